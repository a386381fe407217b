"""Peaks of series over all steps of a run, as they were asked for: `run.peak("S9.ay")`, and as columns of a file."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.results.diagnostics import Extremes

if TYPE_CHECKING:
    from gudgeon.model.compiled import Array
    from gudgeon.results.results import Result

COLUMNS = {
    "name": ("", "series"), "against": ("", "scene whose series was subtracted"), "unit": ("", "unit of the values"),
    "max": ("", "largest value over all steps, SI"), "t_max": ("s", "its time"),
    "min": ("", "smallest value over all steps, SI"), "t_min": ("s", "its time"),
}  # fmt: skip


def over_all_steps(run: Result, name: str, error: bool) -> Extremes:
    """The extremes of a series of a run, or of its error against another scene.

    Raises UnknownNameError for what the run does not have, BadValueError for what was not asked for.
    """
    if name not in run.names:
        raise run.unknown(name)
    for one in run.diagnostics.extremes:
        if one.name == name and bool(one.against) == error:
            return one
    if error:
        told = f"the error of {name} over all steps is not known"
        raise BadValueError(told, hint=f'simulate(…, peaks=["{name}"], against=ideal), where ideal is a loaded scene')
    told = f"the peak of {name} over all steps was not asked for, and samples do not know it"
    raise BadValueError(told, hint=f'simulate(…, peaks=["{name}"]), or peaks: [{name}] in the scene of the file')


def columns(extremes: Sequence[Extremes]) -> dict[str, Array]:
    """Name -> (k,) values, in the order of COLUMNS."""
    return {
        name: np.array([getattr(one, name) for one in extremes], object if name in ("name", "against", "unit") else float)
        for name in COLUMNS
    }

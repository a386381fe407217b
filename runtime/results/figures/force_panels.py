"""Which forces of joints with play a figure shows beside each other, their curves and their peaks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from gudgeon.results import trace

if TYPE_CHECKING:
    from gudgeon.model.compiled import Array
    from gudgeon.results.results import Result

MOST = 4  # panels of a figure


def panels(runs: Iterable[Result]) -> dict[str, list[str]]:
    """Series by what a panel is called: the force at each bearing; of a guide force and moment on its slider, at
    samples, and the forces at its corners, through the extremes of all steps."""
    found = dict[str, list[str]]()
    for joint in dict.fromkeys(joint.name for run in runs for joint in run.source.clearances):
        guide, _, corner = joint.partition(".")
        found.setdefault(f"force at {guide}{', of samples' * bool(corner)}", [f"{guide}.F"])
        if corner:
            found.setdefault(f"moment at {guide}, of samples", [f"{guide}.M"])
            found.setdefault(f"forces at corners of {guide}", []).append(f"{joint}.F")
    return dict([*found.items()][:MOST])


def curve(run: Result, name: str) -> tuple[Array, Array]:
    """Times and values of a series of a panel, (k,) each."""
    return trace.force(run, name.removesuffix(".F")) if name.endswith(".F") else (run.t, run[name])


def peaks(run: Result, name: str) -> Iterator[tuple[float, float]]:
    """Time and value of its peak over all steps, where that is known: of a guide if the run was asked for it."""
    yield from ((peak.t, peak.F) for peak in run.diagnostics.peaks if f"{peak.joint}.F" == name)
    for one in run.diagnostics.extremes:
        if one.name == name and not one.against:
            yield one.t_abs, one.max if one.max >= -one.min else one.min

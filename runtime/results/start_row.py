"""The start of a run whose requested times do not include it.

A Result contains exactly the times that `simulate(output=[…])` requests. Where these begin after the start,
`Result.start_row` is a result of one sample with the state at the start: works and energy.residual count from there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from gudgeon.model.evaluation import Evaluation
from gudgeon.results.state import Array

if TYPE_CHECKING:
    from gudgeon.results.results import Result

ROWS = ("t", "q", "v", "accelerations", "state", "memory", "work")  # arrays of a Result with a row for each sample
Run = TypeVar("Run", bound="Result")


def without_start(run: Run) -> Run:
    """Return the run without its first sample, which becomes its `start_row`; the run itself if there is no other."""
    if len(run.t) < 2:
        return run
    first = replace(_rows(run, lambda x: x[:1].copy()), trace=None, event_states=None)
    others = _rows(run, lambda x: x[1:])
    others.start_row = first
    return others


def with_start(run: Run) -> Run:
    """Return the run with its start as the first sample; the run itself if its samples include the start."""
    first = run.start_row
    if first is None:
        return run
    rows: dict[str, Any] = {name: _joined(getattr(first, name), getattr(run, name)) for name in ROWS}
    both = run.stored.keys() & first.stored.keys()
    stored = {name: np.concatenate([first.stored[name], run.stored[name]]) for name in both}
    return replace(run, **rows, stored=stored, start_row=None)


def _joined(*parts: Array | None) -> Array | None:
    known = [part for part in parts if part is not None]
    return np.concatenate(known) if len(known) == len(parts) else None


def _rows(run: Run, take: Callable[[Array], Array]) -> Run:
    """Return a run with the samples that `take` selects, and what was evaluated of them so far."""
    arrays = ((name, getattr(run, name)) for name in ROWS)
    rows: dict[str, Any] = {name: None if x is None else take(x) for name, x in arrays}
    found = replace(run, **rows, stored={})
    if (known := run.__dict__.get("evaluation")) is not None:
        found.__dict__["evaluation"] = Evaluation(*(take(part) for part in vars(known).values()))
    return found

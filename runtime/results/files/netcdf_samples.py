"""What the integrator stores of a run, from its series in a file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.model.compiled import Array
from gudgeon.results.files.netcdf import START, STATES, at_event, variable
from gudgeon.results.series import MOTION

if TYPE_CHECKING:
    from gudgeon.results.files.netcdf_read import File
    from gudgeon.results.results import Result


def samples_of(source: KernelSource, stored: Mapping[str, Array], length: int) -> dict[str, Any]:
    """What the integrator stores of rows, from their series; by the names of a Result."""
    q, v, a = (_motion(source, stored, length, order) for order in range(3))
    return {
        "q": q, "v": v, "accelerations": a,
        "state": _columns(stored, [f"{joint.name}.state" for joint in source.clearances], length, np.int8),
        "memory": _columns(stored, _memory_names(source), length),
        "work": _works(source, stored, length),
    }  # fmt: skip


def _motion(source: KernelSource, stored: Mapping[str, Array], samples: int, order: int) -> Array:
    """q, q̇ or q̈ (order 0, 1, 2) from the bodies' series."""
    if sorted(body.index for body in source.bodies) != list(range(0, 3 * len(source.bodies), 3)):
        raise ValueError("the bodies' places in q are not theirs")
    values = np.empty((samples, 3 * len(source.bodies)))
    for body in source.bodies:
        for axis, names in enumerate(MOTION):
            values[:, body.index + axis] = stored[f"{body.name}.{names[order]}"]
    return values


def _columns(stored: Mapping[str, Array], names: list[str], samples: int, dtype: Any = float) -> Array:
    values = np.empty((samples, len(names)), dtype)
    for column, name in enumerate(names):
        values[:, column] = stored[name] if name else 0.0  # a place that no law's state has
    return values


def _works(source: KernelSource, stored: Mapping[str, Array], samples: int) -> Array:
    """NaN where there are no masses to tell them by."""
    if source.massless:
        return np.full((samples, 3), np.nan)
    return _columns(stored, ["work.drives", "work.forces", "work.clearances"], samples)


def _memory_names(source: KernelSource) -> list[str]:
    """The series that hold what the right-hand side remembers."""
    latches = [f"{joint.name}.deltadot_minus" for joint in source.clearances]
    return [*latches, *(f"{f}.mode" for f in source.frictions), *source.states]


def states_at_events(file: File, run: Result) -> Result:
    """The result whose samples are the start of the run and then its events."""
    stored, count, first = {}, len(run.events), run.start_row or run
    for name in run.stored:
        at = file.numbers(f"{STATES}/{at_event(name)}", count, "i1" if name.endswith(".state") else "f8")
        stored[name] = np.concatenate([first.stored[name][:1], at])
        stored[name].flags.writeable = False
    t, rows = np.concatenate([first.t[:1], run.events["t"]]), samples_of(run.source, stored, 1 + count)
    return replace(run, t=t, **rows, trace=None, stored=stored, start_row=None)


def start_row(file: File, run: Result) -> Result:
    """Return the start of a run whose samples begin later."""
    t = file.numbers(f"{START}/time", 1)
    own = {name: (f"{START}/{variable(name)}", values.dtype.str) for name, values in run.stored.items()}
    stored = {name: file.numbers(at, 1, dtype) for name, (at, dtype) in own.items()}
    for values in stored.values():
        values.flags.writeable = False
    return replace(run, t=t, **samples_of(run.source, stored, 1), trace=None, stored=stored)

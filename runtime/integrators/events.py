"""User events of a run as C lists them, with the states there."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import MAX_LISTED, N_WORK
from gudgeon.integrators.trajectory import event_dtype
from gudgeon.model.compiled import Array, CompiledModel

EPSILON = float(np.finfo(np.float64).eps)


def resolution(t: Array) -> float:
    """Return the time (s) up to which an event and a sample coincide in a run with these output times (N,)."""
    return max(32 * EPSILON * float(abs(t[[0, -1]]).max()), min(1e-11, 1e-10 * float(t[-1] - t[0])))


def no_states(compiled: CompiledModel) -> NDArray[Any]:
    """Return an empty list of events with states."""
    return np.zeros(0, dtype=event_dtype(compiled.n, compiled.n_memory, len(compiled.source.clearances)))


def fetch_events(compiled: CompiledModel, run: Any, times: Array) -> NDArray[Any]:
    """Return the list of user events of a struct (event_dtype), which is emptied; those of the start do not count.

    Numbers beyond the events of the scene stand for the same events, which are no number from that time on.
    """
    joints, rows = len(compiled.source.clearances), MAX_LISTED if compiled.source.events else 1
    t, event = np.zeros(rows), np.zeros(rows, dtype=np.intc)
    y, memory = (np.zeros((rows, max(width, 1))) for width in (2 * compiled.n + N_WORK, compiled.n_memory))
    state = np.zeros((rows, max(joints, 1)), dtype=np.int8)
    arrays = (compiled.pointer(t), compiled.pointer(event, "int *"), compiled.pointer(y), compiled.pointer(memory),
              compiled.pointer(state, "signed char *"))  # fmt: skip
    parts, count = [no_states(compiled)], rows
    while count == rows:
        count = compiled.lib.gudgeon_run_events(run, rows, *arrays)
        part = np.zeros(count, dtype=parts[0].dtype)
        part["event"], part["t"], part["y"] = event[:count], t[:count], y[:count]
        part["memory"], part["state"] = memory[:count, : compiled.n_memory], state[:count, :joints]
        parts.append(part)
    fetched = np.concatenate(parts)
    no_number = fetched["event"] >= len(compiled.source.events)
    return fetched[no_number | (fetched["t"] > times[0] + resolution(times))]


def split_undefined(compiled: CompiledModel, found: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return the events by time, and those that are no number from a time on; both of the type of `found`."""
    ordered = found[np.argsort(found["t"], kind="stable")]
    number = ordered["event"] < len(compiled.source.events)
    lost = ordered[~number]
    lost["event"] -= len(compiled.source.events)
    return ordered[number], lost

"""Output times of a run, from what a user gives for its end and its output."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.compiled import Array
from gudgeon.errors import BadValueError
from gudgeon.kernel_source import KernelSource, Slot
from gudgeon.parameters import number
from gudgeon.step import scene_end

DEFAULT_OUTPUT = 1000
NEAREST, SHORTEST, FURTHEST = 1024, 1e-290, 1e18  # roundings between start and end; s, of a run


def output_times(
    source: KernelSource, t0: float, t_end: float | str | None, output: int | ArrayLike | None
) -> Array:
    """Output times (s), increasing, the first is t0. Raises BadValueError."""
    defaults = source.simulate
    if output is not None and not isinstance(output, (int, np.integer)):
        times = np.asarray(output, dtype=float)
        if times.ndim != 1 or not len(times) or not np.isfinite(times).all() or (np.diff(times) <= 0).any():
            raise BadValueError("output: expected increasing, finite times (s)")
        if times[0] < t0:
            raise BadValueError(f"output: times begin at {t0:g} s, got {times[0]:g} s")
        _check_end("output ends", t0, float(times[-1]))
        return times if times[0] == t0 else np.concatenate([[t0], times])
    end = seconds("t_end", scene_end(source) if t_end is None else t_end)
    if not end > t0:
        raise BadValueError(f"t_end is {end:g} s: expected a time after the start at {t0:g} s")
    intervals = int(output if output is not None else defaults.get("output", DEFAULT_OUTPUT))
    if not 1 <= intervals <= 10**8:
        raise BadValueError(f"output is {intervals}: expected a number of intervals, 1 to 1e8")
    _check_end("t_end is", t0, end, 4 * intervals)
    return np.linspace(t0, end, intervals + 1)


def _check_end(what: str, t0: float, end: float, roundings: int = NEAREST) -> None:
    """BadValueError for an end so near to the start that no times lie between, or beyond all times."""
    if end > FURTHEST:
        raise BadValueError(f"{what} {end:g} s: expected {FURTHEST:g} s at most", hint="times are in s")
    least = max(max(roundings, NEAREST) * float(np.spacing(max(abs(t0), abs(end)))), SHORTEST)
    if 0.0 < end - t0 < least:
        raise BadValueError(
            f"{what} {end:.17g} s, {end - t0:.3g} s after the start at {t0:.9g} s: expected {least:.3g} s at least, or"
            " numbers have no room for the times between",
            hint="times are in s",
        )


def seconds(name: str, value: float | str) -> float:
    """A time that a user gives. Raises BadValueError."""
    return number(value, Slot(name, "s", 0.0, False, (0, 0, 1)))

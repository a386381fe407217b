"""Runs by heyoka, a Taylor method whose code LLVM makes: one alone, and several of a batch in vectors.

Variables and rates are expressions of heyoka's; times are of `propagate_until`, called from Python.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from importlib import import_module
from time import perf_counter
from typing import Any

import numpy as np

from benchmarks.peers import andrews

NAME = "heyoka"


def variables(*names: str) -> list[Any]:
    """Of these names."""
    return list(import_module(NAME).make_vars(*names))


def integrator(state: Sequence[Any], rates: Sequence[Any], start: np.ndarray, tolerance: float) -> Any:
    """A compiled one; `start` (N,), or (N, runs) for so many runs side by side."""
    hy = import_module(NAME)
    make = hy.taylor_adaptive_batch if start.ndim == 2 else hy.taylor_adaptive
    return make(list(zip(state, rates, strict=True)), start, tol=tolerance)


def beside() -> int:
    """How many runs it recommends to be put side by side."""
    return int(import_module(NAME).recommended_simd_size())


def timed(run: Any, start: np.ndarray, t_end: float) -> float:
    """Seconds of a run from the start; its state is that at the end."""
    if start.ndim == 2:
        run.set_time(0.0)
    else:
        run.time = 0.0
    run.state[:] = start
    before = perf_counter()
    run.propagate_until(t_end)
    return perf_counter() - before


@cache
def _of_andrews(tolerance: float) -> Any:
    hy = import_module(NAME)
    y = variables(*(f"{kind}{k}" for kind in "qv" for k in range(7)))
    found = andrews.parts(hy, _as_it_is, y[:7], y[7:])
    rates = [*y[7:], *andrews.eliminate(_as_it_is, found)]
    return integrator(y, rates, andrews.start(), tolerance)


def _as_it_is(value: Any) -> Any:
    """heyoka finds by itself what is read twice."""
    return value


def of_andrews(tolerance: float) -> andrews.Measured:
    """Andrews' squeezer by accelerations, constraints and multipliers eliminated in its own expressions (index 1)."""
    run = _of_andrews(tolerance)
    seconds = timed(run, andrews.start(), andrews.T_END)
    return andrews.error(run.state), seconds, -1

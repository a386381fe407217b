"""Integrate by heyoka, a Taylor method with code compiled by LLVM: single runs, and runs in SIMD lanes.

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
    """Return heyoka's variables with these names."""
    return list(import_module(NAME).make_vars(*names))


def integrator(state: Sequence[Any], rates: Sequence[Any], start: np.ndarray, tolerance: float) -> Any:
    """Return a compiled integrator; `start` (N,), or (N, runs) for runs in SIMD lanes."""
    hy = import_module(NAME)
    make = hy.taylor_adaptive_batch if start.ndim == 2 else hy.taylor_adaptive
    return make(list(zip(state, rates, strict=True)), start, tol=tolerance)


def beside() -> int:
    """Return the recommended number of runs in SIMD lanes."""
    return int(import_module(NAME).recommended_simd_size())


def timed(run: Any, start: np.ndarray, t_end: float) -> float:
    """Return the seconds of a run from the start; its state is then that at the end."""
    if start.ndim == 2:
        run.set_time(0.0)
    else:
        run.time = 0.0
    run.state[:] = start
    before = perf_counter()
    run.propagate_until(t_end)
    return perf_counter() - before


@cache
def _andrews_integrator(tolerance: float) -> Any:
    """Return the compiled integrator of Andrews' squeezer."""
    hy = import_module(NAME)
    y = variables(*(f"{kind}{k}" for kind in "qv" for k in range(7)))
    found = andrews.parts(hy, _keep_expression, y[:7], y[7:])
    rates = [*y[7:], *andrews.eliminate(_keep_expression, found)]
    return integrator(y, rates, andrews.start(), tolerance)


def _keep_expression(value: Any) -> Any:
    """Return the value: heyoka finds common subexpressions itself."""
    return value


def of_andrews(tolerance: float) -> andrews.Measured:
    """Integrate Andrews' squeezer with multipliers eliminated in heyoka's expressions (index 1)."""
    run = _andrews_integrator(tolerance)
    seconds = timed(run, andrews.start(), andrews.T_END)
    return andrews.error(run.state), seconds, -1

"""Integrate by heyoka, a Taylor method with code compiled by LLVM: single runs, and runs in SIMD lanes.

Variables and rates are expressions of heyoka's; times are of `propagate_until`, called from Python.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from importlib import import_module
from typing import Any

import numpy as np

from benchmarks.peers import andrews
from benchmarks.peers.timing import CallTimer, Measured

NAME = "heyoka"


def variables(*names: str) -> list[Any]:
    """Return heyoka's variables with these names."""
    return list(import_module(NAME).make_vars(*names))


def integrator(
    state: Sequence[Any], rates: Sequence[Any], start: np.ndarray, tolerance: float, compact: bool = False
) -> Any:
    """Return a compiled integrator; `start` (N,), or (N, runs) for runs in SIMD lanes; `compact`: loops, not text."""
    hy = import_module(NAME)
    make = hy.taylor_adaptive_batch if start.ndim == 2 else hy.taylor_adaptive
    return make(list(zip(state, rates, strict=True)), start, tol=tolerance, compact_mode=compact)


def beside() -> int:
    """Return the recommended number of runs in SIMD lanes."""
    return int(import_module(NAME).recommended_simd_size())


def propagate(run: Any, start: np.ndarray, t_end: float, timer: CallTimer) -> np.ndarray:
    """Run from the start to `t_end`; return a copy of the state there. The timer measures the integration."""
    if start.ndim == 2:
        run.set_time(0.0)
    else:
        run.time = 0.0
    run.state[:] = start
    with timer.engine:
        run.propagate_until(t_end)
    return np.array(run.state)


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


def of_andrews(tolerance: float) -> Measured:
    """Integrate Andrews' squeezer with multipliers eliminated in heyoka's expressions (index 1)."""
    run = _andrews_integrator(tolerance)
    timer = CallTimer()
    state = propagate(run, andrews.start(), andrews.T_END, timer)
    return timer.measured(lambda: andrews.error(state))

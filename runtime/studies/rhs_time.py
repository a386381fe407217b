"""The time of one right-hand side, beside the number of operations in it."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from gudgeon.contract.boundary import N_WORK
from gudgeon.errors import SolverError
from gudgeon.model.compiled import Array
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.runs import Setting, natural_step, window

BATCH, REPEATS = 20_000, 9


@dataclass(frozen=True)
class RhsTime:
    """One call of ẏ = f(t, y), at one state."""

    state: str  # "start", or which joint is in contact
    seconds: float  # the least over several batches
    operations: int  # additions, multiplications, divisions, functions on the way that this state takes
    t: float
    q: Array  # (n,)
    v: Array


def time_rhs(simulation: Simulation, longest: float, batch: int = BATCH, repeats: int = REPEATS) -> list[RhsTime]:
    """At the start and, where a joint with play touches within `longest` (s), at the first peak of its force."""
    start = simulation.start()
    free = simulation.compiled.memory_array(None)
    found = [_time(simulation, "start", 0.0, start.q, start.v, free, batch, repeats)]
    if (run := _touching(simulation, longest)) is not None:
        closed = [j.name for j, code in zip(simulation.source.clearances, run.state[-1], strict=True) if code]
        state = f"{', '.join(closed)} in contact"
        found.append(
            _time(simulation, state, float(run.t[-1]), run.q[-1], run.v[-1], run.memory[-1], batch, repeats, closed)
        )
    return found


def operations(simulation: Simulation, closed: list[str] | None = None) -> int:
    """Of the equations of motion, every film, and the dry forces of the joints that are closed."""
    total = 0
    for kernel, count in simulation.source.operations.items():
        names = [j.name for j in simulation.source.clearances if kernel.endswith(f"_{j.name}_force")]
        if kernel == "dynamics" or (names and (kernel.startswith("film_") or names[0] in (closed or []))):
            total += count
    return total


def _touching(simulation: Simulation, longest: float) -> Result | None:
    """A run that ends at the first contact's peak force, with the contact closed."""
    if not simulation.source.clearances:
        return None
    step = natural_step(simulation)
    try:
        work = window(simulation, longest, Setting("rk4", step))
        impacts = simulation.simulate(work.t_end, output=1, method="rk4", step=step, stop=False, peaks=()).impacts
        if not len(impacts):
            return None
        run = simulation.simulate(float(impacts[0]["t_peak"]), output=1, method="rk4", step=step, stop=False, peaks=())
    except SolverError:
        return None
    return run if run.state[-1].any() else None


def _time(
    simulation: Simulation, state: str, t: float, q: Array, v: Array, memory: Array, batch: int, repeats: int,
    closed: list[str] | None = None,
) -> RhsTime:  # fmt: skip
    model = simulation.compiled
    y, latched = np.concatenate([q, v, np.zeros(N_WORK)]), model.memory_array(memory)
    arguments = (batch, t, model.pointer(y), model.pointer(latched), model.pointer(simulation.p))
    best = np.inf
    for _ in range(repeats):
        before = time.perf_counter()
        model.lib.gudgeon_time_rhs(*arguments)
        best = min(best, (time.perf_counter() - before) / batch)
    return RhsTime(state, best, operations(simulation, closed), t, q.copy(), v.copy())

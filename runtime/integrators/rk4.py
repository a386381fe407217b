"""Classical Runge–Kutta of order 4 with fixed step: the loop is in C (templates/c/rk4.c.jinja).

Python is called once a chunk of steps and fetches impacts and samples; C asks it on the way whether to go on.
Constraints are stabilised by Baumgarte's terms (physics.md, section 1).
"""

from __future__ import annotations

import math
from time import perf_counter

from gudgeon.integrators.session import Session
from gudgeon.integrators.trajectory import Problem, Trajectory

NAME, ORDER, SOURCE = "rk4", 4, "W. Kutta, Z. Math. Phys. 46 (1901) 435-453"

CHUNK = 20_000  # steps of one call of C
ADVICE = "the step {:.3g} s is too long for this scene: take a smaller one"


def run(problem: Problem) -> Trajectory:
    """Integrate over the output times; each interval is divided evenly into steps ≤ problem.step."""
    session = Session(problem)
    _steps(session, float(problem.t[0]), float(problem.t[0]), 1, 0, 0)  # the first right-hand side
    session.sample(0)
    return session.drive(lambda: _all(session))


def _all(session: Session) -> None:
    """From sample to sample; raises RunEnded, KeyboardInterrupt, SolverError."""
    for i in range(1, len(session.problem.t)):
        _advance(session, i)
        session.sample(i)
    session.look()


def _advance(session: Session, i: int) -> None:
    """From output time i − 1 to i."""
    problem = session.problem
    t0, t1 = (float(t) for t in problem.t[i - 1 : i + 1])
    total = max(1, math.ceil((t1 - t0) / problem.step * (1.0 - 1e-12)))
    first = 0
    while first < total:
        first += _steps(session, t0, t1, total, first, min(CHUNK, total - first))


def _steps(session: Session, t0: float, t1: float, total: int, first: int, count: int) -> int:
    """Up to `count` steps in C; the number that was made. Raises SolverError."""
    taken = session.compiled.ffi.new("long *")
    p = session.pointer(session.p)
    before = perf_counter()
    status = session.lib.gudgeon_run_steps(session.run, p, t0, t1, total, first, count, taken)
    session.seconds += perf_counter() - before
    session.back(status, t0 + (first + taken[0]) * (t1 - t0) / total, ADVICE.format(session.problem.step))
    return int(taken[0])

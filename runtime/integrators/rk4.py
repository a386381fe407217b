"""Classical Runge–Kutta of order 4 with fixed step: the loop is in C (templates/c/rk4.c.jinja).

Every step is as long as was asked for, the last one as is left; outputs do not touch them. Samples between two steps
come from the cubic through both. Python is called once a chunk of steps: it moves the progress bar, fetches impacts
and events, and sees Ctrl-C. In the full formulation constraints are stabilised by Baumgarte's terms (physics.md,
section 1), in the reduced one they are closed after every step.
"""

from __future__ import annotations

import math
from time import perf_counter

from gudgeon.errors import SolverError
from gudgeon.integrators.session import ENDED, EVENTS_FULL, RunEnded, Session
from gudgeon.integrators.trajectory import Problem, Trajectory

NAME, ORDER, SOURCE = "rk4", 4, "W. Kutta, Z. Math. Phys. 46 (1901) 435-453"

CHUNK = 20_000  # steps between two looks of Python: some 50 ms
ADVICE = "the step {:.3g} s is too long for this scene: take a smaller one"
SAME = 1e-9  # share of the step by which the last one may differ and counts as equal: times are sums of rounded numbers


def run(problem: Problem) -> Trajectory:
    """Integrate over the output times by steps of problem.step."""
    session = Session(problem)
    interrupted, stopped = False, None
    try:
        while session.done < len(problem.t):
            _chunk(session)
    except RunEnded:
        pass
    except KeyboardInterrupt:
        interrupted = True
    except SolverError as error:
        stopped = error
    return session.trajectory(interrupted, stopped)


def _chunk(session: Session) -> None:
    """Some steps in C; raises SolverError."""
    problem, done = session.problem, session.compiled.ffi.new("long *")
    done[0] = session.done
    grid = (problem.step, len(problem.t), session.pointer(problem.t))
    before = perf_counter()
    status = session.lib.gudgeon_rk4_run(
        session.run, session.pointer(session.p), *grid, CHUNK, *session.rows(0), done
    )  # fmt: skip
    session.seconds += perf_counter() - before
    session.done = int(done[0])
    t = session.report()[0]
    if status == EVENTS_FULL:
        session.fetch_impacts(last=False)
        session.fetch_events()
    elif status == ENDED:
        session.end()
    elif status:
        session.fail(status, t, ADVICE.format(problem.step))
    if problem.progress:
        problem.progress((t - problem.t[0]) / max(problem.t[-1] - problem.t[0], 1e-300), "integrating")


def last_step(duration: float, step: float) -> float:
    """Length (s) of the last of the steps over `duration`: `step`, or what is left (step_end in model.h)."""
    total = max(1, math.ceil(duration / step * (1.0 - 1e-12)))
    rest = duration - (total - 1) * step
    return step if abs(rest - step) < SAME * step else rest

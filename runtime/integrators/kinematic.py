"""No degree of freedom: positions by Newton from sample to sample, the rest by linear solves.

Nothing is integrated but the work of drives and force elements, for the energy check: Gauss–Legendre quadrature of
their power over the steps that follow the motion (templates/c/kinematic.c.jinja). `Trajectory.seconds` is the time
of the motion, works and events not counted.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np

from gudgeon.compiled import Array
from gudgeon.errors import NonFiniteError, SolverError
from gudgeon.integrators.failure import NO_NUMBER
from gudgeon.integrators.kinematic_events import find_events
from gudgeon.integrators.session import resolution
from gudgeon.integrators.trajectory import Counts, Problem, Trajectory, no_events
from gudgeon.start import mechanism_size
from gudgeon.written import rate_reason, reason_between

NAME, ORDER, SOURCE = "kinematic", 0, "Newton's method on the constraints"

REACH = 0.05  # rad, or share of the mechanism's size: a Newton correction beyond it halves the way
CHUNK = 20_000  # samples between two looks of Python: some 20 ms


@dataclass(frozen=True)
class _Motion:
    """Positions, velocities and accelerations, (k, n), as far as they could be reached."""

    q: Array
    v: Array
    a: Array
    counts: Counts
    seconds: float
    interrupted: bool = False
    stopped: SolverError | None = None


def run(problem: Problem) -> Trajectory:
    """Samples at the output times, and at the event that ends the run, if any does."""
    motion = _follow(problem)
    if not problem.compiled.source.events:
        return _with_work(problem, motion)
    events, lost, unfinished, interrupted, ended = no_events(), no_events(), None, motion.interrupted, False
    try:
        size = mechanism_size(problem.compiled, problem.p)
        events, lost, ended = find_events(problem, problem.t[: len(motion.q)], motion.q, motion.v, REACH, size)
    except KeyboardInterrupt:
        interrupted = True
    except SolverError as error:
        unfinished = error
    if ended:
        last = events["t"][-1]
        problem = replace(problem, t=np.append(problem.t[problem.t < last - resolution(problem.t)], last))
        motion = _follow(problem)
    trajectory = _with_work(problem, motion)
    return replace(
        trajectory, events=events[events["t"] <= trajectory.t[-1]], interrupted=interrupted or trajectory.interrupted,
        stopped=trajectory.stopped or unfinished, no_number=lost[lost["t"] <= trajectory.t[-1]],
    )  # fmt: skip


def _follow(problem: Problem) -> _Motion:
    """The motion at the output times, as far as they can be reached."""
    compiled, pointer, t = problem.compiled, problem.compiled.pointer, problem.t
    q, v, a = (np.zeros((len(t), compiled.n)) for _ in range(3))
    q[0], v[0], a[0] = problem.q, problem.v, np.nan
    size, maxima, longs = mechanism_size(compiled, problem.p), np.zeros(2), np.zeros(2, dtype=np.int_)
    first, seconds, interrupted, stopped = 0, 0.0, False, None
    try:
        while stopped is None and (first < len(t) - 1 or not first):
            arguments = (
                min(CHUNK, len(t) - 1 - first), pointer(t[first:]), pointer(problem.p), REACH, size,
                *(pointer(x[first:]) for x in (q, v, a)), pointer(maxima), pointer(maxima[1:]),
                pointer(longs, "long *"), pointer(longs[1:], "long *"),
            )  # fmt: skip
            before = perf_counter()
            status = compiled.lib.gudgeon_kinematic(*arguments)
            seconds += perf_counter() - before
            first += int(longs[1])
            if status:
                stopped = _failure(problem, status, float(t[first]))
            if problem.progress:
                problem.progress(first / max(len(t) - 1, 1), "following the constraints")
            if len(t) == 1:
                break
    except KeyboardInterrupt:
        interrupted = True
    counts = Counts(int(longs[0]), 0, phi_max=float(maxima[0]), phi_dot_max=float(maxima[1]))
    reached = slice(first + 1)
    return _Motion(q[reached], v[reached], a[reached], counts, seconds, interrupted, stopped)


def _with_work(problem: Problem, motion: _Motion) -> Trajectory:
    """The motion with the works of drives and force elements, as far as both are known."""
    compiled, pointer, t = problem.compiled, problem.compiled.pointer, problem.t
    count, work, done = len(motion.q), np.zeros((len(motion.q), 3)), np.zeros(1, dtype=np.int_)
    first, interrupted, stopped = 0, motion.interrupted, motion.stopped
    size, status = mechanism_size(compiled, problem.p), 0
    try:
        while first < count - 1 and not status:
            status = compiled.lib.gudgeon_kinematic_works(
                min(CHUNK, count - 1 - first), pointer(t[first:]), pointer(problem.p), REACH, size,
                pointer(motion.q[first:]), pointer(motion.v[first:]), pointer(work[first:]), pointer(done, "long *"),
            )  # fmt: skip
            first += int(done[0])
    except KeyboardInterrupt:
        interrupted = True
    if status:
        stopped = _failure(problem, status, float(t[first]))
    empty, reached = np.zeros((first + 1, 0)), slice(first + 1)
    from gudgeon.results import IMPACT_DTYPE

    return Trajectory(
        t[reached].copy(), motion.q[reached], motion.v[reached], motion.a[reached], empty, empty.astype(np.int8),
        work[reached], np.zeros(0, dtype=IMPACT_DTYPE), np.zeros((0, 3)), motion.counts, interrupted, stopped,
        motion.seconds,
    )  # fmt: skip


def _failure(problem: Problem, status: int, t: float) -> SolverError:
    later = problem.t[problem.t > t]
    until = float(later[0]) if len(later) else t
    why, when = reason_between(problem.compiled.source, problem.p, t, until)
    if not why:
        times = np.linspace(t, until, 1001)
        why, when = rate_reason(problem.compiled, problem.p, times, np.zeros(problem.compiled.n))
    if why:
        return NonFiniteError(f"{why}\n  {NO_NUMBER}", when)
    if status < 0:
        return SolverError(
            f"the linkage cannot follow its drives beyond t = {t:.9g} s: Newton's method finds no position there\n"
            "  the lengths do not let the drives turn on, or the linkage passes a dead centre",
            t,
        )
    try:
        problem.compiled.check_pivot(status, t, problem.compiled.source.start_pivots)
    except SolverError as error:
        return error
    raise AssertionError("a positive status raises")

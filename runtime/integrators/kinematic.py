"""No degree of freedom: positions by Newton from sample to sample, the rest by linear solves.

Nothing is integrated but the work of drives and force elements, for the energy check: Gauss–Legendre
quadrature of their power inside every interval.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from gudgeon.compiled import Array
from gudgeon.errors import SolverError
from gudgeon.integrators.kinematic_events import find_events
from gudgeon.integrators.trajectory import Counts, Problem, Trajectory, no_events
from gudgeon.start import mechanism_size

NAME, ORDER, SOURCE = "kinematic", 0, "Newton's method on the constraints"

REACH = 0.05  # rad, or share of the mechanism's size: a Newton correction beyond it halves the way
RESOLUTION = 1e-12  # s: an output so close to the end of the run is the end
CHUNK = 2_000  # samples between two looks of Python
GAUSS = 4  # nodes an interval


def run(problem: Problem) -> Trajectory:
    """Samples at the output times, and at the event that ends the run, if any does."""
    times = _nodes(problem.t)
    motion = _follow(problem, times)
    if not problem.compiled.source.events:
        return _sample(problem, times, motion)
    events, unfinished, interrupted, ended = no_events(), None, motion.interrupted, False
    try:
        size = mechanism_size(problem.compiled, problem.p)
        events, ended = find_events(problem, times[: len(motion.q)], motion.q, motion.v, REACH, size)
    except KeyboardInterrupt:
        interrupted = True
    except SolverError as error:
        unfinished = error
    if ended:
        last = events["t"][-1]
        problem = replace(problem, t=np.append(problem.t[problem.t < last - RESOLUTION], last))
        times = _nodes(problem.t)
        motion = _follow(problem, times)
    trajectory = _sample(problem, times, motion)
    return replace(
        trajectory, events=events[events["t"] <= trajectory.t[-1]], interrupted=interrupted or trajectory.interrupted,
        stopped=trajectory.stopped or unfinished,
    )  # fmt: skip


def _nodes(t: Array) -> Array:
    """The output times, with the nodes of the quadrature between them."""
    nodes, _ = np.polynomial.legendre.leggauss(GAUSS)
    inner = t[:-1, None] + 0.5 * np.diff(t)[:, None] * (1.0 + nodes)
    return np.concatenate([t[:1], np.concatenate([inner, t[1:, None]], axis=1).ravel()])


@dataclass(frozen=True)
class _Motion:
    """Positions and velocities, (k, n), as far as they could be reached."""

    q: Array
    v: Array
    counts: Counts
    interrupted: bool
    stopped: SolverError | None


def _sample(problem: Problem, times: Array, motion: _Motion) -> Trajectory:
    """The motion at the output times, accelerations and the drives' work with it."""
    _, weights = np.polynomial.legendre.leggauss(GAUSS)
    h = np.diff(problem.t)
    whole = (len(motion.q) - 1) // (GAUSS + 1) + 1  # complete intervals, the start with them
    kept = (whole - 1) * (GAUSS + 1) + 1
    q, v, times = motion.q[:kept], motion.v[:kept], times[:kept]
    evaluation = problem.compiled.evaluate(times, q, v, np.zeros((kept, 0)), problem.p)
    power = evaluation.power[1:].reshape(whole - 1, GAUSS + 1, 3)[:, :GAUSS]
    work = np.zeros((whole, 3))
    work[1:] = np.cumsum(0.5 * h[: whole - 1, None] * np.einsum("igk,g->ik", power, weights), axis=0)
    every = slice(None, None, GAUSS + 1)
    empty = np.zeros((whole, 0))
    from gudgeon.results import IMPACT_DTYPE

    return Trajectory(
        problem.t[:whole].copy(), q[every].copy(), v[every].copy(), evaluation.a[every].copy(), empty,
        empty.astype(np.int8), work, np.zeros(0, dtype=IMPACT_DTYPE), np.zeros((0, 3)), motion.counts,
        motion.interrupted, motion.stopped,
    )  # fmt: skip


def _follow(problem: Problem, times: Array) -> _Motion:
    """Positions and velocities at all times, as far as they can be reached."""
    compiled, pointer = problem.compiled, problem.compiled.pointer
    q, v = np.zeros((len(times), compiled.n)), np.zeros((len(times), compiled.n))
    q[0], v[0] = problem.q, problem.v
    maxima, longs = np.zeros(2), np.zeros(2, dtype=np.int_)
    first, interrupted, stopped = 0, False, None
    try:
        while first < len(times) - 1 and stopped is None:
            count = min(CHUNK, len(times) - 1 - first)
            status = compiled.lib.gudgeon_kinematic(
                count, pointer(times[first:]), pointer(problem.p), REACH, mechanism_size(compiled, problem.p),
                pointer(q[first:]), pointer(v[first:]), pointer(maxima), pointer(maxima[1:]),
                pointer(longs, "long *"), pointer(longs[1:], "long *"),
            )  # fmt: skip
            first += int(longs[1])
            if status:
                stopped = _failure(problem, status, float(times[first]))
            if problem.progress:
                problem.progress(first / max(len(times) - 1, 1), "following the constraints")
    except KeyboardInterrupt:
        interrupted = True
    counts = Counts(int(longs[0]), 0, phi_max=float(maxima[0]), phi_dot_max=float(maxima[1]))
    return _Motion(q[: first + 1], v[: first + 1], counts, interrupted, stopped)


def _failure(problem: Problem, status: int, t: float) -> SolverError:
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

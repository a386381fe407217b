"""No degree of freedom: positions by Newton from sample to sample, the rest by linear solves.

Nothing is integrated but the work of drives and force elements, for the energy check: Gauss–Legendre
quadrature of their power inside every interval.
"""

from __future__ import annotations

import numpy as np

from gudgeon.compiled import Array
from gudgeon.errors import SolverError
from gudgeon.integrators.trajectory import Counts, Problem, Trajectory
from gudgeon.start import mechanism_size

NAME, ORDER, SOURCE = "kinematic", 0, "Newton's method on the constraints"

REACH = 0.05  # rad, or share of the mechanism's size: a Newton correction beyond it halves the way
CHUNK = 2_000  # samples between two looks of Python
GAUSS = 4  # nodes an interval


def run(problem: Problem) -> Trajectory:
    """Positions and velocities at the output times, accelerations and the drives' work with them."""
    nodes, weights = np.polynomial.legendre.leggauss(GAUSS)
    h = np.diff(problem.t)
    inner = problem.t[:-1, None] + 0.5 * h[:, None] * (1.0 + nodes)
    times = np.concatenate([problem.t[:1], np.concatenate([inner, problem.t[1:, None]], axis=1).ravel()])
    q, v, counts, interrupted, stopped = _follow(problem, times)
    whole = (len(q) - 1) // (GAUSS + 1) + 1  # complete intervals, the start with them
    kept = (whole - 1) * (GAUSS + 1) + 1
    q, v, times = q[:kept], v[:kept], times[:kept]
    evaluation = problem.compiled.evaluate(times, q, v, np.zeros((kept, 0)), problem.p)
    power = evaluation.power[1:].reshape(whole - 1, GAUSS + 1, 3)[:, :GAUSS]
    work = np.zeros((whole, 3))
    work[1:] = np.cumsum(0.5 * h[: whole - 1, None] * np.einsum("igk,g->ik", power, weights), axis=0)
    every = slice(None, None, GAUSS + 1)
    empty = np.zeros((whole, 0))
    from gudgeon.results import IMPACT_DTYPE

    return Trajectory(
        problem.t[:whole].copy(), q[every].copy(), v[every].copy(), evaluation.a[every].copy(), empty,
        empty.astype(np.int8), work, np.zeros(0, dtype=IMPACT_DTYPE), np.zeros((0, 3)), counts, interrupted, stopped,
    )  # fmt: skip


def _follow(problem: Problem, times: Array) -> tuple[Array, Array, Counts, bool, SolverError | None]:
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
    return q[: first + 1], v[: first + 1], counts, interrupted, stopped


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

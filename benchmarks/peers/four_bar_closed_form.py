"""Solve many four-bars in closed form by hand-written NumPy: positions, velocities and accelerations at 360 samples.

The crank turns once at constant speed. Coupler (length b) and rocker (c) close the loop over the diagonal from the
crank's head to the rocker's pivot, with the coupler above it:

    d = |B0 - A|, cos(angle at A) = (d^2 + b^2 - c^2)/(2 b d), theta_b = angle of the diagonal + angle at A,
    theta_c = atan2(B - B0).

Derivatives of A + b u_b = B0 + c u_c give two equations for the angular velocities of coupler and rocker, and two for
the accelerations. The product with the vector of one bar eliminates its own unknown.

Arrays have the shape (runs, samples), so that NumPy works on all runs at once, in blocks that fit the cache. Outputs:
angles, angular velocities and accelerations of coupler and rocker, position and
acceleration of the tracer, a point of the coupler. The reference is the same function in long double.
"""

from __future__ import annotations

import math
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from benchmarks.peers import own_scenes, sizes
from benchmarks.peers.timing import CallTimer, Measured
from gudgeon.integrators import lanes

SAMPLES, SPEED = 360, 2.0 * math.pi  # a turn, rad/s
PIVOT, TRACER = 0.1, (0.06, 0.05)  # m: distance of the pivots, tracer from the coupler's tail
CRANK, COUPLER, ROCKER = 0.04, 0.12, 0.08  # m, within SPREAD
SPREAD = 0.05
BLOCK = 32  # runs at once
SERIES = (
    *("coupler.theta", "coupler.omega", "coupler.alpha", "rocker.theta", "rocker.omega", "rocker.alpha"),
    *("coupler.tracer.x", "coupler.tracer.y", "coupler.tracer.ax", "coupler.tracer.ay"),
)


class Lengths(NamedTuple):
    """Lengths of crank, coupler and rocker of each run in m (runs,)."""

    crank: np.ndarray
    coupler: np.ndarray
    rocker: np.ndarray


def draw_lengths(runs: int) -> Lengths:
    """Return random lengths; all linkages are crank-rockers."""
    draw = np.random.default_rng(4).uniform(1.0 - SPREAD, 1.0 + SPREAD, (3, runs))
    return Lengths(CRANK * draw[0], COUPLER * draw[1], ROCKER * draw[2])


def times() -> np.ndarray:
    """Return the times of the samples in s."""
    return np.linspace(0.0, 2.0 * math.pi / SPEED, SAMPLES)


def solve(lengths: Lengths, dtype: Any = float) -> np.ndarray:
    """Return the series of SERIES, shape (10, runs, samples)."""
    runs = len(lengths.crank)
    out = np.empty((len(SERIES), runs, SAMPLES), dtype)
    theta = dtype(SPEED) * times().astype(dtype) + dtype(math.pi) / 2
    unit = np.cos(theta), np.sin(theta)
    for k in range(0, runs, BLOCK):
        a, b, c = (np.asarray(x[k : k + BLOCK], dtype)[:, None] for x in lengths)
        _solve_block(a, b, c, *unit, out[:, k : k + BLOCK])
    return out


def _solve_block(a: Any, b: Any, c: Any, ca: np.ndarray, sa: np.ndarray, out: np.ndarray) -> None:
    """Write the series of some runs; a, b, c have the shape (runs, 1), cosine and sine of the crank (samples,)."""
    x, y = a * ca, a * sa
    dx, dy = PIVOT - x, -y
    squared = dx * dx + dy * dy
    along = (squared + b * b - c * c) / (2.0 * squared)  # of the diagonal, where the height meets it
    height = np.sqrt(b * b / squared - along * along)
    bx, by = along * dx - height * dy, along * dy + height * dx  # the coupler as a vector
    rx, ry = bx - dx, by - dy  # the rocker as a vector
    det = bx * ry - by * rx
    # w_a n_a + w_b n_b = w_c n_c, with n = (-y, x) of each vector
    wb, wc = -SPEED * (x * ry - y * rx) / det, -SPEED * (x * by - y * bx) / det
    # the same for accelerations, with q = sum of w^2 times the vectors
    qx = SPEED * SPEED * x + wb * wb * bx - wc * wc * rx
    qy = SPEED * SPEED * y + wb * wb * by - wc * wc * ry
    eb, ec = (qx * rx + qy * ry) / det, (qx * bx + qy * by) / det
    out[0], out[1], out[2] = np.arctan2(by, bx), wb, eb
    out[3], out[4], out[5] = np.arctan2(ry, rx), wc, ec
    u, v = TRACER[0] / b, TRACER[1] / b
    px, py = u * bx - v * by, u * by + v * bx  # tracer from the crank's head
    out[6], out[7] = x + px, y + py
    out[8] = -SPEED * SPEED * x - eb * py - wb * wb * px
    out[9] = -SPEED * SPEED * y + eb * px - wb * wb * py


@cache
def reference(runs: int) -> np.ndarray:
    """Return the series in long double, rounded."""
    return solve(draw_lengths(runs), np.longdouble).astype(float)


def error(found: np.ndarray) -> float:
    """Return the largest error of a series over its largest value; angles are compared modulo a turn."""
    exact = reference(found.shape[1])
    gap = np.abs(found - exact)
    gap[[0, 3]] = np.abs(np.remainder(found[[0, 3]] - exact[[0, 3]] + math.pi, 2.0 * math.pi) - math.pi)
    return float((gap.max(axis=(1, 2)) / np.abs(exact).max(axis=(1, 2))).max())


def by_numpy(_: float) -> Measured:
    """Solve all runs in closed form; times are those of a run."""
    lengths = draw_lengths(sizes.four_bars)
    timer = CallTimer()
    with timer.engine:
        found = solve(lengths)
    return timer.measured(lambda: error(found)).per(sizes.four_bars)


@cache
def loaded() -> Any:
    """Return gudgeon's compiled four-bar, whose library of vector lanes is compiled with the first runs."""
    simulation = own_scenes.load("four_bar")
    with lanes.announce_later_runs(1_000_000):
        simulation.simulate_many(
            {"omega": np.linspace(6.0, 7.0, 128)}, 1.0, output=times(), keep=list(SERIES), threads=1
        )
    return simulation


def own(_: float) -> Measured:
    """Solve all runs by gudgeon in one thread; times are those of a run."""
    simulation, lengths = loaded(), draw_lengths(sizes.four_bars)
    columns = {f"bodies.{name}.length": values for name, values in lengths._asdict().items()}
    timer = CallTimer()
    with timer.engine:
        batch = simulation.simulate_many(columns, float(times()[-1]), output=times(), keep=list(SERIES), threads=1)
    found = [batch[name] for name in SERIES]
    return timer.measured(lambda: error(np.stack(found)), seconds=batch.seconds).per(sizes.four_bars)

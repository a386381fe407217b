"""Measure ensembles of four-bar linkages: `simulate_many` against hand-written NumPy in closed form, in one thread.

    python -m benchmarks.kinematic [--runs 100000] [--samples 360] [--rounds 3]

The job is that of a synthesis or a tolerance study: for each of the linkages, at each position of the crank, the path
of a point of the coupler, angle, angular velocity and angular acceleration of the rocker, the torque of the motor and
the force in joint B. Both programs return these seven series of all runs, (n, N) each. NumPy intersects two circles,
solves velocities, accelerations and the equations of motion by Cramer's rule, and works on blocks that fit into the
cache. Processor times are the least of several rounds, taken in turns. The largest relative differences of the series
are printed, so that both programs compute the same.
"""

from __future__ import annotations

import argparse
import math
from time import process_time

import numpy as np
from numpy.typing import NDArray

import gudgeon

Array = NDArray[np.float64]
OMEGA = 2.0 * math.pi  # rad/s
SPREAD = 0.02  # relative tolerance of the lengths
SERIES = (
    "coupler.tracer.x",
    "coupler.tracer.y",
    "rocker.theta",
    "rocker.omega",
    "rocker.alpha",
    "motor.torque",
    "B.F",
)
BLOCK = 4096  # samples of a block of NumPy
GRAVITY, GROUND = 9.81, 0.1  # m/s^2; m, distance of the fixed joints
MASS = (0.031, 0.094, 0.063)  # kg, of crank, coupler and rocker, as in mechanisms/four_bar.yaml
INERTIA = (5.2e-6, 1.16e-4, 3.5e-5)  # kg m^2
TRACER = (0.06, 0.05)  # m, in the coupler's frame from its tail


def draw_lengths(n: int) -> Array:
    """Return the lengths (n, 3) in m of crank, coupler and rocker."""
    nominal = np.array([0.04, 0.12, 0.08])
    return nominal * (1.0 + SPREAD * np.random.default_rng(1).uniform(-1.0, 1.0, (n, 3)))


def solve_linkages(lengths: Array, t: Array) -> Array:
    """Return the seven series (7, n, N) of linkages with these lengths (n, 3) at times t (N,), in closed form."""
    out = np.empty((len(SERIES), len(lengths), len(t)))
    rows = max(1, BLOCK // len(t))
    for first in range(0, len(lengths), rows):
        block = slice(first, first + rows)
        _solve_block(lengths[block], t, out[:, block])
    return out


def _solve_block(lengths: Array, t: Array, out: Array) -> None:
    """Write the series of some linkages to `out` (7, n, N): see solve_linkages."""
    a, b, c = lengths.T[:, :, None]
    angle = 0.5 * math.pi + OMEGA * t
    ax, ay = a * np.cos(angle), a * np.sin(angle)  # joint A
    dx, dy = GROUND - ax, -ay
    square = dx * dx + dy * dy
    along = 0.5 + (b * b - c * c) / (2.0 * square)
    across = np.sqrt(b * b / square - along * along)
    bx, by = along * dx - across * dy, along * dy + across * dx  # coupler, A to B
    cx, cy = ax + bx - GROUND, ay + by  # rocker, B0 to B
    det = bx * cy - by * cx
    vx, vy = -OMEGA * ay, OMEGA * ax
    coupler_omega, rocker_omega = -(vx * cx + vy * cy) / det, -(vx * bx + vy * by) / det
    wb, wc = coupler_omega * coupler_omega, rocker_omega * rocker_omega
    a_ax, a_ay = -OMEGA * OMEGA * ax, -OMEGA * OMEGA * ay
    ex, ey = a_ax - wb * bx + wc * cx, a_ay - wb * by + wc * cy
    coupler_alpha, rocker_alpha = -(ex * cx + ey * cy) / det, -(ex * bx + ey * by) / det
    # forces: joint B by the moments about A (coupler) and B0 (rocker), then joint A, then the torque
    g_x = a_ax + 0.5 * (-coupler_alpha * by - wb * bx)
    g_y = a_ay + 0.5 * (coupler_alpha * bx - wb * by) + GRAVITY
    on_coupler = INERTIA[1] * coupler_alpha + 0.5 * MASS[1] * (bx * g_y - by * g_x)
    r_x, r_y = 0.5 * (-rocker_alpha * cy - wc * cx), 0.5 * (rocker_alpha * cx - wc * cy) + GRAVITY
    on_rocker = INERTIA[2] * rocker_alpha + 0.5 * MASS[2] * (cx * r_y - cy * r_x)
    f_x = (bx * on_rocker + cx * on_coupler) / det  # force of the rocker on the coupler
    f_y = (by * on_rocker + cy * on_coupler) / det
    h_x, h_y = MASS[1] * g_x - f_x, MASS[1] * g_y - f_y  # force of the crank on the coupler
    torque = ax * h_y - ay * h_x + 0.5 * MASS[0] * GRAVITY * ax
    ux, uy = bx / b, by / b
    out[0], out[1] = ax + TRACER[0] * ux - TRACER[1] * uy, ay + TRACER[0] * uy + TRACER[1] * ux
    np.arctan2(cy, cx, out=out[2])
    out[3], out[4], out[5] = rocker_omega, rocker_alpha, torque
    np.sqrt(f_x * f_x + f_y * f_y, out=out[6])


def measure(runs: int, samples: int, rounds: int) -> None:
    """Print processor times of both programs per run and sample, their ratio, and the largest differences."""
    scene = gudgeon.load("four_bar", quick=False)
    lengths, t = draw_lengths(runs), np.linspace(0.0, 1.0, samples + 1)
    columns = {f"bodies.{name}.length": x for name, x in zip(("crank", "coupler", "rocker"), lengths.T, strict=True)}
    columns |= {"bodies.coupler.points.tracer.x": np.full(runs, TRACER[0])}
    best = [math.inf, math.inf]
    for _ in range(rounds):
        began = process_time()
        batch = scene.simulate_many(columns, output=t, threads=1, keep=SERIES)
        best[0] = min(best[0], process_time() - began)
        began = process_time()
        closed_form = solve_linkages(lengths, t)
        best[1] = min(best[1], process_time() - began)
    for name, expected in zip(SERIES, closed_form, strict=True):
        difference = np.abs(batch[name] - expected).max() / np.abs(expected).max()
        print(f"{name:20s} largest difference {difference:.1e} of the largest value")
    for name, seconds in zip(("gudgeon", "NumPy"), best, strict=True):
        print(f"{name:8s} {1e6 * seconds / runs:8.1f} us a run, {1e9 * seconds / runs / len(t):6.0f} ns a sample")
    print(f"ratio {best[0] / best[1]:.2f} for {runs} runs of {len(t)} samples; failures: {len(batch.failures)}")


def main() -> None:
    """Read the arguments and measure."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=100_000)
    parser.add_argument("--samples", type=int, default=360)
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    measure(arguments.runs, arguments.samples, arguments.rounds)


if __name__ == "__main__":
    main()

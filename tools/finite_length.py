"""Fit the coefficients of the oil film law `finite_length` to solutions of Reynolds' equation, and print them.

A table of 1820 states takes about a minute, the fit seconds. The law contains the coefficients with four decimals.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import least_squares

from gudgeon.generator.kinds.laws.finite_length import G0, G1, G3, REST, compute_fitted_coefficient
from gudgeon.reynolds import Bearing, table

RADIUS, CLEARANCE, VISCOSITY = 0.01, 1e-5, 0.1  # m, m, Pa·s; ratios do not depend on them
EPS = np.array([0.02, 0.15, 0.3, 0.45, 0.6, 0.7, 0.8, 0.87, 0.92, 0.95, 0.975, 0.99, 0.996, 0.9985])
MOTION_ANGLES = np.linspace(0.0, np.pi, 13)  # ε̇ = W cos α, ½ ε ω_s = W sin α
RATIO = np.array([0.1, 0.2, 0.3, 0.45, 0.65, 0.9, 1.2, 1.6, 2.05, 3.0])
IS_IN_FITTED_RANGE = (RATIO > 0.15) & (RATIO < 2.1)
ROTATION_INDEX = len(MOTION_ANGLES) // 2
CHECKED_ROOTS = np.array([1.0, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.31, 0.25, 0.2, 0.14, 0.1, 0.07, 0.04, 0.0141])  # s
CHECKED_RATIOS = np.array(
    [1e-4, 1e-3, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0, 20.0, 100.0]
)
MARGIN = 0.002  # smallest value of `find_min_potential` without a penalty
SPLIT_INDICES = np.cumsum([len(G0), len(G1), 1])


def solve_states() -> np.ndarray:
    """Return the solver's forces (ratio, ε, motion, 2) over μ R³ L/c² at W = 1/s."""
    result = []
    for ratio in RATIO:
        bearing = Bearing(RADIUS, 2.0 * RADIUS * float(ratio), CLEARANCE, VISCOSITY)
        eps = EPS[:, None]
        forces = table(
            bearing, eps, np.cos(MOTION_ANGLES) + 0.0 * eps, 2.0 * np.sin(MOTION_ANGLES) / eps, cells=(128, 24)
        ).force
        result.append(forces / (VISCOSITY * RADIUS**3 * bearing.length / CLEARANCE**2))
    return np.array(result)


def compute_terms(numbers: np.ndarray, s: np.ndarray, ratio: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return the terms a0 … a3 of the law's potential V; numbers: coefficients, s: √(1 − ε²), ratio: L/D."""
    g0, g1, (g3,), (rest,) = np.split(numbers, SPLIT_INDICES)
    short = ratio**2 / s**3
    a0 = np.pi * short / (s**2 + compute_fitted_coefficient(s, ratio, g0) * ratio**2)
    a1 = 8.0 * short / (s**2 + compute_fitted_coefficient(s, ratio, g1) * ratio**2)
    a3 = 4.0 / 3.0 * short * (s / (s**2 + g3 * ratio**2)) ** 2
    return a0, a1, a1 + a3 - (1.0 - rest) * a0, a3


def compute_law_forces(numbers: np.ndarray) -> np.ndarray:
    """Return the law's forces (ratio, ε, motion, 2) over μ R³ L/c² at W = 1/s."""
    eps = EPS[:, None]
    w_n, w_t, s = np.cos(MOTION_ANGLES), -np.sin(MOTION_ANGLES), np.sqrt(1.0 - eps**2)
    q = np.hypot(w_n, s * w_t)
    x = eps * w_n / q
    a0, a1, a2, a3 = compute_terms(numbers, s, RATIO[:, None, None])
    turn = 2.0 * a0 + a1 * x - a3 * x**3
    return -np.stack([w_n * turn + eps * q * (a1 + 2.0 * a2 * x + 3.0 * a3 * x**2), s**2 * w_t * turn], axis=-1)


def find_min_potential(numbers: np.ndarray) -> np.ndarray:
    """Return the smallest V/(S q² a0) over all motions for each ε and L/D; it must be positive."""
    s, x = CHECKED_ROOTS[:, None], np.sqrt(1.0 - CHECKED_ROOTS[:, None] ** 2) * np.linspace(-1.0, 1.0, 201)
    a0, a1, a2, a3 = compute_terms(numbers, s, CHECKED_RATIOS[:, None, None])
    return np.asarray((1.0 + x * (a1 + x * (a2 + x * a3)) / a0).min(axis=-1))


def compute_weights(force: np.ndarray) -> np.ndarray:
    """Return the weights of force differences (ratio, ε, motion) in the least-squares fit.

    They are mainly relative to the largest force at an ε, for rotation to the force itself, and smaller outside of the
    law's range.
    """
    size = np.hypot(force[..., 0], force[..., 1])
    within = np.where(IS_IN_FITTED_RANGE, 1.0, 0.3)[:, None, None]
    result = size**-0.2 * size.max(axis=2, keepdims=True) ** -0.8 * within * np.where(EPS < 0.955, 1.0, 0.5)[:, None]
    turns = within[..., 0] * np.where(EPS < 0.98, 1.0, 0.3) / size[:, :, ROTATION_INDEX]
    result[:, :, ROTATION_INDEX] = np.maximum(result[:, :, ROTATION_INDEX], turns)
    return result


def main() -> None:
    """Fit the coefficients, and print them with the deviations."""
    force = solve_states()
    weight, numbers = compute_weights(force)[..., None], np.array([*G0, *G1, G3, REST])
    for power in (1.0, 2.0):  # of the differences: the second fit lowers the largest ones

        def residuals(numbers: np.ndarray, power: float = power) -> np.ndarray:
            """Return the residuals: weighted force differences, and a penalty for a potential below MARGIN."""
            each = ((compute_law_forces(numbers) - force) * weight).ravel()
            pulls = 300.0 * np.maximum(MARGIN - find_min_potential(numbers), 0.0).ravel()
            return np.concatenate([np.sign(each) * np.abs(20.0 * each) ** power, pulls])

        numbers = least_squares(residuals, numbers, max_nfev=300).x
    numbers = np.round(numbers, 4)
    for name, some in zip(("G0", "G1", "G3", "REST"), np.split(numbers, SPLIT_INDICES), strict=True):
        print(name, "=", ", ".join(f"{x:.4f}" for x in some))
    size = np.hypot(force[..., 0], force[..., 1])
    away = np.hypot(*np.moveaxis(compute_law_forces(numbers) - force, -1, 0))
    share, turning = away / size.max(axis=2, keepdims=True), (away / size)[:, :, ROTATION_INDEX]
    message = IS_IN_FITTED_RANGE[:, None] & (EPS < 0.955)
    for where, rows in (("L/D .2 to 2, eps to .95", message), ("all", np.ones_like(message))):
        print(f"{where}: {share.max(axis=2)[rows].max():.2%} of the largest force, rotation {turning[rows].max():.2%}")
    print(f"least V/(S q^2 a0): {find_min_potential(numbers).min():.4f}")


if __name__ == "__main__":
    main()

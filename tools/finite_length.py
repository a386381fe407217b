"""Fits the numbers of the film law `finite_length` to the solver's tables and prints them: `python tools/finite_length.py`.

A table of 1820 states takes about a minute, the fit seconds. What stands in the law is this, rounded to four places.
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import least_squares

from gudgeon.generator.kinds.laws.finite_length import G0, G1, G2, G3, leaks
from gudgeon.reynolds import Bearing, table

RADIUS, CLEARANCE, VISCOSITY = 0.01, 1e-5, 0.1  # ratios do not hang on them
EPS = np.array([0.02, 0.15, 0.3, 0.45, 0.6, 0.7, 0.8, 0.87, 0.92, 0.95, 0.975, 0.99, 0.996, 0.9985])
MOTION = np.linspace(0.0, np.pi, 13)  # ε̇ = W cos α, ½ ε ω_s = W sin α
RATIO = np.array([0.1, 0.2, 0.3, 0.45, 0.65, 0.9, 1.2, 1.6, 2.05, 3.0])
WITHIN = (RATIO > 0.15) & (RATIO < 2.1)
TURNS = len(MOTION) // 2
CUTS = np.cumsum([len(G0), len(G1), len(G2)])


def solved() -> np.ndarray:
    """(ratio, ε, motion, 2) forces over μ R³ L/c² at W = 1/s."""
    found = []
    for ratio in RATIO:
        own = Bearing(RADIUS, 2.0 * RADIUS * float(ratio), CLEARANCE, VISCOSITY)
        eps = EPS[:, None]
        forces = table(own, eps, np.cos(MOTION) + 0.0 * eps, 2.0 * np.sin(MOTION) / eps, cells=(128, 24)).force
        found.append(forces / (VISCOSITY * RADIUS**3 * own.length / CLEARANCE**2))
    return np.array(found)


def fitted(numbers: np.ndarray) -> np.ndarray:
    """The law's forces, as `solved`: the lines of its `build` in arrays."""
    g0, g1, g2, (g3,) = np.split(numbers, CUTS)
    eps, ratio = EPS[:, None], RATIO[:, None, None]
    w_n, w_t, s = np.cos(MOTION), -np.sin(MOTION), np.sqrt(1.0 - eps**2)
    q = np.hypot(w_n, s * w_t)
    x = eps * w_n / q
    a0, a1, a2 = (
        number * ratio**2 / (s**3 * (s**2 + leaks(s, ratio, g) * ratio**2))
        for number, g in ((np.pi, g0), (8.0, g1), (2.0 * np.pi, g2))
    )
    a3 = 4.0 / 3.0 * ratio**2 / (s * (s**2 + g3 * ratio**2) ** 2)
    turn = 2.0 * a0 + a1 * x - a3 * x**3
    return -np.stack([w_n * turn + eps * q * (a1 + 2.0 * a2 * x + 3.0 * a3 * x**2), s**2 * w_t * turn], axis=-1)


def weights(force: np.ndarray) -> np.ndarray:
    """Mostly over the largest force at that ε, and for rotation over its own; less outside of the law's range."""
    size = np.hypot(force[..., 0], force[..., 1])
    within = np.where(WITHIN, 1.0, 0.3)[:, None, None]
    found = size**-0.2 * size.max(axis=2, keepdims=True) ** -0.8 * within * np.where(EPS < 0.955, 1.0, 0.5)[:, None]
    turns = 0.6 / size[:, :, TURNS] * within[..., 0] * np.where(EPS < 0.98, 1.0, 0.3)
    found[:, :, TURNS] = np.maximum(found[:, :, TURNS], turns)
    return found


def main() -> None:
    force = solved()
    weight, numbers = weights(force)[..., None], np.array([*G0, *G1, *G2, G3])
    for power in (1.0, 2.0):  # of the differences: the second fit lowers the largest ones
        def off(numbers: np.ndarray, power: float = power) -> np.ndarray:
            each = ((fitted(numbers) - force) * weight).ravel()
            return np.sign(each) * np.abs(20.0 * each) ** power
        numbers = least_squares(off, numbers).x
    for name, some in zip(("G0", "G1", "G2", "G3"), np.split(numbers, CUTS), strict=True):
        print(name, "=", ", ".join(f"{x:.4f}" for x in some))
    size = np.hypot(force[..., 0], force[..., 1])
    away = np.hypot(*np.moveaxis(fitted(np.round(numbers, 4)) - force, -1, 0))
    share, turning = away / size.max(axis=2, keepdims=True), (away / size)[:, :, TURNS]
    told = WITHIN[:, None] & (EPS < 0.955)
    for where, rows in (("L/D .2 to 2, eps to .95", told), ("all", np.ones_like(told))):
        print(f"{where}: {share.max(axis=2)[rows].max():.2%} of the largest force, rotation {turning[rows].max():.2%}")


if __name__ == "__main__":
    main()

"""Dry contact of a pin in a hole: laws as printed, and what an impact under them does.

Source: H. M. Lankarani, P. E. Nikravesh, J. Mech. Des. 112 (1990) 369-376; friction after J. Ambrósio (2003), both
as in X. Chen, S. Gao, T. Wang, Nonlinear Dynamics, doi 10.1007/s11071-022-07478-4, Eqs. 5-7. SI.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq


def stiffness(
    bearing: float, journal: float, young: tuple[float, float], poisson: tuple[float, float], sign: int = 1
) -> float:
    """K in N/m^1.5 of radii R_i, R_j: sign +1 external spheres (as printed), −1 a ball in a cup."""
    sigma = [(1.0 - nu**2) / e for e, nu in zip(young, poisson, strict=True)]
    return 4.0 / (3.0 * sum(sigma)) * math.sqrt(bearing * journal / (bearing + sign * journal))


def dissipation_factor(restitution: float) -> float:
    """a of F = K δⁿ (1 + a δ̇/δ̇⁻) by Lankarani and Nikravesh: 3(1 − c_e²)/4."""
    return 3.0 * (1.0 - restitution**2) / 4.0


def normal_force(delta: float, rate: float, stored: float, stiff: float, exponent: float, factor: float) -> float:
    """K δⁿ (1 + a δ̇/δ̇⁻) for δ > 0, never negative; `stored` ≤ 0 stands for none: the ratio is 1."""
    if delta <= 0.0:
        return 0.0
    ratio = rate / stored if stored > 0.0 else 1.0
    return max(0.0, float(stiff * delta**exponent * (1.0 + factor * ratio)))


def friction_force(slip: float, normal: float, mu: float, v0: float, v1: float) -> float:
    """Modified Coulomb: −μ c_d F_n sgn(v_t), c_d = clip((|v_t| − v0)/(v1 − v0), 0, 1)."""
    return -mu * float(np.clip((abs(slip) - v0) / (v1 - v0), 0.0, 1.0)) * normal * math.copysign(1.0, slip)


def identity(factor: float, restitution: float) -> float:
    """a(1+e) − ln[(1+a)/(1−a e)]: zero for the restitution e that F = K δⁿ(1 + a δ̇/δ̇⁻) delivers.

    From v dv/dδ = −Kδⁿ(1 + a v/v⁻)/m: ∫ v dv/(1 + a v/v⁻) over approach and return is the same ∫ Kδⁿ dδ, so it
    holds whatever n, K and m are.
    """
    return factor * (1.0 + restitution) - math.log((1.0 + factor) / (1.0 - factor * restitution))


def delivered(factor: float) -> float:
    """The root 0 < e < 1 of `identity`, for a > 0."""
    top = min(1.0, 1.0 / factor) * (1.0 - 1e-15)
    return float(brentq(lambda e: identity(factor, e), 1e-12, top, xtol=1e-15, rtol=1e-15))


def impact(factor: float, exponent: float = 1.5, stiff: float = 1e9, mass: float = 0.1, speed: float = 0.2) -> float:
    """Restitution of one mass against a wall, by integrating the impact to 1e-12 (DOP853, δ in units of its scale)."""
    length = (mass * speed**2 / stiff) ** (1.0 / (exponent + 1.0))  # makes time and penetration O(1)

    def rate(_: float, y: np.ndarray) -> list[float]:
        force = normal_force(y[0] * length, y[1] * speed, speed, stiff, exponent, factor)
        return [y[1], -force * length / (mass * speed**2)]

    def left(_: float, y: np.ndarray) -> float:
        return float(y[0])

    left.terminal, left.direction = True, -1.0  # type: ignore[attr-defined]
    run = solve_ivp(rate, (0.0, 1e3), [0.0, 1.0], "DOP853", events=left, rtol=1e-12, atol=1e-14)
    return float(-run.y_events[0][0, 1])

"""The long journal bearing: Gümbel's film by integrating the pressure, and Pinkus and Sternlicht's formulas.

Forces act on the journal, along n = e/|e| and t = n turned +90°, in units of μ R³ L / c²; rates in 1/s.
ω_s = ω_i + ω_j − 2ψ̇. Sources: O. Pinkus, B. Sternlicht, Theory of Hydrodynamic Lubrication, McGraw-Hill 1961;
X. Chen, S. Gao, T. Wang, Nonlinear Dynamics, doi 10.1007/s11071-022-07478-4 (Eqs. 11-13; the sign of Eq. 12 is
wrong in print, see `as_printed`).
"""

from __future__ import annotations

import math

import mpmath as mp
import numpy as np
from scipy.integrate import cumulative_simpson

S = 6.0  # the formulas' factor 6 μ R³ L / c² in units of μ R³ L / c²


def gumbel_film(eps: float, eps_rate: float, omega_s: float, points: int = 20001) -> tuple[float, float]:
    """(F_r, F_t) of the full 2π Sommerfeld pressure, negative pressures dropped, p = 0 at the widest gap.

    φ counts from the widest gap (φ = π is the line n, where the gap is least): h = 1 + ε cos φ. Seen from a frame
    that turns with the mean surface speed, the gap only closes, with the velocity w = (ε̇, −½ ε ω_s):
    ∂h/∂t = w_n cos φ + w_t sin φ, (h³ p')' = 12 ∂h/∂t, p periodic, force −∫ p⁺ (direction of the wall) dφ.
    """
    w_n, w_t = eps_rate, -0.5 * eps * omega_s
    phi = np.linspace(0.0, 2.0 * np.pi, points)
    h = 1.0 + eps * np.cos(phi)
    flow = w_n * np.sin(phi) - w_t * np.cos(phi)  # ∫ ∂h/∂t dφ
    total = cumulative_simpson(np.array([flow / h**3, 1.0 / h**3]), x=phi, initial=0.0)
    constant = total[0, -1] / total[1, -1]  # makes p(2π) = p(0)
    p = np.maximum(12.0 * (total[0] - constant * total[1]), 0.0)
    # the wall at φ lies in the direction −(cos φ) n − (sin φ) t; pressure pushes the journal away from it
    return float(np.trapezoid(p * np.cos(phi), phi)), float(np.trapezoid(p * np.sin(phi), phi))


def pinkus_sternlicht(
    eps: float, eps_rate: float, omega_s: float, *, as_printed: bool = False, digits: int = 40
) -> tuple[float, float]:
    """(F_r, F_t) by the two branches with k, in `digits` digits; 0 < ε < 1, ε̇ ≠ 0.

    `as_printed` takes Eq. 12's F_r for ε̇ < 0 with the minus sign of print.
    """
    with mp.workdps(digits):
        e, de, ws = mp.mpf(eps), mp.mpf(eps_rate), mp.mpf(omega_s)
        k = mp.sqrt((1 - e**2) * ((ws / (2 * de)) ** 2 + 1 / e**2))
        first = 4 * k * e**2 / (2 + e**2)
        if de > 0:
            ratio = (k + 3) / (k + mp.mpf(3) / 2)
            radial = -S * de / (1 - e**2) ** mp.mpf(1.5) * (first + mp.pi * ratio)
        else:
            ratio = k / (k + mp.mpf(3) / 2)
            radial = S * de / (1 - e**2) ** mp.mpf(1.5) * (first - mp.pi * ratio)
            radial = -radial if as_printed else radial
        tangential = S * mp.pi * e * ws / ((2 + e**2) * mp.sqrt(1 - e**2)) * ratio
        return float(radial), float(tangential)


def steady(eps: float, omega_s: float) -> tuple[float, float]:
    """Textbook limit ε̇ → 0 (half Sommerfeld film): F_r = −12 ε²|ω_s|/[(2+ε²)(1−ε²)], F_t = 6πεω_s/[(2+ε²)√(1−ε²)]."""
    square = eps * eps
    return (
        -12.0 * square * abs(omega_s) / ((2.0 + square) * (1.0 - square)),
        6.0 * math.pi * eps * omega_s / ((2.0 + square) * math.sqrt(1.0 - square)),
    )


def centred(eps_rate: float) -> float:
    """Limit ε → 0 of F_r: −6 π ε̇."""
    return -6.0 * math.pi * eps_rate


def pure_squeeze(eps: float, eps_rate: float) -> float:
    """F_r of the formulas for ω_s = 0, by hand: k = √(1−ε²)/ε whatever ε̇ is."""
    s = math.sqrt(1.0 - eps * eps)
    k = s / eps
    ratio = (k + 3.0) / (k + 1.5) if eps_rate > 0.0 else k / (k + 1.5)
    return -6.0 / s**3 * (4.0 * eps * s * abs(eps_rate) / (2.0 + eps * eps) + math.pi * eps_rate * ratio)

"""The stiffness of two elastic surfaces by Hertz, from their radii and materials; both conventions of the curvature.

K = 4/(3(σ_i + σ_j)) √(R_i R_j/(R_i ± R_j)),   σ = (1 − ν²)/E
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import word
from gudgeon.generator.kinds.laws.law import LawInputs

GEOMETRY = word(
    "geometry",
    "curvature of the pair: external R_i + R_j as the paper prints it, internal R_i - R_j for a pin in a hole",
    ("external", "internal"), "external",
)  # fmt: skip


def pair_stiffness(s: LawInputs) -> Any:
    """K (N/m^1.5), by the law's option `geometry`."""
    import sympy as sp

    pair = s.pair
    other = pair.R_j if s.options["geometry"] == "external" else -pair.R_j
    radius = sp.sqrt(pair.R_i * pair.R_j / (pair.R_i + other))
    if (pair.E_i, pair.nu_i) == (pair.E_j, pair.nu_j):
        K = sp.Rational(2, 3) * pair.E_i * radius / (1 - pair.nu_i**2)
    else:  # σ_i + σ_j times E_i, in wholes: two that hold the numbers of one material give its bits
        soft_i, soft_j = (s.whole(1 - nu**2) for nu in (pair.nu_i, pair.nu_j))
        K = sp.Rational(4, 3) * pair.E_i * radius / (soft_i + soft_j * s.whole(pair.E_i / pair.E_j))
    return s.derive("K", K, "contact stiffness")


def contact_modulus(s: LawInputs) -> Any:
    """E* (Pa): 1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j."""
    pair = s.pair
    if (pair.E_i, pair.nu_i) == (pair.E_j, pair.nu_j):
        return pair.E_i / (2 * (1 - pair.nu_i**2))
    soft_i, soft_j = (s.whole(1 - nu**2) for nu in (pair.nu_i, pair.nu_j))
    return pair.E_i / (soft_i + soft_j * s.whole(pair.E_i / pair.E_j))

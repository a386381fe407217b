"""The stiffness of two elastic surfaces by Hertz, from their radii and materials; both conventions of the curvature.

K = 4/(3(σ_i + σ_j)) √(R_i R_j/(R_i ± R_j)),   σ = (1 − ν²)/E

The 6.61e10 N/m^1.5 that the literature has for steel pins of 9.5 mm in holes of 10 mm is that of R_i − R_j, whatever
sign stands in the formula beside it; R_i + R_j gives 1.06e10. The latter is the default, for it is what the paper that
the press is taken from prints, and its golden figures follow; the former is the geometry of a pin in a hole.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import word
from gudgeon.generator.kinds.laws.law import LawInputs

GEOMETRY = word(
    "geometry",
    "curvature of the pair: external R_i + R_j, as the press's paper prints it, hence the default; internal R_i - R_j,"
    " of a pin in a hole (steel, 10 and 9.5 mm: 1.06e10 and 6.61e10 N/m^1.5, of which the literature has the second)",
    ("external", "internal"), "external",
)  # fmt: skip


def pair_stiffness(s: LawInputs) -> Any:
    """K (N/m^1.5), by the law's option `geometry`."""
    import sympy as sp

    pair = s.pair
    other = pair.R_j if s.options["geometry"] == "external" else -pair.R_j
    flat = pair.R_i == sp.oo  # a corner on a wall: R_i R_j/(R_i ± R_j) = R_j
    radius = sp.sqrt(pair.R_j) if flat else sp.sqrt(pair.R_i * pair.R_j / (pair.R_i + other))
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

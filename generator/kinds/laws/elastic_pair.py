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
    sigma_i, sigma_j = (1 - pair.nu_i**2) / pair.E_i, (1 - pair.nu_j**2) / pair.E_j
    other = pair.R_j if s.options["geometry"] == "external" else -pair.R_j
    radius = sp.sqrt(pair.R_i * pair.R_j / (pair.R_i + other))
    return s.derive("K", sp.Rational(4, 3) / (sigma_i + sigma_j) * radius, "contact stiffness")

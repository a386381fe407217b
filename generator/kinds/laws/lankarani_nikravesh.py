"""Lankarani and Nikravesh's normal contact force: Hertz stiffness with hysteresis damping.

    F_n = K δⁿ [1 + 3(1 − c_e²)/4 · δ̇/δ̇⁻],   K = 4/(3(σ_i + σ_j)) √(R_i R_j/(R_i ± R_j)),   σ = (1 − ν²)/E

never negative. H. M. Lankarani, P. E. Nikravesh, J. Mech. Design 112 (1990) 369–376.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import Bound, number, word
from gudgeon.generator.kinds.laws.dissipation import normal_force
from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.language.units import DIMENSIONLESS


def build(s: LawInputs) -> dict[str, Any]:
    """F_n (N), compressive, for δ > 0."""
    import sympy as sp

    pair = s.pair
    sigma_i, sigma_j = (1 - pair.nu_i**2) / pair.E_i, (1 - pair.nu_j**2) / pair.E_j
    other = pair.R_j if s.options["geometry"] == "external" else -pair.R_j
    radius = sp.sqrt(pair.R_i * pair.R_j / (pair.R_i + other))
    K = s.derive("K", sp.Rational(4, 3) / (sigma_i + sigma_j) * radius, "contact stiffness")
    return {"F_n": normal_force(s, K, LAW.name)}


LAW = Law(
    name="lankarani_nikravesh",
    role="normal",
    title="Lankarani and Nikravesh: Hertz stiffness with hysteresis damping",
    source="H. M. Lankarani, P. E. Nikravesh, J. Mech. Design 112 (1990) 369-376",
    validity="c_e near 1 (c_e = .9 delivers .91318); external spheres unless geometry is internal",
    fields=(
        number(
            "restitution", "coefficient of restitution", DIMENSIONLESS,
            symbol="c_e", required=True, bounds=(Bound(">", 0.0), Bound("<=", 1.0)),
        ),
        number(
            "exponent", "exponent of the penetration", DIMENSIONLESS,
            symbol="n", default=1.5, bounds=(Bound(">=", 1.0),),
        ),
        word(
            "geometry",
            "curvature of the pair: external R_i + R_j as the paper prints it, internal R_i - R_j for a pin in a hole",
            ("external", "internal"), "external",
        ),
    ),
    build=build,
)  # fmt: skip

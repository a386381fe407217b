"""Lankarani and Nikravesh's normal contact force: Hertz stiffness with hysteresis damping.

    F_n = K δⁿ [1 + 3(1 − c_e²)/4 · δ̇/δ̇⁻],   K = 4/(3(σ_i + σ_j)) √(R_i R_j/(R_i ± R_j)),   σ = (1 − ν²)/E

never negative. H. M. Lankarani, P. E. Nikravesh, J. Mech. Design 112 (1990) 369–376.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import Bound, number
from gudgeon.generator.kinds.laws.dissipation import SOURCES, make_normal_force
from gudgeon.generator.kinds.laws.elastic_pair import GEOMETRY, make_pair_stiffness
from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.marked_text import MarkedText
from gudgeon.language.units import DIMENSIONLESS


def build_normal_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the compressive normal force F_n (N) for δ > 0 and its abbreviations, as equations by name."""
    return {"F_n": make_normal_force(inputs, make_pair_stiffness(inputs), LAW.name)}


LAW = Law(
    name="lankarani_nikravesh",
    role="normal",
    title="Lankarani and Nikravesh: Hertz stiffness with hysteresis damping",
    equation=(
        r"F_n = K \delta^n \max\left(0, 1 + \frac{3 (1 - c_e^2)}{4}\,\frac{\dot\delta}{\dot\delta^{-}}\right)",
        r"K = \frac{4}{3} E^{*} \sqrt{\frac{R_i R_j}{R_i + R_j}}",
        r"\frac{1}{E^{*}} = \frac{1 - \nu_i^2}{E_i} + \frac{1 - \nu_j^2}{E_j}",
    ),
    source="H. M. Lankarani, P. E. Nikravesh, J. Mech. Design 112 (1990) 369-376",
    reference=SOURCES["lankarani_nikravesh"],
    validity=MarkedText("values of $c_e$ near 1: $c_e$ = 0.9 delivers the restitution 0.91318"),
    properties="the stiffness is that of external spheres, unless `geometry` is `internal`",
    fields=(
        number(
            "restitution",
            "coefficient of restitution",
            DIMENSIONLESS,
            symbol="c_e",
            required=True,
            bounds=(Bound(">", 0.0), Bound("<=", 1.0)),
        ),
        number(
            "exponent",
            "exponent of the penetration",
            DIMENSIONLESS,
            symbol="n",
            default=1.5,
            bounds=(Bound(">=", 1.0),),
        ),
        GEOMETRY,
    ),
    build=build_normal_force,
)

"""Hertz-type contact with a choice of hysteresis damping; the stiffness is given, or follows from radii and materials.

    F_n = K δⁿ (1 + a δ̇/δ̇⁻),   K = 4/(3(σ_i + σ_j)) √(R_i R_j/(R_i ± R_j)),   σ = (1 − ν²)/E

never negative unless it `pulls`. `law: flores`, or another damping's name, is this law with that damping.
 H. Hertz, J. reine angew. Math. 92 (1881) 156–171; the damping factors are those of
K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440–445 and their successors (dissipation.py).
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import Bound, number
from gudgeon.generator.kinds.laws.dissipation import (
    DISSIPATION,
    FACTORS,
    PULLS,
    RESTITUTION,
    make_normal_force,
)
from gudgeon.generator.kinds.laws.elastic_pair import GEOMETRY, make_pair_stiffness
from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.marked_text import MarkedText
from gudgeon.language.units import DIMENSIONLESS


def build_normal_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the compressive normal force F_n (N) for δ > 0, as equations by name.

    The stiffness K is the given one, or else that of the two elastic surfaces.
    """
    stiffness = inputs.parameters.get("stiffness")
    K = make_pair_stiffness(inputs) if stiffness is None else inputs.derive("K", stiffness, "contact stiffness")
    return {"F_n": make_normal_force(inputs, K, str(inputs.options["dissipation"]))}


LAW = Law(
    name="hertz",
    role="normal",
    title="Hertz contact with a choice of hysteresis damping",
    equation=(
        r"F_n = K \delta^n \max\left(0, 1 + a\,\frac{\dot\delta}{\dot\delta^{-}}\right)",
        r"K = \frac{4}{3} E^{*} \sqrt{\frac{R_i R_j}{R_i + R_j}}",
        r"\frac{1}{E^{*}} = \frac{1 - \nu_i^2}{E_i} + \frac{1 - \nu_j^2}{E_j}",
    ),
    source="H. Hertz (1881); K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440-445",
    reference=MarkedText(
        "H. Hertz, Über die Berührung fester elastischer Körper, Journal für die reine und angewandte "
        "Mathematik 92 (1882) 156–171, doi 10.1515/crll.1882.92.156"
    ),
    validity="a point or a line contact whose stiffness is known, or a contact with the stiffness of spheres, "
    "at small penetrations",
    fields=(
        number(
            "stiffness",
            MarkedText("force at unit penetration", plain="force at unit penetration, N/m^n"),
            None,
            symbol="K",
            bounds=(Bound(">", 0.0),),
            per="exponent",
            otherwise="from materials and radii",
        ),
        number(
            "exponent",
            "exponent of the penetration",
            DIMENSIONLESS,
            symbol="n",
            default=1.5,
            bounds=(Bound(">=", 1.0),),
        ),
        RESTITUTION,
        DISSIPATION,
        GEOMETRY,
        PULLS,
    ),
    build=build_normal_force,
    also={name: {"dissipation": name} for name in FACTORS if name not in ("none", "lankarani_nikravesh")},
    instead={"geometry": "stiffness"},
)

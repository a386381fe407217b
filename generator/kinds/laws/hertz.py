"""Hertz-type contact with a stiffness that the user gives, and a choice of hysteresis damping.

    F_n = K δⁿ (1 + a δ̇/δ̇⁻)

never negative. H. Hertz, J. reine angew. Math. 92 (1881) 156–171; the damping factors are those of
K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440–445 and their successors (dissipation.py).
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.laws.dissipation import FACTORS, normal_force
from gudgeon.generator.kinds.laws.law import Law, LawInputs, LawOption, LawParameter
from gudgeon.language.units import DIMENSIONLESS, Dimension


def build(s: LawInputs) -> dict[str, Any]:
    """F_n (N), compressive, for δ > 0."""
    K = s.derive("K", s.parameters["stiffness"], "contact stiffness")
    return {"F_n": normal_force(s, K, str(s.options["dissipation"]))}


LAW = Law(
    name="hertz",
    role="normal",
    title="Hertz contact with a given stiffness and hysteresis damping",
    source="H. Hertz (1881); K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440-445",
    validity="a point or a line contact whose stiffness is known; penetrations small against the radii",
    parameters=(
        LawParameter("stiffness", "K", "force at unit penetration, N/m^n", Dimension(), None, ((">", 0.0),), True),
        LawParameter("exponent", "n", "exponent of the penetration", DIMENSIONLESS, 1.5, ((">=", 1.0),)),
        LawParameter(
            "restitution", "c_e", "coefficient of restitution", DIMENSIONLESS, 1.0, ((">", 0.0), ("<=", 1.0))
        ),
    ),
    options=(LawOption("dissipation", tuple(FACTORS), "hunt_crossley", "whose hysteresis damping factor"),),
    build=build,
)

"""Hertz-type contact with a stiffness that the user gives, and a choice of hysteresis damping.

    F_n = K δⁿ (1 + a δ̇/δ̇⁻)

never negative. H. Hertz, J. reine angew. Math. 92 (1881) 156–171; the damping factors are those of
K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440–445 and their successors (dissipation.py).
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import Bound, number, word
from gudgeon.generator.kinds.laws.dissipation import FACTORS, normal_force
from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.language.units import DIMENSIONLESS


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
    fields=(
        number(
            "stiffness", "force at unit penetration, N/m^n", None, symbol="K", required=True, bounds=(Bound(">", 0.0),)
        ),
        number(
            "exponent", "exponent of the penetration", DIMENSIONLESS,
            symbol="n", default=1.5, bounds=(Bound(">=", 1.0),),
        ),
        number(
            "restitution", "coefficient of restitution", DIMENSIONLESS,
            symbol="c_e", default=1.0, bounds=(Bound(">", 0.0), Bound("<=", 1.0)),
        ),
        word("dissipation", "whose hysteresis damping factor", FACTORS, "hunt_crossley"),
    ),
    build=build,
)  # fmt: skip

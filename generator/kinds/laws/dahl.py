"""Dahl's friction: the surfaces' asperities bend like bristles before they slide, so that contact can stick.

    F_t = −c_f F_n z/z_s,   ż = v_t − |v_t| z/z_s

z is the bristles' deflection, 0 at each onset; it tends to ±z_s, where the force is Coulomb's. As in tyres the
bristles are as stiff as the load makes them, c_f F_n/z_s: at an onset, where there is none, nothing is stiff.
P. R. Dahl, Aerospace Corporation TOR-0158(3107-18)-1 (1968), exponent 1; C. Canudas de Wit, P. Tsiotras, Proc. 38th
IEEE Conf. Decision and Control (1999) 3746-3751, for the load.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import Bound, number
from gudgeon.generator.kinds.laws.law import BREAKAWAY, Law, LawInputs, State
from gudgeon.generator.kinds.laws.roles import MU
from gudgeon.language.units import LENGTH


def build_friction_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the friction force F_t (N) on the journal along t and the rate of the bristle state, as equations by name.

    F_t = −mu F_n z/presliding, and the rate is z_rate = v_t − |v_t| z/presliding (m/s). The deflection `presliding` (m)
    also becomes a derived constant.
    """
    import sympy as sp

    v_t, z = inputs.variables["v_t"], inputs.variables["z"]
    inputs.derive(BREAKAWAY, inputs.parameters["presliding"], "deflection of the bristles at which the surfaces slide")
    share = z * 1 / inputs.parameters["presliding"]
    return {"F_t": -inputs.parameters["mu"] * inputs.variables["F_n"] * share, "z_rate": v_t - sp.Abs(v_t) * share}


LAW = Law(
    name="dahl",
    role="friction",
    title="Dahl's friction, with the deflection of bristles",
    equation=(
        r"F_t = -c_f F_n\, \frac{z}{z_s}",
        r"\dot z = v_t - |v_t|\, \frac{z}{z_s}",
    ),
    source="P. R. Dahl (1968), exponent 1; dependence on the load as in C. Canudas de Wit, P. Tsiotras (1999)",
    reference="P. R. Dahl, A solid friction model, report TOR-0158(3107-18)-1, Aerospace Corporation (1968), exponent "
    "1; dependence on the load as in C. Canudas de Wit, P. Tsiotras, Proc. 38th IEEE Conf. Decision and Control "
    "(1999) 3746-3751",
    validity="presliding and sliding; the law has no difference between static and kinetic friction",
    fields=(
        MU,
        number(
            "presliding",
            "deflection of the bristles at which the surfaces slide",
            LENGTH,
            symbol="z_s",
            required=True,
            bounds=(Bound(">", 0.0),),
        ),
    ),
    build=build_friction_force,
    states=(State("z", "deflection of the bristles"),),
)

"""Modified Coulomb friction: no force below the slip v0, the full Coulomb force above v1.

    F_t = −c_f [clip((v_t − v_0)/(v_1 − v_0), 0, 1) − clip((−v_t − v_0)/(v_1 − v_0), 0, 1)] F_n

which is the usual −c_d(|v_t|) F_n sgn(v_t), written without a corner at v_t = 0, where there is no force.

J. A. C. Ambrósio's form of Coulomb's law, as in the paper (physics.md, section 3). It depends on the
slip alone, so it cannot hold stick.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from gudgeon.generator.field import Bound, number
from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.kinds.laws.roles import MU
from gudgeon.generator.marked_text import MarkedText
from gudgeon.language.units import VELOCITY


def build_friction_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the friction force F_t (N) on the journal along t, as equations by name.

    Its magnitude rises linearly from 0 to mu F_n between the slips v0 and v1.
    """
    v0, v1, v_t = inputs.parameters["v0"], inputs.parameters["v1"], inputs.variables["v_t"]
    slope = inputs.derive("friction_slope", 1 / (v1 - v0), "1/(v1 - v0)")
    forward, backward = (_limit_to_unit_range((v - v0) * slope) for v in (v_t, -v_t))
    return {"F_t": -inputs.parameters["mu"] * (forward - backward) * inputs.variables["F_n"]}


@lru_cache(64)
def _limit_to_unit_range(x: Any) -> Any:
    """Return x limited to the range from 0 to 1; cached, since SymPy's comparisons are slow."""
    import sympy as sp

    return sp.Max(sp.Min(x, 1), 0)


LAW = Law(
    name="modified_coulomb",
    role="friction",
    title="modified Coulomb friction",
    equation=(
        r"F_t = -c_d F_n\, \mathrm{sgn}(v_t)",
        r"c_d = c_f \min\left[1, \max\left(0, \frac{|v_t| - v_0}{v_1 - v_0}\right)\right]",
    ),
    source="physics.md section 3, after J. A. C. Ambrosio",
    reference=MarkedText(
        "J. A. C. Ambrósio, as in X. Chen, S. Gao, T. Wang, Nonlinear Dynamics (2022), doi 10.1007/s11071-022-07478-4"
    ),
    validity=MarkedText("sliding; below the slip $v_1$ the contact creeps where Coulomb's law would stick"),
    fields=(
        MU,
        number(
            "v0",
            "slip below which there is no friction",
            VELOCITY,
            symbol="v_0",
            required=True,
            bounds=(Bound(">=", 0.0),),
        ),
        number(
            "v1",
            "slip above which friction is constant",
            VELOCITY,
            symbol="v_1",
            required=True,
            bounds=(Bound(">", "v0"),),
        ),
    ),
    build=build_friction_force,
)

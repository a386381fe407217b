"""Stribeck's friction: static friction that falls to kinetic friction as the surfaces slide, smoothed at v_t = 0.

    F_t = −F_n [c_f + (c_s − c_f) exp(−(v_t/v_s)²)] tanh(v_t/v_0)

R. Stribeck, Z. VDI 46 (1902) 1341; the Gaussian fall is that of L. C. Bo, D. Pavelescu, Wear 82 (1982) 277–289, with
exponent 2.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.kinds.laws.roles import EXCESS_DECAY, MU, MU_S, declare_slip_field, make_friction_force
from gudgeon.generator.marked_text import MarkedText


def build_friction_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the friction force F_t (N) on the journal along t, as equations by name.

    F_t = −F_n [mu + (mu_s − mu) exp(−(v_t/v_s)²)] tanh(v_t/v0): its coefficient falls from mu_s to mu with the slip.
    """
    import sympy as sp

    mu, mu_s, v_s, v0 = (inputs.parameters[name] for name in ("mu", "mu_s", "v_s", "v0"))
    v_t = inputs.variables["v_t"]
    return make_friction_force(inputs, (mu + (mu_s - mu) * sp.exp(-((v_t / v_s) ** 2))) * sp.tanh(v_t / v0))


LAW = Law(
    name="stribeck",
    role="friction",
    title="Stribeck's friction: static friction falls to kinetic friction",
    equation=(r"F_t = -F_n \left[c_f + (c_s - c_f) \exp\left(-(v_t/v_s)^2\right)\right] \tanh\frac{v_t}{v_0}",),
    source="R. Stribeck (1902); L. C. Bo, D. Pavelescu, Wear 82 (1982) 277-289, exponent 2",
    reference="R. Stribeck, Zeitschrift des Vereines deutscher Ingenieure 46 (1902); L. C. Bo, D. Pavelescu, The "
    "friction-speed relation and its influence on the critical velocity of stick-slip motion, Wear 82 (1982) "
    "277-289, exponent 2",
    validity=MarkedText("sliding; the contact creeps at slips below $v_0$, which must be well below $v_s$"),
    fields=(
        MU,
        MU_S,
        declare_slip_field("v_s", EXCESS_DECAY, "v_s"),
        declare_slip_field("v0", MarkedText(r"slip at which the factor $\tanh(v_t/v_0)$ is 0.76"), "v_0"),
    ),
    build=build_friction_force,
)

"""Stribeck's friction: static friction that falls to kinetic friction as the surfaces slide, smoothed at v_t = 0.

    F_t = −F_n [c_f + (c_s − c_f) e^{−(v_t/v_s)²}] tanh(v_t/v0)

R. Stribeck, Z. VDI 46 (1902) 1341; the Gaussian fall is that of L. C. Bo, D. Pavelescu, Wear 82 (1982) 277–289, with
exponent 2.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.kinds.laws.roles import MU, MU_S, friction, slip_of


def build(s: LawInputs) -> dict[str, Any]:
    """Return the friction force F_t (N) on the journal along t; its coefficient falls from mu_s to mu with the slip."""
    import sympy as sp

    mu, mu_s, v_s, v0 = (s.parameters[name] for name in ("mu", "mu_s", "v_s", "v0"))
    v_t = s.variables["v_t"]
    return friction(s, (mu + (mu_s - mu) * sp.exp(-((v_t / v_s) ** 2))) * sp.tanh(v_t / v0))


LAW = Law(
    name="stribeck",
    role="friction",
    title="Stribeck's friction: static friction falls to kinetic friction",
    equation=(r"F_t = -F_n \left[c_f + (c_s - c_f)\, e^{-(v_t/v_s)^2}\right] \tanh\frac{v_t}{v_0}",),
    source="R. Stribeck (1902); L. C. Bo, D. Pavelescu, Wear 82 (1982) 277-289, exponent 2",
    reference="R. Stribeck, Zeitschrift des Vereines deutscher Ingenieure 46 (1902); L. C. Bo, D. Pavelescu, The "
    "friction-speed relation and its influence on the critical velocity of stick-slip motion, Wear 82 (1982) "
    "277-289, exponent 2",
    validity="sliding; creeps below v0, which is to be well below v_s",
    fields=(
        MU,
        MU_S,
        slip_of("v_s", "slip in which static friction falls", "v_s"),
        slip_of("v0", "slip at which tanh 1 = .76 of the friction is there", "v_0"),
    ),
    build=build,
)

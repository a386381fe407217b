"""Bengisu and Akay's friction: a parabola up to static friction at the slip v0, then a decay to kinetic friction.

    c_d = c_s [1 − (|v_t|/v_0 − 1)²],  |v_t| ≤ v_0;    c_d = c_f + (c_s − c_f) exp(−(|v_t| − v_0)/v_d),  |v_t| ≥ v_0
    F_t = −c_d F_n sgn v_t

M. T. Bengisu, A. Akay, J. Sound Vib. 171 (1994) 557–570, as E. Pennestri et al., Nonlinear Dynamics 83 (2016)
1785–1801, give it.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import Bound, number
from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.kinds.laws.roles import MU, MU_S, declare_slip_field, make_friction_force, make_odd_function
from gudgeon.generator.marked_text import MarkedText
from gudgeon.language.units import VELOCITY


def build_friction_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the friction force F_t (N) on the journal along t, as equations by name.

    Its coefficient at the slip u = |v_t| is mu_s [1 − (u/v0 − 1)²] up to v0, then mu + (mu_s − mu) e^{−(u − v0)/decay}.
    """
    import sympy as sp

    mu, mu_s, v0, decay = (inputs.parameters[name] for name in ("mu", "mu_s", "v0", "decay"))

    def compute_coefficient(u: Any) -> Any:
        """Return the friction coefficient for a slip u ≥ 0 (m/s)."""
        rising = mu_s * (1 - sp.Min(u / v0 - 1, 0) ** 2)
        return rising - (mu_s - mu) * (1 - sp.exp(-sp.Max(u - v0, 0) / decay))

    return make_friction_force(inputs, make_odd_function(inputs.variables["v_t"], compute_coefficient))


LAW = Law(
    name="bengisu_akay",
    role="friction",
    title=MarkedText("Bengisu and Akay's friction: static friction at $v_0$, then a decay to kinetic friction"),
    equation=(
        r"F_t = -c_d F_n\, \mathrm{sgn}(v_t)",
        r"c_d = c_s \left[1 - (|v_t|/v_0 - 1)^2\right], \quad |v_t| \le v_0",
        r"c_d = c_f + (c_s - c_f) \exp\left(-(|v_t| - v_0)/v_d\right), \quad |v_t| \ge v_0",
    ),
    source="M. T. Bengisu, A. Akay, J. Sound Vib. 171 (1994) 557-570",
    reference=MarkedText(
        "M. T. Bengisu, A. Akay, Stability of friction-induced vibrations in multi-degree-of-freedom systems, "
        "Journal of Sound and Vibration 171 (1994) 557–570, as in E. Pennestrì et al., Nonlinear Dynamics 83 "
        "(2016) 1785–1801, doi 10.1007/s11071-015-2485-3"
    ),
    validity=MarkedText("sliding; below the slip $v_0$ the contact creeps where Coulomb's law would stick"),
    properties=MarkedText(r"the sources write $1/\xi$ for the key `decay`"),
    fields=(
        MU,
        MU_S,
        declare_slip_field("v0", "slip at which friction is largest", "v_0"),
        number(
            "decay",
            MarkedText(
                r"additional slip beyond $v_0$ at which the excess over kinetic friction has fallen to $1/\mathrm{e}$"
            ),
            VELOCITY,
            symbol="v_d",
            required=True,
            bounds=(Bound(">", 0.0),),
        ),
    ),
    build=build_friction_force,
)

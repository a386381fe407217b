"""Coulomb's friction, smoothed: F_t = −c_f F_n tanh(v_t/v_0), with normal force F_n and slip v_t.

Without a corner, so that a stiff method may step over it; it creeps where Coulomb's law would stick. Of the smooth
forms of Coulomb's law that E. Pennestri, V. Rossi, P. Salvini, P. P. Valentini, Nonlinear Dynamics 83 (2016) 1785–1801
compare it is the hyperbolic tangent.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.kinds.laws.roles import MU, declare_slip_field, make_friction_force
from gudgeon.generator.marked_text import MarkedText


def build_friction_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the friction force F_t (N) on the journal along t, −c_f F_n tanh(v_t/v_0), as equations by name."""
    import sympy as sp

    return make_friction_force(
        inputs, inputs.parameters["mu"] * sp.tanh(inputs.variables["v_t"] / inputs.parameters["v0"])
    )


LAW = Law(
    name="coulomb",
    role="friction",
    title="Coulomb's friction, smoothed by a hyperbolic tangent",
    equation=(r"F_t = -c_f F_n \tanh\frac{v_t}{v_0}",),
    source="C. A. Coulomb (1785); smoothed as in E. Pennestri et al., Nonlinear Dynamics 83 (2016) 1785-1801",
    reference=MarkedText(
        "C. A. Coulomb (1785), smoothed as in E. Pennestrì, V. Rossi, P. Salvini, P. P. Valentini, Review and "
        "comparison of dry friction force models, Nonlinear Dynamics 83 (2016) 1785–1801, "
        "doi 10.1007/s11071-015-2485-3"
    ),
    validity=MarkedText(
        "sliding; below the slip $v_0$ the contact creeps where Coulomb's law without smoothing would stick"
    ),
    fields=(
        MU,
        declare_slip_field("v0", MarkedText(r"slip at which friction is $\tanh 1 = 0.76$ of its largest value"), "v_0"),
    ),
    build=build_friction_force,
)

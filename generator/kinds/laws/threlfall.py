"""Threlfall's friction, which rises exponentially with the slip up to the slip v_r.

    F_t = −c_f F_n (1 − exp(−3 min(|v_t|, v_r)/v_r)) sgn v_t

so that .9502 c_f F_n is reached at v_r and stays. A. G. Threlfall, Mechanism and Machine Theory 13 (1978) 475–483, as
E. Pennestri et al., Nonlinear Dynamics 83 (2016) 1785–1801, give it.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.kinds.laws.roles import MU, declare_slip_field, make_friction_force, make_odd_function
from gudgeon.generator.marked_text import MarkedText


def build_friction_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the friction force F_t (N) on the journal along t, as equations by name.

    F_t = −mu F_n [1 − exp(−3 min(|v_t|, v_r)/v_r)] sgn(v_t): it is constant, 0.95 mu F_n, beyond the slip v_r.
    """
    import sympy as sp

    v_r = inputs.parameters["v_r"]
    regularised_sign = make_odd_function(inputs.variables["v_t"], lambda u: 1 - sp.exp(-3 * sp.Min(u / v_r, 1)))
    return make_friction_force(inputs, inputs.parameters["mu"] * regularised_sign)


LAW = Law(
    name="threlfall",
    role="friction",
    title="Threlfall's friction: an exponential rise with the slip",
    equation=(r"F_t = -c_f F_n \left[1 - \exp\left(-\frac{3 \min(|v_t|, v_r)}{v_r}\right)\right] \mathrm{sgn}(v_t)",),
    source="A. G. Threlfall, Mechanism and Machine Theory 13 (1978) 475-483",
    reference=MarkedText(
        "A. G. Threlfall, The inclusion of Coulomb friction in mechanisms programs with particular reference to "
        "DRAM, Mechanism and Machine Theory 13 (1978) 475–483, as in E. Pennestrì et al., Nonlinear Dynamics 83 "
        "(2016) 1785–1801, doi 10.1007/s11071-015-2485-3"
    ),
    validity=MarkedText("sliding; below the slip $v_r$ the contact creeps where Coulomb's law would stick"),
    properties=MarkedText("the largest coefficient of friction is 0.9502 $c_f$"),
    fields=(MU, declare_slip_field("v_r", "slip above which friction no longer rises", "v_r")),
    build=build_friction_force,
)

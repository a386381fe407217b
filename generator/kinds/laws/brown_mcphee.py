"""Brown and McPhee's friction: one smooth expression whose peak is static friction at the slip v_0.

    F_t = −F_n [c_f tanh(4x) + (c_s − c_f) x/(x²/4 + ¾)²],   x = v_t/v_0

P. Brown, J. McPhee, J. Comput. Nonlinear Dyn. 11 (2016) 054502, without its viscous part.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.kinds.laws.roles import MU, MU_S, declare_slip_field, make_friction_force
from gudgeon.generator.marked_text import MarkedText


def build_friction_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the friction force F_t (N) on the journal along t, as equations by name; `share` is x = v_t/v0.

    F_t = −F_n [mu tanh 4x + (mu_s − mu) x/(x²/4 + 3/4)²].
    """
    import sympy as sp

    mu, mu_s = inputs.parameters["mu"], inputs.parameters["mu_s"]
    x = sp.Symbol("share", real=True)
    coefficient = mu * sp.tanh(4 * x) + (mu_s - mu) * x / (x**2 / 4 + sp.Rational(3, 4)) ** 2
    return {"share": inputs.variables["v_t"] / inputs.parameters["v0"], **make_friction_force(inputs, coefficient)}


LAW = Law(
    name="brown_mcphee",
    role="friction",
    title="Brown and McPhee's friction: a smooth peak of static friction",
    equation=(
        r"F_t = -F_n \left[c_f \tanh\frac{4 v_t}{v_0} + \frac{(c_s"
        r" - c_f)\, v_t/v_0}{\left(\frac{1}{4} (v_t/v_0)^2 + \frac{3}{4}\right)^2}\right]",
    ),
    source="P. Brown, J. McPhee, J. Comput. Nonlinear Dyn. 11 (2016) 054502",
    reference="P. Brown, J. McPhee, A continuous velocity-based friction model for dynamics and control with "
    "physically meaningful parameters, Journal of Computational and Nonlinear Dynamics 11 (2016) 054502, "
    "doi 10.1115/1.4033658, without its viscous part",
    validity=MarkedText("sliding; the contact creeps at slips below $v_0$, near which friction is largest"),
    fields=(MU, MU_S, declare_slip_field("v0", "slip near which friction is largest", "v_0")),
    build=build_friction_force,
)

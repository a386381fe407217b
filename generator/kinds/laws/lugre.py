"""LuGre friction: bristles bend before the surfaces slide, with static friction and damping of the bristles.

    F_t = −F_n (σ0 z + σ1 ż),   ż = v_t − σ0 |v_t| z/g_v,   g_v = c_f + (c_s − c_f) exp(−(v_t/v_s)²)

z is the bristles' deflection, 0 at each onset; |z| ≤ c_s/σ0 for ever. As in tyres the bristles are as stiff as the load
makes them. Steady sliding gives −F_n g_v sgn v_t. At a steady load ½ σ0 F_n z² is what they store, and it delivers no
more than that where σ1 ≤ 4 g_v/|v_t|: v_t (σ0 z + σ1 ż) − σ0 z ż is a quadratic form in v_t and σ0 z √(|v_t|/g_v) that
is nowhere negative then.
C. Canudas de Wit, H. Olsson, K. J. Åström, P. Lischinsky, IEEE Trans. Autom. Control 40 (1995) 419–425; C. Canudas de
Wit, P. Tsiotras, Proc. 38th IEEE Conf. Decision and Control (1999) 3746–3751, for the load; N. Barabanov, R. Ortega,
IEEE Trans. Autom. Control 45 (2000) 830–832, for the bound.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import Bound, number
from gudgeon.generator.kinds.laws.law import BREAKAWAY, Law, LawInputs, State
from gudgeon.generator.kinds.laws.roles import EXCESS_DECAY, MU, MU_S, declare_slip_field, make_friction_force
from gudgeon.generator.marked_text import MarkedText
from gudgeon.language.units import make_dimension


def build_friction_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the friction force F_t (N) on the journal along t and the rate of the bristle state, as equations by name.

    F_t = −F_n (σ_0 z + σ_1 z_rate) and z_rate = v_t − σ_0 |v_t| z/g_v (m/s), with g_v = μ + (μ_s − μ) exp(−(v_t/v_s)²).
    The deflection μ_s/σ_0 at which sliding begins becomes a derived parameter.
    """
    import sympy as sp

    names = ("mu", "mu_s", "v_s", "stiffness", "damping")
    mu, mu_s, v_s, sigma_0, sigma_1 = (inputs.parameters[name] for name in names)
    v_t, z = inputs.variables["v_t"], inputs.variables["z"]
    inputs.derive(BREAKAWAY, mu_s / sigma_0, "deflection at which it slides from rest")
    g, rate = sp.Symbol("g_v", real=True), sp.Symbol("bending", real=True)
    return {
        "g_v": mu + (mu_s - mu) * sp.exp(-((v_t / v_s) ** 2)),
        "bending": v_t - sigma_0 * sp.Abs(v_t) * z / g,
        **make_friction_force(inputs, sigma_0 * z + sigma_1 * rate),
        "z_rate": rate,
    }


LAW = Law(
    name="lugre",
    role="friction",
    title="LuGre friction, with the deflection of bristles",
    equation=(
        r"F_t = -F_n (\sigma_0 z + \sigma_1 \dot z)",
        r"\dot z = v_t - \sigma_0 |v_t|\, \frac{z}{g_v}",
        r"g_v = c_f + (c_s - c_f) \exp\left(-(v_t/v_s)^2\right)",
    ),
    source="C. Canudas de Wit et al., IEEE Trans. Autom. Control 40 (1995) 419-425; load as in C. Canudas de Wit, "
    "P. Tsiotras (1999)",
    reference=MarkedText(
        "C. Canudas de Wit, H. Olsson, K. J. Åström, P. Lischinsky, A new model for control of systems with "
        "friction, IEEE Transactions on Automatic Control 40 (1995) 419–425, doi 10.1109/9.376053; dependence on the "
        "load as in C. Canudas de Wit, P. Tsiotras, Proc. 38th IEEE Conf. Decision and Control (1999) 3746–3751"
    ),
    validity=MarkedText(
        r"presliding and sliding; the friction is passive at constant $F_n$ where $\sigma_1 \le 4 g_v/\lvert v_t\rvert$"
        r", for which $\sigma_1 \le 4 c_f/\lvert v_t\rvert$ is sufficient"
    ),
    properties="passive friction returns at most the energy that the bristles have stored",
    fields=(
        number(
            "mu",
            "coefficient of kinetic friction",
            MU.dimension,
            symbol="c_f",
            required=True,
            bounds=(Bound(">", 0.0),),
        ),
        MU_S,
        declare_slip_field("v_s", EXCESS_DECAY, "v_s"),
        number(
            "stiffness",
            "stiffness of the bristles divided by the normal force",
            make_dimension(length=-1),
            symbol=r"\sigma_0",
            required=True,
            bounds=(Bound(">", 0.0),),
        ),
        number(
            "damping",
            "damping of the bristles divided by the normal force",
            make_dimension(length=-1, time=1),
            symbol=r"\sigma_1",
            default=0.0,
            bounds=(Bound(">=", 0.0),),
        ),
    ),
    build=build_friction_force,
    states=(State("z", "deflection of the bristles"),),
)

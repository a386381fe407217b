"""Newton's impact law between rigid surfaces: velocities jump, and a lasting contact is a constraint.

    impact:   δ̇⁺ = −c_e δ̇⁻,   M (q̇⁺ − q̇⁻) + Φ_qᵀ P_Φ = −δ_qᵀ P_n,   P_n ≥ 0
    contact:  δ̈ ≤ 0,   λ_n ≥ 0,   λ_n δ̈ = 0   at δ = δ̇ = 0

with the impulse P_n (N s) and the force F_n = λ_n (N) along the normal. A bounce slower than the threshold v_th ends at
rest: the contact is closed. Several contacts at one time are solved as one linear complementarity problem, in which
every contact that is closed or closes takes part. Friction, F_t = −c_d F_n sgn v_t by its own law, acts with λ_n while
a contact is closed. In an impact it has impulses P_t along t (engine/run/frictional_impact.c). With the slip v_t after
the impact without friction,

    friction: v_t⁺ = v_t + G_t P_t,   |P_t| ≤ c_d P_n,   v_t⁺ = 0 where |P_t| < c_d P_n,   P_t (ṽ_t + G_t P_t/2) ≤ 0

P_n changes with P_t so that each δ̇⁺ stays as it is, and G_t contains that change. ṽ_t is the slip after an impact with
c_e = 0. The last condition states that friction adds no energy: P_t is reduced where it would, as Newton's and
Coulomb's laws together may.
I. Newton, Principia (1687), scholium to the laws of motion; J. J. Moreau, Unilateral contact and dry friction in finite
freedom dynamics, in: Nonsmooth Mechanics and Applications (1988) 1–82; F. Pfeiffer, C. Glocker, Multibody Dynamics with
Unilateral Contacts (1996); A. Chatterjee, A. Ruina, A new algebraic rigid-body collision law based on impulse space
considerations, Journal of Applied Mechanics 65 (1998) 939–951, doi 10.1115/1.2791938.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import Bound, number
from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.marked_text import MarkedText
from gudgeon.language.units import DIMENSIONLESS, VELOCITY


def build_normal_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the normal force F_n (N) of a closed contact: the force that keeps e = c, which a run determines."""
    return {"F_n": inputs.variables["held_force"]}


LAW = Law(
    name="newton_restitution",
    role="normal",
    title="Newton's restitution between rigid surfaces",
    equation=(
        r"\dot\delta^{+} = -c_e \dot\delta^{-} \quad \text{in an impact}",
        r"0 \le F_n \perp -\ddot\delta \ge 0 \quad \text{in a closed contact}",
    ),
    source="I. Newton, Principia (1687); J. J. Moreau, in: Nonsmooth Mechanics and Applications (1988) 1-82",
    reference="J. J. Moreau, Unilateral contact and dry friction in finite freedom dynamics, in: J. J. Moreau, P. D. "
    "Panagiotopoulos (eds.), Nonsmooth Mechanics and Applications, Springer (1988) 1-82, "
    "doi 10.1007/978-3-7091-2624-0_1; F. Pfeiffer, C. Glocker, Multibody Dynamics with Unilateral Contacts, "
    "Wiley (1996); friction in an impact: A. Chatterjee, A. Ruina, A new algebraic rigid-body collision law "
    "based on impulse space considerations, Journal of Applied Mechanics 65 (1998) 939-951, "
    "doi 10.1115/1.2791938",
    validity="impacts that are far shorter than all other motion",
    properties=MarkedText(
        "an impact separates the surfaces with $c_e$ times their approach speed, and no force during the impact is "
        "computed; a closed contact is a constraint that only pushes; in an impact, friction reduces the slip, at most "
        "to zero, by an impulse of at most `mu` times the normal impulse; an impact never adds energy"
    ),
    fields=(
        number(
            "restitution",
            "separation speed divided by approach speed",
            DIMENSIONLESS,
            symbol="c_e",
            required=True,
            bounds=(Bound(">=", 0.0), Bound("<=", 1.0)),
        ),
        number(
            "threshold",
            "separation speed up to which a contact closes",
            VELOCITY,
            symbol=r"v_{\mathrm{th}}",
            default=1e-4,
            bounds=(Bound(">", 0.0),),
        ),
    ),
    build=build_normal_force,
    rigid=True,
)

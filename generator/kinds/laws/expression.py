"""Contact whose elastic force is an expression of the penetration that the file gives, with hysteresis damping.

    F_n = F_el(δ) (1 + a δ̇/δ̇⁻),   F_el(0) = 0,   F_el ≥ 0

never negative unless it `pulls`. What the factor a delivers does not depend on F_el: m δ̈ = −F_el (1 + a δ̇/δ̇⁻) is
m v dv/(1 + a v/δ̇⁻) = −F_el dδ, whose right side is the same on the way in and on the way out. So every factor of
dissipation.py may go with it, `exact` too. How the expression is read, and what is looked at:
equations/user_defined_laws.py.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import OF_PENETRATION, Bound, number
from gudgeon.generator.kinds.laws.dissipation import DISSIPATION, PULLS, RESTITUTION, make_hysteresis_factor
from gudgeon.generator.kinds.laws.law import MAX_PENETRATION, SECANT_DEPTH, Law, LawInputs
from gudgeon.language.units import FORCE, LENGTH


def build_normal_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the equations of F_e and F_n by name: forces (N) for δ > 0, positive in compression.

    F_e is the elastic force of the file. F_n is F_e times the hysteresis factor of the option `dissipation`. Derived
    parameters are added to `inputs`: the largest penetration, if the file gives it, and the secant stiffness `spring`
    at a twentieth of the clearance, if the force depends on δ.
    """
    import sympy as sp

    force, delta = inputs.parameters["force"], inputs.variables["delta"]
    max_penetration = inputs.parameters.get(MAX_PENETRATION)
    if max_penetration is not None:
        inputs.derive(MAX_PENETRATION, max_penetration, "penetration up to which the expression holds")
    if force.has(delta):
        depth = SECANT_DEPTH * inputs.pair.c
        inputs.derive("spring", force.subs(delta, depth) / depth, "secant stiffness at a twentieth of the clearance")
    F_e = sp.Symbol("F_e", real=True)
    return {"F_e": force, "F_n": F_e * make_hysteresis_factor(inputs, str(inputs.options["dissipation"]))}


LAW = Law(
    name="expression",
    role="normal",
    title="An elastic force as an expression of the penetration, with a choice of hysteresis damping",
    equation=(r"F_n = F_{\mathrm{el}}(\delta) \max\left(0, 1 + a\,\frac{\dot\delta}{\dot\delta^{-}}\right)",),
    source="the file; the damping as K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440-445",
    reference="The file specifies the elastic force; the damping has the form of K. H. Hunt, F. R. E. Crossley, "
    "Journal of Applied Mechanics 42 (1975) 440-445, doi 10.1115/1.3423596",
    validity="penetrations for which the user knows the elastic force; the elastic force must be 0 at zero "
    "penetration, which every run checks with its parameter values; the elastic force must not be "
    "negative up to the clearance, or up to `deepest` where the file gives it",
    properties="at loading, gudgeon checks the sign of the force with the parameter values of the file and of its "
    "scenes",
    fields=(
        number(
            "force",
            "elastic force, an expression of the penetration `delta`, of parameters and of curves",
            FORCE,
            symbol=r"F_{\mathrm{el}}",
            required=True,
            varies=OF_PENETRATION,
        ),
        number(
            MAX_PENETRATION,
            "penetration up to which the expression holds; a run that goes deeper stops",
            LENGTH,
            symbol=r"\delta_{\mathrm{max}}",
            bounds=(Bound(">", 0.0),),
            otherwise="a tenth of the bearing's radius",
        ),
        RESTITUTION,
        DISSIPATION,
        PULLS,
    ),
    build=build_normal_force,
)

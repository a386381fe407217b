"""Liu's contact of a journal that nearly fills its bearing: conforming cylinders, explicit in the penetration.

    F_n = (π/2) L E* δ √(δ/(2(c + δ))) (1 + a δ̇/δ̇⁻),   1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j,   c = R_i − R_j

never negative unless it `pulls`. C. S. Liu, K. Zhang, R. Yang, Mechanism and Machine Theory 42 (2007) 183–197; the
damping factors are those of dissipation.py.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.laws.dissipation import DISSIPATION, PULLS, RESTITUTION, make_hysteresis_factor
from gudgeon.generator.kinds.laws.elastic_pair import make_contact_modulus
from gudgeon.generator.kinds.laws.law import Law, LawInputs


def build_normal_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the compressive normal force F_n (N) for δ > 0, with hysteresis damping, as an equation by name.

    F_n = (π/2) L E* δ √(δ/(2 (c + δ))) times the hysteresis factor, with the clearance c and the length L of the
    bearing.
    """
    import sympy as sp

    delta = inputs.variables["delta"]
    K = inputs.derive("K", sp.pi / 2 * inputs.pair.L * make_contact_modulus(inputs), "pi L E*/2")
    return {
        "F_n": K
        * delta
        * sp.sqrt(delta / (2 * (inputs.pair.c + delta)))
        * make_hysteresis_factor(inputs, str(inputs.options["dissipation"]))
    }


LAW = Law(
    name="liu",
    role="normal",
    title="Liu, Zhang and Yang: conforming cylinders, with a choice of hysteresis damping",
    equation=(
        r"F_n = \frac{\pi}{2} L E^{*} \delta \sqrt{\frac{\delta}{2 (c + \delta)}}\, \max\left(0, 1"
        r" + a\,\frac{\dot\delta}{\dot\delta^{-}}\right)",
        r"\frac{1}{E^{*}} = \frac{1 - \nu_i^2}{E_i} + \frac{1 - \nu_j^2}{E_j}",
    ),
    source="C. S. Liu, K. Zhang, R. Yang, Mechanism and Machine Theory 42 (2007) 183-197",
    reference="C. S. Liu, K. Zhang, R. Yang, The FEM analysis and approximate model for cylindrical joints with "
    "clearances, Mechanism and Machine Theory 42 (2007) 183-197, doi 10.1016/j.mechmachtheory.2006.02.006",
    validity="a pin in a hole with parallel axes, and penetrations up to some clearances",
    fields=(
        RESTITUTION,
        DISSIPATION,
        PULLS,
    ),
    build=build_normal_force,
    in_hole=True,
)

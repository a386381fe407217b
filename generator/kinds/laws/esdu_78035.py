"""ESDU 78035's contact of a journal in its bearing: cylinders with parallel axes, by the data sheet's formula.

    δ = F_el/(π L E*) [ln(4 π L E* c/F_el) + 1],   F_n = F_el (1 + a δ̇/δ̇⁻),   1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j

never negative unless it `pulls`, solved for F_el (elastic_pair.py). c = R_i − R_j.
ESDU 78035, Contact phenomena I: stresses, deflections and contact dimensions for normally loaded unlubricated elastic
components (1978), as in C. Pereira, A. Ramalho, J. Ambrósio, Nonlinear Dynamics 63 (2011) 681–697. The damping factors
are those of dissipation.py.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.laws.elastic_pair import CYLINDER_FIELDS, make_cylinder_force
from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.marked_text import MarkedText


def build_normal_force(inputs: LawInputs) -> dict[str, Any]:
    """Return the compressive normal force F_n (N) for δ > 0 and its abbreviations, as equations by name.

    The elastic force F_el solves δ = u [ln(4 c/u) + 1], u = F_el/(π L E*), with the clearance c and the length L. F_n
    is F_el times the hysteresis factor. A run stops beyond δ = 3.7 c.
    """
    import sympy as sp

    return make_cylinder_force(inputs, log_constant=1, max_penetration_ratio=sp.Rational(37, 10))


LAW = Law(
    name="esdu_78035",
    role="normal",
    title="ESDU 78035: cylinders with parallel axes, with a choice of hysteresis damping",
    equation=(
        r"\delta = \frac{F_{\mathrm{el}}}{\pi L E^{*}}\left[\ln\frac{4\pi L E^{*} c}{F_{\mathrm{el}}} + 1\right]",
        r"F_n = F_{\mathrm{el}} \max\left(0, 1 + a\,\frac{\dot\delta}{\dot\delta^{-}}\right)",
        r"\frac{1}{E^{*}} = \frac{1 - \nu_i^2}{E_i} + \frac{1 - \nu_j^2}{E_j}",
    ),
    source="ESDU 78035 (1978), as in Pereira et al. (2011)",
    reference=MarkedText(
        "ESDU 78035, Contact phenomena I: stresses, deflections and contact dimensions for normally loaded "
        "unlubricated elastic components (1978), as in C. Pereira, A. Ramalho, J. Ambrósio, A critical overview "
        "of internal and external cylinder contact force models, Nonlinear Dynamics 63 (2011) 681–697, doi "
        "10.1007/s11071-010-9830-3"
    ),
    validity=MarkedText(
        r"a contact that is narrow compared with the radii; the equation for $F_{\text{el}}$ has no solution for a "
        "penetration above 4 clearances, and a run stops at 3.7 clearances"
    ),
    fields=CYLINDER_FIELDS,
    build=build_normal_force,
    in_hole=True,
)

"""Greenwood and Tripp's mixed lubrication: asperities take the load as their overlap grows.

    F = b F_dry + (1 − b) F_film,   b = F_{5/2}(Λ)/F_{5/2}(0),   Λ = 4 − δ/σ_r

F_{5/2}(Λ) = ∫ from Λ of (η − Λ)^{5/2} φ(η) dη, with normally distributed heights η, is proportional to the load of
the asperities. N. Patir, H. S. Cheng, Proc. 5th Leeds-Lyon Symp. (1978) 15–21, fit it by 4.4086e-5 (4 − Λ)^6.804 for
Λ < 4, so that b is (δ/(4σ_r))^6.804. The law of the dry contact gives its force. At Λ = 0 the mean surfaces meet and
the dry contact acts alone; the slope of b jumps there.
J. A. Greenwood, J. H. Tripp, Proc. Instn Mech. Engrs 185 (1970) 625–633; film and asperities side by side: K. L.
Johnson, J. A. Greenwood, S. Y. Poon, Wear 19 (1972) 91–108.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.kinds.laws.roles import ROUGHNESS, make_overlap_fraction
from gudgeon.generator.marked_text import MarkedText

POWER = 6.804


def build_greenwood_tripp_fraction(inputs: LawInputs) -> dict[str, Any]:
    """Return the equations, by name, that lead to `share`, the weight of the dry force.

    It is a power, with the exponent POWER, of the overlap of the roughness, from 4 to 0 standard deviations. It rises
    from 0 to 1 with the penetration δ > 0.
    """
    import sympy as sp

    part = sp.Symbol("part", real=True)
    return {"part": make_overlap_fraction(inputs, 4, 0), "share": part ** sp.Float(POWER)}


LAW = Law(
    name="greenwood_tripp",
    role="mixed",
    title="Greenwood and Tripp: weight of the dry force by the load of the asperities",
    equation=(
        r"F = b F_\mathrm{dry} + (1 - b) F_\mathrm{film}",
        r"b = \frac{F_{5/2}(\Lambda)}{F_{5/2}(0)} \approx \left(\frac{\delta}{4 \sigma_r}\right)^{6.804},"
        r" \quad \Lambda = 4 - \frac{\delta}{\sigma_r}",
    ),
    source="J. A. Greenwood, J. H. Tripp, Proc. Instn Mech. Engrs 185 (1970) 625-633; fit of N. Patir, H. S. Cheng "
    "(1978)",
    reference="J. A. Greenwood, J. H. Tripp, The contact of two nominally flat rough surfaces, Proceedings of the "
    "Institution of Mechanical Engineers 185 (1970) 625-633; their integral as in N. Patir, H. S. Cheng, "
    "Effect of surface roughness orientation on the central film thickness in EHD contacts, Proceedings of "
    "the 5th Leeds-Lyon Symposium (1978) 15-21; K. L. Johnson, J. A. Greenwood, S. Y. Poon, A simple theory "
    "of asperity contact in elastohydrodynamic lubrication, Wear 19 (1972) 91-108",
    validity="heights of the roughness with a normal distribution",
    properties=MarkedText(
        r"the film acts alone where it is thicker than $4 \sigma_r$, and the dry contact acts alone where the mean "
        r"surfaces meet; the clearance $c$ is measured between the tips of the asperities, and the "
        r"clearance between the mean surfaces is $c + 4 \sigma_r$; "
        r"the weight $b$ is the load of the asperities divided by their load where the "
        r"mean surfaces meet; the approximation of $b$ deviates by at most 0.014"
    ),
    fields=(ROUGHNESS,),
    build=build_greenwood_tripp_fraction,
)

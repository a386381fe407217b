"""Christensen's mixed lubrication: a fraction of the area is in contact, and the film acts on the rest.

    F = b F_dry + (1 − b) F_film,   b = ∫ from Λ to 3 of 35/96 (1 − (η/3)²)³ dη,   Λ = 3 − δ/σ_r

η is a height in units of the combined roughness σ_r. b is the share of the area in which the heights of both surfaces
overlap, for Christensen's density of heights, which is nearly a normal one and ends at ±3 σ_r. With x = δ/(6σ_r) and
y = 1 − x it is x⁴ (x³ + 7 x² y + 21 x y² + 35 y³): from 0 at Λ = 3 to 1 at Λ = −3, three times differentiable at both.
No term takes from another: it is good to rounding everywhere, and to its own where it is small.
The contact's force is that of its own laws, the film's that of its own: what only dissipates does so together.
H. Christensen, Proc. Instn Mech. Engrs 184 (1969) 1013–1026 (heights), 186 (1972) 421–430 (the share of the area).
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.laws.law import Law, LawInputs
from gudgeon.generator.kinds.laws.roles import ROUGHNESS, make_overlap_fraction
from gudgeon.generator.marked_text import MarkedText


def build_christensen_fraction(inputs: LawInputs) -> dict[str, Any]:
    """Return the equations, by name, that lead to `share`, the weight of the dry force.

    It is a polynomial of degree 7 in the overlap of the roughness, from −3 to +3 standard deviations, and rises from 0
    to 1 with the penetration δ > 0.
    """
    import sympy as sp

    overlap, remainder = sp.symbols("overlap_fraction remainder", real=True)
    share = overlap**4 * (overlap**3 + remainder * (7 * overlap**2 + remainder * (21 * overlap + 35 * remainder)))
    return {"overlap_fraction": make_overlap_fraction(inputs, 3, -3), "remainder": 1 - overlap, "share": share}


LAW = Law(
    name="christensen",
    role="mixed",
    title="Christensen: weight of the dry force by the area in contact",
    equation=(
        r"F = b F_\mathrm{dry} + (1 - b) F_\mathrm{film}",
        r"b = \int_\Lambda^3 \frac{35}{96} \left[1 - \left(\frac{\eta}{3}\right)^2\right]^3 d\eta, \quad \Lambda"
        r" = 3 - \frac{\delta}{\sigma_r}",
    ),
    source="H. Christensen, Proc. Instn Mech. Engrs 184 (1969) 1013-1026 and 186 (1972) 421-430",
    reference="H. Christensen, Stochastic models for hydrodynamic lubrication of rough surfaces, Proceedings of the "
    "Institution of Mechanical Engineers 184 (1969) 1013-1026; H. Christensen, A theory of mixed "
    "lubrication, the same 186 (1972) 421-430",
    validity="heights of the roughness with a nearly normal distribution, uniform over both surfaces",
    properties=MarkedText(
        r"the film acts alone where it is thicker than $3 \sigma_r$, and the dry contact acts alone below $-3 \sigma_r$"
        r"; the clearance $c$ is measured between the tips of the asperities, and the clearance "
        r"between the mean surfaces is $c + 3 \sigma_r$; "
        r"the weight $b$ is the fraction of the area in contact, and is three times differentiable"
    ),
    fields=(ROUGHNESS,),
    build=build_christensen_fraction,
)

"""What contacts of cylinders with parallel axes share, whose penetration is a known function of the load.

    δ = u (ln(4 ΔR/u) + k),   u = F/(π L E*),   1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j,   ΔR = R_i − R_j = c

The root of small loads: u = δ/p with p − ln p = ln(4 ΔR/δ) + k, p > 1, by Lambert's function −W₋₁(−δ e^{−k}/(4 ΔR)).
It ends at p = 1, where the load grows without penetration: δ = 4 ΔR e^{k−1}. Three of Newton's steps from a start that
is within .8 % leave rounding.
R. M. Corless et al., Adv. Comput. Math. 5 (1996) 329–359, for W; the bounds of I. Chatzigeorgiou, IEEE Commun. Lett. 17
(2013) 1505–1508, for the start.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import Field
from gudgeon.generator.kinds.laws.dissipation import DISSIPATION, PULLS, RESTITUTION, hysteresis
from gudgeon.generator.kinds.laws.elastic_pair import contact_modulus
from gudgeon.generator.kinds.laws.law import DEEPEST, LawInputs

FIELDS: tuple[Field, ...] = (RESTITUTION, DISSIPATION, PULLS)
STEPS = 3  # of Newton's method
_NEVER = 1e-150  # of 4 ΔR, below every penetration: ln is finite at δ = 0
_END = 1e-9  # beyond the end, where no run goes on, ln(…) + k − 1 tends to 0, so that a stage's force is a number


def cylinder_force(s: LawInputs, k: int, deepest: Any) -> dict[str, Any]:
    """The steps to F_n (N) for δ > 0; no run goes deeper than `deepest` clearances."""
    import sympy as sp

    delta = s.variables["delta"]
    K = s.derive("spring", sp.pi * s.pair.L * contact_modulus(s), "pi L E*")
    scale = s.derive("scale", 4 * s.pair.c, "4 (R_i - R_j)")
    s.derive(DEEPEST, deepest * s.pair.c, "penetration up to which the law holds")
    above, p = sp.Symbol("above", real=True), [sp.Symbol(f"p_{n}", real=True) for n in range(STEPS + 1)]
    far = sp.Symbol("far", real=True)
    root = sp.Symbol("root_far", real=True)
    steps: dict[str, Any] = {
        "above": k - 1 - sp.log(delta / scale + sp.Float(_NEVER)),
        "far": (above + sp.sqrt(above**2 + sp.Float(_END**2))) / 2 + sp.Float(_END**2),
        "root_far": sp.sqrt(2 * far),
        "p_0": 1 + root + far * (1 + sp.Float(0.3) * root) / (sp.Float(1.5) + sp.Float(0.3) * root),
    }
    for one, following in zip(p, p[1:], strict=False):
        steps[following.name] = one * (far + sp.log(one)) / (one - 1)
    return {**steps, "F_n": K * delta / p[-1] * hysteresis(s, str(s.options["dissipation"]))}

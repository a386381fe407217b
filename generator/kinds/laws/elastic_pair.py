"""The stiffness of two elastic surfaces by Hertz, from their radii and materials; both conventions of the curvature.

K = 4/3 E* √R*,   1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j,   R* = R_i R_j/(R_i ± R_j)

The 6.61e10 N/m^1.5 that the literature has for steel pins of 9.5 mm in holes of 10 mm is that of R_i − R_j, whatever
sign stands in the formula beside it; R_i + R_j gives 1.06e10. The latter is the default, for it is what the paper that
the press is taken from prints, and its golden figures follow; the former is the geometry of a pin in a hole.

What contacts of cylinders with parallel axes share, whose penetration is a known function of the load.

    δ = u (ln(4 c/u) + k),   u = F_el/(π L E*),   c = R_i − R_j

The root of small loads: u = δ/p with p − ln p = ln(4 c/δ) + k, p > 1, by Lambert's function −W₋₁(−δ e^{−k}/(4 c)).
It ends at p = 1, where the load grows without penetration: δ = 4 c e^{k−1}. Three of Newton's steps from a start that
is within .8 % leave rounding.
R. M. Corless et al., Adv. Comput. Math. 5 (1996) 329–359, for W; the bounds of I. Chatzigeorgiou, IEEE Commun. Lett. 17
(2013) 1505–1508, for the start.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import Field, word
from gudgeon.generator.kinds.laws.dissipation import DISSIPATION, PULLS, RESTITUTION, make_hysteresis_factor
from gudgeon.generator.kinds.laws.law import MAX_PENETRATION, LawInputs
from gudgeon.generator.marked_text import MarkedText

GEOMETRY = word(
    "geometry",
    MarkedText(
        "curvature of the pair: external, $R_i + R_j$, as Chen, Gao and Wang (2022) print it for the press; internal, "
        "$R_i - R_j$, for a pin in a hole"
    ),
    ("external", "internal"),
    "external",
)


def make_pair_stiffness(inputs: LawInputs) -> Any:
    """Return the contact stiffness K (N/m^1.5) of Hertz, K = 4/3 E* √R*, as a derived constant.

    R* = R_i R_j/(R_i ± R_j), + with the option `geometry: external`, − with `internal`; R_j for a corner on a wall
    (R_i = ∞). E* is the contact modulus. Equal materials give a shorter formula.
    """
    import sympy as sp

    pair = inputs.pair
    signed_radius = pair.R_j if inputs.options["geometry"] == "external" else -pair.R_j
    is_flat = pair.R_i == sp.oo  # a corner on a wall: R_i R_j/(R_i ± R_j) = R_j
    radius = sp.sqrt(pair.R_j) if is_flat else sp.sqrt(pair.R_i * pair.R_j / (pair.R_i + signed_radius))
    if (pair.E_i, pair.nu_i) == (pair.E_j, pair.nu_j):
        K = sp.Rational(2, 3) * pair.E_i * radius / (1 - pair.nu_i**2)
    else:  # unevaluated, so that equal numbers give exactly the result of one material
        compliance_i, compliance_j = (inputs.keep_unevaluated(1 - nu**2) for nu in (pair.nu_i, pair.nu_j))
        K = (
            sp.Rational(4, 3)
            * pair.E_i
            * radius
            / (compliance_i + compliance_j * inputs.keep_unevaluated(pair.E_i / pair.E_j))
        )
    return inputs.derive("K", K, "contact stiffness")


def make_contact_modulus(inputs: LawInputs) -> Any:
    """Return the contact modulus E* (Pa): 1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j.

    Equal materials give a shorter formula.
    """
    pair = inputs.pair
    if (pair.E_i, pair.nu_i) == (pair.E_j, pair.nu_j):
        return pair.E_i / (2 * (1 - pair.nu_i**2))
    compliance_i, compliance_j = (inputs.keep_unevaluated(1 - nu**2) for nu in (pair.nu_i, pair.nu_j))
    return pair.E_i / (compliance_i + compliance_j * inputs.keep_unevaluated(pair.E_i / pair.E_j))


CYLINDER_FIELDS: tuple[Field, ...] = (RESTITUTION, DISSIPATION, PULLS)
N_NEWTON_STEPS = 3  # of Newton's method
_MIN_LOG_ARGUMENT = 1e-150  # in units of 4 c: smaller than any penetration, so that ln is finite at δ = 0
_LIMIT_SMOOTHING = (
    1e-9  # keeps the root positive beyond the largest penetration, so that the force in a stage is finite
)


def make_cylinder_force(inputs: LawInputs, log_constant: int, max_penetration_ratio: Any) -> dict[str, Any]:
    """Return the equations by name up to the normal force F_n (N) of parallel cylinders, δ > 0, by Newton's method.

    δ = u (ln(4 c/u) + k), with k the argument `log_constant`, is solved for p = δ/u: p − ln p = k − ln(δ/(4 c)), and
    F_n = K δ/p times the hysteresis factor of the option `dissipation`. The equations contain `N_NEWTON_STEPS` unrolled
    iterations, without a test of convergence. A run stops beyond the penetration `max_penetration_ratio` times the
    clearance. That limit, the stiffness K and 4 c become derived parameters.
    """
    import sympy as sp

    delta = inputs.variables["delta"]
    K = inputs.derive("spring", sp.pi * inputs.pair.L * make_contact_modulus(inputs), "pi L E*")
    scale = inputs.derive("scale", 4 * inputs.pair.c, "4 (R_i - R_j)")
    inputs.derive(MAX_PENETRATION, max_penetration_ratio * inputs.pair.c, "penetration up to which the law holds")
    above, p = sp.Symbol("above", real=True), [sp.Symbol(f"p_{n}", real=True) for n in range(N_NEWTON_STEPS + 1)]
    far = sp.Symbol("far", real=True)
    root = sp.Symbol("root_far", real=True)
    steps: dict[str, Any] = {
        "above": log_constant - 1 - sp.log(delta / scale + sp.Float(_MIN_LOG_ARGUMENT)),
        "far": (above + sp.sqrt(above**2 + sp.Float(_LIMIT_SMOOTHING**2))) / 2 + sp.Float(_LIMIT_SMOOTHING**2),
        "root_far": sp.sqrt(2 * far),
        "p_0": 1 + root + far * (1 + sp.Float(0.3) * root) / (sp.Float(1.5) + sp.Float(0.3) * root),
    }
    for iterate, next_iterate in zip(p, p[1:], strict=False):
        steps[next_iterate.name] = iterate * (far + sp.log(iterate)) / (iterate - 1)
    return {**steps, "F_n": K * delta / p[-1] * make_hysteresis_factor(inputs, str(inputs.options["dissipation"]))}

"""Hysteresis damping factors a of several authors in the force F = K δⁿ (1 + a δ̇/δ̇⁻) (physics.md, section 3).

Each is a function of the coefficient of restitution c_e. What a law delivers is another number: it obeys
a (1 + e_r) = ln[(1 + a)/(1 − a e_r)] whatever n, K and m (physics.md, section 3), and `exact` solves that for a.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

from gudgeon.generator.field import Bound, flag, number, word
from gudgeon.generator.kinds.laws.law import LawInputs
from gudgeon.generator.marked_text import MarkedText
from gudgeon.language.units import DIMENSIONLESS

# name -> a(c_e)
FACTORS: Mapping[str, Callable[[Any], Any]] = {
    "none": lambda c_e: 0 * c_e,
    "hunt_crossley": lambda c_e: 3 * (1 - c_e) / 2,
    "herbert_mcwhannell": lambda c_e: 6 * (1 - c_e) / ((2 * c_e - 1) ** 2 + 3),
    "lee_wang": lambda c_e: 3 * (1 - c_e) / 4,
    "lankarani_nikravesh": lambda c_e: 3 * (1 - c_e**2) / 4,
    "gonthier": lambda c_e: (1 - c_e**2) / c_e,
    "zhiying_qishao": lambda c_e: 3 * (1 - c_e**2) / 4 * _make_exponential(2 * (1 - c_e)),
    "flores": lambda c_e: 8 * (1 - c_e) / (5 * c_e),
    "hu_guo": lambda c_e: 3 * (1 - c_e) / (2 * c_e),
}

# Of those that were not read, and whose volume and pages nothing at hand confirms.
_SECOND_HAND = (
    "cited at second hand and not checked in print; listed in the review of M. Machado, P. Moreira, P. Flores, "
    "H. M. Lankarani, Mechanism and Machine Theory 53 (2012) 99-121, doi 10.1016/j.mechmachtheory.2012.02.010"
)

SOURCES: Mapping[str, str] = {
    "hunt_crossley": "K. H. Hunt, F. R. E. Crossley, Coefficient of restitution interpreted as damping in vibroimpact, "
    "Journal of Applied Mechanics 42 (1975) 440-445, doi 10.1115/1.3423596",
    "herbert_mcwhannell": "R. G. Herbert, D. C. McWhannell, Shape and frequency composition of pulses from an impact "
    f"pair, Journal of Engineering for Industry 99 (1977) 513-518, {_SECOND_HAND}",
    "lee_wang": "T. W. Lee, A. C. Wang, On the dynamics of intermittent-motion mechanisms, part 1: dynamic model and "
    "response, Journal of Mechanisms, Transmissions, and Automation in Design 105 (1983) 534-540, "
    f"{_SECOND_HAND}",
    "lankarani_nikravesh": "H. M. Lankarani, P. E. Nikravesh, A contact force model with hysteresis damping for impact "
    "analysis of multibody systems, Journal of Mechanical Design 112 (1990) 369-376, "
    "doi 10.1115/1.2912617",
    "gonthier": "Y. Gonthier, J. McPhee, C. Lange, J.-C. Piedboeuf, A regularized contact model with asymmetric "
    "damping and dwell-time dependent friction, Multibody System Dynamics 11 (2004) 209-233, "
    "doi 10.1023/B:MUBO.0000029392.21648.bc",
    "zhiying_qishao": "Z. Qin, Q. Lu, Analysis of impact process based on restitution coefficient, Journal of "
    f"Dynamics and Control 4 (2006) 294-298, {_SECOND_HAND}",
    "flores": "P. Flores, M. Machado, M. T. Silva, J. M. Martins, On the continuous contact force models for soft "
    "materials in multibody dynamics, Multibody System Dynamics 25 (2011) 357-375, "
    "doi 10.1007/s11044-010-9237-4",
    "hu_guo": "S. Hu, X. Guo, A dissipative contact force model for impact analysis in multibody dynamics, Multibody "
    "System Dynamics 35 (2015) 131-151, doi 10.1007/s11044-015-9453-z",
    "exact": "a (1 + c_e) = ln[(1 + a)/(1 - a c_e)], solved for a: the identity of the delivered restitution",
}
PULLS = flag(
    "pulls",
    MarkedText(r"apply the formula without $\max(0, \dots)$: the force then pulls where the surfaces separate fast"),
)
EXACT = "exact"  # delivers the restitution that it is given
RESTITUTION = number(
    "restitution",
    "coefficient of restitution",
    DIMENSIONLESS,
    symbol="c_e",
    default=1.0,
    bounds=(Bound(">", 0.0), Bound("<=", 1.0)),
)
DISSIPATION = word(
    "dissipation",
    MarkedText("author of the hysteresis damping factor $a$; `none` is $a = 0$, `exact` delivers $c_e$"),
    (*FACTORS, EXACT),
    "hunt_crossley",
    SOURCES,
)


def make_hysteresis_factor(inputs: LawInputs, formula_name: str) -> Any:
    """Return the hysteresis factor 1 + a δ̇/δ̇⁻ of a normal force, at least 0 unless the law has the option `pulls`.

    a follows from the parameter `restitution` by the formula `formula_name`, a key of FACTORS or EXACT, and becomes a
    derived constant.
    """
    import sympy as sp

    c_e = inputs.parameters["restitution"]
    a = _solve_exact_factor(inputs, c_e) if formula_name == EXACT else FACTORS[formula_name](c_e)
    a = inputs.derive("hysteresis", a, "hysteresis damping factor a")
    factor_at_state = 1 + a * inputs.variables["ratio"]
    return factor_at_state if inputs.options.get("pulls") else sp.Max(factor_at_state, 0)


def make_normal_force(inputs: LawInputs, K: Any, formula_name: str) -> Any:
    """Return the normal force K δⁿ (1 + a δ̇/δ̇⁻) of Hertz's form with hysteresis damping (`make_hysteresis_factor`).

    `K`: stiffness; n is the parameter `exponent`.
    """
    return K * inputs.variables["delta"] ** inputs.parameters["exponent"] * make_hysteresis_factor(inputs, formula_name)


def compute_delivered_restitution(a: float) -> float:
    """Return the coefficient of restitution e_r of a free impact for the damping factor a ≥ 0; 1 for a = 0.

    e_r solves a (1 + e_r) = ln[(1 + a)/(1 − a e_r)] by Brent's method.
    """
    from scipy.optimize import brentq

    if a == 0.0:
        return 1.0
    upper_limit = min(1.0, (1.0 - 1e-15) / a)
    return float(brentq(lambda e: a * (1.0 + e) - math.log1p(a) + math.log1p(-a * e), 1e-12, upper_limit, xtol=1e-15))


def _solve_exact_factor(inputs: LawInputs, c_e: Any) -> Any:
    """Return the factor a that solves 1 − a c_e = (1 + a) e^{−a(1 + c_e)}, by four steps of Newton's method.

    This is the identity of the module with e_r = c_e. The start is Hu and Guo's factor, which exceeds a by at most
    half, so that the steps approach a from above. Each step is at most a third of a, since rounding dominates where a
    is small. All steps are derived constants of the law.
    """
    import sympy as sp

    a = inputs.derive("a_0", FACTORS["hu_guo"](c_e), "Hu and Guo's factor, from which a is found")
    for k in range(1, 5):
        decay = inputs.derive(f"decay_{k}", (1 + a) * sp.exp(-a * (1 + c_e)), "(1 + a) exp(-a(1 + c_e))")
        step = (1 - a * c_e - decay) / (decay * (1 + c_e) - decay / (1 + a) - c_e - sp.Float(1e-150))
        a = inputs.derive(f"a_{k}", a - sp.Max(sp.Min(step, a / 3), 0), "the next a by Newton's method")
    return a


def _make_exponential(x: Any) -> Any:
    """Return the exponential in SymPy."""
    import sympy as sp

    return sp.exp(x)

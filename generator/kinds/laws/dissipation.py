"""The hysteresis damping factor a in F = K δⁿ (1 + a δ̇/δ̇⁻), by its authors (physics.md, section 7).

Each is a function of the coefficient of restitution c_e. What a law delivers is another number: it obeys
a (1 + e) = ln[(1 + a)/(1 − a e)] whatever n, K and m (physics.md, section 3).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from gudgeon.generator.kinds.laws.law import LawInputs

# name -> a(c_e)
FACTORS: Mapping[str, Callable[[Any], Any]] = {
    "none": lambda c_e: 0 * c_e,
    "hunt_crossley": lambda c_e: 3 * (1 - c_e) / 2,
    "herbert_mcwhannell": lambda c_e: 6 * (1 - c_e) / ((2 * c_e - 1) ** 2 + 3),
    "lee_wang": lambda c_e: 3 * (1 - c_e) / 4,
    "lankarani_nikravesh": lambda c_e: 3 * (1 - c_e**2) / 4,
    "gonthier": lambda c_e: (1 - c_e**2) / c_e,
    "zhiying_qishao": lambda c_e: 3 * (1 - c_e**2) / 4 * _exp(2 * (1 - c_e)),
    "flores": lambda c_e: 8 * (1 - c_e) / (5 * c_e),
    "hu_guo": lambda c_e: 3 * (1 - c_e) / (2 * c_e),
}


def hysteresis(s: LawInputs, factor: str) -> Any:
    """1 + a δ̇/δ̇⁻, never negative; with the restitution asked for, `restitution`.

    The corner is that of this factor alone: with the elastic force in it, it would be one at every separation.
    """
    import sympy as sp

    a = s.derive("hysteresis", FACTORS[factor](s.parameters["restitution"]), "hysteresis damping factor a")
    return sp.Max(1 + a * s.variables["ratio"], 0)


def normal_force(s: LawInputs, K: Any, factor: str) -> Any:
    """K δⁿ (1 + a δ̇/δ̇⁻), never negative: what every law of Hertz's form with hysteresis damping is."""
    return K * s.variables["delta"] ** s.parameters["exponent"] * hysteresis(s, factor)


def _exp(x: Any) -> Any:
    import sympy as sp

    return sp.exp(x)

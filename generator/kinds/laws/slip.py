"""Friction laws that hang on the slip alone: the parts of c_d(v_t), which is odd, without a corner at v_t = 0."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gudgeon.generator.field import Bound, Field, number
from gudgeon.generator.kinds.laws.law import LawInputs
from gudgeon.language.units import DIMENSIONLESS, VELOCITY

MU = number("mu", "coefficient of friction", DIMENSIONLESS, symbol="c_f", required=True, bounds=(Bound(">=", 0.0),))
MU_S = number(
    "mu_s", "coefficient of static friction", DIMENSIONLESS, symbol="c_s", required=True, bounds=(Bound(">=", "mu"),),
)  # fmt: skip


def slip_of(name: str, meaning: str, symbol: str) -> Field:
    """A slip (m/s) above 0 that a law names."""
    return number(name, meaning, VELOCITY, symbol=symbol, required=True, bounds=(Bound(">", 0.0),))


def both_ways(v_t: Any, forward: Callable[[Any], Any]) -> Any:
    """An odd function of the slip from what it is for u = max(v_t, 0); `forward(0)` is 0."""
    import sympy as sp

    return forward(sp.Max(v_t, 0)) - forward(sp.Max(-v_t, 0))


def friction(s: LawInputs, coefficient: Any) -> dict[str, Any]:
    """F_t (N) on the journal, along t, by an odd coefficient of the slip."""
    return {"F_t": -coefficient * s.variables["F_n"]}

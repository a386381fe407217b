"""Slip velocities that friction may hold at zero: the row that stick adds, and the force of slip.

Stick's row is v = J q̇ − speed = 0 on velocity level: J q̈ = γ − 2α v. The friction force f acts on the
second body along u, so its generalized force is Jᵀ f: −Jᵀ λ in stick, −Jᵀ kinetic sgn v in slip.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.kinds.forces.force_type import Slip
from gudgeon.generator.symbols.symbols import Symbols


@dataclass(frozen=True)
class Friction:
    """One sliding contact; `jacobian` is J by coordinate, `gamma` what J q̈ must be at constant slip."""

    name: str
    slip: Slip
    jacobian: Mapping[sp.Symbol, sp.Expr]
    gamma: sp.Expr


def make_friction(
    name: str, slip: Slip, pairs: Sequence[tuple[sp.Symbol, sp.Symbol]], t: sp.Symbol, symbols: Symbols
) -> Friction:
    """J = ∂v/∂q̇ and γ = −J̇ q̇ + ∂speed/∂t; `pairs` are coordinates with their velocities."""
    jacobian = {q: entry for q, v in pairs if (entry := sp.expand(symbols.diff(slip.v, v))) != 0}
    gamma = -sum((symbols.diff(slip.v, q) * v for q, v in pairs), sp.Integer(0)) - symbols.diff(slip.v, t)
    return Friction(name, slip, jacobian, sp.expand(gamma))

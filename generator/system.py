"""What is integrated: M q̈ + Φ_qᵀ λ = g with Φ(q, t) = 0, in whichever coordinates.

A model's bodies move with the coordinates of a system: a body's (x, y, θ) have a Jacobian J in them, and
r̈ = J q̈ + bias. In absolute coordinates J is the identity and M is diagonal; everything that is derived
from a system (right-hand side, projection, Jacobians) holds for others as well.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.constraints import Row
from gudgeon.generator.friction import Friction
from gudgeon.generator.model import Model

ZERO, ONE = sp.Integer(0), sp.Integer(1)


@dataclass(frozen=True)
class Motion:
    """How (x, y, θ) of a body follow the coordinates: three rows of J (non-zeros by index), three biases."""

    jacobian: tuple[Mapping[int, sp.Expr], ...]
    bias: tuple[sp.Expr, ...]


@dataclass(frozen=True)
class System:
    """Coordinates q with velocities v; `mass` holds the lower triangle's non-zeros (i ≥ j) of M."""

    model: Model
    q: tuple[sp.Symbol, ...]
    v: tuple[sp.Symbol, ...]
    motions: Mapping[str, Motion]  # by body
    mass: Mapping[tuple[int, int], sp.Expr]
    rows: tuple[Row, ...]
    frictions: tuple[Friction, ...]

    def generalized(self, forces: Sequence[sp.Expr]) -> list[sp.Expr]:
        """Generalized forces (n) of the bodies' forces (three a body, in the model's order): Jᵀ (f − m bias)."""
        total = [ZERO] * len(self.q)
        for body in self.model.bodies:
            motion, masses = self.motions[body.name], (body.mass, body.mass, body.inertia)
            for c in range(3):
                force = forces[body.index + c] - masses[c] * motion.bias[c]
                for k, entry in motion.jacobian[c].items():
                    total[k] += entry * force
        return total


def absolute(model: Model) -> System:
    """The system in the model's own coordinates, three a body."""
    motions = {
        body.name: Motion(tuple({body.index + c: ONE} for c in range(3)), (ZERO, ZERO, ZERO)) for body in model.bodies
    }
    mass = {(k, k): m for k, m in enumerate(model.masses)}
    return System(model, model.q, model.v, motions, mass, model.rows, model.frictions)

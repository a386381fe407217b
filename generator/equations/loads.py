"""Applied forces: generalized forces of force elements, and slip velocities that dry friction may hold at zero.

The equation of stick is v = J q̇ − speed = 0 on velocity level: J q̈ = γ − 2α v. The friction force f acts on the
second body along u, so its generalized force is Jᵀ f: −Jᵀ λ at stick, −Jᵀ kinetic sgn v at slip.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import sympy as sp

from gudgeon.generator.equations.fields import ElementFields
from gudgeon.generator.equations.geometry import Geometry, PointFrame
from gudgeon.generator.kinds.forces.force_type import Loads, Slip, find_element_types
from gudgeon.generator.mechanism import ForceElement
from gudgeon.generator.symbols.symbols import Symbols


class PointLoad(NamedTuple):
    """A force in ground axes at a point, and a moment, both on the point's body."""

    point: PointFrame
    x: sp.Expr
    y: sp.Expr
    moment: sp.Expr


@dataclass(frozen=True)
class AppliedElement:
    """A force element with the frames of its points and its equations."""

    element: ForceElement
    targets: tuple[PointFrame, ...]
    loads: Loads

    def list_point_loads(self) -> list[PointLoad]:
        """Return the forces and moments of the element, each with the point at which it acts."""
        loads = self.loads.loads
        return [PointLoad(self.targets[load.target], load.x, load.y, load.moment) for load in loads]

    def add_generalized_forces(self, forces: list[sp.Expr]) -> None:
        """Add the generalized forces Jᵀ f of the element in absolute coordinates to `forces` (n) in place.

        They are F at the centre of mass and the moment arm × F + M; loads on the ground are skipped.
        """
        for load in self.loads.loads:
            point = self.targets[load.target]
            if point.body is not None:
                k = point.body.index
                forces[k] += load.x
                forces[k + 1] += load.y
                forces[k + 2] += point.arm[0] * load.y - point.arm[1] * load.x + load.moment


def make_applied_element(element: ForceElement, geometry: Geometry, t: sp.Symbol) -> AppliedElement:
    """Return a force element with the frames of its points and its loads; `t` is the symbol of time."""
    targets = tuple(geometry.find_point(ref) for ref in element.targets)
    loads = find_element_types()[element.kind].build(targets, ElementFields(element, geometry, t))
    return AppliedElement(element, targets, loads)


@dataclass(frozen=True)
class Friction:
    """One dry friction element; `jacobian` is J by coordinate, `gamma` the value of J q̈ at constant slip."""

    name: str
    slip: Slip
    jacobian: Mapping[sp.Symbol, sp.Expr]
    gamma: sp.Expr


def make_friction(
    name: str, slip: Slip, coordinate_pairs: Sequence[tuple[sp.Symbol, sp.Symbol]], t: sp.Symbol, symbols: Symbols
) -> Friction:
    """Return a dry friction element with J = ∂v/∂q̇ and γ = −J̇ q̇ + ∂speed/∂t, so that J q̈ = γ at constant slip.

    `slip`: its slip velocity v and friction forces; `coordinate_pairs`: the coordinates, each with its velocity.
    """
    jacobian = {q: entry for q, v in coordinate_pairs if (entry := sp.expand(symbols.differentiate(slip.v, v))) != 0}
    gamma = -sum(
        (symbols.differentiate(slip.v, q) * v for q, v in coordinate_pairs), sp.Integer(0)
    ) - symbols.differentiate(slip.v, t)
    return Friction(name, slip, jacobian, sp.expand(gamma))

"""Force elements at work: their loads as generalized forces (virtual work of each load)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import sympy as sp

from gudgeon.generator.equations.fields import ElementFields
from gudgeon.generator.equations.geometry import Geometry, PointFrame
from gudgeon.generator.kinds.forces.force_type import Loads, element_types
from gudgeon.generator.mechanism.mechanism import ForceElement


class PointLoad(NamedTuple):
    """A force (ground axes) at a point, and a moment, on the point's body."""

    point: PointFrame
    x: sp.Expr
    y: sp.Expr
    moment: sp.Expr


@dataclass(frozen=True)
class AppliedElement:
    """An element with its targets' frames and its equations."""

    element: ForceElement
    targets: tuple[PointFrame, ...]
    loads: Loads

    def on_points(self) -> list[PointLoad]:
        """Its loads with the points at which they act."""
        loads = self.loads.loads
        return [PointLoad(self.targets[load.target], load.x, load.y, load.moment) for load in loads]

    def add_to(self, forces: list[sp.Expr]) -> None:
        """Adds to the generalized forces (n): F at the centre of mass, moment arm × F + M."""
        for load in self.loads.loads:
            point = self.targets[load.target]
            if point.body is not None:
                k = point.body.index
                forces[k] += load.x
                forces[k + 1] += load.y
                forces[k + 2] += point.arm[0] * load.y - point.arm[1] * load.x + load.moment


def apply_element(element: ForceElement, geometry: Geometry, t: sp.Symbol) -> AppliedElement:
    """The equations of one element."""
    targets = tuple(geometry.point(ref) for ref in element.targets)
    loads = element_types()[element.kind].build(targets, ElementFields(element, geometry, t))
    return AppliedElement(element, targets, loads)

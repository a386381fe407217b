"""Symbols of joints and their names, as their declarations draw them (generator/kinds/joints)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from gudgeon.drawing.bodies import BLOCK
from gudgeon.drawing.guides import gap_of
from gudgeon.drawing.joint_at import JointAt, has_rail
from gudgeon.drawing.pen import Pen
from gudgeon.drawing.plan import Plan
from gudgeon.drawing.posture import Posture, type_of
from gudgeon.drawing.shapes import Label, Shape


def joints(posture: Posture, plan: Plan) -> Iterator[Shape]:
    """Those of a scene, by kind."""
    for part in posture.parts("joints"):
        pen = Pen(posture, part, plan)
        type_of(part).symbol.draw(pen)
        yield from pen.shapes


def names_of_joints(posture: Posture, plan: Plan, arcs: Mapping[str, float]) -> Iterator[Label]:
    """Beside each, and beside the `arcs` of arrows around it: radii in units by joint."""
    for part in posture.parts("joints"):
        symbol = type_of(part).symbol
        place = symbol.place(JointAt(posture, part))
        clear, way = max(symbol.clear, arcs.get(part.name, 0.0)), 45.0
        if has_rail(part) and part.name in plan.ways:  # beyond the ground, where nothing slides
            x, y = plan.ways[part.name]
            clear, way = BLOCK[1] + 1.2, float(np.degrees(np.arctan2(y, x)))
            clear += gap_of(posture, part, plan.unit) / plan.unit
        yield Label(f"joint {part.name}", "joint", part.name, place, clear * plan.unit, way)

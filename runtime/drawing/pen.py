"""Own `Pen`, which draws symbols of joints: lines, discs, and components that several symbols share."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from gudgeon.drawing.bodies import BLOCK, SLOT, guide_ends
from gudgeon.drawing.joint_at import JointAt, axes_of, gap_of
from gudgeon.drawing.plan import Plan, is_wide
from gudgeon.drawing.posture import GROUND, body_of
from gudgeon.drawing.shapes import Disc, Line, Shape, hatching, rectangle, rounded, turned
from gudgeon.model.compiled import Array

PIN, WORN = 0.46, 0.86  # radii in units: of a pin, of the hole around one that has play
STAND = 2.3  # how far below its pin the ground is


@dataclass(frozen=True, eq=False)
class Pen(JointAt):
    """Drawing functions for one joint: each method adds to `shapes`. Roles are those of roles.py."""

    plan: Plan
    shapes: list[Shape] = field(default_factory=list)

    ROLLER: ClassVar[float] = 0.95  # radius in units
    horizontal: ClassVar[Array] = np.array([1.0, 0.0])

    @property
    def name(self) -> str:
        """Part to which the shapes belong."""
        return f"joint {self.part.name}"

    @property
    def unit(self) -> float:
        """Half a bar's width, m."""
        return self.plan.unit

    @property
    def on_ground(self) -> bool:
        """Whether one of the bodies is the ground."""
        return self.part.name in self.plan.ways

    def axis_of_body(self, k: int) -> Array:
        """Return the x axis of the first (0) or second (1) body, a unit vector."""
        angle = self.posture.theta(self.bodies[k])
        return np.array([np.cos(angle), np.sin(angle)])

    def line(self, role: str, points: Sequence[Array], closed: bool = False, tint: int = 0) -> None:
        """Add a line through points (m)."""
        self.shapes.append(Line(self.name, role, np.array(points), closed, tint))

    def disc(self, role: str, centre: Array, radius: float, tint: int = 0) -> None:
        """Add a circle with a radius in m."""
        self.shapes.append(Disc(self.name, role, centre, radius, tint))

    def box(self, role: str, centre: Array, along: Array, length: float, width: float) -> None:
        """Add a rectangle with half its length and width in units."""
        self.line(role, list(rectangle(centre, along, length * self.unit, width * self.unit)), True)

    def pin(self, place: Array, size: float = 1.0) -> None:
        """Add a pin with a size as a fraction of the usual one."""
        self.disc("pin", place, size * PIN * self.unit)

    def stand(self) -> None:
        """Add the triangle and the ground under a point on the ground; nothing if neither body is the ground."""
        for end in self.part.ends if self.on_ground else ():
            if body_of(end) == GROUND:
                place, way = self.posture.place(end), self.plan.ways[self.part.name]
                self.shapes.extend(_draw_stand(self.name, place, way, self.unit))

    def wall(self, place: Array) -> None:
        """Add the ground at a fixed point; nothing if neither body is the ground."""
        if self.on_ground:
            self.shapes.extend(ground_wall(self.name, place, self.plan.ways[self.part.name], self.unit, 2.0))

    def bearing(self) -> None:
        """Add the stand of a pin; with play also the hole around it, to scale if that is wide."""
        posture, name = self.posture, self.part.name
        has_play = name in posture.clearances
        if has_play and is_wide(posture, name, self.unit):
            self.disc("clearance", self.first, float(posture.p[posture.clearances[name].clearance]))
            return
        self.stand()
        if has_play:
            self.disc("worn", self.first, WORN * self.unit)

    def rail(self, below: float, side: float = 1.0) -> None:
        """Add the ground under a slider over its travel, at a distance `below` from the line (m), hatched.

        With `side` −1 the ground is above.
        """
        on, along, name = self.on_line, self.along, self.part.name
        if name in self.posture.guides:
            along = axes_of(self.posture, self.part)[0]
        low, high = self.plan.travel[name]
        more, way = (2.0 * BLOCK[0] + 0.4) * self.unit * along, side * self.plan.ways[name]
        a, b = on + low * along - more + below * way, on + high * along + more + below * way
        self.line("rail", [a, b])
        for stroke in hatching(a, b, way, 0.95 * self.unit):
            self.line("hatch", list(stroke))

    def guide(self) -> None:
        """Add the guide of a block: the ground's rails, or the axis of the guiding body, which the block hides."""
        if not self.on_ground:
            self.line("axis", guide_ends(self.posture, self.plan, self.part))
            return
        gap = gap_of(self.posture, self.part, self.unit)
        for side in (1.0, -1.0) if gap else (1.0,):
            self.rail(BLOCK[1] * self.unit + gap, side)

    def slot(self) -> None:
        """Add the slot in the guiding body, as long as the travel."""
        self.line("slot", list(rounded(guide_ends(self.posture, self.plan, self.part), SLOT * self.unit)), True)

    def wheel(self, k: int, centre: Array, radius: float, is_ring: bool = False) -> None:
        """Add a wheel of the first (0) or second (1) body: its pitch circle (m) with a spoke, or a ring with its
        rim.
        """
        body, order = self.bodies[k], list(self.posture.bodies)
        tint = order.index(body) if body in order else 0
        if is_ring:
            self.disc("rim", centre, radius + 1.2 * self.unit, tint)
        self.disc("ring" if is_ring else "wheel", centre, radius, tint)
        spoke, reach = self.axis_of_body(k), (radius, radius + 1.2 * self.unit) if is_ring else (0.0, radius)
        self.line("spoke", [centre + r * spoke for r in reach], tint=tint)


def ground_wall(part: str, place: Array, into: Array, u: float, half: float = 1.5) -> Iterator[Shape]:
    """Yield a hatched line through a point that is fixed to the ground."""
    a, b = place - half * u * turned(into), place + half * u * turned(into)
    yield Line(part, "rail", np.array([a, b]))
    yield from (Line(part, "hatch", stroke) for stroke in hatching(a, b, into, 0.95 * u))


def _draw_stand(part: str, place: Array, direction: Array, u: float) -> Iterator[Shape]:
    """Yield the triangle and the ground under a pin."""
    foot, across = place + STAND * u * direction, turned(direction)
    yield Line(part, "stand", np.array([place, foot - 1.25 * u * across, foot + 1.25 * u * across]), True)
    yield from ground_wall(part, foot, direction, u, 1.9)

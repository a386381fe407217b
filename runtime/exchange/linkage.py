"""A linkage as other programs have it: points, and bodies that hold some of them at fixed distances."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

Point = tuple[float, float]
MEASURED = 1e-9  # of a length: nearer two points are one


@dataclass
class Body:
    """Where it holds its points (in a frame of its own), in their order; what is not said is None.

    `com` in that frame; `turns`: whether it may turn (a piston does not).
    """

    name: str
    local: dict[str, Point]
    mass: float | None = None
    inertia: float | None = None
    com: Point | None = None
    turns: bool = True

    def placed(self, first: str, second: str, distance: float, angle: float) -> Point:
        """The point at a distance from the first, turned by an angle from the direction to the second."""
        (x, y), (u, v) = self.local[first], self.local[second]
        along = math.atan2(v - y, u - x) + angle
        return x + distance * math.cos(along), y + distance * math.sin(along)


@dataclass
class Line:
    """A point that keeps to a line through another one, in a direction of that one's body, or of the ground (None)."""

    point: str
    through: str
    body: str | None
    direction: Point


@dataclass
class Drive:
    """A body that turns about a point: its rate (rad/s), counter-clockwise."""

    body: str
    about: str
    rate: float


@dataclass
class Linkage:
    """All of it; lengths in `unit`, masses in kg. `notes`: what the file does not say, or what was made of it."""

    name: str
    unit: str = "m"
    positions: dict[str, Point] = field(default_factory=dict)  # in ground axes, as far as they are known
    ground: dict[str, Point] = field(default_factory=dict)
    bodies: list[Body] = field(default_factory=list)
    lines: list[Line] = field(default_factory=list)
    drives: list[Drive] = field(default_factory=list)
    gravity: Point | None = None
    measured: bool = False  # the file says the unit
    notes: list[str] = field(default_factory=list)

    def holding(self, *points: str) -> Body | None:
        """The first body that holds all of these points."""
        return next((body for body in self.bodies if all(point in body.local for point in points)), None)

    def bar(self, first: str, second: str, length: float) -> None:
        """A body of two points, or nothing where one holds both already, or the ground does."""
        if self.holding(first, second) is None and not (first in self.ground and second in self.ground):
            self.bodies.append(Body(f"{first}_{second}", {first: (0.0, 0.0), second: (length, 0.0)}))

"""A linkage as other programs have it: points, and bodies that hold some of them at fixed distances."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from gudgeon.errors import InputError

Point = tuple[float, float]
MAX_NUMBER = 1e12  # of whatever a file says: no length, mass or speed of a linkage is larger


@dataclass(eq=False)
class Body:
    """Where it holds its points (in a frame of its own), in their order; what is not said is None.

    `com` in that frame.
    """

    name: str
    local: dict[str, Point]
    mass: float | None = None
    inertia: float | None = None
    com: Point | None = None

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
    body: Body | None
    direction: Point


@dataclass
class Drive:
    """A body that turns: its rate (rad/s), counter-clockwise, relative to a body, or to the ground (None).

    arc: the angles (rad) between which it goes to and fro; None: it turns on.
    """

    body: Body
    rate: float
    relative_to: Body | None = None
    arc: tuple[float, float] | None = None


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
    holders: dict[str, list[Body]] = field(default_factory=dict)  # of each point; `add` and `hold` write it

    def add(self, body: Body) -> Body:
        """Add a body. Raises InputError unless it holds two points at least, the first two apart."""
        if len(body.local) < 2:
            raise InputError(f"link {body.name}: it holds {len(body.local)} joints, expected two at least")
        (x, y), (u, v) = list(body.local.values())[:2]
        if not math.hypot(u - x, v - y) > 0.0:
            raise InputError(f"link {body.name}: its first two joints are at one place")
        self.bodies.append(body)
        for point in body.local:
            self.holders.setdefault(point, []).append(body)
        return body

    def hold(self, body: Body, point: str, place: Point) -> None:
        """A body holds one more point."""
        if point not in body.local:
            self.holders.setdefault(point, []).append(body)
        body.local[point] = place

    def holding(self, *points: str) -> Body | None:
        """The first body that holds all of these points."""
        fewest = min((self.holders.get(point, []) for point in points), key=len)
        return next((body for body in fewest if all(point in body.local for point in points)), None)

    def bar(self, first: str, second: str, length: float) -> Body | None:
        """The body that holds both points, a new bar where none does; None where the ground holds both."""
        if first in self.ground and second in self.ground:
            return None
        if body := self.holding(first, second):
            return body
        return self.add(Body(f"{first}_{second}", {first: (0.0, 0.0), second: (length, 0.0)}))

    def points(self) -> Iterator[str]:
        """Every point, once."""
        yield from dict.fromkeys([*self.positions, *self.ground, *self.holders])

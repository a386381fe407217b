"""Describe a linkage as other programs do: points, and bodies that contain some of them at fixed distances."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from gudgeon.errors import InputError

Point = tuple[float, float]
MAX_NUMBER = 1e12  # largest length, mass or speed that a file may contain


@dataclass(eq=False)
class Body:
    """Points of a rigid body in its own frame, in order, with mass, inertia and centre of mass.

    com: centre of mass in that frame. None: the file does not specify the value.
    """

    name: str
    point_positions: dict[str, Point]
    mass: float | None = None
    inertia: float | None = None
    com: Point | None = None

    def compute_position(self, first_point: str, second_point: str, distance: float, angle: float) -> Point:
        """Return the position at `distance` from the first point, at `angle` (rad) from the direction to the second.

        Both points are of this body; positions are in its own frame.
        """
        (x_first, y_first), (x_second, y_second) = self.point_positions[first_point], self.point_positions[second_point]
        direction = math.atan2(y_second - y_first, x_second - x_first) + angle
        return x_first + distance * math.cos(direction), y_first + distance * math.sin(direction)


@dataclass
class Line:
    """A point that stays on a line through another point; the direction is in the frame of the body (None: the
    ground)."""

    point: str
    through: str
    body: Body | None
    direction: Point


@dataclass
class Drive:
    """A body with a prescribed rate (rad/s, counter-clockwise) relative to another body or to the ground (None).

    arc: angles (rad) between which it oscillates; None: it rotates.
    """

    body: Body
    rate: float
    relative_to: Body | None = None
    arc: tuple[float, float] | None = None


@dataclass
class Linkage:
    """A linkage with lengths in `unit` and masses in kg; `notes` list what the file does not specify or what was
    assumed.
    """

    name: str
    unit: str = "m"
    positions: dict[str, Point] = field(default_factory=dict)  # in ground axes, as far as they are known
    ground: dict[str, Point] = field(default_factory=dict)
    bodies: list[Body] = field(default_factory=list)
    lines: list[Line] = field(default_factory=list)
    drives: list[Drive] = field(default_factory=list)
    gravity: Point | None = None
    has_unit: bool = False  # whether the file specifies the unit
    notes: list[str] = field(default_factory=list)
    bodies_by_point: dict[str, list[Body]] = field(default_factory=dict)  # updated by `add_body` and `add_point`

    def add_body(self, body: Body) -> Body:
        """Add a body, list it under each of its points, and return it.

        Raises InputError if it has fewer than two points, or if the first two coincide.
        """
        if len(body.point_positions) < 2:
            raise InputError(f"link {body.name}: it has {len(body.point_positions)} joints, expected at least two")
        (x_first, y_first), (x_second, y_second) = list(body.point_positions.values())[:2]
        if not math.hypot(x_second - x_first, y_second - y_first) > 0.0:
            raise InputError(f"link {body.name}: its first two joints coincide")
        self.bodies.append(body)
        for point in body.point_positions:
            self.bodies_by_point.setdefault(point, []).append(body)
        return body

    def add_point(self, body: Body, point: str, position: Point) -> None:
        """Add a point to a body at a position in the body's frame; if the body has the point already, move it."""
        if point not in body.point_positions:
            self.bodies_by_point.setdefault(point, []).append(body)
        body.point_positions[point] = position

    def find_body(self, *points: str) -> Body | None:
        """Return the first body that contains all of these points, or None."""
        candidates = min((self.bodies_by_point.get(point, []) for point in points), key=len)
        return next((body for body in candidates if all(point in body.point_positions for point in points)), None)

    def find_or_add_bar(self, first_point: str, second_point: str, length: float) -> Body | None:
        """Return the first body that contains both points, or else add a bar of this length and return it.

        Returns None if both are points of the ground.
        """
        if first_point in self.ground and second_point in self.ground:
            return None
        if body := self.find_body(first_point, second_point):
            return body
        return self.add_body(
            Body(f"{first_point}_{second_point}", {first_point: (0.0, 0.0), second_point: (length, 0.0)})
        )

    def iterate_points(self) -> Iterator[str]:
        """Yield the name of every point once."""
        yield from dict.fromkeys([*self.positions, *self.ground, *self.bodies_by_point])

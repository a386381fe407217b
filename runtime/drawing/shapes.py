"""Own the shapes of a drawing, in metres and ground axes, and the plane geometry for symbols."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np

from gudgeon.model.compiled import Array


@dataclass(frozen=True, eq=False)
class Line:
    """A polyline through points (N, 2); `part` is its owner ("joint A"), `role` its style (roles.py)."""

    part: str
    role: str
    points: Array
    closed: bool = False
    tint: int = 0  # of a body: which of the colours


@dataclass(frozen=True, eq=False)
class Disc:
    """A filled circle; `part` is its owner, `role` its style (roles.py)."""

    part: str
    role: str
    centre: Array
    radius: float
    tint: int = 0


@dataclass(frozen=True, eq=False)
class Label:
    """A text at a distance `clear` (m) from a place (2,), in the direction `way` (degrees) if there is room."""

    part: str
    role: str
    text: str
    place: Array
    clear: float = 0.0
    way: float = 45.0


Shape: TypeAlias = Line | Disc


@dataclass(frozen=True, eq=False)
class Sketch:
    """A drawing: shapes in the order of painting, names to place, and the box (m) that contains all."""

    shapes: tuple[Shape, ...]
    labels: tuple[Label, ...]
    low: Array
    high: Array
    unit: float  # m: half the width of a bar, by which all symbols are measured
    notes: tuple[str, ...] = field(default=())  # scales of arrows and insets

    def of(self, part: str) -> list[Shape]:
        """Return the shapes of one part."""
        return [shape for shape in self.shapes if shape.part == part]


def turned(vector: Array) -> Array:
    """Return a vector rotated by +90°."""
    return np.array([-vector[1], vector[0]])


def unit_vector(vector: Array, otherwise: tuple[float, float] = (1.0, 0.0)) -> Array:
    """Return the direction of a vector; `otherwise` for a zero vector."""
    size = float(np.hypot(*vector))
    return vector / size if size > 0.0 else np.array(otherwise)


def arc(centre: Array, radius: float, begin: float, end: float, count: int = 25) -> Array:
    """Return points of an arc, angles in rad."""
    angle = np.linspace(begin, end, count)
    return centre + radius * np.column_stack([np.cos(angle), np.sin(angle)])


def hull(points: Sequence[Array]) -> Array:
    """Return the corners of the convex hull, counterclockwise (Andrew's monotone chain), from the first of the points
    on.
    """
    ordered = sorted({(float(x), float(y)) for x, y in points})
    if len(ordered) < 3:
        return np.array(list(dict.fromkeys((float(x), float(y)) for x, y in points)))
    size = max(abs(x) for pair in (ordered[0], ordered[-1]) for x in pair) + 1e-300

    def half(these: Iterable[tuple[float, float]]) -> list[tuple[float, float]]:
        """Return the lower or upper chain of the hull."""
        chain: list[tuple[float, float]] = []
        for x, y in these:
            while len(chain) > 1:
                (ax, ay), (bx, by) = chain[-2:]
                if (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 1e-12 * size * size:
                    break
                chain.pop()
            chain.append((x, y))
        return chain[:-1]

    corners = [*half(ordered), *half(reversed(ordered))]
    first = next((corners.index(at) for at in ((float(x), float(y)) for x, y in points) if at in corners), 0)
    return np.array(corners[first:] + corners[:first])


def rounded(points: Sequence[Array], radius: float) -> Array:
    """Return the hull of discs about the points: for two a link, for more a plate with round corners."""
    corners = hull(points)
    if len(corners) == 1:
        return arc(corners[0], radius, 0.0, 2.0 * np.pi, 37)[:-1]
    edges = np.roll(corners, -1, axis=0) - corners
    normals = np.arctan2(-edges[:, 0], edges[:, 1])  # outwards, of the edge that leaves each corner
    outline, count = [], 3 + round(12.0 * np.pi / len(corners))  # of each corner: the same for every shape of a plate
    for k, corner in enumerate(corners):
        begin = float(normals[k - 1])
        turn = float((normals[k] - begin) % (2.0 * np.pi))
        outline.append(arc(corner, radius, begin, begin + turn, count))
    return np.concatenate(outline)


def rectangle(centre: Array, along: Array, length: float, width: float) -> Array:
    """Return the corners of a rectangle; `along` is a unit vector, the sizes are halves."""
    a, b = length * along, width * turned(along)
    return np.array([centre - a - b, centre + a - b, centre + a + b, centre - a + b])


def hatching(a: Array, b: Array, into: Array, length: float) -> list[Array]:
    """Return short oblique strokes from a line to the side `into`, the symbol of the ground."""
    span = b - a
    along = unit_vector(span)
    reach = float(np.hypot(*span))
    count = max(2, round(reach / (0.62 * length)))
    lean = 0.75 * length * (into - along)
    first = min(0.12, 0.75 * length / max(reach, 1e-300))  # as far as the first one leans
    return [np.array([foot, foot + lean]) for foot in a + np.linspace(first, 1.0, count)[:, None] * span]


def zigzag(a: Array, b: Array, height: float, teeth: int = 6, ends: float = 0.2) -> Array:
    """Return the polyline of a spring; `ends` is the fraction of straight wire at either end."""
    across = turned(unit_vector(b - a)) * height
    shares = np.linspace(ends, 1.0 - ends, 2 * teeth + 2)
    sides = np.array([0.0, *([1.0, -1.0] * teeth), 0.0])
    body = a + shares[:, None] * (b - a) + sides[:, None] * across
    return np.vstack([a, body, b])


def arrow_head(tip: Array, along: Array, size: float) -> Array:
    """Return a slender triangle with its tip in the direction `along`."""
    side = 0.38 * size * turned(along)
    return np.array([tip, tip - size * along + side, tip - size * along - side])


def box_of(shapes: Iterable[Shape]) -> tuple[Array, Array]:
    """Return the low and high corner of the box of all shapes."""
    lows, highs = [], []
    for shape in shapes:
        if isinstance(shape, Disc):
            lows.append(shape.centre - shape.radius)
            highs.append(shape.centre + shape.radius)
        else:
            lows.append(shape.points.min(axis=0))
            highs.append(shape.points.max(axis=0))
    return np.min(lows, axis=0), np.max(highs, axis=0)

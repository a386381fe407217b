"""Define the shapes of a drawing, in metres and ground axes, and the plane geometry for symbols."""

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
    colour_index: int = 0  # index of the body's colour


@dataclass(frozen=True, eq=False)
class Disc:
    """A filled circle; `part` is its owner, `role` its style (roles.py)."""

    part: str
    role: str
    centre: Array
    radius: float
    colour_index: int = 0


@dataclass(frozen=True, eq=False)
class Label:
    """A text at a distance `clearance` (m) from `position` (2,), in the direction `direction` (degrees) if it fits."""

    part: str
    role: str
    text: str
    position: Array
    clearance: float = 0.0
    direction: float = 45.0


Shape: TypeAlias = Line | Disc


@dataclass(frozen=True, eq=False)
class Sketch:
    """A drawing: shapes in the order of painting, names to place, and the box (m) that contains all."""

    shapes: tuple[Shape, ...]
    labels: tuple[Label, ...]
    low: Array
    high: Array
    unit: float  # m: half the width of a bar, the unit of all symbols
    notes: tuple[str, ...] = field(default=())  # scales of arrows and insets

    def of(self, part: str) -> list[Shape]:
        """Return the shapes of one part."""
        return [shape for shape in self.shapes if shape.part == part]


def rotate_quarter_turn(vector: Array) -> Array:
    """Return a vector rotated by +90°."""
    return np.array([-vector[1], vector[0]])


def unit_vector(vector: Array, otherwise: tuple[float, float] = (1.0, 0.0)) -> Array:
    """Return the direction of a vector; `otherwise` for a zero vector."""
    size = float(np.hypot(*vector))
    return vector / size if size > 0.0 else np.array(otherwise)


def compute_arc(centre: Array, radius: float, begin: float, end: float, count: int = 25) -> Array:
    """Return `count` points (count, 2) of an arc from angle `begin` to `end` (rad), ends included."""
    angle = np.linspace(begin, end, count)
    return centre + radius * np.column_stack([np.cos(angle), np.sin(angle)])


def compute_convex_hull(points: Sequence[Array]) -> Array:
    """Return the corners of the convex hull (N, 2), counterclockwise, by Andrew's monotone chain.

    The list begins with the first of `points` that is a corner. Fewer than three different points are returned as they
    are.
    """
    sorted_points = sorted({(float(x), float(y)) for x, y in points})
    if len(sorted_points) < 3:
        return np.array(list(dict.fromkeys((float(x), float(y)) for x, y in points)))
    size = max(abs(x) for point in (sorted_points[0], sorted_points[-1]) for x in point) + 1e-300

    def build_half_hull(points_in_order: Iterable[tuple[float, float]]) -> list[tuple[float, float]]:
        """Return the lower or upper chain of the hull without its last point, for points sorted by x, ascending or
        descending.
        """
        chain: list[tuple[float, float]] = []
        for x, y in points_in_order:
            while len(chain) > 1:
                (x0, y0), (x1, y1) = chain[-2:]
                if (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) > 1e-12 * size * size:
                    break
                chain.pop()
            chain.append((x, y))
        return chain[:-1]

    corners = [*build_half_hull(sorted_points), *build_half_hull(reversed(sorted_points))]
    first = next(
        (corners.index(corner) for corner in ((float(x), float(y)) for x, y in points) if corner in corners), 0
    )
    return np.array(corners[first:] + corners[:first])


def compute_rounded_outline(points: Sequence[Array], radius: float) -> Array:
    """Return the outline (N, 2) of the convex hull of discs around points, all with one radius in m.

    It is a circle for one point, a bar with round ends for two, and a plate with round corners for more.
    """
    corners = compute_convex_hull(points)
    if len(corners) == 1:
        return compute_arc(corners[0], radius, 0.0, 2.0 * np.pi, 37)[:-1]
    edges = np.roll(corners, -1, axis=0) - corners
    normals = np.arctan2(-edges[:, 0], edges[:, 1])  # outwards, of the edge that leaves each corner
    outline, n_points = (
        [],
        3 + round(12.0 * np.pi / len(corners)),
    )  # of each corner: the same for every shape of a plate
    for k, corner in enumerate(corners):
        start_angle = float(normals[k - 1])
        angle = float((normals[k] - start_angle) % (2.0 * np.pi))
        outline.append(compute_arc(corner, radius, start_angle, start_angle + angle, n_points))
    return np.concatenate(outline)


def compute_rectangle(centre: Array, axis: Array, half_length: float, half_width: float) -> Array:
    """Return the corners (4, 2) of a rectangle with its length along the unit vector `axis`; sizes are in m."""
    half_length_vector, half_width_vector = half_length * axis, half_width * rotate_quarter_turn(axis)
    return np.array(
        [
            centre - half_length_vector - half_width_vector,
            centre + half_length_vector - half_width_vector,
            centre + half_length_vector + half_width_vector,
            centre - half_length_vector + half_width_vector,
        ]
    )


def compute_hatching(begin: Array, end: Array, direction: Array, length: float) -> list[Array]:
    """Return short oblique strokes, each (2, 2), along the line from `begin` to `end`: the symbol of the ground.

    They lie on the side of the unit vector `direction`. `length` (m) sets their size and spacing; there are at least
    two.
    """
    span = end - begin
    tangent = unit_vector(span)
    line_length = float(np.hypot(*span))
    count = max(2, round(line_length / (0.62 * length)))
    stroke_vector = 0.75 * length * (direction - tangent)
    first_fraction = min(0.12, 0.75 * length / max(line_length, 1e-300))  # the first stroke ends above `begin`
    return [
        np.array([start, start + stroke_vector])
        for start in begin + np.linspace(first_fraction, 1.0, count)[:, None] * span
    ]


def compute_zigzag(begin: Array, end: Array, height: float, teeth: int = 6, straight_fraction: float = 0.2) -> Array:
    """Return the polyline (N, 2) of a spring between two points.

    `height` is the amplitude in m, `teeth` the number of periods, `straight_fraction` the fraction of straight wire at
    each end.
    """
    amplitude_vector = rotate_quarter_turn(unit_vector(end - begin)) * height
    fractions = np.linspace(straight_fraction, 1.0 - straight_fraction, 2 * teeth + 2)
    offsets = np.array([0.0, *([1.0, -1.0] * teeth), 0.0])
    zigzag_points = begin + fractions[:, None] * (end - begin) + offsets[:, None] * amplitude_vector
    return np.vstack([begin, zigzag_points, end])


def compute_arrow_head(tip: Array, direction: Array, size: float) -> Array:
    """Return the corners (3, 2) of a slender triangle with its tip at `tip`, in the unit vector `direction`; `size` is
    its length in m.
    """
    half_width_vector = 0.38 * size * rotate_quarter_turn(direction)
    return np.array([tip, tip - size * direction + half_width_vector, tip - size * direction - half_width_vector])


def compute_bounding_box(shapes: Iterable[Shape]) -> tuple[Array, Array]:
    """Return the lower left and upper right corner of the box that contains all shapes, (2,) each, in m.

    Raises ValueError without shapes.
    """
    lows, highs = [], []
    for shape in shapes:
        if isinstance(shape, Disc):
            lows.append(shape.centre - shape.radius)
            highs.append(shape.centre + shape.radius)
        else:
            lows.append(shape.points.min(axis=0))
            highs.append(shape.points.max(axis=0))
    return np.min(lows, axis=0), np.max(highs, axis=0)

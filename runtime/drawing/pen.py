"""Define `Pen`, which draws symbols of joints: lines, discs, and components that several symbols share."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from gudgeon.drawing.bodies import BLOCK_HALF_SIZE, SLOT_HALF_WIDTH, compute_guide_ends
from gudgeon.drawing.configuration import GROUND, get_body_name
from gudgeon.drawing.joint_geometry import JointGeometry, compute_guide_directions, compute_wall_gap
from gudgeon.drawing.layout import Layout, is_visible_to_scale
from gudgeon.drawing.shapes import (
    Disc,
    Line,
    Shape,
    compute_hatching,
    compute_rectangle,
    compute_rounded_outline,
    rotate_quarter_turn,
)
from gudgeon.model.compiled import Array

PIN_RADIUS, PLAY_HOLE_RADIUS = 0.46, 0.86  # units: of a pin, of the hole around a pin with play
SUPPORT_HEIGHT = 2.3  # units, distance of the ground from the pin of a fixed support


@dataclass(frozen=True, eq=False)
class Pen(JointGeometry):
    """Drawing functions for the symbol of one joint: each method adds to `shapes`. Roles are those of roles.py."""

    layout: Layout
    shapes: list[Shape] = field(default_factory=list)

    ROLLER: ClassVar[float] = 0.95  # radius in units
    horizontal: ClassVar[Array] = np.array([1.0, 0.0])

    @property
    def name(self) -> str:
        """Return the name of the part to which the shapes belong, such as "joint A"."""
        return f"joint {self.part.name}"

    @property
    def unit(self) -> float:
        """Return half a bar's width, m."""
        return self.layout.unit

    @property
    def is_on_ground(self) -> bool:
        """Return whether one of the bodies is the ground."""
        return self.part.name in self.layout.ground_directions

    def compute_body_axis(self, k: int) -> Array:
        """Return the x axis of the first (0) or second (1) body, a unit vector."""
        angle = self.configuration.get_angle(self.bodies[k])
        return np.array([np.cos(angle), np.sin(angle)])

    def add_line(self, role: str, points: Sequence[Array], closed: bool = False, colour_index: int = 0) -> None:
        """Add a line through points (m)."""
        self.shapes.append(Line(self.name, role, np.array(points), closed, colour_index))

    def add_disc(self, role: str, centre: Array, radius: float, colour_index: int = 0) -> None:
        """Add a circle with a radius in m."""
        self.shapes.append(Disc(self.name, role, centre, radius, colour_index))

    def add_box(self, role: str, centre: Array, axis: Array, length: float, width: float) -> None:
        """Add a rectangle with half its length, along the unit vector `axis`, and half its width in units."""
        self.add_line(role, list(compute_rectangle(centre, axis, length * self.unit, width * self.unit)), True)

    def add_pin(self, position: Array, size: float = 1.0) -> None:
        """Add a pin; `size` is a fraction of the usual size."""
        self.add_disc("pin", position, size * PIN_RADIUS * self.unit)

    def add_fixed_support(self) -> None:
        """Add the symbol of a fixed support (triangle and hatched ground) under each end of the joint on the ground.

        Nothing is added if neither body is the ground.
        """
        for end in self.part.ends if self.is_on_ground else ():
            if get_body_name(end) == GROUND:
                position, direction = (
                    self.configuration.get_position(end),
                    self.layout.ground_directions[self.part.name],
                )
                self.shapes.extend(_draw_fixed_support(self.name, position, direction, self.unit))

    def add_wall(self, position: Array) -> None:
        """Add the ground at a fixed point; nothing if neither body is the ground."""
        if self.is_on_ground:
            self.shapes.extend(
                draw_ground_wall(self.name, position, self.layout.ground_directions[self.part.name], self.unit, 2.0)
            )

    def add_bearing(self) -> None:
        """Add the fixed support of a pin on the ground, and for a joint with play the hole around its first point.

        A clearance that is visible to scale is drawn as a circle of its radius instead, without a support.
        """
        configuration, name = self.configuration, self.part.name
        has_play = name in configuration.clearances
        if has_play and is_visible_to_scale(configuration, name, self.unit):
            self.add_disc("clearance", self.first, float(configuration.p[configuration.clearances[name].clearance]))
            return
        self.add_fixed_support()
        if has_play:
            self.add_disc("worn", self.first, PLAY_HOLE_RADIUS * self.unit)

    def add_rail(self, distance: float, side_sign: float = 1.0) -> None:
        """Add a rail with hatching along the whole travel of a slider, parallel to its line.

        `distance` is that of the rail from the line in m. The rail is on the side of the ground; with `side_sign` −1 it
        is on the other side. In a guide with play it has the guide's direction.
        """
        line_point, axis, name = self.on_line, self.along, self.part.name
        if name in self.configuration.guides:
            axis = compute_guide_directions(self.configuration, self.part)[0]
        min_travel, max_travel = self.layout.travel[name]
        overhang, ground_direction = (
            (2.0 * BLOCK_HALF_SIZE[0] + 0.4) * self.unit * axis,
            side_sign * self.layout.ground_directions[name],
        )
        begin, end = (
            line_point + min_travel * axis - overhang + distance * ground_direction,
            line_point + max_travel * axis + overhang + distance * ground_direction,
        )
        self.add_line("rail", [begin, end])
        for stroke in compute_hatching(begin, end, ground_direction, 0.95 * self.unit):
            self.add_line("hatch", list(stroke))

    def add_guide(self) -> None:
        """Add the guide of a block: rails of the ground, or the axis line of the guiding body.

        Rails are on one side without play, on both sides with play. The axis line lies under the block.
        """
        if not self.is_on_ground:
            self.add_line("axis", compute_guide_ends(self.configuration, self.layout, self.part))
            return
        wall_gap = compute_wall_gap(self.configuration, self.part, self.unit)
        for sign in (1.0, -1.0) if wall_gap else (1.0,):
            self.add_rail(BLOCK_HALF_SIZE[1] * self.unit + wall_gap, sign)

    def add_slot(self) -> None:
        """Add the slot of a pin-in-slot joint in the guiding body, as long as the slider's travel."""
        self.add_line(
            "slot",
            list(
                compute_rounded_outline(
                    compute_guide_ends(self.configuration, self.layout, self.part), SLOT_HALF_WIDTH * self.unit
                )
            ),
            True,
        )

    def add_wheel(self, k: int, centre: Array, radius: float, is_ring: bool = False) -> None:
        """Add a wheel of the first (0) or second (1) body: its pitch circle and a spoke that shows its rotation.

        `radius` is in m. With `is_ring` the wheel has teeth inside: a rim is added outside, and the spoke lies in the
        rim.
        """
        body, names = self.bodies[k], list(self.configuration.bodies)
        colour_index = names.index(body) if body in names else 0
        if is_ring:
            self.add_disc("rim", centre, radius + 1.2 * self.unit, colour_index)
        self.add_disc("ring" if is_ring else "wheel", centre, radius, colour_index)
        direction, spoke_radii = (
            self.compute_body_axis(k),
            (radius, radius + 1.2 * self.unit) if is_ring else (0.0, radius),
        )
        self.add_line("spoke", [centre + r * direction for r in spoke_radii], colour_index=colour_index)


def draw_ground_wall(
    part: str, position: Array, ground_direction: Array, unit: float, half_length: float = 1.5
) -> Iterator[Shape]:
    """Yield a hatched line through a point that is fixed to the ground.

    `part` owns the shapes, `ground_direction` is a unit vector, `unit` is half a bar's width in m, `half_length` is in
    units.
    """
    begin, end = (
        position - half_length * unit * rotate_quarter_turn(ground_direction),
        position + half_length * unit * rotate_quarter_turn(ground_direction),
    )
    yield Line(part, "rail", np.array([begin, end]))
    yield from (Line(part, "hatch", stroke) for stroke in compute_hatching(begin, end, ground_direction, 0.95 * unit))


def _draw_fixed_support(part: str, pin: Array, direction: Array, unit: float) -> Iterator[Shape]:
    """Yield the symbol of a fixed support (ground pivot): a triangle from a pin to the ground, and hatching under it.

    `direction` is the unit vector from the pin to the ground, `unit` half a bar's width in m.
    """
    ground_point, tangent = pin + SUPPORT_HEIGHT * unit * direction, rotate_quarter_turn(direction)
    yield Line(
        part, "stand", np.array([pin, ground_point - 1.25 * unit * tangent, ground_point + 1.25 * unit * tangent]), True
    )
    yield from draw_ground_wall(part, ground_point, direction, unit, 1.9)

"""Defines the interface of a joint type: its keys, its constraint equations and its symbol in drawings.

Each other file of this folder is one joint type and exports `JOINT`.

As with laws, nothing here imports SymPy at the top: the reader needs only the YAML fields.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from gudgeon.generator.field import BODY, Field
from gudgeon.generator.kinds import iterate_declarations

# Corners of a slider with play: front (1) or rear along the axis; at the wall to the left of the axis (1) or the right.
CORNERS: Mapping[str, tuple[int, int]] = {
    "front_upper": (1, 1),
    "front_lower": (1, -1),
    "rear_upper": (-1, 1),
    "rear_lower": (-1, -1),
}


def draw_squares(pen: Any) -> None:
    """Draw a small square at each point: the symbol of a joint type that declares no other one."""
    for point in (pen.first, pen.second):
        pen.add_box("block", point, pen.horizontal, 0.5, 0.5)


def find_second_point(joint: Any) -> Any:
    """Return the second body's point, where a joint's name stands in drawings."""
    return joint.second


def find_sliding_point(joint: Any) -> Any:
    """Return the sliding point of a joint that declares `slides`, where its name stands in drawings."""
    return joint.slider


def find_closure_error_between_points(joint: Any, residuals: Any) -> Any:
    """Return the two points of a joint that holds them together: the ends of its closure error where it is open."""
    return joint.first, joint.second


def find_closure_error_to_line(joint: Any, residuals: Any) -> Any:
    """Return the sliding point and the nearest point of its line: the ends of the closure error of an open joint."""
    return joint.slider, joint.on_line + float((joint.slider - joint.on_line) @ joint.along) * joint.along


@dataclass(frozen=True)
class Symbol:
    """Declare how drawings show a joint. Positions are arrays (2,) in ground axes, m.

    The functions get the joint at a configuration, a JointAt (runtime/drawing/joint_geometry.py); `draw` gets a Pen
    (runtime/drawing/pen.py), which is a JointAt with primitives to draw by.
    """

    draw: Callable[[Any], None] = draw_squares
    find_name_position: Callable[[Any], Any] = find_second_point  # where the joint's name stands
    name_distance: float = 0.8  # distance of the name from there, in units of half a bar's width
    # find_closure_error(joint, residuals): the two points between which it is open where a start does not close; their
    # distance is the number next to it. None: no line shows the gap, and the numbers are the residuals of its rows
    find_closure_error: Callable[[Any, Any], Any] | None = None
    find_radii: Callable[[Any], tuple[float, float]] | None = None  # radii (m) about both points that are drawn


@dataclass(frozen=True)
class Slide:
    """Declare the line on which one body slides: the field of its direction, and its body, "first" or "second"."""

    direction: str
    guide: str


@dataclass(frozen=True)
class JointType:
    """Declare a joint type: the YAML key `kind: [first.point, second.point]`, its fields and constraint equations.

    `rows(first, second, fields)` gets two PointFrames (generator/equations/geometry.py) and the JointFields
    (generator/equations/constraints.py) and returns one SymPy expression for each row name. No row changes if both
    bodies, and further ones that fields name, move together: the reaction is a pair of opposite wrenches.
    """

    kind: str
    title: str
    fields: tuple[Field, ...]  # its keys in addition to `kind`, such as `axis` of a translational joint
    play: str  # dimensions of its play, a key of a scene's `play`: "bearing", "guide"; "": it cannot have play
    row_names: tuple[str, ...]  # a short name for each row of Φ, whose full name is "<joint>.<row name>"
    row_units: tuple[str, ...]  # "m" or "rad" for each row
    rows: Callable[..., list[Any]]
    doc: str | None  # text for documents: a line, then its sketch and its equation
    symbol: Symbol = field(default_factory=Symbol)
    slides: Slide | None = None
    joins: str = "points"  # "points": [L1.head, L2.tail]; "bodies": [L1, L4]
    reaction_at: str = "second"  # body whose point is the reference point of the reaction: "first" or "second"
    # rows that tree coordinates satisfy by themselves: two rows if the points coincide, one if the point of the second
    # body slides along the `axis` of the first (generator/reduction/tree.py)
    positioning_rows: tuple[str, ...] = ()
    foreign_names: tuple[str, ...] = ()  # names in other programs, for hints

    @property
    def is_pivot(self) -> bool:
        """Return whether the joint only holds two points together, so that the bodies turn on each other."""
        return self.has_coincident_points and self.positioning_rows == self.row_names

    @property
    def has_coincident_points(self) -> bool:
        """Return whether the joint's two points coincide."""
        return len(self.positioning_rows) == 2

    @property
    def has_fixed_angle(self) -> bool:
        """Return whether the bodies cannot turn relative to each other."""
        return "rad" in self.row_units

    @property
    def third_body_fields(self) -> tuple[str, ...]:
        """Return the fields that name a third body, such as a gear's carrier."""
        return tuple(body_field.name for body_field in self.fields if body_field.kind == BODY)


@cache
def find_joint_types() -> Mapping[str, JointType]:
    """Return all joint types of this folder by kind."""
    return {joint.kind: joint for joint in iterate_declarations("gudgeon.generator.kinds.joints", "JOINT", JointType)}

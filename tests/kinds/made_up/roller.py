r"""Roller on a flat face: a point of the first body keeps a distance from a line of the second.

     .-.
    ( o )  first       Φ = n · (r_P − r_Q) − r,  n: the direction's unit vector turned +90°
=====---=====>  second
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import POSITIVE, number, vector
from gudgeon.generator.kinds.joints.joint_type import JointType, Symbol
from gudgeon.language.units import DIMENSIONLESS, LENGTH


def rows(first: Any, second: Any, fields: Any) -> list[Any]:
    """Return one row: the distance of the roller from the face (m)."""
    u_x, u_y = second.direction(fields.direction("direction"))
    return [u_x * (first.y - second.y) - u_y * (first.x - second.x) - fields.quantity("radius", 0)]


def normal(at: Any) -> Any:
    return at.rotate_quarter_turn(at.direction("direction", at.bodies[1]))


def draw(pen: Any) -> None:
    """Draw the roller with its pin, and as much of the face as is below it."""
    radius = pen.get_parameter("radius")
    foot, half = pen.first - radius * normal(pen), 1.5 * radius * pen.direction("direction", pen.bodies[1])
    pen.add_disc("roller", pen.first, radius)
    pen.add_line("rail", [foot - half, foot + half])
    pen.add_pin(pen.first)


def place(at: Any) -> Any:
    return at.first


def gap(at: Any, left: Any) -> Any:
    """Return where the roller's point is, and where its distance would be right."""
    return at.first, at.first - left[0] * normal(at)


def reach(at: Any) -> tuple[float, float]:
    return at.get_parameter("radius"), 0.0


JOINT = JointType(
    "roller",
    "roller on a flat face",
    (
        vector("direction", "direction of the face in the second body's frame", DIMENSIONLESS, required=True),
        number("radius", "radius of the roller", LENGTH, required=True, bounds=POSITIVE),
    ),
    "",
    ("distance",),
    ("m",),
    rows,
    __doc__,
    Symbol(draw, place, find_closure_error=gap, find_radii=reach),
    reaction_at="first",
)

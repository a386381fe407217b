r"""Constant distance: a massless rod between a point of each body.

      first  o-----------------o  second      Φ = (‖r_Q − r_P‖² − l²)/(2 l)
                     l

The quadratic form has no root and no singular direction; where it holds, its multiplier is the rod's force.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import POSITIVE, number
from gudgeon.generator.kinds.joints.joint_type import JointType, Symbol
from gudgeon.language.units import LENGTH


def derive_constraint_equations(first_frame: Any, second_frame: Any, joint_fields: Any) -> list[Any]:
    """Return one constraint equation, (l² − L²)/(2 L) in m, for the distance l of the points and the `length` L.

    It is positive where the points are too far apart, and about l − L near zero.
    first_frame, second_frame: frames of both points (PointFrame).
    joint_fields: the joint's values (JointFields).
    """
    x, y, length = second_frame.x - first_frame.x, second_frame.y - first_frame.y, joint_fields.quantity("length", 0)
    return [(x**2 + y**2) * joint_fields.derive_parameter("half_inverse_length", 1 / (2 * length)) - length / 2]


def draw_symbol(pen: Any) -> None:
    """Draw the rod between two pins, with a fixed support at a point of the ground."""
    pen.add_fixed_support()
    pen.add_line("rod", [pen.first, pen.second])
    for point in (pen.first, pen.second):
        pen.add_pin(point, 0.8)


def find_middle(joint: Any) -> Any:
    """Return the middle of the rod, where its name stands."""
    return 0.5 * (joint.first + joint.second)


def find_closure_error_points(joint: Any, residuals: Any) -> Any:
    """Return the ideal end point of the rod, at its length from the first point, and the second point, (2,) each.

    Both are in ground axes (m). joint: the joint at a configuration; the residuals are not used.
    """
    return joint.first + joint.get_parameter("length") * joint.unit_vector(joint.second - joint.first), joint.second


JOINT = JointType(
    "distance",
    "constant distance (massless rod)",
    (number("length", "length of the rod", LENGTH, required=True, bounds=POSITIVE),),
    "",
    ("length",),
    ("m",),
    derive_constraint_equations,
    __doc__,
    Symbol(draw_symbol, find_middle, 0.5, find_closure_error_points),
    foreign_names=("link", "rod", "massless_rod", "coupler"),
)

r"""Translational joint: the second body slides along an axis of the first and does not turn to it.

  ====[  second  ]====>  axis (fixed in the first body, through its point)
     first

Φ = ( n · (r_Q − r_P),  θ_second − θ_first − angle )     n: the axis' unit vector turned +90°
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import number, vector
from gudgeon.generator.kinds.joints.joint_type import (
    JointType,
    Slide,
    Symbol,
    find_closure_error_to_line,
    find_sliding_point,
)
from gudgeon.language.units import DIMENSIONLESS


def derive_constraint_equations(first_frame: Any, second_frame: Any, joint_fields: Any) -> list[Any]:
    """Return two constraint equations: the offset from the axis (m), the angle between the bodies (rad).

    The offset of the second point is positive on the left of the axis of the first body. The angle is that of the
    second body relative to the first, less the field `angle` or, without it, the angle of the axis.
    first_frame, second_frame: frames of both points (PointFrame).
    joint_fields: the joint's values (JointFields).
    """
    axis = joint_fields.direction("axis")
    axis_x, axis_y = first_frame.direction(axis)
    offset = axis_x * (second_frame.y - first_frame.y) - axis_y * (second_frame.x - first_frame.x)
    return [
        offset,
        second_frame.theta
        - first_frame.theta
        - joint_fields.quantity("angle", joint_fields.derive_vector_angle("axis")),
    ]


def draw_symbol(pen: Any) -> None:
    """Draw the ground's rails, or the axis in the body that guides; bodies draw blocks and guides."""
    pen.add_guide()


JOINT = JointType(
    "translational",
    "translational joint",
    (
        vector("axis", "direction of sliding in the first body's frame", DIMENSIONLESS, required=True, nonzero=True),
        number(
            "angle",
            "angle of the second body minus angle of the first body",
            DIMENSIONLESS,
            otherwise="the direction of the axis",
        ),
    ),
    "guide",
    ("offset", "angle"),
    ("m", "rad"),
    derive_constraint_equations,
    __doc__,
    Symbol(draw_symbol, find_sliding_point, 1.5, find_closure_error_to_line),
    Slide("axis", "first"),
    positioning_rows=("offset",),
    foreign_names=("prismatic", "slider", "sliding", "slide", "linear", "piston", "guide"),
)

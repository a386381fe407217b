r"""Point on line (pin in slot): a point of the first body stays on a line fixed in the second.

second  ====o=================>  direction (in the second body's frame, through its point)
            |
          first                  Φ = n · (r_P − r_Q),  n: the direction's unit vector turned +90°
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import vector
from gudgeon.generator.kinds.joints.joint_type import (
    JointType,
    Slide,
    Symbol,
    find_closure_error_to_line,
    find_sliding_point,
)
from gudgeon.language.units import DIMENSIONLESS


def derive_constraint_equations(first_frame: Any, second_frame: Any, joint_fields: Any) -> list[Any]:
    """Return one constraint equation: the signed distance of the point from the line (m).

    It is positive on the left of the line, seen along its `direction`.
    first_frame, second_frame: frames of the point and of the line's point (PointFrame).
    joint_fields: the joint's values (JointFields).
    """
    u_x, u_y = second_frame.direction(joint_fields.direction("direction"))
    return [u_x * (first_frame.y - second_frame.y) - u_y * (first_frame.x - second_frame.x)]


def draw_symbol(pen: Any) -> None:
    """Draw a roller on the ground's rail, or a pin with its block in a slot of the body that guides."""
    if pen.ground_guides:
        pen.add_rail(pen.ROLLER * pen.unit)
        pen.add_disc("roller", pen.slider, pen.ROLLER * pen.unit)
    else:
        pen.add_slot()
        pen.add_box("block", pen.slider, pen.along, 1.25, 0.8)
        pen.add_fixed_support()
    pen.add_pin(pen.slider)


JOINT = JointType(
    "point_on_line",
    "point on a line (pin in slot)",
    (vector("direction", "direction in the second body's frame", DIMENSIONLESS, required=True, nonzero=True),),
    "",
    ("offset",),
    ("m",),
    derive_constraint_equations,
    __doc__,
    Symbol(draw_symbol, find_sliding_point, find_closure_error=find_closure_error_to_line),
    Slide("direction", "second"),
    reaction_at="first",
    foreign_names=("slot", "pin_in_slot", "pin_slot", "line", "half_joint"),
)

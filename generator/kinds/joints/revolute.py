r"""Revolute joint: a point of the first body coincides with a point of the second.

     \        /
      \      /
first  \    /  second          Φ = r_first + A(θ_first) s_first − r_second − A(θ_second) s_second
        \  /
         ()
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.joints.joint_type import JointType, Symbol, find_closure_error_between_points


def derive_constraint_equations(first_frame: Any, second_frame: Any, joint_fields: Any) -> list[Any]:
    """Return two constraint equations (m): the points' coordinates in ground axes are equal."""
    return [first_frame.x - second_frame.x, first_frame.y - second_frame.y]


def draw_symbol(pen: Any) -> None:
    """Draw the pin, with a fixed support on the ground, and with its hole if the joint has play."""
    pen.add_bearing()
    pen.add_pin(pen.second)


JOINT = JointType(
    "revolute",
    "revolute joint",
    (),
    "bearing",
    ("x", "y"),
    ("m", "m"),
    derive_constraint_equations,
    __doc__,
    Symbol(draw_symbol, find_closure_error=find_closure_error_between_points),
    positioning_rows=("x", "y"),
    foreign_names=("pin", "hinge", "pivot", "rotational", "rotation", "turning", "journal", "bearing", "ball"),
)

r"""Rigid joint (weld): two points coincide and the bodies keep their angle.

[ first ]=#=[ second ]      Φ = ( r_P − r_Q,  θ_second − θ_first − angle )
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import number
from gudgeon.generator.kinds.joints.joint_type import JointType, Symbol, find_closure_error_between_points
from gudgeon.language.units import DIMENSIONLESS


def derive_constraint_equations(first_frame: Any, second_frame: Any, joint_fields: Any) -> list[Any]:
    """Return three constraint equations: the points' coordinates are equal (m), the angle between the bodies (rad)."""
    angle_error = second_frame.theta - first_frame.theta - joint_fields.quantity("angle", 0)
    return [first_frame.x - second_frame.x, first_frame.y - second_frame.y, angle_error]


def draw_symbol(pen: Any) -> None:
    """Draw a black square, and the hatched wall if one body is the ground."""
    pen.add_wall(pen.first)
    pen.add_box("weld", pen.second, pen.compute_body_axis(0), 0.62, 0.62)


JOINT = JointType(
    "rigid",
    "rigid joint",
    (number("angle", "angle of the second body minus angle of the first body", DIMENSIONLESS, otherwise="0"),),
    "",
    ("x", "y", "angle"),
    ("m", "m", "rad"),
    derive_constraint_equations,
    __doc__,
    Symbol(draw_symbol, find_closure_error=find_closure_error_between_points),
    positioning_rows=("x", "y"),
    foreign_names=("weld", "welded", "fixed", "fix", "clamp", "clamped", "lock"),
)

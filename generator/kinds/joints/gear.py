r"""Rolling gear pair: two wheels on a carrier (body or ground) roll on each other without slip.

        .---.  .---.
       (  1  )(  2  )      Φ = r_1 (θ_1 − θ_3) + r_2 (θ_2 − θ_3) − constant      (− for a ring: internal)
        '---'  '---'
        ===carrier 3===

The constant is what the start's guess (or set) angles give: the teeth mesh as the wheels are guessed.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import POSITIVE, body_or_ground, flag, vector
from gudgeon.generator.kinds.joints.joint_type import JointType, Symbol
from gudgeon.language.units import LENGTH


def derive_constraint_equations(first_frame: Any, second_frame: Any, joint_fields: Any) -> list[Any]:
    """Return one constraint equation: the arc by which the wheels have slipped since the start (m).

    It is r_1 Δθ_1 + r_2 Δθ_2, with − for a wheel in a ring (`internal`). Angles are relative to the carrier, and Δ is
    the change since the guess of the start.
    first_frame, second_frame: frames of the wheels (PointFrame).
    joint_fields: the joint's values (JointFields).
    """
    radius_1, radius_2 = joint_fields.vector("radii")
    sign = -1 if joint_fields.option("internal") == "true" else 1
    carrier = joint_fields.body_angle("carrier")
    arc = radius_1 * (first_frame.theta - carrier) + sign * radius_2 * (second_frame.theta - carrier)
    return [arc - joint_fields.evaluate_at_guess("mesh", arc)]


def find_wheels(joint: Any) -> list[tuple[Any, float]]:
    """Return for each wheel where it turns on the carrier (2,) and its pitch radius (m)."""
    return [(joint.find_pivot(k, joint.get_option("carrier")), radius) for k, radius in enumerate(find_radii(joint))]


def find_radii(joint: Any) -> tuple[float, float]:
    """Return both pitch radii (m)."""
    return joint.get_parameter("radii.x"), joint.get_parameter("radii.y")


def find_pitch_point(joint: Any) -> Any:
    """Return the point at which the wheels touch, (2,) in ground axes (m).

    Inside a ring, the wheels touch at the ring's pitch circle beyond the smaller wheel.
    """
    (centre_1, r_1), (centre_2, r_2) = find_wheels(joint)
    is_internal = joint.get_option("internal") == "true"
    centre, radius = (centre_2, r_2) if r_2 > r_1 or not is_internal else (centre_1, r_1)
    return centre + radius * joint.unit_vector((centre_1 if centre is centre_2 else centre_2) - centre)


def draw_symbol(pen: Any) -> None:
    """Draw pitch circles, a spoke fixed in each wheel, a ring with its rim, and the point of contact."""
    for k, (centre, radius) in enumerate(find_wheels(pen)):
        pen.add_wheel(k, centre, radius, is_ring=k == 1 and pen.get_option("internal") == "true")
    pen.add_disc("mark", find_pitch_point(pen), 0.25 * pen.unit)


def find_closure_error_points(joint: Any, residuals: Any) -> Any:
    """Return the ends of the arc by which the wheels have slipped, (2,) each in ground axes (m).

    The arc is drawn as a line across that of the centres. joint: the joint at a configuration; residuals: the arc (m).
    """
    (centre_1, _), (centre_2, _) = find_wheels(joint)
    midpoint = 0.5 * (centre_1 + centre_2)
    return midpoint, midpoint + residuals[0] * joint.rotate_quarter_turn(joint.unit_vector(centre_2 - centre_1))


JOINT = JointType(
    "gear",
    "rolling gear pair",
    (
        vector("radii", "pitch radii of the first and the second gear", LENGTH, required=True, bounds=POSITIVE),
        body_or_ground("carrier", "body on which both wheels turn"),
        flag("internal", "whether the second gear is a ring around the first"),
    ),
    "",
    ("mesh",),
    ("m",),
    derive_constraint_equations,
    __doc__,
    Symbol(draw_symbol, find_pitch_point, 0.3, find_closure_error_points, find_radii),
    joins="bodies",
    foreign_names=("gears", "gear_pair", "spur", "rolling", "mesh"),
)

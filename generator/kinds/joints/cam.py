r"""Cam with a translating follower: the cam's angle determines the position of a point of the follower.

     |follower|  ^ axis (fixed in the carrier)
     '---o----'  |
       .---.   s(φ)       Φ = u · (r_Q − r_P) − s(φ),   φ = θ_cam − θ_carrier
      ( cam )
       '-o-'              u: the axis' unit vector; P: where the cam turns; Q: the follower's point

The profile is an expression of φ, mostly a curve, continuous with its slope. The constraint does no work: with F the
force on the follower along the axis the cam bears the torque F ds/dφ, as virtual work says. It holds both ways, as a
grooved cam does; a follower that a spring closes stays on its cam where F > 0. A guide keeps the follower on its axis.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import OF_CAM_ANGLE, body_or_ground, number, vector
from gudgeon.generator.kinds.joints.joint_type import JointType, Symbol
from gudgeon.language.units import DIMENSIONLESS, LENGTH


def derive_constraint_equations(first_frame: Any, second_frame: Any, joint_fields: Any) -> list[Any]:
    """Return one constraint equation: position of the follower's point along the axis, less that of the profile (m).

    Positions count from the cam's point, and the axis is fixed in the body `carrier`. The profile is a function of the
    cam's angle relative to `carrier`.

    first_frame, second_frame: frames of the cam's and the follower's point (PointFrame). joint_fields: the joint's
    values (JointFields).
    """
    u_x, u_y = joint_fields.rotate_direction("axis", "carrier")
    along = u_x * (second_frame.x - first_frame.x) + u_y * (second_frame.y - first_frame.y)
    return [along - joint_fields.define_profile("profile", first_frame.theta, joint_fields.body_angle("carrier"))]


def find_closure_error_points(joint: Any, residuals: Any) -> Any:
    """Return the follower's point and the point where the profile requires it, (2,) each in ground axes (m).

    The second is the first moved back along the axis by the residual. joint: the joint at a configuration; residuals:
    the values of its constraint equations (m).
    """
    return joint.second, joint.second - residuals[0] * joint.direction("axis", joint.get_option("carrier"))


JOINT = JointType(
    "cam",
    "cam with a translating follower",
    (
        number(
            "profile",
            "position of the follower's point along the axis, measured from the cam's point",
            LENGTH,
            required=True,
            varies=OF_CAM_ANGLE,
        ),
        vector("axis", "direction of the lift in the carrier's frame", DIMENSIONLESS, required=True, nonzero=True),
        body_or_ground(
            "carrier", "body on which the cam turns; phi is the angle of the cam minus the angle of this body"
        ),
    ),
    "",
    ("lift",),
    ("m",),
    derive_constraint_equations,
    __doc__,
    Symbol(find_closure_error=find_closure_error_points),
    foreign_names=("follower", "disc_cam", "disk_cam", "plate_cam", "cam_follower"),
)

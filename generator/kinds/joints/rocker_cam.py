r"""Cam with an oscillating follower: the cam's angle determines the angle of a rocker.

        .---.     ___---  rocker
       ( cam )---'  ψ     Φ = ψ − ψ(φ),   φ = θ_cam − θ_carrier,   ψ = θ_rocker − θ_carrier
        '-o-'     o

As of a translating follower (cam.py): with T the torque on the rocker the cam bears −T dψ/dφ.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import OF_CAM_ANGLE, body_or_ground, number
from gudgeon.generator.kinds.joints.joint_type import JointType
from gudgeon.language.units import DIMENSIONLESS


def derive_constraint_equations(first_frame: Any, second_frame: Any, joint_fields: Any) -> list[Any]:
    """Return one constraint equation: by how much the rocker's angle differs from its profile (rad)."""
    carrier = joint_fields.body_angle("carrier")
    return [second_frame.theta - carrier - joint_fields.define_profile("profile", first_frame.theta, carrier)]


JOINT = JointType(
    "rocker_cam",
    "cam with an oscillating follower",
    (
        number(
            "profile",
            "angle of the rocker, measured from the carrier",
            DIMENSIONLESS,
            required=True,
            varies=OF_CAM_ANGLE,
        ),
        body_or_ground(
            "carrier", "body on which cam and rocker turn; phi is the angle of the cam minus the angle of this body"
        ),
    ),
    "",
    ("swing",),
    ("rad",),
    derive_constraint_equations,
    __doc__,
    joins="bodies",
    foreign_names=("oscillating_follower", "cam_rocker", "swinging_follower"),
)

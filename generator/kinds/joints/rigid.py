r"""Rigid joint (weld): two points coincide and the bodies keep their angle.

[ first ]=#=[ second ]      Φ = ( r_P − r_Q,  θ_second − θ_first − angle )
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import number
from gudgeon.generator.kinds.joints.joint_type import JointType
from gudgeon.language.units import DIMENSIONLESS


def rows(first: Any, second: Any, fields: Any) -> list[Any]:
    """Three rows: the two points' coordinates are equal (m), the angle between the bodies (rad)."""
    turned = second.theta - first.theta - fields.quantity("angle", 0)
    return [first.x - second.x, first.y - second.y, turned]


JOINT = JointType(
    "rigid",
    "rigid joint",
    (number("angle", "θ_second − θ_first", DIMENSIONLESS, otherwise="0"),),
    "",
    ("x", "y", "angle"),
    ("m", "m", "rad"),
    rows,
    carries=("x", "y"),
    also=("weld", "welded", "fixed", "fix", "clamp", "clamped", "lock"),
)

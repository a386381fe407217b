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
from gudgeon.generator.kinds.joints.joint_type import JointType
from gudgeon.language.units import LENGTH


def rows(first: Any, second: Any, fields: Any) -> list[Any]:
    """One row: the arc by which the wheels have slipped (m)."""
    radius_1, radius_2 = fields.vector("radii")
    sign = -1 if fields.option("internal") == "true" else 1
    carrier = fields.body_angle("carrier")
    meshed = radius_1 * (first.theta - carrier) + sign * radius_2 * (second.theta - carrier)
    return [meshed - fields.at_guess("mesh", meshed)]


JOINT = JointType(
    "gear",
    "rolling gear pair",
    (
        vector("radii", "pitch radii of first and second", LENGTH, required=True, bounds=POSITIVE),
        body_or_ground("carrier", "what both wheels turn on"),
        flag("internal", "the second is a ring around the first"),
    ),
    "",
    ("mesh",),
    ("m",),
    rows,
    joins="bodies",
    also=("gears", "gear_pair", "spur", "rolling", "mesh"),
)

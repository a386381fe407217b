r"""Constant distance: a massless rod between a point of each body.

      first  o-----------------o  second      Φ = (‖r_Q − r_P‖² − l²)/(2 l)
                     l

The quadratic form has no root and no singular direction; where it holds, its multiplier is the rod's force.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import POSITIVE, number
from gudgeon.generator.kinds.joints.joint_type import JointType
from gudgeon.language.units import LENGTH


def rows(first: Any, second: Any, fields: Any) -> list[Any]:
    """One row (m): zero where the distance is `length`, and growing with it at the same rate."""
    x, y, length = second.x - first.x, second.y - first.y, fields.quantity("length", 0)
    return [(x**2 + y**2) * fields.derive("half_inverse_length", 1 / (2 * length)) - length / 2]


JOINT = JointType(
    "distance",
    "constant distance (massless rod)",
    (number("length", "length of the rod", LENGTH, required=True, bounds=POSITIVE),),
    "",
    ("length",),
    ("m",),
    rows,
    also=("link", "rod", "massless_rod", "coupler"),
)

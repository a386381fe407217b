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


def rows(first: Any, second: Any, fields: Any) -> list[Any]:
    """Return one row: the arc by which the wheels have slipped (m)."""
    radius_1, radius_2 = fields.vector("radii")
    sign = -1 if fields.option("internal") == "true" else 1
    carrier = fields.body_angle("carrier")
    meshed = radius_1 * (first.theta - carrier) + sign * radius_2 * (second.theta - carrier)
    return [meshed - fields.at_guess("mesh", meshed)]


def wheels(at: Any) -> list[tuple[Any, float]]:
    """Return of both wheels where they turn on the carrier, and their pitch radii (m)."""
    return [(at.centre(k, at.option("carrier")), radius) for k, radius in enumerate(radii(at))]


def radii(at: Any) -> tuple[float, float]:
    """Return both pitch radii (m)."""
    return at.number("radii.x"), at.number("radii.y")


def pitch_point(at: Any) -> Any:
    """Return the place at which the wheels touch."""
    (one, r_1), (other, r_2) = wheels(at)
    inside = at.option("internal") == "true"
    outer, ring = (other, r_2) if r_2 > r_1 or not inside else (one, r_1)
    return outer + ring * at.unit_vector((one if outer is other else other) - outer)


def draw(pen: Any) -> None:
    """Draw pitch circles, a spoke fixed in each wheel, a ring with its rim, the point of contact."""
    for k, (centre, radius) in enumerate(wheels(pen)):
        pen.wheel(k, centre, radius, is_ring=k == 1 and pen.option("internal") == "true")
    pen.disc("mark", pitch_point(pen), 0.25 * pen.unit)


def gap(at: Any, left: Any) -> Any:
    """Return the ends of the arc by which the wheels have slipped, as a line across that of their centres."""
    (one, _), (other, _) = wheels(at)
    middle = 0.5 * (one + other)
    return middle, middle + left[0] * at.turned(at.unit_vector(other - one))


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
    __doc__,
    Symbol(draw, pitch_point, 0.3, gap, radii),
    joins="bodies",
    also=("gears", "gear_pair", "spur", "rolling", "mesh"),
)

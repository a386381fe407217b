r"""Dry friction between a point of the second body and a surface of the first: Coulomb's set-valued law.

     ____[ second ]____   slip v = u · (ṙ_Q − ṙ_P at Q) − speed
     ->  first (belt)     stick: v = 0 holds as a constraint while its force stays within ±static
                          slip:  force on the second −kinetic · sgn v

`direction` u is fixed in the first body; `speed` is that of its surface along u (a belt). Stick is a row
of the KKT system that is switched on and off at located events, so a block at rest does not creep.
The limits are forces (N): friction whose normal force a joint carries is not in them.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.forces.force_type import ElementField, ElementType, Loads, Slip
from gudgeon.language.units import DIMENSIONLESS, VELOCITY, dimension


def build(targets: Any, fields: Any) -> Loads:
    """The slip; the force follows from it and from whether it sticks."""
    import sympy as sp

    first, second = targets
    u_x, u_y = first.direction(fields.direction("direction"))
    vx, vy = second.velocity
    if first.body is not None:  # the first body's material under the second's point
        vx -= first.body.vx - (second.y - first.body.y) * first.body.omega
        vy -= first.body.vy + (second.x - first.body.x) * first.body.omega
    speed = fields.quantity("speed")
    slip = Slip(u_x * vx + u_y * vy - speed, speed, fields.quantity("static"), fields.quantity("kinetic"))
    return Loads((), sp.Integer(0), sp.Integer(0), {}, slip)


_FORCE = dimension(mass=1, length=1, time=-2)

ELEMENT = ElementType(
    "dry_friction",
    "dry friction with stick",
    "points",
    (2,),
    (
        ElementField("direction", "vector", "of sliding, in the first body's frame", DIMENSIONLESS, True),
        ElementField(
            "static", "quantity", "largest force at stick", _FORCE, True, not_negative=True, at_least="kinetic"
        ),
        ElementField("kinetic", "quantity", "force while slipping", _FORCE, True, not_negative=True),
        ElementField("speed", "quantity", "of the first's surface along the direction", VELOCITY),
    ),
    (("F", _FORCE), ("v", VELOCITY), ("mode", DIMENSIONLESS)),
    build,
)

r"""Dry friction between a point of the second body and a surface of the first: Coulomb's set-valued law.

     ____[ second ]____   slip v = u · (ṙ_Q − ṙ_P at Q) − speed
     ->  first (belt)     stick: v = 0 holds as a constraint while its force stays within ±static
                          slip:  force on the second −F(v) sgn v

`direction` u is fixed in the first body; `speed` is that of its surface along u (a belt). Stick is a row
of the KKT system that is switched on and off at located events, so a block at rest does not creep. F is `kinetic` at
any slip, or with `stribeck_velocity` v_s it falls from `static`: F = kinetic + (static − kinetic) exp(−(v/v_s)²), as
L. C. Bo, D. Pavelescu, Wear 82 (1982) 277–289, with exponent 2; stick and slip then meet without a jump.
The limits are forces (N): friction whose normal force a joint carries is not in them.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import NOT_NEGATIVE, Bound, number, vector
from gudgeon.generator.kinds.forces.force_type import ElementType, Loads, Slip
from gudgeon.language.units import DIMENSIONLESS, FORCE, VELOCITY


def build_loads(target_frames: Any, element_fields: Any) -> Loads:
    """Return the loads of dry friction: a Slip without forces, from which the integrator finds the force.

    Its slip velocity is that of the second body's point relative to the surface of the first body, along `direction`.
    The surface moves with the first body, which may be the ground, and along `direction` at `speed` (a belt).
    target_frames: frames of both points (PointFrame). element_fields: the element's values.
    """
    import sympy as sp

    first, second = target_frames
    u_x, u_y = first.direction(element_fields.direction("direction"))
    vx, vy = second.velocity
    if first.body is not None:  # the first body's material under the second's point
        vx -= first.body.vx - (second.y - first.body.y) * first.body.omega
        vy -= first.body.vy + (second.x - first.body.x) * first.body.omega
    speed = element_fields.quantity("speed")
    static, kinetic, stribeck_velocity = (
        element_fields.quantity(name) for name in ("static", "kinetic", "stribeck_velocity")
    )
    slip = Slip(u_x * vx + u_y * vy - speed, speed, static, kinetic, stribeck_velocity)
    return Loads((), sp.Integer(0), sp.Integer(0), {}, slip)


ELEMENT = ElementType(
    "dry_friction",
    "dry friction with stick",
    "points",
    (2,),
    (
        vector(
            "direction",
            "direction of sliding, in the frame of the first body",
            DIMENSIONLESS,
            required=True,
            nonzero=True,
        ),
        number(
            "static",
            "largest friction force during stick",
            FORCE,
            required=True,
            bounds=(*NOT_NEGATIVE, Bound(">=", "kinetic", "static is at least kinetic")),
        ),
        number("kinetic", "friction force during slip", FORCE, required=True, bounds=NOT_NEGATIVE),
        number(
            "stribeck_velocity",
            "slip in which friction falls from static to kinetic, v_s of exp(-(v/v_s)^2)",
            VELOCITY,
            otherwise="friction falls from static to kinetic at once",
            bounds=(Bound(">", 0.0),),
        ),
        number("speed", "speed of the surface of the first body along the direction", VELOCITY, otherwise="0"),
    ),
    (("F", FORCE), ("v", VELOCITY), ("mode", DIMENSIONLESS)),
    build_loads,
    __doc__,
    foreign_names=("friction", "coulomb", "brake"),
)

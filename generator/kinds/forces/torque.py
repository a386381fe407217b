r"""A torque on a body, or between two bodies (on the first, and its opposite on the second).

( value
 body
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import OF_MOTION, number
from gudgeon.generator.kinds.forces.force_type import ElementType, Load, Loads
from gudgeon.language.units import TORQUE


def build_loads(target_frames: Any, element_fields: Any) -> Loads:
    """Return the loads of a torque on the first body, its opposite on a second one, and their power; series M (N·m).

    The torque is positive counterclockwise. target_frames: one or two frames of centres of mass (PointFrame).
    element_fields: the element's values. There is no potential energy.
    """
    import sympy as sp

    zero = sp.Integer(0)
    moment = element_fields.define_local("torque", element_fields.quantity("value"))
    loads = [Load(0, zero, zero, moment)]
    power = moment * target_frames[0].omega
    if len(target_frames) == 2:
        loads.append(Load(1, zero, zero, -moment))
        power -= moment * target_frames[1].omega
    return Loads(tuple(loads), zero, power, {"M": (moment, "N*m")})


ELEMENT = ElementType(
    "torque",
    "torque on a body or between two",
    "bodies",
    (1, 2),
    (number("value", "torque on the first body", TORQUE, required=True, varies=OF_MOTION),),
    (("M", TORQUE),),
    build_loads,
    __doc__,
    foreign_names=("moment", "couple"),
)

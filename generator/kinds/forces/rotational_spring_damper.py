r"""Rotational spring and damper between two bodies (or the ground and a body).

first )~~~( second        M = k (θ − θ_0) + d ω     θ = θ_second − θ_first; it acts to close θ − θ_0
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import NOT_NEGATIVE, number
from gudgeon.generator.kinds.forces.force_type import ElementType, Load, Loads
from gudgeon.language.units import DIMENSIONLESS, TORQUE, make_dimension


def build_loads(target_frames: Any, element_fields: Any) -> Loads:
    """Return the loads of the spring and damper: opposite moments, the potential ½ k (θ − θ_0)² and the power −d ω².

    θ and ω are the angle and angular velocity of the second body relative to the first. The moment on the first body is
    M = k (θ − θ_0) + d ω (N·m), which is also the series M. target_frames: frames of both centres of mass (PointFrame).
    element_fields: the element's values.
    """
    import sympy as sp

    first, second = target_frames
    k, theta_0, d = (element_fields.quantity(name) for name in ("stiffness", "free_angle", "damping"))
    theta, omega = second.theta - first.theta - theta_0, second.omega - first.omega
    moment = element_fields.define_local("moment", k * theta + d * omega)
    zero = sp.Integer(0)
    loads = (Load(0, zero, zero, moment), Load(1, zero, zero, -moment))
    return Loads(loads, k * theta**2 / 2, -d * omega**2, {"M": (moment, "N*m")})


ELEMENT = ElementType(
    "rotational_spring_damper",
    "rotational spring and damper between two bodies",
    "bodies",
    (2,),
    (
        number("stiffness", "stiffness k: moment divided by angle", TORQUE, bounds=NOT_NEGATIVE, otherwise="0"),
        number("free_angle", "angle θ_0 without moment", DIMENSIONLESS, otherwise="0"),
        number(
            "damping",
            "damping d: moment divided by angular velocity",
            make_dimension(mass=1, length=2, time=-1),
            bounds=NOT_NEGATIVE,
            otherwise="0",
        ),
    ),
    (("M", TORQUE),),
    build_loads,
    __doc__,
    foreign_names=("torsion_spring", "torsional_spring", "rotational_spring", "rotational_damper", "rsda"),
)

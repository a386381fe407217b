r"""Rotational spring and damper between two bodies (or the ground and a body).

first )~~~( second        M = k (θ − θ_0) + d ω     θ = θ_second − θ_first; it acts to close θ − θ_0
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.kinds.forces.force_type import ElementField, ElementType, Load, Loads
from gudgeon.language.units import DIMENSIONLESS, TORQUE, dimension


def build(targets: Any, fields: Any) -> Loads:
    """The pair of moments, ½ k (θ − θ_0)² and −d ω²."""
    import sympy as sp

    first, second = targets
    k, theta_0, d = (fields.quantity(name) for name in ("stiffness", "free_angle", "damping"))
    theta, omega = second.theta - first.theta - theta_0, second.omega - first.omega
    moment = fields.named("moment", k * theta + d * omega)
    zero = sp.Integer(0)
    loads = (Load(0, zero, zero, moment), Load(1, zero, zero, -moment))
    return Loads(loads, k * theta**2 / 2, -d * omega**2, {"M": (moment, "N*m")})


ELEMENT = ElementType(
    "rotational_spring_damper",
    "rotational spring and damper between two bodies",
    "bodies",
    (2,),
    (
        ElementField("stiffness", "quantity", "k", dimension(mass=1, length=2, time=-2), not_negative=True),
        ElementField("free_angle", "quantity", "θ_0", DIMENSIONLESS),
        ElementField("damping", "quantity", "d", dimension(mass=1, length=2, time=-1), not_negative=True),
    ),
    (("M", TORQUE),),
    build,
)

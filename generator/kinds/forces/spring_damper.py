r"""Spring and damper between two points, along the line that joins them.

     P o--/\/\/--[=--o Q       F = k (l − l_0) + d l̇      l = ‖r_Q − r_P‖, tension positive

With a literal free length of zero the spring's force k (r_Q − r_P) is written without the direction, so
that it stays regular where the points meet.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import NOT_NEGATIVE, number
from gudgeon.generator.kinds.forces.force_type import ElementType, Load, Loads
from gudgeon.language.units import DAMPING, FORCE, LENGTH, STIFFNESS


def build_loads(target_frames: Any, element_fields: Any) -> Loads:
    """Return the loads of the spring and damper: opposite forces, the potential ½ k (l − l_0)² and the power −d l̇².

    The force F = k (l − l_0) + d l̇ (N) is positive in tension: it pulls the points together. Series: F, length (m).
    With l_0 = d = 0 the loads are k times the vector between the points, so that l = 0 is allowed. target_frames:
    frames of both points (PointFrame). element_fields: the element's values.
    """
    import sympy as sp

    P, Q = target_frames
    k, l_0, d = (element_fields.quantity(name) for name in ("stiffness", "free_length", "damping"))
    (x, y), (vx, vy) = (
        element_fields.define_local_vector("span", (Q.x - P.x, Q.y - P.y)),
        element_fields.define_local_vector(
            "span_rate", tuple(b - a for a, b in zip(P.velocity, Q.velocity, strict=True))
        ),
    )
    squared_length = x**2 + y**2
    if l_0 == 0 and d == 0:
        force_per_length, potential, series = k, k * squared_length / 2, {"length": (sp.sqrt(squared_length), "m")}
        force = k * sp.sqrt(squared_length)
        power = sp.Integer(0)
    else:
        length = element_fields.define_local("length", sp.sqrt(squared_length))
        rate = element_fields.define_local("length_rate", (x * vx + y * vy) / length)
        force = element_fields.define_local("force", k * (length - l_0) + d * rate)
        force_per_length = element_fields.define_local("pull", force / length)
        potential, power = k * (length - l_0) ** 2 / 2, -d * rate**2
        series = {"length": (length, "m")}
    loads = (
        Load(0, force_per_length * x, force_per_length * y, sp.Integer(0)),
        Load(1, -force_per_length * x, -force_per_length * y, sp.Integer(0)),
    )
    return Loads(loads, potential, power, {"F": (force, "N"), **series})


ELEMENT = ElementType(
    "spring_damper",
    "spring and damper between two points",
    "points",
    (2,),
    (
        number("stiffness", "stiffness k: force divided by elongation", STIFFNESS, bounds=NOT_NEGATIVE, otherwise="0"),
        number("free_length", "length l_0 without force", LENGTH, bounds=NOT_NEGATIVE, otherwise="0"),
        number(
            "damping", "damping d: force divided by the rate of elongation", DAMPING, bounds=NOT_NEGATIVE, otherwise="0"
        ),
    ),
    (("F", FORCE), ("length", LENGTH)),
    build_loads,
    __doc__,
    foreign_names=("spring", "damper", "dashpot", "tsda"),
)

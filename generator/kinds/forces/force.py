r"""A force at a point of a body, in ground or body axes; its components may vary with time and motion.

body  o------>  value
    point
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import OF_MOTION, vector, word
from gudgeon.generator.kinds.forces.force_type import ElementType, Load, Loads
from gudgeon.language.units import FORCE


def build_loads(target_frames: Any, element_fields: Any) -> Loads:
    """Return the loads of a force at a point: components in ground axes (N), power F · ṙ, and series Fx, Fy and F (N).

    target_frames: the frame of the point (PointFrame), as a tuple of one. element_fields: the element's values. With
    the option `axes: body` the components turn with the body. There is no potential energy.
    """
    import sympy as sp

    (point,) = target_frames
    value = element_fields.vector("value")
    if element_fields.option("axes") == "body" and point.body is not None:
        cos, sin = point.geometry.find_cos_and_sin(point.body)
        value = (cos * value[0] - sin * value[1], sin * value[0] + cos * value[1])
    x, y = element_fields.define_local_vector("force", value)
    vx, vy = point.velocity
    series = {"Fx": (x, "N"), "Fy": (y, "N"), "F": (sp.sqrt(x**2 + y**2), "N")}
    return Loads((Load(0, x, y, sp.Integer(0)),), sp.Integer(0), x * vx + y * vy, series)


ELEMENT = ElementType(
    "force",
    "force at a point",
    "points",
    (1,),
    (
        vector("value", "components of the force", FORCE, required=True, varies=OF_MOTION),
        word("axes", "axes of the components", ("ground", "body"), "ground"),
    ),
    (("Fx", FORCE), ("Fy", FORCE), ("F", FORCE)),
    build_loads,
    __doc__,
    foreign_names=("load", "point_force"),
)

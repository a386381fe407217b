"""Contact points of joints with play: a journal in its bearing, or the four corners of a slider at their walls.

A slider is a block between parallel walls, which are fixed in the joint's first body: with n the axis turned by +90°,
the upper wall's outward normal is n and the lower one's −n. Its corners are in front (along the axis) or at the rear.
P. Flores, J. Ambrósio, J. C. P. Claro, H. M. Lankarani, J. Comput. Nonlinear Dyn. 3 (2008) 011007; P. Flores, R. Leine,
C. Glocker, Multibody Syst. Dyn. 23 (2010) 165–190. Corners have a radius ρ here, 0 for sharp ones.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.equations.fields import JointFields
from gudgeon.generator.equations.geometry import Geometry, PointFrame
from gudgeon.generator.kinds.joints.joint_type import CORNERS
from gudgeon.generator.kinds.laws.law import PairSymbols
from gudgeon.generator.mechanism import Bearing, Guide, Joint
from gudgeon.generator.symbols.parameter_table import ParameterTable


@dataclass(frozen=True)
class Wall:
    """A wall of a guide: its outward normal, fixed in the first body, in ground axes.

    `rise`: distance of the centre of a corner's radius from the axis with the slider in the middle, in m.
    """

    normal: tuple[sp.Expr, sp.Expr]
    rise: sp.Expr


@dataclass(frozen=True)
class Place:
    """One contact point, with its name in the file ("guide.front_upper"), in code, and the points of both bodies.

    The radii of `pair` are lever arms of the contact (for a corner: half the guide's width, ρ). Those of `of_laws` give
    the
    stiffness: a wall is flat, R_i = ∞.
    """

    name: str
    label: str
    first: PointFrame
    second: PointFrame
    pair: PairSymbols
    of_laws: PairSymbols
    wall: Wall | None = None


def places_of(joint: Joint, measures: Bearing | Guide, geometry: Geometry, slots: ParameterTable) -> Iterator[Place]:
    """Yield the contact points of a joint with play: one of a revolute joint, four of a translational one."""
    if isinstance(measures, Guide):
        yield from _corners(joint, measures, geometry, slots)
        return
    pair = _pair(measures, slots)
    yield Place(joint.name, joint.name, geometry.point(joint.first), geometry.point(joint.second), pair, pair)


def _pair(bearing: Bearing, slots: ParameterTable) -> PairSymbols:
    """Return radii, clearance, length and elastic constants of a bearing and its journal as parameters."""
    R_i, c = slots.use(bearing.radius), slots.use(bearing.clearance)
    R_j = slots.derive(f"R_j_{bearing.name}", R_i - c, "journal radius")
    return PairSymbols(R_i, R_j, c, slots.use(bearing.length), *_elastic(bearing, slots))


def _elastic(measures: Bearing | Guide, slots: ParameterTable) -> list[sp.Expr]:
    """Return E_i, ν_i, E_j, ν_j of both bodies as parameters."""
    materials = measures.bearing_material, measures.journal_material
    return [slots.use(material.numbers[what]) for material in materials for what in ("E", "nu")]


def _corners(joint: Joint, guide: Guide, geometry: Geometry, slots: ParameterTable) -> Iterator[Place]:
    """Yield the four corners of a slider in its guide as contact points."""
    first = geometry.point(joint.first)
    a, b, c = (slots.use(number) for number in (guide.half_length, guide.half_height, guide.gap))
    radius = sp.Integer(0) if guide.corner_radius is None else slots.use(guide.corner_radius)
    named = (("reach", a - radius, "half-length"), ("rise", b - radius, "half-height"))
    reach, rise = (slots.derive(f"{what}_{guide.name}", x, f"{message} less radius") for what, x, message in named)
    width = slots.derive(f"half_width_{guide.name}", b + c, "half the guide's width")
    pair = PairSymbols(width, radius, c, sp.nan, *_elastic(guide, slots))
    fields = JointFields(joint, geometry)
    axis_x, axis_y = first.direction(fields.direction("axis"))
    along_x, along_y = _axis_in_slider(fields, slots, joint.name)
    used = set(geometry.mechanism.joints)
    for corner, (front, upper) in CORNERS.items():
        label = f"{joint.name}_{corner}"
        while label in used:
            label += "_"
        x, y = front * reach, upper * rise
        offset = (along_x * x - along_y * y, along_y * x + along_x * y)
        wall = Wall((-upper * axis_y, upper * axis_x), rise)
        second = geometry.beside(joint.second, offset, label)
        yield Place(f"{joint.name}.{corner}", label, first, second, pair, replace(pair, R_i=sp.oo), wall)


def _axis_in_slider(fields: JointFields, slots: ParameterTable, joint: str) -> tuple[sp.Expr, sp.Expr]:
    """Return the guide's axis in the slider's frame, with the slider at the angle that the joint prescribes."""
    along = fields.angle_of("axis")
    turned = fields.quantity("angle", along)
    if turned == along:
        return sp.Integer(1), sp.Integer(0)
    cos, sin = (
        slots.derive(f"{f.__name__}_slider_{joint}", f(along - turned), "axis in the slider") for f in (sp.cos, sp.sin)
    )
    return cos, sin

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
class ContactPoint:
    """One contact point, with its name in the file ("guide.front_upper"), in code, and the points of both bodies.

    The radii of `pair` are lever arms of the contact (for a corner: half the guide's width, ρ). Those of
    `law_symbols` give the
    stiffness: a wall is flat, R_i = ∞.
    """

    name: str
    label: str
    first: PointFrame
    second: PointFrame
    pair: PairSymbols
    law_symbols: PairSymbols
    wall: Wall | None = None


def iterate_contact_points(
    joint: Joint, dimensions: Bearing | Guide, geometry: Geometry, parameter_table: ParameterTable
) -> Iterator[ContactPoint]:
    """Yield the contact points of a joint with play: one of a revolute joint, four of a translational one.

    `dimensions`: dimensions of the bearing or guide, which become parameters in `parameter_table`.
    """
    if isinstance(dimensions, Guide):
        yield from _make_corner_points(joint, dimensions, geometry, parameter_table)
        return
    bearing_symbols = _make_bearing_symbols(dimensions, parameter_table)
    yield ContactPoint(
        joint.name,
        joint.name,
        geometry.find_point(joint.first),
        geometry.find_point(joint.second),
        bearing_symbols,
        bearing_symbols,
    )


def _make_bearing_symbols(bearing: Bearing, parameter_table: ParameterTable) -> PairSymbols:
    """Return radii, clearance, length and elastic constants of a bearing and its journal, as symbols of parameters.

    The radius R_j of the journal is a derived parameter: the bearing's radius R_i less the clearance c.
    """
    R_i, c = (
        parameter_table.get_or_add_parameter(bearing.radius),
        parameter_table.get_or_add_parameter(bearing.clearance),
    )
    R_j = parameter_table.derive_parameter(f"R_j_{bearing.name}", R_i - c, "journal radius")
    return PairSymbols(
        R_i,
        R_j,
        c,
        parameter_table.get_or_add_parameter(bearing.length),
        *_make_elastic_constants(bearing, parameter_table),
    )


def _make_elastic_constants(dimensions: Bearing | Guide, parameter_table: ParameterTable) -> list[sp.Expr]:
    """Return [E_i, ν_i, E_j, ν_j] of bearing i and journal j (or guide and slider) as parameters; E in Pa."""
    materials = dimensions.bearing_material, dimensions.journal_material
    return [
        parameter_table.get_or_add_parameter(material.numbers[key]) for material in materials for key in ("E", "nu")
    ]


def _make_corner_points(
    joint: Joint, guide: Guide, geometry: Geometry, parameter_table: ParameterTable
) -> Iterator[ContactPoint]:
    """Yield the four corners of a slider in its guide as contact points, each with its wall.

    The distances of the corners from the slider's point become derived parameters. Names in code are
    "<joint>_<corner>", with underscores appended until no joint has the name. Without a corner radius in `guide` the
    radius is 0.
    """
    first = geometry.find_point(joint.first)
    a, b, c = (
        parameter_table.get_or_add_parameter(quantity) for quantity in (guide.half_length, guide.half_height, guide.gap)
    )
    radius = sp.Integer(0) if guide.corner_radius is None else parameter_table.get_or_add_parameter(guide.corner_radius)
    distances = (("reach", a - radius, "half-length"), ("rise", b - radius, "half-height"))
    axial_distance, normal_distance = (
        parameter_table.derive_parameter(f"{symbol_name}_{guide.name}", x, f"{meaning} less radius")
        for symbol_name, x, meaning in distances
    )
    width = parameter_table.derive_parameter(f"half_width_{guide.name}", b + c, "half the guide's width")
    corner_symbols = PairSymbols(width, radius, c, sp.nan, *_make_elastic_constants(guide, parameter_table))
    fields = JointFields(joint, geometry)
    axis_x, axis_y = first.direction(fields.direction("axis"))
    along_x, along_y = _find_axis_in_slider(fields, parameter_table, joint.name)
    used_names = set(geometry.mechanism.joints)
    for corner, (front, upper) in CORNERS.items():
        label = f"{joint.name}_{corner}"
        while label in used_names:
            label += "_"
        x, y = front * axial_distance, upper * normal_distance
        offset = (along_x * x - along_y * y, along_y * x + along_x * y)
        wall = Wall((-upper * axis_y, upper * axis_x), normal_distance)
        second = geometry.find_point_at_offset(joint.second, offset, label)
        yield ContactPoint(
            f"{joint.name}.{corner}", label, first, second, corner_symbols, replace(corner_symbols, R_i=sp.oo), wall
        )


def _find_axis_in_slider(
    fields: JointFields, parameter_table: ParameterTable, joint_name: str
) -> tuple[sp.Expr, sp.Expr]:
    """Return (cos, sin) of the guide's axis in the slider's frame, with the slider at the joint's prescribed angle.

    The result is (1, 0) if the prescribed angle is that of the axis. Otherwise the components are derived parameters
    with `joint_name` in their names.
    """
    axis_angle = fields.derive_vector_angle("axis")
    slider_angle = fields.quantity("angle", axis_angle)
    if slider_angle == axis_angle:
        return sp.Integer(1), sp.Integer(0)
    cos, sin = (
        parameter_table.derive_parameter(
            f"{function.__name__}_slider_{joint_name}", function(axis_angle - slider_angle), "axis in the slider"
        )
        for function in (sp.cos, sp.sin)
    )
    return cos, sin

"""Check the Newton–Euler equations of single bodies at samples, with the reported forces.

For each body, m a − m g − ΣF and J α − Σ(M + r × F) are computed in C (engine/scene/body_balance.c) from the table of
forces that is built here, from the description of the scene. From the derived equations only reported results enter:
accelerations, reactions, drive torques, forces of elements, friction and contacts, and masses. Left out are bodies of
joints with a third body (gears, cams), of rigid contacts, of length drives and of undetermined reactions. Moments of
bodies of joints with play are left out too.
"""

from __future__ import annotations

import json
from typing import Any, NamedTuple

import numpy as np

from gudgeon.contract.boundary import (
    FORCE_CLEARANCE,
    FORCE_COMPONENTS,
    FORCE_DRIVE,
    FORCE_FRICTION,
    FORCE_MOMENT,
    FORCE_REACTION,
    FORCE_SPRING,
)
from gudgeon.contract.kernel_source import KernelSource, PartInfo, PointInfo
from gudgeon.model.arrays import FLAG, as_c_array, set_struct_pointers
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.evaluation import Evaluation

# for each kind of element: its kind in C, and the result that is its force or moment
ELEMENTS = {
    "spring_damper": (FORCE_SPRING, "F"),
    "force": (FORCE_COMPONENTS, "Fx"),
    "dry_friction": (FORCE_FRICTION, ""),
    "torque": (FORCE_MOMENT, "M"),
    "rotational_spring_damper": (FORCE_MOMENT, "M"),
    "angle": (FORCE_DRIVE, "M"),
}
GROUND = PointInfo("", -1, -1, -1)
Number = tuple[int, float]  # index into the parameter values p, or −1 and the value itself
RESULTS = ("a", "reactions", "torques", "clearance", "series", "friction")  # fields of an Evaluation that C reads


class BodyForce(NamedTuple):
    """Describe a force or moment on the second body at a point, and its opposite on the first, as C's BodyForce."""

    kind: int
    first: int
    second: int  # indices of bodies; −1: ground
    column: int  # of the result of its kind
    at: tuple[int, int, int, int, int] = (-1, -1, -1, 1, 1)  # body, x, y and signs of a PointInfo
    origin: tuple[int, int, int, int, int] = (-1, -1, -1, 1, 1)  # the other end of a spring
    direction: tuple[int, int] = (-1, -1)  # of friction: parameters, or −1 for the number
    component: tuple[float, float] = (0.0, 0.0)


@cache_by_values
def make_body_force_table(compiled: CompiledModel) -> tuple[Any, tuple[Any, ...]]:
    """Return C's struct BodyForceTable of a scene, and its arrays, which the caller keeps.

    It lists which forces act on which bodies: joints first, then elements, then joints with play. On some bodies not
    all forces or moments are known.
    """
    source, ffi = compiled.source, compiled.ffi
    points_by_name = {point.name: point for point in source.points}
    bodies = {"ground", *(body.name for body in source.bodies)}
    elements_of_parts = [(part, _build_element(source, part)) for part in source.parts if part.section != "joints"]
    excluded_bodies = {
        name.partition(".")[0]
        for part in source.parts
        for name in (*part.ends, *part.options.values())
        if part.name in source.indeterminate
        or part.name in source.rigid_joints
        or (part, None) in elements_of_parts
        or (part.section == "joints" and bodies.intersection(part.options.values()))
    }
    forces = [
        BodyForce(FORCE_REACTION, joint.first, joint.second, k, _list_members(points_by_name[joint.point]))
        for k, joint in enumerate(source.joints)
    ]
    forces += [element for _, element in elements_of_parts if element]
    forces += [BodyForce(FORCE_CLEARANCE, x.first, x.second, k) for k, x in enumerate(source.clearances)]
    has_known_forces = np.array([body.name not in excluded_bodies for body in source.bodies]).astype(FLAG)
    has_known_moments = has_known_forces.copy()
    has_known_moments[[body for x in source.clearances for body in (x.first, x.second) if body >= 0]] = 0
    arrays = {"has_known_forces": has_known_forces, "has_known_moments": has_known_moments}
    struct, rows = ffi.new("BodyForceTable *"), ffi.new("BodyForce[]", forces)
    set_struct_pointers(ffi, struct, arrays)
    struct.n_forces, struct.forces = len(forces), rows
    struct.gravity = [source.parameter_indices.get(f"gravity.{axis}", -1) for axis in "xy"]
    return struct, (rows, arrays)


def _list_members(point: PointInfo) -> tuple[int, int, int, int, int]:
    """Return the members of C's BodyPoint for a point."""
    return point.body, point.x, point.y, point.sign_x, point.sign_y


def _build_element(source: KernelSource, part: PartInfo) -> BodyForce | None:
    """Build the BodyForce of a force element or drive of the file.

    With one end, the ground is the first body. The ends of moments are exchanged, since reported moments act on the
    first body. Return None for other kinds, unknown ends, and friction whose direction is an expression.
    """
    bodies = {body.name: PointInfo("", body.index, -1, -1) for body in source.bodies}
    points_by_name = bodies | {point.name: point for point in source.points}
    if part.kind not in ELEMENTS or not points_by_name.keys() >= set(part.ends):
        return None
    (kind, result), ends = ELEMENTS[part.kind], [points_by_name[name] for name in part.ends]
    first, second = ends if len(ends) == 2 else (GROUND, ends[0])
    if result == "M" and len(ends) == 2:  # reported moments act on the first body
        first, second = second, first
    force = BodyForce(kind, first.body, second.body, 0, _list_members(second), _list_members(first))
    if part.kind == "dry_friction":
        x, y = (_resolve_number(source, f"forces.{part.name}.direction.{axis}") for axis in "xy")
        if not (x and y):
            return None
        force = force._replace(direction=(x[0], y[0]), component=(x[1], y[1]))
        return force._replace(column=source.frictions.index(part.name))
    if part.section == "drives":
        return force._replace(column=[drive.name for drive in source.drives].index(part.name))
    return force._replace(column=[series.name for series in source.series].index(f"{part.name}.{result}"))


def _resolve_number(source: KernelSource, address: str) -> Number | None:
    """Return the number at an address of the file as (index into p, 0) or (−1, value); None if it is an expression."""
    if address in source.parameter_indices:
        return source.parameter_indices[address], 0.0
    trees = [json.loads(expression.tree) for expression in source.file_expressions if expression.address == address]
    return (-1, float(trees[0])) if trees and isinstance(trees[0], int | float) else None


def compute_newton_euler_residuals(compiled: CompiledModel, p: Array, q: Array, evaluation: Evaluation) -> Array:
    """Return the residuals of each body's Newton–Euler equations at samples, relative to the largest force or moment.

    The largest one is taken over all samples and bodies. The shape is (k, n_bodies) for coordinates `q` (k, n) and the
    `evaluation` of the k samples. Bodies that are left out have 0, and so do those with forces that are not finite.
    """
    residuals = np.zeros((len(q), len(compiled.source.bodies)))
    arrays = [as_c_array(values, "values") for values in (q, p, *(getattr(evaluation, name) for name in RESULTS))]
    table, _ = make_body_force_table(compiled)
    pointers = [compiled.pointer(array) for array in arrays]
    compiled.lib.gudgeon_body_residuals(len(q), table, *pointers, compiled.pointer(residuals, is_written=True))
    return residuals

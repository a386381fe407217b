"""Check the Newton–Euler equations of single bodies at samples, with the reported forces.

For each body, m a − m g − ΣF and J α − Σ(M + r × F) are computed from the description of the scene. From the derived
equations only reported results enter: accelerations, reactions, drive torques, forces of elements, friction and
contacts, and masses. Left out are bodies of joints with a third body (gears, cams), of rigid contacts, of length drives
and of undetermined reactions. Moments of bodies of joints with play are left out too.
"""

from __future__ import annotations

import json
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import KernelSource, PartInfo, PointInfo
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.evaluation import Evaluation

# for each kind of element, the result that is its force or moment
ELEMENTS = {
    "spring_damper": "F",
    "force": "Fx",
    "dry_friction": "",
    "torque": "M",
    "rotational_spring_damper": "M",
    "angle": "M",
}
MIN_DIVISOR = 1e-300  # N, N m: smallest divisor
GROUND = PointInfo("", -1, -1, -1)
Number = tuple[int, float]  # index into the parameter values p, or −1 and the value itself


@dataclass(frozen=True)
class Element:
    """Describe a force element or drive: its force and moment act on the second body, the opposite on the first."""

    kind: str
    first: PointInfo
    second: PointInfo  # points at which force and moment act
    column: int  # of the reported series, frictions or torques
    direction: tuple[Number, ...] = ()  # of friction, in the first body's frame


@dataclass(frozen=True)
class ForceTable:
    """Hold which forces act on which bodies of a scene: joints first, then elements, then joints with play."""

    signs: Array  # (n_bodies, n_forces) 1 for a force on the second body, −1 for its reaction
    with_known_forces: NDArray[np.intp]  # bodies on which all forces are known
    with_known_moments: NDArray[np.intp]  # bodies on which all moments are known, too
    signs_of_moments: Array  # (n_bodies_with_known_moments, n_joints + n_elements) the rows of `signs` of these bodies
    points: tuple[PointInfo, ...]  # (n_joints + n_elements,) at which the forces act
    elements: tuple[Element, ...]
    gravity: tuple[tuple[int, int], ...]  # given components: axis, index into p


def get_force_table(source: KernelSource) -> ForceTable:
    """Return the table of forces of a scene, built at the first call and cached in `source`."""
    cache = source.__dict__
    if "newton_euler" not in cache:
        cache["newton_euler"] = _build_force_table(source)
    table: ForceTable = cache["newton_euler"]
    return table


def _build_force_table(source: KernelSource) -> ForceTable:
    """Build the table of forces of a scene: which forces act on which bodies, and on which bodies all of them are
    known.
    """
    points_by_name, n = {point.name: point for point in source.points}, len(source.bodies)
    points = [points_by_name[joint.point] for joint in source.joints]
    bodies = {"ground", *(body.name for body in source.bodies)}
    elements_of_parts = [(part, _build_element(source, part)) for part in source.parts if part.section != "joints"]
    elements = tuple(element for _, element in elements_of_parts if element)
    excluded_bodies = {
        name.partition(".")[0]
        for part in source.parts
        for name in (*part.ends, *part.options.values())
        if part.name in source.indeterminate
        or part.name in source.rigid_joints
        or (part, None) in elements_of_parts
        or (part.section == "joints" and bodies.intersection(part.options.values()))
    }
    pairs = [(joint.first, joint.second) for joint in source.joints]
    pairs += [(element.first.body, element.second.body) for element in elements]
    n_pairs = len(pairs)
    pairs += [(joint.first, joint.second) for joint in source.clearances]
    signs = np.zeros((n + 1, len(pairs)))  # the last row is the ground's
    for k, (first, second) in enumerate(pairs):
        signs[first, k], signs[second, k] = -1.0, 1.0
    signs = signs[:n]
    has_known_forces = ~np.array([body.name in excluded_bodies for body in source.bodies], dtype=bool)
    has_known_moments = has_known_forces & ~signs[:, n_pairs:].any(axis=1)
    gravity_components = (
        (0, source.parameter_indices.get("gravity.x")),
        (1, source.parameter_indices.get("gravity.y")),
    )
    return ForceTable(
        signs,
        np.flatnonzero(has_known_forces),
        np.flatnonzero(has_known_moments),
        signs[has_known_moments, :n_pairs],
        (*points, *(element.second for element in elements)),
        elements,
        tuple((axis, k) for axis, k in gravity_components if k is not None),
    )


def _build_element(source: KernelSource, part: PartInfo) -> Element | None:
    """Build the Element of a force element or drive of the file.

    With one end, the ground is the first body. The ends of moments are exchanged, since reported moments act on the
    first body. Return None for other kinds, unknown ends, and friction whose direction is an expression.
    """
    bodies = {body.name: PointInfo("", body.index, -1, -1) for body in source.bodies}
    points_by_name = bodies | {point.name: point for point in source.points}
    if part.kind not in ELEMENTS or not points_by_name.keys() >= set(part.ends):
        return None
    ends = [points_by_name[name] for name in part.ends]
    first, second = ends if len(ends) == 2 else (GROUND, ends[0])
    if ELEMENTS[part.kind] == "M" and len(ends) == 2:  # reported moments act on the first body
        first, second = second, first
    if part.kind == "dry_friction":
        x, y = (_resolve_number(source, f"forces.{part.name}.direction.{axis}") for axis in "xy")
        return Element(part.kind, first, second, source.frictions.index(part.name), (x, y)) if x and y else None
    if part.section == "drives":
        return Element(part.kind, first, second, [drive.name for drive in source.drives].index(part.name))
    name = f"{part.name}.{ELEMENTS[part.kind]}"
    return Element(part.kind, first, second, [series.name for series in source.series].index(name))


def _resolve_number(source: KernelSource, address: str) -> Number | None:
    """Return the number at an address of the file as (index into p, 0) or (−1, value); None if it is an expression."""
    if address in source.parameter_indices:
        return source.parameter_indices[address], 0.0
    trees = [json.loads(expression.tree) for expression in source.file_expressions if expression.address == address]
    return (-1, float(trees[0])) if trees and isinstance(trees[0], int | float) else None


def compute_newton_euler_residuals(compiled: CompiledModel, p: Array, q: Array, evaluation: Evaluation) -> Array:
    """Return the residuals of each body's Newton–Euler equations at samples, relative to the largest force or moment.

    The largest one is taken over all samples and bodies. The shape is (k, n_bodies) for coordinates `q` (k, n) and the
    `evaluation` of the k samples. Bodies that are left out have 0.
    """
    table, n = get_force_table(compiled.source), len(q)
    residuals = np.zeros((n, len(compiled.source.bodies)))
    if not len(table.with_known_forces) or not n:
        return residuals
    m = compiled.mass(p)
    inertia = (evaluation.a * m).reshape(n, -1, 3)
    q = q.reshape(n, -1, 3)
    wrenches = np.concatenate(
        [
            evaluation.reactions[:, : len(compiled.source.joints)],
            *(_compute_element_wrench(element, p, q, evaluation)[:, np.newaxis] for element in table.elements),
        ],
        axis=1,
    )
    forces = np.concatenate([wrenches[:, :, :2], evaluation.clearance[:, :, :2]], axis=1)
    residual = inertia[:, :, :2] - table.signs @ forces
    for axis, k in table.gravity:
        residual[:, :, axis] -= m[::3] * p[k]
    largest = max(np.abs(inertia[:, :, :2]).max(), np.abs(forces).max(initial=0.0), MIN_DIVISOR)
    residuals[:, table.with_known_forces] = np.abs(residual[:, table.with_known_forces]).max(axis=2) / largest
    if len(table.with_known_moments):
        moments, longest = _compute_moments(table, p, q, wrenches)
        differences = np.abs(inertia[:, table.with_known_moments, 2] - moments.sum(axis=2))
        differences /= max(np.abs(moments).max(initial=0.0), largest * longest, MIN_DIVISOR)
        residuals[:, table.with_known_moments] = np.maximum(residuals[:, table.with_known_moments], differences)
    return residuals


def _compute_element_wrench(element: Element, p: Array, q: Array, evaluation: Evaluation) -> Array:
    """Return force and moment (n, 3) in N and N m of an element on its second body at the samples.

    `q` (n, n_bodies, 3): coordinates of the bodies there.
    """
    wrench = np.zeros((len(q), 3))
    if element.kind == "angle":
        wrench[:, 2] = evaluation.torques[:, element.column]
    elif element.kind == "dry_friction":
        u_x, u_y = (p[k] if k >= 0 else value for k, value in element.direction)
        theta = q[:, element.first.body, 2] * (element.first.body >= 0)
        force = evaluation.friction[:, element.column, 0] / np.hypot(u_x, u_y)
        wrench[:, 0] = force * (np.cos(theta) * u_x - np.sin(theta) * u_y)
        wrench[:, 1] = force * (np.sin(theta) * u_x + np.cos(theta) * u_y)
    elif element.kind == "spring_damper":
        span = _compute_point_coordinates(element.first, p, q) - _compute_point_coordinates(element.second, p, q)
        length = np.maximum(np.hypot(span[:, 0], span[:, 1]), MIN_DIVISOR)
        wrench[:, :2] = (evaluation.series[:, element.column] / length)[:, np.newaxis] * span
    elif element.kind == "force":
        wrench[:, :2] = evaluation.series[:, element.column : element.column + 2]
    else:
        wrench[:, 2] = evaluation.series[:, element.column]
    return wrench


def _compute_point_coordinates(point: PointInfo, p: Array, q: Array) -> Array:
    """Return the ground coordinates (n, 2) in m of a point of a body or of the ground; q is (n, n_bodies, 3)."""
    x = point.sign_x * p[point.x] if point.x >= 0 else 0.0
    y = point.sign_y * p[point.y] if point.y >= 0 else 0.0
    body = q[:, point.body] * (point.body >= 0)
    c, s = np.cos(body[:, 2]), np.sin(body[:, 2])
    return np.column_stack([body[:, 0] + c * x - s * y, body[:, 1] + s * x + c * y])


def _compute_moments(table: ForceTable, p: Array, q: Array, wrenches: Array) -> tuple[Array, float]:
    """Return the moments (n, n_bodies, n_forces) in N m about centres of mass, and the longest arm in m.

    The bodies are those with known moments, the forces those of joints and elements. q is (n, n_bodies, 3). The longest
    arm scales the rounding errors: forces at a body's own centre of mass have no arm.
    """
    points = (
        np.array([_compute_point_coordinates(point, p, q) for point in table.points])
        .reshape(-1, len(q), 2)
        .swapaxes(0, 1)
    )
    arms = points[:, np.newaxis] - q[:, :, np.newaxis, :2]
    acts_on_body = table.signs[:, : len(table.points)] != 0.0
    longest = float((np.hypot(arms[..., 0], arms[..., 1]) * acts_on_body).max(initial=0.0))
    arm = arms[:, table.with_known_moments]
    F, M = wrenches[:, np.newaxis, :, :2], wrenches[:, np.newaxis, :, 2]
    return np.asarray(table.signs_of_moments * (M + arm[..., 0] * F[..., 1] - arm[..., 1] * F[..., 0])), longest

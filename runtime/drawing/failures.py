"""Draw the faults that `check` reports: joints that do not close, unconnected bodies, degrees of freedom."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gudgeon.assembly.closure import AssemblyProblem
from gudgeon.assembly.failures import format_length
from gudgeon.assembly.mobility import compute_admissible_velocities
from gudgeon.contract.kernel_source import PartInfo
from gudgeon.drawing.configuration import Configuration, get_joint_type
from gudgeon.drawing.drives_and_forces import HEAD_LENGTH, draw_arrow, draw_round_arrow, find_pivot
from gudgeon.drawing.joint_geometry import JointGeometry
from gudgeon.drawing.shapes import Label, Line, Shape, unit_vector
from gudgeon.model.compiled import Array

MIN_REPORTED_FRACTION = 1e-3  # fraction of the largest residual above which a residual is reported
ARROW_LENGTH = 4.0  # units, of an arrow along a degree of freedom
MIN_MOTION_FRACTION = 1e-6  # fraction of the largest motion below which a body counts as fixed


def draw_gaps(problem: AssemblyProblem, configuration: Configuration) -> tuple[list[Shape], list[Label]]:
    """Return red lines across the gaps of a linkage that does not close, and labels with the residuals of all open
    joints.

    Reported are residuals above MIN_REPORTED_FRACTION times the largest one. A length without a line and an angle have
    a label only.
    """
    residual = problem.compute_residual(configuration.q)
    scaled = np.abs(residual / problem.row_scale)
    max_residual = float(scaled.max(initial=0.0))
    open_rows: dict[str, list[int]] = {}
    for row, owner in enumerate(problem.owners):
        if max_residual > 0.0 and scaled[row] > MIN_REPORTED_FRACTION * max_residual:
            open_rows.setdefault(owner, []).append(row)
    shapes, labels = list[Shape](), list[Label]()
    for owner, row_indices in open_rows.items():
        for part in configuration.find_parts(owner):
            part_lengths = [residual[row] for row in row_indices if problem.units[row] == "m"]
            angles = [residual[row] for row in row_indices if problem.units[row] == "rad"]
            gap_line = _compute_gap_line(configuration, part, part_lengths) if part_lengths else None
            if gap_line is not None:
                shapes.append(Line(f"gap {owner}", "gap", gap_line))
                part_lengths, position = [float(np.hypot(*(gap_line[1] - gap_line[0])))], gap_line.mean(axis=0)
            elif part_lengths:
                position = get_joint_type(part).symbol.find_name_position(JointGeometry(configuration, part))
            else:
                position = find_pivot(configuration, part)
            texts = [format_length(length) for length in part_lengths] + [
                f"{np.degrees(angle):.3g}°" for angle in angles
            ]
            labels.append(Label(f"gap {owner}", "gap", f"{owner}: {', '.join(texts)}", position, direction=90.0))
    return shapes, labels


def _compute_gap_line(configuration: Configuration, part: PartInfo, lengths: list[float]) -> Array | None:
    """Return the line between the actual and the required end of a joint, driven coordinate or distance, (2, 2), m.

    `lengths` are the residuals in m. Returns None for a joint whose symbol declares no gap line.
    """
    if part.section == "joints":
        gap = get_joint_type(part).symbol.find_closure_error
        return np.array(gap(JointGeometry(configuration, part), lengths)) if gap else None
    if part.kind == "coordinate":
        k = "xy".index(part.options["coordinate"])
        point = configuration.get_position(part.ends[0])
        return np.array([point, point - lengths[0] * np.eye(2)[k]])
    begin, end = (configuration.get_position(name) for name in part.ends)
    return np.array([begin + (float(np.hypot(*(end - begin))) - lengths[0]) * unit_vector(end - begin), end])


def draw_degrees_of_freedom(
    problem: AssemblyProblem, configuration: Configuration, unit: float, unconnected_bodies: tuple[str, ...]
) -> tuple[list[Shape], list[Label]]:
    """Return arrows along the degrees of freedom of a closed linkage that no drive prescribes, and labels.

    The arrows are motions of each body in the null space of the constraint Jacobian. Motions below MIN_MOTION_FRACTION
    of the largest one are not drawn. Bodies in `unconnected_bodies` have the label "NAME is unconnected". `unit` is
    half a bar's width in m.
    """
    motions = compute_admissible_velocities(problem.linkage, problem.p, configuration.q, problem.t)
    max_motion = float(np.abs(motions * np.where(problem.is_angle, problem.size, 1.0)[:, None]).max(initial=0.0))
    shapes, labels = list[Shape](), list[Label]()
    for body, info in configuration.bodies.items():
        body_motions = motions[info.index : info.index + 3]
        body_shapes = list(
            _draw_motion_arrows(
                body_motions,
                configuration.get_centre_of_mass(body),
                body,
                unit,
                MIN_MOTION_FRACTION * max_motion,
                problem.size,
            )
        )
        shapes += body_shapes
        if body in unconnected_bodies:
            labels.append(
                Label(
                    f"free {body}", "free", f"{body} is unconnected", configuration.get_centre_of_mass(body), 1.5 * unit
                )
            )
    return shapes, labels


def _draw_motion_arrows(
    motions: Array, centre: Array, body: str, unit: float, min_motion: float, size: float
) -> Iterator[Shape]:
    """Yield double arrows along each direction in which the centre of a body can move, and a round arrow for a
    rotation.

    `motions` (3, k) are the body's parts of k motions in the null space of the constraint Jacobian. If the centre moves
    in both directions, the double arrows are along x and y. With one direction no round arrow is drawn. A motion below
    `min_motion` (m) counts as none; `size` (m) converts angles to lengths. `unit`: half a bar's width, m.
    """
    part, head_length = f"free {body}", HEAD_LENGTH * unit
    directions, singular_values, _ = np.linalg.svd(motions[:2], full_matrices=False)
    free_directions = [
        direction
        for direction, singular_value in zip(directions.T, singular_values, strict=True)
        if singular_value > min_motion
    ]
    if len(free_directions) > 1:
        free_directions = [np.array([1.0, 0.0]), np.array([0.0, 1.0])]
    for direction in free_directions:
        for sign in (1.0, -1.0):
            yield from draw_arrow(
                part,
                "free",
                centre + sign * unit * direction,
                centre + sign * ARROW_LENGTH * unit * direction,
                head_length,
            )
    shows_rotation = not free_directions or len(free_directions) > 1
    if shows_rotation and float(np.abs(motions[2]).max(initial=0.0)) * size > min_motion:
        yield from draw_round_arrow(part, "free", centre, 3.4 * unit, True, head_length)

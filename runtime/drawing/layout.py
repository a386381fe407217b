"""Define the layout that all drawings of one motion share, so that animations do not jump: sizes, ground, extent."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from gudgeon.contract.kernel_source import PartInfo
from gudgeon.drawing.configuration import (
    GROUND,
    Configuration,
    find_outline_points,
    get_body_name,
    get_joint_type,
    remove_repeated_positions,
)
from gudgeon.drawing.joint_geometry import JointGeometry, find_sliding_axis, has_rail, iterate_sliding_joints
from gudgeon.drawing.shapes import rotate_quarter_turn, unit_vector
from gudgeon.model.compiled import Array

# mean offset, as a fraction of the size, from which the ground's points, or all points, count as on one side of a guide
MIN_SIDE_OFFSETS = (0.03, 0.1)
MIN_VISIBLE_CLEARANCE = 3.0  # units, above which a clearance needs no magnification
# half a bar's width as a fraction of the whole, its minimum, and its maximum as a fraction of the shortest link
UNIT_FRACTION, MIN_UNIT_FRACTION, MAX_LINK_FRACTION = 0.017, 0.005, 0.16


@dataclass(frozen=True, eq=False)
class Layout:
    """Layout of the drawings of a scene.

    `unit`: half a bar's width (m). `ground_directions`: for a joint, cylinder or spring on the ground the direction of
    the ground from it, (2,). `travel`: for a sliding joint the smallest and largest position along its axis (m), over
    all configurations. `metres_per_newton`: drawn length of an applied force of 1 N (m); 0: all have one length.
    """

    unit: float
    ground_directions: Mapping[str, Array]
    travel: Mapping[str, tuple[float, float]]
    metres_per_newton: float = 0.0


def make_layout(configurations: Sequence[Configuration], start_configuration: Configuration | None = None) -> Layout:
    """Return the layout for the drawings of one configuration, or of several configurations of a motion.

    The side of the ground at a guide follows from `start_configuration`, so that all drawings of a mechanism agree;
    None: the first configuration.
    """
    first_configuration, start_configuration = configurations[0], start_configuration or configurations[0]
    positions = np.array(
        [position for configuration in configurations for position in _collect_drawn_points(configuration)]
    )
    ground_directions, travel = dict[str, Array](), dict[str, tuple[float, float]]()
    for part in iterate_sliding_joints(first_configuration):
        slider_positions = [_compute_slider_position(configuration, part) for configuration in configurations]
        travel[part.name] = min(slider_positions), max(slider_positions)
    for part in first_configuration.iterate_parts("joints"):
        if any(get_body_name(end) == GROUND for end in part.ends):
            ground_directions[part.name] = (
                _find_rail_side(start_configuration, part)
                if has_rail(part)
                else _find_pin_ground_direction(configurations, part)
            )
    for part in (
        *first_configuration.iterate_parts("drives", "distance"),
        *first_configuration.iterate_parts("forces", "spring_damper"),
    ):
        if any(get_body_name(end) == GROUND for end in part.ends):
            ground_directions[part.name] = _find_element_ground_direction(configurations, part)
    return Layout(_compute_bar_half_width(first_configuration, positions), ground_directions, travel)


def _collect_drawn_points(configuration: Configuration) -> list[Array]:
    """Return all points that a drawing must contain, each (2,), in m.

    They are the points of bodies and parts, and corners of boxes around wheels, journals' clearances and sliders with
    play.
    """
    points = [
        position for body in configuration.bodies for position in find_outline_points(configuration, body).values()
    ]
    points += [
        configuration.get_position(end)
        for part in configuration.source.parts
        for end in part.ends
        if end in configuration.points
    ]
    for part in configuration.iterate_parts("joints"):
        radii = get_joint_type(part).symbol.find_radii
        for end, radius in zip(part.ends, radii(JointGeometry(configuration, part)), strict=True) if radii else ():
            if radius > 0.0:
                points += [configuration.get_position(end) + offset for offset in radius * np.array([[1, 1], [-1, -1]])]
    for joint in configuration.source.clearances:
        half_size = (
            configuration.get_slider_dimensions(joint)[1]
            if joint.is_corner
            else configuration.get_clearance(joint.name)
        )
        offsets = half_size * np.array([[1, 1], [-1, -1]])
        points += [
            configuration.get_position(next(configuration.find_parts(joint.joint)).ends[0]) + offset
            for offset in offsets
        ]
    return points


def _compute_bar_half_width(configuration: Configuration, positions: Array) -> float:
    """Return half a bar's width in m, from the size of the drawing and its shortest link.

    It is MAX_LINK_FRACTION of the shortest link, at least MIN_UNIT_FRACTION and at most UNIT_FRACTION of the size.
    The size is the larger side of the box of `positions` (N, 2), all drawn points. The shortest link is the least
    distance of two outline points of a body that exceeds 1e-3 of the size. If all points coincide, the result is
    UNIT_FRACTION of the file's largest length, or of 1 m without lengths.
    """
    drawing_size = float(np.ptp(positions, axis=0).max())
    if not drawing_size > 0.0:  # all points coincide
        lengths = (
            abs(configuration.get_parameter(parameter.address))
            for parameter in configuration.source.parameters
            if parameter.unit == "m"
        )
        return UNIT_FRACTION * (max(lengths, default=0.0) or 1.0)
    spans = []
    for body in configuration.bodies:
        outline_points = remove_repeated_positions(find_outline_points(configuration, body).values())
        spans += [float(np.hypot(*(a - b))) for k, a in enumerate(outline_points) for b in outline_points[:k]]
    shortest = min((span for span in spans if span > 1e-3 * drawing_size), default=drawing_size)
    return max(MIN_UNIT_FRACTION * drawing_size, min(UNIT_FRACTION * drawing_size, MAX_LINK_FRACTION * shortest))


def is_visible_to_scale(configuration: Configuration, joint: str, unit: float) -> bool:
    """Return whether a joint's clearance exceeds MIN_VISIBLE_CLEARANCE units, so that it needs no magnified inset."""
    return configuration.get_clearance(joint) > MIN_VISIBLE_CLEARANCE * unit


def _compute_slider_position(configuration: Configuration, part: PartInfo) -> float:
    """Return the coordinate of a sliding joint's slider along its line, in m."""
    line_point, axis, slider = find_sliding_axis(configuration, part)
    return float((slider - line_point) @ axis)


def _find_rail_side(start_configuration: Configuration, part: PartInfo) -> Array:
    """Return the direction of the ground at a guide, a unit vector across its axis.

    It points away from the mean of the ground's points, or else of all points at `start_configuration`. If both means
    are within MIN_SIDE_OFFSETS of the guide, it points down or to the right.
    """
    line_point, axis, slider = find_sliding_axis(start_configuration, part)
    normal = rotate_quarter_turn(axis)
    ground = [
        start_configuration.get_position(name) for name in start_configuration.points if get_body_name(name) == GROUND
    ]
    for positions, reference, min_offset in (
        (ground, line_point, MIN_SIDE_OFFSETS[0]),
        (_collect_drawn_points(start_configuration), slider, MIN_SIDE_OFFSETS[1]),
    ):
        offset = float((np.array(positions) - reference).mean(axis=0) @ normal)
        if abs(offset) > min_offset * float(np.ptp(positions, axis=0).max()):
            return normal if offset < 0.0 else -normal
    down = float(normal @ np.array([0.3, -1.0]))
    return normal if down > 0.0 else -normal


def _find_pin_ground_direction(configurations: Sequence[Configuration], part: PartInfo) -> Array:
    """Return the unit vector from a pin to the ground: down if no point of its bodies lies within 50° of that
    direction.

    Otherwise it is the axis direction with the fewest points of the pin's bodies within 50°, over all configurations.
    The bodies are those of all joints at the pin that hold their points.
    """
    end = next(end for end in part.ends if get_body_name(end) == GROUND)
    first, angles = configurations[0], []
    pin = first.get_position(end)
    holding_joints = [joint for joint in first.iterate_parts("joints") if get_joint_type(joint).has_coincident_points]
    bodies = {
        body
        for joint_at_pin in holding_joints
        for body in map(get_body_name, joint_at_pin.ends)
        if body != GROUND
        and any(np.abs(first.get_position(end_name) - pin).max() < 1e-9 for end_name in joint_at_pin.ends)
    }
    for configuration in configurations:
        spans = [
            position - pin for body in sorted(bodies) for position in find_outline_points(configuration, body).values()
        ]
        angles += [np.arctan2(y, x) for x, y in spans if np.hypot(x, y) > 1e-9]
    directions = np.array([[0.0, -1.0], [-1.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    if not angles:
        return directions[0]
    distances = [_compute_angular_distances(np.array(angles), float(np.arctan2(y, x))) for x, y in directions]
    fractions = [float((distance < np.radians(50.0)).mean()) for distance in distances]
    return directions[0] if fractions[0] == 0.0 else directions[int(np.argmin(fractions))]


def _find_element_ground_direction(configurations: Sequence[Configuration], part: PartInfo) -> Array:
    """Return the direction of the ground at the ground end of a drive or spring, a unit vector.

    It points away from the other end, on average over the configurations. If the average is shorter than
    MIN_SIDE_OFFSETS[0], it is that of the first configuration.
    """
    ground_end, other_end = sorted(part.ends, key=lambda end: get_body_name(end) != GROUND)
    spans = [
        configuration.get_position(ground_end) - configuration.get_position(other_end)
        for configuration in configurations
    ]
    mean = np.sum([unit_vector(span) for span in spans], axis=0)
    return unit_vector(mean if float(np.hypot(*mean)) > MIN_SIDE_OFFSETS[0] * len(spans) else spans[0])


def _compute_angular_distances(angles: Array, direction: float) -> Array:
    """Return the absolute differences of angles from a direction, in rad, from 0 to π, with the shape of `angles`."""
    return np.asarray(np.abs((angles - direction + np.pi) % (2.0 * np.pi) - np.pi))

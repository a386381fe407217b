"""Own the layout that all drawings of a scene share, so that a motion does not make them jump: size of symbols, ground
sides, travel.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from gudgeon.contract.kernel_source import PartInfo
from gudgeon.drawing.joint_at import JointAt, axis_of, has_rail, sliding
from gudgeon.drawing.posture import GROUND, Posture, anchors, body_of, distinct, type_of
from gudgeon.drawing.shapes import turned, unit_vector
from gudgeon.model.compiled import Array

ASIDE = (
    0.03,
    0.1,
)  # fraction of the size from which the ground's points, or all points, count as on one side of a guide
WIDE = 3.0  # units: a clearance that needs no magnification
# half a bar's width as a fraction of the whole, its minimum, and its maximum as a fraction of the shortest link
SHARE, LEAST, OF_LINK = 0.017, 0.005, 0.16


@dataclass(frozen=True, eq=False)
class Plan:
    """Layout of the drawings of a scene.

    `unit`: half a bar's width (m). `ways`: for a joint, cylinder or spring on the ground the direction of the ground
    from it, (2,). `travel`: for a sliding joint the smallest and largest position along its axis (m), over all
    postures. `newton`: drawn length of an applied force of 1 N (m); 0: all have one length.
    """

    unit: float
    ways: Mapping[str, Array]
    travel: Mapping[str, tuple[float, float]]
    newton: float = 0.0


def make_plan(postures: Sequence[Posture], start: Posture | None = None) -> Plan:
    """Return the layout for the drawings of one posture, or of several postures of a motion.

    The side of the ground at a guide depends on the ground's points and on `start`, by default the first posture. All
    drawings of a mechanism therefore agree.
    """
    first_posture, start = postures[0], start or postures[0]
    positions = np.array([position for posture in postures for position in _drawn_points(posture)])
    ground_directions, travel = dict[str, Array](), dict[str, tuple[float, float]]()
    for part in sliding(first_posture):
        slider_positions = [_slider_position(posture, part) for posture in postures]
        travel[part.name] = min(slider_positions), max(slider_positions)
    for part in first_posture.parts("joints"):
        if any(body_of(end) == GROUND for end in part.ends):
            ground_directions[part.name] = (
                _rail_side(start, part) if has_rail(part) else _pin_ground_direction(postures, part)
            )
    for part in (*first_posture.parts("drives", "distance"), *first_posture.parts("forces", "spring_damper")):
        if any(body_of(end) == GROUND for end in part.ends):
            ground_directions[part.name] = _element_ground_direction(postures, part)
    return Plan(_symbol_unit(first_posture, positions), ground_directions, travel)


def _drawn_points(posture: Posture) -> list[Array]:
    """Return all points that a drawing must contain, each (2,), in m.

    They are the points of bodies and parts, and corners of boxes around wheels, journals' clearances and sliders with
    play.
    """
    points = [position for body in posture.bodies for position in anchors(posture, body).values()]
    points += [posture.place(end) for part in posture.source.parts for end in part.ends if end in posture.points]
    for part in posture.parts("joints"):
        radii = type_of(part).symbol.reach
        for end, radius in zip(part.ends, radii(JointAt(posture, part)), strict=True) if radii else ():
            if radius > 0.0:
                points += [posture.place(end) + offset for offset in radius * np.array([[1, 1], [-1, -1]])]
    for joint in posture.source.clearances:
        half_size = posture.slider(joint)[1] if joint.at_wall else posture.play(joint.name)
        offsets = half_size * np.array([[1, 1], [-1, -1]])
        points += [posture.place(next(posture.parts_named(joint.joint)).ends[0]) + offset for offset in offsets]
    return points


def _symbol_unit(posture: Posture, positions: Array) -> float:
    """Return half a bar's width in m, from the size of the drawing and its shortest link.

    `positions` (N, 2) are all drawn points. If they are one point, the file's largest length takes the place of the
    size, or 1 m without lengths.
    """
    drawing_size = float(np.ptp(positions, axis=0).max())
    if not drawing_size > 0.0:  # one point: as large as the file's largest length
        lengths = (
            abs(posture.number(parameter.address)) for parameter in posture.source.slots if parameter.unit == "m"
        )
        return SHARE * (max(lengths, default=0.0) or 1.0)
    spans = []
    for body in posture.bodies:
        outline_points = distinct(anchors(posture, body).values())
        spans += [float(np.hypot(*(a - b))) for k, a in enumerate(outline_points) for b in outline_points[:k]]
    shortest = min((span for span in spans if span > 1e-3 * drawing_size), default=drawing_size)
    return max(LEAST * drawing_size, min(SHARE * drawing_size, OF_LINK * shortest))


def is_wide(posture: Posture, joint: str, unit: float) -> bool:
    """Return whether a joint's play is visible without magnification."""
    return posture.play(joint) > WIDE * unit


def _slider_position(posture: Posture, part: PartInfo) -> float:
    """Return the coordinate of a sliding joint's slider along its line, in m."""
    line_point, axis, slider = axis_of(posture, part)
    return float((slider - line_point) @ axis)


def _rail_side(start: Posture, part: PartInfo) -> Array:
    """Return the direction of the ground at a guide, a unit vector across its axis.

    The ground is away from its other points, or else away from the mechanism at `start`. If neither differs enough, it
    is below or to the right.
    """
    line_point, axis, slider = axis_of(start, part)
    normal = turned(axis)
    ground = [start.place(name) for name in start.points if body_of(name) == GROUND]
    for positions, reference, min_offset in ((ground, line_point, ASIDE[0]), (_drawn_points(start), slider, ASIDE[1])):
        offset = float((np.array(positions) - reference).mean(axis=0) @ normal)
        if abs(offset) > min_offset * float(np.ptp(positions, axis=0).max()):
            return normal if offset < 0.0 else -normal
    down = float(normal @ np.array([0.3, -1.0]))
    return normal if down > 0.0 else -normal


def _pin_ground_direction(postures: Sequence[Posture], part: PartInfo) -> Array:
    """Return the direction of the ground at a pin, a unit vector: down unless links lie there in some posture.

    Otherwise it is the one of the four axis directions with the fewest points of the pin's bodies within 50°, over all
    postures.
    """
    end = next(end for end in part.ends if body_of(end) == GROUND)
    first, angles = postures[0], []
    pin = first.place(end)
    holding_joints = [joint for joint in first.parts("joints") if type_of(joint).holds_points]
    bodies = {
        body
        for joint_at_pin in holding_joints
        for body in map(body_of, joint_at_pin.ends)
        if body != GROUND and any(np.abs(first.place(end_name) - pin).max() < 1e-9 for end_name in joint_at_pin.ends)
    }
    for posture in postures:
        spans = [position - pin for body in sorted(bodies) for position in anchors(posture, body).values()]
        angles += [np.arctan2(y, x) for x, y in spans if np.hypot(x, y) > 1e-9]
    directions = np.array([[0.0, -1.0], [-1.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    if not angles:
        return directions[0]
    distances = [_angular_distance(np.array(angles), float(np.arctan2(y, x))) for x, y in directions]
    fractions = [float((distance < np.radians(50.0)).mean()) for distance in distances]
    return directions[0] if fractions[0] == 0.0 else directions[int(np.argmin(fractions))]


def _element_ground_direction(postures: Sequence[Posture], part: PartInfo) -> Array:
    """Return the direction of the ground at the ground end of a drive or spring, a unit vector.

    It points away from the other end, on average over the postures. If the average is almost zero, it is that of the
    first posture.
    """
    ground_end, other_end = sorted(part.ends, key=lambda end: body_of(end) != GROUND)
    spans = [posture.place(ground_end) - posture.place(other_end) for posture in postures]
    mean = np.sum([unit_vector(span) for span in spans], axis=0)
    return unit_vector(mean if float(np.hypot(*mean)) > ASIDE[0] * len(spans) else spans[0])


def _angular_distance(angles: Array, direction: float) -> Array:
    """Return the absolute differences of angles from a direction, in rad, from 0 to π, with the shape of `angles`."""
    return np.asarray(np.abs((angles - direction + np.pi) % (2.0 * np.pi) - np.pi))

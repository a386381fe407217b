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
    """Return the layout for one posture, or for several of a motion.

    The side of the ground at a guide depends on the ground's points and on `start`, by default the first posture, so
    that a mechanism has only one.
    """
    first, start = postures[0], start or postures[0]
    places = np.array([place for posture in postures for place in _drawn_points(posture)])
    ways, travel = dict[str, Array](), dict[str, tuple[float, float]]()
    for part in sliding(first):
        along = [_slider_position(posture, part) for posture in postures]
        travel[part.name] = min(along), max(along)
    for part in first.parts("joints"):
        if any(body_of(end) == GROUND for end in part.ends):
            ways[part.name] = _rail_side(start, part) if has_rail(part) else _pin_ground_direction(postures, part)
    for part in (*first.parts("drives", "distance"), *first.parts("forces", "spring_damper")):
        if any(body_of(end) == GROUND for end in part.ends):
            ways[part.name] = _element_ground_direction(postures, part)
    return Plan(_symbol_unit(first, places), ways, travel)


def _drawn_points(posture: Posture) -> list[Array]:
    """Return all drawn points, including rims of wheels, ranges of journals, and sliders with play."""
    found = [place for body in posture.bodies for place in anchors(posture, body).values()]
    found += [posture.place(end) for part in posture.source.parts for end in part.ends if end in posture.points]
    for part in posture.parts("joints"):
        radii = type_of(part).symbol.reach
        for end, radius in zip(part.ends, radii(JointAt(posture, part)), strict=True) if radii else ():
            if radius > 0.0:
                found += [posture.place(end) + shift for shift in radius * np.array([[1, 1], [-1, -1]])]
    for joint in posture.source.clearances:
        half = posture.slider(joint)[1] if joint.at_wall else posture.play(joint.name)
        reach = half * np.array([[1, 1], [-1, -1]])
        found += [posture.place(next(posture.parts_named(joint.joint)).ends[0]) + shift for shift in reach]
    return found


def _symbol_unit(posture: Posture, places: Array) -> float:
    """Return half a bar's width, m, from the size of the whole and the shortest link."""
    size = float(np.ptp(places, axis=0).max())
    if not size > 0.0:  # one point: as large as the file's largest length
        lengths = (abs(posture.number(slot.address)) for slot in posture.source.slots if slot.unit == "m")
        return SHARE * (max(lengths, default=0.0) or 1.0)
    spans = []
    for body in posture.bodies:
        here = distinct(anchors(posture, body).values())
        spans += [float(np.hypot(*(a - b))) for k, a in enumerate(here) for b in here[:k]]
    shortest = min((span for span in spans if span > 1e-3 * size), default=size)
    return max(LEAST * size, min(SHARE * size, OF_LINK * shortest))


def is_wide(posture: Posture, joint: str, unit: float) -> bool:
    """Return whether a joint's play is visible without magnification."""
    return posture.play(joint) > WIDE * unit


def _slider_position(posture: Posture, part: PartInfo) -> float:
    """Return the position of a slider along its line, m."""
    on, along, place = axis_of(posture, part)
    return float((place - on) @ along)


def _rail_side(start: Posture, part: PartInfo) -> Array:
    """Return the side of the ground at a guide, a unit vector across its axis.

    It is away from the ground's other points, else away from the mechanism at its start, else below or to the right.
    """
    on, along, slider = axis_of(start, part)
    across = turned(along)
    ground = [start.place(name) for name in start.points if body_of(name) == GROUND]
    for places, place, least in ((ground, on, ASIDE[0]), (_drawn_points(start), slider, ASIDE[1])):
        lies = float((np.array(places) - place).mean(axis=0) @ across)
        if abs(lies) > least * float(np.ptp(places, axis=0).max()):
            return across if lies < 0.0 else -across
    down = float(across @ np.array([0.3, -1.0]))
    return across if down > 0.0 else -across


def _pin_ground_direction(postures: Sequence[Posture], part: PartInfo) -> Array:
    """Return the direction of the ground at a pin: down, unless more links are there than elsewhere."""
    end = next(end for end in part.ends if body_of(end) == GROUND)
    first, angles = postures[0], []
    here = first.place(end)
    holding = [joint for joint in first.parts("joints") if type_of(joint).holds_points]
    bodies = {
        body
        for other in holding
        for body in map(body_of, other.ends)
        if body != GROUND and any(np.abs(first.place(e) - here).max() < 1e-9 for e in other.ends)
    }
    for posture in postures:
        spans = [place - here for body in sorted(bodies) for place in anchors(posture, body).values()]
        angles += [np.arctan2(y, x) for x, y in spans if np.hypot(x, y) > 1e-9]
    ways = np.array([[0.0, -1.0], [-1.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    if not angles:
        return ways[0]
    free = [_angular_distance(np.array(angles), float(np.arctan2(y, x))) for x, y in ways]
    share = [float((away < np.radians(50.0)).mean()) for away in free]
    return ways[0] if share[0] == 0.0 else ways[int(np.argmin(share))]


def _element_ground_direction(postures: Sequence[Posture], part: PartInfo) -> Array:
    """Return the direction of the ground at an element's end: away from its other end, on average."""
    fixed, other = sorted(part.ends, key=lambda end: body_of(end) != GROUND)
    spans = [posture.place(fixed) - posture.place(other) for posture in postures]
    mean = np.sum([unit_vector(span) for span in spans], axis=0)
    return unit_vector(mean if float(np.hypot(*mean)) > ASIDE[0] * len(spans) else spans[0])


def _angular_distance(angles: Array, direction: float) -> Array:
    """Return the absolute difference of angles from a direction, within π."""
    return np.asarray(np.abs((angles - direction + np.pi) % (2.0 * np.pi) - np.pi))

"""What all drawings of one scene share, so that a motion does not make them jump: size of symbols, sides of the ground,
how far each slider goes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from gudgeon.contract.kernel_source import PartInfo
from gudgeon.drawing.joint_at import JointAt, axis_of, has_rail, sliding
from gudgeon.drawing.posture import GROUND, Posture, anchors, body_of, distinct, type_of
from gudgeon.drawing.shapes import turned, unit_vector
from gudgeon.model.compiled import Array

ASIDE = (0.03, 0.1)  # share of the size, from which on the ground's points and all points lie on one side of a guide
WIDE = 3.0  # units: a clearance that needs no magnifying
# half a bar's width as a share of the whole, the least, and as the most of the shortest link
SHARE, LEAST, OF_LINK = 0.017, 0.005, 0.16


@dataclass(frozen=True, eq=False)
class Plan:
    """`unit`: half a bar's width (m). `ways`: of a joint, cylinder or spring on the ground where that lies, seen from
    it, (2,).

    `travel`: of a joint that slides the least and largest place along its axis (m), over all postures. `newton`: how
    long an applied force of 1 N is drawn (m); 0: all are of one length.
    """

    unit: float
    ways: Mapping[str, Array]
    travel: Mapping[str, tuple[float, float]]
    newton: float = 0.0


def make_plan(postures: Sequence[Posture], start: Posture | None = None) -> Plan:
    """Of one position, or of several of a motion. On which side of a guide the ground lies hangs on the ground's points
    and on `start`, the first position unless another one is given: one mechanism has one side."""
    first, start = postures[0], start or postures[0]
    places = np.array([place for posture in postures for place in _places(posture)])
    ways, travel = dict[str, Array](), dict[str, tuple[float, float]]()
    for part in sliding(first):
        along = [_slide(posture, part) for posture in postures]
        travel[part.name] = min(along), max(along)
    for part in first.parts("joints"):
        if any(body_of(end) == GROUND for end in part.ends):
            ways[part.name] = _rail_side(start, part) if has_rail(part) else _below(postures, part)
    for part in (*first.parts("drives", "distance"), *first.parts("forces", "spring_damper")):
        if any(body_of(end) == GROUND for end in part.ends):
            ways[part.name] = _behind(postures, part)
    return Plan(_unit(first, places), ways, travel)


def _places(posture: Posture) -> list[Array]:
    """All points that are drawn, rims of wheels, how far journals may go, and how long sliders with play are."""
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


def _unit(posture: Posture, places: Array) -> float:
    """By the size of the whole and the shortest link."""
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
    """Whether a joint's play is large enough to be seen as it is."""
    return posture.play(joint) > WIDE * unit


def _slide(posture: Posture, part: PartInfo) -> float:
    on, along, place = axis_of(posture, part)
    return float((place - on) @ along)


def _rail_side(start: Posture, part: PartInfo) -> Array:
    """Across the axis, away from the ground's other points; where those lie along it, away from the mechanism at its
    start; where that is on both sides, below or to the right."""
    on, along, slider = axis_of(start, part)
    across = turned(along)
    ground = [start.place(name) for name in start.points if body_of(name) == GROUND]
    for places, place, least in ((ground, on, ASIDE[0]), (_places(start), slider, ASIDE[1])):
        lies = float((np.array(places) - place).mean(axis=0) @ across)
        if abs(lies) > least * float(np.ptp(places, axis=0).max()):
            return across if lies < 0.0 else -across
    down = float(across @ np.array([0.3, -1.0]))
    return across if down > 0.0 else -across


def _below(postures: Sequence[Posture], part: PartInfo) -> Array:
    """The direction in which a pin stands on the ground: down, unless links are there more than elsewhere."""
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
    free = [_nearest(np.array(angles), float(np.arctan2(y, x))) for x, y in ways]
    share = [float((away < np.radians(50.0)).mean()) for away in free]
    return ways[0] if share[0] == 0.0 else ways[int(np.argmin(share))]


def _behind(postures: Sequence[Posture], part: PartInfo) -> Array:
    """The direction in which an element that holds the ground ends there: away from its other end, on the mean."""
    fixed, other = sorted(part.ends, key=lambda end: body_of(end) != GROUND)
    spans = [posture.place(fixed) - posture.place(other) for posture in postures]
    mean = np.sum([unit_vector(span) for span in spans], axis=0)
    return unit_vector(mean if float(np.hypot(*mean)) > ASIDE[0] * len(spans) else spans[0])


def _nearest(angles: Array, way: float) -> Array:
    return np.asarray(np.abs((angles - way + np.pi) % (2.0 * np.pi) - np.pi))

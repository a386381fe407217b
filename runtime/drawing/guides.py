"""A slider with play in its guide: how far apart its walls are drawn, how it lies in them, where its corners are."""

from __future__ import annotations

import math
from collections.abc import Mapping

from gudgeon.contract.kernel_source import PartInfo
from gudgeon.drawing.joint_at import axis_of
from gudgeon.drawing.posture import GROUND, Posture, body_of
from gudgeon.drawing.shapes import turned
from gudgeon.model.compiled import Array
from gudgeon.model.contours import corner_at

GAP = 0.5  # units: between a slider and each wall of its guide, if not more


def gap_of(posture: Posture, part: PartInfo, unit: float) -> float:
    """How far each wall of a joint that slides is drawn from the slider, m; 0: it has no play."""
    return max(GAP * unit, posture.play(part.name)) if part.name in posture.guides else 0.0


def axes_of(posture: Posture, part: PartInfo) -> tuple[Array, Array]:
    """Directions of guide and slider, unit vectors; the ground guides where it is one of the two."""
    _, second = map(body_of, part.ends)
    _, along, _ = axis_of(posture, part)
    if part.name not in posture.guides:
        return along, along
    tilt = _tilt(posture, part)
    tilted = math.cos(tilt) * along + math.sin(tilt) * turned(along)
    return (tilted, along) if second == GROUND else (along, tilted)


def _tilt(posture: Posture, part: PartInfo) -> float:
    """By how much the second body is turned in the first, rad: in no turn's excess."""
    first, second = map(body_of, part.ends)
    address = f"joints.{part.name}.angle"
    if posture.has(address):
        angle = posture.number(address)
    else:
        angle = math.atan2(*(posture.number(f"joints.{part.name}.axis.{axis}") for axis in "yx"))
    return math.remainder(posture.theta(second) - posture.theta(first) - angle, 2.0 * math.pi)


def corners(posture: Posture, joint: str) -> Mapping[str, float]:
    """How much nearer to its wall than in the middle of the guide each corner is, m, by its name."""
    part = next(posture.parts_named(joint))
    first, second = part.ends
    (_, along, _), tilt = axis_of(posture, part), _tilt(posture, part)
    offset = float((posture.place(second) - posture.place(first)) @ turned(along))
    return {one.name: corner_at(posture.source, posture.p, one, offset, tilt) for one in posture.guides[joint]}


def in_walls(posture: Posture) -> frozenset[str]:
    """Corners that are in their walls."""
    return frozenset(
        name for joint in posture.guides for name, e in corners(posture, joint).items() if e >= posture.play(joint)
    )

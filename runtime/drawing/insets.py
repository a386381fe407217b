"""Joints with play, magnified beside the mechanism: journal in bearing, slider in guide, where the run has them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gudgeon.drawing.joint_at import axis_of, corners, in_walls
from gudgeon.drawing.plan import is_wide
from gudgeon.drawing.posture import Posture
from gudgeon.drawing.shapes import Disc, Label, Line, Shape, rectangle, turned
from gudgeon.language.plot_units import scale
from gudgeon.model.compiled import Array

DASHED = " (dashed: as far as the journal's centre may go)"
RADIUS, JOURNAL = 5.0, 0.4  # of an inset's hole in units, and of the journal as a share of that
LONG, HIGH, APART, WALL, DOT = 0.9, 0.34, 0.26, 0.06, 0.06  # halves of slider, gap, half a wall, a corner: the same


def eccentricity(posture: Posture, joint: str) -> Array:
    """From the bearing's centre to the journal's, (2,), m, ground axes."""
    first, second = next(posture.parts_named(joint)).ends
    return posture.place(second) - posture.place(first)


def in_contact(posture: Posture) -> frozenset[str]:
    """Joints with play, and corners, whose surfaces overlap, e ≥ c; those that have nothing but a film never touch."""
    reach = {name: float(posture.p[joint.clearance]) for name, joint in posture.clearances.items() if joint.dry}
    found = (name for name, c in reach.items() if float(np.hypot(*eccentricity(posture, name))) >= c)
    return frozenset(found) | in_walls(posture)


def magnification(posture: Posture, joint: str, unit: float) -> float:
    """How many times larger than the drawing an inset is: two digits, so that clearance circle or gap fits."""
    share = APART if joint in posture.guides else 1.0 - JOURNAL
    wanted = RADIUS * share * unit / posture.play(joint)
    step = 10.0 ** (np.floor(np.log10(wanted)) - 1.0)
    return float(np.floor(wanted / step) * step)


def insets(
    posture: Posture,
    unit: float,
    low: Array,
    high: Array,
    touching: frozenset[str] = frozenset(),
    touched: frozenset[str] = frozenset(),
) -> Iterator[tuple[list[Shape], Label, str]]:
    """Of each joint with play its shapes, its name and its scale; below each other, to the right of the box, or where
    that is too low for it in rows below.

    To scale are the gap and the eccentricity, not the radii, nor a slider's lengths. `touching`: joints and corners
    whose surfaces are in contact, red; `touched`: those that are not any more, but were since the picture before: a
    red bearing or wall.
    """
    radius = RADIUS * unit
    played = dict.fromkeys(joint.joint for joint in posture.source.clearances)
    shown = [name for name in played if not is_wide(posture, name, unit)]
    for joint, centre in zip(shown, _centres(len(shown), radius, low, high), strict=True):
        c, times = posture.play(joint), magnification(posture, joint, unit)
        one = _slider if joint in posture.guides else _journal
        shapes, ratio, below = one(posture, joint, centre, radius, touching, touched - touching)
        told = f"{joint} ×{times:g}, e/c = {ratio:.2f}"
        factor, text = scale(c, "m")
        what, each = ("gap", " on each side") if joint in posture.guides else ("clearance", "")
        note = f"{joint}: {what} {c * factor:.4g} {text}{each}, drawn ×{times:g}"
        dashed = DASHED * (joint == next((name for name in shown if name in posture.clearances), ""))
        yield shapes, Label(f"inset {joint}", "inset", told, centre - [0.0, below], 0.0, 270.0), note + dashed


def _journal(
    posture: Posture, joint: str, centre: Array, radius: float, touching: frozenset[str], touched: frozenset[str]
) -> tuple[list[Shape], float, float]:
    """Shapes, e/c, and how far below its name stands."""
    c, times = posture.play(joint), magnification(posture, joint, radius / RADIUS)
    e = eccentricity(posture, joint)
    part, hole = f"inset {joint}", c * times + JOURNAL * radius
    at = centre + times * e
    shapes: list[Shape] = [
        Disc(part, "touched" if joint in touched else "bearing", centre, 1.16 * hole),
        Disc(part, "hole", centre, hole),
        Disc(part, "touching" if joint in touching else "journal", at, JOURNAL * radius),
        Disc(part, "clearance", centre, c * times),
        Line(part, "scale", np.array([centre, at])),
    ]
    return shapes, float(np.hypot(*e)) / c, 1.2 * hole


def _slider(
    posture: Posture, joint: str, centre: Array, radius: float, touching: frozenset[str], touched: frozenset[str]
) -> tuple[list[Shape], float, float]:
    """The same of a guide, along its axis: two walls, and the slider by its corners, as far from the walls as they are,
    e/c of the one that is furthest out."""
    c, times = posture.play(joint), magnification(posture, joint, radius / RADIUS)
    _, along, _ = axis_of(posture, next(posture.parts_named(joint)))
    part, across, found = f"inset {joint}", turned(along), corners(posture, joint)
    beyond = HIGH * radius + c * times + WALL * radius
    shapes: list[Shape] = []
    for side, word in ((1.0, "upper"), (-1.0, "lower")):
        red = any(name in touched for name in found if word in name)
        wall = rectangle(centre + side * beyond * across, along, 1.16 * radius, WALL * radius)
        shapes.append(Line(part, "touched" if red else "bearing", wall, True))
    places = {
        name: centre
        + (LONG if "front" in name else -LONG) * radius * along
        + (1.0 if "upper" in name else -1.0) * (HIGH * radius + times * e) * across
        for name, e in found.items()
    }
    upper, lower = ([at for name, at in places.items() if word in name] for word in ("upper", "lower"))
    shapes.append(Line(part, "journal", np.array([*upper, *reversed(lower)]), True))
    for name, at in places.items():
        shapes.append(Disc(part, "touching" if name in touching else "journal", at, DOT * radius))
    below = 1.16 * abs(along[1]) * radius + abs(across[1]) * (beyond + WALL * radius) + 0.2 * radius
    return shapes, max(found.values()) / c, float(below)


def _centres(n: int, radius: float, low: Array, high: Array) -> Iterator[Array]:
    count = max(1, int((high[1] - low[1]) / (3.1 * radius)))
    width = float(high[0] - low[0])
    pitch = max(3.6 * radius, min(5.5 * radius, width / max(n, 1)))
    across = max(1, int(width / pitch))
    for k in range(n):
        if n > count and across > count:
            row, column = divmod(k, across)
            yield np.array([low[0] + 1.8 * radius + pitch * column, low[1] - (1.6 + 3.1 * row) * radius])
        else:
            column, row = divmod(k, count)
            yield np.array([high[0] + (2.0 + 3.2 * column) * radius, high[1] - (1.25 + 3.1 * row) * radius])

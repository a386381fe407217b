"""Draw insets that magnify joints with play next to the mechanism: journal in bearing, slider in guide."""

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
RADIUS, JOURNAL = 5.0, 0.4  # radius of an inset's hole in units; of the journal as a fraction of that
LONG, HIGH, APART, WALL, DOT = 0.9, 0.34, 0.26, 0.06, 0.06  # halves of slider, gap, half a wall, a corner: the same


def eccentricity(posture: Posture, joint: str) -> Array:
    """Return the vector from the bearing's centre to the journal's, (2,), m, ground axes."""
    first, second = next(posture.parts_named(joint)).ends
    return posture.place(second) - posture.place(first)


def in_contact(posture: Posture) -> frozenset[str]:
    """Return the joints with play and the corners whose surfaces overlap, e ≥ c; joints with a film only never do."""
    reach = {name: float(posture.p[joint.clearance]) for name, joint in posture.clearances.items() if joint.dry}
    found = (name for name, c in reach.items() if float(np.hypot(*eccentricity(posture, name))) >= c)
    return frozenset(found) | in_walls(posture)


def magnification(posture: Posture, joint: str, unit: float) -> float:
    """Return the magnification of an inset over the drawing, with two digits, so that its clearance or gap fits."""
    share = APART if joint in posture.guides else 1.0 - JOURNAL
    expected = RADIUS * share * unit / posture.play(joint)
    step = 10.0 ** (np.floor(np.log10(expected)) - 1.0)
    return float(np.floor(expected / step) * step)


def insets(
    posture: Posture,
    unit: float,
    low: Array,
    high: Array,
    touching: frozenset[str] = frozenset(),
    touched: frozenset[str] = frozenset(),
) -> Iterator[tuple[list[Shape], Label, str]]:
    """Yield shapes, label and note of the inset of each joint with play.

    Insets are in columns to the right of the box, or in rows below a box that is too low. Gap and eccentricity are to
    scale; radii and a slider's lengths are not. `touching`: joints and corners in contact, drawn red; `touched`: those
    that were in contact since the previous picture, with a red bearing or wall.
    """
    radius = RADIUS * unit
    played = dict.fromkeys(joint.joint for joint in posture.source.clearances)
    shown = [name for name in played if not is_wide(posture, name, unit)]
    for joint, centre in zip(shown, _place_insets(len(shown), radius, low, high), strict=True):
        c, times = posture.play(joint), magnification(posture, joint, unit)
        draw_inset = _draw_slider if joint in posture.guides else _draw_journal
        shapes, ratio, below = draw_inset(posture, joint, centre, radius, touching, touched - touching)
        text_of_name = f"{joint} ×{times:g}, e/c = {ratio:.2f}"
        factor, text = scale(c, "m")
        what, each = ("gap", " on each side") if joint in posture.guides else ("clearance", "")
        note = f"{joint}: {what} {c * factor:.4g} {text}{each}, drawn ×{times:g}"
        dashed = DASHED * (joint == next((name for name in shown if name in posture.clearances), ""))
        yield shapes, Label(f"inset {joint}", "inset", text_of_name, centre - [0.0, below], 0.0, 270.0), note + dashed


def _draw_journal(
    posture: Posture, joint: str, centre: Array, radius: float, touching: frozenset[str], touched: frozenset[str]
) -> tuple[list[Shape], float, float]:
    """Return shapes of a journal in its bearing, e/c, and the distance of the name below the centre."""
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


def _draw_slider(
    posture: Posture, joint: str, centre: Array, radius: float, touching: frozenset[str], touched: frozenset[str]
) -> tuple[list[Shape], float, float]:
    """Return shapes of a slider in its guide, largest e/c of its corners, and the distance of the name below the
    centre.

    Two walls are along the axis. The corners are as far from them as in the mechanism, magnified.
    """
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


def _place_insets(n: int, radius: float, low: Array, high: Array) -> Iterator[Array]:
    """Yield the centres of n insets."""
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

"""Joints with play, magnified beside the mechanism: the journal in its bearing, where the run has it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gudgeon.drawing.plan import is_wide
from gudgeon.drawing.posture import Posture
from gudgeon.drawing.shapes import Disc, Label, Line, Shape
from gudgeon.language.plot_units import scale
from gudgeon.model.compiled import Array

DASHED = " (dashed: as far as the journal's centre may go)"
RADIUS, JOURNAL = 5.0, 0.4  # of an inset's hole in units, and of the journal as a share of that


def eccentricity(posture: Posture, joint: str) -> Array:
    """From the bearing's centre to the journal's, (2,), m, ground axes."""
    first, second = next(posture.parts_named(joint)).ends
    return posture.place(second) - posture.place(first)


def in_contact(posture: Posture) -> frozenset[str]:
    """Joints with play whose surfaces overlap, e ≥ c; those that have nothing but a film never touch."""
    reach = {name: float(posture.p[joint.clearance]) for name, joint in posture.clearances.items() if joint.dry}
    return frozenset(name for name, c in reach.items() if float(np.hypot(*eccentricity(posture, name))) >= c)


def magnification(posture: Posture, joint: str, unit: float) -> float:
    """How many times larger than the drawing an inset is: two digits, so that the clearance circle fits."""
    c = float(posture.p[posture.clearances[joint].clearance])
    wanted = RADIUS * (1.0 - JOURNAL) * unit / c
    step = 10.0 ** (np.floor(np.log10(wanted)) - 1.0)
    return float(np.floor(wanted / step) * step)


def insets(
    posture: Posture, unit: float, low: Array, high: Array, touching: frozenset[str] = frozenset(),
    touched: frozenset[str] = frozenset(),
) -> Iterator[tuple[list[Shape], Label, str]]:  # fmt: skip
    """Of each joint with play its shapes, its name and its scale; below each other, to the right of the box, or where
    that is too low for it in rows below.

    To scale are the gap and the eccentricity, not the radii. `touching`: joints whose surfaces are in contact, by a red
    journal; `touched`: those that are not any more, but were since the picture before, by a red bearing.
    """
    radius = RADIUS * unit
    shown = [name for name in posture.clearances if not is_wide(posture, name, unit)]
    for joint, centre in zip(shown, _centres(len(shown), radius, low, high), strict=True):
        c = float(posture.p[posture.clearances[joint].clearance])
        times = magnification(posture, joint, unit)
        e = eccentricity(posture, joint)
        part, hole = f"inset {joint}", c * times + JOURNAL * radius
        at = centre + times * e
        shapes: list[Shape] = [
            Disc(part, "touched" if joint in touched - touching else "bearing", centre, 1.16 * hole),
            Disc(part, "hole", centre, hole),
            Disc(part, "touching" if joint in touching else "journal", at, JOURNAL * radius),
            Disc(part, "clearance", centre, c * times),
            Line(part, "scale", np.array([centre, at])),
        ]
        factor, text = scale(c, "m")
        told = f"{joint} ×{times:g}, e/c = {float(np.hypot(*e)) / c:.2f}"
        label = Label(part, "inset", told, centre - [0.0, 1.2 * hole], 0.0, 270.0)
        note = f"{joint}: clearance {c * factor:.4g} {text}, drawn ×{times:g}"
        yield shapes, label, f"{note}{DASHED}" if joint == shown[0] else note


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

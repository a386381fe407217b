"""Draw velocities of points and forces at joints as arrows to one scale, with a reference arrow of a round value."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from gudgeon.assembly.linkage import place_of
from gudgeon.drawing.movers import HEAD, arrow
from gudgeon.drawing.posture import Posture, anchors
from gudgeon.drawing.shapes import Shape
from gudgeon.language.plot_units import scale
from gudgeon.model.compiled import Array

LONGEST = 9.0  # units


@dataclass(frozen=True, eq=False)
class Arrows:
    """Arrows of one quantity; an arrow of `length` (m of the drawing) represents `text`: "1 m/s".

    `on`: the body on which the quantity acts.
    """

    role: str
    shapes: tuple[Shape, ...]
    length: float
    text: str
    on: str = ""


def arrows(role: str, vectors: Mapping[str, tuple[Array, Array]], unit: str, pen: float, largest: float) -> Arrows:
    """Return the arrows of vectors (SI) by name, each a position and a vector; the magnitude `largest` has the length
    LONGEST.
    """
    if not largest > 0.0:
        return Arrows(role, (), 0.0, "")
    metres, shapes = LONGEST * pen / largest, list[Shape]()
    for name, (place, vector) in vectors.items():
        length = metres * float(np.hypot(*vector))
        if length > 1e-3 * pen:
            shapes += arrow(
                f"{role} {name}", role, place, place + metres * vector, min(0.85 * HEAD * pen, 0.6 * length)
            )
    reference = round_number(largest)
    factor, text = scale(reference, unit)
    return Arrows(role, tuple(shapes), metres * reference, f"{reference * factor:g} {text}")


def round_number(most: float) -> float:
    """Return the largest of 1, 2 or 5 times a power of ten that does not exceed `most`."""
    power = 10.0 ** np.floor(np.log10(most))
    return float(max(x for x in (1.0, 2.0, 5.0) if x * power <= most * (1.0 + 1e-12)) * power)


def velocities_of(posture: Posture) -> Iterator[tuple[str, tuple[Array, Array]]]:
    """Yield name, position and velocity (m/s) of each point on a body's outline and of its centre of mass."""
    if posture.v is None:
        return
    for body, info in posture.bodies.items():
        middle, rates = posture.centre(body), posture.v[info.index : info.index + 3]
        for name in dict.fromkeys([*anchors(posture, body), f"{body}.com"]):
            if name in posture.points:
                arm = place_of(posture.source, posture.p, posture.q, posture.points[name]) - middle
                yield name, (middle + arm, rates[:2] + rates[2] * np.array([-arm[1], arm[0]]))

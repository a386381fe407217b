"""Draw velocities of points and forces at joints as arrows to one scale, with a reference arrow of a round value."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from gudgeon.assembly.linkage import compute_point_position
from gudgeon.drawing.configuration import Configuration, find_outline_points
from gudgeon.drawing.drives_and_forces import HEAD_LENGTH, draw_arrow
from gudgeon.drawing.shapes import Shape
from gudgeon.language.plot_units import choose_prefix
from gudgeon.model.compiled import Array

MAX_ARROW_LENGTH = 9.0  # units


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


def draw_arrows(
    role: str, vectors: Mapping[str, tuple[Array, Array]], si_unit: str, unit_length: float, max_magnitude: float
) -> Arrows:
    """Return the arrows of vectors given as name: (position, vector), with a reference arrow of a round value.

    A vector of the magnitude `max_magnitude` (SI) is drawn MAX_ARROW_LENGTH units long; `unit_length` is a unit in m.
    Arrows below 1e-3 units are left out; without a positive magnitude there are none.
    """
    if not max_magnitude > 0.0:
        return Arrows(role, (), 0.0, "")
    metres_per_unit, shapes = MAX_ARROW_LENGTH * unit_length / max_magnitude, list[Shape]()
    for name, (position, vector) in vectors.items():
        length = metres_per_unit * float(np.hypot(*vector))
        if length > 1e-3 * unit_length:
            shapes += draw_arrow(
                f"{role} {name}",
                role,
                position,
                position + metres_per_unit * vector,
                min(0.85 * HEAD_LENGTH * unit_length, 0.6 * length),
            )
    reference = find_round_number(max_magnitude)
    factor, text = choose_prefix(reference, si_unit)
    return Arrows(role, tuple(shapes), metres_per_unit * reference, f"{reference * factor:g} {text}")


def find_round_number(limit: float) -> float:
    """Return the largest of 1, 2 or 5 times a power of ten that does not exceed a positive `limit`."""
    power = 10.0 ** np.floor(np.log10(limit))
    return float(max(x for x in (1.0, 2.0, 5.0) if x * power <= limit * (1.0 + 1e-12)) * power)


def compute_velocities(configuration: Configuration) -> Iterator[tuple[str, tuple[Array, Array]]]:
    """Yield (name, (position, velocity)) of each point on a body's outline and of each centre of mass, in m and m/s.

    Nothing is yielded for a configuration without velocities.
    """
    if configuration.v is None:
        return
    for body, info in configuration.bodies.items():
        centre, rates = configuration.get_centre_of_mass(body), configuration.v[info.index : info.index + 3]
        for name in dict.fromkeys([*find_outline_points(configuration, body), f"{body}.com"]):
            if name in configuration.points:
                lever = (
                    compute_point_position(
                        configuration.source, configuration.p, configuration.q, configuration.points[name]
                    )
                    - centre
                )
                yield name, (centre + lever, rates[:2] + rates[2] * np.array([-lever[1], lever[0]]))

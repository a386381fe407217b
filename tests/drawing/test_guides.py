"""Guides and the ground beside them: on which side each is drawn."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from gudgeon.assembly.branches import find_assemblies  # noqa: E402
from gudgeon.drawing.layout import make_layout  # noqa: E402
from gudgeon.drawing.shapes import Line  # noqa: E402
from gudgeon.drawing.sketch import make_sketch  # noqa: E402
from tests.drawing.drawn import drawn, named  # noqa: E402

BELL = """format: gudgeon/1
name: bell
bodies:
  push: {mass: 0.4 kg, inertia: 1e-4 kg*m^2}
  link: {length: 90 mm, mass: 0.2 kg, inertia: auto}
  bell: {mass: 0.8 kg, inertia: 2e-3 kg*m^2, points: {in: [0, 80 mm], out: [120 mm, 0]}}
  strut: {length: 100 mm, mass: 0.25 kg, inertia: auto}
  ram: {mass: 2 kg, inertia: 1e-3 kg*m^2}
ground: {O: [0, 0], floor: [-120 mm, 80 mm], guide: [130 mm, 0]}
joints:
  rail: {translational: [ground.floor, push.origin], axis: [1, 0]}
  a: {revolute: [push.origin, link.tail]}
  b: {revolute: [link.head, bell.in]}
  pivot: {revolute: [ground.O, bell.origin]}
  c: {revolute: [bell.out, strut.tail]}
  d: {revolute: [strut.head, ram.origin]}
  column: {translational: [ground.guide, ram.origin], axis: [0, 1]}
drives: {cam: {coordinate: push.x, value: PLACE}}
forces: {load: {force: ram.origin, value: [0, -20 N]}}
start: {guess: {link.x: -60 mm, link.y: 80 mm, ram.y: 100 mm, strut.head: [130 mm, 100 mm]}}
"""


def test_the_ground_stays_on_its_side_of_a_guide() -> None:
    """Away from the ground's other points, wherever the motion is and whichever assembly it has."""
    starts = [drawn(BELL.replace("PLACE", f"{x} mm")) for x in (-110, -90, -70)]
    first = starts[0]
    others = find_assemblies(first.linkage, first.linkage.p, first.configuration.q, ())
    assert len(others) > 1
    configurations = [start.configuration for start in starts] + [
        replace(first.configuration, q=one.q) for one in others
    ]
    for plan in (
        make_layout(configurations),
        make_layout(configurations[::-1]),
        *(make_layout([configuration]) for configuration in configurations),
    ):
        assert plan.ground_directions["rail"] == pytest.approx([0.0, 1.0], abs=1e-15)
        assert plan.ground_directions["column"] == pytest.approx([1.0, 0.0], abs=1e-15)


TROLLEY = """format: gudgeon/1
name: trolley
bodies:
  cart: {mass: 1 kg, inertia: 1e-3 kg*m^2}
  arm: {length: 100 mm, mass: 1 kg, inertia: 1e-3 kg*m^2}
ground: {O: [0, 0]}
joints:
  rail: {translational: [ground.O, cart.origin], axis: [1, 0]}
  pin: {revolute: [cart.origin, arm.tail]}
freedoms: 2
start: {set: {cart.x: 0 m, arm.theta: ANGLE}}
"""


@pytest.mark.parametrize(("angle", "up"), [("-90 deg", 1.0), ("90 deg", -1.0), ("0 deg", -1.0)])
def test_a_guide_alone_lies_away_from_what_it_carries_at_the_start(angle: str, up: float) -> None:
    start = drawn(TROLLEY.replace("ANGLE", angle)).configuration
    swung = replace(start, q=start.q + [0.0, 0.0, 0.0, 0.0, 0.0, 2.0])
    for plan in (make_layout([start]), make_layout([start, swung]), make_layout([swung], start)):
        assert plan.ground_directions["rail"] == pytest.approx([0.0, up], abs=1e-15)


@pytest.mark.parametrize("rate", [-1.0, 0.0, 1.0])
def test_a_drives_arrow_lies_away_from_the_ground_that_guides(rate: float) -> None:
    """Below the block, whose ground is above, and the name below the arrow; it points where the body goes."""
    configuration = drawn(BELL.replace("PLACE", "-110 mm")).configuration
    sketch = make_sketch(replace(configuration, v=np.full(len(configuration.q), rate)))
    block = np.vstack([s.points for s in sketch.of("body push") if isinstance(s, Line)])
    shaft, head = (s.points for s in sketch.of("drive cam") if isinstance(s, Line))
    assert max(shaft[:, 1].max(), head[:, 1].max()) < block[:, 1].min()
    assert np.sign(shaft[1, 0] - shaft[0, 0]) == (-1.0 if rate < 0.0 else 1.0)
    placed = named(sketch)
    assert placed["drive cam"][3] < placed["body link"][1]


def test_a_forces_name_is_beside_its_arrow() -> None:
    """On the arrow's side of the guide's wall, nearer to it than half the arrow is long."""
    configuration = drawn(BELL.replace("PLACE", "-110 mm")).configuration
    sketch = make_sketch(replace(configuration, loads={"load": (0.0, -20.0)}))
    shaft, head = (s.points for s in sketch.of("force load") if isinstance(s, Line))
    (wall,) = (s.points for s in sketch.of("joint column") if s.role == "rail" and isinstance(s, Line))
    assert wall[0, 0] > shaft[0, 0]
    left, low, right, high = named(sketch)["force load"]
    assert right < wall[0, 0] and high > head[0, 1] and low < shaft[0, 1]
    assert shaft[0, 0] - right < 0.5 * (shaft[0, 1] - head[0, 1])


CAR = """
format: gudgeon/1
name: car
freedoms: 1
bodies: {car: {mass: 1 kg, inertia: 1e-3 kg*m^2}}
ground: {O: [0, 0]}
joints: {rail: {translational: [ground.O, car.origin], axis: [1, 0]}}
forces: {spring: {spring_damper: [ground.O, car.origin], stiffness: 40 N/m, damping: 0.2 N*s/m, free_length: 0.1 m}}
start: {guess: {car.x: 150 mm}}
"""


def test_a_spring_at_a_rails_own_point_has_its_wall_and_keeps_off_the_rail() -> None:
    of = drawn(CAR)
    plan = make_layout([of.configuration])
    sketch = make_sketch(of.configuration, plan)
    lines = [shape for shape in (*sketch.of("joint rail"), *sketch.of("force spring")) if isinstance(shape, Line)]
    wires = [line for line in lines if line.part == "force spring"]
    strokes = [line for line in wires if line.role == "hatch"]
    assert len(strokes) > 2 and all(np.abs(stroke.points).max() < 3.0 * plan.unit for stroke in strokes)
    rail = next(line for line in lines if line.role == "rail" and line not in wires).points[0, 1]
    wire = np.vstack([line.points for line in wires if line.role in ("spring", "piston")])
    assert rail < 0.0 and wire[:, 1].min() > rail

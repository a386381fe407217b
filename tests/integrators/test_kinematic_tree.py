"""Scenes without freedom in tree coordinates: as the absolute formulation has them, whatever the groups of rows."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.generator.solvers.sparsity import Block, find_triangular_blocks
from gudgeon.simulation.simulation import Simulation
from tests.oracles import ideal_press
from tests.programs import needs_compiler

pytestmark = needs_compiler

# A plate on three rods, one of them on a driven crank: four rows in four angles that cannot be solved in parts.
PLATE = """
bodies:
  crank: {length: 0.1 m, mass: 1 kg, inertia: 0.01 kg*m^2}
  one: {length: 1 m, mass: 1 kg, inertia: 0.1 kg*m^2}
  two: {length: 1.1 m, mass: 1 kg, inertia: 0.1 kg*m^2}
  three: {length: 0.9 m, mass: 1 kg, inertia: 0.1 kg*m^2}
  plate: {mass: 3 kg, inertia: 0.2 kg*m^2, points: {a: [-0.4, -0.1], b: [0.4, -0.1], c: [0, 0.4]}}
ground: {o: [0, 0], p: [1.6, 0], r: [1, 2.1]}
joints:
  O: {revolute: [ground.o, crank.tail]}
  A: {revolute: [crank.head, one.tail]}
  B: {revolute: [one.head, plate.a]}
  C: {revolute: [ground.p, two.tail]}
  D: {revolute: [two.head, plate.b]}
  E: {revolute: [ground.r, three.tail]}
  F: {revolute: [three.head, plate.c]}
drives: {turn: {angle: crank, value: 0.4 + 2*pi*t/(1 s) + 0.2*sin(2*pi*t/(1 s))}}
gravity: [0, -9.81]
start: {guess: {one.theta: 80 deg, two.theta: 100 deg, three.theta: -110 deg, plate.x: 0.7 m, plate.y: 1.1 m}}
"""

# A foot is drawn along the ground and a pin hangs between two rods that are not bodies: slides as unknowns.
PIN = """
bodies:
  pin: {mass: 1 kg, inertia: 1 kg*m^2}
  foot: {mass: 1 kg, inertia: 1 kg*m^2}
ground: {o: [0, 0]}
joints:
  slide: {translational: [ground.o, foot.origin], axis: [1, 0]}
  left: {distance: [ground.o, pin.origin], length: 1 m}
  right: {distance: [foot.origin, pin.origin], length: 1.2 m}
drives:
  draw: {coordinate: foot.x, value: 1 m + 0.7 m * sin(2*pi*t/(1 s))}
  hold: {angle: pin, value: 0.3*sin(2*pi*t/(1 s))}
start: {guess: {pin.y: 1 m, pin.x: 0.5 m}}
"""


def scene(name: str, folder: Path) -> Simulation:
    text = {"plate": PLATE, "pin": PIN}.get(name)
    if text is None:
        return gudgeon.load(name, "ideal")
    path = folder / f"{name}.yaml"
    path.write_text(f"format: gudgeon/1\nname: {name}\n{text}", encoding="utf-8")
    return gudgeon.load(path)


@pytest.mark.parametrize(
    "name", ["nine_bar_press", "slider_crank", "four_bar", pytest.param("plate", marks=pytest.mark.slow), "pin"]
)
@pytest.mark.parametrize("output", [4, pytest.param(300, marks=pytest.mark.slow)])
def test_both_formulations_agree(name: str, output: int, tmp_path: Path) -> None:
    """Positions, velocities, accelerations, works, reactions; however far the samples lie apart."""
    tree = scene(name, tmp_path)
    t_end = 0.1 if name.startswith("slider") else 1.0
    one, two = tree.simulate(t_end, output=output), tree.full.simulate(t_end, output=output)
    for found, true in ((one.q, two.q), (one.v, two.v), (one.a, two.a)):
        assert np.abs(found - true).max() <= 1e-11 * np.abs(true).max()
    assert np.abs(one.work - two.work).max() <= 1e-9 * one.diagnostics.energy_turned_over
    assert one.diagnostics.phi_max < 1e-14  # lengths of about 1 m; Newton ends below 4e-15
    assert one.diagnostics.phi_dot_max < 1e-14 * np.abs(one.v).max()
    # accelerations of the tree, and those that the equations of motion give at the same state
    assert np.abs(one.a - one.evaluation.a).max() <= 1e-11 * np.abs(one.a).max()


@pytest.mark.parametrize("name", ["nine_bar_press", "plate"])
def test_works_follow_the_motion_between_few_samples(name: str, tmp_path: Path) -> None:
    """The energy balance holds to the quadrature's error on the steps of the motion, not on the samples'."""
    run = scene(name, tmp_path).simulate(2.0, output=3)
    assert run.diagnostics.steps > 30
    assert run.diagnostics.energy_residual < 1e-9 * run.diagnostics.energy_turned_over


def test_press_at_few_and_many_samples() -> None:
    """Against intersections of circles: rounding, in velocities and accelerations too."""
    for output in (7, 1000):
        run = gudgeon.load("nine_bar_press", "ideal").simulate(1.0, output=output)
        true = ideal_press.motion(run.t)
        for found, exact in ((run.q, true.q), (run.v, true.v), (run.a, true.a)):
            assert np.abs(found - exact).max() <= 2e-14 * np.abs(exact).max()


def test_groups_of_rows() -> None:
    """A dyad, then a row that needs it, then a ring of three that needs both."""
    pattern = [{4, 0, 5}, {1, 2}, {0, 1}, {1, 2}, {5, 3}, {3, 4}]
    blocks = find_triangular_blocks(pattern, 6)
    assert blocks is not None
    assert [set(block.rows) for block in blocks] == [{1, 3}, {2}, {0, 4, 5}]
    solved: set[int] = set()
    for block in blocks:
        solved |= set(block.columns)
        assert all(pattern[row] <= solved for row in block.rows)
    assert find_triangular_blocks([{0}, {0}], 2) is None
    assert find_triangular_blocks([{0}], 2) is None
    assert find_triangular_blocks([], 0) == ()
    assert find_triangular_blocks([{0}], 1) == (Block((0,), (0,)),)


def test_a_plate_on_three_rods_is_one_block(tmp_path: Path) -> None:
    files = scene("plate", tmp_path).source.files
    assert "factor_block(4, " in files["positions.c"]
    assert "factor_block" not in gudgeon.load("nine_bar_press", "ideal").source.files["positions.c"]

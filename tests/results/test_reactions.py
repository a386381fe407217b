"""Reactions by balances that need no equation of the product: momentum of the whole, and of a gear train's parts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gudgeon.errors import BadValueError
from tests.scenes import Load, loader


@pytest.fixture
def load(tmp_path: Path) -> Load:
    return loader(tmp_path)


EPICYCLIC = """
gravity: [0, -9.81 m/s^2]
bodies:
  arm: {{length: 0.1 m, mass: 1 kg, inertia: 0.01 kg*m^2}}
  planet: {{mass: 1.5 kg, inertia: 0.02 kg*m^2}}
ground: {{o: [0, 0]}}
joints:
  O: {{revolute: [ground.o, arm.tail]}}
  A: {{revolute: [arm.head, planet.origin]}}
  mesh: {{gear: [{wheels}], radii: [{radii}], carrier: arm, internal: {ring}}}
drives:
  turn: {{angle: arm, value: 20 deg + 3 rad/s * t + 1 rad/s^2 * t**2}}
"""


@pytest.mark.parametrize(
    ("wheels", "radii", "ring", "turns"),
    [
        ("planet, ground", "30 mm, 70 mm", "false", 1 + 7 / 3),
        ("ground, planet", "70 mm, 30 mm", "false", 1 + 7 / 3),
        ("planet, ground", "30 mm, 130 mm", "true", 1 - 13 / 3),
    ],
)
def test_gear_on_the_ground(load: Load, wheels: str, radii: str, ring: str, turns: float) -> None:
    """A planet on a fixed sun or ring: the ground bears what planet and carrier leave over."""
    run = load(EPICYCLIC.format(wheels=wheels, radii=radii, ring=ring)).simulate(0.5, output=5)
    assert run["planet.omega"] == pytest.approx(turns * run["arm.omega"])
    momentum_rate = 0.01 * run["arm.alpha"] + 0.02 * run["planet.alpha"]
    weight: Any = 0.0
    for body, mass in (("arm", 1.0), ("planet", 1.5)):
        x, y, ax, ay = (run[f"{body}.{what}"] for what in ("x", "y", "ax", "ay"))
        momentum_rate = momentum_rate + mass * (x * ay - y * ax)
        weight = weight - 9.81 * mass * x
    planet, second_is_ground = 0.02 * run["planet.alpha"], wheels.endswith("ground")
    fixed = run["turn.torque"] + weight - momentum_rate  # what the wheel on the ground passes to it
    assert run["mesh.M"] == pytest.approx(fixed if second_is_ground else planet, abs=1e-12)
    outer = 70 / 30 if ring == "false" else -130 / 30
    assert fixed == pytest.approx(outer * planet, abs=1e-12)  # the same tooth force at both radii


def test_axis_keeps_its_sign_at_run_time(load: Load) -> None:
    """An axis along y is written into the equations; turning it round must not be ignored."""
    text = """
    bodies: {s: {mass: 1 kg, inertia: 0.01 kg*m^2}}
    ground: {o: [0, 0]}
    joints: {guide: {translational: [ground.o, s.origin], axis: [0, 1]}}
    """
    scene = load(text)
    with pytest.raises(BadValueError, match="overrides"):
        scene.simulate(1.0, parameters={"joints.guide.axis.y": -1.0})
    run = scene.simulate(0.1, output=1, step=0.05, parameters={"joints.guide.axis.y": 3.0})
    assert run["s.theta"] == pytest.approx(np.pi / 2)


def test_axis_that_vanishes_at_run_time_is_refused(load: Load) -> None:
    text = """
    parameters: {along: 1, across: 0.5}
    bodies: {s: {mass: 1 kg, inertia: 0.01 kg*m^2}}
    ground: {o: [0, 0]}
    joints: {guide: {translational: [ground.o, s.origin], axis: [along, across]}}
    """
    with pytest.raises(BadValueError, match=r"guide_axis_x_2 .* is nan"):
        load(text).simulate(1.0, parameters={"along": 0.0, "across": 0.0})

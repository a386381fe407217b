"""The start depends on the linkage and its guess, not on the directions of the axes it is described in."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gudgeon.assembly.closure import AssemblyProblem
from gudgeon.model.parameters import compute_parameter_values
from tests.programs import needs_compiler
from tests.scenes import Load, loader

pytestmark = needs_compiler
PLACES = {"ox": 0.1, "oy": 0.3, "ax": 0.05, "ay": 0.1, "bx": 0.35, "by": 0.02}  # m; a and b are guesses
HEAD = """
parameters: {ox: 0 m, oy: 0 m, ax: 0 m, ay: 0 m, bx: 0 m, by: 0 m, phi: 0, psi: 0}
ground: {o: [ox, oy]}
"""
PENDULUM = """
bodies:
  a: {mass: 1 kg, inertia: 0.01 kg*m^2, points: {p: [-0.1 m, 0.15 m], q: [0.2 m, -0.05 m]}}
  b: {mass: 1 kg, inertia: 0.01 kg*m^2, points: {p: [0.12 m, 0.08 m]}}
joints:
  O: {revolute: [ground.o, a.p]}
  A: {revolute: [a.q, b.p]}
start: {guess: {a.x: ax, a.y: ay, a.theta: phi, b.x: bx, b.y: by, b.theta: psi}}
"""
ROD = """
bodies:
  a: {mass: 1 kg, inertia: 0.01 kg*m^2, points: {p: [-0.1 m, 0.15 m]}}
joints:
  O: {distance: [a.p, ground.o], length: 0.2 m}
start: {guess: {a.x: ax, a.y: ay, a.theta: phi}}
"""


@pytest.fixture
def load(tmp_path: Path) -> Load:
    return loader(tmp_path)


@pytest.mark.parametrize("linkage", [PENDULUM, ROD])
@pytest.mark.parametrize("far", [0.0, 0.1, 0.3])
def test_a_turned_linkage_starts_turned(load: Load, linkage: str, far: float) -> None:
    """The guess closes by centimetres, and by so much more; what is free is where the guess has it, to rounding."""
    scene, found = load(HEAD + linkage), []
    for angle in (0.0, 0.4, 1.9, -2.5):
        numbers = {"phi": 0.2 + angle, "psi": -0.9 + angle}
        turned = np.exp(1j * angle)
        for name in "oab":
            place = turned * complex(PLACES[f"{name}x"] + far * (name == "a"), PLACES[f"{name}y"])
            numbers |= {f"{name}x": place.real, f"{name}y": place.imag}
        q = scene.start(numbers).q
        places = (q[0::3] + 1j * q[1::3]) / turned
        found.append(np.concatenate([places.real, places.imag, q[2::3] - angle]))
    assert np.ptp(found, axis=0).max() < 1e-12


@pytest.mark.parametrize("linkage", [PENDULUM, ROD])
def test_a_closed_guess_is_the_start_to_the_bit(load: Load, linkage: str) -> None:
    """A start serves as a guess again, as it is, in C and in Python."""
    scene, place = load(HEAD + linkage), PLACES
    q = scene.start({**place, "phi": 0.2, "psi": -0.9}).q
    guess = dict(zip(("ax", "ay", "phi", "bx", "by", "psi"), q.tolist(), strict=False))
    numbers = {**place, "psi": -0.9, **guess}
    assert scene.start(numbers).q.tobytes() == q.tobytes()
    problem = AssemblyProblem(scene.compiled, compute_parameter_values(scene.compiled, numbers)[0], 0.0)
    assert problem.find_nearest_configuration()[0].tobytes() == q.tobytes()

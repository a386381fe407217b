"""Example: the scene's functions as plain Python beside the compiled ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tests.programs import needs_compiler
from tests.scenes import loader

pytestmark = needs_compiler
PENDULUM = """
gravity: [0, -9.81 m/s^2]
bodies: {bar: {length: 0.3 m, mass: 1 kg, inertia: auto}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, bar.tail]}}
"""


def test_accelerations_are_those_of_the_compiled_scene(tmp_path: Path) -> None:
    simulation = loader(tmp_path, "full")(PENDULUM)
    run, model = simulation.simulate(0.1, output=5), simulation.model.numpy()
    p = model.prepare()
    assert run.accelerations is not None
    for t, q, v, a in zip(run.t, run.q, run.v, run.accelerations, strict=True):
        np.testing.assert_allclose(model.dynamics(t, q, v, p).a, a, rtol=1e-9, atol=1e-9)

"""Example: many runs at once give the bits of single runs."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tests.programs import needs_compiler
from tests.scenes import loader

pytestmark = needs_compiler
PENDULUM = """
gravity: [0, -9.81 m/s^2]
parameters: {L: 0.3 m}
bodies: {bar: {length: L, mass: 1 kg, inertia: auto}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, bar.tail]}}
"""


def test_a_batch_is_its_runs(tmp_path: Path) -> None:
    simulation, lengths = loader(tmp_path)(PENDULUM), [0.2, 0.3, 0.5]
    batch = simulation.simulate_many({"L": lengths}, 0.5, output=10)
    for k, length in enumerate(lengths):
        alone = simulation.simulate(0.5, output=10, parameters={"L": length})
        np.testing.assert_array_equal(batch["bar.theta"][k], alone["bar.theta"])

"""Example: the reduced formulation gives the motion of the full one."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tests.programs import needs_compiler
from tests.scenes import loader

pytestmark = needs_compiler
DOUBLE_PENDULUM = """
gravity: [0, -9.81 m/s^2]
bodies:
  upper: {length: 0.3 m, mass: 1 kg, inertia: auto}
  lower: {length: 0.2 m, mass: 1 kg, inertia: auto}
ground: {O: [0, 0]}
joints:
  O: {revolute: [ground.O, upper.tail]}
  A: {revolute: [upper.head, lower.tail]}
"""


def test_both_formulations_move_alike(tmp_path: Path) -> None:
    reduced, full = (
        loader(tmp_path, formulation)(DOUBLE_PENDULUM).simulate(0.5, output=20, rtol=1e-10)
        for formulation in ("reduced", "full")
    )
    np.testing.assert_allclose(reduced.q, full.q, atol=1e-8)

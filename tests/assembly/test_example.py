"""Example: a linkage is closed at its start; the angles are compared with a closed form."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.programs import needs_compiler
from tests.scenes import loader

pytestmark = needs_compiler
PARALLELOGRAM = """
bodies:
  left: {length: 0.3 m, mass: 1 kg, inertia: auto}
  top: {length: 0.5 m, mass: 1 kg, inertia: auto}
  right: {length: 0.3 m, mass: 1 kg, inertia: auto}
ground: {O: [0, 0], P: [0.5 m, 0]}
joints:
  O: {revolute: [ground.O, left.tail]}
  A: {revolute: [left.head, top.tail]}
  B: {revolute: [top.head, right.head]}
  P: {revolute: [ground.P, right.tail]}
drives: {turn: {angle: left, value: 60 deg + 1 rad/s * t}}
start: {guess: {top.theta: 0.2, right.theta: 1}}
"""


def test_opposite_sides_of_a_parallelogram_are_parallel(tmp_path: Path) -> None:
    q = loader(tmp_path)(PARALLELOGRAM).start().q
    assert q[[2, 5, 8]] == pytest.approx([np.pi / 3, 0.0, np.pi / 3], abs=1e-12)

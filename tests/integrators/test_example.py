"""Example: a motion with a closed form; the error of the integrator is bounded by its tolerance."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.programs import needs_compiler
from tests.scenes import loader

pytestmark = needs_compiler
OSCILLATOR = """
bodies: {block: {mass: 2 kg, inertia: 1 kg*m^2}}
ground: {wall: [0, 0]}
joints: {rail: {translational: [ground.wall, block.origin], axis: [1, 0]}}
forces: {spring: {force: block.com, value: [-8 N/m * block.x, 0 N]}}
start: {set: {block.x: 0.1 m}}
"""


@pytest.mark.parametrize("method", ["dop853", "rodas5p"])
def test_a_harmonic_oscillator(method: str, tmp_path: Path) -> None:
    """x = x_0 cos(ω t), ω = sqrt(k/m) = 2 rad/s."""
    run = loader(tmp_path)(OSCILLATOR).simulate(5.0, output=50, method=method, rtol=1e-9)
    assert abs(run["block.x"] - 0.1 * np.cos(2.0 * run.t)).max() < 1e-8

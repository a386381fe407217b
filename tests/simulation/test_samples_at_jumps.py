"""Samples on a jump of a drive's rate: forces without stabilization, and rates of the side of the velocities."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon

ARM = """format: gudgeon/1
name: arm
bodies: {arm: {length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, arm.tail]}}
drives: {m: {angle: arm, value: "min(1, 2 rad/s*t)"}}
"""


@pytest.mark.parametrize("gain", [0.0, 50.0])
@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_a_sample_at_a_jump_of_the_rate_has_the_values_after_it(tmp_path: Path, formulation: str, gain: float) -> None:
    """r ω² m before the jump, and rest after it: no torque of 2 α Δω J at the jump."""
    file = tmp_path / "arm.yaml"
    file.write_text(ARM)
    scene = gudgeon.load(file, formulation=formulation)
    gains = {"baumgarte.alpha": gain, "baumgarte.beta": gain}
    run = scene.simulate(1.0, output=4, parameters=gains, peaks=["m.torque", "O.F"], audit="full")
    expected = {"arm.omega": [2, 2, 0, 0, 0], "O.F": [2, 2, 0, 0, 0], "m.torque": 0, "arm.alpha": 0}
    batch = scene.simulate_many({"baumgarte.alpha": np.full(3, gain)}, 1.0, output=4)
    kept = scene.simulate_many({"baumgarte.alpha": np.full(3, gain)}, 1.0, output=4, keep=list(expected))
    for name, values in expected.items():
        for result in (run[name], batch[name][0], kept[name][2]):
            np.testing.assert_allclose(result, values, atol=1e-9)
    assert abs(run.peak("m.torque").max) < 1e-9
    assert run.peak("O.F").max == pytest.approx(2.0)

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
    moving, rest = [2.0, 2.0, 0.0, 0.0, 0.0], [0.0] * 5
    expected = {"arm.omega": moving, "O.F": moving, "m.torque": rest, "arm.alpha": rest}
    batch = scene.simulate_many({"baumgarte.alpha": np.full(3, gain)}, 1.0, output=4)
    kept = scene.simulate_many({"baumgarte.alpha": np.full(3, gain)}, 1.0, output=4, keep=list(expected))
    for name, values in expected.items():
        for result in (run[name], batch[name][0], kept[name][2]):
            np.testing.assert_allclose(result, values, atol=1e-9)
    assert abs(run.peak("m.torque").max) < 1e-9
    assert run.peak("O.F").max == pytest.approx(2.0)


KNOT = """format: gudgeon/1
name: knot
gravity: [0, 0]
curves: {cv: {points: [[0, -40], [0.5, 0], [1, 80]], x: s, y: rad, extrapolate: hold}}
bodies:
  arm: {length: 1 m, mass: 1 kg, inertia: 1 kg*m^2}
  p: {length: 0.5 m, mass: 1 kg, inertia: 0.1 kg*m^2}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, arm.tail]}, A: {revolute: [arm.head, p.tail]}}
drives: {m: {angle: arm, value: cv(t)}}
forces: {d: {rotational_spring_damper: [arm, p], stiffness: 3000 N*m/rad, damping: 10 N*m*s/rad}}
"""


def test_samples_at_and_near_a_knot_of_a_drive_with_a_free_link(tmp_path: Path) -> None:
    """The audit allows the motion of the drive within the accuracy of the time; gains have no effect."""
    file = tmp_path / "knot.yaml"
    file.write_text(KNOT)
    scene, times = gudgeon.load(file), [0.3, 0.5, 0.5 + 1e-9, 0.9]
    run = scene.simulate(output=times)
    for name in ("arm.alpha", "p.alpha", "m.torque", "A.Fx"):
        assert run[name][1] == pytest.approx(run[name][2], rel=1e-4, abs=1e-4)
        other = scene.simulate(output=times, parameters={"baumgarte.alpha": 0.0, "baumgarte.beta": 0.0})[name]
        np.testing.assert_allclose(run[name], other, rtol=1e-12, atol=1e-9)

"""A run in two parts is the run in one part, bit for bit: in free flight, in contact, in stick and slip."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import gudgeon

CASES: list[tuple[str, str, float, float | None, int]] = [
    ("nine_bar_press", "dry", 0.012, 2e-6, 400),
    ("belt_block", "ideal", 3.0, 1e-2, 60),
    ("bouncing_ball", "damped", 0.46, 1e-5, 2300),
    ("slider_crank", "ideal", 0.2, None, 20),
]


@pytest.mark.parametrize(("name", "scene", "t_end", "step", "samples"), CASES)
def test_restart(name: str, scene: str, t_end: float, step: float | None, samples: int) -> None:
    simulation, times = gudgeon.load(name, scene=scene), np.linspace(0.0, t_end, samples + 1)
    whole = simulation.simulate(output=times, step=step)
    busy = np.flatnonzero(whole.state.any(axis=1) if whole.state.size else np.arange(len(times)) % 7 == 3)
    assert len(busy)
    for k in {*busy[:: max(1, len(busy) // 5)].tolist(), samples // 2} - {0, samples}:
        first = simulation.simulate(output=times[: k + 1], step=step)
        second = simulation.simulate(output=times[k:], step=step, start=first.final)
        for part in ("q", "v", "a", "memory", "state"):
            one, other = getattr(second, part), getattr(whole, part)[k:]
            np.testing.assert_allclose(one, other, rtol=1e-12, atol=1e-12)  # an end is one number beside the grid's
        assert first.work[-1] + second.work[-1] == pytest.approx(whole.work[-1], abs=1e-12)


RAIL = """
format: gudgeon/1
name: rail
bodies: {m: {mass: 1 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
joints: {guide: {translational: [ground.O, m.origin], axis: [1, 0], angle: 0}}
forces: {spring: {force: m.origin, value: [-m.x * 4 N/m, 0]}}
start: {set: {m.x: 1 m}, rates: {m.vx: 0}}
"""


def test_a_scene_without_lengths_continues_from_its_state(tmp_path: Path) -> None:
    """A mass on a spring, x = cos 2t, by resumed runs, by steps without inputs, and by a prepared run."""
    (tmp_path / "rail.yaml").write_text(RAIL, encoding="utf-8")
    rail = gudgeon.load(tmp_path / "rail.yaml")
    state, stepper = rail.simulate(0.1, output=1, rtol=1e-10).final, rail.stepper(series=["m.x"], rtol=1e-10)
    stepper.reset()
    for k in range(1, 8):
        assert state.q[0] == pytest.approx(np.cos(0.2 * k), abs=1e-8)
        assert stepper.step(0.1)[0] == pytest.approx(np.cos(0.2 * k), abs=1e-8)
        state = rail.simulate(0.1 * (k + 1), output=1, start=state, rtol=1e-10).final
    run = rail.simulate(0.8, output=8, rtol=1e-10)
    assert rail.prepare(series=["m.x"], t_end=0.8, output=8, rtol=1e-10)(np.zeros(0))[0].tolist() == run["m.x"].tolist()
    assert rail.prepare(["bodies.m.mass"], ["m.x"], 0.8, output=8, rtol=1e-10)([1.0])[0].tolist() == run["m.x"].tolist()


def test_a_corrected_start_has_one_note() -> None:
    """The constraint equations hold from the first step on: no note says that the results are not meaningful."""
    pendulum = gudgeon.load("pendulum")
    start = replace(pendulum.simulate(0.1, output=5).final, q=np.array([0.5, -0.9, 0.0]))
    run = pendulum.simulate(0.2, output=3, start=start)
    (note,) = run.diagnostics.notes
    assert "violates constraint equations rod.length (0.03 m)" in note
    np.testing.assert_allclose(np.hypot(run["bob.x"], run["bob.y"])[1:], 1.0, atol=1e-14)

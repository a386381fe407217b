"""Newton's restitution in joints with play: closed forms, an event-driven oracle, energy, two contacts at once."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError, InputErrors
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from tests.oracles.hung_bar import HungBar
from tests.programs import needs_compiler

pytestmark = needs_compiler
HEAD = """\
format: gudgeon/1
name: rigid
gravity: [0, -9.81 m/s^2]
materials: {steel: {E: 206 GPa, nu: 0.3}}
"""
BALL = """\
bodies: {ball: {mass: 0.092 kg, inertia: 7e-6 kg*m^2}}
ground: {hole: [0, 0]}
freedoms: 1
joints: {A: {revolute: [ground.hole, ball.origin]}}
start: {play: {A: {}}}
bearings: {wide: {radius: 1.014 m, clearance: 1 m, length: 10 mm, bearing_material: steel, journal_material: steel}}
contacts: {hard: {normal: {law: newton_restitution, restitution: 0.8}}}
events: {down: {zero: ball.vy, direction: falling}}
scenes: {hard: {play: {A: {bearing: wide, contact: hard}}, simulate: {t_end: 2 s, step: 1e-3 s}}}
"""
BAR = """\
parameters: {tilt: 0.7 rad, turn: 0 rad/s}
bodies: {bar: {mass: 0.4 kg, inertia: 3e-3 kg*m^2, points: {pin: [0, 0.12 m]}}}
ground: {hole: [0, 0]}
freedoms: 1
joints: {A: {revolute: [ground.hole, bar.pin]}}
start: {set: {bar.theta: tilt}, rates: {bar.omega: turn}}
bearings: {hole: {radius: 15 mm, clearance: 5 mm, length: 10 mm, bearing_material: steel, journal_material: steel}}
contacts: {hard: {normal: {law: newton_restitution, restitution: 0.6, threshold: 1e-3 m/s}}}
scenes: {hard: {play: {A: {bearing: hole, contact: hard}}, simulate: {t_end: 1 s, step: 1e-4 s}}}
"""
OBLIQUE = {"start.play.A.e.x": 0.4, "start.play.A.e.y": 0.3, "start.play.A.rate.x": 2.0}


@cache
def made(folder: Path, text: str, formulation: str = "reduced") -> Simulation:
    file = folder / f"rigid_{abs(hash((text, formulation)))}.yaml"
    file.write_text(HEAD + text, encoding="utf-8")
    return gudgeon.load(file, "hard", formulation=formulation)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("rigid")


def bounces(e: float, threshold: float, h: float = 1.0, g: float = 9.81) -> tuple[Any, Any]:
    """Times and speeds of all blows of a ball that falls by h."""
    speeds = [math.sqrt(2.0 * g * h)]
    times = [math.sqrt(2.0 * h / g)]
    while e * speeds[-1] > threshold:
        speeds.append(e * speeds[-1])
        times.append(times[-1] + 2.0 * speeds[-1] / g)
    return np.array(times), np.array(speeds)


@pytest.mark.parametrize(("method", "formulation"), [("dop853", "reduced"), ("dop853", "full"), ("rk4", "reduced")])
def test_a_ball_bounces_as_often_as_its_closed_form_and_rests(folder: Path, method: str, formulation: str) -> None:
    run = made(folder, BALL, formulation).simulate(4.2, method=method, stop=False)
    times, speeds = bounces(0.8, 1e-4)
    blows = run.impacts[run.impacts["t_off"] == run.impacts["t_on"]]
    assert len(blows) == len(times)
    np.testing.assert_allclose(blows["t_on"], times, rtol=1e-8)
    np.testing.assert_allclose(blows["deltadot"], speeds, atol=1e-8)
    np.testing.assert_allclose(blows["F_peak"][:-1], 0.092 * 1.8 * speeds[:-1], atol=1e-8)  # impulses, N s
    assert blows["F_peak"][-1] == pytest.approx(0.092 * speeds[-1], abs=1e-9)  # the last one does not return
    (rest,) = run.impacts[run.impacts["t_off"] != run.impacts["t_on"]]
    assert rest["t_on"] == pytest.approx(math.sqrt(2 / 9.81) * 1.8 / 0.2, abs=2e-4)  # Zeno's point, but for the threshold
    assert math.isnan(rest["t_off"]) and rest["F_peak"] == pytest.approx(0.092 * 9.81, rel=1e-12)
    assert run["A.Fn"][-1] == pytest.approx(0.092 * 9.81, rel=1e-12) and run["A.state"][-1] == 2
    assert run["A.delta"].max() <= 2e-15 and run["ball.y"][-1] == pytest.approx(-1.0, abs=1e-15)
    assert run.diagnostics.energy_residual < 1e-9 * run.diagnostics.energy_turned_over


@pytest.mark.parametrize("e", [0.0, 0.35, 1.0])
def test_energy_is_lost_by_the_law_and_by_nothing_else(folder: Path, e: float) -> None:
    """In a hole blows are oblique; ½ m (1 − e²) u² goes with each, nothing with e = 1, and none is ever gained."""
    simulation = made(folder, BALL)
    run = simulation.simulate(
        3.0, parameters=OBLIQUE | {"contacts.hard.normal.restitution": e}, stop=False, rtol=1e-11
    )
    blows = run.impacts[run.impacts["t_off"] == run.impacts["t_on"]]
    energy = run["energy.kinetic"] + run["energy.potential"]
    expected = 0.5 * 0.092 * (1.0 - e * e) * (blows["deltadot"] ** 2).sum()
    assert len(blows) >= 1
    assert energy[0] - energy[-1] == pytest.approx(expected, abs=1e-8 * abs(energy).max())
    assert np.diff(energy).max() < 1e-9 * abs(energy).max()
    if e == 1.0:
        assert len(blows) > 5
        np.testing.assert_allclose(energy, energy[0], atol=1e-10 * abs(energy).max())


def released(c: float = 5e-3, e: float = 0.6, tilt: float = 0.7, turn: float = 0.0, end: float = 0.6) -> tuple[HungBar, Any, Any]:
    bar = HungBar(0.4, 3e-3, 0.12, c, e, 1e-3)
    t = np.linspace(0.0, end, 301)
    y = np.array([0.12 * math.sin(tilt), -0.12 * math.cos(tilt), tilt, 0.12 * math.cos(tilt) * turn,
                  0.12 * math.sin(tilt) * turn, turn])  # fmt: skip
    return bar, t, bar.run(y, end, t)


@pytest.mark.parametrize(("method", "formulation"), [("dop853", "reduced"), ("dop853", "full"), ("rk4", "reduced")])
def test_a_bar_in_a_hole_against_an_oracle(folder: Path, method: str, formulation: str) -> None:
    """It falls, bounces ever faster, stays on the wall and swings there as a double pendulum does."""
    bar, t, expected = released()
    settings = {"step": 2e-5} if method == "rk4" else {"rtol": 1e-11}
    run = made(folder, BAR, formulation).simulate(output=t, method=method, **settings)
    blows = run.impacts[run.impacts["t_off"] == run.impacts["t_on"]]
    assert len(blows) == len(bar.blows) > 5 and len(bar.contacts) > 0
    np.testing.assert_allclose(np.array([list(blow) for blow in blows[["t_on", "deltadot", "F_peak"]]]), bar.blows, atol=1e-7)
    for name, column in (("bar.x", 0), ("bar.y", 1), ("bar.theta", 2), ("bar.omega", 5)):
        np.testing.assert_allclose(run[name], expected[:, column], atol=1e-6)
    closed = run["A.state"] > 0
    np.testing.assert_allclose(run["A.Fn"][closed], [bar.force(y) for y in expected[closed]], atol=1e-5)

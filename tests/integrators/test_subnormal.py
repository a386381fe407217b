"""Numbers below the normal range of binary64 are numbers: forces, rates and events of such a size change no motion."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.contract.methods import SMOOTH
from gudgeon.integrators import lanes
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = needs_compiler
BLOCK = """format: gudgeon/1
name: block
parameters: {e: 0, f: 1e-30, w: 0.3, c: 8.1}
bodies: {blk: {mass: 1 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
joints: {g: {translational: [ground.O, blk.origin], axis: [1, 0]}}
forces: {p: {force: blk.origin, value: ['%s', 0], axes: ground}}
start: {set: {blk.x: 0 m}, rates: {blk.vx: %s}}
"""
PULSE = "exp(-((t/(1 s)-c)/w)**2)/w/sqrt(pi) * 1 N"  # 4.7e-317 N at the start, an impulse of 1 N s
SPRING = "-1e4 N/m*blk.x - 300 N*s/m*blk.vx"
EVENT = "events: {z: {zero: 'e*f*(blk.x - 0.1 m)'}}\n"
TINY = [10.0**-k for k in (130, 250, 270, 279, 285, 290, 293)]  # times f: from 1e-160 to the smallest numbers
EVERY = ("auto", "dop853", "rodas5p", "radau5", "radau9", "rk4", *SMOOTH)


def load(tmp_path: Path, force: str, rate: str = "0 m/s", more: str = "") -> gudgeon.Simulation:
    file = tmp_path / "block.yaml"
    file.write_text(BLOCK % (force, rate) + more, encoding="utf-8")
    return gudgeon.load(file)


def options(method: str) -> dict[str, Any]:
    return {"method": method, "output": 20} | ({"step": 1e-3} if method == "rk4" else {})


@pytest.mark.parametrize("method", ["auto", "dop853", "rodas5p", "radau5", "rk4"])
def test_impulse_of_a_force_that_begins_subnormal(tmp_path: Path, method: str) -> None:
    """Velocity 1 m/s before, 2 m/s after."""
    run = load(tmp_path, PULSE, "1 m/s").simulate(12.0, **options(method))
    assert abs(run["blk.vx"][-1] - 2.0) < 1e-7


def test_the_same_in_a_batch(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lanes, "MIN_REMAINING_S", 0.0)  # side by side however short it is
    runs = load(tmp_path, PULSE, "1 m/s").simulate_many([{"c": c} for c in np.linspace(8.05, 8.15, 9)], 12.0, output=20)
    assert np.abs(runs["blk.vx"][:, -1] - 2.0).max() < 1e-7


@pytest.mark.parametrize("method", slow_but(("auto", "rodas5p", "radau5"), EVERY))
@pytest.mark.parametrize(
    ("force", "rate"),
    [
        ("e*f*1 N", "0 m/s"),
        ("e*f*1 N", "1 m/s"),
        ("e*f*sin(t*(40/(1 s)))*1 N", "0 m/s"),
        ("0 N", "e*f*1 m/s"),
        (SPRING, "e*f*1 m/s"),
        ("-9 N/m*blk.x - 2 N*abs(e*f*sin(30/(1 s)*t))", "1 m/s"),
    ],
)
def test_tiny_numbers_change_nothing(tmp_path: Path, method: str, force: str, rate: str) -> None:
    """Against the run in which they are zero."""
    scene = load(tmp_path, force, rate)
    zero = scene.simulate(1.0, **options(method))
    for e in TINY:
        run = scene.simulate(1.0, parameters={"e": e}, **options(method))
        assert np.abs(run["blk.x"] - zero["blk.x"]).max() < 1e-7, e


@pytest.mark.parametrize("e", [1e30, 1e-130, 1e-250, 1e-285])
def test_events_of_tiny_expressions(tmp_path: Path, e: float) -> None:
    """x = sin(3 t)/3 is 0.1 m at asin(0.3)/3 and (π - asin 0.3)/3."""
    found = load(tmp_path, "-9 N/m*blk.x", "1 m/s", EVENT).simulate(1.0, parameters={"e": e}, output=20).events
    assert np.abs(np.asarray(found["t"]) - np.array([np.arcsin(0.3), np.pi - np.arcsin(0.3)]) / 3.0).max() < 1e-8


def test_events_of_a_driven_linkage(tmp_path: Path) -> None:
    """The signs of two values whose product is too small are compared."""
    text = BLOCK.split("forces:")[0] + "drives: {m: {coordinate: blk.x, value: 0.3 m*sin(t/(1 s))}}\n" + EVENT
    file = tmp_path / "driven.yaml"
    file.write_text(text, encoding="utf-8")
    for e in (1e30, 1e-130, 1e-170, 1e-250):
        found = gudgeon.load(file).simulate(2.0, parameters={"e": e}, output=3).events
        assert abs(float(found["t"][0]) - np.arcsin(1.0 / 3.0)) < 1e-9, e


def test_a_mass_whose_energy_is_too_small_to_weigh_by(tmp_path: Path) -> None:
    file = tmp_path / "light.yaml"
    text = BLOCK.replace("e: 0", "e: 1e30") % ("e*f*1 N", "0 m/s")
    file.write_text(text.replace("mass: 1 kg, inertia: 1", "mass: e*f*1 kg, inertia: e*f*1"), encoding="utf-8")
    for e in (1e30, 1e-250, 1e-275):
        run = gudgeon.load(file).simulate(1.0, parameters={"e": e}, output=20)
        assert abs(run["blk.x"][-1] - 0.5) < 1e-9


@pytest.mark.parametrize("e", [1e-250, 1e-287, 1e-293])
def test_a_start_with_a_tiny_rate(tmp_path: Path, e: float) -> None:
    file = tmp_path / "pendulum.yaml"
    file.write_text(
        "format: gudgeon/1\nname: pendulum\nparameters: {e: 0, f: 1e-30}\ngravity: [9.81 m/s^2, 0]\n"
        "bodies: {a: {length: 0.3 m, mass: 1 kg, inertia: 0.01 kg*m^2}}\nground: {O: [0, 0]}\n"
        "joints: {O: {revolute: [ground.O, a.tail]}}\nstart: {set: {a.theta: 0}, rates: {a.omega: e*f*1 rad/s}}\n",
        encoding="utf-8",
    )
    run = gudgeon.load(file).simulate(1.0, parameters={"e": e}, output=20)
    assert np.abs(run["a.theta"]).max() <= e

"""The last instant of a run belongs to the motion before it: drives whose acceleration switches exactly at the end."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.results.results import Result
from tests.programs import needs_compiler

pytestmark = needs_compiler
CRANK = """\
format: gudgeon/1
name: j
bodies: {crank: {length: 0.2 m, mass: 1 kg, inertia: 1e-2 kg*m^2}}
ground: {O: [0, 0]}
joints: {O: {revolute: [ground.O, crank.tail]}}
curves: {lift: {points: [[0, 1], [0.5, 0.25], [1, 0]], x: s, extrapolate: hold, interpolation: monotone}}
drives: {turn: {angle: crank, value: "1 rad*(VALUE)"}}
"""
CART = """\
format: gudgeon/1
name: j
bodies:
  cart: {mass: 1 kg, inertia: 1e-3 kg*m^2}
  bob: {length: 0.4 m, mass: 0.5 kg, inertia: 7e-3 kg*m^2}
ground: {O: [0, 0]}
joints:
  rail: {translational: [ground.O, cart.origin], axis: [1, 0]}
  pin: {revolute: [cart.origin, bob.tail]}
start: {set: {bob.theta: -60 deg}}
drives: {push: {coordinate: cart.x, value: "1 m*(VALUE)"}}
"""
# Value, its second derivative before 1 s and after; its rate is 0 at 1 s. The curve's last piece has the values
# 0.25, 0 and the slopes -0.75, 0 at its ends, 0.5 s apart.
SWITCHES = [
    ("max(1 - T, 0)**2", 2.0, 0.0),
    ("where(t < 1 s, (1 - T)**2, 0)", 2.0, 0.0),
    ("where(t < 1 s, 0.5*(1 - T)**2, -(1 - T)**2)", 1.0, -2.0),
    ("lift(t)", 3.0, 0.0),
]


def scene(text: str, value: str, folder: Path) -> gudgeon.Simulation:
    file = folder / "j.yaml"
    file.write_text(text.replace("VALUE", value.replace("T", "(t/(1 s))")), encoding="utf-8")
    return gudgeon.load(file)


@pytest.mark.parametrize(("value", "before", "after"), SWITCHES)
def test_a_driven_scene(value: str, before: float, after: float, tmp_path: Path) -> None:
    """The crank's torque is that of its acceleration; a longer run has what follows at the same time."""
    simulation = scene(CRANK, value, tmp_path)
    run, longer = simulation.simulate(1.0, output=4), simulation.simulate(2.0, output=8)
    assert run["crank.omega"][-1] == pytest.approx(0.0, abs=1e-12)
    assert run["crank.alpha"][-1] == pytest.approx(before, abs=1e-9)
    assert run["turn.torque"][-1] == pytest.approx((1e-2 + 0.1**2) * before, abs=1e-9)
    assert longer["crank.alpha"][4] == pytest.approx(after, abs=1e-9)
    then = simulation.simulate(2.0, output=4, start=run.final)
    np.testing.assert_allclose(then["crank.alpha"], longer["crank.alpha"][4:], rtol=0, atol=1e-9)
    run.save(tmp_path / "run.nc")
    assert Result.load(tmp_path / "run.nc")["crank.alpha"].tobytes() == run["crank.alpha"].tobytes()


@pytest.mark.parametrize("options", [{}, {"method": "rk4"}, {"method": "rodas5p"}], ids=str)
@pytest.mark.parametrize(("value", "before", "after"), SWITCHES[:3])
def test_an_integrated_scene(value: str, before: float, after: float, options: dict[str, Any], tmp_path: Path) -> None:
    """Of a run alone, in a batch, and where a batch keeps series only."""
    simulation = scene(CART, value, tmp_path)
    run = simulation.simulate(1.0, output=4, **options)
    assert run["cart.ax"][-1] == pytest.approx(before, abs=1e-9)
    batch = simulation.simulate_many([{}] * 3, 1.0, output=4, **options)
    kept = simulation.simulate_many([{}] * 3, 1.0, output=4, keep=["cart.ax", "push.force"], **options)
    for name in ("cart.ax", "push.force"):
        for found in (batch[name], kept[name]):
            assert found[1].tobytes() == run[name].tobytes()


def test_a_rate_that_jumps_at_the_end_stays_that_behind_the_impulse(tmp_path: Path) -> None:
    run = scene(CRANK, "min(T, 1)**2", tmp_path).simulate(1.0, output=4)
    assert run["crank.omega"][-1] == 0.0 and run["crank.alpha"][-1] == 0.0


def test_rk4_passes_a_knot_at_which_the_second_rate_jumps(tmp_path: Path) -> None:
    """At the knot itself the curve has the second rate behind it: a jump is no rate without bounds. Order 4."""
    curve = next(line for line in CRANK.splitlines() if line.startswith("curves:"))
    cart = scene(f"{CART}{curve}\n", "lift(t)", tmp_path)
    exact = cart.simulate(1.0, output=4, rtol=1e-12)["bob.theta"][-1]
    off = [abs(cart.simulate(1.0, output=4, method="rk4", step=h)["bob.theta"][-1] - exact) for h in (2e-3, 1e-3)]
    assert off[1] < 1e-7 and off[0] / off[1] > 10.0

"""The field's reference problems through YAML, against answers that were not computed here (tests/data)."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.mechanisms import n_four_bar
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler

pytestmark = needs_compiler
KNOWN: dict[str, dict[str, Any]] = json.loads(
    (Path(__file__).parent.parent / "data" / "reference_problems.json").read_text(encoding="utf-8")
)
# Baumgarte's correction answers RK4's own drift, of order h^4, and so bends the motion by as much; a run of
# a few periods far from singular positions is more exact without it.
FREE = {"baumgarte.alpha": 0.0, "baumgarte.beta": 0.0}


@cache
def scene_of(name: str, scene: str | None = None) -> Simulation:
    return gudgeon.load(name, scene=scene)


def last(run: Any, names: Sequence[str]) -> np.ndarray:
    return np.array([run[name][-1] for name in names])


def seven(run: Any, what: str) -> np.ndarray:
    """Rates or accelerations of the test set's seven angles from those of the bodies."""
    x = {body: run[f"{body}.{what}"][-1] for body in ("OF", "FE", "BDE", "EG", "AG", "HE", "AH")}
    FE, EG, HE = x["FE"] - x["OF"], x["EG"] - x["AG"], x["HE"] - x["AH"]
    return np.array([x["OF"], FE, x["BDE"], EG, x["AG"], HE, x["AH"]])


def test_andrews_squeezer() -> None:
    """Step 1e-6 s; the crank has made two and a half turns from rest, at 181 turns a second in the end."""
    known = KNOWN["andrews_squeezer"]
    run = scene_of("andrews_squeezer").simulate(known["t"], output=3, step=1e-6, parameters=FREE)
    angles = last(run, ("beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon"))
    assert angles == pytest.approx(known["angles"], rel=1e-10)
    assert seven(run, "omega") == pytest.approx(known["rates"], rel=1e-9)
    assert seven(run, "alpha") == pytest.approx(known["accelerations"], rel=1e-9)
    forces = last(run, [f"{joint}.{component}" for joint in ("E3", "E4", "E6") for component in ("Fx", "Fy")])
    assert forces == pytest.approx(known["forces_at_E"], rel=1e-9)
    assert run.diagnostics.energy_residual < 1e-10  # of 0.5 J that the motor gave


def test_andrews_squeezer_as_shipped() -> None:
    """The scene's own step and the default gains, which reach the eight digits too."""
    known = KNOWN["andrews_squeezer"]
    run = scene_of("andrews_squeezer", "short").simulate(output=1, method="rk4")
    assert run.t[-1] == known["t"]
    angles = last(run, ("beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon"))
    assert angles == pytest.approx(known["angles"], rel=1e-8)


def test_pendulum() -> None:
    """Step 1e-4 s; the rod's force is the weight's share and the centripetal one: 3 m g times the descent."""
    known = KNOWN["pendulum"]
    run = scene_of("pendulum").simulate(known["t"], output=100, step=1e-4, parameters=FREE)
    assert last(run, ("bob.x", "bob.y", "bob.vx", "bob.vy")) == pytest.approx(known["x, y, vx, vy"], abs=1e-9)
    assert run.diagnostics.energy_residual < 5e-5  # the library's criterion
    assert run.diagnostics.energy_residual < 1e-9
    assert np.hypot(run["bob.x"], run["bob.y"]) == pytest.approx(1.0, abs=1e-9)
    assert run["rod.Fx"] == pytest.approx(3.0 * 9.81 * run["bob.y"] * run["bob.x"], abs=1e-8)
    assert run["rod.Fy"] == pytest.approx(3.0 * 9.81 * run["bob.y"] ** 2, abs=1e-8)


def test_pendulum_returns_after_its_period() -> None:
    """At rest on the horizontal after one period, and after five of exactly 2 s with the other gravity."""
    period = KNOWN["pendulum"]["period"]
    one = scene_of("pendulum").simulate(period, output=2, step=1e-4, parameters=FREE)
    assert one.q[:, 0] == pytest.approx([1.0, -1.0, 1.0], abs=1e-10)
    assert one.v[-1] == pytest.approx([0.0, 0.0, 0.0], abs=1e-9)
    five = scene_of("pendulum", "two_seconds").simulate(10.0, output=10, step=1e-4, parameters=FREE)
    assert five.q[:, 0] == pytest.approx([1.0, -1.0] * 5 + [1.0], abs=1e-9)
    assert np.abs(five.v).max() < 1e-9


@pytest.mark.parametrize("step", [1e-3, 5e-4])
def test_two_four_bars(step: float) -> None:
    """Through ten singular positions. The gains (50 1/s, the default) are needed here: a drift δ of the velocities
    becomes an error δ/φ of the accelerations at an angle φ from the singular position, and without them
    the cranks part at the second or third pass. A shorter step gains nothing: it comes nearer to φ = 0."""
    known = KNOWN["n_four_bar"]
    run = scene_of("n_four_bar").simulate(known["t"], output=2000, step=step)
    names = [f"crank0.head.{c}" for c in ("x", "y", "vx", "vy")]
    assert last(run, names) == pytest.approx(known["x, y, vx, vy"], abs=1e-6)
    angles = np.array([run[f"crank{i}.theta"] for i in range(3)])
    assert np.ptp(angles, axis=0).max() < 1e-6
    couplers = np.array([run[f"coupler{i}.theta"] for i in (1, 2)])
    assert np.abs(couplers).max() < 1e-6
    assert run.diagnostics.energy_residual < 1e-3
    assert angles[0].min() < -2.0 * math.pi * 4.5  # it did go round, five times


def test_four_bars_have_their_period() -> None:
    period = KNOWN["n_four_bar"]["period"]
    run = scene_of("n_four_bar").simulate(period, output=1, step=2.5e-4)
    assert run["crank0.theta"][-1] == pytest.approx(math.pi / 2.0 - 2.0 * math.pi, abs=1e-8)
    assert run["crank0.omega"][-1] == pytest.approx(-1.0, abs=1e-8)


def test_many_four_bars_move_as_one(tmp_path: Path) -> None:
    """Any N: the squares are alike, so that N changes only the share of the couplers. Closed form at the start:
    (I_cranks + N m L²) θ̈ = the cranks' weight on their arms; here upright, so that nothing turns them."""
    file = tmp_path / "n_four_bar_3.yaml"
    file.write_text(n_four_bar.text(3), encoding="utf-8")
    scene = gudgeon.load(file)
    assert scene.source.degrees_of_freedom == 1
    run = scene.simulate(0.4, output=40, step=2.5e-4)
    angles = np.array([run[f"crank{i}.theta"] for i in range(4)])
    assert np.ptp(angles, axis=0).max() < 1e-10
    inertia, pull = 4.0 / 3.0 + 3.0, 9.81 * (4.0 * 0.5 + 3.0)  # about the pivots; weight times arm, horizontal
    rate = np.sqrt(1.0 + 2.0 * pull / inertia * (1.0 - np.sin(angles[0])))
    assert run["crank0.omega"] == pytest.approx(-rate, rel=1e-9)
    with pytest.raises(ValueError, match="N is 0"):
        n_four_bar.text(0)


def test_n_four_bar_as_shipped_is_what_its_script_writes() -> None:
    shipped = Path(n_four_bar.__file__).with_name("n_four_bar.yaml")
    assert shipped.read_text(encoding="utf-8") == n_four_bar.text(2)


def test_car_axis() -> None:
    """Step 5e-5 s; the right spring's fast swing (k/m = 2000 1/s²) asks for it."""
    known = KNOWN["car_axis"]
    run = scene_of("car_axis").simulate(known["t"], output=300, step=5e-5, parameters=FREE)
    assert last(run, ("xl", "yl", "xr", "yr")) == pytest.approx(known["xl, yl, xr, yr"], rel=1e-8)
    rates = last(run, [f"axle.{end}.{c}" for end in ("tail", "head") for c in ("vx", "vy")])
    assert rates == pytest.approx(known["rates"], rel=1e-8)
    # the published constraints, term by term
    yb = 0.1 * np.sin(10.0 * run.t)
    xb = np.sqrt(1.0 - yb**2)
    assert run["xl"] * xb + run["yl"] * yb == pytest.approx(0.0, abs=1e-12)
    assert np.hypot(run["xl"] - run["xr"], run["yl"] - run["yr"]) == pytest.approx(1.0, abs=1e-12)
    assert run["road.head.x"] == pytest.approx(xb, abs=1e-12)
    assert run["axle.tail.vx"][0] == pytest.approx(-0.5, abs=1e-14)


def test_car_axis_has_the_published_equations() -> None:
    """k p̈ = …, with the multipliers of the published form eliminated: motion along the constraints' free directions."""
    k, r, omega = 5e-4, 0.1, 10.0
    scene = scene_of("car_axis")
    run = scene.simulate(0.5, output=25, step=5e-5, parameters=FREE)
    for i, t in enumerate(run.t):
        xl, yl, xr, yr = (run[name][i] for name in ("xl", "yl", "xr", "yr"))
        yb = r * math.sin(omega * t)
        xb = math.sqrt(1.0 - yb**2)
        left, right = math.hypot(xl, yl), math.hypot(xr - xb, yr - yb)
        applied = [(0.5 - left) * xl / left, (0.5 - left) * yl / left - k]
        applied += [(0.5 - right) * (xr - xb) / right, (0.5 - right) * (yr - yb) / right - k]
        a = [run[f"axle.{end}.{c}"][i] for end in ("tail", "head") for c in ("ax", "ay")]
        G = np.array([[xb, yb, 0.0, 0.0], [xl - xr, yl - yr, xr - xl, yr - yl]])
        free = np.linalg.svd(G)[2][2:]
        assert free @ (k * np.array(a) - applied) == pytest.approx([0.0, 0.0], abs=1e-12)


def test_slider_crank_spring() -> None:
    """The published five digits; and twice the step changes nothing in them."""
    known = KNOWN["slider_crank_spring"]
    for step in (1e-2, 5e-3):
        run = scene_of("slider_crank_spring").simulate(10.0, output=10, step=step)
        for t in (2, 10):
            want = known[f"q, x, p at t = {t}"]
            for name, value in zip("qxp", want, strict=True):
                assert run[name][t] == pytest.approx(value, abs=0.6 * 10.0 ** -_decimals(value))
        assert run.diagnostics.energy_residual < 1e-5


def _decimals(value: float) -> int:
    return len(repr(value).partition(".")[2])

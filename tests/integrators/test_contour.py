"""Bearings that are no circles: elastic motion by a potential, a valley's frequency, circles of another size."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import gudgeon
from gudgeon.errors import ArrayError, BadValueError, UnknownNameError
from gudgeon.model.contours import interpolate_depth
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler

pytestmark = needs_compiler
K, C, R, A, N = 1e8, 0.2e-3, 10e-3, 40e-6, 512
ANGLES = 2.0 * np.pi * np.arange(N) / N
FAR = complex(0.03, 0.01)  # the bearing's centre on the ring
MASS, RING, PIN = 0.5, 2e-4, 4e-5  # kg, kg m²
TEXT = f"""
format: gudgeon/1
name: rig
title: rig
parameters: {{c: {C}, R: {R}, worn: 0 m/s^2, steep: worn}}
gravity: [0, -steep] # called as the steps of a contour are
materials: {{steel: {{E: 207 GPa, nu: 0.3}}}}
ground: {{O: [0, 0]}}
bearings: {{b: {{radius: R, clearance: c, length: 20 mm, bearing_material: steel, journal_material: steel}}}}
contacts:
  dry: {{normal: {{law: hertz, stiffness: {K}, restitution: 1, dissipation: none}}}}
  rub:
    normal: {{law: hertz, stiffness: {K}, restitution: 0.8}}
    friction: {{law: modified_coulomb, mu: 0.2, v0: 1e-3 m/s, v1: 1e-2 m/s}}
bodies:
  ring: {{mass: 1 kg, inertia: {RING}, points: {{far: [{FAR.real}, {FAR.imag}]}}}}
  pin: {{mass: {MASS} kg, inertia: {PIN}}}
joints: {{O: {{revolute: [ground.O, ring.origin]}}, J: {{revolute: [ring.far, pin.origin]}}}}
start:
  rates: {{ring.omega: 5 rad/s, pin.omega: -40 rad/s}}
  play: {{J: {{e: [0.05 mm, 0.02 mm], rate: [0.11 m/s, 0.05 m/s]}}}}
scenes:
  circle: {{play: {{J: {{bearing: b, contact: rub}}}}}}
  worn: {{play: {{J: {{bearing: b, contact: dry, contour: {N}}}}}}}
  rubs: {{play: {{J: {{bearing: b, contact: rub, contour: {N}}}}}}}
"""


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("contour") / "rig.yaml"
    path.write_text(TEXT, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def worn(file: Path) -> Simulation:
    return gudgeon.load(file, "worn")


@pytest.fixture(scope="module")
def rubs(file: Path) -> Simulation:
    return gudgeon.load(file, "rubs")


def potential(z: Any, theta: Any) -> Any:
    """The elastic energy of the pin at z = (x, y), the ring at θ; of real parts, analytic beside them."""
    turned = FAR.real * np.cos(theta) - FAR.imag * np.sin(theta), FAR.real * np.sin(theta) + FAR.imag * np.cos(theta)
    x, y = z[0] - turned[0], z[1] - turned[1]
    e = np.sqrt(x * x + y * y)
    cos, sin = (x * np.cos(theta) + y * np.sin(theta)) / e, (y * np.cos(theta) - x * np.sin(theta)) / e
    delta = e - C - A * (cos * cos - sin * sin)  # cos 2β
    return 0.4 * K * delta**2.5 if np.real(delta) > 0.0 else 0.0 * delta


def rates(_: float, s: np.ndarray) -> np.ndarray:
    """(x, y, θ) and their rates: forces are slopes of the potential, by complex steps."""
    h = 1e-30
    forces = []
    for k in range(3):
        moved = s[:3].astype(complex)
        moved[k] += 1j * h
        forces.append(-np.imag(potential(moved[:2], moved[2])) / h)
    return np.array([*s[3:], forces[0] / MASS, forces[1] / MASS, forces[2] / RING])


def test_an_elastic_journal_moves_by_the_potential_of_the_gap(worn: Simulation) -> None:
    """Against scipy with nothing of the equations: forces are the slopes of U(δ), along e, across it and by θ.

    512 depths are cos 2β to 1e-6; every method, both formulations; the energy stays, the ring is turned by the pin.
    """
    contour, t_end = {"J": A * np.cos(2.0 * ANGLES)}, 0.02
    start = worn.start()
    pin, ring = 3, 0
    s = np.concatenate([start.q[[pin, pin + 1, ring + 2]], start.v[[pin, pin + 1, ring + 2]]])
    want = solve_ivp(rates, (0.0, t_end), s, method="DOP853", rtol=1e-11, atol=1e-14, max_step=1e-5).y[:, -1]
    for simulation, method, rtol, step in (
        (worn, "dop853", 1e-10, None),
        (worn, "rodas5p", 1e-9, None),
        (worn, "rk4", None, 2e-6),
        (worn.full, "dop853", 1e-10, None),
        (worn.full, "rodas5p", 1e-9, None),
    ):
        run = simulation.simulate(t_end, output=200, method=method, contour=contour, rtol=rtol, step=step)
        assert len(run.impacts) >= 5 and np.ptp(run["ring.omega"]) > 0.1
        assert np.abs(run["energy.residual"]).max() < 3e-8 * run["energy.kinetic"].max()
        got = np.concatenate([run.q[-1, [pin, pin + 1, ring + 2]], run.v[-1, [pin, pin + 1, ring + 2]]])
        np.testing.assert_allclose(got[:3], want[:3], atol=2e-7)
        np.testing.assert_allclose(got[3:], want[3:], rtol=2e-4, atol=2e-5)


def test_a_journal_swings_in_a_valley(worn: Simulation) -> None:
    """At rest below, F_n the weight; beside it ω² = g (ρ − 4a)/ρ², of a point on the curve c + δ − a cos 2φ."""
    a, g = A / 8.0, 9.81
    contour, rho = {"J": a * np.cos(2.0 * ANGLES)}, C - a + (MASS * g / K) ** (2.0 / 3.0)
    numbers = {"worn": g, "start.rates.ring.omega": 0.0, "start.rates.pin.omega": 0.0, "bodies.ring.inertia": 1e9}
    for away in (0.0, 1e-3):
        e = rho * np.array([math.sin(away), -math.cos(away)])
        numbers |= {"start.play.J.e.x": e[0], "start.play.J.e.y": e[1], "start.play.J.rate.x": 0.0}
        numbers["start.play.J.rate.y"] = 0.0
        run = worn.simulate(0.05, output=4000, parameters=numbers, contour=contour, rtol=1e-11)
        if not away:
            np.testing.assert_allclose(run["J.Fn"], MASS * g, rtol=1e-4)
            continue
        angle = np.arctan2(run["J.ex"], -run["J.ey"])
        k = np.flatnonzero(np.diff(np.sign(angle)))
        zero = run.t[k] - angle[k] * (run.t[k + 1] - run.t[k]) / (angle[k + 1] - angle[k])
        omega = math.pi / np.diff(zero).mean()
        assert omega == pytest.approx(math.sqrt(g * (rho - 4.0 * a)) / rho, rel=2e-3)


def test_an_even_contour_is_a_larger_circle(file: Path, rubs: Simulation) -> None:
    """Depth w everywhere is a bearing of radius R + w and clearance c + w: the same journal, friction included."""
    w, circle = 30e-6, gudgeon.load(file, "circle")
    options: dict[str, Any] = {"output": 50, "method": "dop853", "rtol": 1e-10}
    for depth in (0.0, w):
        wide = circle.simulate(0.01, parameters={"c": C + depth, "R": R + depth}, **options)
        even = rubs.simulate(0.01, contour={"J": np.full(N, depth)}, **options)
        assert len(wide.impacts) >= 2 and np.abs(wide["J.Ft"]).max() > 1.0
        np.testing.assert_allclose(even.q, wide.q, atol=1e-12)
        np.testing.assert_allclose(even.v, wide.v, atol=1e-9)
        np.testing.assert_allclose(even["J.delta"], wide["J.delta"], atol=1e-12)


def test_friction_only_takes_and_nothing_turns_by_itself(rubs: Simulation) -> None:
    """Of a steep contour: power of friction ≤ 0, both bodies keep their angular momentum about O."""
    rng = np.random.default_rng(4)
    depths = 30e-6 * rng.uniform(0.0, 1.0, N // 8).repeat(8)
    run = rubs.simulate(0.05, output=3000, contour={"J": depths}, rtol=1e-9)
    touching = run["J.delta"] > 0.0
    assert touching.sum() > 20 and (run["J.Ft"] * run["J.vt"])[touching].max() <= 0.0
    work = run["energy.kinetic"] - run["energy.kinetic"][0]
    np.testing.assert_allclose(work[-1], run["work.clearances"][-1], rtol=1e-6)
    spin = RING * run["ring.omega"] + PIN * run["pin.omega"]
    spin += MASS * (run["pin.x"] * run["pin.vy"] - run["pin.y"] * run["pin.vx"])
    assert np.ptp(spin) < 1e-8 * np.abs(spin).max()


def test_its_polynomials_have_two_derivatives_and_the_mean_of_the_depths() -> None:
    rng = np.random.default_rng(2)
    depths = rng.uniform(0.0, 1.0, 24)
    knots = 2.0 * np.pi * np.arange(24) / 24
    np.testing.assert_allclose(interpolate_depth(depths, knots), depths, atol=1e-14)
    for order in range(3):
        np.testing.assert_allclose(
            interpolate_depth(depths, knots - 1e-12, order),
            interpolate_depth(depths, knots + 1e-12, order),
            rtol=1e-8,
            atol=1e-8,
        )
    x = rng.uniform(-20.0, 20.0, 200)
    for order in (1, 2):
        rise = (interpolate_depth(depths, x + 1e-6, order - 1) - interpolate_depth(depths, x - 1e-6, order - 1)) / 2e-6
        np.testing.assert_allclose(interpolate_depth(depths, x, order), rise, rtol=1e-5, atol=1e-5 * 24**order)
    fine = (np.arange(24 * 400) + 0.5) * 2.0 * np.pi / (24 * 400)
    assert interpolate_depth(depths, fine).mean() == pytest.approx(depths.mean(), rel=1e-9)


def test_a_batch_has_a_contour_a_run(worn: Simulation, tmp_path: Path) -> None:
    """Bit for bit the single runs; files know it; a run goes on with another one and says so."""
    several = A * np.cos(2.0 * ANGLES) * np.array([[0.0], [0.5], [1.0]])
    batch = worn.simulate_many({}, 0.005, output=10, contour={"J": several}, threads=2)
    for k, depths in enumerate(several):
        run = worn.simulate(0.005, output=10, contour={"J": depths})
        assert np.array_equal(batch[k].q, run.q) and np.array_equal(batch[k]["J.delta"], run["J.delta"])
        assert np.array_equal([run.parameters[f"scenes.worn.play.J.contour.{i}"] for i in range(N)], depths)
    run.save(tmp_path / "run.nc")
    assert np.array_equal(gudgeon.Result.load(tmp_path / "run.nc")["J.delta"], run["J.delta"])
    on = worn.simulate(0.006, output=10, start=run.final)
    assert np.array_equal(on.p, run.p)
    other = worn.simulate(0.006, output=10, start=run.final, contour={"J": several[1]})
    assert any("other parameter values" in note for note in other.diagnostics.notes)


def test_what_is_no_contour_is_refused(worn: Simulation, file: Path) -> None:
    with pytest.raises(UnknownNameError, match="no contour at 'O'"):
        worn.simulate(0.01, contour={"O": np.zeros(N)})
    for wrong in (np.zeros(8), np.full(N, np.nan), "deep", np.zeros((2, N))):
        with pytest.raises(ArrayError):
            worn.simulate(0.01, contour={"J": wrong})
    with pytest.raises(BadValueError, match="clearance of J is 0 m at its contour"):
        worn.simulate(0.01, contour={"J": np.full(N, -C)})
    failed = worn.simulate_many({}, 0.001, output=2, contour={"J": np.stack([np.zeros(N), np.full(N, -C)])})
    assert [one.run for one in failed.failures] == [1]
    with pytest.raises(BadValueError, match="3 runs"):
        worn.simulate_many({"c": [1e-4, 2e-4, 3e-4]}, 0.001, contour={"J": np.zeros((2, N))})


@pytest.mark.parametrize("number", [32, np.int64(32)])
def test_the_number_of_depths_can_be_overridden_by_a_whole_number(file: Path, number: Any) -> None:
    """A whole number stays one on its way into the file's text: 32.0 is no number of depths."""
    worn = gudgeon.load(file, "worn", overrides={"scenes.worn.play.J.contour": number})
    assert worn.simulate(1e-4, contour={"J": np.zeros(32)}).t[-1] == 1e-4

"""Friction between surfaces that do not give: blows against closed forms and an algebraic law, contacts that slide."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import gudgeon
from gudgeon.errors import BadValueError, SolverError
from gudgeon.simulation.simulation import Simulation
from tests.integrators.test_newton_restitution import CRANK, HEAD
from tests.programs import needs_compiler

pytestmark = needs_compiler
DISC = """\
bodies: {disc: {mass: 0.092 kg, inertia: 7e-6 kg*m^2}}
ground: {hole: [0, 0]}
freedoms: 1
joints: {A: {revolute: [ground.hole, disc.origin]}}
start: {play: {A: {}}, set: {disc.theta: 0}, rates: {disc.omega: 0}}
bearings: {wide: {radius: 1.014 m, clearance: 1 m, length: 10 mm, bearing_material: steel, journal_material: steel}}
contacts:
  hard:
    normal: {law: newton_restitution, restitution: 0.8}
    friction: {law: coulomb, mu: 0.2, v0: 1e-3 m/s}
scenes: {hard: {play: {A: {bearing: wide, contact: hard}}, simulate: {t_end: 2 s, step: 1e-3 s}}}
"""
BAR = """\
bodies: {bar: {mass: 0.4 kg, inertia: 5e-4 kg*m^2, points: {pin: [0, 0.12 m]}}}
ground: {hole: [0, 0]}
freedoms: 1
joints: {A: {revolute: [ground.hole, bar.pin]}}
start: {play: {A: {}}, set: {bar.theta: 0.7}, rates: {bar.omega: 0}}
bearings: {hole: {radius: 15 mm, clearance: 5 mm, length: 10 mm, bearing_material: steel, journal_material: steel}}
contacts:
  hard:
    normal: {law: newton_restitution, restitution: 0.6, threshold: 1e-3 m/s}
    friction: {law: modified_coulomb, mu: 0.3, v0: 1e-4 m/s, v1: 1e-3 m/s}
  spring:
    normal: {law: hertz, stiffness: 1e9, dissipation: exact, restitution: 0.6}
    friction: {law: modified_coulomb, mu: 0.3, v0: 1e-4 m/s, v1: 1e-3 m/s}
scenes:
  hard: {play: {A: {bearing: hole, contact: hard}}, simulate: {t_end: 1 s, step: 1e-4 s}}
  spring: {extends: hard, play: {A: {bearing: hole, contact: spring}}}
"""
TWO = """\
parameters: {drop: 0 m}
bodies: {bar: {mass: 0.4 kg, inertia: 3e-3 kg*m^2, points: {left: [-0.1 m, 0], right: [0.1 m, 0]}}}
ground: {west: [-0.1 m, -drop], east: [0.1 m, drop]}
freedoms: 0
joints: {A: {revolute: [ground.west, bar.left]}, B: {revolute: [ground.east, bar.right]}}
start: {play: {A: {}, B: {}}}
bearings: {hole: {radius: 15 mm, clearance: 5 mm, length: 10 mm, bearing_material: steel, journal_material: steel}}
contacts:
  hard: {normal: {law: newton_restitution, restitution: 0.6}, friction: {law: coulomb, mu: 0.4, v0: 1e-3 m/s}}
  soft: {extends: hard, normal: {restitution: 0.3}}
scenes:
  hard:
    play: {A: {bearing: hole, contact: hard}, B: {bearing: hole, contact: soft}}
    simulate: {t_end: 1 s, step: 1e-4 s}
"""
g = 9.81


@cache
def made(folder: Path, text: str, formulation: str = "reduced", scene: str = "hard") -> Simulation:
    file = folder / f"rubbed_{abs(hash(text))}.yaml"
    file.write_text(HEAD + text, encoding="utf-8")
    return gudgeon.load(file, scene, formulation=formulation)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("rubbed")


def blow(u: float, slip: float, along: tuple[float, float, float], e: float, mu: float) -> tuple[float, float]:
    """Chatterjee and Ruina's impulses (normal, along the slip): P = (1 + e) P_I + (1 + e_t)(P_II − P_I).

    P_I stops the approach without friction, P_II the slip too; e_t within −1 and 1 leaves least slip, |P_t| ≤ μ P_n.
    `along`: a normal impulse takes D of the approach u, one along the slip adds S to it and B to the approach.
    """
    D, S, B = along
    plastic = np.array([u / D, 0.0])
    step = np.linalg.solve([[D, -B], [-B, S]], [u, -slip]) - plastic
    base = (1.0 + e) * plastic
    low, high, P = 0.0, 2.0, base
    for _ in range(8):  # by trying, ever nearer: no formula of the engine's
        k = np.linspace(low, high, 2001)
        tried = base + k[:, None] * step
        left = np.where(abs(tried[:, 1]) <= mu * tried[:, 0], abs(slip - B * tried[:, 0] + S * tried[:, 1]), math.inf)
        best, apart = int(left.argmin()), k[1] - k[0]
        low, high, P = max(k[best] - apart, 0.0), min(k[best] + apart, 2.0), tried[best]
    return float(P[0]), float(P[1])


@pytest.mark.parametrize("omega", [-70.0, 0.0, 63.0])
@pytest.mark.parametrize("mu", [0.02, 0.2])
def test_a_disc_leaves_a_wall_with_the_spin_that_friction_gives_it(folder: Path, omega: float, mu: float) -> None:
    """Straight down, where normal and slip are apart: P = min(μ (1 + e) m u, m_t |v|), and then it rolls."""
    m, J, R, e = 0.092, 7e-6, 0.014, 0.8
    given = {"start.rates.disc.omega": omega, "contacts.hard.friction.mu": mu, "start.play.A.e.y": -0.9}
    run = made(folder, DISC).simulate(0.2, parameters=given, output=2, stop=False)
    u, slip = math.sqrt(2.0 * g * 0.1), R * omega
    P = -math.copysign(min(mu * (1.0 + e) * m * u, abs(slip) / (1.0 / m + R * R / J)), slip)
    assert run["disc.omega"][-1] == pytest.approx(omega + R * P / J, rel=1e-7, abs=1e-9)
    assert run["disc.vx"][-1] == pytest.approx(P / m, rel=1e-7, abs=1e-9)
    assert run["disc.vy"][-1] == pytest.approx(e * u - g * (0.2 - u / g), rel=1e-7)
    assert run.impacts["F_peak"][0] == pytest.approx((1.0 + e) * m * u, rel=1e-7)
    assert (abs(slip) / (1.0 / m + R * R / J) < mu * (1.0 + e) * m * u) == (omega == 0.0 or mu == 0.2)  # both kinds


@pytest.mark.parametrize(("mu", "e"), [(0.05, 0.6), (0.3, 0.0), (0.3, 1.0), (2.0, 0.6)])
def test_an_oblique_blow_is_that_of_its_law_and_takes_energy(folder: Path, mu: float, e: float) -> None:
    """A bar's end in a hole, where friction presses or relieves: slides, and sticks with μ = 2."""
    m, J, arm, R = 0.4, 5e-4, 0.12, 0.010
    given = {"contacts.hard.friction.mu": mu, "contacts.hard.normal.restitution": e, "start.play.A.rate.x": 0.4}
    simulation, short = made(folder, BAR), 1e-9
    first = simulation.simulate(0.05, parameters=given, output=2).impacts[0]["t_on"]
    run = simulation.simulate(output=[0.0, first - short, first + short], parameters=given, rtol=1e-12)
    names = ("bar.vx", "bar.vy", "bar.omega")
    before, after = (np.array([run[name][k] for name in names]) for k in (1, 2))
    n = np.array([run["A.ex"][2], run["A.ey"][2]]) / run["A.e"][2]
    tilt = run["bar.theta"][2]
    at = arm * np.array([-math.sin(tilt), math.cos(tilt)]) + R * n  # of the contact, from the centre of mass
    mass = np.diag([m, m, J])
    rows = np.array([[*d, at[0] * d[1] - at[1] * d[0]] for d in (n, (-n[1], n[0]))])
    G = rows @ np.linalg.solve(mass, rows.T)
    u, slip = rows @ before
    pushed, P = blow(u, slip, (G[0, 0], G[1, 1], G[0, 1]), e, mu)
    expected = before + np.linalg.solve(mass, rows.T @ [-pushed, P])
    np.testing.assert_allclose(after, expected, rtol=1e-6, atol=1e-6)
    assert (rows @ after)[0] == pytest.approx(-e * u, abs=1e-6) and abs(P) <= mu * pushed * (1.0 + 1e-12)
    energy = [0.5 * v @ mass @ v for v in (before, after)]
    assert energy[1] < energy[0] * (1.0 - 1e-3)
    assert (abs(P) < 0.999 * mu * pushed) == (mu == 2.0)


@pytest.mark.parametrize(("sideways", "end", "mu"), [(0.4, 0.016, 0.2), (0.0, 0.034, 0.2), (0.0, 0.034, 2.0)])
def test_ever_stiffer_springs_come_to_the_same(folder: Path, sideways: float, end: float, mu: float) -> None:
    """Off by their time of contact, K^(−2/5), where it slides, begins to slide, or sticks all through a blow."""

    def settings(name: str, mu: float = mu) -> dict[str, float]:
        return {f"contacts.{name}.friction.{key}": x for key, x in (("mu", mu), ("v0", 1e-6), ("v1", 1e-5))} | given

    t, given = np.linspace(0.0, end, 18), {"start.play.A.rate.x": sideways}
    simulation, soft = made(folder, BAR), made(folder, BAR, scene="spring")
    rigid = simulation.simulate(output=t, rtol=1e-11, parameters=settings("hard"))
    smooth = simulation.simulate(output=t, rtol=1e-11, parameters=settings("hard", 0.0))
    assert len(rigid.impacts) == 1 and abs(smooth["bar.theta"] - rigid["bar.theta"]).max() > 4e-4
    off = []
    for stiffness in (1e9, 3.2e11, 1.024e14):  # times 320: contacts are 10 times shorter
        stiff = settings("spring") | {"contacts.spring.normal.stiffness": stiffness}
        run = soft.simulate(output=t, rtol=1e-10, parameters=stiff)
        off.append(abs(run["bar.theta"] - rigid["bar.theta"]).max())
    assert off[0] < 1e-3 and off[1] < 0.13 * off[0] and off[2] < 0.13 * off[1]


@pytest.mark.parametrize(
    ("method", "formulation"),
    [("dop853", "reduced"), pytest.param("dop853", "full", marks=pytest.mark.slow), ("rk4", "reduced")],
)
def test_a_disc_slides_in_its_hole_until_it_rolls(folder: Path, method: str, formulation: str) -> None:
    """It spins on the wall: R φ'' and ω' by the same law, as scipy integrates them."""
    m, J, R, mu, v0, spin, end = 0.092, 7e-6, 0.014, 0.2, 1e-3, 200.0, 2.0
    given = {"start.rates.disc.omega": spin, "start.play.A.e.y": -1.0}

    def rates(_: float, y: Any) -> Any:
        angle, speed, omega = y
        F_n = m * (g * math.cos(angle) + speed * speed)  # e = 1 m
        F_t = -mu * math.tanh((speed + R * omega) / v0) * F_n
        return [speed, F_t / m - g * math.sin(angle), R * F_t / J]

    t = np.linspace(0.0, end, 41)
    expected = solve_ivp(rates, (0.0, end), [0.0, 0.0, spin], t_eval=t, rtol=1e-10, atol=1e-12, method="Radau").y
    step: dict[str, Any] = {"step": 2e-4} if method == "rk4" else {"rtol": 1e-10}
    run = made(folder, DISC, formulation).simulate(output=t, parameters=given, method=method, stop=False, **step)
    np.testing.assert_allclose(np.arctan2(run["disc.x"], -run["disc.y"]), expected[0], atol=1e-6)
    np.testing.assert_allclose(run["disc.omega"], expected[2], atol=1e-4)
    assert (run["A.state"] == 2).all() and len(run.impacts) == 1
    assert abs(run["A.vt"][1]) > 0.5 and abs(run["A.vt"][-1]) < 1e-3  # it slid, and rolls
    assert run.diagnostics.energy_residual < 1e-6 * run.diagnostics.energy_turned_over


def test_two_blows_at_once_and_all_that_follows_take_energy(folder: Path) -> None:
    """Both ends strike while the bar moves along: no blow and no step gains, works balance, partings are as told."""
    simulation = made(folder, TWO)
    for along, mu in ((0.3, 0.4), (-0.3, 0.05), (0.05, 3.0)):
        given = {"contacts.hard.friction.mu": mu, "contacts.soft.friction.mu": mu}
        given |= {f"start.play.{joint}.rate.x": along for joint in "AB"}
        run = simulation.simulate(0.3, parameters=given, output=3000, rtol=1e-10)
        energy = run["energy.kinetic"] + run["energy.potential"]
        scale = run.diagnostics.energy_turned_over
        assert np.diff(energy).max() < 1e-9 * scale and energy[-1] - energy[0] < -0.05 * scale
        assert run.diagnostics.energy_residual < 1e-8 * scale
        assert max(run[f"{joint}.delta"].max() for joint in "AB") < 1e-12
        assert len(run.impacts) >= 4
        for joint in "AB":
            closed = run[f"{joint}.state"] > 0
            assert (np.abs(run[f"{joint}.Ft"][closed]) <= mu * run[f"{joint}.Fn"][closed] * (1.0 + 1e-12)).all()


@pytest.mark.filterwarnings("error")
def test_a_report_tells_the_restitution_of_what_meets_and_of_nothing_that_is_pressed(folder: Path) -> None:
    """Each joint's own e_n, also where another one's blows press a contact that is closed and has no approach."""
    simulation = made(folder, TWO)
    run = simulation.simulate(0.3, parameters={f"start.play.{joint}.rate.x": 0.3 for joint in "AB"}, output=30)
    assert (run.impacts["deltadot"] == 0.0).sum() > 5  # pressed only
    blows = run.impacts[run.impacts["deltadot"] > 0.0]
    assert blows["deltadot"].min() > 1e-10  # of the threshold 1e-4 m/s: slower is at rest
    joints = gudgeon.examine(simulation, run).report().to_dict()["joints"]
    for k, (joint, requested) in enumerate((("A", 0.6), ("B", 0.3))):
        met = blows["deltadot"][blows["joint"] == k]
        assert joints[joint]["approach"]["min"] == met.min() and joints[joint]["approach"]["max"] == met.max()
        assert joints[joint]["restitution"]["median"] == pytest.approx(requested, abs=1e-9)
        assert joints[joint]["restitution"]["max"] == pytest.approx(requested, abs=1e-9)


def test_no_blow_gains_energy_whatever_meets(folder: Path) -> None:
    """Both ends of a bar strike, or rest and are struck, at random speeds, restitutions, coefficients and inertias."""
    simulation, rng, ran = made(folder, TWO), np.random.default_rng(17), 0
    for _ in range(60):
        given = {"bodies.bar.inertia": 10.0 ** rng.uniform(-3.5, -2.0)}
        sideways, deep, mu = rng.uniform(-1.0, 1.0), rng.choice([-5e-3, -4.9e-3]), rng.uniform(0.0, 1.0)
        for joint, contact in (("A", "hard"), ("B", "soft")):
            given |= {f"start.play.{joint}.rate.x": sideways, f"start.play.{joint}.rate.y": rng.uniform(-1.0, 1.0)}
            given |= {f"start.play.{joint}.e.y": deep, f"contacts.{contact}.friction.mu": mu}
            given[f"contacts.{contact}.normal.restitution"] = rng.uniform(0.0, 1.0)
        try:
            run = simulation.simulate(0.02, parameters=given, output=100, rtol=1e-9)
        except SolverError as error:
            assert "jams" in str(error)
            continue
        energy, ran = run["energy.kinetic"] + run["energy.potential"], ran + 1
        scale = run.diagnostics.energy_turned_over + abs(energy[0])
        assert np.diff(energy).max() < 1e-13 * scale and run.diagnostics.energy_residual < 1e-7 * scale
        assert all(run[f"{joint}.delta"].max() < 1e-12 for joint in "AB")
    assert ran > 50


def test_beside_friction_that_sticks_and_a_drive(folder: Path) -> None:
    """Blows with friction in two joints, a stick and a drive that turns round: formulations agree, works balance."""
    rubs = CRANK.replace("restitution: 0.5}", "restitution: 0.5}, friction: {law: coulomb, mu: 0.15, v0: 1e-3 m/s}")
    assert rubs != CRANK
    reference = made(folder, rubs).simulate(rtol=1e-11, output=300)
    other = made(folder, rubs, "full").simulate(rtol=1e-11, output=300)
    for run in (reference, other):
        assert run.diagnostics.energy_residual < 1e-9 * run.diagnostics.energy_turned_over
        assert max(run[f"{joint}.delta"].max() for joint in "PQ") < 1e-12
    assert {*reference.impacts["joint"]} == {0, 1} and len(reference.impacts) == len(other.impacts) > 20
    np.testing.assert_allclose(other["block.x"], reference["block.x"], atol=1e-9)
    assert {*reference["rub.mode"]} == {-1.0, 0.0, 1.0} and abs(reference["P.Ft"]).max() > 10.0


def test_friction_that_jams_a_contact_is_told(folder: Path) -> None:
    """Painlevé's bar: dragged over a wall it is drawn into it where μ > (J/m + x²)/(x y): no force keeps it out."""
    tilt = 0.7
    given = {"contacts.hard.friction.mu": 8.0, "start.play.A.e.y": -5e-3, "start.play.A.rate.x": 0.2}
    message = []
    for way in (1.0, -1.0):
        given |= {"start.set.bar.theta": way * tilt + math.pi, "start.play.A.rate.x": 0.2}
        try:
            made(folder, BAR).simulate(0.01, parameters=given)
        except SolverError as error:
            message.append(str(error))
    assert len(message) == 1 and "friction jams a contact of newton_restitution at t = 0 s" in message[0]


def wedged(mu: tuple[float, float], tilt: float = 0.1) -> dict[str, float]:
    """A bar of TWO that is held at both ends between the outer flanks of its holes, and moves down."""
    x, y = 0.1 * math.cos(tilt) - 0.005, 0.1 * math.sin(tilt)
    given = {"ground.west.x": -x, "ground.east.x": x, "drop": y}
    for joint, contact, side, value in (("A", "hard", -1.0, mu[0]), ("B", "soft", 1.0, mu[1])):
        given |= {f"start.play.{joint}.e.x": side * 0.005, f"start.play.{joint}.rate.y": -1.0}
        given |= {f"contacts.{contact}.friction.mu": value, f"contacts.{contact}.normal.restitution": 0.0}
    return given


@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_contacts_that_friction_wedges_together_are_told(folder: Path, formulation: str) -> None:
    """Each pushes as m v²/c and levers let it; F_n = (v²/c) J / (l (2 l + (μ_B − μ_A) L)), none where that is < 0."""
    tilt, a, R, J = 0.1, 0.1, 0.010, 3e-3
    lever, arm = a * math.sin(tilt), a * math.cos(tilt) + R
    simulation, most = made(folder, TWO, formulation), 0.1 + 2.0 * lever / arm
    for mu in (0.1, 0.5 * most, 0.98 * most):
        run = simulation.simulate(1e-6, parameters=wedged((mu, 0.1)), output=2)
        expected = J / (0.005 * lever * (2.0 * lever + (0.1 - mu) * arm))
        assert run["A.Fn"][0] == pytest.approx(expected, rel=1e-6)
        assert run["B.Fn"][0] == pytest.approx(expected, rel=1e-6)
    assert 0.4 * lever * (1.02 * most * arm - lever) < J  # alone either contact would part
    with pytest.raises(SolverError, match="friction jams a contact of newton_restitution at t = 0 s"):
        simulation.simulate(1e-6, parameters=wedged((1.02 * most, 0.1)), output=2)
    moving = {f"start.play.{joint}.rate.{way}": v for joint in "AB" for way, v in (("x", 0.1), ("y", 1.0))}
    with pytest.raises(SolverError, match=r"friction jams .* at t = 0\.01363\d* s: .* grow beyond all bounds"):
        simulation.simulate(
            0.05, parameters=wedged((0.7, 0.8)) | moving
        )  # one slip ends, its friction no longer holds against the other's


def test_friction_that_a_blow_does_not_know_is_refused(folder: Path) -> None:
    file = folder / "bristles.yaml"
    rubs = "friction: {law: dahl, mu: 0.2, presliding: 1 um}"
    file.write_text(HEAD + DISC.replace("friction: {law: coulomb, mu: 0.2, v0: 1e-3 m/s}", rubs), encoding="utf-8")
    with pytest.raises(BadValueError, match=r"bristles.yaml:14:21: .*newton_restitution and friction by dahl"):
        gudgeon.load(file, "hard")

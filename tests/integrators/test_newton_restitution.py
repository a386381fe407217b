"""Newton's restitution in joints with play: closed forms, an event-driven oracle, energy, two contacts at once."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import AssemblyError, BadValueError
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from tests.oracles.hung_bar import HungBar
from tests.programs import needs_compiler
from tests.slow import slow_rows_but

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
parameters: {tilt: 0.7 rad}
bodies: {bar: {mass: 0.4 kg, inertia: 3e-3 kg*m^2, points: {pin: [0, 0.12 m]}}}
ground: {hole: [0, 0]}
freedoms: 1
joints: {A: {revolute: [ground.hole, bar.pin]}}
start: {set: {bar.theta: tilt}, rates: {bar.omega: 0}}
bearings: {hole: {radius: 15 mm, clearance: 5 mm, length: 10 mm, bearing_material: steel, journal_material: steel}}
contacts:
  hard: {normal: {law: newton_restitution, restitution: 0.6, threshold: 1e-3 m/s}}
  spring: {normal: {law: hertz, stiffness: 1e9, dissipation: exact, restitution: 0.6}}
scenes:
  hard: {play: {A: {bearing: hole, contact: hard}}, simulate: {t_end: 1 s, step: 1e-4 s}}
  spring: {extends: hard, play: {A: {bearing: hole, contact: spring}}}
"""
TWO = """\
bodies: {bar: {mass: 0.4 kg, inertia: 3e-3 kg*m^2, points: {left: [-0.1 m, 0], right: [0.1 m, 0]}}}
ground: {west: [-0.1 m, 0], east: [0.1 m, 0]}
freedoms: 0
joints: {A: {revolute: [ground.west, bar.left]}, B: {revolute: [ground.east, bar.right]}}
start: {play: {A: {}, B: {}}}
bearings: {hole: {radius: 15 mm, clearance: 5 mm, length: 10 mm, bearing_material: steel, journal_material: steel}}
contacts:
  hard: {normal: {law: newton_restitution, restitution: 0.6}}
  soft: {normal: {law: newton_restitution, restitution: 0.3}}
scenes:
  hard:
    play: {A: {bearing: hole, contact: hard}, B: {bearing: hole, contact: soft}}
    simulate: {t_end: 1 s, step: 1e-4 s}
"""
CRANK = """\
bodies:
  crank: {length: 50 mm, mass: 0.1 kg, inertia: 4e-5 kg*m^2}
  rod: {length: 120 mm, mass: 0.2 kg, inertia: 3e-4 kg*m^2}
  block: {mass: 0.3 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0]}
freedoms: 0
joints:
  O: {revolute: [ground.O, crank.tail]}
  P: {revolute: [crank.head, rod.tail]}
  Q: {revolute: [rod.head, block.origin]}
  guide: {translational: [ground.O, block.origin], axis: [1, 0]}
drives: {motor: {angle: crank, value: 10 rad/s * abs(t - 10 ms)}}
forces: {rub: {dry_friction: [ground.O, block.origin], direction: [1, 0], static: 300 N, kinetic: 250 N}}
start: {guess: {crank.theta: 6 deg, rod.theta: -3 deg}}
bearings: {pin: {radius: 8 mm, clearance: 0.2 mm, length: 10 mm, bearing_material: steel, journal_material: steel}}
contacts: {hard: {normal: {law: newton_restitution, restitution: 0.5}}}
scenes:
  hard:
    play: {P: {bearing: pin, contact: hard}, Q: {bearing: pin, contact: hard}}
    simulate: {t_end: 30 ms, step: 1e-5 s}
"""
OBLIQUE = {"start.play.A.e.x": 0.4, "start.play.A.e.y": 0.3, "start.play.A.rate.x": 2.0}


@cache
def made(folder: Path, text: str, formulation: str = "reduced", scene: str = "hard") -> Simulation:
    file = folder / f"rigid_{abs(hash((text, formulation)))}.yaml"
    file.write_text(HEAD + text, encoding="utf-8")
    return gudgeon.load(file, scene, formulation=formulation)


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
    assert rest["t_on"] == pytest.approx(math.sqrt(2 / 9.81) * 1.8 / 0.2, abs=2e-4)  # Zeno's point
    assert math.isnan(rest["t_off"]) and rest["F_peak"] == pytest.approx(0.092 * 9.81, rel=1e-12)
    assert run["A.Fn"][-1] == pytest.approx(0.092 * 9.81, rel=1e-12) and run["A.state"][-1] == 2
    assert run["A.delta"].max() <= 2e-15 and run["ball.y"][-1] == pytest.approx(-1.0, abs=1e-15)
    assert run.diagnostics.energy_residual < 1e-9 * run.diagnostics.energy_turned_over


@pytest.mark.parametrize("e", [0.0, 0.35, 1.0])
def test_energy_is_lost_by_the_law_and_by_nothing_else(folder: Path, e: float) -> None:
    """In a hole blows are oblique; ½ m (1 − e²) u² goes with each, nothing with e = 1, and none is ever gained."""
    simulation = made(folder, BALL)
    run = simulation.simulate(3.0, parameters=OBLIQUE | {"contacts.hard.normal.restitution": e}, stop=False, rtol=1e-11)
    blows = run.impacts[run.impacts["t_off"] == run.impacts["t_on"]]
    energy = run["energy.kinetic"] + run["energy.potential"]
    expected = 0.5 * 0.092 * (1.0 - e * e) * (blows["deltadot"] ** 2).sum()
    assert len(blows) >= 1
    assert energy[0] - energy[-1] == pytest.approx(expected, abs=1e-8 * abs(energy).max())
    assert np.diff(energy).max() < 1e-9 * abs(energy).max()
    if e == 1.0:
        assert len(blows) > 5
        np.testing.assert_allclose(energy, energy[0], atol=1e-10 * abs(energy).max())


def released(tilt: float = 0.7, end: float = 0.6) -> tuple[HungBar, Any, Any]:
    bar = HungBar(0.4, 3e-3, 0.12, 5e-3, 0.6, 1e-3)
    t = np.linspace(0.0, end, 301)
    y = np.array([0.12 * math.sin(tilt), -0.12 * math.cos(tilt), tilt, 0.0, 0.0, 0.0])
    return bar, t, bar.run(y, end, t)


WAYS = [("dop853", "reduced"), ("dop853", "full"), ("rk4", "reduced")]


@pytest.mark.parametrize(("method", "formulation"), slow_rows_but(WAYS[:1], WAYS))
def test_a_bar_in_a_hole_against_an_oracle(folder: Path, method: str, formulation: str) -> None:
    """It falls, bounces ever faster, stays on the wall and swings there as a double pendulum does."""
    bar, t, expected = released()
    settings: dict[str, Any] = {"step": 2e-5} if method == "rk4" else {"rtol": 1e-11}
    run = made(folder, BAR, formulation).simulate(output=t, method=method, **settings)
    blows = run.impacts[run.impacts["t_off"] == run.impacts["t_on"]]
    assert len(blows) == len(bar.blows) > 5 and len(bar.contacts) > 0
    message = np.array([list(blow) for blow in blows[["t_on", "deltadot", "F_peak"]]])
    np.testing.assert_allclose(message, bar.blows, atol=1e-7)
    for name, column in (("bar.x", 0), ("bar.y", 1), ("bar.theta", 2), ("bar.omega", 5)):
        np.testing.assert_allclose(run[name], expected[:, column], atol=1e-6)
    closed = run["A.state"] > 0
    np.testing.assert_allclose(run["A.Fn"][closed], [bar.force(y) for y in expected[closed]], atol=1e-5)


def test_ever_stiffer_springs_come_to_the_same(folder: Path) -> None:
    """Hertz's contact of the same restitution: behind two blows it is off by its time of contact, K^(−2/5)."""
    t = np.linspace(0.0, 0.06, 61)
    rigid = made(folder, BAR).simulate(output=t, rtol=1e-11)
    off = []
    for stiffness in (1e9, 3.2e11, 1.024e14):  # times 320: contacts are 10 times shorter
        given = {"contacts.spring.normal.stiffness": stiffness}
        run = made(folder, BAR, scene="spring").simulate(output=t, rtol=1e-10, parameters=given)
        assert len(run.impacts) == 2 == (rigid.impacts["t_on"] < 0.06).sum()
        off.append(abs(run["bar.theta"] - rigid["bar.theta"]).max())
    assert off[0] < 1e-3 and off[1] < 0.13 * off[0] and off[2] < 0.13 * off[1]


def test_a_ball_runs_up_the_wall_and_leaves_it_where_nothing_presses(folder: Path) -> None:
    """A start on the wall; it leaves at cos θ = (2 − v²/(g R))/3 from below, and falls on a parabola."""
    v, g = 6.0, 9.81
    start = {"start.play.A.e.y": -1.0, "start.play.A.rate.x": v, "contacts.hard.normal.restitution": 0.0}
    run = made(folder, BALL).simulate(1.2, parameters=start, output=1200, rtol=1e-11, stop=False)
    first = run.impacts[0]
    assert first["t_on"] == 0.0 and first["deltadot"] == 0.0
    cosine = (2.0 - v * v / g) / 3.0
    flight = np.flatnonzero(run["A.state"] == 0)
    assert len(flight) > 20 and run.t[flight[0] - 1] <= first["t_off"] <= run.t[flight[0]]
    closed = slice(0, flight[0])
    theta = np.arctan2(run["ball.x"], -run["ball.y"])[closed]
    assert math.cos(theta[-1]) > cosine - 1e-12 and math.cos(theta[-1] + 7e-3) < cosine
    force = 0.092 * (v * v - 2.0 * g * (1.0 - np.cos(theta)) + g * np.cos(theta))
    np.testing.assert_allclose(run["A.Fn"][closed], force, rtol=1e-8, atol=1e-9)
    np.testing.assert_allclose(np.hypot(run["ball.x"], run["ball.y"])[closed], 1.0, atol=4e-16)


def test_a_ball_swings_in_the_hole_as_a_pendulum_of_its_clearance(folder: Path) -> None:
    from scipy.special import ellipk

    amplitude = 0.9
    start = {"start.play.A.e.x": math.sin(amplitude), "start.play.A.e.y": -math.cos(amplitude)}
    run = made(folder, BALL).simulate(5.0, parameters=start, rtol=1e-11, stop=False)
    period = 4.0 * math.sqrt(1.0 / 9.81) * float(ellipk(math.sin(amplitude / 2.0) ** 2))
    tops = run.events_of("down")  # at each end of a swing
    np.testing.assert_allclose(np.diff(tops), period / 2.0, rtol=1e-9)
    assert len(tops) == 4 and (run["A.state"] == 2).all()


@pytest.mark.parametrize("method", ["dop853", "rk4"])
def test_two_contacts_at_once(folder: Path, method: str) -> None:
    """Both ends of a bar fall on their walls together: each returns by its own law, by the impulses that does it."""
    simulation = made(folder, TWO)
    run = simulation.simulate(0.04, method=method, output=400)
    u, m, J, half = math.sqrt(2.0 * 9.81 * 5e-3), 0.4, 3e-3, 0.1
    first = run.impacts[:2]
    np.testing.assert_allclose(first["t_on"], u / 9.81, rtol=1e-9)
    np.testing.assert_allclose(first["deltadot"], u, rtol=1e-9)
    assert sorted(first["joint"]) == [0, 1] and first["t_on"][0] == first["t_on"][1]
    same, cross = 1 / m + half**2 / J, 1 / m - half**2 / J
    D = np.array([[same, cross], [cross, same]])
    impulse = np.linalg.solve(D, [1.6 * u, 1.3 * u])
    np.testing.assert_allclose(first["F_peak"][np.argsort(first["joint"])], impulse, rtol=1e-8)
    k = int(np.searchsorted(run.t, u / 9.81)) + 1
    speed, turn = (0.6 + 0.3) / 2.0 * u, (0.3 - 0.6) * u / (2.0 * half)
    assert run["bar.vy"][k] == pytest.approx(speed - 9.81 * (run.t[k] - u / 9.81), rel=1e-8)
    assert run["bar.omega"][k] == pytest.approx(turn, rel=1e-8)
    both = {f"contacts.{name}.normal.restitution": 1.0 for name in ("hard", "soft")}
    kept = simulation.simulate(0.5, parameters=both, method=method, output=500)
    energy = kept["energy.kinetic"] + kept["energy.potential"]
    late = len(kept.impacts) * 1e-12 * u  # m: each blow is located to 1e-12 s
    np.testing.assert_allclose(energy, 0.0, atol=late * m * 9.81)
    np.testing.assert_allclose(kept["bar.theta"], 0.0, atol=1e-9)
    assert len(kept.impacts) >= 12


@pytest.mark.parametrize(("inertia", "held"), [(3e-3, True), (5e-3, False)])
def test_a_contact_that_rests_takes_part_in_another_ones_blow(folder: Path, inertia: float, held: bool) -> None:
    """One end rests on its wall when the other strikes: it is held down where 1/m − l²/J < 0, else it is thrown up."""
    m, half, c, tilt = 0.4, 0.1, 5e-3, 5e-3
    start = {"start.play.A.e.y": -c, "start.play.B.e.y": -c + 2 * half * math.sin(tilt), "bodies.bar.inertia": inertia}
    start |= {"start.play.B.e.x": 2 * half * (math.cos(tilt) - 1.0)}
    start |= {f"contacts.{name}.normal.restitution": 0.0 for name in ("hard", "soft")}
    run = made(folder, TWO).simulate(0.05, parameters=start, rtol=1e-11)
    own = run.impacts[run.impacts["joint"] == 0]
    blow = run.impacts[(run.impacts["joint"] == 1)][0]
    gone = own[(own["t_off"] == blow["t_on"]) & (own["t_on"] < blow["t_on"])]
    pressed = own[(own["t_off"] == blow["t_on"]) & (own["t_on"] == blow["t_on"])]
    same, cross = 1 / m + half**2 / inertia, 1 / m - half**2 / inertia
    assert (cross < 0.0) == held
    assert len(pressed) == held and len(gone) == (not held)
    if held:
        D = np.array([[same, cross], [cross, same]])
        impulse = np.linalg.solve(D, [0.0, blow["deltadot"]])
        np.testing.assert_allclose([pressed["F_peak"][0], blow["F_peak"]], impulse, rtol=1e-3)  # round walls
        assert run["A.state"][-1] == run["B.state"][-1] == 2 and run["A.Fn"][-1] == pytest.approx(0.2 * 9.81, rel=1e-2)


@pytest.mark.parametrize("gap", [0.0, 1e-9])
@pytest.mark.parametrize("inertia", [3e-3, 5e-3])
def test_what_rests_at_the_start_takes_part_in_the_first_blow(folder: Path, inertia: float, gap: float) -> None:
    """0 ≤ Λ ⊥ D Λ − (u + e u) ≥ 0 of both, whether the other strikes at once or a moment later."""
    m, half, u = 0.4, 0.1, 0.2
    start = {"start.play.A.e.y": -5e-3, "start.play.B.e.y": -5e-3 + gap, "start.play.B.rate.y": -u}
    run = made(folder, TWO).simulate(1e-7, parameters=start | {"bodies.bar.inertia": inertia}, output=2)
    same, cross = 1 / m + half**2 / inertia, 1 / m - half**2 / inertia
    impulse = max(0.0, -1.3 * u * cross / (same**2 - cross**2))  # where A is held
    struck = (1.3 * u - cross * impulse) / same
    down = -u / 2.0 + (impulse + struck) / m, -u / (2.0 * half) + (struck - impulse) * half / inertia
    assert (run["bar.vy"][-1], run["bar.omega"][-1]) == pytest.approx(down, abs=1e-5)
    assert run.diagnostics.energy_residual < 1e-12  # the first sample is behind the blow, and so is its work


def test_batches_files_and_going_on_have_the_same_run(folder: Path, tmp_path: Path) -> None:
    simulation, address = made(folder, BALL), "contacts.hard.normal.restitution"
    given = np.array([0.3, 0.8, 1.0])
    settings: dict[str, Any] = {"output": 300, "stop": False, "peaks": ["A.Fn"]}
    batch = simulation.simulate_many({address: given, **OBLIQUE}, t_end=1.5, **settings)
    singles = [simulation.simulate(1.5, parameters=OBLIQUE | {address: e}, **settings) for e in given]
    for i, run in enumerate(singles):
        np.testing.assert_array_equal(batch[i].q, run.q)
        assert batch[i].impacts.tobytes() == run.impacts.tobytes()
        assert np.isnan(batch.peaks["first_peak"][i, 0]) and math.isnan(run.diagnostics.peaks[0].first_peak)
    run = singles[0]
    run.save(tmp_path / "run.nc")
    again = Result.load(tmp_path / "run.nc")
    assert again.impacts.tobytes() == run.impacts.tobytes() and str(again.report()) == str(run.report())
    np.testing.assert_array_equal(again["A.Fn"], run["A.Fn"])
    assert (run["A.state"] == 2).any() and run.peak("A.Fn").max >= run["A.Fn"].max()
    half = simulation.simulate(run.t[200], parameters=OBLIQUE | {address: 0.3}, output=run.t[:201], stop=False)
    rest = simulation.simulate(output=run.t[200:], start=half.final, stop=False)
    np.testing.assert_allclose(rest.q[-1], run.q[-1], atol=1e-7)
    np.testing.assert_allclose(rest["A.Fn"][0], run["A.Fn"][200], rtol=1e-6)
    at = run.at_events("down")
    assert len(at["A.Fn"]) == len(run.events_of("down"))


def test_bounces_that_pile_up_are_told(folder: Path) -> None:
    run = made(folder, BALL).simulate(4.2, stop=False)
    times, _ = bounces(0.8, 1e-4)
    (note,) = [note for note in run.diagnostics.notes if "bounces accumulated" in note]
    assert f"A: {len(times)} bounces accumulated until t = {times[-1]:.6f}"[:50] in note
    assert note in str(run.report())


def test_what_cannot_be_had_is_refused(folder: Path, tmp_path: Path) -> None:
    for method in ("rodas5p", "radau5", "radau9"):
        with pytest.raises(BadValueError, match=rf"method '{method}' does not fit: the contact in A .*newton_rest"):
            made(folder, BALL).simulate(0.1, method=method)
    law = "{normal: {law: newton_restitution, restitution: 0.8}"
    for part in ("film: {law: ocvirk, viscosity: 0.1 Pa*s}", "velocity_floor: 1e-5 m/s"):
        file = tmp_path / "refused.yaml"
        file.write_text(HEAD + BALL.replace(law, f"{law}, {part}"), encoding="utf-8")
        message = f":11:.*contact hard has newton_restitution and {part.partition(':')[0]}"
        with pytest.raises(BadValueError, match=message):
            gudgeon.load(file, "hard")
    with pytest.raises(
        AssemblyError, match=r"start\.play\.A\.e has a length of 1001 mm: expected 1000 mm at most, the clearance"
    ):
        made(folder, BALL).simulate(0.1, parameters={"start.play.A.e.x": 1.001})


@pytest.mark.slow
def test_with_friction_that_sticks_and_a_drive_that_turns_round(folder: Path) -> None:
    """Contacts, sticks and the impulse of a drive at once: formulations and methods agree, works balance."""
    reference = made(folder, CRANK).simulate(rtol=1e-11, output=300)
    blows = reference.impacts[reference.impacts["t_off"] == reference.impacts["t_on"]]
    assert {*reference.impacts["joint"]} == {0, 1} and len(blows) > 20 and (blows["t_on"] > 0.01).any()
    others = [
        made(folder, CRANK, "full").simulate(rtol=1e-11, output=300),
        made(folder, CRANK).simulate(method="rk4", step=1e-6, output=300),
    ]
    for run in (reference, *others):
        d = run.diagnostics
        assert d.energy_residual < 1e-6 * d.energy_turned_over
        assert max(run[f"{joint}.delta"].max() for joint in "PQ") < 1e-12
        assert min(run[f"{joint}.Fn"].min() for joint in "PQ") >= 0.0
        np.testing.assert_allclose(run["block.x"], reference["block.x"], atol=1e-6)
        np.testing.assert_allclose(run["rod.omega"][:100], reference["rod.omega"][:100], atol=1e-4)
    assert {*reference["rub.mode"]} == {-1.0, 0.0, 1.0}

"""Methods that choose their step: observed order, constraints, events, and answers known to many digits."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.special import ellipj, ellipk

import gudgeon
import tests.benches  # noqa: F401
from benchmarks.methods import write_journals
from gudgeon.errors import SolverError
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from tests.oracles import golden
from tests.programs import needs_compiler
from tests.slow import slow_rows_but

pytestmark = needs_compiler
HERE = Path(__file__).parent.parent
GOLDEN = golden.load()
KNOWN = json.loads((HERE / "data/reference_problems.json").read_text(encoding="utf-8"))
ADAPTIVE = ("dop853", "rodas5p", "auto")
FREE = {"baumgarte.alpha": 0.0, "baumgarte.beta": 0.0}
LUBRICATED = {"c": 0.6e-3, "omega": 5 * math.pi}


@cache
def scene_of(name: str, scene: str | None = None) -> Simulation:
    file = HERE / f"mechanisms/methods/{name}.yaml"
    return gudgeon.load(file if file.exists() else name, scene=scene)


def observed_order(name: str, method: str, t_end: float, steps: tuple[int, int, int], inside: bool) -> float:
    """Slope of the error over fixed steps, at the end or at 200 times between, over errors 1e-3 … 1e-12."""
    simulation = scene_of(name)
    between = np.sort(np.random.default_rng(1).uniform(0.0, t_end, 200 * inside))
    times = np.concatenate([[0.0], between, [t_end]])
    numbers = FREE if method == "rk4" else {}
    exact = simulation.simulate(output=times, method="dop853", rtol=1e-14)
    h, errors = [], []
    for count in np.unique(np.round(np.geomspace(*steps)).astype(int)):
        run = simulation.simulate(output=times, method=method, step=t_end / count, parameters=numbers)
        h.append(t_end / count)
        errors.append(max(abs(run.q - exact.q).max(), abs(run.v - exact.v).max()))
    kept = (np.array(errors) < 1e-3) & (np.array(errors) > 1e-12)
    assert kept.sum() >= 8
    return float(np.polyfit(np.log(np.array(h)[kept]), np.log(np.array(errors)[kept]), 1)[0])


@pytest.mark.parametrize("inside", [False, True])
def test_rodas5p_has_order_5_and_its_interpolant_4(inside: bool) -> None:
    """An interpolant of order 4 errs by O(h⁵) on the way, which is as good as the ends of the steps."""
    assert observed_order("swing", "rodas5p", 1.0, (12, 1600, 14), inside) == pytest.approx(5.0, abs=0.15)


@pytest.mark.parametrize("inside", [False, True])
def test_dop853_has_order_8_and_its_interpolant_7(inside: bool) -> None:
    found = observed_order("car_axis", "dop853", 1.0, (40, 400, 14), inside)
    assert found == pytest.approx(8.0, abs=0.4)


@pytest.mark.parametrize("inside", [False, True])
def test_dopri5_has_order_5_and_its_interpolant_4(inside: bool) -> None:
    """As of rodas5p: on the way it errs by O(h⁵)."""
    assert observed_order("swing", "dopri5", 1.0, (40, 2000, 12), inside) == pytest.approx(5.0, abs=0.15)


@pytest.mark.parametrize("inside", [False, True])
def test_rk4_has_order_4(inside: bool) -> None:
    """The cubic errs by O(h⁴) on the way, which is as good as the ends of the steps."""
    assert observed_order("swing", "rk4", 1.0, (60, 4000, 12), inside) == pytest.approx(4.0, abs=0.15)


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
def test_outputs_leave_the_steps_of_rk4_alone(formulation: str) -> None:
    """Steps as long as was asked for: the same bits, contacts and costs whatever is looked at in between."""
    press = gudgeon.load("nine_bar_press", "dry", formulation=formulation)
    step, t_end = 2e-5, 0.03
    alone = press.simulate(t_end, output=1, method="rk4", step=step)
    times = np.sort(np.random.default_rng(1).uniform(0.0, t_end, 4000))
    run = press.simulate(output=[*times, t_end], method="rk4", step=step)
    assert len(alone.impacts) > 0
    assert run.diagnostics.steps == alone.diagnostics.steps >= 1500 + 2 * len(alone.impacts)  # an event ends one, too
    assert run.diagnostics.right_hand_sides == alone.diagnostics.right_hand_sides
    assert run.diagnostics.step == step and math.isnan(run.diagnostics.last_step)
    assert run.impacts.tobytes() == alone.impacts.tobytes()
    assert run.diagnostics.peaks == alone.diagnostics.peaks
    for name in ("q", "v", "work", "state"):
        assert (getattr(run, name)[-1] == getattr(alone, name)[-1]).all()
    ends = press.simulate(t_end, output=1500, method="rk4", step=step)
    some = press.simulate(output=np.sort([*times[::50], *ends.t[::7], t_end]), method="rk4", step=step)
    assert (some.q[np.isin(some.t, ends.t[::7])] == ends.q[::7]).all()  # at the end of a step the step's own


def test_samples_of_rk4_know_their_contacts() -> None:
    """Between two steps too: closed from onset to separation, and not outside."""
    run = scene_of("nine_bar_press", "dry").simulate(0.03, output=7919, method="rk4", step=2e-5)
    for k, joint in enumerate(run.source.clearances):
        touching = np.zeros(len(run.t), dtype=bool)
        for impact in run.impacts[run.impacts["joint"] == k]:
            touching |= (run.t >= impact["t_on"]) & ~(run.t >= impact["t_off"])
        assert touching.any() and not touching.all()
        assert ((run.state[:, k] > 0) == touching).all()
        assert (np.isfinite(run[f"{joint.name}.deltadot_minus"]) == touching).all()


def test_a_step_that_does_not_fill_the_run_is_told() -> None:
    run = scene_of("swing").simulate(1.0, output=10, method="rk4", step=0.03)
    assert run.diagnostics.steps == 34
    assert run.diagnostics.step == 0.03
    assert run.diagnostics.last_step == pytest.approx(0.01, rel=1e-9)
    longer = scene_of("swing").simulate(0.02, output=10, method="rk4", step=0.03)
    assert (longer.diagnostics.steps, longer.diagnostics.step) == (1, 0.02)


def digits(run: Result) -> float:
    """Of Andrews' seven angles, absolute below one radian and relative above."""
    names = ("beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon")
    exact = np.array(KNOWN["andrews_squeezer"]["angles"])
    errors = np.array([run[name][-1] for name in names]) - exact
    return float(-np.log10((abs(errors) / (1 + abs(exact))).max()))


def test_andrews_in_ten_digits_with_few_right_hand_sides() -> None:
    run = scene_of("andrews_squeezer").simulate(0.03, output=1, method="dop853", rtol=1e-10)
    assert digits(run) > 10.0
    assert run.diagnostics.right_hand_sides <= 1600


@pytest.mark.parametrize(("method", "rtol"), [("dop853", 1e-14), ("auto", 1e-14), ("rodas5p", 1e-13)])
def test_andrews_in_twelve_digits(method: str, rtol: float) -> None:
    assert digits(scene_of("andrews_squeezer").simulate(0.03, output=1, method=method, rtol=rtol)) > 12.0


def test_pendulum_keeps_its_phase_for_two_thousand_seconds() -> None:
    """From the horizontal: sin(θ/2) = k sn(K − ω t), k = sin 45°, θ from the vertical."""
    run = scene_of("pendulum").simulate(2000.0, output=[0.0, 1999.5, 2000.0], method="dop853", rtol=1e-14)
    k2 = 0.5
    omega = 4.0 * ellipk(k2) / KNOWN["pendulum"]["period"]
    phase = ellipk(k2) - omega * np.fmod(run.t[1:], KNOWN["pendulum"]["period"])
    theta = 2.0 * np.arcsin(math.sqrt(k2) * ellipj(phase, k2)[0])
    assert run["bob.x"][1:] == pytest.approx(np.sin(theta), abs=1e-6)
    assert run["bob.y"][1:] == pytest.approx(-np.cos(theta), abs=1e-6)


@pytest.mark.parametrize("method", ADAPTIVE)
def test_lubricated_press_reaches_the_golden_figures(method: str) -> None:
    want = GOLDEN["lubricated"]
    numbers = {"omega": want["omega"], "c": want["c"], "contacts.oil.transition": want["transition"]}
    press = scene_of("nine_bar_press", "lubricated")
    run = press.simulate(output=[0.0, *want["t"]], method=method, rtol=1e-10, parameters=numbers)
    assert run["S9.y"][1:] == pytest.approx(want["y9"], rel=5e-10)
    assert run["S9.vy"][1:] == pytest.approx(want["v9"], rel=1e-7)
    assert run["S9.ay"][1:] == pytest.approx(want["a9"], rel=1e-6)
    assert run["A.F"][1:] == pytest.approx(want["F_A"], rel=1e-6)
    assert run["B.F"][1:] == pytest.approx(want["F_B"], rel=1e-6)


@pytest.mark.parametrize("method", ADAPTIVE)
def test_dry_press_reaches_the_golden_first_contacts(method: str) -> None:
    want = GOLDEN["dry"]
    numbers = {"omega": want["omega"], "c": want["c"]}
    press = scene_of("nine_bar_press", "dry")
    run = press.simulate(want["t_end"], output=9, method=method, rtol=1e-12, parameters=numbers)
    for joint in ("A", "B"):
        peak = run.diagnostics.peak(joint)
        assert peak.first_contact == pytest.approx(want["first_contact"][joint], abs=1e-9)
        assert peak.first_peak == pytest.approx(want["first_peak"][joint], rel=5e-6)  # that RK4 sees ends of steps


ONSETS = json.loads((HERE / "data/press_dry_onsets.json").read_text(encoding="utf-8"))


@cache
def race(method: str, rtol: float) -> Result:
    numbers: dict[str, Any] = {"l5": 0.25, "gravity.y": 0.0}
    return scene_of("nine_bar_press", "dry").simulate(0.05, output=1, method=method, rtol=rtol, parameters=numbers)


@pytest.mark.parametrize(("method", "rtol"), [("dop853", 1e-13), ("auto", 1e-13), ("rodas5p", 1e-14)])
def test_every_onset_of_the_dry_press(method: str, rtol: float) -> None:
    """Against hand-written equations in long double by extrapolation of order 12 (benchmarks/peers)."""
    run = race(method, rtol)
    assert ["AB"[j] for j in run.impacts["joint"]] == [joint for joint, _, _ in ONSETS["onsets"]]
    assert run.impacts["t_on"] == pytest.approx([t for _, t, _ in ONSETS["onsets"]], abs=1e-10)
    assert run.impacts["deltadot"] == pytest.approx([v for _, _, v in ONSETS["onsets"]], rel=1e-7)
    assert run["S9.y"][-1] == pytest.approx(ONSETS["S9.y"], abs=1e-11)


def test_onsets_converge_with_the_tolerance() -> None:
    exact = np.array([t for _, t, _ in ONSETS["onsets"]])
    errors = [abs(race("dop853", rtol).impacts["t_on"] - exact).max() for rtol in (1e-8, 1e-10, 1e-12)]
    assert errors[1] < 0.1 * errors[0] and errors[2] < 0.1 * errors[1]


@pytest.mark.parametrize("method", ADAPTIVE)
def test_energy_of_the_dry_press(method: str) -> None:
    """At 1e-8 the balance closes to 1e-5 of what friction and the contacts' hysteresis took."""
    run = race(method, 1e-8)
    dissipated = -run.work[-1, 2]
    assert dissipated > 1e-3
    assert run.diagnostics.energy_residual < 1e-5 * dissipated


def test_constraints_hold_to_rounding() -> None:
    """100 s of the lubricated press, at every step and at samples between; the longest body has .35 m."""
    press = scene_of("nine_bar_press", "lubricated")
    run = press.simulate(100.0, output=1001, rtol=1e-5, parameters=LUBRICATED)
    assert run.diagnostics.steps > 10_000
    assert run.diagnostics.phi_max < 1e-15
    assert run.diagnostics.phi_dot_max < 1e-13
    for t, q, v in zip(run.t, run.q, run.v, strict=True):
        assert abs(press.compiled.phi(t, q, run.p)).max() < 1e-15
        assert abs(press.compiled.phi_q(t, q, run.p) @ v - press.compiled.nu(t, q, run.p)).max() < 1e-13


@pytest.mark.parametrize(
    ("beyond", "rtol", "off"),
    slow_rows_but(
        [(1e-5, 1e-9, 1e-4)],
        [
            (1e-8, 1e-9, 1e-3),
            (1e-7, 1e-8, 1e-3),
            (1e-6, 1e-6, 3e-2),
            (1e-5, 1e-5, 0.2),
            (1e-5, 1e-9, 1e-4),
        ],
    ),
)
def test_grazing_contacts_are_not_lost(beyond: float, rtol: float, off: float) -> None:
    """A puck on a spring turns round just beyond its bearing's clearance, 64 times in 2 s.

    A free flight is one or two steps, so every contact lies within a step. RK4 at 2e-6 s sees them all.
    """
    simulation = scene_of("graze", "loose")
    c, omega = 1e-3, 100.0
    still = simulation.simulate(1e-6, output=1, method="rk4", step=1e-6).final
    v = np.array([(c + beyond) * omega, 0.0, 0.0])
    start = replace(still, t=0.0, q=np.zeros(3), v=v, memory=np.array([np.nan]), state=np.zeros(1, dtype=np.int8))
    exact = simulation.simulate(2.0, output=100, step=2e-6, start=start)
    run = simulation.simulate(2.0, output=100, method="dop853", rtol=rtol, start=start)
    assert run.diagnostics.onsets == exact.diagnostics.onsets >= 64
    assert run.diagnostics.peaks[0].e_max < c + 1.1 * beyond
    assert abs(run["puck.x"] - exact["puck.x"]).max() < off * c


@pytest.mark.parametrize("method", [*ADAPTIVE, "rk4"])
def test_a_journal_deep_in_its_bearing_ends_the_run(method: str) -> None:
    """Metal as soft as jelly: beyond a tenth of the bearing's radius (15 mm) no law of contact means anything."""
    soft = {"materials.aluminium.E": 1e3}
    with pytest.raises(SolverError, match=r"of A lies \d\.\d+ mm deep.* a tenth of its radius") as caught:
        scene_of("nine_bar_press", "dry").simulate(0.3, output=300, method=method, parameters=soft)
    run = caught.value.partial
    assert run is not None
    assert 1.5e-3 < max(peak.e_max for peak in run.diagnostics.peaks) - 0.3e-3 < 3e-3  # a step may go further


@pytest.mark.parametrize(
    ("method", "rtol", "off"), [("dop853", 1e-6, 1e-6), ("rodas5p", 1e-6, 1e-6), ("rk4", None, 1e-7)]
)
def test_the_largest_eccentricity_lies_between_steps(method: str, rtol: float | None, off: float) -> None:
    """A puck on a spring swings freely inside its clearance: e = A |sin 100 t|, some steps a swing."""
    simulation, A, omega = scene_of("graze", "loose"), 0.8e-3, 100.0
    still = simulation.simulate(1e-6, output=1, method="rk4", step=1e-6).final
    v = np.array([A * omega, 0.0, 0.0])
    start = replace(still, t=0.0, q=np.zeros(3), v=v, memory=np.array([np.nan]), state=np.zeros(1, dtype=np.int8))
    step = None if rtol else 3e-4
    run = simulation.simulate(0.1, output=1, method=method, rtol=rtol, step=step, start=start)
    assert run.diagnostics.peaks[0].e_max == pytest.approx(A, rel=off)


def test_a_drive_that_jumps_gives_an_impulse() -> None:
    """A crank starts at full speed: the rod on its tip keeps its angular momentum about the tip."""
    run = scene_of("jump").simulate(output=[0.0, 0.0999999999, 0.1000000001, 0.11], method="dop853", rtol=1e-12)
    m, J, half, crank, rate = 0.3, 2e-3, 0.1, 0.1, math.radians(90.0) / 0.3
    theta = run["L2.theta"][1]
    jump = run["L2.omega"][2] - run["L2.omega"][1]
    arm = half * np.array([math.cos(theta), math.sin(theta)])
    tip = np.array([0.0, crank * rate])  # the crank lies along x
    com = tip + jump * np.array([-arm[1], arm[0]])
    assert J * jump + m * (arm[0] * com[1] - arm[1] * com[0]) == pytest.approx(0.0, abs=1e-10)
    assert run.diagnostics.energy_residual < 1e-11


@pytest.mark.parametrize("method", ADAPTIVE)
@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_a_drive_into_a_dead_centre_ends_there(method: str, formulation: str) -> None:
    """The bar's speed grows as (0.2 s - t)^-1/2: no method may crawl on, or step over it."""
    simulation = gudgeon.load(HERE / "mechanisms/methods/dead_centre.yaml", formulation=formulation)
    with pytest.raises(SolverError, match=r"dead centre at t = 0\.2 s: .*constraint equations? .*push") as caught:
        simulation.simulate(0.5, output=50, method=method)
    run = caught.value.partial
    assert run is not None
    assert abs(run.t[-1] - 0.2) < 0.011
    assert abs(np.hypot(run["bar.x"], run["bar.y"]) - 0.5).max() < 1e-14


@pytest.mark.parametrize("method", ADAPTIVE)
@pytest.mark.parametrize("t_end", [0.1, 0.4, 3.0])
def test_a_pulse_between_two_stages_is_not_missed(method: str, t_end: float) -> None:
    """From rest the steps grow as they like; the impulse of a parabola is 4/3 of height × half width."""
    run = scene_of("pulse").simulate(t_end, output=1, method=method)
    speed = 4.0 / 3.0 * 30.0 * 0.5e-3 / 0.2
    assert run["puck.vx"][-1] == pytest.approx(speed, rel=1e-9)
    assert run["puck.x"][-1] == pytest.approx(speed * (t_end - 52.7e-3), rel=1e-9)
    np.testing.assert_allclose(run.events_of("window"), [0.070, 0.072], rtol=0, atol=2e-12)


def test_samples_at_an_event_hold_what_follows() -> None:
    run = scene_of("jump").simulate(output=[0.0, 0.1, 0.2], method="dop853")
    assert run["L1.omega"][1] == pytest.approx(math.radians(90.0) / 0.3, rel=1e-12)


def test_auto_is_explicit_or_stiff_as_the_scene_is() -> None:
    assert scene_of("andrews_squeezer").simulate(0.03, output=1).diagnostics.method == "dop853"
    film = scene_of("nine_bar_press", "lubricated").simulate(0.4, output=1, rtol=1e-6, parameters=LUBRICATED)
    assert film.diagnostics.stiff_steps > 0.9 * film.diagnostics.steps
    explicit = scene_of("nine_bar_press", "lubricated").simulate(
        0.4, output=1, rtol=1e-6, parameters=LUBRICATED, method="dop853"
    )
    assert explicit.diagnostics.right_hand_sides > 3 * film.diagnostics.right_hand_sides
    assert abs(explicit.q - film.q).max() < 1e-8


def test_tolerances_that_are_none() -> None:
    for rtol in (0.0, -1e-6, 2.0, math.nan):
        with pytest.raises(gudgeon.GudgeonError, match="rtol"):
            scene_of("pendulum").simulate(1.0, rtol=rtol)


def test_auto_leaves_stiff_steps_that_do_not_pay() -> None:
    """Contacts of the dry slider-crank are stiff for a few steps: auto takes about as many steps as dop853."""
    crank = scene_of("slider_crank", "dry")
    auto, explicit = (
        crank.simulate(0.1, output=1, method=method, rtol=1e-4).diagnostics for method in ("auto", "dop853")
    )
    assert auto.steps < 1.2 * explicit.steps
    assert 0 < auto.stiff_steps < 0.3 * auto.steps


def test_auto_stays_explicit_between_frequent_events(tmp_path: Path) -> None:
    """Four dry joints: contacts begin and end every few steps, between which stiff steps cannot become longer."""
    file = tmp_path / "joints.yaml"
    file.write_text(write_journals(4), encoding="utf-8")
    joints = gudgeon.load(file, "dry", quick=True)
    auto, explicit = (
        joints.simulate(0.1, output=1, method=method, rtol=1e-4).diagnostics for method in ("auto", "dop853")
    )
    assert auto.stiff_steps == 0 and auto.steps == explicit.steps


@needs_compiler
def test_a_film_keeps_the_stiff_method_while_its_steps_grow() -> None:
    """After the start, steps at 1e-12 are so short that stability would not limit dop853; later it needs 8,000."""
    run, exact = (
        scene_of("nine_bar_press", "lubricated").simulate(0.1, output=20, method=method, rtol=rtol)
        for method, rtol in (("auto", 1e-12), ("radau9", 1e-13))
    )
    assert run.diagnostics.method == "radau9" and run.diagnostics.steps < 200
    assert abs(run.q - exact.q).max() < 1e-12

"""The shipped press, from its YAML file to its motion, against the golden figures and its closed form."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import gudgeon
from gudgeon.results.results import Result
from tests.oracles import golden, ideal_press, press_dense
from tests.oracles.ideal_press import PressData
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = needs_compiler
PRESS = "nine_bar_press"
GOLDEN = golden.load()


@cache
def lubricated() -> Result:
    want = GOLDEN["lubricated"]
    numbers = {"omega": want["omega"], "c": want["c"], "contacts.oil.transition": want["transition"]}
    press = gudgeon.load(PRESS, scene="lubricated")
    return press.simulate(output=[0.0, *want["t"]], step=want["step"], parameters=numbers)


@pytest.mark.parametrize("omega", [2.0 * math.pi, 16.0 * math.pi, -3.0])
def test_ideal_press_is_its_closed_form(omega: float) -> None:
    """Positions to 1e-12 m and rad; velocities and accelerations as far as their size allows."""
    run = gudgeon.load(PRESS, scene="ideal").simulate(1.0, output=500, parameters={"omega": omega})
    want = ideal_press.motion(run.t, PressData(omega1=omega, omega4=-omega))
    assert run.diagnostics.method == "kinematic"
    assert abs(run.q - want.q).max() < 1e-12
    assert abs(run.v - want.v).max() < 1e-13 * abs(want.v).max() + 1e-13
    assert abs(run.a - want.a).max() < 1e-12 * abs(want.a).max() + 1e-12


def test_ideal_press_with_other_lengths() -> None:
    run = gudgeon.load(PRESS).simulate(0.5, output=50, parameters={"l5": "310 mm", "bodies.L7.length": 0.24})
    want = ideal_press.motion(run.t, PressData(l5=0.31, l7=0.24))
    assert abs(run.q - want.q).max() < 1e-12


def test_lubricated_press_reaches_the_golden_figures() -> None:
    run, want = lubricated(), GOLDEN["lubricated"]
    tolerance = want["tolerance"]
    assert run["S9.y"][1:] == pytest.approx(want["y9"], rel=tolerance["y9"])
    assert run["S9.vy"][1:] == pytest.approx(want["v9"], rel=tolerance["v9"])
    assert run["S9.ay"][1:] == pytest.approx(want["a9"], rel=tolerance["force"])
    assert run["A.F"][1:] == pytest.approx(want["F_A"], rel=tolerance["force"])
    assert run["B.F"][1:] == pytest.approx(want["F_B"], rel=tolerance["force"])
    # the two codes share no line and take the same steps: far more digits agree
    assert run["S9.y"][1:] == pytest.approx(want["y9"], rel=2e-10)
    assert run["A.F"][1:] == pytest.approx(want["F_A"], rel=1e-8)
    assert run.diagnostics.onsets == 0


CASES = {
    "dry": ({}, {}),
    "dry_steel": ({}, {"materials.aluminium.E": "206 GPa"}),
    "dry_conformal": ({"contacts.dry.normal.geometry": "internal"}, {}),
}


@pytest.mark.parametrize("case", slow_but(["dry", "dry_steel"], CASES))
def test_dry_press_reaches_the_golden_first_contacts(case: str) -> None:
    want, (overrides, numbers) = GOLDEN[case], CASES[case]
    press = gudgeon.load(PRESS, scene="dry", overrides=overrides)
    numbers = numbers | {"omega": want["omega"], "c": want["c"]}
    run = press.simulate(want["t_end"], output=9, step=want["step"], parameters=numbers)
    for joint in ("A", "B"):
        peak = run.diagnostics.peak(joint)
        time, force = want["first_contact"][joint], want["first_peak"][joint]
        assert peak.first_contact == pytest.approx(time, abs=want["tolerance"]["first_contact_s"])
        assert peak.first_peak == pytest.approx(force, rel=want["tolerance"]["first_peak"])
    assert run.diagnostics.onsets >= 2


def test_dry_press_follows_the_hand_written_one_before_chaos() -> None:
    """Up to and through the first impacts; the impact velocity is stored at the crossing here, after it there."""
    run = gudgeon.load(PRESS, scene="dry").simulate(7.7e-3, output=77, step=2e-7)
    peer = press_dense.rk4(replace(golden.DRY, common_point=True), 7.7e-3, 2e-7, every=500)
    assert run.t == pytest.approx(peer.t, abs=1e-15)
    assert abs(run.q - peer.q).max() < 1e-8
    assert abs(run["A.e"] - peer.e[:, 0]).max() < 1e-8
    before = run.t < 6.7e-3
    # 33 000 additions of the same small increment to θ4 = 3.48 rad, each rounded the same way
    assert abs(run.q - peer.q)[before].max() < 33_000 * 4.5e-16 * 2.0


@pytest.mark.parametrize("scene", ["dry", "lubricated"])
def test_energy_is_accounted_for(scene: str) -> None:
    """Kinetic + potential − work of drives and clearance forces, each integrated by its own way."""
    run = lubricated() if scene == "lubricated" else gudgeon.load(PRESS, scene=scene).simulate(0.03, step=1e-6)
    d = run.diagnostics
    assert d.energy_residual < 1e-8 * d.energy_turned_over
    kinetic = 0.5 * (run.v**2 * press_mass()).sum(axis=1)
    potential = 9.81 * (run.q[:, 1::3] * press_mass()[1::3]).sum(axis=1)
    balance = kinetic + potential - run.work.sum(axis=1)
    assert np.ptp(balance) < 1e-8 * d.energy_turned_over
    assert run.work[-1, 2] < 0.0  # the clearance joints only dissipate here
    assert d.phi_max < 1e-9 and d.phi_dot_max < 1e-8


def press_mass() -> np.ndarray:
    press = press_dense.Press()
    return np.array([x for m, j in zip(press.mass, press.inertia, strict=True) for x in (m, m, j)])


@pytest.mark.parametrize("scene", ["dry", "lubricated"])
def test_play_starts_concentric_with_ideal_velocities(scene: str) -> None:
    run = gudgeon.load(PRESS, scene=scene).simulate(1e-5, output=1, step=1e-6)
    want = ideal_press.motion(0.0)
    assert abs(run.q[0] - want.q[0]).max() < 1e-14
    assert abs(run.v[0] - want.v[0]).max() < 1e-13


def test_paper_step_is_too_long_for_the_film() -> None:
    """At 1e-4 s rk4 misses F_A at t = .2 s, 12.27 N, by a third and more."""
    want = GOLDEN["lubricated"]
    numbers = {"omega": want["omega"], "c": want["c"], "contacts.oil.transition": want["transition"]}
    run = gudgeon.load(PRESS, scene="lubricated").simulate(0.2, output=2, step=1e-4, parameters=numbers)
    assert abs(run["A.F"][-1] - 12.27) > 4.09

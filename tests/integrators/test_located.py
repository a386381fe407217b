"""How near their zeros events are located, and that none is passed on the way: as the tolerance asks."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon


@pytest.mark.parametrize("method", ["dop853", "rodas5p"])
@pytest.mark.parametrize("rtol", [1e-3, 1e-5, 1e-9])
def test_a_contact_begins_as_near_its_zero_as_the_tolerance_asks(method: str, rtol: float) -> None:
    """A fall is a parabola, which a step meets to rounding: what t_on is late by is its location alone."""
    fall = math.sqrt(2.0 / 9.81)
    run = gudgeon.load("bouncing_ball", "elastic").simulate(0.46, output=1, method=method, rtol=rtol)
    (onset,) = run.impacts["t_on"]
    assert -1e-14 < onset - fall < max(min(1e-9, rtol**2) * fall, 1e-12)


@pytest.mark.parametrize("rtol", [1e-3, 1e-4, 1e-6])
def test_a_force_that_begins_with_a_jump_is_missed_by_less_than_the_tolerance(rtol: float, tmp_path: Path) -> None:
    """Contacts of 1e-4 s behind flights of .4 s, in a step or a few: what onsets are late by is no share of a flight.

    Kelvin and Voigt, zeta = .3: e = exp(-(zeta/sqrt(1 - zeta^2)) (pi - 2 arcsin zeta)) at any speed, but for gravity.
    """
    stiffness, mass, zeta = 1.4e8, 0.092, 0.3
    damping = 2.0 * zeta * math.sqrt(stiffness * mass)
    law = f"{{law: kelvin_voigt, stiffness: {stiffness} N/m, damping: {damping} N*s/m}}"
    text = Path(gudgeon.__file__).with_name("mechanisms").joinpath("bouncing_ball.yaml").read_text(encoding="utf-8")
    file = tmp_path / "ball.yaml"
    file.write_text(re.sub(r"normal: \{law: hertz.*dissipation: none\}", f"normal: {law}", text), encoding="utf-8")
    ball = gudgeon.load(file, scene="elastic")
    found, fine = (ball.simulate(1.1, output=1, rtol=tolerance).impacts["deltadot"] for tolerance in (rtol, 1e-10))
    e = math.exp(-zeta / math.sqrt(1.0 - zeta**2) * (math.pi - 2.0 * math.asin(zeta)))
    assert len(fine) == 3 and fine[1] / fine[0] == pytest.approx(e, rel=1e-3)
    np.testing.assert_allclose(found, fine, rtol=3.0 * rtol)


BALLS = """format: gudgeon/1
name: two_balls
gravity: [0, -9.81 m/s^2]
materials: {steel: {E: 206 GPa, nu: 0.3}}
bodies: {soft: {mass: 1 kg, inertia: 1e-5 kg*m^2}, stiff: {mass: 1 g, inertia: 1e-5 kg*m^2}}
ground: {p: [0, 0], q: [3, 0]}
freedoms: 2
joints: {a: {revolute: [ground.p, soft.origin]}, b: {revolute: [ground.q, stiff.origin]}}
bearings:
  A: {radius: 10 m, clearance: .3 m, length: 10 mm, bearing_material: steel, journal_material: steel}
  B: {radius: 1.014 m, clearance: 1 m, length: 10 mm, bearing_material: steel, journal_material: steel}
contacts:
  rubber: {normal: {law: kelvin_voigt, stiffness: 1e3 N/m, damping: 6.3 N*s/m}}
  hard: {normal: {law: kelvin_voigt, stiffness: STIFFNESS N/m, damping: DAMPING N*s/m}}
scenes: {main: {play: {a: {bearing: A, contact: rubber}, b: {bearing: B, contact: hard}}, simulate: {t_end: 1.2 s}}}
"""


@pytest.mark.parametrize(("stiffness", "rtol"), [(1e7, 1e-3), (1e9, 1e-3), (1e9, 1e-4), (1e11, 1e-4)])
def test_a_short_contact_is_found_in_time_whatever_was_before(stiffness: float, rtol: float, tmp_path: Path) -> None:
    """A soft ball lands, then a light hard one, 1 m below: Kelvin and Voigt's force is D v at an onset, late or not.

    zeta = .5: that is its largest, in the last and slowest contacts too, whose corner ends their first step.
    """
    mass, zeta, v = 1e-3, 0.5, math.sqrt(2.0 * 9.81)
    damping = 2.0 * zeta * math.sqrt(stiffness * mass)
    file = tmp_path / "balls.yaml"
    file.write_text(BALLS.replace("STIFFNESS", str(stiffness)).replace("DAMPING", str(damping)), encoding="utf-8")
    run = gudgeon.load(file, scene="main").simulate(1.2, output=1, rtol=rtol)
    contacts = run.impacts[run.impacts["joint"] == 1]
    e = math.exp(-zeta / math.sqrt(1.0 - zeta**2) * (math.pi - 2.0 * math.asin(zeta)))
    late = 1e-9 * 0.5 * stiffness / damping  # a step of .5 s at most: what the force grows by, over itself
    assert contacts["t_on"][0] == pytest.approx(math.sqrt(2.0 / 9.81), abs=0.5e-9)
    assert contacts["F_peak"][0] == pytest.approx(damping * v, rel=late + rtol)
    assert contacts["deltadot"][1] == pytest.approx(e * v, rel=3.0 * (late + rtol))
    ended = contacts[np.isfinite(contacts["t_off"])]
    assert len(ended) > 5 and (ended["F_peak"] > (1.0 - rtol) * damping * ended["deltadot"]).all()


@pytest.mark.parametrize(("k", "rtol"), [(0, 1e-5), (2, 10**-5.5), (14, 1e-4), (18, 10**-4.75)])
def test_a_graze_by_stages_that_lie_off_the_motion(k: int, rtol: float) -> None:
    """A puck on a spring, 100 rad/s, swings along a diameter to c + 1e-7 m: x = a cos(100 t + phase) first meets −c."""
    a, c, phase = 1e-3 + 1e-7, 1e-3, 0.4 + 0.1 * k
    simulation = gudgeon.load(Path(__file__).parents[1] / "mechanisms/methods/graze.yaml", scene="loose")
    still = simulation.simulate(1e-6, output=1, method="rk4", step=1e-6).final
    q, v = np.array([a * math.cos(phase), 0.0, 0.0]), np.array([-100.0 * a * math.sin(phase), 0.0, 0.0])
    start = replace(still, t=0.0, q=q, v=v, memory=np.array([np.nan]), state=np.zeros(1, dtype=np.int8))
    run = simulation.simulate(0.04, output=1, method="rodas5p", rtol=rtol, start=start)
    assert run.impacts["t_on"][0] == pytest.approx((math.acos(-c / a) - phase) / 100.0, abs=2e-5)


def test_a_ramp_of_friction_as_thin_as_what_is_located() -> None:
    """v1 is 1.7e-4 beyond v0: a corner may not be left so far behind that the next one is passed unseen."""
    press, v0, omega = gudgeon.load("nine_bar_press", scene="dry"), 1.0795e-4, 17.6797912
    thin: dict[str, Any] = {"contacts.dry.friction.v0": v0, "contacts.dry.friction.v1": v0 * (1.0 + 1.7311587756e-4)}
    thin |= {"c": 0.37610387e-3, "omega": omega}
    found, fine = (
        press.simulate(0.004 + 0.03 / omega, output=1, method=method, rtol=rtol, parameters=thin)
        for method, rtol in (("dop853", 1e-5), ("rodas5p", 1e-10))
    )
    assert abs(found.q[-1] - fine.q[-1]).max() < 1e-7
    np.testing.assert_allclose(found.impacts["F_peak"], fine.impacts["F_peak"], rtol=1e-3)


@pytest.mark.parametrize(
    ("c", "omega", "rtol", "t_end"),
    [(0.43446480744e-3, 24.0942541, 1.44990907e-3, 0.0277814), (0.71056498e-3, 23.66564052, 1.55148980e-3, 0.0221572)],
)
def test_peaks_of_long_steps_are_no_lower_than_samples(c: float, omega: float, rtol: float, t_end: float) -> None:
    """A step that leads from before a force's top to where it is 0, and one that ends behind a top just passed."""
    press = gudgeon.load("nine_bar_press", scene="dry")
    run = press.simulate(t_end, output=20_000, method="dop853", rtol=rtol, parameters={"c": c, "omega": omega})
    assert len(run.impacts) > 5
    for contact in run.impacts:
        inside = (run.t >= contact["t_on"]) & (run.t <= contact["t_off"])
        force = run[f"{'AB'[contact['joint']]}.F"][inside]
        assert contact["F_peak"] > (1.0 - 1e-4) * force.max(initial=0.0)

"""Followers of a cam's angle: their motion, the torque that the cam's shaft bears, what a profile may be."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline, PchipInterpolator

from gudgeon.errors import InputError
from tests.programs import needs_compiler
from tests.scenes import loader
from tests.slow import slow_rows_but

pytestmark = needs_compiler
DEGREES, LIFTS = [0, 60, 90, 120, 150, 180, 210, 240, 360], [40, 40, 45, 52, 55, 52, 45, 40, 40]
POINTS = f"points: {[list(p) for p in zip(DEGREES, LIFTS, strict=True)]}, x: deg, y: mm, ends: periodic"
M, J, G, K, OMEGA = 0.3, 1e-3, 9.81, 5000.0, 10.0 * np.pi
CAM = """
gravity: [0, -9.81]
parameters: {omega: 300 rpm, k: 5 kN/m, h: 8 mm, r: 30 mm, push: 0 N*m}
curves: {lift: {%s}}
bodies:
  cam: {mass: 1 kg, inertia: 1e-3 kg*m^2}
  follower: {mass: 0.3 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0], top: [0, 120 mm]}
joints:
  O: {revolute: [ground.O, cam.origin]}
  guide: {translational: [ground.O, follower.origin], axis: [0, 1], angle: 0}
  pair: {cam: [cam.origin, follower.origin], axis: [0, 1], profile: "%s"}
%s
forces:
  spring: {spring_damper: [ground.top, follower.origin], stiffness: k, free_length: 110 mm}
  effort: {torque: cam, value: push}
"""
DRIVEN = "drives: {motor: {angle: cam, value: omega * t}}"
FREE = "start: {set: {cam.theta: 0.3}, rates: {cam.omega: 20 rad/s}}"
FORMS = ["reduced", "full"]


def upward(y: np.ndarray, ay: np.ndarray) -> np.ndarray:
    """Force of the cam on the follower, N: against weight, inertia and the spring, which is 0.12 m − y long."""
    return M * (G + ay) - K * (0.12 - y - 0.11)


@pytest.mark.parametrize("form", FORMS)
def test_the_shaft_bears_the_torque_that_virtual_work_says(tmp_path: Path, form: str) -> None:
    """T = F ds/dφ at every angle of several turns; the contact's force is that of the follower alone."""
    text = CAM % (POINTS, "lift(phi)", DRIVEN)
    run = loader(tmp_path, formulation=form)(text).simulate(0.5, output=731)
    s, phi = CubicSpline(np.radians(DEGREES), np.array(LIFTS) * 1e-3, bc_type="periodic"), OMEGA * run.t
    F = upward(s(phi), OMEGA**2 * s(phi, 2))
    np.testing.assert_allclose(run["follower.y"], s(phi), atol=1e-15)
    np.testing.assert_allclose(run["pair.Fy"], F, atol=1e-10)
    np.testing.assert_allclose(run["motor.torque"], F * s(phi, 1), atol=1e-11)
    assert np.abs(run["motor.torque"]).max() > 2.0
    assert run.diagnostics.phi_max < 1e-14


WAYS = [
    ("dop853", "reduced", 1e-9),
    ("rk4", "full", 1e-7),
    ("rodas5p", "reduced", 1e-7),
    ("dop853", "full", 1e-9),
    ("rk4", "reduced", 1e-7),
    ("radau5", "full", 1e-6),
]


@pytest.mark.parametrize(("method", "form", "within"), slow_rows_but(WAYS[:3], WAYS))
def test_a_free_shaft_turns_as_its_equation_of_motion_says(
    tmp_path: Path, method: str, form: str, within: float
) -> None:
    """(J + m s'²) φ'' + m s' s'' φ'² = T − F₀ s' with s = r − h cos φ, as SciPy integrates it."""
    r, h, push = 0.03, 0.008, 0.05

    def rates(_: float, y: np.ndarray) -> list[float]:
        s, slope, bend = r - h * np.cos(y[0]), h * np.sin(y[0]), h * np.cos(y[0])
        turn = push - slope * upward(s, bend * y[1] ** 2)
        return [y[1], turn / (J + M * slope**2)]

    scene = loader(tmp_path, formulation=form)(CAM % (POINTS, "r - h * cos(phi)", FREE))
    options: dict[str, Any] = {"step": 2e-5} if method == "rk4" else {"rtol": 1e-10}
    run = scene.simulate(0.3, output=30, method=method, parameters={"push": push}, **options)
    expected = solve_ivp(rates, (0, 0.3), [0.3, 20.0], "DOP853", t_eval=run.t, rtol=1e-12, atol=1e-13).y
    np.testing.assert_allclose(run["cam.theta"], expected[0], atol=within)
    np.testing.assert_allclose(run["cam.omega"], expected[1], atol=100.0 * within)
    assert run.diagnostics.energy_residual < within * run.diagnostics.energy_turned_over


@pytest.mark.parametrize("form", FORMS)
def test_steps_of_a_free_shaft_end_at_the_knots_of_its_profile(tmp_path: Path, form: str) -> None:
    """Energy is kept to the tolerance over several turns, though the curve's third derivative jumps."""
    run = loader(tmp_path, formulation=form)(CAM % (POINTS, "lift(phi)", FREE.replace("20", "100"))).simulate(
        0.3, rtol=1e-11, output=50
    )
    energy = run["energy.kinetic"] + run["energy.potential"]
    assert run["cam.theta"][-1] > 4.0 * np.pi
    assert np.abs(energy - energy[0]).max() < 1e-9 * run.diagnostics.energy_turned_over


@pytest.mark.parametrize("form", FORMS)
def test_a_rocker_and_a_follower_on_a_carrier_that_turns(tmp_path: Path, form: str) -> None:
    """Angles and lifts are measured on the carrier; power goes in by the drives and into motion alone."""
    text = """
bodies:
  arm: {mass: 2 kg, inertia: 1e-2 kg*m^2, points: {P: [60 mm, 20 mm]}}
  cam: {mass: 1 kg, inertia: 1e-3 kg*m^2}
  rocker: {mass: 0.2 kg, inertia: 2e-4 kg*m^2, com: [10 mm, 0]}
  slug: {mass: 0.3 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0]}
joints:
  O: {revolute: [ground.O, arm.origin]}
  C: {revolute: [arm.origin, cam.origin]}
  P: {revolute: [arm.P, rocker.origin]}
  swing: {rocker_cam: [cam, rocker], profile: "0.2 * sin(phi)", carrier: arm}
  way: {translational: [arm.origin, slug.origin], axis: [1, 1]}
  lift: {cam: [cam.origin, slug.origin], axis: [1, 1], profile: "40 mm + 5 mm * cos(2 * phi)", carrier: arm}
drives: {slow: {angle: arm, value: 3 * t}, fast: {angle: cam, value: 20 * t}}
"""
    run = loader(tmp_path, formulation=form)(text).simulate(0.4, output=200)
    phi, turn = 17.0 * run.t, 3.0 * run.t
    np.testing.assert_allclose(run["rocker.theta"] - turn, 0.2 * np.sin(phi), atol=1e-12)
    s, angle = 0.04 + 0.005 * np.cos(2.0 * phi), turn + 0.25 * np.pi
    np.testing.assert_allclose(run["slug.x"], s * np.cos(angle), atol=1e-14)
    np.testing.assert_allclose(run["slug.y"], s * np.sin(angle), atol=1e-14)
    power = 3.0 * run["slow.torque"] + 20.0 * run["fast.torque"]
    kinetic = CubicSpline(run.t, run["energy.kinetic"])
    np.testing.assert_allclose(power[5:-5], kinetic(run.t, 1)[5:-5], atol=1e-4 * np.abs(power).max())


@pytest.mark.parametrize("ends", ["periodic", "natural", "clamped"])
def test_a_monotone_curve_is_scipys_and_dwells_where_its_points_do(tmp_path: Path, ends: str) -> None:
    """The spline of the same points leaves its dwell of 40 mm for 38.2 mm."""
    monotone = POINTS.replace("periodic", f"{ends}, interpolation: monotone")
    dwell = {}
    for name, points in (("spline", POINTS), ("monotone", monotone)):
        scene = loader(tmp_path)(CAM % (points, "lift(phi)", DRIVEN))
        run = scene.simulate(2.0 * np.pi / OMEGA * 0.999, output=720)
        phi, y = OMEGA * run.t, run["follower.y"]
        dwell[name] = y[(phi < np.radians(60)) | (phi > np.radians(240))]
    assert dwell["spline"].min() < 0.0385 and (np.abs(dwell["monotone"] - 0.04) < 1e-16).all()
    s = PchipInterpolator(np.radians(DEGREES), np.array(LIFTS) * 1e-3)
    np.testing.assert_allclose(y, s(phi), atol=1e-15)
    np.testing.assert_allclose(run["follower.vy"], OMEGA * s(phi, 1), atol=1e-12)


REFUSED = [
    ("40 mm", "does not depend on phi"),
    ("40 mm + 1 mm/s * t", "'t' "),
    ("follower.y + 1 mm * phi", "is not allowed in the profile of a cam"),
    ("40 mm + 1 mm * abs(phi)", "slope that may jump, because of abs"),
    ("40 mm + 1 mm * psi", "unknown name 'psi'"),
    ("0.4 * phi", "m"),
]


@pytest.mark.parametrize(("profile", "message"), REFUSED)
def test_what_is_no_profile_is_refused(tmp_path: Path, profile: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        loader(tmp_path)(CAM % (POINTS, profile, DRIVEN))
    held = POINTS.replace("periodic", "natural, extrapolate: hold")
    with pytest.raises(InputError, match="extrapolate: none"):
        loader(tmp_path)(CAM % (held, "lift(phi)", DRIVEN))
    with pytest.raises(InputError, match="'phi' is the cam's angle here"):
        loader(tmp_path)((CAM % (POINTS, "lift(phi)", DRIVEN)).replace("h: 8 mm", "h: 8 mm, phi: 1"))

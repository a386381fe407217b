"""The shipped textbook linkages against their closed forms, and every shipped file as it stands."""

from __future__ import annotations

import math

import numpy as np
import pytest

import gudgeon
from gudgeon.loading.shipped import list_shipped_mechanisms
from tests.programs import needs_compiler

pytestmark = needs_compiler


def test_slider_crank_in_closed_form() -> None:
    """x = r cos θ + √(rod² − r² sin²θ); the motor's power is the rate of the kinetic energy."""
    r, rod, omega = 0.05, 0.12, 20.0 * math.pi
    run = gudgeon.load("slider_crank").simulate(0.2, output=400)
    angle = omega * run.t
    s, c, root = np.sin(angle), np.cos(angle), np.sqrt(rod**2 - (r * np.sin(angle)) ** 2)
    assert run["slider.x"] == pytest.approx(r * c + root, abs=1e-15)
    assert run["slider.vx"] == pytest.approx(-omega * r * s * (1.0 + r * c / root), abs=1e-13)
    assert run["rod.theta"] == pytest.approx(-np.arcsin(r * s / rod), abs=1e-14)
    masses = {"crank": (0.3, 1e-4), "rod": (0.21, 2.5e-4), "slider": (0.14, 1e-4)}
    power = sum(
        m * (run[f"{body}.vx"] * run[f"{body}.ax"] + run[f"{body}.vy"] * run[f"{body}.ay"])
        + inertia * run[f"{body}.omega"] * run[f"{body}.alpha"]
        for body, (m, inertia) in masses.items()
    )
    assert run["motor.torque"] * omega == pytest.approx(power, abs=1e-10 * np.abs(power).max())


def test_slider_crank_with_play_stays_near_the_ideal() -> None:
    """The slider is off by the clearance and a few µm of penetration at most, and the pin does strike."""
    dry, ideal = gudgeon.load("slider_crank", "dry"), gudgeon.load("slider_crank")
    run, reference = dry.simulate(0.1, output=500), ideal.simulate(0.1, output=500)
    assert np.abs(run["slider.x"] - reference["slider.x"]).max() < 1.2 * 0.2e-3
    assert run["wristpin.e"].max() > 0.2e-3
    assert run.diagnostics.onsets > 3
    assert run.diagnostics.energy_residual < 1e-6 * run.diagnostics.energy_turned_over


def test_four_bar_obeys_freudensteins_equation() -> None:
    """K1 cos ψ − K2 cos φ + K3 = cos(φ − ψ), φ the crank, ψ the rocker; the crank goes round, the rocker swings."""
    a, b, c, d = 0.04, 0.12, 0.08, 0.1
    run = gudgeon.load("four_bar").simulate(2.0, output=500)
    phi, psi = run["crank.theta"], run["rocker.theta"]
    left = d / a * np.cos(psi) - d / c * np.cos(phi) + (a**2 - b**2 + c**2 + d**2) / (2.0 * a * c)
    assert left == pytest.approx(np.cos(phi - psi), abs=1e-12)
    assert phi[-1] - phi[0] == pytest.approx(4.0 * math.pi, abs=1e-12)
    # the rocker turns back where crank and coupler are in one line, stretched and folded
    limits = [math.pi - math.acos((c**2 + d**2 - side**2) / (2.0 * c * d)) for side in (b + a, b - a)]
    assert (psi.min(), psi.max()) == (pytest.approx(min(limits), abs=1e-3), pytest.approx(max(limits), abs=1e-3))
    # and the transmission angle is least and largest where the crank lies on the ground line
    extremes = [math.acos((b**2 + c**2 - side**2) / (2.0 * b * c)) for side in (d - a, d + a)]
    angle = run["transmission_angle"]
    assert (angle.min(), angle.max()) == (pytest.approx(extremes[0], abs=1e-3), pytest.approx(extremes[1], abs=1e-3))


@pytest.mark.parametrize("name", list_shipped_mechanisms())
def test_every_shipped_mechanism_starts_closed(name: str) -> None:
    """Its ideal scene assembles, moves a little, and keeps its constraints."""
    scene = gudgeon.load(name)
    start = scene.start()
    assert start.residual < 1e-12
    run = scene.simulate(0.01, output=4)
    assert run.diagnostics.phi_max < 1e-9
    assert all(np.isfinite(run[output]).all() for output in scene.source.outputs)
    assert scene.source.title

"""A journal that turns under a constant load settles where the force of its film carries the load."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

import gudgeon
from gudgeon.reynolds import Bearing
from gudgeon.reynolds.deviations import law_force
from tests.programs import needs_compiler

pytestmark = needs_compiler
ROTOR = """
format: gudgeon/1
name: rotor
gravity: [0, -9.81]
materials: {steel: {E: 207 GPa, nu: 0.3}}
parameters: {omega: 200 rad/s}
bodies: {rotor: {mass: 90 kg, inertia: 1 kg*m^2}}
ground: {O: [0, 0]}
joints: {a: {revolute: [ground.O, rotor.origin]}}
drives: {spin: {angle: rotor, value: omega*t}}
bearings:
  pin: {radius: 10 mm, clearance: 0.03 mm, length: 20 mm, bearing_material: steel, journal_material: steel}
contacts: {oil: {film: {law: finite_length, viscosity: 0.05 Pa*s}}}
start: {play: {a: {e: [0.01 mm, -0.015 mm], rate: [0, 0]}}}
scenes: {oil: {play: {a: {bearing: pin, contact: oil}}, simulate: {t_end: 1 s, output: 20}}}
"""


def test_finite_length_under_a_constant_load(tmp_path: Path) -> None:
    """ε and attitude of the law's own equilibrium, found by a root finder."""
    c, omega, load = 0.03e-3, 200.0, 90.0 * 9.81
    force = law_force("finite_length", Bearing(10e-3 - c, 20e-3, c, 0.05), {})

    def steady(eps: float) -> np.ndarray:
        return np.asarray(force(*(np.array([x]) for x in (eps, 0.0, -0.5 * eps * omega)))[0])

    eps = float(brentq(lambda x: np.hypot(*steady(x)) - load, 0.01, 0.99, xtol=1e-14))
    radial, tangential = steady(eps)
    file = tmp_path / "rotor.yaml"
    file.write_text(ROTOR, encoding="utf-8")
    run = gudgeon.load(file, "oil").simulate(1.0, output=20, method="rodas5p", rtol=1e-9)
    at = np.array([run["rotor.x"][-1], run["rotor.y"][-1]]) / c
    assert np.hypot(*at) == pytest.approx(eps, rel=1e-6)
    # the film's force on the journal is up: radial n + tangential t = (0, load)
    n = np.array([tangential, radial]) / load
    np.testing.assert_allclose(at, eps * n, rtol=0, atol=1e-6)

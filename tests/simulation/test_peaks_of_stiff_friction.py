"""Peaks of a contact with stiff friction at loose tolerances: those of the run's own motion, not of a polynomial."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tests.programs import needs_compiler
from tests.scenes import loader

pytestmark = needs_compiler

BALL = """\
gravity: [0, -9.81]
materials: {steel: {E: 207 GPa, nu: 0.3}, bronze: {E: 110 GPa, nu: 0.34}}
bodies: {ball: {mass: 0.5 kg, inertia: 2e-4 kg*m^2, points: {pin: [0, 0]}}}
ground: {O: [5 mm, 3 mm]}
joints: {A: {revolute: [ground.O, ball.pin]}}
forces: {spin: {torque: ball, value: 0.2 N*m}}
freedoms: 1
start:
  set: {ball.theta: 1.833836547060427}
  rates: {ball.omega: -300}
  play: {A: {e: [0.4822818856752439 mm, -0.8352021272171701 mm], rate: [-0.16985778226170467, 0.16047495716188004]}}
bearings:
  pin: {radius: 10 mm, clearance: 0.9644472036862558 mm, length: 20 mm,
    bearing_material: steel, journal_material: bronze}
contacts:
  touch:
    normal: {law: flores, restitution: 0.9, geometry: internal}
    friction: {law: stribeck, mu: 0.6, mu_s: 1.2, v_s: 0.3, v0: 1e-3}
scenes: {worn: {play: {A: {bearing: pin, contact: touch}}}}
"""


def test_the_peak_is_what_dense_samples_have(tmp_path: Path) -> None:
    """A state between those of the run, as good as the tolerance, had 11 % more force than the run ever has."""
    ball = loader(tmp_path)(BALL, "worn")
    times = np.linspace(0.0, 0.03, 60_001)
    for rtol in (4e-4, 3e-4):
        dense = ball.simulate(0.03, output=times, rtol=rtol)["A.F"].max()
        assert abs(ball.simulate(0.03, rtol=rtol, peaks=["A.F"]).peak("A.F").max / dense - 1.0) < 1e-2

"""Drives whose second rate is unbounded at the start of a run, or within it: right motions, and a quiet audit."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.programs import needs_compiler
from tests.scenes import loader
from tests.simulation.test_audit_at_rest import audit_notes

pytestmark = needs_compiler

CRANK = """
gravity: [0, -9.81]
bodies:
  crank: {{length: 50 mm, mass: 0.3 kg, inertia: 1e-4 kg*m^2}}
  rod: {{length: 150 mm, mass: 0.2 kg, inertia: 4e-4 kg*m^2}}
ground: {{O: [0, 0]}}
joints: {{A: {{revolute: [ground.O, crank.tail]}}, B: {{revolute: [crank.head, rod.tail]}}}}
drives: {{m: {{angle: crank, value: "{value}"}}}}
start: {{set: {{rod.theta: 0.3}}}}
"""


@pytest.mark.parametrize("method", ["dop853", "radau5", "radau9"])
@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_speeds_count_where_the_start_is_unbounded(method: str, rtol: float, tmp_path: Path) -> None:
    """An unbounded acceleration is no scale of speeds: with it rod.omega was 2752 rad/s after 1e-13 s, and no word."""
    rod = loader(tmp_path)(CRANK.format(value="1 rad*max(t/(1 s), 0)**1.5"))
    run = rod.simulate(0.1, method=method, rtol=rtol, output=10, audit="full")
    assert run["rod.theta"][-1] == pytest.approx(-0.1838001597, abs=1e-5)  # radau9 at 1e-10
    assert run["rod.omega"][-1] == pytest.approx(-9.68432387, rel=1e-5)
    assert not audit_notes(run)


@pytest.mark.parametrize(
    "value, method, rtol",
    [
        ("1 rad*abs(t/(1 s) - 0.5)**1.5", "dop853", 1e-4),
        ("1 rad*max(t/(1 s) - 0.3, 0)**1.3", "radau5", 1e-10),
        ("1 rad*max(sin(10 rad/s*t), 0)**2.5", "dop853", 1e-10),
        ("1 rad*abs(sin(10 rad/s*t))**1.7", "radau5", 1e-8),
    ],
)
def test_steps_that_end_where_a_second_rate_is_unbounded(value: str, method: str, rtol: float, tmp_path: Path) -> None:
    """No polynomial follows it there, so that the dense output says nothing about the step."""
    run = loader(tmp_path)(CRANK.format(value=value)).simulate(1.0, method=method, rtol=rtol, output=50, audit="full")
    assert not audit_notes(run)


FILM = """
materials: {s: {E: 2e11, nu: 0.3}}
bearings: {pin: {radius: 50 mm, clearance: 0.13 mm, length: 73 mm, bearing_material: s, journal_material: s}}
contacts: {oil: {film: {law: ocvirk, viscosity: 0.05 Pa*s}}}
scenes: {wet: {play: {B: {bearing: pin, contact: oil}}}}
"""


def test_films_where_a_second_rate_is_unbounded(tmp_path: Path) -> None:
    """The force is unbounded as well: the check of films' forces ended such runs."""
    text = CRANK.format(value="0.3 rad + 30 rad/s*t + 0.2 rad*abs(t/(1 s)*36 - 1.7)**1.5") + FILM
    run = loader(tmp_path)(text, "wet").simulate(0.1, rtol=1e-6, output=50, audit="full")
    assert run.t[-1] == 0.1 and not audit_notes(run)

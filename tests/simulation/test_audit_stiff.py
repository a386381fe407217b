"""The audit is quiet where a contact is far stiffer than the motion: rates in it are known as well as forces are."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.programs import needs_compiler
from tests.scenes import loader
from tests.simulation.test_audit_at_rest import audit_notes

pytestmark = needs_compiler

LIGHT_ROD = """
gravity: [0, -9.81 m/s^2]
bodies:
  follower: {mass: 0.25 kg, inertia: 2.6e-4 kg*m^2}
  rod: {length: 175 mm, mass: 0.124 kg, inertia: 1e-10 kg*m^2}
  slider: {mass: 0.083 kg, inertia: 8e-5 kg*m^2}
ground: {O: [0, 0], W: [0, 0.103]}
joints:
  stem: {translational: [ground.W, follower.origin], axis: [0, 1]}
  crankpin: {revolute: [follower.origin, rod.tail]}
  wristpin: {revolute: [rod.head, slider.origin]}
  cylinder: {translational: [ground.O, slider.origin], axis: [1, 0]}
drives: {cam: {coordinate: follower.y, value: 83.6 mm + 10 mm*(1 - cos(28 rad/s*t))}}
start: {guess: {slider.x: 150 mm, follower.y: 83.6 mm, rod.theta: -0.51}}
materials: {steel: {E: 211 GPa, nu: 0.309}}
bearings:
  pin: {radius: 13.2 mm, clearance: 0.316 mm, length: 20.5 mm, bearing_material: steel, journal_material: steel}
contacts: {touch: {normal: {law: liu, restitution: 0.715, dissipation: lankarani_nikravesh}}}
scenes: {worn: {play: {wristpin: {bearing: pin, contact: touch}, crankpin: {bearing: pin, contact: touch}}}}
"""


@pytest.mark.parametrize("rtol", [3e-7, 1e-8])
def test_a_rod_without_inertia_between_two_contacts(rtol: float, tmp_path: Path) -> None:
    """Its angle follows the contacts: an error of a position within its tolerance was a rate of any size."""
    run = loader(tmp_path)(LIGHT_ROD, "worn").simulate(0.1, output=100, rtol=rtol)
    assert run.diagnostics.steps > 1000 and not audit_notes(run)

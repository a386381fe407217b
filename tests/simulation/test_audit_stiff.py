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


SEPARATES = """
gravity: [0, -9.81]
materials: {s: {E: 207 GPa, nu: 0.3}}
bodies:
  crank: {length: 50 mm, mass: 0.3 kg, inertia: 1e-4 kg*m^2}
  rod: {length: 120 mm, mass: 0.21 kg, inertia: 2.5e-4 kg*m^2}
  piston: {mass: 0.14 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0]}
joints:
  shaft: {revolute: [ground.O, crank.tail]}
  crankpin: {revolute: [crank.head, rod.tail]}
  wristpin: {revolute: [rod.head, piston.origin]}
  cylinder: {translational: [ground.O, piston.origin], axis: [1, 0]}
drives: {motor: {angle: crank, value: 30 deg + 80 rad/s*t}}
forces: {gas: {force: piston.origin, value: [-50 N - 30 N*sin(100 rad/s*t), 0 N]}}
start: {guess: {piston.x: 170 mm}}
bearings: {pin: {radius: 10 mm, clearance: 0.2 mm, length: 20 mm, bearing_material: s, journal_material: s}}
contacts:
  tr:
    normal: {law: lankarani_nikravesh, restitution: 0.7}
    film: {law: pinkus_sternlicht, viscosity: 1e-8 Pa*s}
    transition: 5 um
scenes: {tr: {play: {wristpin: {bearing: pin, contact: tr}, crankpin: {bearing: pin, contact: tr}}}}
"""


def test_forces_that_are_left_after_a_contact(tmp_path: Path) -> None:
    """A film has 0.02 N after a contact of 2 kN: its error is measured by the contact, and not by what is left."""
    scene = loader(tmp_path)(SEPARATES, "tr")
    run, reference = scene.simulate(0.02, output=200, audit="full"), scene.simulate(0.02, output=200, rtol=1e-11)
    (found,) = [one for one in run.diagnostics.audit if one.check == "force"]
    assert found.worst < 3.0
    for joint in ("wristpin", "crankpin"):
        early = run.t < 5e-3  # later an impact makes the motions part
        assert abs(run[f"{joint}.F"] - reference[f"{joint}.F"])[early].max() < 1e-4 * reference[f"{joint}.F"].max()

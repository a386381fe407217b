"""Whether the start is a dead centre follows from its geometry, whatever the masses."""

from __future__ import annotations

from pathlib import Path

import pytest

import gudgeon
from gudgeon.assembly.rank import find_dependent_equations
from tests.programs import needs_compiler
from tests.scenes import loader

pytestmark = needs_compiler
TEXT = """
format: gudgeon/1
name: light
parameters: {m: 1 kg, J: 1e-4 kg*m^2, r: 0.05 m, L: 0.2 m}
bodies:
  crank: {length: r, mass: 0.5 kg, inertia: 1e-4 kg*m^2}
  rod: {length: L, mass: m, inertia: J}
  slider: {mass: 0.3 kg, inertia: 1e-4 kg*m^2}
ground: {O: [0, 0]}
joints:
  O: {revolute: [ground.O, crank.tail]}
  crankpin: {revolute: [crank.head, rod.tail]}
  wristpin: {revolute: [rod.head, slider.origin]}
  cylinder: {translational: [ground.O, slider.origin], axis: [1, 0]}
"""
FREE = "start: {set: {crank.theta: ANGLE}, guess: {rod.theta: 0, slider.x: r + L}}\n"
DRIVEN = (
    "start: {guess: {rod.theta: 0, slider.x: r + L}}\ndrives: {D: {coordinate: slider.x, value: SPAN + 0.01 m/s * t}}\n"
)
MASSES = ((1.0, 1e-4), (1e-9, 1e-13), (1e-12, 1e-16), (1e-12, 1e-4), (1e-13, 1e-17), (1e9, 1e-4), (1e9, 1e9))


@pytest.mark.parametrize("start", [FREE.replace("ANGLE", "30 deg"), DRIVEN.replace("SPAN", "0.22 m")])
@pytest.mark.parametrize("length", [1.0, 1e-3, 1e3])
def test_masses_make_no_dead_centre(start: str, length: float, tmp_path: Path) -> None:
    text = (TEXT + start).replace("0.05 m", f"{0.05 * length} m").replace("0.2 m", f"{0.2 * length} m")
    (tmp_path / "m.yaml").write_text(text.replace("0.22 m", f"{0.22 * length} m").replace("0.01 m/s", f"{length} mm/s"))
    simulation = gudgeon.load(tmp_path / "m.yaml")
    for m, J in MASSES:
        run = simulation.simulate(1e-6, output=1, parameters={"m": m, "J": J}, audit=False)
        assert not any("dead centre" in note for note in run.diagnostics.notes), (m, J)
        assert not find_dependent_equations(simulation.compiled, run.p, 0.0, run.q[0])


def test_a_stretched_linkage_is_one_for_all_masses(tmp_path: Path) -> None:
    """The slider is driven, and crank and rod lie in one line."""
    (tmp_path / "d.yaml").write_text(TEXT + DRIVEN.replace("SPAN", "0.24 m"))
    driven = gudgeon.load(tmp_path / "d.yaml")
    for m, J in MASSES:
        run = driven.simulate(1e-6, output=1, parameters={"m": m, "J": J}, audit=False)
        stretched = run.q[0].copy()
        stretched[[0, 1, 2]], stretched[[3, 4, 5]] = (0.025, 0.0, 0.0), (0.15, 0.0, 0.0)
        stretched[[6, 7, 8]] = (0.25, 0.0, 0.0)
        assert "D" in find_dependent_equations(driven.compiled, run.p, 0.0, stretched)


LIFT = """
parameters: {mu: 0.3}
gravity: [0, -9.81]
materials: {s: {E: 207 GPa, nu: 0.3}}
bodies: {car: {mass: 2 kg, inertia: 1e-2}, ball: {mass: 0.5 kg, inertia: 1e-4}}
ground: {O: [0, 0]}
joints:
  rail: {translational: [ground.O, car.origin], axis: [0, 1], angle: 0}
  pen: {revolute: [car.origin, ball.origin]}
  hold: {translational: [ground.O, ball.origin], axis: [0, 1], angle: 0}
DRIVES
bearings: {h: {radius: 30 mm, clearance: 10 mm, length: 10 mm, bearing_material: s, journal_material: s}}
contacts: {c: {normal: {law: flores, restitution: 0.5}}}
scenes: {m: {play: {pen: {bearing: h, contact: c}}}}
"""


@pytest.mark.parametrize("drives", ["drives: {m: {coordinate: car.y, value: 0.5 m/s * t}}", ""])
def test_a_joint_with_play_that_says_the_same_makes_no_dead_centre(drives: str, tmp_path: Path) -> None:
    """Closed, the pen says again that the ball stays on the line of the car: everywhere, and not at the start alone."""
    scene = loader(tmp_path)(LIFT.replace("DRIVES", drives), "m")
    assert not any("dead centre" in note for note in scene.simulate(1e-6, output=1).diagnostics.notes)

"""Bodies whose mass is small beside others': accelerations and forces tend to those of a rod without mass."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import gudgeon
from tests.programs import needs_compiler

pytestmark = needs_compiler
FOUR_BAR = """
format: gudgeon/1
name: light_coupler
gravity: [0, -9.81]
parameters: {{m: {mass} kg, J: {mass} kg*m^2}}
ground: {{O: [0, 0], Q: [2 m, 0]}}
bodies:
  crank: {{length: 0.3 m, mass: 1 kg, inertia: auto}}
  coupler: {{length: 2 m, mass: m, inertia: J}}
  rocker: {{length: 1 m, mass: 2 kg, inertia: auto}}
joints:
  a: {{revolute: [ground.O, crank.tail]}}
  b: {{revolute: [crank.head, coupler.tail]}}
  c: {{revolute: [coupler.head, rocker.head]}}
  d: {{revolute: [ground.Q, rocker.tail]}}
start: {{set: {{crank.theta: 1 rad}}, guess: {{rocker.theta: 1.5 rad}}}}
"""


@pytest.mark.parametrize("formulation", ["reduced", "full"])
def test_a_light_coupler_is_a_rod_that_bears_along_itself(formulation: str, tmp_path: Path) -> None:
    """Rows of joints that a light body separates depend on each other in the metric of M, not in that of lengths.

    At 1e-9 kg they were left out: the force in the joint was 2.4e-9 N. The right values are the limit: what a mass of
    1e-6 kg changes is its share of the others.
    """
    runs = {}
    for mass in (1e-6, 1e-9, 1e-10):
        file = tmp_path / f"{mass}.yaml"
        file.write_text(FOUR_BAR.format(mass=mass), encoding="utf-8")
        runs[mass] = gudgeon.load(file, formulation=formulation).simulate(0.05, output=4)
    for mass in (1e-9, 1e-10):
        for name in ("crank.alpha", "b.F", "c.F"):
            assert runs[mass][name] == pytest.approx(runs[1e-6][name], rel=1e-5), (mass, name)


@pytest.mark.parametrize("formulation", ["reduced", "full"])
@pytest.mark.parametrize("mass", [1e-12, 1e-18])
def test_linkages_with_a_light_coupler_are_closed_to_rounding(formulation: str, mass: float, tmp_path: Path) -> None:
    """Errors of the constraints are not measured by masses so far apart: then no step onto them was found.

    Up to 2e-11 m were left, which the audit reports; with a drive the full formulation ended as singular.
    """
    file = tmp_path / "free.yaml"
    file.write_text(FOUR_BAR.format(mass=mass), encoding="utf-8")
    free = gudgeon.load(file, formulation=formulation)
    for method in ("auto", "rodas5p"):
        run = free.simulate(1.0, output=20, method=method, rtol=1e-10)
        assert np.abs(run["Phi.max"]).max() < 1e-14 and not run.diagnostics.notes
    file.write_text(FOUR_BAR.format(mass=mass) + "drives: {motor: {angle: crank, value: 1 rad + 3 rad/s*t}}\n")
    driven = gudgeon.load(file, formulation=formulation).simulate(1.0, output=20)
    heavier = gudgeon.load(file, formulation=formulation).simulate(1.0, output=20, parameters={"m": 1e-6, "J": 1e-6})
    assert not driven.diagnostics.notes
    for name in ("b.F", "c.F", "motor.torque"):
        largest = np.abs(heavier[name]).max()
        np.testing.assert_allclose(driven[name], heavier[name], rtol=0, atol=1e-5 * largest)


WELDED = """
format: gudgeon/1
name: welded_halves
gravity: [0.8587, -9.81]
parameters: {J: 1e-7 kg*m^2}
ground: {A: [0.2547, -0.2797], B: [0.2703, 0.1327], C: [0.04512, -0.02494], D: [-0.1196, 0.1061]}
bodies:
  frame: {mass: 0.33 kg, inertia: 1.6e-5 kg*m^2, com: [0.0047, -0.0205],
          points: {d: [-0.05725, -0.01173], c: [-0.02538, 0.3261]}}
  one: {mass: 0.22 kg, inertia: J, com: [-0.02752, -0.05534], points: {a: [-0.347, -0.1837], b: [-0.1899, -0.447]}}
  other: {mass: 0.22 kg, inertia: J}
joints:
  slot: {point_on_line: [ground.D, frame.d], direction: [0.1102, 1.347]}
  link: {distance: [ground.A, one.a], length: 0.2841}
  pin: {revolute: [frame.c, ground.C]}
  groove: {point_on_line: [one.b, ground.B], direction: [-0.1314, -0.8016]}
  weld: {rigid: [one.com, other.origin], angle: 0.7}
forces: {spring: {rotational_spring_damper: [frame, one], free_angle: 3.869, stiffness: 1.817 N*m, damping: 0 N*m*s}}
start:
  guess: {frame.x: -0.2629, frame.y: 0.1369, frame.theta: -2.141, one.x: -0.1483, one.y: 0.2001, one.theta: 1.818,
          other.x: -0.1483, other.y: 0.2001, other.theta: 2.518}
"""


def test_accelerations_hold_for_all_moments_of_inertia(tmp_path: Path) -> None:
    """Accelerations of the tree and of all bodies agree to 1e-9 of the largest from 1e-14 to 1 kg m².

    Elimination leaves J of J + m s² as a pivot, and rounding grows by the square of that ratio: for 1e-7 to 1e-6 kg m²
    accelerations were wrong by 1e-5 of the largest.
    """
    file = tmp_path / "welded.yaml"
    file.write_text(WELDED, encoding="utf-8")
    simulation = gudgeon.load(file)
    for inertia in 10.0 ** np.arange(-14.0, 0.5, 0.5):
        run = simulation.simulate(0.5, output=10, rtol=1e-9, audit="full", parameters={"J": inertia})
        found = {one.check: one.worst for one in run.diagnostics.audit}
        assert found["acceleration"] < 1e-3 and run.diagnostics.steps < 200, inertia  # of a limit of 1e-6


POINTS = """
format: gudgeon/1
name: points
bodies:
  crank: {length: 50 mm, mass: 0.15 kg, inertia: 0, com: [20 mm, 6 mm]}
  rod: {length: 130 mm, mass: 0.15 kg, inertia: 0, com: [50 mm, -8 mm]}
  piston: {mass: 0.15 kg, inertia: 0, com: [5 mm, 2 mm]}
ground: {O: [0, 0], G: [0, 10 mm]}
joints:
  A: {revolute: [ground.O, crank.tail]}
  B: {revolute: [crank.head, rod.tail]}
  C: {revolute: [rod.head, piston.origin]}
  S: {translational: [ground.G, piston.origin], axis: [1, 0]}
drives: {d: {angle: crank, value: 0.4 rad + 40 rad/s*t}}
start: {guess: {piston.x: 180 mm}}
"""


@pytest.mark.parametrize(
    ("light", "pair"),
    [
        ("crank", "rod (0.15 kg) and crank (1e-14 kg)"),
        ("piston", "crank (0.15 kg) and piston (1e-14 kg)"),
    ],
)
def test_bodies_without_inertia_are_refused_by_their_masses(light: str, pair: str, tmp_path: Path) -> None:
    """The inertias of crank (0) and crank (0) were reported as too far apart. Masses within the ratio are accepted."""
    file = tmp_path / "points.yaml"
    file.write_text(POINTS)
    simulation = gudgeon.load(file)
    with pytest.raises(gudgeon.AssemblyError) as caught:
        simulation.simulate(0.01, output=4, parameters={f"bodies.{light}.mass": 1e-14})
    assert f"the masses of {pair} have too large a ratio" in str(caught.value) and "1e+12 times" in str(caught.value)
    simulation.simulate(0.01, output=4, parameters={f"bodies.{light}.mass": 0.16e-12})

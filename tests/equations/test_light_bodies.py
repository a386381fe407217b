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

"""Where the drives of a linkage without freedom can lead no further: the time is that of the limit, in closed form."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import gudgeon
from gudgeon.errors import SolverError
from tests.programs import needs_compiler

pytestmark = needs_compiler
HEAD = "format: gudgeon/1\nname: limit\n"
BODY = "mass: .1 kg, inertia: 1e-4 kg*m^2"
SHORT_ROD = f"""{HEAD}bodies:
  crank: {{length: 100 mm, {BODY}}}
  rod: {{length: 80 mm, {BODY}}}
  block: {{{BODY}}}
ground: {{O: [0, 0], G: [0, 0]}}
joints:
  O: {{revolute: [ground.O, crank.tail]}}
  A: {{revolute: [crank.head, rod.tail]}}
  B: {{revolute: [rod.head, block.origin]}}
  guide: {{translational: [ground.G, block.origin], axis: [1, 0]}}
drives: {{turn: {{angle: crank, value: 10 deg + 2 rad/s * t}}}}
start: {{guess: {{rod.theta: -20 deg}}}}
"""
FOUR_BAR = f"""{HEAD}bodies:
  crank: {{length: 120 mm, {BODY}}}
  coupler: {{length: 100 mm, {BODY}}}
  rocker: {{length: 90 mm, {BODY}}}
ground: {{O: [0, 0], Q: [150 mm, 0]}}
joints:
  O: {{revolute: [ground.O, crank.tail]}}
  A: {{revolute: [crank.head, coupler.tail]}}
  B: {{revolute: [coupler.head, rocker.head]}}
  Q: {{revolute: [ground.Q, rocker.tail]}}
drives: {{turn: {{angle: crank, value: 40 deg + 1.5 rad/s * t}}}}
start: {{guess: {{coupler.theta: 10 deg, rocker.theta: 80 deg}}}}
"""
LIMITS = {  # the rod stands across the guide: a sin = b; coupler and rocker in one line: |AQ| = b + c
    SHORT_ROD: (math.asin(0.08 / 0.1) - math.radians(10.0)) / 2.0,
    FOUR_BAR: (math.acos((0.12**2 + 0.15**2 - 0.19**2) / (2 * 0.12 * 0.15)) - math.radians(40.0)) / 1.5,
}


@pytest.mark.parametrize("formulation", ["reduced", pytest.param("full", marks=pytest.mark.slow)])
@pytest.mark.parametrize("text", LIMITS)
def test_a_limit_is_named_by_its_own_time(text: str, formulation: str, tmp_path: Path) -> None:
    """Not by the last sample before it, however far apart they are."""
    (tmp_path / "limit.yaml").write_text(text, encoding="utf-8")
    linkage = gudgeon.load(tmp_path / "limit.yaml", formulation=formulation)
    for output in (7, 100):
        with pytest.raises(SolverError) as caught:
            linkage.simulate(2.0, output=output)
        assert caught.value.time == pytest.approx(LIMITS[text], rel=1e-9)
        assert caught.value.partial.t[-1] <= caught.value.time


def test_an_energy_beyond_all_numbers_is_told(tmp_path: Path) -> None:
    """m v²/2 is ∞ from the start on, and the balance ∞ − ∞."""
    file = tmp_path / "heavy.yaml"
    file.write_text(
        f"{HEAD}bodies: {{a: {{mass: 1e300 kg, inertia: 1 kg*m^2}}}}\nground: {{o: [0, 0]}}\n"
        "joints: {g: {translational: [ground.o, a.origin], axis: [1, 0]}}\n"
        "drives: {d: {coordinate: a.x, value: 1e5 m/s * t}}\n"
    )
    scene = gudgeon.load(file)
    run, many = scene.simulate(1.0, output=4), scene.simulate_many([{}], 1.0, output=4)
    assert math.isnan(run.diagnostics.energy_residual)
    message = "the energy residual is not known: the energy is not finite at t = 0 s"
    assert message in run.diagnostics.notes and message in many[0].diagnostics.notes


def test_a_drive_that_is_a_number_stands_beside(tmp_path: Path) -> None:
    """It has no value of time to be told: a KeyError, and nothing of the run was kept."""
    file = tmp_path / "table.yaml"
    text = SHORT_ROD.replace("  block: {", "  table: {" + BODY + "}\n  block: {").replace(
        "drives: {",
        "  lift: {translational: [ground.G, table.origin], axis: [0, 1]}\n"
        "drives: {hold: {coordinate: table.y, value: 50 mm}, ",
    )
    file.write_text(text, encoding="utf-8")
    with pytest.raises(SolverError, match="beyond t = ") as caught:
        gudgeon.load(file).simulate(2.0)
    assert caught.value.partial.t[-1] == pytest.approx((math.asin(0.8) - math.radians(10)) / 2, abs=2e-3)

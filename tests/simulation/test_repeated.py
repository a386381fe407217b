"""Runs that are made once more, bit for bit, whatever ended them and wherever they began."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.results.results import Result
from gudgeon.simulation.examine import NOTE_STORED_SAMPLES, repeat_run_exactly
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler

pytestmark = needs_compiler
HEAD = """
format: gudgeon/1
name: again
gravity: [0, -9.81 m/s^2]
materials: {steel: {E: 207 GPa, nu: 0.3}}
ground: {O: [0, 0]}
bearings: {b: {radius: 10 mm, clearance: 0.1 mm, length: 20 mm, bearing_material: steel, journal_material: steel}}
contacts: {dry: {normal: {law: flores, restitution: 0.7}, friction: {law: coulomb, mu: 0.1, v0: 1e-2 m/s}}}
"""
PENDULUM = (
    HEAD
    + """
bodies: {bob: {mass: 2 kg, inertia: 1e-3, points: {pin: [0, 0.3 m]}}}
joints: {J: {revolute: [ground.O, bob.pin]}}
start: {set: {bob.theta: 40 deg}}
events: {low: {zero: bob.theta, action: stop}}
scenes: {loose: {play: {J: {bearing: b, contact: dry}}}}
"""
)
CRANK = (
    HEAD
    + """
bodies:
  crank: {length: 50 mm, mass: 0.3 kg, inertia: 1e-4 kg*m^2}
  rod: {length: 120 mm, mass: 0.21 kg, inertia: 2.5e-4 kg*m^2}
  piston: {mass: 0.14 kg, inertia: 1e-4 kg*m^2}
joints:
  shaft: {revolute: [ground.O, crank.tail]}
  J: {revolute: [crank.head, rod.tail]}
  wristpin: {revolute: [rod.head, piston.origin]}
  cylinder: {translational: [ground.O, piston.origin], axis: [1, 0.1]}
drives: {motor: {angle: crank, value: 30 deg + 40 rad/s*t}}
start: {guess: {piston.x: 170 mm}}
scenes: {loose: {play: {J: {bearing: b, contact: dry}}}}
"""
)


def load(folder: Path, text: str) -> Simulation:
    (folder / "again.yaml").write_text(text, encoding="utf-8")
    return gudgeon.load(folder / "again.yaml", "loose")


def volume(simulation: Simulation, run: Result, **options: Any) -> float:
    return gudgeon.wear(simulation, run, "J", k=1.0, **options).bearing.volume


@pytest.mark.parametrize("options", [{}, {"method": "rk4", "step": 1e-5}, {"method": "rodas5p"}], ids=str)
def test_a_run_that_an_event_ended(tmp_path: Path, options: dict[str, Any]) -> None:
    """Ends again where it did, also from a file; it wears as much as the run that goes on wears until then."""
    simulation = load(tmp_path, PENDULUM)
    run = simulation.simulate(0.5, output=20, **options)
    assert len(run.events) == 1 and run.t[-1] == run.events["t"][0] < run.diagnostics.t_end == 0.5
    whole = simulation.simulate(0.5, output=20, stop=False, **options)
    assert np.isnan(whole.diagnostics.t_end)
    until = volume(simulation, whole, until=float(run.t[-1]))
    assert volume(simulation, run) == pytest.approx(until, rel=1e-5) and until > 0.0
    run.save(tmp_path / "run.nc")
    assert volume(simulation, Result.load(tmp_path / "run.nc")) == volume(simulation, run)
    check = run.check()
    assert check and NOTE_STORED_SAMPLES not in check.notes and check.samples > 1000
    batch = simulation.simulate_many([{}], 0.5, output=20, **options)
    assert volume(simulation, batch[0]) == volume(simulation, run)


def test_a_run_that_goes_on_along_an_inclined_slide(tmp_path: Path) -> None:
    """It begins in the state that it was given, which its first sample rounds; alone, in a batch, cut by an output."""
    simulation = load(tmp_path, CRANK)
    first = simulation.simulate(0.013, output=5)
    run = simulation.simulate(0.03, output=10, start=first.final)
    other = repeat_run_exactly(simulation, run, np.union1d(run.t, np.linspace(0.013, 0.03, 301)), None)
    assert other is not None and len(other.t) > 300
    whole = simulation.simulate(0.03, output=10, start=first.final, method=run.diagnostics.method)
    assert np.array_equal(whole.q, run.q)
    alone = volume(simulation, run)
    later = simulation.simulate(output=[0.02, 0.03], start=first.final)
    assert volume(simulation, later) == alone > 0.0
    batch = simulation.simulate_many([{}, {}], 0.03, output=10, start=first.final)
    assert volume(simulation, batch[1]) == alone
    check = run.check()
    assert check and NOTE_STORED_SAMPLES not in check.notes

"""The audit compares each discrete state with its condition: it reports ends that are missed, and nothing else."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.integrators import lanes
from gudgeon.simulation.simulation import Simulation
from tests.audit_mutants import mutant
from tests.integrators.test_newton_restitution import BALL, made
from tests.programs import needs_compiler
from tests.simulation.test_audit import crank, reported

pytestmark = needs_compiler

EVENTS = "engine/watch/events.c"
GAP, FORCE = "is_gap ? bracket_gap_zero(run", "sampled ? bracket_force_zero(run"
CLOSED, THIRD = "run->discrete.contact[event].closed", "run->contacts.onsets % 3 == 2"
STICKS = "run->discrete.mode[event - N_CLEARANCES - N_SWITCHES] == 0.0"
IGNORED = "(switch_index == run->roots.suppressed_switch"
METHODS = ("dop853", "rk4", "rodas5p", "auto")
STATES = ("gap", "free", "branch", "mode")


def unsearched(condition: str, search: str = GAP) -> tuple[str, str, str]:
    """The edit of a mutant that does not search for the zeros of event functions under a condition in C."""
    kind, call = search.split("? ")
    return EVENTS, search, f"{kind}? !({condition}) && {call}"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("states")


@pytest.fixture(scope="module")
def right(folder: Path) -> Simulation:
    return crank(folder)


def settings(method: str, step: float) -> dict[str, Any]:
    return {"method": method, "step": step if method == "rk4" else None}


@pytest.mark.parametrize(
    "condition",
    [CLOSED, THIRD],
    ids=["separations", "every third onset and separation"],
)
def test_contacts_whose_end_is_missed(
    condition: str, right: Simulation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The force law of a closed contact with a gap is outside its domain, also if the force is zero there."""
    monkeypatch.setattr(lanes, "MIN_REMAINING_S", 0.0)
    wrong = mutant(right, tmp_path, unsearched(condition))
    speeds = {"omega": np.linspace(60.0, 64.0, lanes.MIN_RUNS)}
    for method in METHODS:
        how = settings(method, 2e-6)
        assert "check gap" in reported(wrong, 0.05, **how), method
        assert len(wrong.simulate_many(speeds, 0.05, output=20, **how).failures) == lanes.MIN_RUNS, method
    assert not right.simulate_many(speeds, 0.05, output=20, **how).failures


@pytest.mark.parametrize(
    "condition",
    [STICKS, f"!({STICKS})", "run->counts.switches % 3 == 2"],
    ids=["the end of stick", "the end of slip", "every third change"],
)
def test_modes_of_friction_whose_end_is_missed(condition: str, tmp_path: Path) -> None:
    right = gudgeon.load("belt_block")
    wrong = mutant(right, tmp_path, unsearched(f"event >= N_CLEARANCES && {condition}", FORCE))
    for method in METHODS:
        assert "check mode" in reported(wrong, 5.0, **settings(method, 1e-3)), method


def test_rigid_surfaces_that_pull(folder: Path, tmp_path: Path) -> None:
    """The ball leaves the wall at cos θ = (2 − v²/(g R))/3, 0.484 s after its start; the mutant stays on the wall."""
    start = {"start.play.A.e.y": -1.0, "start.play.A.rate.x": 6.0, "contacts.hard.normal.restitution": 0.0}
    right = made(folder, BALL)
    wrong = mutant(right, tmp_path, unsearched("event < N_CLEARANCES", FORCE))
    for method in ("dop853", "dopri5", "rk4", "auto"):
        how = settings(method, 1e-3) | {"parameters": start, "stop": False}
        assert not reported(right, 1.2, **how), method
        assert "check free" in reported(wrong, 1.2, **how), method


@pytest.mark.parametrize("condition", ["is_continuous_switch[switch_index]", "run->counts.steps / 50 % 3 == 2"])
def test_phases_of_laws_whose_end_is_missed(condition: str, tmp_path: Path) -> None:
    """Phases whose forces meet at the switching point, such as those of the friction law, are checked as well."""
    press = gudgeon.load("nine_bar_press", "dry")
    wrong = mutant(press, tmp_path, (EVENTS, IGNORED, f"({condition} || switch_index == run->roots.suppressed_switch"))
    for method in METHODS:
        assert "check branch" in reported(wrong, 0.03, **settings(method, 1e-5)), method


QUIET = (
    ("nine_bar_press", "dry", 0.05, 1e-5),
    ("nine_bar_press", "lubricated", 0.05, 1e-5),
    ("guided_slider_crank", "hard", 0.05, 1e-5),
    ("bouncing_ball", "damped", 2.0, 1e-5),
    ("belt_block", "ideal", 5.0, 1e-3),
)


@pytest.mark.parametrize(("name", "scene", "t_end", "step"), QUIET)
def test_right_runs_hold_the_conditions_of_their_states(name: str, scene: str, t_end: float, step: float) -> None:
    """Contacts that separate, graze and rest, and sticking friction, with drawn tolerances, steps and parameters."""
    rng = np.random.default_rng(sum(map(ord, name + scene)))
    simulation = gudgeon.load(name, scene)
    for method in simulation.source.methods:
        slot = simulation.source.parameters[int(rng.integers(len(simulation.source.parameters)))]
        how: dict[str, Any] = {"step": step} if method == "rk4" else {"rtol": 10.0 ** -float(rng.integers(4, 11))}
        values = {slot.address: slot.default * rng.uniform(0.999, 1.001)}
        run = simulation.simulate(t_end, output=20, method=method, audit="full", parameters=values, **how)
        findings = {one.check: one.worst for one in run.diagnostics.audit if one.check in STATES}
        assert max(findings.values()) < 0.3, (method, how, values, findings)

"""States at events: what closed forms say there, at the located times and not at the samples beside them."""

from __future__ import annotations

import pickle
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import GudgeonError, UnknownNameError
from gudgeon.results.results import Result
from tests.programs import needs_compiler
from tests.pump import TEXT as PUMP
from tests.valve import valve

pytestmark = needs_compiler
METHODS: list[dict[str, Any]] = [
    {},
    {"rtol": 1e-11},
    {"method": "rodas5p"},
    {"method": "rk4", "step": 1e-3},
    {"method": "dop853", "step": 1e-3},
]
W, TOP, STROKE = 7.0, 25e-3, 30e-3


def expect_closed_form(run: Result, tolerance: float = 1e-9) -> None:
    """lifter: x = 30 mm sin(w t); rising at sin = 25/30 with ẋ > 0, turn at ẋ = 0."""
    rising, turn = run.at_events("rising"), run.at_events("turn")
    assert (len(rising), len(turn)) == (3, 4)
    assert repr(rising).startswith("3 states at 'rising': t = ") and repr(rising).endswith(" s")
    np.testing.assert_array_equal(rising.t, run.events_of("rising"))
    np.testing.assert_allclose(rising["follower.x"], TOP, rtol=0, atol=tolerance * STROKE)
    np.testing.assert_allclose(rising["lift"], 2 * TOP, rtol=0, atol=2 * tolerance * STROKE)
    np.testing.assert_allclose(rising["follower.vx"], W * np.sqrt(STROKE**2 - TOP**2), atol=10 * tolerance)
    np.testing.assert_allclose(turn["follower.vx"], 0.0, atol=10 * tolerance)
    np.testing.assert_allclose(turn["follower.ax"], -(W**2) * turn["follower.x"], atol=100 * tolerance)
    assert turn.q.shape == turn.v.shape == (4, 9)


@pytest.mark.parametrize("formulation", ["reduced", "full"])
@pytest.mark.parametrize("options", METHODS, ids=str)
def test_states_at_events_are_those_of_closed_forms(options: dict[str, Any], formulation: str, tmp_path: Path) -> None:
    """With five samples: none is near an event."""
    expect_closed_form(valve(tmp_path, formulation=formulation).simulate(2.0, output=5, **options), 1e-7)


def test_states_of_a_scene_without_a_freedom(tmp_path: Path) -> None:
    expect_closed_form(valve(tmp_path, kinematic=True).simulate(2.0, output=5), 1e-9)


@pytest.mark.parametrize("kinematic", [False, True])
def test_states_at_events_are_those_of_samples_there(kinematic: bool, tmp_path: Path) -> None:
    """Every series, works and the energy residual too: a run that has samples at these times."""
    simulation = valve(tmp_path, kinematic=kinematic)
    run = simulation.simulate(2.0, output=5, rtol=1e-11)
    times = np.concatenate([[0.0], run.events["t"], [2.0]])
    sampled = simulation.simulate(output=times, rtol=1e-11)
    for name in run.names:
        scale = "energy.kinetic" if name == "energy.residual" else name
        size = float(np.abs(sampled[scale]).max()) + 1e-6
        np.testing.assert_allclose(
            run.states_at_events[name], sampled[name][:-1], rtol=0, atol=1e-7 * size, err_msg=name
        )


def test_the_state_at_the_event_that_ends_a_run_is_its_last_sample(tmp_path: Path) -> None:
    file = tmp_path / "pump.yaml"
    file.write_text(PUMP + "events: {reached: {zero: piston.x - 0.13, action: stop}}\n")
    run = gudgeon.load(file, "worn").simulate(0.1)
    at = run.at_events("reached")
    assert len(at) == 1 and repr(at) == f"1 state at 'reached': t = {run.t[-1]:.6g} s"
    for name in run.names:
        np.testing.assert_allclose(at[name][0], run[name][-1], rtol=1e-9, atol=1e-9, err_msg=name)


@pytest.mark.parametrize("options", [{}, {"method": "rk4", "step": 2e-6}], ids=str)
def test_contacts_at_events_are_those_of_a_trace(options: dict[str, Any], tmp_path: Path) -> None:
    """An event on the journal's way within a contact has the force that the law gives there."""
    file = tmp_path / "pump.yaml"
    file.write_text(PUMP + "events: {turn: {zero: piston.vx}}\n")
    run = gudgeon.load(file, "worn").simulate(0.3, **options)
    at = run.states_at_events
    assert len(at.t) > 2
    np.testing.assert_array_equal(at["B.state"] > 0, np.isfinite(at["B.deltadot_minus"]))
    closed = at["B.delta"] > 0
    np.testing.assert_array_equal(closed[1:], (at["B.state"] > 0)[1:])


def test_a_run_without_the_event_has_no_state_and_a_wrong_name_is_told(tmp_path: Path) -> None:
    run = valve(tmp_path).simulate(0.05, output=5)
    at = run.at_events("turn")
    assert (len(at), at["follower.ax"].shape, at.q.shape) == (0, (0,), (0, 9))
    with pytest.raises(UnknownNameError, match="rising"):
        run.at_events("risin")
    with pytest.raises(UnknownNameError, match=r"follower\.vx"):
        at["follower.vvx"]


@pytest.mark.parametrize("options", [{}, {"method": "rk4", "step": 1e-3}, {"kinematic": True}], ids=str)
def test_batches_have_the_states_of_their_runs_bit_for_bit(options: dict[str, Any], tmp_path: Path) -> None:
    own = dict(options)
    simulation, speeds = valve(tmp_path, own.pop("kinematic", False)), [5.0, 7.0, 9.0, 11.0, 13.0]
    batch = simulation.simulate_many({"w": speeds}, 2.0, output=5, **own)
    for w, at in zip(speeds, batch.at_events("rising"), strict=True):
        alone = simulation.simulate(2.0, output=5, parameters={"w": w}, **own).at_events("rising")
        assert at is not None and len(at) == len(alone) > 1
        for name in ("t", *alone):
            assert at[name].tobytes() == alone[name].tobytes(), name


@pytest.mark.parametrize("kinematic", [False, True])
def test_files_and_pickles_bring_the_states_along(kinematic: bool, tmp_path: Path) -> None:
    pytest.importorskip("h5py")
    run = valve(tmp_path, kinematic).simulate(2.0, output=5)
    run.save(tmp_path / "run.nc")
    for back in (Result.load(tmp_path / "run.nc"), pickle.loads(pickle.dumps(run))):
        for event in ("rising", "turn"):
            ours, theirs = run.at_events(event), back.at_events(event)
            for name in ("t", *ours):
                assert ours[name].tobytes() == theirs[name].tobytes(), name
            assert (ours.q.tobytes(), ours.v.tobytes()) == (theirs.q.tobytes(), theirs.v.tobytes())


def test_a_file_from_before_says_so(tmp_path: Path) -> None:
    run = replace(valve(tmp_path).simulate(2.0, output=5), compiled=None, event_states=None)
    with pytest.raises(GudgeonError, match="run the scene again"):
        run.at_events("turn")

"""`simulate(output=[…])` returns exactly the requested times; the start, where it is not among them, is `start_row`."""

from __future__ import annotations

import pickle
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError, InputError, SolverError
from gudgeon.results.batch import Batch
from gudgeon.results.results import Result
from gudgeon.simulation.predictability_horizon import compute_horizon
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler

pytestmark = needs_compiler
PENDULUM = """\
format: gudgeon/1
name: pendulum
gravity: [0, -9.81]
bodies: {bob: {mass: 1 kg, inertia: 0.1 kg*m^2, points: {O: [-1 m, 0]}}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, bob.O]}}
start: {set: {bob.theta: 0}}
outputs: {per_time: bob.theta/t}
events: {low: {zero: bob.theta + 90 deg, action: stop}}
"""
TIMES = [0.2, 0.25, 0.5]
SCENES = [
    ("nine_bar_press", "dry", [0.001, 0.002, 0.005]),
    ("nine_bar_press", "ideal", [0.01, 0.03]),
    ("belt_block", "ideal", TIMES),
    ("slider_crank", "ideal", TIMES),
]


@cache
def scene(name: str, of: str) -> Simulation:
    return gudgeon.load(name, of)


def same(run: Result | None, other: Result | None, rows: Any = slice(None)) -> None:
    """All series of both are equal bit for bit."""
    assert run is not None and other is not None
    for name in ("t", *run.names):
        np.testing.assert_array_equal(run[name], other[name][rows], name)


@pytest.mark.parametrize(("name", "of", "times"), SCENES)
def test_samples_are_the_requested_times(name: str, of: str, times: list[float], tmp_path: Path) -> None:
    simulation = scene(name, of)
    whole, run = simulation.simulate(output=[0.0, *times]), simulation.simulate(output=times)
    assert run.t.tolist() == times and whole.start_row is None and run.start_row is not None
    same(run, whole, slice(1, None))
    same(run.start_row, whole, slice(1))
    run.save(tmp_path / "run.nc")
    for again in (Result.load(tmp_path / "run.nc"), pickle.loads(pickle.dumps(run))):
        same(again, run)
        same(again.start_row, run.start_row)
    run.to_csv(tmp_path / "run.csv")
    assert len((tmp_path / "run.csv").read_text().splitlines()) == 1 + len(times)
    assert run.to_xarray()["time"].values.tolist() == times
    assert run.report().to_dict()["t"] == [0.0, times[-1]]
    assert bool(run.check(500)) and gudgeon.examine(simulation, run).diagnostics.examined is not None


@pytest.mark.parametrize(("name", "of", "times"), SCENES)
@pytest.mark.parametrize("options", [{}, {"method": "rk4", "step": 1e-5}, {"side_by_side": False}])
def test_a_batch_has_the_requested_times(
    name: str, of: str, times: list[float], options: dict[str, Any], tmp_path: Path
) -> None:
    simulation, alone = scene(name, of), {key: options[key] for key in options if key != "side_by_side"}
    if options.get("method") and not simulation.source.degrees_of_freedom:
        pytest.skip("a driven motion has no step")
    run = simulation.simulate(output=times, **alone)
    batch = simulation.simulate_many([{}] * 3, output=times, **options)
    assert batch.t.tolist() == times and batch.samples.tolist() == [len(times)] * 3
    batch.save(tmp_path / "batch.nc")
    for found in (batch, Batch.load(tmp_path / "batch.nc")):
        for series in run.names:
            np.testing.assert_array_equal(found[series], np.tile(run[series], (3, 1)), series)
        same(found[1], run)
        same(found[1].start_row, run.start_row)
    names = [series for series in run.names if not series.startswith("lambda")]
    kept = simulation.simulate_many([{}] * 3, output=times, keep=names, **options)
    for series in ("t", *names):
        np.testing.assert_array_equal(kept[series][2], run[series], series)


def test_each_run_has_its_own_requested_times() -> None:
    rows = [[0.001, 0.002], [0.0, 0.001, 0.002], [0.005], []]
    simulation = scene("nine_bar_press", "dry")
    batch = simulation.simulate_many([{}] * 3, output=rows[:3])
    assert batch.samples.tolist() == [2, 3, 1] and batch.t.shape == (3, 3)
    for i, times in enumerate(rows[:3]):
        run = simulation.simulate(output=times)
        same(batch[i], run)
        np.testing.assert_array_equal(batch["energy.residual"][i, : len(times)], run["energy.residual"])
        assert np.isnan(batch.t[i, len(times) :]).all() and np.isnan(batch.q[i, len(times) :]).all()


def test_a_run_that_goes_on_has_the_requested_times() -> None:
    simulation = scene("nine_bar_press", "dry")
    first = simulation.simulate(output=[0.002])
    assert first.t.tolist() == [0.002]
    on = simulation.simulate(output=[0.003, 0.004], start=first.final)
    grid = simulation.simulate(0.004, output=2, start=first.final)
    assert on.t.tolist() == [0.003, 0.004] and grid.t.tolist() == [0.002, 0.003, 0.004] and grid.start_row is None
    assert on.start_row is not None and on.start_row.t.tolist() == [0.002]
    same(on, grid, slice(1, None))
    many = simulation.simulate_many([{}, {}], output=[0.003, 0.004], start=first.final)
    same(many[0], on)


@pytest.mark.parametrize(
    ("output", "message"),
    [
        ([0.5, 0.2], "expected increasing times"),
        ([0.2, 0.2], "expected increasing times"),
        ([-0.1, 0.2], "times begin at 0.0 s"),
        ([], "at least one time"),
        ([0.2, float("nan")], "finite"),
    ],
)
def test_times_that_are_refused(output: list[float], message: str) -> None:
    simulation = scene("slider_crank", "ideal")
    for call in (simulation.simulate, lambda **given: simulation.simulate_many([{}, {}], **given)):
        with pytest.raises(BadValueError, match=message):
            call(output=output)


def test_files_keep_the_given_start(tmp_path: Path) -> None:
    """The state that runs were given as `start` is read back bit for bit, and is None where there was none."""
    simulation = scene("nine_bar_press", "dry")
    first = simulation.simulate(output=[0.002])
    for start in (first.final, None):
        run = simulation.simulate(output=[0.003, 0.004], start=start)
        batch = simulation.simulate_many([{}, {}], output=[0.003, 0.004], start=start)
        run.save(tmp_path / "run.nc")
        batch.save(tmp_path / "batch.nc")
        for found in (Result.load(tmp_path / "run.nc"), Batch.load(tmp_path / "batch.nc")[1]):
            if start is None:
                assert found.given_start is None
                continue
            assert found.given_start is not None and found.given_start.t == start.t
            for name in ("q", "v", "state", "memory"):
                np.testing.assert_array_equal(getattr(found.given_start, name), getattr(start, name), name)
        assert bool(Result.load(tmp_path / "run.nc").check(100))


def test_a_count_and_times_of_other_types() -> None:
    """An array of no dimension is a count if it is whole; times of single precision end at the t_end they round to."""
    simulation = scene("slider_crank", "ideal")
    times = np.linspace(0.0, 0.1, 5, dtype=np.float32)
    for call in (simulation.simulate, lambda *given, **more: simulation.simulate_many([{}, {}], *given, **more)):
        assert len(call(0.1, output=np.array(20)).t) == 21
        for given in (times, list(times), times.astype(np.float16)):
            assert call(0.1, output=given).t.tolist() == [float(t) for t in given]
        for t_end, output in (
            (0.1, np.array(20.0)),
            (0.1, np.array(True)),
            (0.1, times.astype(float)),
            (0.1 + 1e-7, times),
            (0.1, [0, 1]),
        ):
            with pytest.raises(InputError, match="output"):
                call(t_end, output=output)


def test_a_run_that_an_event_ends(tmp_path: Path) -> None:
    """Its last sample is that of the event, also before the first requested time; t = 0 is not a sample."""
    file = tmp_path / "pendulum.yaml"
    file.write_text(PENDULUM)
    simulation = gudgeon.load(file)
    end = simulation.simulate(5.0).t[-1]
    for times, samples in (([0.2, 0.4, 5.0], [0.2, 0.4, end]), ([2.0, 5.0], [end])):
        run, batch = simulation.simulate(output=times), simulation.simulate_many([{}, {}], output=times)
        assert run.t.tolist() == pytest.approx(samples, abs=1e-9) and run.t[-1] == run.events_of("low")[0]
        assert run.at_events("low")["bob.theta"] == pytest.approx([-np.pi / 2]) and len(batch[0].t) == len(samples)
        assert batch.samples.tolist() == [len(samples)] * 2 and not any("per_time" in x for x in run.diagnostics.notes)
        np.testing.assert_array_equal(batch["t"][0, : len(samples)], run.t)


def test_a_run_that_fails_before_the_first_requested_time(tmp_path: Path) -> None:
    """What it reached is its only sample."""
    file = tmp_path / "pendulum.yaml"
    force = "forces: {push: {torque: [ground, bob], value: 1 N*m*sqrt(0.1 - t/(1 s))}}"
    file.write_text(f"{PENDULUM}{force}\n")
    simulation = gudgeon.load(file)
    each: tuple[dict[str, Any], ...] = ({}, {"method": "rk4", "step": 1e-3})
    for options in each:
        with pytest.raises(SolverError) as raised:
            simulation.simulate(output=[0.5, 1.0], **options)
        partial, batch = raised.value.partial, simulation.simulate_many([{}, {}], output=[0.5, 1.0], **options)
        assert partial is not None and len(partial.t) == 1 and partial.t[0] <= 0.1 + 1e-9
        assert len(batch.failures) == 2 and batch.samples.tolist() == [1, 1]
        same(batch.partial(1), partial)
        np.testing.assert_array_equal(batch["bob.theta"][:, 0], partial["bob.theta"][[0, 0]])
        batch.save(tmp_path / "batch.nc")
        same(Batch.load(tmp_path / "batch.nc").partial(1), partial)


def test_horizon_and_report_count_from_the_start() -> None:
    simulation = scene("nine_bar_press", "dry")
    run = simulation.simulate(output=[0.003, 0.006])
    whole = simulation.simulate(output=[0.0, 0.003, 0.006])
    assert compute_horizon(simulation, run) == compute_horizon(simulation, whole)
    reports = [one.report().to_dict()["joints"]["A"] for one in (run, whole)]
    assert reports[0] == reports[1]


def test_an_object_that_is_an_array_alone_is_one() -> None:
    class Alone:
        def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
            return np.array([0.1, 0.2])

    simulation, given = scene("slider_crank", "ideal"), [0.1, 0.2]
    assert simulation.simulate(output=Alone()).t.tolist() == given
    ends = simulation.simulate_many([{}, {}], Alone(), output=2)
    assert ends.t_last.tolist() == given

"""Batches: each run is bit for bit what it is alone, failures stop nobody, and mistakes are told in words."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

import gudgeon
from gudgeon.assembly.linkage import compute_mechanism_size
from gudgeon.assembly.start import assemble_start, search_start
from gudgeon.contract.boundary import IMPACT_COLUMN_NAMES, N_IMPACT_COLUMNS
from gudgeon.errors import BadValueError, GudgeonError, SolverError, UnknownNameError
from gudgeon.integrators import stored
from gudgeon.integrators.batch import Runs
from gudgeon.integrators.trajectory import IMPACT_DTYPE
from gudgeon.model.compiled import CompiledModel
from gudgeon.results.batch import Batch
from gudgeon.results.peaks import build_peak_records, is_rigid_impact
from gudgeon.results.results import Result
from tests.programs import needs_compiler

pytestmark = needs_compiler
HERE = Path(__file__).parent.parent
CLEARANCES = np.array([0.3e-3, 0.5e-3, 0.8e-3])
SPEEDS = np.pi * np.array([2.0, 5.0, 4.0])
ARRAYS = ("t", "q", "v", "a", "state", "memory", "work", "impacts", "events")
# scene, options of both calls; rk4's step is short enough for the film
CASES: list[tuple[str, dict[str, Any]]] = [
    ("dry", {"rtol": 1e-6}),
    ("lubricated", {}),
    ("dry", {"method": "rk4", "step": 2e-5}),
    ("lubricated", {"method": "rodas5p", "step": 1e-4}),
    ("ideal", {}),
    ("dry", {"method": "scipy:LSODA", "rtol": 1e-5}),
]


def press_runs(scene: str, options: dict[str, Any], **more: Any) -> tuple[gudgeon.Simulation, Batch]:
    simulation = gudgeon.load("nine_bar_press", scene=scene)
    parameters: dict[str, Any] = {"omega": SPEEDS, "gravity.y": 0.0}
    parameters |= {} if scene == "ideal" else {"c": CLEARANCES}
    return simulation, simulation.simulate_many(parameters, 0.03, output=12, **options, **more)


def assert_same(one: Result, other: Result) -> None:
    for name in ARRAYS:
        assert getattr(one, name).tobytes() == getattr(other, name).tobytes(), name
    timeless: dict[str, Any] = {"seconds": 0.0, "seconds_per_simulated_second": 0.0}
    assert str(replace(one.diagnostics, **timeless)) == str(replace(other.diagnostics, **timeless))


@pytest.mark.parametrize(("scene", "options"), [*CASES[:-1], pytest.param(*CASES[-1], marks=pytest.mark.slow)])
def test_runs_are_bit_for_bit_those_made_alone(scene: str, options: dict[str, Any]) -> None:
    simulation, batch = press_runs(scene, options, threads=2)
    assert not batch.failures and len(batch) == 3 and batch.q.shape == (3, 13, 24)
    for i, (c, omega) in enumerate(zip(CLEARANCES, SPEEDS, strict=True)):
        parameters = {"omega": omega, "gravity.y": 0.0} | ({} if scene == "ideal" else {"c": c})
        alone = simulation.simulate(0.03, output=12, parameters=parameters, **options)
        assert_same(batch[i], alone)
        assert batch.q[i].tobytes() == alone.q.tobytes()
        assert batch["S9.y"][i].tobytes() == alone["S9.y"].tobytes()
        peaks = [(peak.F, peak.first_contact) for peak in alone.diagnostics.peaks]
        np.testing.assert_array_equal([(peak["F"], peak["first_contact"]) for peak in batch.peaks[i]], peaks)
        assert batch.diagnostics["steps"][i] == alone.diagnostics.steps


def test_a_run_whose_end_is_too_far_ends_as_alone() -> None:
    """With the pace of its last steps in the error, and the state that was reached as the last sample."""
    pendulum = gudgeon.load("pendulum", quick=False)
    with pytest.raises(SolverError, match="at the pace of its last 32768 steps") as alone:
        pendulum.simulate(1e13, output=2, method="dop853")
    batch = pendulum.simulate_many({"g": [9.81]}, 1e13, output=2, method="dop853")
    run = batch.partial(0)
    assert run is not None and str(batch.failures[0].error) == str(alone.value)
    assert_same(run, alone.value.partial)
    assert batch.t_last[0] == run.t[-1] == alone.value.partial.t[-1] > 1e3


def test_no_more_threads_than_runs() -> None:
    pendulum = gudgeon.load("pendulum")
    assert pendulum.simulate_many({"g": [9.0, 10.0]}, 0.1, output=2, threads=3).threads == 2


def test_any_number_of_threads_gives_identical_bytes() -> None:
    one, three = (press_runs("dry", {"rtol": 1e-6}, threads=threads)[1] for threads in (1, 3))
    for name in ("q", "v", "work", "state", "peaks", "samples", "t_last"):
        assert getattr(one, name).tobytes() == getattr(three, name).tobytes(), name
    assert [x.tobytes() for x in one.impacts] == [x.tobytes() for x in three.impacts]
    assert (one.onsets.sum(axis=1) == one.diagnostics["onsets"]).all() and one.onsets.sum() > 0


def test_more_contacts_than_the_list_of_c_holds() -> None:
    """A ball that loses nothing falls from 1 mm again and again, 28.6 ms apart."""
    simulation = gudgeon.load("bouncing_ball", scene="elastic")
    options: dict[str, Any] = {"method": "rk4", "step": 2e-5, "output": 4}
    batch = simulation.simulate_many({"height": [1e-3, 1.2e-3]}, 9.5, **options)
    assert len(batch.impacts[0]) > 300
    assert_same(batch[0], simulation.simulate(9.5, parameters={"height": 1e-3}, **options))


def test_contacts_that_come_in_any_order_are_each_runs_own_by_onset(monkeypatch: pytest.MonkeyPatch) -> None:
    """As threads fetch them, into blocks: lists of several runs mixed, some out of order, equal onsets as they came."""

    def listed(run: list[Any], last: bool, capacity: int, numbers: Any, joints: Any) -> int:
        own, run[:] = run[:capacity], run[capacity:]
        for k, contact in enumerate(own):
            joints[k] = contact["joint"]
            first = N_IMPACT_COLUMNS * k
            numbers[first : first + N_IMPACT_COLUMNS] = [float(contact[name]) for name in IMPACT_COLUMN_NAMES]
        return len(own)

    monkeypatch.setattr(stored, "FIRST_BLOCK_CONTACTS", 21)
    monkeypatch.setattr(stored, "BLOCK_CONTACTS", 21)
    lib, pointer = SimpleNamespace(gudgeon_run_impacts=listed), gudgeon.load("bouncing_ball", "damped").compiled.pointer
    fetched = stored.Contacts(cast(CompiledModel, SimpleNamespace(lib=lib, pointer=pointer)))
    rng, runs, each = np.random.default_rng(5), Runs.__new__(Runs), [list[np.ndarray]() for _ in range(9)]
    threads = [ThreadPoolExecutor(1), ThreadPoolExecutor(1)]
    for i in rng.integers(0, 8, 60).tolist():
        own = np.zeros(rng.integers(0, 4), IMPACT_DTYPE)
        own["joint"], own["F_peak"] = rng.integers(0, 3, len(own)), rng.random(len(own))
        own["t_on"] = len(each[i]) if i < 4 else rng.integers(0, 5, len(own))
        own["t_off"] = own["t_on"] + rng.integers(0, 2, len(own))
        threads[i % 2].submit(fetched.fetch_contacts, i, list(own), True).result()
        each[i].append(own)
    assert len(fetched.thread_contacts) == 2 and all(own.full_blocks for own in fetched.thread_contacts)
    runs.python_lists = {}  # none by a method in Python
    runs.contacts, runs.first_contact_indices = fetched.join_contacts(9)
    whole = [np.concatenate([np.zeros(0, IMPACT_DTYPE), *several]) for several in each]
    expected = [own[np.argsort(own["t_on"], kind="stable")] for own in whole]
    assert [x.tobytes() for x in runs.list_contacts()] == [x.tobytes() for x in expected]
    assert [runs.get_contacts(i).tobytes() for i in range(9)] == [x.tobytes() for x in expected]
    peaks = build_peak_records(np.zeros((9, 4, 3)), runs.contacts, np.diff(runs.first_contact_indices))
    for i, k in np.ndindex(9, 4):
        first = expected[i][expected[i]["joint"] == k][:1]
        force = np.where(is_rigid_impact(first), np.nan, first["F_peak"])
        np.testing.assert_array_equal(peaks["first_contact"][i, k], first["t_on"][0] if len(first) else np.nan)
        np.testing.assert_array_equal(peaks["first_peak"][i, k], force[0] if len(first) else np.nan)


def test_a_run_that_fails_stops_no_other() -> None:
    simulation = gudgeon.load("nine_bar_press", scene="lubricated")
    sets: list[dict[str, float | str]] = [{"c": 0.1e-3}, {"c": -1.0}, {"c": 0.8e-3}, {"bodies.L2.length": "5 m"}]
    batch = simulation.simulate_many(sets, 5e-3, output=10, method="rk4", step=4e-4)
    assert [failure.run for failure in batch.failures] == [0, 1, 3]  # the film of .1 mm asks for far shorter steps
    film = "no longer finite|diverged|deep in its bearing"
    words = (film, "bearings.pin.clearance|parameters.c", "cannot be assembled")
    for failure, expected in zip(batch.failures, words, strict=True):
        with pytest.raises(GudgeonError, match=expected):
            batch[failure.run]
    assert np.isfinite(batch.q[2]).all() and np.isnan(batch.q[[1, 3]]).all()
    assert batch.samples[2] == 11 and 0 < batch.samples[0] < 11
    assert np.isnan(batch.q[0, batch.samples[0] :]).all()
    with pytest.raises(GudgeonError) as alone:
        simulation.simulate(5e-3, output=10, method="rk4", step=4e-4, parameters=sets[0])
    assert str(alone.value) == str(batch.failures[0].error)
    partial = batch.partial(0)
    assert partial is not None
    assert_same(partial, alone.value.partial)  # type: ignore[attr-defined]
    assert np.isnan(batch["S9.y"][0, batch.samples[0] :]).all()


def test_columns_rows_and_structured_arrays_are_the_same() -> None:
    simulation = gudgeon.load("four_bar")
    omega = [1.0, 2.0]
    address = next(slot.address for slot in simulation.source.parameters if slot.unit in ("1/s", "rad/s"))
    table = np.array([(w,) for w in omega], dtype=[(address, "f8")])
    sets: tuple[Any, ...] = ({address: omega}, {address: np.array(omega)}, [{address: w} for w in omega], table)
    first, *others = [simulation.simulate_many(given, 0.1, output=5) for given in sets]
    assert all(first.q.tobytes() == other.q.tobytes() for other in others)
    assert list(first.parameters) == [address] and first.parameters[address].tolist() == omega


def test_an_event_that_ends_a_run_ends_only_that_one(tmp_path: Path) -> None:
    file = tmp_path / "fall.yaml"
    file.write_text(
        """\
format: gudgeon/1
name: fall
gravity: [0, -g]
parameters: {g: 10 m/s^2}
bodies: {ball: {mass: 1 kg, inertia: 1 kg*m^2}}
start: {set: {ball.x: 0, ball.y: 5 m, ball.theta: 0}}
events: {floor: {zero: ball.y, action: stop}}
""",
        encoding="utf-8",
    )
    simulation = gudgeon.load(file)
    batch = simulation.simulate_many({"g": [1.0, 10.0, 40.0]}, 2.0, output=7)
    assert batch.t_last == pytest.approx([2.0, 1.0, 0.5], abs=1e-9) and not batch.failures
    assert batch.samples.tolist() == [8, 5, 3]  # outputs every 2/7 s, and the end
    for i, g in enumerate((1.0, 10.0, 40.0)):
        assert_same(batch[i], simulation.simulate(2.0, output=7, parameters={"g": g}))


MISTAKES: list[tuple[Any, dict[str, Any], str]] = [
    ({"c": [1e-3, 2e-3], "omega": [1.0, 2.0, 3.0]}, {}, "different lengths: c has 2, omega has 3"),
    ({"c": np.zeros((2, 2))}, {}, r"c has shape \(2, 2\)"),
    ([], {}, "at least one run"),
    ([1.0], {}, "a mapping for every run"),
    ({"c": 1e-3}, {"threads": 0}, "threads is 0"),
    ({"c": 1e-3}, {"step": -1.0}, "positive"),
]


@pytest.mark.parametrize(("parameters", "options", "words"), MISTAKES)
def test_mistakes_are_told_before_anything_runs(parameters: Any, options: dict[str, Any], words: str) -> None:
    with pytest.raises(BadValueError, match=words):
        gudgeon.load("nine_bar_press", scene="dry").simulate_many(parameters, 1e-3, **options)


def test_unknown_names_are_told_with_the_nearest() -> None:
    with pytest.raises(UnknownNameError, match="omega"):
        gudgeon.load("nine_bar_press", scene="dry").simulate_many({"omeg": [1.0]}, 1e-3)


def test_interruption_keeps_what_was_computed() -> None:
    simulation = gudgeon.load("nine_bar_press", scene="dry")

    def interrupt(fraction: float, what: str) -> None:
        raise KeyboardInterrupt

    batch = simulation.simulate_many({"c": [0.3e-3] * 40}, 100.0, output=10, rtol=1e-10, threads=1, progress=interrupt)
    assert batch.interrupted and len(batch.failures) == 40
    with pytest.raises(GudgeonError, match="interrupted"):
        batch[39]


def test_to_xarray() -> None:
    pytest.importorskip("xarray")
    _, batch = press_runs("dry", {"rtol": 1e-6})
    data = batch.to_xarray(["L1.head.x"])
    assert dict(data.sizes) == {"run": 3, "time": 13}
    table = data.to_dataframe()
    assert len(table) == 3 * 13
    for i in range(3):
        run, own = batch[i], table.xs(i, level="run")
        assert (own["parameters.c"] == CLEARANCES[i]).all() and (own["samples"] == len(run.t)).all()
        for name in ("L1.head.x", "S9.y", "S9.vy", "L2.theta", "L2.omega", "work.drives"):
            np.testing.assert_array_equal(own[name], run[name])
        assert (own["A.peak.F"] == run.diagnostics.peak("A").F).all()


@pytest.mark.parametrize("name", ["nine_bar_press", "andrews_squeezer", "four_bar", "slider_crank", "belt_block"])
def test_the_start_closed_in_c_is_that_of_the_search(name: str) -> None:
    simulation = gudgeon.load(name)
    compiled, p = simulation.compiled, simulation.p
    assert compiled.close_linkage(0.0, p, compute_mechanism_size(compiled, p)) is not None
    quick, sought = assemble_start(compiled, p), search_start(compiled, p)
    size = np.where(
        [c.endswith(".theta") for c in simulation.source.coordinates], 1.0, compute_mechanism_size(compiled, p)
    )
    assert np.abs((quick.q - sought.q) / size).max() < 1e-13
    assert np.abs(quick.v - sought.v).max() <= 1e-12 * np.abs(sought.v).max(initial=0.0)


def test_a_guess_that_closes_dependent_rows_is_the_start() -> None:
    simulation = gudgeon.load("pendulum")  # what holds the bob sideways and what holds its distance agree there
    compiled, p = simulation.compiled, simulation.p
    closed = compiled.close_linkage(0.0, p, compute_mechanism_size(compiled, p))
    assert closed is not None and closed[0].tolist() == [1.0, 0.0, 0.0] and not closed[1].any()
    batch = simulation.simulate_many({"g": [9.81, 5.0]}, 0.5, output=3)
    assert_same(batch[1], simulation.simulate(0.5, output=3, parameters={"g": 5.0}))

"""Batches of which only some series are kept: the same bits as those of the states, in the room of the series alone."""

from __future__ import annotations

import pickle
import tracemalloc
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import GudgeonError, SingularError, UnknownNameError
from gudgeon.integrators import lanes
from gudgeon.results.batch import Batch
from gudgeon.simulation import stored_series
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler
from tests.valve import valve

pytestmark = needs_compiler
KEPT = ("S9.ay", "A.F", "energy.residual", "A.state", "L1.head.x", "A.deltadot_minus")
C = {"c": [3e-4, 4e-4, -1.0, 5e-4, 6e-4, 8e-4, 7e-4]}
BESIDE = ("samples", "t_last", "peaks")


@cache
def press(scene: str = "dry") -> Simulation:
    return gudgeon.load("nine_bar_press", scene)


def same(kept: Batch, whole: Batch, names: tuple[str, ...]) -> None:
    for name in (*names, "t"):
        assert kept[name].tobytes() == whole[name].tobytes(), name
    for name in BESIDE:
        assert getattr(kept, name).tobytes() == getattr(whole, name).tobytes(), name
    for name in ("impacts", "events"):
        assert [x.tobytes() for x in getattr(kept, name)] == [x.tobytes() for x in getattr(whole, name)]
    assert list(map(str, kept.failures)) == list(map(str, whole.failures))
    assert kept.diagnostics["steps"].tobytes() == whole.diagnostics["steps"].tobytes()


METHODS: list[dict[str, Any]] = [
    {"rtol": 1e-6},
    {"method": "rk4", "step": 5e-6},
    {"method": "rk4", "step": 5e-6, "side_by_side": False},
    {"method": "rk4", "step": 2e-5},
    {"rtol": 1e-6, "t_end": np.linspace(0.004, 0.012, 7)},
]


@pytest.mark.parametrize("options", METHODS)
@pytest.mark.parametrize("threads", [1, 3])
def test_the_same_bits_as_from_states(options: dict[str, Any], threads: int) -> None:
    """With the longest step runs end before their time."""
    given = {"t_end": 0.012, "output": 30, "threads": threads} | options
    kept, whole = (press().simulate_many(C, **given, keep=keep) for keep in (KEPT, "states"))
    assert 2 in [failure.run for failure in kept.failures] and whole.samples.max() == 31 and whole.onsets.any()
    same(kept, whole, KEPT)


def test_a_step_that_is_too_long_leaves_what_was_reached() -> None:
    given: dict[str, Any] = {"t_end": 0.02, "output": 50, "method": "rk4", "step": 4e-4}
    thin = {"c": [1e-4, *C["c"]]}
    kept, whole = (press("lubricated").simulate_many(thin, **given, keep=keep) for keep in (["S9.y"], "states"))
    assert (kept.samples < 51).sum() > 1 and kept.samples.max() > 1
    same(kept, whole, ("S9.y",))


@pytest.mark.parametrize(
    ("scene", "options"), [("ideal", {}), ("dry", {"method": "scipy:DOP853", "rtol": 1e-5}), ("ideal", {"step": 1e-3})]
)
def test_methods_without_a_loop_in_c(scene: str, options: dict[str, Any]) -> None:
    names = ("S9.ay", "energy.kinetic", "crank1.torque")
    given = {"t_end": 0.003, "output": 5, **options}
    columns = {"omega": [6.0, 7.0]} if scene == "ideal" else {"c": [3e-4, -1.0]}
    kept, whole = (press(scene).simulate_many(columns, **given, keep=keep) for keep in (names, "states"))
    same(kept, whole, names)


def test_starts_that_only_the_search_closes() -> None:
    swing = gudgeon.load("pendulum")
    given: dict[str, Any] = {"t_end": 0.5, "output": 3, "threads": 2}
    kept, whole = (swing.simulate_many({"g": [9.81, 5.0, 3.0]}, **given, keep=k) for k in (["bob.x"], "states"))
    assert np.isfinite(kept["bob.x"]).all()
    same(kept, whole, ("bob.x",))


@pytest.fixture(scope="module")
def some() -> Batch:
    return press().simulate_many(C, 0.012, output=20, rtol=1e-6, keep=["S9.y", "A.F"])


def test_what_was_not_kept_is_told(some: Batch) -> None:
    calls: list[Any] = [
        lambda: some["S9.vy"],
        lambda: some[0],
        lambda: some.q,
        lambda: some.state,
        lambda: some.partial(1),
        lambda: some.to_xarray(["A.e"]),
        lambda: some.to_dataframe(["S9.x"]),
        lambda: some.to_xarray(part="trace"),
        lambda: press().simulate_many(C, 1e-4, output=1, keep=[])["S9.y"],
    ]
    for call in calls:
        with pytest.raises(GudgeonError, match=r"stored.*\n.*keep="):
            call()
    with pytest.raises(UnknownNameError, match=r"S9\.y"):
        some["S9.yy"]
    assert "no series stored" in repr(press().simulate_many(C, 1e-4, output=1, keep=[])) and "S9.y, A.F" in repr(some)
    with pytest.raises(IndexError):
        some[7]


@pytest.mark.parametrize(
    ("keep", "words"),
    [("stats", "nothing named 'stats'"), (["S9.why"], "S9.why"), ([1], "keep"), (None, "keep"), (3, "keep")],
)
def test_what_cannot_be_kept_is_refused(keep: Any, words: str) -> None:
    with pytest.raises(GudgeonError, match=words):
        press().simulate_many(C, 0.001, keep=keep)


def test_tables_and_files_have_what_was_kept(some: Batch, tmp_path: Path) -> None:
    pytest.importorskip("xarray")
    pytest.importorskip("h5py")
    data, frame = some.to_xarray(), some.to_dataframe()
    assert {"S9.y", "A.F", "A.peak.F"} <= {*map(str, data)} and "S9.vy" not in data
    np.testing.assert_array_equal(data["A.F"], some["A.F"])
    assert list(frame)[-3:] == ["t", "S9.y", "A.F"] and len(frame) == some.samples.sum()
    np.testing.assert_array_equal(some.to_xarray(part="impacts")["t_on"], np.concatenate(some.impacts)["t_on"])
    some.save(tmp_path / "batch.nc")
    for back in (Batch.load(tmp_path / "batch.nc"), pickle.loads(pickle.dumps(some))):
        same(back, some, ("S9.y", "A.F"))
        with pytest.raises(GudgeonError, match="stored"):
            back[0]
    with pytest.raises(GudgeonError, match="stored"):
        Batch.load(tmp_path / "batch.nc")["S9.vy"]


def test_events_of_runs_are_there(tmp_path: Path) -> None:
    pytest.importorskip("h5py")
    batch = valve(tmp_path).simulate_many({"w": [5.0, 7.0]}, 2.0, output=7, keep=["lift"])
    assert all(map(len, batch.events))
    batch.save(tmp_path / "batch.nc")
    same(Batch.load(tmp_path / "batch.nc"), batch, ("lift",))
    with pytest.raises(GudgeonError, match="not stored"):
        batch.at_events("rising")


def test_a_sample_that_has_no_accelerations_is_a_failure_of_its_own_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of several runs that are evaluated at once nobody says which one it is."""
    many, speeds = stored_series.evaluate_runs, np.linspace(20.0, 30.0, 17)
    seen = list[int]()

    def singular(compiled: Any, counts: list[int], *rest: Any) -> Any:
        seen.append(len(counts))
        assert many(compiled, counts, *rest).a.shape == (sum(counts), compiled.n)
        raise SingularError("a pivot vanished", 0.0, "A.x")

    monkeypatch.setattr(stored_series, "evaluate_runs", singular)
    monkeypatch.setattr(lanes, "MIN_REMAINING_S", 0.0)
    kept, whole = (
        press().simulate_many({"omega": speeds}, 0.004, output=9, keep=keep) for keep in (["S9.ay"], "states")
    )
    assert seen and max(seen) > 1
    same(kept, whole, ("S9.ay",))


def test_states_of_all_runs_are_never_there_at_once() -> None:
    """120 runs of 1,501 samples: 27 coordinates and as many velocities would be 80 MB, two series are 3 MB."""
    tracemalloc.start()
    try:
        batch = press("lubricated").simulate_many(
            {"c": np.linspace(4e-4, 8e-4, 120)}, 0.001, output=1500, keep=["S9.y", "A.F"], threads=2
        )
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert not batch.failures and np.isfinite(batch["A.F"]).all()
    states = 120 * 1501 * 2 * len(batch.source.coordinates) * 8
    assert most < states / 3
    assert len(pickle.dumps(batch)) < states / 3

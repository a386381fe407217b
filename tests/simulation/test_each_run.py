"""Times and steps of a batch's runs: one for all or one a run, each run the same as it is alone."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError, GudgeonError, InputError
from gudgeon.integrators.times import Times
from gudgeon.results.batch import Batch
from gudgeon.simulation.simulation import Simulation
from tests.programs import needs_compiler
from tests.simulation.test_many import assert_same

pytestmark = needs_compiler
SPEEDS = (60.0, 75.0, 60.0, 60.0, 75.0)
EIGHTH = 8.0  # of a turn; of cross-checks less


@cache
def press(scene: str = "dry") -> Simulation:
    return gudgeon.load("nine_bar_press", scene)


OPTIONS: list[Any] = [
    ("dry", {"rtol": 1e-6}),
    ("dry", {"method": "dop853", "step": 1e-6}),
    ("dry", {"method": "rk4", "step": 5e-6}),
    ("dry", {"method": "rk4", "step": 5e-6, "side_by_side": False}),
    ("ideal", {}),
    pytest.param("dry", {"method": "scipy:DOP853", "rtol": 1e-4}, marks=[pytest.mark.plain, pytest.mark.slow]),
]


@pytest.mark.parametrize(("scene", "options"), OPTIONS)
def test_an_end_that_follows_the_numbers_of_each_run(scene: str, options: dict[str, Any]) -> None:
    part = 1000.0 if "scipy" in options.get("method", "") else EIGHTH
    batch = press(scene).simulate_many({"omega": SPEEDS}, f"2*pi/{part}/omega", output=9, threads=2, **options)
    assert not batch.failures and batch.t.shape == batch.times.shape == (5, 10)
    alone = {name: value for name, value in options.items() if name != "side_by_side"}
    for i, omega in enumerate(SPEEDS[:3]):
        run = press(scene).simulate(2.0 * math.pi / part / omega, output=9, parameters={"omega": omega}, **alone)
        np.testing.assert_array_equal(batch.t[i], run.t)
        np.testing.assert_array_equal(batch["t"][i], run.t)
        assert_same(batch[i], run)
        assert batch.q[i].tobytes() == run.q.tobytes() and batch.t_last[i] == run.t[-1]
        assert batch["S9.ay"][i].tobytes() == run["S9.ay"].tobytes()


def test_times_of_each_run_may_be_of_different_numbers() -> None:
    times: list[Any] = [np.linspace(0.0, 0.004, 5), [0.001, 0.002], (0.0, 0.001, 0.006)]
    batch = press().simulate_many({"c": 4e-4}, output=times)
    assert batch.t.shape == (3, 5) and batch.samples.tolist() == [5, 2, 3]
    for i, own in enumerate(times):
        run = press().simulate(output=own, parameters={"c": 4e-4})
        assert_same(batch[i], run)
        assert np.isnan(batch.t[i, len(run.t) :]).all() and np.isnan(batch.q[i, len(run.t) :]).all()
        np.testing.assert_array_equal(batch.t[i, : len(run.t)], run.t)
        np.testing.assert_array_equal(batch["A.F"][i, : len(run.t)], run["A.F"])
        np.testing.assert_array_equal(batch["A.state"][i], [*run["A.state"], *[np.nan] * (5 - len(run.t))])
    table = np.array([[0.0, 0.001, 0.002], [0.0, 0.0015, 0.003]])
    rows = press().simulate_many({"c": [3e-4, 4e-4]}, output=table)
    np.testing.assert_array_equal(rows.t, table)


@pytest.mark.parametrize("given", [[0.004, 0.004], 0.004, "4 ms", ["4 ms", "0.004 s"], np.array([0.004, 0.004])])
def test_times_that_are_the_same_are_those_of_all(given: Any) -> None:
    batch = press().simulate_many({"c": [3e-4, 4e-4]}, given, output=4)
    assert batch.t.shape == (5,) and batch.times.shape == (2, 5)
    np.testing.assert_array_equal(batch.q, press().simulate_many({"c": [3e-4, 4e-4]}, 0.004, output=4).q)


@pytest.mark.parametrize("method", ["rk4", "dop853"])
def test_steps_of_each_run(method: str) -> None:
    steps: list[float | str] = [5e-6, "4 us", 1e-5, 1e-5]
    batch = press().simulate_many({"c": 4e-4}, 0.004, output=4, method=method, step=steps)
    assert batch.t.shape == (5,) and len({x.tobytes() for x in batch.q}) == 3
    for i, step in enumerate(steps):
        assert_same(batch[i], press().simulate(0.004, output=4, method=method, step=step, parameters={"c": 4e-4}))


@pytest.mark.parametrize("method", ["rk4", "dop853"])
def test_a_step_for_all_runs_is_that_of_each(method: str) -> None:
    """Of runs with the same times it is read once; a run that is left out has none of its own."""
    columns = {"c": [3e-4, -1.0, 4e-4]}
    one, three = (press().simulate_many(columns, 0.002, output=2, method=method, step=h) for h in (5e-6, [5e-6] * 3))
    assert one.q.tobytes() == three.q.tobytes() and one.failures == three.failures and len(one.failures) == 1
    with pytest.raises(BadValueError, match="^step 1e-30 s means more than"):
        press().simulate_many(columns, 0.002, output=2, method=method, step=1e-30)


def test_ends_of_runs() -> None:
    same = Times(np.array([0.0, 1.0, 2.0]), np.full(2, 3), np.zeros(2, int))
    own = Times.from_runs({1: (np.array([0.0, 3.0]), True), 2: (np.array([0.0, 1.0, 4.0]), True)}, 3)
    np.testing.assert_array_equal(same.get_ends(), [2.0, 2.0])
    np.testing.assert_array_equal(own.get_ends(), [np.nan, 3.0, 4.0])


def test_a_number_that_is_none_fails_its_own_run() -> None:
    nan, columns = math.nan, {"c": [3e-4, 4e-4]}
    good = press().simulate_many(columns, 0.002, output=2).q[0]
    cases: list[dict[str, Any]] = [
        {"t_end": [0.002, nan]},
        {"t_end": np.array([0.002, -math.inf])},
        {"t_end": 0.002, "method": "rk4"},
        {"output": [[0.0, 0.001, 0.002], [0.0, nan, 0.002]]},
        {"t_end": "0.001/(omega - 5)"},
    ]
    for case in cases:
        more = {"step": [5e-6, nan]} if "method" in case else {}
        given = columns | ({"omega": [6.0, 5.0]} if isinstance(case.get("t_end"), str) else {})
        batch = press().simulate_many(given, **({"output": 2} | case | more))
        assert [failure.run for failure in batch.failures] == [1], case
        assert "finite number" in str(batch.failures[0])
        if not more and given is columns:
            np.testing.assert_array_equal(batch.q[0, :3], good)
        with pytest.raises(GudgeonError, match="finite"):
            batch[1]
    with pytest.raises(BadValueError, match="t_end: nan is not"):
        press().simulate_many(columns, [nan, nan])


MISTAKES: list[tuple[dict[str, Any], str]] = [
    ({"t_end": [0.1, 0.2]}, "t_end has 2 values for 3 runs"),
    ({"t_end": []}, "t_end has 0 values for 3 runs"),
    ({"step": [1e-5]}, "step has 1 values for 3 runs"),
    ({"output": [[0.0, 1.0]]}, "output has 1 rows of times for 3"),
    ({"t_end": [0.1, 0.0, 0.1]}, "run 1: t_end is 0 s: expected a time after the start"),
    ({"t_end": [0.1, None, 0.1]}, "run 1: t_end is None"),
    ({"step": [1e-5, 1e-5, None]}, "run 2: step is None"),
    ({"step": [1e-5, -1e-5, 1e-5]}, "run 1: step is -1e-05 s: expected a positive time"),
    ({"t_end": [0.1, "3 kg", 0.1]}, r"run 1: .*time"),
    ({"t_end": "1/omga"}, "run 0: .*unknown name 'omga'"),
    ({"output": [[0.0, 0.1], [0.0, 0.1], [0.1, 0.0]]}, "run 2: output: expected increasing times"),
    ({"output": [[0.0, 0.1], 1.0, [0.1, 0.2]]}, "run 1: output is 1.0: expected a whole number"),
    ({"output": [[0.0, 0.1]] * 3, "t_end": [0.1, 0.2, 0.1]}, "run 1: t_end is 0.2 s, and the times of output end"),
    ({"output": np.ma.array(np.zeros((3, 2)), mask=np.eye(3, 2, dtype=bool))}, "is masked"),
    ({"t_end": np.ma.array([1.0, 2.0, 3.0], mask=[False, True, False])}, r"t_end\[1\] is masked"),
    ({"t_end": np.ones((3, 2))}, r"t_end has shape \(3, 2\)"),
]


@pytest.mark.parametrize(("options", "words"), MISTAKES)
def test_mistakes_are_told_with_the_number_of_the_run(options: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words):
        press("dry" if "step" in options else "ideal").simulate_many({"omega": [6.0, 7.0, 8.0]}, **options)


def test_times_alone_say_how_many_runs_there_are() -> None:
    batch = press("ideal").simulate_many({}, [0.1, 0.2, 0.3], output=3)
    np.testing.assert_array_equal(batch.t[:, -1], [0.1, 0.2, 0.3])
    states = [press("ideal").simulate(0.1, output=2, parameters={"omega": omega}).final for omega in (6.0, 7.0)]
    batch = press("ideal").simulate_many({}, [0.2, 0.3], output=3, start=states)
    np.testing.assert_array_equal(batch.t[:, [0, -1]], [[0.1, 0.2], [0.1, 0.3]])
    np.testing.assert_array_equal(batch.q[1], press("ideal").simulate(0.3, output=3, start=states[1]).q)
    with pytest.raises(BadValueError, match="start has 2 states for 3 runs"):
        press("ideal").simulate_many({}, [0.2, 0.3, 0.4], start=states)


@pytest.fixture(scope="module")
def ragged() -> Batch:
    """Runs that have their own times, one of which fails."""
    return press().simulate_many(
        {"c": [3e-4, 4e-4, -1.0]}, output=[[0.0, 0.001], [0.0, 0.001, 0.004], [0.0, 0.002]], rtol=1e-6
    )


def test_datasets_tables_and_joins_have_them(ragged: Batch, tmp_path: Path) -> None:
    pytest.importorskip("xarray")
    data = ragged.to_xarray(["A.F"])
    assert dict(data.sizes) == {"run": 3, "time": 3} and "time" not in data.coords
    np.testing.assert_array_equal(data["t"], ragged.t)
    np.testing.assert_array_equal(data["A.F"], ragged["A.F"])
    frame = ragged.to_dataframe(["S9.y"])
    assert frame["t"].tolist() == [0.0, 0.001, 0.0, 0.001, 0.004] and frame["run"].tolist() == [0, 0, 1, 1, 1]
    np.testing.assert_array_equal(frame["S9.y"], ragged["S9.y"][~np.isnan(ragged["S9.y"])])
    ragged.to_csv(tmp_path / "runs.csv", ["S9.y"])
    np.testing.assert_array_equal(np.loadtxt(tmp_path / "runs.csv", delimiter=",", skiprows=1)[:, 2], frame["t"])
    other = press("ideal").simulate_many({"omega": [6.0, 6.5, 7.0]}, [0.1, 0.2, 0.3], output=2)
    joined = gudgeon.join([ragged, other])
    np.testing.assert_array_equal(joined["t"].sel(scene="ideal"), other.t)
    for wrong in (
        press("ideal").simulate_many({"omega": [6.0, 6.5, 7.0]}, [0.1, 0.2, 0.3], output=3),
        press("ideal").simulate_many({"omega": [6.0, 6.5, 7.0]}, 0.1, output=2),
    ):
        with pytest.raises(BadValueError, match="times of their own"):
            gudgeon.join([ragged, wrong])


def test_files_have_them(ragged: Batch, tmp_path: Path) -> None:
    pytest.importorskip("h5py")
    from tests.results.test_batch_file import assert_same as same_batch

    ragged.save(tmp_path / "batch.nc")
    same_batch(ragged, Batch.load(tmp_path / "batch.nc"))

"""Results for other programs: what pandas, a CSV reader and MATLAB's format give back is what the run has."""

from __future__ import annotations

import builtins
import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BadValueError, GudgeonError, OutputError, UnknownNameError
from gudgeon.results.files import export
from gudgeon.results.results import Result
from tests.programs import needs_compiler
from tests.valve import valve


def refuse(monkeypatch: pytest.MonkeyPatch, package: str) -> None:
    ours = builtins.__import__

    def missing(name: str, *more: Any) -> Any:
        if name.partition(".")[0] == package:
            raise ModuleNotFoundError(name)
        return ours(name, *more)

    monkeypatch.setattr(builtins, "__import__", missing)


def test_a_data_frame_has_every_series_over_t_with_its_unit(run: Result) -> None:
    pytest.importorskip("pandas")
    table = run.to_dataframe()
    assert list(table.columns) == list(run.names)
    assert table.index.name == "t"
    np.testing.assert_array_equal(table.index.to_numpy(), run.t)
    for name, unit in run.names.items():
        np.testing.assert_array_equal(table[name].to_numpy(), run[name])
        assert table.attrs["units"][name] == unit
    assert (table.attrs["units"]["t"], table.attrs["mechanism"], table.attrs["scene"]) == ("s", "slider", "dry")


def test_a_data_frame_of_some_series_is_the_readers_own(run: Result) -> None:
    pytest.importorskip("pandas")
    table = run.to_dataframe(["lift", "S9.y"])
    assert list(table.columns) == ["lift", "S9.y"]
    before = run["S9.y"].copy()
    table.loc[:, "S9.y"] = 0.0
    np.testing.assert_array_equal(run["S9.y"], before)


@pytest.mark.parametrize("way", ["to_dataframe", "to_csv", "to_mat"])
def test_names_that_are_none_are_told_before_anything_is_written(way: str, run: Result, tmp_path: Path) -> None:
    path = () if way == "to_dataframe" else (tmp_path / "file",)
    with pytest.raises(UnknownNameError, match=r"S9\.y"):
        getattr(run, way)(*path, ["S9.yy"])
    with pytest.raises(BadValueError, match="names"):
        getattr(run, way)(*path, "S9.y")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("none", [[], ["t"]])
def test_an_empty_list_of_names_is_no_series(none: list[str], run: Result, tmp_path: Path) -> None:
    """As keep=[] keeps none: what was found by a search that finds nothing is not everything."""
    pytest.importorskip("pandas")
    assert list(run.to_dataframe(none).columns) == [] and len(run.to_dataframe(none)) == len(run.t)
    run.to_csv(tmp_path / "run.csv", none)
    assert (tmp_path / "run.csv").read_text().splitlines() == ["t", *map(repr, run.t.tolist())]
    run.to_mat(tmp_path / "run.mat", none)
    loadmat = pytest.importorskip("scipy.io").loadmat
    assert [str(name[0]) for name in loadmat(tmp_path / "run.mat")["names"].ravel()] == ["t"]


def test_csv_gives_back_every_bit(run: Result, tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    run.to_csv(path)
    with path.open(newline="") as file:
        head, *rows = csv.reader(file)
    assert head == ["t", *run.names]
    for name, column in zip(head, np.array(rows, dtype=float).T, strict=True):
        assert column.tobytes() == np.asarray(run[name], dtype=float).tobytes(), name


def test_csv_in_parts_is_the_same_file(run: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run.to_csv(tmp_path / "whole.csv", ["S9.y", "A.state"])
    monkeypatch.setattr(export, "ROWS_PER_WRITE", 7)
    run.to_csv(tmp_path / "parts.csv", ["S9.y", "A.state"])
    assert (tmp_path / "parts.csv").read_bytes() == (tmp_path / "whole.csv").read_bytes()
    assert len((tmp_path / "whole.csv").read_text().splitlines()) == 1 + len(run.t)


@pytest.mark.parametrize("way", ["to_csv", "to_mat"])
def test_a_file_that_cannot_be_written_leaves_the_older_one(
    way: str, run: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "file"
    getattr(run, way)(path)
    before = path.read_bytes()
    path.chmod(0o444)
    with pytest.raises(OutputError):
        getattr(run, way)(path)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_matlab_reads_every_series_with_name_and_unit(run: Result, tmp_path: Path) -> None:
    from scipy.io import loadmat

    run.to_mat(tmp_path / "run.mat")
    found = loadmat(tmp_path / "run.mat")
    np.testing.assert_array_equal(found["t"], run.t[:, None])
    np.testing.assert_array_equal(found["S9_y"], run["S9.y"][:, None])
    cells = (found[key].ravel() for key in ("variables", "names", "units"))
    variables, names, units = ([str(cell[0]) if cell.size else "" for cell in column] for column in cells)
    assert names == ["t", *run.names]
    assert units == ["s", *run.names.values()]
    for variable, name in zip(variables, names, strict=True):
        np.testing.assert_array_equal(found[variable].ravel(), run[name])
        assert found[variable].dtype == np.float64  # MATLAB's whole numbers saturate


def test_matlab_reads_batches_as_runs_by_samples(tmp_path: Path) -> None:
    """Runs of their own lengths: NaN behind the end; of a batch that kept series only, those."""
    from scipy.io import loadmat

    pendulum, lengths = gudgeon.load("pendulum"), [0.2, 0.3, 0.1]
    for keep in ("states", ["bob.x", "bob.theta"]):
        batch = pendulum.simulate_many({"g": [9.0, 9.5, 10.0]}, t_end=lengths, output=5, keep=keep)
        batch.to_mat(tmp_path / "runs.mat", ["bob.theta"])
        found = loadmat(tmp_path / "runs.mat")
        np.testing.assert_array_equal(found["bob_theta"], batch["bob.theta"])
        np.testing.assert_array_equal(found["t"], batch["t"])
        np.testing.assert_allclose(np.nanmax(found["t"], axis=1), lengths)
        np.testing.assert_array_equal(found["parameters_g"], np.array([[9.0], [9.5], [10.0]]))
        message = [[str(cell[0]) for cell in found[key].ravel()] for key in ("names", "units")]
        assert message == [["t", "bob.theta", "parameters.g"], ["s", "rad", "m/s^2"]]
        batch.to_mat(tmp_path / "all.mat")
        assert "bob_x" in loadmat(tmp_path / "all.mat")


def test_the_same_run_gives_the_same_matlab_file(run: Result, tmp_path: Path) -> None:
    """SciPy writes the day and the minute into its head."""
    for name in ("first", "second"):
        run.to_mat(tmp_path / name)
    assert (tmp_path / "first").read_bytes() == (tmp_path / "second").read_bytes()
    assert b"Created" not in (tmp_path / "first").read_bytes()[:128]


def test_names_that_matlab_refuses_are_made_valid_and_stay_apart() -> None:
    names = ["t", "a.b", "a_b", "end", "names", "lambda.A.x", "long." + "y" * 80, "long." + "y" * 79 + ".z"]
    found = list(export._make_matlab_names(names).values())
    assert found[:6] == ["t", "a_b", "a_b_2", "end_", "names_2", "lambda_A_x"]
    assert len({*found}) == len(names)
    assert all(len(name) <= 63 for name in found)


def test_a_package_that_is_missing_is_told(run: Result, monkeypatch: pytest.MonkeyPatch) -> None:
    refuse(monkeypatch, "pandas")
    with pytest.raises(GudgeonError, match="pandas: pip install"):
        run.to_dataframe()


@needs_compiler
def test_a_batch_is_a_long_table_of_its_runs(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    batch = valve(tmp_path).simulate_many({"w": [7.0, 9.0]}, 1.0, output=20)
    table = batch.to_dataframe(["follower.x", "lift"])
    assert list(table.columns) == ["run", "parameters.w", "t", "follower.x", "lift"]
    runs = [run for i in range(2) if (run := batch.partial(i)) is not None]
    assert len(table) == sum(len(run.t) for run in runs)
    for i, run in enumerate(runs):
        own = table[table["run"] == i]
        np.testing.assert_array_equal(own["lift"].to_numpy(), run["lift"])
        np.testing.assert_array_equal(own["t"].to_numpy(), run.t)
        assert (own["parameters.w"] == run.parameters["w"]).all()
    assert table.attrs["units"] == {"run": "", "parameters.w": "1/s", "t": "s", "follower.x": "m", "lift": "m"}
    assert list(batch.to_dataframe([]).columns) == ["run", "parameters.w", "t"]
    batch.to_csv(tmp_path / "batch.csv", ["follower.x", "lift"])
    pandas.testing.assert_frame_equal(pandas.read_csv(tmp_path / "batch.csv"), table)

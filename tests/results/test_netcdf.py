"""What a file gives back is what was saved, to the bit."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

h5py = pytest.importorskip("h5py")

from gudgeon.errors import InputError, OutputError  # noqa: E402
from gudgeon.results.results import Result, read  # noqa: E402


def test_everything_comes_back_bit_for_bit(run: Result, ideal: Result, tmp_path: Path) -> None:
    for result in (run, ideal):
        path = tmp_path / f"{result.source.scene}.nc"
        result.save(path)
        back = read(path)
        assert back.compiled is None
        assert back.source == result.source
        assert back.diagnostics.to_json() == result.diagnostics.to_json()
        for name in ("p", "given", "is_given", "t", "q", "v", "a", "state", "memory", "work", "impacts"):
            ours, theirs = getattr(result, name), getattr(back, name)
            assert (ours.dtype, ours.shape) == (theirs.dtype, theirs.shape), name
            assert ours.tobytes() == theirs.tobytes(), name
        assert list(back.names) == list(result.names)
        for name in result.names:
            assert back[name].tobytes() == result[name].tobytes(), name
        assert dict(back.final.parameters) == dict(result.final.parameters)


def test_reading_does_not_need_what_can_be_computed(run: Result, tmp_path: Path) -> None:
    """Every series is in the file: a reading library without our code finds them with their units."""
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    run.save(tmp_path / "run.nc")
    with xarray.open_dataset(tmp_path / "run.nc", engine="h5netcdf") as file:
        for name, unit in run.names.items():
            assert file[name].attrs["units"] == (unit or "1")
            np.testing.assert_array_equal(file[name].to_numpy(), run[name])
        np.testing.assert_array_equal(file["time"].to_numpy(), run.t)
    with xarray.open_dataset(tmp_path / "run.nc", engine="h5netcdf", group="impacts") as file:
        np.testing.assert_array_equal(file["t_on"].to_numpy(), run.impacts["t_on"])
        assert file["joint"].to_numpy().tolist() == ["A", "A"]


def test_the_same_run_gives_the_same_bytes(make: object, tmp_path: Path) -> None:
    for name in ("first", "second"):
        make().save(tmp_path / name)  # type: ignore[operator]
    assert (tmp_path / "first").read_bytes() == (tmp_path / "second").read_bytes()


def test_a_failed_write_leaves_the_older_file_and_nothing_else(
    run: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "run.nc"
    run.save(path)
    before = path.read_bytes()

    def fail(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", fail)  # the last thing that is done
    with pytest.raises(OutputError, match="No space left"):
        run.save(path)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("kind", ["missing", "text", "foreign", "cut short"])
def test_what_is_no_result_is_refused(kind: str, run: Result, tmp_path: Path) -> None:
    path = tmp_path / "file.nc"
    if kind == "text":
        path.write_text("no NetCDF")
    elif kind == "foreign":
        with h5py.File(path, "w") as file:
            file["x"] = np.arange(3.0)
    elif kind == "cut short":
        run.save(path)
        path.write_bytes(path.read_bytes()[:-4000])
    with pytest.raises(InputError):
        Result.load(path)


def test_an_output_may_be_called_like_a_dimension(run: Result, tmp_path: Path) -> None:
    from dataclasses import replace

    odd = replace(run, source=replace(run.source, outputs={"time": ["*", 2.0, "t"], "p": 1.0}), stored={})
    odd.save(tmp_path / "odd.nc")
    back = read(tmp_path / "odd.nc")
    np.testing.assert_array_equal(back["time"], 2 * run.t)
    assert back["p"].tolist() == [1.0] * len(run.t)


def test_a_dataset_is_what_the_file_holds(run: Result, ideal: Result, tmp_path: Path) -> None:
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    groups = {"dry": ("impacts", "parameters"), "ideal": ("parameters",)}
    for result in (run, ideal):
        result.save(tmp_path / "run.nc")
        with xarray.open_dataset(tmp_path / "run.nc", engine="h5netcdf") as file:
            xarray.testing.assert_identical(file.load(), result.to_xarray())
        for part in groups[result.source.scene]:
            with xarray.open_dataset(tmp_path / "run.nc", engine="h5netcdf", group=part) as file:
                xarray.testing.assert_identical(file.load(), result.to_xarray(part))
        with h5py.File(tmp_path / "run.nc") as file:
            assert {name for name in file if isinstance(file[name], h5py.Group)} == {
                *groups[result.source.scene],
                "compiled",
            }


def test_a_table_has_a_row_a_sample_and_a_column_a_series(run: Result, ideal: Result) -> None:
    """Impacts, events and parameters are tables of their own; what is not there has no row."""
    pytest.importorskip("xarray")
    for result in (run, ideal):
        data = result.to_xarray()
        table = data.to_dataframe()
        assert dict(data.sizes) == {"time": len(result.t)}
        assert list(table.columns) == list(result.names) and (table.index == result.t).all()
        assert len(result.to_xarray("impacts").to_dataframe()) == len(result.impacts)
        assert len(result.to_xarray("events").to_dataframe()) == 0
        parameters = result.to_xarray("parameters").to_dataframe()
        assert parameters["value"].to_dict() == {
            slot.address: result.parameters[slot.address] for slot in result.source.parameters
        }
    with pytest.raises(InputError, match="impacts"):
        run.to_xarray("impact")

"""A batch in a file: every run of it comes back to the bit, with what it was given, its notes and its failures."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

h5py = pytest.importorskip("h5py")

import gudgeon  # noqa: E402
from gudgeon.errors import GudgeonError, InputError, OutputError  # noqa: E402
from gudgeon.results.batch import Batch  # noqa: E402
from gudgeon.results.results import Result  # noqa: E402
from tests.programs import needs_compiler  # noqa: E402
from tests.pump import TEXT as PUMP  # noqa: E402
from tests.valve import valve  # noqa: E402

pytestmark = needs_compiler
ARRAYS = ("p", "given", "is_given", "t", "q", "v", "a", "state", "memory", "work", "impacts", "events")


def assert_same(ours: Batch, theirs: Batch) -> None:
    for name in ("t", "q", "v", "work", "state", "samples", "t_last", "peaks"):
        one, other = getattr(ours, name), getattr(theirs, name)
        assert (one.dtype, one.shape) == (other.dtype, other.shape), name
        assert one.tobytes() == other.tobytes(), name
    assert (ours.seconds, ours.threads, ours.interrupted) == (theirs.seconds, theirs.threads, theirs.interrupted)
    for name in ("parameters", "diagnostics"):
        one, other = getattr(ours, name), getattr(theirs, name)
        assert list(one) == list(other)
        assert all(one[key].tobytes() == other[key].tobytes() for key in one)
    assert ours.failures == theirs.failures
    assert list(map(str, ours.failures)) == list(map(str, theirs.failures))
    for i in range(len(ours)):
        one, other = ours.partial(i), theirs.partial(i)
        assert (one is None) == (other is None)
        if one is not None and other is not None:
            assert_same_run(one, other)


def assert_same_run(one: Result, other: Result) -> None:
    assert other.source == one.source
    assert one.diagnostics.to_json() == other.diagnostics.to_json()
    for name in ARRAYS:
        assert getattr(one, name).tobytes() == getattr(other, name).tobytes(), name
    for name in one.names:
        assert one[name].tobytes() == other[name].tobytes(), name
    for event in one.source.events:
        ours, theirs = one.at_events(event.name), other.at_events(event.name)
        assert all(ours[name].tobytes() == theirs[name].tobytes() for name in ("t", *ours))
    assert dict(one.final.parameters) == dict(other.final.parameters)


def worn(folder: Path, text: str = PUMP) -> gudgeon.Simulation:
    file = folder / "pump.yaml"
    file.write_text(text)
    return gudgeon.load(file, "worn")


@pytest.mark.parametrize(
    "options", [{}, pytest.param({"method": "rk4", "step": 1e-3}, marks=pytest.mark.slow), {"kinematic": True}], ids=str
)
def test_every_run_comes_back_bit_for_bit(options: dict[str, Any], tmp_path: Path) -> None:
    own = dict(options)
    simulation = valve(tmp_path, own.pop("kinematic", False))
    batch = simulation.simulate_many({"w": [5.0, 7.0, 9.0]}, 2.0, output=7, **own)
    batch.save(tmp_path / "batch.nc")
    assert_same(batch, Batch.load(tmp_path / "batch.nc"))


def test_contacts_notes_and_failures_come_back(tmp_path: Path) -> None:
    """One run of a crank that is too short for its start, one with a step that is too long, one that ends well."""
    batch = worn(tmp_path).simulate_many(
        {"bodies.rod.length": [0.12, 0.12, 0.001], "c": ["0.2 mm", "0.4 mm", "0.2 mm"]}, 0.02, output=11
    )
    assert len(batch.failures) == 1 and len(batch.impacts[0]) > 0
    batch.save(tmp_path / "batch.nc")
    back = Batch.load(tmp_path / "batch.nc")
    assert_same(batch, back)
    assert type(back.failures[0].error) is type(batch.failures[0].error)
    with pytest.raises(GudgeonError):
        back[2]
    back.save(tmp_path / "again.nc")
    assert (tmp_path / "again.nc").read_bytes() == (tmp_path / "batch.nc").read_bytes()


def test_runs_that_failed_on_their_way_have_what_they_reached(tmp_path: Path) -> None:
    text = PUMP.replace("value: 20 deg + omega * t", "value: 20 deg + omega * t + 0.1 * sqrt(0.5 - t * omega)")
    batch = worn(tmp_path, text).simulate_many({"omega": [20.0, 60.0]}, 0.02, output=11)
    assert [failure.run for failure in batch.failures] == [1]
    batch.save(tmp_path / "batch.nc")
    back = Batch.load(tmp_path / "batch.nc")
    assert_same(batch, back)
    partial = back.partial(1)
    assert partial is not None and 1 < len(partial.t) < 12


def test_a_reader_of_netcdf_finds_long_tables(tmp_path: Path) -> None:
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    batch = worn(tmp_path).simulate_many({"c": ["0.2 mm", "0.4 mm"]}, 0.02, output=11)
    batch.save(tmp_path / "batch.nc")
    with xarray.open_dataset(tmp_path / "batch.nc", engine="h5netcdf", group="series") as file:
        np.testing.assert_array_equal(file["run"].to_numpy(), np.repeat([0, 1], 12))
        np.testing.assert_array_equal(file["piston.x"].to_numpy(), batch["piston.x"].ravel())
        assert file["piston.x"].attrs["units"] == "m"
    with xarray.open_dataset(tmp_path / "batch.nc", engine="h5netcdf", group="impacts") as file:
        assert len(file["t_on"]) == sum(map(len, batch.impacts))


def test_damaged_foreign_and_other_files_are_refused(tmp_path: Path, run: Result) -> None:
    path = tmp_path / "batch.nc"
    valve(tmp_path).simulate_many({"w": [5.0, 7.0]}, 0.2, output=7).save(path)
    with pytest.raises(InputError, match=r"batch\.nc contains a batch of runs .*\n.*gudgeon\.Batch\.load") as caught:
        Result.load(path)
    assert "run the scene again" not in str(caught.value)
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    (tmp_path / "damaged.nc").write_bytes(data)
    with pytest.raises(InputError, match="damaged"):
        Batch.load(tmp_path / "damaged.nc")
    run.save(tmp_path / "run.nc")
    with pytest.raises(InputError, match=r"run\.nc contains a single run .*\n.*gudgeon\.Result\.load"):
        Batch.load(tmp_path / "run.nc")
    with pytest.raises(OutputError):
        valve(tmp_path).simulate_many({"w": [5.0]}, 0.2, output=7).save(tmp_path)


@pytest.mark.parametrize("what", ["series/run", "runs/failure", "runs/diagnostics", "times/time", "compiled/run"])
def test_a_file_that_lacks_something_is_refused(what: str, tmp_path: Path) -> None:
    """Changed by another program, so that no seal tells."""
    path = tmp_path / "batch.nc"
    valve(tmp_path).simulate_many({"w": [5.0, 7.0]}, 0.2, output=7).save(path)
    with h5py.File(path, "r+") as file:
        del file[what]
    with pytest.raises(InputError):
        Batch.load(path)


def test_rows_of_no_run_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "batch.nc"
    valve(tmp_path).simulate_many({"w": [5.0, 7.0]}, 0.2, output=7).save(path)
    with h5py.File(path, "r+") as file:
        file["series/run"][-1] = 2
    with pytest.raises(InputError):
        Batch.load(path)


def test_files_of_before_runs_had_their_own_times_are_read(tmp_path: Path) -> None:
    """They say so, and have nothing else that differs."""
    path = tmp_path / "batch.nc"
    batch = valve(tmp_path).simulate_many({"w": [5.0, 7.0]}, 0.2, output=7)
    batch.save(path)
    with h5py.File(path, "r+") as file:
        assert bytes(file.attrs["gudgeon"]) == b"gudgeon-batch/2" and "kept" not in file
        file.attrs["gudgeon"] = "gudgeon-batch/1"
    assert_same(batch, Batch.load(path))


def test_an_output_may_be_called_like_the_column_of_runs(tmp_path: Path) -> None:
    text = PUMP + "outputs: {run: 2 * piston.x}\n"
    for keep in ("states", ["run"]):
        batch = worn(tmp_path, text).simulate_many({"c": ["0.2 mm", "0.4 mm"]}, 0.002, output=3, keep=keep)
        batch.save(tmp_path / "batch.nc")
        assert Batch.load(tmp_path / "batch.nc")["run"].tobytes() == batch["run"].tobytes()


@pytest.mark.parametrize("what", ["kept/run", "kept/time", "kept/lift", "times/run", "times/time"])
def test_a_file_of_series_that_lacks_one_is_refused(what: str, tmp_path: Path) -> None:
    path = tmp_path / "batch.nc"
    valve(tmp_path).simulate_many({"w": [5.0, 7.0]}, [0.2, 0.3], output=7, keep=["lift"]).save(path)
    with h5py.File(path, "r+") as file:
        del file[what]
    with pytest.raises(InputError):
        Batch.load(path)


def test_peaks_beside_kept_series_come_back(tmp_path: Path) -> None:
    """They are no part of states: a file of kept series has them bit for bit, and none where none were asked for."""
    valves = worn(tmp_path)
    name = f"{valves.source.clearances[0].name}.F"
    for peaks in ([name], []):
        batch = valves.simulate_many([{}, {}], 2e-3, output=4, keep=[name], peaks=peaks)
        batch.save(tmp_path / "kept.nc")
        assert Batch.load(tmp_path / "kept.nc").extremes == batch.extremes
    assert len(valves.simulate_many([{}, {}], 2e-3, output=4, keep=[name], peaks=[name]).extremes[1]) == 1


def swapped(values: Any) -> None:
    values[1], values[2] = values[2], values[1]


@pytest.mark.parametrize(
    ("what", "change", "message"),
    [
        ("times/time", swapped, "the times of samples do not ascend"),
        ("series/time", swapped, "the times of samples do not ascend"),
        ("given/parameters.w", lambda values: values.put(1, 8.0), "run 1: parameters.w is 7.0, but was given as 8.0"),
        ("parameters/given", lambda values: values.fill(3.25), "was given as 3.25"),
        (
            "given",
            lambda group: group.move("parameters.w", "parameters.v"),
            "'parameters.v' was given, but its scene has no such",
        ),
    ],
)
def test_what_another_program_changed_is_told(what: str, change: Any, message: str, tmp_path: Path) -> None:
    """They were loaded as they stood."""
    path = tmp_path / "batch.nc"
    valve(tmp_path).simulate_many({"w": [5.0, 7.0]}, 0.2, output=7).save(path)
    with h5py.File(path, "r+") as file:
        if what == "given":
            change(file[what])
        else:
            values = file[what][...]
            change(values)
            file[what][...] = values
    with pytest.raises(InputError, match=message):
        Batch.load(path)

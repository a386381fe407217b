"""Files that are not what they should be: a Result that is right, or an InputError; nothing else, and no memory."""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import pytest

h5py = pytest.importorskip("h5py")

from gudgeon.contract.kernel_source import STORED_NAMES  # noqa: E402
from gudgeon.errors import InputError  # noqa: E402
from gudgeon.results.files.hdf5 import CHECKSUM_BYTES  # noqa: E402
from gudgeon.results.results import Result, read  # noqa: E402
from tests.results.old_results import save_old  # noqa: E402
from tests.slow import slow_rows_but  # noqa: E402

Change: TypeAlias = Callable[[Any], object]


@pytest.fixture
def path(run: Result, tmp_path: Path) -> Path:
    run.save(tmp_path / "run.nc")
    return tmp_path / "run.nc"


def test_a_file_that_is_cut_short_is_refused(path: Path) -> None:
    data = path.read_bytes()
    for k in range(50):
        path.write_bytes(data[: len(data) * k // 50])
        with pytest.raises(InputError):
            read(path)


def test_a_flipped_bit_is_told_wherever_it_is(path: Path) -> None:
    """In the numbers too: they would be read as others."""
    data, rng = path.read_bytes(), random.Random(1)
    for _ in range(300):
        damaged = bytearray(data)
        at = rng.randrange(len(data) - 30)  # behind is the seal itself
        damaged[at] ^= 1 << rng.randrange(8)
        path.write_bytes(damaged)
        with pytest.raises(InputError, match="damaged"):
            read(path)


def test_a_damaged_checksum_is_refused(run: Result, path: Path) -> None:
    """A cut or changed last line, and bytes after it: the data are then not checked by anything."""
    data = path.read_bytes()
    assert data[-CHECKSUM_BYTES:].startswith(b"\ngudgeon crc32 ")
    damaged = [data[:-k] for k in range(1, CHECKSUM_BYTES)] + [data + b"x", data + b"\nseen\n", data + data[-24:]]
    for k in range(1, CHECKSUM_BYTES + 1):
        changed = bytearray(data)
        changed[-k] ^= 1
        damaged.append(bytes(changed))
    for contents in damaged:
        path.write_bytes(contents)
        with pytest.raises(InputError, match="its checksum does not match"):
            read(path)


@pytest.mark.parametrize("version", ["earliest", "v108", "latest"])
def test_files_that_other_programs_wrote_have_no_checksum(version: str, run: Result, path: Path) -> None:
    """They end with their HDF5 data, whatever the version of the superblock."""
    other = path.with_name("other.nc")
    with h5py.File(path) as file, h5py.File(other, "w", libver=version) as copy:
        for key, value in file.attrs.items():
            copy.attrs[key] = value
        for name in file:
            file.copy(name, copy)
    np.testing.assert_array_equal(read(other)["A.F"], run["A.F"])
    other.write_bytes(other.read_bytes() + b"x")
    with pytest.raises(InputError, match="its checksum does not match"):
        read(other)


def test_holes_and_moved_blocks_are_told(path: Path) -> None:
    data, rng = path.read_bytes(), random.Random(2)
    for _ in range(50):
        begin, size = rng.randrange(len(data) - 5000), rng.choice((1, 100, 4096))
        other = rng.randrange(len(data) - 5000)
        for block in (bytes(size), data[other : other + size]):
            damaged = data[:begin] + block + data[begin + size :]
            if damaged != data:
                path.write_bytes(damaged)
                with pytest.raises(InputError, match="damaged"):
                    read(path)


def test_what_another_program_added_does_not_spoil_a_file(run: Result, path: Path) -> None:
    with h5py.File(path, "a") as file:
        file.attrs["comment"] = "seen"
        file["note"] = np.arange(3.0)
    np.testing.assert_array_equal(read(path)["A.F"], run["A.F"])


def test_a_file_may_be_packed_by_another_program(run: Result, path: Path) -> None:
    with h5py.File(path, "a") as file:
        values = np.zeros(len(run.t))
        del file["lambda.guide.angle"]
        file.create_dataset("lambda.guide.angle", data=values, compression="gzip", chunks=True)
    assert not read(path)["lambda.guide.angle"].any()


def replace_dataset(name: str, **options: Any) -> Change:
    def change(file: Any) -> None:
        del file[name]
        file.create_dataset(name, **options)

    return change


def link(name: str, to: Any) -> Change:
    def change(file: Any) -> None:
        del file[name]
        file[name] = to

    return change


def virtual(file: Any) -> None:
    layout = h5py.VirtualLayout(shape=file["time"].shape, dtype="f8")
    layout[:] = h5py.VirtualSource(file["time"])
    del file["A.F"]
    file.create_virtual_dataset("A.F", layout)


def elsewhere(file: Any) -> None:
    """The numbers are said to be in another file of the user's."""
    size = file["time"].shape[0]
    del file["A.F"]
    file.create_dataset("A.F", shape=(size,), dtype="f8", external=[("/etc/hostname", 0, 8 * size)])


def attribute(key: str, value: Any, group: str = "/") -> Change:
    def change(file: Any) -> None:
        file[group].attrs[key] = value

    return change


HUGE, SAMPLES = 10**12, 201
CHANGES: dict[str, Change] = {
    "no series": lambda file: file.pop("A.F"),
    "no time": lambda file: file.pop("time"),
    "no group": lambda file: file.pop("compiled"),
    "no source": lambda file: file["compiled"].attrs.pop("source"),
    "no diagnostics": lambda file: file.attrs.pop("diagnostics"),
    "no format": lambda file: file.attrs.pop("gudgeon"),
    "later format": attribute("gudgeon", "gudgeon-result/9"),
    "format of numbers": attribute("gudgeon", np.arange(3)),
    "source of numbers": attribute("source", 3.0, "compiled"),
    "source of bytes": attribute("source", np.void(b"\xff\xfe"), "compiled"),
    "empty source": attribute("source", h5py.Empty("S1"), "compiled"),
    "deep source": attribute("source", "[" * 100_000, "compiled"),
    "diagnostics of a list": attribute("diagnostics", "[]"),
    "diagnostics of words": attribute("diagnostics", '{"method": 1}'),
    "a group for a series": lambda file: (file.pop("A.F"), file.create_group("A.F")),
    "a series for a group": replace_dataset("impacts", data=np.arange(3.0)),
    "shorter": replace_dataset("A.F", data=np.arange(3.0)),
    "longer": replace_dataset("A.F", data=np.zeros(100_000)),
    "a matrix": replace_dataset("A.F", data=np.zeros((2, 2))),
    "a number": replace_dataset("A.F", data=1.0),
    "texts": replace_dataset("A.F", data=["a"] * SAMPLES),
    "integers": replace_dataset("time", data=np.arange(SAMPLES)),
    "no samples": replace_dataset("time", shape=(0,), dtype="f8"),
    "structures": replace_dataset("A.F", data=np.zeros(SAMPLES, "f8,i4")),
    "half the precision": replace_dataset("A.F", data=np.zeros(SAMPLES, "f4")),
    "huge, unwritten": replace_dataset("time", shape=(HUGE,), dtype="f8"),
    "huge, in chunks": replace_dataset("time", shape=(HUGE,), dtype="f8", chunks=(1000,), compression="gzip"),
    "huge impacts": replace_dataset("impacts/t_on", shape=(HUGE,), dtype="f8"),
    "huge texts": replace_dataset("impacts/joint", shape=(HUGE,), dtype=h5py.string_dtype()),
    "an unknown joint": replace_dataset("impacts/joint", data=["A", "B"], dtype=h5py.string_dtype()),
    "joints by number": replace_dataset("impacts/joint", data=[0, 1]),
    "a link to another file": link("A.F", h5py.ExternalLink("/etc/hostname", "/A.F")),
    "a link by name": link("A.F", h5py.SoftLink("/time")),
    "a loop": link("A.F", h5py.SoftLink("/A.F")),
    "virtual": virtual,
    "elsewhere": elsewhere,
}


@pytest.mark.parametrize("change", CHANGES)
def test_what_somebody_changed_is_looked_at(change: str, run: Result, path: Path) -> None:
    assert len(run.t) == SAMPLES
    with h5py.File(path, "a") as file:
        CHANGES[change](file)
    with pytest.raises(InputError):
        read(path)


WRONG: tuple[Any, ...] = (None, True, -1, 10**30, 1e308, "", "[/]", [], ["x"], [[1]], [None], {}, {"a": 1}, [{}])


AS_STORED = ("in full", (150, 20)), ("short", (80, 10))


@pytest.mark.parametrize(("stored", "fewest"), slow_rows_but(AS_STORED[1:], AS_STORED))
def test_a_source_of_other_types_is_refused_or_right(
    run: Result, path: Path, stored: str, fewest: tuple[int, int]
) -> None:
    """Every field of the source, with values of other kinds: a Result whose values can be had, or an InputError.

    In full: with all that follows from other fields, which is said no more but may be.
    """
    refused = accepted = 0
    source, rng = json.loads(run.source.to_json()), random.Random(3)
    if stored == "in full":
        in_full = {STORED_NAMES.get(name, name): value for name, value in asdict(run.source).items()}
        source = json.loads(json.dumps(in_full))
    for key in source:
        for wrong in rng.sample((*WRONG, "left out"), 6):
            changed = source | {key: wrong}
            if wrong == "left out":
                del changed[key]
            with h5py.File(path, "a") as file:
                file["compiled"].attrs["source"] = json.dumps(changed | ({"files": {}} if key != "files" else {}))
            try:
                back = read(path)
            except InputError:
                refused += 1
                continue
            accepted += 1
            assert all(len(back[name]) == len(back.t) for name in back.names)
            assert str(back) and str(back.diagnostics) and back.final.q.shape == (6,)
    assert refused > fewest[0] and accepted > fewest[1]


def test_files_of_before_the_groups_are_read(run: Result, ideal: Result, tmp_path: Path) -> None:
    for result in (run, ideal):
        save_old(result, tmp_path / "old.nc")
        back = read(tmp_path / "old.nc")
        assert back.source == result.source and back.diagnostics.to_json() == result.diagnostics.to_json()
        for name in ("p", "given", "is_given", "t", "q", "v", "a", "state", "memory", "work", "impacts", "events"):
            ours, theirs = getattr(result, name), getattr(back, name)
            assert (ours.dtype, ours.tobytes()) == (theirs.dtype, theirs.tobytes()), name
        assert all(back[name].tobytes() == result[name].tobytes() for name in result.names)


def test_old_files_that_are_cut_short_are_refused(run: Result, tmp_path: Path) -> None:
    save_old(run, tmp_path / "old.nc")
    data = (tmp_path / "old.nc").read_bytes()
    for k in range(50):
        (tmp_path / "old.nc").write_bytes(data[: len(data) * k // 50])
        with pytest.raises(InputError):
            read(tmp_path / "old.nc")

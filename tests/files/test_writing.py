"""Users' files: whole or as they were, nothing left behind, nothing outside the folder."""

from __future__ import annotations

import errno
import os
import resource
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from gudgeon.errors import OutputError
from gudgeon.files.writing import PART, AtomicFiles, check_output_path, open_atomic, write_bytes, write_text


def test_a_file_is_made_with_its_folders(tmp_path: Path) -> None:
    write_text(tmp_path / "a" / "b" / "x.txt", "é")
    assert (tmp_path / "a" / "b" / "x.txt").read_bytes() == "é".encode()
    assert os.listdir(tmp_path / "a" / "b") == ["x.txt"]


def test_permissions_are_those_of_what_is_replaced_or_of_the_umask(tmp_path: Path) -> None:
    old, new = tmp_path / "old", tmp_path / "new"
    old.write_text("secret")
    old.chmod(0o640)
    mask = os.umask(0o027)
    try:
        write_bytes(old, b"1")
        write_bytes(new, b"2")
    finally:
        os.umask(mask)
    assert [stat.S_IMODE(path.stat().st_mode) for path in (old, new)] == [0o640, 0o640]
    assert old.read_bytes() == b"1"


def test_a_planted_link_is_replaced_and_what_it_points_to_stays(tmp_path: Path) -> None:
    precious = tmp_path / "precious.txt"
    precious.write_text("precious")
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / "x.csv").symlink_to(precious)
    write_text(folder / "x.csv", "new")
    assert precious.read_text() == "precious"
    assert not (folder / "x.csv").is_symlink() and (folder / "x.csv").read_text() == "new"


def test_the_temporary_name_is_opened_exclusively(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Somebody who guessed the name and planted a link gets nothing written through it, and keeps the link."""
    precious = tmp_path / "precious.txt"
    precious.write_text("precious")
    monkeypatch.setattr(os, "urandom", bytes)
    part = tmp_path / f".gudgeon-{bytes(8).hex()}.part"
    assert PART.fullmatch(part.name)
    part.symlink_to(precious)
    with pytest.raises(OutputError, match="File exists"):
        write_text(tmp_path / "x", "new")
    assert precious.read_text() == "precious" and part.is_symlink() and not (tmp_path / "x").exists()


def test_the_folder_may_be_moved_while_a_file_is_written(tmp_path: Path) -> None:
    """What is put in the folder's place meanwhile gets nothing."""
    (tmp_path / "other").mkdir()
    with open_atomic(tmp_path / "out" / "x") as file:
        (tmp_path / "out").rename(tmp_path / "away")
        (tmp_path / "out").symlink_to(tmp_path / "other")
        file.write(b"text")
    assert os.listdir(tmp_path / "other") == [] and os.listdir(tmp_path / "away") == ["x"]


@contextmanager
def limited(size: int) -> Iterator[None]:
    """No file may grow beyond so many bytes."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize("size", [0, 1, 4095, 4096, 99_999])
def test_a_limit_on_the_size_leaves_the_older_file_alone(tmp_path: Path, size: int) -> None:
    path = tmp_path / "x"
    write_bytes(path, b"older")
    with limited(size), pytest.raises(OutputError, match="(?s)File too large.*ulimit") as caught:
        write_bytes(path, bytes(100_000))
    assert caught.value.path == str(path) and caught.value.exit_code == 1
    assert path.read_bytes() == b"older" and os.listdir(tmp_path) == ["x"]
    write_bytes(path, b"next")
    assert path.read_bytes() == b"next"


@pytest.mark.parametrize("where", ["fsync", "replace"])
@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EDQUOT, errno.EIO])
def test_a_disk_that_tells_late_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, where: str, code: int
) -> None:
    write_bytes(tmp_path / "x", b"older")

    def full(*_: object, **__: object) -> None:
        raise OSError(code, os.strerror(code))

    monkeypatch.setattr(os, where, full)
    with pytest.raises(OutputError, match=os.strerror(code)), open_atomic(tmp_path / "x", sync=True) as file:
        file.write(b"new")
    assert (tmp_path / "x").read_bytes() == b"older" and os.listdir(tmp_path) == ["x"]


def test_an_interrupt_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt), open_atomic(tmp_path / "x") as file:
        file.write(b"half")
        raise KeyboardInterrupt
    assert os.listdir(tmp_path) == []


def test_files_move_in_together_or_not_at_all(tmp_path: Path) -> None:
    write_bytes(tmp_path / "a", b"older")
    with limited(10), pytest.raises(OutputError), AtomicFiles(tmp_path) as aside:
        aside.write("a", b"new")
        aside.write("b", bytes(11))
        aside.move_files()
    assert (tmp_path / "a").read_bytes() == b"older" and os.listdir(tmp_path) == ["a"]
    with AtomicFiles(tmp_path) as aside:
        aside.write("a", b"new")
        aside.write("b", b"b")
        aside.move_files(1)
    assert (tmp_path / "a").read_bytes() == b"new" and os.listdir(tmp_path) == ["a"]


def make(path: Path, what: str) -> Path:
    if what == "pipe":
        os.mkfifo(path)
    elif what == "folder":
        path.mkdir()
    elif what == "protected":
        path.write_text("older")
        path.chmod(0o444)
    elif what == "too long":
        return path.with_name("x" * 300)
    elif what == "below a file":
        path.write_text("")
        return path / "x"
    return {"device": Path("/dev/null"), "the system's link": Path("/dev/stdout")}.get(what, path)


@pytest.mark.parametrize(
    ("what", "message"),
    [
        ("pipe", "a pipe"),
        ("folder", "a folder"),
        ("device", "a device"),
        ("protected", "write-protected"),
        ("the system's link", "system"),
        ("too long", "File name too long"),
        ("below a file", "Not a directory|exists"),
    ],
)
def test_what_cannot_be_replaced_is_refused(tmp_path: Path, what: str, message: str) -> None:
    path = make(tmp_path / "x", what)
    before = [(p.name, p.lstat().st_mode) for p in tmp_path.iterdir()], os.lstat("/dev/null")[:2]
    for refuse in (check_output_path, lambda path: write_bytes(path, b"new")):
        if refuse is check_output_path and what == "below a file":
            continue  # folders are another question
        if refuse is not check_output_path and path.is_relative_to("/dev"):
            continue  # a test that fails must not harm the machine
        with pytest.raises(OutputError, match=message) as caught:
            refuse(path)
        assert caught.value.exit_code == 2
    assert ([(p.name, p.lstat().st_mode) for p in tmp_path.iterdir()], os.lstat("/dev/null")[:2]) == before


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("", "cannot write '': the name is empty\n"),
        (".", r"cannot write \.: it is a folder"),
        ("/", "it is a folder"),
        ("./", "it is a folder"),
        ("..", "it is a folder"),
        (Path(), "it is a folder"),
    ],
)
def test_a_folder_or_no_name_is_reported_as_such(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, path: str | Path, message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    for refuse in (check_output_path, lambda path: write_bytes(path, b"new")):
        with pytest.raises(OutputError, match=message) as caught:
            refuse(path)
        assert caught.value.exit_code == 2
    assert os.listdir(tmp_path) == []

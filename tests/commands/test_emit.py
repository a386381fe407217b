"""`gudgeon emit`: what it removes and replaces is its own, and a disk that fills leaves what was there."""

from __future__ import annotations

import errno
import os
import subprocess
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest

from gudgeon.commands import emit
from gudgeon.commands.emit import CHECKSUM_LIST, emit_c, refuse_foreign_files
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import GudgeonError, InputError, OutputError
from gudgeon.loading.compiler import find_compiler
from gudgeon.loading.engine import read_engine_files, read_engine_readme
from tests.tiny import tiny


@pytest.fixture
def source(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[KernelSource]:
    """What is emitted next, for scenes called ideal and dry; no mechanism is read."""
    current = [tiny()]
    monkeypatch.setattr(emit, "select_scenes", lambda mechanism, expected: expected or ("ideal", "dry"))
    monkeypatch.setattr(emit, "find_mechanism", Path)
    monkeypatch.setattr(emit, "read_bytes", lambda file: b"")
    monkeypatch.setattr(emit, "find_kernel_source", lambda data, file, scene: (current[0], "cache"))
    return current


def run(folder: Path) -> dict[str, bytes]:
    emit_c("x.yaml", folder, ("dry",))
    return contents(folder)


def contents(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_what_an_earlier_version_wrote_goes(source: list[KernelSource], tmp_path: Path) -> None:
    source[0] = tiny(files={**tiny().files, "old.c": "/* old */\n"})
    before = run(tmp_path / "c")
    assert "dry/old.c" in before
    source[0] = tiny(3)
    after = run(tmp_path / "c")
    assert "dry/old.c" not in after and after["dry/tiny.h"] != before["dry/tiny.h"]
    for line in after[f"dry/{CHECKSUM_LIST}"].decode().splitlines():
        total, name = line.split("  ")
        assert sha256(after[f"dry/{name}"]).hexdigest() == total
    assert run(tmp_path / "c") == after


@pytest.mark.parametrize("how", ["../../precious.txt", "{0}/precious.txt", "link", "other bytes", "folder is a link"])
def test_no_list_makes_emit_remove_a_users_file(source: list[KernelSource], tmp_path: Path, how: str) -> None:
    precious = tmp_path / "precious.txt"
    precious.write_text("precious")
    total = sha256(b"precious").hexdigest()
    folder = tmp_path / "c" / "dry"
    run(tmp_path / "c")
    listed = (folder / CHECKSUM_LIST).read_text()
    if how == "link":
        (folder / "old.c").symlink_to(precious)
        (folder / CHECKSUM_LIST).write_text(f"{listed}{total}  old.c\n")
    elif how == "other bytes":
        (folder / "old.c").write_text("mine")
        (folder / CHECKSUM_LIST).write_text(f"{listed}{total}  old.c\n")
    elif how == "folder is a link":
        folder.rename(tmp_path / "elsewhere")
        folder.symlink_to(tmp_path / "elsewhere")
        source[0] = tiny(5)
    else:
        (folder / CHECKSUM_LIST).write_text(f"{listed}{total}  {how.format(tmp_path)}\n")
    before = contents(tmp_path)
    with pytest.raises(InputError):
        run(tmp_path / "c")
    assert contents(tmp_path) == before


def test_a_file_that_changes_after_it_was_looked_at_stays(source: list[KernelSource], tmp_path: Path) -> None:
    """Bytes are compared when a file is removed, not only before."""
    source[0] = tiny(files={**tiny().files, "old.c": "/* old */\n"})
    run(tmp_path / "c")
    (tmp_path / "c/dry/old.c").write_text("mine")
    source[0] = tiny()
    emit._write_folder(tmp_path / "c/dry", {"tiny.c": b""})
    assert (tmp_path / "c/dry/old.c").read_text() == "mine"


def test_a_list_of_ones_own_is_not_replaced(source: list[KernelSource], tmp_path: Path) -> None:
    (tmp_path / "c/dry").mkdir(parents=True)
    (tmp_path / "c/dry" / CHECKSUM_LIST).write_text("things to buy\n")
    with pytest.raises(InputError, match=CHECKSUM_LIST):
        run(tmp_path / "c")


@pytest.mark.parametrize("call", ["write", "replace"])
def test_a_failure_at_any_file_is_no_obstacle_to_the_next_emit(
    source: list[KernelSource], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, call: str
) -> None:
    """The old files whole, none lost, none half; the folder is still its own, and the next emit is as any."""
    older = run(tmp_path / "c")
    first = tiny(3, files={**tiny(3).files, "more.h": "/* more */\n"})
    source[0] = first
    expected = run(tmp_path / "whole")
    real_open, real_replace = os.open, os.replace
    for failing in range(5):
        count = [0]

        def fail(count: list[int] = count, failing: int = failing) -> None:
            count[0] += 1
            if count[0] > failing:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        def opening(path: str, flags: int, *args: int, **kwargs: int) -> int:
            if str(path).endswith(".part"):
                fail()
            return real_open(path, flags, *args, **kwargs)

        def replacing(*args: Any, **kwargs: Any) -> None:
            fail()
            real_replace(*args, **kwargs)

        with monkeypatch.context() as patch, pytest.raises(OutputError, match="No space left") as caught:
            patch.setattr(os, *(("open", opening) if call == "write" else ("replace", replacing)))
            run(tmp_path / "c")
        assert caught.value.exit_code == 1
        there = contents(tmp_path / "c")
        if call == "write":
            assert there == older
        names = there.keys() - {f"dry/{CHECKSUM_LIST}"}
        assert older.keys() <= there.keys() and all(there[n] in (older.get(n), expected[n]) for n in names)
        refuse_foreign_files(tmp_path / "c/dry")
    assert run(tmp_path / "c") == expected


def test_what_a_killed_emit_left_aside_is_replaced(source: list[KernelSource], tmp_path: Path) -> None:
    expected = run(tmp_path / "c")
    half = tmp_path / "c/dry" / f".gudgeon-{'0' * 16}.part"
    half.write_bytes(expected["dry/tiny.c"][:10])
    assert run(tmp_path / "c") == expected


def test_a_first_emit_that_fails_leaves_no_folder(
    source: list[KernelSource], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(OutputError):
        run(tmp_path / "c")
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("name", ["file", "file/x", "n" * 300, "/".join(["n" * 200] * 30), "/proc/x"])
def test_a_folder_that_cannot_be_is_told(source: list[KernelSource], tmp_path: Path, name: str) -> None:
    (tmp_path / "file").write_text("mine")
    with pytest.raises(GudgeonError) as caught:
        run(tmp_path / name)
    assert caught.value.exit_code == 2 and len(str(caught.value)) < 600
    assert contents(tmp_path) == {"file": b"mine"}


def test_a_list_that_was_altered_is_what_is_told(tmp_path: Path) -> None:
    """Not the files that it no longer lists."""
    emit_c("pendulum", tmp_path, ("ideal",))
    file = tmp_path / "ideal" / CHECKSUM_LIST
    good = file.read_text()
    file.write_text(good.replace("  model.h", "  ../model.h"))
    with pytest.raises(InputError) as caught:
        refuse_foreign_files(tmp_path / "ideal")
    assert str(caught.value).startswith(f"{file} is not a list")
    assert "dynamics.c" not in str(caught.value)
    line = next(each for each in good.splitlines() if each.endswith("  model.h"))
    file.write_text(good.replace(line, "0" * 64 + "  model.h"))
    with pytest.raises(
        InputError, match=rf": model.h and the checksums in {CHECKSUM_LIST} differ: files or list were changed"
    ):
        refuse_foreign_files(tmp_path / "ideal")
    (tmp_path / "ideal" / "mine.txt").write_text("x")
    with pytest.raises(InputError, match=r"did not write: mine\.txt\n"):
        refuse_foreign_files(tmp_path / "ideal")


def test_the_engine_is_written_once_beside_the_scenes(tmp_path: Path) -> None:
    """What was emitted compiles by itself; emitted again it is the same; a file of another in its folders is kept."""
    emit_c("pendulum", tmp_path, ())
    before = contents(tmp_path)
    texts = {name: text.encode() for name, text in (*read_engine_files().items(), read_engine_readme())}
    assert texts == {
        name: before[name] for name in before if name.startswith("engine/") and not name.endswith(CHECKSUM_LIST)
    }
    flags = ["-std=c11", "-O0", "-ffp-contract=off", "-fPIC", "-shared", "-I.", "-I.."]
    for scene in ("ideal", "two_seconds"):
        made = str(tmp_path.with_name(f"{tmp_path.name}.so"))
        command = [*find_compiler(), *flags, "scene.c", "../engine/engine.c", "-lm", "-o", made]
        done = subprocess.run(command, cwd=tmp_path / scene, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr[:2000]
    emit_c("pendulum", tmp_path, ("ideal",))
    assert contents(tmp_path) == before
    (tmp_path / "engine" / "run" / "mine.c").write_text("mine")
    with pytest.raises(InputError, match=r"engine/run contains files that `emit` did not write: mine\.c"):
        emit_c("pendulum", tmp_path, ())


def test_a_scene_that_is_called_as_the_engines_folder(source: list[KernelSource], tmp_path: Path) -> None:
    with pytest.raises(InputError, match="scene 'engine' cannot be emitted"):
        emit_c("x.yaml", tmp_path / "c", ("dry", "engine"))
    assert not (tmp_path / "c").exists()


@pytest.mark.parametrize("names", [("dry", "Engine"), ("dry", "Dry")])
def test_scenes_that_differ_in_capitals_alone_share_no_folder(
    names: tuple[str, ...], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """There are file systems that know no capitals: one would remove what the other wrote."""
    monkeypatch.setattr("gudgeon.commands.emit.select_scenes", lambda *_: names)
    with pytest.raises(InputError, match=f"scene '{names[1]}' cannot be emitted"):
        emit_c("pendulum", tmp_path / "c", ())
    assert not (tmp_path / "c").exists()

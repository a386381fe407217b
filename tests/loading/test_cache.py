"""The cache: an entry is there as a whole or not at all, and a bad folder is no reason to fail."""

from __future__ import annotations

import errno
import os
import threading
from collections.abc import Callable
from pathlib import Path

import pytest
from filelock import FileLock
from hypothesis import given, settings
from hypothesis import strategies as st

from gudgeon.errors import BuildError, CacheError
from gudgeon.loading import cache as cache_module
from gudgeon.loading.cache import (
    CHECKSUM_FILE,
    Cache,
    compute_digest,
    get_default_cache,
    get_private_cache,
    is_entry_complete,
)


@pytest.fixture
def folder(tmp_path: Path) -> Cache:
    return Cache(tmp_path / "cache")


class Writer:
    """Makes an entry of two files and counts how often it was asked to."""

    def __init__(self) -> None:
        self.calls = 0

    def __call__(self, folder: Path) -> None:
        self.calls += 1
        (folder / "a.bin").write_bytes(bytes(range(256)) * 40)
        (folder / "b.txt").write_text("text")


def snapshot(root: Path) -> dict[str, tuple[int, int]]:
    return {str(p): (p.stat().st_mtime_ns, p.stat().st_size) for p in [root, *root.rglob("*")]}


@settings(deadline=None)
@given(st.lists(st.binary(max_size=4), max_size=4), st.lists(st.binary(max_size=4), max_size=4))
def test_digest_tells_lists_apart(one: list[bytes], two: list[bytes]) -> None:
    assert (compute_digest(one) == compute_digest(two)) == (one == two)


def test_made_once_then_only_read(folder: Cache) -> None:
    make = Writer()
    entry = folder.fetch("kind", "key", make)
    before = snapshot(folder.root)
    assert folder.fetch("kind", "key", make) == entry
    assert make.calls == 1
    assert snapshot(folder.root) == before, "a hit must write nothing: the folder may be read-only"


def test_renew_makes_again(folder: Cache) -> None:
    make = Writer()
    folder.fetch("kind", "key", make)
    folder.fetch("kind", "key", make, renew=True)
    assert make.calls == 2


def test_not_visible_until_whole(folder: Cache) -> None:
    def make(work: Path) -> None:
        (work / "a").write_text("half")
        assert not (folder.root / "kind" / "key").exists()

    assert is_entry_complete(folder.fetch("kind", "key", make))


def test_a_failed_make_leaves_nothing(folder: Cache) -> None:
    def make(work: Path) -> None:
        (work / "a").write_text("half")
        raise BuildError("no")

    with pytest.raises(BuildError):
        folder.fetch("kind", "key", make)
    assert not (folder.root / "kind" / "key").exists()
    assert list((folder.root / "aside").iterdir()) == []


def cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-1])


def flip(path: Path) -> None:
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(data)


@pytest.mark.parametrize("name", ["a.bin", "b.txt", CHECKSUM_FILE])
@pytest.mark.parametrize("damage", [cut, flip, Path.unlink], ids=["cut", "flip", "remove"])
def test_a_damaged_entry_is_made_again(folder: Cache, name: str, damage: Callable[[Path], None]) -> None:
    make = Writer()
    damage(folder.fetch("kind", "key", make) / name)
    assert is_entry_complete(folder.fetch("kind", "key", make))
    # the newline at the end of the list is the one byte that nothing depends on
    assert make.calls == (1 if (name, damage) == (CHECKSUM_FILE, cut) else 2)


def test_a_list_cut_anywhere_is_noticed(folder: Cache) -> None:
    path = folder.fetch("kind", "key", Writer()) / CHECKSUM_FILE
    text = path.read_bytes().rstrip()
    for length in range(len(text)):
        path.write_bytes(text[:length])
        assert not is_entry_complete(path.parent), text[:length]


def test_a_file_in_place_of_an_entry_is_replaced(folder: Cache) -> None:
    (folder.root / "kind").mkdir(parents=True)
    (folder.root / "kind" / "key").write_text("in the way")
    assert is_entry_complete(folder.fetch("kind", "key", Writer()))


def test_leftovers_of_dead_processes_are_swept_and_those_at_work_are_not(folder: Cache) -> None:
    folder.fetch("kind", "first", Writer())
    aside = folder.root / "aside"
    dead, second, alive = (compute_digest([name]) for name in ("dead", "second", "alive"))
    for name in (f"{dead}.abcdefg1", f"{dead}.abcdefg2.old", f"{second}.abcdefg3", f"{alive}.abcdefg4"):
        (aside / name).mkdir()
        (aside / name / "half.so").write_bytes(b"half")
    with FileLock(folder.root / "locks" / f"{alive}.lock"):
        folder.fetch("kind", second, Writer())
        assert [path.name for path in aside.iterdir()] == [f"{alive}.abcdefg4"]


def test_the_sweep_removes_nothing_that_was_not_made_there(folder: Cache, tmp_path: Path) -> None:
    """Neither what a link leads to, nor what somebody else put aside."""
    precious = tmp_path / "precious"
    own = f"{compute_digest(['dead'])}.abcdefgh"
    for path in (precious, precious / own):
        path.mkdir()
    (precious / "file").write_text("precious")
    folder.fetch("kind", "first", Writer())
    aside = folder.root / "aside"
    (aside / own).symlink_to(precious)
    (aside / "notes.backup01").mkdir()
    (aside / "file").write_text("mine")
    folder.fetch("kind", "second", Writer())
    assert sorted(os.listdir(aside)) == sorted([own, "notes.backup01", "file"])
    for path in (aside / own, aside / "file"):
        path.unlink()
    (aside / "notes.backup01").rmdir()
    aside.rmdir()
    aside.symlink_to(precious)
    with pytest.warns(RuntimeWarning, match="cannot be used"):
        folder.fetch("kind", "third", Writer())
    assert sorted(os.listdir(precious)) == sorted([own, "file"])


def test_threads_make_it_once(folder: Cache) -> None:
    make, gate = Writer(), threading.Barrier(8)

    def ask() -> None:
        gate.wait()
        folder.fetch("kind", "key", make)

    threads = [threading.Thread(target=ask) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert make.calls == 1


def test_a_folder_that_cannot_be_made_falls_back_with_a_warning(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.warns(RuntimeWarning, match="GUDGEON_CACHE"):
        entry = Cache(tmp_path / "file" / "cache").fetch("kind", "key", Writer())
    assert is_entry_complete(entry)
    assert entry.is_relative_to(get_private_cache().root)


def test_a_name_that_the_system_has_not_falls_back(tmp_path: Path) -> None:
    cache = Cache(tmp_path / ("a" * 300))
    assert not cache.has_folder("kind", "key") and not cache.has_entry("kind", "key")
    with pytest.warns(RuntimeWarning, match="GUDGEON_CACHE"):
        assert is_entry_complete(cache.fetch("kind", "key", Writer()))


def test_a_limit_on_the_size_of_files_is_told_with_what_set_it(folder: Cache) -> None:
    def make(work: Path) -> None:
        raise OSError(errno.EFBIG, os.strerror(errno.EFBIG))

    with pytest.warns(RuntimeWarning, match="File too large"), pytest.raises(CacheError) as caught:
        folder.fetch("kind", "large", make)
    assert str(caught.value).endswith("File too large\n  a limit is set on the size of files (ulimit -f)")


def test_a_full_disk_falls_back_and_leaves_nothing(folder: Cache) -> None:
    def make(work: Path) -> None:
        (work / "a").write_text("half")
        if work.is_relative_to(folder.root):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with pytest.warns(RuntimeWarning, match="No space left"):
        assert is_entry_complete(folder.fetch("kind", "full", make))
    assert list((folder.root / "aside").iterdir()) == []


def test_nowhere_to_write_is_a_cache_error(tmp_path: Path) -> None:
    def make(work: Path) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with pytest.warns(RuntimeWarning), pytest.raises(CacheError, match="No space left"):
        Cache(tmp_path).fetch("kind", "nowhere", make)


def test_a_lock_held_too_long_falls_back(folder: Cache, monkeypatch: pytest.MonkeyPatch) -> None:
    folder.fetch("kind", "other", Writer())
    monkeypatch.setattr(cache_module, "LOCK_SECONDS", 0.0)
    with FileLock(folder.root / "locks" / "held.lock"), pytest.warns(RuntimeWarning, match="cannot be used"):
        assert is_entry_complete(folder.fetch("kind", "held", Writer()))


def test_the_environment_names_the_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GUDGEON_CACHE", str(tmp_path / "mine"))
    assert get_default_cache().root == tmp_path / "mine"
    monkeypatch.setenv("GUDGEON_CACHE", "")
    assert get_default_cache().root.name == "gudgeon"
    assert get_default_cache().root.is_absolute()

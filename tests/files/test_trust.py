"""What another user may write is not loaded: the folder, the way to it, an entry; told once, with what to do."""

from __future__ import annotations

import hashlib
import os
import shutil
import stat
import tempfile
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gudgeon.errors import CacheError
from gudgeon.files import trust
from gudgeon.files.trust import UntrustedPathError, check_trusted_path
from gudgeon.loading.cache import CHECKSUM_FILE, Cache, get_private_cache, is_entry_complete
from tests.loading.test_cache import Writer

OTHER = 54321  # a user who is neither we nor root


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """A cache folder with an entry of each of two keys."""
    for key in ("one", "two"):
        Cache(tmp_path / "cache").fetch("models", key, text(key))
    return tmp_path / "cache"


def text(what: str) -> Callable[[Path], None]:
    def make(folder: Path) -> None:
        (folder / "text").write_text(what)

    return make


@pytest.fixture
def give(monkeypatch: pytest.MonkeyPatch) -> Callable[[Path], None]:
    """Makes a path look as if it belonged to another user."""
    given: set[tuple[int, int]] = set()

    def watch(real: Callable[..., os.stat_result]) -> Callable[..., os.stat_result]:
        def look(*args: Any, **kwargs: Any) -> os.stat_result:
            found = real(*args, **kwargs)
            if (found.st_dev, found.st_ino) in given:
                return os.stat_result([*found[:4], OTHER, *found[5:10]])
            return found

        return look

    def to_another(path: Path) -> None:
        found = path.lstat()
        given.add((found.st_dev, found.st_ino))

    for name in ("stat", "lstat", "fstat"):
        monkeypatch.setattr(os, name, watch(getattr(os, name)))
    return to_another


def open_to(bits: int) -> Callable[[Path], None]:
    return lambda path: path.chmod(path.stat().st_mode | bits)


@pytest.mark.parametrize("what", ["group", "others", "another's"])
@pytest.mark.parametrize("where", [".", "models", "models/one", "models/one/text", f"models/one/{CHECKSUM_FILE}"])
def test_what_others_may_write_is_not_used(root: Path, give: Callable[[Path], None], where: str, what: str) -> None:
    (root / "models" / "one" / "text").write_bytes(b"evil")
    sums = root / "models" / "one" / CHECKSUM_FILE
    sums.write_text(f"{hashlib.sha256(b'evil').hexdigest()} text\n{sums.read_text().splitlines()[-1]}\n")
    assert is_entry_complete(root / "models" / "one"), "checksums and all"
    {"group": open_to(0o020), "others": open_to(0o002), "another's": give}[what](root / where)
    with warnings.catch_warnings(record=True) as message:
        warnings.simplefilter("always")
        entries = [Cache(root).fetch("models", "one", text("mine")) for _ in range(3)]
    assert {(entry / "text").read_text() for entry in entries} == {"mine"}
    assert len(message) == 1, [str(t.message) for t in message]
    assert str(root) in str(message[0].message)
    if where in (".", "models"):
        assert "chmod" in str(message[0].message) and "GUDGEON_CACHE" in str(message[0].message)
        assert entries[0].is_relative_to(get_private_cache().root)
        assert stat.S_IMODE(get_private_cache().root.stat().st_mode) == 0o700


def test_entries_that_were_swapped_are_noticed(root: Path) -> None:
    one, two = root / "models" / "one", root / "models" / "two"
    one.rename(root / "models" / "x")
    two.rename(one)
    (root / "models" / "x").rename(two)
    assert not is_entry_complete(one) and not is_entry_complete(two)
    assert (Cache(root).fetch("models", "one", text("one")) / "text").read_text() == "one"
    other = root / "scenes"
    (root / "models").rename(other)
    assert is_entry_complete(root / "scenes" / "one") is False, "another kind"


def test_a_folder_above_that_others_may_write_lets_them_swap_it(tmp_path: Path, give: Callable[[Path], None]) -> None:
    above = tmp_path / "above"
    (above / "mine").mkdir(parents=True, mode=0o700)
    check_trusted_path(above / "mine")
    above.chmod(0o777)
    with pytest.raises(UntrustedPathError, match="everybody may write"):
        check_trusted_path(above / "mine")
    with pytest.raises(UntrustedPathError, match="everybody may write"):
        check_trusted_path(above / "not yet there")
    above.chmod(0o1777)  # as /tmp: names stay their owners'
    check_trusted_path(above / "mine")
    above.chmod(0o755)
    give(above)
    with pytest.raises(UntrustedPathError, match=f"uid {OTHER}"):
        check_trusted_path(above / "mine")


def test_links_on_the_way_are_followed_as_the_kernel_does(tmp_path: Path, give: Callable[[Path], None]) -> None:
    (tmp_path / "open").mkdir()
    (tmp_path / "open").chmod(0o777)
    (tmp_path / "open" / "mine").mkdir(mode=0o700)
    (tmp_path / "safe" / "cache").mkdir(parents=True, mode=0o700)
    (tmp_path / "in").symlink_to("safe/../open/mine")
    (tmp_path / "good").symlink_to(tmp_path / "safe")
    (tmp_path / "open" / "out").symlink_to("../safe")
    check_trusted_path(tmp_path / "good" / "cache")
    for way in ("in", "open/out/cache", "good/../open/mine"):
        with pytest.raises(UntrustedPathError, match="open"):
            check_trusted_path(tmp_path / way)
    (tmp_path / "circle").symlink_to("circle")
    with pytest.raises(OSError):
        check_trusted_path(tmp_path / "circle")
    give(tmp_path / "good")
    with pytest.raises(UntrustedPathError, match="good"):
        check_trusted_path(tmp_path / "good" / "cache")


def test_a_group_of_the_user_alone_may_write_above(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As with a umask of 002, where each user has a group; not the cache folder itself, as ssh has it."""
    (tmp_path / "home" / "cache").mkdir(parents=True, mode=0o700)
    (tmp_path / "home").chmod(0o775)
    monkeypatch.setattr(trust, "_is_private_group", lambda group: True)
    check_trusted_path(tmp_path / "home" / "cache")
    with pytest.raises(UntrustedPathError):
        check_trusted_path(tmp_path / "home")
    monkeypatch.setattr(trust, "_is_private_group", lambda group: False)
    with pytest.raises(UntrustedPathError, match="the group"):
        check_trusted_path(tmp_path / "home" / "cache")


def test_roots_folders_are_trusted_and_in_a_container_without_root_nobodys(
    root: Path, monkeypatch: pytest.MonkeyPatch, give: Callable[[Path], None]
) -> None:
    """An administrator's cache that all may read; and the system's folders where users are numbered anew."""
    owner = root.stat().st_uid
    if owner == 0:
        monkeypatch.setattr(os, "geteuid", lambda: 1000)
        check_trusted_path(root)
        assert is_entry_complete(root / "models" / "one")
    give(root.parent)
    monkeypatch.setattr(trust, "_read_overflow_user", lambda: OTHER)
    with pytest.raises(UntrustedPathError):
        check_trusted_path(root)
    monkeypatch.setattr(trust, "_is_root_unmapped", lambda: True)
    check_trusted_path(root)


def test_what_we_make_is_ours_alone_whatever_the_umask(tmp_path: Path) -> None:
    mask = os.umask(0)
    try:
        entry = Cache(tmp_path / "new" / "cache").fetch("kind", "key", Writer())
    finally:
        os.umask(mask)
    for folder in (tmp_path / "new", tmp_path / "new" / "cache", entry.parent, entry, tmp_path / "new/cache/aside"):
        assert stat.S_IMODE(folder.stat().st_mode) == 0o700, folder
    assert is_entry_complete(entry)


def test_a_file_that_is_a_link_is_not_read(root: Path) -> None:
    entry = root / "models" / "one"
    (entry / "text").rename(root / "text")
    (entry / "text").symlink_to(root / "text")
    assert not is_entry_complete(entry)


def test_a_list_that_leads_out_of_the_entry_is_not_read(root: Path) -> None:
    entry = root / "models" / "one"
    (entry / "text").rename(root / "text")
    listed = (entry / CHECKSUM_FILE).read_text()
    (entry / CHECKSUM_FILE).write_text(listed.replace(" text", " ../../text"))
    assert not is_entry_complete(entry)


def test_a_temporary_folder_that_is_anothers_is_an_error(tmp_path: Path, give: Callable[[Path], None]) -> None:
    (tmp_path / "private").mkdir()
    give(tmp_path / "private")
    with pytest.raises(CacheError, match=f"uid {OTHER}"):
        Cache(tmp_path / "private", private=True).fetch("kind", "key", Writer())


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can be another user")
def test_what_another_user_put_into_a_shared_folder_is_not_loaded() -> None:
    """As in a cache that a group shares: an entry is replaced, checksums and all, by a process of that user."""
    above = Path(tempfile.mkdtemp())
    try:
        above.chmod(0o755)
        shared = above / "cache"
        Cache(shared).fetch("models", "shared", text("honest"))
        for path in (shared, *shared.rglob("*")):
            path.chmod(0o777 if path.is_dir() else 0o666)
        entry = shared / "models" / "shared"
        child = os.fork()
        if child == 0:
            try:
                os.setgroups([])
                os.setgid(OTHER)
                os.setuid(OTHER)
                end = (entry / CHECKSUM_FILE).read_text().splitlines()[-1]
                for path in (entry / "text", entry / CHECKSUM_FILE):
                    path.unlink()
                (entry / "text").write_text("evil")
                (entry / CHECKSUM_FILE).write_text(f"{hashlib.sha256(b'evil').hexdigest()} text\n{end}\n")
            finally:
                os._exit(0)
        os.waitpid(child, 0)
        assert (entry / "text").read_text() == "evil"
        with pytest.warns(RuntimeWarning, match="not used"):
            assert (Cache(shared).fetch("models", "shared", text("honest")) / "text").read_text() == "honest"
        shared.chmod(0o700)  # made the user's own again, and the entry in it was not looked at
        (shared / "models").chmod(0o700)
        with pytest.warns(RuntimeWarning, match="created again"):
            assert (Cache(shared).fetch("models", "shared", text("honest")) / "text").read_text() == "honest"
    finally:
        shutil.rmtree(above)

"""The cache folder: an entry is there as a whole or not at all, and is made once however many ask for it.

An entry is a folder `<kind>/<key>/` with a list of checksums. It is made aside, under a lock of its own,
and moved in by one rename, so that a process killed at any moment leaves nothing that a later one trusts.
Reading takes no lock and writes nothing. A folder that cannot be written (read-only, full, no locks) is
replaced by a private temporary one for the rest of the process, with a warning: a cache must never be
the reason why a run fails.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Iterable
from functools import cache
from hashlib import sha256
from pathlib import Path

from gudgeon.errors import CacheError

LIST = "checksums"
END = "whole"  # last line of the list: without it the list itself was cut short
LOCK_SECONDS = 300.0  # longer than any compile; a lock held longer is a process that hangs

Make = Callable[[Path], None]  # writes the files of an entry into the empty folder that it is given


def digest(parts: Iterable[str | bytes]) -> str:
    """SHA-256 of the parts in order; the lengths go in too, so that ("ab", "c") is not ("a", "bc")."""
    total = sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        total.update(b"%d:" % len(data))
        total.update(data)
    return total.hexdigest()


class Cache:
    """Entries by kind and key in one folder."""

    def __init__(self, root: str | os.PathLike[str], *, private: bool = False) -> None:
        self.root = Path(root)
        self.private = private  # dies with the process: what fails here fails for good

    def fetch(self, kind: str, key: str, make: Make, *, renew: bool = False) -> Path:
        """The folder of an entry; `make` is called if it is not there, is damaged, or `renew` is asked for.

        Errors of `make` pass through, except that an OSError counts as the folder's fault: the entry is
        then made in a private folder. Raises CacheError if even that is impossible.
        """
        entry = self.root / kind / key
        if not renew and is_whole(entry):
            return entry
        try:
            return self._make(entry, make, renew)
        except OSError as error:
            if self.private:
                raise CacheError(f"cannot write to the temporary folder {self.root}: {error}") from error
            warnings.warn(
                f"the cache folder {self.root} cannot be used ({error}); what this process compiles is not kept. "
                "Set GUDGEON_CACHE to a folder that can be written.",
                RuntimeWarning,
                stacklevel=2,
            )
            return private_cache().fetch(kind, key, make, renew=renew)

    def _make(self, entry: Path, make: Make, renew: bool) -> Path:
        import tempfile

        from filelock import FileLock  # 40 ms: only when something has to be made

        aside = self.root / "aside"
        for folder in (aside, self.root / "locks", entry.parent):
            folder.mkdir(parents=True, exist_ok=True)
        with FileLock(self._lock(entry.name), timeout=LOCK_SECONDS):
            if not renew and is_whole(entry):  # another process made it while this one waited
                return entry
            self._sweep(aside, entry.name)
            work = Path(tempfile.mkdtemp(prefix=f"{entry.name}.", dir=aside))
            old = work.with_name(work.name + ".old")
            try:
                make(work)
                _seal(work)
                if os.path.lexists(entry):  # a damaged one: a rename cannot replace a folder that has files
                    os.replace(entry, old)
                os.replace(work, entry)
            finally:
                _remove(work)
                _remove(old)
        return entry

    def _lock(self, key: str) -> Path:
        return self.root / "locks" / f"{key}.lock"

    def _sweep(self, aside: Path, held: str) -> None:
        """Remove what killed processes left: every folder aside whose key nobody holds (but this process)."""
        from filelock import FileLock, Timeout

        for folder in aside.iterdir():
            key = folder.name.partition(".")[0]
            if key == held:
                _remove(folder)
                continue
            try:
                with FileLock(self._lock(key), timeout=0):
                    _remove(folder)
            except Timeout:
                continue  # somebody is at work there


def is_whole(entry: Path) -> bool:
    """Whether every file of the entry is there with the bytes that were put in."""
    try:
        lines = (entry / LIST).read_text().splitlines()
        if not lines or lines.pop() != END:
            return False
        return all(sha256((entry / name).read_bytes()).hexdigest() == sum_ for sum_, name in map(str.split, lines))
    except (OSError, ValueError):
        return False


def _seal(folder: Path) -> None:
    names = sorted(path.name for path in folder.iterdir() if path.is_file())
    lines = [f"{sha256((folder / name).read_bytes()).hexdigest()} {name}" for name in names]
    (folder / LIST).write_text("\n".join([*lines, END]) + "\n")


def _remove(path: Path) -> None:
    import shutil

    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)  # a compiler that outlived its parent may still write here
    else:
        path.unlink(missing_ok=True)


def default_cache() -> Cache:
    """The user's cache: $GUDGEON_CACHE, or the platform's folder for caches."""
    chosen = os.environ.get("GUDGEON_CACHE")
    if chosen:
        return Cache(Path(chosen).expanduser().absolute())
    return Cache(_user_folder())


@cache
def _user_folder() -> str:
    from platformdirs import user_cache_dir

    return user_cache_dir("gudgeon", appauthor=False)


@cache
def private_cache() -> Cache:
    """A folder of this process alone, removed when it ends."""
    import atexit
    import shutil
    import tempfile

    try:
        root = tempfile.mkdtemp(prefix="gudgeon-")
    except OSError as error:
        raise CacheError(f"neither the cache folder nor a temporary one can be written: {error}") from error
    owner = os.getpid()

    def remove() -> None:
        if os.getpid() == owner:  # not in a forked worker that ends before its parent
            shutil.rmtree(root, ignore_errors=True)

    atexit.register(remove)
    return Cache(root, private=True)

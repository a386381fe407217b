"""The cache folder: an entry is there as a whole or not at all, and is made once however many ask for it.

An entry is a folder `<kind>/<key>/` with a list of checksums. It is made aside, under a lock of its own,
and moved in by one rename, so that a process killed at any moment leaves nothing that a later one trusts.
Reading takes no lock and writes nothing. A folder that cannot be written (read-only, full, no locks) is
replaced by a private temporary one for the rest of the process, with a warning: a cache must never be
the reason why a run fails.

What is in it is loaded and run, so a folder that another user may write is not used either, nor an entry that another
user may have written (trust.py); the list of checksums holds kind and key, so that no entry stands for another.
"""

from __future__ import annotations

import errno
import os
import re
import stat
import warnings
from collections.abc import Callable, Iterable
from functools import cache
from hashlib import sha256
from pathlib import Path

from gudgeon.errors import LIMITED, BadValueError, CacheError
from gudgeon.files.trust import Untrusted, check_folder, check_way, read
from gudgeon.waiting.ctrl_c import CtrlC

LIST = "checksums"
END = "whole"  # begins the last line of the list: without it the list itself was cut short
ASIDE = re.compile(r"[0-9a-f]{64}\.[a-z0-9_]{8}(\.old)?")  # folders that `_make` makes: the key, and mkdtemp's letters
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
        try:
            self._check(kind)
            entry = self.root / kind / key
            if not renew and _usable(entry):
                return entry
            return self._make(entry, make, renew)
        except (OSError, Untrusted) as error:
            if self.private:
                told = f"the temporary folder {self.root} cannot be used: {error}"
                is_limit = getattr(error, "errno", 0) == errno.EFBIG and "ulimit" not in told
                raise CacheError(f"{told}\n  {LIMITED}" if is_limit else told) from error
            self._tell(error)
        return private_cache().fetch(kind, key, make, renew=renew)

    def has(self, kind: str, key: str) -> bool:
        """Whether an entry is there, whole."""
        try:
            self._check(kind)
            return is_whole(self.root / kind / key)
        except (OSError, Untrusted):
            return False

    def holds(self, kind: str, key: str) -> bool:
        """Whether there is such an entry, whole or not: one look."""
        return os.path.exists(self.root / kind / key)  # False too where the system has no such long name

    def _check(self, *folders: str) -> None:
        """Untrusted if what is in the cache or these folders of it may be another user's; they need not be there.

        The way to a temporary folder is the system's.
        """
        try:
            if self.private:
                check_folder(self.root)
            else:
                check_way(self.root)
            for folder in folders:
                check_folder(self.root / folder)
        except FileNotFoundError:
            return

    def _tell(self, error: OSError | Untrusted) -> None:
        what = f"the cache folder {self.root} cannot be used ({error})"
        do = "Set GUDGEON_CACHE to a folder that can be written."
        if isinstance(error, Untrusted):
            what = f"the cache folder {self.root} is not used: {error}, and code in it would run as you"
            do = "Set GUDGEON_CACHE to a folder that is yours alone."
            if self.root.is_dir():
                do = f"Make it yours alone (chown; chmod -R go-w {self.root}) or set GUDGEON_CACHE to a folder that is."
        tell_once(f"{what}; what this process compiles is not kept. {do}", f"{self.root}")

    def _make(self, entry: Path, make: Make, renew: bool) -> Path:
        import tempfile

        from filelock import FileLock  # 40 ms: only when something has to be made

        aside = self.root / "aside"
        for folder in (self.root, aside, self.root / "locks", entry.parent):
            _own_folder(folder)
        self._check("aside", "locks", entry.parent.name)  # somebody may have been quicker to make them
        with FileLock(self._lock(entry.name), timeout=LOCK_SECONDS):
            if not renew and _usable(entry):  # another process made it while this one waited
                return entry
            left: list[Path] = []
            try:
                with CtrlC() as ctrl_c:  # not between a folder and the note of it, nor where a lock's end swallows it
                    self._sweep(aside, entry.name)
                    work = Path(tempfile.mkdtemp(prefix=f"{entry.name}.", dir=aside))
                    old = work.with_name(work.name + ".old")
                    left += [work, old]
                ctrl_c.take()
                make(work)
                _seal(work, entry)
                if os.path.lexists(entry):  # a damaged one: a rename cannot replace a folder that has files
                    os.replace(entry, old)
                os.replace(work, entry)
            finally:
                for folder in left:
                    _remove(folder)
        return entry

    def _lock(self, key: str) -> Path:
        return self.root / "locks" / f"{key}.lock"

    def _sweep(self, aside: Path, held: str) -> None:
        """Remove what killed processes left: our folders aside whose key nobody holds (but this process)."""
        from filelock import FileLock, Timeout

        for folder in aside.iterdir():
            if not ASIDE.fullmatch(folder.name) or not _own(folder):
                continue  # nothing that was made here
            key = folder.name.partition(".")[0]
            if key == held:
                _remove(folder)
                continue
            try:
                with FileLock(self._lock(key), timeout=0):
                    _remove(folder)
            except Timeout:
                continue  # somebody is at work there


def _own_folder(path: Path) -> None:
    """Make a folder, and those above it, for the user alone."""
    for folder in reversed([path, *path.parents]):
        if not folder.is_dir():
            folder.mkdir(mode=0o700, exist_ok=True)


def _own(folder: Path) -> bool:
    """Whether it is a folder, no link, and the user's."""
    found = folder.lstat()
    return stat.S_ISDIR(found.st_mode) and found.st_uid == os.geteuid()


def tell_once(text: str, about: str = "") -> None:
    """A warning, once in a process however many entries are asked for."""
    if (about or text) not in _told:
        _told.add(about or text)
        warnings.warn(text, RuntimeWarning, stacklevel=4)


_told: set[str] = set()


def _usable(entry: Path) -> bool:
    """Whether an entry is whole; a warning if another user may have written it."""
    try:
        return is_whole(entry)
    except Untrusted as error:
        tell_once(f"an entry of the cache is not used, since {error}; it is made anew")
        return False


def is_whole(entry: Path) -> bool:
    """Whether every file of the entry is there with the bytes that were put in under its kind and key.

    Raises Untrusted if another user may have put them there.
    """
    try:
        check_folder(entry)
        lines = read(entry / LIST).decode().splitlines()
        if not lines or lines.pop() != _end(entry):
            return False
        pairs = [line.split(" ", 1) for line in lines]
        if any(os.path.basename(name) != name for _, name in pairs):
            return False
        return all(sha256(read(entry / name)).hexdigest() == sum_ for sum_, name in pairs)
    except (OSError, ValueError):
        return False


def _end(entry: Path) -> str:
    return f"{END} {entry.parent.name} {entry.name}"


def _seal(folder: Path, entry: Path) -> None:
    """The list of an entry's checksums; its files become the user's alone to write, whatever the umask says."""
    paths = sorted(path for path in folder.iterdir() if path.is_file())
    lines = [f"{sha256(path.read_bytes()).hexdigest()} {path.name}" for path in paths]
    (folder / LIST).write_text("\n".join([*lines, _end(entry)]) + "\n")
    for path in (*paths, folder / LIST):
        path.chmod(path.stat().st_mode & ~0o022)


def _remove(path: Path) -> None:
    import shutil

    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)  # a compiler that outlived its parent may still write here
    else:
        path.unlink(missing_ok=True)


def default_cache() -> Cache:
    """The user's cache: $GUDGEON_CACHE, or the platform's folder for caches. BadValueError for "~nobody"."""
    chosen = os.environ.get("GUDGEON_CACHE")
    if chosen:
        try:
            return Cache(Path(chosen).expanduser().absolute())
        except RuntimeError as error:
            hint = "name a folder by its path, or leave the variable out"
            raise BadValueError(f"GUDGEON_CACHE={chosen}: no such user, or no home folder", hint=hint) from error
    folder = _user_folder()
    if os.path.isabs(folder):
        return Cache(folder)
    tell_once("no home folder is known; what this process compiles is not kept. Set GUDGEON_CACHE to a folder.")
    return private_cache()


@cache
def _user_folder() -> str:
    from platformdirs import user_cache_dir

    return user_cache_dir("gudgeon", appauthor=False)


@cache
def private_cache() -> Cache:
    """A folder of this process alone, removed when it ends."""
    import atexit

    from gudgeon.files.temporary import TemporaryFolder

    try:
        folder = TemporaryFolder()
    except OSError as error:
        raise CacheError(f"neither the cache folder nor a temporary one can be written: {error}") from error
    owner = os.getpid()

    def remove() -> None:
        if os.getpid() == owner:  # not in a forked worker that ends before its parent
            folder.remove()

    atexit.register(remove)
    return Cache(folder.path, private=True)

"""Store compiled libraries and generated C sources in a cache on disk, each entry created by one process only.

An entry is a folder `<kind>/<key>/` with a list of checksums. It is written in a temporary folder under a lock, and
moved into place by one rename (atomically), so that a killed process leaves no incomplete entry. Reading needs no lock
and writes nothing. If the folder cannot be written (read-only, full, no locks), a private temporary one replaces it for
the rest of the process, with a warning.

Files in the cache are executed. A folder that another user may write is therefore not used, nor an entry that another
user may have written (trust.py). The list of checksums contains kind and key, so that no entry can replace another.
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

from gudgeon.errors import FILE_SIZE_LIMIT_HINT, BadValueError, CacheError
from gudgeon.files.trust import UntrustedPathError, check_trusted_folder, check_trusted_path, read_trusted_file
from gudgeon.waiting.ctrl_c import DelayedCtrlC

CHECKSUM_FILE = "checksums"
LAST_LINE_PREFIX = "whole"  # begins the last line of the list; without it the list is incomplete
# names of temporary folders of `_make_entry`: the key, and the letters of mkdtemp
TEMPORARY_NAME = re.compile(r"[0-9a-f]{64}\.[a-z0-9_]{8}(\.old)?")
LOCK_SECONDS = 300.0  # longer than any compilation; a lock held longer means a process that hangs

WriteFiles = Callable[[Path], None]  # function that writes the files of an entry into an empty folder


def compute_digest(parts: Iterable[str | bytes]) -> str:
    """Return the SHA-256 of the parts in order, with their lengths, so that ("ab", "c") differs from ("a", "bc")."""
    total = sha256()
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        total.update(b"%d:" % len(data))
        total.update(data)
    return total.hexdigest()


class Cache:
    """Store entries by kind and key in one folder."""

    def __init__(self, root: str | os.PathLike[str], *, private: bool = False) -> None:
        self.root = Path(root)
        self.private = private  # whether it is removed with the process, so that errors in it are final

    def fetch(self, kind: str, key: str, write_files: WriteFiles, *, renew: bool = False) -> Path:
        """Return the folder of an entry; `write_files` writes it if it is absent or damaged, or if `renew` is set.

        Errors of `write_files` are passed on, except OSError, which counts as a fault of the folder: the entry is then
        created in a private temporary cache, with a warning. Raises CacheError if even that fails.
        """
        try:
            self._check_trusted(kind)
            entry = self.root / kind / key
            if not renew and _is_usable(entry):
                return entry
            return self._make_entry(entry, write_files, renew)
        except (OSError, UntrustedPathError) as error:
            if self.private:
                message = f"the temporary folder {self.root} cannot be used: {error}"
                is_limit = getattr(error, "errno", 0) == errno.EFBIG and "ulimit" not in message
                raise CacheError(f"{message}\n  {FILE_SIZE_LIMIT_HINT}" if is_limit else message) from error
            self._warn_unusable(error)
        return get_private_cache().fetch(kind, key, write_files, renew=renew)

    def has_entry(self, kind: str, key: str) -> bool:
        """Return whether a complete entry exists."""
        try:
            self._check_trusted(kind)
            return is_entry_complete(self.root / kind / key)
        except (OSError, UntrustedPathError):
            return False

    def has_folder(self, kind: str, key: str) -> bool:
        """Return whether the folder of an entry exists, complete or not; this is faster than `has_entry`."""
        return os.path.exists(self.root / kind / key)  # False too for names that are too long for the system

    def _check_trusted(self, *folders: str) -> None:
        """Raise UntrustedPathError if another user may have written the cache or its subfolders; folders may be absent.

        The path to a temporary (private) cache is not checked.
        """
        try:
            if self.private:
                check_trusted_folder(self.root)
            else:
                check_trusted_path(self.root)
            for folder in folders:
                check_trusted_folder(self.root / folder)
        except FileNotFoundError:
            return

    def _warn_unusable(self, error: OSError | UntrustedPathError) -> None:
        """Warn once that the cache folder cannot be used, why, and what the user can do."""
        what = f"the cache folder {self.root} cannot be used ({error})"
        do = "Set GUDGEON_CACHE to a folder that can be written."
        if isinstance(error, UntrustedPathError):
            what = f"the cache folder {self.root} is not used: {error}, and code in it would run with your rights"
            do = "Set GUDGEON_CACHE to a folder that only you can write."
            if self.root.is_dir():
                do = f"Let only you write it (chown; chmod -R go-w {self.root}), or set GUDGEON_CACHE to such a folder."
        warn_once(f"{what}; libraries that this process compiles are not stored. {do}", f"{self.root}")

    def _make_entry(self, entry: Path, write_files: WriteFiles, renew: bool) -> Path:
        """Create an entry under a lock in a temporary folder, and move it into place; return its path.

        An entry that another process created in the meantime is used, unless `renew` is set. A damaged one is replaced.
        Temporary folders are removed in any case.
        """
        import tempfile

        from filelock import FileLock  # takes 40 ms: imported only to create an entry

        temporary_root = self.root / "aside"
        for folder in (self.root, temporary_root, self.root / "locks", entry.parent):
            _make_private_folder(folder)
        self._check_trusted("aside", "locks", entry.parent.name)  # another process may have created them
        with FileLock(self._get_lock_path(entry.name), timeout=LOCK_SECONDS):
            if not renew and _is_usable(entry):  # another process created it while this one waited
                return entry
            temporary_folders: list[Path] = []
            try:
                with (
                    DelayedCtrlC() as ctrl_c
                ):  # Ctrl-C must not come between the creation of a folder and its record, nor be lost with the lock
                    self._remove_abandoned_folders(temporary_root, entry.name)
                    work = Path(tempfile.mkdtemp(prefix=f"{entry.name}.", dir=temporary_root))
                    old = work.with_name(work.name + ".old")
                    temporary_folders += [work, old]
                ctrl_c.raise_delayed()
                write_files(work)
                _write_checksums(work, entry)
                if os.path.lexists(entry):  # a damaged entry: a rename cannot replace a folder with files
                    os.replace(entry, old)
                os.replace(work, entry)
            finally:
                for folder in temporary_folders:
                    _remove_path(folder)
        return entry

    def _get_lock_path(self, key: str) -> Path:
        """Return the path of the lock file of a key."""
        return self.root / "locks" / f"{key}.lock"

    def _remove_abandoned_folders(self, temporary_root: Path, locked_key: str) -> None:
        """Remove the temporary folders of killed processes: those in `temporary_root` whose key no process has locked.

        `locked_key`: key that this process has locked.
        """
        from filelock import FileLock, Timeout

        for folder in temporary_root.iterdir():
            if not TEMPORARY_NAME.fullmatch(folder.name) or not _is_own_folder(folder):
                continue  # not a folder of this cache
            key = folder.name.partition(".")[0]
            if key == locked_key:
                _remove_path(folder)
                continue
            try:
                with FileLock(self._get_lock_path(key), timeout=0):
                    _remove_path(folder)
            except Timeout:
                continue  # another process uses the folder


def _make_private_folder(path: Path) -> None:
    """Create a folder and its missing parents with permissions for the user only; existing ones stay unchanged."""
    for folder in reversed([path, *path.parents]):
        if not folder.is_dir():
            folder.mkdir(mode=0o700, exist_ok=True)


def _is_own_folder(folder: Path) -> bool:
    """Return whether a path is a folder, not a link, that belongs to the user."""
    status = folder.lstat()
    return stat.S_ISDIR(status.st_mode) and status.st_uid == os.geteuid()


def warn_once(text: str, warning_key: str = "") -> None:
    """Issue a RuntimeWarning unless one with the same `warning_key`, or the same text, was issued in this process."""
    if (warning_key or text) not in _issued_warnings:
        _issued_warnings.add(warning_key or text)
        warnings.warn(text, RuntimeWarning, stacklevel=4)


_issued_warnings: set[str] = set()  # warnings that were issued


def _is_usable(entry: Path) -> bool:
    """Return whether a cache entry is complete; warn, and return False, if another user may have written it."""
    try:
        return is_entry_complete(entry)
    except UntrustedPathError as error:
        warn_once(f"an entry of the cache is not used, since {error}; it is created again")
        return False


def is_entry_complete(entry: Path) -> bool:
    """Return whether a cache entry is complete: every listed file has the bytes stored under its kind and key.

    Raises UntrustedPathError if another user may have written it.
    """
    try:
        check_trusted_folder(entry)
        lines = read_trusted_file(entry / CHECKSUM_FILE).decode().splitlines()
        if not lines or lines.pop() != _format_last_line(entry):
            return False
        pairs = [line.split(" ", 1) for line in lines]
        if any(os.path.basename(name) != name for _, name in pairs):
            return False
        return all(sha256(read_trusted_file(entry / name)).hexdigest() == sum_ for sum_, name in pairs)
    except (OSError, ValueError):
        return False


def _format_last_line(entry: Path) -> str:
    """Return the last line of an entry's list of checksums."""
    return f"{LAST_LINE_PREFIX} {entry.parent.name} {entry.name}"


def _write_checksums(folder: Path, entry: Path) -> None:
    """Write the list of checksums of an entry in `folder`, and remove write permissions of other users.

    `entry`: final path, whose kind and key are in the list.
    """
    paths = sorted(path for path in folder.iterdir() if path.is_file())
    lines = [f"{sha256(path.read_bytes()).hexdigest()} {path.name}" for path in paths]
    (folder / CHECKSUM_FILE).write_text("\n".join([*lines, _format_last_line(entry)]) + "\n")
    for path in (*paths, folder / CHECKSUM_FILE):
        path.chmod(path.stat().st_mode & ~0o022)


def _remove_path(path: Path) -> None:
    """Remove a file, link or folder with its contents; an absent one is ignored."""
    import shutil

    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)  # a compiler of a killed process may still write here
    else:
        path.unlink(missing_ok=True)


def get_default_cache() -> Cache:
    """Return the user's cache: $GUDGEON_CACHE, or the platform's cache folder.

    Without a home folder, a private cache is returned with a warning. Raises BadValueError for "~nobody".
    """
    selected = os.environ.get("GUDGEON_CACHE")
    if selected:
        try:
            return Cache(Path(selected).expanduser().absolute())
        except RuntimeError as error:
            hint = "name a folder by its path, or leave the variable out"
            raise BadValueError(f"GUDGEON_CACHE={selected}: no such user, or no home folder", hint=hint) from error
    folder = _find_user_folder()
    if os.path.isabs(folder):
        return Cache(folder)
    warn_once(
        "no home folder is known; libraries that this process compiles are not stored. Set GUDGEON_CACHE to a folder."
    )
    return get_private_cache()


@cache
def _find_user_folder() -> str:
    """Return the platform's cache folder for gudgeon."""
    from platformdirs import user_cache_dir

    return user_cache_dir("gudgeon", appauthor=False)


@cache
def get_private_cache() -> Cache:
    """Return the cache in a temporary folder of this process, created at the first call and removed when the process
    ends.

    Raises CacheError if it cannot be created.
    """
    import atexit

    from gudgeon.files.temporary import TemporaryFolder

    try:
        folder = TemporaryFolder()
    except OSError as error:
        raise CacheError(f"neither the cache folder nor a temporary one can be written: {error}") from error
    owner = os.getpid()

    def remove_folder() -> None:
        """Remove the folder at the end of the process that created it."""
        if os.getpid() == owner:  # not in a forked process that ends before its parent
            folder.remove_folder()

    atexit.register(remove_folder)
    return Cache(folder.path, private=True)

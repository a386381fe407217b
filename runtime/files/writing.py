"""Write all files for users: to a temporary name first, then moved into place.

The old file stays complete until the new one is; a full disk, a limit or Ctrl-C leaves nothing behind. The temporary
name is random and opened exclusively within the opened folder, so that nothing outside it is written. A link in the
place of a file is replaced, not followed. Devices, pipes, sockets and write-protected files are refused. The new file
gets the permissions of the old one and, if allowed, its owner.
"""

from __future__ import annotations

import errno
import os
import re
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from gudgeon.errors import OutputError

PART = re.compile(r"\.gudgeon-[0-9a-f]{16}\.part")  # temporary names, which a killed process may leave
LARGEST = 1 << 26  # bytes of the largest file that may be an emitted one
_OPEN = os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC | os.O_NOFOLLOW
_FOLDER = getattr(os, "O_PATH", os.O_RDONLY) | os.O_DIRECTORY | os.O_CLOEXEC  # O_PATH: a folder of which no list is had


class AtomicFiles:
    """Write files of one folder under temporary names and move them into place; a context.

    The folder is made if it does not exist; follow: it may be a link. Files that were not moved are removed at the end
    of the context, after an error also the folders that were made. sync: each file reaches the disk before it is moved,
    for results that cannot be repeated. Without it, a power failure may lose both files on some file systems.
    """

    def __init__(self, folder: str | os.PathLike[str], *, sync: bool = False, follow: bool = True) -> None:
        self.folder, self.sync, self.follow = Path(folder), sync, follow
        self._made: list[Path] = []
        self._fd = -1
        self._parts: list[str] = []  # temporary files on the disk
        self._whole: list[tuple[str, str]] = []  # temporary name, name

    def __enter__(self) -> AtomicFiles:
        """Make and open the folder."""
        with telling(self.folder):
            self._made = [path for path in (self.folder, *self.folder.parents) if not os.path.lexists(path)]
            self.folder.mkdir(parents=True, exist_ok=True)
            self._fd = os.open(self.folder, _FOLDER | (0 if self.follow else os.O_NOFOLLOW))
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        """Remove the files that were not moved, and close the folder."""
        try:
            self._clear(kind is not None)
        except KeyboardInterrupt:
            self._clear(True)
            raise

    def _clear(self, failed: bool) -> None:
        """Remove temporary files and, if `failed`, new folders; a second call continues the first."""
        while self._parts:
            with suppress(OSError):
                os.unlink(self._parts[-1], dir_fd=self._fd)
            self._parts.pop()
        if self._fd >= 0:
            handle, self._fd = self._fd, -1
            os.close(handle)
        made, self._made = self._made, []
        for folder in made if failed else ():
            with suppress(OSError):  # it holds something else by now
                folder.rmdir()

    @contextmanager
    def file(self, name: str) -> Iterator[BinaryIO]:
        """Yield a file to write, which can be read and positioned; it is complete when the block ends without error."""
        with telling(self.folder / name):
            old = _check_replaceable(self.folder, name, self._fd)
            part = f".gudgeon-{os.urandom(8).hex()}.part"
            self._parts.append(part)  # first: Ctrl-C may come as it has been opened
            try:
                handle = os.open(part, _OPEN, 0o600 if old else 0o666, dir_fd=self._fd)
            except FileExistsError:  # another's: it stays
                self._parts.remove(part)
                raise
            with open(handle, "w+b") as file:
                yield file
                file.flush()
                if old:
                    _copy_permissions(handle, old)
                if self.sync:
                    _sync(handle)
            self._whole.append((part, name))

    def write(self, name: str, data: bytes | memoryview) -> None:
        """Write a file with these bytes under a temporary name."""
        with self.file(name) as file:
            file.write(data)

    def move(self, count: int | None = None) -> None:
        """Move the first `count` complete files into place, in the order in which they were written; None: all."""
        for _ in range(len(self._whole) if count is None else count):
            part, name = self._whole.pop(0)
            with telling(self.folder / name):
                os.replace(part, name, src_dir_fd=self._fd, dst_dir_fd=self._fd)
                self._parts.remove(part)

    def remove(self, name: str, own: Callable[[bytes], bool]) -> None:
        """Remove a regular file of the folder if `own` accepts its bytes; it may be gone already."""
        with telling(self.folder / name):
            data = read_regular(name, dir_fd=self._fd)
            if data is not None and own(data):
                os.unlink(name, dir_fd=self._fd)


@contextmanager
def written(path: str | os.PathLike[str], *, sync: bool = False) -> Iterator[BinaryIO]:
    """Yield a file to write; it is moved to `path` when the block ends without error.

    Raises OutputError, also for an OSError of the block; `path` is then unchanged. sync: as in Aside.
    """
    path = _file_path(path)
    with AtomicFiles(path.parent, sync=sync) as aside:
        with aside.file(path.name) as file:
            yield file
        aside.move()


def write_bytes(path: str | os.PathLike[str], data: bytes | memoryview) -> None:
    """Write a file with these bytes at `path`. Raise OutputError and leave `path` unchanged if that fails."""
    with written(path) as file:
        file.write(data)


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Write a file with this text, as UTF-8."""
    write_bytes(path, text.encode())


def read_regular(name: str | os.PathLike[str], *, dir_fd: int | None = None) -> bytes | None:
    """Return the bytes of a regular file up to LARGEST; None if it is absent, a link or a device, or too large."""
    try:
        handle = os.open(name, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, dir_fd=dir_fd)
    except OSError as error:
        if error.errno in (errno.ENOENT, errno.ELOOP, errno.ENXIO, errno.EMLINK):  # EMLINK: a link, to some kernels
            return None
        raise
    try:
        found = os.fstat(handle)
        if not stat.S_ISREG(found.st_mode) or found.st_size > LARGEST:
            return None
        with open(handle, "rb", closefd=False) as file:
            return file.read(min(found.st_size + 1, LARGEST))  # no more memory than the file needs
    finally:
        os.close(handle)


def check_target(path: str | os.PathLike[str]) -> None:
    """Raise OutputError if `write_bytes` would refuse this path; nothing is written."""
    path = _file_path(path)
    with telling(path):
        with suppress(FileNotFoundError, NotADirectoryError):
            path.lstat()
        if path.parent.exists():
            handle = os.open(path.parent, _FOLDER)
            try:
                _check_replaceable(path.parent, path.name, handle)
            finally:
                os.close(handle)


def _file_path(path: str | os.PathLike[str]) -> Path:
    """Return the path of a file to be written. Raise OutputError for an empty name, and for "." and "/"."""
    if not os.fspath(path):
        raise OutputError(path, "the name is empty")
    if not Path(path).name:
        raise OutputError(path, "it is a folder")
    return Path(path)


@contextmanager
def telling(path: Path) -> Iterator[None]:
    """Convert each OSError of the with block to an OutputError for `path`."""
    try:
        yield
    except OSError as error:
        raise OutputError(path, error) from error


def _check_replaceable(folder: Path, name: str, handle: int) -> os.stat_result | None:
    """Return the status of the file to be replaced, None if it is absent or a link. Raise OutputError if refused."""
    try:
        old = os.stat(name, dir_fd=handle, follow_symlinks=False)
    except FileNotFoundError:
        return None
    if stat.S_ISLNK(old.st_mode):
        if folder.absolute() == Path("/dev"):
            raise OutputError(folder / name, "the system's own")
        return None
    if not stat.S_ISREG(old.st_mode):
        raise OutputError(folder / name, "it is a folder" if stat.S_ISDIR(old.st_mode) else f"it is {kind(old)}")
    if not old.st_mode & 0o222:
        raise OutputError(folder / name, "there is a file that is write-protected")
    return old


def _sync(handle: int) -> None:
    """Flush a file to the disk: some file systems report only here that they are full."""
    try:
        os.fsync(handle)
    except OSError as error:
        if error.errno not in (errno.EINVAL, errno.ENOTSUP, errno.ENOSYS):  # a file system that cannot
            raise


def kind(found: os.stat_result) -> str:
    """Return a description of a path that is not a regular file."""
    kinds = {
        stat.S_IFDIR: "a folder",
        stat.S_IFIFO: "a pipe",
        stat.S_IFSOCK: "a socket",
        stat.S_IFCHR: "a device",
        stat.S_IFBLK: "a device",
        stat.S_IFLNK: "a link",
    }
    return kinds.get(stat.S_IFMT(found.st_mode), "no regular file")


def _copy_permissions(handle: int, old: os.stat_result) -> None:
    """Set permissions and, if allowed, owner of a file to those of the one that it replaces."""
    made = os.fstat(handle)
    with suppress(PermissionError):
        if (made.st_uid, made.st_gid) != (old.st_uid, old.st_gid):
            os.fchown(handle, old.st_uid, old.st_gid)
    with suppress(PermissionError):  # a file system that has none
        os.fchmod(handle, stat.S_IMODE(old.st_mode) & 0o777)

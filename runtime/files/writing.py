"""Write output files atomically, completely or not at all: first under a temporary name, then renamed.

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
MAX_REGULAR_BYTES = 1 << 26  # largest file that `read_regular_file` reads
_OPEN_FLAGS = os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC | os.O_NOFOLLOW
_FOLDER_FLAGS = getattr(os, "O_PATH", os.O_RDONLY) | os.O_DIRECTORY | os.O_CLOEXEC  # O_PATH: not to be listed


class AtomicFiles:
    """Write files of one folder under temporary names and move them into place; a context.

    The folder is created if it does not exist; follow: it may be a link. Files that were not moved are removed at the
    end of the context, after an error also the created folders. sync: each file is flushed to the disk before it is
    moved, for results that cannot be repeated. Without it, a power failure may lose both files on some file systems.
    """

    def __init__(self, folder: str | os.PathLike[str], *, sync: bool = False, follow: bool = True) -> None:
        """Store the folder and the options; nothing is created or opened before the context begins."""
        self.folder, self.sync, self.follow = Path(folder), sync, follow
        self._made_folders: list[Path] = []
        self._fd = -1
        self._temporary_names: list[str] = []  # temporary files on the disk
        self._complete_files: list[tuple[str, str]] = []  # temporary name, name

    def __enter__(self) -> AtomicFiles:
        """Create the folder if necessary, and open it."""
        with convert_os_errors(self.folder):
            self._made_folders = [path for path in (self.folder, *self.folder.parents) if not os.path.lexists(path)]
            self.folder.mkdir(parents=True, exist_ok=True)
            self._fd = os.open(self.folder, _FOLDER_FLAGS | (0 if self.follow else os.O_NOFOLLOW))
        return self

    def __exit__(self, error_class: type[BaseException] | None, *_: object) -> None:
        """Remove the files that were not moved, and close the folder."""
        try:
            self._remove_temporary_files(error_class is not None)
        except KeyboardInterrupt:
            self._remove_temporary_files(True)
            raise

    def _remove_temporary_files(self, failed: bool) -> None:
        """Remove temporary files, close the folder and, if `failed`, remove the created folders that are empty.

        A second call continues the first, which Ctrl-C may have interrupted.
        """
        while self._temporary_names:
            with suppress(OSError):
                os.unlink(self._temporary_names[-1], dir_fd=self._fd)
            self._temporary_names.pop()
        if self._fd >= 0:
            descriptor, self._fd = self._fd, -1
            os.close(descriptor)
        new_folders, self._made_folders = self._made_folders, []
        for folder in new_folders if failed else ():
            with suppress(OSError):  # not empty
                folder.rmdir()

    @contextmanager
    def open_file(self, name: str) -> Iterator[BinaryIO]:
        """Yield a binary file to write, which can be read and positioned, under a temporary name.

        It is complete when the block ends without error; `move_files` then puts it in place. It gets the permissions of
        the file that it replaces, and is flushed to the disk if `sync` is set. Raises OutputError for a target that may
        not be replaced, and for each OSError.
        """
        with convert_os_errors(self.folder / name):
            old_status = _check_replaceable_file(self.folder, name, self._fd)
            temporary_name = f".gudgeon-{os.urandom(8).hex()}.part"
            self._temporary_names.append(temporary_name)  # first, since Ctrl-C may come just after the file is opened
            try:
                descriptor = os.open(temporary_name, _OPEN_FLAGS, 0o600 if old_status else 0o666, dir_fd=self._fd)
            except FileExistsError:  # a file of another process: not removed
                self._temporary_names.remove(temporary_name)
                raise
            with open(descriptor, "w+b") as file:
                yield file
                file.flush()
                if old_status:
                    _copy_permissions(descriptor, old_status)
                if self.sync:
                    _flush_to_disk(descriptor)
            self._complete_files.append((temporary_name, name))

    def write(self, name: str, data: bytes | memoryview) -> None:
        """Write a file with these bytes under a temporary name."""
        with self.open_file(name) as file:
            file.write(data)

    def move_files(self, count: int | None = None) -> None:
        """Move the first `count` complete files into place, in the order in which they were written; None: all.

        Raises OutputError for the first that cannot be moved.
        """
        for _ in range(len(self._complete_files) if count is None else count):
            temporary_name, name = self._complete_files.pop(0)
            with convert_os_errors(self.folder / name):
                os.replace(temporary_name, name, src_dir_fd=self._fd, dst_dir_fd=self._fd)
                self._temporary_names.remove(temporary_name)

    def remove_file(self, name: str, is_accepted: Callable[[bytes], bool]) -> None:
        """Remove a regular file of the folder if `is_accepted` returns True for its bytes.

        An absent file is not an error. Raises OutputError.
        """
        with convert_os_errors(self.folder / name):
            data = read_regular_file(name, dir_fd=self._fd)
            if data is not None and is_accepted(data):
                os.unlink(name, dir_fd=self._fd)


@contextmanager
def open_atomic(path: str | os.PathLike[str], *, sync: bool = False) -> Iterator[BinaryIO]:
    """Yield a binary file to write; it is moved to `path` when the block ends without error.

    Raises OutputError, also for an OSError of the block; `path` is then unchanged. sync: as in AtomicFiles.
    """
    path = _check_file_path(path)
    with AtomicFiles(path.parent, sync=sync) as folder:
        with folder.open_file(path.name) as file:
            yield file
        folder.move_files()


def write_bytes(path: str | os.PathLike[str], data: bytes | memoryview) -> None:
    """Write a file with these bytes at `path`. Raise OutputError and leave `path` unchanged if that fails."""
    with open_atomic(path) as file:
        file.write(data)


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Write a file with this text, as UTF-8."""
    write_bytes(path, text.encode())


def read_regular_file(name: str | os.PathLike[str], *, dir_fd: int | None = None) -> bytes | None:
    """Return the bytes of a regular file up to MAX_REGULAR_BYTES; None if it is absent, a link, a device or too large.

    `name` is relative to the folder of the descriptor `dir_fd`, if one is given. Raises OSError for other errors.
    """
    try:
        descriptor = os.open(name, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, dir_fd=dir_fd)
    except OSError as error:
        if error.errno in (errno.ENOENT, errno.ELOOP, errno.ENXIO, errno.EMLINK):  # EMLINK: a link, to some kernels
            return None
        raise
    try:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode) or status.st_size > MAX_REGULAR_BYTES:
            return None
        with open(descriptor, "rb", closefd=False) as file:
            return file.read(min(status.st_size + 1, MAX_REGULAR_BYTES))  # no more memory than the file needs
    finally:
        os.close(descriptor)


def check_output_path(path: str | os.PathLike[str]) -> None:
    """Raise OutputError if a file at this path could not be written: an empty name, a folder, a device, a protected
    file.

    Nothing is written. Called before long computations.
    """
    path = _check_file_path(path)
    with convert_os_errors(path):
        with suppress(FileNotFoundError, NotADirectoryError):
            path.lstat()
        if path.parent.exists():
            descriptor = os.open(path.parent, _FOLDER_FLAGS)
            try:
                _check_replaceable_file(path.parent, path.name, descriptor)
            finally:
                os.close(descriptor)


def _check_file_path(path: str | os.PathLike[str]) -> Path:
    """Return the path of a file to be written.

    Raises OutputError for an empty name, and for names of folders such as "." and "/".
    """
    if not os.fspath(path):
        raise OutputError(path, "the name is empty")
    if not Path(path).name:
        raise OutputError(path, "it is a folder")
    return Path(path)


@contextmanager
def convert_os_errors(path: Path) -> Iterator[None]:
    """Convert each OSError within the context to an OutputError for `path`."""
    try:
        yield
    except OSError as error:
        raise OutputError(path, error) from error


def _check_replaceable_file(folder: Path, name: str, descriptor: int) -> os.stat_result | None:
    """Return the status of the file to be replaced, None if it is absent or a link.

    Raises OutputError for a folder, a device, a link in /dev and a write-protected file. `descriptor` is that of the
    folder.
    """
    try:
        status = os.stat(name, dir_fd=descriptor, follow_symlinks=False)
    except FileNotFoundError:
        return None
    if stat.S_ISLNK(status.st_mode):
        if folder.absolute() == Path("/dev"):
            raise OutputError(folder / name, "it is a link of the system")
        return None
    if not stat.S_ISREG(status.st_mode):
        raise OutputError(
            folder / name, "it is a folder" if stat.S_ISDIR(status.st_mode) else f"it is {describe_file_type(status)}"
        )
    if not status.st_mode & 0o222:
        raise OutputError(folder / name, "the existing file is write-protected")
    return status


def _flush_to_disk(descriptor: int) -> None:
    """Flush a file to the disk; some file systems report only here that they are full.

    Raises OSError, except from file systems that cannot flush.
    """
    try:
        os.fsync(descriptor)
    except OSError as error:
        if error.errno not in (errno.EINVAL, errno.ENOTSUP, errno.ENOSYS):  # a file system without fsync
            raise


def describe_file_type(status: os.stat_result) -> str:
    """Return the type of a path that is not a regular file, from the result of os.stat: "a pipe", "a special file"."""
    descriptions = {
        stat.S_IFDIR: "a folder",
        stat.S_IFIFO: "a pipe",
        stat.S_IFSOCK: "a socket",
        stat.S_IFCHR: "a device",
        stat.S_IFBLK: "a device",
        stat.S_IFLNK: "a link",
    }
    return descriptions.get(stat.S_IFMT(status.st_mode), "a special file")


def _copy_permissions(descriptor: int, old_status: os.stat_result) -> None:
    """Set permissions and, if allowed, owner of an open file to those of the file that it replaces.

    A PermissionError is ignored.
    """
    status = os.fstat(descriptor)
    with suppress(PermissionError):
        if (status.st_uid, status.st_gid) != (old_status.st_uid, old_status.st_gid):
            os.fchown(descriptor, old_status.st_uid, old_status.st_gid)
    with suppress(PermissionError):  # a file system without permissions
        os.fchmod(descriptor, stat.S_IMODE(old_status.st_mode) & 0o777)

"""Read files: only regular ones up to a size. Files that a mechanism names must be in its folder, not behind links.

`read_named` reads what a call or the command line names, `read_beside` what a mechanism names.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path

from gudgeon.errors import BadValueError, InputError, LimitError, Location, shortened
from gudgeon.files.writing import kind

_PARTS = 8  # largest number of parts of a path
MAX_BYTES = 1 << 20  # of a mechanism file
MAX_TABLE_BYTES = 1 << 26  # of a table of a curve: more than a million points


def read_named(file: str | os.PathLike[str], most: int, what: str = "", hint: str = "") -> bytes:
    """Return the bytes of a file, at most `most`; `what` it is and a `hint` are used in errors.

    Raises InputError if it cannot be read or is not a regular file, LimitError if it is too large. Devices and pipes
    are not opened: they may have no end or block, and files are read more than once.
    """
    message = f"{what} {shortened(file)}".strip()
    try:
        found = os.stat(file)
        if stat.S_ISREG(found.st_mode):
            handle = os.open(file, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
            with open(handle, "rb") as opened:
                found = os.fstat(handle)
                data = opened.read(most + 1) if found.st_size <= most else b""
    except (OSError, ValueError) as error:  # ValueError: a name with a zero byte
        raise InputError(f"cannot read {message}: {getattr(error, 'strerror', '') or error}", hint=hint) from error
    check_regular(found, message, hint)
    size = max(found.st_size, len(data))
    if size > most:
        raise LimitError(f"a file of {size} bytes", Location(os.fspath(file), 1, 1), f"expected at most {most}")
    return data


def check_regular(found: os.stat_result, message: str, hint: str = "") -> None:
    """Raise InputError for a folder, a device or a pipe; `message` is its name in the message."""
    if not stat.S_ISREG(found.st_mode):
        pipe = stat.S_ISFIFO(found.st_mode)
        hint = "write what comes through the pipe to a file first" if pipe else hint
        raise InputError(f"cannot read {message}: it is {kind(found)}, not a file", hint=hint)


def read_beside(file: str | os.PathLike[str], name: str, most: int, where: Location | None = None) -> bytes:
    """Return the bytes of `name`, a path relative to the folder of `file`, at most `most`. Raise InputError.

    Neither a folder on the path nor the file may be a link, so that nothing outside the folder is read.
    """
    parts = name.split("/")
    if not 0 < len(parts) <= _PARTS or any(part in ("", ".", "..") or _is_forbidden(part) for part in parts):
        hint = "expected the name of a file in the mechanism's folder or below: lift.csv, data/lift.csv"
        raise BadValueError(f"{name[:60]!r} is no path to a table", where, hint)
    try:
        data, found = _read_without_links(Path(file).parent, parts, most)
    except OSError as error:
        linked = _is_link(Path(file).parent, parts)
        why = "a link is not followed" if linked else error.strerror or error
        hint = "expected a file in the folder of the mechanism or below"
        raise InputError(f"cannot read the table {name}: {why}", where, hint) from error
    if not stat.S_ISREG(found.st_mode):
        raise InputError(f"cannot read the table {name}: it is {kind(found)}, not a file", where, "name a CSV file")
    if (size := max(found.st_size, len(data))) > most:
        raise LimitError(f"a table of {size} bytes", where, f"expected at most {most}")
    return data


def _is_forbidden(part: str) -> bool:
    """Return whether a part of a path has characters that are not allowed."""
    return "\\" in part or not part.isprintable()


def _read_without_links(folder: Path, parts: list[str], most: int) -> tuple[bytes, os.stat_result]:
    """Return bytes and status of a file, opened folder by folder, so that no link can be inserted meanwhile."""
    here = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        for part in parts[:-1]:
            below = os.open(part, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC, dir_fd=here)
            os.close(here)
            here = below
        found = os.stat(parts[-1], dir_fd=here, follow_symlinks=False)
        if not stat.S_ISREG(found.st_mode) and not stat.S_ISLNK(found.st_mode):
            return b"", found  # a pipe or device is not opened
        handle = os.open(parts[-1], os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, dir_fd=here)
    finally:
        os.close(here)
    with open(handle, "rb") as opened:
        found = os.fstat(handle)
        regular = stat.S_ISREG(found.st_mode) and found.st_size <= most
        return opened.read(most + 1) if regular else b"", found


def _is_link(folder: Path, parts: list[str]) -> bool:
    """Return whether the path contains a link, for the message."""
    return any(os.path.islink(folder.joinpath(*parts[: k + 1])) for k in range(len(parts)))

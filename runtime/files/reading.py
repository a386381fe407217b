"""Read regular files up to a maximum size. Files that a mechanism names must be in its folder and not symbolic links.

`read_user_file` reads files of calls and the command line, `read_table_file` files that a mechanism names.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path

from gudgeon.errors import BadValueError, InputError, LimitError, Location, shorten_path
from gudgeon.files.writing import describe_file_type

_MAX_PATH_PARTS = 8  # largest number of parts of a path
MAX_BYTES = 1 << 20  # of a mechanism file
MAX_TABLE_BYTES = 1 << 26  # of a table of a curve, more than a million points


def read_user_file(file: str | os.PathLike[str], max_bytes: int, description: str = "", hint: str = "") -> bytes:
    """Return the bytes of a file that a call or the command line names.

    `description` and `hint` are used in errors. Raises InputError if it cannot be read or is not a regular file,
    LimitError if it has more than `max_bytes`. Devices and pipes are not opened: reading may block or not end.
    """
    file_text = f"{description} {shorten_path(file)}".strip()
    try:
        status = os.stat(file)
        if stat.S_ISREG(status.st_mode):
            descriptor = os.open(file, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
            with open(descriptor, "rb") as opened:
                status = os.fstat(descriptor)
                data = opened.read(max_bytes + 1) if status.st_size <= max_bytes else b""
    except (OSError, ValueError) as error:  # ValueError: a name with a zero byte
        raise InputError(f"cannot read {file_text}: {getattr(error, 'strerror', '') or error}", hint=hint) from error
    check_regular_file(status, file_text, hint)
    size = max(status.st_size, len(data))
    if size > max_bytes:
        raise LimitError(f"a file of {size} bytes", Location(os.fspath(file), 1, 1), f"expected at most {max_bytes}")
    return data


def check_regular_file(status: os.stat_result, file_text: str, hint: str = "") -> None:
    """Raise InputError for a folder, a device or a pipe; `status` is the result of os.stat.

    `file_text` names the file in the error.
    """
    if not stat.S_ISREG(status.st_mode):
        is_pipe = stat.S_ISFIFO(status.st_mode)
        hint = "write the output of the pipe to a file first" if is_pipe else hint
        raise InputError(f"cannot read {file_text}: it is {describe_file_type(status)}, not a file", hint=hint)


def read_table_file(file: str | os.PathLike[str], name: str, max_bytes: int, location: Location | None = None) -> bytes:
    """Return the bytes of a table that a mechanism names, at most `max_bytes`.

    `name` is a path relative to the folder of `file`, with "/" between its parts. Neither a folder on the path nor the
    file may be a link, so that nothing outside the folder is read. Raises BadValueError for such a path, InputError for
    the file, LimitError for its size. `location`: location of the name, for errors; None if there is none.
    """
    parts = name.split("/")
    if not 0 < len(parts) <= _MAX_PATH_PARTS or any(map(_is_forbidden_part, parts)):
        hint = "expected the name of a file in the mechanism's folder or below: lift.csv, data/lift.csv"
        raise BadValueError(f"{name[:60]!r} is not a path to a table", location, hint)
    try:
        data, status = _read_without_links(Path(file).parent, parts, max_bytes)
    except OSError as error:
        has_link = _has_link(Path(file).parent, parts)
        reason = "links are not followed" if has_link else error.strerror or error
        hint = "expected a file in the folder of the mechanism or below"
        raise InputError(f"cannot read the table {name}: {reason}", location, hint) from error
    if not stat.S_ISREG(status.st_mode):
        raise InputError(
            f"cannot read the table {name}: it is {describe_file_type(status)}, not a file", location, "name a CSV file"
        )
    if (size := max(status.st_size, len(data))) > max_bytes:
        raise LimitError(f"a table of {size} bytes", location, f"expected at most {max_bytes}")
    return data


def _is_forbidden_part(part: str) -> bool:
    """Return whether a part of a path is empty, ".", "..", or contains a backslash or an unprintable character."""
    return part in ("", ".", "..") or "\\" in part or not part.isprintable()


def _read_without_links(folder: Path, parts: list[str], max_bytes: int) -> tuple[bytes, os.stat_result]:
    """Return bytes and status of a file; folders are opened one by one, so that no link can be inserted meanwhile.

    At most `max_bytes` + 1 are read. A file that is not regular or too large is not read: its bytes are b"". Raises
    OSError for links.
    """
    folder_descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        for part in parts[:-1]:
            subfolder_descriptor = os.open(
                part, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC, dir_fd=folder_descriptor
            )
            os.close(folder_descriptor)
            folder_descriptor = subfolder_descriptor
        status = os.stat(parts[-1], dir_fd=folder_descriptor, follow_symlinks=False)
        if not stat.S_ISREG(status.st_mode) and not stat.S_ISLNK(status.st_mode):
            return b"", status  # a pipe or device is not opened
        descriptor = os.open(
            parts[-1], os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, dir_fd=folder_descriptor
        )
    finally:
        os.close(folder_descriptor)
    with open(descriptor, "rb") as opened:
        status = os.fstat(descriptor)
        is_readable = stat.S_ISREG(status.st_mode) and status.st_size <= max_bytes
        return opened.read(max_bytes + 1) if is_readable else b"", status


def _has_link(folder: Path, parts: list[str]) -> bool:
    """Return whether a folder or the file on the path is a link; used for the text of an error."""
    return any(os.path.islink(folder.joinpath(*parts[: k + 1])) for k in range(len(parts)))

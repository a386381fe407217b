"""Files that are named in a call or on the command line: regular, and not too large."""

from __future__ import annotations

import os
import stat

from gudgeon.errors import InputError, LimitError, Location, shortened
from gudgeon.files.writing import kind


def read_named(file: str | os.PathLike[str], most: int, what: str = "", hint: str = "") -> bytes:
    """At most so many bytes of a file; `what` it is, and a `hint`, for the errors.

    InputError if it cannot be read or is no regular file, LimitError if it is too large. A device or pipe is not
    opened: it may have no end, or keep us waiting; and a file is read more than once.
    """
    told = f"{what} {shortened(file)}".strip()
    try:
        found = os.stat(file)
        if stat.S_ISREG(found.st_mode):
            handle = os.open(file, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
            with open(handle, "rb") as opened:
                found = os.fstat(handle)
                data = opened.read(most + 1) if found.st_size <= most else b""
    except (OSError, ValueError) as error:  # ValueError: a name with a zero byte
        raise InputError(f"cannot read {told}: {getattr(error, 'strerror', '') or error}", hint=hint) from error
    check_regular(found, told, hint)
    size = max(found.st_size, len(data))
    if size > most:
        raise LimitError(f"a file of {size} bytes", Location(os.fspath(file), 1, 1), f"expected at most {most}")
    return data


def check_regular(found: os.stat_result, told: str, hint: str = "") -> None:
    """InputError for a folder, a device, a pipe, by what `told` calls it."""
    if not stat.S_ISREG(found.st_mode):
        pipe = stat.S_ISFIFO(found.st_mode)
        hint = "write what comes through the pipe to a file first" if pipe else hint
        raise InputError(f"cannot read {told}: it is {kind(found)}, not a file", hint=hint)

"""From which mechanism file a result in the folder of results is, so that none of another's is written over.

Two files may have one name inside. A result notes a digest of its file's path and of its bytes: the same path, edited,
or the same bytes, moved, is the same mechanism; a result that notes nothing may be replaced as ever.
"""

from __future__ import annotations

import mmap
import os
import re
from hashlib import sha256
from pathlib import Path

from gudgeon.errors import InputError, shortened
from gudgeon.loading.find import find_mechanism

ORIGIN = "origin"  # attribute of the file
_NOTED = re.compile(rb"gudgeon-origin ([0-9a-f]{16}) ([0-9a-f]{16})")  # found without HDF5, which takes time to import


def origin_of(mechanism: str, digest: str) -> str:
    """Of a mechanism as it was named on the command line, and the digest of its bytes."""
    place = sha256(os.fsencode(find_mechanism(mechanism).resolve())).hexdigest()
    return f"gudgeon-origin {place[:16]} {digest[:16]}"


def check_origin(path: Path, origin: str) -> None:
    """InputError where a result of another mechanism file stands at `path`."""
    ours = _NOTED.match(origin.encode())
    try:
        with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
            noted = _NOTED.search(data)
            found = set(noted.groups()) if noted else set()
    except (OSError, ValueError):  # none there; what may be replaced is known when it is written
        return
    if ours and found and not found & set(ours.groups()):
        told = f"--out: {shortened(path)} is the result of another mechanism file that has the same name"
        raise InputError(told, hint="name another folder with --out, or remove it; or change `name:` in one of them")

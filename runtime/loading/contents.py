"""All files of a folder and of those in it, quickly: a start looks through hundreds to know whether one changed."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path


def contents(folder: Path, *suffixes: str) -> Iterator[tuple[str, bytes]]:
    """(path from the folder with "/", bytes) of files that end so, in the order of their paths' parts."""
    found, left = list[tuple[list[str], str]](), [(list[str](), str(folder))]
    while left:
        parts, place = left.pop()
        with os.scandir(place) as entries:
            for entry in entries:
                if entry.name.endswith(suffixes):
                    found.append(([*parts, entry.name], entry.path))
                elif entry.name != "__pycache__" and entry.is_dir():
                    left.append(([*parts, entry.name], entry.path))
    for parts, place in sorted(found):
        with open(place, "rb", buffering=0) as file:
            yield "/".join(parts), file.read()

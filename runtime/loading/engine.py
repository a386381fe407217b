"""The engine: the C that all scenes share (engine/), beside which a scene's own is compiled.

What of it a scene needs is decided by the sizes in its model.h, here as in C. `contents` reads all files of a folder
quickly, for each start asks whether one of hundreds changed.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from gudgeon.contract.kernel_source import HEADER, KernelSource
from gudgeon.loading.cache import digest
from gudgeon.loading.shipped import PACKAGE

ENGINE = PACKAGE / "engine"
UNIT = ENGINE / "engine.c"
CALLS, LANE_CALLS = ENGINE / "scene" / "calls.h", ENGINE / "batch" / "lane_calls.h"
_SIZE = re.compile(r"^#define (\w+) (\d+)\b", re.MULTILINE)


def engine_files() -> dict[str, str]:
    """Its texts by their paths from the folder that holds `engine`, sorted."""
    return {f"{ENGINE.name}/{name}": text.decode() for name, text in contents(ENGINE, ".c", ".h")}


def engine_readme() -> tuple[str, str]:
    """The page that says which of them to read first: its path and its text. No part of what is compiled."""
    path = ENGINE / "README.md"
    return path.relative_to(ENGINE.parent).as_posix(), path.read_text(encoding="utf-8")


@cache
def engine_digest() -> str:
    """Of all its texts."""
    return digest([part for item in engine_files().items() for part in item])


def own_texts(source: KernelSource) -> list[str]:
    """Names and texts of a scene's own files, as keys of what is compiled from them hold them."""
    return [part for name in sorted(source.files) for part in (name, source.files[name])]


def include_flags() -> tuple[str, ...]:
    """The compiler's, for files that include "model.h" beside them and "engine/..."."""
    return ("-I.", f"-I{ENGINE.parent}")


def declarations(source: KernelSource) -> str:
    """What of the library is called from outside, as cffi reads it."""
    return source.cdef or declared_for(source.files[HEADER])


def declared_for(header: str) -> str:
    """The same for a scene with the engine and this model.h."""
    return _with_sizes(CALLS.read_text(encoding="utf-8"), _sizes(header))


def all_declarations() -> str:
    """Of all scenes, and of libraries of lanes: what a library does not have is missed when it is asked for."""
    lines = CALLS.read_text(encoding="utf-8").splitlines()
    return "".join(f"{line}\n" for line in lines if not line.startswith("#")) + lane_declarations()


def lane_declarations() -> str:
    """Of a library of runs side by side."""
    return _with_sizes(LANE_CALLS.read_text(encoding="utf-8"), {})


def sizes(source: KernelSource) -> dict[str, int]:
    """The whole numbers of model.h by name."""
    return _sizes(source.files[HEADER])


def _sizes(header: str) -> dict[str, int]:
    return {name: int(value) for name, value in _SIZE.findall(header)}


def _with_sizes(text: str, values: dict[str, int]) -> str:
    """The lines of a header whose `#if NAME && !NAME` hold; no more of the preprocessor is needed, nor nested ones."""
    kept, holds = [], True
    for line in text.splitlines():
        if line.startswith("#if "):
            names = line.removeprefix("#if ").split(" && ")
            holds = all(bool(values[name.lstrip("!")]) != name.startswith("!") for name in names)
        elif line.startswith("#endif"):
            holds = True
        elif holds and not line.startswith("#"):
            kept.append(line)
    return "\n".join(kept) + "\n"


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

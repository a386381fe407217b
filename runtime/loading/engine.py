"""Provide the engine's C files, which all scenes share (engine/), and the declarations of its functions.

The sizes in a scene's model.h decide which functions it has. `read_files` reads a folder quickly, because each start
checks whether a file of the engine changed.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from gudgeon.contract.kernel_source import HEADER, KernelSource
from gudgeon.loading.cache import compute_digest
from gudgeon.loading.shipped import PACKAGE

ENGINE = PACKAGE / "engine"
UNIT = ENGINE / "engine.c"
CALLS, LANE_CALLS = ENGINE / "scene" / "calls.h", ENGINE / "batch" / "lane_calls.h"
_SIZE = re.compile(r"^#define (\w+) (\d+)\b", re.MULTILINE)


def read_engine_files() -> dict[str, str]:
    """Return the engine's texts by their paths relative to the parent folder, sorted."""
    return {f"{ENGINE.name}/{name}": text.decode() for name, text in read_files(ENGINE, ".c", ".h")}


def read_engine_readme() -> tuple[str, str]:
    """Return path and text of the engine's README."""
    path = ENGINE / "README.md"
    return path.relative_to(ENGINE.parent).as_posix(), path.read_text(encoding="utf-8")


@cache
def compute_engine_digest() -> str:
    """Return the digest of all texts of the engine."""
    return compute_digest([part for item in read_engine_files().items() for part in item])


def list_scene_texts(source: KernelSource) -> list[str]:
    """Return names and texts of a scene's own files, alternating and sorted by name, for cache keys."""
    return [part for name in sorted(source.files) for part in (name, source.files[name])]


def build_include_flags() -> tuple[str, ...]:
    """Return the compiler's flags for including "model.h" and "engine/..."."""
    return ("-I.", f"-I{ENGINE.parent}")


def select_declarations(source: KernelSource) -> str:
    """Return the declarations of the functions of a source's library, as cffi reads them.

    A library of lanes has its own declarations (`cdef`); for other sources, model.h selects those of the engine.
    """
    return source.cdef or _select_engine_declarations(source.files[HEADER])


def _select_engine_declarations(header: str) -> str:
    """Return the declarations of the engine's functions that a scene with this model.h has."""
    return _select_lines(CALLS.read_text(encoding="utf-8"), _parse_sizes(header))


def list_all_declarations() -> str:
    """Return the declarations of all scenes and of libraries of lanes; absent functions fail when called."""
    lines = CALLS.read_text(encoding="utf-8").splitlines()
    return "".join(f"{line}\n" for line in lines if not line.startswith("#")) + list_lane_declarations()


def list_lane_declarations() -> str:
    """Return the declarations of a library of lanes."""
    return _select_lines(LANE_CALLS.read_text(encoding="utf-8"), {})


def parse_sizes(source: KernelSource) -> dict[str, int]:
    """Return the integers of a scene's model.h, by name."""
    return _parse_sizes(source.files[HEADER])


def _parse_sizes(header: str) -> dict[str, int]:
    """Return the integers defined in a model.h, by name."""
    return {name: int(value) for name, value in _SIZE.findall(header)}


def _select_lines(text: str, values: dict[str, int]) -> str:
    """Return the lines of a header whose conditions `#if NAME && !NAME` hold for `values`, without preprocessor lines.

    Conditions are not nested and have no #else. `values`: number of each name, 0 for false.
    """
    selected, is_active = [], True
    for line in text.splitlines():
        if line.startswith("#if "):
            names = line.removeprefix("#if ").split(" && ")
            is_active = all(bool(values[name.lstrip("!")]) != name.startswith("!") for name in names)
        elif line.startswith("#endif"):
            is_active = True
        elif is_active and not line.startswith("#"):
            selected.append(line)
    return "\n".join(selected) + "\n"


def read_files(folder: Path, *suffixes: str) -> Iterator[tuple[str, bytes]]:
    """Yield (path relative to `folder`, bytes) of all files below it with these suffixes, sorted by path parts.

    Folders named __pycache__ are skipped.
    """
    entries_by_parts, left = list[tuple[list[str], str]](), [(list[str](), str(folder))]
    while left:
        parts, entry_path = left.pop()
        with os.scandir(entry_path) as entries:
            for entry in entries:
                if entry.name.endswith(suffixes):
                    entries_by_parts.append(([*parts, entry.name], entry.path))
                elif entry.name != "__pycache__" and entry.is_dir():
                    left.append(([*parts, entry.name], entry.path))
    for parts, entry_path in sorted(entries_by_parts):
        with open(entry_path, "rb", buffering=0) as file:
            yield "/".join(parts), file.read()

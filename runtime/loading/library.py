"""A library opened: its functions as Python calls them, which takes neither a compiler nor Python.h (cffi's ABI mode).

cffi's parser of declarations takes a tenth of a second to import. What it makes of the engine's is kept in declared.py,
which `make generated` writes; other declarations, and the engine's while they are being edited, are parsed here.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from _cffi_backend import FFI

from gudgeon.loading import declared
from gudgeon.loading.cache import digest
from gudgeon.loading.engine import all_declarations, lane_declarations
from gudgeon.waiting.imports import CFFI, whole


@dataclass(frozen=True)
class Library:
    """Of a kernel source: the file, what cffi knows of its declarations, its functions."""

    file: Path
    ffi: Any
    lib: Functions


class Functions:
    """The functions of a library by name, which release the GIL; one that it does not have is an AttributeError."""

    def __init__(self, library: Any) -> None:
        self._library = library

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            found = getattr(self._library, name)
        except FFI.error as error:
            raise AttributeError(str(error)) from None
        setattr(self, name, found)
        return found


def opened(file: Path, cdef: str = "") -> Library:
    """The library in a file: of the engine, or with these declarations. ImportError where it cannot be opened."""
    ffi = _engines() if cdef in ("", lane_declarations()) else _parsed(cdef)
    try:
        return Library(file, ffi, Functions(ffi.dlopen(str(file))))
    except OSError as error:
        raise ImportError(str(error)) from error


@lru_cache(maxsize=1)
def _engines() -> Any:
    text = all_declarations()
    return declared.ffi if digest([text]) == declared.OF else _parsed(text)


def _parsed(text: str) -> Any:
    whole(*CFFI)
    from cffi import FFI

    ffi = FFI()
    ffi.cdef(text)
    return ffi

"""A library opened: its functions as Python calls them, which takes neither a compiler nor Python.h (cffi's ABI mode).

cffi's parser of declarations takes a tenth of a second to import. What it makes of the engine's is kept in declared.py,
which `make generated` writes; other declarations, and the engine's while they are being edited, are parsed here.

A wheel carries libraries for machines without a compiler (`carried`): shipped mechanisms, one run at a time.
`tools/wheels.py` compiles them when it makes a wheel for a platform, without instructions that only some processors
have; a clone has none. They are known by the texts that they were compiled from, so that an edited file, or another
engine, never gets them.
"""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Protocol

from _cffi_backend import FFI

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.loading import declared
from gudgeon.loading.cache import digest
from gudgeon.loading.engine import all_declarations, engine_digest, lane_declarations, own_texts
from gudgeon.loading.shipped import PACKAGE
from gudgeon.waiting.imports import CFFI, whole

HASTE = "its optimized library was still being compiled when the run began: it takes less time from now on"
CARRIED = PACKAGE / "carried"


@dataclass(frozen=True)
class Library:
    """Of a kernel source: the file, what cffi knows of its declarations, its functions."""

    file: Path
    ffi: Any
    lib: Functions


class Better(Protocol):
    """A library that is being made (behind.py): both give it to `become`."""

    def look(self, functions: Functions) -> bool:
        """At once, if it is there; whether it is still to come."""

    def wait(self, functions: Functions) -> None:
        """When it is there."""


class Functions:
    """The functions of a library by name, which release the GIL; one that it does not have is an AttributeError."""

    _behind: Better | None = None

    def __init__(self, library: Any) -> None:
        self._libraries = [library]  # the last one is called; others stay open, for a call may be in one

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        library = self._libraries[-1]
        try:
            found = getattr(library, name)
        except FFI.error as error:
            raise AttributeError(str(error)) from None
        setattr(self, name, found)
        if library is not self._libraries[-1]:  # another thread has called `become`
            vars(self).pop(name, None)
        return found

    @property
    def haste(self) -> str:
        """What is to be told of times that it takes: nothing, where no better one is being made."""
        return HASTE if self._behind else ""

    def follow(self, behind: Better) -> None:
        """A better library of the same texts is being made."""
        self._behind = behind

    def newest(self) -> None:
        """Where a better one is being made: from now on that one, if it is there."""
        if (behind := self._behind) and not behind.look(self):
            self._behind = None

    def best(self) -> None:
        """The same when it is there: for what takes longer than a compiler does."""
        if behind := self._behind:
            behind.wait(self)
            self._behind = None

    def become(self, other: Functions) -> None:
        """From the next call on those of another library of the same texts, also where a run is under way.

        Structs are laid out alike, and tables of the library that a run began in stay where they are.
        """
        self._libraries.append(other._libraries[-1])
        for name in [name for name in vars(self) if not name.startswith("_")]:
            vars(self).pop(name, None)


def opened(file: Path, cdef: str = "") -> Library:
    """The library in a file: of the engine, or with these declarations. ImportError where it cannot be opened."""
    ffi = _engines() if cdef in ("", lane_declarations()) else _parsed(cdef)
    try:
        return Library(file, ffi, Functions(ffi.dlopen(str(file))))
    except (OSError, UnicodeEncodeError) as error:  # cffi takes a path as UTF-8
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


def carried(source: KernelSource) -> Library | None:
    """The library of this source; None where the wheel has none for this machine, or the user names a compiler."""
    if os.environ.get("CC"):
        return None
    path = CARRIED / platform(sys.platform, os.uname().machine) / file_name(source)
    try:
        return opened(path, source.cdef) if path.is_file() else None
    except ImportError:  # of another C library, as musl
        return None


def platform(system: str, machine: str) -> str:
    """The folder of such machines."""
    return f"{system}-{machine}"


def file_name(source: KernelSource) -> str:
    """By everything that it was compiled from."""
    return digest(["carried/1", source.main, source.cdef, engine_digest(), *own_texts(source)])[:32] + ".so"

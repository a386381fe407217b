"""Open a compiled library and call its functions through cffi's ABI mode, without a compiler or Python.h.

cffi's parser takes a tenth of a second to import. Its result for the engine's declarations is stored in declared.py,
which `make generated` writes. Other declarations are parsed here.

A wheel contains libraries of shipped mechanisms for machines without a compiler (BUNDLED_FOLDER), built by
`tools/wheels.py` with portable instructions. They are identified by the texts that they were compiled from, so that an
edited file or another engine never uses them.
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
from gudgeon.loading.cache import compute_digest
from gudgeon.loading.engine import (
    compute_engine_digest,
    list_all_declarations,
    list_lane_declarations,
    list_scene_texts,
)
from gudgeon.loading.shipped import PACKAGE
from gudgeon.waiting.imports import CFFI, import_modules_in_thread

UNOPTIMIZED_NOTE = "its optimized library was still being compiled at the start of the run: later runs take less time"
BUNDLED_FOLDER = PACKAGE / "carried"  # folder of the bundled libraries


@dataclass(frozen=True)
class Library:
    """Hold an opened library: its file, cffi's interface and its functions."""

    file: Path
    ffi: Any
    lib: Functions


class PendingLibrary(Protocol):
    """Provide an optimized library that is being compiled (optimized_library.py), for `Functions.replace_functions`."""

    def switch_if_library_is_ready(self, functions: Functions) -> bool:
        """Switch `functions` to the library if it exists; return whether it is still expected."""

    def wait_for_library_and_switch(self, functions: Functions) -> None:
        """Wait for the library, and switch `functions` to it."""


class Functions:
    """Call the functions of a library by name; calls release the GIL. Missing ones raise AttributeError."""

    _pending_library: PendingLibrary | None = None

    def __init__(self, library: Any) -> None:
        self._libraries = [library]  # the last one is called; others stay open, for a call may be in one

    def __getattr__(self, name: str) -> Any:
        """Return a function of the newest library and cache it; called for names that are not cached.

        Raises AttributeError for functions that the library lacks.
        """
        if name.startswith("_"):
            raise AttributeError(name)
        library = self._libraries[-1]
        try:
            function = getattr(library, name)
        except FFI.error as error:
            raise AttributeError(str(error)) from None
        setattr(self, name, function)
        if library is not self._libraries[-1]:  # another thread has called `replace_functions`
            vars(self).pop(name, None)
        return function

    @property
    def optimization_note(self) -> str:
        """Return a note for measured times while an optimized library is being compiled; else ""."""
        return UNOPTIMIZED_NOTE if self._pending_library else ""

    def set_pending_library(self, pending_library: PendingLibrary) -> None:
        """Register an optimized library of the same texts that is being compiled."""
        self._pending_library = pending_library

    def switch_library_if_ready(self) -> None:
        """Switch to the optimized library if its compilation has ended; called often during runs.

        Do nothing without a pending library. After a failed compilation, the current library stays in use.
        """
        if (pending_library := self._pending_library) and not pending_library.switch_if_library_is_ready(self):
            self._pending_library = None

    def wait_for_optimized_library(self) -> None:
        """Wait for the optimized library, if one is being compiled, and switch to it, before long computations."""
        if pending_library := self._pending_library:
            pending_library.wait_for_library_and_switch(self)
            self._pending_library = None

    def replace_functions(self, functions: Functions) -> None:
        """Use the functions of another library of the same texts from the next call on, even during a run.

        Structs have the same layout, and tables of the library in which a run began stay in memory.
        """
        self._libraries.append(functions._libraries[-1])
        for name in [name for name in vars(self) if not name.startswith("_")]:
            vars(self).pop(name, None)


def open_library(file: Path, cdef: str = "") -> Library:
    """Open the library in a file: one with the engine, or one with given declarations.

    Raise ImportError if that fails.
    """
    ffi = _get_engine_interface() if cdef in ("", list_lane_declarations()) else _parse_declarations(cdef)
    try:
        return Library(file, ffi, Functions(ffi.dlopen(str(file))))
    except (OSError, UnicodeEncodeError) as error:  # cffi takes a path as UTF-8
        raise ImportError(str(error)) from error


@lru_cache(maxsize=1)
def _get_engine_interface() -> Any:
    """Return cffi's interface to the engine's declarations: the stored one unless the declarations have changed."""
    text = list_all_declarations()
    return declared.ffi if compute_digest([text]) == declared.SHA256 else _parse_declarations(text)


def _parse_declarations(text: str) -> Any:
    """Parse declarations and return cffi's interface to them; importing the parser takes a tenth of a second."""
    import_modules_in_thread(*CFFI)
    from cffi import FFI

    ffi = FFI()
    ffi.cdef(text)
    return ffi


def open_bundled_library(source: KernelSource) -> Library | None:
    """Return the library of a source that is bundled with gudgeon; None if there is none or it cannot be opened.

    None too if $CC is set, so that a user's compiler is always used.
    """
    if os.environ.get("CC"):
        return None
    path = BUNDLED_FOLDER / format_platform(sys.platform, os.uname().machine) / compute_library_file_name(source)
    try:
        return open_library(path, source.cdef) if path.is_file() else None
    except ImportError:  # compiled for another C library, such as musl
        return None


def format_platform(system: str, machine: str) -> str:
    """Return the name of the folder for a kind of machine."""
    return f"{system}-{machine}"


def compute_library_file_name(source: KernelSource) -> str:
    """Return the name of a bundled library: 32 characters of a digest of its sources, and ".so".

    Sources are the texts of scene and engine and the declarations `cdef`; compiler and flags do not count.
    """
    return (
        compute_digest(["carried/1", source.main, source.cdef, compute_engine_digest(), *list_scene_texts(source)])[:32]
        + ".so"
    )

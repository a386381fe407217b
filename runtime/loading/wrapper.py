"""What cffi writes between Python and a library: calls and structs are those of many scenes, so it is compiled once.

It depends on the sizes of a scene as far as these decide which calls there are.
"""

from __future__ import annotations

from pathlib import Path

from gudgeon.loading import compiler
from gudgeon.loading.cache import Cache, digest
from gudgeon.loading.compiling import begin, finish
from gudgeon.waiting.imports import CFFI, whole
from gudgeon.waiting.programs import Programs

MODULE, OBJECT = "_gudgeon_library", "wrapper.o"
ASKS = 'extern "Python" int gudgeon_python_asks(void *);\n'  # what C calls to ask Python (integrators/asking.py)


def wrapper(calls: str, portable: bool, cache: Cache) -> Path:
    """The object, compiled if the cache has none: it converts arguments, which no optimizer makes faster.

    Raises BuildError without Python.h, or if it does not compile.
    """
    line = [*compiler.find_compiler(), *compiler.flags(portable), "-O0"]
    identity = compiler.identity(compiler.find_compiler(), cache)
    key = digest(["wrapper/1", calls, ASKS, *line, identity, "" if portable else compiler.cpu()])

    def make(folder: Path) -> None:
        includes = (f"-I{path}" for path in compiler.include_folders())
        whole(*CFFI)
        from cffi import FFI

        ffi = FFI()
        ffi.cdef(calls + ASKS)
        ffi.set_source(MODULE, f"#include <stddef.h>\n{calls}", compiler_verbose=0)
        ffi.emit_c_code(str(folder / "wrapper.c"))
        with Programs() as programs:
            process = begin(programs, [*line, *includes, "-c", "wrapper.c", "-o", OBJECT], folder)
            if failed := finish(programs, process, folder / OBJECT):
                raise failed
        (folder / "wrapper.c").unlink()

    return cache.fetch("wrappers", key, make) / OBJECT

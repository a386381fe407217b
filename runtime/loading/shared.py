"""Objects that scenes have in common, compiled once: the engine where sizes and tables agree, and cffi's wrapper."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.contract.kernel_source import ENGINE_ENDS, HEADER
from gudgeon.loading import compiler
from gudgeon.loading.cache import Cache, digest
from gudgeon.loading.compiling import begin, finish, unit_line
from gudgeon.loading.engine import UNIT, engine_digest
from gudgeon.waiting.imports import CFFI, whole
from gudgeon.waiting.programs import Programs

if TYPE_CHECKING:
    from gudgeon.loading.ahead import Ahead

MODULE = "_gudgeon_library"  # the name that every library has as a module of Python
ASKS = 'extern "Python" int gudgeon_python_asks(void *);\n'  # what C calls to ask Python (integrators/asking.py)


@dataclass(frozen=True)
class Shared:
    """An object: its kind in the cache, its file, the compiler's line, what decides it, and the texts that it reads."""

    kind: str
    name: str
    line: tuple[str, ...]
    decided_by: tuple[str, ...]
    texts: Callable[[], Mapping[str, str]]  # made only where it is compiled: cffi takes a tenth of a second to import

    def key(self, portable: bool, cache: Cache) -> str:
        """Everything that decides its bytes; the identity holds cffi's version and Python's."""
        identity = compiler.identity(compiler.find_compiler(), cache)
        return digest([*self.decided_by, *self.line, identity, "" if portable else compiler.cpu()])

    def is_there(self, portable: bool, cache: Cache) -> bool:
        """Whether the cache has it."""
        return cache.has(self.kind, self.key(portable, cache))

    def fetch(self, portable: bool, cache: Cache, ahead: Ahead, renew: bool = False) -> Path:
        """The object, compiled if the cache has none or `renew` is asked for. BuildError if it does not compile."""

        def make(folder: Path) -> None:
            texts = self.texts()
            if ahead.take(folder / self.name, self.line, texts):
                return
            for name, text in texts.items():
                (folder / name).write_text(text, encoding="utf-8")
            with Programs() as programs:
                if failed := finish(programs, begin(programs, self.line, folder), folder / self.name):
                    raise failed
            for name in texts:
                (folder / name).unlink()

        return cache.fetch(self.kind, self.key(portable, cache), make, renew=renew) / self.name


def engine_object(header: str, portable: bool) -> Shared:
    """The time loops for a scene with this model.h, of which they read what stands in front of its numbers."""
    _, _, text = header.partition("#define GUDGEON_MODEL_H\n")
    read = text.partition(ENGINE_ENDS)[0]
    line = unit_line(portable, [str(UNIT)], "engine.o")
    return Shared("engines", "engine.o", line, (read, engine_digest()), lambda: {HEADER: read})


def wrapper_object(calls: str, portable: bool) -> Shared:
    """What cffi writes between Python and C that is called so: it converts arguments, which no optimizer speeds up.

    Its line raises BuildError without Python.h.
    """
    includes = (f"-I{path}" for path in compiler.include_folders())
    command = (*compiler.find_compiler(), *compiler.flags(portable), "-O0", *includes)
    line = (*command, "-c", "wrapper.c", "-o", "wrapper.o")
    return Shared("wrappers", "wrapper.o", line, (calls, ASKS), lambda: {"wrapper.c": _written(calls)})


@lru_cache(maxsize=4)
def _written(calls: str) -> str:
    whole(*CFFI)
    import tempfile

    from cffi import FFI

    ffi = FFI()
    ffi.cdef(calls + ASKS)
    ffi.set_source(MODULE, f"#include <stddef.h>\n{calls}", compiler_verbose=0)
    with tempfile.TemporaryDirectory(prefix="gudgeon-") as folder:
        file = Path(folder, "wrapper.c")
        ffi.emit_c_code(str(file))
        return file.read_text(encoding="utf-8")

"""Objects that scenes have in common, compiled once: the engine, where sizes and tables agree."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.contract.kernel_source import ENGINE_ENDS, HEADER
from gudgeon.loading import compiler
from gudgeon.loading.cache import Cache, digest
from gudgeon.loading.compiling import begin, finish, unit_line
from gudgeon.loading.engine import UNIT, engine_digest
from gudgeon.waiting.programs import Programs

if TYPE_CHECKING:
    from gudgeon.loading.ahead import Ahead


@dataclass(frozen=True)
class Shared:
    """An object: its kind in the cache, its file, the compiler's line, what decides it, and the texts that it reads."""

    kind: str
    name: str
    line: tuple[str, ...]
    decided_by: tuple[str, ...]
    texts: Mapping[str, str]

    def key(self, portable: bool, cache: Cache) -> str:
        """Everything that decides its bytes."""
        identity = compiler.identity(compiler.find_compiler(), cache)
        return digest([*self.decided_by, *self.line, identity, "" if portable else compiler.cpu()])

    def is_there(self, portable: bool, cache: Cache) -> bool:
        """Whether the cache has it."""
        return cache.has(self.kind, self.key(portable, cache))

    def fetch(self, portable: bool, cache: Cache, ahead: Ahead, renew: bool = False) -> Path:
        """The object, compiled if the cache has none or `renew` is asked for. BuildError if it does not compile."""

        def make(folder: Path) -> None:
            if ahead.take(folder / self.name, self.line, self.texts):
                return
            for name, text in self.texts.items():
                (folder / name).write_text(text, encoding="utf-8")
            with Programs() as programs:
                if failed := finish(programs, begin(programs, self.line, folder), folder / self.name):
                    raise failed
            for name in self.texts:
                (folder / name).unlink()

        return cache.fetch(self.kind, self.key(portable, cache), make, renew=renew) / self.name


def engine_object(header: str, portable: bool, quick: bool = False) -> Shared:
    """The time loops for a scene with this model.h, of which they read what stands in front of its numbers."""
    _, _, text = header.partition("#define GUDGEON_MODEL_H\n")
    read = text.partition(ENGINE_ENDS)[0]
    line = unit_line(portable, [str(UNIT)], "engine.o", quick, "loops")
    return Shared("engines", "engine.o", line, (read, engine_digest()), {HEADER: read})

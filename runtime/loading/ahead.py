"""What a library is compiled from, and compiled ahead of it: each part as soon as the texts that it reads are there.

Scenes whose sizes and tables agree share the object of the engine: `Shared`.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING
from weakref import finalize

from gudgeon.contract.kernel_source import ENGINE_ENDS, ENGINE_PART, HEADER, MAIN, KernelSource
from gudgeon.errors import GudgeonError
from gudgeon.files.temporary import TemporaryFolder
from gudgeon.loading import compiler
from gudgeon.loading.cache import Cache, default_cache, digest
from gudgeon.loading.compiler import begin, finish, unit_line
from gudgeon.loading.engine import UNIT, engine_digest
from gudgeon.waiting.ctrl_c import CtrlC
from gudgeon.waiting.programs import Programs

if TYPE_CHECKING:
    import subprocess


def own_lines(source: KernelSource, portable: bool, quick: bool = False) -> dict[str, tuple[str, ...]]:
    """The compiler's lines for what is a scene's own, by the names of the objects."""
    if source.cdef or not source.units:
        unit = "lanes" if source.cdef else ""
        return {"scene.o": unit_line(portable, [source.main], "scene.o", quick, unit)}
    return dict(_part(part, portable, quick) for part in source.units)


def _part(part: int, portable: bool, quick: bool) -> tuple[str, tuple[str, ...]]:
    name = f"scene_{part}.o"
    return name, unit_line(portable, [f"-DPART={part}", MAIN], name, quick)


class Ahead:
    """A context that nothing survives. What cannot be begun here is told where the library is made.

    quick: parts are compiled without optimization (loading/behind.py).
    """

    def __init__(self, portable: bool, cache: Cache | None = None, quick: bool = False) -> None:
        self._portable, self._cache, self._quick, self._programs = portable, cache, quick, Programs()
        self._folder: Path | None = None
        self._begun: dict[str, tuple[tuple[str, ...], dict[str, str], subprocess.Popen[str]]] = {}

    def __enter__(self) -> Ahead:
        return self

    def begin(self, part: int, texts: Mapping[str, str]) -> None:
        """A part of the scene, or the engine, of which these texts are there by now."""
        try:
            if part == ENGINE_PART:
                self.begin_shared(self._engine(texts[HEADER], self._quick))
            else:
                self._begin(*_part(part, self._portable, self._quick), texts)
        except (GudgeonError, OSError):
            return

    def foresee(self, header: str) -> None:
        """The engine of a scene that may have this model.h: a core has nothing to do in the next second."""
        if header and (os.cpu_count() or 1) > 1:
            self.begin(ENGINE_PART, {HEADER: header})

    def shared_objects(self, source: KernelSource, quick: bool = False) -> list[Shared]:
        """What it has in common with others: no engine where C is compiled alone."""
        return [] if source.cdef else [self._engine(source.files[HEADER], quick)]

    def _engine(self, header: str, quick: bool) -> Shared:
        """A quick library takes the optimized one too, where it is there."""
        engine = engine_object(header, self._portable)
        if not quick or engine.is_there(self._portable, self._cache or default_cache()):
            return engine
        return engine_object(header, self._portable, quick=True)

    def begin_shared(self, shared: Shared) -> None:
        """What the cache does not have yet. GudgeonError or OSError where it cannot be."""
        if self.is_under_way(shared.name, shared.line, shared.texts):
            return
        if shared.name in self._begun:  # it was foreseen wrongly
            self._programs.stop(self._begun.pop(shared.name)[2])
            shutil.rmtree(self._place(shared.name))
        if not shared.is_there(self._portable, self._cache or default_cache()):
            self._begin(shared.name, shared.line, shared.texts)

    def _begin(self, name: str, line: tuple[str, ...], texts: Mapping[str, str]) -> None:
        folder = self._place(name)
        folder.mkdir(exist_ok=True)
        for file, text in texts.items():
            if not (folder / file).exists():
                (folder / file).write_text(text, encoding="utf-8")
        environment = {**compiler.plain(), "TMPDIR": str(folder)}
        self._begun[name] = line, dict(texts), self._programs.begin([*line], folder, environment)

    def _place(self, name: str) -> Path:
        """The folder of an object: a scene's parts read the same texts, the engine its own."""
        if self._folder is None:
            with CtrlC() as ctrl_c:  # none is made that nobody knows of
                temporary = TemporaryFolder()
                self._folder = temporary.path
                self._clear = finalize(self, temporary.remove)  # at the latest
            ctrl_c.take()
        return self._folder / name.partition("_")[0]

    def take(self, made: Path, line: tuple[str, ...], texts: Mapping[str, str]) -> bool:
        """Waits for the object of this line and these texts and moves it to its place, once; False: there is none."""
        if self._folder is None or not self.is_under_way(made.name, line, texts):
            return False
        _, _, process = self._begun.pop(made.name)
        self._programs.wait(process)
        found = self._place(made.name) / made.name
        if process.returncode or not found.exists():
            return False
        shutil.move(found, made)
        return True

    @property
    def is_busy(self) -> bool:
        """Whether anything is under way."""
        return bool(self._begun)

    def is_under_way(self, name: str, line: tuple[str, ...], texts: Mapping[str, str]) -> bool:
        """Whether `take` may have it."""
        if name not in self._begun:
            return False
        known, read, _ = self._begun[name]
        return known == line and all(texts.get(file) == text for file, text in read.items())

    def __exit__(self, *wrong: object) -> None:
        with CtrlC() as ctrl_c:  # a second one leaves nothing either
            self._programs.__exit__(*wrong)
            if self._folder is not None:
                self._clear()
        ctrl_c.take()


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

"""Compile the parts of a library in the background, each as soon as the texts that it reads exist.

Scenes with equal sizes and tables share the object file of the engine (`SharedObject`).
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


def own_command_lines(source: KernelSource, portable: bool, quick: bool = False) -> dict[str, tuple[str, ...]]:
    """Return the compiler's command lines for a scene's own object files, by the names of these."""
    if source.cdef or not source.units:
        unit = "lanes" if source.cdef else ""
        return {"scene.o": unit_line(portable, [source.main], "scene.o", quick, unit)}
    return dict(_part_line(part, portable, quick) for part in source.units)


def _part_line(part: int, portable: bool, quick: bool) -> tuple[str, tuple[str, ...]]:
    """Return the name of the object file of a part of a scene, and the compiler's command line for it."""
    name = f"scene_{part}.o"
    return name, unit_line(portable, [f"-DPART={part}", MAIN], name, quick)


class BackgroundCompilation:
    """Compile parts of a library in the background; a context at whose end all compilers are stopped.

    Errors are ignored here; they appear when the library is made. quick: compile without optimization
    (loading/behind.py).
    """

    def __init__(self, portable: bool, cache: Cache | None = None, quick: bool = False) -> None:
        self._portable, self._cache, self._quick, self._programs = portable, cache, quick, Programs()
        self._folder: Path | None = None
        self._begun: dict[str, tuple[tuple[str, ...], dict[str, str], subprocess.Popen[str]]] = {}

    def __enter__(self) -> BackgroundCompilation:
        """Return the context."""
        return self

    def begin(self, part: int, texts: Mapping[str, str]) -> None:
        """Start to compile a part of the scene, or the engine, whose texts exist now."""
        try:
            if part == ENGINE_PART:
                self.begin_shared(self._engine(texts[HEADER], self._quick))
            else:
                self._begin(*_part_line(part, self._portable, self._quick), texts)
        except (GudgeonError, OSError):
            return

    def foresee(self, header: str) -> None:
        """Start to compile the engine for a scene that probably has this model.h, if a second core is free."""
        if header and (os.cpu_count() or 1) > 1:
            self.begin(ENGINE_PART, {HEADER: header})

    def shared_objects(self, source: KernelSource, quick: bool = False) -> list[SharedObject]:
        """Return the object files that a scene shares with others: the engine, or none if it is compiled alone."""
        return [] if source.cdef else [self._engine(source.files[HEADER], quick)]

    def _engine(self, header: str, quick: bool) -> SharedObject:
        """Return the engine's object file; a quick library uses the optimized one if the cache has it."""
        engine = engine_object(header, self._portable)
        if not quick or engine.is_there(self._portable, self._cache or default_cache()):
            return engine
        return engine_object(header, self._portable, quick=True)

    def begin_shared(self, shared: SharedObject) -> None:
        """Start to compile a shared object file that the cache lacks. Raise GudgeonError or OSError if that fails."""
        if self.is_under_way(shared.name, shared.line, shared.texts):
            return
        if shared.name in self._begun:  # it was foreseen wrongly
            self._programs.stop(self._begun.pop(shared.name)[2])
            shutil.rmtree(self._folder_of(shared.name))
        if not shared.is_there(self._portable, self._cache or default_cache()):
            self._begin(shared.name, shared.line, shared.texts)

    def _begin(self, name: str, line: tuple[str, ...], texts: Mapping[str, str]) -> None:
        """Start the compiler for an object file in a temporary folder."""
        folder = self._folder_of(name)
        folder.mkdir(exist_ok=True)
        for file, text in texts.items():
            if not (folder / file).exists():
                (folder / file).write_text(text, encoding="utf-8")
        environment = {**compiler.plain(), "TMPDIR": str(folder)}
        self._begun[name] = line, dict(texts), self._programs.begin([*line], folder, environment)

    def _folder_of(self, name: str) -> Path:
        """Return the folder of an object file: the parts of a scene share one, the engine has its own."""
        if self._folder is None:
            with CtrlC() as ctrl_c:  # so that every folder made is known
                temporary = TemporaryFolder()
                self._folder = temporary.path
                self._clear = finalize(self, temporary.remove)  # at the latest
            ctrl_c.take()
        return self._folder / name.partition("_")[0]

    def take(self, made: Path, line: tuple[str, ...], texts: Mapping[str, str]) -> bool:
        """Wait for an object file with this command line and texts, and move it to `made`; False if there is none."""
        if self._folder is None or not self.is_under_way(made.name, line, texts):
            return False
        _, _, process = self._begun.pop(made.name)
        self._programs.wait(process)
        found = self._folder_of(made.name) / made.name
        if process.returncode or not found.exists():
            return False
        shutil.move(found, made)
        return True

    @property
    def is_busy(self) -> bool:
        """Return whether a compiler is running, or its result is still to be taken."""
        return bool(self._begun)

    def is_under_way(self, name: str, line: tuple[str, ...], texts: Mapping[str, str]) -> bool:
        """Return whether this object file is being compiled from these texts."""
        if name not in self._begun:
            return False
        known, read, _ = self._begun[name]
        return known == line and all(texts.get(file) == text for file, text in read.items())

    def __exit__(self, *wrong: object) -> None:
        """Stop all compilers and remove the temporary folder, also if Ctrl-C comes."""
        with CtrlC() as ctrl_c:  # a second one leaves nothing either
            self._programs.__exit__(*wrong)
            if self._folder is not None:
                self._clear()
        ctrl_c.take()


@dataclass(frozen=True)
class SharedObject:
    """Describe an object file that scenes share: kind in the cache, name, command line, what decides it, its texts."""

    kind: str
    name: str
    line: tuple[str, ...]
    decided_by: tuple[str, ...]
    texts: Mapping[str, str]

    def key(self, portable: bool, cache: Cache) -> str:
        """Return the cache key: a digest of everything that decides the bytes of the object file."""
        identity = compiler.identity(compiler.find_compiler(), cache)
        return digest([*self.decided_by, *self.line, identity, "" if portable else compiler.cpu()])

    def is_there(self, portable: bool, cache: Cache) -> bool:
        """Return whether the cache has the object file."""
        return cache.has(self.kind, self.key(portable, cache))

    def fetch(self, portable: bool, cache: Cache, ahead: BackgroundCompilation, renew: bool = False) -> Path:
        """Return the object file, compiled if the cache lacks it or `renew` is set. Raise BuildError."""

        def make(folder: Path) -> None:
            """Compile the object file in a folder, or take it from the background compilation."""
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


def engine_object(header: str, portable: bool, quick: bool = False) -> SharedObject:
    """Return the object file of the time loops for a scene with this model.h.

    They read only the part of it before its values.
    """
    _, _, text = header.partition("#define GUDGEON_MODEL_H\n")
    read = text.partition(ENGINE_ENDS)[0]
    line = unit_line(portable, [str(UNIT)], "engine.o", quick, "loops")
    return SharedObject("engines", "engine.o", line, (read, engine_digest()), {HEADER: read})

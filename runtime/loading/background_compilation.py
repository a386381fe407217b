"""Compile the parts of a library in the background, each as soon as its source files exist.

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
from gudgeon.loading.cache import Cache, compute_digest, get_default_cache
from gudgeon.loading.compiler import build_unit_command, start_compiler, wait_for_compiler
from gudgeon.loading.engine import UNIT, compute_engine_digest
from gudgeon.waiting.ctrl_c import DelayedCtrlC
from gudgeon.waiting.programs import Programs

if TYPE_CHECKING:
    import subprocess


def build_command_lines(source: KernelSource, portable: bool, unoptimized: bool = False) -> dict[str, tuple[str, ...]]:
    """Return the compiler's command line for each object file of a scene's code without the engine, by file name.

    A scene is compiled in one part, or in the parts of `source.compilation_units`. `unoptimized`: without optimization.
    """
    if source.cdef or not source.compilation_units:
        unit = "lanes" if source.cdef else ""
        return {"scene.o": build_unit_command(portable, [source.main], "scene.o", unoptimized, unit)}
    return dict(_build_unit_command(unit, portable, unoptimized) for unit in source.compilation_units)


def _build_unit_command(unit: int, portable: bool, unoptimized: bool) -> tuple[str, tuple[str, ...]]:
    """Return the name of the object file of part `unit` of a scene, and the compiler's command line for it."""
    name = f"scene_{unit}.o"
    return name, build_unit_command(portable, [f"-DPART={unit}", MAIN], name, unoptimized)


class BackgroundCompilation:
    """Compile parts of a library in the background; a context at whose end all compilers are stopped.

    Errors are ignored here: the library is then built without these parts, which raises them. unoptimized: compile
    without optimization (loading/optimized_library.py).
    """

    def __init__(self, portable: bool, cache: Cache | None = None, unoptimized: bool = False) -> None:
        self._portable, self._cache, self._unoptimized, self._programs = portable, cache, unoptimized, Programs()
        self._folder: Path | None = None
        self._compilations: dict[str, tuple[tuple[str, ...], dict[str, str], subprocess.Popen[str]]] = {}

    def __enter__(self) -> BackgroundCompilation:
        """Return the context."""
        return self

    def start_unit_compilation(self, unit: int, texts: Mapping[str, str]) -> None:
        """Start to compile a compilation unit to an object file in the background, from the texts generated so far.

        unit: ENGINE_PART (0) for the engine, or the number of a part of the scene (-DPART of MAIN). texts: contents by
        file name. Errors are ignored: the unit is then compiled when the library is built.
        """
        try:
            if unit == ENGINE_PART:
                self.start_shared_object(self._find_engine_object(texts[HEADER], self._unoptimized))
            else:
                self._start_compilation(*_build_unit_command(unit, self._portable, self._unoptimized), texts)
        except (GudgeonError, OSError):
            return

    def prefetch_engine(self, header: str) -> None:
        """Start to compile the engine for a scene that probably has this model.h, if there is a second core.

        An empty header starts nothing.
        """
        if header and (os.cpu_count() or 1) > 1:
            self.start_unit_compilation(ENGINE_PART, {HEADER: header})

    def list_shared_objects(self, source: KernelSource, unoptimized: bool = False) -> list[SharedObject]:
        """Return the object files that a scene shares with others: that of the engine; [] for a library of lanes."""
        return [] if source.cdef else [self._find_engine_object(source.files[HEADER], unoptimized)]

    def _find_engine_object(self, header: str, unoptimized: bool) -> SharedObject:
        """Return the engine's object file; an unoptimized library uses the optimized one if the cache has it."""
        engine = describe_engine_object(header, self._portable)
        if not unoptimized or engine.is_cached(self._portable, self._cache or get_default_cache()):
            return engine
        return describe_engine_object(header, self._portable, unoptimized=True)

    def start_shared_object(self, shared_object: SharedObject) -> None:
        """Start to compile a shared object file unless it is being compiled or the cache has it.

        A compilation of the same file from other texts is stopped. Raises GudgeonError or OSError if it cannot be
        started.
        """
        if self.is_compiling(shared_object.name, shared_object.command_line, shared_object.texts):
            return
        if shared_object.name in self._compilations:  # it was prefetched for another header
            self._programs.stop(self._compilations.pop(shared_object.name)[2])
            shutil.rmtree(self._get_folder(shared_object.name))
        if not shared_object.is_cached(self._portable, self._cache or get_default_cache()):
            self._start_compilation(shared_object.name, shared_object.command_line, shared_object.texts)

    def _start_compilation(self, name: str, command_line: tuple[str, ...], texts: Mapping[str, str]) -> None:
        """Write missing source texts into a temporary folder, and start the compiler there for object file `name`.

        The compilation is recorded under its name. Raises OSError or GudgeonError.
        """
        folder = self._get_folder(name)
        folder.mkdir(exist_ok=True)
        for file, text in texts.items():
            if not (folder / file).exists():
                (folder / file).write_text(text, encoding="utf-8")
        environment = {**compiler.build_environment(), "TMPDIR": str(folder)}
        self._compilations[name] = command_line, dict(texts), self._programs.start([*command_line], folder, environment)

    def _get_folder(self, name: str) -> Path:
        """Return the temporary folder of an object file: the parts of a scene share one, the engine has its own.

        The parent folder is created at the first call, and removed at the latest with this object.
        """
        if self._folder is None:
            with DelayedCtrlC() as ctrl_c:  # so that every created folder is recorded and removed
                temporary = TemporaryFolder()
                self._folder = temporary.path
                self._clear = finalize(self, temporary.remove_folder)  # removed at the latest with this object
            ctrl_c.raise_delayed()
        return self._folder / name.partition("_")[0]

    def fetch_object(self, object_file: Path, command_line: tuple[str, ...], texts: Mapping[str, str]) -> bool:
        """Wait for an object file compiled with this command line and texts, and move it to the path `object_file`.

        Return False if it was not being compiled or its compilation failed.
        """
        if self._folder is None or not self.is_compiling(object_file.name, command_line, texts):
            return False
        _, _, process = self._compilations.pop(object_file.name)
        self._programs.wait(process)
        compiled_file = self._get_folder(object_file.name) / object_file.name
        if process.returncode or not compiled_file.exists():
            return False
        shutil.move(compiled_file, object_file)
        return True

    @property
    def is_busy(self) -> bool:
        """Return whether a compiler is running, or an object file has not been fetched yet."""
        return bool(self._compilations)

    def is_compiling(self, name: str, command_line: tuple[str, ...], texts: Mapping[str, str]) -> bool:
        """Return whether the object file `name` is being compiled with this command line from these texts."""
        if name not in self._compilations:
            return False
        compiled_line, compiled_texts, _ = self._compilations[name]
        return compiled_line == command_line and all(texts.get(file) == text for file, text in compiled_texts.items())

    def __exit__(self, *exception_info: object) -> None:
        """Stop all compilers and remove the temporary folder, also after Ctrl-C."""
        with DelayedCtrlC() as ctrl_c:  # a second Ctrl-C does not interrupt the removal
            self._programs.__exit__(*exception_info)
            if self._folder is not None:
                self._clear()
        ctrl_c.raise_delayed()


@dataclass(frozen=True)
class SharedObject:
    """Describe an object file that scenes share: kind in the cache, name, command line, texts, and parts of its cache
    key.
    """

    kind: str
    name: str
    command_line: tuple[str, ...]
    key_parts: tuple[str, ...]
    texts: Mapping[str, str]

    def compute_key(self, portable: bool, cache: Cache) -> str:
        """Return the cache key: a digest of texts, command line, compiler and, unless `portable`, processor."""
        identity = compiler.describe_compiler(compiler.find_compiler(), cache)
        return compute_digest(
            [*self.key_parts, *self.command_line, identity, "" if portable else compiler.describe_cpu()]
        )

    def is_cached(self, portable: bool, cache: Cache) -> bool:
        """Return whether the cache has the object file."""
        return cache.has_entry(self.kind, self.compute_key(portable, cache))

    def fetch_file(self, portable: bool, cache: Cache, background: BackgroundCompilation, renew: bool = False) -> Path:
        """Return the path of the object file, compiled first if the cache lacks it or `renew` is set. Raise BuildError.

        If `background` compiles the same texts, its result is awaited and used. portable: for any processor of this
        architecture.
        """

        def compile_object(folder: Path) -> None:
            """Compile the object file in a folder, or fetch it from the background compilation. Raise BuildError.

            The written texts are removed at the end.
            """
            if background.fetch_object(folder / self.name, self.command_line, self.texts):
                return
            for name, text in self.texts.items():
                (folder / name).write_text(text, encoding="utf-8")
            with Programs() as programs:
                if failed := wait_for_compiler(
                    programs, start_compiler(programs, self.command_line, folder), folder / self.name
                ):
                    raise failed
            for name in self.texts:
                (folder / name).unlink()

        return cache.fetch(self.kind, self.compute_key(portable, cache), compile_object, renew=renew) / self.name


def describe_engine_object(header: str, portable: bool, unoptimized: bool = False) -> SharedObject:
    """Return the description of the time loops' object file for a scene with this model.h.

    The engine reads only the part of the header before its values, so that scenes of equal sizes share the file.
    """
    _, _, text = header.partition("#define GUDGEON_MODEL_H\n")
    read = text.partition(ENGINE_ENDS)[0]
    command_line = build_unit_command(portable, [str(UNIT)], "engine.o", unoptimized, "loops")
    return SharedObject("engines", "engine.o", command_line, (read, compute_engine_digest()), {HEADER: read})

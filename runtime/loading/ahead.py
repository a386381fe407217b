"""What a library is compiled from, and compiled ahead of it: each part as soon as the texts that it reads are there."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.contract.kernel_source import ENGINE_PART, MAIN, KernelSource
from gudgeon.errors import GudgeonError
from gudgeon.loading import compiler
from gudgeon.loading.engine import UNIT, include_flags
from gudgeon.waiting.programs import Programs

if TYPE_CHECKING:
    import subprocess


def units(source: KernelSource) -> dict[str, list[str]]:
    """What is compiled side by side: the compiler's arguments by the name of the object."""
    whole = {"scene.o": [source.main]}
    if source.cdef:
        return whole
    parts = {_object(part): _unit(part, source.main) for part in source.parts}
    return {_object(ENGINE_PART): _unit(ENGINE_PART, source.main), **(parts or whole)}


def unit_line(command: tuple[str, ...], portable: bool, unit: list[str], made: str) -> list[str]:
    """The compiler's line for one unit of a library: what it shares with others stays inside."""
    return [*command, *compiler.flags(portable), "-fvisibility=hidden", *include_flags(), "-c", *unit, "-o", made]


def _object(part: int) -> str:
    return f"scene_{part}.o" if part else "engine.o"


def _unit(part: int, main: str) -> list[str]:
    return [f"-DPART={part}", main] if part else [str(UNIT)]


class Ahead:
    """A context that nothing survives. What cannot be begun here is told where the library is made."""

    def __init__(self, portable: bool) -> None:
        self._portable, self._programs = portable, Programs()
        self._folder: Path | None = None
        self._texts: dict[str, str] = {}
        self._begun: dict[str, tuple[list[str], subprocess.Popen[str]]] = {}

    def __enter__(self) -> Ahead:
        return self

    def begin(self, part: int, texts: Mapping[str, str]) -> None:
        """A part of the scene of which these texts are there by now."""
        made = _object(part)
        try:
            line = unit_line(compiler.find_compiler(), self._portable, _unit(part, MAIN), made)
            self._folder = self._folder or Path(tempfile.mkdtemp(prefix="gudgeon-"))
            for name in texts.keys() - self._texts.keys():
                (self._folder / name).write_text(texts[name], encoding="utf-8")
            self._texts |= texts
            environment = {**compiler.plain(), "TMPDIR": str(self._folder)}
            self._begun[made] = line, self._programs.begin(line, self._folder, environment)
        except (GudgeonError, OSError):
            self._begun.pop(made, None)

    def take(self, made: Path, line: list[str], texts: Mapping[str, str]) -> bool:
        """Waits for the object of this line and these texts and moves it to its place, once; False: there is none."""
        if self._folder is None or not self.is_under_way(made.name, line, texts):
            return False
        _, process = self._begun.pop(made.name)
        self._programs.wait(process)
        if process.returncode or not (self._folder / made.name).exists():
            return False
        shutil.move(self._folder / made.name, made)
        return True

    def is_under_way(self, name: str, line: list[str], texts: Mapping[str, str]) -> bool:
        """Whether `take` may have it."""
        same = all(texts.get(file) == text for file, text in self._texts.items())
        return same and name in self._begun and self._begun[name][0] == line

    def __exit__(self, *wrong: object) -> None:
        self._programs.__exit__(*wrong)
        if self._folder is not None and os.path.isdir(self._folder):
            shutil.rmtree(self._folder, ignore_errors=True)

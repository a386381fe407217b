"""The engine compiled ahead: of a scene's C it reads model.h alone, and is under way while the rest is written."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.errors import GudgeonError
from gudgeon.loading import compiler
from gudgeon.loading.engine import UNIT, include_flags
from gudgeon.waiting.programs import Programs

if TYPE_CHECKING:
    import subprocess

HEADER, OBJECT = "model.h", "engine.o"


def unit_line(command: tuple[str, ...], portable: bool, unit: str, made: str) -> list[str]:
    """The compiler's line for one unit of a library: what it shares with others stays inside."""
    return [*command, *compiler.flags(portable), "-fvisibility=hidden", *include_flags(), "-c", unit, "-o", made]


class Ahead:
    """A context that nothing survives. What cannot be begun here is told where the library is made."""

    def __init__(self, portable: bool) -> None:
        self._portable, self._programs = portable, Programs()
        self._folder: Path | None = None
        self._begun: tuple[str, list[str], subprocess.Popen[str]] | None = None

    def __enter__(self) -> Ahead:
        return self

    def begin(self, header: str) -> None:
        """The engine of the scene with this model.h; once."""
        try:
            line = unit_line(compiler.find_compiler(), self._portable, str(UNIT), OBJECT)
            self._folder = Path(tempfile.mkdtemp(prefix="gudgeon-"))
            (self._folder / HEADER).write_text(header, encoding="utf-8")
            environment = {**compiler.plain(), "TMPDIR": str(self._folder)}
            self._begun = header, line, self._programs.begin(line, self._folder, environment)
        except (GudgeonError, OSError):
            self._begun = None

    def take(self, header: str, line: list[str], made: Path) -> bool:
        """Waits for the object of this very header and line and moves it to its place, once; False: there is none."""
        if self._begun is None or self._folder is None or not self.is_under_way(header, line):
            return False
        process, self._begun = self._begun[2], None
        self._programs.wait(process)
        if process.returncode or not (self._folder / OBJECT).exists():
            return False
        shutil.move(self._folder / OBJECT, made)
        return True

    def is_under_way(self, header: str, line: list[str]) -> bool:
        """Whether `take` may have it."""
        return self._begun is not None and self._begun[:2] == (header, line)

    def __exit__(self, *wrong: object) -> None:
        self._programs.__exit__(*wrong)
        if self._folder is not None and os.path.isdir(self._folder):
            shutil.rmtree(self._folder, ignore_errors=True)

"""One call of the compiler: begun, waited for, and what is said where it fails."""

from __future__ import annotations

import errno
import signal
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.errors import BuildError
from gudgeon.loading import compiler
from gudgeon.loading.engine import include_flags
from gudgeon.waiting.programs import Programs

if TYPE_CHECKING:
    import subprocess

FULL = {
    "No space left on device": errno.ENOSPC, "Disk quota exceeded": errno.EDQUOT, "File too large": errno.EFBIG,
    "File size limit exceeded": errno.EFBIG,
}  # fmt: skip


def unit_line(
    portable: bool, files: Sequence[str], made: str, quick: bool = False, unit: str = ""
) -> tuple[str, ...]:  # fmt: skip
    """The line for one unit of a library (compiler.of_unit): what it shares with others stays inside."""
    command = compiler.find_compiler()
    flags = compiler.of_unit(compiler.flags(portable, command, quick), unit)
    return (*command, *flags, "-fvisibility=hidden", *include_flags(), "-c", *files, "-o", made)


def begin(programs: Programs, line: Sequence[str], folder: Path) -> subprocess.Popen[str]:
    """A compiler under way in the folder."""
    environment = {**compiler.plain(), "TMPDIR": str(folder)}  # what it writes in between belongs to the entry too
    try:
        return programs.begin([*line], folder, environment)
    except OSError as error:
        raise BuildError(f"the compiler {line[0]} cannot be run: {error}\n  {compiler.INSTALL_COMPILER}") from error


def finish(programs: Programs, process: subprocess.Popen[str], made: Path) -> Exception | None:
    """Wait; what to raise where it failed: OSError for a full disk (another folder is tried then), else BuildError."""
    out, err = programs.wait(process)
    if process.returncode == 0 and made.is_file():
        return None
    said = (err or out).strip()
    for text, code in FULL.items():
        if text in said:
            return OSError(code, f"the compiler said: {text}")
    if process.returncode == -signal.SIGXFSZ:
        return OSError(errno.EFBIG, "the compiler was stopped by a limit on the size of files (ulimit -f)")
    first = "\n  ".join(said.splitlines()[:8]) or "it said nothing"
    line = " ".join(map(str, process.args))  # type: ignore[arg-type]
    told = f"failed (exit status {process.returncode})"
    if process.returncode == 0:
        told = f"ended without an error, and made no {made.name}"
    return BuildError(f"the C compiler {told}:\n  {first}\n  called as {line}")

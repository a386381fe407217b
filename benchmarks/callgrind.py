"""Count the instructions of one function call by valgrind's callgrind, independent of the machine's load.

A small C driver makes `count` calls. It is run with two counts under valgrind. The difference of instructions over the
difference of counts is one call, since the start of the process, the loader and `atol` cancel. Values are written in
hexadecimal. Valgrind does not support every instruction of every processor: on x86 all is compiled for x86-64-v3
(AVX2), which also makes machines comparable.
"""

from __future__ import annotations

import math
import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.loading import compiler
from gudgeon.loading.engine import UNIT, build_include_flags, select_declarations

COUNTS = (100, 1100)
PORTABLE = ("-march=x86-64-v3",) if os.uname().machine == "x86_64" else ()
FLAGS = (*compiler.FLAGS, *PORTABLE)  # flags of a scene, for that processor
DRIVER = """\
#include <stddef.h>
#include <stdlib.h>
{declarations}
{arrays}
int main(int argc, char **argv)
{{
    const long count = argc > 1 ? atol(argv[1]) : 1;
    volatile double sum = {call}; /* somebody wants it */
    (void)sum;
    return 0;
}}
"""


@dataclass(frozen=True)
class Call:
    """A C expression `call` of type double that makes `count` calls, with named `arrays` of doubles."""

    files: Mapping[str, str]
    units: tuple[str, ...]
    declarations: str
    call: str
    arrays: Mapping[str, np.ndarray]
    flags: tuple[str, ...] = FLAGS


def of_scene(source: KernelSource, call: str, arrays: Mapping[str, np.ndarray]) -> Call:
    """Return a call of a function in a scene's library."""
    return Call(
        source.files,
        (source.main, str(UNIT)),
        select_declarations(source),
        call,
        arrays,
        (*FLAGS, *build_include_flags()),
    )


def available() -> bool:
    """Return whether valgrind is installed."""
    return shutil.which("valgrind") is not None


def instructions(call: Call, counts: tuple[int, int] = COUNTS) -> float:
    """Return the number of instructions of one call.

    Raises RuntimeError without valgrind, or if something cannot be compiled or run.
    """
    if not available():
        raise RuntimeError("instructions are counted by valgrind, which is not installed (apt-get install valgrind)")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, text in call.files.items():
            (folder / file).write_text(text, encoding="utf-8")
        arrays = "\n".join(_array(*item) for item in call.arrays.items())
        driver = DRIVER.format(declarations=call.declarations, arrays=arrays, call=call.call)
        (folder / "driver.c").write_text(driver, encoding="utf-8")
        command = [*compiler.find_compiler(), *call.flags, "driver.c", *call.units, "-o", "driver", "-lm"]
        _run(command, folder)
        few, many = (_total(folder, count) for count in counts)
    return (many - few) / (counts[1] - counts[0])


def _array(name: str, values: np.ndarray) -> str:
    """Return a C array with exact values: hexadecimal; it has at least one element."""
    words = [_word(float(x)) for x in np.ravel(values)] or ["0.0"]
    return f"static double {name}[] = {{{', '.join(words)}}};"


def _word(x: float) -> str:
    """Return a C expression for a double, with NaN and infinity."""
    if math.isnan(x):
        return "0.0/0.0"
    return x.hex() if math.isfinite(x) else f"{'-' if x < 0 else ''}1.0/0.0"


def _total(folder: Path, count: int) -> int:
    """Return the number of instructions of the whole process."""
    report = folder / f"count_{count}.out"
    digits = f"{count:09d}"  # a fixed number of digits, so that `atol` cancels
    _run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={report}", "./driver", digits], folder)
    found = re.search(r"^(?:summary|totals): (\d+)", report.read_text(), re.MULTILINE)
    if found is None:
        raise RuntimeError("callgrind has counted nothing")
    return int(found[1])


def _run(command: list[str], folder: Path) -> None:
    """Run a command. Raises RuntimeError if it fails."""
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace")
    if done.returncode:
        raise RuntimeError(f"{command[0]} failed: {done.stderr.strip()[-400:]}")

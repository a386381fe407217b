"""Instructions of one call, counted by callgrind: figures that do not depend on the machine or on who else uses it.

A small C driver makes `count` calls. It is run with two counts under valgrind; their difference over that of the
counts is one call, and the start of the process, the loader and `atol` cancel. Numbers reach the driver in
hexadecimal and live in a file of their own, so that the compiler cannot compute with them beforehand. Valgrind does
not know every instruction of every processor: on x86 all is compiled for x86-64-v3 (AVX2), which also makes machines
comparable.
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
from gudgeon.loading.engine import UNIT, declarations, include_flags

COUNTS = (100, 1100)
PORTABLE = ("-march=x86-64-v3",) if os.uname().machine == "x86_64" else ()
FLAGS = (*compiler.FLAGS, *PORTABLE)  # a scene's own, for that processor
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
    """`call` is an expression of type double that makes `count` calls, on `arrays` of doubles by name."""

    files: Mapping[str, str]
    units: tuple[str, ...]
    declarations: str
    call: str
    arrays: Mapping[str, np.ndarray]
    flags: tuple[str, ...] = FLAGS


def of_scene(source: KernelSource, call: str, arrays: Mapping[str, np.ndarray]) -> Call:
    """A call of a scene's library."""
    return Call(source.files, (source.main, str(UNIT)), declarations(source), call, arrays, (*FLAGS, *include_flags()))


def available() -> bool:
    """Whether valgrind is installed."""
    return shutil.which("valgrind") is not None


def instructions(call: Call, counts: tuple[int, int] = COUNTS) -> float:
    """Of one call. Raises RuntimeError without valgrind, or where something cannot be compiled or run."""
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
    """Exact: hexadecimal; NaN and infinity by their usual expressions. No array of C is empty."""
    words = [_word(float(x)) for x in np.ravel(values)] or ["0.0"]
    return f"static double {name}[] = {{{', '.join(words)}}};"


def _word(x: float) -> str:
    if math.isnan(x):
        return "0.0/0.0"
    return x.hex() if math.isfinite(x) else f"{'-' if x < 0 else ''}1.0/0.0"


def _total(folder: Path, count: int) -> int:
    """Instructions of the whole process."""
    report = folder / f"count_{count}.out"
    digits = f"{count:09d}"  # as many, or `atol` would not cancel
    _run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={report}", "./driver", digits], folder)
    found = re.search(r"^(?:summary|totals): (\d+)", report.read_text(), re.MULTILINE)
    if found is None:
        raise RuntimeError("callgrind has counted nothing")
    return int(found[1])


def _run(command: list[str], folder: Path) -> None:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace")
    if done.returncode:
        raise RuntimeError(f"{command[0]} failed: {done.stderr.strip()[-400:]}")

"""Parts of the integrator by themselves, in C and without a scene: `c/test_*.c` are programs that check closed forms.

`c/model.h` has the sizes of a linkage that is none, `c/part.h` its only equation; both hold for all of them.
"""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from gudgeon.loading.compiler import find_compiler
from gudgeon.loading.engine import build_include_flags

FOLDER = Path(__file__).parent / "c"
FLAGS = ["-std=c11", "-O1", "-g", "-Wall", "-Wextra", "-Werror", *build_include_flags()]


@pytest.mark.parametrize("program", sorted(file.stem for file in FOLDER.glob("test_*.c")))
def test_part(program: str, tmp_path: Path) -> None:
    line = [*find_compiler(), *FLAGS, f"{program}.c", "-o", str(tmp_path / program), "-lm"]
    compiled = subprocess.run(line, cwd=FOLDER, capture_output=True, text=True)
    assert compiled.returncode == 0, compiled.stderr[:4000]
    done = subprocess.run([tmp_path / program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr

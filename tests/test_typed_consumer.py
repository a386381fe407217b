"""The public calls have types that a strict check can use: of a user's program, outside the checkout."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests import consumer
from tests.programs import needs_compiler


@needs_compiler
def test_the_program_runs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert consumer.main(tmp_path) == 0
    assert "t_end is -1 s" in capsys.readouterr().out


@pytest.mark.slow
def test_mypy_strict_finds_nothing_in_it_and_what_is_put_into_it(tmp_path: Path) -> None:
    text = Path(consumer.__file__).read_text(encoding="utf-8")
    (tmp_path / "mistaken.py").write_text(text.replace("    run, told = one_run(crank)\n", WRONG), encoding="utf-8")
    shutil.copy(consumer.__file__, tmp_path / "consumer.py")
    line = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "consumer.py", "mistaken.py"]
    found = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True)
    errors = [line for line in found.stdout.splitlines() if ": error: " in line]
    assert found.stderr == "" and all(line.startswith("mistaken.py") for line in errors)
    assert [line.rpartition("  [")[2] for line in errors] == MISTAKES


WRONG = """\
    run, told = one_run(crank)
    crank.simulate(1.0, outputs=3)
    gudgeon.load(3)
    answer: int = gudgeon.examine(crank, run)
    crank.simulate_many({"c": [1e-4]}, 1.0)[0].energy()
"""
MISTAKES = ["call-arg]", "arg-type]", "assignment]", "attr-defined]"]

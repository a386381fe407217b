"""Ctrl-C while packages are imported, again in the same process: what is half imported would fail ever after."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from gudgeon.waiting import imports
from tests.programs import needs_compiler

ROOT = Path(__file__).parents[2]
TWICE = """
import os, signal, sys, threading
signal.signal(signal.SIGINT, signal.default_int_handler)

def look(frame, event, _):
    if event == "call" and frame.f_code.co_name == "<module>" and frame.f_code.co_filename.endswith(sys.argv[2]):
        sys.setprofile(None)
        os.kill(os.getpid(), signal.SIGINT)

threading.setprofile(look)
try:
    import gudgeon
    gudgeon.load(sys.argv[1])
    print("not interrupted")
except KeyboardInterrupt:
    print("interrupted")
run = gudgeon.load(sys.argv[1]).simulate(0.01, output=2)
print(run.t[-1])
"""


@needs_compiler
@pytest.mark.parametrize(
    "inside", [pytest.param("ruamel/yaml/scanner.py", marks=pytest.mark.slow), "sympy/polys/__init__.py"]
)
def test_ctrl_c_while_a_package_is_imported_breaks_nothing_later(inside: str, tmp_path: Path) -> None:
    file = tmp_path / "own.yaml"
    file.write_text((ROOT / "mechanisms/pendulum.yaml").read_text(encoding="utf-8") + "# mine\n", encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-c", TWICE, str(file), inside],
        env={**os.environ, "GUDGEON_CACHE": str(tmp_path / "cache")},
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    assert done.stdout == "interrupted\n0.01\n"


def test_ctrl_c_is_raised_at_once_and_what_is_imported_comes_to_its_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """SymPy kept it for as long as it took itself: seconds on a loaded machine."""
    imported: list[str] = []
    answered = threading.Event()

    def import_module(name: str) -> None:
        if name == "b":
            os.kill(os.getpid(), signal.SIGINT)
            assert answered.wait(60)
        imported.append(name)

    monkeypatch.setattr(imports, "import_module", import_module)
    with pytest.raises(KeyboardInterrupt):
        imports.import_modules_in_thread("a", "b", "c")
    assert imported == ["a"]
    answered.set()
    for thread in threading.enumerate():
        if thread.name == "imports":
            thread.join(60)
    assert imported == ["a", "b", "c"]


def test_what_fails_is_told_and_what_is_there_costs_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ModuleNotFoundError, match="no_such_package"):
        imports.import_modules_in_thread("json", "no_such_package")
    monkeypatch.setattr(imports, "import_module", None)
    imports.import_modules_in_thread("json", "signal")


COMMAND = """
import signal, sys

def look(frame, event, _):
    if event == "call" and frame.f_code.co_filename.endswith("typer/__init__.py"):
        sys.setprofile(None)
        signal.raise_signal(signal.SIGINT)

signal.signal(signal.SIGINT, signal.default_int_handler)
from gudgeon.entry import main
sys.setprofile(look)
main()
"""


def test_ctrl_c_while_the_command_line_is_imported_is_told_in_a_word() -> None:
    done = subprocess.run([sys.executable, "-c", COMMAND], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted\n")


@pytest.mark.parametrize(("user_size", "size"), [(None, 20000), ("777", 777)])
def test_sympy_gets_a_larger_cache_unless_the_user_chose_its_size(user_size: str | None, size: int) -> None:
    """The variable is set during the import of SymPy only."""
    code = (
        "import os; from gudgeon.waiting.imports import import_modules_in_thread; import_modules_in_thread('sympy');"
        " from sympy.core.cache import SYMPY_CACHE_SIZE; print(SYMPY_CACHE_SIZE, os.environ.get('SYMPY_CACHE_SIZE'))"
    )
    environment = {name: value for name, value in os.environ.items() if name != "SYMPY_CACHE_SIZE"}
    environment |= {"SYMPY_CACHE_SIZE": user_size} if user_size else {}
    result = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert result.stdout.split() == [str(size), str(user_size)]

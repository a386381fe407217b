"""A program that is interrupted or ended while it compiles leaves no temporary folder and no compiler behind."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.programs import needs_compiler

pytestmark = needs_compiler
COMPILER = """#!/bin/sh
case "$*" in *-c*-o*) echo $$ >> {folder}/compilers; sleep 60;; esac
exec {real} "$@"
"""
LINES = ["-c", "import gudgeon; gudgeon.load('pendulum', quick=False)"], ["-m", "gudgeon", "run", "pendulum"]
ENDINGS = [(signal.SIGINT, False), (signal.SIGTERM, False), (signal.SIGHUP, False), (signal.SIGTERM, True)]


def is_running(process: int) -> bool:
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="processes are looked up in /proc")
@pytest.mark.parametrize(("ending", "command"), ENDINGS)
def test_nothing_is_left(ending: signal.Signals, command: bool, tmp_path: Path) -> None:
    real = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    compiler = tmp_path / "compiler"
    compiler.write_text(COMPILER.format(folder=tmp_path, real=real))
    compiler.chmod(0o755)
    (tmp_path / "temporary").mkdir()
    more = {
        "CC": str(compiler),
        "TMPDIR": str(tmp_path / "temporary"),
        "GUDGEON_CACHE": str(tmp_path / "cache"),
        "GUDGEON_QUICK": "0",
    }
    with subprocess.Popen(
        [sys.executable, *LINES[command]],
        env=os.environ | more,
        cwd=tmp_path,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as program:
        began = time.monotonic()
        while not (tmp_path / "compilers").exists() and time.monotonic() - began < 60.0:
            assert program.poll() is None
            time.sleep(0.01)
        program.send_signal(ending)
        program.wait(timeout=120)  # a bound for what hangs, also beside other work
    assert program.returncode in (-ending, 128 + ending)
    compilers = [int(number) for number in (tmp_path / "compilers").read_text().split()]
    left = [number for number in compilers if is_running(number)]
    for number in left:
        os.killpg(number, signal.SIGKILL)
    assert compilers and not left and not list((tmp_path / "temporary").iterdir())

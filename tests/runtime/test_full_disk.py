"""A disk that fills at fifty sizes under whatever writes: nothing lost, nothing left, no signal, and then it works.

Where a process may make a file system of its own (root; or users, where namespaces are theirs to make).
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.runtime.full_disk import TASKS

ROOT = Path(__file__).parents[2]
COUNT = 50
MOUNT = 'mount -t tmpfs -o size=24m,mode=0700 gudgeon "$1" && shift && exec "$@"'


def own_namespace(folder: Path, *line: str) -> list[str] | None:
    """The line in a namespace of its own with a small file system at `folder`; None if that is refused."""
    for way in (["unshare", "--mount"], ["unshare", "--user", "--map-root-user", "--mount"]):
        start = [*way, "sh", "-c", MOUNT, "sh", str(folder)]
        if shutil.which("unshare") and subprocess.run([*start, "true"], capture_output=True).returncode == 0:
            return [*start, *line]
    return None


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(TASKS))
def test_a_disk_that_fills_loses_nothing(name: str, tmp_path: Path) -> None:
    (tmp_path / "disk").mkdir()
    line = own_namespace(
        tmp_path / "disk", sys.executable, "-m", "tests.runtime.full_disk", name, str(tmp_path / "disk"), str(COUNT)
    )
    if line is None:
        pytest.skip("no file system of one's own can be made here")
    done = subprocess.run(line, cwd=ROOT, capture_output=True, text=True, env={**os.environ, "MPLBACKEND": "agg"})
    assert done.returncode == 0, done.stderr[-2000:]
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["wrong"] == [] and found["signals"] == 0
    assert found["refused"] + found["written"] == COUNT and found["written"] > 0
    assert found["refused"] > 0 or name == "compile", "the disk was never full"

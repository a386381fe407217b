"""A disk that fills at fifty sizes under whatever writes: nothing lost, nothing left, no signal, and then it works.

And one whose programs may not be run.

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

from tests.files.full_disk import TASKS

ROOT = Path(__file__).parents[2]
COUNT = 50
MOUNT = 'mount -t tmpfs -o "$1",mode=0700 gudgeon "$2" && shift 2 && exec "$@"'


def own_namespace(folder: Path, *line: str, options: str = "size=24m") -> list[str] | None:
    """The line in a namespace of its own with a small file system at `folder`; None if that is refused."""
    for way in (["unshare", "--mount"], ["unshare", "--user", "--map-root-user", "--mount"]):
        start = [*way, "sh", "-c", MOUNT, "sh", options, str(folder)]
        if shutil.which("unshare") and subprocess.run([*start, "true"], capture_output=True).returncode == 0:
            return [*start, *line]
    return None


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(TASKS))
def test_a_disk_that_fills_loses_nothing(name: str, tmp_path: Path) -> None:
    (tmp_path / "disk").mkdir()
    line = own_namespace(
        tmp_path / "disk", sys.executable, "-m", "tests.files.full_disk", name, str(tmp_path / "disk"), str(COUNT)
    )
    if line is None:
        pytest.skip("no file system of one's own can be made here")
    done = subprocess.run(line, cwd=ROOT, capture_output=True, text=True, env={**os.environ, "MPLBACKEND": "agg"})
    assert done.returncode == 0, done.stderr[-2000:]
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["wrong"] == [] and found["signals"] == 0
    assert found["refused"] + found["written"] == COUNT and found["written"] > 0
    assert found["refused"] > 0 or name == "compile", "the disk was never full"


TWICE = """
import os, sys, pathlib
sys.path.insert(0, sys.argv[2])
from gudgeon.loading import build
from gudgeon.loading.cache import Cache
from tests.tiny import tiny
for _ in range(int(sys.argv[3])):
    build._libraries.clear()
    assert build.compile_kernels(tiny(7), cache=Cache(sys.argv[1] + "/cache")).lib.scale(1.0) == 7.0
real, tries = build._build, []
build._build = lambda *a: tries.append(a) or real(*a)
build._libraries.clear()
build.compile_kernels(tiny(7), cache=Cache(sys.argv[1] + "/cache"))
print(len(tries))
"""


@pytest.mark.slow
def test_a_cache_that_is_mounted_noexec_is_told_and_compiled_into_once(tmp_path: Path) -> None:
    (tmp_path / "disk").mkdir()
    requested = (sys.executable, "-W", "always", "-c", TWICE, str(tmp_path / "disk"), str(ROOT), "1")
    line = own_namespace(tmp_path / "disk", *requested, options="noexec")
    if line is None:
        pytest.skip("no file system of one's own can be made here")
    done = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "0\n" and done.stderr.count("noexec") == 1 and "GUDGEON_CACHE" in done.stderr

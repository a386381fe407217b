"""Two versions of gudgeon share a cache: each finds what is its own, and leaves the other's as it is."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.programs import needs_compiler

ROOT = Path(__file__).parents[2]
MORE = 4096  # bytes that the other engine's runs take beside those of this one's
CODE = """
import sys
import gudgeon
print("ready", flush=True)
input()
for file in ("pendulum", "own.yaml"):
    one = gudgeon.load(file)
    run = one.simulate(0.5, output=5)
    noted = sum("another version" in text for text in one.source.files.values())
    print(gudgeon.__version__, one.loading.origin, one.compiled.lib.gudgeon_run_size(), noted, run.q.tobytes().hex())
"""


def copy_of(folder: Path) -> Path:
    """The package as it is installed."""
    shutil.copytree(ROOT / "src", folder, dirs_exist_ok=True)
    return folder


def change(file: Path, old: str, new: str) -> None:
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")


def start(version: Path, cache: Path) -> subprocess.Popen[str]:
    environment = {**os.environ, "PYTHONPATH": str(version), "GUDGEON_CACHE": str(cache)}
    line = [sys.executable, "-c", CODE]
    pipe = subprocess.PIPE
    return subprocess.Popen(line, cwd=cache.parent, env=environment, stdin=pipe, stdout=pipe, stderr=pipe, text=True)


def together(versions: list[Path], cache: Path) -> list[list[list[str]]]:
    """Both begin to load at once; of each its two lines, in words."""
    several = [start(version, cache) for version in versions]
    for each in several:
        assert each.stdout and each.stdout.readline() == "ready\n"
    for each in several:
        assert each.stdin
        each.stdin.write("\n")
        each.stdin.flush()
    message = [each.communicate() for each in several]
    assert [error for _, error in message] == [""] * len(several)
    return [[line.split() for line in out.splitlines()] for out, _ in message]


def contents(cache: Path) -> dict[Path, tuple[int, bytes]]:
    """Files of entries: when they were written, and what they hold."""
    kinds = ("models", "libraries", "engines", "compilers")
    files = (path for kind in kinds for path in cache.glob(f"{kind}/*/*"))
    return {path: (path.stat().st_mtime_ns, path.read_bytes()) for path in files}


@needs_compiler
@pytest.mark.slow
def test_two_versions_in_one_cache(tmp_path: Path) -> None:
    """They differ in their engine and in what they print; both begin at once on an empty cache, and a third time."""
    ours, other = (copy_of(tmp_path / name) for name in ("ours", "other"))
    change(other / "gudgeon/__init__.py", '__version__ = "', '__version__ = "9.')
    change(other / "gudgeon/engine/run/run.c", "return sizeof(Run)", f"return {MORE} + sizeof(Run)")
    change(other / "gudgeon/templates/c/model.h.jinja", "/*\n", "/*\n * another version\n")
    (tmp_path / "own.yaml").write_text((ROOT / "mechanisms/pendulum.yaml").read_text() + "# own\n")
    first = together([ours, other], tmp_path / "cache")
    there = contents(tmp_path / "cache")
    again = together([other, ours, other, ours], tmp_path / "cache")
    assert contents(tmp_path / "cache") == there
    for versions, found in (((0, 1), first), ((1, 0, 1, 0), again)):
        size = int(found[versions.index(0)][0][2])
        for is_other, lines in zip(versions, found, strict=True):
            for version, origin, took, _, numbers in lines:
                assert version.startswith("9.") == bool(is_other) and int(took) == size + MORE * is_other
                assert numbers == first[0][0][4] and (found is first or origin == "cache")
            assert int(lines[1][3]) == is_other
    assert [lines[1][1] for lines in first] == ["derived", "derived"]

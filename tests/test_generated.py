"""generated/ is what the generator writes today, byte for byte, whatever the order of Python's sets."""

from __future__ import annotations

import os
import subprocess
import sys
from hashlib import sha256
from pathlib import Path

import pytest

from gudgeon.loading.shipped import committed, generated, read_generated, write_generated

ROOT = Path(__file__).parents[1]
STRANGE = {
    "LC_ALL": "POSIX", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0", "TZ": "Pacific/Auckland",
    "SOURCE_DATE_EPOCH": "315532800", "HOME": "/nowhere",
}  # fmt: skip


def contents(folder: Path) -> dict[str, bytes]:
    files = (path for path in folder.rglob("*") if path.suffix in (".c", ".h", ".json"))
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


@pytest.mark.parametrize("seed", ["1", *(pytest.param(seed, marks=pytest.mark.slow) for seed in ("0", "20231"))])
def test_generating_again_gives_the_committed_bytes(tmp_path: Path, seed: str) -> None:
    """In a process to which umask, locale, time zone, home, clock and the folder's name are strange."""
    folder = tmp_path / "Käse & \"mein's\" {x} %s"
    folder.mkdir()
    subprocess.run(
        [sys.executable, str(ROOT / "tools" / "regenerate.py"), str(folder)],
        env={**os.environ, **STRANGE, "PYTHONHASHSEED": seed}, cwd=folder, umask=0o077,
        check=True,
        capture_output=True,
    )  # fmt: skip
    kept, now = contents(ROOT / "generated"), contents(folder)
    assert sorted(kept) == sorted(now), "run `make generated`"
    assert [name for name in kept if kept[name] != now[name]] == [], "run `make generated`"


@pytest.mark.parametrize("mechanism", generated())
def test_every_shipped_mechanism_compiles_without_a_derivation(mechanism: str, tmp_path: Path) -> None:
    data = (ROOT / "mechanisms" / f"{mechanism}.yaml").read_bytes()
    scenes = sorted(path.name for path in (ROOT / "generated" / mechanism).glob("*"))
    assert "ideal" in scenes, "run `make generated`"
    for scene in scenes:
        source = committed(mechanism, scene, sha256(data).hexdigest())
        assert source is not None, "run `make generated`"
        assert (source.mechanism, source.scene) == (mechanism, scene)
        write_generated(source, tmp_path)
        assert read_generated(tmp_path) == source


def test_no_trace_of_the_machine() -> None:
    for name, text in contents(ROOT / "generated").items():
        for trace in (str(ROOT).encode(), str(Path.home()).encode() + b"/", b"/tmp/", b".py"):
            assert trace not in text, name

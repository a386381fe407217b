"""generated/ is what the generator writes today, byte for byte, whatever the order of Python's sets."""

from __future__ import annotations

import lzma
import os
import subprocess
import sys
from dataclasses import replace
from hashlib import sha256
from pathlib import Path

import pytest

from gudgeon.generator.targets.c.readme import READABLE
from gudgeon.loading.generated_scenes import ARCHIVE, read_archive, read_scenes, write_scenes
from gudgeon.loading.shipped import list_generated_scenes, read_committed_source

ROOT = Path(__file__).parents[1]
MAX_LINES = 20_000
STRANGE = {
    "LC_ALL": "POSIX",
    "PYTHONUTF8": "0",
    "PYTHONCOERCECLOCALE": "0",
    "TZ": "Pacific/Auckland",
    "SOURCE_DATE_EPOCH": "315532800",
    "HOME": "/nowhere",
}


def files(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*") if path.is_file() and path.suffix not in (".py", ".pyc"))


def contents(folder: Path) -> dict[str, bytes]:
    """Files by path; of an archive what is in it, for its bytes depend on the version of liblzma."""
    read = {path.relative_to(folder).as_posix(): path.read_bytes() for path in files(folder)}
    return {name: lzma.decompress(data) if name.endswith(ARCHIVE) else data for name, data in read.items()}


@pytest.mark.parametrize("seed", ["1", *(pytest.param(seed, marks=pytest.mark.slow) for seed in ("0", "20231"))])
def test_generating_again_gives_the_committed_bytes(tmp_path: Path, seed: str) -> None:
    """In a process to which umask, locale, time zone, home, clock and the folder's name are strange."""
    folder = tmp_path / 'Käse & "mein\'s" {x} %s'
    folder.mkdir()
    subprocess.run(
        [sys.executable, str(ROOT / "tools" / "regenerate.py"), str(folder)],
        env={**os.environ, **STRANGE, "PYTHONHASHSEED": seed},
        cwd=folder,
        umask=0o077,
        check=True,
        capture_output=True,
    )
    kept, now = contents(ROOT / "generated"), contents(folder)
    assert sorted(kept) == sorted(now), "run `make generated`"
    assert [name for name in kept if kept[name] != now[name]] == [], "run `make generated`"


def test_files_are_for_readers() -> None:
    """Each text is stored once, as a file where a person reads it; the files are short enough to be read."""
    kept = {path: path.read_bytes() for path in files(ROOT / "generated")}
    assert len(set(kept.values())) == len(kept)
    assert {path.name for path in kept} <= {*READABLE, ARCHIVE, "README.md"}
    assert sum(data.count(b"\n") for data in kept.values()) <= MAX_LINES
    for folder in (ROOT / "generated").glob("*/"):
        texts = [*read_archive(folder).get("texts", {}).values()]
        assert len(set(texts)) == len(texts)


@pytest.mark.parametrize("mechanism", list_generated_scenes())
def test_every_shipped_mechanism_compiles_without_a_derivation(mechanism: str, tmp_path: Path) -> None:
    data = (ROOT / "mechanisms" / f"{mechanism}.yaml").read_bytes()
    sources = read_scenes(ROOT / "generated" / mechanism)
    scenes = [source.scene for source in sources]
    assert "ideal" in scenes, "run `make generated`"
    assert sorted(scenes) == sorted(folder.name for folder in (ROOT / "generated" / mechanism).glob("*/"))
    for source in sources:
        assert read_committed_source(mechanism, source.scene, sha256(data).hexdigest()) == source, (
            "run `make generated`"
        )
        assert source.mechanism == mechanism
    write_scenes(tmp_path, sources, READABLE)
    assert read_scenes(tmp_path) == sources


def test_no_trace_of_the_machine() -> None:
    for name, text in contents(ROOT / "generated").items():
        for trace in (str(ROOT).encode(), str(Path.home()).encode() + b"/", b"/tmp/", b".py"):
            assert trace not in text, name


def test_the_texts_of_an_archive_can_be_compared() -> None:
    """What `git diff` is given in place of the compressed bytes: texts as they are compiled, with their lines."""
    tool = [sys.executable, str(ROOT / "tools" / "archived.py"), str(ROOT / "generated" / "pendulum" / ARCHIVE)]
    printed = subprocess.run(tool, check=True, capture_output=True, env={**os.environ, **STRANGE}).stdout.decode()
    source = read_scenes(ROOT / "generated" / "pendulum")[0]
    assert f"==> ideal/lanes.c <==\n{source.files['lanes.c']}" in printed
    assert f"==> ideal/kernel.json <==\n{replace(source, files={}).to_json()}" in printed

"""Libraries bundled in a wheel: what runs without a compiler."""

from __future__ import annotations

import os
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import BuildError
from gudgeon.loading import build, compiler, library
from gudgeon.loading.cache import Cache
from gudgeon.loading.generated_scenes import read_scene, read_scenes
from gudgeon.loading.shipped import GENERATED

ROOT = Path(__file__).parents[2]


@pytest.fixture(name="wheel")
def carries_the_pendulum(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """As a wheel with this scene alone lies there; then there is no compiler, and nothing is in the cache."""
    monkeypatch.delenv("CC", raising=False)
    source = read_scene(GENERATED / "pendulum", "ideal")
    assert source is not None
    (tmp_path / "made").mkdir()
    folder = tmp_path / "carried" / library.format_platform(sys.platform, os.uname().machine)
    folder.mkdir(parents=True)
    made = build.build_portable_library(tmp_path / "made", source, Cache(tmp_path / "cache"))
    made.rename(folder / library.compute_library_file_name(source))
    monkeypatch.setattr(library, "BUNDLED_FOLDER", tmp_path / "carried")
    monkeypatch.setenv("GUDGEON_CACHE", str(tmp_path / "empty"))
    monkeypatch.setenv("PATH", "")
    monkeypatch.setitem(sys.modules, "ziglang", None)
    return folder


def test_a_shipped_mechanism_runs_without_a_compiler(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    """To the bits of a library for this processor, in batches too, which go run by run."""
    first = gudgeon.load("pendulum")
    expected = first.simulate(0.5, output=3).q
    request.getfixturevalue("wheel")
    build._libraries.clear()
    monkeypatch.setattr(build, "_libraries", {})
    again = gudgeon.load("pendulum")
    assert Path(again.compiled._library.file).is_relative_to(tmp_path / "carried")
    assert np.array_equal(again.simulate(0.5, output=3).q, expected)
    batch = again.simulate_many({"g": [9.81] * 20}, t_end=0.5, output=3)
    assert all(np.array_equal(batch[k].q, expected) for k in range(20))


def test_what_differs_is_not_taken(wheel: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An edited text, another engine, a library that is none; and a compiler that the user names is never passed by."""
    source = read_scene(GENERATED / "pendulum", "ideal")
    assert source is not None and library.open_bundled_library(source) is not None
    edited = replace(source, files={**source.files, "dynamics.c": source.files["dynamics.c"] + "\n"})
    assert library.open_bundled_library(edited) is None
    with pytest.raises(BuildError, match="no C compiler"):
        build.compile_kernels(edited)
    with pytest.raises(BuildError, match="no C compiler"):  # asked to compile anew
        build.compile_kernels(source, rebuild=True)
    with monkeypatch.context() as other:
        other.setenv("CC", "no-such-cc")
        with pytest.raises(BuildError, match="no-such-cc"):
            build.compile_kernels(source)
    with monkeypatch.context() as other:
        other.setattr(library, "compute_engine_digest", lambda: "another")
        assert library.open_bundled_library(source) is None
    (wheel / library.compute_library_file_name(source)).write_bytes(b"of another C library")
    assert library.open_bundled_library(source) is None
    assert not compiler.has_compiler()


@pytest.mark.slow
@pytest.mark.parametrize("machine", ["x86_64", "aarch64"])
def test_a_wheel_for_a_platform(tmp_path: Path, machine: str) -> None:
    """Libraries of that machine for every scene whose C is kept, and small."""
    pytest.importorskip("ziglang")
    tool = [sys.executable, str(ROOT / "tools" / "wheels.py"), str(tmp_path), "--machine", machine]
    subprocess.run(tool, check=True, capture_output=True)
    (wheel,) = tmp_path.glob(f"gudgeon-*-py3-none-manylinux_2_17_{machine}.whl")
    assert wheel.stat().st_size < 6e6
    with zipfile.ZipFile(wheel) as held:
        names = [name for name in held.namelist() if f"/carried/linux-{machine}/" in name]
        kinds = {held.read(name)[18] for name in names}  # e_machine of ELF: 62 is x86-64, 183 AArch64
    assert len(names) == sum(len(read_scenes(folder)) for folder in (ROOT / "generated").glob("*/"))
    assert kinds == {{"x86_64": 62, "aarch64": 183}[machine]}

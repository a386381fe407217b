"""Engine and parts of a scene are compiled while the rest is being written; nothing is left, whatever happens."""

from __future__ import annotations

import os
import shutil
import signal
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

import gudgeon
from gudgeon.contract.kernel_source import ENGINE_PART, KernelSource
from gudgeon.errors import BuildError, InputError
from gudgeon.loading import background_compilation, build
from gudgeon.loading.background_compilation import BackgroundCompilation, build_command_lines
from gudgeon.loading.cache import CHECKSUM_FILE, _write_checksums
from gudgeon.waiting.programs import Programs

ROD = """\
format: gudgeon/1
name: rod
gravity: [0, -9.81]
bodies: {rod: {length: 0.3, mass: 1, inertia: 0.01}}
ground: {O: [0, 0]}
joints: {pin: {revolute: [ground.O, rod.tail]}}
start: {set: {rod.theta: 0.3}}
"""


@pytest.fixture(autouse=True)
def own_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where temporary folders and the cache are: `tmp` is empty at the end of each test. Nothing is loaded yet."""
    monkeypatch.setattr(build, "_libraries", {})
    (tmp_path / "tmp").mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "tmp"))
    monkeypatch.setenv("GUDGEON_CACHE", str(tmp_path / "cache"))
    return tmp_path


ENGINE = "engine.o"
Line = tuple[str, ...]


def pendulum() -> KernelSource:
    return gudgeon.load("pendulum").source


def part_1(source: KernelSource) -> Line:
    return build_command_lines(source, False)["scene_1.o"]


def test_a_derivation_begins_it_and_the_library_takes_it(own_folders: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    used: list[str] = []
    take = BackgroundCompilation.fetch_object

    def noted(early: BackgroundCompilation, made: Path, line: Line, texts: Mapping[str, str]) -> bool:
        found = take(early, made, line, texts)
        used.extend([made.name] if found else [])
        return found

    monkeypatch.setattr(BackgroundCompilation, "fetch_object", noted)
    (own_folders / "rod.yaml").write_text(ROD)
    run = gudgeon.load(own_folders / "rod.yaml").simulate(t_end=0.5, output=3)
    assert sorted(used) == [ENGINE, "scene_1.o", "scene_2.o", "scene_3.o"]
    assert list((own_folders / "tmp").iterdir()) == []
    monkeypatch.setattr(BackgroundCompilation, "start_unit_compilation", lambda *given: None)
    again = gudgeon.load(own_folders / "rod.yaml", regenerate=True).simulate(t_end=0.5, output=3)
    assert len(used) == 4 and (run["rod.theta"] == again["rod.theta"]).all()


def test_what_scenes_share_is_compiled_once(own_folders: Path) -> None:
    """Another length and another name leave sizes and tables as they are; a second rod does not."""
    engines = own_folders / "cache" / "engines"
    other = ROD.replace("0.3, mass", "0.7, mass").replace("rod", "bar")
    for number, text in ((1, ROD), (1, other), (2, ROD.replace("bodies: {", "bodies: {free: {mass: 1, inertia: 1}, "))):
        (own_folders / "rod.yaml").write_text(text)
        run = gudgeon.load(own_folders / "rod.yaml").simulate(t_end=0.1, output=3)
        assert run.diagnostics.energy_residual < 1e-9
        assert len(list(engines.iterdir())) == number


def test_what_does_not_link_is_compiled_again_where_that_is_asked_for(own_folders: Path) -> None:
    """An object that is whole by its checksums, and no object."""
    (own_folders / "rod.yaml").write_text(ROD)
    gudgeon.load(own_folders / "rod.yaml")
    (entry,) = (own_folders / "cache" / "engines").iterdir()
    (entry / ENGINE).write_bytes(b"no object")
    (entry / CHECKSUM_FILE).unlink()
    _write_checksums(entry, entry)
    build._libraries.clear()
    (own_folders / "rod.yaml").write_text(ROD.replace("0.3, mass", "0.4, mass"))
    with pytest.raises(BuildError, match=ENGINE):
        gudgeon.load(own_folders / "rod.yaml")
    assert gudgeon.load(own_folders / "rod.yaml", regenerate=True).simulate(0.1, output=2)


def test_only_what_is_asked_for_is_taken(own_folders: Path) -> None:
    """Another scene's, or another compiler's line, is not."""
    source, made = pendulum(), own_folders / "scene_1.o"
    texts, line = source.files, part_1(source)
    with BackgroundCompilation(False) as early:
        assert not early.is_compiling("scene_1.o", line, texts)
        early.start_unit_compilation(1, texts)
        assert not early.fetch_object(made, line, {**texts, "model.h": texts["model.h"] + "\n"})
        assert not early.fetch_object(made, (*line, "-g"), texts) and not made.exists()
        assert early.fetch_object(made, line, texts) and made.stat().st_size > 1000
        assert not early.is_compiling("scene_1.o", line, texts) and not early.fetch_object(made, line, texts)
    assert list((own_folders / "tmp").iterdir()) == []


def test_what_is_compiled_already_is_not_begun(own_folders: Path) -> None:
    source = pendulum()
    with BackgroundCompilation(False) as early:
        early.start_unit_compilation(ENGINE_PART, source.files)
        assert not early._compilations and len(early.list_shared_objects(source)) == 1
        early.start_unit_compilation(
            ENGINE_PART, {"model.h": source.files["model.h"].replace("#define N_Q 3 ", "#define N_Q 4 ")}
        )
        assert list(early._compilations) == [ENGINE]
    assert list((own_folders / "tmp").iterdir()) == []


def test_the_engine_of_a_copy_is_begun_before_it_is_derived(own_folders: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """That of the shipped scene of the same name, once; another linkage of that name gets its own in its place."""
    begun: list[str] = []
    begin = BackgroundCompilation._start_compilation

    def noted(early: BackgroundCompilation, name: str, line: Line, texts: Mapping[str, str]) -> None:
        begun.append("derive" if name.startswith("scene") else name)
        begin(early, name, line, texts)

    monkeypatch.setattr(BackgroundCompilation, "_start_compilation", noted)
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    shipped, file = gudgeon.load("pendulum"), own_folders / "own.yaml"
    engines = own_folders / "cache" / "engines"
    shutil.rmtree(engines)
    begun.clear()
    file.write_text(shipped.file.read_text().replace("title: ", "title: own "))
    run = gudgeon.load(file).simulate(0.5, output=3)
    assert begun[:2] == [ENGINE, "derive"] and begun.count(ENGINE) == 1
    assert (run.q == shipped.simulate(0.5, output=3).q).all()
    shutil.rmtree(engines)
    found = []
    for name, number in (("pendulum", 2), ("rod", 1)):
        begun.clear()
        file.write_text(ROD.replace("name: rod", f"name: {name}"))
        found.append(gudgeon.load(file).simulate(0.5, output=3).q)
        assert begun.count(ENGINE) == number and len(list(engines.iterdir())) == 1
        shutil.rmtree(engines)
    assert (found[0] == found[1]).all() and list((own_folders / "tmp").iterdir()) == []


def test_what_cannot_be_compiled_is_told_by_the_library(own_folders: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = pendulum()
    with BackgroundCompilation(False) as early:
        broken = {**source.files, "dynamics.c": "#error of a scene\n"}
        early.start_unit_compilation(1, broken)
        assert not early.fetch_object(own_folders / "scene_1.o", part_1(source), broken)
    (own_folders / "broken.c").write_text("#error of the engine\n")
    (own_folders / "rod.yaml").write_text(ROD.replace("mass: 1", "mass: 2"))  # this process has the other one
    monkeypatch.setattr(background_compilation, "UNIT", own_folders / "broken.c")
    with pytest.raises(BuildError, match="of the engine"):
        gudgeon.load(own_folders / "rod.yaml")
    monkeypatch.setenv("CC", "no-such-compiler")
    with pytest.raises(BuildError, match="no-such-compiler"):
        gudgeon.load(own_folders / "rod.yaml")
    assert list((own_folders / "tmp").iterdir()) == []


def test_nothing_is_left_where_a_derivation_fails(own_folders: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    begun: list[BackgroundCompilation] = []
    begin = BackgroundCompilation.start_unit_compilation

    def and_fail(early: BackgroundCompilation, part: int, texts: Mapping[str, str]) -> None:
        begun.append(early)
        begin(early, part, texts)
        raise InputError("a derivation that fails behind it")

    monkeypatch.setattr(BackgroundCompilation, "start_unit_compilation", and_fail)
    (own_folders / "rod.yaml").write_text(ROD)
    with pytest.raises(InputError, match="behind it"):
        gudgeon.load(own_folders / "rod.yaml")
    assert begun[0]._compilations[ENGINE][2].returncode is not None
    assert list((own_folders / "tmp").iterdir()) == []


def test_a_second_ctrl_c_leaves_nothing_either(own_folders: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One while what the first one gave up is being stopped: it waits until that is done."""
    source, stop = pendulum(), Programs.stop

    def interrupted(self: Programs, *given_up: Any) -> None:
        os.kill(os.getpid(), signal.SIGINT)
        stop(self, *given_up)

    monkeypatch.setattr(Programs, "stop", interrupted)
    with pytest.raises(KeyboardInterrupt), BackgroundCompilation(False) as early:
        early.start_unit_compilation(1, {**source.files, "model.h": source.files["model.h"] + "\n"})
    assert early._compilations["scene_1.o"][2].returncode is not None
    assert list((own_folders / "tmp").iterdir()) == []

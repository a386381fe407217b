"""The engine is compiled while the scene's own C is still being written; nothing of it is left, whatever happens."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest

import gudgeon
from gudgeon.errors import BuildError, InputError
from gudgeon.loading import ahead, compiler
from gudgeon.loading.ahead import OBJECT, Ahead, unit_line
from gudgeon.loading.engine import UNIT

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
    """Where temporary folders and the cache are: `tmp` is empty at the end of each test."""
    (tmp_path / "tmp").mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "tmp"))
    monkeypatch.setenv("GUDGEON_CACHE", str(tmp_path / "cache"))
    return tmp_path


def line() -> list[str]:
    return unit_line(compiler.find_compiler(), False, str(UNIT), OBJECT)


def header() -> str:
    return gudgeon.load("pendulum").source.files["model.h"]


def test_a_derivation_begins_it_and_the_library_takes_it(own_folders: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    taken: list[bool] = []
    take = Ahead.take

    def noted(early: Ahead, text: str, command: list[str], made: Path) -> bool:
        taken.append(take(early, text, command, made))
        return taken[-1]

    monkeypatch.setattr(Ahead, "take", noted)
    (own_folders / "rod.yaml").write_text(ROD)
    run = gudgeon.load(own_folders / "rod.yaml").simulate(t_end=0.5, output=3)
    assert taken == [True] and list((own_folders / "tmp").iterdir()) == []
    monkeypatch.setattr(Ahead, "begin", lambda *given: None)
    again = gudgeon.load(own_folders / "rod.yaml", regenerate=True).simulate(t_end=0.5, output=3)
    assert taken == [True] and (run["rod.theta"] == again["rod.theta"]).all()


def test_only_what_is_asked_for_is_taken(own_folders: Path) -> None:
    """Another scene's, or another compiler's line, is not."""
    text, made = header(), own_folders / "engine.o"
    with Ahead(False) as early:
        assert not early.is_under_way(text, line())
        early.begin(text)
        assert not early.take(text + "\n", line(), made) and not early.take(text, [*line(), "-g"], made)
        assert not made.exists()
        assert early.take(text, line(), made) and made.stat().st_size > 1000
    assert list((own_folders / "tmp").iterdir()) == []


def test_what_cannot_be_compiled_is_told_by_the_library(own_folders: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with Ahead(False) as early:
        early.begin("#error of a scene\n")
        assert not early.take("#error of a scene\n", line(), own_folders / "engine.o")
    (own_folders / "broken.c").write_text("#error of the engine\n")
    (own_folders / "rod.yaml").write_text(ROD.replace("mass: 1", "mass: 2"))  # this process has the other one
    monkeypatch.setattr(ahead, "UNIT", own_folders / "broken.c")
    monkeypatch.setattr("gudgeon.loading.build.UNIT", own_folders / "broken.c")
    with pytest.raises(BuildError, match="of the engine"):
        gudgeon.load(own_folders / "rod.yaml")
    monkeypatch.setenv("CC", "no-such-compiler")
    with pytest.raises(BuildError, match="no-such-compiler"):
        gudgeon.load(own_folders / "rod.yaml")
    assert list((own_folders / "tmp").iterdir()) == []


def test_nothing_is_left_where_a_derivation_fails(own_folders: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    begun: list[Ahead] = []
    begin = Ahead.begin

    def and_fail(early: Ahead, text: str) -> None:
        begun.append(early)
        begin(early, text)
        raise InputError("a derivation that fails behind it")

    monkeypatch.setattr(Ahead, "begin", and_fail)
    (own_folders / "rod.yaml").write_text(ROD)
    with pytest.raises(InputError, match="behind it"):
        gudgeon.load(own_folders / "rod.yaml")
    assert begun[0]._begun is not None and begun[0]._begun[2].returncode is not None
    assert list((own_folders / "tmp").iterdir()) == []


def test_what_was_taken_is_not_there_twice(own_folders: Path) -> None:
    """A cache that fills up meanwhile is left for another folder: there the engine is compiled anew."""
    text = header()
    with Ahead(False) as early:
        early.begin(text)
        assert early.take(text, line(), own_folders / "first.o")
        assert not early.is_under_way(text, line()) and not early.take(text, line(), own_folders / "second.o")

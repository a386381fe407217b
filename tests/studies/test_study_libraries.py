"""Libraries of a study are made by two processes at once, and nothing is left of the second one."""

from __future__ import annotations

import os
import subprocess
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

import gudgeon
from gudgeon.errors import InputError
from gudgeon.loading.kernel_sources import is_source_cached
from gudgeon.studies.ensemble import libraries
from gudgeon.studies.ensemble.libraries import Structure, compile_libraries_in_second_process
from gudgeon.waiting.programs import Programs
from tests.programs import needs_compiler
from tests.slow import slow_but

pytestmark = needs_compiler
CRANK = str(Path(__file__).parents[1] / "mechanisms" / "methods" / "jump.yaml")
DRIVES = ["30 rpm * t", "60 rpm * t", "pi/2 + 60 rpm * t"]
STUDY: dict[str, Any] = {
    "mechanism": CRANK,
    "choices": {"drives.crank.value": DRIVES},
    "t_end": "20 ms",
    "output": 2,
    "measures": {"y": {"final": "L2.y"}},
}
STRUCTURES = [Structure(CRANK, "ideal", (("drives.crank.value", drive),)) for drive in DRIVES]


@pytest.fixture
def begun(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[subprocess.Popen[str]]:
    """Processes that were begun: two cores, an empty cache, and folders of what is under way of their own."""
    found: list[subprocess.Popen[str]] = []

    class Noted(Programs):
        def start(self, line: list[str], folder: Path | None, environment: dict[str, str]) -> Any:
            process = super().start(line, folder, environment | {"TMPDIR": str(tmp_path / "under_way")})
            found.append(process)
            return process

    monkeypatch.setattr(libraries, "Programs", Noted)
    monkeypatch.setattr(libraries, "count_available_threads", lambda: 2)
    monkeypatch.setenv("GUDGEON_CACHE", str(tmp_path / "cache"))
    (tmp_path / "under_way").mkdir()
    return found


def known() -> list[bool]:
    return [is_source_cached(one.mechanism, one.scene, dict(one.overrides)) for one in STRUCTURES]


def check_nothing_is_left(begun: list[subprocess.Popen[str]], folder: Path) -> None:
    for process in begun:
        with pytest.raises(ProcessLookupError):
            os.kill(process.pid, 0)
    assert not list((folder / "under_way").iterdir())
    assert not list((folder / "cache").glob("aside/*"))


def test_the_other_process_makes_what_this_one_does_not_come_to(
    begun: list[subprocess.Popen[str]], tmp_path: Path
) -> None:
    with compile_libraries_in_second_process(STRUCTURES):
        assert not any(known())
        assert begun[0].communicate(timeout=100) == ("", "")
    assert begun[0].returncode == 0 and all(known())
    check_nothing_is_left(begun, tmp_path)


# s, about: while it begins, derives, compiles, or has done
@pytest.mark.parametrize("moment", slow_but([0.9], [0.1, 0.9, 1.3]))
def test_it_ends_where_this_one_does(moment: float, begun: list[subprocess.Popen[str]], tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt), compile_libraries_in_second_process(STRUCTURES):
        with suppress(subprocess.TimeoutExpired):
            begun[0].communicate(timeout=moment)
        raise KeyboardInterrupt
    check_nothing_is_left(begun, tmp_path)


@pytest.mark.slow
def test_the_same_dataset(begun: list[subprocess.Popen[str]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    beside = gudgeon.study(STUDY).dataset
    assert len(begun) == 1
    check_nothing_is_left(begun, tmp_path)
    again = gudgeon.study(STUDY).dataset
    assert len(begun) == 1  # all are there
    monkeypatch.setattr(libraries, "count_available_threads", lambda: 1)
    monkeypatch.setenv("GUDGEON_CACHE", str(tmp_path / "another"))
    alone = gudgeon.study(STUDY).dataset
    assert len(begun) == 1
    xr.testing.assert_identical(beside, again)
    xr.testing.assert_identical(beside, alone)


def test_what_is_wrong_is_told_here(begun: list[subprocess.Popen[str]], tmp_path: Path) -> None:
    wrong = {**STUDY, "choices": {"drives.crank.value": [*DRIVES, "60 rpm * kg"]}}
    with pytest.raises(InputError, match="s"):
        gudgeon.study(wrong)
    assert len(begun) == 1
    check_nothing_is_left(begun, tmp_path)


def test_an_interpreter_that_cannot_be_run(begun: list[subprocess.Popen[str]], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(libraries.sys, "executable", "/nowhere/python")
    assert len(gudgeon.study(STUDY).dataset.y) == len(DRIVES)
    assert not begun

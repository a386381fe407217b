"""The folder of a study: killed at any moment, edited, damaged, full, taken; the dataset is that of a quiet run."""

from __future__ import annotations

import os
import resource
import shutil
import signal
import sys
import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from filelock import FileLock

import gudgeon
from gudgeon.errors import GudgeonError, InputError, OutputError
from gudgeon.studies.ensemble import loop
from tests.programs import needs_compiler
from tests.pump import Gudgeon
from tests.slow import slow_but

pytestmark = [needs_compiler, pytest.mark.usefixtures("blocks_of_one")]
STUDY: dict[str, Any] = {
    "mechanism": "pendulum",
    "parameters": {"g": [1.62, 3.7, 9.81], "length": ["1 m", "2 m"]},
    "t_end": "20 ms",
    "output": 10,
    "measures": {"y": {"final": "bob.y"}, "v": {"peak_of_steps": "bob.vy"}},
    "keep": ["bob.x"],
}


def killed(act: Callable[[], object]) -> int:
    """How a process ended that did this."""
    process = os.fork()
    if process == 0:
        try:
            act()
        finally:
            os._exit(0)
    return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])


@pytest.mark.parametrize("moment", slow_but([1 / 6, 1.0], [0.0, 0.1, 1 / 6, 0.4, 0.5, 5 / 6, 1.0]))
def test_a_killed_study_goes_on_to_the_same_dataset(moment: float, tmp_path: Path, quiet: xr.Dataset) -> None:
    def kill(fraction: float, text: str) -> None:
        if fraction >= moment:
            os.kill(os.getpid(), signal.SIGKILL)

    assert killed(lambda: gudgeon.study(STUDY, tmp_path, progress=kill)) == -signal.SIGKILL
    there = len(list(tmp_path.glob("block-*.nc")))
    assert not (tmp_path / "study.nc").exists() and there <= 6
    with pytest.raises(InputError, match="not finished"):
        gudgeon.load_study(tmp_path)
    begun: list[float] = []
    found = gudgeon.study(STUDY, tmp_path, progress=lambda fraction, text: begun.append(fraction))
    assert not begun or begun[0] > (there - 1) / 6
    xr.testing.assert_identical(found.dataset, quiet)
    xr.testing.assert_identical(gudgeon.load_study(tmp_path).dataset, quiet)


def calls_until_killed(most: int, counted: list[int]) -> None:
    """From here on a call of Python after so many, in whatever thread, kills the process."""

    def count(frame: object, event: str, argument: object) -> None:
        counted[0] += 1
        if counted[0] == most:
            os.kill(os.getpid(), signal.SIGKILL)

    threading.setprofile(count)
    sys.setprofile(count)


@pytest.mark.parametrize("kills", [4, pytest.param(10, marks=pytest.mark.slow)])
def test_killed_at_random_moments(kills: int, tmp_path: Path, quiet: xr.Dataset) -> None:
    """At so many calls of Python, wherever they are: loading, runs, a block's bytes, the dataset; going on as well."""
    counted = [0]
    calls_until_killed(0, counted)
    try:
        gudgeon.study(STUDY, tmp_path / "whole", threads=1)
    finally:
        sys.setprofile(None)
        threading.setprofile(None)
    rng, ends, there = np.random.default_rng(16), [], []
    for k, moment in enumerate(rng.integers(1, counted[0], kills).tolist()):
        folder = tmp_path / str(k // 2)  # each second one kills what went on from the first

        def act(folder: Path = folder, moment: int = moment) -> None:
            calls_until_killed(moment, [0])
            gudgeon.study(STUDY, folder, threads=1)

        ends.append(killed(act))
        there.append(len(list(folder.glob("block-*.nc"))))
        if k % 2:
            xr.testing.assert_identical(gudgeon.study(STUDY, folder).dataset, quiet)
    assert ends.count(-signal.SIGKILL) >= 0.6 * kills and len(set(there)) >= 0.3 * kills  # not all at one place


def test_a_kill_as_the_dataset_is_written(tmp_path: Path, quiet: xr.Dataset, monkeypatch: pytest.MonkeyPatch) -> None:
    def kill(*_: object) -> None:
        os.kill(os.getpid(), signal.SIGKILL)

    with monkeypatch.context() as patch:
        patch.setattr("gudgeon.studies.ensemble.final._write_values", kill)
        assert killed(lambda: gudgeon.study(STUDY, tmp_path)) == -signal.SIGKILL
    assert list(tmp_path.glob(".gudgeon-*.part"))
    xr.testing.assert_identical(gudgeon.study(STUDY, tmp_path).dataset, quiet)
    assert not list(tmp_path.glob(".gudgeon-*.part"))


def test_a_finished_study_is_not_run_again(tmp_path: Path, quiet: xr.Dataset, monkeypatch: pytest.MonkeyPatch) -> None:
    gudgeon.study(STUDY, tmp_path)
    monkeypatch.setattr(loop, "run_block", lambda *_: pytest.fail("it was run again"))
    xr.testing.assert_identical(gudgeon.study(STUDY, tmp_path).dataset, quiet)


def test_another_study_is_refused_with_what_differs(tmp_path: Path) -> None:
    gudgeon.study(STUDY, tmp_path)
    other = STUDY | {"t_end": "30 ms", "measures": {"y": {"max": "bob.y"}}}
    with pytest.raises(InputError) as message:
        gudgeon.study(other, tmp_path)
    assert "t_end was '20 ms', is '30 ms'" in str(message.value) and "measures.y.max was not specified" in str(
        message.value
    )
    assert "--restart" in str(message.value) and (tmp_path / "study.nc").exists()
    found = gudgeon.study(other, tmp_path, restart=True).dataset
    assert float(found["t_last"].max()) == 0.03 and "v" not in found


def test_an_edited_mechanism_is_refused(tmp_path: Path) -> None:
    shutil.copy(Path(gudgeon.load("pendulum").file), tmp_path / "p.yaml")
    study = STUDY | {"mechanism": str(tmp_path / "p.yaml")}
    gudgeon.study(study, tmp_path / "s")
    with (tmp_path / "p.yaml").open("a") as file:
        file.write("# edited\n")
    with pytest.raises(InputError, match="mechanism.ideal was"):
        gudgeon.study(study, tmp_path / "s")


def test_a_damaged_block_is_run_again(tmp_path: Path, quiet: xr.Dataset) -> None:
    gudgeon.study(STUDY, tmp_path)
    (tmp_path / "study.nc").unlink()
    paths = sorted(tmp_path.glob("block-*.nc"))
    data = bytearray(paths[1].read_bytes())
    at = data.find(quiet["bob.x"].values[0, 1, 3:8].tobytes())
    assert at > 0
    data[at] ^= 1  # of a number: only its checksum knows
    paths[1].write_bytes(data)
    paths[2].write_bytes(paths[2].read_bytes()[:1000])
    paths[3].write_bytes(b"")
    shutil.copy(paths[0], paths[4])  # another block's
    xr.testing.assert_identical(gudgeon.study(STUDY, tmp_path).dataset, quiet)


def test_a_damaged_dataset_is_refused_and_written_anew(tmp_path: Path, quiet: xr.Dataset) -> None:
    gudgeon.study(STUDY, tmp_path)
    for data in (b"", b"no HDF5", (tmp_path / "block-000000.nc").read_bytes()):
        (tmp_path / "study.nc").write_bytes(data)
        with pytest.raises(InputError, match="cannot be read"):
            gudgeon.load_study(tmp_path)
        xr.testing.assert_identical(gudgeon.study(STUDY, tmp_path).dataset, quiet)


def test_a_manifest_that_is_none_is_refused(tmp_path: Path) -> None:
    gudgeon.study(STUDY, tmp_path)
    for text in ("[" * 100_000, "[]", '{"parts": 3}', '{"parts": {"a": 1}}', "NaN"):
        (tmp_path / "study.json").write_text(text)
        with pytest.raises(InputError):
            gudgeon.load_study(tmp_path)


def test_foreign_folders_stay_as_they_are(tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("mine")
    half = tmp_path / f".gudgeon-{'0' * 16}.part"  # what another command is about to write there
    half.write_text("mine")
    for restart in (False, True):
        with pytest.raises(InputError, match="thesis.tex"):
            gudgeon.study(STUDY, tmp_path, restart=restart)
    with pytest.raises(OutputError):
        gudgeon.study(STUDY, tmp_path / "thesis.tex")
    with pytest.raises(InputError, match="not a study folder"):
        gudgeon.load_study(tmp_path)
    assert (tmp_path / "thesis.tex").read_text() == half.read_text() == "mine"


def test_one_writer(tmp_path: Path) -> None:
    with FileLock(tmp_path / ".lock"), pytest.raises(InputError, match="another process"):
        gudgeon.study(STUDY, tmp_path)


@pytest.mark.parametrize("most", [20_000, 45_000])  # less than a block; less than the dataset
def test_a_full_disk_keeps_what_is_there(most: int, tmp_path: Path, quiet: xr.Dataset) -> None:
    """What is beyond a limit on the size of files is refused by the system as on a full disk."""

    def limited() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
        try:
            gudgeon.study(STUDY | {"output": 1000}, tmp_path)
        except OutputError as error:
            os._exit(7 if "File too large" in str(error) else 8)

    assert killed(limited) == 7
    assert not (tmp_path / "study.nc").exists() and not list(tmp_path.glob("*.part"))
    assert len(list(tmp_path.glob("block-*.nc"))) == (0 if most < 30_000 else 6)
    xr.testing.assert_identical(gudgeon.study(STUDY | {"output": 1000}, tmp_path).dataset["y"], quiet["y"])


def test_ctrl_c_leaves_what_is_there(call: Gudgeon, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = "format: gudgeon-study/1\nmechanism: pendulum\nparameters: {g: [1, 2, 3]}\nmeasures: {y: {final: bob.y}}\n"
    (tmp_path / "s.yaml").write_text(text)
    run, done = loop.run_block, list[object]()

    def interrupted(*arguments: Any) -> object:
        if len(done) == 2:
            raise KeyboardInterrupt
        done.append(found := run(*arguments))
        return found

    with monkeypatch.context() as patch:
        patch.setattr(loop, "run_block", interrupted)
        message = call("study", "s.yaml", "--threads", "1")
    assert message.exit_code == 130 and "2 of 3 blocks of runs are in s.study" in message.output
    assert call("study", "s.yaml").exit_code == 0 and call("study", "s.yaml", "--restart").exit_code == 0


class Dying(ThreadPoolExecutor):
    """Its worker dies at the third block."""

    count = 0

    def submit(self, *arguments: Any, **_: Any) -> Future[Any]:
        from concurrent.futures.process import BrokenProcessPool

        self.count += 1
        if self.count == 3:
            future: Future[Any] = Future()
            future.set_exception(BrokenProcessPool("terminated abruptly"))
            return future
        return super().submit(*arguments)


def test_a_worker_that_dies_is_told_and_costs_no_block(tmp_path: Path, quiet: xr.Dataset) -> None:
    with Dying(1) as pool, pytest.raises(GudgeonError, match="a worker ended before its runs did"):
        gudgeon.study(STUDY, tmp_path, executor=pool)
    with ThreadPoolExecutor(2) as pool:
        found = gudgeon.study(STUDY, tmp_path, executor=pool)
    xr.testing.assert_identical(found.dataset, quiet)

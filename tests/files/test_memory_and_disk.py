"""Requests that exceed the memory or the disk are reported before any work begins."""

from __future__ import annotations

import math
import os
import re
import resource
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

import gudgeon
from gudgeon.errors import OutputError
from gudgeon.files import free_space
from gudgeon.files.free_space import check_disk, check_memory, format_size, read_free_disk_space, read_free_memory
from gudgeon.model.evaluation import compute_evaluation_bytes, compute_sample_bytes
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.axes import make_axis
from gudgeon.studies.box import Range
from gudgeon.studies.map import compute_verdict_box, compute_verdict_map
from tests.programs import needs_compiler
from tests.pump import Gudgeon

GB = 1e9
STUDY: dict[str, Any] = {"mechanism": "pendulum", "parameters": {"g": {"from": 1, "to": 9, "count": 1000}}}


class Disk(NamedTuple):
    """What os.statvfs says."""

    f_bavail: int
    f_frsize: int = 4096
    f_blocks: int = 10**9


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine with a gigabyte of memory and ten megabytes of disk, where no run may begin."""
    monkeypatch.setattr(free_space, "read_free_memory", lambda: GB)
    monkeypatch.setattr(os, "statvfs", lambda path: Disk(2500))
    for place in ("integrators.single_run.SingleRun.integrate", "integrators.batch.Runs.integrate_all_runs"):
        monkeypatch.setattr(f"gudgeon.{place}", None)


@pytest.fixture(scope="module")
def pendulum() -> Simulation:
    return gudgeon.load("pendulum")


def test_what_is_free_is_the_least_of_machine_group_and_limit(tmp_path: Path) -> None:
    """By files as Linux has them: cgroups v2 and v1, of which pages of files that can be dropped are free."""

    def write(name: str, text: str) -> None:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)

    write("proc/meminfo", "MemTotal: 9000000 kB\nMemFree: 7 kB\nMemAvailable:    8000000 kB\n")
    write("proc/self/statm", "1000 200 30")
    assert read_free_memory(tmp_path) == 8e6 * 1024
    write("proc/self/cgroup", "0::/user/one\n")
    write("sys/fs/cgroup/user/one/memory.max", "max\n")
    write("sys/fs/cgroup/user/one/memory.current", "50\n")
    assert read_free_memory(tmp_path) == 8e6 * 1024
    write("sys/fs/cgroup/user/memory.max", "5000000000\n")
    write("sys/fs/cgroup/user/memory.current", "3000000000\n")
    write("sys/fs/cgroup/user/memory.stat", "anon 5\ninactive_file 1000000000\n")
    assert read_free_memory(tmp_path) == 3e9
    write("proc/self/cgroup", "4:cpu,memory:/job\n2:devices:/\n")
    write("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "2000000000")
    write("sys/fs/cgroup/memory/job/memory.usage_in_bytes", "2500000000")
    assert read_free_memory(tmp_path) == 0.0


def test_a_limit_of_the_process_counts() -> None:
    """`ulimit -v`: what is free is at most what it leaves, and a run that needs more is told so in a word."""
    code = "import gudgeon; from gudgeon.files.free_space import read_free_memory; print(read_free_memory())\n"
    code += "gudgeon.load('pendulum').simulate(1.0, output=2 * 10**7)"
    limit = 3 << 29
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)),
    )
    assert 0.0 < float(done.stdout) < limit
    assert done.stderr.splitlines()[-1].startswith("MemoryError: 20000001 samples would take ")


def test_the_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(free_space, "read_free_memory", lambda: GB)
    check_memory(0.89 * GB, "x")
    with pytest.raises(MemoryError, match=r"^4 tables would take 901 MB, and 1 GB are free$"):
        check_memory(0.901 * GB, "4 tables")
    monkeypatch.setattr(free_space, "read_free_memory", lambda: pytest.fail("little is not asked about"))
    check_memory(1e6, "x")
    assert [format_size(size) for size in (12, 3400, 5.6e6, 7.8e9, 2.5e13)] == [
        "12 bytes",
        "3.4 kB",
        "5.6 MB",
        "7.8 GB",
        "25 TB",
    ]


def test_a_disk_is_that_of_the_nearest_folder_which_is_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real = os.statvfs(tmp_path)
    assert read_free_disk_space(tmp_path / "a/b") == pytest.approx(real.f_bavail * real.f_frsize, rel=0.2)
    requested: list[Path] = []

    def statvfs(path: Path) -> Disk:
        requested.append(path)
        if path != tmp_path:
            raise FileNotFoundError
        return Disk(2)

    monkeypatch.setattr(os, "statvfs", statvfs)
    check_disk(tmp_path / "a/b", 8192, "it")
    with pytest.raises(OutputError, match="x: No space left on device: it would take 8.19 kB, and 8.19 kB are free"):
        check_disk(tmp_path / "a/b", 8193, "it", "x")
    assert requested[:3] == [tmp_path / "a/b", tmp_path / "a", tmp_path]
    monkeypatch.setattr(os, "statvfs", lambda path: Disk(0, f_blocks=0))  # a file system that does not say
    assert math.isinf(read_free_disk_space(tmp_path))


@needs_compiler
def test_bytes_of_a_sample_are_those_of_the_arrays() -> None:
    for scene in ("ideal", "dry", "lubricated"):
        press = gudgeon.load("nine_bar_press", scene)
        run = press.simulate(1e-4, output=3)
        kept = [run.t, run.q, run.v, run.work, run.state, run.memory]
        if not press.source.degrees_of_freedom:
            kept.append(run.a)
        found = sum(array.nbytes for array in kept) / len(run.t)
        assert (
            found <= compute_sample_bytes(press.compiled) <= found + 10
        )  # where nothing is remembered there is a place
        every = vars(run.evaluation).values()
        assert compute_evaluation_bytes(press.compiled) * len(run.t) == sum(array.nbytes for array in every)


@needs_compiler
@pytest.mark.usefixtures("small")
def test_runs_that_do_not_fit_into_memory(pendulum: Simulation) -> None:
    sets: list[dict[str, float]] = [{}] * 1000
    own = np.linspace(1.0, 2.0, 1000)
    for message, begin in (
        ("20000001 samples would take", lambda: pendulum.simulate(1.0, output=20_000_000)),
        ("the times of 100000000 samples", lambda: pendulum.simulate(1.0, output=100_000_000)),
        ("1000 runs of 20001 samples each", lambda: pendulum.simulate_many(sets, 1.0, output=20_000)),
        ("1000 runs of 100001", lambda: pendulum.simulate_many(sets, 1.0, output=100_000, keep=["swing"], threads=1)),
        ("1000 runs of 20001", lambda: pendulum.simulate_many(sets, 1.0, output=20_000, method="scipy:DOP853")),
        ("1000 rows of times, 100001 each,", lambda: pendulum.simulate_many(sets, own, output=100_000)),
        (
            "2 runs of 4000001 samples, simulated at once",
            lambda: gudgeon.study(STUDY | {"output": 4_000_000, "measures": {"top": {"max": "swing"}}}, threads=2),
        ),
    ):
        with pytest.raises(MemoryError, match=message):
            begin()


@needs_compiler
@pytest.mark.usefixtures("small")
def test_maps_of_more_cells_than_fit(pendulum: Simulation) -> None:
    """A cell is two kilobytes: 460 × 1000 of them are more than nine tenths of a gigabyte, so are 19 edges' corners."""
    axes = [make_axis(pendulum, "rtol", np.geomspace(1e-12, 1e-4, 460).tolist())]
    axes.append(make_axis(pendulum, "g", np.linspace(1.0, 2.0, 1000).tolist()))
    with pytest.raises(MemoryError, match=r"^460000 cells would take 942 MB, and 1 GB are free$"):
        compute_verdict_map(pendulum, axes)
    edges = [Range(f"p{k}", 1.0, 2.0) for k in range(19)]
    known = {edge.name: make_axis(pendulum, "g", (1.0, 2.0)) for edge in edges}
    with pytest.raises(MemoryError, match="^524290 cells"):
        compute_verdict_box(pendulum, edges, 2, addresses=known)


@needs_compiler
def test_exports_that_do_not_fit(pendulum: Simulation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """How long a CSV file will be is told by some of its lines, within a few percent; nothing is left of it."""
    run, batch = pendulum.simulate(2.0, output=5000), pendulum.simulate_many([{}] * 3, 2.0, output=2000)
    for of, rows in ((run, 5001), (batch, 6003)):
        of.to_csv(tmp_path / "x.csv", ["swing"])
        size = (tmp_path / "x.csv").stat().st_size
        (tmp_path / "x.csv").unlink()
        with monkeypatch.context() as full:
            full.setattr(os, "statvfs", lambda path: Disk(5))
            with pytest.raises(
                OutputError, match=r"x\.csv: No space left on device: it would take (\d+) kB"
            ) as message:
                of.to_csv(tmp_path / "x.csv", ["swing"])
            assert float(re.findall(r"take (\d+) kB", str(message.value))[0]) * 1e3 == pytest.approx(size, rel=0.05)
            with pytest.raises(OutputError, match=r"x\.mat: No space left on device: it would take"):
                of.to_mat(tmp_path / "x.mat", ["swing"])
        assert not [*tmp_path.iterdir()] and size > 16 * rows
    monkeypatch.setattr(free_space, "MIN_CHECKED_BYTES", 0)
    monkeypatch.setattr(free_space, "read_free_memory", lambda: 1e5)
    for export in (lambda: batch.to_mat(tmp_path / "x.mat", ["swing"]), lambda: batch.to_dataframe(["swing"])):
        with pytest.raises(MemoryError, match="of 3 runs would take"):
            export()


@needs_compiler
@pytest.mark.usefixtures("small")
def test_a_study_that_does_not_fit_on_the_disk(tmp_path: Path) -> None:
    """16 bytes a kept number, in blocks and in the dataset; nothing is made, not even its folder."""
    with pytest.raises(OutputError, match=r"the study, 1000 runs, would take 16 MB, and 10\.2 MB are free"):
        gudgeon.study(STUDY | {"output": 1000, "keep": ["swing"]}, tmp_path / "x.study")
    assert not [*tmp_path.iterdir()]


@needs_compiler
@pytest.mark.usefixtures("small")
@pytest.mark.parametrize(
    ("output", "message"),
    [
        ("10000000", "not enough memory: 2 scenes of 10000001 samples would take "),
        ("100000", "No space left on device: the results, 2 scenes of 100001 samples, would take "),
    ],
)
def test_a_command_whose_results_fit_nowhere(call: Gudgeon, output: str, message: str, tmp_path: Path) -> None:
    done = call("run", "pendulum", "--output", output)
    assert done.exit_code == 1 and done.stderr.startswith("error: ") and message in done.stderr
    assert not [*tmp_path.iterdir()]


@needs_compiler
def test_what_follows_from_samples_and_a_file_that_is_too_large(
    pendulum: Simulation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The run is kept; what cannot be evaluated, or saved, can be where there is room again."""
    run = pendulum.simulate(1.0, output=20_000)
    with monkeypatch.context() as short:
        short.setattr(free_space, "MIN_CHECKED_BYTES", 0)
        short.setattr(free_space, "read_free_memory", lambda: 1e6)
        with pytest.raises(MemoryError, match="the evaluated quantities of 20001 samples would take"):
            pendulum.compiled.evaluate(run.t, run.q, run.v, run.memory, run.p)
    with monkeypatch.context() as short:
        short.setattr(os, "statvfs", lambda path: Disk(1000))
        with pytest.raises(OutputError, match=r"x\.nc: No space left on device: it would take \d\.\d+ MB, and 4.1 MB"):
            run.save(tmp_path / "x.nc")
    assert not [*tmp_path.iterdir()]
    run.save(tmp_path / "x.nc")
    assert gudgeon.Result.load(tmp_path / "x.nc").t[-1] == 1.0

"""Blocks made by real worker processes and by a real cluster, whose workers are killed: nothing is lost."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

import gudgeon
from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.studies.ensemble.workers import Processes
from tests.programs import needs_compiler
from tests.pump import Gudgeon

pytestmark = [needs_compiler, pytest.mark.usefixtures("blocks_of_one")]
STUDY: dict[str, Any] = {
    "mechanism": "pendulum",
    "parameters": {"g": {"from": 1, "to": 10, "count": 12}},
    "t_end": "20 ms",
    "output": 10,
    "measures": {"y": {"final": "bob.y"}},
    "keep": ["bob.x"],
}


def killing(victims: Callable[[], list[int]], times: int = 1) -> Callable[[float, str], None]:
    """A progress that kills a worker when the first block is there, and so on."""
    message: set[str] = set()

    def progress(fraction: float, text: str) -> None:
        if not text.startswith("0 ") and text not in message and len(message) < times:
            message.add(text)
            os.kill(victims()[0], signal.SIGKILL)

    return progress


def test_a_cluster(tmp_path: Path, quiet: xr.Dataset) -> None:
    """Of threads of this process."""
    from distributed import Client, LocalCluster

    with (
        LocalCluster(n_workers=1, processes=False, dashboard_address=None, silence_logs=50) as cluster,
        Client(cluster) as client,
    ):
        found = gudgeon.study(STUDY, tmp_path, executor=client)
    xr.testing.assert_identical(found.dataset, quiet)


@pytest.mark.slow
def test_a_cluster_one_of_whose_workers_is_killed(tmp_path: Path, quiet: xr.Dataset) -> None:
    """Its scheduler gives the blocks to another one."""
    from distributed import Client, LocalCluster

    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50) as cluster,
        Client(cluster) as client,
    ):
        before = list(client.run(os.getpid).values())
        found = gudgeon.study(STUDY, tmp_path, executor=client, progress=killing(lambda: before))
        client.wait_for_workers(2, timeout=60)
        assert len(before) == 2 and before[0] not in client.run(os.getpid).values()
    xr.testing.assert_identical(found.dataset, quiet)


def test_worker_processes_one_of_which_is_killed(tmp_path: Path, quiet: xr.Dataset) -> None:
    """What they had not done goes to new ones."""
    with Processes(2) as pool:
        first = pool.pool
        found = gudgeon.study(STUDY, tmp_path, executor=pool, progress=killing(lambda: list(first._processes)))
        assert pool.pool is not first
    xr.testing.assert_identical(found.dataset, quiet)


def test_a_pool_of_the_users_that_breaks(tmp_path: Path, quiet: xr.Dataset) -> None:
    """It is told, and the same call goes on with another one."""
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        progress = killing(lambda: list(pool._processes))
        with pytest.raises(GudgeonError, match=r"(?s)BrokenProcessPool.*the same call resumes"):
            gudgeon.study(STUDY, tmp_path, executor=pool, progress=progress)
    assert 0 < len(list(tmp_path.glob("block-*.nc"))) < 12
    xr.testing.assert_identical(gudgeon.study(STUDY, tmp_path).dataset, quiet)


def test_workers_that_die_at_every_block_end_the_study(tmp_path: Path) -> None:
    class Mortal(Processes):
        """It comes to nothing, again and again."""

        renewed = 0

        def replace_processes(self) -> None:
            self.renewed += 1
            super().replace_processes()

        def submit(self, work: Any, /, *args: Any, **kwargs: Any) -> Any:
            return self.pool.submit(os._exit, 3)

    with Mortal(1) as pool, pytest.raises(GudgeonError, match="0 of 12 blocks are finished"):
        gudgeon.study(STUDY, tmp_path, executor=pool)
    assert pool.renewed == 2


def test_the_command(call: Gudgeon, tmp_path: Path) -> None:
    text = "format: gudgeon-study/1\nmechanism: pendulum\nparameters: {g: [1, 2, 3]}\nmeasures: {y: {final: bob.y}}\n"
    (tmp_path / "s.yaml").write_text(text)
    assert call("study", "s.yaml").exit_code == 0
    assert call("study", "s.yaml", "--workers", "1", "--out", "w").exit_code == 0
    found, own = (gudgeon.load_study(tmp_path / name).dataset for name in ("w", "s.study"))
    xr.testing.assert_identical(found, own)
    message = call("study", "s.yaml", "--workers", "1", "--dask", "tcp://127.0.0.1:1")
    assert message.exit_code == 2 and "one of the two options" in message.output


def test_a_cluster_that_is_none_is_told(call: Gudgeon, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gudgeon.studies.ensemble.workers.CLUSTER_TIMEOUT_S", 1)
    (tmp_path / "s.yaml").write_text("format: gudgeon-study/1\nmechanism: pendulum\nkeep: bob.x\n")
    for address in ("tcp://127.0.0.1:1", "nonsense://x", ""):
        message = call("study", "s.yaml", "--dask", address)
        assert message.exit_code == 2 and "no scheduler answers" in message.output
    gudgeon.study(STUDY).save(tmp_path / "s.nc")  # by no lock of a cluster that does not answer
    with pytest.raises(BadValueError, match="executor"):
        gudgeon.study(STUDY, executor="tcp://127.0.0.1:1")
    with ThreadPoolExecutor(1) as over:
        pass
    for executor in (over, Executor()):
        with pytest.raises(GudgeonError, match="the executor accepts no work"):
            gudgeon.study(STUDY, executor=executor)

"""Own the executors of a study's runs: local processes, a cluster of dask, any executor of concurrent.futures."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager, suppress
from multiprocessing import get_context, parent_process
from threading import Thread
from typing import Any

from gudgeon.errors import GudgeonError, InputError, escape_line_breaks
from gudgeon.language.argument_checks import check_instance

BLOCKS_PER_WORKER = 2  # blocks for each worker that wait or run
DEFAULT_N_WORKERS = 4  # assumed workers of an executor whose number is not known
CLUSTER_TIMEOUT_S = 10  # s, timeout of a cluster


class Processes(Executor):
    """Executor with spawned worker processes, each of which loads its own libraries; `replace_processes` replaces them
    after a death.
    """

    def __init__(self, count: int, laws: tuple[str, ...] = ()) -> None:
        """Start `count` processes that know the user-defined laws in the files `laws`."""
        self.count, self.laws = count, laws
        self.pool = self._create_pool()

    def _create_pool(self) -> ProcessPoolExecutor:
        """Return a pool of new spawned processes; they start at the first submission."""
        return ProcessPoolExecutor(self.count, get_context("spawn"), initialize_worker, (self.laws,))

    def replace_processes(self) -> None:
        """Replace all processes by new ones after one of them died, so that unfinished work can be submitted again."""
        self._terminate_processes()
        self.pool = self._create_pool()

    def submit(self, function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Submit `function(*args, **kwargs)` to a process and return its future."""
        return self.pool.submit(function, *args, **kwargs)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Terminate the processes at once, also running ones; the arguments are ignored."""
        self._terminate_processes()

    def _terminate_processes(self) -> None:
        """Terminate all processes and cancel the waiting work."""
        processes = dict(getattr(self.pool, "_processes", None) or {})
        for process in processes.values():
            process.terminate()
        self.pool.shutdown(cancel_futures=True)


def initialize_worker(law_files: tuple[str, ...]) -> None:
    """Prepare a new worker process: it ignores Ctrl-C, ends with its parent, and knows the user-defined laws.

    law_files: files of the laws.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_exit_after_parent, daemon=True).start()
    for law in law_files:
        from gudgeon.generator.kinds.laws.registered import register

        register(law)


def _exit_after_parent() -> None:
    """Wait until the parent process ends, for example because it is killed, and end this process; for a thread of its
    own.
    """
    if (parent := parent_process()) is not None:
        parent.join()
        os._exit(1)


def convert_to_executor(executor_or_client: Any) -> Executor | None:
    """Return an executor of concurrent.futures: the argument itself, or the executor of a dask Client; None for None.

    Raises BadValueError for anything else.
    """
    distributed = sys.modules.get("distributed")
    if distributed is not None and isinstance(executor_or_client, distributed.Client):
        pool_executor: Executor = executor_or_client.get_executor(pure=False)
        return pool_executor
    return None if executor_or_client is None else check_instance(executor_or_client, "executor", Executor)


def compute_max_submitted_blocks(executor: Executor) -> int:
    """Return the number of blocks to submit at once to an executor, BLOCKS_PER_WORKER per worker.

    More would cost memory, fewer would let workers wait. DEFAULT_N_WORKERS workers are assumed if their number is not
    known.
    """
    count = getattr(executor, "count", None) or getattr(executor, "_max_workers", None)
    if count is None and (client := getattr(executor, "_connect", None)) is not None:
        count = sum(client.ncores().values())  # of a cluster that grows and shrinks
    return BLOCKS_PER_WORKER * max(1, DEFAULT_N_WORKERS if count is None else count)


def is_lost_worker_error(error: BaseException) -> bool:
    """Return whether an error means that a worker process ended before its work did."""
    distributed = sys.modules.get("distributed")
    killed = (distributed.KilledWorker,) if distributed is not None else ()
    return isinstance(error, (BrokenExecutor, CancelledError, *killed))


@contextmanager
def open_workers(n_processes: int | None, cluster_address: str | None) -> Iterator[Executor | None]:
    """Yield an executor with `n_processes` processes, or of the dask cluster at the address `cluster_address`; None for
    neither.

    It is shut down at the end of the context. Raises InputError for both or no answer, GudgeonError without dask.
    """
    if n_processes is not None and cluster_address is not None:
        raise InputError("--workers and --dask: a cluster has its own workers", hint="give one of them")
    if n_processes is not None:
        with Processes(n_processes, list_law_files()) as executor:
            yield executor
    elif cluster_address is not None:
        with _connect_to_cluster(cluster_address) as client:
            yield convert_to_executor(client)
    else:
        yield None


def list_law_files() -> tuple[str, ...]:
    """Return the files of the user-defined laws that are registered in this process."""
    module = sys.modules.get("gudgeon.generator.kinds.laws.registered")
    return () if module is None else tuple(origin.file for origin in module.ORIGINS.values() if origin.file)


@contextmanager
def _connect_to_cluster(address: str) -> Iterator[Any]:
    """Yield a dask Client for the address of a scheduler, and close it at the end of the context.

    Raises InputError if no scheduler answers, GudgeonError if dask is not installed.
    """
    try:
        from distributed import Client
    except ModuleNotFoundError as error:
        raise GudgeonError("clusters need dask: pip install 'gudgeon[dask]'") from error
    try:
        if not address.strip():  # of that Client makes a cluster of its own
            raise ValueError("the address is empty")
        client = Client(
            address, timeout=CLUSTER_TIMEOUT_S, set_as_default=False
        )  # otherwise other code would use a failed client
    except (OSError, ValueError, TypeError) as error:
        message = (
            f"--dask: no scheduler answers at {escape_line_breaks(address)[:100]}: "
            f"{escape_line_breaks(str(error))[:200]}"
        )
        raise InputError(message, hint="expected an address as `dask scheduler` prints it, tcp://HOST:8786") from error
    try:
        yield client
    finally:
        with suppress(OSError, TimeoutError):
            client.close()

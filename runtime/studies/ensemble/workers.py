"""Define the executors of a study: worker processes, a dask cluster, any executor of concurrent.futures."""

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

BLOCKS_PER_WORKER = 2  # submitted blocks per worker, running or waiting
DEFAULT_N_WORKERS = 4  # assumed workers of an executor whose number is not known
CLUSTER_TIMEOUT_S = 10  # s, timeout of the connection to a cluster


class Processes(Executor):
    """Executor with spawned worker processes, each of which loads its own libraries.

    After the death of a process, `replace_processes` starts new ones. Shutdown terminates running work.
    """

    def __init__(self, count: int, laws: tuple[str, ...] = ()) -> None:
        """Create a pool of `count` processes, in which the user-defined laws of the files `laws` are registered."""
        self.count, self.laws = count, laws
        self.pool = self._create_pool()

    def _create_pool(self) -> ProcessPoolExecutor:
        """Return a process pool with the start method "spawn"; its processes start at the first submission."""
        return ProcessPoolExecutor(self.count, get_context("spawn"), initialize_worker, (self.laws,))

    def replace_processes(self) -> None:
        """Terminate all processes and create a new pool, after one of them died; submitted work is lost."""
        self._terminate_processes()
        self.pool = self._create_pool()

    def submit(self, function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Submit `function(*args, **kwargs)` to a process and return its future."""
        return self.pool.submit(function, *args, **kwargs)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Terminate the processes at once, also running ones; the arguments are ignored."""
        self._terminate_processes()

    def _terminate_processes(self) -> None:
        """Terminate all processes at once, also running ones, and cancel the waiting work."""
        processes = dict(getattr(self.pool, "_processes", None) or {})
        for process in processes.values():
            process.terminate()
        self.pool.shutdown(cancel_futures=True)


def initialize_worker(law_files: tuple[str, ...]) -> None:
    """Initialize a new worker process: ignore Ctrl-C, watch the parent process, register the user-defined laws.

    law_files: files of the laws. The process exits when its parent ends.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_exit_after_parent, daemon=True).start()
    for law in law_files:
        from gudgeon.generator.kinds.laws.registered import register

        register(law)


def _exit_after_parent() -> None:
    """Wait until the parent process ends, also if it is killed, and exit this process at once; target of a daemon
    thread.

    Without a parent process of multiprocessing it returns at once.
    """
    if (parent := parent_process()) is not None:
        parent.join()
        os._exit(1)


def convert_to_executor(executor_or_client: Any) -> Executor | None:
    """Return an executor of concurrent.futures: the argument itself, or the executor of a dask Client; None for None.

    Raises BadValueError for another type.
    """
    distributed = sys.modules.get("distributed")
    if distributed is not None and isinstance(executor_or_client, distributed.Client):
        pool_executor: Executor = executor_or_client.get_executor(pure=False)
        return pool_executor
    return None if executor_or_client is None else check_instance(executor_or_client, "executor", Executor)


def compute_max_submitted_blocks(executor: Executor) -> int:
    """Return the maximum number of running and waiting blocks of an executor: BLOCKS_PER_WORKER per worker.

    More would need memory, fewer would let workers wait. For a dask cluster, its present number of cores counts;
    DEFAULT_N_WORKERS workers are assumed if their number is unknown.
    """
    count = getattr(executor, "count", None) or getattr(executor, "_max_workers", None)
    if count is None and (client := getattr(executor, "_connect", None)) is not None:
        count = sum(client.ncores().values())  # the number of workers may change during a study
    return BLOCKS_PER_WORKER * max(1, DEFAULT_N_WORKERS if count is None else count)


def is_lost_worker_error(error: BaseException) -> bool:
    """Return whether an error means that a worker process died: a broken pool, cancelled work, KilledWorker of dask."""
    distributed = sys.modules.get("distributed")
    killed = (distributed.KilledWorker,) if distributed is not None else ()
    return isinstance(error, (BrokenExecutor, CancelledError, *killed))


@contextmanager
def open_workers(n_processes: int | None, cluster_address: str | None) -> Iterator[Executor | None]:
    """Yield the executor of the options --workers (n_processes) or --dask (cluster_address); None without both options.

    It is shut down at the end of the context. Raises InputError for both options or if no scheduler answers,
    GudgeonError without dask.
    """
    if n_processes is not None and cluster_address is not None:
        raise InputError("--workers and --dask: a cluster has its own workers", hint="use one of the two options")
    if n_processes is not None:
        with Processes(n_processes, list_registered_law_files()) as executor:
            yield executor
    elif cluster_address is not None:
        with _connect_to_cluster(cluster_address) as client:
            yield convert_to_executor(client)
    else:
        yield None


def list_registered_law_files() -> tuple[str, ...]:
    """Return the files of the user-defined laws that are registered in this process, for `initialize_worker`.

    Laws without a file are left out.
    """
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
        if not address.strip():  # for an empty address, Client would start a local cluster
            raise ValueError("the address is empty")
        client = Client(
            address, timeout=CLUSTER_TIMEOUT_S, set_as_default=False
        )  # as the default, other code would use a client that failed
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

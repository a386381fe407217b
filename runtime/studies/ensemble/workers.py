"""Who makes blocks elsewhere: processes of this machine, a cluster of dask, any executor of concurrent.futures."""

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

from gudgeon.errors import GudgeonError, InputError, in_a_line
from gudgeon.language.wanted import instance

AHEAD = 2  # blocks for each worker that wait or run
UNKNOWN = 4  # workers of an executor that does not say how many it has
PATIENCE = 10  # s, until a cluster that does not answer is told


class Processes(Executor):
    """Worker processes that are started anew, not forked: each loads its own libraries. `renew` where one has died."""

    def __init__(self, count: int, laws: tuple[str, ...] = ()) -> None:
        self.count, self.laws = count, laws
        self.pool = self._begun()

    def _begun(self) -> ProcessPoolExecutor:
        return ProcessPoolExecutor(self.count, get_context("spawn"), begin_worker, (self.laws,))

    def renew(self) -> None:
        """Other processes, for what these have not done."""
        self._end()
        self.pool = self._begun()

    def submit(self, work: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """As of any executor."""
        return self.pool.submit(work, *args, **kwargs)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Ends the processes, whatever they are at: nobody waits for it any more."""
        self._end()

    def _end(self) -> None:
        processes = dict(getattr(self.pool, "_processes", None) or {})
        for process in processes.values():
            process.terminate()
        self.pool.shutdown(cancel_futures=True)


def begin_worker(laws: tuple[str, ...]) -> None:
    """In a new worker: Ctrl-C is the calling process's own, it ends with that, and it knows the user's laws."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_with_parent, daemon=True).start()
    for law in laws:
        from gudgeon.generator.kinds.laws.registered import register

        register(law)


def _end_with_parent() -> None:
    """A worker whose parent was killed would wait for work for ever."""
    if (parent := parent_process()) is not None:
        parent.join()
        os._exit(1)


def executor_of(given: Any) -> Executor | None:
    """An executor, or that of a dask Client. Raises BadValueError for anything else."""
    distributed = sys.modules.get("distributed")
    if distributed is not None and isinstance(given, distributed.Client):
        found: Executor = given.get_executor(pure=False)
        return found
    return None if given is None else instance(given, "executor", Executor)


def room(executor: Executor) -> int:
    """Blocks that are to be out at once: no worker waits, and memory stays as it is."""
    count = getattr(executor, "count", None) or getattr(executor, "_max_workers", None)
    if count is None and (client := getattr(executor, "_client", None)) is not None:
        count = sum(client.ncores().values())  # of a cluster that grows and shrinks
    return AHEAD * max(1, UNKNOWN if count is None else count)


def is_lost(error: BaseException) -> bool:
    """Whether it says that a worker ended before its work did."""
    distributed = sys.modules.get("distributed")
    killed = (distributed.KilledWorker,) if distributed is not None else ()
    return isinstance(error, (BrokenExecutor, CancelledError, *killed))


@contextmanager
def workers(count: int | None, cluster: str | None) -> Iterator[Executor | None]:
    """So many processes, or a cluster of dask at an address; None for neither. Raises InputError, GudgeonError."""
    if count is not None and cluster is not None:
        raise InputError("--workers and --dask: a cluster has its own workers", hint="give one of them")
    if count is not None:
        with Processes(count, law_files()) as executor:
            yield executor
    elif cluster is not None:
        with _client(cluster) as client:
            yield executor_of(client)
    else:
        yield None


def law_files() -> tuple[str, ...]:
    """Files of the laws that this process knows beside the house's."""
    module = sys.modules.get("gudgeon.generator.kinds.laws.registered")
    return () if module is None else tuple(origin.file for origin in module.ORIGINS.values() if origin.file)


@contextmanager
def _client(address: str) -> Iterator[Any]:
    try:
        from distributed import Client
    except ModuleNotFoundError as error:
        raise GudgeonError("clusters need dask: pip install 'gudgeon[dask]'") from error
    try:
        if not address.strip():  # of that Client makes a cluster of its own
            raise ValueError("the address is empty")
        client = Client(address, timeout=PATIENCE, set_as_default=False)  # else what failed would be asked by others
    except (OSError, ValueError, TypeError) as error:
        told = f"--dask: no scheduler answers at {in_a_line(address)[:100]}: {in_a_line(str(error))[:200]}"
        raise InputError(told, hint="expected an address as `dask scheduler` prints it, tcp://HOST:8786") from error
    try:
        yield client
    finally:
        with suppress(OSError, TimeoutError):
            client.close()

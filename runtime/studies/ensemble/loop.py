"""Run all missing blocks of a study, here or by an executor; one writer stores a block at a time."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager, suppress
from itertools import islice
from threading import Event
from typing import TYPE_CHECKING

from gudgeon.errors import GudgeonError, InputError
from gudgeon.integrators.threads import POLL_INTERVAL_S, available_threads
from gudgeon.studies.ensemble.block import Block, run_block
from gudgeon.studies.ensemble.final import write_dataset
from gudgeon.studies.ensemble.folder import DATASET, StudyFolder, check_dataset
from gudgeon.studies.ensemble.workers import Processes, is_lost, max_submitted

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.studies.ensemble.plan import BlockOf

SIDE_BY_SIDE = 4  # blocks at once here, at most: while Python has one, and the last runs of another end, cores work
FUTILE = 3  # times that workers die one after the other, and no block is done


class _StudyProgress:
    """Progress of a study: runs of written blocks, and fractions of the running ones."""

    def __init__(self, runs: int, done: int, progress: Progress | None) -> None:
        """Begin at `done` of `runs` runs."""
        self.runs, self.done, self.progress = runs, done, progress
        self.shares: dict[int, float] = {}  # of blocks by their number, in runs

    def add(self, block: BlockOf) -> None:
        """Count a written block."""
        self.shares.pop(block.number, None)
        self.done += block.runs

    def tell(self) -> None:
        """Report the progress in the calling thread."""
        if self.progress:
            under_way = sum(self.shares.copy().values())
            self.progress((self.done + under_way) / self.runs, f"{self.done} of {self.runs} runs")


def finish_study(
    folder: StudyFolder, threads: int | None, executor: Executor | None, progress: Progress | None
) -> None:
    """Run the missing blocks, then write the dataset. KeyboardInterrupt preserves the finished blocks."""
    plan, futile = folder.plan, 0
    while True:
        missing = [block for block in plan.blocks if not folder.has(block.number)]
        if not missing and (folder.path / DATASET).exists():
            with suppress(InputError):  # a damaged one is written anew
                check_dataset(folder.path, plan.identity)
                return
        done = _StudyProgress(plan.runs, plan.runs - sum(block.runs for block in missing), progress)
        if done.done:  # a bar measures its speed from here on
            done.tell()
        try:
            if executor is None:
                _run_in_threads(folder, missing, done, threads)
            else:
                _run_by_executor(folder, missing, done, threads, executor)
        except Exception as error:
            if not is_lost(error):
                raise
            futile = 0 if any(folder.has(block.number) for block in missing) else futile + 1
            if not isinstance(executor, Processes) or futile >= FUTILE:
                raise _lost_worker_error(folder, error) from error
            executor.renew()
            continue
        with suppress(LookupError):  # a block that was taken away meanwhile
            write_dataset(folder)
            return


def _run_in_threads(folder: StudyFolder, missing: list[BlockOf], done: _StudyProgress, threads: int | None) -> None:
    """Run blocks in threads of this process; an exception while waiting stops all runs.

    Lanes are empty at the end of a block, in each of its threads. A block therefore has few threads, except for the
    last blocks, whose end no other block fills.
    """
    cores, ended = threads or available_threads(), Event()
    most = min(cores, SIDE_BY_SIDE)  # more threads than cores cost more than they save: they change places
    last = {block.number for block in missing[-most:]}

    def run(block: BlockOf) -> Block:
        """Run one block."""
        own = cores if block.number in last else math.ceil(cores / most)

        def report(fraction: float, text: str) -> None:
            """Note the progress of the block. Raises KeyboardInterrupt after the end."""
            if ended.is_set():
                raise KeyboardInterrupt
            done.shares[block.number] = fraction * block.runs

        return run_block(folder.plan.job(block, own), report, folder.plan.parts[block.part].simulation)

    with ThreadPoolExecutor(most, thread_name_prefix="gudgeon") as pool:
        try:
            _run_all(folder, missing, done, lambda block: pool.submit(run, block), lambda: most)
        finally:
            ended.set()


def _run_by_executor(
    folder: StudyFolder, missing: list[BlockOf], done: _StudyProgress, threads: int | None, executor: Executor
) -> None:
    """Run blocks by the workers of an executor."""

    def submit(block: BlockOf) -> Future[Block]:
        """Submit one block to the executor."""
        try:
            return executor.submit(run_block, folder.plan.job(block, threads or 1))
        except RuntimeError as error:  # one that was shut down, or that cannot
            if is_lost(error):
                raise
            raise GudgeonError(f"the executor takes no work: {error or type(error).__name__}") from error

    _run_all(folder, missing, done, submit, lambda: max_submitted(executor))


def _run_all(
    folder: StudyFolder,
    missing: list[BlockOf],
    done: _StudyProgress,
    submit: Callable[[BlockOf], Future[Block]],
    most: Callable[[], int],
) -> None:
    """Submit blocks as workers become free, and write each as it is finished."""
    left = iter(missing)
    out: dict[Future[Block], BlockOf] = {}
    with _cancel_at_end(out):
        over: list[tuple[Future[Block], BlockOf]] = []
        while True:
            if over or not out:
                for block in islice(left, max(0, most() - len(out))):
                    out[submit(block)] = block
            for future, block in sorted(over, key=lambda one: one[0].cancelled() or one[0].exception() is not None):
                folder.write(future.result())  # what is good first: the others raise
                done.add(block)
            done.tell()
            if not out:
                return
            over = [
                (future, out.pop(future)) for future in wait(out, POLL_INTERVAL_S, return_when=FIRST_COMPLETED).done
            ]


@contextmanager
def _cancel_at_end(out: dict[Future[Block], BlockOf]) -> Iterator[None]:
    """Cancel the waiting blocks at the end of the context."""
    try:
        yield
    finally:
        for future in out:
            future.cancel()


def _lost_worker_error(folder: StudyFolder, error: Exception) -> GudgeonError:
    """Return the error for a worker that ended early, with the number of finished blocks."""
    finished = sum(folder.has(block.number) for block in folder.plan.blocks)
    message = f"a worker ended before its runs did ({type(error).__name__}): {finished} of {len(folder.plan.blocks)}"
    return GudgeonError(f"{message} blocks are there\n  the same call goes on from them")

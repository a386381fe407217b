"""Compute all missing runs of a study, in this process or by an executor; one writer stores the results."""

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
from gudgeon.studies.ensemble.workers import Processes, is_lost_worker, max_submitted

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.studies.ensemble.plan import BlockOf

SIDE_BY_SIDE = 4  # blocks at once here, at most: while Python has one, and the last runs of another end, cores work
FUTILE = 3  # times that workers die one after the other, and no block is done


class _StudyProgress:
    """Progress of a study: runs of written blocks, and fractions of the running ones."""

    def __init__(self, runs: int, n_done: int, progress: Progress | None) -> None:
        """Begin with `n_done` of `runs` runs done; `progress` is None or the caller's progress function."""
        self.runs, self.done, self.progress = runs, n_done, progress
        self.shares: dict[int, float] = {}  # of blocks by their number, in runs

    def add(self, block: BlockOf) -> None:
        """Count the runs of a written block as done."""
        self.shares.pop(block.number, None)
        self.done += block.runs

    def report_progress(self) -> None:
        """Call the progress function, if there is one, with done runs and fractions of running blocks."""
        if self.progress:
            under_way = sum(self.shares.copy().values())
            self.progress((self.done + under_way) / self.runs, f"{self.done} of {self.runs} runs")


def finish_study(
    folder: StudyFolder, threads: int | None, executor: Executor | None, progress: Progress | None
) -> None:
    """Run the missing blocks of a study, then write the dataset; nothing is done if a valid dataset exists.

    executor: None runs the blocks in threads of this process. Local worker processes that end early are replaced, up
    to FUTILE times without a new block; then GudgeonError is raised. KeyboardInterrupt leaves the finished blocks in
    the folder.
    """
    plan, n_futile = folder.plan, 0
    while True:
        missing = [block for block in plan.blocks if not folder.has_block(block.number)]
        if not missing and (folder.path / DATASET).exists():
            with suppress(InputError):  # a damaged one is written anew
                check_dataset(folder.path, plan.identity)
                return
        study_progress = _StudyProgress(plan.runs, plan.runs - sum(block.runs for block in missing), progress)
        if study_progress.done:  # a bar measures its speed from here on
            study_progress.report_progress()
        try:
            if executor is None:
                _run_in_threads(folder, missing, study_progress, threads)
            else:
                _run_by_executor(folder, missing, study_progress, threads, executor)
        except Exception as error:
            if not is_lost_worker(error):
                raise
            n_futile = 0 if any(folder.has_block(block.number) for block in missing) else n_futile + 1
            if not isinstance(executor, Processes) or n_futile >= FUTILE:
                raise _make_lost_worker_error(folder, error) from error
            executor.renew()
            continue
        with suppress(LookupError):  # a block that was taken away meanwhile
            write_dataset(folder)
            return


def _run_in_threads(
    folder: StudyFolder, missing: list[BlockOf], study_progress: _StudyProgress, threads: int | None
) -> None:
    """Run blocks in threads of this process and write each when it is finished; an exception stops all runs.

    A block has few threads, since its lanes are partly empty at its end. Only the last blocks have all cores.
    """
    cores, ended = threads or available_threads(), Event()
    n_blocks = min(cores, SIDE_BY_SIDE)  # more threads than cores cost more than they save: they change places
    last_blocks = {block.number for block in missing[-n_blocks:]}

    def run(block: BlockOf) -> Block:
        """Run one block in a thread of the pool and return its results."""
        n_threads = cores if block.number in last_blocks else math.ceil(cores / n_blocks)

        def report(fraction: float, text: str) -> None:
            """Store the progress of the block for the calling thread. Raises KeyboardInterrupt after the end."""
            if ended.is_set():
                raise KeyboardInterrupt
            study_progress.shares[block.number] = fraction * block.runs

        return run_block(folder.plan.make_block_job(block, n_threads), report, folder.plan.parts[block.part].simulation)

    with ThreadPoolExecutor(n_blocks, thread_name_prefix="gudgeon") as pool:
        try:
            _run_blocks(folder, missing, study_progress, lambda block: pool.submit(run, block), lambda: n_blocks)
        finally:
            ended.set()


def _run_by_executor(
    folder: StudyFolder, missing: list[BlockOf], study_progress: _StudyProgress, threads: int | None, executor: Executor
) -> None:
    """Run blocks by the workers of an executor and write each when it is finished. Raises GudgeonError if it takes no
    work.
    """

    def submit(block: BlockOf) -> Future[Block]:
        """Submit one block to the executor and return its future."""
        try:
            return executor.submit(run_block, folder.plan.make_block_job(block, threads or 1))
        except RuntimeError as error:  # one that was shut down, or that cannot
            if is_lost_worker(error):
                raise
            raise GudgeonError(f"the executor takes no work: {error or type(error).__name__}") from error

    _run_blocks(folder, missing, study_progress, submit, lambda: max_submitted(executor))


def _run_blocks(
    folder: StudyFolder,
    missing: list[BlockOf],
    study_progress: _StudyProgress,
    submit: Callable[[BlockOf], Future[Block]],
    max_running: Callable[[], int],
) -> None:
    """Submit blocks as workers become free, write each when it is finished, and report the progress.

    submit: starts a block and returns its future. max_running: returns the number of blocks to submit at once. Good
    results are written before the error of another block is raised.
    """
    remaining = iter(missing)
    running: dict[Future[Block], BlockOf] = {}
    with _cancel_on_exit(running):
        finished: list[tuple[Future[Block], BlockOf]] = []
        while True:
            if finished or not running:
                for block in islice(remaining, max(0, max_running() - len(running))):
                    running[submit(block)] = block
            for future, block in sorted(finished, key=lambda one: one[0].cancelled() or one[0].exception() is not None):
                folder.write_block(future.result())  # what is good first: the others raise
                study_progress.add(block)
            study_progress.report_progress()
            if not running:
                return
            finished = [
                (future, running.pop(future))
                for future in wait(running, POLL_INTERVAL_S, return_when=FIRST_COMPLETED).done
            ]


@contextmanager
def _cancel_on_exit(running: dict[Future[Block], BlockOf]) -> Iterator[None]:
    """Cancel the blocks of `running` that have not begun, at the end of the context, also after an exception."""
    try:
        yield
    finally:
        for future in running:
            future.cancel()


def _make_lost_worker_error(folder: StudyFolder, error: Exception) -> GudgeonError:
    """Return the error for a worker that ended early; it reports the number of finished blocks, which are kept."""
    finished = sum(folder.has_block(block.number) for block in folder.plan.blocks)
    message = f"a worker ended before its runs did ({type(error).__name__}): {finished} of {len(folder.plan.blocks)}"
    return GudgeonError(f"{message} blocks are there\n  the same call goes on from them")

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
from gudgeon.integrators.threads import POLL_INTERVAL_S, count_available_threads
from gudgeon.studies.ensemble.block import Block, run_block
from gudgeon.studies.ensemble.final import write_dataset
from gudgeon.studies.ensemble.folder import DATASET, StudyFolder, check_dataset
from gudgeon.studies.ensemble.workers import Processes, compute_max_submitted_blocks, is_lost_worker_error

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.studies.ensemble.plan import BlockRange

MAX_CONCURRENT_BLOCKS = (
    4  # blocks at once here, at most: while Python has one, and the last runs of another end, cores work
)
MAX_FUTILE_RESTARTS = 3  # times that workers die one after the other, and no block is done


class _StudyProgress:
    """Progress of a study: runs of written blocks, and fractions of the running ones."""

    def __init__(self, runs: int, n_done: int, progress: Progress | None) -> None:
        """Begin with `n_done` of `runs` runs done; `progress` is None or the caller's progress function."""
        self.runs, self.n_done, self.progress = runs, n_done, progress
        self.partial_runs: dict[int, float] = {}  # of running blocks by their number: fraction × runs

    def add_block(self, block: BlockRange) -> None:
        """Count the runs of a written block as done."""
        self.partial_runs.pop(block.number, None)
        self.n_done += block.runs

    def report_progress(self) -> None:
        """Call the progress function, if there is one, with the fraction of runs that are done and a text.

        Running blocks count by the fraction of their runs that is done.
        """
        if self.progress:
            under_way = sum(self.partial_runs.copy().values())
            self.progress((self.n_done + under_way) / self.runs, f"{self.n_done} of {self.runs} runs")


def finish_study(
    folder: StudyFolder, threads: int | None, executor: Executor | None, progress: Progress | None
) -> None:
    """Run the missing blocks of a study, then write the dataset; nothing is done if a valid dataset exists.

    executor: None runs the blocks in threads of this process. Local worker processes that end early are replaced, up to
    MAX_FUTILE_RESTARTS times without a new block; then GudgeonError is raised. KeyboardInterrupt leaves the finished
    blocks in the folder.
    """
    plan, n_futile = folder.plan, 0
    while True:
        missing = [block for block in plan.blocks if not folder.has_block(block.number)]
        if not missing and (folder.path / DATASET).exists():
            with suppress(InputError):  # a damaged one is written anew
                check_dataset(folder.path, plan.identity)
                return
        study_progress = _StudyProgress(plan.runs, plan.runs - sum(block.runs for block in missing), progress)
        if study_progress.n_done:  # a bar measures its speed from here on
            study_progress.report_progress()
        try:
            if executor is None:
                _run_blocks_in_threads(folder, missing, study_progress, threads)
            else:
                _run_blocks_by_executor(folder, missing, study_progress, threads, executor)
        except Exception as error:
            if not is_lost_worker_error(error):
                raise
            n_futile = 0 if any(folder.has_block(block.number) for block in missing) else n_futile + 1
            if not isinstance(executor, Processes) or n_futile >= MAX_FUTILE_RESTARTS:
                raise _make_lost_worker_error(folder, error) from error
            executor.replace_processes()
            continue
        with suppress(LookupError):  # a block that was taken away meanwhile
            write_dataset(folder)
            return


def _run_blocks_in_threads(
    folder: StudyFolder, missing_blocks: list[BlockRange], study_progress: _StudyProgress, threads: int | None
) -> None:
    """Run blocks in threads of this process and write each when it is finished; an exception stops all runs.

    threads: in total, None for the number of cores. A block has few threads, since its lanes are partly empty at its
    end. Only the last blocks have all cores.
    """
    cores, ended = threads or count_available_threads(), Event()
    n_blocks = min(cores, MAX_CONCURRENT_BLOCKS)  # more threads than cores cost more than they save: they change places
    last_blocks = {block.number for block in missing_blocks[-n_blocks:]}

    def run_one_block(block: BlockRange) -> Block:
        """Run one block in a thread of the pool and return its results.

        One of the last blocks has all cores, another an equal part of them. Its progress is stored in `study_progress`.
        Raises KeyboardInterrupt at the next report of progress once `ended` is set.
        """
        n_threads = cores if block.number in last_blocks else math.ceil(cores / n_blocks)

        def store_progress(fraction: float, text: str) -> None:
            """Store the progress of the block for the calling thread. Raises KeyboardInterrupt after the end."""
            if ended.is_set():
                raise KeyboardInterrupt
            study_progress.partial_runs[block.number] = fraction * block.runs

        return run_block(
            folder.plan.make_block_job(block, n_threads), store_progress, folder.plan.parts[block.part].simulation
        )

    with ThreadPoolExecutor(n_blocks, thread_name_prefix="gudgeon") as pool:
        try:
            _run_blocks(
                folder,
                missing_blocks,
                study_progress,
                lambda block: pool.submit(run_one_block, block),
                lambda: n_blocks,
            )
        finally:
            ended.set()


def _run_blocks_by_executor(
    folder: StudyFolder,
    missing_blocks: list[BlockRange],
    study_progress: _StudyProgress,
    threads: int | None,
    executor: Executor,
) -> None:
    """Run blocks by the workers of an executor, and write each when it is finished.

    threads: of each block, None for 1. Raises GudgeonError if the executor accepts no work.
    """

    def submit_block(block: BlockRange) -> Future[Block]:
        """Submit one block to the executor and return its future.

        Raises GudgeonError if the executor accepts no work.
        """
        try:
            return executor.submit(run_block, folder.plan.make_block_job(block, threads or 1))
        except RuntimeError as error:  # one that was shut down, or that cannot
            if is_lost_worker_error(error):
                raise
            raise GudgeonError(f"the executor takes no work: {error or type(error).__name__}") from error

    _run_blocks(folder, missing_blocks, study_progress, submit_block, lambda: compute_max_submitted_blocks(executor))


def _run_blocks(
    folder: StudyFolder,
    missing_blocks: list[BlockRange],
    study_progress: _StudyProgress,
    submit_block: Callable[[BlockRange], Future[Block]],
    get_max_running: Callable[[], int],
) -> None:
    """Submit blocks as workers become free, write each when it is finished, and report the progress.

    submit_block: starts a block and returns its future. get_max_running: returns the number of blocks to submit at
    once. Good results are written before the error of another block is raised.
    """
    remaining = iter(missing_blocks)
    running: dict[Future[Block], BlockRange] = {}
    with _cancel_futures_on_exit(running):
        finished: list[tuple[Future[Block], BlockRange]] = []
        while True:
            if finished or not running:
                for block in islice(remaining, max(0, get_max_running() - len(running))):
                    running[submit_block(block)] = block
            for future, block in sorted(finished, key=lambda one: one[0].cancelled() or one[0].exception() is not None):
                folder.write_block(future.result())  # what is good first: the others raise
                study_progress.add_block(block)
            study_progress.report_progress()
            if not running:
                return
            finished = [
                (future, running.pop(future))
                for future in wait(running, POLL_INTERVAL_S, return_when=FIRST_COMPLETED).done
            ]


@contextmanager
def _cancel_futures_on_exit(futures: dict[Future[Block], BlockRange]) -> Iterator[None]:
    """Cancel the blocks of `futures` that have not begun, at the end of the context, also after an exception."""
    try:
        yield
    finally:
        for future in futures:
            future.cancel()


def _make_lost_worker_error(folder: StudyFolder, error: Exception) -> GudgeonError:
    """Return the error for a worker that ended early; it reports the number of finished blocks, which are kept."""
    finished = sum(folder.has_block(block.number) for block in folder.plan.blocks)
    message = f"a worker ended before its runs did ({type(error).__name__}): {finished} of {len(folder.plan.blocks)}"
    return GudgeonError(f"{message} blocks are there\n  the same call goes on from them")

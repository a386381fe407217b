"""Run all blocks (batches) of a study not yet on disk, by threads or an executor; one process writes the results."""

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
    """Progress of a study: number of runs in written blocks, and progress of the running blocks."""

    def __init__(self, runs: int, n_done: int, progress: Progress | None) -> None:
        """Start with `n_done` of `runs` runs in written blocks; `progress`: the caller's progress function or None."""
        self.runs, self.n_done, self.progress = runs, n_done, progress
        self.partial_runs: dict[int, float] = {}  # of running blocks by their number: fraction × runs

    def add_block(self, block: BlockRange) -> None:
        """Count the runs of a written block as finished, and forget its partial progress."""
        self.partial_runs.pop(block.number, None)
        self.n_done += block.runs

    def report_progress(self) -> None:
        """Call the progress function, if there is one, with the fraction of finished runs and a text.

        Running blocks count by their partial progress in the fraction, but not in the text.
        """
        if self.progress:
            n_partial = sum(self.partial_runs.copy().values())
            self.progress((self.n_done + n_partial) / self.runs, f"{self.n_done} of {self.runs} runs")


def finish_study(
    folder: StudyFolder, threads: int | None, executor: Executor | None, progress: Progress | None
) -> None:
    """Run the missing blocks of a study, then write the dataset; nothing is done if all blocks and a valid dataset
    exist.

    executor: None runs the blocks in `threads` threads of this process. After a death of local worker processes, they
    are replaced and the missing blocks run again; MAX_FUTILE_RESTARTS deaths in a row without a new block raise
    GudgeonError, as does a lost worker of another executor. KeyboardInterrupt leaves the finished blocks in the folder.
    """
    plan, n_futile = folder.plan, 0
    while True:
        missing = [block for block in plan.blocks if not folder.has_block(block.number)]
        if not missing and (folder.path / DATASET).exists():
            with suppress(InputError):  # a damaged dataset is written again
                check_dataset(folder.path, plan.identity)
                return
        study_progress = _StudyProgress(plan.runs, plan.runs - sum(block.runs for block in missing), progress)
        if study_progress.n_done:  # a progress bar measures its speed from this report
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
        with suppress(LookupError):  # a block was removed in the meantime: run it again
            write_dataset(folder)
            return


def _run_blocks_in_threads(
    folder: StudyFolder, missing_blocks: list[BlockRange], study_progress: _StudyProgress, threads: int | None
) -> None:
    """Run up to MAX_CONCURRENT_BLOCKS blocks at once in threads of this process, and write each when it is finished.

    threads: in total, None for the number of cores. Concurrent blocks share the cores, but the last blocks use all
    cores each. An exception, also Ctrl-C, stops all runs at their next progress report.
    """
    cores, ended = threads or count_available_threads(), Event()
    n_blocks = min(cores, MAX_CONCURRENT_BLOCKS)  # more threads than cores would cost time by context switches
    last_blocks = {block.number for block in missing_blocks[-n_blocks:]}

    def run_one_block(block: BlockRange) -> Block:
        """Run one block in a thread of the pool and return its results.

        A last block uses all cores, another block an equal number of them. Its progress is stored in `study_progress`.
        Raises KeyboardInterrupt at the next progress report after `ended` is set.
        """
        n_threads = cores if block.number in last_blocks else math.ceil(cores / n_blocks)

        def store_progress(fraction: float, text: str) -> None:
            """Store the progress of the block, which the main thread reports; the text is ignored.

            Raises KeyboardInterrupt after `ended` is set.
            """
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
    """Submit blocks to the workers of an executor, and write each in this process when it is finished.

    threads: of each block, None for 1. Raises GudgeonError if the executor accepts no work.
    """

    def submit_block(block: BlockRange) -> Future[Block]:
        """Submit the job of one block to the executor and return its future.

        A broken pool raises its own error, from which `finish_study` may recover. Raises GudgeonError if the executor
        accepts no work.
        """
        try:
            return executor.submit(run_block, folder.plan.make_block_job(block, threads or 1))
        except RuntimeError as error:  # the executor was shut down, or cannot pickle the job
            if is_lost_worker_error(error):
                raise
            raise GudgeonError(f"the executor accepts no work: {error or type(error).__name__}") from error

    _run_blocks(folder, missing_blocks, study_progress, submit_block, lambda: compute_max_submitted_blocks(executor))


def _run_blocks(
    folder: StudyFolder,
    missing_blocks: list[BlockRange],
    study_progress: _StudyProgress,
    submit_block: Callable[[BlockRange], Future[Block]],
    get_max_running: Callable[[], int],
) -> None:
    """Main loop of a study: submit blocks as workers become free, write each finished block, report the progress.

    submit_block: starts a block and returns its future. get_max_running: returns the maximum number of submitted
    blocks, which may change. It polls every POLL_INTERVAL_S seconds. If a block fails, results of blocks that finished
    at the same time are written before its error is raised; waiting blocks are cancelled.
    """
    remaining = iter(missing_blocks)
    running: dict[Future[Block], BlockRange] = {}
    with _cancel_futures_on_exit(running):
        finished: list[tuple[Future[Block], BlockRange]] = []
        while True:
            if finished or not running:
                for block in islice(remaining, max(0, get_max_running() - len(running))):
                    running[submit_block(block)] = block
            for future, block in sorted(
                finished,
                key=lambda future_and_block: (
                    future_and_block[0].cancelled() or future_and_block[0].exception() is not None
                ),
            ):
                folder.write_block(future.result())  # successful blocks are first, the others raise
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
    """Cancel, at the end of the context or after an exception, all futures in `futures` whose work has not begun."""
    try:
        yield
    finally:
        for future in futures:
            future.cancel()


def _make_lost_worker_error(folder: StudyFolder, error: Exception) -> GudgeonError:
    """Return the error for a worker that died; its message has the number of stored blocks."""
    finished = sum(folder.has_block(block.number) for block in folder.plan.blocks)
    message = f"a worker ended before its runs did ({type(error).__name__}): {finished} of {len(folder.plan.blocks)}"
    return GudgeonError(f"{message} blocks are finished\n  the same call resumes the study from them")

"""All blocks of a study that are not there yet, run here or by an executor; one writer, a block at a time."""

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
from gudgeon.studies.ensemble.workers import Processes, is_lost, room

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.studies.ensemble.plan import BlockOf

SIDE_BY_SIDE = 4  # blocks at once here, at most: while Python has one, and the last runs of another end, cores work
FUTILE = 3  # times that workers die one after the other, and no block is done


class _Done:
    """How far a study is: runs of blocks that are written, and shares of those that are under way."""

    def __init__(self, runs: int, done: int, progress: Progress | None) -> None:
        self.runs, self.done, self.progress = runs, done, progress
        self.shares: dict[int, float] = {}  # of blocks by their number, in runs

    def add(self, block: BlockOf) -> None:
        """A block is written."""
        self.shares.pop(block.number, None)
        self.done += block.runs

    def tell(self) -> None:
        """In the calling thread."""
        if self.progress:
            under_way = sum(self.shares.copy().values())
            self.progress((self.done + under_way) / self.runs, f"{self.done} of {self.runs} runs")


def finish(folder: StudyFolder, threads: int | None, executor: Executor | None, progress: Progress | None) -> None:
    """Run what is missing, then write the dataset. KeyboardInterrupt leaves what is there."""
    plan, futile = folder.plan, 0
    while True:
        missing = [block for block in plan.blocks if not folder.has(block.number)]
        if not missing and (folder.path / DATASET).exists():
            with suppress(InputError):  # a damaged one is written anew
                check_dataset(folder.path, plan.identity)
                return
        done = _Done(plan.runs, plan.runs - sum(block.runs for block in missing), progress)
        if done.done:  # a bar measures its speed from here on
            done.tell()
        try:
            if executor is None:
                _here(folder, missing, done, threads)
            else:
                _there(folder, missing, done, threads, executor)
        except Exception as error:
            if not is_lost(error):
                raise
            futile = 0 if any(folder.has(block.number) for block in missing) else futile + 1
            if not isinstance(executor, Processes) or futile >= FUTILE:
                raise _told(folder, error) from error
            executor.renew()
            continue
        with suppress(LookupError):  # a block that was taken away meanwhile
            write_dataset(folder)
            return


def _here(folder: StudyFolder, missing: list[BlockOf], done: _Done, threads: int | None) -> None:
    """In threads of this process; what ends the waiting ends all runs where they are.

    Runs of a block that go side by side leave lanes empty at its end, once in each of its threads: it has few of them,
    but for the last blocks, whose end nobody else's begin covers.
    """
    cores, ended = threads or available_threads(), Event()
    most = min(cores, SIDE_BY_SIDE)  # more threads than cores cost more than they save: they change places
    last = {block.number for block in missing[-most:]}

    def run(block: BlockOf) -> Block:
        own = cores if block.number in last else math.ceil(cores / most)

        def report(fraction: float, text: str) -> None:
            if ended.is_set():
                raise KeyboardInterrupt
            done.shares[block.number] = fraction * block.runs

        return run_block(folder.plan.job(block, own), report, folder.plan.parts[block.part].simulation)

    with ThreadPoolExecutor(most, thread_name_prefix="gudgeon") as pool:
        try:
            _all(folder, missing, done, lambda block: pool.submit(run, block), lambda: most)
        finally:
            ended.set()


def _there(folder: StudyFolder, missing: list[BlockOf], done: _Done, threads: int | None, executor: Executor) -> None:
    """By whoever the executor gives them to."""

    def submit(block: BlockOf) -> Future[Block]:
        try:
            return executor.submit(run_block, folder.plan.job(block, threads or 1))
        except RuntimeError as error:  # one that was shut down, or that cannot
            if is_lost(error):
                raise
            raise GudgeonError(f"the executor takes no work: {error or type(error).__name__}") from error

    _all(folder, missing, done, submit, lambda: room(executor))


def _all(
    folder: StudyFolder,
    missing: list[BlockOf],
    done: _Done,
    submit: Callable[[BlockOf], Future[Block]],
    most: Callable[[], int],
) -> None:
    """Blocks are written as they come, and never more are out than there is room for: the next begin before that."""
    left = iter(missing)
    out: dict[Future[Block], BlockOf] = {}
    with _cancelled(out):
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
def _cancelled(out: dict[Future[Block], BlockOf]) -> Iterator[None]:
    try:
        yield
    finally:
        for future in out:
            future.cancel()


def _told(folder: StudyFolder, error: Exception) -> GudgeonError:
    there = sum(folder.has(block.number) for block in folder.plan.blocks)
    told = f"a worker ended before its runs did ({type(error).__name__}): {there} of {len(folder.plan.blocks)}"
    return GudgeonError(f"{told} blocks are there\n  the same call goes on from them")

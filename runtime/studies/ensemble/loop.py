"""All blocks of a study that are not there yet, run here or by an executor; one writer, a block at a time."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Executor, Future, wait
from contextlib import contextmanager
from typing import TYPE_CHECKING

from gudgeon.errors import GudgeonError
from gudgeon.studies.ensemble.block import Block, run_block
from gudgeon.studies.ensemble.final import write_dataset
from gudgeon.studies.ensemble.folder import DATASET, StudyFolder

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.studies.ensemble.plan import BlockOf

AHEAD = 2  # blocks for each worker of an executor that wait or run


def finish(folder: StudyFolder, threads: int | None, executor: Executor | None, progress: Progress | None) -> None:
    """Run what is missing, then write the dataset. KeyboardInterrupt leaves what is there."""
    plan = folder.plan
    while True:
        missing = [block for block in plan.blocks if not folder.has(block.number)]
        if not missing and (folder.path / DATASET).exists():
            return
        done = plan.runs - sum(block.runs for block in missing)
        if progress and done:  # a bar measures its speed from here on
            progress(done / plan.runs, f"{done} of {plan.runs} runs are there")
        if executor is None:
            _here(folder, missing, done, threads, progress)
        else:
            _there(folder, missing, done, threads, executor, progress)
        try:
            write_dataset(folder)
            return
        except LookupError:  # a block that was taken away meanwhile
            continue


def _here(
    folder: StudyFolder, missing: list[BlockOf], done: int, threads: int | None, progress: Progress | None
) -> None:
    runs = folder.plan.runs
    for block in missing:

        def report(fraction: float, text: str, of: BlockOf = block, before: int = done) -> None:
            if progress:
                progress((before + fraction * of.runs) / runs, text)

        simulation = folder.plan.parts[block.part].simulation
        folder.write(run_block(folder.plan.job(block, threads), report if progress else None, simulation))
        done += block.runs
        if progress:
            progress(done / runs, f"{done} of {runs} runs")


def _there(
    folder: StudyFolder, missing: list[BlockOf], done: int, threads: int | None, executor: Executor,
    progress: Progress | None,
) -> None:  # fmt: skip
    """Blocks are written as they come; never more are out than workers can use, so that memory stays as it is."""
    runs, left, most = folder.plan.runs, iter(missing), AHEAD * max(1, getattr(executor, "_max_workers", 4))
    out: dict[Future[Block], BlockOf] = {}
    with _told(folder), _cancelled(out):
        while True:
            for block in left:
                out[executor.submit(run_block, folder.plan.job(block, threads or 1))] = block
                if len(out) >= most:
                    break
            if not out:
                return
            for future in wait(out, return_when=FIRST_COMPLETED).done:
                folder.write(future.result())
                done += out.pop(future).runs
                if progress:
                    progress(done / runs, f"{done} of {runs} runs")


@contextmanager
def _cancelled(out: dict[Future[Block], BlockOf]) -> Iterator[None]:
    try:
        yield
    finally:
        for future in out:
            future.cancel()


@contextmanager
def _told(folder: StudyFolder) -> Iterator[None]:
    try:
        yield
    except (BrokenExecutor, CancelledError) as error:
        there = sum(folder.has(block.number) for block in folder.plan.blocks)
        told = f"a worker ended before its runs did ({type(error).__name__}): {there} of {len(folder.plan.blocks)}"
        raise GudgeonError(f"{told} blocks are there\n  the same call goes on from them") from error

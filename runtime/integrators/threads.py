"""Work on the runs of a batch in threads, each of which takes portions of runs."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.integrators.lanes import NEW, OVER, numbers_of
from gudgeon.integrators.steps import StepLog
from gudgeon.waiting.ctrl_c import CtrlC

if TYPE_CHECKING:
    from gudgeon.integrators.batch import Runs
    from gudgeon.integrators.trajectory import Progress

PORTION = 16  # largest number of runs handed to a thread at once
POLL_INTERVAL_S = 0.05  # s between two checks of the waiting thread


def available_threads() -> int:
    """Return the number of cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def wait_for(
    waiting: set[Future[None]], ctrl_c: CtrlC, progress: Progress | None, fraction: Callable[[int], float]
) -> None:
    """Wait for all futures; raise their errors, and KeyboardInterrupt after Ctrl-C.

    `fraction` returns the fraction of the work done, given the number of unfinished futures.
    """
    while waiting:
        ended, waiting = wait(waiting, POLL_INTERVAL_S)
        ctrl_c.take()
        for future in ended:
            future.result()
        if progress:
            progress(fraction(len(waiting)), "integrating")


def run_in_threads(runs: Runs, progress: Progress | None, expected: range | list[int], ctrl_c: CtrlC) -> None:
    """Integrate all `expected` runs to their ends in threads. Ctrl-C ends them where they are."""
    portion = max(1, min(PORTION, len(expected) // (8 * runs.threads)))
    portions = deque(expected[k : k + portion] for k in range(0, len(expected), portion))
    with ThreadPoolExecutor(runs.threads, thread_name_prefix="gudgeon") as pool:
        try:
            work = _work_in_python if runs.drive else _work_in_c
            waiting: set[Future[None]] = {pool.submit(work, runs, portions, k) for k in range(runs.threads)}
            wait_for(waiting, ctrl_c, progress, lambda _: float(np.mean(runs.arrays["phase"] == OVER)))
        except BaseException:
            runs.arrays["ending"][0] = 1
            raise


def _work_in_python(runs: Runs, portions: deque[range | list[int]], worker: int) -> None:
    """Integrate runs whose loop is in Python, in one thread, until none is left."""
    for i in numbers_of(runs, portions):
        if runs.shared:
            runs.arrays["place"][i] = worker * runs.places
        runs.follow(i)


def _work_in_c(runs: Runs, portions: deque[range | list[int]], worker: int) -> None:
    """Integrate portions of runs in one thread, alone or in lanes, until none is left."""
    memories = np.zeros((runs.abreast, runs.compiled.lib.gudgeon_run_size()), dtype=np.uint8)
    tapes, place = [StepLog(runs.compiled) for _ in memories] if runs.looks else [], worker * runs.places
    for memory, own in zip(memories, tapes, strict=False):
        own.lay(runs.compiled.pointer(memory, "void *"))
    tape = tapes[0] if tapes else None
    while portions and not runs.stopping:
        if runs.flow and (beside := runs.flow.begins(runs)):
            beside.flow(runs, numbers_of(runs, portions), memories, tapes, place)
            return
        try:
            portion = portions.popleft()
        except IndexError:  # another thread was quicker
            return
        if runs.over is None and isinstance(portion, range):
            runs.alone(portion.start, portion.stop, memories[0], tape)
            continue
        for i in portion:
            if runs.arrays["phase"][i] == NEW:
                if runs.shared:
                    runs.arrays["place"][i] = place
                runs.to_its_end(i, memories[0], tape)

"""Distribute the runs of a batch over threads; each thread takes one portion of the runs at a time."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from itertools import islice
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.integrators.lanes import NEW, OVER, yield_waiting_runs
from gudgeon.integrators.steps import StepLog
from gudgeon.waiting.ctrl_c import DelayedCtrlC

if TYPE_CHECKING:
    from gudgeon.integrators.batch import Runs
    from gudgeon.integrators.trajectory import Progress

MAX_PORTION_RUNS = 16  # largest number of runs handed to a thread at once
POLL_INTERVAL_S = 0.05  # s between two checks of the waiting thread


def count_available_threads() -> int:
    """Return the number of CPU cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def wait_for_futures(
    futures: set[Future[None]],
    ctrl_c: DelayedCtrlC,
    progress: Progress | None,
    compute_fraction: Callable[[int], float],
) -> None:
    """Wait until all futures are done, and report progress; raise their errors, and KeyboardInterrupt after Ctrl-C.

    `compute_fraction` returns the fraction of the work done, given the number of unfinished futures. `progress` None:
    nothing is reported.
    """
    while futures:
        ended, futures = wait(futures, POLL_INTERVAL_S)
        ctrl_c.raise_delayed()
        for future in ended:
            future.result()
        if progress:
            progress(compute_fraction(len(futures)), "integrating")


def integrate_runs_in_threads(
    runs: Runs, progress: Progress | None, indices: range | list[int], ctrl_c: DelayedCtrlC
) -> None:
    """Integrate the runs with these indices to their ends in threads, by portions from a shared queue.

    `progress` is called with the fraction of finished runs. Ctrl-C or an error ends all runs where they are, and is
    passed on. `progress` None: nothing is reported.
    """
    portion = max(1, min(MAX_PORTION_RUNS, len(indices) // (8 * runs.threads)))
    portions = deque(indices[k : k + portion] for k in range(0, len(indices), portion))
    with ThreadPoolExecutor(runs.threads, thread_name_prefix="gudgeon") as pool:
        try:
            work = _integrate_portions_in_python if runs.python_loop else _integrate_portions_in_c
            if runs.kinematic and not runs.observers:
                work = _compute_kinematic_portions
            waiting: set[Future[None]] = {pool.submit(work, runs, portions, k) for k in range(runs.threads)}
            wait_for_futures(waiting, ctrl_c, progress, lambda _: float(np.mean(runs.arrays["phase"] == OVER)))
        except BaseException:
            runs.arrays["ending"][0] = 1
            raise


def _integrate_portions_in_python(runs: Runs, portions: deque[range | list[int]], thread_index: int) -> None:
    """Integrate runs by a time loop in Python, in the thread with this index, until the queue of portions is empty."""
    for i in yield_waiting_runs(runs, portions):
        if runs.has_shared_rows:
            runs.arrays["sample_block"][i] = thread_index * runs.n_rows_per_thread
        runs.integrate_run_in_python(i)


def _compute_kinematic_portions(runs: Runs, portions: deque[range | list[int]], thread_index: int) -> None:
    """Compute kinematic runs in C, several in each call, in the thread with this index, until the queue is empty."""
    assert runs.kinematic
    waiting_runs, n_rows = yield_waiting_runs(runs, portions), runs.n_rows_per_thread
    storages = runs.kinematic.allocate_storages(runs.n_lanes)
    while indices := list(islice(waiting_runs, n_rows)):
        if runs.has_shared_rows:
            runs.arrays["sample_block"][indices] = thread_index * n_rows + np.arange(len(indices))
        lanes = runs.lane_provider.get_lanes(runs) if runs.lane_provider else None
        runs.integrate_kinematic_runs(indices, storages[: lanes.count if lanes else 1], lanes)


def _integrate_portions_in_c(runs: Runs, portions: deque[range | list[int]], thread_index: int) -> None:
    """Integrate portions of runs in C, in the thread with this index, until the queue is empty or the batch is stopped.

    Before each portion, vector lanes are requested (`get_lanes`); once they pay off, they integrate all remaining runs,
    else the portion is integrated one by one. Observers get step records.
    """
    storages = np.zeros((runs.n_lanes, runs.compiled.lib.gudgeon_run_size()), dtype=np.uint8)
    step_logs, first_row = (
        [StepLog(runs.compiled) for _ in storages] if runs.observers else [],
        thread_index * runs.n_rows_per_thread,
    )
    for storage, step_log in zip(storages, step_logs, strict=False):
        step_log.register_record_buffer(runs.compiled.pointer(storage, "void *"))
    first_log = step_logs[0] if step_logs else None
    while portions and not runs.is_stopping:
        if runs.lane_provider and (lanes := runs.lane_provider.get_lanes(runs)):
            lanes.integrate_runs(runs, yield_waiting_runs(runs, portions), storages, step_logs, first_row)
            return
        try:
            portion = portions.popleft()
        except IndexError:  # another thread was quicker
            return
        if runs.store_results is None and isinstance(portion, range):
            runs.integrate_runs_sequentially(portion.start, portion.stop, storages[0], first_log)
            continue
        for i in portion:
            if runs.arrays["phase"][i] == NEW:
                if runs.has_shared_rows:
                    runs.arrays["sample_block"][i] = first_row
                runs.integrate_run_to_end(i, storages[0], first_log)

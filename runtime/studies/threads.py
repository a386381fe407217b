"""Run independent tasks in as many threads as there are cores; the C code releases Python's lock."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from typing import Generic, TypeVar

Report = Callable[[float, str], None]
Task = TypeVar("Task")
TaskResult = TypeVar("TaskResult")


class Pool(Generic[Task, TaskResult]):
    """Threads that run tasks; Ctrl-C ends all tasks at their next report and keeps the results of finished ones."""

    def __init__(self, report: Report, count: int) -> None:
        """Prepare a pool for `count` tasks; `report` receives the mean of their progress."""
        self.report, self.fractions, self.stop = report, [0.0] * count, threading.Event()
        self.lock = threading.Lock()

    def __enter__(self) -> Pool[Task, TaskResult]:
        """Start as many threads as there are cores, at most one for each task."""
        self.executor = ThreadPoolExecutor(max(1, min(len(self.fractions), os.cpu_count() or 1)))
        return self

    def __exit__(self, *_: object) -> None:
        """Request all running tasks to stop at their next report, cancel the waiting ones, and wait for them."""
        self.stop.set()
        self.executor.shutdown(wait=True, cancel_futures=True)

    def map(self, function: Callable[[Task, Report], TaskResult], tasks: Sequence[Task]) -> list[TaskResult | None]:
        """Call `function(task, report_progress)` for all tasks in threads, and return the results in their order.

        After Ctrl-C the result of an unfinished task is None. Raises KeyboardInterrupt if none is finished, and any
        error of a task.
        """
        futures = [self.executor.submit(self._run_task, function, task, i) for i, task in enumerate(tasks)]
        try:
            for future in as_completed(futures):
                future.result()
        except KeyboardInterrupt:
            self.stop.set()
            self.executor.shutdown(wait=True, cancel_futures=True)
            results = [_get_result_or_none(future) for future in futures]
            if all(task is None for task in results):
                raise
            return results
        return [future.result() for future in futures]

    def _run_task(self, function: Callable[[Task, Report], TaskResult], task: Task, i: int) -> TaskResult:
        """Return the result of task i in a worker thread, and report the task as finished."""
        report_progress = self._make_task_progress(i)
        result = function(task, report_progress)
        report_progress(1.0, "")
        return result

    def _make_task_progress(self, i: int) -> Report:
        """Return the progress function of task i, which raises KeyboardInterrupt in the task after Ctrl-C."""

        def report_progress(fraction: float, text: str) -> None:
            """Set the fraction of task i and report the mean over all tasks; the text is not used.

            Raises KeyboardInterrupt after Ctrl-C. Threads may call it at the same time.
            """
            if self.stop.is_set():
                raise KeyboardInterrupt
            with self.lock:
                self.fractions[i] = fraction
                self.report(sum(self.fractions) / len(self.fractions), "")

        return report_progress


def _get_result_or_none(future: Future[TaskResult]) -> TaskResult | None:
    """Return the result of a task after Ctrl-C; None if it was cancelled or interrupted. Raises any other error."""
    if future.cancelled() or isinstance(future.exception(), KeyboardInterrupt):
        return None
    return future.result()

"""Run independent tasks in a thread pool of one thread per core; the C code releases the global interpreter lock."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from typing import Generic, TypeVar

ReportProgress = Callable[[float, str], None]  # (fraction done, text)
Task = TypeVar("Task")
TaskResult = TypeVar("TaskResult")


class TaskPool(Generic[Task, TaskResult]):
    """Thread pool for tasks with progress; Ctrl-C ends all tasks at their next progress report.

    Use it as a context manager. The results of tasks that were finished before Ctrl-C are returned.
    """

    def __init__(self, report_total: ReportProgress, count: int) -> None:
        """Store the progress function for `count` tasks; `report_total` receives the mean of their fractions.

        No thread is started here.
        """
        self.report_total, self.fractions, self.stop = report_total, [0.0] * count, threading.Event()
        self.lock = threading.Lock()

    def __enter__(self) -> TaskPool[Task, TaskResult]:
        """Create the executor with one thread per core, at most one per task, and return the pool."""
        self.executor = ThreadPoolExecutor(max(1, min(len(self.fractions), os.cpu_count() or 1)))
        return self

    def __exit__(self, *_: object) -> None:
        """Cancel the waiting tasks, stop running ones at their next progress report, and wait for their end."""
        self.stop.set()
        self.executor.shutdown(wait=True, cancel_futures=True)

    def map_in_threads(
        self, function: Callable[[Task, ReportProgress], TaskResult], tasks: Sequence[Task]
    ) -> list[TaskResult | None]:
        """Call `function(task, report_progress)` for all tasks in threads; return the results in the order of the
        tasks.

        It waits for all tasks. Ctrl-C stops them and closes the pool; the result of each unfinished task is then None.
        Raises KeyboardInterrupt if no task was finished before Ctrl-C, and at once the first error of a task.
        """
        futures = [self.executor.submit(self._run_task, function, task, i) for i, task in enumerate(tasks)]
        try:
            for future in as_completed(futures):
                future.result()
        except KeyboardInterrupt:
            self.stop.set()
            self.executor.shutdown(wait=True, cancel_futures=True)
            results = [_read_result_or_none(future) for future in futures]
            if all(task is None for task in results):
                raise
            return results
        return [future.result() for future in futures]

    def _run_task(self, function: Callable[[Task, ReportProgress], TaskResult], task: Task, i: int) -> TaskResult:
        """Run task i in a worker thread, report its fraction as 1, and return its result.

        `function` receives the task and its progress function, which raises KeyboardInterrupt in it after Ctrl-C.
        """
        report_progress = self._make_task_progress(i)
        result = function(task, report_progress)
        report_progress(1.0, "")
        return result

    def _make_task_progress(self, i: int) -> ReportProgress:
        """Return the progress function of task i, which raises KeyboardInterrupt in the task after Ctrl-C."""

        def report_progress(fraction: float, text: str) -> None:
            """Set the fraction of task i, and report the mean over all tasks with an empty text.

            The function is thread-safe and ignores `text`. Raises KeyboardInterrupt once the pool is stopped.
            """
            if self.stop.is_set():
                raise KeyboardInterrupt
            with self.lock:
                self.fractions[i] = fraction
                self.report_total(sum(self.fractions) / len(self.fractions), "")

        return report_progress


def _read_result_or_none(future: Future[TaskResult]) -> TaskResult | None:
    """Return the result of a task's future after Ctrl-C; None if the task was cancelled or raised KeyboardInterrupt.

    Raises any other error of the task.
    """
    if future.cancelled() or isinstance(future.exception(), KeyboardInterrupt):
        return None
    return future.result()

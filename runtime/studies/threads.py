"""Run independent tasks in as many threads as there are cores; the C code releases Python's lock."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from typing import Generic, TypeVar

Report = Callable[[float, str], None]
Piece = TypeVar("Piece")
Found = TypeVar("Found")


class Pool(Generic[Piece, Found]):
    """Threads that process pieces of work; Ctrl-C ends all pieces at their next report and keeps finished ones."""

    def __init__(self, report: Report, count: int) -> None:
        """Prepare a pool for `count` pieces of work; `report` receives the mean of their progress."""
        self.report, self.fractions, self.stop = report, [0.0] * count, threading.Event()
        self.lock = threading.Lock()

    def __enter__(self) -> Pool[Piece, Found]:
        """Start as many threads as there are cores, at most one for each piece."""
        self.executor = ThreadPoolExecutor(max(1, min(len(self.fractions), os.cpu_count() or 1)))
        return self

    def __exit__(self, *_: object) -> None:
        """Request all running pieces to stop at their next report, cancel the waiting ones, and wait for them."""
        self.stop.set()
        self.executor.shutdown(wait=True, cancel_futures=True)

    def map(self, function: Callable[[Piece, Report], Found], pieces: Sequence[Piece]) -> list[Found | None]:
        """Call `function(piece, report_progress)` for all pieces in threads, and return the results in the order of the
        pieces.

        After Ctrl-C the result of an unfinished piece is None. Raises KeyboardInterrupt if none is finished, and any
        error of a piece.
        """
        futures = [self.executor.submit(self._process_piece, function, piece, i) for i, piece in enumerate(pieces)]
        try:
            for future in as_completed(futures):
                future.result()
        except KeyboardInterrupt:
            self.stop.set()
            self.executor.shutdown(wait=True, cancel_futures=True)
            results = [_get_result_or_none(future) for future in futures]
            if all(piece is None for piece in results):
                raise
            return results
        return [future.result() for future in futures]

    def _process_piece(self, function: Callable[[Piece, Report], Found], piece: Piece, i: int) -> Found:
        """Return the result of piece i in a worker thread, and report the piece as finished."""
        report_progress = self._make_progress(i)
        result = function(piece, report_progress)
        report_progress(1.0, "")
        return result

    def _make_progress(self, i: int) -> Report:
        """Return the progress function of piece i, which raises KeyboardInterrupt in the piece after Ctrl-C."""

        def report_progress(fraction: float, text: str) -> None:
            """Set the fraction of piece i and report the mean over all pieces; the text is not used.

            Raises KeyboardInterrupt after Ctrl-C. Threads may call it at the same time.
            """
            if self.stop.is_set():
                raise KeyboardInterrupt
            with self.lock:
                self.fractions[i] = fraction
                self.report(sum(self.fractions) / len(self.fractions), "")

        return report_progress


def _get_result_or_none(future: Future[Found]) -> Found | None:
    """Return the result of a piece after Ctrl-C; None if it was cancelled or interrupted. Raises any other error of the
    piece.
    """
    if future.cancelled() or isinstance(future.exception(), KeyboardInterrupt):
        return None
    return future.result()

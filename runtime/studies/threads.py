"""Run pieces of work on as many threads as there are cores; C code releases Python's lock."""

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
        """Prepare for `count` pieces; `report` receives the mean progress."""
        self.report, self.fractions, self.stop = report, [0.0] * count, threading.Event()
        self.lock = threading.Lock()

    def __enter__(self) -> Pool[Piece, Found]:
        """Start the threads."""
        self.executor = ThreadPoolExecutor(max(1, min(len(self.fractions), os.cpu_count() or 1)))
        return self

    def __exit__(self, *_: object) -> None:
        """Stop all pieces and wait for the threads."""
        self.stop.set()
        self.executor.shutdown(wait=True, cancel_futures=True)

    def map(self, function: Callable[[Piece, Report], Found], pieces: Sequence[Piece]) -> list[Found | None]:
        """Return `function(piece, tick)` of all pieces in order.

        After Ctrl-C the result of an unfinished piece is None. Raises KeyboardInterrupt if none is finished.
        """
        futures = [self.executor.submit(self._process_piece, function, piece, i) for i, piece in enumerate(pieces)]
        try:
            for future in as_completed(futures):
                future.result()
        except KeyboardInterrupt:
            self.stop.set()
            self.executor.shutdown(wait=True, cancel_futures=True)
            found = [_finished_result(future) for future in futures]
            if all(piece is None for piece in found):
                raise
            return found
        return [future.result() for future in futures]

    def _process_piece(self, function: Callable[[Piece, Report], Found], piece: Piece, i: int) -> Found:
        """Process piece i and report it as finished."""
        tick = self._progress_of(i)
        found = function(piece, tick)
        tick(1.0, "")
        return found

    def _progress_of(self, i: int) -> Report:
        """Return the progress function of piece i, which raises KeyboardInterrupt after Ctrl-C."""

        def tick(fraction: float, text: str) -> None:
            """Report the mean progress of all pieces. Raises KeyboardInterrupt after Ctrl-C."""
            if self.stop.is_set():
                raise KeyboardInterrupt
            with self.lock:
                self.fractions[i] = fraction
                self.report(sum(self.fractions) / len(self.fractions), "")

        return tick


def _finished_result(future: Future[Found]) -> Found | None:
    """Return the result of an interrupted piece, None if it is not finished. Raises its error."""
    if future.cancelled() or isinstance(future.exception(), KeyboardInterrupt):
        return None
    return future.result()

"""Pieces of work on as many threads as there are cores: runs leave Python alone while they are in C."""

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
    """Ctrl-C ends all pieces at their next report; those that are done are handed back."""

    def __init__(self, report: Report, count: int) -> None:
        self.report, self.fractions, self.stop = report, [0.0] * count, threading.Event()
        self.lock = threading.Lock()

    def __enter__(self) -> Pool[Piece, Found]:
        self.executor = ThreadPoolExecutor(max(1, min(len(self.fractions), os.cpu_count() or 1)))
        return self

    def __exit__(self, *_: object) -> None:
        self.stop.set()
        self.executor.shutdown(wait=True, cancel_futures=True)

    def map(self, function: Callable[[Piece, Report], Found], pieces: Sequence[Piece]) -> list[Found | None]:
        """Like the built-in, in order; after Ctrl-C None for what is not done. KeyboardInterrupt where nothing is."""
        futures = [self.executor.submit(self._one, function, piece, i) for i, piece in enumerate(pieces)]
        try:
            for future in as_completed(futures):
                future.result()
        except KeyboardInterrupt:
            self.stop.set()
            self.executor.shutdown(wait=True, cancel_futures=True)
            found = [_done(future) for future in futures]
            if all(piece is None for piece in found):
                raise
            return found
        return [future.result() for future in futures]

    def _one(self, function: Callable[[Piece, Report], Found], piece: Piece, i: int) -> Found:
        tick = self._tick(i)
        found = function(piece, tick)
        tick(1.0, "")
        return found

    def _tick(self, i: int) -> Report:
        def tick(fraction: float, text: str) -> None:
            if self.stop.is_set():
                raise KeyboardInterrupt
            with self.lock:
                self.fractions[i] = fraction
                self.report(sum(self.fractions) / len(self.fractions), "")

        return tick


def _done(future: Future[Found]) -> Found | None:
    """What an interrupted piece has to show, or raises what broke it."""
    if future.cancelled() or isinstance(future.exception(), KeyboardInterrupt):
        return None
    return future.result()

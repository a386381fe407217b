"""Ctrl-C is raised only where it is asked for: none falls between what was computed and the note of it.

`last_word` is the last message of a program that is interrupted, INTERRUPTED its exit code.
"""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Callable
from time import monotonic
from types import FrameType
from typing import Any

ENDING = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))
PATIENCE = 1.0  # s after a first Ctrl-C, from which on another one is raised wherever Python is
INTERRUPTED = 130
_whole: list[bool] = []  # not empty where the process is the command `gudgeon` and nothing else


class CtrlC:
    """While this context is open SIGINT only waits for `take`, which hands it to the handler that was there before.

    In another thread than the first one there is nothing to do: Python raises there no signal's exception. A handler
    that is not a function of Python (SIG_DFL, SIG_IGN) stays as it is.
    """

    def __init__(self) -> None:
        self.since, self.frame = 0.0, None  # s, when it came; 0: none waits
        self._handler: Callable[[int, FrameType | None], Any] | None = None

    def __enter__(self) -> CtrlC:
        if threading.current_thread() is threading.main_thread():
            handler = signal.getsignal(signal.SIGINT)
            if callable(handler):
                self._handler = handler
                signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(self, *_: object) -> None:
        if self._handler is not None:
            signal.signal(signal.SIGINT, self._handler)

    def _note(self, number: int, frame: FrameType | None) -> None:
        now = monotonic()
        if not self.since:
            self.since = now
        elif now - self.since > PATIENCE and self._handler is not None:
            self._handler(number, frame)

    def take(self) -> None:
        """Raises what the handler raises, KeyboardInterrupt as a rule, if a signal waits."""
        if self.since and self._handler is not None:
            self.since = 0.0
            self._handler(signal.SIGINT, None)


class EndingSignals:
    """While this context is open SIGTERM and SIGHUP interrupt as Ctrl-C does, and end the process when it closes.

    So no compiler and no temporary folder outlives a program that is ended while it loads a scene. A program that
    handles these signals itself, or Ctrl-C in its own way, is left alone; so is every thread but the first one.
    """

    def __enter__(self) -> None:
        self._ended: list[int] = []
        self._replaced: list[int] = []
        if threading.current_thread() is not threading.main_thread():
            return
        if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
            return
        for number in ENDING:
            if signal.getsignal(number) is signal.SIG_DFL:
                self._replaced.append(number)
                signal.signal(number, self._interrupt)

    def __exit__(self, *_: object) -> None:
        for number in self._replaced:
            signal.signal(number, signal.SIG_DFL)
        for number in self._ended[:1]:
            signal.raise_signal(number)

    def _interrupt(self, number: int, _: FrameType | None) -> None:
        self._ended.append(number)
        signal.raise_signal(signal.SIGINT)


def is_the_program() -> None:
    """The process is the command and nothing else: its last word is the last thing that it does."""
    _whole.append(True)


def nothing_more() -> None:
    """A second Ctrl-C would find nothing but the end, and make another one of it: Python, as it ends, lets it kill."""
    if _whole:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def last_word() -> None:
    """That it was interrupted."""
    nothing_more()
    print("interrupted", file=sys.stderr)

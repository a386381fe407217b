"""Delay Ctrl-C to safe points, so that it never falls between a result and its storage; end interrupted programs.

`print_interrupted` prints the last message of an interrupted program, INTERRUPTED is its exit code.
"""

from __future__ import annotations

import _signal  # type: ignore[import-not-found]  # `signal` converts handlers to enumerations: 20 µs for a function
import signal
import sys
import threading
from collections.abc import Callable
from time import monotonic
from types import FrameType
from typing import Any

# signals that end a program
ENDING = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))
MIN_REPEAT_INTERVAL_S = 1.0  # s after a first Ctrl-C, after which another one is raised at once
INTERRUPTED = 130  # exit code of an interrupted program
_whole: list[bool] = []  # not empty if the process is the command `gudgeon` only


class DelayedCtrlC:
    """Delay SIGINT within a with block until `raise_delayed`, which calls the handler that was installed before."""

    def __init__(self) -> None:
        self.since, self.frame = 0.0, None  # s, when Ctrl-C came; 0: none waits
        self._handler: Callable[[int, FrameType | None], Any] | None = None

    def __enter__(self) -> DelayedCtrlC:
        """Install the delaying handler; do nothing outside the main thread or if SIGINT is ignored."""
        if threading.current_thread() is threading.main_thread():
            handler = _signal.getsignal(signal.SIGINT)
            if callable(handler):
                self._handler = handler
                _signal.signal(signal.SIGINT, self._record_interrupt)
        return self

    def __exit__(self, *_: object) -> None:
        """Restore the handler that was there before."""
        if self._handler is not None:
            _signal.signal(signal.SIGINT, self._handler)

    def _record_interrupt(self, signal_number: int, frame: FrameType | None) -> None:
        """Record a Ctrl-C; call the former handler for another one more than MIN_REPEAT_INTERVAL_S after the first."""
        now = monotonic()
        if not self.since:
            self.since = now
        elif now - self.since > MIN_REPEAT_INTERVAL_S and self._handler is not None:
            self._handler(signal_number, frame)

    def raise_delayed(self) -> None:
        """Call the former handler if a Ctrl-C is recorded, and forget it; the handler usually raises
        KeyboardInterrupt.
        """
        if self.since and self._handler is not None:
            self.since = 0.0
            self._handler(signal.SIGINT, None)


class EndingSignals:
    """Treat SIGTERM and SIGHUP as Ctrl-C within a with block, and end the process when it closes.

    So no compiler and no temporary folder outlives a program that is ended while it loads a scene. Programs that handle
    these signals or Ctrl-C themselves are left alone; so are other threads than the main one.
    """

    def __enter__(self) -> None:
        """Install handlers for SIGTERM and SIGHUP if they have the default ones.

        Do nothing outside the main thread or if SIGINT has a handler of the user.
        """
        self._ended: list[int] = []
        self._replaced: list[int] = []
        if threading.current_thread() is not threading.main_thread():
            return
        if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
            return
        for number in ENDING:
            if signal.getsignal(number) is signal.SIG_DFL:
                self._replaced.append(number)
                signal.signal(number, self._raise_interrupt)

    def __exit__(self, *_: object) -> None:
        """Restore the default handlers, and raise the first signal that came, which ends the process."""
        for number in self._replaced:
            signal.signal(number, signal.SIG_DFL)
        for number in self._ended[:1]:
            signal.raise_signal(number)

    def _raise_interrupt(self, signal_number: int, _: FrameType | None) -> None:
        """Record a signal and raise SIGINT in its place."""
        self._ended.append(signal_number)
        signal.raise_signal(signal.SIGINT)


def declare_program() -> None:
    """Declare that the process is the command `gudgeon` only, so that it may ignore Ctrl-C at its end."""
    _whole.append(True)


def ignore_ctrl_c() -> None:
    """Ignore Ctrl-C from now on, if the process was declared to be the command `gudgeon` only; else do nothing."""
    if _whole:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def print_interrupted() -> None:
    """Print that the program was interrupted."""
    ignore_ctrl_c()
    print("interrupted", file=sys.stderr)

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
_is_program: list[bool] = []  # not empty if the process is the command `gudgeon`, not a user's program


class DelayedCtrlC:
    """Context that delays SIGINT until `raise_delayed`, which calls the handler that was installed before.

    A second Ctrl-C after MIN_REPEAT_INTERVAL_S is not delayed. A delayed one is lost without a call of `raise_delayed`.
    """

    def __init__(self) -> None:
        self.since, self.frame = 0.0, None  # time of a delayed Ctrl-C (s); 0: none
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
    """Context that treats SIGTERM and SIGHUP as Ctrl-C, and at its end raises the signal again, which ends the process.

    Thus compilers and temporary folders are cleaned up if a program is ended while it loads a scene. Nothing is done in
    programs with their own handlers of these signals or of Ctrl-C, and outside the main thread.
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
    _is_program.append(True)


def ignore_ctrl_c() -> None:
    """Ignore Ctrl-C from now on, if the process was declared to be the command `gudgeon` only; else do nothing."""
    if _is_program:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def print_interrupted() -> None:
    """Print "interrupted" to stderr, and ignore further Ctrl-C if the process is the command `gudgeon`."""
    ignore_ctrl_c()
    print("interrupted", file=sys.stderr)

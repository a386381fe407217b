"""What a program that is interrupted says last, and the code with which it ends."""

from __future__ import annotations

import signal
import sys

INTERRUPTED = 130
_whole: list[bool] = []  # not empty where the process is the command `gudgeon` and nothing else


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

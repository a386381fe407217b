"""Run other programs (subprocesses), each in its own process group, so that it is killed with all its children."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.waiting.cancellation import POLL_INTERVAL_S
from gudgeon.waiting.ctrl_c import DelayedCtrlC

if TYPE_CHECKING:
    import subprocess

# function that returns whether waiting is cancelled
_is_cancelled: ContextVar[Callable[[], bool] | None] = ContextVar("whether waiting is cancelled", default=None)


@contextmanager
def set_cancellation_check(is_cancelled: Callable[[], bool]) -> Iterator[None]:
    """Let `Programs.wait` in this thread raise KeyboardInterrupt once `is_cancelled()` is true, within the with block.

    Python raises no signals in other threads than the main one; the thread that received Ctrl-C sets the condition.
    """
    token = _is_cancelled.set(is_cancelled)
    try:
        yield
    finally:
        _is_cancelled.reset(token)


class Programs:
    """Context in which programs run; those still running at its end are killed."""

    def __init__(self) -> None:
        self._processes: list[subprocess.Popen[str]] = []

    def __enter__(self) -> Programs:
        """Return the context."""
        return self

    def start(self, command: list[str], folder: Path | None, environment: dict[str, str]) -> subprocess.Popen[str]:
        """Start a program in a folder (None: the current one) and return its process. Raise OSError if it cannot be
        run.

        Its output is captured, and it gets no Ctrl-C of the terminal.
        """
        import subprocess

        with DelayedCtrlC() as ctrl_c:  # no Ctrl-C between the start of a process and its registration
            process = subprocess.Popen(
                command,
                cwd=folder,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
                errors="replace",
                start_new_session=True,
            )
            self._processes.append(process)
        ctrl_c.raise_delayed()
        return process

    def wait(self, process: subprocess.Popen[str]) -> tuple[str, str]:
        """Wait for a program to end, and return its standard output and error as texts.

        Raises KeyboardInterrupt soon after Ctrl-C, or once the condition of `set_cancellation_check` is true.
        """
        import subprocess

        output: tuple[str, str] | None = None
        is_cancelled = _is_cancelled.get()
        with DelayedCtrlC() as ctrl_c:
            while output is None:
                try:
                    output = process.communicate(timeout=POLL_INTERVAL_S)
                except subprocess.TimeoutExpired:
                    ctrl_c.raise_delayed()
                    if is_cancelled and is_cancelled():
                        raise KeyboardInterrupt from None
        ctrl_c.raise_delayed()  # a Ctrl-C during the end of the program
        return output

    def stop(self, *processes: subprocess.Popen[str]) -> None:
        """Kill those of these programs that are still running, with their child processes, and wait for their ends."""
        running_processes = [process for process in processes if process.returncode is None]
        for process in running_processes:
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except OSError:  # the program has ended
                continue
        for process in running_processes:
            process.communicate()

    def __exit__(self, *_: object) -> None:
        """Kill the programs that are still running."""
        self.stop(*self._processes)

"""Show progress bars and status lines on stderr if it is a terminal; Rich is imported on first use."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from gudgeon.language.text_output import escape_invisible
from gudgeon.waiting.cancellation import set_reporter

Report = Callable[[float, str], None]  # fraction done, short text
SPEED_WINDOW_S = 600.0  # s over which speed is measured: blocks of a long study take minutes


def is_terminal() -> bool:
    """Return whether stderr is a terminal."""
    return sys.stderr.isatty()


@contextmanager
def show_progress_bars(quiet: bool = False) -> Iterator[Callable[[str], Report | None]]:
    """Return a context that yields make_bar(name), which returns a callback for `simulate(progress=…)`.

    The callback is None without a terminal or if `quiet`. A bar appears with its first report; all are removed at the
    end of the context.
    """
    if quiet or not is_terminal():
        yield lambda name: None
        return
    shown: list[Any] = []  # rich's Progress, created at the first report

    def make_bar(name: str) -> Report:
        """Return the callback of one task; its bar appears with the first report."""
        task: list[Any] = []

        def report(fraction: float, text: str) -> None:
            """Show the fraction done and a short text; the first call creates the bar."""
            if not shown:
                shown.append(_start_progress_display())
            if not task:
                task.append(shown[0].add_task(name, total=1.0, completed=fraction, text=""))  # speed counts from here
            shown[0].update(task[0], completed=fraction, text=text)

        return report

    try:
        yield make_bar
    finally:
        for progress in shown:
            progress.stop()


@contextmanager
def show_status_line(quiet: bool = False) -> Iterator[None]:
    """Show one line on stderr during each derivation and compilation in the with block.

    Nothing is shown if `quiet`, or if stderr is not a terminal.
    """
    if quiet or not is_terminal():
        yield
        return
    with set_reporter(_show_status_text):
        yield


@contextmanager
def _show_status_text(text: str) -> Iterator[None]:
    """Show a line with this text on stderr until the with block ends, then remove it."""
    from rich.live import Live
    from rich.text import Text

    from gudgeon.language.text_output import make_plain_console

    line = Text(f"{escape_invisible(text)} …", no_wrap=True, overflow="ellipsis")
    with Live(line, console=make_plain_console(stderr=True), auto_refresh=False, transient=True):
        yield


def _start_progress_display() -> Any:
    """Start a display of progress bars on stderr (rich.progress.Progress) and return it.

    The caller adds tasks with a field `text` and stops the display; stopping removes the bars.
    """
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

    from gudgeon.language.text_output import make_plain_console

    progress = Progress(
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TaskProgressColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.fields[text]}", markup=False),
        console=make_plain_console(stderr=True),
        transient=True,
        speed_estimate_period=SPEED_WINDOW_S,
    )
    progress.start()
    return progress

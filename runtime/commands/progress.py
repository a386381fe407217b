"""A progress bar on stderr, only where somebody looks, and imported only once there is something to show."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from gudgeon.language.shown import visible
from gudgeon.waiting.asking import told_to

Report = Callable[[float, str], None]  # fraction done, a few words
MEMORY = 600.0  # s that speed is measured over: blocks of a long study come minutes apart


def looked_at() -> bool:
    """Whether somebody may see it."""
    return sys.stderr.isatty()


@contextmanager
def progress_bar(quiet: bool = False) -> Iterator[Callable[[str], Report | None]]:
    """Gives `bar(name)`, a callable for `simulate(progress=…)`, or None where nobody looks."""
    if quiet or not looked_at():
        yield lambda name: None
        return
    shown: list[Any] = []  # rich's Progress, once the first piece of work is done

    def bar(name: str) -> Report:
        task: list[Any] = []

        def report(fraction: float, text: str) -> None:
            if not shown:
                shown.append(_start())
            if not task:
                task.append(shown[0].add_task(name, total=1.0, completed=fraction, text=""))  # speed counts from here
            shown[0].update(task[0], completed=fraction, text=text)

        return report

    try:
        yield bar
    finally:
        for progress in shown:
            progress.stop()


@contextmanager
def status_line(quiet: bool = False) -> Iterator[None]:
    """A line on stderr, while somebody looks, about the derivations and compilations that the block waits for."""
    if quiet or not looked_at():
        yield
        return
    with told_to(_status):
        yield


@contextmanager
def _status(text: str) -> Iterator[None]:
    from rich.live import Live
    from rich.text import Text

    from gudgeon.language.shown import plain_console

    line = Text(f"{visible(text)} …", no_wrap=True, overflow="ellipsis")
    with Live(line, console=plain_console(stderr=True), auto_refresh=False, transient=True):
        yield


def _start() -> Any:
    from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

    from gudgeon.language.shown import plain_console

    progress = Progress(
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TaskProgressColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.fields[text]}", markup=False),
        console=plain_console(stderr=True),
        transient=True,
        speed_estimate_period=MEMORY,
    )
    progress.start()
    return progress

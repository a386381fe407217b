"""What C does in one long call, in another thread, so that Ctrl-C need not wait for its end."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TypeVar

Result = TypeVar("Result")


def apart(work: Callable[[], Result]) -> Result:
    """What `work` returns or raises, called in another thread; it holds nothing but memory, and lets others run.

    Ctrl-C is raised here at once and the thread ends on its own; a process that ends meanwhile waits for it. Not by
    Thread.join: one that a signal interrupts may leave its lock taken, and the next never returns.
    """
    results: list[Result] = []
    errors: list[BaseException] = []
    gate = threading.Lock()
    gate.acquire()

    def call() -> None:
        try:
            results.append(work())
        except BaseException as error:
            errors.append(error)
        gate.release()

    threading.Thread(target=call).start()
    while not (results or errors):
        gate.acquire(timeout=0.05)
    if errors:
        raise errors[0]
    return results[0]

"""Whether a run is still wanted: Ctrl-C and progress while its loop is in C (templates/c/asked.c.jinja).

C asks each EVERY seconds, wherever it is, and gives up what it is at when told so. Ctrl-C itself is raised nowhere
but where it is asked for (CtrlC.take): no exception falls between what was computed and the note of it.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable
from time import monotonic
from types import FrameType
from typing import Any

from gudgeon.compiled import CompiledModel

EVERY = 0.05  # s between two questions
PATIENCE = 1.0  # s after a first Ctrl-C, from which on another one is raised wherever Python is
NAME = "gudgeon_python_asks"
_registered: dict[int, Any] = {}  # libraries by id; kept, so that no other one gets the same


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


class Asker:
    """Whom C asks: `look` is called, and what it raises is kept until Python is back from C (`check`)."""

    def __init__(self, compiled: CompiledModel, look: Callable[[], object]) -> None:
        self.look = look
        self.raised: BaseException | None = None
        self.function = _function(compiled)
        self.handle = compiled.ffi.new_handle(self)

    @property
    def arguments(self) -> tuple[Any, Any, float]:
        """As C takes them: function, whom, seconds."""
        return self.function, self.handle, EVERY

    def answer(self) -> int:
        """1: stop."""
        try:
            self.look()
        except BaseException as error:  # nothing may pass through C
            self.raised = error
            return 1
        return 0

    def check(self, stopped: bool) -> None:
        """Raises what was raised while C asked; `stopped`: C has given up."""
        raised, self.raised = self.raised, None
        if raised is not None:
            raise raised
        if stopped:
            raise KeyboardInterrupt


def _function(compiled: CompiledModel) -> Any:
    """The function of a library that leads back to Python; an exception on the way there stops the run too."""
    lib, ffi = compiled.lib, compiled.ffi
    if id(lib) not in _registered:
        ffi.def_extern(name=NAME, error=1, onerror=lambda *_: None)(lambda whom: ffi.from_handle(whom).answer())
        _registered[id(lib)] = lib
    return getattr(lib, NAME)

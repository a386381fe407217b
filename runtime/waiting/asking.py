"""Whether a run is still wanted: Ctrl-C and progress while its loop is in C (engine/run/asked.c).

C asks each EVERY seconds, wherever it is, and gives up what it is at when told so.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from types import TracebackType

    from gudgeon.model.compiled import CompiledModel

EVERY = 0.05  # s between two questions
_functions: dict[int, tuple[Any, Any]] = {}  # by the id of what cffi knows, which is kept: no other gets the same


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
    """The function that leads from C back to Python; an exception on the way there stops the run too."""
    ffi = compiled.ffi
    if id(ffi) not in _functions:

        def keep(kind: object, error: BaseException | None, trace: TracebackType | None) -> None:
            """What a signal's handler raised just before or behind `answer` is of the one who was asked."""
            whom = trace.tb_frame.f_locals.get("whom") if trace else None
            if whom is not None and error is not None:
                ffi.from_handle(whom).raised = error

        asked = ffi.callback("int(void *)", lambda whom: ffi.from_handle(whom).answer(), error=1, onerror=keep)
        _functions[id(ffi)] = ffi, asked
    return _functions[id(ffi)][1]

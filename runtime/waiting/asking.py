"""Whether a run is still wanted: Ctrl-C and progress while its loop is in C (engine/run/cancellation.c).

C asks each EVERY seconds, wherever it is, and gives up what it is at when told so.

- `Asker`: what C calls while it runs.
- `apart` runs one long call of C in another thread, so that Ctrl-C need not wait for its end.
- `working` reports that deriving or compiling is under way, before anything runs.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from types import TracebackType

    from gudgeon.model.compiled import CompiledModel

EVERY = 0.05  # s between two questions
_functions: dict[int, tuple[Any, Any]] = {}  # by the id of what cffi knows, which is kept: no other gets the same
Result = TypeVar("Result")
Teller = Callable[[str], AbstractContextManager[None]]  # what is done -> what surrounds it

_teller: ContextVar[Teller | None] = ContextVar("teller", default=None)


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


def working(text: str) -> AbstractContextManager[None]:
    """Surrounds what takes a while; nothing where nobody listens."""
    teller = _teller.get()
    return teller(text) if teller else nullcontext()


@contextmanager
def told_to(teller: Teller) -> Iterator[None]:
    """While the block runs `teller` surrounds what takes a while in it, in this thread."""
    token = _teller.set(teller)
    try:
        yield
    finally:
        _teller.reset(token)

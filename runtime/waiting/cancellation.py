"""Poll for cancellation and progress while a run is in C (engine/run/cancellation.c), and run long calls in
threads.

C calls Python every EVERY seconds, and stops its work if requested.
- `CancellationPoll`: the callback of C.
- `run_interruptible` runs one long call of C in another thread, so that Ctrl-C need not wait for its end.
- `report_work` reports that deriving or compiling is under way.
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

EVERY = 0.05  # s between two polls
# callbacks by the id of cffi's interface, which is stored too, so that ids stay unique
_functions: dict[int, tuple[Any, Any]] = {}
Result = TypeVar("Result")
Teller = Callable[[str], AbstractContextManager[None]]  # what is done → context around it

_teller: ContextVar[Teller | None] = ContextVar("teller", default=None)


class CancellationPoll:
    """Poll for cancellation while C runs: C calls `poll`, whose exception is stored until `check` raises it in
    Python.
    """

    def __init__(self, compiled: CompiledModel, look: Callable[[], object]) -> None:
        self.poll = look
        self.raised: BaseException | None = None
        self.function = _get_callback(compiled)
        self.handle = compiled.ffi.new_handle(self)

    @property
    def c_arguments(self) -> tuple[Any, Any, float]:
        """Return the arguments for C: callback function, handle of this object, seconds between polls."""
        return self.function, self.handle, EVERY

    def poll_from_c(self) -> int:
        """Call `poll`; return 0, or 1 if it raised an exception, which is stored and makes C stop. C calls this."""
        try:
            self.poll()
        except BaseException as error:  # nothing may pass through C
            self.raised = error
            return 1
        return 0

    def raise_stored(self, stopped: bool) -> None:
        """Raise the exception that a poll stored, else KeyboardInterrupt if C has `stopped`; called after C returns."""
        raised, self.raised = self.raised, None
        if raised is not None:
            raise raised
        if stopped:
            raise KeyboardInterrupt


def _get_callback(compiled: CompiledModel) -> Any:
    """Return the callback from C to `Asker.poll_from_c`, created once per cffi interface and cached.

    An exception of a signal handler outside `poll_from_c` is stored in the Asker, and stops the run too.
    """
    ffi = compiled.ffi
    if id(ffi) not in _functions:

        def store_error(kind: object, error: BaseException | None, trace: TracebackType | None) -> None:
            """Store an exception that a signal handler raised just before or after `poll_from_c` in its Asker."""
            whom = trace.tb_frame.f_locals.get("whom") if trace else None
            if whom is not None and error is not None:
                ffi.from_handle(whom).raised = error

        requested = ffi.callback(
            "int(void *)", lambda whom: ffi.from_handle(whom).poll_from_c(), error=1, onerror=store_error
        )
        _functions[id(ffi)] = ffi, requested
    return _functions[id(ffi)][1]


def run_interruptible(work: Callable[[], Result]) -> Result:
    """Call `work` in another thread, and return its result or raise its exception, so that Ctrl-C is raised at once.

    After Ctrl-C the thread ends on its own; a process that ends meanwhile waits for it. Thread.join is not used: if a
    signal interrupts it, its lock may stay locked. `work` must hold no resources but memory.
    """
    results: list[Result] = []
    errors: list[BaseException] = []
    gate = threading.Lock()
    gate.acquire()

    def call() -> None:
        """Call `work`, and store its result or exception."""
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


def report_work(text: str) -> AbstractContextManager[None]:
    """Return a context for work that takes a while; it shows `text` by the reporter of this thread, if there is one."""
    teller = _teller.get()
    return teller(text) if teller else nullcontext()


@contextmanager
def set_reporter(teller: Teller) -> Iterator[None]:
    """Set the reporter of this thread, which `report_work` calls with a text, within the with block."""
    token = _teller.set(teller)
    try:
        yield
    finally:
        _teller.reset(token)

"""Poll for cancellation and progress while a run is in C (engine/run/cancellation.c), and run long calls in
threads.

C calls Python every POLL_INTERVAL_S seconds, and stops its work if requested.
- `CancellationPoll`: the callback of C.
- `run_interruptible` runs one long call of C in another thread, so that Ctrl-C takes effect before its end.
- `report_work` shows a status text during derivation and compilation.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any, TypeVar
from weakref import ref

if TYPE_CHECKING:
    from types import TracebackType

    from gudgeon.model.compiled import CompiledModel

POLL_INTERVAL_S = 0.05
# callbacks by the id of cffi's interface, which is stored too, so that ids stay unique
_functions: dict[int, tuple[Any, Any]] = {}
Result = TypeVar("Result")
Reporter = Callable[[str], AbstractContextManager[None]]  # status text → context of the work

_reporter: ContextVar[Reporter | None] = ContextVar("reporter", default=None)


class CancellationPoll:
    """Poll for cancellation while C runs: C calls `poll`, whose exception is stored until `raise_stored_exception`
    raises it in Python.

    The caller keeps this object until C has returned. C's handle is a weak reference: else the arrays of a run, to
    which `poll` refers, would stay in memory until Python's next search for cycles.
    """

    def __init__(self, compiled: CompiledModel, poll: Callable[[], object]) -> None:
        self.poll = poll
        self.raised: BaseException | None = None
        self.function = _get_callback(compiled)
        self.handle = compiled.ffi.new_handle(ref(self))

    @property
    def c_arguments(self) -> tuple[Any, Any, float]:
        """Return the arguments for C: callback function, handle of this object, seconds between polls."""
        return self.function, self.handle, POLL_INTERVAL_S

    def poll_from_c(self) -> int:
        """Call `poll`; return 0, or 1 if it raised an exception, which is stored and makes C stop. C calls this."""
        try:
            self.poll()
        except BaseException as error:  # nothing may pass through C
            self.raised = error
            return 1
        return 0

    def raise_stored_exception(self, stopped: bool) -> None:
        """Raise the exception that a poll stored, else KeyboardInterrupt if C has `stopped`; called after C returns."""
        raised, self.raised = self.raised, None
        if raised is not None:
            raise raised
        if stopped:
            raise KeyboardInterrupt


def _get_callback(compiled: CompiledModel) -> Any:
    """Return the callback from C to `CancellationPoll.poll_from_c`, created once per cffi interface and cached.

    An exception of a signal handler outside `poll_from_c` is stored in the CancellationPoll, and stops the run too.
    """
    ffi = compiled.ffi
    if id(ffi) not in _functions:

        def store_error(kind: object, error: BaseException | None, trace: TracebackType | None) -> None:
            """Store an exception that a signal handler raised just before or after `poll_from_c`.

            The arguments are those of cffi's `onerror`; nothing is stored without a traceback.
            """
            handle = trace.tb_frame.f_locals.get("handle") if trace else None
            if handle is not None and error is not None:
                ffi.from_handle(handle)().raised = error

        callback = ffi.callback(
            "int(void *)", lambda handle: ffi.from_handle(handle)().poll_from_c(), error=1, onerror=store_error
        )
        _functions[id(ffi)] = ffi, callback
    return _functions[id(ffi)][1]


def run_interruptible(function: Callable[[], Result]) -> Result:
    """Call `function` in another thread and return its result, or raise its exception; Ctrl-C is raised at once.

    After Ctrl-C the thread runs to its end, and the process waits for it at exit. Thread.join is not used: if a signal
    interrupts it, its lock may stay locked. `function` must use no resources but memory.
    """
    results: list[Result] = []
    errors: list[BaseException] = []
    gate = threading.Lock()
    gate.acquire()

    def call_function() -> None:
        """Call `function`, and store its result or exception."""
        try:
            results.append(function())
        except BaseException as error:
            errors.append(error)
        gate.release()

    threading.Thread(target=call_function).start()
    while not (results or errors):
        gate.acquire(timeout=0.05)
    if errors:
        raise errors[0]
    return results[0]


def report_work(text: str) -> AbstractContextManager[None]:
    """Return a context for long work during which the reporter of this thread, if any, shows the status `text`."""
    reporter = _reporter.get()
    return reporter(text) if reporter else nullcontext()


@contextmanager
def set_reporter(reporter: Reporter) -> Iterator[None]:
    """Set the reporter that `report_work` calls in this thread, within the with block; then restore the former one."""
    token = _reporter.set(reporter)
    try:
        yield
    finally:
        _reporter.reset(token)

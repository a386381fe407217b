"""Integrate several runs of a batch in the lanes of vector registers, one run per lane (engine/batch/lanes.h).

Each run has its own steps, and a lane whose run has ended loads the next one. The library of lanes is compiled when a
batch first needs it.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import replace
from threading import Lock
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import ALL_OVER, LISTS, NEW, NOT_CLOSED, OVER
from gudgeon.contract.methods import SMOOTH
from gudgeon.loading.compiler import is_there
from gudgeon.model.arrays import address
from gudgeon.model.compiled import CompiledModel
from gudgeon.waiting.programs import until

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.integrators.batch import Runs
    from gudgeon.integrators.steps import StepLog

NONE = -1  # in place of the number of a run
FEW = 16  # smallest number of runs for which vectors are used
# largest number of runs that proceed together, and the number that always may, however many samples they have
MOST, ALWAYS = 32, 8
WORTH = 6.0  # s: expected remaining time of a batch from which on its library is compiled
_later: ContextVar[int] = ContextVar("runs of the same scene that are to come in other batches", default=0)


_made: WeakKeyDictionary[CompiledModel, Lanes] = WeakKeyDictionary()  # libraries of lanes by scene
_making = Lock()


class Lanes:
    """Hold the library that integrates `count` runs of a scene side by side."""

    def __init__(self, compiled: CompiledModel) -> None:
        from gudgeon.loading.build import compile_kernels

        library = compile_kernels(_source_of_lanes(compiled), portable=compiled.portable)
        self.lib, self.ffi = library.lib, library.ffi
        self.count = int(self.lib.gudgeon_lane_count())
        single = compiled.ffi.cast("uintptr_t", compiled.lib.gudgeon_single())
        self.single = self.ffi.cast("void *", int(single))

    def flow(
        self, runs: Runs, supply: Iterator[int], memories: NDArray[np.uint8], tapes: Sequence[StepLog], place: int
    ) -> None:
        """Integrate all runs of `supply`, each with a row of `memories` as its storage.

        If rows of samples are shared, those from `place` on are used. `tapes`: step records for observers, one per row.
        """
        arguments, rows, number = self._arguments(runs, memories)
        free, waiting, status = [*range(place, place + runs.places)], list[int](), LISTS
        empty = [*range(len(rows))]
        while status != ALL_OVER and not runs.stopping:
            for k in empty:
                if (i := next(supply, NONE)) != NONE:
                    number[k] = i
                    if runs.shared:
                        runs.arrays["place"][i] = free.pop()
            before = list(number)
            status = self.lib.gudgeon_lanes(*arguments, number)
            empty = [k for k, i in enumerate(number) if i == NONE and k < len(rows)]
            for k in empty if status != LISTS else range(len(rows)):
                if before[k] != NONE:
                    _fetch_lists(runs, before[k], rows[k], tapes[k] if tapes else None)
            waiting += [before[k] for k in empty if before[k] != NONE]
            if runs.shared and len(free) < len(empty):
                runs.are_over(waiting)
                free += runs.arrays["place"][waiting].tolist()
                waiting.clear()
        runs.are_over(waiting)
        for k, i in enumerate(number):
            if i != NONE:
                runs.to_its_end(i, memories[k], tapes[k] if tapes else None)

    def _arguments(self, runs: Runs, memories: NDArray[np.uint8]) -> tuple[tuple[Any, ...], list[Any], Any]:
        """Return the arguments for C, pointers to the rows of `memories`, and the run numbers of the lanes (none)."""
        rows = [runs.compiled.pointer(memory, "void *") for memory in memories[: self.count]]
        pointers = self.ffi.new("void *[]", self.count)
        for k, memory in enumerate(memories[: self.count]):
            pointers[k] = self.ffi.cast("void *", address(runs.compiled.ffi, memory))
        batch = self.ffi.cast("void *", int(runs.compiled.ffi.cast("uintptr_t", runs.struct)))
        return (batch, self.single, pointers), rows, self.ffi.new("long[]", [NONE] * self.count)


class Flow:
    """Provide the lanes of a batch, as soon as compiling their library is worth the time."""

    def __init__(self, compiled: CompiledModel) -> None:
        self.compiled, self.count, self.later = compiled, MOST, _later.get()
        self.lanes = _made.get(compiled)
        if self.lanes is None and (not WORTH or _is_compiled(compiled)):
            self.lanes = _lanes_of(compiled)
        self.began = time.perf_counter()

    def begins(self, runs: Runs) -> Lanes | None:
        """Return the lanes if the remaining runs are worth them, else None.

        One thread compiles their library while the others continue.
        """
        self.lanes = self.lanes or _made.get(self.compiled)  # another batch may have made them
        if self.lanes is None and self._is_worth(runs) and _making.acquire(blocking=False):
            try:
                with until(lambda: runs.stopping):
                    self.lanes = self.lanes or _lanes_of(self.compiled)
            except KeyboardInterrupt:  # the batch is ending: who waits for it has taken Ctrl-C
                return None
            finally:
                _making.release()
        return self.lanes

    def _is_worth(self, runs: Runs) -> bool:
        """Return whether the remaining runs are expected to take longer than WORTH."""
        over = int(np.count_nonzero(runs.arrays["phase"] == OVER))
        return over > 0 and (time.perf_counter() - self.began) * (runs.n + self.later - over) / over > WORTH


@contextmanager
def followed_by(runs: int) -> Iterator[None]:
    """Announce within a with block that so many runs follow in later batches, for which a library may pay off."""
    token = _later.set(runs)
    try:
        yield
    finally:
        _later.reset(token)


def _lanes_of(compiled: CompiledModel) -> Lanes:
    """Return the library of lanes of a scene, loaded once for all its batches."""
    return _made.setdefault(compiled, _made.get(compiled) or Lanes(compiled))


def numbers_of(runs: Runs, portions: deque[range | list[int]]) -> Iterator[int]:
    """Yield the runs of the portions that are yet to begin, taking portions until none is left."""
    while portions and not runs.stopping:
        try:
            portion = portions.popleft()
        except IndexError:  # another thread was quicker
            return
        yield from (i for i in portion if runs.arrays["phase"][i] == NEW)


def _source_of_lanes(compiled: CompiledModel) -> KernelSource:
    """Return the scene with the sources and declarations of the library of lanes."""
    from gudgeon.loading.engine import lane_declarations

    return replace(compiled.source, main=compiled.source.lanes, cdef=lane_declarations())


def _is_compiled(compiled: CompiledModel) -> bool:
    """Return whether the library of lanes is in the cache."""
    from gudgeon.loading.build import is_compiled

    return is_compiled(_source_of_lanes(compiled), portable=compiled.portable)


def _fetch_lists(runs: Runs, i: int, run: Any, tape: StepLog | None = None) -> None:
    """Fetch the contacts and events of run i, and its step record if it is full or the run is over."""
    if runs.arrays["status"][i] == NOT_CLOSED:
        return
    over = bool(runs.arrays["phase"][i] == OVER)
    if tape and (over or runs.compiled.lib.gudgeon_run_full(run)):
        tape.look = runs.looks[i]
        tape.fetch(run)
    runs.fetch(i, run, over)


def expected(compiled: CompiledModel, method: str, runs: int) -> bool:
    """Return whether the runs of a batch may share vectors: enough runs, and a method that the lanes have.

    Scenes derived for Taylor's method have lanes for it only.
    """
    fits = bool(compiled.source.lanes) and (method in SMOOTH) == bool(compiled.source.taylor)
    return runs >= FEW and fits and is_there()

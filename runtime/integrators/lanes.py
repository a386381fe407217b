"""Runs of a batch side by side in vector registers (engine/batch/lanes.h): a lane each.

Each run has steps of its own, and a lane whose run is over takes the next one. The library is compiled when a batch
first asks for it.
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
    from gudgeon.integrators.steps import Tape

NONE = -1  # in place of the number of a run
FEW = 16  # runs that are worth a vector
MOST, ALWAYS = 32, 8  # runs that may be under way side by side, several a lane; those that are, however many samples
WORTH = 6.0  # s that a batch may still take, by the pace so far, from which on its library is worth being compiled
_later: ContextVar[int] = ContextVar("runs of the same scene that are to come in other batches", default=0)


_made: WeakKeyDictionary[CompiledModel, Lanes] = WeakKeyDictionary()
_making = Lock()


class Lanes:
    """The library of a scene's runs side by side; `count` of them."""

    def __init__(self, compiled: CompiledModel) -> None:
        from gudgeon.loading.build import compile_kernels

        library = compile_kernels(_source(compiled), portable=compiled.portable)
        self.lib, self.ffi = library.lib, library.ffi
        self.count = int(self.lib.gudgeon_lane_count())
        single = compiled.ffi.cast("uintptr_t", compiled.lib.gudgeon_single())
        self.single = self.ffi.cast("void *", int(single))

    def flow(
        self, runs: Runs, supply: Iterator[int], memories: NDArray[np.uint8], tapes: Sequence[Tape], place: int
    ) -> None:
        """All runs of `supply`, each in a row of `memories`; where places are shared, its samples go there from
        `place` on.

        `tapes`: one a row, where somebody looks at all steps.
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
                    _fetch(runs, before[k], rows[k], tapes[k] if tapes else None)
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
        """What C is given, the rows of `memories` that it uses as a run's own library knows them, and the numbers of
        runs: none yet."""
        rows = [runs.compiled.pointer(memory, "void *") for memory in memories[: self.count]]
        pointers = self.ffi.new("void *[]", self.count)
        for k, memory in enumerate(memories[: self.count]):
            pointers[k] = self.ffi.cast("void *", address(runs.compiled.ffi, memory))
        batch = self.ffi.cast("void *", int(runs.compiled.ffi.cast("uintptr_t", runs.struct)))
        return (batch, self.single, pointers), rows, self.ffi.new("long[]", [NONE] * self.count)


class Flow:
    """The lanes of a batch, from when on they are worth it."""

    def __init__(self, compiled: CompiledModel) -> None:
        self.compiled, self.count, self.later = compiled, MOST, _later.get()
        self.lanes = _made.get(compiled)
        if self.lanes is None and (not WORTH or _is_compiled(compiled)):
            self.lanes = _lanes_of(compiled)
        self.began = time.perf_counter()

    def begins(self, runs: Runs) -> Lanes | None:
        """The lanes, if what is left is worth them; one thread compiles, the others go on meanwhile."""
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
        over = int(np.count_nonzero(runs.arrays["phase"] == OVER))
        return over > 0 and (time.perf_counter() - self.began) * (runs.n + self.later - over) / over > WORTH


@contextmanager
def followed_by(runs: int) -> Iterator[None]:
    """Batches here are a part of more: so many runs come behind them, for which a library may be worth it too."""
    token = _later.set(runs)
    try:
        yield
    finally:
        _later.reset(token)


def _lanes_of(compiled: CompiledModel) -> Lanes:
    """Once a library, for all its batches."""
    return _made.setdefault(compiled, _made.get(compiled) or Lanes(compiled))


def numbers_of(runs: Runs, portions: deque[range | list[int]]) -> Iterator[int]:
    """The runs of portions that are yet to begin, as long as there are any."""
    while portions and not runs.stopping:
        try:
            portion = portions.popleft()
        except IndexError:  # another thread was quicker
            return
        yield from (i for i in portion if runs.arrays["phase"][i] == NEW)


def _source(compiled: CompiledModel) -> KernelSource:
    """What the library is compiled from."""
    from gudgeon.loading.engine import lane_declarations

    return replace(compiled.source, main=compiled.source.lanes, cdef=lane_declarations())


def _is_compiled(compiled: CompiledModel) -> bool:
    from gudgeon.loading.build import is_compiled

    return is_compiled(_source(compiled), portable=compiled.portable)


def _fetch(runs: Runs, i: int, run: Any, tape: Tape | None = None) -> None:
    """The lists of a run, if it has any, and of its tape the pieces that it has alone."""
    if runs.arrays["status"][i] == NOT_CLOSED:
        return
    over = bool(runs.arrays["phase"][i] == OVER)
    if tape and (over or runs.compiled.lib.gudgeon_run_full(run)):
        tape.look = runs.looks[i]
        tape.fetch(run)
    runs.fetch(i, run, over)


def wanted(compiled: CompiledModel, method: str, runs: int) -> bool:
    """Whether runs may go side by side: what has Taylor's method has lanes for no other."""
    fits = bool(compiled.source.lanes) and (method in SMOOTH) == bool(compiled.source.taylor)
    return runs >= FEW and fits and is_there()

"""Integrate several runs of a batch in the lanes of vector registers (SIMD), one run per lane (engine/batch/lanes.h).

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

from gudgeon.contract.boundary import BATCH_ENDED, BUFFERS_FULL, NEW, NOT_CLOSED, OVER
from gudgeon.contract.methods import IN_LANES, KINEMATIC
from gudgeon.loading.compiler import has_compiler
from gudgeon.model.arrays import find_memory_address, make_pointer
from gudgeon.model.compiled import CompiledModel
from gudgeon.waiting.programs import set_cancellation_check

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.integrators.batch import Runs
    from gudgeon.integrators.steps import StepLog

NO_RUN = -1  # index of an empty lane
MIN_RUNS = 16  # smallest number of runs for which vectors are used
# largest number of lanes, and the smallest number of rows of samples for them, however many samples a run has
MAX_LANES, MIN_SHARED_ROWS = 32, 8
# s: expected remaining time of a batch above which its library of lanes is compiled; factor of this time for
# kinematic runs, whose library is small
MIN_REMAINING_S, KINEMATIC_REMAINING_FACTOR = 6.0, 0.25
_n_later_runs: ContextVar[int] = ContextVar("runs of the same scene that are to come in other batches", default=0)


# libraries of lanes by scene, and by whether they have the Taylor series
_loaded_lanes: WeakKeyDictionary[CompiledModel, dict[bool, Lanes]] = WeakKeyDictionary()
_compile_lock = Lock()
SERIES_MAIN = "lane_series.c"  # name of the main C file of the library with the Taylor series
_SERIES_TEXT = '/* The lanes with the Taylor series of the motion. */\n#define LANE_SERIES 1\n#include "lanes.c"\n'


class Lanes:
    """Hold the library that integrates `count` runs of a scene side by side.

    `has_series`: by Taylor series instead of the other methods.
    """

    def __init__(self, compiled: CompiledModel, has_series: bool = False) -> None:
        from gudgeon.loading.build import compile_kernels

        library = compile_kernels(_derive_lane_library_source(compiled, has_series), portable=compiled.portable)
        self.lib, self.ffi = library.lib, library.ffi
        self.count = int(self.lib.gudgeon_lane_count())
        single = compiled.ffi.cast("uintptr_t", compiled.lib.gudgeon_single_run_functions())
        self.single = self.ffi.cast("void *", int(single))

    def integrate_runs(
        self,
        runs: Runs,
        waiting_runs: Iterator[int],
        storages: NDArray[np.uint8],
        step_logs: Sequence[StepLog],
        first_row: int,
    ) -> None:
        """Integrate all runs of `waiting_runs` in this thread, several in the lanes of one vector, until none is left.

        Lanes that become free are filled with the next run. Each lane has a row of `storages` as the memory of its
        integrator. If rows of samples are shared, those from `first_row` on are used. `step_logs`: step records for
        observers, one per lane. If the batch is stopped, begun runs are ended and stored one by one.
        """
        arguments, rows, run_of_lane = self._build_arguments(runs, storages)
        free_rows, unstored, status = [*range(first_row, first_row + runs.n_rows_per_thread)], list[int](), BUFFERS_FULL
        empty_lanes = [*range(len(rows))]
        while status != BATCH_ENDED and not runs.is_stopping:
            for k in empty_lanes:
                if (i := next(waiting_runs, NO_RUN)) != NO_RUN:
                    run_of_lane[k] = i
                    if runs.has_shared_rows:
                        runs.arrays["sample_block"][i] = free_rows.pop()
            before = self.ffi.unpack(run_of_lane, len(rows))
            status = self.lib.gudgeon_lanes(*arguments, run_of_lane)
            empty_lanes = [k for k, i in enumerate(self.ffi.unpack(run_of_lane, len(rows))) if i == NO_RUN]
            for k in empty_lanes if status != BUFFERS_FULL else range(len(rows)):
                if before[k] != NO_RUN:
                    _fetch_results(runs, before[k], rows[k], step_logs[k] if step_logs else None)
            unstored += [before[k] for k in empty_lanes if before[k] != NO_RUN]
            if runs.has_shared_rows and len(free_rows) < len(empty_lanes):
                runs.store_finished_runs(unstored)
                free_rows += runs.arrays["sample_block"][unstored].tolist()
                unstored.clear()
        runs.store_finished_runs(unstored)
        for k, i in enumerate(run_of_lane):
            if i != NO_RUN:
                runs.integrate_run_to_end(i, storages[k], step_logs[k] if step_logs else None)

    def compute_kinematic_runs(self, batch: int, memory_addresses: Sequence[int], indices: NDArray[np.int_]) -> None:
        """Compute kinematic runs in the lanes, in the calling thread.

        `batch`: address of C's struct KinematicBatch; `memory_addresses`: addresses of the memory of each lane (`count`
        of them); `indices`: those of the runs.
        """
        pointers = self.ffi.new("void *[]", [self.ffi.cast("void *", address) for address in memory_addresses])
        numbers = make_pointer(self.ffi, indices, "long *")
        self.lib.gudgeon_kinematic_lanes(self.ffi.cast("void *", batch), self.single, pointers, len(indices), numbers)

    def _build_arguments(self, runs: Runs, storages: NDArray[np.uint8]) -> tuple[tuple[Any, ...], list[Any], Any]:
        """Return the arguments of C's gudgeon_lanes, pointers to the rows of `storages`, and the array of run indices.

        The array has one index per lane and is filled with NO_RUN.
        """
        rows = [runs.compiled.pointer(storage, "void *") for storage in storages[: self.count]]
        pointers = self.ffi.new("void *[]", self.count)
        for k, storage in enumerate(storages[: self.count]):
            pointers[k] = self.ffi.cast("void *", find_memory_address(runs.compiled.ffi, storage))
        batch = self.ffi.cast("void *", int(runs.compiled.ffi.cast("uintptr_t", runs.struct)))
        return (batch, self.single, pointers), rows, self.ffi.new("long[]", [NO_RUN] * self.count)


class LaneProvider:
    """Provide the lanes of a batch, as soon as compiling their library saves time."""

    def __init__(self, compiled: CompiledModel, has_series: bool = False) -> None:
        self.compiled, self.has_series, self.count, self.n_later_runs = (
            compiled,
            has_series,
            MAX_LANES,
            _n_later_runs.get(),
        )
        self.lanes = self._get_loaded_lanes()
        if self.lanes is None and (not MIN_REMAINING_S or _is_compiled(compiled, has_series)):
            self.lanes = _load_lanes(compiled, has_series)
        self.began = time.perf_counter()

    def get_lanes(self, runs: Runs) -> Lanes | None:
        """Return the lanes, and compile their library first if this saves time; else None. Called before each portion.

        The calling thread compiles the library while other threads continue and get None. None is also returned if the
        batch is stopped during the compilation.
        """
        self.lanes = self.lanes or self._get_loaded_lanes()  # another batch may have loaded them
        if self.lanes is None and self._is_worth_compiling(runs) and _compile_lock.acquire(blocking=False):
            try:
                with set_cancellation_check(lambda: runs.is_stopping):
                    self.lanes = self.lanes or _load_lanes(self.compiled, self.has_series)
            except KeyboardInterrupt:  # the batch was cancelled: the waiting thread handles Ctrl-C
                return None
            finally:
                _compile_lock.release()
        return self.lanes

    def _get_loaded_lanes(self) -> Lanes | None:
        """Return the lanes if a batch has loaded them, else None."""
        return _loaded_lanes.get(self.compiled, {}).get(self.has_series)

    def _is_worth_compiling(self, runs: Runs) -> bool:
        """Return whether the remaining runs are expected to take longer than MIN_REMAINING_S.

        The estimate is the elapsed wall time of the batch, divided by the number of finished runs and multiplied by
        that of the remaining ones; without a finished run, return False. For kinematic runs the limit is multiplied by
        KINEMATIC_REMAINING_FACTOR. Runs of later batches count (`announce_later_runs`).
        """
        over = int(np.count_nonzero(runs.arrays["phase"] == OVER))
        required = MIN_REMAINING_S * (KINEMATIC_REMAINING_FACTOR if runs.kinematic else 1.0)
        return over > 0 and (time.perf_counter() - self.began) * (runs.n + self.n_later_runs - over) / over > required


@contextmanager
def announce_later_runs(n_runs: int) -> Iterator[None]:
    """Announce, for a with block, how many runs follow in later batches, so that lanes are compiled earlier."""
    token = _n_later_runs.set(n_runs)
    try:
        yield
    finally:
        _n_later_runs.reset(token)


def _load_lanes(compiled: CompiledModel, has_series: bool) -> Lanes:
    """Return a library of lanes of a scene, compiled or loaded at the first call and cached for all its batches."""
    made = _loaded_lanes.setdefault(compiled, {})
    return made.setdefault(has_series, made.get(has_series) or Lanes(compiled, has_series))


def yield_waiting_runs(runs: Runs, portions: deque[range | list[int]]) -> Iterator[int]:
    """Yield the indices of runs that have not begun, from portions that are removed from a shared queue.

    Yielding ends if the queue is empty or the batch is stopped. Several threads may use the queue.
    """
    while portions and not runs.is_stopping:
        try:
            portion = portions.popleft()
        except IndexError:  # another thread was quicker
            return
        yield from (i for i in portion if runs.arrays["phase"][i] == NEW)


def _derive_lane_library_source(compiled: CompiledModel, has_series: bool) -> KernelSource:
    """Return a copy of a scene's KernelSource whose main file and declarations are those of its library of lanes.

    compile_kernels compiles it. `has_series`: the main file of the lanes with Taylor series is added.
    """
    from gudgeon.loading.engine import list_lane_declarations

    main, files = compiled.source.lane_file, compiled.source.files
    if has_series:
        main, files = SERIES_MAIN, {**files, SERIES_MAIN: _SERIES_TEXT}
    return replace(compiled.source, main=main, files=files, cdef=list_lane_declarations())


def _is_compiled(compiled: CompiledModel, has_series: bool) -> bool:
    """Return whether the compiled library of lanes of a scene is in the cache on disk."""
    from gudgeon.loading.build import is_compiled

    return is_compiled(_derive_lane_library_source(compiled, has_series), portable=compiled.portable)


def _fetch_results(runs: Runs, i: int, run: Any, step_log: StepLog | None = None) -> None:
    """Fetch the contacts and events of run i from C's integrator `run`, and its step record if full or the run is over.

    Recorded steps are passed to the run's observer; `step_log` is None without one. Runs whose start C could not
    assemble are skipped.
    """
    if runs.arrays["status"][i] == NOT_CLOSED:
        return
    over = bool(runs.arrays["phase"][i] == OVER)
    if step_log and (over or runs.compiled.lib.gudgeon_run_has_full_buffers(run)):
        step_log.observer = runs.observers[i]
        step_log.flush_recorded_states(run)
    runs.fetch_contacts_and_events(i, run, over)


def may_use_lanes(compiled: CompiledModel, method: str, n_runs: int) -> bool:
    """Return whether the runs of a batch may use lanes: MIN_RUNS or more, a method in IN_LANES, and a C compiler."""
    has_lanes = bool(compiled.source.lane_file) and method in (*IN_LANES, KINEMATIC)
    return n_runs >= MIN_RUNS and has_lanes and has_compiler()

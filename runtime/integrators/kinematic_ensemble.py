"""Compute the kinematic runs of a batch in C, one after the other without Python (engine/kinematic/ensemble.c).

Start, motion, works and checks of a run are one call of C, which fills the arrays of the batch. A run that C cannot
complete is computed again by `KinematicRun`, which finds the cause. Scenes with user events always use `KinematicRun`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.integrators.kinematic import MAX_CORRECTION
from gudgeon.integrators.lanes import MIN_SHARED_ROWS
from gudgeon.integrators.times import Times
from gudgeon.integrators.trajectory import Problem
from gudgeon.model.arrays import find_memory_address, set_struct_pointers
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.evaluation import MotionSeries
from gudgeon.model.sizes import compute_mechanism_sizes

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.integrators.lanes import Lanes

# arrays of the batch that C fills, by their names in the struct KinematicBatch; then those that this module adds
FILLED = ("start", "started", "phase", "y", "a", "done", "status", "t_last", "seconds", "counts", "residuals")
ADDED = ("n_interpolated", "t_interpolated", "is_suspect")
MAX_RUNS, MAX_SAMPLES = 64, 24_576  # of one call of C; at least MIN_SHARED_ROWS runs, whatever their samples
MAX_SHORT_RUN_SAMPLES = 2_000  # samples: a single run of no more is computed without polls for cancellation


def has_kinematic_ensemble(source: KernelSource, method: str) -> bool:
    """Return whether C computes whole runs of a scene by a method: kinematic runs without user events."""
    return method == "kinematic" and not source.events


def is_short_kinematic_run(problem: Problem) -> bool:
    """Return whether C may compute a single run in one call, without polls for cancellation.

    It is kinematic, and has at most MAX_SHORT_RUN_SAMPLES samples, no user events, observer or report of progress.
    """
    return (
        has_kinematic_ensemble(problem.compiled.source, problem.method)
        and len(problem.t) <= MAX_SHORT_RUN_SAMPLES
        and not (problem.observer or problem.progress)
    )


def count_runs_per_kinematic_call(n_samples: int) -> int:
    """Return how many runs of `n_samples` samples one call of C computes, so that they fit into the CPU cache.

    At most MAX_RUNS with MAX_SAMPLES in all; a multiple of MIN_SHARED_ROWS, and at least that, so that all lanes are
    used.
    """
    return max(MIN_SHARED_ROWS, min(MAX_RUNS, MAX_SAMPLES // n_samples) // MIN_SHARED_ROWS * MIN_SHARED_ROWS)


class KinematicEnsemble:
    """Hold C's struct of a batch of kinematic runs, with pointers to `arrays`, the arrays of the batch by name.

    It adds arrays (n,): `is_suspect`, whether Python must check a run, and the number of samples at or near a change
    point with the time (s) of the first.
    """

    def __init__(self, compiled: CompiledModel, arrays: dict[str, NDArray[Any]], times: Times) -> None:
        self.compiled, self._arrays, n = compiled, arrays, len(arrays["p"])
        arrays["is_suspect"] = np.ones(n, np.uint8)
        arrays["n_interpolated"], arrays["t_interpolated"] = np.zeros(n, np.int_), np.full(n, np.nan)
        self._largest_a = np.empty(arrays["a"].shape[:2])
        self._inputs = {
            "t": np.ascontiguousarray(times.t),
            "n_requested": np.ascontiguousarray(times.count, np.int_),
            "sample_block": arrays["sample_block"],
            "p": np.ascontiguousarray(arrays["p_motion"]),
            "size": compute_mechanism_sizes(compiled.source, arrays["p"]),
        }
        self._struct = struct = compiled.ffi.new("KinematicBatch *")
        struct.samples, struct.time_stride, struct.numbers = times.max_count, times.stride, arrays["p"].shape[1]
        struct.max_correction, struct.has_states, struct.has_works = MAX_CORRECTION, True, True
        struct.largest_a = compiled.pointer(self._largest_a, is_written=True)
        set_struct_pointers(compiled.ffi, struct, self._inputs | {name: arrays[name] for name in (*FILLED, *ADDED)})
        struct.ending = compiled.pointer(arrays["ending"], "int *")
        self._series: Any = ()  # what the struct points to: series and their arrays
        self._complete_struct = struct

    def set_series(
        self, series: Sequence[MotionSeries], arrays: Sequence[Array], *, has_states: bool, has_works: bool
    ) -> None:
        """Make C store series of the motion in `arrays` (n, N). Call it after `set_sample_audit`, before runs begin.

        Without `has_states`, C stores only the states at audited samples and at the last one. Without `has_works`, it
        computes no works. `is_complete` in `compute_runs` selects both.
        """
        ffi, struct = self.compiled.ffi, self.compiled.ffi.new("KinematicBatch *", self._struct[0])
        pointers = [self.compiled.pointer(array, is_written=True) for array in arrays]
        c_series, values = ffi.new("MotionSeries[]", series), ffi.new("double *[]", pointers)
        self._series = c_series, values, arrays
        struct.n_series, struct.series, struct.values = len(series), c_series, values
        struct.has_states, struct.has_works = has_states, has_works
        self._struct = struct

    @property
    def is_complete(self) -> bool:
        """Return whether the runs store all states and works; False after `set_series` without them."""
        return bool(self._struct.has_states and self._struct.has_works)

    def set_sample_audit(self, positions: Array, limits: Array) -> None:
        """Set the samples that C audits, and the limits (4,) of its checks, in the order of audit.LIMITS.

        `positions`: at most 8 fractions of a run, 0 to 1; runs with no more samples are audited at all of them.
        """
        self._struct.n_drawn = len(positions)
        self._struct.drawn[0 : len(positions)] = positions.tolist()
        self._struct.limit = limits.tolist()

    def allocate_storages(self, count: int = 1) -> NDArray[np.uint8]:
        """Allocate and return the memory of C's integrators, a row for each of `count` runs computed at once."""
        return np.zeros((count, self.compiled.lib.gudgeon_kinematic_size()), dtype=np.uint8)

    def compute_runs(
        self,
        indices: Sequence[int],
        storages: NDArray[np.uint8],
        lanes: Lanes | None = None,
        is_complete: bool = False,
    ) -> None:
        """Compute the runs with these indices in the calling thread, without Python's global lock.

        In `lanes`, several runs are computed at once, each in a row of `storages` (memory of C); otherwise the first
        row is used, one run after the other. Runs that are over are skipped. No run begins once the batch is ending.
        `is_complete`: with all states and works, and without the series of `set_series`.
        """
        struct = self._complete_struct if is_complete else self._struct
        self.compiled.lib.switch_library_if_ready()
        run_indices, ffi = np.array(indices, np.int_), self.compiled.ffi
        if lanes and len(run_indices) > 1:
            rows = [find_memory_address(ffi, row) for row in storages]
            lanes.compute_kinematic_runs(int(ffi.cast("uintptr_t", struct)), rows, run_indices)
            return
        storage = self.compiled.pointer(storages[0], "void *", True)
        indices_pointer = self.compiled.pointer(run_indices, "long *")
        self.compiled.lib.gudgeon_kinematic_ensemble(struct, storage, len(run_indices), indices_pointer)

    def compute_short_run(self, n_samples: int) -> bool:
        """Compute the only run (is_short_kinematic_run) of the batch and return whether it has all its `n_samples`.

        Return False if C cannot complete the run within 0.02 s. KinematicRun then computes it, with polls for
        cancellation.
        """
        self._struct.must_be_short = 1
        self.compute_runs([0], self.allocate_storages())
        is_complete = bool(self._arrays["done"][0] == n_samples and not self._arrays["status"][0])
        if not is_complete:
            self._arrays["status"][0], self._arrays["done"][0] = 0, 0
        return is_complete

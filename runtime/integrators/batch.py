"""Call the time loop in C (engine/batch/ensemble.c) for one run or many, with arrays that the runs fill.

A call of C integrates runs from start to end without Python's global lock. Python distributes the runs and fetches the
lists of contacts and events. Many runs use threads (threads.py); a single one stays in the calling thread
(single_run.py). A method without a loop in C is a Python function from a Problem to a Trajectory
(`Runs.python_loop`), whose runs fill the same arrays.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.guess_warnings import find_guess_deviations
from gudgeon.assembly.large import MIN_SPARSE_COORDINATES
from gudgeon.assembly.rank import check_redundant_equations, list_redundant_equations
from gudgeon.assembly.start import assemble_start
from gudgeon.contract.boundary import (
    AUDITED,
    BUFFERS_FULL,
    ENDED,
    NEW,
    NOT_CLOSED,
    OVER,
    RUN_ENDED,
    STOPPED,
)
from gudgeon.errors import GudgeonError, SolverError
from gudgeon.integrators import adaptive, lanes
from gudgeon.integrators.failure import INTERRUPTED, build_audit_error, build_run_error
from gudgeon.integrators.kinematic_ensemble import (
    KinematicEnsemble,
    count_runs_per_kinematic_call,
    has_kinematic_ensemble,
)
from gudgeon.integrators.lanes import LaneProvider, Lanes
from gudgeon.integrators.run_arrays import SingleRunArrays, set_pointers
from gudgeon.integrators.steps import StepCallback, StepLog
from gudgeon.integrators.stored import StoredRuns
from gudgeon.integrators.threads import integrate_runs_in_threads
from gudgeon.integrators.times import Times
from gudgeon.integrators.trajectory import Problem, Progress, Trajectory
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.waiting.ctrl_c import DelayedCtrlC

if TYPE_CHECKING:
    from gudgeon.results.results import State

PythonLoop: TypeAlias = Callable[[Problem], Trajectory]  # a method without a loop over runs in C
MAX_STEPS_PER_CALL = 4_000  # steps of one call of C, within which it polls Python for cancellation (cancellation.py)
MAX_UNSTORED_SAMPLES = 4096  # largest number of samples of finished runs that wait to be stored together


class Runs(StoredRuns):
    """Integrate runs from start to end.

    Each run has its own rows of samples or, if they are `has_shared_rows`, those of its thread. Shared samples are
    lost unless `store_results` stores them when runs end.
    """

    def __init__(
        self,
        compiled: CompiledModel,
        p: Array,
        p_motion: Array,
        times: Times,
        method: str,
        step: Array,
        rtol: float,
        stop: bool,
        audit: int,
        side_by_side: bool,
        threads: int,
        has_shared_rows: bool = False,
        python_loop: PythonLoop | None = None,
    ) -> None:
        self.threads, self.rtol, self.has_shared_rows, self.python_loop = threads, rtol, has_shared_rows, python_loop
        self.stop, self.audit = stop, audit
        self.store_results: Callable[[Sequence[int]], None] | None = None  # stores the results of finished runs
        n, N = len(p), times.max_count
        is_kinematic = has_kinematic_ensemble(compiled.source, method)
        is_in_c = is_kinematic or not python_loop
        has_lanes = side_by_side and is_in_c and lanes.may_use_lanes(compiled, method, n)
        if has_lanes:
            compiled.lib.wait_for_optimized_library()  # lanes call its functions
        has_series = adaptive.uses_taylor_series(compiled.source, method, rtol)
        self.lane_provider = LaneProvider(compiled, has_series) if has_lanes else None
        self.n_lanes = self.lane_provider.count if self.lane_provider else 1
        if self.lane_provider and has_shared_rows:
            self.n_lanes = min(self.n_lanes, max(lanes.MIN_SHARED_ROWS, MAX_UNSTORED_SAMPLES // N))
        n_unstored_rows = (
            min(self.n_lanes, MAX_UNSTORED_SAMPLES // N) if self.lane_provider else 0
        )  # rows of finished runs that are not stored yet
        self.n_rows_per_thread = self.n_lanes + n_unstored_rows  # rows of samples per thread
        if is_kinematic:
            self.n_rows_per_thread = count_runs_per_kinematic_call(N)
        super().__init__(
            compiled,
            method,
            p,
            p_motion,
            times,
            step,
            threads * self.n_rows_per_thread if has_shared_rows else n,
            bool(python_loop),
        )
        self.struct: Any = None if python_loop else self._make_batch_struct()
        self.kinematic = KinematicEnsemble(compiled, self.arrays, times) if is_kinematic else None
        # deviations of the assembled start from the guesses of the file, by run
        self.guess_deviations: dict[int, dict[str, float]] = {}
        self.observers: Sequence[StepCallback | None] = ()  # observers of all steps, one per run; empty without any
        self.resumed = set[int]()  # runs that resume from a state

    def _make_batch_struct(self) -> Any:
        """Return C's struct Batch with pointers to all arrays, tolerances and settings; not for time loops in Python.

        Arrays of parameters, times and tolerances in `arrays` are replaced by contiguous ones. A single run with arrays
        in one block (SingleRunArrays) gets the values copied into that block instead.
        """
        compiled, x, times = self.compiled, self.arrays, self.times
        scale, least, size = adaptive.compute_tolerances_of_runs(compiled, x["p"], self.rtol)
        if isinstance(x, SingleRunArrays):
            x["t"][:], x["n_requested"][0] = times.t, times.count[0]
            x["scale"][:], x["min_size"][:], x["size"][:] = scale, least, size
            struct = x.make_struct(compiled.ffi)
        else:
            given = {"t": times.t, "n_requested": times.count, "scale": scale, "min_size": least, "size": size}
            names = ("p", "p_motion", "step")
            given |= {name: x[name] for name in names}
            self.arrays |= {name: np.ascontiguousarray(array) for name, array in given.items()}
            struct = compiled.ffi.new("Batch *")
            set_pointers(compiled.ffi, struct, self.arrays)
        struct.samples, struct.time_stride, struct.numbers = times.max_count, times.stride, compiled.n_p
        struct.limit = MAX_STEPS_PER_CALL
        struct.choice, struct.automatic = adaptive.find_method_numbers(compiled, self.method, self.rtol)
        struct.fixed, struct.stop, struct.audit = math.isfinite(x["step"].item(0)), self.stop, self.audit
        return struct

    def __getstate__(self) -> dict[str, Any]:
        """Return the state for pickling: arrays and lists of finished runs, without C's structures."""
        none = dict.fromkeys(("struct", "kinematic", "lane_provider", "store_results", "python_loop", "fetched"))
        return self.__dict__ | none | {"observers": ()}

    def release_samples(self) -> None:
        """Release the samples of all runs and C's struct; called after `store_results` has stored the series."""
        self.arrays |= {name: np.zeros_like(self.arrays[name][:0]) for name in ("y", "discrete_states", "state")}
        self.arrays.pop("a", None)
        self.struct, self.kinematic, self.store_results = None, None, None

    @property
    def is_stopping(self) -> bool:
        """Return whether the batch was cancelled, so that all runs end where they are; C reads the same flag."""
        return bool(self.arrays["ending"][0])

    def set_starts(self, starts: Sequence[State | Problem]) -> None:
        """Set the start states of the runs, one each, at the first of their times; [] lets all starts be assembled.

        A state with contact codes marks its run as resumed.
        """
        x, nc = self.arrays, len(self.compiled.source.clearances)
        for i, start in enumerate(starts):
            x["start"][i] = np.concatenate([start.q, start.v])
            x["initial_discrete_states"][i, : self.compiled.n_discrete_states] = start.memory
            if start.state is not None:
                x["codes"][i, :nc] = start.state
                self.resumed.add(i)
        x["started"][: len(starts)] = 1

    def exclude_runs(self, failures: dict[int, Any]) -> None:
        """Record runs as failed, with their errors by index, and mark them as over so that they are not integrated."""
        self.failures.update(failures)
        self.arrays["phase"][list(failures)] = OVER

    def integrate_all_runs(self, progress: Progress | None) -> None:
        """Integrate all runs in threads, assemble missing starts, and record failures; Ctrl-C ends them where they are.

        Starts are assembled in C where possible, in Python for the rest. After Ctrl-C `interrupted` is set, and nothing
        is raised. The contacts of all runs are then joined and sorted. `progress` is called with the fraction of runs
        done. `progress` None: nothing is reported.
        """
        with DelayedCtrlC() as ctrl_c:
            try:
                if self._has_starts_in_python:
                    self._assemble_starts(np.flatnonzero(self.arrays["phase"] == NEW).tolist(), ctrl_c)
                integrate_runs_in_threads(self, progress, range(self.n), ctrl_c)
                if unassembled := self._reset_unassembled_runs():
                    integrate_runs_in_threads(self, progress, self._assemble_starts(unassembled, ctrl_c), ctrl_c)
                ctrl_c.raise_delayed()
            except KeyboardInterrupt:
                self.interrupted = True
            self._join_contacts()
            self._record_failures()

    @property
    def _has_starts_in_python(self) -> bool:
        """Return whether Python assembles all starts, because C does not or because they must be checked."""
        is_in_c = self.struct or (self.kinematic and self.compiled.n < MIN_SPARSE_COORDINATES and not self.observers)
        return not is_in_c or bool(list_redundant_equations(self.compiled))

    def _record_failures(self) -> None:
        """Record the errors of runs that did not reach their ends, and fill their remaining samples with NaN.

        Runs that the user interrupted or that never began get a SolverError; recorded failures are kept. Runs without a
        sample are NaN throughout. Shared rows of samples are not filled.
        """
        x = self.arrays
        self._reset_unassembled_runs()
        for i in np.flatnonzero(x["phase"] != OVER).tolist():
            self.failures[i] = SolverError(INTERRUPTED, float(x["t_last"][i]))
        for i in np.flatnonzero(~np.isin(x["status"], (0, ENDED))).tolist():
            if i not in self.failures:
                self.failures[i] = self._build_error(i)
        if self.has_shared_rows:
            return
        without_samples = x["done"] == 0
        x["y"][without_samples], x["discrete_states"][without_samples] = np.nan, np.nan
        for i in np.flatnonzero(~without_samples & (x["done"] < self.times.max_count)).tolist():
            x["y"][i, x["done"][i] :], x["discrete_states"][i, x["done"][i] :] = np.nan, np.nan

    def _reset_unassembled_runs(self) -> list[int]:
        """Reset runs whose start C could not assemble to runs that have not begun, and return their indices."""
        unassembled: list[int] = np.flatnonzero(self.arrays["status"] == NOT_CLOSED).tolist()
        self.arrays["phase"][unassembled], self.arrays["status"][unassembled] = NEW, 0
        return unassembled

    def _assemble_starts(self, runs: Sequence[int], ctrl_c: DelayedCtrlC) -> list[int]:
        """Assemble the starts of these runs in Python and store them; return the indices of runs that may begin.

        Starts that were set before are only checked for redundant equations. A run whose start does not close is
        recorded as failed. Deviations from guesses are stored in `guess_deviations`. Ctrl-C is polled before each run.
        """
        x = self.arrays
        for i in runs:
            ctrl_c.raise_delayed()
            try:
                if not x["started"][i]:
                    start = assemble_start(self.compiled, x["p"][i])
                    if guess_distances := find_guess_deviations(self.compiled, x["p"][i], start.q):
                        self.guess_deviations[i] = guess_distances
                    x["start"][i] = np.concatenate([start.q, start.v])
                check_redundant_equations(
                    self.compiled, x["p"][i], float(self.times.get_times(i)[0]), x["start"][i, : self.compiled.n]
                )
                x["started"][i] = 1
            except GudgeonError as error:
                self.exclude_runs({i: error})
        return [i for i in runs if x["phase"][i] == NEW]

    def build_problem(self, i: int) -> Problem:
        """Build the Problem of run i, whose start is known, as for a single run; it has no observer and no progress.

        The contact codes of its start are those of a resumed run, else None.
        """
        x, n, joints = self.arrays, self.compiled.n, len(self.compiled.source.clearances)
        return Problem(
            self.compiled,
            x["p"][i],
            self.times.get_times(i),
            x["start"][i, :n],
            x["start"][i, n:],
            x["initial_discrete_states"][i, : self.compiled.n_discrete_states],
            float(x["step"][i]),
            state=x["codes"][i, :joints] if i in self.resumed else None,
            method=self.method,
            rtol=self.rtol,
            p_motion=x["p_motion"][i],
            stop=self.stop,
            start_is_sample=not self.times.n_skipped[i],
            audit=self.audit,
        )

    def poll_cancellation(self) -> None:
        """Raise KeyboardInterrupt if the batch was cancelled; time loops in Python call it."""
        if self.is_stopping:
            raise KeyboardInterrupt

    def integrate_run_in_python(self, i: int) -> None:
        """Integrate run i from start to end by a time loop in Python, and store its results.

        An error is recorded as its failure. Nothing is stored if Ctrl-C comes before the first sample.
        """
        assert self.python_loop
        try:
            observer = self.observers[i] if self.observers else None
            self.store_trajectory(
                i,
                self.python_loop(
                    replace(self.build_problem(i), poll_cancellation=self.poll_cancellation, observer=observer)
                ),
            )
        except KeyboardInterrupt:  # before the first sample
            return
        except GudgeonError as error:
            self.exclude_runs({i: error})
            return
        self.store_finished_runs([i])

    def integrate_kinematic_runs(
        self, indices: Sequence[int], storages: NDArray[np.uint8], lanes: Lanes | None
    ) -> None:
        """Compute these kinematic runs in C, repeat failed ones in Python, which finds the cause, and store all.

        Runs whose start C could not assemble are left for `integrate_all_runs`. `storages`: memory of C, a row for each
        of the `lanes`.
        """
        assert self.kinematic
        self.kinematic.compute_runs(indices, storages, lanes)
        failed = self._repeat_failed_runs_in_python(indices)
        self.store_finished_runs([i for i in indices if i not in failed])

    def _repeat_failed_runs_in_python(self, indices: Sequence[int]) -> list[int]:
        """Compute those of the runs that failed in C again in Python, store them, and return their indices.

        Runs that were cancelled, or whose start C could not assemble, are not repeated.
        """
        x, status = self.arrays, self.arrays["status"]
        ended = [int(i) for i in np.array(indices, np.intp)[status[indices] != 0]]
        failed = [i for i in ended if status[i] not in (NOT_CLOSED, STOPPED)]
        for i in failed:
            x["phase"][i], x["status"][i], x["done"][i], x["a"][x["sample_block"][i]] = NEW, 0, 0, np.nan
            self.integrate_run_in_python(i)
        return failed

    def recompute_runs_in_full(self, indices: Sequence[int]) -> list[int]:
        """Compute kinematic runs again with all states and works, unless C has stored them, before Python checks them.

        Return the indices of the runs to check, without those that fail now, which are stored already, and without
        interrupted ones.
        """
        x, again = self.arrays, [i for i in indices if i not in self.python_lists]
        if not again or not self.kinematic or self.kinematic.is_complete:
            return list(indices)
        x["phase"][again], x["status"][again], x["done"][again] = NEW, 0, 0
        self.kinematic.compute_runs(again, self.kinematic.allocate_storages(), is_complete=True)
        failed = self._repeat_failed_runs_in_python(again)
        return [i for i in indices if x["phase"][i] == OVER and i not in failed]

    def integrate_run_to_end(self, i: int, storage: NDArray[np.uint8], step_log: StepLog | None = None) -> None:
        """Integrate run i in C, alone in this thread, from its current state to its end, and store its results.

        `storage`: memory of C's integrator, which may have begun the run. `step_log`: step record for the observer;
        None without one.
        """
        self.integrate_runs_sequentially(i, i + 1, storage, step_log)
        self.store_finished_runs([i])

    def store_finished_runs(self, runs: Sequence[int]) -> None:
        """Pass those of the runs that have ended to `store_results`; do nothing if it is None.

        Runs whose start C could not assemble are skipped. Rows of samples of the others may be reused after that.
        """
        x = self.arrays
        if not self.store_results or not len(runs):
            return
        indices = np.array(runs, np.intp)
        finished = indices[(x["phase"][indices] == OVER) & (x["status"][indices] != NOT_CLOSED)].tolist()
        if finished:
            self.store_results(finished)

    def integrate_runs_sequentially(
        self,
        first: int,
        end: int,
        storage: NDArray[np.uint8],
        step_log: StepLog | None,
    ) -> None:
        """Integrate runs `first` to `end` − 1 in C, one after the other, in the calling thread.

        Contacts, events and recorded steps are fetched whenever a list is full or a run is over. `storage`: memory of
        C's integrator. `step_log`: step record for observers; None without observers.
        """
        compiled, current = self.compiled, self.compiled.ffi.new("long *", first)
        compiled.lib.switch_library_if_ready()
        run = compiled.pointer(storage, "void *")
        while current[0] < end:  # results of begun runs are fetched even if the batch was cancelled
            status = compiled.lib.gudgeon_ensemble(self.struct, run, current, end)
            if status in (BUFFERS_FULL, RUN_ENDED):
                self.fetch_contacts_and_events(int(current[0]), run, status == RUN_ENDED)
                if step_log:
                    step_log.observer = self.observers[int(current[0])]
                    step_log.flush_recorded_states(run)
            current[0] += status == RUN_ENDED

    def _build_error(self, i: int) -> GudgeonError:
        """Build the error that ended run i in C, from its status and the values that C stored.

        It is an AuditError if the run ended because a check of its audit exceeded the limit.
        """
        if self.arrays["status"][i] == AUDITED:
            return build_audit_error(self.build_findings(i))
        names = "status", "t_last", "last", "peaks", "p_motion", "step", "time_gain", "monitored_steps", "ended"
        stored = {name: self.arrays[name][i] for name in names}
        return build_run_error(self.compiled, self.method, stored, float(self.times.get_times(i)[-1]))

"""Integrate one run in the calling thread, by the time loop in C or in Python: `integrate_problem`.

The arrays of a short run in C are reused by later runs of the scene with the same sizes and settings. A Trajectory
contains copies of them, in one block. Each run in progress has its own arrays, also in several threads.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from weakref import ref

import numpy as np

from gudgeon.contract.boundary import BEGUN, BUFFERS_FULL, ENDED, RUN_ENDED
from gudgeon.integrators import adaptive
from gudgeon.integrators.batch import PythonLoop, Runs
from gudgeon.integrators.kinematic_ensemble import is_short_kinematic_run
from gudgeon.integrators.run_arrays import SingleRunArrays
from gudgeon.integrators.steps import StepLog
from gudgeon.integrators.stored import Contacts
from gudgeon.integrators.times import Times
from gudgeon.integrators.trajectory import Problem, Trajectory
from gudgeon.waiting.cancellation import CancellationPoll

MAX_REUSED_SAMPLES = 256  # largest number of samples of a run whose arrays are reused
MAX_UNUSED_RUNS = 8  # largest number of unused runs of a scene that are cached, per key, and of keys


class SingleRun(Runs):
    """Integrate the run of a Problem, and with `begin_problem` those of further ones of equal sizes and settings."""

    def __init__(self, problem: Problem, python_loop: PythonLoop | None = None) -> None:
        compiled, N = problem.compiled, len(problem.t)
        super().__init__(
            compiled,
            problem.p[None],
            problem.p[None],
            Times(problem.t, np.full(1, N), np.zeros(1, np.int_)),
            problem.method,
            np.full(1, problem.step),
            problem.rtol,
            problem.stop,
            problem.audit,
            side_by_side=False,
            threads=1,
            python_loop=python_loop,
        )
        if python_loop:
            self.set_starts([problem])
            return
        assert isinstance(self.arrays, SingleRunArrays)
        self.times = Times(self.arrays["t"], self.times.count, self.times.n_skipped)
        self._storage = np.zeros(compiled.lib.gudgeon_run_size(), dtype=np.uint8)
        self._integrator = compiled.pointer(self._storage, "void *", True)
        self._current = compiled.ffi.new("long *")
        this = ref(self)
        self._cancellation = CancellationPoll(compiled, lambda: this()._poll_and_report_progress())  # type: ignore[union-attr]
        self.struct.is_stop_requested, self.struct.context, self.struct.poll_interval = self._cancellation.c_arguments
        if compiled.source.clearances:
            self.allocate_envelope()
        self._problem: Problem | None = None
        self._tolerance_table = adaptive.make_tolerance_table(compiled, problem.rtol)
        names = "p", "scale", "min_size", "size"
        self._tolerance_arguments = self._tolerance_table[0], *self.arrays.find_pointers(compiled.ffi, names)
        self.arrays["started"][0] = 1
        self._head = self.arrays.copy_head()
        self.begin_problem(problem)

    def begin_problem(self, problem: Problem) -> None:
        """Reset the arrays for C, and set start, times, parameter values, tolerances and observer of the next run.

        The results of the previous run are overwritten. The parameters of the motion are `values_of_motion`.
        """
        compiled, x, n = self.compiled, self.arrays, self.compiled.n
        assert isinstance(x, SingleRunArrays)
        x.reset_head(self._head)
        x["t"][:] = t = problem.t
        x["step"][0], x["t_last"][0], x["p"][0] = problem.step, t[0], problem.p
        compiled.lib.gudgeon_compute_tolerances(*self._tolerance_arguments)
        x["p_motion"][0] = problem.values_of_motion
        start = x["start"][0]
        start[:n], start[n:] = problem.q, problem.v
        if compiled.n_discrete_states:
            x["initial_discrete_states"][0] = problem.memory
        if problem.state is not None and len(problem.state):
            x["codes"][0] = problem.state
        self._problem = problem
        self.observers = [problem.observer] if problem.observer else ()

    def release_problem(self) -> None:
        """Release the problem, its errors and lists after its results were copied, so that the run can be reused."""
        self._problem, self.observers, self.interrupted = None, (), False
        if self.failures or self.events or self.fetched.of_thread:
            self.failures, self.events, self.fetched = {}, {}, Contacts(self.compiled)
            self.contacts, self.first_contact_indices = self.contacts[:0], np.zeros(2, np.int_)

    def integrate(self, problem: Problem) -> Trajectory:
        """Integrate the run in the calling thread, in C or Python, and return its Trajectory.

        The problem polls for cancellation. Raises KeyboardInterrupt if no sample was reached.
        """
        if not self.python_loop:
            self._integrate_in_c()
        elif not (self.kinematic and self.kinematic.compute_short_run(len(problem.t))):
            return self.python_loop(problem)
        self._join_contacts()
        return self.build_trajectory(0)

    def _integrate_in_c(self) -> None:
        """Integrate the run by the time loop in C, with the optimized library if it is ready.

        Steps are recorded for observers, if there are any. After Ctrl-C, `interrupted` is set, `failures` stays empty,
        and the samples up to there remain. The error of a failed run is recorded in `failures`; without any sample, its
        start becomes the first. Raises KeyboardInterrupt if Ctrl-C came before the first sample.
        """
        compiled, x, run = self.compiled, self.arrays, self._integrator
        step_log = StepLog(compiled) if self.observers else None
        if step_log:
            step_log.register_record_buffer(run)
        compiled.lib.switch_library_if_ready()
        try:
            self._run_time_loop(step_log, self._poll)
        except KeyboardInterrupt:
            if not x["done"][0]:
                raise
            self.interrupted, x["ending"][0] = True, 1
            self._run_time_loop(step_log, lambda: None)
        if not self.interrupted and x["status"].item(0) not in (0, ENDED):
            self.failures[0] = self._build_error(0)
        if not x["done"].item(0):  # the start becomes the only sample
            rows = x["y"][0], x["discrete_states"][0], x["state"][0]
            to = (compiled.pointer(rows[0]), compiled.pointer(rows[1]), compiled.pointer(rows[2], "signed char *"))
            compiled.lib.gudgeon_run_sample(run, self.struct.p_motion, *to)
            x["done"][0] = 1

    def _run_time_loop(self, step_log: StepLog | None, poll: Callable[[], object]) -> None:
        """Call the time loop in C until the run is over; fetch contacts, events and recorded steps of full lists.

        `poll` is called after each call of C.
        """
        current, run, integrate = self._current, self._integrator, self.compiled.lib.gudgeon_ensemble
        current[0] = 0
        while not current[0]:
            status = integrate(self.struct, run, current, 1)
            if status in (BUFFERS_FULL, RUN_ENDED):
                self.fetch_contacts_and_events(0, run, status == RUN_ENDED)
                if step_log:
                    step_log.observer = self.observers[0]
                    step_log.flush_recorded_states(run)
                current[0] = status == RUN_ENDED
            poll()

    def _poll(self) -> None:
        """Raise the exception that a poll within C stored, if any, and poll once more."""
        self._cancellation.raise_stored_exception(False)
        self._poll_and_report_progress()

    def _poll_and_report_progress(self) -> None:
        """Poll for Ctrl-C and for an optimized library, and report progress; called between calls of C and within them.

        Raises KeyboardInterrupt.
        """
        problem, arrays, struct = self._problem, self.arrays, self.struct
        assert problem
        self.compiled.lib.switch_library_if_ready()
        problem.poll_cancellation()
        if problem.progress:
            t = problem.t
            if arrays["phase"][0] == BEGUN:
                self.compiled.lib.gudgeon_run_report(
                    self._integrator, struct.t_last, struct.counts, struct.residuals, struct.peaks
                )
            fraction = (arrays["t_last"][0] - t[0]) / max(t[-1] - t[0], 1e-300)
            problem.progress(float(min(max(fraction, 0.0), 1.0)), "integrating")


def integrate_problem(problem: Problem, python_loop: PythonLoop | None = None) -> Trajectory:
    """Integrate one run, in C or by the time loop `python_loop` in Python, and return its Trajectory.

    Runs in C with at most MAX_REUSED_SAMPLES samples and no observer reuse the arrays of earlier runs. A time loop in
    Python stores its samples itself; only a short kinematic run, which C computes, needs arrays here. Ctrl-C ends the
    run where it is. Raises KeyboardInterrupt if no sample was reached.
    """
    if python_loop and not is_short_kinematic_run(problem):
        return python_loop(problem)
    if python_loop or len(problem.t) > MAX_REUSED_SAMPLES or problem.observer:
        return SingleRun(problem, python_loop).integrate(problem)
    free = _get_reusable_runs(problem)
    try:
        run = free.pop()  # removed from the list: no other thread uses it
        run.begin_problem(problem)
    except IndexError:
        run = SingleRun(problem)
        run.is_reused = True
    trajectory = run.integrate(problem)
    run.release_problem()
    if len(free) < MAX_UNUSED_RUNS:
        free.append(run)
    return trajectory


def _get_reusable_runs(problem: Problem) -> list[SingleRun]:
    """Return the scene's list of unused runs whose sizes and settings fit a problem, for callers to take from.

    A new list is added to the cache for other sizes or settings; if the cache has MAX_UNUSED_RUNS lists, it is cleared
    first.
    """
    unused_runs, is_fixed = problem.compiled.unused_runs, math.isfinite(problem.step)
    key = len(problem.t), problem.method, problem.rtol, is_fixed, problem.stop, problem.audit
    if key not in unused_runs and len(unused_runs) >= MAX_UNUSED_RUNS:
        unused_runs.clear()
    return unused_runs.setdefault(key, [])

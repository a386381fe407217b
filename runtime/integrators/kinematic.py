"""Compute the motion of a linkage without degrees of freedom: positions by Newton's method, then rates.

Only the works of drives and force elements are integrated, for the energy balance, by Gauss–Legendre quadrature of
their power over the steps (engine/kinematic/kinematic.c). `Trajectory.seconds` is the time of the motion, without works
and events.

kinematic_events.py searches the user events.
"""

from __future__ import annotations

from time import perf_counter
from typing import Any
from weakref import WeakMethod

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.linkage import compute_mechanism_size
from gudgeon.assembly.rank import describe_branches
from gudgeon.contract.boundary import EVENTS_FULL, N_PEAK, N_WORK, NOT_FINITE, STALLED, STOPPED
from gudgeon.errors import NonFiniteError, SingularError, SolverError
from gudgeon.integrators.failure import (
    NO_NUMBER,
    RunProgress,
    build_overflow_error,
    build_runaway_error,
    build_too_slow_error,
    format_drive_states,
)
from gudgeon.integrators.kinematic_events import KinematicEvents
from gudgeon.integrators.steps import KinematicStepLog, StepCallback, Steps
from gudgeon.integrators.trajectory import (
    IMPACT_DTYPE,
    Counts,
    Problem,
    Trajectory,
    compute_time_resolution,
    make_empty_events,
)
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.file_expressions import (
    explain_undefined_rate,
    explain_undefined_value_after,
    explain_undefined_value_between,
)
from gudgeon.waiting.cancellation import CancellationPoll

NAME, ORDER, SOURCE = "kinematic", 0, "Newton's method on the constraints"

MAX_CORRECTION = 0.05  # rad, or relative to the mechanism's size: after a larger Newton correction, the step is halved
# largest number of samples that are computed together, and time (s) after which chunks are halved
MAX_CHUNK_SAMPLES, MAX_CHUNK_TIME_S = 10_000, 0.02


class KinematicRun:
    """Hold a kinematic run as far as it is complete: positions, velocities, accelerations, works and events.

    Rows up to `last_complete` are complete.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem, self.compiled, self.t = problem, problem.compiled, problem.t
        self.compiled.lib.switch_library_if_ready()
        self.q, self.v, self.a = (np.zeros((len(self.t), self.compiled.n)) for _ in range(3))
        self.work = np.zeros((len(self.t), N_WORK))
        self.q[0], self.v[0], self.a[0] = problem.q, problem.v, np.nan
        self.maxima, self.call_counts = np.zeros(2), np.zeros(2, dtype=np.int_)  # |Φ|, |Φ̇|; and steps, rows of a call
        self.last_complete, self.seconds = 0, 0.0
        self.events = KinematicEvents(problem) if self.compiled.source.events else None
        weak_poll = WeakMethod(self.poll_and_report_progress)  # this object owns the poll

        def poll() -> None:
            """Poll for Ctrl-C as long as the run exists."""
            if own_poll := weak_poll():
                own_poll()

        self.cancellation_poll = CancellationPoll(self.compiled, poll)
        self.motion_struct = self._allocate_motion_struct()
        self.steps = self._make_step_log(problem.observer) if problem.observer else None
        if self.steps:
            self.steps.register_record_buffer(self.pointer(self.motion_struct, "void *"))

    def _allocate_motion_struct(self) -> NDArray[Any]:
        """Allocate and initialise C's struct that follows a motion, or its works, and return its bytes (an array)."""
        motion_struct = np.zeros(self.compiled.lib.gudgeon_kinematic_size(), dtype=np.uint8)
        size = compute_mechanism_size(self.compiled, self.problem.p)
        self.compiled.lib.gudgeon_kinematic_begin(
            self.pointer(motion_struct, "void *"),
            MAX_CORRECTION,
            size,
            float(self.t[-1]),
            *self.cancellation_poll.c_arguments,
        )
        return motion_struct

    def _make_step_log(self, observer: StepCallback) -> KinematicStepLog:
        """Return a step log that collects all steps for `observer`, beginning with the start."""
        none = np.zeros((1, 0))
        begin = Steps(
            self.t[:1], self.q[:1], self.v[:1], self.work[:1], none, none.astype(np.int8), np.ones(1, dtype=bool)
        )
        return KinematicStepLog(self.compiled, observer, self._allocate_motion_struct, begin)

    def pointer(self, array: NDArray[Any], kind: str = "double *") -> Any:
        """Return a C pointer to an array."""
        return self.compiled.pointer(array, kind)

    def poll_and_report_progress(self) -> None:
        """Poll for Ctrl-C and for an optimized library, and report progress; called by C and between chunks.

        Raises KeyboardInterrupt.
        """
        self.compiled.lib.switch_library_if_ready()
        self.problem.poll_cancellation()
        if self.problem.progress:
            t = self.problem.t
            mean_time = (
                float(np.nanmean(self._read_progress()[0])) if self.has_first_sample else t[0]
            )  # of motion and works
            self.problem.progress(
                float(mean_time - t[0]) / max(float(t[-1] - t[0]), 1e-300), "solving the constraint equations"
            )

    def integrate(self) -> None:
        """Compute all samples in chunks: the motion, its events, then its works, and pass steps to the observer.

        Chunks are doubled while they take less than MAX_CHUNK_TIME_S. An event may end the run. Raises SolverError
        where the equations have no solution, and KeyboardInterrupt.
        """
        first, last, chunk = 0, len(self.t) - 1, 1
        while first < last or not self.has_first_sample:
            before = perf_counter()
            end, failed = self._compute_motion(first, min(first + chunk, last))
            stops = self.events is not None and end > first and self.events.search_events(self, first, end)
            if stops:
                end = last = self._truncate_at_event(first, end)
            self.last_complete = self._compute_works(first, end)
            if self.steps:
                self.steps.flush_states(self.problem.p, (self.t[end], self.q[end], self.v[end]) if stops else None)
            if failed and not stops:
                raise self._build_error(failed)
            first = end
            chunk = max(
                1, min(2 * chunk, MAX_CHUNK_SAMPLES) if perf_counter() - before < MAX_CHUNK_TIME_S else chunk // 2
            )
            self.poll_and_report_progress()

    @property
    def has_first_sample(self) -> bool:
        """Return whether the first sample is complete."""
        return not np.isnan(self.a[0]).all()

    def _compute_motion(self, first: int, last: int) -> tuple[int, int]:
        """Compute q, q̇, q̈ of the samples after `first` up to `last`, from the last position in C's struct.

        Return the index of the last computed sample, and the status of C (0: no failure). Recorded steps are fetched
        when C's list is full. Raises KeyboardInterrupt.
        """
        call_counts, motion_struct, status = (
            self.pointer(self.call_counts, "long *"),
            self.pointer(self.motion_struct, "void *"),
            EVENTS_FULL,
        )
        while status == EVENTS_FULL:
            rows, before = slice(first, None), perf_counter()
            status = self.compiled.lib.gudgeon_kinematic(
                motion_struct,
                last - first,
                self.pointer(self.t[rows]),
                self.pointer(self.problem.values_of_motion),
                *(self.pointer(x[rows]) for x in (self.q, self.v, self.a)),
                self.pointer(self.maxima),
                self.pointer(self.maxima[1:]),
                call_counts,
                call_counts + 1,
            )
            self.seconds += perf_counter() - before
            first += int(self.call_counts[1])
            if self.steps:
                self.steps.collect_steps(motion_struct)
            self.cancellation_poll.raise_stored_exception(status == STOPPED)
        return first, int(status)

    def _compute_works(self, first: int, last: int) -> int:
        """Compute the works of the samples after `first` up to `last`, and return `last`.

        Raises SolverError where they cannot be computed to the end; `last_complete` is then the last complete sample.
        """
        if last == first:
            return last
        rows, done = slice(first, None), np.zeros(1, dtype=np.int_)
        status = self.compiled.lib.gudgeon_kinematic_works(
            self.pointer(self.motion_struct, "void *"),
            last - first,
            self.pointer(self.t[rows]),
            self.pointer(self.problem.values_of_motion),
            *(self.pointer(x[rows]) for x in (self.q, self.v, self.work)),
            self.pointer(done, "long *"),
        )
        self.cancellation_poll.raise_stored_exception(status == STOPPED)
        if status:
            self.last_complete = first + int(done[0])
            raise self._build_error(status)
        return last

    def _truncate_at_event(self, first: int, end: int) -> int:
        """Shorten the samples to the event that ends the run between `first` and `end`; return the last sample's index.

        The event's time becomes the last sample, whose motion is computed. Recording of steps ends. Raises SolverError.
        """
        assert self.events is not None
        t_end = float(self.events.sort_events()[0]["t"][-1])
        last = first + int(np.searchsorted(self.t[first : end + 1], t_end - compute_time_resolution(self.problem.t)))
        self.t = np.append(self.t[:last], t_end)
        if self.steps:
            self.steps.register_record_buffer(self.pointer(self.motion_struct, "void *"), 0)
        if last > first:
            self.compiled.lib.gudgeon_kinematic_restart(self.pointer(self.motion_struct, "void *"))
            _, failed = self._compute_motion(last - 1, last)
            if failed:
                raise self._build_error(failed)
        return last

    def _build_error(self, status: int) -> SolverError:
        """Build the error for a nonzero status of C: no progress (STALLED), an undefined value, or no solution.

        STALLED gives two errors: a motion that becomes ever faster, or samples that take too long.
        """
        failure_time, advanced_time, steps, is_slowing = self._read_progress()
        t, t_end = float(failure_time[0]), float(self.problem.t[-1])
        if status == STALLED:
            progress = RunProgress(t, t_end - t, advanced_time, steps, bool(is_slowing))
            return (
                build_runaway_error(progress, format_drive_states(self.compiled, self.problem.p, t))
                if is_slowing
                else build_too_slow_error(progress)
            )
        if status == NOT_FINITE:
            return self._build_undefined_error(float(failure_time[1]))
        return _build_motion_error(self.problem, status, t, self._compute_positions(t))

    def _compute_positions(self, t: float) -> Array:
        """Return the coordinates (n,) at t (s), continued from the last complete sample.

        If t is not later than that sample, its coordinates are returned.
        """
        k = self.last_complete
        if not self.has_first_sample or not t > self.t[k]:
            return self.q[k]
        return compute_motion_at(
            self.compiled, self.problem.values_of_motion, np.array([self.t[k], t]), self.q[k], self.v[k]
        )[0][1]

    def _build_undefined_error(self, t: float) -> SolverError:
        """Build the error for a drive, a force or one of their rates that is not a number at t (s), with its
        expression.
        """
        compiled, p = self.compiled, self.problem.p
        why = explain_undefined_value_after(
            compiled.source, p, t, self.q[self.last_complete], self.v[self.last_complete]
        )
        why = why or explain_undefined_rate(compiled, p, np.array([t]), np.zeros(compiled.n))[0]
        why = why or f"drives or forces are not finite at t = {t:.9g} s{format_drive_states(compiled, p, t)}"
        return NonFiniteError(f"{why}\n  {NO_NUMBER}", t)

    def _read_progress(self) -> tuple[Array, float, int, int]:
        """Return the progress of C: times (2,) in s of motion and works, then three values on the last steps.

        These are the time by which they advanced (s), their number, and a code: 1 if they are far shorter than earlier
        ones, 2 if their number grows exponentially with time, else 0.
        """
        t, advanced_time, steps = np.zeros(2), np.zeros(1), np.zeros(2, dtype=np.int_)
        self.compiled.lib.gudgeon_kinematic_progress(
            self.pointer(self.motion_struct, "void *"),
            self.pointer(t),
            self.pointer(advanced_time),
            self.pointer(steps, "long *"),
        )
        return t, float(advanced_time[0]), int(steps[0]), int(steps[1])

    def build_trajectory(self, interrupted: bool, stopped: SolverError | None) -> Trajectory:
        """Return the complete samples as a Trajectory, with events up to the last one.

        Also stored in it: whether Ctrl-C `interrupted` the run, the error that `stopped` it or None, the number of
        steps, the largest residuals, the time spent in C, and the interpolated singular positions as `change_points`.
        """
        rows, first = slice(self.last_complete + 1), np.zeros(1)
        n_interpolated = self.compiled.lib.gudgeon_kinematic_count_interpolated(
            self.pointer(self.motion_struct, "void *"), self.pointer(first)
        )
        t, n_steps, (phi_max, phi_dot_max) = self.t[rows].copy(), int(self.call_counts[0]), self.maxima.tolist()
        events, undefined = (
            (make_empty_events(), make_empty_events()) if self.events is None else self.events.sort_events()
        )
        return Trajectory(
            t,
            self.q[rows],
            self.v[rows],
            self.a[rows],
            np.zeros((len(t), 0)),
            np.zeros((len(t), 0), np.int8),
            self.work[rows],
            np.zeros(0, IMPACT_DTYPE),
            np.zeros((0, N_PEAK)),
            Counts(n_steps, 0, phi_max=phi_max, phi_dot_max=phi_dot_max),
            interrupted=interrupted,
            stopped=stopped,
            seconds=self.seconds,
            events=events[events["t"] <= t[-1]],
            undefined_events=undefined[undefined["t"] <= t[-1]],
            change_points=(n_interpolated, float(first[0])),
        )


def integrate_kinematic(problem: Problem) -> Trajectory:
    """Integrate a kinematic run and return its Trajectory at the output times, or up to an event that ends it.

    An error ends the trajectory and is its `stopped`. A chunk that Ctrl-C interrupts is discarded, because motion,
    works and events belong together. Raises KeyboardInterrupt before the first sample.
    """
    run_state = KinematicRun(problem)
    interrupted, stopped = False, None
    try:
        run_state.integrate()
    except KeyboardInterrupt:
        if not run_state.has_first_sample:
            raise
        interrupted = True
    except SolverError as error:
        stopped = error
    return run_state.build_trajectory(interrupted, stopped)


def compute_motion_at(compiled: CompiledModel, p: Array, t: Array, q: Array, v: Array) -> tuple[Array, Array]:
    """Compute q and q̇ (T, n) of a kinematic motion at times t (T,) in s, continued from the state q, v at t[0].

    Rows after a failure are NaN. Nothing polls for Ctrl-C.
    """
    T, pointer, done = len(t), compiled.pointer, np.zeros(2, dtype=np.int_)
    motion_struct, maxima, a = (
        np.zeros(compiled.lib.gudgeon_kinematic_size(), dtype=np.uint8),
        np.zeros(2),
        np.zeros((T, len(q))),
    )
    every_q, every_v = np.full((T, len(q)), np.nan), np.full((T, len(q)), np.nan)
    every_q[0], every_v[0] = q, v
    where, null = pointer(motion_struct, "void *", True), compiled.ffi.NULL
    size = compute_mechanism_size(compiled, p)
    compiled.lib.gudgeon_kinematic_begin(where, MAX_CORRECTION, size, float(t[-1]), null, null, 1.0)
    compiled.lib.gudgeon_kinematic(
        where,
        T - 1,
        pointer(t),
        pointer(p),
        *(pointer(x, is_written=True) for x in (every_q, every_v, a)),
        pointer(maxima),
        pointer(maxima[1:]),
        pointer(done, "long *"),
        pointer(done[1:], "long *"),
    )
    return every_q, every_v


def _build_motion_error(problem: Problem, status: int, t: float, q: Array) -> SolverError:
    """Build the error for a kinematic motion that has no solution beyond t (s), with coordinates q (n,) there.

    Its cause is the first that applies: overflow, an undefined drive, no position (status < 0), a branching of the
    motion, or a singular position.
    """
    if message := build_overflow_error(problem.compiled, problem.p, t):
        return message
    later = problem.t[problem.t > t]
    t_next = float(later[0]) if len(later) else t
    reason_text, when = explain_undefined_value_between(problem.compiled.source, problem.p, t, t_next)
    if not reason_text:
        times = np.linspace(t, t_next, 1001)
        reason_text, when = explain_undefined_rate(problem.compiled, problem.p, times, np.zeros(problem.compiled.n))
    if reason_text:
        return NonFiniteError(f"{reason_text}\n  {NO_NUMBER}", when)
    if status < 0:
        return SolverError(
            f"the linkage cannot follow its drives beyond t = {t:.12g} s: Newton's method finds no position"
            f" there{format_drive_states(problem.compiled, problem.p, t)}\n"
            "  with these lengths the drives cannot move further, or the linkage passes a dead centre",
            t,
        )
    row = problem.compiled.source.start_pivots[status - 1]
    if branches := describe_branches(problem.compiled, problem.p, t, q):
        begun = t > float(problem.t[0])
        remedy = "end the run before it" if begun else "give one of these rates in start.rates, or begin elsewhere"
        return SingularError(
            f"the linkage cannot be followed beyond t = {t:.12g} s: {branches}"
            f"{format_drive_states(problem.compiled, problem.p, t)}\n"
            f"  the drives do not determine which branch follows: {remedy}",
            t,
            row,
        )
    return SingularError(
        f"the linkage cannot be followed beyond t = {t:.12g} s: it is singular there, the pivot of constraint equation"
        f" {row} vanished{format_drive_states(problem.compiled, problem.p, t)}\n"
        "  links are in one line (a dead centre) or too short, or constraints are redundant: end the run before it, or"
        " change lengths or drives",
        t,
        row,
    )

"""Follow a linkage without degrees of freedom: positions by Newton's method from sample to sample, rates by linear
solves.

Only the works of drives and force elements are integrated, for the energy balance, by Gauss–Legendre quadrature of
their power over the steps (engine/kinematic/kinematic.c). `Trajectory.seconds` is the time of the motion, without works
and events.

engine/kinematic/events.c searches sign changes of event functions on intervals in which they are monotone. It locates
zeros to 4 ulp of t or 1e-13 of the interval (engine/watch/zeros.h). A zero at the end of the run counts: the search
extends a little beyond it.
"""

from __future__ import annotations

from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.linkage import mechanism_size
from gudgeon.assembly.rank import branches_text
from gudgeon.contract.boundary import EVENT_STOPS, EVENTS_FULL, MAX_LISTED, N_PEAK, N_WORK, NOT_FINITE, STALLED, STOPPED
from gudgeon.errors import NonFiniteError, SingularError, SolverError
from gudgeon.integrators.failure import NO_NUMBER, Pace, drives_text, overflowing, runaway_error, too_slow_error
from gudgeon.integrators.steps import Course, Look, Steps
from gudgeon.integrators.trajectory import (
    EVENT_DTYPE,
    Counts,
    Problem,
    Trajectory,
    no_events,
    resolution,
    split_undefined,
)
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.written import rate_reason, reason, reason_between
from gudgeon.waiting.asking import Asker

NAME, ORDER, SOURCE = "kinematic", 0, "Newton's method on the constraints"

REACH = 0.05  # rad, or relative to the mechanism's size: after a larger Newton correction, the step is halved
CHUNK, TURN = 10_000, 0.02  # largest number of samples that are computed together, and their time limit in s


class _KinematicRun:
    """Hold a kinematic run as far as it is complete: positions, velocities, accelerations, works and events.

    Rows up to `reached` are complete.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem, self.compiled, self.t = problem, problem.compiled, problem.t
        self.compiled.lib.newest()
        self.q, self.v, self.a = (np.zeros((len(self.t), self.compiled.n)) for _ in range(3))
        self.work = np.zeros((len(self.t), N_WORK))
        self.q[0], self.v[0], self.a[0] = problem.q, problem.v, np.nan
        self.maxima, self.longs = np.zeros(2), np.zeros(2, dtype=np.int_)  # |Φ|, |Φ̇|; and steps, rows of a call
        self.reached, self.seconds = 0, 0.0
        self.events = Events(problem) if self.compiled.source.events else None
        self.asker = Asker(self.compiled, self.look)
        self.course = self._new_course()
        self.steps = self._make_record(problem.look) if problem.look else None
        if self.steps:
            self.steps.lay(self.pointer(self.course, "void *"))

    def _new_course(self) -> NDArray[Any]:
        """Return a new struct of C that follows the motion, or its works."""
        course = np.zeros(self.compiled.lib.gudgeon_kinematic_size(), dtype=np.uint8)
        size = mechanism_size(self.compiled, self.problem.p)
        self.compiled.lib.gudgeon_kinematic_begin(
            self.pointer(course, "void *"), REACH, size, float(self.t[-1]), *self.asker.arguments
        )
        return course

    def _make_record(self, look: Look) -> Course:
        """Return the record of all steps for an observer."""
        none = np.zeros((1, 0))
        begin = Steps(
            self.t[:1], self.q[:1], self.v[:1], self.work[:1], none, none.astype(np.int8), np.ones(1, dtype=bool)
        )
        return Course(self.compiled, look, self._new_course, begin)

    def pointer(self, array: NDArray[Any], kind: str = "double *") -> Any:
        """Return a C pointer to an array."""
        return self.compiled.pointer(array, kind)

    def look(self) -> None:
        """Check for Ctrl-C and for an optimized library, and report progress; called by C and between chunks."""
        self.compiled.lib.newest()
        self.problem.take()
        if self.problem.progress:
            t = self.problem.t
            come = float(np.nanmean(self._progress()[0])) if self.begun else t[0]  # of motion and works
            self.problem.progress(float(come - t[0]) / max(float(t[-1] - t[0]), 1e-300), "following the constraints")

    def go(self) -> None:
        """Follow the motion to its end in chunks: motion, events, then works of the same samples. Raise SolverError."""
        first, last, chunk = 0, len(self.t) - 1, 1
        while first < last or not self.begun:
            before = perf_counter()
            end, failed = self._compute_motion(first, min(first + chunk, last))
            stops = self.events is not None and end > first and self.events.find(self, first, end)
            if stops:
                end = last = self._cut_at_event(first, end)
            self.reached = self._compute_works(first, end)
            if self.steps:
                self.steps.hand_on(self.problem.p, (self.t[end], self.q[end], self.v[end]) if stops else None)
            if failed and not stops:
                raise self._failure(failed)
            first = end
            chunk = max(1, min(2 * chunk, CHUNK) if perf_counter() - before < TURN else chunk // 2)
            self.look()

    @property
    def begun(self) -> bool:
        """Return whether the first row is complete."""
        return not np.isnan(self.a[0]).all()

    def _compute_motion(self, first: int, last: int) -> tuple[int, int]:
        """Compute rows up to `last`; return the last row that was reached, and the status (0: no failure)."""
        longs, course, status = self.pointer(self.longs, "long *"), self.pointer(self.course, "void *"), EVENTS_FULL
        while status == EVENTS_FULL:
            rows, before = slice(first, None), perf_counter()
            status = self.compiled.lib.gudgeon_kinematic(
                course,
                last - first,
                self.pointer(self.t[rows]),
                self.pointer(self.problem.p),
                *(self.pointer(x[rows]) for x in (self.q, self.v, self.a)),
                self.pointer(self.maxima),
                self.pointer(self.maxima[1:]),
                longs,
                longs + 1,
            )
            self.seconds += perf_counter() - before
            first += int(self.longs[1])
            if self.steps:
                self.steps.fetch(course)
            self.asker.check(status == STOPPED)
        return first, int(status)

    def _compute_works(self, first: int, last: int) -> int:
        """Compute the works of rows up to `last`. Raise SolverError where they cannot be computed to the end."""
        if last == first:
            return last
        rows, done = slice(first, None), np.zeros(1, dtype=np.int_)
        status = self.compiled.lib.gudgeon_kinematic_works(
            self.pointer(self.course, "void *"),
            last - first,
            self.pointer(self.t[rows]),
            self.pointer(self.problem.p),
            *(self.pointer(x[rows]) for x in (self.q, self.v, self.work)),
            self.pointer(done, "long *"),
        )
        self.asker.check(status == STOPPED)
        if status:
            self.reached = first + int(done[0])
            raise self._failure(status)
        return last

    def _cut_at_event(self, first: int, end: int) -> int:
        """Shorten the samples to the event that ends the run among these rows; return the index of the last sample."""
        assert self.events is not None
        t_end = float(self.events.in_order()[0]["t"][-1])
        last = first + int(np.searchsorted(self.t[first : end + 1], t_end - resolution(self.problem.t)))
        self.t = np.append(self.t[:last], t_end)
        if self.steps:
            self.steps.lay(self.pointer(self.course, "void *"), 0)
        if last > first:
            self.compiled.lib.gudgeon_kinematic_restart(self.pointer(self.course, "void *"))
            _, failed = self._compute_motion(last - 1, last)
            if failed:
                raise self._failure(failed)
        return last

    def _failure(self, status: int) -> SolverError:
        """Return the error for a status of C."""
        at, gained, steps, crawls = self._progress()
        t, t_end = float(at[0]), float(self.problem.t[-1])
        if status == STALLED:
            pace = Pace(t, t_end - t, gained, steps, bool(crawls))
            return (
                runaway_error(pace, drives_text(self.compiled, self.problem.p, t)) if crawls else too_slow_error(pace)
            )
        if status == NOT_FINITE:
            return self._not_a_number_error(float(at[1]))
        return _failure(self.problem, status, t, self._positions_at(t))

    def _positions_at(self, t: float) -> Array:
        """Return the positions at t (s), followed from the last complete row."""
        k = self.reached
        if not self.begun or not t > self.t[k]:
            return self.q[k]
        return along(self.compiled, self.problem.p, np.array([self.t[k], t]), self.q[k], self.v[k])[0][1]

    def _not_a_number_error(self, t: float) -> SolverError:
        """Return the error for a drive, a force or one of their rates that is not a number at t (s)."""
        compiled, p = self.compiled, self.problem.p
        why = reason(compiled.source, p, t, self.q[self.reached], self.v[self.reached])
        why = why or rate_reason(compiled, p, np.array([t]), np.zeros(compiled.n))[0]
        why = why or f"what the drives and forces do is no number at t = {t:.9g} s{drives_text(compiled, p, t)}"
        return NonFiniteError(f"{why}\n  {NO_NUMBER}", t)

    def _progress(self) -> tuple[Array, float, int, int]:
        """Return the times (s) of motion and works, the gain (s) of the last steps, their number, and if they crawl."""
        t, gained, steps = np.zeros(2), np.zeros(1), np.zeros(2, dtype=np.int_)
        self.compiled.lib.gudgeon_kinematic_progress(
            self.pointer(self.course, "void *"), self.pointer(t), self.pointer(gained), self.pointer(steps, "long *")
        )
        return t, float(gained[0]), int(steps[0]), int(steps[1])

    def trajectory(self, interrupted: bool, stopped: SolverError | None) -> Trajectory:
        """Return the complete rows as a Trajectory."""
        from gudgeon.integrators.trajectory import IMPACT_DTYPE

        rows, first = slice(self.reached + 1), np.zeros(1)
        passed = self.compiled.lib.gudgeon_kinematic_interpolated(
            self.pointer(self.course, "void *"), self.pointer(first)
        )
        empty, t = np.zeros((self.reached + 1, 0)), self.t[rows].copy()
        events, lost = (no_events(), no_events()) if self.events is None else self.events.in_order()
        counts = Counts(int(self.longs[0]), 0, phi_max=float(self.maxima[0]), phi_dot_max=float(self.maxima[1]))
        return Trajectory(
            t,
            self.q[rows],
            self.v[rows],
            self.a[rows],
            empty,
            empty.astype(np.int8),
            self.work[rows],
            np.zeros(0, dtype=IMPACT_DTYPE),
            np.zeros((0, N_PEAK)),
            counts,
            interrupted,
            stopped,
            self.seconds,
            events[events["t"] <= t[-1]],
            no_number=lost[lost["t"] <= t[-1]],
            change_points=(passed, float(first[0])),
        )


def run(problem: Problem) -> Trajectory:
    """Return the Trajectory of a kinematic run at the output times, and at an event that ends it.

    Raises KeyboardInterrupt before the first sample. A chunk that Ctrl-C interrupts is discarded, because motion, works
    and events belong together.
    """
    way = _KinematicRun(problem)
    interrupted, stopped = False, None
    try:
        way.go()
    except KeyboardInterrupt:
        if not way.begun:
            raise
        interrupted = True
    except SolverError as error:
        stopped = error
    return way.trajectory(interrupted, stopped)


def along(compiled: CompiledModel, p: Array, t: Array, q: Array, v: Array) -> tuple[Array, Array]:
    """Return q and q̇ (T, n) at times t (T,), following the motion from the state q, v (n,) at t[0]; NaN after a
    failure.
    """
    T, pointer, done = len(t), compiled.pointer, np.zeros(2, dtype=np.int_)
    course, maxima, a = (
        np.zeros(compiled.lib.gudgeon_kinematic_size(), dtype=np.uint8),
        np.zeros(2),
        np.zeros((T, len(q))),
    )
    every_q, every_v = np.full((T, len(q)), np.nan), np.full((T, len(q)), np.nan)
    every_q[0], every_v[0] = q, v
    where, null = pointer(course, "void *", True), compiled.ffi.NULL
    size = mechanism_size(compiled, p)
    compiled.lib.gudgeon_kinematic_begin(where, REACH, size, float(t[-1]), null, null, 1.0)
    compiled.lib.gudgeon_kinematic(
        where,
        T - 1,
        pointer(t),
        pointer(p),
        *(pointer(x, written=True) for x in (every_q, every_v, a)),
        pointer(maxima),
        pointer(maxima[1:]),
        pointer(done, "long *"),
        pointer(done[1:], "long *"),
    )
    return every_q, every_v


def _failure(problem: Problem, status: int, t: float, q: Array) -> SolverError:
    """Return the error for a motion that cannot be followed beyond t (s), with positions q (n,) there."""
    if message := overflowing(problem.compiled, problem.p, t):
        return message
    later = problem.t[problem.t > t]
    until = float(later[0]) if len(later) else t
    why, when = reason_between(problem.compiled.source, problem.p, t, until)
    if not why:
        times = np.linspace(t, until, 1001)
        why, when = rate_reason(problem.compiled, problem.p, times, np.zeros(problem.compiled.n))
    if why:
        return NonFiniteError(f"{why}\n  {NO_NUMBER}", when)
    if status < 0:
        return SolverError(
            f"the linkage cannot follow its drives beyond t = {t:.12g} s: Newton's method finds no position"
            f" there{drives_text(problem.compiled, problem.p, t)}\n"
            "  the lengths do not let the drives turn on, or the linkage passes a dead centre",
            t,
        )
    row = problem.compiled.source.start_pivots[status - 1]
    if branches := branches_text(problem.compiled, problem.p, t, q):
        begun = t > float(problem.t[0])
        remedy = "end the run before it" if begun else "give one of these rates in start.rates, or begin elsewhere"
        return SingularError(
            f"the linkage cannot be followed beyond t = {t:.12g} s: {branches}"
            f"{drives_text(problem.compiled, problem.p, t)}\n"
            f"  the drives do not tell on which one it goes on: {remedy}",
            t,
            row,
        )
    return SingularError(
        f"the linkage cannot be followed beyond t = {t:.12g} s: it is singular there, the pivot of constraint row {row}"
        f" vanished{drives_text(problem.compiled, problem.p, t)}\n"
        "  links lie in one line (a dead centre) or do not reach further, or constraints are redundant: end the run"
        " before it, or change lengths or drives",
        t,
        row,
    )


class Events:
    """Collect the user events of a kinematic run in `found` (EVENT_DTYPE), in the order of the search."""

    def __init__(self, problem: Problem) -> None:
        self.problem, self.end = problem, float(problem.t[-1])
        self.side = np.zeros(len(problem.compiled.source.events), dtype=np.int8)  # of zero, seen last
        self.found, self.capacity = no_events(), MAX_LISTED

    def find(self, way: _KinematicRun, first: int, last: int) -> bool:
        """Search the intervals between rows first to last; return whether an event ends the run there.

        Raises SolverError where the motion cannot be followed between its samples.
        """
        times, done = way.t[first : last + 1], 0
        if last == len(self.problem.t) - 1:  # a little more, for what is zero at the end
            more = max(4.0 * float(np.spacing(abs(self.end))), 1e-12 * (self.end - float(times[-2])))
            times = np.append(times, self.end + more)
        while done < len(times) - 1:
            status, count = self._search_intervals(way, first + done, times[done:])
            done += count
            if status == EVENT_STOPS:
                return True
            if status == EVENTS_FULL:
                self.capacity *= 4  # one interval may have more than there was room for
            elif status and times[done] < self.end:
                t = float(times[done])
                message = f"events cannot be looked for beyond t = {t:.9g} s: no position was found there"
                raise SolverError(message, t)
            elif status:
                break  # beyond the end
        return False

    def _search_intervals(self, way: _KinematicRun, row: int, times: Array) -> tuple[int, int]:
        """Search the intervals between these times from a row on; return a status and the number of complete ones."""
        pointer, counts = self.problem.compiled.pointer, np.zeros(2, dtype=np.int_)
        at, which = np.zeros(self.capacity), np.zeros(self.capacity, dtype=np.intc)
        status = self.problem.compiled.lib.gudgeon_kinematic_events(
            pointer(way.course, "void *"),
            len(times) - 1,
            pointer(times),
            pointer(self.problem.p),
            pointer(way.q[row:]),
            pointer(way.v[row:]),
            float(way.t[0]),
            int(self.problem.stop),
            pointer(self.side, "signed char *"),
            self.capacity,
            pointer(at),
            pointer(which, "int *"),
            pointer(counts, "long *"),
            pointer(counts[1:], "long *"),
        )
        way.asker.check(status == STOPPED)
        some = np.zeros(int(counts[0]), dtype=EVENT_DTYPE)
        some["event"], some["t"] = which[: len(some)], at[: len(some)]
        self.found = np.concatenate([self.found, some])
        return int(status), int(counts[1])

    def in_order(self) -> tuple[NDArray[Any], NDArray[Any]]:
        """Return the events by time, not beyond the end, and the first time at which each is not a number."""
        events, lost = split_undefined(self.problem.compiled, self.found)
        events["t"] = np.minimum(events["t"], self.end)
        return events, lost[np.unique(lost["event"], return_index=True)[1]]

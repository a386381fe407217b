"""The driver of the time loop in C (engine/batch/many.c), of one run and of many: the arrays that runs fill.

A call of C takes runs from start to end and holds no lock of Python; Python hands out runs, and fetches the lists of
contacts and events. Many runs go on in threads (threads.py), one in the thread that asked for it (`integrate`).
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.followed import unfollowed
from gudgeon.assembly.start import assemble
from gudgeon.contract.audit import Finding
from gudgeon.contract.boundary import (
    AUDITED,
    BEGUN,
    ENDED,
    LISTS,
    N_CHECKS,
    N_COUNTS,
    N_PEAK,
    N_RESIDUALS,
    N_STEP_ENDS,
    N_WORK,
    NEW,
    NOT_CLOSED,
    OVER,
    RUN_OVER,
    STALLED,
    STOPPED,
    PEAK_e_max,
)
from gudgeon.errors import GudgeonError, SolverError
from gudgeon.integrators import adaptive, lanes, rk4, trace
from gudgeon.integrators.audit import as_findings, audit_failure
from gudgeon.integrators.contacts import Contacts
from gudgeon.integrators.events import fetch_events, no_states, resolution, split_undefined
from gudgeon.integrators.failure import FELT, INTERRUPTED, Pace, drives_at, failure, film, stalled, with_corners
from gudgeon.integrators.lanes import Flow, Lanes
from gudgeon.integrators.steps import Look, Tape
from gudgeon.integrators.threads import GLANCE as GLANCE
from gudgeon.integrators.threads import in_threads
from gudgeon.integrators.times import Times
from gudgeon.integrators.trajectory import (
    IMPACT_DTYPE,
    Counts,
    Problem,
    Progress,
    Trajectory,
    counts_of,
    no_events,
    plain,
)
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.sizes import mechanism_sizes
from gudgeon.waiting.asking import Asker
from gudgeon.waiting.ctrl_c import CtrlC

if TYPE_CHECKING:
    from gudgeon.results.results import State

TOGETHER = 4096  # samples of runs that are over, at most, that wait for one another: they are taken at once


def available_threads() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class Runs:
    """Arrays by run, and by place where there are samples; what is not reached is NaN.

    Each run has a place of its own for its samples or, with `over`, one of the thread which it goes on in: what `over`
    does not take of runs that are over, some at once in that thread, is lost.
    """

    def __init__(
        self, compiled: CompiledModel, p: Array, motion: Array, times: Times, method: str, step: Array, rtol: float,
        stop: bool, audit: int, side_by_side: bool, threads: int, over: Callable[..., None] | None = None,
    ) -> None:  # fmt: skip
        self.compiled, self.method, self.times, self.threads, self.over = compiled, method, times, threads, over
        n, N, size, nc = len(p), times.most, 2 * compiled.n + N_WORK, max(len(compiled.source.clearances), 1)
        beside = side_by_side and lanes.wanted(compiled, method, step)
        if beside:
            compiled.lib.best()  # whose functions are called from within lanes, for all runs
        self.lanes = Lanes(compiled) if beside and method == "rk4" else None
        self.flow = Flow(compiled) if beside and method != "rk4" else None
        self.n, self.abreast = n, max((each.count for each in (self.lanes, self.flow) if each), default=1)
        if self.flow and over:
            self.abreast = min(self.abreast, max(lanes.ALWAYS, TOGETHER // N))
        spare = min(self.abreast, TOGETHER // N) if self.flow else 0  # of runs that are over, and not taken yet
        self.places = self.abreast + spare  # of a thread
        places = threads * self.places if over else n
        scale, least = np.zeros((2, 1)) if method == "rk4" else adaptive.tolerances(compiled, p, rtol)
        self.arrays: dict[str, NDArray[Any]] = {
            "t": times.t, "wanted": times.count, "place": np.arange(n) % places, "p": p, "p_motion": motion,
            "size": mechanism_sizes(compiled.source, p), "step": step, "scale": scale, "least": least,
            "start": np.full((n, 2 * compiled.n), np.nan),
            "started": np.zeros(n, np.uint8), "phase": np.zeros(n, np.uint8), "y": np.empty((places, N, size)),
            "remembered": np.full((n, max(compiled.n_memory, 1)), np.nan), "codes": np.zeros((n, nc), np.int8),
            "latched": np.empty((places, N, max(compiled.n_memory, 1))), "state": np.zeros((places, N, nc), np.int8),
            "done": np.zeros(n, np.int_), "checked": np.zeros(n, np.int_), "status": np.zeros(n, np.intc),
            "audited_t": np.zeros((n, N_CHECKS)), "t_last": np.full(n, times.start),
            "last": np.full((n, size), np.nan), "seconds": np.zeros(n),
            "counts": np.zeros((n, N_COUNTS), np.int_), "residuals": np.full((n, N_RESIDUALS), np.nan),
            "peaks": np.full((n, nc, N_PEAK), np.nan), "ending": np.zeros(1, np.intc),
            "audited": np.full((n, N_CHECKS), -1.0), "audited_where": np.full((n, N_CHECKS), -1, np.intc),
            "gained": np.zeros(n), "paced": np.zeros((n, 2), np.int_), "ended": np.zeros((n, N_STEP_ENDS), np.int_),
        }  # fmt: skip
        self.arrays = {name: np.ascontiguousarray(array) for name, array in self.arrays.items()}
        self.struct = self._struct(math.isfinite(step[0]), stop, audit, rtol)
        self.fetched = Contacts(compiled)
        self.events: dict[int, list[NDArray[Any]]] = {}  # of runs that have any, with states
        self.contacts, self.cuts = np.zeros(0, IMPACT_DTYPE), np.zeros(n + 1, np.int_)  # once all are over: by run
        self.failures: dict[int, GudgeonError] = {}
        self.unfollowed: dict[int, dict[str, float]] = {}  # guesses, of runs that C could not close near them
        self.interrupted = False
        self.looks: Sequence[Look | None] = ()  # a run each, where somebody looks at all steps

    def _struct(self, fixed: bool, stop: bool, audit: int, rtol: float) -> Any:
        struct = self.compiled.ffi.new("Batch *")
        explicit = self.method == "rk4"
        struct.samples, struct.apart, struct.numbers = self.times.most, self.times.apart, self.arrays["p"].shape[1]
        struct.limit = rk4.CHUNK if explicit else adaptive.CHUNK
        struct.choice, struct.automatic = (-1, 0) if explicit else adaptive.choice_of(self.compiled, self.method, rtol)
        struct.fixed, struct.stop, struct.audit = int(fixed), int(stop), audit
        kinds = {"B": "unsigned char *", "b": "signed char *", "i": "int *", "l": "long *", "d": "double *"}
        for name, array in self.arrays.items():
            setattr(struct, name, self.compiled.pointer(array, kinds[array.dtype.char], True))
        return struct

    def keep_trace(self) -> None:
        """Runs that are yet to begin keep what a picture needs of each step."""
        joints, x = len(self.compiled.source.clearances), self.arrays
        x["trace"], x["traced"] = np.empty((self.n, trace.ROWS, trace.width(joints))), np.zeros(self.n, np.int_)
        self.struct.trace, self.struct.trace_rows = self.compiled.pointer(x["trace"], written=True), trace.ROWS
        self.struct.traced = self.compiled.pointer(x["traced"], "long *", True)

    def __getstate__(self) -> dict[str, Any]:
        """What is over: arrays and lists, without what C worked on."""
        return self.__dict__ | {"struct": None, "lanes": None, "flow": None, "over": None, "looks": (), "fetched": None}

    def let_go(self) -> None:
        """Samples that `over` has taken what it wanted of."""
        self.arrays |= {name: self.arrays[name][:0] for name in ("y", "latched", "state")}
        self.arrays |= {name: np.zeros_like(self.arrays[name]) for name in ("y", "latched", "state")}
        self.struct, self.over = None, None

    @property
    def stopping(self) -> bool:
        """Whether all runs are to end where they are; C reads the same number."""
        return bool(self.arrays["ending"][0])

    def begin(self, starts: Sequence[State | Problem]) -> None:
        """Runs that go on from states, one each, at the first of the times."""
        x, nc = self.arrays, len(self.compiled.source.clearances)
        for i, start in enumerate(starts):
            x["start"][i] = np.concatenate([start.q, start.v])
            x["remembered"][i, : self.compiled.n_memory] = start.memory
            if start.state is not None:
                x["codes"][i, :nc] = start.state
        x["started"][: len(starts)] = 1

    def leave_out(self, failures: dict[int, Any]) -> None:
        """These runs are over before they begin."""
        self.failures.update(failures)
        self.arrays["phase"][list(failures)] = OVER

    def run(self, progress: Progress | None) -> None:
        """All of them. Ctrl-C ends them where they are."""
        with CtrlC() as ctrl_c:
            try:
                in_threads(self, progress, range(self.n), ctrl_c)
                left = self._not_closed()
                if left:
                    again = [i for i in left if self._assemble(i, ctrl_c)]
                    in_threads(self, progress, again, ctrl_c)
                ctrl_c.take()
            except KeyboardInterrupt:
                self.interrupted = True
            self.contacts, self.cuts = self.fetched.joined(self.n)
            self._judge()

    def _judge(self) -> None:
        """Lists the runs that did not come to their ends, and marks what was not reached."""
        x = self.arrays
        self._not_closed()
        for i in np.flatnonzero(x["phase"] != OVER).tolist():
            self.failures[i] = SolverError(INTERRUPTED, float(x["t_last"][i]))
        for i in np.flatnonzero(~np.isin(x["status"], (0, ENDED))).tolist():
            if i not in self.failures:
                self.failures[i] = self._failure(i)
        if self.over:
            return
        none = x["done"] == 0
        x["y"][none], x["latched"][none] = np.nan, np.nan
        for i in np.flatnonzero(~none & (x["done"] < self.times.most)).tolist():
            x["y"][i, x["done"][i] :], x["latched"][i, x["done"][i] :] = np.nan, np.nan

    def _not_closed(self) -> list[int]:
        """Runs whose start C could not close: they are yet to begin."""
        left: list[int] = np.flatnonzero(self.arrays["status"] == NOT_CLOSED).tolist()
        self.arrays["phase"][left], self.arrays["status"][left] = NEW, 0
        return left

    def _assemble(self, i: int, ctrl_c: CtrlC) -> bool:
        """The start of a run that C could not close, by the search in Python."""
        ctrl_c.take()
        try:
            start = assemble(self.compiled, self.arrays["p"][i])
        except GudgeonError as error:
            self.leave_out({i: error})
            return False
        self.unfollowed[i] = unfollowed(self.compiled, self.arrays["p"][i], start.q)
        self.arrays["start"][i] = np.concatenate([start.q, start.v])
        self.arrays["started"][i] = 1
        return True

    def to_its_end(self, i: int, memory: NDArray[np.uint8], tape: Tape | None = None) -> None:
        """Run i alone from where it is, if it is not over."""
        self.alone(i, i + 1, memory, tape)
        self.are_over([i])

    def are_over(self, runs: Sequence[int]) -> None:
        """What is wanted of those of these that came to their ends in places that others may take."""
        x = self.arrays
        over = [i for i in runs if self.over and x["phase"][i] == OVER and x["status"][i] != NOT_CLOSED]
        if self.over and over:
            self.over(self, over)

    def alone(
        self, first: int, end: int, memory: NDArray[np.uint8], tape: Tape | None,
        poll: Callable[[], object] = lambda: None,
    ) -> None:  # fmt: skip
        """Runs one after the other, from where they are to their ends; `poll` is called after each call of C."""
        compiled, current = self.compiled, self.compiled.ffi.new("long *", first)
        compiled.lib.newest()
        run = compiled.pointer(memory, "void *")
        while current[0] < end:  # what has begun is handed over even where the batch is ending
            status = compiled.lib.gudgeon_many(self.struct, run, current, end)
            if status in (LISTS, RUN_OVER):
                self.fetch(int(current[0]), run, status == RUN_OVER)
                if tape:
                    tape.look = self.looks[int(current[0])]
                    tape.fetch(run)
            current[0] += status == RUN_OVER
            poll()

    def here(self, problem: Problem) -> Trajectory:
        """Integrate the only run in this thread, which asks `problem` on its way whether to go on.

        Raises KeyboardInterrupt where nothing was reached.
        """
        compiled, x = self.compiled, self.arrays
        memory = np.zeros(compiled.lib.gudgeon_run_size(), dtype=np.uint8)
        run, tape = compiled.pointer(memory, "void *", True), Tape(compiled) if self.looks else None
        if tape:
            tape.lay(run)
        asker = Asker(compiled, lambda: self._poll(problem, run))
        self.struct.ask, self.struct.whom, self.struct.every = asker.arguments

        def poll() -> None:
            asker.check(False)
            self._poll(problem, run)

        try:
            self.alone(0, 1, memory, tape, poll)
        except KeyboardInterrupt:
            if not x["done"][0]:
                raise
            self.interrupted, x["ending"][0] = True, 1
            self.alone(0, 1, memory, tape)
        self.contacts, self.cuts = self.fetched.joined(1)
        if not self.interrupted and x["status"][0] not in (0, ENDED):
            self.failures[0] = self._failure(0)
        if not x["done"][0]:  # at least the start
            rows = x["y"][0], x["latched"][0], x["state"][0]
            to = (compiled.pointer(rows[0]), compiled.pointer(rows[1]), compiled.pointer(rows[2], "signed char *"))
            compiled.lib.gudgeon_run_sample(run, self.struct.p_motion, *to)
            x["done"][0] = 1
        return self.trajectory(0)

    def _poll(self, problem: Problem, run: Any) -> None:
        """Between steps or, called by C, within one: takes Ctrl-C and a better library, moves the progress bar."""
        x, b, t = self.arrays, self.struct, problem.t
        self.compiled.lib.newest()
        problem.take()
        if problem.progress:
            if x["phase"][0] == BEGUN:
                self.compiled.lib.gudgeon_run_report(run, b.t_last, b.counts, b.residuals, b.peaks)
            share = (x["t_last"][0] - t[0]) / max(t[-1] - t[0], 1e-300)
            problem.progress(float(min(max(share, 0.0), 1.0)), "integrating")

    def fetch(self, i: int, run: Any, last: bool) -> None:
        """Takes over the lists of contacts and events of run i."""
        if self.compiled.source.clearances:
            self.fetched.fetch(i, run, last)
        if self.compiled.source.events and self.compiled.lib.gudgeon_run_listed(run):
            self.events.setdefault(i, []).append(fetch_events(self.compiled, run, self.times.of(i)))

    def _failure(self, i: int) -> GudgeonError:
        """Return the error for what ended run i."""
        x = {name: self.arrays[name][i] for name in ("status", "t_last", "last", "peaks", "p_motion", "step")}
        advice = adaptive.ADVICE if self.method != "rk4" else rk4.ADVICE.format(float(x["step"]))
        e_max = x["peaks"][: len(self.compiled.source.clearances), PEAK_e_max]
        numbers = (int(x["status"]), float(x["t_last"]), advice, x["last"], e_max, x["p_motion"])
        if x["status"] == AUDITED:
            return audit_failure(self.findings(i))
        if x["status"] == STALLED:
            return self._stalled(i, e_max)
        return failure(self.compiled, self.method, *numbers, float(x["step"]) if self.method == "rk4" else 0.0)

    def _stalled(self, i: int, e_max: Array) -> SolverError:
        """Return the error for run i, which no longer advances."""
        x = {name: self.arrays[name][i] for name in ("t_last", "gained", "paced", "ended", "p_motion")}
        t, (steps, crawls) = float(x["t_last"]), x["paced"].tolist()
        pace = Pace(t, float(self.times.of(i)[-1]) - t, float(x["gained"]), steps, bool(crawls))
        # a drive that still turns on in steps so short is what they are short for
        fast = drives_at(self.compiled, x["p_motion"], t, FELT * pace.steps / max(pace.gained, 1e-300))
        closing = film(self.compiled, e_max, x["p_motion"])
        return stalled(pace, x["ended"], closing, fast, with_corners(self.compiled.source))

    def findings(self, i: int) -> tuple[Finding, ...]:
        """What the audit of run i found."""
        return as_findings(self.compiled.source, *(self.arrays[f"audited{x}"][i] for x in ("", "_t", "_where")))

    def impacts_of(self, i: int) -> NDArray[Any]:
        """IMPACT_DTYPE, the contacts of run i by their onset."""
        return self.contacts[self.cuts[i] : self.cuts[i + 1]].copy()

    def all_impacts(self) -> tuple[NDArray[Any], ...]:
        """The same of all runs, views of one array."""
        return tuple(self.contacts[a:b] for a, b in pairwise(self.cuts.tolist()))

    def all_events(self) -> tuple[NDArray[Any], ...]:
        """EVENT_DTYPE, the user events of all runs by time."""
        events = [no_events()] * self.n
        for i in self.events:
            events[i] = plain(self._events_of(i)[0])
        return tuple(events)

    def _events_of(self, i: int) -> tuple[NDArray[Any], NDArray[Any]]:
        """Return the user events of run i by time, and those that are no number from a time on."""
        if i not in self.events:
            return no_states(self.compiled), no_states(self.compiled)
        x, times = self.arrays, self.times.of(i)
        events, lost = split_undefined(self.compiled, np.concatenate(self.events[i]))
        if x["status"][i] not in (0, ENDED, STOPPED) or not x["done"][i]:
            return events, lost
        t_last = self._times_of(i)[-1] + resolution(times)
        return events[events["t"] <= t_last], lost[lost["t"] <= t_last]

    def counts(self, i: int) -> Counts:
        """Sums and maxima over the steps of run i."""
        return counts_of(self.arrays["counts"][i], self.arrays["residuals"][i])

    def samples(self, i: int) -> tuple[Array, Array, Array, NDArray[Any]]:
        """Times of the samples of run i that were reached, and views of these: (q, v, works), memory, codes."""
        x, compiled, k = self.arrays, self.compiled, int(self.arrays["place"][i])
        t, joints = self._times_of(i), len(compiled.source.clearances)
        y, memory, state = (x[name][k, : len(t)] for name in ("y", "latched", "state"))
        return t, y, memory[:, : compiled.n_memory], state[:, :joints]

    def _times_of(self, i: int) -> Array:
        """Return the times (s) of the samples of run i that were reached."""
        done = int(self.arrays["done"][i])
        t = self.times.of(i)[:done].copy()
        if done and self.arrays["status"][i] in (ENDED, STOPPED, STALLED):
            t[-1] = self.arrays["t_last"][i]
        return t

    def trajectory(self, i: int) -> Trajectory:
        """Return run i; of several runs a copy, without their arrays."""
        own, x, n = np.copy if self.n > 1 else np.asarray, self.arrays, self.compiled.n
        t, y, memory, state = self.samples(i)
        error, (events, no_number) = self.failures.get(i), self._events_of(i)
        joints = len(self.compiled.source.clearances)
        is_stopped = x["status"][i] == STOPPED or (self.n == 1 and self.interrupted)
        return Trajectory(
            t, own(y[:, :n]), own(y[:, n : 2 * n]), None, own(memory), own(state), own(y[:, 2 * n :]),
            self.impacts_of(i), own(x["peaks"][i, :joints]), self.counts(i),
            is_stopped, error if isinstance(error, SolverError) and not is_stopped else None,
            seconds=float(x["seconds"][i]), events=plain(events), event_states=events, no_number=plain(no_number),
            trace=self._trace(i), audit=self.findings(i),
        )  # fmt: skip

    def _trace(self, i: int) -> trace.Trace | None:
        if "trace" not in self.arrays:
            return None
        rows = self.arrays["trace"][i, : self.arrays["traced"][i]]
        return trace.Trace.of_rows(rows, len(self.compiled.source.clearances))


def integrate(problem: Problem) -> Trajectory:
    """Integrate one run over its output times. Raises KeyboardInterrupt where nothing was reached."""
    times = Times(problem.t, np.full(1, len(problem.t)), np.zeros(1, np.int_))
    motion = problem.p if problem.method == "rk4" or problem.p_free is None else problem.p_free
    runs = Runs(
        problem.compiled, problem.p[None], motion[None], times, problem.method, np.full(1, problem.step), problem.rtol,
        problem.stop, problem.audit, side_by_side=False, threads=1,
    )  # fmt: skip
    runs.begin([problem])
    runs.looks = [problem.look] if problem.look else ()
    if problem.compiled.source.clearances:
        runs.keep_trace()
    return runs.here(problem)

"""Many runs in C (engine/batch/many.c): the arrays that they fill, and the threads that work on them.

A call of C takes runs from start to end and holds no lock of Python; Python hands out runs, and fetches the
lists of contacts and events.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.followed import unfollowed
from gudgeon.assembly.start import assemble
from gudgeon.contract.audit import Finding
from gudgeon.contract.boundary import (
    ALL_OVER,
    AUDITED,
    ENDED,
    LISTS,
    N_CHECKS,
    N_COUNTS,
    N_PEAK,
    N_RESIDUALS,
    N_WORK,
    NEW,
    NOT_CLOSED,
    NOT_FINITE,
    OVER,
    RUN_OVER,
    STOPPED,
    PEAK_e_max,
)
from gudgeon.errors import GudgeonError, SolverError
from gudgeon.integrators import adaptive, lanes, rk4
from gudgeon.integrators.audit import as_findings, audit_failure
from gudgeon.integrators.contacts import Contacts
from gudgeon.integrators.failure import INTERRUPTED, failure
from gudgeon.integrators.lanes import Flow, Lanes
from gudgeon.integrators.session import counts_of, fetch_events, no_states, told_apart
from gudgeon.integrators.steps import Look, Tape
from gudgeon.integrators.threads import GLANCE as GLANCE
from gudgeon.integrators.threads import in_threads
from gudgeon.integrators.times import Times
from gudgeon.integrators.trajectory import IMPACT_DTYPE, Counts, Progress, Trajectory, no_events, plain
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.sizes import mechanism_sizes
from gudgeon.waiting.ctrl_c import CtrlC

if TYPE_CHECKING:
    from gudgeon.results.results import State

AT_ONCE = 64  # runs whose samples are looked at together, at least
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
        scale, least = adaptive.tolerances(compiled, p, rtol)
        self.arrays: dict[str, NDArray[Any]] = {
            "t": times.t, "wanted": times.count, "place": np.arange(n) % places, "p": p, "p_motion": motion,
            "size": mechanism_sizes(compiled.source, p), "step": step, "scale": scale, "least": least,
            "start": np.full((n, 2 * compiled.n), np.nan),
            "started": np.zeros(n, np.uint8), "phase": np.zeros(n, np.uint8), "y": np.empty((places, N, size)),
            "remembered": np.full((n, max(compiled.n_memory, 1)), np.nan), "codes": np.zeros((n, nc), np.int8),
            "latched": np.empty((places, N, max(compiled.n_memory, 1))), "state": np.zeros((places, N, nc), np.int8),
            "done": np.zeros(n, np.int_), "status": np.zeros(n, np.intc), "audited_t": np.zeros((n, N_CHECKS)),
            "t_last": np.full(n, np.nanmin(times.t)), "last": np.full((n, size), np.nan), "seconds": np.zeros(n),
            "counts": np.zeros((n, N_COUNTS), np.int_), "residuals": np.full((n, N_RESIDUALS), np.nan),
            "peaks": np.full((n, nc, N_PEAK), np.nan), "ending": np.zeros(1, np.intc),
            "audited": np.full((n, N_CHECKS), -1.0), "audited_where": np.full((n, N_CHECKS), -1, np.intc),
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
        kinds = {"uint8": "unsigned char *", "int8": "signed char *", "int32": "int *", "int64": "long *"}
        for name, array in self.arrays.items():
            setattr(struct, name, self.compiled.pointer(array, kinds.get(array.dtype.name, "double *"), True))
        return struct

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

    def begin(self, starts: Sequence[State]) -> None:
        """Runs that go on from states, one each, at the first of the times."""
        x, nc = self.arrays, len(self.compiled.source.clearances)
        for i, start in enumerate(starts):
            x["start"][i] = np.concatenate([start.q, start.v])
            x["remembered"][i, : self.compiled.n_memory] = start.memory
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
        for i in self._not_finite() if self.method != "rk4" and not self.over else ():
            self._take_back(i)
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

    def _not_finite(self) -> Iterator[int]:
        """Runs among which are those that stored what is no number."""
        y, n, at_once = self.arrays["y"], 2 * self.compiled.n, max(AT_ONCE, TOGETHER // self.times.most)
        for first in range(0, self.n, at_once):
            if not np.isfinite(y[first : first + at_once, :, :n]).all():
                yield from range(first, min(first + at_once, self.n))

    def _take_back(self, i: int) -> None:
        """Samples of run i from the first on that is no number, as a single run does it."""
        x = self.arrays
        y = x["y"][x["place"][i]]
        k = adaptive.first_odd(y[: x["done"][i]], self.compiled.n)
        if k:
            x["done"][i], x["status"][i], x["t_last"][i] = k, NOT_FINITE, self.times.of(i)[k]
            x["last"][i] = y[k - 1]

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
        x, odd = self.arrays, self.method != "rk4"
        over = [i for i in runs if self.over and x["phase"][i] == OVER and x["status"][i] != NOT_CLOSED]
        for i in over if odd else ():
            self._take_back(i)
        if self.over and over:
            self.over(self, over)

    def alone(self, first: int, end: int, memory: NDArray[np.uint8], tape: Tape | None) -> None:
        """Runs one after the other, from where they are to their ends."""
        compiled, current = self.compiled, self.compiled.ffi.new("long *", first)
        compiled.lib.newest()
        run = compiled.pointer(memory, "void *")
        while True:  # what has begun is handed over even where the batch is ending
            status = compiled.lib.gudgeon_many(self.struct, run, current, end)
            if status == ALL_OVER:
                break
            if status in (LISTS, RUN_OVER):
                self.fetch(int(current[0]), run, status == RUN_OVER)
                if tape:
                    tape.look = self.looks[int(current[0])]
                    tape.fetch(run)
            current[0] += status == RUN_OVER

    def fetch(self, i: int, run: Any, last: bool) -> None:
        """Takes over the lists of contacts and events of run i."""
        if self.compiled.source.clearances:
            self.fetched.fetch(i, run, last)
        if self.compiled.source.events and self.compiled.lib.gudgeon_run_listed(run):
            self.events.setdefault(i, []).append(fetch_events(self.compiled, run, self.times.of(i)))

    def _failure(self, i: int) -> GudgeonError:
        """What ended run i, as a single run says it."""
        x = {name: self.arrays[name][i] for name in ("status", "t_last", "last", "peaks", "p_motion", "step")}
        advice = adaptive.ADVICE if self.method != "rk4" else rk4.ADVICE.format(float(x["step"]))
        e_max = x["peaks"][: len(self.compiled.source.clearances), PEAK_e_max]
        numbers = (int(x["status"]), float(x["t_last"]), advice, x["last"], e_max, x["p_motion"])
        if x["status"] == AUDITED:
            return audit_failure(self.findings(i))
        return failure(self.compiled, self.method, *numbers, float(x["step"]) if self.method == "rk4" else 0.0)

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
        for i, several in self.events.items():
            events[i] = plain(told_apart(self.compiled, np.concatenate(several))[0])
        return tuple(events)

    def counts(self, i: int) -> Counts:
        """Sums and maxima over the steps of run i."""
        return counts_of(self.arrays["counts"][i], self.arrays["residuals"][i])

    def samples(self, i: int) -> tuple[Array, Array, Array, NDArray[Any]]:
        """Times of the samples of run i that were reached, and views of these: (q, v, works), memory, codes."""
        x, compiled, k = self.arrays, self.compiled, int(self.arrays["place"][i])
        done = int(x["done"][i])
        t = self.times.of(i)[:done].copy()
        if done and x["status"][i] in (ENDED, STOPPED):
            t[-1] = x["t_last"][i]
        joints = len(compiled.source.clearances)
        return t, x["y"][k, :done], x["latched"][k, :done, : compiled.n_memory], x["state"][k, :done, :joints]

    def trajectory(self, i: int) -> Trajectory:
        """Run i as its method would hand it back."""
        compiled, n = self.compiled, self.compiled.n
        t, y, memory, state = self.samples(i)
        found = np.concatenate([no_states(compiled), *self.events.get(i, ())])
        error, (events, no_number) = self.failures.get(i), told_apart(compiled, found)
        joints = len(compiled.source.clearances)
        return Trajectory(
            t, y[:, :n].copy(), y[:, n : 2 * n].copy(), None, memory.copy(), state.copy(), y[:, 2 * n :].copy(),
            self.impacts_of(i), self.arrays["peaks"][i, :joints].copy(), self.counts(i),
            self.interrupted and error is not None, error if isinstance(error, SolverError) else None,
            seconds=float(self.arrays["seconds"][i]), events=plain(events),
            event_states=events, no_number=plain(no_number), audit=self.findings(i),
        )  # fmt: skip

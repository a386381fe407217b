"""The C struct of one run: started, driven by a method, and read out (engine/run/)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import (
    AUDITED,
    COUNT_NAMES,
    ENDED,
    EVENTS_FULL,
    IMPACT_COLUMN_NAMES,
    MAX_LISTED,
    N_COUNTS,
    N_IMPACT_COLUMNS,
    N_PEAK,
    N_RESIDUALS,
    N_STEP_ENDS,
    N_WORK,
    RESIDUAL_NAMES,
    STALLED,
    STOPPED,
    PEAK_e_max,
)
from gudgeon.errors import SolverError
from gudgeon.integrators import trace
from gudgeon.integrators.audit import audit_failure, fetch_findings
from gudgeon.integrators.failure import FELT, Pace, drives_at, failure, film, stalled, with_corners
from gudgeon.integrators.steps import Tape
from gudgeon.integrators.trajectory import Counts, Problem, Trajectory, event_dtype, plain
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.sizes import mechanism_sizes
from gudgeon.waiting.asking import Asker

EPSILON = float(np.finfo(np.float64).eps)


class RunEnded(Exception):
    """An event of the user ends the run; its sample is stored."""


def resolution(t: Array) -> float:
    """To how many seconds an event and a sample are told apart in a run with these output times (N,)."""
    return max(32 * EPSILON * float(abs(t[[0, -1]]).max()), min(1e-11, 1e-10 * float(t[-1] - t[0])))


def no_states(compiled: CompiledModel) -> NDArray[Any]:
    """An empty list of events with states."""
    return np.zeros(0, dtype=event_dtype(compiled.n, compiled.n_memory, len(compiled.source.clearances)))


def fetch_events(compiled: CompiledModel, run: Any, times: Array) -> NDArray[Any]:
    """event_dtype, the list of user events of a struct, which is emptied; those of the start do not count.

    What is beyond the events of the scene tells of the same events that they are no number at that time.
    """
    joints, rows = len(compiled.source.clearances), MAX_LISTED if compiled.source.events else 1
    t, event = np.zeros(rows), np.zeros(rows, dtype=np.intc)
    y, memory = (np.zeros((rows, max(width, 1))) for width in (2 * compiled.n + N_WORK, compiled.n_memory))
    state = np.zeros((rows, max(joints, 1)), dtype=np.int8)
    arrays = (compiled.pointer(t), compiled.pointer(event, "int *"), compiled.pointer(y), compiled.pointer(memory),
              compiled.pointer(state, "signed char *"))  # fmt: skip
    parts, count = [no_states(compiled)], rows
    while count == rows:
        count = compiled.lib.gudgeon_run_events(run, rows, *arrays)
        part = np.zeros(count, dtype=parts[0].dtype)
        part["event"], part["t"], part["y"] = event[:count], t[:count], y[:count]
        part["memory"], part["state"] = memory[:count, : compiled.n_memory], state[:count, :joints]
        parts.append(part)
    fetched = np.concatenate(parts)
    no_number = fetched["event"] >= len(compiled.source.events)
    return fetched[no_number | (fetched["t"] > times[0] + resolution(times))]


def told_apart(compiled: CompiledModel, found: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Events by time, and those that are no number from a time on; both of the type of `found`."""
    ordered = found[np.argsort(found["t"], kind="stable")]
    number = ordered["event"] < len(compiled.source.events)
    lost = ordered[~number]
    lost["event"] -= len(compiled.source.events)
    return ordered[number], lost


def fetch_impacts(compiled: CompiledModel, run: Any, last: bool) -> NDArray[Any]:
    """IMPACT_DTYPE, the list of contacts of a struct, which is emptied; with `last` those that still go on too."""
    numbers, joints = np.empty((MAX_LISTED, N_IMPACT_COLUMNS)), np.empty(MAX_LISTED, dtype=np.intc)
    arrays = (compiled.pointer(numbers), compiled.pointer(joints, "int *"))
    parts, count = [], MAX_LISTED
    while count == MAX_LISTED:
        count = compiled.lib.gudgeon_run_impacts(run, int(last), MAX_LISTED, *arrays)
        parts.append(as_impacts(numbers[:count], joints[:count]))
    return np.concatenate(parts)


def as_impacts(numbers: Array, joints: NDArray[np.intc]) -> NDArray[Any]:
    """IMPACT_DTYPE, contacts from their numbers (n, N_IMPACT_COLUMNS) and joints (n,) as C tells them."""
    from gudgeon.integrators.trajectory import IMPACT_DTYPE

    impacts = np.empty(len(joints), dtype=IMPACT_DTYPE)
    impacts["joint"] = joints
    for name in (IMPACT_DTYPE.names or ())[1:]:
        impacts[name] = numbers[:, IMPACT_COLUMN_NAMES.index(name)]
    return impacts


def counts_of(counts: NDArray[Any], numbers: Array) -> Counts:
    """Return the counts (N_COUNTS,) and residuals (N_RESIDUALS,) that gudgeon_run_report writes."""
    known = counts_of_runs(counts[None], numbers[None])
    return Counts(**{name: values[0].item() for name, values in known.items()})


def counts_of_runs(counts: NDArray[Any], numbers: Array) -> dict[str, NDArray[Any]]:
    """Return arrays (n,) by the names in Counts, from those of n runs, (n, N_COUNTS) and (n, N_RESIDUALS)."""
    known = dict(zip(COUNT_NAMES, counts.T.copy(), strict=True))
    finite = np.where(np.isfinite(numbers), numbers, math.nan)
    known |= dict(zip(RESIDUAL_NAMES, finite.T.copy(), strict=True))
    return {each.name: known[each.name] for each in fields(Counts)}


class Session:
    """Samples by row: y (N, 2n + 3), memory, contact codes; `done` rows are filled."""

    def __init__(self, problem: Problem, p: Array | None = None) -> None:
        from gudgeon.integrators.trajectory import IMPACT_DTYPE

        self.problem, self.compiled = problem, problem.compiled
        self.lib, self.pointer = self.compiled.lib, self.compiled.pointer
        self.lib.newest()
        n, nc, N = self.compiled.n, len(self.compiled.source.clearances), len(problem.t) + 1  # one for an early end
        self.n, self.nc = n, nc
        self.rows_done = np.zeros(1, dtype=np.int_)  # what C has filled, whatever happens in Python
        self.seconds = 0.0  # spent in C
        self.t, self.events = problem.t, [no_states(self.compiled)]
        self.p = problem.p if p is None else p
        self.y = np.zeros((N, 2 * n + N_WORK))
        self.memory = np.full((N, max(self.compiled.n_memory, 1)), np.nan)
        self.state = np.zeros((N, max(nc, 1)), dtype=np.int8)
        self.impacts = [np.zeros(0, dtype=IMPACT_DTYPE)]
        self.struct = np.zeros(self.lib.gudgeon_run_size(), dtype=np.uint8)
        start = np.concatenate([problem.q, problem.v, np.zeros(N_WORK)])
        latched = self.compiled.memory_array(problem.memory if self.compiled.n_memory else None)
        p_run, y = self.pointer(self.p), self.pointer(start)
        self.lib.gudgeon_run_start(self.run, p_run, problem.t[0], y, self.pointer(latched))
        self.lib.gudgeon_run_stop(self.run, int(problem.stop))
        size = float(mechanism_sizes(self.compiled.source, self.p)) if problem.audit else 1.0
        self.lib.gudgeon_run_audit(self.run, problem.audit, size)
        self.trace = np.empty((trace.ROWS if nc else 0, trace.width(nc)))
        if nc:
            self.lib.gudgeon_run_trace(self.run, self.pointer(self.trace, written=True), len(self.trace))
        self.tape = Tape(self.compiled, problem.look) if problem.look else None
        if self.tape:
            self.tape.lay(self.run)
        self.asker = Asker(self.compiled, self.look)
        self.lib.gudgeon_run_asks(self.run, *self.asker.arguments)
        if problem.state is not None and nc:
            codes = np.ascontiguousarray(problem.state, dtype=np.int8)
            self.lib.gudgeon_run_codes(self.run, self.pointer(codes, "signed char *"))

    @property
    def done(self) -> int:
        """Rows that are filled."""
        return int(self.rows_done[0])

    def look(self) -> None:
        """Between steps or, asked by C, within one: takes Ctrl-C and a better library, moves the progress bar."""
        self.lib.newest()
        self.problem.take()
        if self.problem.progress:
            t = self.problem.t
            share = (self.report()[0] - t[0]) / max(t[-1] - t[0], 1e-300)
            self.problem.progress(float(min(max(share, 0.0), 1.0)), "integrating")

    def drive(self, advance: Callable[[], object]) -> Trajectory:
        """What was reached when `advance` is over, however that ends. KeyboardInterrupt where nothing was."""
        interrupted, stopped = False, None
        try:
            advance()
        except RunEnded:
            pass
        except KeyboardInterrupt:
            if not self.done:
                raise
            interrupted = True
            self.close()
        except SolverError as error:
            stopped = error
        return self.trajectory(interrupted, stopped)

    def back(self, status: int, t: float, advice: str) -> None:
        """What a call of a time loop returned: lists to be fetched, RunEnded, KeyboardInterrupt, SolverError."""
        self.asker.check(status == STOPPED)
        if status == EVENTS_FULL:
            self.fetch_impacts(last=False)
            self.fetch_events()
            self.fetch_steps()
        elif status == ENDED:
            self.close(resolution(self.problem.t))
            raise RunEnded
        elif status:
            self.fail(status, t, advice)

    @property
    def run(self) -> Any:
        """The struct as C takes it."""
        return self.pointer(self.struct, "void *", True)

    def rows(self, i: int) -> tuple[Any, ...]:
        """Pointers to row i of the samples: y, memory, codes."""
        codes = self.pointer(self.state[i:], "signed char *", True)
        return self.pointer(self.y[i:], written=True), self.pointer(self.memory[i:], written=True), codes

    def sample(self, i: int) -> None:
        """Store the present state as output i."""
        self.lib.gudgeon_run_sample(self.run, self.pointer(self.p), *self.rows(i))
        self.rows_done[0] = i + 1

    def close(self, near: float = 0.0) -> None:
        """Stores the present state as the last sample, in place of those that are as late, but for `near` (s)."""
        t = self.report()[0]
        done = int(np.searchsorted(self.problem.t[: self.done], t - near))
        self.t = np.append(self.problem.t[:done], t)
        self.sample(done)

    def fetch_events(self) -> None:
        """Take over the list of user events from C."""
        self.events.append(fetch_events(self.compiled, self.run, self.problem.t))

    def fetch_impacts(self, last: bool) -> None:
        """Take over the list of contacts from C; with `last` those that still go on too."""
        self.impacts.append(fetch_impacts(self.compiled, self.run, last))

    def fetch_steps(self) -> None:
        """Hand on the states of steps, where somebody looks at them."""
        if self.tape:
            self.tape.fetch(self.run)

    def report(self) -> tuple[float, NDArray[Any], Array, Array]:
        """The present time, counts, (max |Φ|, max |Φ̇|, least and largest ratio), peaks by joint."""
        t, counts = np.zeros(1), np.zeros(N_COUNTS, dtype=np.int_)
        numbers, peaks = np.zeros(N_RESIDUALS), np.zeros((max(self.nc, 1), N_PEAK))
        self.lib.gudgeon_run_report(
            self.run, self.pointer(t), self.pointer(counts, "long *"), self.pointer(numbers), self.pointer(peaks)
        )
        return float(t[0]), counts, numbers, peaks[: self.nc]

    def trajectory(self, interrupted: bool, stopped: SolverError | None) -> Trajectory:
        """What was stored, at least the start, and the run's counts."""
        if not self.done:
            self.sample(0)
        t_last = math.inf if stopped else float(self.t[self.done - 1]) + resolution(self.problem.t)
        self.fetch_impacts(last=True)
        self.fetch_events()
        self.fetch_steps()
        events, no_number = told_apart(self.compiled, np.concatenate(self.events))
        events, no_number = events[events["t"] <= t_last], no_number[no_number["t"] <= t_last]
        _, counts, numbers, peaks = self.report()
        impacts = np.concatenate(self.impacts)
        impacts = impacts[np.argsort(impacts["t_on"], kind="stable")]
        n, y = self.n, self.y[: self.done]
        return Trajectory(  # no copies: those of a gigabyte take seconds, and Ctrl-C waits
            self.t[: self.done], y[:, :n], y[:, n : 2 * n], None, self.memory[: self.done, : self.compiled.n_memory],
            self.state[: self.done, : self.nc], y[:, 2 * n :], impacts, peaks,
            counts_of(counts, numbers), interrupted, stopped, seconds=self.seconds,
            events=plain(events), event_states=events, no_number=plain(no_number), trace=self._trace(),
            audit=fetch_findings(self.compiled, self.run) if self.problem.audit else (),
        )  # fmt: skip

    def _trace(self) -> trace.Trace | None:
        if not self.nc:
            return None
        return trace.Trace.of_rows(self.trace[: self.lib.gudgeon_run_traced(self.run)], self.nc)

    def fail(self, status: int, t: float, advice: str) -> None:
        """Raises what a status of C stands for."""
        y, memory, state = self.y[:1].copy(), self.memory[:1].copy(), self.state[:1].copy()
        out = (self.pointer(y), self.pointer(memory), self.pointer(state, "signed char *"))
        self.lib.gudgeon_run_sample(self.run, self.pointer(self.p), *out)
        if status == AUDITED:
            raise audit_failure(fetch_findings(self.compiled, self.run))
        _, _, _, peaks = self.report()
        if status == STALLED:
            self.close()
            gained, steps, ended = np.zeros(1), np.zeros(2, dtype=np.int_), np.zeros(N_STEP_ENDS, dtype=np.int_)
            arrays = (self.pointer(gained), self.pointer(steps, "long *"), self.pointer(ended, "long *"))
            self.lib.gudgeon_run_pace(self.run, *arrays)
            pace = Pace(t, float(self.problem.t[-1]) - t, float(gained[0]), int(steps[0]), bool(steps[1]))
            # a drive that still turns on in steps so short is what they are short for
            fast = drives_at(self.compiled, self.p, t, FELT * pace.steps / max(pace.gained, 1e-300))
            closing = film(self.compiled, peaks[:, PEAK_e_max], self.p)
            raise stalled(pace, ended, closing, fast, with_corners(self.compiled.source))
        ahead = self.problem.step if self.problem.method == "rk4" else 0.0
        raise failure(self.compiled, self.problem.method, status, t, advice, y, peaks[:, PEAK_e_max], self.p, ahead)

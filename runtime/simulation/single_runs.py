"""A batch from whole runs of Python, for methods that have no loop over runs in C.

The runs go on in threads all the same, but share Python's lock where they are in Python.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.assembly.followed import NOTED, tell_of_runs
from gudgeon.errors import GudgeonError, SolverError
from gudgeon.integrators.failure import INTERRUPTED
from gudgeon.integrators.threads import wait_for
from gudgeon.integrators.times import Times
from gudgeon.integrators.trajectory import IMPACT_DTYPE, Counts, Progress, joined, no_events
from gudgeon.model.choices import said
from gudgeon.model.compiled import Array
from gudgeon.model.parameter_sets import Mask
from gudgeon.results.batch import Batch, States, as_failures, given_values
from gudgeon.results.diagnostics import Diagnostics
from gudgeon.results.peaks import peaks_of
from gudgeon.results.results import Result, State
from gudgeon.waiting.ctrl_c import CtrlC

if TYPE_CHECKING:
    from gudgeon.results.wear import Rubbing
    from gudgeon.simulation.simulation import Simulation


@dataclass(frozen=True)
class Asked:
    """What every run of a batch is asked for, checked."""

    method: str
    rtol: float
    threads: int
    progress: Progress | None
    stop: bool
    side_by_side: bool
    keep: tuple[str, ...] | None  # series; None: states
    peaks: tuple[str | Rubbing, ...] = ()  # series whose peaks over all steps are wanted, and what rubs
    against: Simulation | None = None  # of those less this scene's
    audit: int = 1  # level of the audit


@dataclass(frozen=True, eq=False)
class _Kept:
    """What is left of a run's Result where only series of it are kept."""

    t: Array
    impacts: Array
    events: Array
    diagnostics: Diagnostics


class _Runs:
    """Results and errors of runs by their number; a run may have both."""

    def __init__(
        self, simulation: Simulation, given: Array, is_given: Mask, options: Sequence[dict[str, Any]],
        starts: Sequence[State], keep: tuple[str, ...] | None, N: int,
    ) -> None:  # fmt: skip
        self.simulation, self.given, self.is_given, self.options = simulation, given, is_given, options
        self.n, self.interrupted, self.ending, self.starts = len(given), False, False, starts
        self.results: dict[int, Result] = {}
        self.left: dict[int, Result | _Kept] = {}  # of each that began: its result, or what is kept of it
        self.errors: dict[int, GudgeonError] = {}
        self.noted: list[Mapping[str, float]] = []  # guesses that runs do not follow
        self.keep = keep
        self.kept = {} if keep is None else {name: np.full((self.n, N), np.nan) for name in ("t", *keep)}

    def _one(self, i: int) -> None:
        slots = self.simulation.source.slots
        given = [(slots[k], float(self.given[i, k])) for k in np.flatnonzero(self.is_given[i]).tolist()]
        parameters = {slot.address: said(slot, value) for slot, value in given}
        NOTED.set(self.noted)
        try:
            begin = self.starts[i] if self.starts else None
            run = self.simulation.simulate(parameters=parameters, start=begin, progress=self._tick, **self.options[i])
            self._take(i, run)
            if run.diagnostics.interrupted:
                self.errors[i] = SolverError(INTERRUPTED, float(run.t[-1]))
                if self.keep is None:
                    self.errors[i].partial = run  # type: ignore[attr-defined]
        except KeyboardInterrupt:  # before it had anything
            pass
        except GudgeonError as error:
            self.errors[i], partial = error, getattr(error, "partial", None)
            if isinstance(partial, Result):
                self._take(i, partial)

    def _take(self, i: int, run: Result) -> None:
        """Its result, or the series of it that are kept; where one cannot be computed, that is what it failed of."""
        if self.keep is None:
            self.results[i] = self.left[i] = run
            return
        self.left[i] = _Kept(run.t, run.impacts, run.events, run.diagnostics)
        try:
            for name in self.kept:
                self.kept[name][i, : len(run.t)] = run[name]
        except SolverError as error:
            self.errors.setdefault(i, error)

    def _tick(self, fraction: float, text: str) -> None:
        if self.ending:
            raise KeyboardInterrupt

    def run(self, threads: int, progress: Progress | None, t_first: float) -> None:
        """All of them. Ctrl-C ends them where they are."""
        with CtrlC() as ctrl_c, ThreadPoolExecutor(threads, thread_name_prefix="gudgeon") as pool:
            try:
                waiting: set[Future[None]] = {pool.submit(self._one, i) for i in range(self.n) if i not in self.errors}
                wait_for(waiting, ctrl_c, progress, lambda left: 1.0 - left / self.n)
            except KeyboardInterrupt:
                self.interrupted = True
            finally:
                self.ending = True
                pool.shutdown(cancel_futures=True)
        for i in range(self.n):
            if i not in self.left and i not in self.errors:
                self.errors[i] = SolverError(INTERRUPTED, t_first)

    def __getstate__(self) -> dict[str, Any]:
        """What is over."""
        return self.__dict__ | {"simulation": None, "options": ()}

    def __call__(self, i: int) -> Result:
        """Run i, as it went."""
        if i in self.errors:
            raise self.errors[i]
        return self.results[i]

    def notes(self) -> dict[int, tuple[str, ...]]:
        """What runs say of themselves, of each that began."""
        return {i: run.diagnostics.notes for i, run in self.left.items()}

    def bare(self, i: int, parts: frozenset[str]) -> Result | None:
        """Run i as ResultOf has it."""
        return self.results.get(i)

    def padded(self, name: str, N: int) -> Array:
        """A result's array of all runs, (n, N, ...), NaN (whole numbers: 0) where a run has no sample."""
        found = {i: getattr(run, name) for i, run in self.results.items()}
        shape, kind = next(((x.shape[1:], x.dtype) for x in found.values()), ((0,), np.dtype(float)))
        out = np.full((self.n, N, *shape), np.nan if kind.kind == "f" else 0, dtype=kind)
        for i, values in found.items():
            out[i, : len(values)] = values
        return out

    def counts(self) -> dict[str, Array]:
        """Diagnostics that are numbers, (n,) each; NaN for runs that did not begin."""
        names = (*(field.name for field in fields(Counts)), "seconds")
        rows = [self.left[i].diagnostics if i in self.left else None for i in range(self.n)]
        return {name: np.array([np.nan if row is None else getattr(row, name, 0) for row in rows]) for name in names}


def run_singly(
    simulation: Simulation, numbers: tuple[Array, Mask, Array], times: Times, options: Sequence[dict[str, Any]],
    starts: Sequence[State], bad: Mapping[int, GudgeonError], asked: Asked,
) -> Batch:  # fmt: skip
    """The batch of simulation.simulate(parameters=…, **options) of each run; its values, mask and p (n, ...)."""
    before, (given, is_given, p) = time.perf_counter(), numbers
    source, t, t0 = simulation.source, times.requested(), times.start
    runs = _Runs(simulation, given, is_given, options, starts, asked.keep, t.shape[-1])
    runs.errors |= bad
    runs.run(asked.threads, asked.progress, t0)
    tell_of_runs(source, runs.noted)
    found = [runs.left.get(i) for i in range(runs.n)]
    impacts = tuple(np.zeros(0, IMPACT_DTYPE) if run is None else run.impacts for run in found)
    count, peaks = np.array([*map(len, impacts)], np.int_), np.full((runs.n, len(source.clearances), 3), np.nan)
    for i, run in runs.left.items():
        for k, peak in enumerate(run.diagnostics.peaks):
            peaks[i, k] = peak.F, peak.t, peak.e_max
    states = None if runs.kept else States(*(runs.padded(name, t.shape[-1]) for name in ("q", "v", "work", "state")))
    return Batch(
        source=source, t=t, states=states, samples=np.array([0 if run is None else len(run.t) for run in found]),
        t_last=np.array([t0 if run is None else run.t[-1] for run in found]),
        parameters=given_values(source, p, is_given), impacts=impacts,
        events=tuple(no_events() if run is None else run.events for run in found),
        peaks=peaks_of(peaks, joined(impacts), count), diagnostics=runs.counts(), failures=as_failures(runs.errors),
        seconds=time.perf_counter() - before,
        threads=asked.threads, interrupted=runs.interrupted, result=runs, kept=runs.kept,
        extremes=tuple(() if run is None else run.diagnostics.extremes for run in found),
        rubbed=tuple(() if run is None else run.diagnostics.rubbed for run in found),
    )  # fmt: skip

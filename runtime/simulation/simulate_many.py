"""Simulate many parameter sets of one scene in threads: `Simulation.simulate_many`."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.assembly.guess_warnings import warn_unfollowed_in_runs
from gudgeon.assembly.journals import check_places, parting
from gudgeon.assembly.rank import contradiction, left_out
from gudgeon.errors import AssemblyError, BadValueError, SolverError
from gudgeon.integrators import adaptive
from gudgeon.integrators import batch as many
from gudgeon.integrators.failure import INTERRUPTED
from gudgeon.integrators.threads import available_threads
from gudgeon.integrators.times import Times
from gudgeon.integrators.trajectory import Problem, Progress, counts_of_runs
from gudgeon.language.argument_checks import flag, function, is_whole, message, text
from gudgeon.language.shown import counted
from gudgeon.model.compiled import Array
from gudgeon.model.contours import of_run, read_contours
from gudgeon.model.evaluation import check_room, evaluate_runs
from gudgeon.model.left_limit import evaluation_times
from gudgeon.model.parameter_sets import ParameterSets, each_of, prepare_sets, read_uniform_rows, rows_of
from gudgeon.model.sizes import mechanism_sizes
from gudgeon.results.batch import (
    STATES,
    Batch,
    States,
    as_failures,
    check_series_names,
    evaluation_parts_of,
    given_values,
)
from gudgeon.results.peaks import peaks_of
from gudgeon.results.results import EvaluatedSamples, Result, State, bare
from gudgeon.results.samples import without_start
from gudgeon.results.series import catalogue
from gudgeon.simulation.arguments import DRIVES, method_of
from gudgeon.simulation.audit import audit_level
from gudgeon.simulation.conclusion import build_result, check_result, indeterminate, may_leave_range, range_notes
from gudgeon.simulation.each_run import EachRun
from gudgeon.simulation.hidden_jumps import end_before, first_jumps, jump_failure
from gudgeon.simulation.restart import check_resumable, checked_states, constraint_violation_notes, numbers
from gudgeon.simulation.step_observers import (
    Observation,
    StepObserver,
    check_compared_scene,
    make_observer,
    requested_peaks,
)

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.integrators.batch import Runs
    from gudgeon.results.wear import SlidingRequest
    from gudgeon.simulation.simulation import Simulation


def simulate_many(
    simulation: Simulation,
    parameters: ParameterSets,
    t_end: Any,
    output: Any,
    method: str,
    rtol: float | str | None,
    step: Any,
    threads: int | None,
    progress: Progress | None,
    stop: bool,
    side_by_side: bool = True,
    start: State | Sequence[State] | None = None,
    keep: str | Iterable[str] = STATES,
    peaks: Iterable[str | SlidingRequest] | None = None,
    against: Simulation | None = None,
    contour: Any = None,
    audit: bool | str = True,
) -> Batch:
    """Run each of many parameter sets and return the Batch; arguments as in Simulation.simulate_many."""
    method, progress = text(method, "method"), function(progress, "progress")
    simulation = simulation.of_method(method, progress)
    compiled, source = simulation.compiled, simulation.source
    names, against = requested_peaks(source, peaks), check_compared_scene(source, against)
    each = EachRun(compiled, t_end, output, step)
    worn = read_contours(source, contour, runs=True)
    starts = _Starts(simulation, parameters, start, each, worn)
    stop, side_by_side, level = flag(stop, "stop"), flag(side_by_side, "side_by_side"), audit_level(audit)
    workers = available_threads() if threads is None else threads
    if not is_whole(workers) or workers < 1:
        raise BadValueError(f"threads is {message(threads)}: expected a number of threads, 1 or more")
    workers = int(min(workers, max(len(starts.given), 1)))  # no more than there is to do
    series = _series_to_store(source, keep)
    selected = method_of(source, method, step is not None)
    tolerance = adaptive.tolerance(rtol, selected, step is not None)
    requested = Asked(selected, tolerance, workers, progress, stop, side_by_side, series, names, against, level)
    p, motion, bad = prepare_sets(compiled, starts.given, starts.is_given, selected != "rk4")
    bad |= starts.bad | starts.unfit(p, bad)
    times = each.times(p, starts.t, bad)
    check_room(compiled, times.most, len(p), series, evaluation_parts_of(source, series or ()), workers)
    steps = each.lengths_of_steps(selected, p, times, bad)
    bad |= each.bad
    return _run_batch(simulation, starts, (p, motion, steps), times, bad, requested)


def _series_to_store(source: KernelSource, keep: str | Iterable[str]) -> tuple[str, ...] | None:
    """Return the names of the series to be stored, or None if states are stored."""
    if isinstance(keep, str) and keep == STATES:
        return None
    return tuple(name for name in check_series_names(source, keep, "keep") if name != "t")


def _run_batch(
    simulation: Simulation,
    starts: _Starts,
    numbers: tuple[Array, Array, Array],
    times: Times,
    bad: dict[int, Any],
    requested: Asked,
) -> Batch:
    """Run all prepared runs to their ends and return the Batch. A drive that jumps ends its run before the jump."""
    p, motion, steps = numbers
    jumps = first_jumps(simulation.source, p, starts.t, times.ends().tolist(), bad)
    own_times = times.before({i: end_before(jump, starts.t) for i, jump in jumps.items()})
    kept = None if requested.keep is None else KeptSeries(simulation.source, requested.keep, len(p), times)
    runs = many.Runs(
        simulation.compiled,
        p,
        motion,
        own_times,
        requested.method,
        steps,
        requested.rtol,
        requested.stop,
        requested.audit,
        requested.side_by_side,
        requested.threads,
        kept is not None,
        DRIVES.get(requested.method),
    )
    runs.begin(starts.states)
    runs.leave_out(bad)
    runs.looks = searches = starts.searches(p, bad, requested)
    results = _Results(simulation, runs, starts, requested, kept)
    before = time.perf_counter()
    results.run(requested.progress)
    for i in (i for i in jumps if i not in runs.failures and runs.is_complete(i)):
        runs.failures[i] = jump_failure(simulation.source, jumps[i])
    warn_unfollowed_in_runs(simulation.source, [*runs.unfollowed.values(), *[{}] * (runs.n - len(runs.unfollowed))])
    results.message = [search.message() if search else Observation() for search in searches]
    batch = _build_batch(results, times)
    return replace(batch, seconds=time.perf_counter() - before, threads=requested.threads)


@dataclass(frozen=True)
class Asked:
    """Hold the checked options that all runs of a batch share."""

    method: str
    rtol: float
    threads: int
    progress: Progress | None
    stop: bool
    side_by_side: bool
    keep: tuple[str, ...] | None  # series to store; None: states
    peaks: tuple[str | SlidingRequest, ...]  # series whose peaks over all steps are requested, and requests for wear
    against: Simulation | None  # scene whose series are subtracted
    audit: int  # level of the audit


class _Starts:
    """Hold the parameter values (n_runs, n_slots) and start states of all runs, and which of them cannot begin.

    Without states, runs begin at t = 0.
    """

    def __init__(
        self, simulation: Simulation, parameters: ParameterSets, start: Any, each: EachRun, worn: dict[str, Array]
    ) -> None:
        self.compiled, self.worn = simulation.compiled, worn
        rows, self.bad = rows_of(parameters)
        own = next((len(contour) for contour in worn.values() if contour.ndim == 2), len(rows))
        if own != len(rows) and len(rows) > 1:
            hint = "one contour, or one for every run"
            raise BadValueError(f"contour has {counted(own, 'row')} for {counted(len(rows), 'run')}", hint=hint)
        rows = rows if own == len(rows) else list(rows) * own
        runs = each.length(len(rows))
        self.states = checked_states(simulation.source, start, runs)
        if len(rows) == 1:
            rows = list(rows) * max(runs, len(self.states))
        if len(rows) != runs:
            each.length(len(rows))
        self.t = self.states[0].t if self.states else 0.0
        plain = (
            None if self.states or worn else read_uniform_rows(simulation.source, rows)
        )  # then none chooses anything
        self.remarks: list[tuple[str, ...]] = [()] * len(rows) if plain else []
        self.given: Array
        self.is_given: Any
        self.given, self.is_given = plain or each_of(rows, self._slots)

    def _slots(self, i: int, row: Mapping[str, Any]) -> tuple[Array, Array]:
        """Return values and mask of the parameters that are given for run i, and store its notes."""
        given, is_given, remarks = numbers(
            self.compiled, self.states[i] if self.states else None, row, of_run(self.worn, i)
        )
        self.remarks.append(remarks)
        return given, is_given

    def unfit(self, p: Array, bad: Mapping[int, Any]) -> dict[int, Any]:
        """Return the errors of runs whose parameter values do not fit their state or start position, by index."""
        found: dict[int, Any] = {}
        source = self.compiled.source
        placed = (source.start_apart or any(one.at_wall for one in source.clearances)) and not self.states
        for i in range(len(p) if placed or self.states else 0):
            if i in bad:
                continue
            try:
                if placed:
                    check_places(self.compiled, p[i])
                elif self.remarks[i]:
                    check_resumable(self.compiled, self.states[i], p[i])
            except AssemblyError as error:
                found[i] = error
        return found

    def searches(self, p: Array, bad: Mapping[int, Any], requested: Asked) -> list[StepObserver | None]:
        """Return the step observer of each run, or None for it; an empty list if no peaks are requested."""
        every = range(len(p) if requested.peaks else 0)
        numbers = [(p[i], self.given[i], self.is_given[i]) for i in every]
        expected = (requested.rtol, requested.peaks, requested.against)
        return [None if i in bad else make_observer(self.compiled, numbers[i], *expected) for i in every]


@dataclass
class _Results:
    """Build the Result of run i from the stored arrays of the batch."""

    simulation: Simulation
    runs: many.Runs
    starts: _Starts
    requested: Asked
    kept: KeptSeries | None
    message: Sequence[Observation] = ()  # findings of the step observers by run; empty without observers
    specified: dict[int, tuple[str, ...]] = field(default_factory=dict)  # notes of runs that Python has checked

    def run(self, progress: Progress | None) -> None:
        """Integrate all runs."""
        self.runs.over = self._take if self.kept or self.runs.drive or left_out(self.runs.compiled) else None
        self.runs.run(progress)

    def _take(self, over: Sequence[int]) -> None:
        """Check finished runs for errors that C does not find, and store their requested series."""
        runs = self.runs
        if runs.drive:
            for i in over:
                made = self._check(i)
                if self.kept:
                    self.kept.take_one(runs, i, made)
            return
        for i in over if left_out(runs.compiled) else ():
            if runs.arrays["done"][i] and (error := contradiction(self._problem(i), runs.trajectory(i))):
                runs.failures.setdefault(i, error)
        if self.kept:
            self.kept.take(runs, over)

    def _check(self, i: int) -> Result:
        """Return the Result of run i, which a Python time loop made, and record a failed check."""
        problem, trajectory = replace(self._problem(i), take=self.runs.take), self.runs.trajectory(i)
        made = build_result(problem, trajectory, self.starts.given[i], self.starts.is_given[i])
        made, error = check_result(problem, trajectory, made)
        if error is None and made.diagnostics.interrupted:
            error = SolverError(INTERRUPTED, float(trajectory.t[-1]))
        if error is not None:
            self.runs.failures.setdefault(i, error)
        self.specified[i] = made.diagnostics.notes
        return made

    def _problem(self, i: int) -> Problem:
        """Return the Problem of run i, with the notes on its start."""
        problem, t0, remarks = self.runs.problem(i), self.starts.t, self.starts.remarks[i]
        begin = problem.q, problem.v
        if self.starts.states:
            remarks += constraint_violation_notes(problem.compiled, problem.p, t0, *begin)
        remarks += parting(problem.compiled, problem.p, t0, *begin, problem.memory)
        return replace(problem, remarks=remarks, begun=self.starts.states[i] if self.starts.states else None)

    def __call__(self, i: int) -> Result:
        """Return the Result of run i. Raise the error of a run that failed, with its partial result."""
        runs, error = self.runs, self.runs.failures.get(i)
        if error is not None and not runs.arrays["done"][i]:
            raise error
        given = self.starts.given[i], self.starts.is_given[i]
        made = build_result(self._problem(i), runs.trajectory(i), *given, soon=False)
        if self.message:
            self.message[i].to(made)
        if isinstance(error, SolverError):
            error.partial = made
        if error is not None:
            raise error
        return made

    def notes(self) -> dict[int, tuple[str, ...]]:
        """Return the notes of all runs that have any, by index, as far as they are known without samples."""
        x, source, n = self.runs.arrays, self.simulation.source, self.simulation.compiled.n
        peaks, counted = x["peaks"][:, : len(source.clearances)], counts_of_runs(x["counts"], x["residuals"])
        size = mechanism_sizes(source, x["p"])
        some = may_leave_range(source, x["p"], size, counted["phi_max"], peaks) & (x["done"] > 0)
        found = {i: remarks for i, remarks in enumerate(self.starts.remarks) if remarks}
        for i in np.flatnonzero(some).tolist():
            begin, counts, t0 = x["start"][i, :n], self.runs.counts(i), float(self.runs.times.of(i)[0])
            message = range_notes(self.simulation.compiled, x["p"][i], t0, begin, counts, peaks[i])
            found[i] = (*found.get(i, ()), *message)
        for i in np.flatnonzero(x["done"] > 0).tolist() if source.indeterminate else ():
            found[i] = (*found.get(i, ()), *indeterminate(source))
        found |= self.specified
        for i, each in enumerate(self.message):
            found[i] = (*found.get(i, ()), *each.notes)
        return found

    def bare(self, i: int, parts: frozenset[str]) -> EvaluatedSamples | None:
        """Return the samples of run i without diagnostics, as ResultOf needs them; None without samples."""
        run = bare_of(self.runs, i, parts)
        return without_start(run) if run and self.runs.times.skipped[i] else run


def _build_batch(results: _Results, times: Times) -> Batch:
    """Return the Batch of all runs at the requested output times; arrays are not copied."""
    runs, source, kept = results.runs, results.simulation.source, results.kept
    x, n, joints = runs.arrays, results.simulation.compiled.n, len(source.clearances)
    alone = np.flatnonzero((x["done"] == 1) & (times.skipped == 1))  # the start is all that they have
    for rows in kept.arrays.values() if kept else (x["y"], x["state"]):
        rows[alone, 1:2] = rows[alone, :1]
    states = None
    if kept:
        runs.let_go()
    else:
        y, state = times.without_starts(x["y"]), times.without_starts(x["state"])
        work = np.full_like(y[:, :, 2 * n :], np.nan) if source.massless else y[:, :, 2 * n :]
        states = States(y[:, :, :n], y[:, :, n : 2 * n], work, state[:, :, :joints])
    numbers = {**counts_of_runs(x["counts"], x["residuals"]), "seconds": x["seconds"]}
    return Batch(
        source=source,
        t=times.requested(),
        states=states,
        samples=x["done"] - times.skipped * (x["done"] > 1),
        t_last=x["t_last"],
        parameters=given_values(source, x["p"], results.starts.is_given),
        impacts=runs.all_impacts(),
        events=runs.all_events(),
        peaks=peaks_of(x["peaks"][:, :joints], runs.contacts, np.diff(runs.cuts)),
        diagnostics=numbers,
        failures=as_failures(runs.failures),
        seconds=math.nan,
        threads=0,
        interrupted=runs.interrupted,
        result=results,
        kept={name: times.without_starts(rows) for name, rows in kept.arrays.items()} if kept else {},
        extremes=tuple(message.extremes for message in results.message),
        rubbed=tuple(message.rubbed for message in results.message),
    )


class KeptSeries:
    """Store requested series as arrays (n, N) by name, and "t"; NaN where a run has no sample."""

    def __init__(self, source: KernelSource, names: tuple[str, ...], n: int, times: Times) -> None:
        self.names, self.parts = ("t", *names), evaluation_parts_of(source, names)
        self.arrays = {name: np.full((n, times.most), np.nan) for name in self.names}
        known = [catalogue(source)[name] for name in names if name != "t"]
        self.columns = all(one.stored or one.evaluated for one in known)  # none of them reads a run's own numbers

    def take(self, runs: Runs, over: Sequence[int]) -> None:
        """Store the series of finished runs. A run whose series cannot be computed has failed."""
        begun = [i for i in over if runs.arrays["done"][i]]
        if len(begun) > 1 and self.columns:
            try:
                self._take(begun, *_join_samples(runs, begun, self.parts))
                return
            except SolverError:  # of one of them: alone it says which
                pass
        for i in begun:
            if run := bare_of(runs, i, self.parts):
                self.take_one(runs, i, run)

    def take_one(self, runs: Runs, i: int, run: Result) -> None:
        """Store the series of run i, from its Result."""
        try:
            self._take([i], [len(run.t)], run, int(run.start_row is not None))
        except SolverError as error:
            runs.failures.setdefault(i, error)

    def _take(self, begun: Sequence[int], counts: Sequence[int], of: Result, row: int = 0) -> None:
        """Store the samples of several runs, which follow each other in `of`: counts[k] belong to run begun[k]."""
        columns, first = [(self.arrays[name], of[name]) for name in self.names], 0
        for i, count in zip(begun, counts, strict=True):
            for kept, column in columns:
                kept[i, row : row + count] = column[first : first + count]
            first += count


def bare_of(runs: Runs, i: int, parts: frozenset[str]) -> EvaluatedSamples | None:
    """Return the samples of run i as a Bare result without diagnostics; None if there is none."""
    if not runs.arrays["done"][i]:
        return None
    n, source, p = runs.compiled.n, runs.compiled.source, runs.arrays["p"][i]
    t, y, memory, state = runs.samples(i)
    made = bare(source, runs.compiled, p, t, y[:, :n], y[:, n : 2 * n], y[:, 2 * n :], memory, state, parts)
    made.accelerations = runs.accelerations(i)
    return made


def _join_samples(runs: Runs, begun: Sequence[int], parts: frozenset[str]) -> tuple[list[int], EvaluatedSamples]:
    """Return the sample counts of these runs, and their samples joined to one Bare result."""
    compiled, n, each = runs.compiled, runs.compiled.n, [runs.samples(i) for i in begun]
    counts = [len(own[0]) for own in each]
    t, y, memory, state = (np.concatenate(arrays) for arrays in zip(*each, strict=True))
    q, v = y[:, :n], y[:, n : 2 * n]
    none = np.full(compiled.n_p, np.nan)
    made = bare(compiled.source, compiled, none, t, q, v, y[:, 2 * n :], memory, state, parts)
    if parts:
        numbers = runs.arrays["p"][begun]
        if compiled.may_switch:
            last = zip(each, numbers, strict=True)
            t = np.concatenate([evaluation_times(compiled, t, y[:, :n], y[:, n : 2 * n], p) for (t, y, *_), p in last])
        made.evaluation = evaluate_runs(compiled, counts, t, q, v, memory, numbers, parts)
    return counts, made

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
    """Check the arguments of Simulation.simulate_many, prepare all runs, integrate them in threads and return the
    Batch.

    A run with invalid parameters, start, times or step is listed in the failures of the Batch and not run. Raises
    BadValueError for arguments that no run can use.
    """
    method, progress = text(method, "method"), function(progress, "progress")
    simulation = simulation.of_method(method, progress)
    compiled, source = simulation.compiled, simulation.source
    names, against = requested_peaks(source, peaks), check_compared_scene(source, against)
    run_arguments = EachRun(compiled, t_end, output, step)
    contours = read_contours(source, contour, runs=True)
    starts = _Starts(simulation, parameters, start, run_arguments, contours)
    stop, side_by_side, level = flag(stop, "stop"), flag(side_by_side, "side_by_side"), audit_level(audit)
    workers = available_threads() if threads is None else threads
    if not is_whole(workers) or workers < 1:
        raise BadValueError(f"threads is {message(threads)}: expected a number of threads, 1 or more")
    workers = int(min(workers, max(len(starts.given), 1)))  # no more than there is to do
    series = _select_stored_series(source, keep)
    selected = method_of(source, method, step is not None)
    tolerance = adaptive.tolerance(rtol, selected, step is not None)
    options = _BatchOptions(selected, tolerance, workers, progress, stop, side_by_side, series, names, against, level)
    p, p_motion, failures = prepare_sets(compiled, starts.given, starts.is_given, selected != "rk4")
    failures |= starts.failures | starts.find_unfit_runs(p, failures)
    times = run_arguments.times(p, starts.t, failures)
    check_room(compiled, times.most, len(p), series, evaluation_parts_of(source, series or ()), workers)
    steps = run_arguments.lengths_of_steps(selected, p, times, failures)
    failures |= run_arguments.failures
    return _run_batch(simulation, starts, (p, p_motion, steps), times, failures, options)


def _select_stored_series(source: KernelSource, keep: str | Iterable[str]) -> tuple[str, ...] | None:
    """Return the checked names of the series to store, without "t"; None if the states are stored (`keep` is "states").

    Raises UnknownNameError or BadValueError for names that the scene does not have.
    """
    if isinstance(keep, str) and keep == STATES:
        return None
    return tuple(name for name in check_series_names(source, keep, "keep") if name != "t")


def _run_batch(
    simulation: Simulation,
    starts: _Starts,
    arrays: tuple[Array, Array, Array],
    times: Times,
    failures: dict[int, Any],
    options: _BatchOptions,
) -> Batch:
    """Run all prepared runs to their ends and return the Batch with its wall time.

    `arrays`: parameter values (n_runs, …), those of the motion without Baumgarte terms, and fixed steps (s).
    `failures`: errors by index of the runs that are left out. A drive that jumps ends its run before the jump, with an
    error.
    """
    p, p_motion, steps = arrays
    jumps = first_jumps(simulation.source, p, starts.t, times.ends().tolist(), failures)
    run_times = times.before({i: end_before(jump, starts.t) for i, jump in jumps.items()})
    stored_series = None if options.keep is None else _StoredSeries(simulation.source, options.keep, len(p), times)
    runs = many.Runs(
        simulation.compiled,
        p,
        p_motion,
        run_times,
        options.method,
        steps,
        options.rtol,
        options.stop,
        options.audit,
        options.side_by_side,
        options.threads,
        stored_series is not None,
        DRIVES.get(options.method),
    )
    runs.begin(starts.states)
    runs.leave_out(failures)
    runs.looks = observers = starts.make_observers(p, failures, options)
    results = _Results(simulation, runs, starts, options, stored_series)
    time_at_begin = time.perf_counter()
    results.run(options.progress)
    for i in (i for i in jumps if i not in runs.failures and runs.is_complete(i)):
        runs.failures[i] = jump_failure(simulation.source, jumps[i])
    warn_unfollowed_in_runs(simulation.source, [*runs.unfollowed.values(), *[{}] * (runs.n - len(runs.unfollowed))])
    results.message = [search.message() if search else Observation() for search in observers]
    batch = _build_batch(results, times)
    return replace(batch, seconds=time.perf_counter() - time_at_begin, threads=options.threads)


@dataclass(frozen=True)
class _BatchOptions:
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
        self,
        simulation: Simulation,
        parameters: ParameterSets,
        start: Any,
        run_arguments: EachRun,
        contours: dict[str, Array],
    ) -> None:
        self.compiled, self.contours = simulation.compiled, contours
        rows, self.failures = rows_of(parameters)
        count = next((len(contour) for contour in contours.values() if contour.ndim == 2), len(rows))
        if count != len(rows) and len(rows) > 1:
            hint = "one contour, or one for every run"
            raise BadValueError(f"contour has {counted(count, 'row')} for {counted(len(rows), 'run')}", hint=hint)
        rows = rows if count == len(rows) else list(rows) * count
        runs = run_arguments.length(len(rows))
        self.states = checked_states(simulation.source, start, runs)
        if len(rows) == 1:
            rows = list(rows) * max(runs, len(self.states))
        if len(rows) != runs:
            run_arguments.length(len(rows))
        self.t = self.states[0].t if self.states else 0.0
        uniform_values = (
            None if self.states or contours else read_uniform_rows(simulation.source, rows)
        )  # then none chooses anything
        self.remarks: list[tuple[str, ...]] = [()] * len(rows) if uniform_values else []
        self.given: Array
        self.is_given: Any
        self.given, self.is_given = uniform_values or each_of(rows, self._merge_parameters)

    def _merge_parameters(self, i: int, parameters: Mapping[str, Any]) -> tuple[Array, Array]:
        """Return values and mask of the parameters given for run i, and append its notes to `remarks`.

        Values of its start state and of its contour are included.
        """
        given, is_given, remarks = numbers(
            self.compiled, self.states[i] if self.states else None, parameters, of_run(self.contours, i)
        )
        self.remarks.append(remarks)
        return given, is_given

    def find_unfit_runs(self, p: Array, failures: Mapping[int, Any]) -> dict[int, Any]:
        """Return the errors by index of runs whose parameter values do not fit their state or start position.

        Runs in `failures` are skipped. Without states, journals that the file places are checked; otherwise only runs
        whose parameters differ from those of their state are checked.
        """
        found: dict[int, Any] = {}
        source = self.compiled.source
        has_journal_positions = (
            source.start_apart or any(joint.at_wall for joint in source.clearances)
        ) and not self.states
        for i in range(len(p) if has_journal_positions or self.states else 0):
            if i in failures:
                continue
            try:
                if has_journal_positions:
                    check_places(self.compiled, p[i])
                elif self.remarks[i]:
                    check_resumable(self.compiled, self.states[i], p[i])
            except AssemblyError as error:
                found[i] = error
        return found

    def make_observers(
        self, p: Array, failures: Mapping[int, Any], options: _BatchOptions
    ) -> list[StepObserver | None]:
        """Return the step observer of each run, None for runs in `failures`; an empty list if no peaks are requested.

        `p`: parameter values (n_runs, …).
        """
        indices = range(len(p) if options.peaks else 0)
        numbers = [(p[i], self.given[i], self.is_given[i]) for i in indices]
        arguments = (options.rtol, options.peaks, options.against)
        return [None if i in failures else make_observer(self.compiled, numbers[i], *arguments) for i in indices]


@dataclass
class _Results:
    """Build the Result of run i from the stored arrays of the batch."""

    simulation: Simulation
    runs: many.Runs
    starts: _Starts
    requested: _BatchOptions
    kept: _StoredSeries | None
    message: Sequence[Observation] = ()  # findings of the step observers by run; empty without observers
    python_notes: dict[int, tuple[str, ...]] = field(default_factory=dict)  # notes of runs that Python has checked

    def run(self, progress: Progress | None) -> None:
        """Integrate all runs. Finished runs are processed at once where series are stored or Python must check them."""
        self.runs.over = self._take if self.kept or self.runs.drive or left_out(self.runs.compiled) else None
        self.runs.run(progress)

    def _take(self, finished: Sequence[int]) -> None:
        """Process finished runs, by index `finished`: record errors that C does not find, and store their requested
        series.

        Results of Python time loops are checked in full. Other runs are checked for contradictory constraints where the
        scene may have them.
        """
        runs = self.runs
        if runs.drive:
            for i in finished:
                result = self._build_checked_result(i)
                if self.kept:
                    self.kept.store_run(runs, i, result)
            return
        for i in finished if left_out(runs.compiled) else ():
            if runs.arrays["done"][i] and (error := contradiction(self._build_problem(i), runs.trajectory(i))):
                runs.failures.setdefault(i, error)
        if self.kept:
            self.kept.take(runs, finished)

    def _build_checked_result(self, i: int) -> Result:
        """Build and return the Result of run i of a Python time loop; record its notes, and an error or interrupt as
        failure.
        """
        problem, trajectory = replace(self._build_problem(i), take=self.runs.take), self.runs.trajectory(i)
        result = build_result(problem, trajectory, self.starts.given[i], self.starts.is_given[i])
        result, error = check_result(problem, trajectory, result)
        if error is None and result.diagnostics.interrupted:
            error = SolverError(INTERRUPTED, float(trajectory.t[-1]))
        if error is not None:
            self.runs.failures.setdefault(i, error)
        self.python_notes[i] = result.diagnostics.notes
        return result

    def _build_problem(self, i: int) -> Problem:
        """Return the Problem of run i with the notes on its start: choices, violated constraints, deep journals."""
        problem, t0, remarks = self.runs.problem(i), self.starts.t, self.starts.remarks[i]
        state = problem.q, problem.v
        if self.starts.states:
            remarks += constraint_violation_notes(problem.compiled, problem.p, t0, *state)
        remarks += parting(problem.compiled, problem.p, t0, *state, problem.memory)
        return replace(problem, remarks=remarks, begun=self.starts.states[i] if self.starts.states else None)

    def __call__(self, i: int) -> Result:
        """Build and return the Result of run i from the stored states, with the findings of its step observer.

        Raises the error of a run that failed. A SolverError has the Result up to there as `partial`.
        """
        runs, error = self.runs, self.runs.failures.get(i)
        if error is not None and not runs.arrays["done"][i]:
            raise error
        given = self.starts.given[i], self.starts.is_given[i]
        result = build_result(self._build_problem(i), runs.trajectory(i), *given, soon=False)
        if self.message:
            self.message[i].to(result)
        if isinstance(error, SolverError):
            error.partial = result
        if error is not None:
            raise error
        return result

    def notes(self) -> dict[int, tuple[str, ...]]:
        """Return the notes of all runs that have any, by index, as far as they are known without evaluating samples.

        They are notes on parameters, left validity ranges, redundant constraints, checks in Python, and step observers.
        """
        x, source, n = self.runs.arrays, self.simulation.source, self.simulation.compiled.n
        peaks, counted = x["peaks"][:, : len(source.clearances)], counts_of_runs(x["counts"], x["residuals"])
        size = mechanism_sizes(source, x["p"])
        in_question = may_leave_range(source, x["p"], size, counted["phi_max"], peaks) & (x["done"] > 0)
        found = {i: remarks for i, remarks in enumerate(self.starts.remarks) if remarks}
        for i in np.flatnonzero(in_question).tolist():
            q0, counts, t0 = x["start"][i, :n], self.runs.counts(i), float(self.runs.times.of(i)[0])
            message = range_notes(self.simulation.compiled, x["p"][i], t0, q0, counts, peaks[i])
            found[i] = (*found.get(i, ()), *message)
        for i in np.flatnonzero(x["done"] > 0).tolist() if source.indeterminate else ():
            found[i] = (*found.get(i, ()), *indeterminate(source))
        found |= self.python_notes
        for i, observation in enumerate(self.message):
            found[i] = (*found.get(i, ()), *observation.notes)
        return found

    def bare(self, i: int, parts: frozenset[str]) -> EvaluatedSamples | None:
        """Return the samples of run i without diagnostics, for evaluating `parts` of its equations; None if it has no
        samples.

        The start is left out if it was not requested as a sample. Batch evaluates series from it (ResultOf).
        """
        samples = _build_samples(self.runs, i, parts)
        return without_start(samples) if samples and self.runs.times.skipped[i] else samples


def _build_batch(results: _Results, times: Times) -> Batch:
    """Return the Batch of all runs at the requested output times; arrays are not copied.

    With stored series, the states of all runs are released. Wall time and threads are set by the caller.
    """
    runs, source, stored_series = results.runs, results.simulation.source, results.kept
    x, n, joints = runs.arrays, results.simulation.compiled.n, len(source.clearances)
    without_samples = np.flatnonzero((x["done"] == 1) & (times.skipped == 1))  # the start is all that they have
    for rows in stored_series.arrays.values() if stored_series else (x["y"], x["state"]):
        rows[without_samples, 1:2] = rows[without_samples, :1]
    states = None
    if stored_series:
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
        kept={name: times.without_starts(rows) for name, rows in stored_series.arrays.items()} if stored_series else {},
        extremes=tuple(message.extremes for message in results.message),
        rubbed=tuple(message.rubbed for message in results.message),
    )


class _StoredSeries:
    """Store requested series as arrays (n, N) by name, and "t"; NaN where a run has no sample."""

    def __init__(self, source: KernelSource, names: tuple[str, ...], n: int, times: Times) -> None:
        self.names, self.parts = ("t", *names), evaluation_parts_of(source, names)
        self.arrays = {name: np.full((n, times.most), np.nan) for name in self.names}
        known = [catalogue(source)[name] for name in names if name != "t"]
        self.columns = all(one.stored or one.evaluated for one in known)  # none of them reads a run's own numbers

    def take(self, runs: Runs, finished: Sequence[int]) -> None:
        """Store the series of the finished runs with indices `finished`, all at once where their equations allow it.

        Runs without samples are skipped. A run whose series cannot be computed is recorded as failed.
        """
        with_samples = [i for i in finished if runs.arrays["done"][i]]
        if len(with_samples) > 1 and self.columns:
            try:
                self._take(with_samples, *_concatenate_samples(runs, with_samples, self.parts))
                return
            except SolverError:  # of one of them: alone it says which
                pass
        for i in with_samples:
            if run := _build_samples(runs, i, self.parts):
                self.store_run(runs, i, run)

    def store_run(self, runs: Runs, i: int, run: Result) -> None:
        """Store the series of run i from its Result. An error of their evaluation is recorded as the run's failure."""
        try:
            self._take([i], [len(run.t)], run, int(run.start_row is not None))
        except SolverError as error:
            runs.failures.setdefault(i, error)

    def _take(self, indices: Sequence[int], counts: Sequence[int], result: Result, first_column: int = 0) -> None:
        """Copy samples of several runs, concatenated in the result `result`, into the rows of the stored arrays.

        counts[k] samples belong to run begun[k]. `first_column`: first column that is filled.
        """
        columns, first = [(self.arrays[name], result[name]) for name in self.names], 0
        for i, count in zip(indices, counts, strict=True):
            for kept, column in columns:
                kept[i, first_column : first_column + count] = column[first : first + count]
            first += count


def _build_samples(runs: Runs, i: int, parts: frozenset[str]) -> EvaluatedSamples | None:
    """Return the stored samples of run i as a result without diagnostics; None if it has no samples.

    `parts`: names of the evaluated quantities that its series need. Accelerations are those of the method, if stored.
    """
    if not runs.arrays["done"][i]:
        return None
    n, source, p = runs.compiled.n, runs.compiled.source, runs.arrays["p"][i]
    t, y, memory, state = runs.samples(i)
    result = bare(source, runs.compiled, p, t, y[:, :n], y[:, n : 2 * n], y[:, 2 * n :], memory, state, parts)
    result.accelerations = runs.accelerations(i)
    return result


def _concatenate_samples(
    runs: Runs, indices: Sequence[int], parts: frozenset[str]
) -> tuple[list[int], EvaluatedSamples]:
    """Return the sample counts of the runs `indices`, and all their samples concatenated in one result.

    If `parts` is not empty, these quantities are evaluated with each run's parameter values.
    """
    compiled, n, samples_of_runs = runs.compiled, runs.compiled.n, [runs.samples(i) for i in indices]
    counts = [len(samples[0]) for samples in samples_of_runs]
    t, y, memory, state = (np.concatenate(arrays) for arrays in zip(*samples_of_runs, strict=True))
    q, v = y[:, :n], y[:, n : 2 * n]
    no_parameters = np.full(compiled.n_p, np.nan)
    result = bare(compiled.source, compiled, no_parameters, t, q, v, y[:, 2 * n :], memory, state, parts)
    if parts:
        numbers = runs.arrays["p"][indices]
        if compiled.may_switch:
            last = zip(samples_of_runs, numbers, strict=True)
            t = np.concatenate([evaluation_times(compiled, t, y[:, :n], y[:, n : 2 * n], p) for (t, y, *_), p in last])
        result.evaluation = evaluate_runs(compiled, counts, t, q, v, memory, numbers, parts)
    return counts, result

"""Simulate many parameter sets of one scene in threads: `Simulation.simulate_many`."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.assembly.guess_warnings import warn_guess_deviations_in_runs
from gudgeon.assembly.journals import check_journal_positions, describe_contacts_with_assumed_approach_speed
from gudgeon.assembly.rank import find_constraint_violation, list_redundant_equations
from gudgeon.errors import AssemblyError, BadValueError, SolverError
from gudgeon.integrators import adaptive
from gudgeon.integrators.batch import Runs
from gudgeon.integrators.failure import INTERRUPTED
from gudgeon.integrators.threads import count_available_threads
from gudgeon.integrators.times import Times
from gudgeon.integrators.trajectory import Problem, Progress, convert_counts_of_runs
from gudgeon.language.argument_checks import check_callable, check_flag, check_text, is_integer, shorten_value
from gudgeon.language.text_output import format_count
from gudgeon.model.baumgarte import has_baumgarte_terms
from gudgeon.model.compiled import Array
from gudgeon.model.contours import read_contours, select_contours_of_run
from gudgeon.model.evaluation import check_sample_memory
from gudgeon.model.parameter_sets import (
    ParameterSets,
    compute_parameter_values_of_runs,
    read_parameter_sets,
    read_parameters_of_runs,
    read_runs_with_equal_names,
)
from gudgeon.model.sizes import compute_mechanism_sizes
from gudgeon.results.batch import (
    STATES,
    Batch,
    States,
    collect_given_values,
    find_evaluation_fields,
    make_failures,
)
from gudgeon.results.peaks import build_peak_records
from gudgeon.results.results import EvaluatedSamples, Result, State
from gudgeon.results.samples import split_off_start
from gudgeon.simulation.arguments import PYTHON_TIME_LOOPS, select_method
from gudgeon.simulation.audit import parse_audit_level
from gudgeon.simulation.batch_arguments import BatchArguments
from gudgeon.simulation.hidden_jumps import build_jump_error, compute_end_before_jump, find_first_jumps
from gudgeon.simulation.restart import build_violation_notes, check_resumed_state, copy_checked_states, merge_parameters
from gudgeon.simulation.result_builder import (
    build_result,
    check_result,
    may_exceed_validity_range,
    yield_missing_mass_note,
    yield_range_notes,
    yield_redundancy_note,
)
from gudgeon.simulation.step_observers import (
    Observation,
    StepObserver,
    check_compared_scene,
    check_requested_peaks,
    make_observer,
)
from gudgeon.simulation.stored_series import StoredSeries, build_samples, select_stored_series
from gudgeon.simulation.suspect_runs import SuspectRuns

if TYPE_CHECKING:
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
    method, progress = check_text(method, "method"), check_callable(progress, "progress")
    simulation = simulation.of_method(method, progress, rtol, step is not None)
    compiled, source = simulation.compiled, simulation.source
    names, against = check_requested_peaks(source, peaks), check_compared_scene(source, against)
    run_arguments = BatchArguments(compiled, t_end, output, step)
    contours = read_contours(source, contour, allows_runs=True)
    starts = _Starts(simulation, parameters, start, run_arguments, contours)
    stop, side_by_side, level = (
        check_flag(stop, "stop"),
        check_flag(side_by_side, "side_by_side"),
        parse_audit_level(audit),
    )
    workers = count_available_threads() if threads is None else threads
    if not is_integer(workers) or workers < 1:
        raise BadValueError(f"threads is {shorten_value(threads)}: expected a number of threads, 1 or more")
    workers = int(min(workers, max(len(starts.given), 1)))  # at most one thread per run
    series = select_stored_series(source, keep)
    selected = select_method(source, method, step is not None)
    tolerance = adaptive.parse_tolerance(rtol, selected, step is not None)
    options = _BatchOptions(selected, tolerance, workers, progress, stop, side_by_side, series, names, against, level)
    p, p_motion, failures = compute_parameter_values_of_runs(
        compiled, starts.given, starts.is_given, not has_baumgarte_terms(source, selected)
    )
    failures |= starts.failures | starts.find_runs_with_invalid_start(p, failures)
    times = run_arguments.compute_times(p, starts.t, failures)
    check_sample_memory(
        compiled, times.max_count, len(p), series, find_evaluation_fields(source, series or ()), workers
    )
    steps = run_arguments.compute_steps(selected, p, times, failures)
    failures |= run_arguments.failures
    return _run_batch(simulation, starts, (p, p_motion, steps), times, failures, options)


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
    jumps = find_first_jumps(simulation.source, p, starts.t, times.get_ends().tolist(), failures)
    run_times = times.cut_times_before({i: compute_end_before_jump(jump, starts.t) for i, jump in jumps.items()})
    stored_series = None if options.keep is None else StoredSeries(simulation.source, options.keep, len(p), times)
    runs = Runs(
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
        PYTHON_TIME_LOOPS.get(options.method),
    )
    runs.set_starts(starts.states)
    runs.exclude_runs(failures)
    runs.observers = observers = starts.make_observers(p_motion, failures, options)
    results = _Results(simulation, runs, starts, options, stored_series)
    time_at_begin = time.perf_counter()
    results.integrate_runs(options.progress)
    for i in (i for i in jumps if i not in runs.failures and runs.is_complete(i)):
        runs.failures[i] = build_jump_error(simulation.source, jumps[i])
    warn_guess_deviations_in_runs(
        simulation.source, [*runs.guess_deviations.values(), *[{}] * (runs.n - len(runs.guess_deviations))]
    )
    results.observations = [search.build_observation() if search else Observation() for search in observers]
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
    """Hold the parameter values (n_runs, n_parameters), start states and notes of all runs.

    `failures`: errors of runs with invalid parameters, by index. `nonfinite_values`: values {name: value} of these runs
    that are NaN or infinite, which are not in the others. Without states, runs begin at t = 0.
    """

    def __init__(
        self,
        simulation: Simulation,
        parameters: ParameterSets,
        start: Any,
        run_arguments: BatchArguments,
        contours: dict[str, Array],
    ) -> None:
        self.compiled, self.contours = simulation.compiled, contours
        rows, self.failures, self.nonfinite_values = read_parameter_sets(parameters)
        count = next((len(contour) for contour in contours.values() if contour.ndim == 2), len(rows))
        if count != len(rows) and len(rows) > 1:
            hint = "one contour, or one for every run"
            raise BadValueError(
                f"contour has {format_count(count, 'row')} for {format_count(len(rows), 'run')}", hint=hint
            )
        rows = rows if count == len(rows) else list(rows) * count
        runs = run_arguments.count_runs(len(rows))
        self.states = copy_checked_states(simulation.source, start, runs)
        if len(rows) == 1:
            rows = list(rows) * max(runs, len(self.states))
        if len(rows) != runs:
            run_arguments.count_runs(len(rows))
        self.t = self.states[0].t if self.states else 0.0
        uniform_values = (
            None if self.states or contours else read_runs_with_equal_names(simulation.source, rows)
        )  # not None: no run has notes on choices
        self.notes_of_starts: list[tuple[str, ...]] = [()] * len(rows) if uniform_values else []
        self._merged_inputs: tuple[object, ...] = (self, self)  # of the last run: its parameters, those of its state
        self.given: Array
        self.is_given: Any
        self.given, self.is_given = uniform_values or read_parameters_of_runs(rows, self._merge_parameters)

    def collect_given_values(self, p: Array) -> dict[str, Array]:
        """Return the values (n_runs,) that runs were given, NaN and infinite ones too, by address; choices as names.

        `p` (n_runs, …): parameter values of the runs.
        """
        source = self.compiled.source
        p, is_given = (p.copy(), self.is_given.copy()) if self.nonfinite_values else (p, self.is_given)
        for i, values in self.nonfinite_values.items():
            for name, value in values.items():
                address = name if name in source.parameter_indices else f"parameters.{name}"
                k = source.parameter_indices.get(address)
                if k is not None and not source.parameters[k].words:
                    p[i, k], is_given[i, k] = value, True
        return collect_given_values(source, p, is_given)

    def _merge_parameters(self, i: int, parameters: Mapping[str, Any]) -> tuple[Array, Array]:
        """Return values and mask (n_parameters,) of the parameters that are given for run i, and append its notes.

        Given are the entries of `parameters`, those of the start state of the run, and its contour; other values are
        not set. The notes go to `notes_of_starts`. The result of the last run is returned again if the inputs are the
        same objects and no contours are given.
        """
        state = self.states[i] if self.states else None
        inputs = parameters, state.parameters if state else None
        if self.contours or any(x is not y for x, y in zip(inputs, self._merged_inputs, strict=True)):
            contours = select_contours_of_run(self.contours, i)
            self._merged = merge_parameters(self.compiled, state, parameters, contours)
            self._merged_inputs = inputs
        given, is_given, notes = self._merged
        self.notes_of_starts.append(notes)
        return given, is_given

    def find_runs_with_invalid_start(self, p: Array, failures: Mapping[int, Any]) -> dict[int, Any]:
        """Return the errors of runs whose start contradicts their parameter values p (n_runs, …), by index.

        Runs in `failures` are skipped. Without states, journals that the file places are checked; otherwise only runs
        whose parameters differ from those of their state are checked.
        """
        errors: dict[int, Any] = {}
        source = self.compiled.source
        has_journal_positions = (
            source.eccentricity_equations or any(joint.is_corner for joint in source.clearances)
        ) and not self.states
        for i in range(len(p) if has_journal_positions or self.states else 0):
            if i in failures:
                continue
            try:
                if has_journal_positions:
                    check_journal_positions(self.compiled, p[i])
                elif self.notes_of_starts[i]:
                    check_resumed_state(self.compiled, self.states[i], p[i])
            except AssemblyError as error:
                errors[i] = error
        return errors

    def make_observers(
        self, p: Array, failures: Mapping[int, Any], options: _BatchOptions
    ) -> list[StepObserver | None]:
        """Return the step observer of each run, None for runs in `failures`; an empty list if no peaks are requested.

        `p`: parameter values (n_runs, …).
        """
        indices = range(len(p) if options.peaks else 0)
        parameter_values = [(p[i], self.given[i], self.is_given[i]) for i in indices]
        arguments = (options.rtol, options.peaks, options.against)
        return [
            None if i in failures else make_observer(self.compiled, parameter_values[i], *arguments) for i in indices
        ]


@dataclass
class _Results:
    """Integrate the runs of a batch, and build the Result of run i from the stored arrays when it is requested."""

    simulation: Simulation
    runs: Runs
    starts: _Starts
    options: _BatchOptions
    stored_series: StoredSeries | None
    observations: Sequence[Observation] = ()  # findings of the step observers by run; empty without observers
    python_notes: dict[int, tuple[str, ...]] = field(default_factory=dict)  # notes of runs that Python has checked

    def __post_init__(self) -> None:
        """Choose the samples that C audits in kinematic runs, and the runs that Python checks."""
        self._suspects = SuspectRuns(self.runs, bool(self.starts.states))

    def integrate_runs(self, progress: Progress | None) -> None:
        """Integrate all runs; process them as they finish where series are stored or Python must check them.

        In kinematic ensembles without observers, C stores the series of the motion. `progress` None: no progress is
        reported.
        """
        if self.stored_series and self.runs.kinematic and not (self.runs.observers or self._suspects.checks_all):
            self.stored_series.pass_arrays_to_c(self.runs.kinematic)
        self.runs.store_results = (
            self._process_finished_runs
            if self.stored_series or self.runs.python_loop or list_redundant_equations(self.runs.compiled)
            else None
        )
        self.runs.integrate_all_runs(progress)

    def _process_finished_runs(self, finished_runs: Sequence[int]) -> None:
        """Store the requested series of finished runs, given by index, and record errors that C does not find.

        With a Python time loop, the runs that SuspectRuns selects are checked in full. Otherwise runs are checked for
        violated redundant constraints if the scene has them.
        """
        runs = self.runs
        if runs.python_loop:
            suspects = self._suspects.select_runs_to_check(finished_runs)
            for i in runs.recompute_runs_in_full(suspects):
                result = self._build_checked_result(i)
                if self.stored_series:
                    self.stored_series.store_run(runs, i, result)
            finished_runs = [i for i in finished_runs if i not in suspects] if suspects else finished_runs
        else:
            self._check_redundant_constraints(finished_runs)
        if self.stored_series:
            self.stored_series.store_finished_runs(runs, finished_runs)

    def _check_redundant_constraints(self, finished_runs: Sequence[int]) -> None:
        """Record an error for each finished run with samples that violates a redundant constraint equation."""
        runs = self.runs
        for i in finished_runs if list_redundant_equations(runs.compiled) else ():
            if runs.arrays["done"][i] and (
                error := find_constraint_violation(self._build_problem(i), runs.build_trajectory(i))
            ):
                runs.failures.setdefault(i, error)

    def _build_checked_result(self, i: int) -> Result:
        """Build the Result of run i of a Python time loop; record its notes, and an error or interrupt as failure."""
        problem, trajectory = (
            replace(self._build_problem(i), poll_cancellation=self.runs.poll_cancellation),
            self.runs.build_trajectory(i),
        )
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
        problem, t0, remarks = self.runs.build_problem(i), self.starts.t, self.starts.notes_of_starts[i]
        state = problem.q, problem.v
        if self.starts.states:
            remarks += build_violation_notes(problem.compiled, problem.p, t0, *state)
        remarks += describe_contacts_with_assumed_approach_speed(
            problem.compiled, problem.p, t0, *state, problem.memory
        )
        return replace(problem, remarks=remarks, resumed_state=self.starts.states[i] if self.starts.states else None)

    def __call__(self, i: int) -> Result:
        """Build and return the Result of run i from the stored states, with the findings of its step observer.

        Raises the error of a run that failed. A SolverError has the Result up to there as `partial`.
        """
        runs, error = self.runs, self.runs.failures.get(i)
        if error is not None and not runs.arrays["done"][i]:
            raise error
        given = self.starts.given[i], self.starts.is_given[i]
        result = build_result(self._build_problem(i), runs.build_trajectory(i), *given, is_time_limited=False)
        if self.observations:
            self.observations[i].store_in(result)
        if isinstance(error, SolverError):
            error.partial = result
        if error is not None:
            raise error
        return result

    def notes(self) -> dict[int, tuple[str, ...]]:
        """Return the notes of all runs that have any, by index, as far as they are known without evaluating samples.

        They are notes on parameters, left validity ranges, redundant constraints, checks in Python, and step observers.
        """
        arrays, source, n = self.runs.arrays, self.simulation.source, self.simulation.compiled.n
        peaks, counted = (
            arrays["peaks"][:, : len(source.clearances)],
            convert_counts_of_runs(arrays["counts"], arrays["residuals"]),
        )
        size = compute_mechanism_sizes(source, arrays["p"])
        may_be_outside = may_exceed_validity_range(source, arrays["p"], size, counted["phi_max"], peaks) & (
            arrays["done"] > 0
        )
        notes_by_run = {i: remarks for i, remarks in enumerate(self.starts.notes_of_starts) if remarks}
        for i in np.flatnonzero(may_be_outside).tolist():
            q0, counts, t0 = arrays["start"][i, :n], self.runs.get_counts(i), float(self.runs.times.get_times(i)[0])
            range_notes = yield_range_notes(self.simulation.compiled, arrays["p"][i], t0, q0, counts, peaks[i])
            notes_by_run[i] = (*notes_by_run.get(i, ()), *range_notes)
        for i in np.flatnonzero(arrays["done"] > 0).tolist() if source.massless_bodies else ():
            notes_by_run[i] = (*notes_by_run.get(i, ()), *yield_missing_mass_note(source))
        for i in np.flatnonzero(arrays["done"] > 0).tolist() if source.indeterminate else ():
            notes_by_run[i] = (*notes_by_run.get(i, ()), *yield_redundancy_note(source))
        notes_by_run |= self.python_notes
        for i, observation in enumerate(self.observations):
            notes_by_run[i] = (*notes_by_run.get(i, ()), *observation.notes)
        return notes_by_run

    def build_run_samples(self, i: int, field_names: frozenset[str]) -> EvaluatedSamples | None:
        """Return the samples of run i without diagnostics, for evaluating the fields `field_names` of an Evaluation;
        None if it has no samples.

        The start is left out if it was not requested as a sample. Batch evaluates series from it (ResultOf).
        """
        samples = build_samples(self.runs, i, field_names)
        return split_off_start(samples) if samples and self.runs.times.n_skipped[i] else samples


def _build_batch(results: _Results, times: Times) -> Batch:
    """Return the Batch of all runs at the requested output times; arrays are not copied.

    With stored series, the states of all runs are released. Wall time and threads are set by the caller.
    """
    runs, source, stored_series = results.runs, results.simulation.source, results.stored_series
    arrays, n, joints = runs.arrays, results.simulation.compiled.n, len(source.clearances)
    if stored_series:
        stored_series.fill_times_and_gaps(runs)
    without_samples = np.flatnonzero((arrays["done"] == 1) & (times.n_skipped == 1))  # runs that have only their start
    for rows in (
        (stored_series.arrays.values() if stored_series else (arrays["y"], arrays["state"]))
        if len(without_samples)
        else ()
    ):
        rows[without_samples, 1:2] = rows[without_samples, :1]
    states = None
    if stored_series:
        runs.release_samples()
    else:
        y, state = times.select_requested_samples(arrays["y"]), times.select_requested_samples(arrays["state"])
        work = np.full_like(y[:, :, 2 * n :], np.nan) if source.massless_bodies else y[:, :, 2 * n :]
        states = States(y[:, :, :n], y[:, :, n : 2 * n], work, state[:, :, :joints])
    counts_by_name = {**convert_counts_of_runs(arrays["counts"], arrays["residuals"]), "seconds": arrays["seconds"]}
    return Batch(
        source=source,
        t=times.get_requested_times(),
        states=states,
        samples=arrays["done"] - times.n_skipped * (arrays["done"] > 1),
        t_last=arrays["t_last"],
        parameters=results.starts.collect_given_values(arrays["p"]),
        impacts=runs.list_contacts(),
        events=runs.list_events(),
        peaks=build_peak_records(arrays["peaks"][:, :joints], runs.contacts, np.diff(runs.first_contact_indices)),
        diagnostics=counts_by_name,
        failures=make_failures(runs.failures),
        seconds=math.nan,
        threads=0,
        interrupted=runs.interrupted,
        result=results,
        kept={name: times.select_requested_samples(rows) for name, rows in stored_series.arrays.items()}
        if stored_series
        else {},
        extremes=tuple(observation.extremes for observation in results.observations),
        sliding_loads=tuple(observation.sliding_loads for observation in results.observations),
    )

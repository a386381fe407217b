"""Run one block of a study, a batch of runs that one process computes, and return a picklable result."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource, RuntimeParameter
from gudgeon.errors import BadValueError, GudgeonError, InputError, UnknownNameError
from gudgeon.integrators.lanes import announce_later_runs
from gudgeon.language.tree import Expr
from gudgeon.model.default_step import evaluate_scene_end_time, evaluate_scene_option
from gudgeon.model.parameter_sets import compute_parameter_values_of_runs, read_given_parameters_of_runs
from gudgeon.results.batch import Array
from gudgeon.simulation.arguments import DEFAULT_OUTPUT
from gudgeon.simulation.simulation import Simulation
from gudgeon.simulation.wear import parse_wear_rate
from gudgeon.simulation.wear_loop import WearLoop, WearModel, scale_progress
from gudgeon.studies.ensemble.exponents import compute_neighbour_measures
from gudgeon.studies.ensemble.libraries import get_method_for_scene, load_library
from gudgeon.studies.ensemble.measures import (
    Spans,
    evaluate_measure,
    find_sampled_interval,
    is_in_window,
    list_peak_series,
    list_sampled_series,
    list_sliding_requests,
)
from gudgeon.studies.ensemble.notes import Note, collect_start_deviation_warnings, group_notes, merge_notes
from gudgeon.studies.ensemble.parameter_values import (
    ROUNDING,
    evaluate_expression_for_runs,
    find_out_of_range_values,
    find_parameter,
    find_parameter_key,
    parse_real_value,
    to_python_value,
)
from gudgeon.studies.ensemble.reference_series import (
    compute_reference_series,
    find_reference_scene_of_steps,
    load_reference_scene,
)

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import Measure, WearRounds
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.batch import Batch


@dataclass(frozen=True)
class RunSettings:
    """Settings of all runs of a study; an expression None means the value of the scene."""

    t_end: Expr | None
    output: Expr | None
    step: Expr | None
    windows: Mapping[str, tuple[Expr | None, ...]]  # begin and end
    measures: tuple[Measure, ...]
    keep: tuple[str, ...]
    method: str
    rtol: float | None
    stop: bool
    wear: WearModel | None = None
    wear_rounds: int = 0  # rounds of wear before the measured runs


@dataclass(frozen=True, eq=False)
class Job:
    """Task of a worker: the inputs of n runs of one scene, picklable.

    columns: parameter values, (n,) each, by name. relative, absolute: deviations of perturbed parameters, (n,) each.
    """

    mechanism: str
    scene: str
    overrides: tuple[tuple[str, str], ...]
    sha256: str
    block_number: int
    first_run: int  # index in the study
    n_runs: int
    columns: Mapping[str, Array]
    relative: Mapping[str, Array]
    absolute: Mapping[str, Array]
    run_settings: RunSettings
    threads: int | None
    n_later_runs: int = 0  # runs of the same scene in later blocks


@dataclass(frozen=True, eq=False)
class Block:
    """Results of n runs; `t` is (N,) if all runs that began have the same times, else (n, N)."""

    number: int
    first_run: int  # index in the study
    measures: Mapping[str, Array]  # (n,)
    failures: tuple[str, ...]  # reason of the failure of each run, "" for none
    t_last: Array  # (n,) s, end of each run; NaN: it did not begin
    t: Array  # sample times; empty if no series is stored
    series: Mapping[str, Array]  # stored series, (n, N)
    notes: Mapping[str, Note] = field(default_factory=dict)  # by kind

    @property
    def nbytes(self) -> int:
        """Return the memory of all arrays of the block, bytes."""
        return sum(array.nbytes for array in (self.t_last, self.t, *self.measures.values(), *self.series.values()))


def run_block(job: Job, progress: Progress | None = None, simulation: Simulation | None = None) -> Block:
    """Simulate all runs of a job as a batch, evaluate their measures, and return the results as a Block.

    simulation: the loaded scene; None loads its library, as worker processes do. Runs with invalid parameters get a
    reason and no results. If simulate_many rejects the batch, the runs are simulated one by one to find the invalid
    one. Raises KeyboardInterrupt if Ctrl-C ended a run.
    """
    simulation = simulation or load_library(job.mechanism, job.scene, job.overrides, job.sha256)
    table = RunTable(simulation, job)
    failures = [table.invalid_runs.get(i, "") for i in range(job.n_runs)]
    valid_runs = np.array([i for i in range(job.n_runs) if i not in table.invalid_runs], dtype=int)
    collector = _Collector(job, table)
    with (
        collect_start_deviation_warnings(simulation.source, job.first_run) as start_deviation_notes,
        announce_later_runs(job.n_later_runs),
    ):
        try:
            if len(valid_runs):
                collector.add_batch(
                    valid_runs, _simulate_block_runs(simulation, job, table, valid_runs, progress), failures
                )
        except InputError:  # usually caused by one run: simulate the runs one by one
            for i in valid_runs:
                try:
                    collector.add_batch(
                        np.array([i]), _simulate_block_runs(simulation, job, table, np.array([i]), None), failures
                    )
                except InputError as error:
                    failures[i] = str(error)
    collector.notes.append(start_deviation_notes)
    collector.add_measures(
        compute_neighbour_measures(simulation, job, table, collector.t_last, failures, progress), failures
    )
    return collector.build_block(failures)


class RunTable:
    """Evaluated parameters, end times, outputs, steps and windows of all runs of a job, and reasons of invalid runs."""

    def __init__(self, simulation: Simulation, job: Job) -> None:
        """Evaluate parameters, end time, output, step and windows of all runs of a job.

        Invalid values do not raise: `invalid_runs` maps the index of such a run to the reason.
        """
        self.source, self.compiled, settings = simulation.source, simulation.compiled, job.run_settings
        self.invalid_runs: dict[int, str] = {}
        self.columns = {
            key: values for name, values in job.columns.items() if (key := find_parameter_key(self.source, name))
        }
        self.p, errors = self._prepare_parameter_vectors(job.n_runs)
        if perturbed_columns := self._compute_perturbed_parameters(job):
            self.columns |= perturbed_columns
            self.p, errors = self._prepare_parameter_vectors(job.n_runs)
        self.invalid_runs |= {i: str(error) for i, error in errors.items() if i not in self.invalid_runs}
        self.t_end = self._evaluate_end_times(settings.t_end)
        values_by_name = {"t_end": self.t_end}
        self.output = self._evaluate_output_counts(settings.output, values_by_name)
        self.step: Array | None = None
        if settings.step is not None and self.source.degrees_of_freedom:
            self.step = evaluate_expression_for_runs(self.source, settings.step, self.p, values_by_name)
            self._record_invalid_runs("step", self.step)
        self.spans = self._evaluate_windows(settings.windows, values_by_name)

    def _compute_perturbed_parameters(self, job: Job) -> dict[str, Array]:
        """Return the values of the perturbed parameters by key, p (1 + relative) + absolute, (n,) each.

        Parameters that the scene lacks are left out. Empty for a job without deviations.
        """
        index_of_address, parameters = (
            {parameter.address: k for k, parameter in enumerate(self.source.parameters)},
            dict[str, Array](),
        )
        for name in dict.fromkeys((*job.relative, *job.absolute)):
            if (parameter := find_parameter(self.source, name)) is None:
                continue
            base, key, zero = (
                self.p[:, index_of_address[parameter.address]],
                find_parameter_key(self.source, name),
                np.zeros(job.n_runs),
            )
            deviation = base * job.relative.get(name, zero) + job.absolute.get(name, zero)
            # two ensembles may name the same parameter differently, as "c" and "parameters.c"
            parameters[key] = parameters.get(key, base) + deviation
        return parameters

    def _prepare_parameter_vectors(self, n_runs: int) -> tuple[Array, Mapping[int, GudgeonError]]:
        """Return the parameter vectors p of all runs, (n_runs, n_p), and the errors of runs with invalid values, by
        run.

        A value that is not finite is replaced by the default, and its run is entered in `invalid_runs`.
        """
        rows: list[dict[str, float | str]] = [{} for _ in range(n_runs)]
        for name, column in self.columns.items():
            for i, value in enumerate(map(to_python_value, column)):
                if isinstance(value, str) or math.isfinite(value):
                    rows[i][name] = value
                else:
                    self.invalid_runs.setdefault(i, f"{name} is {value}: expected a finite number")
        given, is_given = read_given_parameters_of_runs(self.source, rows)
        p, _, errors = compute_parameter_values_of_runs(self.compiled, given, is_given, False)
        return p, errors

    def _evaluate_windows(
        self, windows: Mapping[str, tuple[Expr | None, ...]], known_values: Mapping[str, Array]
    ) -> Spans:
        """Return begin and end of each window by name, (n,) s each; None for an end that the study does not specify.

        known_values: values of further names in the expressions, such as t_end. A run that does not overlap its window
        is entered in `invalid_runs`.
        """
        spans: dict[str, tuple[Array | None, ...]] = {}
        for name, ends in windows.items():
            ends_of_runs = [
                None if expr is None else evaluate_expression_for_runs(self.source, expr, self.p, known_values)
                for expr in ends
            ]
            limits = zip(ends_of_runs, (np.zeros_like(self.t_end), self.t_end), strict=True)
            begin, end = (limit if x is None else x for x, limit in limits)
            is_valid = (begin <= end) & (begin <= self.t_end * (1 + ROUNDING)) & (end >= 0.0)
            for i in np.flatnonzero(~is_valid).tolist():
                message = f"window {name} is from {begin[i]:g} s to {end[i]:g} s with the parameters of this run"
                self.invalid_runs.setdefault(i, f"{message}: expected a part of the run, to {self.t_end[i]:g} s")
            spans[name] = tuple(ends_of_runs)
        return spans

    def _record_invalid_runs(self, name: str, values: Array) -> None:
        """Enter the runs with an impossible value of the setting `name` in `invalid_runs`, with value and expected
        range.

        name: "t_end", "output" or "step". A run that is entered already keeps its first reason.
        """
        is_impossible, expected = find_out_of_range_values(name, values)
        for i in np.flatnonzero(is_impossible).tolist():
            message = f"{name} is {values[i]:g} with the parameters of this run: expected {expected}"
            self.invalid_runs.setdefault(i, message)

    def _evaluate_end_times(self, expr: Expr | None) -> Array:
        """Return the end time of each run, (n,) s, from the study's expression, or from the scene if `expr` is None.

        Runs with an impossible end time are entered in `invalid_runs`.
        """
        if expr is not None:
            end_times = evaluate_expression_for_runs(self.source, expr, self.p, {})
            self._record_invalid_runs("t_end", end_times)
            return end_times
        return self._evaluate_for_each_run(lambda p: evaluate_scene_end_time(self.source, p))

    def _evaluate_output_counts(self, expr: Expr | None, known_values: Mapping[str, Array]) -> Array:
        """Return the number of output intervals of each run, (n,), as floats with integer values.

        expr: expression of the study, whose values are rounded; None means the number of the scene. known_values:
        values of further names in it. Runs with an impossible number are entered in `invalid_runs`.
        """
        if expr is None:
            return self._evaluate_for_each_run(
                lambda p: evaluate_scene_option(self.source, "output", p, DEFAULT_OUTPUT)
            )
        counts = np.rint(evaluate_expression_for_runs(self.source, expr, self.p, known_values))
        self._record_invalid_runs("output", counts)
        return counts

    def _evaluate_for_each_run(self, compute_value: Any) -> Array:
        """Return `compute_value(p)` for the parameter vector p of each run, (n,); NaN for runs in `invalid_runs`.

        A run for which it raises BadValueError is entered in `invalid_runs`.
        """
        values = np.full(len(self.p), np.nan)
        for i in range(len(self.p)):
            try:
                if i not in self.invalid_runs:
                    values[i] = compute_value(self.p[i])
            except BadValueError as error:
                self.invalid_runs[i] = str(error)
        return values


def _simulate_block_runs(
    simulation: Simulation, job: Job, table: RunTable, runs: Array, progress: Progress | None
) -> Batch:
    """Simulate some runs of a job as one batch, after its rounds of wear, and return the batch.

    runs: indices within the job. If the study stores no series and no measure needs samples of whole runs, only samples
    within the windows are stored. Raises KeyboardInterrupt if Ctrl-C ended a run, InputError for invalid parameters.
    """
    settings, ends, counts = job.run_settings, table.t_end[runs], table.output[runs].astype(int)
    spans = None if settings.keep else find_sampled_interval(settings.measures, table.spans, runs)
    same_times = spans is None and len(set(counts.tolist())) == 1
    output: Any = int(counts[0])
    if not same_times:
        output = [np.linspace(0.0, end, k + 1) for end, k in zip(ends, counts, strict=True)]
        output = (
            output
            if spans is None
            else [_select_stored_times(t, *span) for t, *span in zip(output, *spans, strict=True)]
        )
    same_end = len(set(ends.tolist())) == 1
    t_end: Any = None if not same_times else float(ends[0]) if same_end else ends
    parameters: Any = {name: list(map(to_python_value, values[runs])) for name, values in table.columns.items()}
    source, step = simulation.source, None if table.step is None else table.step[runs]
    reference_scene, sliding = (
        find_reference_scene_of_steps(settings.measures, source),
        list_sliding_requests(settings.measures, source),
    )
    options: dict[str, Any] = {
        "method": get_method_for_scene(source, settings.method),
        "rtol": settings.rtol if source.degrees_of_freedom else None,
        "step": step,
        "threads": job.threads,
        "stop": settings.stop,
    }
    parameters = parameters or [{}] * len(runs)
    contour, progress = run_wear_rounds(
        simulation, settings.wear, settings.wear_rounds, parameters, ends, options, progress
    )
    batch = simulation.simulate_many(
        parameters,
        t_end,
        output=output,
        **options,
        progress=progress,
        contour=contour,
        keep=list_sampled_series(settings.measures, settings.keep, source),
        peaks=(*list_peak_series(settings.measures, source), *sliding),
        against=load_reference_scene(job, reference_scene) if reference_scene else None,
    )
    if batch.interrupted:
        raise KeyboardInterrupt
    return batch


def _select_stored_times(t: Array, begin: float, end: float) -> Array:
    """Return the sample times of t (s) that are stored: those in [begin, end], and the first and last of the run."""
    return t[(t == 0.0) | (t == t[-1]) | is_in_window(t, begin, end)]


class _Collector:
    """Accumulator of the measures, series and notes of the runs of a job; runs without results have NaN."""

    def __init__(self, job: Job, table: RunTable) -> None:
        """Allocate measures and end times of all runs of a job, filled with NaN."""
        self.job, self.table, n = job, table, job.n_runs
        self.measures = {measure.name: np.full(n, np.nan) for measure in job.run_settings.measures}
        self.t_last = np.full(n, np.nan)
        self.kept: list[tuple[Array, Array, Mapping[str, Array]]] = []
        self.notes: list[Mapping[str, Note]] = []

    def add_batch(self, runs: Array, batch: Batch, failures: list[str]) -> None:
        """Evaluate the measures of a batch, and add them with its end times, notes and stored series.

        Scenes that measures subtract are run here. runs: indices of the batch's runs within the job. Reasons of failed
        runs are entered in `failures`; their measures stay NaN.
        """
        spans: Spans = {
            name: tuple(None if end is None else end[runs] for end in ends) for name, ends in self.table.spans.items()
        }
        failed = {failure.run: str(failure.error) for failure in batch.failures}
        for i, message in failed.items():
            failures[runs[i]] = message
        reference_series = compute_reference_series(self.job, self.table, runs, batch, failures)
        is_valid = np.array([not failures[i] for i in runs])
        for measure in self.job.run_settings.measures:
            self.measures[measure.name][runs] = np.where(
                is_valid, evaluate_measure(batch, measure, spans, reference_series), np.nan
            )
        has_begun = np.asarray(batch.samples) > 0
        self.t_last[runs] = np.where(has_begun, batch.t_last, np.nan)
        notes_by_run = batch.result.notes()
        self.notes.append(
            group_notes((self.job.first_run + int(runs[i]), notes_by_run[i]) for i in sorted(notes_by_run))
        )
        if self.job.run_settings.keep:
            self.kept.append((runs, batch.t, batch.kept))  # without the batch, whose states would stay in memory

    def add_measures(self, values: Mapping[str, Array], failures: list[str]) -> None:
        """Add further measures of all runs, (n,) by name, and set all measures of failed runs to NaN."""
        for name, measure_values in (self.measures | dict(values)).items():
            self.measures[name] = np.where([not message for message in failures], measure_values, np.nan)

    def build_block(self, failures: list[str]) -> Block:
        """Return the collected results as a Block; sample times are (N,) if all runs that began share them.

        Series of shorter runs are padded with NaN to the largest number of samples N.
        """
        job, keep = self.job, self.job.run_settings.keep
        N = max((requested.shape[-1] for _, requested, _ in self.kept), default=0)
        t = np.full((job.n_runs, N), np.nan)
        series = {name: np.full((job.n_runs, N), np.nan) for name in keep}
        for runs, requested, stored in self.kept:
            used = stored["t"]
            t[runs, : used.shape[1]] = np.where(np.isnan(used), requested, used)
            for name in (name for name in keep if name in stored):
                series[name][runs, : used.shape[1]] = stored[name]
        began = ~np.isnan(self.t_last)
        t[~began] = np.nan
        common = t[began][0] if began.any() else np.zeros(N)
        if np.array_equal(t[began], np.broadcast_to(common, t[began].shape)):
            t = common
        notes = merge_notes(self.notes)
        return Block(job.block_number, job.first_run, self.measures, tuple(failures), self.t_last, t, series, notes)


def resolve_wear_model(wear: WearRounds, sources: Sequence[KernelSource]) -> WearModel:
    """Return the wear model of a study, with the wear rate from the wear coefficient and the hardness in SI.

    sources: all scenes of the study. Raises UnknownNameError for a joint that has a contour in no scene, InputError for
    invalid values, each at its location.
    """
    joints_with_contour = {contour.joint for source in sources for contour in source.contours}
    for joint in wear.joints:
        if joint not in joints_with_contour:
            hint = (
                f"joints with a contour: {', '.join(sorted(joints_with_contour))}"
                if joints_with_contour
                else "expected contour: 128 in the play of a scene"
            )
            raise UnknownNameError(f"wear.joints: no scene has a contour at {joint}", joint.where, hint)
    try:
        rate = parse_wear_rate(wear.k, wear.hardness, "wear.k", "wear.hardness")
    except InputError as error:
        raise type(error)(error.message, wear.k.where, error.hint) from None
    scale = (
        1.0
        if wear.scale is None
        else parse_real_value(wear.scale, RuntimeParameter("wear.scale", "", 1.0, False, (0, 0, 0)))
    )
    if wear.scale is not None and not scale > 0.0:
        raise BadValueError(f"wear.scale is {scale:g}", wear.scale.where, "expected a positive factor")
    return WearModel(tuple(map(str, wear.joints)), rate, wear.law, scale)


def run_wear_rounds(
    simulation: Simulation,
    wear: WearModel | None,
    n_rounds: int,
    parameters: Any,
    end_times: Array,
    options: dict[str, Any],
    progress: Progress | None,
) -> tuple[dict[str, Array], Progress | None]:
    """Simulate the rounds of wear, and return the worn contours by joint and the progress function for the next runs.

    Without wear, or in a scene whose worn joints have no contour, it runs nothing and returns {} and `progress`.
    parameters, end_times (s): of each run. options: further arguments of `simulate_many`. Each round, and the measured
    runs, have equal parts of the progress.
    """
    joints_with_contour = {contour.joint for contour in simulation.source.contours}
    if wear is None or not joints_with_contour.intersection(wear.joints):
        return {}, progress
    wear_loop = WearLoop(
        simulation, replace(wear, joints=tuple(joint for joint in wear.joints if joint in joints_with_contour)), {}
    )
    for k in range(n_rounds):
        wear_loop.run_round(parameters, end_times, progress=scale_progress(progress, k, n_rounds + 1), **options)
    return wear_loop.given, scale_progress(progress, n_rounds, n_rounds + 1)

"""Run one block of a study's runs: the job that a process receives, its execution, and the picklable result."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource, Slot
from gudgeon.errors import BadValueError, GudgeonError, InputError, UnknownNameError
from gudgeon.integrators.lanes import followed_by
from gudgeon.language.tree import Expr
from gudgeon.model.default_step import scene_end, scene_number
from gudgeon.model.parameter_sets import given_each, prepare_sets
from gudgeon.results.batch import Array
from gudgeon.simulation.arguments import DEFAULT_OUTPUT
from gudgeon.simulation.simulation import Simulation
from gudgeon.simulation.wear import rate_of
from gudgeon.simulation.wear_loop import Loop, Wearing, share
from gudgeon.studies.ensemble.exponents import follow
from gudgeon.studies.ensemble.libraries import load_library, method_in
from gudgeon.studies.ensemble.measures import (
    Spans,
    is_within,
    measure_runs,
    peak_series_of,
    sampled_interval,
    series_of,
    sliding_requests_of,
)
from gudgeon.studies.ensemble.notes import Note, collect_guess_notes, gathered, merge_notes
from gudgeon.studies.ensemble.numbers import ROUNDING, evaluate_for_runs, find_impossible, key_of, real_value, slot_of
from gudgeon.studies.ensemble.origins import origin_of, origin_over_steps, origin_series

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import Measure, WearRounds
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.batch import Batch


@dataclass(frozen=True)
class Expected:
    """Requested outputs and settings of every run of a study."""

    t_end: Expr | None
    output: Expr | None
    step: Expr | None
    windows: Mapping[str, tuple[Expr | None, ...]]  # begin and end
    measures: tuple[Measure, ...]
    keep: tuple[str, ...]
    method: str
    rtol: float | None
    stop: bool
    wear: Wearing | None = None
    rounds: int = 0  # of wear before the runs that are measured


@dataclass(frozen=True, eq=False)
class Job:
    """Runs of one scene with their parameters, (n,) each; `relative` and `absolute` are deviations of perturbed
    starts.
    """

    mechanism: str
    scene: str
    overrides: tuple[tuple[str, str], ...]
    sha256: str
    number: int  # of the block
    first: int  # run of the study
    n: int  # how many
    columns: Mapping[str, Array]
    relative: Mapping[str, Array]
    absolute: Mapping[str, Array]
    expected: Expected
    threads: int | None
    later: int = 0  # runs of the same scene in later blocks


@dataclass(frozen=True, eq=False)
class Block:
    """Results of n runs; `t` is (N,) if all runs that began have the same times, else (n, N)."""

    number: int
    first: int
    measures: Mapping[str, Array]  # (n,)
    failures: tuple[str, ...]  # why a run failed, "" where it did not
    t_last: Array  # (n,) s, NaN: it did not begin
    t: Array  # empty where nothing is kept
    series: Mapping[str, Array]  # (n, N)
    notes: Mapping[str, Note] = field(default_factory=dict)  # by their kind

    @property
    def nbytes(self) -> int:
        """Memory of the arrays, bytes."""
        return sum(array.nbytes for array in (self.t_last, self.t, *self.measures.values(), *self.series.values()))


def run_block(job: Job, progress: Progress | None = None, simulation: Simulation | None = None) -> Block:
    """Run the runs of a job, measure them and return the results; without a simulation load it.

    Raises KeyboardInterrupt if Ctrl-C ended a run.
    """
    simulation = simulation or load_library(job.mechanism, job.scene, job.overrides, job.sha256)
    table = Table(simulation, job)
    failures = [table.bad.get(i, "") for i in range(job.n)]
    good = np.array([i for i in range(job.n) if i not in table.bad], dtype=int)
    found = _Collector(job, table)
    with collect_guess_notes(simulation.source, job.first) as off, followed_by(job.later):
        try:
            if len(good):
                found.take(good, _run_batch(simulation, job, table, good, progress), failures)
        except InputError:  # usually of one run; run by run it is found
            for i in good:
                try:
                    found.take(np.array([i]), _run_batch(simulation, job, table, np.array([i]), None), failures)
                except InputError as error:
                    failures[i] = str(error)
    found.notes.append(off)
    found.add(follow(simulation, job, table, found.t_last, failures, progress), failures)
    return found.block(failures)


class Table:
    """Parameters of all runs of a job, with their ends, outputs, steps and windows, and reasons why some cannot
    begin.
    """

    def __init__(self, simulation: Simulation, job: Job) -> None:
        """Evaluate the parameters and settings of all runs of a job."""
        self.source, self.compiled, expected = simulation.source, simulation.compiled, job.expected
        self.bad: dict[int, str] = {}
        self.columns = {key: own for name, own in job.columns.items() if (key := key_of(self.source, name))}
        self.p, errors = self._prepare_parameters(job.n)
        if off := self._perturbed_parameters(job):
            self.columns |= off
            self.p, errors = self._prepare_parameters(job.n)
        self.bad |= {i: str(error) for i, error in errors.items() if i not in self.bad}
        self.t_end = self._end_times(expected.t_end)
        known = {"t_end": self.t_end}
        self.output = self._output_counts(expected.output, known)
        self.step: Array | None = None
        if expected.step is not None and self.source.degrees_of_freedom:
            self.step = evaluate_for_runs(self.source, expected.step, self.p, known)
            self._mark_impossible("step", self.step)
        self.spans = self._evaluate_windows(expected.windows, known)

    def _perturbed_parameters(self, job: Job) -> dict[str, Array]:
        """Return the parameters of perturbed starts by address: p (1 + relative) + absolute, (n,) each."""
        place, found = {slot.address: k for k, slot in enumerate(self.source.slots)}, dict[str, Array]()
        for name in dict.fromkeys((*job.relative, *job.absolute)):
            if (slot := slot_of(self.source, name)) is None:
                continue
            base, key, zero = self.p[:, place[slot.address]], key_of(self.source, name), np.zeros(job.n)
            deviation = base * job.relative.get(name, zero) + job.absolute.get(name, zero)
            found[key] = found.get(key, base) + deviation  # another ensemble may spell it otherwise
        return found

    def _prepare_parameters(self, n: int) -> tuple[Array, Mapping[int, GudgeonError]]:
        """Return p of all runs and the errors by run; a value that is not finite is left out, and its run is bad."""
        rows: list[dict[str, float | str]] = [{} for _ in range(n)]
        for name, own in self.columns.items():
            for i, value in enumerate(map(_as_python_value, own)):
                if isinstance(value, str) or math.isfinite(value):
                    rows[i][name] = value
                else:
                    self.bad.setdefault(i, f"{name} is {value}: expected a finite number")
        given, is_given = given_each(self.source, rows)
        p, _, errors = prepare_sets(self.compiled, given, is_given, False)
        return p, errors

    def _evaluate_windows(self, windows: Mapping[str, tuple[Expr | None, ...]], known: Mapping[str, Array]) -> Spans:
        """Return begin and end of each run's windows; a window outside its run makes the run bad."""
        found: dict[str, tuple[Array | None, ...]] = {}
        for name, ends in windows.items():
            own = [None if expr is None else evaluate_for_runs(self.source, expr, self.p, known) for expr in ends]
            limits = zip(own, (np.zeros_like(self.t_end), self.t_end), strict=True)
            begin, end = (limit if x is None else x for x, limit in limits)
            is_valid = (begin <= end) & (begin <= self.t_end * (1 + ROUNDING)) & (end >= 0.0)
            for i in np.flatnonzero(~is_valid).tolist():
                message = f"window {name} goes from {begin[i]:g} s to {end[i]:g} s with this run's numbers"
                self.bad.setdefault(i, f"{message}: expected a part of the run, to {self.t_end[i]:g} s")
            found[name] = tuple(own)
        return found

    def _mark_impossible(self, name: str, values: Array) -> None:
        """Mark the runs whose values are not possible as bad."""
        wrong, expected = find_impossible(name, values)
        for i in np.flatnonzero(wrong).tolist():
            self.bad.setdefault(i, f"{name} is {values[i]:g} with this run's numbers: expected {expected}")

    def _end_times(self, expr: Expr | None) -> Array:
        """Return the end time of each run, (n,), s."""
        if expr is not None:
            found = evaluate_for_runs(self.source, expr, self.p, {})
            self._mark_impossible("t_end", found)
            return found
        return self._from_scene(lambda p: scene_end(self.source, p))

    def _output_counts(self, expr: Expr | None, more: Mapping[str, Array]) -> Array:
        """Return the number of output intervals of each run, (n,); an expression is rounded to a whole number."""
        if expr is None:
            return self._from_scene(lambda p: scene_number(self.source, "output", p, DEFAULT_OUTPUT))
        found = np.rint(evaluate_for_runs(self.source, expr, self.p, more))
        self._mark_impossible("output", found)
        return found

    def _from_scene(self, value: Any) -> Array:
        """Return a value that the scene determines from p for each run, (n,); an error makes the run bad."""
        found = np.full(len(self.p), np.nan)
        for i in range(len(self.p)):
            try:
                if i not in self.bad:
                    found[i] = value(self.p[i])
            except BadValueError as error:
                self.bad[i] = str(error)
        return found


def _as_python_value(value: Any) -> float | str:
    """Return a Python float or text from an entry of an array."""
    return value if isinstance(value, str) else float(value)


def _run_batch(simulation: Simulation, job: Job, table: Table, runs: Array, progress: Progress | None) -> Batch:
    """Run some runs of a job and return their batch."""
    expected, ends, counts = job.expected, table.t_end[runs], table.output[runs].astype(int)
    spans = None if expected.keep else sampled_interval(expected.measures, table.spans, runs)
    same_times = spans is None and len(set(counts.tolist())) == 1
    output: Any = int(counts[0])
    if not same_times:
        output = [np.linspace(0.0, end, k + 1) for end, k in zip(ends, counts, strict=True)]
        output = output if spans is None else [_times_to_store(t, *own) for t, *own in zip(output, *spans, strict=True)]
    same_end = len(set(ends.tolist())) == 1
    t_end: Any = None if not same_times else float(ends[0]) if same_end else ends
    parameters: Any = {name: list(map(_as_python_value, values[runs])) for name, values in table.columns.items()}
    source, step = simulation.source, None if table.step is None else table.step[runs]
    origin, sliding = origin_over_steps(expected.measures, source), sliding_requests_of(expected.measures, source)
    common: dict[str, Any] = {
        "method": method_in(source, expected.method),
        "rtol": expected.rtol if source.degrees_of_freedom else None,
        "step": step,
        "threads": job.threads,
        "stop": expected.stop,
    }
    parameters = parameters or [{}] * len(runs)
    contour, progress = run_wear_rounds(simulation, expected.wear, expected.rounds, parameters, ends, common, progress)
    batch = simulation.simulate_many(
        parameters,
        t_end,
        output=output,
        **common,
        progress=progress,
        contour=contour,
        keep=series_of(expected.measures, expected.keep, source),
        peaks=(*peak_series_of(expected.measures, source), *sliding),
        against=origin_of(job, origin) if origin else None,
    )
    if batch.interrupted:
        raise KeyboardInterrupt
    return batch


def _times_to_store(t: Array, begin: float, end: float) -> Array:
    """Return the sample times within [begin, end], and the start and end of the run."""
    return t[(t == 0.0) | (t == t[-1]) | is_within(t, begin, end)]


class _Collector:
    """Collector of measures and series of the runs of a job; NaN for runs without results so far."""

    def __init__(self, job: Job, table: Table) -> None:
        """Create empty measures for all runs of a job."""
        self.job, self.table, n = job, table, job.n
        self.measures = {one.name: np.full(n, np.nan) for one in job.expected.measures}
        self.t_last = np.full(n, np.nan)
        self.kept: list[tuple[Array, Array, Mapping[str, Array]]] = []
        self.notes: list[Mapping[str, Note]] = []

    def take(self, runs: Array, batch: Batch, failures: list[str]) -> None:
        """Add the measures and series of a batch of these runs; of a failed run only its end."""
        spans: Spans = {
            name: tuple(None if end is None else end[runs] for end in ends) for name, ends in self.table.spans.items()
        }
        failed = {failure.run: str(failure.error) for failure in batch.failures}
        for i, message in failed.items():
            failures[runs[i]] = message
        origins = origin_series(self.job, self.table, runs, batch, failures)
        good = np.array([not failures[i] for i in runs])
        for one in self.job.expected.measures:
            self.measures[one.name][runs] = np.where(good, measure_runs(batch, one, spans, origins), np.nan)
        begun = np.asarray(batch.samples) > 0
        self.t_last[runs] = np.where(begun, batch.t_last, np.nan)
        noted = batch.result.notes()
        self.notes.append(gathered((self.job.first + int(runs[i]), noted[i]) for i in sorted(noted)))
        if self.job.expected.keep:
            self.kept.append((runs, batch.t, batch.kept))  # the batch itself holds what C has stored

    def add(self, values: Mapping[str, Array], failures: list[str]) -> None:
        """Add further measures of all runs, and set those of failed runs to NaN."""
        for name, own in (self.measures | dict(values)).items():
            self.measures[name] = np.where([not message for message in failures], own, np.nan)

    def block(self, failures: list[str]) -> Block:
        """Return the collected results as a Block."""
        job, keep = self.job, self.job.expected.keep
        N = max((requested.shape[-1] for _, requested, _ in self.kept), default=0)
        t = np.full((job.n, N), np.nan)
        series = {name: np.full((job.n, N), np.nan) for name in keep}
        for runs, requested, kept in self.kept:
            used = kept["t"]
            t[runs, : used.shape[1]] = np.where(np.isnan(used), requested, used)
            for name in (name for name in keep if name in kept):
                series[name][runs, : used.shape[1]] = kept[name]
        began = ~np.isnan(self.t_last)
        t[~began] = np.nan
        common = t[began][0] if began.any() else np.zeros(N)
        if np.array_equal(t[began], np.broadcast_to(common, t[began].shape)):
            t = common
        notes = merge_notes(self.notes)
        return Block(job.number, job.first, self.measures, tuple(failures), self.t_last, t, series, notes)


def resolve_wear(wear: WearRounds, sources: Sequence[KernelSource]) -> Wearing:
    """Return the wear model of a study. Raises InputError for bad values, and for a joint without a contour in any
    scene.
    """
    able = {one.joint for source in sources for one in source.contours}
    for joint in wear.joints:
        if joint not in able:
            hint = f"joints with one: {', '.join(sorted(able))}" if able else "contour: 128 in the play of a scene"
            raise UnknownNameError(f"wear.joints: no scene has a contour at {joint}", joint.where, hint)
    try:
        rate = rate_of(wear.k, wear.hardness, "wear.k", "wear.hardness")
    except InputError as error:
        raise type(error)(error.message, wear.k.where, error.hint) from None
    scale = 1.0 if wear.scale is None else real_value(wear.scale, Slot("wear.scale", "", 1.0, False, (0, 0, 0)))
    if wear.scale is not None and not scale > 0.0:
        raise BadValueError(f"wear.scale is {scale:g}", wear.scale.where, "expected a positive number of runs")
    return Wearing(tuple(map(str, wear.joints)), rate, wear.law, scale)


def run_wear_rounds(
    simulation: Simulation,
    wearing: Wearing | None,
    rounds: int,
    parameters: Any,
    ends: Array,
    common: dict[str, Any],
    progress: Progress | None,
) -> tuple[dict[str, Array], Progress | None]:
    """Run the rounds of wear; return the contours by joint, and the progress function for the measured runs.

    There are no contours if no joint of the scene wears. Each round takes an equal part of the progress.
    """
    able = {one.joint for one in simulation.source.contours}
    if wearing is None or not able.intersection(wearing.joints):
        return {}, progress
    loop = Loop(simulation, replace(wearing, joints=tuple(joint for joint in wearing.joints if joint in able)), {})
    for k in range(rounds):
        loop.round(parameters, ends, progress=share(progress, k, rounds + 1), **common)
    return loop.given, share(progress, rounds, rounds + 1)

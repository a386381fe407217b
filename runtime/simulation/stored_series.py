"""Store requested series of a batch instead of its states, as runs finish (`keep` of `simulate_many`)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.contract.boundary import MAX_MOTION_SERIES
from gudgeon.errors import SolverError
from gudgeon.integrators.times import Times
from gudgeon.model.compiled import Array
from gudgeon.model.evaluation import evaluate_runs
from gudgeon.model.file_expressions import may_powers_be_undefined
from gudgeon.model.left_limit import find_evaluation_times
from gudgeon.results.batch import STATES, check_series_names, depends_on_works, find_evaluation_fields
from gudgeon.results.results import EvaluatedSamples, Result, make_evaluated_samples
from gudgeon.results.series import get_catalogue

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.integrators.batch import Runs
    from gudgeon.integrators.kinematic_ensemble import KinematicEnsemble

MAX_JOINED_SAMPLES = 2048  # of runs whose series are computed at once: more would need memory without being faster


def select_stored_series(source: KernelSource, keep: str | Iterable[str]) -> tuple[str, ...] | None:
    """Return the checked names of the series to store, without "t"; None if the states are stored (`keep` is "states").

    Raises UnknownNameError or BadValueError for names that the scene does not have.
    """
    if isinstance(keep, str) and keep == STATES:
        return None
    return tuple(name for name in check_series_names(source, keep, "keep") if name != "t")


class StoredSeries:
    """Store requested series as arrays (n, N) by name, and "t" when all runs are over.

    Some are stored from the samples of finished runs. C stores the others during the runs (`pass_arrays_to_c`).
    """

    def __init__(self, source: KernelSource, names: tuple[str, ...], n: int, times: Times) -> None:
        self.names, self.evaluation_fields = names, find_evaluation_fields(source, names)
        # one block, whose memory the system provides in larger pages than that of many arrays
        self.arrays = dict(zip(names, np.empty((len(names), n, times.max_count)), strict=True))
        self._source, self._names_in_python = source, names
        series = [get_catalogue(source)[name] for name in names]
        self.may_join_runs = all(entry.stored or entry.evaluated or entry.is_by_sample for entry in series)

    def pass_arrays_to_c(self, kinematic: KinematicEnsemble) -> None:
        """Pass the arrays of series of the motion to the kinematic ensemble, so that C fills them during the runs.

        At most MAX_MOTION_SERIES are passed; Python computes the others. States are stored only if Python needs them,
        works only if a series depends on them or powers may be undefined.
        """
        motions = {name: get_catalogue(self._source)[name].motion for name in self._names_in_python}
        in_c = dict([(name, motion) for name, motion in motions.items() if motion][:MAX_MOTION_SERIES])
        self._names_in_python = tuple(name for name in self._names_in_python if name not in in_c)
        self.evaluation_fields = find_evaluation_fields(self._source, self._names_in_python)
        needs_works = any(depends_on_works(self._source, name) for name in self._names_in_python)
        kinematic.set_series(
            list(in_c.values()),
            [self.arrays[name] for name in in_c],
            has_states=bool(self._names_in_python),
            has_works=needs_works or may_powers_be_undefined(self._source),
        )

    def fill_times_and_gaps(self, runs: Runs) -> None:
        """Store "t", the times of all samples, and set all series to NaN where a run has no sample.

        Called once, when all runs are over. "t" is read-only if all runs have the same times.
        """
        times, n_samples = runs.times, runs.arrays["done"]
        if times.t.ndim == 1 and (n_samples == times.max_count).all() and not runs.arrays["status"].any():
            self.arrays["t"] = np.broadcast_to(times.t, (runs.n, times.max_count))
            return
        self.arrays["t"] = np.full((runs.n, times.max_count), np.nan)
        for i in range(runs.n):
            self.arrays["t"][i, : n_samples[i]] = runs.get_reached_times(i)
        for i in np.flatnonzero(n_samples < times.max_count).tolist():
            for name in self.names:
                self.arrays[name][i, n_samples[i] :] = np.nan

    def store_finished_runs(self, runs: Runs, finished_runs: Sequence[int]) -> None:
        """Store the series of finished runs, given by index, several at once where their equations allow it.

        Runs without samples are skipped. A run whose series cannot be computed is recorded as failed.
        """
        indices = np.array(finished_runs, np.intp)
        with_samples = indices[runs.arrays["done"][indices] > 0].tolist()
        n_joined = max(1, MAX_JOINED_SAMPLES // runs.times.max_count) if self.may_join_runs else 1
        for k in range(0, len(with_samples) if self._names_in_python else 0, n_joined):
            self._store_joined_runs(runs, with_samples[k : k + n_joined])

    def _store_joined_runs(self, runs: Runs, indices: Sequence[int]) -> None:
        """Store the series of the runs `indices`, which have samples, from one joint evaluation.

        If the evaluation fails, the runs are evaluated one by one, so that only those with an error fail.
        """
        if len(indices) > 1:
            try:
                joined = _concatenate_samples(runs, indices, self.evaluation_fields)
                self._copy_samples(self._names_in_python, indices, joined.sample_counts, joined)
                return
            except SolverError:  # evaluating run by run shows which one has the error
                pass
        for i in indices:
            if run := build_samples(runs, i, self.evaluation_fields):
                self._store_run(self._names_in_python, runs, i, run)

    def store_run(self, runs: Runs, i: int, run: Result) -> None:
        """Store all series of run i from its Result. An error of their evaluation is recorded as the run's failure."""
        self._store_run(self.names, runs, i, run)

    def _store_run(self, names: Sequence[str], runs: Runs, i: int, run: Result) -> None:
        """Store series of run i from its Result; an error is recorded as the run's failure, and the series are NaN."""
        try:
            self._copy_samples(names, [i], [len(run.t)], run, int(run.start_row is not None))
        except SolverError as error:
            runs.failures.setdefault(i, error)
            for name in self.names:
                self.arrays[name][i] = np.nan

    def _copy_samples(
        self, names: Sequence[str], indices: Sequence[int], counts: Sequence[int], result: Result, first_column: int = 0
    ) -> None:
        """Copy series at samples of several runs, concatenated in `result`, into the rows of the stored arrays.

        counts[k] samples belong to run indices[k]. `first_column`: first column that is filled.
        """
        columns, first = [(self.arrays[name], result[name]) for name in names], 0
        for i, count in zip(indices, counts, strict=True):
            for stored, column in columns:
                stored[i, first_column : first_column + count] = column[first : first + count]
            first += count


def build_samples(runs: Runs, i: int, field_names: frozenset[str]) -> EvaluatedSamples | None:
    """Return the stored samples of run i as a result without diagnostics; None if it has no samples.

    `field_names`: fields of an Evaluation that its series need. Accelerations are those of the method, if stored.
    """
    if not runs.arrays["done"][i]:
        return None
    n, source, p = runs.compiled.n, runs.compiled.source, runs.arrays["p_motion"][i]
    t, y, discrete_states, state = runs.get_samples(i)
    result = make_evaluated_samples(
        source, runs.compiled, p, t, y[:, :n], y[:, n : 2 * n], y[:, 2 * n :], discrete_states, state, field_names
    )
    result.accelerations = _get_accelerations(runs, i)
    return result


def find_evaluation_times_of_run(runs: Runs, i: int) -> Array:
    """Return the times (k,) in s at which the samples of run i of a batch are evaluated, as `find_evaluation_times`."""
    n, (t, y, *_) = runs.compiled.n, runs.get_samples(i)
    return find_evaluation_times(runs.compiled, t, y[:, :n], y[:, n : 2 * n], runs.arrays["p"][i])


def _get_accelerations(runs: Runs, i: int) -> Array | None:
    """Return q̈ (k, n) at the samples of run i if its method stored it; else None.

    Where accelerations of drives jump at the last sample, that sample has those before the jump, as in a single run.
    """
    a, compiled, n = runs.get_accelerations(i), runs.compiled, runs.compiled.n
    if a is None or not compiled.may_drive_acceleration_jump:
        return a
    t, y, discrete_states, _ = runs.get_samples(i)
    times = find_evaluation_times_of_run(runs, i)
    if times[-1] == t[-1]:
        return a
    q, v, p = y[-1:, :n], y[-1:, n : 2 * n], runs.arrays["p_motion"][i]
    last = compiled.evaluate(times[-1:], q, v, discrete_states[-1:], p, field_names=frozenset(["a"]))
    return np.append(a[:-1], last.a, axis=0)


def _concatenate_samples(runs: Runs, indices: Sequence[int], field_names: frozenset[str]) -> EvaluatedSamples:
    """Return all samples of the runs `indices` concatenated in one result.

    `field_names`: fields of an Evaluation that are evaluated, with each run's parameter values; none: nothing is
    evaluated. Accelerations are those of the method, if it stores them. Where accelerations of drives may jump, a run's
    last sample is evaluated before its jump.
    """
    compiled, n, samples_of_runs = runs.compiled, runs.compiled.n, [runs.get_samples(i) for i in indices]
    run_lengths = [len(samples[0]) for samples in samples_of_runs]
    t, y, discrete_states, state = (np.concatenate(arrays) for arrays in zip(*samples_of_runs, strict=True))
    q, v = y[:, :n], y[:, n : 2 * n]
    parameter_values = runs.arrays["p_motion"][indices]
    result = make_evaluated_samples(
        compiled.source, compiled, parameter_values, t, q, v, y[:, 2 * n :], discrete_states, state, field_names
    )
    result.sample_counts_of_runs = tuple(run_lengths)
    accelerations = [a for i in indices if (a := _get_accelerations(runs, i)) is not None]
    if accelerations:
        result.accelerations, field_names = np.concatenate(accelerations), field_names - {"a"}
    if field_names:
        if compiled.may_drive_acceleration_jump:
            t = np.concatenate([find_evaluation_times_of_run(runs, i) for i in indices])
        result.evaluation = evaluate_runs(
            compiled, run_lengths, t, q, v, discrete_states, parameter_values, field_names
        )
    return result

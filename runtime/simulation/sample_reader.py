"""Read requested series at the samples of a run that was integrated in preallocated arrays (reusable_run.py).

C stores the series that are columns of samples or of evaluated quantities (engine/batch/repeated_run.c). The functions
of the catalogue (results/series.py) compute the others, from the arrays of the run, which stay where they are.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from gudgeon.integrators.reusable_run import N_ROWS, ReusableRun
from gudgeon.model.arrays import make_column_pointer
from gudgeon.model.compiled import Array
from gudgeon.model.evaluation import Evaluation, allocate_evaluation
from gudgeon.results.batch import find_evaluation_fields
from gudgeon.results.results import Result, make_evaluated_samples
from gudgeon.results.series import get_catalogue
from gudgeon.simulation.stored_series import build_samples

MAX_SAMPLES = 2048  # with more, C is called for parts of the samples, between which Ctrl-C is handled
# values of a result that depend on its parameters and are computed once
_PARAMETER_PROPERTIES = ("parameters", "constants")
_MOTION = ("q", "v", "a", "work")  # arrays of a result that are columns of stored or evaluated samples


class SampleReader:
    """Read the series `names` of the runs of a ReusableRun; the first `n_skipped` samples (0 or 1) are left out."""

    def __init__(self, run: ReusableRun, names: Sequence[str], n_skipped: int) -> None:
        source = run.compiled.source
        self.run, self.names, self.n_skipped, self.n_samples = run, names, n_skipped, run.times.max_count
        self.evaluation_fields = find_evaluation_fields(source, names)
        is_simple = not (
            self.evaluation_fields
            and (run.compiled.may_drive_acceleration_jump or source.massless_bodies or source.indeterminate)
        )
        self._is_reusable = is_simple and self.n_samples <= MAX_SAMPLES and not source.massless_bodies
        self.values = np.empty((len(names), self.n_samples - n_skipped))  # that C stores
        self._samples, self._computed = list[_ReusableSamples](), list[tuple[int, Callable[[Result], Array]]]()
        if self._is_reusable:
            evaluation, pointers = allocate_evaluation(run.compiled, self.n_samples, self.evaluation_fields)
            self._samples = [_ReusableSamples(run, k, self.evaluation_fields, evaluation) for k in range(N_ROWS)]
            self._set_columns([pointer for pointer, _ in pointers])

    def _set_columns(self, pointers: Sequence[Any]) -> None:
        """Set the fields of the struct RepeatedRun that C reads: columns of series, pointers to evaluated quantities.

        Series that Python must compute are stored in `_computed`, with their positions.
        """
        compiled, repeated, names = self.run.compiled, self.run.repeated, self.names
        columns = [[self._find_column(samples, name) for name in names] for samples in self._samples]
        arrays = [[x if isinstance(x, np.ndarray) else None for x in row] for row in columns]
        self._computed = [(i, x) for i, x in enumerate(columns[0]) if not isinstance(x, np.ndarray)]
        ffi = compiled.ffi
        self._addresses = ffi.new(
            "double *[]",
            [ffi.NULL if x is None else make_column_pointer(ffi, x) for row in arrays for x in row],
        )
        self._strides = np.array([0 if x is None else x.strides[0] // x.itemsize for x in arrays[0]], np.int_)
        repeated.columns, repeated.strides = self._addresses, compiled.pointer(self._strides, "long *")
        repeated.values = compiled.pointer(self.values, is_written=True)
        repeated.n_series, repeated.n_skipped = len(names), self.n_skipped
        repeated.is_read, repeated.is_evaluated, repeated.evaluated = True, bool(self.evaluation_fields), pointers

    def _find_column(self, samples: _ReusableSamples, name: str) -> Array | Callable[[Result], Array]:
        """Return the view (N,) of a series in the reused arrays of a row, or the function that computes the series."""
        if name == "t":
            return samples.result.t
        series = get_catalogue(self.run.compiled.source)[name]
        if series.evaluated is not None:
            part, index = series.evaluated
            return np.asarray(getattr(samples.evaluation, part)[:, *index])
        if series.stored is None or series.stored[0] not in _MOTION:
            return series.compute
        array, column = series.stored
        return np.asarray((samples.evaluation.a if array == "a" else getattr(samples.result, array))[:, column])

    def read_row(self, k: int, is_read: bool) -> Array:
        """Return the series (n_series, n_samples) of the run in row k; NaN after the sample at which it ended.

        `is_read`: C has stored the series, but those that Python computes. Raises SingularError for a sample whose
        quantities cannot be evaluated.
        """
        if is_read:
            if self._computed:
                stored = self._samples[k].get_result()
                for i, compute in self._computed:
                    self.values[i] = compute(stored)[self.n_skipped :]
            return self.values.copy()
        values = np.full_like(self.values, np.nan)
        result = build_samples(self.run, k, self.evaluation_fields)
        assert result is not None
        first = self.n_skipped if len(result.t) > 1 else 0  # a run that ends at its start has no other sample
        for row, name in zip(values, self.names, strict=True):
            row[: len(result.t) - first] = result[name][first:]
        return values


class _ReusableSamples:
    """Hold the samples of one row as a result without diagnostics, whose arrays are views of those of the run."""

    def __init__(self, run: ReusableRun, k: int, evaluation_fields: frozenset[str], evaluation: Evaluation) -> None:
        compiled, x, n = run.compiled, run.arrays, run.compiled.n
        y, joints = x["y"][k], len(compiled.source.clearances)
        memory, state = x["discrete_states"][k][:, : compiled.n_discrete_states], x["state"][k][:, :joints]
        self.result = make_evaluated_samples(
            compiled.source,
            compiled,
            x["p"][k],
            run.times.t,
            y[:, :n],
            y[:, n : 2 * n],
            y[:, 2 * n :],
            memory,
            state,
            evaluation_fields,
        )
        self.evaluation, self._evaluation_fields = evaluation, evaluation_fields

    def get_result(self) -> Result:
        """Return the result of the run that has ended in this row, without cached values of the previous run."""
        cached: dict[str, Any] = vars(self.result)
        self.result.stored.clear()
        for name in _PARAMETER_PROPERTIES:
            cached.pop(name, None)
        if self._evaluation_fields:
            cached["evaluation"], cached["a"] = self.evaluation, self.evaluation.a
        return self.result

"""Compute requested series at the samples of a run that was integrated in preallocated arrays (reusable_run.py).

Series are computed by the functions of the catalogue (results/series.py) from the arrays of the run, which stay where
they are from run to run. Quantities that must be evaluated are written by C into arrays that are allocated once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from gudgeon.integrators.reusable_run import N_ROWS, ReusableRun
from gudgeon.model.compiled import Array
from gudgeon.model.evaluation import allocate_evaluation
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
            and (
                run.compiled.has_mod_in_drives
                or run.compiled.may_drive_acceleration_jump
                or source.massless_bodies
                or source.indeterminate
            )
        )
        self._is_reusable = is_simple and self.n_samples <= MAX_SAMPLES and not source.massless_bodies
        self._samples = [
            _ReusableSamples(run, k, self.evaluation_fields) for k in range(N_ROWS if self._is_reusable else 0)
        ]
        self._columns = [[self._find_column(samples, name) for name in names] for samples in self._samples]

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

    def read_row(self, k: int) -> Array:
        """Return the series (n_series, n_samples) of the run in row k; NaN after the sample at which it ended.

        Raises SingularError for a sample whose quantities cannot be evaluated.
        """
        arrays, n_skipped = self.run.arrays, self.n_skipped
        is_complete = arrays["done"].item(k) == self.n_samples and not arrays["status"].item(k)
        if self._is_reusable and is_complete and self._samples[k].evaluate():
            samples = self._samples[k]
            values = np.empty((len(self.names), self.n_samples - n_skipped))
            for i, column in enumerate(self._columns[k]):
                values[i] = (column if isinstance(column, np.ndarray) else column(samples.result))[n_skipped:]
            return values
        values = np.full((len(self.names), self.n_samples - n_skipped), np.nan)
        result = build_samples(self.run, k, self.evaluation_fields)
        assert result is not None
        first = n_skipped if len(result.t) > 1 else 0  # a run that ends at its start has no other sample
        for row, name in zip(values, self.names, strict=True):
            row[: len(result.t) - first] = result[name][first:]
        return values


class _ReusableSamples:
    """Hold the samples of one row as a result without diagnostics, whose arrays are views of those of the run."""

    def __init__(self, run: ReusableRun, k: int, evaluation_fields: frozenset[str]) -> None:
        compiled, x, n = run.compiled, run.arrays, run.compiled.n
        y, pointer = x["y"][k], compiled.pointer
        joints = len(compiled.source.clearances)
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
        self.compiled, self.n_samples, self._evaluation_fields = compiled, len(y), evaluation_fields
        self._source = y[:, :n], y[:, n : 2 * n]
        self._copies = np.empty((len(y), n)), np.empty((len(y), n))
        self.evaluation, _ = allocate_evaluation(compiled, len(y), evaluation_fields)
        self._filled = [array for array in vars(self.evaluation).values() if array.size]
        results = [
            pointer(array, is_written=True) if array.size else compiled.ffi.NULL
            for array in vars(self.evaluation).values()
        ]
        inputs = [pointer(array) for array in (run.times.t, *self._copies, x["discrete_states"][k])]
        self._arguments = (len(y), *inputs, pointer(x["p"][k]), *results, compiled.ffi.new("long *"))

    def evaluate(self) -> bool:
        """Evaluate the samples of the run that has ended in this row in C; return whether all could be evaluated.

        Cached values of the previous run are dropped. Without quantities to evaluate, return True.
        """
        cached: dict[str, Any] = vars(self.result)
        self.result.stored.clear()
        for name in _PARAMETER_PROPERTIES:
            cached.pop(name, None)
        if not self._evaluation_fields:
            return True
        for copy, source in zip(self._copies, self._source, strict=True):
            copy[...] = source
        for array in self._filled:
            array.fill(np.nan)
        cached["evaluation"], cached["a"] = self.evaluation, self.evaluation.a
        return not self.compiled.lib.gudgeon_evaluate(*self._arguments)

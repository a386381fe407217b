"""Read times and steps of a batch: `t_end`, `output` and `step` hold for all runs, or give one value per run."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from gudgeon.errors import BadValueError, InputError
from gudgeon.files.free_space import check_memory
from gudgeon.integrators.times import Times
from gudgeon.language.quantities import has_names
from gudgeon.model.arrays import as_c_array
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.parameter_sets import read_column
from gudgeon.model.parameters import insert_space_before_unit
from gudgeon.simulation.arguments import MAX_OUTPUT, MAX_STEPS, compute_output_times, evaluate_end_time, evaluate_step

Errors = dict[int, BadValueError]


def _split_times_by_run(output: Any) -> list[Any] | None:
    """Split the argument `output` into one row of times per run; return None if all runs have the same times.

    Rows come from an array (n, N), or from a list, tuple or object array that contains sequences. Rows are not checked.
    """
    if getattr(output, "ndim", None) == 2:
        return list(as_c_array(output, "output", (None, None), max_entries=MAX_OUTPUT))
    is_object_array = getattr(output, "ndim", None) == 1 and getattr(output, "dtype", None) == np.dtype(object)
    if not (isinstance(output, (list, tuple)) or is_object_array):
        return None
    has_rows = any(isinstance(row, (list, tuple)) or getattr(row, "ndim", 0) for row in output)
    return list(output) if has_rows else None


@dataclass
class BatchArguments:
    """Hold `t_end`, `output` and `step` of a batch. A value that is not a number fails its own run only."""

    compiled: CompiledModel
    t_end: Any
    output: Any
    step: Any
    failures: Errors = field(default_factory=dict)  # errors of runs without valid times or step, by index

    def __post_init__(self) -> None:
        """Split the arguments into columns with one value per run."""
        self.ends, self.steps = read_column("t_end", self.t_end), read_column("step", self.step)
        self.rows = _split_times_by_run(self.output)

    def count_runs(self, n_sets: int) -> int:
        """Return the number of runs of the batch, given the number of parameter sets `n_sets`.

        Raises BadValueError if t_end, output or step have another number of values; one set combines with any number.
        """
        for name, values in (("t_end", self.ends), ("output", self.rows), ("step", self.steps)):
            if values is not None and (not values or n_sets not in (1, len(values))):
                items = "rows of times" if name == "output" else "values"
                message = f"{name} has {len(values)} {items} for {n_sets} run{'s' if n_sets > 1 else ''}"
                raise BadValueError(message, hint="one for all runs, or one for every run")
            n_sets = n_sets if values is None else len(values)
        return n_sets

    def compute_times(self, p: Array, t0: float, excluded_runs: dict[int, Any]) -> Times:
        """Return the sample times of all runs from t0 (s), with parameter values p (n_runs, …).

        Runs in `excluded_runs` get none. Errors of single runs are recorded in `failures`; if every run has one, the
        first is raised. Runs with equal times share one array. Raises MemoryError before arrays that do not fit.
        """
        source = self.compiled.source
        has_own_times = (
            isinstance(self.t_end, str)
            and has_names(insert_space_before_unit(self.t_end))
            or bool(source.simulate_expressions)
        )
        if self.ends is None and self.rows is None and not has_own_times:
            t, requested = compute_output_times(source, p[0], t0, self.t_end, self.output)
            return Times(t, np.full(len(p), len(t)), np.full(len(p), int(not requested)))
        times_of_runs: dict[int, tuple[Array, bool]] = {}
        known_times: dict[Any, tuple[Array, bool]] = {}
        for i in range(len(p)):
            times = None if i in excluded_runs else self._compute_times_of_run(i, p[i], t0, known_times)
            if times is None:
                continue
            if len(times_of_runs) == 1 and times is not next(
                iter(times_of_runs.values())
            ):  # each run gets a row of its times
                check_memory(2 * 8 * float(len(p)) * len(times[0]), f"{len(p)} rows of times, {len(times[0])} each,")
            times_of_runs[i] = times
        if self.failures and not times_of_runs:
            raise next(iter(self.failures.values()))
        return Times.from_runs(times_of_runs or {0: (np.array([t0]), True)}, len(p))

    def _compute_times_of_run(
        self, i: int, p: Array, t0: float, known_times: dict[Any, tuple[Array, bool]]
    ) -> tuple[Array, bool] | None:
        """Return the sample times (s) of run i from t0, and whether t0 is a requested sample; None if they are invalid.

        A time that is not finite, or an expression of the file that fails, is recorded in `failures`. Other errors are
        raised as BadValueError with the run's index. `known_times` caches times across runs with equal ends.
        """
        source = self.compiled.source
        row = self.output if self.rows is None else self.rows[i]
        try:
            end = evaluate_end_time(
                source, self.t_end if self.ends is None else _require_time(self.ends[i], "t_end"), p
            )
        except InputError as error:
            raise BadValueError(f"run {i}: {error}") from None
        if message := _explain_nonfinite_value(end, "t_end") or (
            "" if self.rows is None else _explain_nonfinite_times(row)
        ):
            self.failures[i] = BadValueError(message)
            return None
        is_shareable = self.rows is None and not source.simulate_expressions and isinstance(end, (int, float, str))
        key = (type(end), end) if is_shareable else None
        if key in known_times:
            return known_times[key]
        try:
            t = compute_output_times(source, p, t0, end, row)
        except InputError as error:
            if end is None and self.rows is None:  # the times are those of the file, with parameter values p
                self.failures[i] = BadValueError(str(error))
                return None
            raise BadValueError(f"run {i}: {error}") from None
        return known_times.setdefault(key, t) if key else t

    def compute_steps(self, method: str, p: Array, times: Times, excluded_runs: dict[int, Any]) -> Array:
        """Return the fixed step (s) of each run, (n_runs,); infinity where the method controls its step.

        Runs in `excluded_runs` or `failures` get 1.0, which has no meaning. A step that is not finite is recorded in
        `failures`; if every run has an error, the first is raised.
        """
        steps = np.full(len(p), 1.0 if method == "rk4" or self.step is not None else math.inf)
        indices = [
            i for i in range(len(p) if steps[0] < math.inf else 0) if i not in excluded_runs and i not in self.failures
        ]
        if self.step is not None and self.steps is None and times.t.ndim == 1 and indices:
            steps[indices] = self._compute_step_of_run(
                indices[0], self.step, method, p[indices[0]], float(times.t[-1] - times.t[0])
            )
            return steps
        for i in indices:
            step, t = self.step if self.steps is None else self.steps[i], times.get_times(i)
            if message := "" if self.steps is None else _explain_nonfinite_value(step, "step"):
                self.failures[i] = BadValueError(message)
                continue
            steps[i] = self._compute_step_of_run(i, step, method, p[i], float(t[-1] - t[0]))
        if self.failures and len(self.failures | excluded_runs) == len(p) and self.steps is not None:
            raise next(iter(self.failures.values()))
        return steps

    def _compute_step_of_run(self, i: int, step: Any, method: str, p: Array, duration: float) -> float:
        """Return the checked fixed step (s) of run i, which lasts `duration` (s).

        An error of the file's step expression is recorded in `failures`, and 1.0 is returned. Others are raised as
        BadValueError, with the index of the run if t_end, output or step differ between runs.
        """
        try:
            h = evaluate_step(
                self.compiled, step if self.steps is None else _require_time(step, "step"), method, p, duration
            )
            if duration / h > MAX_STEPS:
                raise BadValueError(f"step {h:.3g} s means more than {MAX_STEPS:.0e} steps")
        except InputError as error:
            if step is None and self.compiled.source.simulate_expressions:
                self.failures[i] = BadValueError(str(error))
                return 1.0
            if self.steps is None and self.ends is None and self.rows is None:
                raise
            raise BadValueError(f"run {i}: {error}") from None
        return h


def _require_time(value: Any, name: str) -> Any:
    """Return the argument `value` of one run (t_end or step); raise BadValueError if it is None. `name`: for messages.

    Nothing else is checked here.
    """
    if value is None:
        raise BadValueError(f"{name} is None: expected a time (s)")
    return value


def _explain_nonfinite_value(value: Any, name: str) -> str:
    """Return a message if `value` is a float and not finite, else ""; other types are not checked here."""
    number = isinstance(value, (float, np.floating))
    return f"{name}: {value} is not a finite number" if number and not math.isfinite(value) else ""


def _explain_nonfinite_times(times: Any) -> str:
    """Return a message on the first sample time that is not finite, else "".

    Rows that are not a one-dimensional list of numbers, or too long, give "": `compute_output_times` refuses them.
    """
    try:
        t = np.asarray(times if np.size(times) <= MAX_OUTPUT else (), dtype=float)
    except (TypeError, ValueError):
        return ""
    not_finite = np.flatnonzero(~np.isfinite(t)).tolist() if t.ndim == 1 else []
    return f"output[{not_finite[0]}] is {t[not_finite[0]]}: expected finite numbers" if not_finite else ""

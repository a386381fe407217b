"""Read times and steps of a batch: `t_end`, `output` and `step` hold for all runs, or give one value per run."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from gudgeon.errors import BadValueError, InputError
from gudgeon.files.free_space import check_memory
from gudgeon.integrators.times import Times
from gudgeon.language.quantities import holds_names
from gudgeon.model.arrays import as_c_array
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.parameter_sets import column
from gudgeon.model.parameters import spaced
from gudgeon.simulation.arguments import MAX_STEPS, MOST_OUTPUT, end_of, output_times, step_of

Errors = dict[int, BadValueError]


def rows_of_times(output: Any) -> list[Any] | None:
    """Return the output times as one row per run, of a list of rows or an array (n, N); None if all runs share them."""
    if getattr(output, "ndim", None) == 2:
        return list(as_c_array(output, "output", (None, None), most=MOST_OUTPUT))
    of_objects = getattr(output, "ndim", None) == 1 and getattr(output, "dtype", None) == np.dtype(object)
    if not (isinstance(output, (list, tuple)) or of_objects):
        return None
    several = any(isinstance(row, (list, tuple)) or getattr(row, "ndim", 0) for row in output)
    return list(output) if several else None


@dataclass
class EachRun:
    """Hold `t_end`, `output` and `step` of a batch. A value that is not a number fails its own run only."""

    compiled: CompiledModel
    t_end: Any
    output: Any
    step: Any
    bad: Errors = field(default_factory=dict)  # errors of runs without valid times or step, by index

    def __post_init__(self) -> None:
        """Split the arguments into columns with one value per run."""
        self.ends, self.steps = column("t_end", self.t_end), column("step", self.step)
        self.rows = rows_of_times(self.output)

    def length(self, runs: int) -> int:
        """Return the number of runs, given `runs` parameter sets. Raise BadValueError if lengths do not agree."""
        for name, values in (("t_end", self.ends), ("output", self.rows), ("step", self.steps)):
            if values is not None and (not values or runs not in (1, len(values))):
                of = "rows of times" if name == "output" else "values"
                message = f"{name} has {len(values)} {of} for {runs} run{'s' if runs > 1 else ''}"
                raise BadValueError(message, hint="one for all runs, or one for every run")
            runs = runs if values is None else len(values)
        return runs

    def times(self, p: Array, t0: float, left_out: dict[int, Any]) -> Times:
        """Return the sample times of all runs from t0 (s), with parameter values p (n, ...). Runs in `left_out` get
        none; invalid times are recorded in `bad`.
        """
        source = self.compiled.source
        follows = isinstance(self.t_end, str) and holds_names(spaced(self.t_end)) or bool(source.simulate_written)
        if self.ends is None and self.rows is None and not follows:
            t, requested = output_times(source, p[0], t0, self.t_end, self.output)
            return Times(t, np.full(len(p), len(t)), np.full(len(p), int(not requested)))
        found: dict[int, tuple[Array, bool]] = {}
        same: dict[Any, tuple[Array, bool]] = {}
        for i in range(len(p)):
            own = None if i in left_out else self._times_of_run(i, p[i], t0, same)
            if own is None:
                continue
            if len(found) == 1 and own is not next(iter(found.values())):  # a row for each is made of them
                check_memory(2 * 8 * float(len(p)) * len(own[0]), f"{len(p)} rows of times, {len(own[0])} each,")
            found[i] = own
        if self.bad and not found:
            raise next(iter(self.bad.values()))
        return Times.of_runs(found or {0: (np.array([t0]), True)}, len(p))

    def _times_of_run(
        self, i: int, p: Array, t0: float, same: dict[Any, tuple[Array, bool]]
    ) -> tuple[Array, bool] | None:
        """Return the `output_times` of run i, or None if they are not numbers. `same` caches them across runs."""
        source = self.compiled.source
        row = self.output if self.rows is None else self.rows[i]
        try:
            end = end_of(source, self.t_end if self.ends is None else _require_time(self.ends[i], "t_end"), p)
        except InputError as error:
            raise BadValueError(f"run {i}: {error}") from None
        if message := _message_if_not_finite(end, "t_end") or (
            "" if self.rows is None else _message_if_times_not_finite(row)
        ):
            self.bad[i] = BadValueError(message)
            return None
        alike = self.rows is None and not source.simulate_written and isinstance(end, (int, float, str))
        key = (type(end), end) if alike else None
        if key in same:
            return same[key]
        try:
            t = output_times(source, p, t0, end, row)
        except InputError as error:
            if end is None and self.rows is None:  # what the file says of its runs, with these numbers
                self.bad[i] = BadValueError(str(error))
                return None
            raise BadValueError(f"run {i}: {error}") from None
        return same.setdefault(key, t) if key else t

    def lengths_of_steps(self, method: str, p: Array, times: Times, left_out: dict[int, Any]) -> Array:
        """Return the fixed step (s) of each run, (n,); infinite where the method controls its step. Values of runs in
        `left_out` have no meaning.
        """
        steps = np.full(len(p), 1.0 if method == "rk4" or self.step is not None else math.inf)
        own = [i for i in range(len(p) if steps[0] < math.inf else 0) if i not in left_out and i not in self.bad]
        if self.step is not None and self.steps is None and times.t.ndim == 1 and own:
            steps[own] = self._step_of(own[0], self.step, method, p[own[0]], float(times.t[-1] - times.t[0]))
            return steps
        for i in own:
            step, t = self.step if self.steps is None else self.steps[i], times.of(i)
            if message := "" if self.steps is None else _message_if_not_finite(step, "step"):
                self.bad[i] = BadValueError(message)
                continue
            steps[i] = self._step_of(i, step, method, p[i], float(t[-1] - t[0]))
        if self.bad and len(self.bad | left_out) == len(p) and self.steps is not None:
            raise next(iter(self.bad.values()))
        return steps

    def _step_of(self, i: int, step: Any, method: str, p: Array, duration: float) -> float:
        """Return the checked step (s) of run i. Errors of the file's own expressions fail this run only."""
        try:
            h = step_of(self.compiled, step if self.steps is None else _require_time(step, "step"), method, p, duration)
            if duration / h > MAX_STEPS:
                raise BadValueError(f"step {h:.3g} s means more than {MAX_STEPS:.0e} steps")
        except InputError as error:
            if step is None and self.compiled.source.simulate_written:
                self.bad[i] = BadValueError(str(error))
                return 1.0
            if self.steps is None and self.ends is None and self.rows is None:
                raise
            raise BadValueError(f"run {i}: {error}") from None
        return h


def _require_time(value: Any, name: str) -> Any:
    """Return a time that is given for one run; raise BadValueError if it is None."""
    if value is None:
        raise BadValueError(f"{name} is None: expected a time (s)")
    return value


def _message_if_not_finite(value: Any, name: str) -> str:
    """Return a message if a float is not finite, else ""."""
    number = isinstance(value, (float, np.floating))
    return f"{name}: {value} is not a finite number" if number and not math.isfinite(value) else ""


def _message_if_times_not_finite(row: Any) -> str:
    """Return a message on the first sample time that is not finite, else "". Other types are refused by the reader."""
    try:
        t = np.asarray(row if np.size(row) <= MOST_OUTPUT else (), dtype=float)
    except (TypeError, ValueError):
        return ""
    odd = np.flatnonzero(~np.isfinite(t)).tolist() if t.ndim == 1 else []
    return f"output[{odd[0]}] is {t[odd[0]]}: expected finite numbers" if odd else ""

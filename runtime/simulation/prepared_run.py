"""Define `PreparedRun`: a run whose arguments are checked once, called with arrays of parameter values.

`Simulation.simulate` checks all arguments of each call and returns a Result. Loops of optimizers and samplers make many
calls that differ in parameter values only. A PreparedRun keeps its arrays and its pointers for C between the calls.
Scenes that need Python within a run or after it are run by `simulate`; so are values that `simulate` refuses, for the
same error.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from threading import Lock
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.assembly.journals import check_journal_positions
from gudgeon.assembly.rank import list_redundant_equations
from gudgeon.contract.boundary import (
    AUDIT_FAILS,
    CHECK_POSITION,
    NOT_CONFIRMED,
    NOT_VALID,
    RUN_FAILED,
    SERIES_READ,
    SET_PARAMETERS,
)
from gudgeon.errors import ArrayError, BadValueError, GudgeonError
from gudgeon.integrators import adaptive
from gudgeon.integrators.reusable_run import N_ROWS, ReusableRun
from gudgeon.integrators.threads import count_available_threads
from gudgeon.language.argument_checks import check_flag, check_text, is_integer
from gudgeon.language.quantities import has_names
from gudgeon.model.baumgarte import has_baumgarte_terms
from gudgeon.model.compiled import Array
from gudgeon.model.evaluation import check_sample_memory
from gudgeon.model.parameter_columns import ParameterColumns, check_parameter_arguments, read_values_in_order
from gudgeon.model.parameters import insert_space_before_unit
from gudgeon.results.batch import check_series_names
from gudgeon.simulation.arguments import (
    MAX_STEPS,
    PYTHON_TIME_LOOPS,
    compute_output_times,
    evaluate_end_time,
    evaluate_step,
    select_method,
)
from gudgeon.simulation.audit import (
    LIMITS,
    MAX_CALLS_OF_SHORT_RUN,
    SAMPLE_POSITIONS,
    list_inapplicable_checks,
    parse_audit_level,
)
from gudgeon.simulation.hidden_jumps import needs_jump_search
from gudgeon.simulation.sample_reader import SampleReader
from gudgeon.simulation.step_observers import check_requested_peaks

if TYPE_CHECKING:
    from gudgeon.results.results import Result
    from gudgeon.simulation.simulation import Simulation


@dataclass(frozen=True, eq=False)
class RunSetup:
    """Hold the checked arguments that prepared runs and steppers share; `settings` are those of `simulate` as given."""

    scene: Simulation  # the variant of the scene that the method needs
    names: tuple[str, ...]
    fixed: dict[str, Any]
    series: tuple[str, ...]
    method: str  # as select_method returns it
    rtol: float
    step: float | str | None
    stop: bool
    audit: int  # level of the audit
    settings: dict[str, Any]
    columns: ParameterColumns

    @staticmethod
    def from_arguments(
        simulation: Simulation,
        names_argument: str,
        names: str | Iterable[str],
        series: str | Iterable[str],
        fixed: Mapping[str, float | str] | None,
        settings: dict[str, Any],
    ) -> RunSetup:
        """Check the arguments and build the setup. Raises InputError.

        `names`: of the parameters that each run sets, from the argument `names_argument`; `series`: names of the series
        that it returns. `settings`: method, rtol, step, stop and audit; the method is chosen by select_method.

        Waits until the optimized library of the scene is compiled. `fixed` None: no fixed parameters.
        """
        step = settings["step"]
        scene = simulation.of_method(
            check_text(settings["method"], "method"), rtol=settings["rtol"], has_step=step is not None
        )
        source = scene.source
        method = select_method(source, settings["method"], step is not None)
        checked_names, constants = check_parameter_arguments(names, fixed, names_argument)
        scene.compiled.lib.wait_for_optimized_library()
        return RunSetup(
            scene,
            checked_names,
            constants,
            tuple(check_series_names(source, series, "series")),
            method,
            adaptive.parse_tolerance(settings["rtol"], method, step is not None),
            step,
            check_flag(settings["stop"], "stop"),
            parse_audit_level(settings["audit"]),
            settings,
            ParameterColumns(
                scene.compiled, checked_names, constants, has_baumgarte_terms(scene.source, method), N_ROWS
            ),
        )

    @property
    def needs_simulate(self) -> bool:
        """Return whether runs need `simulate`, whose checks or time loop are in Python.

        They do for methods with a time loop in Python, redundant constraint equations, and drives that may jump.
        """
        compiled = self.scene.compiled
        return (
            self.method in PYTHON_TIME_LOOPS
            or bool(list_redundant_equations(compiled))
            or needs_jump_search(compiled.source)
        )

    @property
    def has_journal_positions(self) -> bool:
        """Return whether the file's start places journals, whose positions must be checked for each run."""
        source = self.scene.source
        return bool(source.eccentricity_equations) or any(joint.is_corner for joint in source.clearances)

    def make_run(self, t: Array, steps: Array) -> ReusableRun:
        """Allocate and return the ReusableRun for sample times t (N,) and fixed steps (N_ROWS,), both in s.

        C audits samples as `audit._check_random_samples` does. The other checks of samples in audit.py need all
        quantities at all samples, which only `simulate` evaluates.
        """
        run = ReusableRun(self.columns, t, self.method, steps, self.rtol, self.stop, self.audit)
        left_out = list_inapplicable_checks(self.scene.source, self.method)
        run.repeated.drawn = SAMPLE_POSITIONS.tolist()
        run.repeated.limit = [math.inf if check in left_out else AUDIT_FAILS * x for check, x in LIMITS.items()]
        run.repeated.max_calls_of_short_run = MAX_CALLS_OF_SHORT_RUN
        return run

    def evaluate_step(self, k: int, duration: float) -> float:
        """Return the fixed step (s) of the run in row k, which lasts `duration` (s); infinity without one.

        Raises BadValueError.
        """
        h = evaluate_step(self.scene.compiled, self.step, self.method, self.columns.p[k], duration)
        if duration / h > MAX_STEPS:
            raise BadValueError(f"step {h:.3g} s means more than {MAX_STEPS:.0e} steps")
        return h

    def get_parameters(self, x: Array) -> dict[str, Any]:
        """Return the parameters of a run as a mapping, from the values x (n_names,) and the fixed ones."""
        return dict(zip(self.names, x.tolist(), strict=True)) | self.fixed


class PreparedRun:
    """Run a scene with parameter values from an array and return series as an array; `Simulation.prepare` returns it.

    `prepared(x)` with x (n_parameters,) in SI, in the order of `parameters`, returns (n_series, n_samples); with x
    (n_runs, n_parameters) it returns (n_runs, n_series, n_samples). Samples after the end of a run are NaN.

    One run raises the errors of `simulate`, without `partial`. Of several runs, those that fail have rows of NaN, and
    `failures` maps their indices to the errors. Calls release the global lock while C integrates. An object makes one
    call at a time: for threads, prepare one for each. It can be pickled, and is prepared again where it is loaded.
    """

    def __init__(self, simulation: Simulation, arguments: dict[str, Any]) -> None:
        self._simulation, self._lock = simulation, Lock()
        names = ("method", "rtol", "step", "stop", "audit")
        setup = self._setup = RunSetup.from_arguments(
            simulation,
            "parameters",
            arguments["parameters"],
            arguments["series"],
            arguments["fixed"],
            {name: arguments[name] for name in names},
        )
        source = setup.scene.source
        self._peaks = [str(name) for name in check_requested_peaks(source, arguments["peaks"] or ())]
        self._t_end, self._output = arguments["t_end"], arguments["output"]
        self._threads = _check_threads(arguments["threads"])
        t, self._n_skipped = self._compute_times(0)
        if self._output is not None and not is_integer(self._output):
            self._output = t[self._n_skipped :].copy()  # the caller may change an array
        checked = {"parameters": setup.names, "series": setup.series, "fixed": setup.fixed}
        self._arguments = arguments | checked | {"output": self._output, "peaks": self._peaks}
        check_sample_memory(setup.scene.compiled, len(t))
        is_expression = isinstance(self._t_end, str) and has_names(insert_space_before_unit(self._t_end))
        self._has_variable_times = is_expression or bool(source.simulate_expressions)
        self._has_variable_step = setup.method == "rk4" and (setup.step is None or self._has_variable_times)
        self._t, self._shape, self._run = t, (len(setup.names),), None
        if not (setup.needs_simulate or self._peaks):
            steps = np.full(N_ROWS, setup.evaluate_step(0, float(t[-1] - t[0])))
            self._run = setup.make_run(t, steps)
            self._reader = SampleReader(self._run, setup.series, self._n_skipped)
            self._is_set_in_python = (
                setup.has_journal_positions
                or setup.columns.needs_python
                or self._has_variable_times
                or self._has_variable_step
            )
        self.failures: dict[int, GudgeonError] = {}
        self.extremes = np.full((len(self._peaks), 2), np.nan)

    def __repr__(self) -> str:
        """Return mechanism, scene, and the numbers of parameters, series and samples in one line."""
        source, n_samples = self._setup.scene.source, len(self._t) - self._n_skipped
        sizes = f"{len(self.parameters)} parameters, {len(self.series)} series of {n_samples} samples"
        return f"<PreparedRun {source.mechanism}/{source.scene}: {sizes}>"

    @property
    def parameters(self) -> tuple[str, ...]:
        """Return the names of the parameters in the order of the values of a call."""
        return self._setup.names

    @property
    def series(self) -> tuple[str, ...]:
        """Return the names of the series in the order of the rows that a call returns."""
        return self._setup.series

    @property
    def t(self) -> Array:
        """Return the sample times (n_samples,) in s; where they depend on parameters, those of the last single run."""
        return self._t[self._n_skipped :].copy()

    def __call__(self, values: ArrayLike) -> Array:
        """Run the scene with these parameter values and return the series; see the class for shapes.

        Raises ArrayError for another shape or type. For one run it raises InputError for values that violate a
        condition of the file, AssemblyError for a start that does not close, SolverError and AuditError.
        """
        x = read_values_in_order(values, self.parameters, "values")
        if x.shape == self._shape:
            with self._lock:
                return self._run_single(x)
        if x.ndim != 2 or x.shape[1:] != self._shape:
            n = self._shape[0]
            raise ArrayError(
                f"values have shape {x.shape}, expected ({n},) or (n_runs, {n}): {', '.join(self.parameters)}"
            )
        with self._lock:
            return self._run_many(x)

    def __getstate__(self) -> dict[str, Any]:
        """Return the arguments for pickling."""
        return {"simulation": self._simulation, "arguments": self._arguments}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Prepare the run again."""
        self.__init__(**state)  # type: ignore[misc]

    def _compute_times(self, k: int) -> tuple[Array, int]:
        """Return the sample times (s) with the values in row k, from the start on, and 1 if the start is not requested.

        Raises BadValueError.
        """
        source, p = self._setup.scene.source, self._setup.columns.p[k]
        t, is_requested = compute_output_times(source, p, 0.0, evaluate_end_time(source, self._t_end, p), self._output)
        return t, int(not is_requested)

    def _update_times(self, k: int) -> None:
        """Update sample times and fixed step of the run in row k where they depend on its parameters.

        The arrays that C reads are changed in place. Raises InputError.
        """
        assert self._run
        if self._has_variable_times:
            t, _ = self._compute_times(k)
            self._t[:] = _check_sample_count(t, len(self._t))
        if self._has_variable_step:
            self._run.arrays["step"][k] = self._setup.evaluate_step(k, float(self._t[-1] - self._t[0]))

    def _run_single(self, x: Array) -> Array:
        """Return the series (n_series, n_samples) of the run with parameter values x (n_parameters,).

        The extremes of the requested peaks are stored in `extremes`. `simulate` runs scenes that need it, values that
        are not valid, and runs whose audit fails. Raises the error of a run that fails.
        """
        self.failures, run = {}, self._run
        if self._peaks:
            self.extremes = np.full((len(self._peaks), 2), np.nan)  # set at the end of the run
        if run is None:
            return self._simulate(x)
        k = run.next_row
        if not self._is_set_in_python:
            self._setup.columns.x[...] = x
            result = run.repeat(k, SET_PARAMETERS)
        else:
            result = run.repeat(k, CHECK_POSITION) if self._set_row(x, k) else NOT_VALID
        if result in (NOT_VALID, NOT_CONFIRMED):
            return self._simulate(x)
        if result == RUN_FAILED:
            raise run.build_error(k)
        return self._reader.read_row(k, result == SERIES_READ)

    def _set_row(self, x: Array, k: int) -> bool:
        """Set row k for parameter values x (n_parameters,) where Python must check them, or compute times and steps.

        Return whether they are valid. Raises InputError for positions of journals, times and steps.
        """
        run = self._run
        assert run
        if not run.set_row(x, k):
            return False
        if self._setup.has_journal_positions:
            check_journal_positions(run.compiled, run.arrays["p"][k])
        if self._has_variable_times or self._has_variable_step:
            self._update_times(k)
        return True

    def _get_run_arguments(self) -> dict[str, Any]:
        """Return the arguments that `simulate` and `simulate_many` share."""
        return {"t_end": self._t_end, "output": self._output, "peaks": self._peaks, **self._setup.settings}

    def _simulate(self, x: Array) -> Array:
        """Run `simulate` with parameter values x (n_parameters,), and return the series (n_series, n_samples).

        `extremes` and variable sample times are updated. Raises KeyboardInterrupt after Ctrl-C, and the errors of
        `simulate`.
        """
        result = self._setup.scene.simulate(parameters=self._setup.get_parameters(x), **self._get_run_arguments())
        if result.diagnostics.interrupted:
            raise KeyboardInterrupt
        if self._has_variable_times and self._run is None:
            self._setup.columns.compute_values_of_row(x, 0)
            self._t[:] = _check_sample_count(self._compute_times(0)[0], len(self._t))
        self.extremes = np.array([[peak.min, peak.max] for peak in map(result.peak, self._peaks)]).reshape(-1, 2)
        return _pad_series(result, self.series, len(self._t) - self._n_skipped)

    def _run_many(self, x: Array) -> Array:
        """Return the series (n_runs, n_series, n_samples) of runs with parameter values x (n_runs, n_parameters).

        Failed runs have NaN, and their errors are stored in `failures`. Raises KeyboardInterrupt after Ctrl-C.
        """
        values = np.full((len(x), len(self.series), len(self._t) - self._n_skipped), np.nan)
        self.failures, self.extremes = {}, np.full((len(x), len(self._peaks), 2), np.nan)
        magnitudes = np.abs(x)
        is_number = np.isfinite(x) & ((magnitudes >= np.finfo(float).tiny) | (x == 0.0))
        for i in np.flatnonzero(~is_number.all(axis=1)).tolist():
            j = int(is_number[i].argmin())
            self.failures[i] = BadValueError(f"{self.parameters[j]} is {x[i, j]}: expected a finite number")
        indices = np.flatnonzero(is_number.all(axis=1))
        if not len(indices):
            return values
        columns = dict(zip(self.parameters, x[indices].T, strict=True))
        parameters: Any = columns | self._setup.fixed if columns else [self._setup.fixed] * len(indices)
        keep = [name for name in self.series if name != "t"]
        batch = self._setup.scene.simulate_many(
            parameters, keep=keep, threads=self._threads, **self._get_run_arguments()
        )
        if batch.interrupted:
            raise KeyboardInterrupt
        self.failures |= {int(indices[failure.run]): failure.error for failure in batch.failures}
        for j, name in enumerate(self.series):
            values[indices, j] = _check_sample_count(np.moveaxis(batch[name], -1, 0), values.shape[-1]).T
        for j, name in enumerate(self._peaks):
            extremes = batch.peak(name)
            self.extremes[indices, j, 0], self.extremes[indices, j, 1] = extremes.min, extremes.max
        values[list(self.failures)] = np.nan
        return values


def _check_sample_count(samples: Array, n_samples: int) -> Array:
    """Return samples (n_samples, …); raise BadValueError if their number differs, because it depends on parameters."""
    if len(samples) != n_samples:
        message = f"output: {len(samples)} samples with these parameter values, {n_samples} when the run was prepared"
        raise BadValueError(message, hint="give output as a number of intervals, or as times")
    return samples


def _check_threads(threads: Any) -> int:
    """Return the number of threads; for None, that of the available cores. Raises BadValueError below 1."""
    if threads is not None and (not is_integer(threads) or threads < 1):
        raise BadValueError(f"threads is {threads!r}: expected a number of threads, 1 or more")
    return count_available_threads() if threads is None else int(threads)


def _pad_series(result: Result, names: Iterable[str], n_samples: int) -> Array:
    """Return series of a result as an array (n_series, n_samples), NaN after its last sample."""
    columns = [result[name] for name in names]
    values = np.full((len(columns), n_samples), np.nan)
    for row, column in zip(values, columns, strict=True):
        row[: len(column)] = column
    return values

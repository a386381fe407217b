"""Check the arguments of `simulate`: method, step, end of the run, and times of the samples."""

from __future__ import annotations

import math
import sys
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.contract.kernel_source import KernelSource, RuntimeParameter
from gudgeon.contract.methods import (
    ADAPTIVE,
    EXPLICIT,
    KINEMATIC,
    SMOOTH,
    STAGED,
    STAGES,
    STEP_CONTROLLED_METHODS,
    TAYLOR,
)
from gudgeon.errors import AssemblyError, BadValueError
from gudgeon.files.free_space import check_memory
from gudgeon.integrators import adaptive, kinematic, single_run
from gudgeon.integrators.batch import PythonLoop
from gudgeon.integrators.peers import driver
from gudgeon.integrators.trajectory import Problem, Trajectory
from gudgeon.language.argument_checks import check_flag, check_text, is_integer, shorten_value
from gudgeon.loading.compiler import has_compiler
from gudgeon.model.arrays import as_c_array
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.default_step import evaluate_scene_end_time, evaluate_scene_option, evaluate_scene_step
from gudgeon.model.parameters import insert_space_before_unit, read_parameter_value
from gudgeon.simulation.audit import parse_audit_level

# methods whose time loop runs in Python, with the function that runs them
PYTHON_TIME_LOOPS: dict[str, PythonLoop] = {
    KINEMATIC: kinematic.integrate_kinematic,
    **dict.fromkeys(driver.NAMES, driver.integrate_by_reference_solver),
}
METHODS = ("rk4", *STEP_CONTROLLED_METHODS, *SMOOTH, ADAPTIVE, *PYTHON_TIME_LOOPS)
MAX_STEPS = 10**12  # largest number of fixed steps of a run
DEFAULT_OUTPUT, MAX_OUTPUT = 1000, 10**8  # numbers of intervals: the default, and the largest that is allowed
OUTPUT = f"a whole number of intervals, 1 to {MAX_OUTPUT:.0e}, or times (s)"
MAX_CACHED_INTERVALS = 256  # largest number of equal intervals whose ends are cached
MAX_CHECKED_ITEMS = 10**4  # largest number of list entries that are searched for True and False
# shortest run in roundings of its times, the same in s, and latest end of a run in s
MIN_ROUNDINGS, MIN_DURATION_S, MAX_END_TIME_S = 1024, 1e-290, 1e18


class RunSettings(NamedTuple):
    """Hold the checked arguments of a run that depend on nothing but the scene."""

    needs_variant: bool  # the method needs another variant of the scene, which checks the arguments again
    method: str  # as select_method returns it
    rtol: float
    horizon: bool
    stop: bool
    audit: int  # level of the audit


@cache_by_values
def check_run_settings(
    source: KernelSource, method: Any, rtol: Any, has_step: bool, horizon: Any, stop: Any, audit: Any
) -> RunSettings:
    """Check the arguments of `Simulation.simulate` that depend on the scene only, and return them.

    `has_step`: whether a step is given. If the method needs another variant of the scene, or if dof < 0, method and
    tolerance are not checked; rtol is then NaN. Raises InputError.
    """
    flags = check_flag(horizon, "horizon"), check_flag(stop, "stop"), parse_audit_level(audit)
    check_text(method, "method")
    if (method in driver.NAMES and source.formulation != "full") or find_required_variant(
        source, method, rtol, has_step
    ):
        return RunSettings(True, method, math.nan, *flags)
    if source.degrees_of_freedom < 0:  # `simulate` names the joints that contradict each other
        return RunSettings(False, "", math.nan, *flags)
    selected = select_method(source, method, has_step)
    return RunSettings(False, selected, adaptive.parse_tolerance(rtol, selected, has_step), *flags)


def integrate_run(problem: Problem) -> Trajectory:
    """Integrate one run by its method, in C or Python, and return its trajectory.

    Ctrl-C ends the run; its trajectory up to then is returned. Raises KeyboardInterrupt if it has no sample.
    """
    return single_run.integrate_problem(problem, PYTHON_TIME_LOOPS.get(problem.method))


def parse_seconds(name: str, value: float | str) -> float:
    """Parse a time argument and return it in s: a number, or a text such as '5 ms' or '1e-3'. `name` is for messages.

    The time may be negative or zero: the caller checks its range. Raises InputError for NaN, infinite and subnormal
    numbers, another dimension, and values of other types.
    """
    if type(value) is float and sys.float_info.min <= abs(value) < math.inf:
        return value
    return read_parameter_value(value, RuntimeParameter(name, "s", 0.0, False, (0, 0, 1)))


def evaluate_end_time(source: KernelSource, t_end: float | str | None, p: Array) -> float | str | None:
    """Evaluate t_end (s) with the parameter values p if it is an expression with names such as '2*pi/omega'.

    Numbers, plain texts and None are returned unchanged. Raises InputError for unknown names or a wrong dimension.
    """
    if not isinstance(t_end, str):
        return t_end
    from gudgeon.language.quantities import evaluate_expression, has_names

    if not has_names(insert_space_before_unit(t_end)):
        return t_end
    values_by_name = {
        parameter.address.removeprefix("parameters."): (float(number), parameter.dimension)
        for parameter, number in zip(source.parameters, p, strict=False)
    }
    return evaluate_expression(insert_space_before_unit(t_end), "t_end", (0, 0, 1), values_by_name)


def compute_output_times(
    source: KernelSource, p: Array, t0: float, t_end: float | str | None, output: int | ArrayLike | None
) -> tuple[Array, bool]:
    """Return the increasing sample times (s) of a run from t0, and whether t0 itself is a requested sample.

    The times are a new array that begins with t0. They follow from `output`: times, or a number of intervals to t_end.
    If `t_end` or `output` is None, the value of the file holds, with parameter values `p`. Raises BadValueError,
    MemoryError.
    """
    if type(t_end) is float and type(output) is int and 1 <= output <= MAX_CACHED_INTERVALS:
        times = _compute_cached_times(source, t0, t_end, output)
        if times is not None:
            return times.copy(), True
    if isinstance(output, np.ndarray) and not output.ndim:
        output = output[()]
    if isinstance(output, (float, np.floating)):
        raise BadValueError(
            f"output is {shorten_value(output)}: expected {OUTPUT}", hint="a list for times: output=[0.5]"
        )
    if output is not None and not isinstance(output, bool) and not is_integer(output):
        times, requested = _check_output_times(t0, output)
        kind = np.asarray(output).dtype
        rounding = float(np.finfo(kind).eps) if kind.kind == "f" else 0.0
        _check_t_end_matches_output(
            None if t_end is None else parse_seconds("t_end", t_end), float(times[-1]), rounding
        )
        return times, requested
    end = parse_seconds("t_end", evaluate_scene_end_time(source, p) if t_end is None else t_end)
    if not end > t0:
        raise BadValueError(f"t_end is {end:g} s: expected a time after the start at {t0:g} s")
    intervals = evaluate_scene_option(source, "output", p, DEFAULT_OUTPUT) if output is None else output
    if isinstance(intervals, bool) or not 1 <= intervals <= MAX_OUTPUT:
        raise BadValueError(f"output is {shorten_value(intervals)}: expected {OUTPUT}")
    _check_duration("t_end is", t0, end, 4 * int(intervals))
    check_memory(2 * 8 * float(intervals), f"the times of {intervals} samples")
    return _compute_interval_ends(t0, end, int(intervals)), True


@cache_by_values
def _compute_cached_times(source: KernelSource, t0: float, end: float, intervals: int) -> Array | None:
    """Return the ends (s) of at most MAX_CACHED_INTERVALS equal intervals from t0 to `end`; callers must copy them.

    Return None if the run may be too short or end too late, so that `_check_duration` must decide. `source` is used as
    the owner of the cache only.
    """
    min_duration = max(4 * MIN_ROUNDINGS * math.ulp(max(abs(t0), abs(end))), MIN_DURATION_S)
    return _compute_interval_ends(t0, end, intervals) if min_duration < end - t0 and end <= MAX_END_TIME_S else None


def _compute_interval_ends(t0: float, end: float, intervals: int) -> Array:
    """Return the ends (s) of equal intervals, bit for bit those of numpy.linspace, which takes longer for few."""
    times = np.arange(intervals + 1.0)
    times *= (end - t0) / intervals
    times += t0
    times[-1] = end
    return times


def _check_output_times(t0: float, output: ArrayLike) -> tuple[Array, bool]:
    """Check the sample times (s) given by the user; return them from t0 on, and whether t0 is one of them.

    Raises BadValueError for booleans, no times, times that do not increase, and times before t0.
    """
    times = as_c_array(output, "output", (None,), require_finite=True, always_copy=True, max_entries=MAX_OUTPUT)
    if not isinstance(output, np.ndarray) or output.dtype.kind == "b":
        for k, value in enumerate(np.asarray(output, object)[:MAX_CHECKED_ITEMS]):
            if isinstance(value, (bool, np.bool_)):
                raise BadValueError(f"output[{k}] is {value}: expected a time (s)")
    if not len(times):
        raise BadValueError("output: expected at least one time (s), got none")
    decreasing = np.flatnonzero(~(np.diff(times) > 0.0))
    if len(decreasing):
        k = int(decreasing[0])
        raise BadValueError(f"output: expected increasing times (s), got {times[k + 1]!s} s after {times[k]!s} s")
    if times[0] < t0:
        raise BadValueError(f"output: times begin at {t0!s} s, got {times[0]!s} s")
    _check_duration("output ends", t0, float(times[-1]), 1)
    requested = bool(times[0] == t0)
    return times if requested else np.concatenate([[t0], times]), requested


def _check_t_end_matches_output(t_end: float | None, last_time: float, relative_tolerance: float) -> None:
    """Raise BadValueError if t_end and the last sample time `last_time` (s) differ by more than rounding.

    They may differ by half of `relative_tolerance`, at least 1e-9, of the larger one. None as t_end always passes.
    """
    if t_end is not None and not abs(t_end - last_time) <= max(1e-9, 0.5 * relative_tolerance) * max(
        abs(t_end), abs(last_time)
    ):
        hint = "leave out t_end (the last time of output ends the run), or end the times of output at t_end"
        raise BadValueError(f"t_end is {t_end:.12g} s, and the times of output end at {last_time:.12g} s", hint=hint)


def _check_duration(message_prefix: str, t0: float, end: float, min_roundings: int) -> None:
    """Raise BadValueError if the end of a run (s) is too close to its start t0 for distinct times, or too large.

    `message_prefix` begins the message; `min_roundings`: least duration in units of the last digit of the times.
    """
    if end > MAX_END_TIME_S:
        raise BadValueError(f"{message_prefix} {end:g} s: expected {MAX_END_TIME_S:g} s at most", hint="times are in s")
    min_duration = max(max(min_roundings, MIN_ROUNDINGS) * math.ulp(max(abs(t0), abs(end))), MIN_DURATION_S)
    if 0.0 < end - t0 < min_duration:
        raise BadValueError(
            f"{message_prefix} {end:.17g} s, {end - t0:.3g} s after the start at {t0:.9g} s:"
            f" expected {min_duration:.3g} s at least: sample times in a shorter run are equal after rounding",
            hint="times are in s",
        )


def find_required_variant(source: KernelSource, method: str, rtol: float | str | None, has_step: bool) -> str:
    """Return the variant of a scene that a method needs and its library lacks; "" if the library has the method,
    or if it cannot have the stages because the scene has no Jacobian.

    The variant is STAGES for methods with implicit stages, or the name of a Taylor method. "auto" needs the latter at
    tolerances at which it integrates by series, without a fixed step. Without a compiler, it uses the methods of the
    library. Raises BadValueError for such a run with an invalid `rtol`.
    """
    if method in STAGED:
        return "" if source.has_stage_matrices or source.reason_without_jacobian else STAGES
    if method == "auto" and source.max_taylor_tolerance and not source.taylor_file and not has_step:
        is_missing = (
            adaptive.lacks_taylor_series(source, adaptive.parse_tolerance(rtol, ADAPTIVE, False)) and has_compiler()
        )
        return TAYLOR if is_missing else ""
    return method if method in SMOOTH and not source.taylor_file else ""


def select_method(source: KernelSource, method: str, has_step: bool) -> str:
    """Return the name of the method that integrates the scene for the argument `method`, which may be "auto".

    "auto" gives rk4 if a step is given (`has_step`), kinematic analysis without degrees of freedom, else "adaptive".
    Raises BadValueError for a method that does not fit, AssemblyError if dof < 0.
    """
    dof = source.degrees_of_freedom
    if dof < 0:
        raise AssemblyError(
            f"{-dof} constraint equations more than coordinates: constraints are redundant or contradict each other\n"
            "  remove a drive or a joint; `gudgeon check -v` lists the constraint equations"
        )
    fitting_methods = source.methods
    if KINEMATIC not in fitting_methods and not source.is_explicit:
        fitting_methods = (
            *fitting_methods,
            ADAPTIVE,
            *(() if source.internal_states else driver.NAMES),
        )  # reference solvers integrate no internal states
    if source.taylor_file:
        fitting_methods = (*fitting_methods, *SMOOTH)
    if method == "auto":
        return (
            fitting_methods[0]
            if len(fitting_methods) == 1 or has_step
            else EXPLICIT
            if source.is_explicit
            else ADAPTIVE
        )
    if method not in METHODS:
        offered = ", ".join(name for name in METHODS if name != ADAPTIVE)  # internal name of the method of auto
        raise BadValueError(f"method {method!r}: expected auto, {offered}")
    if method not in fitting_methods:
        reason = f"this scene has {dof} degree{'' if dof == 1 else 's'} of freedom"
        if source.rigid_joints:
            reason = source.reason_without_jacobian
        elif source.internal_states:
            reason = (
                f"a law has an internal state ({next(filter(None, source.internal_states))}),"
                " which reference solvers do not integrate"
            )
        *others, last = source.methods
        fit = f"{', '.join(others)} and {last} fit it" if others else f"{last} fits it"
        raise BadValueError(f"method {method!r} does not fit: {reason}; use auto ({fit})")
    return method


def evaluate_step(compiled: CompiledModel, step: float | str | None, method: str, p: Array, duration: float) -> float:
    """Return the fixed step (s) of a run of `duration` (s); infinity where the method controls its step.

    If `step` is None, rk4 uses the step of the file or a default. Kinematic analysis ignores the step, but checks it.
    Raises BadValueError for a step that is not positive.
    """
    if step is None and method != "rk4":
        return math.inf
    if step is None:
        return evaluate_scene_step(compiled, p, duration)
    h = parse_seconds("step", step)
    if not h > 0:
        raise BadValueError(f"step is {h:g} s: expected a positive time")
    return math.inf if method == "kinematic" else h

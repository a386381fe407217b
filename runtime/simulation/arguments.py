"""Check the arguments of `simulate`: method, step, end of the run, and times of the samples."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from gudgeon.contract.kernel_source import KernelSource, Slot
from gudgeon.contract.methods import ADAPTIVE, CHOOSING, EXPLICIT, KINEMATIC, SMOOTH, STAGED, STAGES
from gudgeon.errors import AssemblyError, BadValueError
from gudgeon.files.free_space import check_memory
from gudgeon.integrators import batch, kinematic
from gudgeon.integrators.batch import Drive
from gudgeon.integrators.peers import driver
from gudgeon.integrators.trajectory import Problem, Trajectory
from gudgeon.language.argument_checks import is_whole, message
from gudgeon.model.arrays import as_c_array
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.default_step import scene_end, scene_number, scene_step
from gudgeon.model.parameters import number, spaced

# methods whose time loop runs in Python, with the function that runs them
DRIVES: dict[str, Drive] = {KINEMATIC: kinematic.run, **dict.fromkeys(driver.NAMES, driver.run)}
METHODS = ("rk4", *CHOOSING, *SMOOTH, ADAPTIVE, *DRIVES)
MAX_STEPS = 10**12  # largest number of fixed steps of a run
DEFAULT_OUTPUT, MOST_OUTPUT = 1000, 10**8  # numbers of intervals: the default, and the largest that is allowed
OUTPUT = f"a whole number of intervals, 1 to {MOST_OUTPUT:.0e}, or times (s)"
MOST_TRUTHS = 10**4  # largest number of list entries that are searched for True and False
# shortest run in roundings of its times, the same in s, and latest end of a run in s
NEAREST, SHORTEST, FURTHEST = 1024, 1e-290, 1e18


def integrate(problem: Problem) -> Trajectory:
    """Integrate one run by its method. Raise KeyboardInterrupt where nothing was reached."""
    return batch.integrate(problem, DRIVES.get(problem.method))


def seconds(name: str, value: float | str) -> float:
    """Return a time in s from a number or a text such as '5 ms' or '1e-3'. Raise InputError for anything else."""
    return number(value, Slot(name, "s", 0.0, False, (0, 0, 1)))


def end_of(source: KernelSource, t_end: float | str | None, p: Array) -> float | str | None:
    """Return t_end (s), evaluated with the parameter values p if it is an expression such as '2*pi/omega'. Numbers,
    plain texts and None are returned unchanged.
    """
    if not isinstance(t_end, str):
        return t_end
    from gudgeon.language.quantities import holds_names, number_of_names

    if not holds_names(spaced(t_end)):
        return t_end
    known = {
        slot.address.removeprefix("parameters."): (float(number), slot.dimension)
        for slot, number in zip(source.slots, p, strict=False)
    }
    return number_of_names(spaced(t_end), "t_end", (0, 0, 1), known)


def output_times(
    source: KernelSource, p: Array, t0: float, t_end: float | str | None, output: int | ArrayLike | None
) -> tuple[Array, bool]:
    """Return the increasing sample times (s) of a run from t0, and whether t0 itself is a requested sample.

    The times are a new array that begins with t0. `p` are the parameter values of the run. Raises BadValueError.
    """
    if isinstance(output, np.ndarray) and not output.ndim:
        output = output[()]
    if isinstance(output, (float, np.floating)):
        raise BadValueError(f"output is {message(output)}: expected {OUTPUT}", hint="a list for times: output=[0.5]")
    if output is not None and not isinstance(output, bool) and not is_whole(output):
        times, requested = _given_times(t0, output)
        kind = np.asarray(output).dtype
        rounding = float(np.finfo(kind).eps) if kind.kind == "f" else 0.0
        _check_t_end_matches_output(None if t_end is None else seconds("t_end", t_end), float(times[-1]), rounding)
        return times, requested
    end = seconds("t_end", scene_end(source, p) if t_end is None else t_end)
    if not end > t0:
        raise BadValueError(f"t_end is {end:g} s: expected a time after the start at {t0:g} s")
    intervals = scene_number(source, "output", p, DEFAULT_OUTPUT) if output is None else output
    if isinstance(intervals, bool) or not 1 <= intervals <= MOST_OUTPUT:
        raise BadValueError(f"output is {message(intervals)}: expected {OUTPUT}")
    _check_duration("t_end is", t0, end, 4 * int(intervals))
    check_memory(2 * 8 * float(intervals), f"the times of {intervals} samples")
    return np.linspace(t0, end, int(intervals) + 1), True


def _given_times(t0: float, output: ArrayLike) -> tuple[Array, bool]:
    """Return the checked sample times of the user from t0 on, and whether t0 is one of them.

    Raises BadValueError for booleans, times that do not increase, and times before t0.
    """
    times = as_c_array(output, "output", (None,), finite=True, own=True, most=MOST_OUTPUT)
    if not isinstance(output, np.ndarray) or output.dtype.kind == "b":
        for k, value in enumerate(np.asarray(output, object)[:MOST_TRUTHS]):
            if isinstance(value, (bool, np.bool_)):
                raise BadValueError(f"output[{k}] is {value}: expected a time (s)")
    if not len(times):
        raise BadValueError("output: expected at least one time (s), got none")
    back = np.flatnonzero(~(np.diff(times) > 0.0))
    if len(back):
        k = int(back[0])
        raise BadValueError(f"output: expected increasing times (s), got {times[k + 1]!s} s after {times[k]!s} s")
    if times[0] < t0:
        raise BadValueError(f"output: times begin at {t0!s} s, got {times[0]!s} s")
    _check_duration("output ends", t0, float(times[-1]), 1)
    requested = bool(times[0] == t0)
    return times if requested else np.concatenate([[t0], times]), requested


def _check_t_end_matches_output(t_end: float | None, last: float, rounding: float) -> None:
    """Raise BadValueError if t_end differs from the last of the given sample times by more than their `rounding`."""
    if t_end is not None and not abs(t_end - last) <= max(1e-9, 0.5 * rounding) * max(abs(t_end), abs(last)):
        hint = "leave out t_end, for the times say when the run ends, or let them end there"
        raise BadValueError(f"t_end is {t_end:.12g} s, and the times of output end at {last:.12g} s", hint=hint)


def _check_duration(what: str, t0: float, end: float, roundings: int) -> None:
    """Raise BadValueError if the end of a run is too close to its start for distinct times, or too large."""
    if end > FURTHEST:
        raise BadValueError(f"{what} {end:g} s: expected {FURTHEST:g} s at most", hint="times are in s")
    least = max(max(roundings, NEAREST) * float(np.spacing(max(abs(t0), abs(end)))), SHORTEST)
    if 0.0 < end - t0 < least:
        raise BadValueError(
            f"{what} {end:.17g} s, {end - t0:.3g} s after the start at {t0:.9g} s: expected {least:.3g} s at least, or"
            " numbers have no room for the times between",
            hint="times are in s",
        )


def derived_for(source: KernelSource, method: str) -> str:
    """Return the variant that a scene must be derived as for a method that its library lacks; "" if it has it."""
    if method in STAGED:
        return "" if source.stages or source.no_slopes else STAGES
    return method if method in SMOOTH and not source.taylor else ""


def method_of(source: KernelSource, method: str, fixed: bool) -> str:
    """Return the name of the method that integrates the scene, "adaptive" where auto switches between methods.

    `fixed` says that a step is given. Raises BadValueError for a method that does not fit, AssemblyError if dof < 0.
    """
    dof = source.degrees_of_freedom
    if dof < 0:
        raise AssemblyError(
            f"{-dof} constraint rows more than coordinates: constraints are redundant or contradict each other\n"
            "  remove a drive or a joint; `gudgeon check -v` lists the rows"
        )
    fitting = source.methods
    if KINEMATIC not in fitting and not source.explicit:
        fitting = (*fitting, ADAPTIVE, *(() if source.states else driver.NAMES))  # peers integrate no inner states
    if source.taylor:
        fitting = (*fitting, *SMOOTH)
    if method == "auto":
        return fitting[0] if len(fitting) == 1 or fixed else EXPLICIT if source.explicit else ADAPTIVE
    if method not in METHODS:
        offered = ", ".join(name for name in METHODS if name != ADAPTIVE)  # a name of ours for what auto runs
        raise BadValueError(f"method {method!r}: expected auto, {offered}")
    if method not in fitting:
        why = f"this scene has {dof} degree{'' if dof == 1 else 's'} of freedom"
        if source.rigid:
            why = source.no_slopes
        elif source.states:
            why = f"a law has an inner state ({next(filter(None, source.states))}), which peers do not integrate"
        *others, last = source.methods
        fit = f"{', '.join(others)} and {last} fit it" if others else f"{last} fits it"
        raise BadValueError(f"method {method!r} does not fit: {why}; use auto ({fit})")
    return method


def step_of(compiled: CompiledModel, step: float | str | None, method: str, p: Array, duration: float) -> float:
    """Return the fixed step (s) of a run, or infinity where the method controls its step."""
    if method == "kinematic" or (step is None and method != "rk4"):
        return math.inf
    if step is None:
        return scene_step(compiled, p, duration)
    h = seconds("step", step)
    if not h > 0:
        raise BadValueError(f"step is {h:g} s: expected a positive time")
    return h

"""Find switching points and jumps of drives that their expressions do not show, as in `acos(cos(t))` or `atan2`.

The generator finds the switching points of abs, min, max, ramp and roots of squares; steps end there. The others are
found here by sampling drives whose functions may hide them. Discontinuities of where and mod are found too.

Where second differences of f on an even grid stand out, they are followed to ever shorter distances h. They are
proportional to h² where f is smooth, to h where its rate jumps. They decrease more slowly where the rate is infinite,
and not at all where f jumps. Without degrees of freedom no impulse is lost, but rates near such a point are 0/0.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.methods import KINEMATIC
from gudgeon.errors import NonFiniteError, SolverError
from gudgeon.integrators.failure import NO_NUMBER
from gudgeon.language.functions import JUMPING, WITH_SWITCHING_POINTS, select_function_names
from gudgeon.language.tree import Binary, Call, Expr, Number, Unary, iterate_names, list_functions
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array
from gudgeon.model.file_expressions import evaluate_at_times, find_undefined_value_at_switch, read_expression_trees

_FUNCTIONS_HIDING_SWITCHING_POINTS = select_function_names(
    lambda f: f.hides_switching_points
)  # functions that may hide a switching point
# grid intervals, largest number of candidates of `_find_jumps`, and of `_find_first_discontinuity`
N_GRID_INTERVALS, MAX_JUMPS, MAX_BREAK_CANDIDATES = 4096, 16, 512
END_MARGIN = 1e-12  # fraction of a run's time that is searched after its end
# intervals of a refinement level, and number of levels; each is a quarter as wide as the one before
N_LEVEL_INTERVALS, N_LEVELS = 16, 11
MAX_LARGE_DIFFERENCES = 6  # number of intervals with large differences from which on there is no isolated point


@dataclass(frozen=True)
class Jump:
    """Describe a jump of a drive: its time (s), kind and size.

    Kinds: "rate" (by `size`, in the drive's unit per second), "infinite rate", "value" (by `size`), or a message
    `message`.
    """

    drive: str
    t: float
    kind: str
    size: float
    is_between_branches: bool = False  # whether the jump is between branches of where or mod
    message: str = ""  # message: a branch of a where is not a number at its own switching point


_Search: TypeAlias = tuple[str, Expr, Callable[..., list[Jump]]]  # in a drive with this expression


def find_hidden_jumps(source: KernelSource, p: Array, t0: float, t1: float) -> list[Jump]:
    """Return the jumps of value or rate of all drives between t0 and t1 (s), sorted by time.

    `p` holds the parameter values. A drive has at most MAX_JUMPS hidden jumps.
    """
    jumps = []
    for drive, tree in _list_drives_with_unknown_switching(source) if t1 > t0 else ():
        jumps += _find_jumps(source, p, tree, drive, t0, t1)
    for drive, tree in _list_drives_with_branches(source) if t1 > t0 else ():
        jumps += _find_first_discontinuity(source, p, tree, drive, t0, t1)
    return sorted(jumps, key=lambda jump: jump.t)


def needs_jump_search(source: KernelSource) -> bool:
    """Return whether `find_hidden_jumps` must search any drive of the scene."""
    return bool(_list_drives_with_unknown_switching(source) or _list_drives_with_branches(source))


@cache_by_values
def _list_jump_searches(source: KernelSource) -> list[_Search]:
    """Return the drives to search for jumps that end a run: name, expression and search function of each.

    For kinematic scenes they include drives whose switching points the generator finds: their rates may be infinite.
    """
    searches: list[_Search] = [
        (drive, tree, _find_jumps) for drive, tree in _list_drives_with_unknown_switching(source)
    ]
    searches += [(drive, tree, _find_first_discontinuity) for drive, tree in _list_drives_with_branches(source)]
    drives = {drive for drive, *_ in searches}
    others = () if _has_impulse_at_jump(source) else _list_drive_expressions(source)
    return searches + [
        (drive, tree, _find_unbounded_rates)
        for drive, tree in others
        if drive not in drives and _is_possibly_nonsmooth(tree)
    ]


def find_first_jumps(
    source: KernelSource, p: Array, t0: float, ends: Sequence[float], excluded_runs: Container[int] = ()
) -> dict[int, Jump]:
    """Return the first jump of each run after t0 and up to its end (s), by index; runs without one are absent.

    `p` (n_runs, …): parameter values. Drives with equal parameter values are searched once. Runs in
    `excluded_runs` are skipped.
    """
    if not _list_jump_searches(source):
        return {}
    first, known_jumps = dict[int, Jump](), dict[tuple[Any, ...], float | Jump]()
    for drive, tree, search in _list_jump_searches(source):
        used = {f"parameters.{name.path}" for name in iterate_names(tree)}
        columns = [k for k, parameter in enumerate(source.parameters) if parameter.address in used]
        for i, t1 in enumerate(ends):
            if i in excluded_runs or not t1 > t0:
                continue
            key = drive, t1, p[i, columns].tobytes()
            if key not in known_jumps:
                jumps = [jump for jump in search(source, p[i], tree, drive, t0, t1) if jump.t > t0]
                known_jumps[key] = min(jumps, key=lambda jump: jump.t, default=math.inf)
            jump = known_jumps[key]
            if isinstance(jump, Jump) and (i not in first or jump.t < first[i].t):
                first[i] = jump
    return first


def _has_impulse_at_jump(source: KernelSource) -> bool:
    """Return whether a jump of a drive would cause an impulse: the scene has drives and degrees of freedom."""
    return bool(source.drives) and KINEMATIC not in source.methods


def _list_drive_expressions(source: KernelSource) -> list[tuple[str, Expr]]:
    """Return the name and expression of each drive."""
    return [(info.address.split(".")[1], tree) for info, tree in read_expression_trees(source, ("drives",))]


def _list_drives_with_unknown_switching(source: KernelSource) -> list[tuple[str, Expr]]:
    """Return name and expression of the drives that may have switching points unknown to the generator.

    Drives in `source.rate_jumps` and drives with functions such as abs are left out: the generator knows their points.
    """
    return [
        (drive, tree)
        for drive, tree in _list_drive_expressions(source)
        if _is_possibly_nonsmooth(tree)
        and drive not in source.rate_jumps
        and WITH_SWITCHING_POINTS.isdisjoint(list_functions(tree))
    ]


def compute_end_before_jump(jump: Jump, t0: float) -> float:
    """Return the latest time (s) at which a run from t0 (s) may end without an error because of the jump.

    It is the time of the jump, less a relative margin of 1e-10 for a jump between branches of where or mod: rounding
    decides which branch holds at the jump.
    """
    return jump.t - (1e-10 * max(abs(t0), abs(jump.t)) if jump.is_between_branches else 0.0)


def build_jump_error(source: KernelSource, jump: Jump) -> SolverError:
    """Build the error that ends a run at a jump of a drive; NonFiniteError if a branch is not a number there."""
    why = "its rate is not defined there" if jump.kind == "rate" else "no linkage can follow it"
    message = _format_jump_error(jump, "the impulse there would be left out" if _has_impulse_at_jump(source) else why)
    return (NonFiniteError if jump.message else SolverError)(message, jump.t)


def _format_jump_error(jump: Jump, reason: str) -> str:
    """Return the error message of a jump, by its kind, with a remedy; `reason` says what makes it an error."""
    if jump.message:
        return f"{jump.message}\n  {NO_NUMBER}"
    if jump.kind == "infinite rate":
        return (
            f"drive {jump.drive}: its rate is infinite at t = {jump.t:.6g} s: velocities are not finite there\n"
            "  write it so that its rate is bounded, or end the run before"
        )
    if jump.is_between_branches:
        return (
            f"drive {jump.drive}: it jumps by {jump.size:.4g} at t = {jump.t:.6g} s: no linkage can follow it\n"
            "  give where and mod branches with equal values at their switching points, or end the run before"
        )
    jump_text = f"its rate jumps by about {jump.size:.3g}" if jump.kind == "rate" else f"it jumps by {jump.size:.4g}"
    return (
        f"drive {jump.drive}: {jump_text} at t = {jump.t:.6g} s, which its expression does not show: {reason}\n"
        "  write it with abs, min, max or ramp, whose switching points are found, or end the run before"
    )


def _is_possibly_nonsmooth(tree: Expr) -> bool:
    """Return whether an expression may be non-smooth at points that the generator does not detect.

    Such are functions with `hides_switching_points`, as acos and sqrt, powers whose exponent is not a natural number,
    and divisions by other than a number.
    """
    match tree:
        case Unary(operand=operand):
            return _is_possibly_nonsmooth(operand)
        case Binary(operator=operator, left=left, right=right):
            is_integer_power = isinstance(right, Number) and (operator == "/" or right.value == round(right.value) >= 0)
            return (
                operator in ("**", "/")
                and not is_integer_power
                or _is_possibly_nonsmooth(left)
                or _is_possibly_nonsmooth(right)
            )
        case Call(function=function, arguments=arguments):
            return function in _FUNCTIONS_HIDING_SWITCHING_POINTS or any(map(_is_possibly_nonsmooth, arguments))
    return False


def _list_drives_with_branches(source: KernelSource) -> list[tuple[str, Expr]]:
    """Return name and expression of the drives with where or mod, whose branches may differ at switching points."""
    return [
        (drive, tree) for drive, tree in _list_drive_expressions(source) if not JUMPING.isdisjoint(list_functions(tree))
    ]


@np.errstate(all="ignore")
def _find_first_discontinuity(
    source: KernelSource, p: Array, tree: Expr, drive: str, t0: float, t1: float
) -> list[Jump]:
    """Return the first jump of a drive's value between t0 and t1 (s), as a list of one Jump; [] without one.

    `drive` and `tree`: its name and expression, with where or mod. The end is included: the last sample may lie on
    either side of it. A branch that is not a number at its own switching point is returned as a Jump too.
    """
    end_margin = END_MARGIN * (t1 - t0)
    t1 += end_margin
    info = next(info for info, _ in read_expression_trees(source, ("drives",)) if info.address.split(".")[1] == drive)
    undefined = find_undefined_value_at_switch(source, p, info, tree, np.linspace(t0, t1, N_GRID_INTERVALS + 1))
    if undefined:
        t1 = undefined[1]
    ratios, h = (
        _compute_curvature_ratio(source, p, tree, t0, t1, "reflect"),
        (t1 - t0) / N_GRID_INTERVALS,
    )  # a jump in the last interval is detected too
    for k in np.flatnonzero(ratios > 3.0)[:MAX_BREAK_CANDIDATES].tolist():
        t = t0 + (k + 1) * h
        jump = _classify_jump(source, p, tree, drive, max(t - h, t0), min(t + h, t1))
        if jump and jump.kind == "value":
            near = evaluate_at_times(source, p, tree, np.array([t - h, t, t + h]))
            if (
                jump.size > 10.0 * end_margin * np.abs(np.diff(near)).max() / h
            ):  # else a jump of the rate, so near an end
                return [replace(jump, is_between_branches=True)]
    return [Jump(drive, t1, "no number", np.nan, is_between_branches=True, message=undefined[0])] if undefined else []


def _compute_curvature_ratio(
    source: KernelSource, p: Array, tree: Expr, t0: float, t1: float, pad_mode: Any = "edge"
) -> Array:
    """Return the ratio (N_GRID_INTERVALS − 1,) of a drive's second differences on a grid to the median of 17 of them.

    Rounding errors, 1e-14 of the largest value, are added to the median.

    `pad_mode`: how the differences are continued past the ends t0, t1 (mode of numpy.pad).
    """
    f = evaluate_at_times(source, p, tree, np.linspace(t0, t1, N_GRID_INTERVALS + 1))
    second_differences = np.abs(np.diff(f, 2))
    around = np.median(
        np.lib.stride_tricks.sliding_window_view(np.pad(second_differences, 8, mode=pad_mode), 17), axis=1
    )
    return np.asarray(second_differences / (around + 1e-14 * np.abs(f).max(initial=0.0) + 1e-300))


@np.errstate(all="ignore")
def _find_jumps(source: KernelSource, p: Array, tree: Expr, drive: str, t0: float, t1: float) -> list[Jump]:
    """Return the hidden jumps of one drive between t0 and t1 (s), at most MAX_JUMPS.

    They are in descending order of their curvature ratio, not of time. `drive` and `tree`: name and expression of the
    drive. Jumps closer than 2.5 grid intervals count as one.
    """
    ratios = _compute_curvature_ratio(source, p, tree, t0, t1)
    candidates = [k for k in np.argsort(-ratios, kind="stable")[: 4 * MAX_JUMPS].tolist() if ratios[k] > 3.0]
    jumps: list[Jump] = []
    h = (t1 - t0) / N_GRID_INTERVALS
    for k in candidates:
        t = t0 + (k + 1) * h
        if len(jumps) < MAX_JUMPS and all(abs(t - jump.t) > 2.5 * h for jump in jumps):
            jump = _classify_jump(source, p, tree, drive, max(t - h, t0), min(t + h, t1))
            jumps += [jump] if jump else []
    return jumps


def _find_unbounded_rates(source: KernelSource, p: Array, tree: Expr, drive: str, t0: float, t1: float) -> list[Jump]:
    """Return the hidden jumps of a drive at which its rate is infinite or its value is discontinuous."""
    return [jump for jump in _find_jumps(source, p, tree, drive, t0, t1) if jump.kind != "rate"]


def _classify_jump(source: KernelSource, p: Array, tree: Expr, drive: str, a: float, b: float) -> Jump | None:
    """Classify a candidate between a and b (s) as a jump of value, rate or infinite rate, and return the Jump.

    The largest second difference on shorter and shorter intervals h is proportional to h^n, with n near 0 for a jump of
    the value, 1 for a jump of the rate, between them for an infinite rate, 2 for a smooth drive. Return None if the
    drive is smooth or not a number there.
    """
    logs: list[float] = []
    sizes: list[float] = []  # of the rate's change
    for _ in range(N_LEVELS):
        times = np.linspace(a, b, N_LEVEL_INTERVALS + 1)
        f = evaluate_at_times(source, p, tree, times)
        curvatures = np.diff(f, 2)
        second_differences = np.abs(curvatures)
        if not np.isfinite(second_differences).all():
            return None  # no number there: another matter
        k = int(second_differences.argmax())
        if second_differences[k] < 1e-11 * np.abs(f).max(initial=0.0) or b - a < 1e-11 * max(abs(a), abs(b)):
            break
        if np.count_nonzero(second_differences > 0.25 * second_differences[k]) >= MAX_LARGE_DIFFERENCES:
            if abs(np.sign(curvatures).sum()) == len(curvatures):
                return None  # all have one sign: the intervals resolve a smooth function, as the tail of a narrow pulse
            break  # rounding, as of a square that is not quite one under its root
        logs.append(float(np.log(second_differences[k]) / np.log(4.0)))
        sizes.append(float(abs((f[-1] - f[-2]) - (f[1] - f[0])) / (times[1] - times[0])))
        value = float(second_differences[k])
        a, b = float(times[max(k - 1, 0)]), float(times[min(k + 3, N_LEVEL_INTERVALS)])
    if len(logs) < 5:
        return None
    exponents = -np.diff(logs)  # second differences ∝ h^exponent; the last digits may be rounding
    last_exponent = float(exponents[-4:].mean())
    if last_exponent > 1.4:
        return None
    # near an end of the interval, a jump of the rate shows by its distance from there, until that is wider
    exponent = max(float(np.median(exponents[: len(exponents) // 2 + 1])), last_exponent)
    kind = "rate" if exponent > 0.8 else "infinite rate" if exponent > 0.2 else "value"
    return Jump(drive, 0.5 * (a + b), kind, sizes[min(3, len(sizes) - 1)] if kind == "rate" else value)

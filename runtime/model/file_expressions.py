"""Evaluate expressions of the file at states of a run, and explain why one is NaN: find its undefined part.

This module finds the smallest undefined part of an expression, forces without a finite slope (which methods with a
Jacobian need) and drives without a bounded second rate. Expressions of parameters are also checked in the form of the
file, because the compiled form is simplified.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import ExpressionInfo, KernelSource
from gudgeon.language.tree import (
    Binary,
    Call,
    CurveCall,
    Expr,
    Number,
    Unary,
    evaluate,
    from_json,
    iterate_active_calls,
    iterate_calls,
    iterate_names,
    replace_names,
)
from gudgeon.language.undefined_parts import find_possibly_undefined_cases, find_undefined_part, is_defined_everywhere
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array, CompiledModel

if TYPE_CHECKING:
    pass

_SEARCH_OFFSETS = tuple(
    10.0**k for k in range(-13, -8)
)  # s, or fractions of the time: offsets after a state at which a reason is searched
MAX_SWITCHING_POINTS = 64  # largest number of switching points of a where that are examined
DEFINED_EVERYWHERE = ("force", "torque", "rotational_spring_damper")  # force elements with finite values
Values = Callable[[str], float]  # function that returns the value of a name
_DISTANCES = (1e-8, 1e-10, 1e-12)  # distances over which a difference is measured, for a size of 1
# smallest growth of an unbounded slope per shorter distance; largest difference that is rounding
_MIN_SLOPE_GROWTH, _ROUNDING_TOL = 3.0, 1e-13
# of the difference over the longest distance: if the shortest one has more, it is a jump, which methods handle
_MIN_JUMP_FRACTION = 0.9
REMEDY = "expected finite numbers: is there a division by zero, or a root of a negative number?"


def make_value_function(source: KernelSource, p: Array, t: float, q: Array, v: Array) -> Values:
    """Return a function from names to values at a state: t, parameters, coordinates and velocities (SI).

    q, v: (n,). The function accepts the names of expressions in a file, such as "L1.head.vx" and "ground.O.x"; it
    raises KeyError for others. Positions and velocities of points follow from those of their body.
    """
    index_of_coordinate = {name: k for k, name in enumerate(source.coordinates)}
    parameter_values = {parameter.address: float(p[k]) for k, parameter in enumerate(source.parameters)}
    points = {point.name: point for point in source.points}
    offset_of_component = {"x": 0, "y": 1, "theta": 2, "vx": 0, "vy": 1, "omega": 2}

    def evaluate_name(path: str) -> float:
        """Return the value of a name at the state. Raises KeyError for an unknown name.

        A point on a body has position and velocity from the body's coordinates and its arm; a point on the ground is
        constant.
        """
        if path == "t":
            return t
        for address in (f"parameters.{path}", path):  # path: "ground.O.x"
            if address in parameter_values:
                return parameter_values[address]
        owner, _, component = path.rpartition(".")
        state = v if component in ("vx", "vy", "omega") else q
        if owner.count(".") == 0:
            return float(state[index_of_coordinate[f"{owner}.x"] + offset_of_component[component]])
        point = points[owner]
        x, y = (0.0 if k < 0 else sign * float(p[k]) for k, sign in ((point.x, point.sign_x), (point.y, point.sign_y)))
        if point.body < 0:
            return (x, y)[offset_of_component[component]]
        first_index = 3 * point.body
        theta, omega = float(q[first_index + 2]), float(v[first_index + 2])
        dx, dy = x * math.cos(theta) - y * math.sin(theta), x * math.sin(theta) + y * math.cos(theta)
        displacement = (dx, dy) if state is q else (-omega * dy, omega * dx)
        return float(state[first_index + offset_of_component[component]]) + displacement[offset_of_component[component]]

    return evaluate_name


def evaluate_at_times(source: KernelSource, p: Array, tree: Expr, t: Array) -> Array:
    """Return the values (N,) of an expression of t and parameters at times t (N,). p: parameter values."""
    values = {parameter.address: float(p[k]) for k, parameter in enumerate(source.parameters)}
    return np.broadcast_to(evaluate(tree, lambda path: t if path == "t" else values[f"parameters.{path}"]), t.shape)


@cache_by_values
def read_expression_trees(source: KernelSource, kinds: Iterable[str]) -> list[tuple[ExpressionInfo, Expr]]:
    """Return the expressions of t and motion in sections `kinds` of the file (drives, forces, events), with trees."""
    selected = (info for info in source.file_expressions if info.address.split(".")[0] in kinds)
    return [(info, from_json(json.loads(info.tree))) for info in selected]


def may_powers_be_undefined(source: KernelSource) -> bool:
    """Return whether a drive or force of a scene, and thus its power, may be undefined at some time or position.

    It may with functions that are not defined for all numbers, and with parameters that are expressions. It may too
    with force elements along a line between two points, whose direction is undefined where both coincide.
    """
    trees = [tree for _, tree in read_expression_trees(source, ("drives", "forces"))]
    has_line = any(part.section == "forces" and part.kind not in DEFINED_EVERYWHERE for part in source.parts)
    return has_line or any(x.tree for x in source.parameters) or not all(map(is_defined_everywhere, trees))


def explain_undefined_value_after(
    source: KernelSource, p: Array, t: float, q: Array, v: Array, duration: float = 0.0
) -> str:
    """Return why a drive or force is not a number at a state, or within `duration` s after it; "" if all are numbers.

    States after it are extrapolated by the velocity. If q or v is not finite, only expressions of t and parameters are
    examined.
    """
    expressions = read_expression_trees(source, ("drives", "forces"))
    if not (np.isfinite(q).all() and np.isfinite(v).all()):
        expressions = [x for x in expressions if all("." not in name.path for name in iterate_names(x[1]))]
    scale = max(1.0, abs(t))
    times_after = (
        *(scale * dt for dt in _SEARCH_OFFSETS),
        *(duration * fraction for fraction in (0.01, 0.1, 0.5, 1.0)),
    )
    for h in (0.0, *times_after):
        with np.errstate(invalid="ignore"):  # a velocity may be infinite
            message = _explain_undefined_expression(source, expressions, p, t + h, q + h * v, v)
        if message:
            return message
    return ""


def explain_undefined_value_near(
    source: KernelSource, p: Array, t: float, q: Array, v: Array, duration: float = 0.0
) -> str:
    """Return why a drive or force is not a number at a state, or in a where-branch near it; else "".

    A step that ends or begins at a switching point evaluates both branches. Switching points are searched within
    `duration` s, at least a millionth of the time.
    """
    expressions = read_expression_trees(source, ("drives", "forces"))
    for h in (0.0, float(np.spacing(t))):
        if message := _explain_undefined_expression(source, expressions, p, t + h, q, v):
            return message
    search_range = max(duration, 1e-6 * max(1.0, abs(t)))
    for info, tree in expressions:
        for call in iterate_calls(tree, "where"):
            left, right = call.arguments[:2]
            difference = Binary("-", left, right)

            def is_first_branch_active(h: float, difference: Expr = difference) -> bool:
                """Return whether the compared difference is negative h s after the state."""
                return bool(evaluate(difference, make_value_function(source, p, t + h, q + h * v, v)) < 0.0)

            for low, high in pairwise(np.linspace(-search_range, search_range, 33).tolist()):
                if is_first_branch_active(low) != is_first_branch_active(high):
                    ends = _bisect_switching_point(is_first_branch_active, low, high)
                    messages = (_explain_undefined_branch(source, p, info, call, t + h, q + h * v, v) for h in ends)
                    if message := next(filter(None, messages), ""):
                        return message
    return ""


def find_undefined_value_at_switch(
    source: KernelSource, p: Array, info: ExpressionInfo, tree: Expr, t: Array
) -> tuple[str, float] | None:
    """Return (message, time) for a drive that is not a number at the switching point of a `where`; None if it is one.

    t (N,): increasing times between which the earliest such time is searched.
    """
    empty, messages_and_times = np.zeros(0), []
    for call in iterate_calls(tree, "where"):
        left, right = call.arguments[:2]
        difference = Binary("-", left, right)

        def is_first_branch_active(time: float, difference: Expr = difference) -> bool:
            """Return whether the compared difference is negative at a time."""
            return bool(evaluate_at_times(source, p, difference, np.array([time]))[0] < 0.0)

        is_negative = evaluate_at_times(source, p, difference, t) < 0.0
        for k in np.flatnonzero(is_negative[1:] != is_negative[:-1])[:MAX_SWITCHING_POINTS].tolist():
            for switch_time in _bisect_switching_point(is_first_branch_active, float(t[k]), float(t[k + 1])):
                values = make_value_function(source, p, switch_time, empty, empty)
                if any(other is call for other in iterate_active_calls(tree, "where", values)):
                    message = _explain_undefined_branch(source, p, info, call, switch_time, empty, empty)
                    messages_and_times += [(message, switch_time)] if message else []
    return min(messages_and_times, key=lambda message_and_time: message_and_time[1], default=None)


def _bisect_switching_point(predicate: Callable[[float], bool], low: float, high: float) -> tuple[float, float]:
    """Return two adjacent numbers in [low, high] between which a predicate changes, by bisection.

    The predicate must have different values at `low` and `high`. The search also stops at a distance of 1e-18.
    """
    value_at_low = predicate(low)
    while low < (middle := 0.5 * (low + high)) < high and high - low > 1e-18:
        low, high = (middle, high) if predicate(middle) == value_at_low else (low, middle)
    return low, high


def _explain_undefined_branch(
    source: KernelSource, p: Array, info: ExpressionInfo, call: Call, t: float, q: Array, v: Array
) -> str:
    """Return a text on an active branch of a where that is not a number, at its switching point; else "".

    call: the where in the expression `info`. Both branches count where the compared values are equal.
    """
    values = make_value_function(source, p, t, q, v)
    left, right, first_branch, second_branch = (evaluate(part, values) for part in call.arguments)
    for k, (value, is_active) in enumerate(((first_branch, left <= right), (second_branch, left >= right))):
        if is_active and not math.isfinite(value):
            explanation = explain_nonfinite_part(source, call.arguments[2 + k], values)
            location = f"(line {info.line}, column {info.column}): at t = {t:.9g} s, a switching point of its where"
            return f"{info.address} {location}, a branch is {value}: {explanation}"
    return ""


def explain_undefined_value_between(source: KernelSource, p: Array, t0: float, t1: float) -> tuple[str, float]:
    """Return why a drive ceases to be a number between t0 and t1 (s), and when; ("", t1) if none does.

    Each drive is sampled at 4001 times and just after t1; the time is located by bisection. Of several drives the
    earliest is returned.
    """
    empty, first_time, message = np.zeros(0), t1, ""
    for info, tree in read_expression_trees(source, ("drives",)):
        times = np.append(np.linspace(t0, t1, 4001), t1 + 1e-9 * max(1.0, abs(t1)))  # and just after the end
        invalid_samples = np.flatnonzero(~np.isfinite(evaluate_at_times(source, p, tree, times)))
        if not len(invalid_samples):
            continue
        low, high = (float(times[k]) for k in (max(invalid_samples[0] - 1, 0), invalid_samples[0]))
        for _ in range(60):
            middle = 0.5 * (low + high)
            is_finite = np.isfinite(evaluate_at_times(source, p, tree, np.array([middle])))[0]
            low, high = (middle, high) if is_finite else (low, middle)
        if not message or high < first_time:
            first_time, message = high, _explain_undefined_expression(source, [(info, tree)], p, high, empty, empty)
    return message, first_time


def explain_undefined_rate(compiled: CompiledModel, p: Array, times: Array, q: Array) -> tuple[str, float]:
    """Return which drive's rate or second rate is not a number first, and when; ("", last time) if all are numbers.

    times: increasing times (s) that are examined; q (n,): a position at which the constraint equations are evaluated.
    """
    drives = [k for k, row in enumerate(compiled.source.start_equations) if row.kind == "drive"]
    v = np.zeros(compiled.n)
    for t in times.tolist() if drives else ():
        for order, rates in (("rate", compiled.closed_nu(t, q, p)), ("second rate", compiled.closed_gamma(t, q, v, p))):
            if invalid_rows := [k for k in drives if not np.isfinite(rates[k])]:
                name = compiled.source.start_equations[invalid_rows[0]].name
                return f"the {order} of drive {name} is {-rates[invalid_rows[0]]:g} at t = {t:.9g} s", t
    return "", float(times[-1])


def _explain_undefined_expression(
    source: KernelSource, expressions: Iterable[tuple[ExpressionInfo, Expr]], p: Array, t: float, q: Array, v: Array
) -> str:
    """Return a message on the first of the expressions that is not finite at t, q, v; "" if all are finite.

    An example: "forces.push.value.x (line 7, column 12) is not finite at t = 0.3 s, nan: sqrt of -0.01".
    """
    values = make_value_function(source, p, t, q, v)
    for info, tree in expressions:
        value = float(evaluate(tree, values))
        if not math.isfinite(value):
            location = f"line {info.line}, column {info.column}"
            explanation = explain_nonfinite_part(source, tree, values)
            return f"{info.address} ({location}) is not finite at t = {t:.9g} s, {value}: {explanation}"
    return ""


def explain_nonfinite_part(source: KernelSource, tree: Expr, values: Values) -> str:
    """Return a text on the smallest part of an expression that is not finite although its inputs are.

    values: a function from names to values. A part that is a named expression of the file is located by its line.
    """
    path = _find_path_to_nonfinite_part(tree, values)
    named_expressions = _expand_named_expressions(source)
    owner = next((info for part in path[::-1] for info, expanded in named_expressions if expanded == part), None)
    location = f"in {owner.address} (line {owner.line}, column {owner.column}), " if owner else ""
    return location + _describe_part(path[-1], values)


def _expand_named_expressions(source: KernelSource) -> list[tuple[ExpressionInfo, Expr]]:
    """Return the file's named expressions, with the names of others replaced by their trees."""
    expressions = source.named_expressions
    trees_by_name = {info.address.partition(".")[2]: from_json(json.loads(info.tree)) for info in expressions}
    expanded_trees: dict[str, Expr] = {}

    def expand_tree(name: str) -> Expr:
        """Return the tree of a named expression with the names of others replaced by their trees."""
        if name not in expanded_trees:
            used = {used.path for used in iterate_names(trees_by_name[name])} & trees_by_name.keys()
            expanded_trees[name] = replace_names(trees_by_name[name], {other: expand_tree(other) for other in used})
        return expanded_trees[name]

    return [(info, expand_tree(name)) for name, info in zip(trees_by_name, expressions, strict=True)]


def _find_path_to_nonfinite_part(tree: Expr, values: Values) -> list[Expr]:
    """Return the path of parts from an expression to the smallest one that is not finite, both included."""
    for part in _find_active_parts(tree, values):
        if not isinstance(part, Number) and not math.isfinite(evaluate(part, values)):
            return [tree, *_find_path_to_nonfinite_part(part, values)]
    return [tree]


def _find_active_parts(tree: Expr, values: Values) -> tuple[Expr, ...]:
    """Return the operands or arguments on which the value of an expression depends; () for a number or a name.

    Of a `where` they are the two compared values and the active branch.
    """
    match tree:
        case Unary(operand=operand):
            return (operand,)
        case Binary(left=left, right=right):
            return left, right
        case Call(function="where", arguments=(left, right, then, otherwise)):
            return left, right, then if evaluate(left, values) < evaluate(right, values) else otherwise
        case Call(arguments=parts):
            return parts
    return ()


def _describe_part(tree: Expr, values: Values) -> str:
    """Return a description of an undefined operation with the values of its operands: "1 divided by 0".

    A function gives "f of 1, 2", a power "the power 0.5 of -1", a curve the range that the argument leaves.
    """
    part_values = [float(evaluate(part, values)) for part in _find_active_parts(tree, values)]
    texts = [f"{number:.12g}" for number in part_values]
    match tree:
        case Binary(operator="/"):
            return f"{texts[0]} divided by {texts[1]}"
        case Binary(operator="**"):
            return f"the power {texts[1]} of {texts[0]}"
        case Binary(operator=operator):
            return f"{texts[0]} {operator} {texts[1]}"
        case CurveCall(function=function, curve=curve):
            return f"curve {function} {curve.describe_out_of_range(part_values[0])}"
        case Call(function=function):
            return f"{function} of {', '.join(texts)}"
    return "a number that is not finite"


def find_unbounded_drive(compiled: CompiledModel, p: Array, t: float) -> str:
    """Return the drive whose second rate at t (s) is over 100 times that nearby, and thus unbounded; "" if none is.

    The second rates at t and at the next doubles are compared with those at t (1 ± 1e-4). NaN counts as infinite at t.
    Of several drives the one with the largest rate is returned.
    """
    zero = np.zeros(compiled.n)
    distance = 1e-4 * max(abs(t), 1e-9)
    times_t = (t - 8 * np.spacing(t), np.nextafter(t, -np.inf), t, np.nextafter(t, np.inf), t + 8 * np.spacing(t))
    at_t, near_t = (
        np.nan_to_num(np.abs([compiled.closed_gamma(float(s), zero, zero, p) for s in times]), nan=fill).max(axis=0)
        for times, fill in ((times_t, np.inf), ((t - distance, t + distance), 0.0))
    )
    rows = compiled.source.start_equations
    drives = [k for k, row in enumerate(rows) if row.kind == "drive" and at_t[k] > 100.0 * near_t[k]]
    return rows[max(drives, key=lambda k: at_t[k])].owner if drives else ""


def find_force_with_unbounded_slope(source: KernelSource, p: Array, t: float, q: Array, v: Array) -> str:
    """Return which force has an unbounded slope by a name of motion or t, or is not a number; "" if none has."""
    values, addresses = make_value_function(source, p, t, q, v), {parameter.address for parameter in source.parameters}
    for info, tree in read_expression_trees(source, ("forces",)):
        for path in sorted({name.path for name in iterate_names(tree)}):
            value = float(values(path))
            if f"parameters.{path}" not in addresses and _has_unbounded_slope(
                _make_function_of_name(tree, path, values), value
            ):
                location = f"{info.address} (line {info.line}, column {info.column})"
                argument_text = "" if path == "t" else f", {path} = {value:.9g}"
                return f"the slope of {location} by {path} is not finite at t = {t:.9g} s{argument_text}"
    return ""


def _make_function_of_name(tree: Expr, path: str, values: Values) -> Callable[[float], float]:
    """Return an expression as a function of one of its names, `path`; other names have their `values`."""
    return lambda x: float(evaluate(tree, lambda name: x if name == path else values(name)))


def _has_unbounded_slope(function: Callable[[float], float], point: float) -> bool:
    """Return whether a function is finite at a point, but its slope is not.

    Slopes are measured over shorter and shorter distances on both sides and must grow by _MIN_SLOPE_GROWTH each time. A
    jump does not count. True is returned also if the function is not finite next to the point.
    """
    value, size = function(point), 1.0 + abs(point)
    for signed_size in (-size, size):
        differences = [abs(function(point + signed_size * distance) - value) for distance in _DISTANCES]
        if not all(map(math.isfinite, differences)):
            return math.isfinite(value)
        slopes = [difference / distance for difference, distance in zip(differences, _DISTANCES, strict=True)]
        is_growing = all(
            next_slope > _MIN_SLOPE_GROWTH * slope for slope, next_slope in zip(slopes, slopes[1:], strict=False)
        )
        if is_growing and _ROUNDING_TOL * abs(value) < differences[-1] < _MIN_JUMP_FRACTION * differences[0]:
            return True
    return False


@dataclass(frozen=True)
class PossiblyUndefinedExpression:
    """Hold an expression that may be undefined; `parameter_index`: of the parameter that it
    defines, −1: none; `indices_by_name`: of the parameters in it."""

    address: str
    tree: Expr
    parameter_index: int
    indices_by_name: Mapping[str, int]


def find_undefined_runs(source: KernelSource, p: Array, is_given: NDArray[np.generic]) -> NDArray[np.bool_]:
    """Return a mask (n,) of runs with p (n, n_parameters + n_derived) that may have an undefined value.

    Values given, by the mask is_given (n, n_parameters), do not count. `describe_undefined_part` decides exactly.
    """
    has_undefined = np.zeros(len(p), dtype=np.bool_)
    for expression in _find_affected_expressions(source, p):
        values_by_name = {name: p[:, k] for name, k in expression.indices_by_name.items()}
        undefined = find_possibly_undefined_cases(expression.tree, values_by_name)
        has_undefined |= (
            undefined & ~is_given[:, expression.parameter_index].astype(bool)
            if expression.parameter_index >= 0
            else undefined
        )
    return has_undefined


def describe_undefined_part(source: KernelSource, p: Array, is_given: NDArray[np.generic]) -> str:
    """Return a message on the first expression of a run with an undefined part; "" if there is none.

    p: (n_p,). Expressions of parameters that are given, by the mask is_given (n_parameters,), are skipped.
    """
    for expression in _find_affected_expressions(source, p[np.newaxis]):
        values_by_name = {name: float(p[k]) for name, k in expression.indices_by_name.items()}
        if expression.parameter_index >= 0 and is_given[expression.parameter_index]:
            continue
        if (undefined_part := find_undefined_part(expression.tree, values_by_name)) is not None:
            values_text = ", ".join(f"{name} = {number:.6g}" for name, number in values_by_name.items())
            return f"{expression.address} has a part that is {undefined_part} with {values_text}\n  {REMEDY}"
    return ""


def _find_affected_expressions(source: KernelSource, p: Array) -> list[PossiblyUndefinedExpression]:
    """Return the possibly undefined expressions with a parameter that differs from the file's in at least one run.

    p: parameter values (n_runs, n_p). Indices and defaults of the parameters are cached in the source.
    """
    cache, expressions = vars(source), list_possibly_undefined_expressions(source)
    if "partial_indices" not in cache:
        parameter_indices = sorted({k for expression in expressions for k in expression.indices_by_name.values()})
        cache["partial_indices"] = parameter_indices
        cache["partial_defaults"] = np.array([source.parameters[k].default for k in parameter_indices])
    parameter_indices = cache["partial_indices"]
    is_changed = (p[:, parameter_indices] != cache["partial_defaults"]).any(axis=0)
    if not is_changed.any():
        return []
    changed_indices = {parameter_indices[k] for k in np.flatnonzero(is_changed).tolist()}
    return [
        expression for expression in expressions if not changed_indices.isdisjoint(expression.indices_by_name.values())
    ]


def list_possibly_undefined_expressions(source: KernelSource) -> list[PossiblyUndefinedExpression]:
    """Return the expressions of parameters, drives and forces that may be undefined; read once for each source."""
    cache = vars(source)
    if "partials" not in cache:
        cache["partials"] = _read_possibly_undefined_expressions(source)
    result: list[PossiblyUndefinedExpression] = cache["partials"]
    return result


def _read_possibly_undefined_expressions(source: KernelSource) -> list[PossiblyUndefinedExpression]:
    """Return the expressions of parameters, drives and forces that may be undefined, from the source's JSON trees."""
    parameter_index, result = source.parameter_indices, []
    trees = [(parameter.address, parameter.tree, k) for k, parameter in enumerate(source.parameters) if parameter.tree]
    for address, tree, k in [*trees, *((info.address, info.tree, -1) for info in source.file_expressions)]:
        expr = from_json(json.loads(tree))
        paths = dict.fromkeys(name.path for name in iterate_names(expr))
        indices = {name: parameter_index.get(f"parameters.{name}", parameter_index.get(name, -1)) for name in paths}
        if not is_defined_everywhere(expr):
            result.append(
                PossiblyUndefinedExpression(address, expr, k, {name: i for name, i in indices.items() if i >= 0})
            )
    return result

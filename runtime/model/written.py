"""Explain why a file's expression is not a number at a state, by walking its tree again after C found the failure.

- Why an expression is not a number: its smallest part that is not, and the names in it.
- Which force has no finite slope at a state, and which drive has no bounded second rate at a time. Methods that use
  the Jacobian cannot continue at a force without a slope.
- Numbers that are undefined as the file writes them, where simplified formulas have a value: C has d for
  cos(acos(d)). The file's own values were checked when it was read; here those of a run are.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.kernel_source import KernelSource, WrittenInfo
from gudgeon.language.defined import find_undefined_part, is_total_expression, may_be_undefined
from gudgeon.language.tree import (
    Binary,
    Call,
    CurveCall,
    Expr,
    Number,
    Unary,
    calls,
    evaluate,
    from_json,
    names,
    reached,
    replaced,
)
from gudgeon.model.compiled import Array, CompiledModel, Evaluation

if TYPE_CHECKING:
    from gudgeon.results.results import Result

_REACH = tuple(10.0**k for k in range(-13, -8))  # s, or of the time: how far after a state a reason is searched
MOST_CORNERS = 64  # largest number of switching points of a where that are examined
Values = Callable[[str], float]  # function that returns the value of a name
_SHORT = (1e-8, 1e-10, 1e-12)  # distances over which a rise is measured, for a size of 1
_STEEPER, _ROUNDING = 3.0, 1e-13  # smallest growth of the slope per shorter distance; largest rise that is rounding
_JUMP = 0.9  # of the rise over the longest distance: if the shortest has more, it is a jump, which methods handle
REMEDY = "expected finite numbers: is there a division by zero, or a root of a negative number?"


def values_at(source: KernelSource, p: Array, t: float, q: Array, v: Array) -> Values:
    """Return a function from names to values at a state: t, parameters, coordinates and velocities."""
    place = {name: k for k, name in enumerate(source.coordinates)}
    slots = {slot.address: float(p[k]) for k, slot in enumerate(source.slots)}
    points = {point.name: point for point in source.points}
    position = {"x": 0, "y": 1, "theta": 2, "vx": 0, "vy": 1, "omega": 2}

    def value(path: str) -> float:
        """Return the value of a name at the state."""
        if path == "t":
            return t
        if (address := f"parameters.{path}") in slots:
            return slots[address]
        if (address := f"{path.rpartition('.')[0]}.{path.rpartition('.')[2]}") in slots:  # "ground.O.x"
            return slots[address]
        owner, _, part = path.rpartition(".")
        state = v if part in ("vx", "vy", "omega") else q
        if owner.count(".") == 0:
            return float(state[place[f"{owner}.x"] + position[part]])
        point = points[owner]
        x, y = (0.0 if k < 0 else sign * float(p[k]) for k, sign in ((point.x, point.sign_x), (point.y, point.sign_y)))
        if point.body < 0:
            return (x, y)[position[part]]
        first = 3 * point.body
        theta, omega = float(q[first + 2]), float(v[first + 2])
        dx, dy = x * math.cos(theta) - y * math.sin(theta), x * math.sin(theta) + y * math.cos(theta)
        moved = (dx, dy) if state is q else (-omega * dy, omega * dx)
        return float(state[first + position[part]]) + moved[position[part]]

    return value


def values_of_time(source: KernelSource, p: Array, tree: Expr, t: Array) -> Array:
    """Return the values (N,) of an expression of t and parameters at times t (N,)."""
    slots = {slot.address: float(p[k]) for k, slot in enumerate(source.slots)}
    return np.broadcast_to(evaluate(tree, lambda path: t if path == "t" else slots[f"parameters.{path}"]), t.shape)


def trees(source: KernelSource, kinds: Iterable[str]) -> list[tuple[WrittenInfo, Expr]]:
    """Return the file's expressions of t and motion in some sections (drives, forces, events), with their trees."""
    return [(info, from_json(json.loads(info.tree))) for info in source.written if info.address.split(".")[0] in kinds]


def reason(source: KernelSource, p: Array, t: float, q: Array, v: Array, ahead: float = 0.0) -> str:
    """Return why a drive or force is not a number at a state, or within `ahead` s after it; "" if all are."""
    found = trees(source, ("drives", "forces"))
    if not (np.isfinite(q).all() and np.isfinite(v).all()):
        found = [(info, tree) for info, tree in found if all("." not in name.path for name in names(tree))]
    later = (*(reach * max(1.0, abs(t)) for reach in _REACH), *(ahead * share for share in (0.01, 0.1, 0.5, 1.0)))
    for h in (0.0, *later):
        with np.errstate(invalid="ignore"):  # a velocity may be infinite
            message = _message_at(source, found, p, t + h, q + h * v, v)
        if message:
            return message
    return ""


def undefined_here(source: KernelSource, p: Array, t: float, q: Array, v: Array, ahead: float = 0.0) -> str:
    """Return why a drive or force is not a number at a state, or in a where-branch near it; else "".

    A step that ends or begins at a switching point evaluates both branches.
    """
    found = trees(source, ("drives", "forces"))
    for h in (0.0, float(np.spacing(t))):
        if message := _message_at(source, found, p, t + h, q, v):
            return message
    reach = max(ahead, 1e-6 * max(1.0, abs(t)))
    for info, tree in found:
        for call in calls(tree, "where"):
            left, right = call.arguments[:2]
            gap = Binary("-", left, right)

            def ahead_of_zero(h: float, gap: Expr = gap) -> bool:
                """Return whether the compared difference is negative h s after the state."""
                return bool(evaluate(gap, values_at(source, p, t + h, q + h * v, v)) < 0.0)

            for low, high in pairwise(np.linspace(-reach, reach, 33).tolist()):
                if ahead_of_zero(low) != ahead_of_zero(high):
                    ends = _neighbours(ahead_of_zero, low, high)
                    words = (_branch_message(source, p, info, call, t + h, q + h * v, v) for h in ends)
                    if message := next(filter(None, words), ""):
                        return message
    return ""


def undefined_at_a_corner(
    source: KernelSource, p: Array, info: WrittenInfo, tree: Expr, t: Array
) -> tuple[str, float] | None:
    """Return what of a drive is not a number where one of its wheres switches, and when; None if all is."""
    none = np.zeros(0)
    found = []
    for call in calls(tree, "where"):
        left, right = call.arguments[:2]
        gap = Binary("-", left, right)

        def ahead_of_zero(time: float, gap: Expr = gap) -> bool:
            """Return whether the compared difference is negative at a time."""
            return bool(values_of_time(source, p, gap, np.array([time]))[0] < 0.0)

        before = values_of_time(source, p, gap, t) < 0.0
        for k in np.flatnonzero(before[1:] != before[:-1])[:MOST_CORNERS].tolist():
            for end in _neighbours(ahead_of_zero, float(t[k]), float(t[k + 1])):
                values = values_at(source, p, end, none, none)
                if any(other is call for other in reached(tree, "where", values)):
                    message = _branch_message(source, p, info, call, end, none, none)
                    found += [(message, end)] if message else []
    return min(found, key=lambda one: one[1], default=None)


def _neighbours(answer: Callable[[float], bool], low: float, high: float) -> tuple[float, float]:
    """Return two adjacent numbers between `low` and `high` between which the answer changes, by bisection."""
    first = answer(low)
    while low < (middle := 0.5 * (low + high)) < high and high - low > 1e-18:
        low, high = (middle, high) if answer(middle) == first else (low, middle)
    return low, high


def _branch_message(source: KernelSource, p: Array, info: WrittenInfo, call: Call, t: float, q: Array, v: Array) -> str:
    """Return a text on an active branch of a where that is not a number, at its switching point; else ""."""
    values = values_at(source, p, t, q, v)
    left, right, then, otherwise = (evaluate(part, values) for part in call.arguments)
    for k, (value, meant) in enumerate(((then, left <= right), (otherwise, left >= right))):
        if meant and not math.isfinite(value):
            place = f"line {info.line}, column {info.column}"
            why = explain_culprit(source, call.arguments[2 + k], values)
            corner = f"at t = {t:.9g} s, where its where changes over"
            return f"{info.address} ({place}): {corner}, a branch is {value}: {why}"
    return ""


def reason_between(source: KernelSource, p: Array, t0: float, t1: float) -> tuple[str, float]:
    """Return why a drive ceases to be a number between t0 and t1 (s), and when; ("", t1) if none does."""
    none, first, message = np.zeros(0), t1, ""
    for info, tree in trees(source, ("drives",)):
        times = np.append(np.linspace(t0, t1, 4001), t1 + 1e-9 * max(1.0, abs(t1)))  # and just after the end
        wrong = np.flatnonzero(~np.isfinite(values_of_time(source, p, tree, times)))
        if not len(wrong):
            continue
        high = float(times[wrong[0]])
        low = float(times[max(wrong[0] - 1, 0)])
        for _ in range(60):
            middle = 0.5 * (low + high)
            if np.isfinite(values_of_time(source, p, tree, np.array([middle])))[0]:
                low = middle
            else:
                high = middle
        if not message or high < first:
            first, message = high, _message_at(source, [(info, tree)], p, high, none, none)
    return message, first


def rate_reason(compiled: CompiledModel, p: Array, times: Array, q: Array) -> tuple[str, float]:
    """Return which drive's rate or second rate is not a number first, and when; ("", last time) if all are."""
    drives = [k for k, row in enumerate(compiled.source.start_rows) if row.kind == "drive"]
    v = np.zeros(compiled.n)
    for t in times.tolist() if drives else ():
        for of, rows in (("rate", compiled.closed_nu(t, q, p)), ("second rate", compiled.closed_gamma(t, q, v, p))):
            wrong = [k for k in drives if not np.isfinite(rows[k])]
            if wrong:
                name = compiled.source.start_rows[wrong[0]].name
                return f"the {of} of drive {name} is {-rows[wrong[0]]:g} at t = {t:.9g} s", t
    return "", float(times[-1])


def with_notes_on_undefined(run: Result, evaluation: Evaluation) -> Result:
    """Return the run with notes on outputs that are not numbers although all their inputs are.

    Drives and forces by a `where` that compares values that are not numbers are noted too: C takes one branch.
    """
    compared = _comparing_expressions(run.source)
    if not run.source.outputs and not compared:
        return run
    probe = replace(run, stored={})  # without cached series of many samples
    probe.__dict__["evaluation"] = evaluation
    outputs = {f"output {name}": from_json(tree) for name, tree in run.source.outputs.items() if name in probe}
    for address, tree in compared.items():
        if all(used.path in probe.parameters or used.path in probe for used in names(tree)):
            outputs[address] = tree
    odd = [message for name, tree in outputs.items() if (message := _message_if_undefined(probe, name, tree))]
    notes = (*run.diagnostics.notes, *odd)
    return replace(run, diagnostics=replace(run.diagnostics, notes=notes)) if odd else run


def _comparing_expressions(source: KernelSource) -> dict[str, Expr]:
    """Return the drives and forces, by address, with a `where` that may compare values that are not numbers."""
    kept = vars(source)
    if "compared" not in kept:
        found = {info.address: tree for info, tree in trees(source, ("drives", "forces"))}
        kept["compared"] = {
            address: tree
            for address, tree in found.items()
            if not all(is_total_expression(one) for call in calls(tree, "where") for one in call.arguments[:2])
        }
    return dict(kept["compared"])


def _message_if_undefined(run: Result, name: str, tree: Expr) -> str:
    """Return when an expression is first not a number, and why; "" if it always is, or only if its inputs are not."""
    parts = {used.path: np.broadcast_to(run.value_of(used.path), run.t.shape) for used in names(tree)}
    values = np.broadcast_to(evaluate(tree, parts.__getitem__), run.t.shape)
    wrong = ~np.isfinite(values)
    for part in parts.values() if wrong.any() else ():
        wrong &= np.isfinite(part)
    if not wrong.any():
        return ""
    k, count = int(wrong.argmax()), int(wrong.sum())
    why = explain_culprit(run.source, tree, lambda path: float(parts[path][k]))
    others = f"; it is none at {count} of {len(wrong)} samples" if count > 1 else ""
    return f"{name} is no number ({values[k]}) at t = {run.t[k]:.9g} s: {why}{others}"


def _message_at(
    source: KernelSource, found: Iterable[tuple[WrittenInfo, Expr]], p: Array, t: float, q: Array, v: Array
) -> str:
    """Return a message on the first expression that is not a number at a state; "" if all are."""
    values = values_at(source, p, t, q, v)
    for info, tree in found:
        value = float(evaluate(tree, values))
        if not math.isfinite(value):
            place = f"line {info.line}, column {info.column}"
            why = explain_culprit(source, tree, values)
            return f"{info.address} ({place}) is not finite at t = {t:.9g} s, {value}: {why}"
    return ""


def explain_culprit(source: KernelSource, tree: Expr, values: Values) -> str:
    """Return a text on the smallest part of an expression that is not finite although its inputs are."""
    way = _path_to_culprit(tree, values)
    called = _expanded_expressions(source)
    within = next((one for part in way[::-1] for one, whole in called if whole == part), None)
    place = f"in {within.address} (line {within.line}, column {within.column}), " if within else ""
    return place + _describe_part(way[-1], values)


def _expanded_expressions(source: KernelSource) -> list[tuple[WrittenInfo, Expr]]:
    """Return the file's named expressions with the trees of others in place of their names."""
    written = {one.address.partition(".")[2]: from_json(json.loads(one.tree)) for one in source.expressions}
    known: dict[str, Expr] = {}

    def whole(name: str) -> Expr:
        """Return the tree of a named expression with all others put in."""
        if name not in known:
            used = {used.path for used in names(written[name])} & written.keys()
            known[name] = replaced(written[name], {other: whole(other) for other in used})
        return known[name]

    return [(one, whole(name)) for name, one in zip(written, source.expressions, strict=True)]


def _path_to_culprit(tree: Expr, values: Values) -> list[Expr]:
    """Return the path of parts from an expression to the smallest one that is not finite."""
    for part in _parts(tree, values):
        if not isinstance(part, Number) and not math.isfinite(evaluate(part, values)):
            return [tree, *_path_to_culprit(part, values)]
    return [tree]


def _parts(tree: Expr, values: Values) -> tuple[Expr, ...]:
    """Return the parts on which the value of an expression depends."""
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
    """Return a description of an expression with the values of its parts: "1 divided by 0"."""
    numbers = [float(evaluate(part, values)) for part in _parts(tree, values)]
    message = [f"{number:.12g}" for number in numbers]
    match tree:
        case Binary(operator="/"):
            return f"{message[0]} divided by {message[1]}"
        case Binary(operator="**"):
            return f"the power {message[1]} of {message[0]}"
        case Binary(operator=operator):
            return f"{message[0]} {operator} {message[1]}"
        case CurveCall(function=function, curve=curve):
            return f"curve {function} {curve.outside(numbers[0])}"
        case Call(function=function):
            return f"{function} of {', '.join(message)}"
    return "a number that is not finite"


def unbounded_drive(compiled: CompiledModel, p: Array, t: float) -> str:
    """Return the drive whose second rate is far larger at a time than near it; "" if there is none."""
    zero = np.zeros(compiled.n)
    beside = 1e-4 * max(abs(t), 1e-9)
    near = (t - 8 * np.spacing(t), np.nextafter(t, -np.inf), t, np.nextafter(t, np.inf), t + 8 * np.spacing(t))
    at, apart = (
        np.nan_to_num(np.abs([compiled.closed_gamma(float(s), zero, zero, p) for s in times]), nan=none).max(axis=0)
        for times, none in ((near, np.inf), ((t - beside, t + beside), 0.0))
    )
    rows = [k for k, row in enumerate(compiled.source.start_rows) if row.kind == "drive" and at[k] > 100.0 * apart[k]]
    return compiled.source.start_rows[max(rows, key=lambda k: at[k])].owner if rows else ""


def steep_force(source: KernelSource, p: Array, t: float, q: Array, v: Array) -> str:
    """Return which force has an unbounded slope at a state, or is not a number, and by which name; else ""."""
    values, constant = values_at(source, p, t, q, v), {slot.address for slot in source.slots}
    for info, tree in trees(source, ("forces",)):
        for path in sorted({name.path for name in names(tree)}):
            here = float(values(path))
            if f"parameters.{path}" not in constant and _is_steep(_function_of(tree, path, values), here):
                where = f"{info.address} (line {info.line}, column {info.column})"
                beside = "" if path == "t" else f", {path} = {here:.9g}"
                return f"the slope of {where} by {path} is not finite at t = {t:.9g} s{beside}"
    return ""


def _function_of(tree: Expr, path: str, values: Values) -> Callable[[float], float]:
    """Return an expression as a function of one of its names."""
    return lambda x: float(evaluate(tree, lambda name: x if name == path else values(name)))


def _is_steep(at: Callable[[float], float], here: float) -> bool:
    """Return whether a function is finite at a point, but its slope is not."""
    value, size = at(here), 1.0 + abs(here)
    for side in (-size, size):
        rises = [abs(at(here + side * way) - value) for way in _SHORT]
        if not all(map(math.isfinite, rises)):
            return math.isfinite(value)
        slopes = [rise / way for rise, way in zip(rises, _SHORT, strict=True)]
        grows = all(later > _STEEPER * earlier for earlier, later in zip(slopes, slopes[1:], strict=False))
        if grows and _ROUNDING * abs(value) < rises[-1] < _JUMP * rises[0]:
            return True
    return False


@dataclass(frozen=True)
class Partial:
    """Hold an expression that may be undefined: its own parameter index (−1: none) and those of its names."""

    address: str
    tree: Expr
    slot: int
    slots: Mapping[str, int]


def undefined_rows(source: KernelSource, p: Array, is_given: NDArray[np.generic]) -> NDArray[np.bool_]:
    """Return a mask (n,) of runs with p (n, n_slots + n_derived) that may have an undefined value.

    undefined_number decides exactly.
    """
    found = np.zeros(len(p), dtype=np.bool_)
    for one in _affected_partials(source, p):
        known = {name: p[:, k] for name, k in one.slots.items()}
        undefined = may_be_undefined(one.tree, known)
        found |= undefined & ~is_given[:, one.slot].astype(bool) if one.slot >= 0 else undefined
    return found


def undefined_number(source: KernelSource, p: Array, is_given: NDArray[np.generic]) -> str:
    """Return a message on the first undefined value of one run; "" if there is none."""
    for one in _affected_partials(source, p[np.newaxis]):
        known = {name: float(p[k]) for name, k in one.slots.items()}
        if one.slot >= 0 and is_given[one.slot]:
            continue
        if (value := find_undefined_part(one.tree, known)) is not None:
            by = ", ".join(f"{name} = {number:.6g}" for name, number in known.items())
            return f"{one.address} has a part that is {value} with {by}\n  {REMEDY}"
    return ""


def _affected_partials(source: KernelSource, p: Array) -> list[Partial]:
    """Return the expressions that name a parameter which differs from the file's in some run."""
    kept = vars(source)
    if "partial_slots" not in kept:
        kept["partial_slots"] = sorted({k for one in partials(source) for k in one.slots.values()})
        kept["partial_defaults"] = np.array([source.slots[k].default for k in kept["partial_slots"]])
    slots = kept["partial_slots"]
    if not slots:
        return []
    differ = (p[:, slots] != kept["partial_defaults"]).any(axis=0)
    if not differ.any():
        return []
    changed = {slots[k] for k in np.flatnonzero(differ).tolist()}
    return [one for one in partials(source) if not changed.isdisjoint(one.slots.values())]


def partials(source: KernelSource) -> list[Partial]:
    """Return the expressions of parameters, drives and forces that may be undefined; read once for each source."""
    kept = vars(source)
    if "partials" not in kept:
        kept["partials"] = _read_partials(source)
    found: list[Partial] = kept["partials"]
    return found


def _read_partials(source: KernelSource) -> list[Partial]:
    """Read the expressions of parameters, drives and forces that may be undefined."""
    place, found = source.place, []
    trees = [(slot.address, slot.tree, k) for k, slot in enumerate(source.slots) if slot.tree]
    for address, tree, k in [*trees, *((one.address, one.tree, -1) for one in source.written)]:
        expr = from_json(json.loads(tree))
        used = dict.fromkeys(name.path for name in names(expr))
        slots = {name: place.get(f"parameters.{name}", place.get(name, -1)) for name in used}
        if not is_total_expression(expr):
            found.append(Partial(address, expr, k, {name: at for name, at in slots.items() if at >= 0}))
    return found

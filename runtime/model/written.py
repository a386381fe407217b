"""What a file's own expressions are worth at a state: which one is no number there, and why.

C computes with them and finds out that something is not finite; here their trees are walked again to say what.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.contract.kernel_source import KernelSource, WrittenInfo
from gudgeon.language.defined import is_defined_everywhere
from gudgeon.language.tree import Binary, Call, Expr, calls, evaluate, from_json, names, reached
from gudgeon.model.compiled import Array, CompiledModel, Evaluation
from gudgeon.model.culprit import Values, culprit

if TYPE_CHECKING:
    from gudgeon.results.results import Result

_REACH = tuple(10.0**k for k in range(-13, -8))  # s, or share of the time: how far ahead of a state a reason may lie
MOST_CORNERS = 64  # of a where, that are looked at one after the other


def values_at(source: KernelSource, p: Array, t: float, q: Array, v: Array) -> Values:
    """Value of a name: t, a parameter, a coordinate or velocity of a body, or of a point."""
    place = {name: k for k, name in enumerate(source.coordinates)}
    slots = {slot.address: float(p[k]) for k, slot in enumerate(source.slots)}
    points = {point.name: point for point in source.points}
    position = {"x": 0, "y": 1, "theta": 2, "vx": 0, "vy": 1, "omega": 2}

    def value(path: str) -> float:
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


def of_time(source: KernelSource, p: Array, tree: Expr, t: Array) -> Array:
    """Values of an expression of t and parameters, (N,)."""
    slots = {slot.address: float(p[k]) for k, slot in enumerate(source.slots)}
    return np.broadcast_to(evaluate(tree, lambda path: t if path == "t" else slots[f"parameters.{path}"]), t.shape)


def trees(source: KernelSource, kinds: Iterable[str]) -> list[tuple[WrittenInfo, Expr]]:
    """The file's expressions of t and motion of some sections: drives, forces, events."""
    return [(info, from_json(json.loads(info.tree))) for info in source.written if info.address.split(".")[0] in kinds]


def reason(source: KernelSource, p: Array, t: float, q: Array, v: Array, ahead: float = 0.0) -> str:
    """Which drive or force is no number at a state, just after it or at most `ahead` s later, where and why; or ""."""
    found = trees(source, ("drives", "forces"))
    if not (np.isfinite(q).all() and np.isfinite(v).all()):
        found = [(info, tree) for info, tree in found if all("." not in name.path for name in names(tree))]
    later = (*(reach * max(1.0, abs(t)) for reach in _REACH), *(ahead * share for share in (0.01, 0.1, 0.5, 1.0)))
    for h in (0.0, *later):
        with np.errstate(invalid="ignore"):  # a velocity may be infinite
            told = _told(source, found, p, t + h, q + h * v, v)
        if told:
            return told
    return ""


def undefined_here(source: KernelSource, p: Array, t: float, q: Array, v: Array, ahead: float = 0.0) -> str:
    """Which drive or force is no number at a state itself, or in a branch of a `where` that changes near it; or "".

    The step that leads to such a corner, or begins there, computes with either branch, whichever is picked there.
    """
    found = trees(source, ("drives", "forces"))
    for h in (0.0, float(np.spacing(t))):
        if told := _told(source, found, p, t + h, q, v):
            return told
    reach = max(ahead, 1e-6 * max(1.0, abs(t)))
    for info, tree in found:
        for call in calls(tree, "where"):
            left, right = call.arguments[:2]
            gap = Binary("-", left, right)

            def ahead_of_zero(h: float, gap: Expr = gap) -> bool:
                return bool(evaluate(gap, values_at(source, p, t + h, q + h * v, v)) < 0.0)

            for low, high in pairwise(np.linspace(-reach, reach, 33).tolist()):
                if ahead_of_zero(low) != ahead_of_zero(high):
                    ends = _neighbours(ahead_of_zero, low, high)
                    words = (_of_branches(source, p, info, call, t + h, q + h * v, v) for h in ends)
                    if told := next(filter(None, words), ""):
                        return told
    return ""


def undefined_at_a_corner(
    source: KernelSource, p: Array, info: WrittenInfo, tree: Expr, t: Array
) -> tuple[str, float] | None:
    """What of a drive is no number where one of its wheres changes over between the times t, and when; None: all is."""
    none = np.zeros(0)
    found = []
    for call in calls(tree, "where"):
        left, right = call.arguments[:2]
        gap = Binary("-", left, right)

        def ahead_of_zero(time: float, gap: Expr = gap) -> bool:
            return bool(of_time(source, p, gap, np.array([time]))[0] < 0.0)

        before = of_time(source, p, gap, t) < 0.0
        for k in np.flatnonzero(before[1:] != before[:-1])[:MOST_CORNERS].tolist():
            for end in _neighbours(ahead_of_zero, float(t[k]), float(t[k + 1])):
                values = values_at(source, p, end, none, none)
                if any(other is call for other in reached(tree, "where", values)):
                    told = _of_branches(source, p, info, call, end, none, none)
                    found += [(told, end)] if told else []
    return min(found, key=lambda one: one[1], default=None)


def _neighbours(answer: Callable[[float], bool], low: float, high: float) -> tuple[float, float]:
    """Two numbers, next to each other, between which an answer changes."""
    first = answer(low)
    while low < (middle := 0.5 * (low + high)) < high and high - low > 1e-18:
        low, high = (middle, high) if answer(middle) == first else (low, middle)
    return low, high


def _of_branches(source: KernelSource, p: Array, info: WrittenInfo, call: Call, t: float, q: Array, v: Array) -> str:
    """What is no number in the branch of a where that is picked, at its corner itself in both, in words; or ""."""
    values = values_at(source, p, t, q, v)
    left, right, then, otherwise = (evaluate(part, values) for part in call.arguments)
    for k, (value, meant) in enumerate(((then, left <= right), (otherwise, left >= right))):
        if meant and not math.isfinite(value):
            place = f"line {info.line}, column {info.column}"
            why = culprit(source, call.arguments[2 + k], values)
            corner = f"at t = {t:.9g} s, where its where changes over"
            return f"{info.address} ({place}): {corner}, a branch is {value}: {why}"
    return ""


def reason_between(source: KernelSource, p: Array, t0: float, t1: float) -> tuple[str, float]:
    """Which drive ceases to be a number on the way from t0 to t1 (s), and when; ("", t1) where none does."""
    none, first, told = np.zeros(0), t1, ""
    for info, tree in trees(source, ("drives",)):
        times = np.append(np.linspace(t0, t1, 4001), t1 + 1e-9 * max(1.0, abs(t1)))  # and just behind the end
        wrong = np.flatnonzero(~np.isfinite(of_time(source, p, tree, times)))
        if not len(wrong):
            continue
        high = float(times[wrong[0]])
        low = float(times[max(wrong[0] - 1, 0)])
        for _ in range(60):
            middle = 0.5 * (low + high)
            if np.isfinite(of_time(source, p, tree, np.array([middle])))[0]:
                low = middle
            else:
                high = middle
        if not told or high < first:
            first, told = high, _told(source, [(info, tree)], p, high, none, none)
    return told, first


def rate_reason(compiled: CompiledModel, p: Array, times: Array, q: Array) -> tuple[str, float]:
    """Which drive's rate or second rate is none first at some times (s), and when; ("", the last) where all are."""
    drives = [k for k, row in enumerate(compiled.source.start_rows) if row.kind == "drive"]
    v = np.zeros(compiled.n)
    for t in times.tolist() if drives else ():
        for of, rows in (("rate", compiled.closed_nu(t, q, p)), ("second rate", compiled.closed_gamma(t, q, v, p))):
            wrong = [k for k in drives if not np.isfinite(rows[k])]
            if wrong:
                name = compiled.source.start_rows[wrong[0]].name
                return f"the {of} of drive {name} is {-rows[wrong[0]]:g} at t = {t:.9g} s", t
    return "", float(times[-1])


def with_undefined(run: Result, evaluation: Evaluation) -> Result:
    """The run, its notes with outputs that are no number at a sample at which all that they are made of is one.

    And with drives and forces by a `where` that compares what is no number: C picks one of its branches.
    """
    compared = _compared(run.source)
    if not run.source.outputs and not compared:
        return run
    probe = replace(run, stored={})  # of many samples nothing is kept that nobody asked for
    probe.__dict__["evaluation"] = evaluation
    outputs = {f"output {name}": from_json(tree) for name, tree in run.source.outputs.items() if name in probe}
    for address, tree in compared.items():
        if all(used.path in probe.parameters or used.path in probe for used in names(tree)):
            outputs[address] = tree
    odd = [told for name, tree in outputs.items() if (told := _odd(probe, name, tree))]
    notes = (*run.diagnostics.notes, *odd)
    return replace(run, diagnostics=replace(run.diagnostics, notes=notes)) if odd else run


def _compared(source: KernelSource) -> dict[str, Expr]:
    """Drives and forces, by address, with a `where` that may compare what is no number."""
    kept = vars(source)
    if "compared" not in kept:
        found = {info.address: tree for info, tree in trees(source, ("drives", "forces"))}
        kept["compared"] = {
            address: tree for address, tree in found.items()
            if not all(is_defined_everywhere(one) for call in calls(tree, "where") for one in call.arguments[:2])
        }  # fmt: skip
    return dict(kept["compared"])


def _odd(run: Result, name: str, tree: Expr) -> str:
    """When an expression is no number first, and why; "" where it is one, or only what it is made of is none."""
    parts = {used.path: np.broadcast_to(run.value_of(used.path), run.t.shape) for used in names(tree)}
    values = np.broadcast_to(evaluate(tree, parts.__getitem__), run.t.shape)
    wrong = ~np.isfinite(values)
    for part in parts.values() if wrong.any() else ():
        wrong &= np.isfinite(part)
    if not wrong.any():
        return ""
    k, count = int(wrong.argmax()), int(wrong.sum())
    why = culprit(run.source, tree, lambda path: float(parts[path][k]))
    others = f"; it is none at {count} of {len(wrong)} samples" if count > 1 else ""
    return f"{name} is no number ({values[k]}) at t = {run.t[k]:.9g} s: {why}{others}"


def _told(
    source: KernelSource, found: Iterable[tuple[WrittenInfo, Expr]], p: Array, t: float, q: Array, v: Array
) -> str:
    values = values_at(source, p, t, q, v)
    for info, tree in found:
        value = float(evaluate(tree, values))
        if not math.isfinite(value):
            place = f"line {info.line}, column {info.column}"
            return f"{info.address} ({place}) is not finite at t = {t:.9g} s, {value}: {culprit(source, tree, values)}"
    return ""

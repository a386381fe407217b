"""Corners and jumps of drives that their form does not show: `acos(cos(t))`, `atan2`, a root that touches zero.

What is written with abs, min, max or ramp, or is the root of a square, has its corners found by the generator, and a
step ends there. What is left is looked for by values, of drives that have a function which may hide it; and whether
what is written with where or mod is continuous at its corners.
Where the second differences of f on an even grid stand out they are followed to ever shorter distances h. They go
with h² where f is smooth, with h where its rate jumps, more slowly where that is infinite, and stay where f jumps.
Where nothing is free there is no impulse to be left out, but near such a place rates are 0/0 in binary64.
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
from gudgeon.language.functions import CORNERED, JUMPING, names_where
from gudgeon.language.tree import Binary, Call, Expr, Number, Unary, functions, names
from gudgeon.model.compiled import Array
from gudgeon.model.written import of_time, trees, undefined_at_a_corner

_HIDING = names_where(lambda f: f.hides_corners)
GRID, MOST, MOST_CORNERS = 4096, 16, 512  # intervals, candidates; those that are looked at one after the other
AT_THE_END = 1e-12  # share of a run's time that is looked at behind its end
POINTS, LEVELS = 16, 11  # intervals of a closer look; each is a quarter as wide as the one before
EVERYWHERE = 6  # of them that stand out like the one that does most: it is no place


@dataclass(frozen=True)
class Jump:
    """Where and how: "rate" (by `size`, of f's unit a second), "infinite rate", "value" (by `size`), or `told`."""

    drive: str
    t: float
    kind: str
    size: float
    breaks: bool = False  # between what where and mod choose
    told: str = ""  # a branch of a where is no number at its own corner: in words


_Search: TypeAlias = tuple[str, Expr, Callable[..., list[Jump]]]  # in a drive with this expression


def hidden_jumps(source: KernelSource, p: Array, t0: float, t1: float) -> list[Jump]:
    """Of all drives between two times (s), in time's order; at most MOST a drive."""
    found = []
    for drive, tree in _that_may_hide(source) if t1 > t0 else ():
        found += _jumps(source, p, tree, drive, t0, t1)
    for drive, tree in _that_may_break(source) if t1 > t0 else ():
        found += _first_break(source, p, tree, drive, t0, t1)
    return sorted(found, key=lambda jump: jump.t)


def may_jump(source: KernelSource) -> bool:
    """Whether a drive is looked at by values at all."""
    return bool(_that_may_hide(source) or _that_may_break(source))


def _looked_at(source: KernelSource) -> list[_Search]:
    """Return the searches for what no run goes over.

    Without freedom these are infinite rates too, of drives whose corners are found otherwise.
    """
    found: list[_Search] = [(drive, tree, _jumps) for drive, tree in _that_may_hide(source)]
    found += [(drive, tree, _first_break) for drive, tree in _that_may_break(source)]
    known = {drive for drive, *_ in found}
    others = () if _integrates(source) else _with_drives(source)
    return found + [(drive, tree, _unbounded) for drive, tree in others if drive not in known and _hides(tree)]


def first_jumps(
    source: KernelSource, p: Array, t0: float, ends: Sequence[float], left_out: Container[int] = ()
) -> dict[int, Jump]:
    """Return the first jump that each run meets after t0 until its end (s), by its number; p (runs, numbers).

    The same drives are looked at once.
    """
    first, known = dict[int, Jump](), dict[tuple[Any, ...], float | Jump]()
    for drive, tree, search in _looked_at(source):
        used = {f"parameters.{name.path}" for name in names(tree)}
        columns = [k for k, slot in enumerate(source.slots) if slot.address in used]
        for i, t1 in enumerate(ends):
            if i in left_out or not t1 > t0:
                continue
            key = drive, t1, p[i, columns].tobytes()
            if key not in known:
                found = [jump for jump in search(source, p[i], tree, drive, t0, t1) if jump.t > t0]
                known[key] = min(found, key=lambda jump: jump.t, default=math.inf)
            jump = known[key]
            if isinstance(jump, Jump) and (i not in first or jump.t < first[i].t):
                first[i] = jump
    return first


def _integrates(source: KernelSource) -> bool:
    """Whether a jump is an impulse on what is free; else the linkage follows it, as far as rates are numbers there."""
    return bool(source.drives) and KINEMATIC not in source.methods


def _with_drives(source: KernelSource) -> list[tuple[str, Expr]]:
    """All drives with their expressions."""
    return [(info.address.split(".")[1], tree) for info, tree in trees(source, ("drives",))]


def _that_may_hide(source: KernelSource) -> list[tuple[str, Expr]]:
    """Drives whose corners the generator may not have found."""
    return [
        (drive, tree)
        for drive, tree in _with_drives(source)
        if _hides(tree) and drive not in source.rate_jumps and CORNERED.isdisjoint(functions(tree))
    ]


def end_before(jump: Jump, t0: float) -> float:
    """Return the time (s) before which the last sample of a run from t0 is."""
    return jump.t - (1e-10 * max(abs(t0), abs(jump.t)) if jump.breaks else 0.0)  # at the jump it is on either side


def jump_failure(source: KernelSource, jump: Jump) -> SolverError:
    """Return the error that a run ends with which came to a jump."""
    why = "its rate is no number there" if jump.kind == "rate" else "no linkage follows it"
    told = _told(jump, "the impulse there would be left out" if _integrates(source) else why)
    return (NonFiniteError if jump.told else SolverError)(told, jump.t)


def _told(jump: Jump, why: str) -> str:
    if jump.told:
        return f"{jump.told}\n  {NO_NUMBER}"
    if jump.kind == "infinite rate":
        return (
            f"drive {jump.drive}: its rate is infinite at t = {jump.t:.6g} s: no velocity is a number there\n"
            "  write it so that its rate is bounded, or end the run before"
        )
    if jump.breaks:
        return (
            f"drive {jump.drive}: it jumps by {jump.size:.4g} at t = {jump.t:.6g} s: no linkage follows it\n"
            "  what where and mod choose between must meet where they change over, or the run ends before"
        )
    what = f"its rate jumps by about {jump.size:.3g}" if jump.kind == "rate" else f"it jumps by {jump.size:.4g}"
    return (
        f"drive {jump.drive}: {what} at t = {jump.t:.6g} s, which its form does not show: {why}\n"
        "  write it with abs, min, max or ramp, whose corners are found, or end the run before"
    )


def _hides(tree: Expr) -> bool:
    """Whether there is a function, a broken power or a division in it that may hide a corner."""
    match tree:
        case Unary(operand=operand):
            return _hides(operand)
        case Binary(operator=operator, left=left, right=right):
            whole = isinstance(right, Number) and (operator == "/" or right.value == round(right.value) >= 0)
            return operator in ("**", "/") and not whole or _hides(left) or _hides(right)
        case Call(function=function, arguments=arguments):
            return function in _HIDING or any(map(_hides, arguments))
    return False


def _that_may_break(source: KernelSource) -> list[tuple[str, Expr]]:
    """Drives whose corners the generator has found, and whose branches may not meet there."""
    return [(drive, tree) for drive, tree in _with_drives(source) if not JUMPING.isdisjoint(functions(tree))]


@np.errstate(all="ignore")
def _first_break(source: KernelSource, p: Array, tree: Expr, drive: str, t0: float, t1: float) -> list[Jump]:
    """The first time at which a drive jumps, its end among them, where the last sample is on either side; or none."""
    behind = AT_THE_END * (t1 - t0)
    t1 += behind
    info = next(info for info, _ in trees(source, ("drives",)) if info.address.split(".")[1] == drive)
    undefined = undefined_at_a_corner(source, p, info, tree, np.linspace(t0, t1, GRID + 1))
    if undefined:
        t1 = undefined[1]
    share, h = _share(source, p, tree, t0, t1, "reflect"), (t1 - t0) / GRID  # the last place may stand out too
    for k in np.flatnonzero(share > 3.0)[:MOST_CORNERS].tolist():
        at = t0 + (k + 1) * h
        jump = _follow(source, p, tree, drive, max(at - h, t0), min(at + h, t1))
        if jump and jump.kind == "value":
            near = of_time(source, p, tree, np.array([at - h, at, at + h]))
            if jump.size > 10.0 * behind * np.abs(np.diff(near)).max() / h:  # else the corner of a rate, so near an end
                return [replace(jump, breaks=True)]
    return [Jump(drive, t1, "no number", np.nan, breaks=True, told=undefined[0])] if undefined else []


def _share(source: KernelSource, p: Array, tree: Expr, t0: float, t1: float, beyond: Any = "edge") -> Array:
    """How far second differences on the grid stand out of those around them, (GRID - 1,)."""
    f = of_time(source, p, tree, np.linspace(t0, t1, GRID + 1))
    bent = np.abs(np.diff(f, 2))
    around = np.median(np.lib.stride_tricks.sliding_window_view(np.pad(bent, 8, mode=beyond), 17), axis=1)
    return np.asarray(bent / (around + 1e-14 * np.abs(f).max(initial=0.0) + 1e-300))


@np.errstate(all="ignore")
def _jumps(source: KernelSource, p: Array, tree: Expr, drive: str, t0: float, t1: float) -> list[Jump]:
    share = _share(source, p, tree, t0, t1)
    outstanding = [k for k in np.argsort(-share, kind="stable")[: 4 * MOST].tolist() if share[k] > 3.0]
    found: list[Jump] = []
    h = (t1 - t0) / GRID
    for k in outstanding:
        at = t0 + (k + 1) * h
        if len(found) < MOST and all(abs(at - jump.t) > 2.5 * h for jump in found):
            jump = _follow(source, p, tree, drive, max(at - h, t0), min(at + h, t1))
            found += [jump] if jump else []
    return found


def _unbounded(source: KernelSource, p: Array, tree: Expr, drive: str, t0: float, t1: float) -> list[Jump]:
    return [jump for jump in _jumps(source, p, tree, drive, t0, t1) if jump.kind != "rate"]


def _follow(source: KernelSource, p: Array, tree: Expr, drive: str, a: float, b: float) -> Jump | None:
    """To ever shorter distances, as long as more is left of the differences than rounding."""
    logs: list[float] = []
    sizes: list[float] = []  # of the rate's change
    for _ in range(LEVELS):
        times = np.linspace(a, b, POINTS + 1)
        f = of_time(source, p, tree, times)
        bent = np.abs(np.diff(f, 2))
        if not np.isfinite(bent).all():
            return None  # no number there: another matter
        k = int(bent.argmax())
        if bent[k] < 1e-11 * np.abs(f).max(initial=0.0) or b - a < 1e-11 * max(abs(a), abs(b)):
            break
        if np.count_nonzero(bent > 0.25 * bent[k]) >= EVERYWHERE:
            break  # rounding, as of a square that is not quite one under its root
        logs.append(float(np.log(bent[k]) / np.log(4.0)))
        sizes.append(float(abs((f[-1] - f[-2]) - (f[1] - f[0])) / (times[1] - times[0])))
        value = float(bent[k])
        a, b = float(times[max(k - 1, 0)]), float(times[min(k + 3, POINTS)])
    if len(logs) < 5:
        return None
    powers = -np.diff(logs)  # how the differences go with h; a function may be smooth but for its last digits
    last = float(powers[-4:].mean())
    if last > 1.4:
        return None
    # at the end of what is looked at a corner stands out by its distance from there, until that is wider
    power = max(float(np.median(powers[: len(powers) // 2 + 1])), last)
    kind = "rate" if power > 0.8 else "infinite rate" if power > 0.2 else "value"
    return Jump(drive, 0.5 * (a + b), kind, sizes[min(3, len(sizes) - 1)] if kind == "rate" else value)

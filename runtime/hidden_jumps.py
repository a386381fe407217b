"""Corners and jumps of drives that their form does not show: `acos(cos(t))`, `atan2`, a root that touches zero.

What is written with abs, min, max or ramp, or is the root of a square, has its corners found by the generator, and a
step ends there. What is left is looked for by values, of those drives that have a function which may hide it:
where the second differences of f on an even grid stand out they are followed to ever shorter distances h. They go with
h² where f is smooth, with h where its rate jumps, more slowly where the rate is infinite, and stay where f itself jumps.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gudgeon.compiled import Array
from gudgeon.expression_tree import Binary, Call, Expr, Number, Unary, functions
from gudgeon.kernel_source import KernelSource
from gudgeon.written import of_time, trees

VISIBLE = frozenset({"abs", "min", "max", "ramp", "sign"})
_HIDING = frozenset({"sqrt", "hypot", "asin", "acos", "atan", "atan2", "tan", "log"})
GRID, MOST = 4096, 16  # intervals, candidates
POINTS, LEVELS = 16, 11  # intervals of a closer look; each is a quarter as wide as the one before


@dataclass(frozen=True)
class Jump:
    """Where and how: "rate" (by `size`, of f's unit a second), "infinite rate" or "value" (by `size`)."""

    drive: str
    t: float
    kind: str
    size: float


def hidden_jumps(source: KernelSource, p: Array, t0: float, t1: float) -> list[Jump]:
    """Of all drives between two times (s), in time's order; at most MOST a drive."""
    found = []
    for info, tree in trees(source, ("drives",)):
        if t1 > t0 and _hides(tree) and VISIBLE.isdisjoint(functions(tree)):
            with np.errstate(all="ignore"):
                found += _jumps(source, p, tree, info.address.split(".")[1], t0, t1)
    return sorted(found, key=lambda jump: jump.t)


def notes(source: KernelSource, p: Array, t0: float, t1: float) -> list[str]:
    """What a run says of them, a line a drive."""
    jumps: dict[str, list[Jump]] = {}
    for jump in hidden_jumps(source, p, t0, t1):
        jumps.setdefault(jump.drive, []).append(jump)
    return [_told(drive, of_drive) for drive, of_drive in jumps.items()]


def _told(drive: str, jumps: list[Jump]) -> str:
    first, more = jumps[0], f" and {len(jumps) - 1} times more" if len(jumps) > 1 else ""
    how = {"rate": f"its rate jumps by {first.size:.4g}", "infinite rate": "its rate is infinite"}
    what = how.get(first.kind, f"it jumps by {first.size:.4g}")
    return (
        f"drive {drive}: {what} at t = {first.t:.6g} s{more}, which its form does not show: no impulse moves the"
        " linkage there; write it with abs, min, max or ramp, whose corners are found"
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


def _jumps(source: KernelSource, p: Array, tree: Expr, drive: str, t0: float, t1: float) -> list[Jump]:
    f = of_time(source, p, tree, np.linspace(t0, t1, GRID + 1))
    bent = np.abs(np.diff(f, 2))
    around = np.median(np.lib.stride_tricks.sliding_window_view(np.pad(bent, 8, mode="edge"), 17), axis=1)
    share = bent / (around + 1e-14 * np.abs(f).max(initial=0.0) + 1e-300)
    outstanding = [k for k in np.argsort(-share, kind="stable")[: 4 * MOST].tolist() if share[k] > 3.0]
    h, found = (t1 - t0) / GRID, []
    for k in outstanding:
        at = t0 + (k + 1) * h
        if len(found) < MOST and all(abs(at - jump.t) > 2.5 * h for jump in found):
            jump = _follow(source, p, tree, drive, max(at - h, t0), min(at + h, t1))
            found += [jump] if jump else []
    return found


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
        logs.append(float(np.log(bent[k]) / np.log(4.0)))
        sizes.append(float(abs((f[-1] - f[-2]) - (f[1] - f[0])) / (times[1] - times[0])))
        value = float(bent[k])
        a, b = float(times[max(k - 1, 0)]), float(times[min(k + 3, POINTS)])
    if len(logs) < 5:
        return None
    powers = -np.diff(logs)  # how the differences go with h; a function may be smooth but for its last digits
    if powers[-4:].mean() > 1.4:
        return None
    power = float(np.median(powers[: len(powers) // 2 + 1]))
    kind = "rate" if power > 0.8 else "infinite rate" if power > 0.2 else "value"
    return Jump(drive, 0.5 * (a + b), kind, sizes[len(sizes) // 2] if kind == "rate" else value)

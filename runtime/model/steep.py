"""Which force has no finite slope at a state, and which drive no bounded second rate at a time.

Methods that need the Jacobian cannot go on from a force without a slope, others can.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.language.tree import Expr, evaluate, names
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.written import Values, trees, values_at

_SHORT = (1e-8, 1e-10, 1e-12)  # ways over which a rise is looked at, of a size of 1
_STEEPER, _ROUNDING = 3.0, 1e-13  # how much each shorter way is steeper at least; what is no rise
_JUMP = 0.9  # of the rise over the longest way, that one over the shortest has where it is a jump: of that methods know


def unbounded_drive(compiled: CompiledModel, p: Array, t: float) -> str:
    """The drive whose second rate is far larger at a time than beside it; "": none."""
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
    """Which force rises without bound beside a state, or is no number there, and by what; "" where none does."""
    values, constant = values_at(source, p, t, q, v), {slot.address for slot in source.slots}
    for info, tree in trees(source, ("forces",)):
        for path in sorted({name.path for name in names(tree)}):
            here = float(values(path))
            if f"parameters.{path}" not in constant and _is_steep(_by(tree, path, values), here):
                where = f"{info.address} (line {info.line}, column {info.column})"
                beside = "" if path == "t" else f", {path} = {here:.9g}"
                return f"the slope of {where} by {path} is not finite at t = {t:.9g} s{beside}"
    return ""


def _by(tree: Expr, path: str, values: Values) -> Callable[[float], float]:
    """An expression as a function of one of its names."""
    return lambda x: float(evaluate(tree, lambda name: x if name == path else values(name)))


def _is_steep(at: Callable[[float], float], here: float) -> bool:
    """Whether a function is finite at a place, and its slope is not."""
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

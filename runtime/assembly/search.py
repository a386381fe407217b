"""The start where one call of C does not do: the nearest closed configuration by all means, then its velocities."""

from __future__ import annotations

import numpy as np

from gudgeon.assembly.closure import Closure
from gudgeon.assembly.failures import not_closed, stuck
from gudgeon.assembly.large import smallest
from gudgeon.assembly.linkage import Linkage
from gudgeon.assembly.start import Start
from gudgeon.errors import AssemblyError
from gudgeon.model.compiled import Array
from gudgeon.model.sizes import metric

MIN_RESOLVED = float(np.finfo(float).tiny / np.finfo(float).eps)  # smaller numbers may have fewer digits than others


def search(linkage: Linkage, p: Array, t: float = 0.0) -> Start:
    """The start by all means there are. Raises AssemblyError with rows, joints and residual."""
    closure = Closure(linkage, p, t)
    with np.errstate(all="ignore"):  # Newton may come where a direction is not defined; it looks for that itself
        q, closed = closure.nearest()
    if not closed:
        raise not_closed(closure, q)
    return Start(q, velocities(closure, q), float(np.abs(closure.residual(q)).max(initial=0.0)))


def _ahead(closure: Closure) -> float:
    """s, when the drives' rates are looked at: a rate that jumps at the start is what follows (numbers.h)."""
    more = max(32 * np.finfo(float).eps * abs(closure.t), 1e-100)
    return closure.t + more if closure.linkage.source.rate_jumps else closure.t


def velocities(closure: Closure, q: Array) -> Array:
    """q̇ with Φ_q q̇ = ν and the start's rates; what nothing determines is least in the metric of M."""
    names = {"x": "vx", "y": "vy", "theta": "omega"}
    wanted = [f"{body}.{names[c]}" for body, c in (name.split(".") for name in closure.place)]
    index = [wanted.index(name) for name in closure.linkage.source.start_rates]
    extra = np.zeros((len(index), len(q)))
    extra[np.arange(len(index)), index] = 1.0
    matrix = np.concatenate([closure.linkage.closed_phi_q(closure.t, q, closure.p), extra])
    nu = closure.linkage.closed_nu(_ahead(closure), q, closure.p)
    nu[closure.apart_index] -= closure.parting
    target = np.concatenate([nu, closure.rates])
    if not (np.isfinite(target).all() and np.isfinite(matrix).all()):
        source = closure.linkage.source
        rows = [row.name for row, x in zip(source.start_rows, target, strict=False) if not np.isfinite(x)]
        raise AssemblyError(
            f"the start has no velocities: the rate of {', '.join(rows) or 'the constraints'} is not finite at"
            f" t = {closure.t:g} s\n  a root or a power has no slope where it begins: begin with smooth_step or later"
        )
    root = np.sqrt(metric(closure.linkage.source, closure.p, closure.linkage.mass(closure.p)))
    v = np.zeros_like(q)
    for _ in range(2):  # once more for the rounding of the first solution
        v += smallest(matrix / root, target - matrix @ v) / root
    left = np.abs(matrix @ v - target)
    if left.max(initial=0.0) > 1e-8 * float(np.abs(target).max(initial=0.0)) + MIN_RESOLVED:
        raise stuck(closure, matrix / root, left)
    return v

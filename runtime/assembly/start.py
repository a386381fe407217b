"""The exact start on the branch nearest the guess: positions by Newton, then velocities.

A scene with play starts from its closed linkage (e = 0, ideal velocities), but where the file's `start.play` says e
and ė of a journal: rows of its joint are held apart by so much. Angles weigh most: a step moves guessed angles least,
then the other angles, and positions follow. The ordinary case is one call of C (engine/scene/start.c). If C cannot
close the linkage, or not near the guess, `search` looks for the nearest closed configuration. What `search` alone
needs is imported when it is called, so that a warm start does not pay for it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.assembly.journals import check_places
from gudgeon.assembly.large import LARGE, smallest
from gudgeon.assembly.linkage import Linkage, mechanism_size
from gudgeon.errors import AssemblyError
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.sizes import metric

if TYPE_CHECKING:
    from gudgeon.assembly.closure import Closure

MIN_RESOLVED = float(np.finfo(float).tiny / np.finfo(float).eps)  # smaller numbers may have fewer digits than others


@dataclass(frozen=True)
class Start:
    """q, q̇ (n,) at time t, with the residual max |Φ| that is left."""

    q: Array
    v: Array
    residual: float


def assemble(compiled: CompiledModel, p: Array, t: float = 0.0) -> Start:
    """The start of a scene. Raises AssemblyError with rows, joints and residual."""
    check_places(compiled, p)
    closed = compiled.close(t, p, mechanism_size(compiled, p)) if compiled.n < LARGE else None
    if closed is not None and np.isfinite(closed[1]).all():
        return Start(*closed)
    return search(compiled, p, t)


def search(linkage: Linkage, p: Array, t: float = 0.0) -> Start:
    """The start by all means there are. Raises AssemblyError with rows, joints and residual."""
    from gudgeon.assembly.closure import Closure

    closure = Closure(linkage, p, t)
    with np.errstate(all="ignore"):  # Newton may come where a direction is not defined; it looks for that itself
        q, closed = closure.nearest()
    if not closed:
        from gudgeon.assembly.failures import not_closed

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
        from gudgeon.assembly.failures import stuck

        raise stuck(closure, matrix / root, left)
    return v

"""Whether a configuration is singular: rows of Φ_q that depend on each other there and nowhere near."""

from __future__ import annotations

import numpy as np

from gudgeon.assembly.rank import tied
from gudgeon.assembly.redundant_rows import left_out
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.sizes import mechanism_sizes

DEAD = 1e-6  # singular values below this share count as zero: a double root is found to 1e-8 only
NEAR = 1e-4  # the same where a motion ended on its way to a dead centre
_POSITION = {"vx": "x", "vy": "y", "omega": "theta"}


def dependent_rows(compiled: CompiledModel, p: Array, t: float, q: Array) -> tuple[str, ...]:
    """Names of rows of Φ and of start.rates that tie each other at q; empty at an ordinary configuration.

    Rows that are redundant everywhere were left out when the scene was derived and do not count.
    """
    source = compiled.source
    redundant = set(left_out(compiled))
    index = [k for k in range(len(source.start_rows)) if k not in redundant]
    if not index:
        return ()
    names = [source.start_rows[k].name for k in index] + list(source.start_rates)
    rates = np.zeros((len(source.start_rates), len(q)))
    for k, rate in enumerate(source.start_rates):
        body, _, component = rate.partition(".")
        rates[k, source.coordinates.index(f"{body}.{_POSITION[component]}")] = 1.0
    matrix = np.concatenate([compiled.closed_phi_q(t, q, p)[index], rates])
    return _tied_rows(compiled, p, matrix, names, DEAD)


def nearly_dependent_rows(compiled: CompiledModel, p: Array, t: float, q: Array) -> tuple[str, ...]:
    """Names of the motion's rows (joints with play left out) that all but tie each other at q."""
    rows = compiled.source.rows
    if not rows or not np.isfinite(q).all():
        return ()
    return _tied_rows(compiled, p, compiled.phi_q(t, q, p), [row.name for row in rows], NEAR)


def _tied_rows(compiled: CompiledModel, p: Array, matrix: Array, names: list[str], least: float) -> tuple[str, ...]:
    """Names of the rows that depend on each other, by their geometry alone: angles are measured by the size."""
    matrix = matrix / np.tile([1.0, 1.0, float(mechanism_sizes(compiled.source, p))], matrix.shape[1] // 3)
    matrix /= np.linalg.norm(matrix, axis=1, keepdims=True) + 1e-300
    return tuple(name for name, share in zip(names, tied(matrix, least), strict=True) if share > 1e-6)

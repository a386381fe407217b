"""Whether a configuration is singular: rows of Φ_q that depend on each other there and nowhere near."""

from __future__ import annotations

import numpy as np

from gudgeon.compiled import Array, CompiledModel

RANK = 1e-6  # singular values below this share count as zero: a double root is found to 1e-8 only
_POSITION = {"vx": "x", "vy": "y", "omega": "theta"}
MOST = 600  # coordinates beyond which the dense rank costs more than it tells


def dependent_rows(compiled: CompiledModel, p: Array, t: float, q: Array) -> tuple[str, ...]:
    """Names of rows of Φ and of start.rates that tie each other at q; empty at an ordinary configuration.

    Rows that are redundant everywhere were left out when the scene was derived and do not count.
    """
    source = compiled.source
    kept = {row.name for row in source.rows}
    played = {joint.name for joint in source.clearances}
    index = [k for k, row in enumerate(source.start_rows) if row.name in kept or row.owner in played]
    if not index or len(q) > MOST:
        return ()
    names = [source.start_rows[k].name for k in index] + list(source.start_rates)
    rates = np.zeros((len(source.start_rates), len(q)))
    for k, rate in enumerate(source.start_rates):
        body, _, component = rate.partition(".")
        rates[k, source.coordinates.index(f"{body}.{_POSITION[component]}")] = 1.0
    matrix = np.concatenate([compiled.closed_phi_q(t, q, p)[index], rates]) / np.sqrt(compiled.mass(p))
    matrix /= np.linalg.norm(matrix, axis=1, keepdims=True) + 1e-300
    left, values, _ = np.linalg.svd(matrix)
    rank = int((values > RANK * values[0]).sum())
    share = np.abs(left[:, rank:]).max(axis=1, initial=0.0)
    return tuple(name for name, size in zip(names, share, strict=True) if size > 1e-6)

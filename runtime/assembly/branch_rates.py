"""Velocities with which a linkage may pass a singular position: of the branches that meet there.

Rows that depend on each other leave the velocities open by α n, with n in the null space of Φ_q. Accelerations exist
only where λᵀ γ(v) = 0 for the left null vector λ of Φ_q, which is a quadratic equation for α: two real roots are two
branches, none is a position at which the motion ends.
"""

from __future__ import annotations

import numpy as np

from gudgeon.assembly.redundant_rows import left_out
from gudgeon.model.compiled import Array, CompiledModel

SINGULAR = 1e-4  # share of the largest singular value below which one counts as zero
CONSISTENT = 1e-3  # share of the rows' rates that contradict each other where the linkage can go no further
SAME = 1e-6  # share of a rate that two branches have to differ by


def branch_rates(compiled: CompiledModel, p: Array, t: float, q: Array) -> list[Array]:
    """The velocities q̇ (n,) of each branch at the singular position q (n,); none where they cannot be told."""
    redundant = set(left_out(compiled))
    rows = [k for k in range(len(compiled.source.start_rows)) if k not in redundant]
    matrix = compiled.closed_phi_q(t, q, p)[rows]
    nu = compiled.closed_nu(t, q, p)[rows]
    if not (len(rows) == len(q) and np.isfinite(matrix).all() and np.isfinite(nu).all()):
        return []
    left, sizes, right = np.linalg.svd(matrix)
    if not (sizes[-1] <= SINGULAR * sizes[0] and sizes[-2] > SINGULAR * sizes[0]):
        return []
    if abs(left[:, -1] @ nu) > CONSISTENT * float(np.abs(nu).max()):
        return []
    v = right[:-1].T @ ((left[:, :-1].T @ nu) / sizes[:-1])
    scale = float(np.abs(v).max())
    f = [left[:, -1] @ compiled.closed_gamma(t, q, v + a * scale * right[-1], p)[rows] for a in (-1.0, 0.0, 1.0)]
    square, linear = 0.5 * (f[0] + f[2]) - f[1], 0.5 * (f[2] - f[0])
    inner = linear**2 - 4.0 * square * f[1]
    if not (scale > 0.0 and square != 0.0 and inner > (SAME * max(abs(linear), abs(square))) ** 2):
        return []
    return [v + (sign * np.sqrt(inner) - linear) / (2.0 * square) * scale * right[-1] for sign in (-1.0, 1.0)]


def branches_told(compiled: CompiledModel, p: Array, t: float, q: Array) -> str:
    """The branches at q in words, by the angular velocity or velocity that differs most; "": none are known."""
    rates = branch_rates(compiled, p, t, q)
    if not rates:
        return ""
    body, _, part = compiled.source.coordinates[int(np.abs(rates[1] - rates[0]).argmax())].rpartition(".")
    k = compiled.source.coordinates.index(f"{body}.{part}")
    name, unit = f"{body}.{'omega' if part == 'theta' else f'v{part}'}", "rad/s" if part == "theta" else "m/s"
    told = " or ".join(f"{name} = {v[k]:.6g} {unit}" for v in rates)
    return f"two branches of the motion meet there, with {told}"

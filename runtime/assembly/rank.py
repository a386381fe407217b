"""Rank of a Jacobian, which of its rows depend on the others, and singular positions.

- `rank`, `tied`: the rank of a matrix, and the share of each row in a combination that vanishes.
- `left_out`: rows that generator/redundancy.py found redundant with the file's numbers. Other lengths, or drives that
  part later, may make them count again; that is checked here.
- `branch_rates`: velocities with which a linkage may pass a singular position. Rows that depend on each other leave
  the velocities open by α n, with n in the null space of Φ_q. Accelerations exist only where λᵀ γ(v) = 0 for the left
  null vector λ of Φ_q. That is a quadratic equation for α: two real roots are two branches; with none the motion ends.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.assembly.large import LARGE, is_independent, rank_by_rows, tied_shares
from gudgeon.assembly.linkage import Linkage, angles, mechanism_size, scaled_rows
from gudgeon.errors import AssemblyError, SolverError
from gudgeon.model.compiled import Array, CompiledModel

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Problem, Trajectory

SAMPLES = 3
REACH = 0.05  # rad, or share of the size: how far from the start the other configurations are
RANK = 1e-9  # singular values below this share of the largest count as zero
DAMPED = 1e-7  # the least limit that a damped factorization can tell
DEAD = 1e-6  # singular values below this share count as zero: a double root is found to 1e-8 only
NEAR = 1e-4  # the same where a motion ended on its way to a dead centre
_POSITION = {"vx": "x", "vy": "y", "omega": "theta"}
MOST = 2_000  # samples of an interrupted run at which that is looked at: Ctrl-C is to be answered
OPEN = 1e-3  # rad, or share of the mechanism's size: a row left out that opens further contradicts the others
SINGULAR = 1e-4  # share of the largest singular value below which one counts as zero
CONSISTENT = 1e-3  # share of the rows' rates that contradict each other where the linkage can go no further
SAME = 1e-6  # share of a rate that two branches have to differ by


def rank(matrix: Array, least: float = RANK) -> int:
    """How many rows are independent."""
    if matrix.shape[1] >= LARGE:
        return len(matrix) if is_independent(matrix, least) else rank_by_rows(matrix, least)
    return _rank(matrix, least)


def tied(matrix: Array, least: float = RANK) -> Array:
    """Of each row its largest share in a combination of rows that vanishes; 0 for rows that depend on nothing."""
    if matrix.shape[1] >= LARGE:
        return tied_shares(matrix, max(least, DAMPED))
    return _tied(matrix, least)


def _rank(matrix: Array, least: float) -> int:
    values = np.linalg.svd(matrix, compute_uv=False)
    return int((values > least * values[0]).sum())


def _tied(matrix: Array, least: float) -> Array:
    left, values, _ = np.linalg.svd(matrix)
    vanishing = left[:, int((values > least * values[0]).sum()) :]
    return np.asarray(np.abs(vanishing).max(axis=1, initial=0.0), dtype=np.float64)


def dependent_rows(compiled: CompiledModel, p: Array, t: float, q: Array) -> tuple[str, ...]:
    """Names of rows of Φ and of start.rates that tie each other at q; empty at an ordinary configuration.

    Rows that are redundant everywhere do not count. They were left out when the scene was derived, or tie each other
    near q, too, as rows of joints with play do that are closed at the start alone.
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
    tied_there = _tied_rows(compiled, p, np.concatenate([compiled.closed_phi_q(t, q, p)[index], rates]), names, DEAD)
    if not tied_there:
        return ()
    near = configurations(compiled, p, q, [k for k in index if source.start_rows[k].kind != "drive"], SAMPLES, t)
    rows = (np.concatenate([compiled.closed_phi_q(t, x, p)[index], rates]) for x in near)
    at_start, *others = (rank(scaled_rows(compiled, p, matrix), DEAD) for matrix in rows)
    return () if others and max(others) == at_start else tied_there


def nearly_dependent_rows(compiled: CompiledModel, p: Array, t: float, q: Array) -> tuple[str, ...]:
    """Names of the motion's rows (joints with play left out) that all but tie each other at q."""
    rows = compiled.source.rows
    if not rows or not np.isfinite(q).all():
        return ()
    return _tied_rows(compiled, p, compiled.phi_q(t, q, p), [row.name for row in rows], NEAR)


def _tied_rows(compiled: CompiledModel, p: Array, matrix: Array, names: list[str], least: float) -> tuple[str, ...]:
    """Names of the rows that depend on each other, by their geometry alone."""
    shares = tied(scaled_rows(compiled, p, matrix), least)
    return tuple(name for name, share in zip(names, shares, strict=True) if share > 1e-6)


def configurations(
    linkage: Linkage, p: Array, q: Array, rows: Sequence[int], count: int, t: float = 0.0
) -> list[Array]:
    """The start, and `count` configurations near it: a random step along the motion, closed again by Newton's."""
    if not count:  # NumPy imports its random numbers when they are asked for
        return [q]
    rng, found, kept, size = np.random.default_rng(0), [q], list(rows), mechanism_size(linkage, p)
    scale = np.where(angles(linkage.source), 1.0, size)
    units = np.array([size if linkage.source.start_rows[k].unit == "m" else 1.0 for k in kept])
    for _ in range(count):
        x = q + REACH * rng.standard_normal(len(q)) * scale
        for _ in range(50):
            residual = linkage.closed_phi(t, x, p)[kept] / units
            if np.abs(residual).max(initial=0.0) < 1e-13:
                break
            matrix = linkage.closed_phi_q(t, x, p)[kept] * scale / units[:, None]
            x = x - scale * np.linalg.lstsq(matrix, residual, rcond=1e-10)[0]
        if np.abs(linkage.closed_phi(t, x, p)[kept] / units).max(initial=0.0) < 1e-9:
            found.append(x)
    return found


def left_out(compiled: CompiledModel) -> list[int]:
    """Rows of the closed linkage that are neither kept nor those of a joint with play."""
    source = compiled.source
    kept, with_play = {row.name for row in source.rows}, {joint.joint for joint in source.clearances}
    return [k for k, row in enumerate(source.start_rows) if row.name not in kept and row.owner not in with_play]


def check_start(compiled: CompiledModel, p: Array, t: float, q: Array) -> None:
    """AssemblyError where a row that was left out would take a degree of freedom at the start."""
    extra = left_out(compiled)
    if not extra:
        return
    rows = scaled_rows(compiled, p, compiled.closed_phi_q(t, q, p))
    kept = scaled_rows(compiled, p, compiled.phi_q(t, q, p))
    if rank(kept) == len(kept) and rank(np.concatenate([kept, rows[extra]])) > len(kept):
        raise AssemblyError(
            f"{_named(compiled, extra)} said nothing new with the file's numbers and"
            " would hold the linkage with these\n"
            "  give the numbers in the file or as overrides of load(), so that the constraints are counted anew"
        )


def contradiction(problem: Problem, trajectory: Trajectory) -> SolverError | None:
    """The error for the first sample at which a row that was left out is open.

    Of a run that was interrupted, for the first of MOST samples, the last one among them. KeyboardInterrupt.
    """
    compiled, p = problem.compiled, problem.p
    extra = left_out(compiled)
    if not extra:
        return None
    size = mechanism_size(compiled, p)
    scale = np.array([size if compiled.source.start_rows[k].unit == "m" else 1.0 for k in extra])
    stride = math.ceil(len(trajectory.t) / MOST) if trajectory.interrupted else 1
    for k in range((len(trajectory.t) - 1) % stride, len(trajectory.t), stride):
        if k % 256 == 0:
            problem.take()
        t = float(trajectory.t[k])
        far = np.abs(compiled.closed_phi(t, trajectory.q[k], p)[extra]) > OPEN * scale
        if far.any():
            names = _named(compiled, [row for row, is_far in zip(extra, far, strict=True) if is_far])
            return SolverError(
                f"the constraints contradict each other by t = {t:.9g} s: {names} depended on the others and is open"
                " now\n  check the values of the drives and the lengths of links that run side by side",
                t,
            )
    return None


def _named(compiled: CompiledModel, rows: list[int]) -> str:
    found = [compiled.source.start_rows[k] for k in rows]
    owners = dict.fromkeys([*(row.owner for row in found), *compiled.source.indeterminate])
    return f"row {', '.join(row.name for row in found)} (with {', '.join(owners)})"


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

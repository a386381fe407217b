"""Compute the rank of Jacobians, dependent constraint equations, and branches at singular positions.

- `rank`, `tied`: the rank of a matrix, and the share of each row in a vanishing combination.
- `left_out`: equations that generator/redundancy.py found redundant with the file's values. Other lengths or
  drives may make them independent again; that is checked here.
- `branch_rates`: velocities with which a linkage may pass a singular position. Dependent equations leave the velocities
  open by α n, with n in the null space of Φ_q. Accelerations exist only where λᵀ γ(v) = 0 for the left null vector λ
  of Φ_q. This quadratic equation has two real roots for two branches; without any, the motion ends.
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

SAMPLES = 3  # configurations near the start at which ranks are evaluated
REACH = 0.05  # rad, or relative to the size: distance of these configurations from the start
RANK = 1e-9  # singular values below this fraction of the largest count as zero
DAMPED = 1e-7  # smallest limit that a damped factorization can distinguish
DEAD = 1e-6  # singular values below this fraction count as zero: a double root is found to 1e-8 only
NEAR = 1e-4  # the same where a motion ended on its way to a dead centre
_POSITION = {"vx": "x", "vy": "y", "omega": "theta"}
MOST = 2_000  # largest number of samples of an interrupted run that are checked, so that Ctrl-C is answered soon
OPEN = 1e-3  # rad, or relative to the size: a redundant equation violated by more contradicts the others
SINGULAR = 1e-4  # fraction of the largest singular value below which one counts as zero
CONSISTENT = 1e-3  # relative contradiction of the rates at which the linkage cannot move further
SAME = 1e-6  # smallest relative difference of the rates of two branches


def rank(matrix: Array, least: float = RANK) -> int:
    """Return the number of independent rows of a matrix."""
    if matrix.shape[1] >= LARGE:
        return len(matrix) if is_independent(matrix, least) else rank_by_rows(matrix, least)
    return _rank(matrix, least)


def tied(matrix: Array, least: float = RANK) -> Array:
    """Return for each row its largest share in a vanishing combination of rows; 0 for independent rows."""
    if matrix.shape[1] >= LARGE:
        return tied_shares(matrix, max(least, DAMPED))
    return _tied(matrix, least)


def _rank(matrix: Array, least: float) -> int:
    """Return the rank of a small matrix by its singular values."""
    values = np.linalg.svd(matrix, compute_uv=False)
    return int((values > least * values[0]).sum())


def _tied(matrix: Array, least: float) -> Array:
    """Return the shares of the rows of a small matrix in vanishing combinations."""
    left, values, _ = np.linalg.svd(matrix)
    vanishing = left[:, int((values > least * values[0]).sum()) :]
    return np.asarray(np.abs(vanishing).max(axis=1, initial=0.0), dtype=np.float64)


def dependent_rows(compiled: CompiledModel, p: Array, t: float, q: Array) -> tuple[str, ...]:
    """Return the equations of Φ and start.rates that depend on each other at q; () at a regular position.

    Equations that are redundant everywhere do not count: they were left out when the scene was derived, or depend on
    each other near q, too.
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
    """Return the equations of the motion (without joints with play) that nearly depend on each other at q."""
    rows = compiled.source.rows
    if not rows or not np.isfinite(q).all():
        return ()
    return _tied_rows(compiled, p, compiled.phi_q(t, q, p), [row.name for row in rows], NEAR)


def _tied_rows(compiled: CompiledModel, p: Array, matrix: Array, names: list[str], least: float) -> tuple[str, ...]:
    """Return the names of the rows that depend on each other, by their geometry alone."""
    shares = tied(scaled_rows(compiled, p, matrix), least)
    return tuple(name for name, share in zip(names, shares, strict=True) if share > 1e-6)


def configurations(
    linkage: Linkage, p: Array, q: Array, rows: Sequence[int], count: int, t: float = 0.0
) -> list[Array]:
    """Return the start and `count` configurations near it: random steps along the motion, closed by Newton."""
    if not count:  # NumPy's random numbers are imported on request
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
    """Return the indices of equations of the closed linkage that are redundant: not kept, and not of joints with
    play.
    """
    source = compiled.source
    kept, with_play = {row.name for row in source.rows}, {joint.joint for joint in source.clearances}
    return [k for k, row in enumerate(source.start_rows) if row.name not in kept and row.owner not in with_play]


def check_start(compiled: CompiledModel, p: Array, t: float, q: Array) -> None:
    """Raise AssemblyError if a redundant equation would remove a degree of freedom at the start."""
    extra = left_out(compiled)
    if not extra:
        return
    rows = scaled_rows(compiled, p, compiled.closed_phi_q(t, q, p))
    kept = scaled_rows(compiled, p, compiled.phi_q(t, q, p))
    if rank(kept) == len(kept) and rank(np.concatenate([kept, rows[extra]])) > len(kept):
        raise AssemblyError(
            f"{_equations_text(compiled, extra)} said nothing new with the file's numbers and"
            " would hold the linkage with these\n"
            "  give the numbers in the file or as overrides of load(), so that the constraints are counted anew"
        )


def contradiction(problem: Problem, trajectory: Trajectory) -> SolverError | None:
    """Return the error for the first sample at which a redundant equation is violated, or None.

    For an interrupted run, at most MOST samples are checked, the last one among them. Raises KeyboardInterrupt.
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
            names = _equations_text(compiled, [row for row, is_far in zip(extra, far, strict=True) if is_far])
            return SolverError(
                f"the constraints contradict each other by t = {t:.9g} s: {names} depended on the others and is open"
                " now\n  check the values of the drives and the lengths of links that run side by side",
                t,
            )
    return None


def _equations_text(compiled: CompiledModel, rows: list[int]) -> str:
    """Return a text with the names of equations and their joints."""
    found = [compiled.source.start_rows[k] for k in rows]
    owners = dict.fromkeys([*(row.owner for row in found), *compiled.source.indeterminate])
    return f"row {', '.join(row.name for row in found)} (with {', '.join(owners)})"


def branch_rates(compiled: CompiledModel, p: Array, t: float, q: Array) -> list[Array]:
    """Return the velocities q̇ (n,) of each branch at the singular position q (n,); [] if they are unknown."""
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


def branches_text(compiled: CompiledModel, p: Array, t: float, q: Array) -> str:
    """Return the branches at q as text, by the velocity that differs most; "" if none are known."""
    rates = branch_rates(compiled, p, t, q)
    if not rates:
        return ""
    body, _, part = compiled.source.coordinates[int(np.abs(rates[1] - rates[0]).argmax())].rpartition(".")
    k = compiled.source.coordinates.index(f"{body}.{part}")
    name, unit = f"{body}.{'omega' if part == 'theta' else f'v{part}'}", "rad/s" if part == "theta" else "m/s"
    message = " or ".join(f"{name} = {v[k]:.6g} {unit}" for v in rates)
    return f"two branches of the motion meet there, with {message}"

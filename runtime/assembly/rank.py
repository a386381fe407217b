"""Compute the rank of Jacobians, dependent constraint equations, and branches at singular positions.

- `compute_rank`, `compute_left_null_maxima`: the rank of a matrix, and the largest entries of its left null
vectors, which are nonzero for dependent rows.
- `list_redundant_equations`: equations that generator/redundancy.py found redundant with the file's values. Other
lengths or drives may make them independent again; that is checked here.
- `compute_branch_velocities`: velocities with which a linkage may pass a singular position. Dependent equations
determine the velocities up to α n, with n in the null space of Φ_q. Accelerations exist only where λᵀ γ(v) = 0 for the
left null vector λ of Φ_q. This quadratic equation has two real roots for two branches; without any, the motion ends.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.assembly.large import (
    MIN_SPARSE_COORDINATES,
    compute_rank_by_gram_schmidt,
    estimate_left_null_maxima,
    has_independent_rows,
    solve_minimum_norm,
)
from gudgeon.assembly.linkage import Linkage, compute_mechanism_size, find_angles, normalize_jacobian_rows
from gudgeon.errors import AssemblyError, SolverError
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array, CompiledModel

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Problem, Trajectory

N_NEARBY_CONFIGURATIONS = 3  # configurations near the start at which ranks are evaluated
NEARBY_DISTANCE = 0.05  # rad, or relative to the size: distance of these configurations from the start
RANK_TOL = 1e-9  # singular values below this fraction of the largest count as zero
MIN_DAMPED_TOL = 1e-7  # smallest limit that a damped factorization can distinguish
DEAD_CENTRE_TOL = 1e-6  # singular values below this fraction count as zero: a double root is found to 1e-8 only
NEAR_DEAD_CENTRE_TOL = 1e-4  # the same for a motion that ended just before a dead centre
_POSITION = {"vx": "x", "vy": "y", "omega": "theta"}
# largest number of samples of an interrupted run that are checked, so that Ctrl-C is answered soon
MAX_CHECKED_SAMPLES = 2_000
# rad, or relative to the size: a redundant equation violated by more contradicts the others
MAX_REDUNDANT_VIOLATION = 1e-3
SINGULAR_TOL = 1e-4  # fraction of the largest singular value below which one counts as zero
CONSISTENCY_TOL = 1e-3  # relative contradiction of the rates at which the linkage cannot move further
MIN_BRANCH_DIFFERENCE = 1e-6  # smallest relative difference of the rates of two branches


def compute_rank(matrix: Array, relative_limit: float = RANK_TOL) -> int:
    """Return the number of independent rows of a matrix.

    relative_limit: singular values below this fraction of the largest count as zero. From MIN_SPARSE_COORDINATES
    columns on, sparse factorization and Gram–Schmidt with pivoting replace the singular values.
    """
    if matrix.shape[1] >= MIN_SPARSE_COORDINATES:
        return (
            len(matrix)
            if has_independent_rows(matrix, relative_limit)
            else compute_rank_by_gram_schmidt(matrix, relative_limit)
        )
    return _compute_rank_by_svd(matrix, relative_limit)


def compute_left_null_maxima(matrix: Array, relative_limit: float = RANK_TOL) -> Array:
    """Return for each row, (m,), its largest magnitude in left null vectors (unit vectors); 0 for independent rows.

    relative_limit: singular values below this fraction of the largest count as zero. From MIN_SPARSE_COORDINATES
    columns on the result is an estimate, with a limit of at least MIN_DAMPED_TOL.
    """
    if matrix.shape[1] >= MIN_SPARSE_COORDINATES:
        return estimate_left_null_maxima(matrix, max(relative_limit, MIN_DAMPED_TOL))
    return _compute_left_null_maxima_by_svd(matrix, relative_limit)


def _compute_rank_by_svd(matrix: Array, relative_limit: float) -> int:
    """Return the rank of a small matrix: singular values above `relative_limit` times the largest."""
    values = np.linalg.svd(matrix, compute_uv=False)
    return int((values > relative_limit * values[0]).sum())


def _compute_left_null_maxima_by_svd(matrix: Array, relative_limit: float) -> Array:
    """Return for each row of a small matrix, (m,), its largest magnitude in left null vectors, by singular vectors."""
    left, values, _ = np.linalg.svd(matrix)
    vanishing = left[:, int((values > relative_limit * values[0]).sum()) :]
    return np.asarray(np.abs(vanishing).max(axis=1, initial=0.0), dtype=np.float64)


@cache_by_values
def find_dependent_equations(compiled: CompiledModel, p: Array, t: float, q: Array) -> tuple[str, ...]:
    """Return the names of the equations of Φ and start.rates that depend on each other at q; () at a regular position.

    Equations that are redundant everywhere do not count: they were left out in the derivation of the scene, or depend
    on each other near q, too. Results are cached.
    """
    source = compiled.source
    redundant = set(list_redundant_equations(compiled))
    index = [k for k in range(len(source.start_equations)) if k not in redundant]
    if not index:
        return ()
    names = [source.start_equations[k].name for k in index] + list(source.start_rates)
    rates = np.zeros((len(source.start_rates), len(q)))
    for k, rate in enumerate(source.start_rates):
        body, _, component = rate.partition(".")
        rates[k, source.coordinates.index(f"{body}.{_POSITION[component]}")] = 1.0
    dependent = _find_dependent_rows(
        compiled, p, np.concatenate([compiled.closed_phi_q(t, q, p)[index], rates]), names, DEAD_CENTRE_TOL
    )
    if not dependent:
        return ()
    near_q = find_nearby_configurations(
        compiled, p, q, [k for k in index if source.start_equations[k].kind != "drive"], N_NEARBY_CONFIGURATIONS, t
    )
    rows = (np.concatenate([compiled.closed_phi_q(t, x, p)[index], rates]) for x in near_q)
    at_start, *others = (compute_rank(normalize_jacobian_rows(compiled, p, matrix), DEAD_CENTRE_TOL) for matrix in rows)
    return () if others and max(others) == at_start else dependent


def find_nearly_dependent_equations(compiled: CompiledModel, p: Array, t: float, q: Array) -> tuple[str, ...]:
    """Return the names of the equations of motion (joints with play left out) that nearly depend on each other at q.

    () without equations, or if q is not finite.
    """
    rows = compiled.source.equations
    if not rows or not np.isfinite(q).all():
        return ()
    return _find_dependent_rows(compiled, p, compiled.phi_q(t, q, p), [row.name for row in rows], NEAR_DEAD_CENTRE_TOL)


def _find_dependent_rows(
    compiled: CompiledModel, p: Array, matrix: Array, names: list[str], relative_limit: float
) -> tuple[str, ...]:
    """Return the names of the rows that depend on each other, after scaling, so that units do not matter.

    matrix: rows of Φ_q. relative_limit: as in `compute_left_null_maxima`; a row depends on others if its magnitude in
    left null vectors exceeds 1e-6.
    """
    maxima = compute_left_null_maxima(normalize_jacobian_rows(compiled, p, matrix), relative_limit)
    return tuple(name for name, maximum in zip(names, maxima, strict=True) if maximum > 1e-6)


def find_nearby_configurations(
    linkage: Linkage, p: Array, q: Array, equation_indices: Sequence[int], n_configurations: int, t: float = 0.0
) -> list[Array]:
    """Return q and up to `n_configurations` configurations near it: random steps, closed by Newton's method.

    A random step is of the size NEARBY_DISTANCE (rad, or times the mechanism's size), the same in every run.
    equation_indices: indices of the equations that must be satisfied. Configurations that do not close in 50 steps are
    left out.
    """
    if not n_configurations:  # NumPy's random numbers are imported on request
        return [q]
    rng, near_q, row_indices, size = (
        np.random.default_rng(0),
        [q],
        list(equation_indices),
        compute_mechanism_size(linkage, p),
    )
    scale = np.where(find_angles(linkage.source), 1.0, size)
    units = np.array([size if linkage.source.start_equations[k].unit == "m" else 1.0 for k in row_indices])
    for _ in range(n_configurations):
        x = q + NEARBY_DISTANCE * rng.standard_normal(len(q)) * scale
        for _ in range(50):
            residual = linkage.closed_phi(t, x, p)[row_indices] / units
            if np.abs(residual).max(initial=0.0) < 1e-13:
                break
            matrix = linkage.closed_phi_q(t, x, p)[row_indices] * scale / units[:, None]
            step = (
                solve_minimum_norm(matrix, residual)
                if len(x) >= MIN_SPARSE_COORDINATES
                else np.linalg.lstsq(matrix, residual, rcond=1e-10)[0]
            )
            x = x - scale * step
        if np.abs(linkage.closed_phi(t, x, p)[row_indices] / units).max(initial=0.0) < 1e-9:
            near_q.append(x)
    return near_q


@cache_by_values
def list_redundant_equations(compiled: CompiledModel) -> list[int]:
    """Return the indices in source.start_equations of equations that were found redundant and are not integrated.

    Equations of joints with play do not count. The list is cached: callers must not change it.
    """
    source = compiled.source
    integrated, with_play = {row.name for row in source.equations}, {joint.joint for joint in source.clearances}
    return [
        k for k, row in enumerate(source.start_equations) if row.name not in integrated and row.owner not in with_play
    ]


def check_redundant_equations(compiled: CompiledModel, p: Array, t: float, q: Array) -> None:
    """Raise AssemblyError if an equation that was redundant with the file's values removes a degree of freedom at q.

    p: parameter values of the run; t: time, s. Nothing is checked without redundant equations, or if the integrated
    equations depend on each other at q, as at a singular position.
    """
    extra = list_redundant_equations(compiled)
    if not extra:
        return
    rows = normalize_jacobian_rows(compiled, p, compiled.closed_phi_q(t, q, p))
    integrated = normalize_jacobian_rows(compiled, p, compiled.phi_q(t, q, p))
    n_rows = len(integrated)
    if compute_rank(integrated) == n_rows and compute_rank(np.concatenate([integrated, rows[extra]])) > n_rows:
        raise AssemblyError(
            f"redundant with the file's values, but not with these: {_format_equation_names(compiled, extra)}\n"
            "  give the values in the file or as overrides of load(), so that redundant constraints are found again"
        )


def find_constraint_violation(problem: Problem, trajectory: Trajectory) -> SolverError | None:
    """Return the error for the first sample at which a trajectory violates a redundant equation; None if none does.

    A residual above MAX_REDUNDANT_VIOLATION (of the mechanism's size for lengths) is a violation. Of an interrupted
    run, at most MAX_CHECKED_SAMPLES samples are checked, the last one among them. Raises KeyboardInterrupt.
    """
    compiled, p = problem.compiled, problem.p
    extra = list_redundant_equations(compiled)
    if not extra:
        return None
    size = compute_mechanism_size(compiled, p)
    scale = np.array([size if compiled.source.start_equations[k].unit == "m" else 1.0 for k in extra])
    stride = math.ceil(len(trajectory.t) / MAX_CHECKED_SAMPLES) if trajectory.interrupted else 1
    for k in range((len(trajectory.t) - 1) % stride, len(trajectory.t), stride):
        if k % 256 == 0:
            problem.poll_cancellation()
        t = float(trajectory.t[k])
        far = np.abs(compiled.closed_phi(t, trajectory.q[k], p)[extra]) > MAX_REDUNDANT_VIOLATION * scale
        if far.any():
            names = _format_equation_names(compiled, [row for row, is_far in zip(extra, far, strict=True) if is_far])
            return SolverError(
                f"the constraints contradict each other by t = {t:.9g} s: redundant before, and violated now:"
                f" {names}\n  check the values of the drives and the lengths of parallel links",
                t,
            )
    return None


def _format_equation_names(compiled: CompiledModel, equation_indices: list[int]) -> str:
    """Return the names of equations, of their joints, and of joints with indeterminate forces, as text.

    An example: "constraint equation C.x (joints C, D)".
    """
    equations = [compiled.source.start_equations[k] for k in equation_indices]
    owners = dict.fromkeys([*(row.owner for row in equations), *compiled.source.indeterminate])
    return f"constraint equation {', '.join(row.name for row in equations)} (joints {', '.join(owners)})"


def compute_branch_velocities(compiled: CompiledModel, p: Array, t: float, q: Array) -> list[Array]:
    """Return the velocities q̇ (n,) of both branches of the motion at the singular position q.

    [] if the position is regular, has more than one dependent equation, contradicts the drives, or has no two distinct
    real branches.
    """
    redundant = set(list_redundant_equations(compiled))
    rows = [k for k in range(len(compiled.source.start_equations)) if k not in redundant]
    matrix = compiled.closed_phi_q(t, q, p)[rows]
    nu = compiled.closed_nu(t, q, p)[rows]
    if not (len(rows) == len(q) and np.isfinite(matrix).all() and np.isfinite(nu).all()):
        return []
    left, sizes, right = np.linalg.svd(matrix)
    if not (sizes[-1] <= SINGULAR_TOL * sizes[0] and sizes[-2] > SINGULAR_TOL * sizes[0]):
        return []
    if abs(left[:, -1] @ nu) > CONSISTENCY_TOL * float(np.abs(nu).max()):
        return []
    v = right[:-1].T @ ((left[:, :-1].T @ nu) / sizes[:-1])
    scale = float(np.abs(v).max())
    f = [left[:, -1] @ compiled.closed_gamma(t, q, v + a * scale * right[-1], p)[rows] for a in (-1.0, 0.0, 1.0)]
    square, linear = 0.5 * (f[0] + f[2]) - f[1], 0.5 * (f[2] - f[0])
    inner = linear**2 - 4.0 * square * f[1]
    if not (scale > 0.0 and square != 0.0 and inner > (MIN_BRANCH_DIFFERENCE * max(abs(linear), abs(square))) ** 2):
        return []
    return [v + (sign * np.sqrt(inner) - linear) / (2.0 * square) * scale * right[-1] for sign in (-1.0, 1.0)]


def describe_branches(compiled: CompiledModel, p: Array, t: float, q: Array) -> str:
    """Return a text on both branches of the motion at q, by the velocity that differs most; "" if they are unknown."""
    rates = compute_branch_velocities(compiled, p, t, q)
    if not rates:
        return ""
    body, _, part = compiled.source.coordinates[int(np.abs(rates[1] - rates[0]).argmax())].rpartition(".")
    k = compiled.source.coordinates.index(f"{body}.{part}")
    name, unit = f"{body}.{'omega' if part == 'theta' else f'v{part}'}", "rad/s" if part == "theta" else "m/s"
    message = " or ".join(f"{name} = {v[k]:.6g} {unit}" for v in rates)
    return f"two branches of the motion meet there, with {message}"

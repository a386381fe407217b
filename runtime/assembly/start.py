"""Assemble a linkage at the start, near the file's guess: positions by Newton's method, then velocities.

A scene with play starts without it (e = 0), unless the file's `start.play` gives e and ė of a journal.
Guessed angles have the largest weights, then other angles, then positions. Usually one call of C suffices
(engine/scene/start.c). If C cannot close the linkage near the guess, `search_start` finds the nearest closed
configuration. Its modules are imported only then, for a quick start.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.assembly.journals import check_journal_positions
from gudgeon.assembly.large import MIN_SPARSE_COORDINATES, solve_minimum_norm
from gudgeon.assembly.linkage import Linkage, compute_mechanism_size
from gudgeon.errors import AssemblyError
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.sizes import compute_norm_weights

if TYPE_CHECKING:
    from gudgeon.assembly.closure import AssemblyProblem

MIN_RESOLVED = float(np.finfo(float).tiny / np.finfo(float).eps)  # smaller numbers may have fewer digits


@dataclass(frozen=True)
class Start:
    """Hold q, q̇ (n,) at time t, with the remaining residual max |Φ|."""

    q: Array
    v: Array
    residual: float


def assemble_start(compiled: CompiledModel, p: Array, t: float = 0.0) -> Start:
    """Return the assembled start of a scene at time t, by C or, if that fails, by the search in Python.

    From MIN_SPARSE_COORDINATES coordinates on, C is not tried. Raises AssemblyError with equations, joints and
    residual, or for a start position of a journal that is too deep in its wall.
    """
    check_journal_positions(compiled, p)
    closed = (
        compiled.close_linkage(t, p, compute_mechanism_size(compiled, p))
        if compiled.n < MIN_SPARSE_COORDINATES
        else None
    )
    if closed is not None and np.isfinite(closed[1]).all():
        return Start(*closed)
    return search_start(compiled, p, t)


def search_start(linkage: Linkage, p: Array, t: float = 0.0) -> Start:
    """Return the start nearest to the guess by a search in Python: closed configuration, then velocities.

    Called if C does not converge, and for large mechanisms. Raises AssemblyError with equations, joints and residual.
    """
    from gudgeon.assembly.closure import AssemblyProblem

    problem = AssemblyProblem(linkage, p, t)
    with np.errstate(all="ignore"):  # Newton handles undefined directions itself
        q, closed = problem.find_nearest_configuration()
    if not closed:
        from gudgeon.assembly.failures import make_closure_error

        raise make_closure_error(problem, q)
    return Start(q, compute_start_velocities(problem, q), float(np.abs(problem.compute_residual(q)).max(initial=0.0)))


def _choose_rate_time(problem: AssemblyProblem) -> float:
    """Return the time (s) at which the drives' rates are evaluated: just after t if a rate jumps there, else t."""
    more = max(32 * np.finfo(float).eps * abs(problem.t), 1e-100)
    return problem.t + more if problem.linkage.source.rate_jumps else problem.t


def compute_start_velocities(problem: AssemblyProblem, q: Array) -> Array:
    """Return q̇ (n,) with Φ_q q̇ = ν and the start's rates; undetermined velocities are least in the norm of M.

    Joints with play whose rate of eccentricity the file's start sets get that rate. Raises AssemblyError if a rate is
    not finite or the equations contradict each other.
    """
    names = {"x": "vx", "y": "vy", "theta": "omega"}
    expected = [f"{body}.{names[c]}" for body, c in (name.split(".") for name in problem.coordinate_index)]
    index = [expected.index(name) for name in problem.linkage.source.start_rates]
    rate_rows = np.zeros((len(index), len(q)))
    rate_rows[np.arange(len(index)), index] = 1.0
    matrix = np.concatenate([problem.linkage.closed_phi_q(problem.t, q, problem.p), rate_rows])
    nu = problem.linkage.closed_nu(_choose_rate_time(problem), q, problem.p)
    nu[problem.eccentricity_rows] -= problem.start_eccentricity_rates
    target = np.concatenate([nu, problem.rates])
    if not (np.isfinite(target).all() and np.isfinite(matrix).all()):
        source = problem.linkage.source
        rows = [row.name for row, x in zip(source.start_equations, target, strict=False) if not np.isfinite(x)]
        raise AssemblyError(
            f"the start has no velocities: the rate of {', '.join(rows) or 'the constraints'} is not finite at"
            f" t = {problem.t:g} s\n  the slope of a root or a power is infinite where it begins: use smooth_step, or"
            " start later"
        )
    root_of_mass = np.sqrt(compute_norm_weights(problem.linkage.source, problem.p, problem.linkage.mass(problem.p)))
    v = np.zeros_like(q)
    for _ in range(2):  # once more for the rounding of the first solution
        v += solve_minimum_norm(matrix / root_of_mass, target - matrix @ v) / root_of_mass
    left = np.abs(matrix @ v - target)
    if left.max(initial=0.0) > 1e-8 * float(np.abs(target).max(initial=0.0)) + MIN_RESOLVED:
        from gudgeon.assembly.failures import make_velocity_error

        raise make_velocity_error(problem, matrix / root_of_mass, left)
    return v

"""Solve the discrete film equation under one of three cavitation conditions.

half_sommerfeld: p of the whole film, of which only p > 0 contributes to forces (L. Gümbel). It does not conserve oil.

reynolds: p ≥ 0, outflow ≥ squeeze flow, with equality in one of both at every node: ∂p/∂φ = 0 at the film's end. Oil is
conserved at the rupture, not at the reformation (H. W. Swift, W. Stieber). The complementarity problem has an M-matrix:
its active set is found in finitely many steps (M. Hintermüller, K. Ito, K. Kunisch, SIAM J. Optim. 13 (2003) 865–888).

elrod_adams: p ≥ 0, θ ≤ 1 and p (1 − θ) = 0. θ is the fraction of the gap that oil fills; it is convected with the
surfaces (B. Jakobsson, L. Floberg, K. O. Olsson; H. G. Elrod, ASME J. Lubr. Technol. 103 (1981) 350–354).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu

from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.reynolds.equation import Array, Equation
from gudgeon.waiting.cancellation import run_interruptible

Flags = NDArray[np.bool_]
MAX_MONOTONE_STEPS = 1000  # iterations of a monotone active set: at most one cell each; from a coarser grid a few
MAX_STEPS = 100  # iterations of an active set that may cycle
MIN_THREADED_UNKNOWNS = 20_000  # above it the factorization (0.1 s) runs in a thread, so that Ctrl-C is immediate


@dataclass(frozen=True)
class Motion:
    """Motion of the gap in 1/s: effective squeeze velocity over c, and half of ω_s."""

    w_n: float
    w_t: float
    half_speed: float


@dataclass(frozen=True)
class Pressure:
    """Solution for all unknowns (n·n_rows,): pressure, filled fraction θ, and gain of each cell.

    unknown: signed with half_sommerfeld. gain: outflow − closing (for elrod_adams also the convected oil); 0 where the
    equation holds.
    """

    unknown: Array
    filled: Array
    gain: Array


def solve_pressure(
    cavitation: str, equation: Equation, motion: Motion, free_nodes: Flags, initial_unknowns: Array | None = None
) -> Pressure:
    """Solve the film equation under a cavitation condition, and return pressure, filled fraction and gain of all nodes.

    cavitation: "half_sommerfeld" (full film, p may be negative), "reynolds" or "elrod_adams". gain: outflow of a cell
    less its squeeze flow. free_nodes: nodes at which p is unknown, all except the groove. initial_unknowns: unknowns of
    a coarser grid; their signs are the initial active set. None: the signs of the squeeze flow; elrod_adams then starts
    from the solution of reynolds. Raises BadValueError, GudgeonError if the active set does not converge.
    """
    squeeze_flow = equation.compute_squeeze_flow(motion.w_n, motion.w_t)
    if cavitation == "half_sommerfeld":
        p = _solve_subsystem(equation.pressure_flow_matrix, squeeze_flow, free_nodes)
        return Pressure(p, np.ones_like(p), equation.pressure_flow_matrix @ p - squeeze_flow)
    has_pressure = (squeeze_flow > 0.0) if initial_unknowns is None else (initial_unknowns > 0.0)
    if cavitation == "elrod_adams" and initial_unknowns is not None:
        return _solve_elrod_adams(equation, motion, free_nodes, has_pressure & free_nodes)
    p, has_pressure = _solve_complementarity_problem(
        equation.pressure_flow_matrix, squeeze_flow, free_nodes, has_pressure & free_nodes
    )
    if cavitation == "elrod_adams":
        return _solve_elrod_adams(equation, motion, free_nodes, has_pressure)
    return Pressure(p, np.ones_like(p), equation.pressure_flow_matrix @ p - squeeze_flow)


def _solve_subsystem(matrix: sparse.csr_matrix, right_side: Array, selected_nodes: Flags) -> Array:
    """Return p of the equations matrix p = right_side at the selected nodes, with p = 0 at all other nodes."""
    p = np.zeros(len(right_side))
    if selected_nodes.any():
        p[selected_nodes] = _factorize_m_matrix(matrix[selected_nodes][:, selected_nodes]).solve(
            right_side[selected_nodes]
        )
    return p


def _factorize_m_matrix(matrix: sparse.csr_matrix) -> Any:
    """Return the LU factors of an M-matrix with symmetric pattern, without pivoting, an object with `solve`."""
    options = {"SymmetricMode": True}
    return _factorize(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)


def _factorize(matrix: sparse.csr_matrix, **options: Any) -> Any:
    """Return SuperLU's factors L U of a sparse matrix; `options` are arguments of `splu`.

    Large matrices are factorized in another thread, so that Ctrl-C is immediate. Raises GudgeonError if a pivot
    vanishes because the gap is almost closed.
    """
    columns = matrix.tocsc()
    try:
        if columns.shape[0] < MIN_THREADED_UNKNOWNS:
            return splu(columns, **options)
        return run_interruptible(lambda: splu(columns, **options))
    except RuntimeError as error:  # SuperLU raises it for a pivot of 0
        message = "reynolds: the gap is too thin for doubles: try a smaller eccentricity or other cells"
        raise GudgeonError(message) from error


def _solve_complementarity_problem(
    matrix: sparse.csr_matrix, squeeze_flow: Array, free_nodes: Flags, active_nodes: Flags
) -> tuple[Array, Flags]:
    """Return pressure and active set (nodes with p > 0) of the complementarity problem of the reynolds condition.

    free_nodes: all nodes but the groove. active_nodes: first guess of the active set.
    Raises GudgeonError if the active set does not converge in MAX_MONOTONE_STEPS iterations.
    """
    for _ in range(MAX_MONOTONE_STEPS):
        p = _solve_subsystem(matrix, squeeze_flow, active_nodes)
        next_active = np.where(active_nodes, p > 0.0, matrix @ p < squeeze_flow) & free_nodes
        if np.array_equal(next_active, active_nodes):
            return p, active_nodes
        active_nodes = next_active
    raise GudgeonError("reynolds: the boundary of the film was not found: try another number of cells")


def _solve_elrod_adams(equation: Equation, motion: Motion, free_nodes: Flags, full_nodes: Flags) -> Pressure:
    """Return the solution for p in full nodes and for θ in cavitated nodes; the groove is full with p = 0.

    free_nodes: all nodes but the groove. full_nodes: first guess of the full nodes; if it fails, the iteration starts
    from no full nodes. Raises BadValueError if the gap closes faster than oil is convected, GudgeonError if the active
    set does not converge.
    """
    matrix, convection = equation.pressure_flow_matrix, equation.build_convection_matrix(motion.half_speed, motion.w_n)
    if (convection.diagonal() <= 0.0).any():
        raise BadValueError(
            "elrod_adams: the gap closes faster than oil is convected",
            hint="θ would depend on the history; cavitation='reynolds' does not use θ",
        )
    pressure = _solve_by_active_set(matrix, convection, free_nodes, full_nodes) or _solve_by_active_set(
        matrix, convection, free_nodes, np.zeros_like(full_nodes)
    )
    if pressure is None:
        raise GudgeonError("elrod_adams: the boundary of the film was not found: try another number of cells")
    return pressure


def _solve_by_active_set(
    matrix: sparse.csr_matrix, convection: sparse.csr_matrix, free_nodes: Flags, full_nodes: Flags
) -> Pressure | None:
    """Solve for p and θ by iterating the active set of full nodes; return None without convergence in MAX_STEPS.

    In each iteration p is unknown in full nodes and θ in the others; then nodes with p > 0 or θ > 1 are full. matrix,
    convection: outflows by pressure and by filled fraction. free_nodes: all nodes except the groove.
    full_nodes: initial guess. Without supply of oil the iteration may cycle; the caller then starts without full nodes.
    """
    groove = np.where(free_nodes, 0.0, 1.0)
    for _ in range(MAX_STEPS):
        is_full = full_nodes.astype(float)
        columns = matrix @ sparse.diags(is_full) + convection @ sparse.diags(1.0 - is_full)
        right_side = -(convection @ (is_full + groove))
        unknowns = np.zeros(len(right_side))
        unknowns[free_nodes] = _factorize(columns[free_nodes][:, free_nodes]).solve(right_side[free_nodes])
        p, filled = np.where(full_nodes, unknowns, 0.0), np.where(full_nodes | ~free_nodes, 1.0, unknowns)
        next_full = np.where(full_nodes, p > 0.0, filled > 1.0) & free_nodes
        if np.array_equal(next_full, full_nodes):
            return Pressure(p, filled, matrix @ p + convection @ filled)
        full_nodes = next_full
    return None

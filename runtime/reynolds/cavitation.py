"""What the film does where it cannot pull: three answers, each of them a solution of the discrete flows.

half_sommerfeld  p of the whole film, of which only p > 0 carries (L. Gümbel): what is dropped conserves no oil.
reynolds         p ≥ 0, outflow ≥ closing, and one of both at every node: ∂p/∂φ = 0 where the film ends, so that oil is
                 conserved where it ruptures, not where it forms again (H. W. Swift, W. Stieber). A complementarity
                 problem of an M-matrix: its active set is found in finitely many steps (M. Hintermüller, K. Ito,
                 K. Kunisch, SIAM J. Optim. 13 (2003) 865–888).
elrod_adams      p ≥ 0, θ ≤ 1 and p (1 − θ) = 0: θ is the share of the gap that oil fills, and is carried along
                 (B. Jakobsson, L. Floberg, K. O. Olsson; H. G. Elrod, ASME J. Lubr. Technol. 103 (1981) 350–354).
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
from gudgeon.waiting.asking import apart

Flags = NDArray[np.bool_]
STEPS = 1000  # of an active set that only grows, at worst by a cell a step; from a coarser grid it takes a few
TRIES = 100  # of one that may come and go
LONG = 20_000  # unknowns whose factorization Ctrl-C is not to wait for, some .1 s


@dataclass(frozen=True)
class Motion:
    """How the gap moves, rates in 1/s: the effective squeeze velocity over c, and half of ω_s."""

    w_n: float
    w_t: float
    half_speed: float


@dataclass(frozen=True)
class Pressure:
    """All the unknowns (n·rows,): signed with half_sommerfeld. `filled` is θ, `gain` what each cell lets in or out.

    outflow − closing (or with θ: what is carried too) of each cell: 0 where the equation holds.
    """

    unknown: Array
    filled: Array
    gain: Array


def solved(kind: str, equation: Equation, motion: Motion, free: Flags, start: Array | None = None) -> Pressure:
    """free: where p is an unknown, all but the groove. start: unknowns near the solution, of a coarser grid."""
    closing = equation.closing(motion.w_n, motion.w_t)
    if kind == "half_sommerfeld":
        p = _inverse(equation.matrix, closing, free)
        return Pressure(p, np.ones_like(p), equation.matrix @ p - closing)
    carries = (closing > 0.0) if start is None else (start > 0.0)
    if kind == "elrod_adams" and start is not None:
        return _elrod_adams(equation, motion, free, carries & free)
    p, carries = _reynolds(equation.matrix, closing, free, carries & free)
    if kind == "elrod_adams":
        return _elrod_adams(equation, motion, free, carries)
    return Pressure(p, np.ones_like(p), equation.matrix @ p - closing)


def _inverse(matrix: sparse.csr_matrix, right: Array, where: Flags) -> Array:
    """matrix p = right in the rows `where`, p = 0 elsewhere."""
    p = np.zeros(len(right))
    if where.any():
        p[where] = _factor(matrix[where][:, where]).solve(right[where])
    return p


def _factor(matrix: sparse.csr_matrix) -> Any:
    """An M-matrix of a symmetric pattern needs no pivots."""
    options = {"SymmetricMode": True}
    return _split(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)


def _split(matrix: sparse.csr_matrix, **how: Any) -> Any:
    """L U; where the gap all but closes, flows across it are lost beside the others."""
    columns = matrix.tocsc()
    try:
        if columns.shape[0] < LONG:
            return splu(columns, **how)
        return apart(lambda: splu(columns, **how))
    except RuntimeError as error:  # SuperLU's word for a pivot of 0
        told = "reynolds: the gap is too thin for doubles: less eccentricity may do, or other cells"
        raise GudgeonError(told) from error


def _reynolds(matrix: sparse.csr_matrix, closing: Array, free: Flags, carries: Flags) -> tuple[Array, Flags]:
    for _ in range(STEPS):
        p = _inverse(matrix, closing, carries)
        new = np.where(carries, p > 0.0, matrix @ p < closing) & free
        if np.array_equal(new, carries):
            return p, carries
        carries = new
    raise GudgeonError("reynolds: where the film ends is not found: another number of cells may do")


def _elrod_adams(equation: Equation, motion: Motion, free: Flags, full: Flags) -> Pressure:
    """Each free node is full, its p unknown, or cavitated, its θ; the groove is full, p = 0."""
    matrix, carried = equation.matrix, equation.carried(motion.half_speed, motion.w_n)
    if (carried.diagonal() <= 0.0).any():
        raise BadValueError(
            "elrod_adams: the gap closes faster than oil is carried along",
            hint="θ would hang on what was before; cavitation='reynolds' does not know θ",
        )
    found = _carried_film(matrix, carried, free, full) or _carried_film(matrix, carried, free, np.zeros_like(full))
    if found is None:
        raise GudgeonError("elrod_adams: where the film ends is not found: another number of cells may do")
    return found


def _carried_film(matrix: sparse.csr_matrix, carried: sparse.csr_matrix, free: Flags, full: Flags) -> Pressure | None:
    """From the film `full`, or from none: where oil has run out, a film to begin with may come and go for ever."""
    held = np.where(free, 0.0, 1.0)
    for _ in range(TRIES):
        pick = full.astype(float)
        columns = matrix @ sparse.diags(pick) + carried @ sparse.diags(1.0 - pick)
        right = -(carried @ (pick + held))
        unknown = np.zeros(len(right))
        unknown[free] = _split(columns[free][:, free]).solve(right[free])
        p, filled = np.where(full, unknown, 0.0), np.where(full | ~free, 1.0, unknown)
        new = np.where(full, p > 0.0, filled > 1.0) & free
        if np.array_equal(new, full):
            return Pressure(p, filled, matrix @ p + carried @ filled)
        full = new
    return None

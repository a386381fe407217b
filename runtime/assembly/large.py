"""Solve linear systems of large mechanisms with sparse matrices, in short steps between which Ctrl-C is handled.

LAPACK takes seconds for a thousand coordinates, and Python handles no signal during this time. Another thread would not
help: a process cannot end during a call of OpenBLAS.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gudgeon.model.compiled import Array
from gudgeon.waiting.imports import SPARSE, import_modules_in_thread

MIN_SPARSE_COORDINATES = 150  # coordinates from which on sparse solvers are used
DAMPING = 1e-10  # of the sum of squares, as in C's first step (engine/scene/start.c)
N_RANDOM_COLUMNS, N_FILTER_STEPS = 6, 6  # random columns that are filtered, and the number of filter steps
# of the largest singular value: smaller ones are ignored where equations depend on each other
MIN_SINGULAR_RATIO = 1e-6


def solve_minimum_norm(matrix: Array, right_hand_side: Array) -> Array:
    """Return the minimum-norm solution x (n,) of matrix x = right_hand_side, in the least-squares sense.

    It is 0 if a number is not finite. From MIN_SPARSE_COORDINATES columns on, sparse solvers are used, else NumPy's
    lstsq, for which singular values below 1e-12 of the largest are 0.
    """
    if not (np.isfinite(matrix).all() and np.isfinite(right_hand_side).all()):
        return np.zeros(matrix.shape[1])
    if matrix.shape[1] >= MIN_SPARSE_COORDINATES:
        x = solve_full_rank(matrix, right_hand_side)
        return x if x is not None else solve_rank_deficient(matrix, right_hand_side)
    return np.asarray(np.linalg.lstsq(matrix, right_hand_side, rcond=1e-12)[0], dtype=np.float64)


def solve_full_rank(matrix: Array, right_hand_side: Array) -> Array | None:
    """Return the minimum-norm solution x (n,) of matrix x = right_hand_side; None if the rows A are dependent.

    The matrix [I Aᵀ; A 0] is factorized. Rows are dependent if it is singular or x has a residual above 1e-9.
    """
    columns = matrix.shape[1]
    try:
        x = _factorize(matrix, 0.0)(np.concatenate([np.zeros(columns), right_hand_side]))[:columns]
    except RuntimeError:  # exactly singular
        return None
    fits = np.linalg.norm(matrix @ x - right_hand_side) <= 1e-9 * (np.linalg.norm(right_hand_side) + 1e-300)
    return np.asarray(x, dtype=np.float64) if fits else None


def solve_rank_deficient(matrix: Array, right_hand_side: Array) -> Array:
    """Return an approximate minimum-norm least-squares solution x (n,) of matrix x = right_hand_side.

    Rows may depend on each other; used if the direct sparse solution (`solve_full_rank`) fails. Singular values below
    MIN_SINGULAR_RATIO of the largest are damped; four repetitions reduce the effect of the damping on the others.
    """
    columns, x = matrix.shape[1], np.zeros(matrix.shape[1])
    solve = _factorize(matrix, (MIN_SINGULAR_RATIO * _compute_norm_bound(matrix)) ** 2)
    for _ in range(4):  # damping reduces each step by a fraction, less each time
        x = x + solve(np.concatenate([np.zeros(columns), right_hand_side - matrix @ x]))[:columns]
    return x


def solve_damped_least_squares(matrix: Array, right_hand_side: Array) -> Array:
    """Return x (n,) that minimizes |matrix x − right_hand_side|² + ε |x|², with ε = DAMPING times the sum of squares.

    Newton's method for large mechanisms uses it if there are more equations than coordinates.
    """
    rows = len(matrix)
    damping = DAMPING * float((matrix**2).sum()) + 1e-300
    x = _factorize(matrix.T, damping)(np.concatenate([right_hand_side, np.zeros(matrix.shape[1])]))[rows:]
    return np.asarray(x, dtype=np.float64)


def has_independent_rows(matrix: Array, relative_limit: float) -> bool:
    """Return whether all rows are independent, by an estimate of the smallest singular value (inverse iteration).

    It must exceed ten times `relative_limit` times a bound of the largest singular value. Return False too for numbers
    that are not finite, no rows, or more rows than columns.
    """
    if not len(matrix) or len(matrix) > matrix.shape[1] or not np.isfinite(matrix).all():
        return False
    columns = matrix.shape[1]
    x, growth = np.random.default_rng(0).standard_normal(len(matrix)), 0.0
    try:
        solve = _factorize(matrix, 0.0)
        for _ in range(4):
            y = solve(np.concatenate([np.zeros(columns), x]))[columns:]
            growth, x = float(np.linalg.norm(y) / np.linalg.norm(x)), y / np.linalg.norm(y)
    except RuntimeError:
        return False
    return growth * (relative_limit * _compute_norm_bound(matrix)) ** 2 < 1e-2


def estimate_left_null_maxima(matrix: Array, relative_limit: float) -> Array:
    """Return for each row, (m,), an estimate of its magnitude in left null vectors of a large matrix.

    They are left singular vectors of values σ below `relative_limit` (at least 1e-7) times the largest. (ε/(AAᵀ + ε))ᵏ
    filters them from random columns, with ε = σ² at the limit. The result is 0 for numbers that are not finite.
    """
    rows, columns = matrix.shape
    if not rows or not np.isfinite(matrix).all():
        return np.zeros(rows)
    epsilon = (relative_limit * _compute_norm_bound(matrix)) ** 2
    solve = _factorize(matrix, epsilon)
    x = np.random.default_rng(0).standard_normal((rows, N_RANDOM_COLUMNS))
    for _ in range(N_FILTER_STEPS):
        x = -epsilon * solve(np.concatenate([np.zeros((columns, N_RANDOM_COLUMNS)), x]))[columns:]
    return np.asarray(np.abs(x).max(axis=1, initial=0.0), dtype=np.float64)


def compute_rank_by_gram_schmidt(matrix: Array, relative_limit: float) -> int:
    """Return the rank of a matrix by Gram–Schmidt orthogonalization of its rows, the longest remaining row first.

    relative_limit: length of a remaining row, relative to the longest row of the matrix, at which it counts as
    dependent.
    """
    remaining, limit = np.array(matrix), 0.0
    for k in range(min(matrix.shape)):
        size = np.einsum("ij,ij->i", remaining, remaining)
        pivot = int(size.argmax())
        length = float(np.sqrt(size[pivot]))
        limit = limit or relative_limit * length
        if not length > limit:
            return k
        direction = remaining[pivot] / length
        remaining[pivot] = remaining[-1]
        remaining = remaining[:-1]
        remaining -= np.outer(remaining @ direction, direction)
    return min(matrix.shape)


def _factorize(matrix: Array, damping: float) -> Callable[[Array], Array]:
    """Return a function that solves [I Aᵀ; A −damping I] x = b for a matrix A by sparse factorization.

    Raises RuntimeError if the matrix is singular.
    """
    import_modules_in_thread(*SPARSE)
    from scipy import sparse
    from scipy.sparse.linalg import splu

    A = sparse.csc_matrix(matrix)
    corner = -damping * sparse.identity(len(matrix)) if damping else None
    solve: Callable[[Array], Array] = splu(
        sparse.bmat([[sparse.identity(matrix.shape[1]), A.T], [A, corner]], format="csc")
    ).solve
    return solve


def _compute_norm_bound(matrix: Array) -> float:
    """Return an upper bound of the largest singular value of a matrix, close to it if rows have few entries."""
    size = np.abs(matrix)
    return float(np.sqrt(size.sum(axis=0).max() * size.sum(axis=1).max()))

"""Linear algebra of large mechanisms: sparse, for a joint ties two bodies, and in steps between which Ctrl-C is heard.

LAPACK takes seconds for a thousand coordinates (or for a few hundred where other threads keep the cores), and while
it does Python hears of no signal. A thread of its own is no way out: OpenBLAS does not let a process end meanwhile.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gudgeon.model.compiled import Array
from gudgeon.waiting.imports import SPARSE, whole

LARGE = 150  # coordinates from which on this is used
DAMPING = 1e-10  # of the sum of squares: C's first step has the same (engine/scene/start.c)
COLUMNS, SHARPER = 6, 6  # random columns that are filtered, how often
VANISHES = 1e-6  # of the largest singular value: what is below is left alone where rows depend on each other


def smallest(matrix: Array, target: Array) -> Array:
    """The shortest x with matrix x = target, or the nearest to it that there is; 0 where they are not finite."""
    if not (np.isfinite(matrix).all() and np.isfinite(target).all()):
        return np.zeros(matrix.shape[1])
    if matrix.shape[1] >= LARGE:
        x = smallest_step(matrix, target)
        return x if x is not None else dependent_step(matrix, target)
    return np.asarray(np.linalg.lstsq(matrix, target, rcond=1e-12)[0], dtype=np.float64)


def smallest_step(matrix: Array, target: Array) -> Array | None:
    """The shortest x (n,) with matrix x = target by a factorization of [I Aᵀ; A 0]; None where A is rank-deficient."""
    columns = matrix.shape[1]
    try:
        x = _solver(matrix, 0.0)(np.concatenate([np.zeros(columns), target]))[:columns]
    except RuntimeError:  # exactly singular
        return None
    fits = np.linalg.norm(matrix @ x - target) <= 1e-9 * (np.linalg.norm(target) + 1e-300)
    return np.asarray(x, dtype=np.float64) if fits else None


def dependent_step(matrix: Array, target: Array) -> Array:
    """The same where rows depend on each other: what target asks of them beyond what they can give is left."""
    columns, x = matrix.shape[1], np.zeros(matrix.shape[1])
    solve = _solver(matrix, (VANISHES * _norm(matrix)) ** 2)
    for _ in range(4):  # damping takes a share of a step, less each time
        x = x + solve(np.concatenate([np.zeros(columns), target - matrix @ x]))[:columns]
    return x


def nearest_step(matrix: Array, target: Array) -> Array:
    """x (n,) that leaves the least of matrix x − target, damped a little: where Newton begins, no more."""
    rows = len(matrix)
    damping = DAMPING * float((matrix**2).sum()) + 1e-300
    x = _solver(matrix.T, damping)(np.concatenate([target, np.zeros(matrix.shape[1])]))[rows:]
    return np.asarray(x, dtype=np.float64)


def is_independent(matrix: Array, least: float) -> bool:
    """Whether all rows surely are: the smallest singular value is far above this share of the largest one.

    By the inverse's powers on a random column, whose growth is 1/σ² of the smallest σ.
    """
    if not len(matrix) or len(matrix) > matrix.shape[1] or not np.isfinite(matrix).all():
        return False
    columns = matrix.shape[1]
    x, growth = np.random.default_rng(0).standard_normal(len(matrix)), 0.0
    try:
        solve = _solver(matrix, 0.0)
        for _ in range(4):
            y = solve(np.concatenate([np.zeros(columns), x]))[columns:]
            growth, x = float(np.linalg.norm(y) / np.linalg.norm(x)), y / np.linalg.norm(y)
    except RuntimeError:
        return False
    return growth * (least * _norm(matrix)) ** 2 < 1e-2


def tied_shares(matrix: Array, least: float) -> Array:
    """Of each row about its share in combinations of rows that vanish: σ below `least` of the largest; least ≥ 1e-7.

    (ε/(AAᵀ + ε))ᵏ leaves of random columns what is in these combinations, ε = σ² at the limit.
    """
    rows, columns = matrix.shape
    if not rows or not np.isfinite(matrix).all():
        return np.zeros(rows)
    epsilon = (least * _norm(matrix)) ** 2
    solve = _solver(matrix, epsilon)
    x = np.random.default_rng(0).standard_normal((rows, COLUMNS))
    for _ in range(SHARPER):
        x = -epsilon * solve(np.concatenate([np.zeros((columns, COLUMNS)), x]))[columns:]
    return np.asarray(np.abs(x).max(axis=1, initial=0.0), dtype=np.float64)


def rank_by_rows(matrix: Array, least: float) -> int:
    """How many rows are independent, by Gram-Schmidt with pivoting; `least`: of the first, what still counts."""
    left, limit = np.array(matrix), 0.0
    for k in range(min(matrix.shape)):
        size = np.einsum("ij,ij->i", left, left)
        pivot = int(size.argmax())
        length = float(np.sqrt(size[pivot]))
        limit = limit or least * length
        if not length > limit:
            return k
        direction = left[pivot] / length
        left[pivot] = left[-1]
        left = left[:-1]
        left -= np.outer(left @ direction, direction)
    return min(matrix.shape)


def _solver(matrix: Array, damping: float) -> Callable[[Array], Array]:
    """Solves [I Aᵀ; A −ε]; its time grows with the number of joints. RuntimeError where it is exactly singular."""
    whole(*SPARSE)
    from scipy import sparse
    from scipy.sparse.linalg import splu

    A = sparse.csc_matrix(matrix)
    corner = -damping * sparse.identity(len(matrix)) if damping else None
    solve: Callable[[Array], Array] = splu(
        sparse.bmat([[sparse.identity(matrix.shape[1]), A.T], [A, corner]], format="csc")
    ).solve
    return solve


def _norm(matrix: Array) -> float:
    """An upper bound of the largest singular value, near it where rows have few entries."""
    size = np.abs(matrix)
    return float(np.sqrt(size.sum(axis=0).max() * size.sum(axis=1).max()))

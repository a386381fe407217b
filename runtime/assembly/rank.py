"""Rank of a Jacobian, and which of its rows depend on the others."""

from __future__ import annotations

import numpy as np

from gudgeon.assembly.large import LARGE, is_independent, rank_by_rows, tied_shares
from gudgeon.model.compiled import Array

RANK = 1e-9  # singular values below this share of the largest count as zero
DAMPED = 1e-7  # the least limit that a damped factorization can tell


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

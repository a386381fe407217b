"""Rank of a Jacobian, and which of its rows depend on the others."""

from __future__ import annotations

import numpy as np

from gudgeon.compiled import Array

RANK = 1e-9  # singular values below this share of the largest count as zero


def rank(matrix: Array, least: float = RANK) -> int:
    """How many rows are independent."""
    values = np.linalg.svd(matrix, compute_uv=False)
    return int((values > least * values[0]).sum())


def tied(matrix: Array, least: float = RANK) -> Array:
    """Of each row its largest share in a combination of rows that vanishes; 0 for rows that depend on nothing."""
    left, values, _ = np.linalg.svd(matrix)
    vanishing = left[:, int((values > least * values[0]).sum()) :]
    return np.asarray(np.abs(vanishing).max(axis=1, initial=0.0), dtype=np.float64)

"""Load of a journal bearing of finite length against that of a long one: how far the film's law overstates it.

    python -m tests.oracles.finite_bearing

Reynolds' equation ∂(h³ ∂p/∂θ)/∂θ + ∂(h³ ∂p/∂ζ)/∂ζ = ∂h/∂θ with h = 1 + ε cos θ, θ round the bearing, ζ = z/R along it,
p = 0 at both ends ζ = ±L/D, steady. By finite volumes; the film carries where p > 0 of its solution (half film), or
p ≥ 0 is part of the problem, which is solved by its active set (Reynolds' condition).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import spsolve

L_OVER_D = 40.0 / 30.0  # of the press's pins
Array = NDArray[np.float64]


def load(eps: float, l_over_d: float, reynolds: bool, around: int = 360, along: int = 60) -> float:
    """|∬ p (cos θ, sin θ) dθ dζ| over the bearing; an infinite l_over_d: of a slice of length 1, of no ends."""
    long = math.isinf(l_over_d)
    if long:
        along, l_over_d = 1, 0.5
    a, b = 2.0 * math.pi / around, l_over_d / along  # of cells; half the bearing, the other half is its image
    theta = a * (np.arange(around) + 0.5)
    faces = (1.0 + eps * np.cos(a * np.arange(around))) ** 3  # between cells i - 1 and i
    cube = (1.0 + eps * np.cos(theta)) ** 3
    round_ = sparse.diags(-(faces + np.roll(faces, -1))).tolil()
    for i in range(around):
        round_[i, i - 1] += faces[i]
        round_[i - 1, i] += faces[i]
    ends = np.full(along, -2.0)
    ends[0] = -1.0 if along > 1 else 0.0  # the middle, where p is even
    if not long:
        ends[-1] -= 1.0  # p = 0 half a cell further
    side = (
        sparse.diags([np.ones(along - 1), ends, np.ones(along - 1)], (-1, 0, 1))
        if along > 1
        else sparse.csr_matrix((1, 1))
    )
    matrix = sparse.kron(round_ / a**2, sparse.eye(along)) + sparse.kron(sparse.diags(cube), side / b**2)
    right = np.repeat(np.diff(1.0 + eps * np.cos(a * np.arange(around + 1))) / a, along)
    p = _complementary(matrix.tocsr(), right) if reynolds else np.maximum(_solved(matrix.tocsr(), right, long), 0.0)
    total = p.reshape(around, along).sum(axis=1) * a * 2.0 * b
    return float(np.hypot(total @ np.cos(theta), total @ np.sin(theta)))


def _solved(matrix: sparse.csr_matrix, right: Array, long: bool) -> Array:
    """p of the whole film; without ends it is known but for a constant, which Sommerfeld takes 0 where h is most."""
    if not long:
        return np.asarray(spsolve(matrix.tocsc(), right))
    p = np.zeros(len(right))
    p[1:] = spsolve(matrix[1:, 1:].tocsc(), right[1:])
    return np.asarray(p - 0.5 * (p[0] + p[-1]))


def _complementary(matrix: sparse.csr_matrix, right: Array) -> Array:
    """p ≥ 0, r = right − matrix p ≥ 0, p · r = 0."""
    carries = right < 0.0
    for _ in range(200):
        p = np.zeros(len(right))
        p[carries] = spsolve(matrix[carries][:, carries].tocsc(), right[carries])
        rest = right - matrix @ p
        new = np.where(carries, p > 0.0, rest < 0.0)
        if (new == carries).all():
            return p
        carries = new
    raise ArithmeticError("the active set does not settle")


def overstated(eps: float, reynolds: bool, l_over_d: float = L_OVER_D) -> float:
    """The long half film's load over that of the finite bearing."""
    return load(eps, math.inf, False) * 2.0 * l_over_d / load(eps, l_over_d, reynolds)


if __name__ == "__main__":
    for eps in (0.05, 0.2, 0.5, 0.9):
        print(f"ε = {eps}: {overstated(eps, False):.3f} (half film), {overstated(eps, True):.3f} (Reynolds' condition)")

"""Reynolds' equation in finite volumes: what flows out of each cell, for pressures and for oil that is carried along.

    ∂(h³ ∂p/∂φ)/∂φ + ∂(h³ ∂p/∂ζ)/∂ζ = ∂h/∂t,   h = 1 + ε cos φ,   ∂h/∂t = w_n cos φ + w_t sin φ

in a frame that turns with the mean speed of the surfaces, ½(ω_i + ω_j): there the gap only closes, with the effective
squeeze velocity w (docs/physics.md, section 4). Pressures are in units of 12 μ (R/c)², flows of c R², rates in 1/s.
B. J. Hamrock, S. R. Schmid, B. O. Jacobson, Fundamentals of Fluid Film Lubrication, 2nd ed., Marcel Dekker 2004.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import sparse

from gudgeon.reynolds.grid import Array, Grid


@dataclass(frozen=True)
class Equation:
    """The flows of a grid. Unknowns are counted along the bearing first: node (i, j) is i·rows + j.

    An open end's nodes are unknowns too: p = 0 there, and the unknown is what flows out over the end.
    """

    grid: Grid

    @property
    def rows(self) -> int:
        """Unknowns at an angle."""
        return len(self.grid.height)

    @cached_property
    def matrix(self) -> sparse.csr_matrix:
        """Outflow of each cell by the unknowns: an M-matrix, each cell's sum of columns 0 or what leaves the end."""
        grid, n, m = self.grid, len(self.grid.phi), len(self.grid.zeta)
        i = np.arange(n)
        across = (1.0 + grid.eps * np.cos(grid.right)) ** 3 / grid.apart  # between i and i + 1
        around = sparse.coo_matrix(
            (
                np.concatenate([across + np.roll(across, 1), -across, -across]),
                (np.concatenate([i, i, (i + 1) % n]), np.concatenate([i, (i + 1) % n, i])),
            ),
            shape=(n, n),
        )
        inside = np.zeros(self.rows)
        inside[:m] = grid.height[:m]  # at the end p = 0: nothing flows around
        matrix = sparse.kron(around, sparse.diags(inside))
        if not grid.sealed:
            matrix += sparse.kron(sparse.diags(grid.h**3 * (grid.right - grid.left)), self._along())
            matrix += sparse.kron(sparse.eye(n), sparse.diags(np.arange(self.rows) == m, dtype=float))
        return sparse.csr_matrix(matrix)

    def _along(self) -> sparse.csr_matrix:
        m, share = len(self.grid.zeta), 1.0 / self.grid.gaps
        between = np.arange(m)
        flows = sparse.coo_matrix((share, (between, between)), shape=(m + 1, m + 1))
        flows += sparse.coo_matrix((-share, (between + 1, between)), shape=(m + 1, m + 1))
        back, ahead = share[:-1], between[:-1]
        flows += sparse.coo_matrix((back, (ahead + 1, ahead + 1)), shape=(m + 1, m + 1))
        return sparse.csr_matrix(flows + sparse.coo_matrix((-back, (ahead, ahead + 1)), shape=(m + 1, m + 1)))

    def closing(self, w_n: float, w_t: float) -> Array:
        """(n·rows,) −∫ ∂h/∂t over each cell: what it must let go."""
        grid = self.grid
        squeeze = w_n * (np.sin(grid.right) - np.sin(grid.left)) - w_t * (np.cos(grid.right) - np.cos(grid.left))
        return np.asarray(-np.outer(squeeze, grid.height).ravel())

    def carried(self, half_speed: float, w_n: float) -> sparse.csr_matrix:
        """Outflow of each cell by the share θ of the gap that oil fills: carried from where it comes, ½ω_s θ h, and
        what the rate ε̇ = w_n of a gap takes up, θ ∂h/∂t. With θ = 1 everywhere it is −closing."""
        grid, n = self.grid, len(self.grid.phi)
        over = half_speed * (1.0 + grid.eps * np.cos(grid.right))  # through a cell's end, from i to i + 1
        i, nothing = np.arange(n), np.zeros(n)
        ahead, back = (over, nothing) if half_speed > 0.0 else (nothing, over)  # what leaves i by θ_i, by θ_{i+1}
        squeeze = w_n * (np.sin(grid.right) - np.sin(grid.left))
        values = np.concatenate([ahead - np.roll(back, 1) + squeeze, back, -np.roll(ahead, 1)])
        places = (np.concatenate([i, i, i]), np.concatenate([i, (i + 1) % n, (i - 1) % n]))
        return sparse.csr_matrix(
            sparse.kron(sparse.coo_matrix((values, places), shape=(n, n)), sparse.diags(grid.height))
        )

"""Discretize Reynolds' equation by finite volumes: the outflow of each cell by pressure and by convection.

    ∂(h³ ∂p/∂φ)/∂φ + ∂(h³ ∂p/∂ζ)/∂ζ = ∂h/∂t,   h = 1 + ε cos φ,   ∂h/∂t = w_n cos φ + w_t sin φ

in a frame that turns with the mean speed of the surfaces, ½(ω_i + ω_j): there the gap only closes, with the effective
squeeze velocity w (docs/physics.md, section 4). Pressures are in units of 12 μ (R/c)², flows of c R², rates in 1/s.
B. J. Hamrock, S. R. Schmid, B. O. Jacobson, Fundamentals of Fluid Film Lubrication, 2nd ed., Marcel Dekker 2004.

The nodes of a `Grid` are close together where the film is thin, and towards the ends of the bearing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.optimize import brentq

Array = NDArray[np.float64]
FULL_TURN = 2.0 * math.pi
UNIFORM_FRACTION = 0.5  # weight of φ in the variable of equidistant nodes; the rest is Sommerfeld's angle


@dataclass(frozen=True)
class Equation:
    """The flows of a grid. Unknowns are counted along the bearing first: node (i, j) is i·n_rows + j.

    The nodes of an open end are unknowns too: there p = 0, and the unknown is the outflow over the end.
    """

    grid: Grid

    @property
    def n_rows(self) -> int:
        """Return the number of unknowns at one angle: nodes along the half bearing and, for an open end, its
        outflow.
        """
        return len(self.grid.height)

    @cached_property
    def pressure_flow_matrix(self) -> sparse.csr_matrix:
        """Return the matrix (n·n_rows, n·n_rows) of the outflow of each cell by pressures (Poiseuille flow).

        The flow by convection (Couette flow) is that of `build_convection_matrix`.
        It is an M-matrix; each column sums to 0, or to the outflow over the end.
        """
        grid, n, m = self.grid, len(self.grid.phi), len(self.grid.zeta)
        i = np.arange(n)
        conductances = (1.0 + grid.eps * np.cos(grid.right)) ** 3 / grid.node_spacing  # between i and i + 1
        around = sparse.coo_matrix(
            (
                np.concatenate([conductances + np.roll(conductances, 1), -conductances, -conductances]),
                (np.concatenate([i, i, (i + 1) % n]), np.concatenate([i, (i + 1) % n, i])),
            ),
            shape=(n, n),
        )
        heights = np.zeros(self.n_rows)
        heights[:m] = grid.height[:m]  # at the end p = 0: nothing flows around
        matrix = sparse.kron(around, sparse.diags(heights))
        if not grid.sealed:
            matrix += sparse.kron(sparse.diags(grid.h**3 * (grid.right - grid.left)), self._build_axial_matrix())
            matrix += sparse.kron(sparse.eye(n), sparse.diags(np.arange(self.n_rows) == m, dtype=float))
        return sparse.csr_matrix(matrix)

    def _build_axial_matrix(self) -> sparse.csr_matrix:
        """Return the axial part of the matrix at one angle, (m + 1, m + 1), without the factor h³ Δφ."""
        m, conductances = len(self.grid.zeta), 1.0 / self.grid.gaps
        nodes = np.arange(m)
        flows = sparse.coo_matrix((conductances, (nodes, nodes)), shape=(m + 1, m + 1))
        flows += sparse.coo_matrix((-conductances, (nodes + 1, nodes)), shape=(m + 1, m + 1))
        inner_conductances, inner_nodes = conductances[:-1], nodes[:-1]
        flows += sparse.coo_matrix((inner_conductances, (inner_nodes + 1, inner_nodes + 1)), shape=(m + 1, m + 1))
        return sparse.csr_matrix(
            flows + sparse.coo_matrix((-inner_conductances, (inner_nodes, inner_nodes + 1)), shape=(m + 1, m + 1))
        )

    def compute_squeeze_flow(self, w_n: float, w_t: float) -> Array:
        """Return −∫ ∂h/∂t over each cell, (n·n_rows,): the flow that the closing gap displaces.

        w_n, w_t: effective squeeze velocities over c along and across the line of centres, 1/s.
        """
        grid = self.grid
        squeeze = w_n * (np.sin(grid.right) - np.sin(grid.left)) - w_t * (np.cos(grid.right) - np.cos(grid.left))
        return np.asarray(-np.outer(squeeze, grid.height).ravel())

    def build_convection_matrix(self, half_speed: float, w_n: float) -> sparse.csr_matrix:
        """Return the matrix of outflows by the filled fraction θ of each cell.

        Oil is convected from upstream, ½ω_s θ h, and stored by the rate ε̇ = w_n of the gap, θ ∂h/∂t. With θ = 1
        everywhere the outflow is minus the squeeze flow. half_speed: ½ω_s, 1/s.
        """
        grid, n = self.grid, len(self.grid.phi)
        flow = half_speed * (1.0 + grid.eps * np.cos(grid.right))  # through a cell's end, from i to i + 1
        i, zeros = np.arange(n), np.zeros(n)
        forward, backward = (flow, zeros) if half_speed > 0.0 else (zeros, flow)  # outflow of i by θ_i, by θ_{i+1}
        squeeze = w_n * (np.sin(grid.right) - np.sin(grid.left))
        values = np.concatenate([forward - np.roll(backward, 1) + squeeze, backward, -np.roll(forward, 1)])
        indices = (np.concatenate([i, i, i]), np.concatenate([i, (i + 1) % n, (i - 1) % n]))
        return sparse.csr_matrix(
            sparse.kron(sparse.coo_matrix((values, indices), shape=(n, n)), sparse.diags(grid.height))
        )


@dataclass(frozen=True)
class Grid:
    """Nodes and the cells around them. φ counts from the widest gap, ζ = z/R from the middle to an end.

    A sealed bearing has no axial variation: it has one node along, in a cell as long as the half.
    """

    eps: float
    phi: Array  # (n,) nodes
    right: Array  # (n,) a cell's end towards larger φ
    left: Array  # (n,) and towards smaller
    node_spacing: Array  # (n,) from a node to the next
    weight: Array  # (n,) of the trapezoidal rule in the variable in which nodes are equidistant
    zeta: Array  # (m,) nodes, without that at the end, where p = 0
    height: Array  # (m,) lengths of cells; for an open end with the remaining length (m + 1,)
    gaps: Array  # (m,) from a node to the next, the last to the end; (0,) if sealed
    weight_along: Array  # (m,) Simpson's, of the half

    @property
    def sealed(self) -> bool:
        """Return whether the bearing is sealed at its ends; it then has no axial gaps."""
        return not len(self.gaps)

    @property
    def h(self) -> Array:
        """Return the film thickness over c at the nodes (n,)."""
        return np.asarray(1.0 + self.eps * np.cos(self.phi))


def make_grid(eps: float, l_over_d: float, n_around: int, n_along: int, first_angle: float = 0.0) -> Grid:
    """Return a grid with a node at φ = `first_angle` (rad), dense where the film is thin and towards open ends.

    eps: eccentricity ratio. n_around: number of cells around. n_along: cells from the middle to an end, 0 for a sealed
    bearing.
    """
    uniform_spacing = FULL_TURN / n_around
    first_uniform_angle = float(_compute_grid_coordinate(np.array([first_angle]), eps)[0])
    half_nodes = _invert_grid_coordinate(
        first_uniform_angle + 0.5 * uniform_spacing * np.arange(2 * n_around, dtype=float), eps
    )
    phi, right = half_nodes[::2], half_nodes[1::2]
    left = np.concatenate([[right[-1] - FULL_TURN], right[:-1]])
    node_spacing = np.concatenate([phi[1:], [phi[0] + FULL_TURN]]) - phi
    angle_weights = uniform_spacing / _compute_node_density(phi, eps)
    if not n_along:
        half_length = np.array([l_over_d])
        return Grid(
            eps, phi, right, left, node_spacing, angle_weights, np.zeros(1), half_length, np.zeros(0), half_length
        )
    end_slope_ratio = min(1.0, math.sqrt(1.0 - eps * eps) / l_over_d)  # axial and circumferential gradients are similar
    zeta, slope = _place_axial_nodes(np.linspace(0.0, 1.0, 2 * n_along + 1), l_over_d, end_slope_ratio)
    height = np.diff(np.concatenate([[0.0], zeta[1::2], [l_over_d]]))
    simpson = np.where(np.arange(n_along) % 2, 4.0, 2.0) / (3.0 * n_along)
    simpson[0] *= 0.5
    nodes = zeta[::2]
    return Grid(
        eps, phi, right, left, node_spacing, angle_weights, nodes[:-1], height, np.diff(nodes), simpson * slope[:-1:2]
    )


def _compute_node_density(phi: Array, eps: float) -> Array:
    """Return the relative density of the nodes, the derivative of `_compute_grid_coordinate` with respect to φ."""
    return np.asarray(
        UNIFORM_FRACTION + (1.0 - UNIFORM_FRACTION) * math.sqrt(1.0 - eps * eps) / (1.0 + eps * np.cos(phi))
    )


def _compute_grid_coordinate(phi: Array, eps: float) -> Array:
    """Return the stretched grid coordinate, in which the nodes are equidistant, for angles φ at eccentricity ratio ε.

    It is the mean of φ and of Sommerfeld's angle γ: (1 + ε cos φ)(1 − ε cos γ) = 1 − ε², dγ = √(1 − ε²)/h dφ.
    """
    turns = np.floor((phi + math.pi) / FULL_TURN)
    half = 0.5 * (phi - FULL_TURN * turns)
    gamma = (
        2.0 * np.arctan2(math.sqrt(1.0 - eps) * np.sin(half), math.sqrt(1.0 + eps) * np.cos(half)) + FULL_TURN * turns
    )
    return np.asarray(UNIFORM_FRACTION * phi + (1.0 - UNIFORM_FRACTION) * gamma)


def _invert_grid_coordinate(values: Array, eps: float) -> Array:
    """Return the angles φ at which the grid coordinate (`_compute_grid_coordinate`) has these values.

    Safeguarded Newton's method: the bracket is bisected if a step leaves it or is more than half of the last one. Both
    variables differ by at most π. For ε → 1 the slope nearly jumps, so that Newton's method alone may cycle.
    """
    low, high, phi, last_step = values - math.pi, values + math.pi, values.copy(), np.full_like(values, FULL_TURN)
    for _ in range(200):
        residual = _compute_grid_coordinate(phi, eps) - values
        low, high = np.where(residual < 0.0, phi, low), np.where(residual > 0.0, phi, high)
        step = -residual / _compute_node_density(phi, eps)
        must_bisect = (phi + step <= low) | (phi + step >= high) | (abs(step) > 0.5 * abs(last_step))
        last_step = np.where(must_bisect & (residual != 0.0), 0.5 * (low + high) - phi, step)
        phi = phi + last_step
        if float(np.max(abs(last_step))) <= 1e-14 * float(np.max(abs(values), initial=1.0)):
            break
    return phi


def _place_axial_nodes(fraction: Array, length: float, end_slope_ratio: float) -> tuple[Array, Array]:
    """Return ζ from 0 to `length`, dense towards the end, and its slope dζ/ds, for fractions s (n,) from 0 to 1.

    The distribution is ζ = length (1 − sinh(b (1 − s))/sinh b).

    end_slope_ratio: slope at the end over that of equidistant nodes; above 0.98 the nodes are equidistant.
    """
    if end_slope_ratio > 0.98:
        return length * fraction, np.full_like(fraction, length)
    b = brentq(lambda b: b / math.sinh(b) - end_slope_ratio, 1e-3, 700.0)
    return (
        np.asarray(length * (1.0 - np.sinh(b * (1.0 - fraction)) / math.sinh(b))),
        np.asarray(length * b * np.cosh(b * (1.0 - fraction)) / math.sinh(b)),
    )

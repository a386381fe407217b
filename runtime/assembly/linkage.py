"""Define the numerical interface of a linkage for its assembly, and project states onto the constraints."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.large import solve_minimum_norm
from gudgeon.contract.kernel_source import KernelSource, PointInfo
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.sizes import compute_norm_weights, compute_size

N_NEWTON_STEPS = 3  # Newton's passes of a projection: the second one reaches rounding already
PROJECTION_TOL = 1e-15  # m or rad: Φ that no further pass reduces


class Linkage(Protocol):
    """Provide Φ with all joints without play (e = 0): m equations, n coordinates, p as from `prepare`."""

    source: KernelSource
    n: int

    def closed_phi(self, t: float, q: Array, p: Array) -> Array:
        """Return the residuals Φ(q, t) of the constraint equations with every joint closed, (m,), in m and rad."""

    def closed_phi_q(self, t: float, q: Array, p: Array) -> Array:
        """Return the constraint Jacobian ∂Φ/∂q with every joint closed, (m, n)."""

    def closed_nu(self, t: float, q: Array, p: Array) -> Array:
        """Return the right-hand side ν = −Φ_t of the velocity equations Φ_q v = ν, (m,)."""

    def mass(self, p: Array) -> Array:
        """Return the diagonal of the mass matrix M, (n,)."""

    def start_values(self, p: Array) -> tuple[Array, Array, Array]:
        """Return the values of the file's start: guess, set coordinates, and rates.

        The last two end with e and ė of the joints in `start_apart`.
        """


def compute_mechanism_size(linkage: Linkage, p: Array) -> float:
    """Return the size (m) of the mechanism with parameter values p, by which lengths are scaled."""
    return compute_size(linkage.source, p)


def find_angles(source: KernelSource) -> NDArray[np.bool_]:
    """Return a mask (n,) of the coordinates that are angles."""
    return np.array([name.endswith(".theta") for name in source.coordinates], dtype=bool)


def normalize_jacobian_rows(linkage: Linkage, p: Array, matrix: Array) -> Array:
    """Return rows (m, n) of the constraint Jacobian without units, each of length 1.

    matrix: rows of Φ_q. Angles count as arcs at the mechanism's size.
    """
    matrix = matrix / np.where(find_angles(linkage.source), compute_mechanism_size(linkage, p), 1.0)
    return np.asarray(matrix / (np.linalg.norm(matrix, axis=1, keepdims=True) + 1e-300))


def find_point_in_body(p: Array, point: PointInfo) -> Array:
    """Return the coordinates (2,) in m of a point in its body's frame (centre of mass), or in ground axes."""
    pairs = ((point.x, point.sign_x), (point.y, point.sign_y))
    return np.array([sign * float(p[k]) if k >= 0 else 0.0 for k, sign in pairs])


def compute_point_position(source: KernelSource, p: Array, q: Array, point: PointInfo) -> Array:
    """Return the position (2,) in m of a point in ground axes at the configuration q."""
    arm = find_point_in_body(p, point)
    if point.body < 0:
        return arm
    i = source.bodies[point.body].index
    c, s = np.cos(q[i + 2]), np.sin(q[i + 2])
    return np.array([q[i] + c * arm[0] - s * arm[1], q[i + 1] + s * arm[0] + c * arm[1]])


def project_state(compiled: CompiledModel, t: float, q: Array, v: Array, p: Array) -> tuple[Array, Array]:
    """Return q and v (n,) projected onto the constraints at time t by the smallest changes in the norm of M.

    q is changed by at most N_NEWTON_STEPS Newton steps, v once. The result is not tested. Dependent equations, as for
    links in line, are satisfied in the least-squares sense. Values that are not finite are returned unchanged.
    """
    root = np.sqrt(compute_norm_weights(compiled.source, p, compiled.mass(p)))
    for _ in range(N_NEWTON_STEPS):
        phi = compiled.phi(t, q, p)
        phi_q = compiled.phi_q(t, q, p)
        if not len(phi) or not (np.isfinite(phi).all() and np.isfinite(phi_q).all() and np.isfinite(v).all()):
            return q, v
        q = q - solve_minimum_norm(phi_q / root, phi) / root
        if np.abs(phi).max() < PROJECTION_TOL:
            break
    phi_q = compiled.phi_q(t, q, p)
    return q, v - solve_minimum_norm(phi_q / root, phi_q @ v - compiled.nu(t, q, p)) / root


def compute_residuals(compiled: CompiledModel, t: float, q: Array, v: Array, p: Array) -> tuple[float, float]:
    """Return max |Φ| and max |Φ̇| at a state; 0 without constraints."""
    phi_dot = compiled.phi_q(t, q, p) @ v - compiled.nu(t, q, p)
    return float(np.abs(compiled.phi(t, q, p)).max(initial=0.0)), float(np.abs(phi_dot).max(initial=0.0))

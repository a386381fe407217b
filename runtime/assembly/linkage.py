"""The linkage of a scene in numbers: what assembling asks of compiled functions, and the nearest state that fits."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.large import smallest
from gudgeon.contract.kernel_source import KernelSource, PointInfo
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.sizes import mechanism_sizes, metric

PASSES = 3  # Newton: the second one is at rounding already, from anywhere that an integrator leads to
CLOSED = 1e-15  # m or rad: Φ that no further pass makes smaller


class Linkage(Protocol):
    """Φ of the closed linkage: joints with play closed, all m rows; n coordinates, p as `prepare` gives it."""

    source: KernelSource
    n: int

    def closed_phi(self, t: float, q: Array, p: Array) -> Array:
        """Φ(q, t), (m,), m and rad."""

    def closed_phi_q(self, t: float, q: Array, p: Array) -> Array:
        """∂Φ/∂q, (m, n)."""

    def closed_nu(self, t: float, q: Array, p: Array) -> Array:
        """ν = −Φ_t, (m,): Φ_q v = ν."""

    def mass(self, p: Array) -> Array:
        """The diagonal of M, (n,)."""

    def start_values(self, p: Array) -> tuple[Array, Array, Array]:
        """What the file's start guesses, sets, and gives as rates; behind the last two e and ė of `start_apart`."""


def mechanism_size(linkage: Linkage, p: Array) -> float:
    """Return the size of the mechanism as `mechanism_sizes` has it, m."""
    return float(mechanism_sizes(linkage.source, p))


def angles(source: KernelSource) -> NDArray[np.bool_]:
    """Which coordinates are angles, (n,)."""
    return np.array([name.endswith(".theta") for name in source.coordinates], dtype=bool)


def scaled_rows(linkage: Linkage, p: Array, matrix: Array) -> Array:
    """Return rows of Φ_q without units, (m, n): angles count as arcs at the mechanism's size, each row has length 1."""
    matrix = matrix / np.where(angles(linkage.source), mechanism_size(linkage, p), 1.0)
    return np.asarray(matrix / (np.linalg.norm(matrix, axis=1, keepdims=True) + 1e-300))


def arm_of(p: Array, point: PointInfo) -> Array:
    """A point in its body's frame of the centre of mass, or in ground axes, (2,), m."""
    pairs = ((point.x, point.sign_x), (point.y, point.sign_y))
    return np.array([sign * float(p[k]) if k >= 0 else 0.0 for k, sign in pairs])


def place_of(source: KernelSource, p: Array, q: Array, point: PointInfo) -> Array:
    """Where a point is, in ground axes, (2,), m."""
    arm = arm_of(p, point)
    if point.body < 0:
        return arm
    i = source.bodies[point.body].index
    c, s = np.cos(q[i + 2]), np.sin(q[i + 2])
    return np.array([q[i] + c * arm[0] - s * arm[1], q[i + 1] + s * arm[0] + c * arm[1]])


def project(compiled: CompiledModel, t: float, q: Array, v: Array, p: Array) -> tuple[Array, Array]:
    """q and v (n,) moved onto the constraints by the smallest changes in the metric of M.

    Where links are in line the rows depend on each other; the smallest solution of what is left is taken. What
    is not finite is handed back as it is.
    """
    root = np.sqrt(metric(compiled.source, p, compiled.mass(p)))
    for _ in range(PASSES):
        phi = compiled.phi(t, q, p)
        phi_q = compiled.phi_q(t, q, p)
        if not len(phi) or not (np.isfinite(phi).all() and np.isfinite(phi_q).all() and np.isfinite(v).all()):
            return q, v
        q = q - smallest(phi_q / root, phi) / root
        if np.abs(phi).max() < CLOSED:
            break
    phi_q = compiled.phi_q(t, q, p)
    return q, v - smallest(phi_q / root, phi_q @ v - compiled.nu(t, q, p)) / root


def residuals(compiled: CompiledModel, t: float, q: Array, v: Array, p: Array) -> tuple[float, float]:
    """max |Φ| and max |Φ̇|, 0 without constraints."""
    phi_dot = compiled.phi_q(t, q, p) @ v - compiled.nu(t, q, p)
    return float(np.abs(compiled.phi(t, q, p)).max(initial=0.0)), float(np.abs(phi_dot).max(initial=0.0))

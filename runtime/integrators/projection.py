"""The nearest state on Φ = 0 and Φ̇ = 0, distances measured by M: what the Python drivers use."""

from __future__ import annotations

import numpy as np

from gudgeon.assembly.large import smallest
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.sizes import metric

PASSES = 3  # Newton: the second one is at rounding already, from anywhere that an integrator leads to
CLOSED = 1e-15  # m or rad: Φ that no further pass makes smaller


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

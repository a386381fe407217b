"""The half film of a bearing of finite length without any grid along it: Fourier round it, exact along it.

p_ζζ − A p = f/h³ with A p = −h⁻³ (h³ p')' and f = w_n cos φ + w_t sin φ; in the eigenvectors of A each part is
−(g/λ) (1 − cosh(√λ ζ)/cosh(√λ Z)) with p = 0 at ζ = ±Z, Z = L/D. φ from the widest gap, p in units of 12 μ (R/c)².
"""

from __future__ import annotations

import numpy as np


def half_film(
    eps: float, w_n: float, w_t: float, l_over_d: float, modes: int = 128, places: int = 24, dense: int = 8192
) -> tuple[float, float]:
    """(F_r, F_t) over μ R³ L/c² of p > 0, with w over c in 1/s."""
    phi = 2.0 * np.pi * np.arange(modes) / modes
    h = 1.0 + eps * np.cos(phi)
    wave = np.fft.fftfreq(modes, 1.0 / modes)
    wave[modes // 2] = 0.0
    d = np.real(np.fft.ifft(1j * wave[:, None] * np.fft.fft(np.eye(modes), axis=0), axis=0))
    half = h**-1.5
    symmetric = half[:, None] * (d.T @ (h[:, None] ** 3 * d)) * half  # h^1.5 A h^-1.5
    size, vectors = np.linalg.eigh(symmetric)
    size = np.maximum(size, 1e-12)
    part = vectors.T @ (h**-1.5 * (w_n * np.cos(phi) + w_t * np.sin(phi)))
    nodes, weights = np.polynomial.legendre.leggauss(places)
    zeta, root = 0.5 * l_over_d * (nodes + 1.0), np.sqrt(size)[:, None]
    fade = np.exp(root * (zeta - l_over_d)) + np.exp(-root * (zeta + l_over_d))
    fade /= 1.0 + np.exp(-2.0 * root * l_over_d)
    p = half[:, None] * (vectors @ (-(part / size)[:, None] * (1.0 - fade)))
    spectrum = np.fft.rfft(p, axis=0)
    carried = np.maximum(np.fft.irfft(spectrum, dense, axis=0) * (dense / modes), 0.0)
    fine = 2.0 * np.pi * np.arange(dense) / dense
    load = carried @ (weights * l_over_d) * (2.0 * np.pi / dense)  # both halves
    factor = 12.0 / (2.0 * l_over_d)
    return factor * float(load @ np.cos(fine)), factor * float(load @ np.sin(fine))

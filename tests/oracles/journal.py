"""A journal in its bearing as one wrench: what a joint with play does to its two bodies.

Built from film.py and dry.py alone. e = r_journal − r_bearing, t = n turned +90°; force on the journal in ground axes.
Dry: both bodies take the force in the middle of the penetration. Film: its resultant goes through the journal's
centre on both bodies; with `shear` each body takes it at its own centre, with the torques that go with that.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from . import dry, film
from .numpy_linkage import Wrench


@dataclass(frozen=True)
class Journal:
    """Numbers of one joint with play, SI; `stored` is δ̇⁻ (0: none), `viscosity` 0 means no film."""

    radius: float = 0.015
    clearance: float = 0.3e-3
    width: float = 0.04
    young: float = 70e9
    poisson: float = 0.3
    restitution: float = 0.9
    exponent: float = 1.5
    sign: int = 1
    mu: float = 0.15
    v0: float = 1e-4
    v1: float = 1e-3
    viscosity: float = 0.0
    transition: float = 5e-6
    shear: bool = False
    as_printed: bool = False
    stored: float = 0.0

    def __call__(self, e: np.ndarray, rate: np.ndarray, omega_i: float, omega_j: float) -> Wrench:
        """The wrench at e, ė and the two bodies' angular velocities."""
        size = float(np.hypot(*e))
        n = np.asarray(e) / size
        t = np.array([-n[1], n[0]])
        v_n, v_t = float(rate @ n), float(rate @ t)
        share = 1.0 if not self.viscosity else float(np.clip((size - self.clearance) / self.transition, 0.0, 1.0))
        force, first, second = np.zeros(2), 0.0, 0.0
        parts = ((share, self._dry), (1.0 - share, self._film))
        for weight, law in parts:
            if weight > 0.0:
                normal, tangential, m_i, m_j = law(size, v_n, v_t, omega_i, omega_j)
                force = force + weight * (normal * n + tangential * t)
                first, second = first + weight * m_i, second + weight * m_j
        return Wrench(force, first, second)

    def _dry(self, e: float, v_n: float, v_t: float, omega_i: float, omega_j: float) -> tuple[float, ...]:
        delta = e - self.clearance
        if delta <= 0.0:
            return 0.0, 0.0, 0.0, 0.0
        stiff = dry.stiffness(
            self.radius, self.radius - self.clearance, (self.young,) * 2, (self.poisson,) * 2, self.sign
        )
        factor = dry.dissipation_factor(self.restitution)
        normal = dry.normal_force(delta, v_n, self.stored, stiff, self.exponent, factor)
        arm_i, arm_j = self.radius + delta / 2.0, self.radius - self.clearance - delta / 2.0
        tangential = dry.friction_force(v_t + omega_j * arm_j - omega_i * arm_i, normal, self.mu, self.v0, self.v1)
        return -normal, tangential, -arm_i * tangential, arm_j * tangential

    def _film(self, e: float, v_n: float, v_t: float, omega_i: float, omega_j: float) -> tuple[float, ...]:
        c, eps = self.clearance, min(e / self.clearance, 0.9999)
        journal = self.radius - c
        unit = self.viscosity * journal**3 * self.width / c**2
        omega_s = omega_i + omega_j - 2.0 * v_t / e
        radial, tangential = film.pinkus_sternlicht(eps, v_n / c, omega_s, as_printed=self.as_printed)
        radial, tangential = unit * radial, unit * tangential
        if not self.shear:
            return radial, tangential, -e * tangential, 0.0
        torque = 2.0 * math.pi * unit * c * (omega_j - omega_i) / math.sqrt(1.0 - eps * eps)
        return radial, tangential, torque - e * tangential / 2.0, -torque - e * tangential / 2.0

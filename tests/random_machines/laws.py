"""Force laws of joints with play by their published formulas (shared by nothing of the product).

Sources: docs/laws.md lists them; the film is Pinkus and Sternlicht's in the form without branches. SI.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from tests.oracles.numpy_linkage import Wrench

DISSIPATION: Mapping[str, Callable[[float], float]] = {
    "none": lambda c: 0.0,
    "hunt_crossley": lambda c: 1.5 * (1.0 - c),
    "herbert_mcwhannell": lambda c: 6.0 * (1.0 - c) / ((2.0 * c - 1.0) ** 2 + 3.0),
    "lee_wang": lambda c: 0.75 * (1.0 - c),
    "lankarani_nikravesh": lambda c: 0.75 * (1.0 - c * c),
    "gonthier": lambda c: (1.0 - c * c) / c,
    "zhiying_qishao": lambda c: 0.75 * (1.0 - c * c) * math.exp(2.0 - 2.0 * c),
    "flores": lambda c: 1.6 * (1.0 - c) / c,
    "hu_guo": lambda c: 1.5 * (1.0 - c) / c,
}
SHARES: Mapping[str, Callable[[Mapping[str, float], float], float]] = {  # of the normal force, against the slip v
    "coulomb": lambda k, v: k["mu"] * math.tanh(v / k["v0"]),
    "modified_coulomb": lambda k, v: (
        k["mu"] * math.copysign(min(max((abs(v) - k["v0"]) / (k["v1"] - k["v0"]), 0.0), 1.0), v)
    ),
    "threlfall": lambda k, v: k["mu"] * math.copysign(1.0 - math.exp(-3.0 * min(abs(v) / k["v_r"], 1.0)), v),
    "stribeck": lambda k, v: (
        (k["mu"] + (k["mu_s"] - k["mu"]) * math.exp(-((v / k["v_s"]) ** 2))) * math.tanh(v / k["v0"])
    ),
    "brown_mcphee": lambda k, v: (
        k["mu"] * math.tanh(4.0 * v / k["v0"])
        + (k["mu_s"] - k["mu"]) * (v / k["v0"]) / ((v / k["v0"]) ** 2 / 4.0 + 0.75) ** 2
    ),
}


@dataclass
class Pin:
    """A pin in a hole: its law as a Wrench of e, ė and both angular velocities. `stored`: δ̇⁻, 0: free."""

    radius: float
    clearance: float
    length: float
    young: float
    poisson: float
    normal: Mapping[str, Any]
    friction: Mapping[str, Any]
    viscosity: float = 0.0
    transition: float = 0.0
    stored: float = 0.0

    def stiffness(self) -> float:
        """K of Hertz's F = K δⁿ, two bodies of one material."""
        if "stiffness" in self.normal:
            return float(self.normal["stiffness"])
        sign = -1.0 if self.normal.get("geometry") == "internal" else 1.0
        r, j = self.radius, self.radius - self.clearance
        return 2.0 * self.young / (3.0 * (1.0 - self.poisson**2)) * math.sqrt(r * j / (r + sign * j))

    def pressed(self, delta: float, rate: float) -> float:
        """The normal force at a penetration δ > 0."""
        law, ratio = self.normal["law"], rate / self.stored if self.stored > 0.0 else 1.0
        if law == "kelvin_voigt":
            return max(0.0, float(self.normal["stiffness"] * delta + self.normal["damping"] * rate))
        if law == "liu":
            gap = self.clearance + delta
            modulus = self.young / (2.0 * (1.0 - self.poisson**2))
            elastic = 0.5 * math.pi * self.length * modulus * delta * math.sqrt(delta / (2.0 * gap))
        else:
            elastic = self.stiffness() * delta ** float(self.normal.get("exponent", 1.5))
        named = law if law in DISSIPATION else self.normal.get("dissipation", "hunt_crossley")
        factor = DISSIPATION[named](float(self.normal.get("restitution", 1.0)))
        return elastic * max(0.0, 1.0 + factor * ratio)

    def __call__(self, e: np.ndarray, rate: np.ndarray, omega_i: float, omega_j: float) -> Wrench:
        size = float(np.hypot(*e))
        if size == 0.0:
            unit = math.pi * 6.0 * self.viscosity * (self.radius - self.clearance) ** 3 * self.length
            return Wrench(-unit / self.clearance**3 * rate, 0.0, 0.0)
        n = e / size
        t = np.array([-n[1], n[0]])
        v_n, v_t, delta = float(rate @ n), float(rate @ t), size - self.clearance
        dry = 1.0 if not self.viscosity else min(max(delta / self.transition, 0.0), 1.0)
        force, first, second = np.zeros(2), 0.0, 0.0
        if dry > 0.0 and delta > 0.0:
            normal = dry * self.pressed(delta, v_n)
            arm_i, arm_j = self.radius + delta / 2.0, self.radius - self.clearance - delta / 2.0
            slip = v_t + omega_j * arm_j - omega_i * arm_i
            along = -normal * SHARES[self.friction["law"]](self.friction, slip) if self.friction else 0.0
            force, first, second = along * t - normal * n, -arm_i * along, arm_j * along
        if self.viscosity and dry < 1.0:
            radial, along = self.film(size, v_n, v_t, omega_i, omega_j)
            force = force + (1.0 - dry) * (radial * n + along * t)
            first -= (1.0 - dry) * size * along
        return Wrench(force, first, second)

    def film(self, size: float, v_n: float, v_t: float, omega_i: float, omega_j: float) -> tuple[float, float]:
        """F_r = -(S/s³)[4εsW/(2+ε²) + π w_n f], F_t = -2π S w_t f/((2+ε²)s); w = ė - ½(ω_i+ω_j) ẑ×e, by c."""
        c = self.clearance
        eps = min(size / c, 0.9999)
        w_n, w_t = v_n / c, (v_t - 0.5 * (omega_i + omega_j) * size) / c
        total, s = math.hypot(w_n, w_t), math.sqrt(1.0 - eps * eps)
        if total == 0.0:
            return 0.0, 0.0
        f = 1.0 + 1.5 * eps * w_n / (s * total + 1.5 * eps * abs(w_n))
        unit = 6.0 * self.viscosity * (self.radius - c) ** 3 * self.length / c**2
        radial = -unit / s**3 * (4.0 * eps * s * total / (2.0 + eps * eps) + math.pi * w_n * f)
        return radial, -2.0 * math.pi * unit * w_t * f / ((2.0 + eps * eps) * s)

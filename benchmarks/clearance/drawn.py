"""Implement the equations of published programs that draw their results without printing numbers.

Each is a function y' = f(t, y) with y = positions, then velocities; numbers are those codes' own, in kg, m, s but for
the rotor in its stator (kg, mm, ms). Where they were read is in README.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

Rates = Callable[[float, np.ndarray], np.ndarray]
WEIGHT = 9.81  # m/s²
NEVER_ZERO = 1e-10  # Nowald adds it to ε, and begins with it


@dataclass(frozen=True)
class Film:
    """Nowald's short bearing, after van de Vrande: width, diameter, gap (m), viscosity (Pa s)."""

    width: float
    diameter: float
    gap: float
    viscosity: float

    def force(self, e: np.ndarray, rate: np.ndarray, turning: float) -> np.ndarray:
        """Return the force on the journal in N; turning: sum of the speeds of both surfaces, rad/s.

        In a frame that rotates with half of that sum, the journal is squeezed with w at the angle α from its
        eccentricity. The integrals over the pressed half are closed forms in ε and α. Their names contain the powers of
        sin γ and cos γ over (1 + ε cos γ)³.
        """
        d, v = e / self.gap, rate / self.gap
        eps = float(np.hypot(*d)) + NEVER_ZERO
        radial = float(d @ v) / eps
        across = 0.5 * turning * eps - float(d[0] * v[1] - d[1] * v[0]) / eps
        speed = math.hypot(radial, across)
        if not speed:
            return np.zeros(2)
        c, s = radial / speed, across / speed
        open_, below = 1.0 - eps * eps, (1.0 - (eps * s) ** 2) ** 2
        side = 1.0 if c >= 0.0 else -1.0
        one = sum(math.acos(-side * (eps + x) / (1.0 + eps * x)) for x in (s, -s)) / math.sqrt(open_)
        cos_cos = (1.0 + 2.0 * eps**2) * one + 2.0 * eps * c * (3.0 + (2.0 - 5.0 * eps**2) * s**2) / below
        sin_sin = one + 2.0 * eps * c * (1.0 - (2.0 - eps**2) * s**2) / below
        cos_cos, sin_sin, sin_cos = 0.5 * cos_cos / open_**2, 0.5 * sin_sin / open_, -2.0 * eps * s**3 / below
        unit = -0.5 * self.viscosity * self.diameter * self.width**3 / self.gap**2 * speed
        along, over = cos_cos * c - sin_cos * s, sin_cos * c - sin_sin * s
        return unit / eps * np.array([along * d[0] - over * d[1], along * d[1] + over * d[0]])

    def torque(self, e: np.ndarray, slip: float) -> float:
        """Return the torque of shear on the body that is faster by `slip` (rad/s), in N·m."""
        eps = float(np.hypot(*e)) / self.gap + NEVER_ZERO
        unit = math.pi * self.viscosity * self.width * self.diameter**3 / (4.0 * self.gap)
        return -unit * slip / math.sqrt(1.0 - eps * eps)


def unbalance(t: float, m_e: float, alpha: float) -> np.ndarray:
    """Return the force of an unbalance (N) at the angle alpha t²/2; its heavy side points up at first."""
    angle, speed = 0.5 * alpha * t * t, alpha * t
    c, s = math.cos(angle), math.sin(angle)
    return m_e * np.array([alpha * c - speed**2 * s, alpha * s + speed**2 * c])


SMALL = Film(width=3.5e-3, diameter=7e-3, gap=15e-6, viscosity=1e-2)
INNER = Film(width=20e-3, diameter=25e-3, gap=50e-6, viscosity=1e-2)
OUTER = Film(width=20e-3, diameter=40e-3, gap=70e-6, viscosity=2e-2)
DOWN = np.array([0.0, -WEIGHT])


def rigid_rotor(t: float, y: np.ndarray, film: Film = SMALL) -> np.ndarray:
    """Return y' of the rigid rotor's centre."""
    m, alpha = 0.1, 2.0 * math.pi * 700.0
    force = 2.0 * film.force(y[:2], y[2:], alpha * t) + unbalance(t, 1e-6 * m, alpha)
    return np.concatenate([y[2:], force / m + DOWN])


def elastic_rotor(t: float, y: np.ndarray) -> np.ndarray:
    """Return y' of journal and disc."""
    m, m_j, k, alpha = 0.1, 1e-5, 1e5, 2.0 * math.pi * 500.0
    journal, disc, v_j, v_d = y.reshape(4, 2)
    shaft = k * (disc - journal) + 1e-2 * math.sqrt(k * m) * (v_d - v_j)
    film = 2.0 * SMALL.force(journal, v_j, alpha * t)
    return np.concatenate([v_j, v_d, (film + shaft) / m_j + DOWN, (unbalance(t, 1e-6 * m, alpha) - shaft) / m + DOWN])


def floating_ring(t: float, y: np.ndarray) -> np.ndarray:
    """Return y' of journal, disc and ring, and of the ring's speed."""
    m, m_j, m_r, inertia, k, alpha = 5.0, 1.0, 75e-3, 20e-6, 2e4, 2.0 * math.pi * 300.0
    journal, disc, ring, v_j, v_d, v_r = y[:12].reshape(6, 2)
    speed, turns = alpha * t, float(y[12])
    shaft = k * (disc - journal) + 2e-2 * math.sqrt(k * m) * (v_d - v_j)
    inside = 2.0 * INNER.force(journal - ring, v_j - v_r, speed + turns)
    outside = 2.0 * OUTER.force(ring, v_r, turns)
    torque = 2.0 * (OUTER.torque(ring, turns) - INNER.torque(journal - ring, speed - turns))
    return np.concatenate(
        [
            v_j,
            v_d,
            v_r,
            (inside + shaft) / m_j + DOWN,
            (unbalance(t, 3e-6 * m, alpha) - shaft) / m + DOWN,
            (outside - inside) / m_r + DOWN,
            [torque / inertia],
        ]
    )


def mobility(load: Callable[[float], float], share: float) -> Rates:
    """Return Booker's mobility equations of a short bearing, y = e/c along the load's line and across.

    load: N over s. share: mean speed of the surfaces over that of the crank; a half if the bearing is at rest.
    """
    viscosity, length, diameter, gap, speed = 4.16e-3, 0.0254, 0.0635, 35.56e-6, 2000.0 / 60.0 * 2.0 * math.pi
    unit = (2.0 * gap / diameter) ** 2 / (viscosity * length * diameter) / (math.pi * (length / diameter) ** 2)

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        """Return y'."""
        force = load(t)
        towards, across = (float(y[0]), float(y[1])) if force > 0.0 else (-float(y[0]), float(y[1]))
        pull = unit * abs(force)
        along = pull * (1.0 - towards) ** 2.5 * (1.0 if force > 0.0 else -1.0)
        back = -pull * 4.0 / math.pi * across * (1.0 - towards) ** 1.5
        return np.array([along - share * speed * y[1], back + share * speed * y[0]])

    return rates


def stator(beside: bool) -> Rates:
    """Return the equations of the rotor's centre in its stator.

    beside: the direction of the force is that from a point at the distance e, away from the heavy side.
    """
    m, e, speed, k, d, k_c, gap = 10.0, 0.18, 3.1, 1.0, 0.05, 50.0, 1.0

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        """Return y'."""
        heavy = e * np.array([math.cos(speed * t), math.sin(speed * t)])
        line = y[:2] - heavy if beside else y[:2]
        deep = max(float(np.hypot(*y[:2])) - gap, 0.0)
        force = m * speed**2 * heavy - d * y[2:] - k * y[:2] - k_c * deep * line / float(np.hypot(*line))
        return np.concatenate([y[2:], force / m])

    return rates


@dataclass(frozen=True)
class Collar:
    """Lobo's third section with one torsional degree of freedom: y = r, θ (of its centre), φ (its rotation), and their
    rates.
    """

    v0: float  # m/s, of friction
    gap: float = (0.216 - 0.171) / 2.0
    e: float = 0.014

    @property
    def mass(self) -> tuple[float, float]:
        """Return the mass of the steel, and that with the moving mud, in kg."""
        steel = math.pi * 7800.0 * (0.171**2 - 0.071**2) * 8.55 / 8.0
        return steel, steel + math.pi * 1500.0 * (0.071**2 + 1.7 * 0.171**2) * 8.55 / 8.0

    @property
    def stiffness(self) -> float:
        """Return the bending stiffness in N/m, reduced by the load in the middle of the section."""
        length, above = 8.55, 19.25 + 8.55 / 2.0
        axial = 135e3 - 7800.0 * 9.81 * math.pi * (0.171**2 - 0.071**2) / 4.0 * above
        second = math.pi * (0.171**4 - 0.071**4) / 64.0
        return math.pi**4 * 220e9 * second / (2.0 * length**3) - axial * math.pi**2 / (2.0 * length)

    @property
    def torsion(self) -> tuple[float, float, float]:
        """Return inertia, stiffness and damping of the string."""
        polar = {d: math.pi * (d[0] ** 4 - d[1] ** 4) / 32.0 for d in ((0.14, 0.119), (0.14, 0.076), (0.171, 0.071))}
        pipes, first, others = polar.values()
        inertia = 7800.0 * (pipes * 4733.6 / 3.0 + first * 171.3 + others * (267.1 + 8.55 + 19.25))
        k = 85.3e9 * pipes / 4733.6
        return inertia, k, 0.35 * inertia + 0.06 * k

    def start(self) -> np.ndarray:
        """Return the state at rest under its weight; the string is 1e-7 rad off the vertical."""
        return np.array([self.mass[0] * 9.81 * 1e-7 / self.stiffness, *[0.0] * 5])

    def rates(self, touches: bool) -> Rates:
        """Return the equations with or without contact of the wall."""
        (_, m), (inertia, k_t, c_t), k, table = self.mass, self.torsion, self.stiffness, 105.0 * math.pi / 30.0
        drag, softer = 2.0 * 1500.0 * 0.171 * 8.55 / (3.0 * math.pi), math.pi**3 / (2.0 * 8.55**2)
        e, radius = self.e, 0.171 / 2.0

        def of(t: float, y: np.ndarray) -> np.ndarray:
            """Return y'."""
            r, theta, phi, v, whirl, turns = (float(x) for x in y)
            c, s = math.cos(phi - theta), math.sin(phi - theta)
            rock = 135e3 * 0.0239 * (math.tanh(1.91 * turns) + 8.5 * turns / (1.0 + 5.47 * turns**2))
            mud = drag * math.hypot(v, r * whirl)
            normal = 1e9 * (r - self.gap) if touches else 0.0
            rubbing = 0.35 * normal * math.tanh((turns * radius + r * whirl) / self.v0) if touches else 0.0
            torque = k_t * (table * t - phi) + c_t * (table - turns) - rock
            torque += e * (mud * (r * whirl * c - v * s) - normal * s) - rubbing * (radius - e * c)
            spin = torque / inertia
            radial = whirl**2 * r - (mud * v + (k - softer * rock) * r + normal) / m + e * (turns**2 * c + spin * s)
            around = (e * (turns**2 * s - spin * c) - (mud * r * whirl + rubbing) / m - 2.0 * v * whirl) / r
            return np.array([v, whirl, turns, radial, around, spin])

        return of

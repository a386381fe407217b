"""Force elements for numpy_linkage.py: each as a force at a point and a moment, by virtual work Σ r_qᵀ F + M.

Haug 1989, section 6.3; Nikravesh 1988, section 9.3. Springs are in tension when positive and pull their ends together.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .numpy_linkage import GROUND, End, place, rotation


@dataclass(frozen=True)
class Term:
    """factor · a coordinate or its rate: x, y or θ of a body (`which` 0, 1, 2), or x or y of a point of it."""

    factor: float
    rate: bool
    which: int
    at: End | int

    def value(self, q: np.ndarray, v: np.ndarray) -> float:
        if isinstance(self.at, int):
            return float(self.factor * (v if self.rate else q)[3 * self.at + self.which])
        point = place(self.at, q, v)
        return float(self.factor * (point.v if self.rate else point.r)[self.which])


@dataclass(frozen=True)
class Signal:
    """constant + swing sin(w t) + Σ terms."""

    constant: float
    swing: float = 0.0
    w: float = 1.0
    terms: tuple[Term, ...] = ()

    def value(self, t: float, q: np.ndarray, v: np.ndarray) -> float:
        return float(self.constant + self.swing * np.sin(self.w * t) + sum(term.value(q, v) for term in self.terms))


def turning(size: int, body: int, moment: float) -> np.ndarray:
    """Generalized forces of a moment on a body (the ground: nothing)."""
    g = np.zeros(size)
    if body != GROUND:
        g[3 * body + 2] = moment
    return g


@dataclass(frozen=True)
class Spring:
    """k (l − l_0) + d l̇ along the line between two points."""

    first: End
    second: End
    stiffness: float
    free_length: float
    damping: float

    def forces(self, t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        one, two = place(self.first, q, v), place(self.second, q, v)
        span = two.r - one.r
        length = np.hypot(*span)
        u = span / length
        pull = self.stiffness * (length - self.free_length) + self.damping * (u @ (two.v - one.v))
        return np.asarray(pull * (u @ (one.r_q - two.r_q)))

    def potential(self, q: np.ndarray) -> float:
        v = np.zeros(q.size)
        span = place(self.second, q, v).r - place(self.first, q, v).r
        return float(0.5 * self.stiffness * (np.hypot(*span) - self.free_length) ** 2)


@dataclass(frozen=True)
class RotationalSpring:
    """k (θ_second − θ_first − θ_0) + d (ω_second − ω_first), on the first; its opposite on the second."""

    first: int
    second: int
    stiffness: float
    free_angle: float
    damping: float

    def _difference(self, x: np.ndarray) -> float:
        turned = [0.0 if body == GROUND else float(x[3 * body + 2]) for body in (self.first, self.second)]
        return turned[1] - turned[0]

    def forces(self, t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        wound = self._difference(q) - self.free_angle
        moment = self.stiffness * wound + self.damping * self._difference(v)
        return turning(q.size, self.first, moment) + turning(q.size, self.second, -moment)

    def potential(self, q: np.ndarray) -> float:
        return float(0.5 * self.stiffness * (self._difference(q) - self.free_angle) ** 2)


@dataclass(frozen=True)
class Force:
    """Components in ground axes, or in those of its body."""

    at: End
    x: Signal
    y: Signal
    in_body: bool

    def forces(self, t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        point = place(self.at, q, v)
        force = np.array([self.x.value(t, q, v), self.y.value(t, q, v)])
        return np.asarray(point.r_q.T @ (rotation(point.angle) @ force if self.in_body else force))

    def potential(self, q: np.ndarray) -> float:
        """It stores nothing: what it gives is work."""
        return 0.0


@dataclass(frozen=True)
class Torque:
    """On the first body; its opposite on the second, unless that is the ground."""

    first: int
    second: int
    value: Signal

    def forces(self, t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        moment = self.value.value(t, q, v)
        return turning(q.size, self.first, moment) + turning(q.size, self.second, -moment)

    def potential(self, q: np.ndarray) -> float:
        """It stores nothing: what it gives is work."""
        return 0.0

"""A bar whose pin hangs in a round hole, both rigid: free flight, blows by Newton's law, and rolling without friction.

The bar's centre of mass lies at length (sin θ, −cos θ) from the pin. Flights and contacts are integrated by scipy's
DOP853 between its own events, in the coordinates of the centre of mass.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

Array = np.ndarray[Any, np.dtype[np.float64]]
TIGHT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14}


@dataclass
class HungBar:
    """m (kg), J about the centre of mass (kg m²), length, clearance c (m), restitution e, threshold (m/s), g (m/s²)."""

    m: float
    J: float
    length: float
    c: float
    e: float
    threshold: float
    g: float = 9.81
    blows: list[tuple[float, float, float]] = field(default_factory=list)  # time, approach, impulse
    contacts: list[list[float]] = field(default_factory=list)  # begin, end

    def _free(self, t: float, y: Array) -> Array:
        """The centre of mass falls, the bar turns on: y is (X, Y, θ) of the centre of mass and their rates."""
        return np.array([y[3], y[4], y[5], 0.0, -self.g, 0.0])

    def pin(self, y: Array) -> tuple[Array, Array]:
        """Place and velocity of the pin."""
        s, c = np.sin(y[2]), np.cos(y[2])
        return (
            np.array([y[0] - self.length * s, y[1] + self.length * c]),
            np.array([y[3] - self.length * c * y[5], y[4] - self.length * s * y[5]]),
        )

    def gap(self, y: Array) -> float:
        return float(self.c - np.hypot(*self.pin(y)[0]))

    def approach(self, y: Array) -> float:
        at, speed = self.pin(y)
        return float(at @ speed / np.hypot(*at))

    def direction(self, y: Array) -> Array:
        """∂(e)/∂(X, Y, θ): what a unit force along the normal does."""
        at = self.pin(y)[0]
        n = at / np.hypot(*at)
        return np.array([n[0], n[1], -self.length * (n[0] * np.cos(y[2]) + n[1] * np.sin(y[2]))])

    def force(self, y: Array) -> float:
        """λ that keeps the pin on the wall: n · ë + (ė · ė − (n · ė)²)/|e| = 0."""
        w, (at, speed) = self.direction(y), self.pin(y)
        n, inverse = at / np.hypot(*at), np.array([1 / self.m, 1 / self.m, 1 / self.J])
        s, c = np.sin(y[2]), np.cos(y[2])
        turning = self.length * y[5] ** 2 * np.array([s, -c])  # of the pin about the centre of mass: −ω² arm
        along = n @ (np.array([0.0, -self.g]) + turning)
        across = speed @ speed - (n @ speed) ** 2
        return float((along + across / np.hypot(*at)) / (w @ (inverse * w)))

    def _held(self, t: float, y: Array) -> Array:
        w, force = self.direction(y), self.force(y)
        inverse = np.array([1 / self.m, 1 / self.m, 1 / self.J])
        return np.concatenate([y[3:], np.array([0.0, -self.g, 0.0]) - inverse * w * force])

    def blow(self, t: float, y: Array) -> tuple[Array, bool]:
        """Behind a blow, and whether the pin stays."""
        u, w = self.approach(y), self.direction(y)
        inverse = np.array([1 / self.m, 1 / self.m, 1 / self.J])
        stays = self.e * u <= self.threshold
        impulse = float((1.0 if stays else 1.0 + self.e) * u / (w @ (inverse * w)))
        self.blows.append((t, u, impulse))
        after = y.copy()
        after[3:] -= inverse * w * impulse
        return after, stays and self.force(after) > 0.0

    def run(self, y: Array, end: float, at: Array) -> Array:
        """States at the times `at`, (k, 6)."""
        found, t, held, parting = np.full((len(at), 6), np.nan), 0.0, False, 1.0
        while t < end:
            rates: Callable[[float, Array], Array] = self._held if held else self._free
            turn = (lambda t, y: self.force(y)) if held else (lambda t, y: self.gap(y))  # noqa: B023
            turn.terminal, turn.direction = True, -1  # type: ignore[attr-defined]
            short = np.inf if held else parting / 30.0  # some steps in each flight: no blow hides in one
            part = solve_ivp(rates, (t, end), y, events=turn, dense_output=True, max_step=short, **TIGHT)
            here = (at >= t) & (at <= part.t[-1])
            if here.any():
                found[here] = part.sol(at[here]).T
            t, y = float(part.t[-1]), part.y[:, -1]
            if part.status != 1:
                break
            if held:
                self.contacts[-1][1] = t
                held = False
                continue
            y, held = self.blow(t, y)
            parting = max(-self.approach(y), 1e-3)
            if held:
                self.contacts.append([t, np.nan])
        return found

"""More joints and drives for numpy_linkage.py, from the same textbooks; d = r_second − r_first throughout.

Haug 1989, section 3.2 (absolute constraints) to 3.4 (composite joints, gears); Nikravesh 1988, section 4.2.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .numpy_linkage import GROUND, End, Law, Revolute, Rows, angle_row, offset_row, place, rows_of, stack


@dataclass(frozen=True)
class Rigid:
    """Two points coincide, θ_second − θ_first = angle."""

    first: End
    second: End
    angle: float

    def rows(self, t: float, q: np.ndarray, v: np.ndarray) -> Rows:
        pin = rows_of(Revolute(self.first, self.second), t, q, v)
        return stack([pin, angle_row(self.second.body, self.first.body, self.angle, q)], q.size)


@dataclass(frozen=True)
class Distance:
    """(d·d − l²)/(2l): its rate is d·ḋ/l, its second rate (d·d̈ + ḋ·ḋ)/l."""

    first: End
    second: End
    length: float

    def rows(self, t: float, q: np.ndarray, v: np.ndarray) -> Rows:
        one, two = place(self.first, q, v), place(self.second, q, v)
        d, rate, quadratic = two.r - one.r, two.v - one.v, two.quadratic - one.quadratic
        return Rows(
            np.array([(d @ d - self.length**2) / (2.0 * self.length)]),
            (d @ (two.r_q - one.r_q))[None, :] / self.length,
            np.zeros(1),
            np.array([-(d @ quadratic + rate @ rate) / self.length]),
        )


@dataclass(frozen=True)
class PointOnLine:
    """The first end is on a line through the second end, along `direction` in the second body's frame."""

    first: End
    second: End
    direction: tuple[float, float]

    def rows(self, t: float, q: np.ndarray, v: np.ndarray) -> Rows:
        return offset_row(self.second, self.direction, self.first, q, v)


@dataclass(frozen=True)
class Gear:
    """r_1 (θ_1 − θ_3) + r_2 (θ_2 − θ_3) − constant; r_2 negative for a ring. The ends are bodies, at no point."""

    first: End
    second: End
    carrier: int
    radii: tuple[float, float]
    constant: float

    def coefficients(self, size: int) -> np.ndarray:
        """Of the angles in the row (n,)."""
        row = np.zeros(size)
        r1, r2 = self.radii
        for body, factor in ((self.first.body, r1), (self.second.body, r2), (self.carrier, -(r1 + r2))):
            if body != GROUND:
                row[3 * body + 2] += factor
        return row

    def rows(self, t: float, q: np.ndarray, v: np.ndarray) -> Rows:
        row = self.coefficients(q.size)
        return Rows(np.array([row @ q - self.constant]), row[None, :], np.zeros(1), np.zeros(1))


@dataclass(frozen=True)
class CoordinateDrive:
    """q[3 body + which] is law(t); which: 0 x, 1 y, 2 θ."""

    body: int
    which: int
    law: Law

    def rows(self, t: float, q: np.ndarray, v: np.ndarray) -> Rows:
        k = 3 * self.body + self.which
        return Rows(
            np.array([q[k] - self.law.value(t)]),
            np.eye(q.size)[k : k + 1],
            np.array([self.law.rate(t)]),
            np.array([self.law.acceleration(t)]),
        )


@dataclass(frozen=True)
class DistanceDrive:
    """‖d‖ is law(t); with u = d/‖d‖ the second rate of ‖d‖ is u·d̈ + (ḋ·ḋ − (u·ḋ)²)/‖d‖."""

    first: End
    second: End
    law: Law

    def rows(self, t: float, q: np.ndarray, v: np.ndarray) -> Rows:
        one, two = place(self.first, q, v), place(self.second, q, v)
        d, rate, quadratic = two.r - one.r, two.v - one.v, two.quadratic - one.quadratic
        length = float(np.hypot(*d))
        u = d / length
        turning = (rate @ rate - (u @ rate) ** 2) / length
        return Rows(
            np.array([length - self.law.value(t)]),
            (u @ (two.r_q - one.r_q))[None, :],
            np.array([self.law.rate(t)]),
            np.array([self.law.acceleration(t) - u @ quadratic - turning]),
        )

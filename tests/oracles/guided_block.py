"""A block with round corners in the slot of an arm that swings, in absolute coordinates of both, by scipy.

Each corner is a disc that a straight wall may meet. The arm turns about the origin, its slot runs along its x axis at
the height `rise`. Contact is K δ^n without loss, friction Threlfall's; everything is written in world axes: where the
disc's deepest point is, where the wall is, and how fast the bodies' material moves there.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

Array = np.ndarray[Any, np.dtype[np.float64]]


@dataclass(frozen=True)
class GuidedBlock:
    """Arm: mass, J about its centre, which lies `com` along it; block: mass, J about its centre; SI."""

    arm: tuple[float, float, float]
    block: tuple[float, float]
    rise: float
    half: tuple[float, float, float]  # half-length, half-height, radius of the corners
    gap: float
    turned: float  # angle of the block's frame in the arm's, as the joint asks
    K: float
    n: float
    mu: float
    v_r: float
    g: float = 9.81

    def contacts(self, y: Array) -> list[tuple[float, float, float, Array, Array]]:
        """Penetration, normal force, friction along the slot, place, outward normal; of y = (φ, x, z, θ, rates)."""
        phi, x, z, theta = y[:4]
        a, b, rho = self.half
        along = np.array([np.cos(phi), np.sin(phi)])
        up = np.array([-along[1], along[0]])
        own = theta - self.turned
        lengthwise, crosswise = np.array([np.cos(own), np.sin(own)]), np.array([-np.sin(own), np.cos(own)])
        found = []
        for front, upper in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            disc = np.array([x, z]) + front * (a - rho) * lengthwise + upper * (b - rho) * crosswise
            outward = upper * up
            wall = self.rise * up + (b + self.gap) * outward
            delta = float((disc - wall) @ outward) + rho
            place = disc + (rho - delta / 2) * outward
            slips = self.velocity(y, place, True) - self.velocity(y, place, False)
            tangent = np.array([-outward[1], outward[0]])
            slip = float(slips @ tangent)
            F_n = self.K * delta**self.n if delta > 0 else 0.0
            risen = 1 - np.exp(-3 * min(abs(slip) / self.v_r, 1.0))
            found.append((delta, F_n, -self.mu * F_n * risen * np.sign(slip), place, outward))
        return found

    @staticmethod
    def velocity(y: Array, place: Array, of_block: bool) -> Array:
        if of_block:
            return np.array([y[5] - y[7] * (place[1] - y[2]), y[6] + y[7] * (place[0] - y[1])])
        return y[4] * np.array([-place[1], place[0]])

    def rate(self, t: float, y: Array) -> Array:
        m, J, com = self.arm
        about = J + m * com**2
        moment = -m * self.g * com * np.cos(y[0])
        force, turning = np.array([0.0, -self.block[0] * self.g]), 0.0
        for _, F_n, F_t, place, outward in self.contacts(y):
            F = -F_n * outward + F_t * np.array([-outward[1], outward[0]])
            force = force + F
            turning += (place[0] - y[1]) * F[1] - (place[1] - y[2]) * F[0]
            moment -= place[0] * F[1] - place[1] * F[0]
        return np.array([*y[4:], moment / about, *(force / self.block[0]), turning / self.block[1]])

    def run(self, y: Array, t: Array) -> Array:
        """States (N, 8) at the times t, from y at t[0]."""
        found = solve_ivp(self.rate, (t[0], t[-1]), y, "DOP853", t, rtol=1e-11, atol=1e-13, max_step=2e-4)
        return np.asarray(found.y.T)

"""Simulate machines with joint clearance without gudgeon, as a reference: dense NumPy, DOP853, contacts as events.

It shares no code with gudgeon: linkages are those of tests/oracles/numpy_linkage.py, journals those of journal.py. A
step ends at each switching point of a joint's force: onset and end of contact, slips of v0 and v1.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from tests.oracles import dry
from tests.oracles.journal import Journal
from tests.oracles.numpy_linkage import Linkage, Play, Revolute, Wrench, accelerations, place, rows

STABLE = 100.0  # 1/s, gain of Baumgarte's terms
FLOOR = 1e-6  # m/s: the least δ̇⁻ that an onset stores


@dataclass(frozen=True)
class Pin(Journal):
    """Journal that may be in the centre of its bearing, with a given stiffness or that of its materials."""

    stiffness: float = 0.0  # N/m^exponent; 0: that of its materials

    def __call__(self, e: np.ndarray, rate: np.ndarray, omega_i: float, omega_j: float) -> Wrench:
        """Return the force on the journal and both torques."""
        least = 1e-13 * self.clearance
        if float(np.hypot(*e)) > least:
            return super().__call__(e, rate, omega_i, omega_j)
        if not self.viscosity:
            return Wrench(np.zeros(2), 0.0, 0.0)
        speed = float(np.hypot(*rate))
        return super().__call__(least * rate / speed if speed else np.array([least, 0.0]), rate, omega_i, omega_j)

    def _dry(self, e: float, v_n: float, v_t: float, omega_i: float, omega_j: float) -> tuple[float, ...]:
        """Return radial and tangential contact force, and both torques."""
        delta = e - self.clearance
        if delta <= 0.0 or not self.stiffness:
            return super()._dry(e, v_n, v_t, omega_i, omega_j)
        factor = dry.dissipation_factor(self.restitution)
        normal = dry.normal_force(delta, v_n, self.stored, self.stiffness, self.exponent, factor)
        arm_i, arm_j = self.radius + delta / 2.0, self.radius - self.clearance - delta / 2.0
        tangential = dry.friction_force(v_t + omega_j * arm_j - omega_i * arm_i, normal, self.mu, self.v0, self.v1)
        return -normal, tangential, -arm_i * tangential, arm_j * tangential

    def _film(self, e: float, v_n: float, v_t: float, omega_i: float, omega_j: float) -> tuple[float, ...]:
        """Return radial and tangential film force, and both torques."""
        c, eps, rate = self.clearance, e / self.clearance, v_n / self.clearance
        turning = omega_i + omega_j - 2.0 * v_t / e
        unit = 6.0 * self.viscosity * (self.radius - c) ** 3 * self.width / c**2
        open_ = 1.0 - eps * eps
        if open_ <= 0.0:  # a stage of a step that is too long: SciPy tries a shorter one
            return math.nan, math.nan, math.nan, 0.0
        wedge = math.sqrt(open_ * ((0.5 * turning * eps) ** 2 + rate * rate))  # k ε |ε̇|
        k = wedge / (eps * abs(rate)) if rate else math.inf
        lost = 1.5 / (k + 1.5)
        ratio = 1.0 + lost if rate > 0.0 else 1.0 - lost  # (k + 3)/(k + 3/2), or k/(k + 3/2)
        radial = -unit / open_**1.5 * (4.0 * eps * wedge / (2.0 + eps * eps) + math.pi * rate * ratio)
        tangential = unit * math.pi * eps * turning / ((2.0 + eps * eps) * math.sqrt(open_)) * ratio
        return radial, tangential, -e * tangential, 0.0


@dataclass
class Joint:
    """State of a joint with play: `stored` is δ̇⁻ (0 without contact), `sector` the switching points around its
    slip."""

    play: Play
    law: Journal
    stored: float = 0.0
    sector: tuple[float, float] = (-math.inf, math.inf)

    def now(self) -> Play:
        """Return the play with the stored approach speed."""
        return replace(self.play, law=replace(self.law, stored=self.stored))

    def gap(self, q: np.ndarray, v: np.ndarray) -> tuple[float, float]:
        """Return e − c in m, and its rate in m/s."""
        one, two = place(self.play.first, q, v), place(self.play.second, q, v)
        e, rate = two.r - one.r, two.v - one.v
        size = float(np.hypot(*e))
        return size - self.law.clearance, float(e @ rate) / size if size else 0.0

    def slip(self, q: np.ndarray, v: np.ndarray) -> float:
        """Return the slip of the journal's surface on the bearing's in m/s, in the middle of the penetration."""
        one, two = place(self.play.first, q, v), place(self.play.second, q, v)
        e, rate = two.r - one.r, two.v - one.v
        size, law = float(np.hypot(*e)), self.law
        half = (size - law.clearance) / 2.0
        across = float(np.array([-e[1], e[0]]) @ rate) / size
        return across + two.omega * (law.radius - law.clearance - half) - one.omega * (law.radius + half)

    def settle(self, q: np.ndarray, v: np.ndarray) -> None:
        """Set the sector in which the slip is."""
        corners = [-math.inf, -self.law.v1, -self.law.v0, self.law.v0, self.law.v1, math.inf]
        slip = self.slip(q, v)
        k = next(i for i in range(5) if slip < corners[i + 1])
        self.sector = corners[k], corners[k + 1]


@dataclass
class Second:
    """A machine and its integrator; `onsets` lists the times of contact of each joint."""

    linkage: Linkage
    joints: list[Joint]
    rtol: float = 1e-13
    method: str = "DOP853"
    onsets: list[list[float]] = field(default_factory=list)
    calls: int = 0

    def __call__(self, t: float, y: np.ndarray) -> np.ndarray:
        """Return y' for the integrator."""
        self.calls += 1
        n = y.size // 2
        linkage = replace(self.linkage, plays=tuple(joint.now() for joint in self.joints))
        return np.concatenate([y[n:], accelerations(linkage, t, y[:n], y[n:], STABLE, STABLE)[0]])

    def start(self, guess: np.ndarray) -> np.ndarray:
        """Return the state with centred journals that move as ideal joints, by Newton's method. Raises ValueError."""
        pins = tuple(Revolute(joint.play.first, joint.play.second) for joint in self.joints)
        ideal = replace(self.linkage, joints=(*self.linkage.joints, *pins))
        q = np.array(guess, dtype=float)
        for _ in range(60):
            found = rows(ideal, 0.0, q, np.zeros(q.size))
            q -= np.linalg.lstsq(found.phi_q, found.phi, rcond=None)[0]
        found = rows(ideal, 0.0, q, np.zeros(q.size))
        if abs(found.phi).max() > 1e-14:
            raise ValueError("the linkage does not close from this guess")
        return np.concatenate([q, np.linalg.solve(found.phi_q, found.nu)])

    def run(self, y: np.ndarray, times: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return samples at `times`, which begin with 0: q (N, n), e (N, joints, 2), force on each journal (N, joints,
        2).
        """
        self.onsets = [[] for _ in self.joints]
        t, n = 0.0, y.size // 2
        samples = [(y[:n], *self._of(0.0, y[:n], y[n:]))]
        for end in times[1:]:
            while t < end:
                t, y = self._piece(t, float(end), y)
            samples.append((y[:n], *self._of(t, y[:n], y[n:])))
        q, e, force = (np.array(column) for column in zip(*samples, strict=True))
        return q, e, force

    def _of(self, t: float, q: np.ndarray, v: np.ndarray) -> tuple[list[np.ndarray], list[np.ndarray]]:
        """Return the eccentricity of each joint and the force on its journal."""
        eccentricities, forces = [], []
        for joint in self.joints:
            one, two = place(joint.play.first, q, v), place(joint.play.second, q, v)
            eccentricities.append(two.r - one.r)
            forces.append(joint.now().law(two.r - one.r, two.v - one.v, one.omega, two.omega).force)
        return eccentricities, forces

    def _piece(self, t: float, end: float, y: np.ndarray) -> tuple[float, np.ndarray]:
        """Integrate to the next event, or to `end`; return time and state."""
        n = y.size // 2
        what = list(self._events(n))
        end = min(end, t + self._stride(y))
        found = solve_ivp(
            self,
            (t, end),
            y,
            self.method,
            events=[event for event, _ in what],
            rtol=self.rtol,
            atol=self.rtol * self._sizes(y),
        )
        if found.status < 0:
            raise ValueError(found.message)
        t, y = float(found.t[-1]), found.y[:, -1]
        for (_, done), times in zip(what, found.t_events, strict=True):
            if times.size:
                done(t, y[:n], y[n:])
        return t, y

    def _stride(self, y: np.ndarray) -> float:
        """Return the largest step in s."""
        return math.inf

    def _sizes(self, y: np.ndarray) -> np.ndarray:
        """Return the scales of absolute tolerances: 1e-3 m, rad, m/s, rad/s."""
        return np.full(y.size, 1e-3)

    def _events(self, n: int) -> Iterator[tuple[Any, Callable[[float, np.ndarray, np.ndarray], None]]]:
        """Yield each event function with the change of mode after its zero."""
        for k, joint in enumerate(self.joints):
            touches = joint.stored > 0.0

            def gap(t: float, y: np.ndarray, joint: Joint = joint) -> float:
                """Return the penetration of a joint."""
                return joint.gap(y[:n], y[n:])[0]

            def change(t: float, q: np.ndarray, v: np.ndarray, k: int = k, joint: Joint = joint) -> None:
                """Begin or end the contact of a joint."""
                if joint.stored:
                    joint.stored = 0.0
                    return
                joint.stored = max(joint.gap(q, v)[1], FLOOR)
                self.onsets[k].append(t)
                joint.settle(q, v)

            yield ending(gap, -1.0 if touches else 1.0), change
            if not touches or not joint.law.mu:
                continue
            for corner, direction in zip(joint.sector, (-1.0, 1.0), strict=True):
                if not math.isfinite(corner):
                    continue

                def slip(t: float, y: np.ndarray, joint: Joint = joint, corner: float = corner) -> float:
                    """Return the slip's distance from a switching point."""
                    return joint.slip(y[:n], y[n:]) - corner

                def cross(
                    t: float,
                    q: np.ndarray,
                    v: np.ndarray,
                    joint: Joint = joint,
                    corner: float = corner,
                    direction: float = direction,
                ) -> None:
                    """Change the sector of a joint's slip."""
                    corners = [-math.inf, -joint.law.v1, -joint.law.v0, joint.law.v0, joint.law.v1, math.inf]
                    at = corners.index(corner)
                    joint.sector = (corner, corners[at + 1]) if direction > 0.0 else (corners[at - 1], corner)

                yield ending(slip, direction), cross


def ending(function: Callable[[float, np.ndarray], float], direction: float) -> Any:
    """Return the function as a terminal event of solve_ivp with a direction."""
    function.terminal, function.direction = True, direction  # type: ignore[attr-defined]
    return function

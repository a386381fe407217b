"""A planar linkage in dense NumPy, straight from the textbook, and random linkages to try it on.

q = (x, y, θ) of every body, at its centre of mass; rotation matrix A(θ) = [cos −sin; sin cos], B = dA/dθ.
    [M Φ_qᵀ; Φ_q 0][q̈; λ] = [g; γ − 2αΦ̇ − β²Φ]
Sources: E. J. Haug, Computer Aided Kinematics and Dynamics, 1989, chapters 3 and 6; P. E. Nikravesh, Computer-Aided
Analysis of Mechanical Systems, 1988, chapters 4 and 8. Row conventions: a revolute joint's rows are the point on the
first body minus that on the second; a translational joint's are n·(r_second − r_first) with n the axis turned +90°,
then θ_second − θ_first − angle; a drive's row is θ − θ_reference − f(t). linkage_joints.py has the other joints and
drives, linkage_loads.py the force elements.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

GROUND = -1
TURN = np.array([[0.0, -1.0], [1.0, 0.0]])  # +90°


class Law(Protocol):
    """A function of time with two derivatives."""

    def value(self, t: float) -> float: ...
    def rate(self, t: float) -> float: ...
    def acceleration(self, t: float) -> float: ...


@dataclass(frozen=True)
class Wave:
    """a + b t + c sin(w t)."""

    a: float
    b: float = 0.0
    c: float = 0.0
    w: float = 1.0

    def value(self, t: float) -> float:
        return float(self.a + self.b * t + self.c * np.sin(self.w * t))

    def rate(self, t: float) -> float:
        return float(self.b + self.c * self.w * np.cos(self.w * t))

    def acceleration(self, t: float) -> float:
        return float(-self.c * self.w**2 * np.sin(self.w * t))


@dataclass(frozen=True)
class Body:
    """Mass (kg) and moment of inertia about the centre of mass (kg·m²)."""

    mass: float
    inertia: float


class End(NamedTuple):
    """A point of a body in its centre-of-mass frame (m); body −1 is the ground."""

    body: int
    at: tuple[float, float]


@dataclass(frozen=True)
class Revolute:
    first: End
    second: End


@dataclass(frozen=True)
class Translational:
    """`axis` (any length) in the first body's frame; `angle` = θ_second − θ_first."""

    first: End
    second: End
    axis: tuple[float, float]
    angle: float


@dataclass(frozen=True)
class Drive:
    """θ of `body` less that of `reference` (−1: the ground) is law(t)."""

    body: int
    reference: int
    law: Law


class Wrench(NamedTuple):
    """Force on the journal's body (ground axes, N) and moments on both bodies about their own end points (N·m)."""

    force: np.ndarray
    moment_first: float
    moment_second: float


@dataclass(frozen=True)
class Play:
    """Bearing at `first`, journal at `second`; law(e, ė, ω_first, ω_second) → Wrench, e = r_second − r_first.

    The bearing gets −force at its end point and `moment_first`.
    """

    first: End
    second: End
    law: Callable[[np.ndarray, np.ndarray, float, float], Wrench]


@dataclass(frozen=True)
class Rows:
    """Φ (m,), Φ_q (m, n), ν = −Φ_t (m,), γ (m,)."""

    phi: np.ndarray
    phi_q: np.ndarray
    nu: np.ndarray
    gamma: np.ndarray


class Constraint(Protocol):
    """A joint or a drive of linkage_joints.py."""

    def rows(self, t: float, q: np.ndarray, v: np.ndarray) -> Rows: ...


class Load(Protocol):
    """A force element of linkage_loads.py: its generalized forces (n,) and the energy that it stores (J)."""

    def forces(self, t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray: ...
    def potential(self, q: np.ndarray) -> float: ...


@dataclass(frozen=True)
class Linkage:
    bodies: tuple[Body, ...]
    joints: tuple[Revolute | Translational | Constraint, ...]
    drives: tuple[Drive | Constraint, ...] = ()
    plays: tuple[Play, ...] = ()
    gravity: tuple[float, float] = (0.0, 0.0)
    loads: tuple[Load, ...] = ()

    @property
    def size(self) -> int:
        """Number of coordinates."""
        return 3 * len(self.bodies)


class _Place(NamedTuple):
    """A point on its way: position, velocity, velocity-dependent acceleration, ∂r/∂q (2, n)."""

    r: np.ndarray
    v: np.ndarray
    quadratic: np.ndarray
    r_q: np.ndarray
    angle: float
    omega: float


def rotation(theta: float) -> np.ndarray:
    """A(θ)."""
    return np.array([[np.cos(theta), -np.sin(theta)], [np.sin(theta), np.cos(theta)]])


def place(end: End, q: np.ndarray, v: np.ndarray) -> _Place:
    """Where the end is and how it moves: r + A s, ṙ + ω B s, −ω² A s."""
    r_q = np.zeros((2, q.size))
    s = np.array(end.at)
    if end.body == GROUND:
        return _Place(s, np.zeros(2), np.zeros(2), r_q, 0.0, 0.0)
    i = 3 * end.body
    arm, omega = rotation(q[i + 2]) @ s, v[i + 2]
    r_q[:, i : i + 2] = np.eye(2)
    r_q[:, i + 2] = TURN @ arm
    return _Place(q[i : i + 2] + arm, v[i : i + 2] + omega * (TURN @ arm), -(omega**2) * arm, r_q, q[i + 2], omega)


def _angle_row(size: int, second: int, first: int) -> np.ndarray:
    row = np.zeros(size)
    for body, sign in ((second, 1.0), (first, -1.0)):
        if body != GROUND:
            row[3 * body + 2] = sign
    return row


def _revolute(joint: Revolute, q: np.ndarray, v: np.ndarray) -> Rows:
    one, two = place(joint.first, q, v), place(joint.second, q, v)
    return Rows(one.r - two.r, one.r_q - two.r_q, np.zeros(2), -(one.quadratic - two.quadratic))


def offset_row(line: End, axis: tuple[float, float], point: End, q: np.ndarray, v: np.ndarray) -> Rows:
    """n·(r_point − r_line), n being the axis (any length, fixed in the line's body) turned +90°."""
    one, two = place(line, q, v), place(point, q, v)
    n = TURN @ rotation(one.angle) @ (np.array(axis) / np.hypot(*axis))
    d, rate = two.r - one.r, two.v - one.v
    row = n @ (two.r_q - one.r_q)
    if line.body != GROUND:
        row[3 * line.body + 2] += (TURN @ n) @ d
    quadratic = -(one.omega**2) * (n @ d) + 2.0 * one.omega * ((TURN @ n) @ rate) + n @ (two.quadratic - one.quadratic)
    return Rows(np.array([n @ d]), row[None, :], np.zeros(1), np.array([-quadratic]))


def angle_row(second: int, first: int, angle: float, q: np.ndarray) -> Rows:
    """θ_second − θ_first − angle."""
    row = _angle_row(q.size, second, first)
    return Rows(np.array([row @ q - angle]), row[None, :], np.zeros(1), np.zeros(1))


def stack(parts: Sequence[Rows], size: int) -> Rows:
    """Rows under each other; `size` coordinates."""
    if not parts:
        return Rows(np.zeros(0), np.zeros((0, size)), np.zeros(0), np.zeros(0))
    return Rows(
        np.concatenate([p.phi for p in parts]),
        np.vstack([p.phi_q for p in parts]),
        np.concatenate([p.nu for p in parts]),
        np.concatenate([p.gamma for p in parts]),
    )


def _translational(joint: Translational, q: np.ndarray, v: np.ndarray) -> Rows:
    offset = offset_row(joint.first, joint.axis, joint.second, q, v)
    return stack([offset, angle_row(joint.second.body, joint.first.body, joint.angle, q)], q.size)


def _drive(drive: Drive, t: float, q: np.ndarray) -> Rows:
    row = _angle_row(q.size, drive.body, drive.reference)
    return Rows(
        np.array([row @ q - drive.law.value(t)]),
        row[None, :],
        np.array([drive.law.rate(t)]),
        np.array([drive.law.acceleration(t)]),
    )


def rows_of(part: Revolute | Translational | Drive | Constraint, t: float, q: np.ndarray, v: np.ndarray) -> Rows:
    """The rows of one joint or drive."""
    if isinstance(part, Revolute):
        return _revolute(part, q, v)
    if isinstance(part, Translational):
        return _translational(part, q, v)
    return _drive(part, t, q) if isinstance(part, Drive) else part.rows(t, q, v)


def rows(linkage: Linkage, t: float, q: np.ndarray, v: np.ndarray) -> Rows:
    """All rows: the joints in their order, then the drives in theirs."""
    return stack([rows_of(part, t, q, v) for part in (*linkage.joints, *linkage.drives)], q.size)


def mass(linkage: Linkage) -> np.ndarray:
    """The diagonal of M (n,)."""
    return np.array([x for b in linkage.bodies for x in (b.mass, b.mass, b.inertia)])


def forces(linkage: Linkage, q: np.ndarray, v: np.ndarray, t: float = 0.0) -> np.ndarray:
    """g (n,): weights, the force elements, and the forces of the joints with play."""
    g = np.array([x for b in linkage.bodies for x in (b.mass * linkage.gravity[0], b.mass * linkage.gravity[1], 0.0)])
    for play in linkage.plays:
        one, two = place(play.first, q, v), place(play.second, q, v)
        wrench = play.law(two.r - one.r, two.v - one.v, one.omega, two.omega)
        g = g + (two.r_q - one.r_q).T @ wrench.force
        for body, moment in ((play.first.body, wrench.moment_first), (play.second.body, wrench.moment_second)):
            if body != GROUND:
                g[3 * body + 2] += moment
    return np.asarray(g + sum((load.forces(t, q, v) for load in linkage.loads), np.zeros(q.size)))


def energy(linkage: Linkage, q: np.ndarray, v: np.ndarray) -> float:
    """Kinetic energy, and the potential of gravity and springs (J)."""
    weights = sum(b.mass * np.dot(linkage.gravity, q[3 * i : 3 * i + 2]) for i, b in enumerate(linkage.bodies))
    stored = sum(load.potential(q) for load in linkage.loads)
    return float(0.5 * mass(linkage) @ v**2 - weights + stored)


def accelerations(
    linkage: Linkage, t: float, q: np.ndarray, v: np.ndarray, alpha: float = 0.0, beta: float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    """q̈ (n,) and λ (m,) by a dense solve; α, β are Baumgarte's (1/s)."""
    r = rows(linkage, t, q, v)
    n, m = q.size, r.phi.size
    kkt = np.zeros((n + m, n + m))
    kkt[:n, :n] = np.diag(mass(linkage))
    kkt[:n, n:], kkt[n:, :n] = r.phi_q.T, r.phi_q
    corrected = r.gamma - 2.0 * alpha * (r.phi_q @ v - r.nu) - beta**2 * r.phi
    x = np.linalg.solve(kkt, np.concatenate([forces(linkage, q, v, t), corrected]))
    return x[:n], x[n:]

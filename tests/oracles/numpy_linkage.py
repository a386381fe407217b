"""A planar linkage in dense NumPy, straight from the textbook, and random linkages to try it on.

q = (x, y, θ) of every body, at its centre of mass; rotation matrix A(θ) = [cos −sin; sin cos], B = dA/dθ.
    [M Φ_qᵀ; Φ_q 0][q̈; λ] = [g; γ − 2αΦ̇ − β²Φ]
Sources: E. J. Haug, Computer Aided Kinematics and Dynamics, 1989, chapters 3 and 6; P. E. Nikravesh, Computer-Aided
Analysis of Mechanical Systems, 1988, chapters 4 and 8. Row conventions: a revolute joint's rows are the point on the
first body minus that on the second; a translational joint's are n·(r_second − r_first) with n the axis turned +90°,
then θ_second − θ_first − angle; a drive's row is θ − θ_reference − f(t).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
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
class Linkage:
    bodies: tuple[Body, ...]
    joints: tuple[Revolute | Translational, ...]
    drives: tuple[Drive, ...] = ()
    plays: tuple[Play, ...] = ()
    gravity: tuple[float, float] = (0.0, 0.0)

    @property
    def size(self) -> int:
        """Number of coordinates."""
        return 3 * len(self.bodies)


@dataclass(frozen=True)
class Rows:
    """Φ (m,), Φ_q (m, n), ν = −Φ_t (m,), γ (m,)."""

    phi: np.ndarray
    phi_q: np.ndarray
    nu: np.ndarray
    gamma: np.ndarray


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


def _translational(joint: Translational, q: np.ndarray, v: np.ndarray) -> Rows:
    one, two = place(joint.first, q, v), place(joint.second, q, v)
    axis = np.array(joint.axis) / np.hypot(*joint.axis)
    n = TURN @ rotation(one.angle) @ axis
    d, rate = two.r - one.r, two.v - one.v
    row = n @ (two.r_q - one.r_q)
    if joint.first.body != GROUND:
        row[3 * joint.first.body + 2] += (TURN @ n) @ d
    quadratic = -(one.omega**2) * (n @ d) + 2.0 * one.omega * ((TURN @ n) @ rate) + n @ (two.quadratic - one.quadratic)
    return Rows(
        np.array([n @ d, two.angle - one.angle - joint.angle]),
        np.array([row, _angle_row(q.size, joint.second.body, joint.first.body)]),
        np.zeros(2),
        np.array([-quadratic, 0.0]),
    )


def _drive(drive: Drive, t: float, q: np.ndarray) -> Rows:
    row = _angle_row(q.size, drive.body, drive.reference)
    return Rows(
        np.array([row @ q - drive.law.value(t)]),
        row[None, :],
        np.array([drive.law.rate(t)]),
        np.array([drive.law.acceleration(t)]),
    )


def rows(linkage: Linkage, t: float, q: np.ndarray, v: np.ndarray) -> Rows:
    """All rows: the joints in their order, then the drives in theirs."""
    parts = [_revolute(j, q, v) if isinstance(j, Revolute) else _translational(j, q, v) for j in linkage.joints]
    parts += [_drive(d, t, q) for d in linkage.drives]
    if not parts:
        return Rows(np.zeros(0), np.zeros((0, q.size)), np.zeros(0), np.zeros(0))
    return Rows(
        np.concatenate([p.phi for p in parts]),
        np.vstack([p.phi_q for p in parts]),
        np.concatenate([p.nu for p in parts]),
        np.concatenate([p.gamma for p in parts]),
    )


def mass(linkage: Linkage) -> np.ndarray:
    """The diagonal of M (n,)."""
    return np.array([x for b in linkage.bodies for x in (b.mass, b.mass, b.inertia)])


def forces(linkage: Linkage, q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """g (n,): weights, and the forces of the joints with play."""
    g = np.array([x for b in linkage.bodies for x in (b.mass * linkage.gravity[0], b.mass * linkage.gravity[1], 0.0)])
    for play in linkage.plays:
        one, two = place(play.first, q, v), place(play.second, q, v)
        wrench = play.law(two.r - one.r, two.v - one.v, one.omega, two.omega)
        g = g + (two.r_q - one.r_q).T @ wrench.force
        for body, moment in ((play.first.body, wrench.moment_first), (play.second.body, wrench.moment_second)):
            if body != GROUND:
                g[3 * body + 2] += moment
    return g


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
    x = np.linalg.solve(kkt, np.concatenate([forces(linkage, q, v), corrected]))
    return x[:n], x[n:]


@dataclass(frozen=True)
class Case:
    """A random linkage with a state that satisfies its constraints at t = 0."""

    linkage: Linkage
    q: np.ndarray
    v: np.ndarray
    seed: int
    kinds: tuple[str, ...] = field(default=())


def _local(body: int, q: np.ndarray, world: np.ndarray) -> End:
    if body == GROUND:
        return End(GROUND, (float(world[0]), float(world[1])))
    s = rotation(q[3 * body + 2]).T @ (world - q[3 * body : 3 * body + 2])
    return End(body, (float(s[0]), float(s[1])))


def _random_joint(
    rng: np.random.Generator, first: int, second: int, q: np.ndarray, sliding: float
) -> Revolute | Translational:
    """A joint that the configuration q satisfies already."""
    world = rng.uniform(-0.3, 0.3, 2)
    first, second = (second, first) if rng.random() < 0.3 else (first, second)  # the ground may come second
    if rng.random() >= sliding:
        return Revolute(_local(first, q, world), _local(second, q, world))
    direction = rng.uniform(0.0, 2.0 * np.pi)
    along = np.array([np.cos(direction), np.sin(direction)])
    angle1 = 0.0 if first == GROUND else q[3 * first + 2]
    axis = rng.uniform(0.5, 2.0) * (rotation(angle1).T @ along)  # any length: only its direction counts
    other = world + rng.uniform(-0.2, 0.2) * along
    angle2 = 0.0 if second == GROUND else q[3 * second + 2]
    return Translational(
        _local(first, q, world), _local(second, q, other), (float(axis[0]), float(axis[1])), float(angle2 - angle1)
    )


def _independent(linkage: Linkage, q: np.ndarray, freedom: int = 0) -> bool:
    """Are the rows well away from dependent, with at least `freedom` degrees of freedom left?"""
    r = rows(linkage, 0.0, q, np.zeros(q.size)).phi_q
    return bool(r.shape[0] + freedom <= q.size and np.linalg.svd(r, compute_uv=False)[-1] > 0.02)


def random_case(seed: int, bodies: int = 4, loops: int = 1, drives: int = 1, sliding: float = 0.3) -> Case:
    """A connected linkage: a random tree of joints on the ground, then so many loops and drives as stay independent.

    The same seed gives the same case; which loops and drives fit is tried in a fixed order.
    """
    rng = np.random.default_rng(seed)
    parts = tuple(Body(float(rng.uniform(0.1, 2.0)), float(rng.uniform(1e-3, 2e-2))) for _ in range(bodies))
    q = rng.uniform(-0.3, 0.3, 3 * bodies)
    q[2::3] = rng.uniform(-np.pi, np.pi, bodies)
    gravity = (float(rng.uniform(-2.0, 2.0)), -9.81)
    while True:
        joints = tuple(_random_joint(rng, int(rng.integers(-1, b)), b, q, sliding) for b in range(bodies))
        linkage = Linkage(parts, joints, gravity=gravity)
        if _independent(linkage, q):
            break
    for _ in range(20 * loops):
        if len(linkage.joints) == bodies + loops:
            break
        one, two = sorted(int(x) for x in rng.choice(bodies, 2, replace=False)) if bodies > 1 else (GROUND, 0)
        more = (*linkage.joints, _random_joint(rng, GROUND if rng.random() < 0.5 else one, two, q, sliding))
        candidate = Linkage(parts, more, gravity=gravity)
        linkage = candidate if _independent(candidate, q, freedom=1) else linkage
    linkage = _with_drives(rng, linkage, q, drives)
    return Case(
        linkage, q, _consistent_velocity(rng, linkage, q), seed, tuple(type(j).__name__ for j in linkage.joints)
    )


def _with_drives(rng: np.random.Generator, linkage: Linkage, q: np.ndarray, wanted: int) -> Linkage:
    """So many drives, up to `wanted`, as stay independent; at t = 0 they prescribe what q has."""
    for body in rng.permutation(len(linkage.bodies)):
        if len(linkage.drives) == wanted:
            break
        reference = int(rng.integers(-1, len(linkage.bodies)))
        reference = GROUND if reference == body else reference
        now = float(_angle_row(q.size, int(body), reference) @ q)
        law = Wave(now, *(float(x) for x in rng.uniform((-3.0, 0.1, 1.0), (3.0, 0.5, 5.0))))
        drives = (*linkage.drives, Drive(int(body), reference, law))
        candidate = Linkage(linkage.bodies, linkage.joints, drives, (), linkage.gravity)
        linkage = candidate if _independent(candidate, q) else linkage
    return linkage


def _consistent_velocity(rng: np.random.Generator, linkage: Linkage, q: np.ndarray) -> np.ndarray:
    """A random velocity with Φ_q v = ν at t = 0."""
    r = rows(linkage, 0.0, q, np.zeros(q.size))
    v = rng.uniform(-1.0, 1.0, q.size)
    return np.asarray(v - np.linalg.pinv(r.phi_q) @ (r.phi_q @ v - r.nu))


def names(linkage: Linkage) -> Sequence[str]:
    """Names of the bodies in what is written about a random linkage: b0, b1, …"""
    return [f"b{i}" for i in range(len(linkage.bodies))]

"""Random linkages of revolute and translational joints, to try numpy_linkage.py and the product on."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .numpy_linkage import GROUND, Body, Drive, End, Linkage, Revolute, Translational, Wave, angle_row, rotation, rows


@dataclass(frozen=True)
class Case:
    """A random linkage with a state that satisfies its constraints at t = 0."""

    linkage: Linkage
    q: np.ndarray
    v: np.ndarray
    seed: int
    kinds: tuple[str, ...] = field(default=())


def local(body: int, q: np.ndarray, world: np.ndarray) -> End:
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
        return Revolute(local(first, q, world), local(second, q, world))
    direction = rng.uniform(0.0, 2.0 * np.pi)
    along = np.array([np.cos(direction), np.sin(direction)])
    angle1 = 0.0 if first == GROUND else q[3 * first + 2]
    axis = rng.uniform(0.5, 2.0) * (rotation(angle1).T @ along)  # any length: only its direction counts
    other = world + rng.uniform(-0.2, 0.2) * along
    angle2 = 0.0 if second == GROUND else q[3 * second + 2]
    return Translational(
        local(first, q, world), local(second, q, other), (float(axis[0]), float(axis[1])), float(angle2 - angle1)
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
    return Case(linkage, q, consistent_velocity(rng, linkage, q), seed, tuple(type(j).__name__ for j in linkage.joints))


def _with_drives(rng: np.random.Generator, linkage: Linkage, q: np.ndarray, expected: int) -> Linkage:
    """So many drives, up to `expected`, as stay independent; at t = 0 they prescribe what q has."""
    for body in rng.permutation(len(linkage.bodies)):
        if len(linkage.drives) == expected:
            break
        reference = int(rng.integers(-1, len(linkage.bodies)))
        reference = GROUND if reference == body else reference
        now = float(angle_row(int(body), reference, 0.0, q).phi[0])
        law = Wave(now, *(float(x) for x in rng.uniform((-3.0, 0.1, 1.0), (3.0, 0.5, 5.0))))
        drives = (*linkage.drives, Drive(int(body), reference, law))
        candidate = Linkage(linkage.bodies, linkage.joints, drives, (), linkage.gravity)
        linkage = candidate if _independent(candidate, q) else linkage
    return linkage


def consistent_velocity(rng: np.random.Generator, linkage: Linkage, q: np.ndarray) -> np.ndarray:
    """A random velocity with Φ_q v = ν at t = 0."""
    r = rows(linkage, 0.0, q, np.zeros(q.size))
    v = rng.uniform(-1.0, 1.0, q.size)
    return np.asarray(v - np.linalg.pinv(r.phi_q) @ (r.phi_q @ v - r.nu))

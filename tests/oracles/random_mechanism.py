"""Random linkages of everything: trees and loops of every joint, every drive, springs, dampers, forces, torques.

A joint is made around the configuration that it finds, so that the configuration satisfies all of them;
what would depend on earlier rows is left out. The same seed gives the same linkage.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .linkage_joints import CoordinateDrive, Distance, DistanceDrive, Gear, PointOnLine, Rigid
from .linkage_loads import Force, RotationalSpring, Signal, Spring, Term, Torque
from .numpy_linkage import (
    GROUND,
    Body,
    Constraint,
    Drive,
    End,
    Linkage,
    Load,
    Revolute,
    Translational,
    Wave,
    angle_row,
    place,
    rotation,
    rows,
)
from .random_linkage import Case, consistent_velocity, local

Joint = Revolute | Translational | Constraint
JOINTS = ("revolute", "translational", "rigid", "distance", "point_on_line", "gear")
WEIGHTS = (0.35, 0.15, 0.08, 0.15, 0.15, 0.12)
INDEPENDENT = 0.02  # least singular value of the rows, each of length one
APART = 0.05  # m, least distance of points that a line joins


class _Maker:
    """Draws parts that fit the configuration q."""

    def __init__(self, rng: np.random.Generator, q: np.ndarray) -> None:
        self.rng, self.q, self.count = rng, q, q.size // 3

    def number(self, low: float, high: float) -> float:
        return float(self.rng.uniform(low, high))

    def body(self) -> int:
        return int(self.rng.integers(self.count))

    def place(self) -> np.ndarray:
        """A point in ground axes."""
        return self.rng.uniform(-0.3, 0.3, 2)

    def angle(self, body: int) -> float:
        return 0.0 if body == GROUND else float(self.q[3 * body + 2])

    def along(self, body: int) -> tuple[np.ndarray, tuple[float, float]]:
        """A direction in ground axes, and the same in the body's frame with any length."""
        turn = self.number(0.0, 2.0 * np.pi)
        along = np.array([np.cos(turn), np.sin(turn)])
        axis = self.number(0.5, 2.0) * (rotation(self.angle(body)).T @ along)
        return along, (float(axis[0]), float(axis[1]))

    def two_ends(self, first: int, second: int) -> tuple[End, End, float]:
        """Ends at different places, and how far apart they are."""
        one = two = self.place()
        while np.hypot(*(two - one)) < APART:
            two = self.place()
        return local(first, self.q, one), local(second, self.q, two), float(np.hypot(*(two - one)))

    def joint(self, first: int, second: int) -> Joint:
        """Between two bodies, either of which may be the ground."""
        kind = str(self.rng.choice(JOINTS, p=WEIGHTS))
        world, q = self.place(), self.q
        if kind == "gear" and GROUND not in (first, second):
            others = [b for b in range(GROUND, self.count) if b not in (first, second)]
            ring = -1.0 if self.rng.random() < 0.3 else 1.0
            radii = (self.number(0.03, 0.2), ring * self.number(0.03, 0.2))
            centres = (End(first, (0.0, 0.0)), End(second, (0.0, 0.0)))
            gear = Gear(*centres, int(self.rng.choice(others)), radii, 0.0)
            return replace(gear, constant=float(gear.coefficients(q.size) @ q))
        if kind == "distance":
            return Distance(*self.two_ends(first, second))
        if kind == "rigid":
            turned = self.angle(second) - self.angle(first)
            return Rigid(local(first, q, world), local(second, q, world), turned)
        if kind == "point_on_line":
            along, direction = self.along(second)
            other = world + self.number(-0.2, 0.2) * along
            return PointOnLine(local(first, q, world), local(second, q, other), direction)
        if kind == "translational":
            along, axis = self.along(first)
            other = world + self.number(-0.2, 0.2) * along
            turned = self.angle(second) - self.angle(first)
            return Translational(local(first, q, world), local(second, q, other), axis, turned)
        return Revolute(local(first, q, world), local(second, q, world))

    def law(self, now: float) -> Wave:
        """What is `now` at t = 0."""
        return Wave(now, self.number(-2.0, 2.0), self.number(0.1, 0.5), self.number(1.0, 5.0))

    def drive(self) -> Drive | Constraint:
        """Of an angle, a coordinate or a distance."""
        body, kind = self.body(), self.rng.integers(3)
        other = int(self.rng.integers(-1, self.count))
        if kind == 0:
            reference = GROUND if other == body else other
            return Drive(body, reference, self.law(float(angle_row(body, reference, 0.0, self.q).phi[0])))
        if kind == 1:
            which = int(self.rng.integers(3))
            return CoordinateDrive(body, which, self.law(float(self.q[3 * body + which])))
        first, second, apart = self.two_ends(GROUND if other == body else other, body)
        return DistanceDrive(first, second, replace(self.law(apart), b=self.number(-0.2, 0.2)))

    def signal(self, size: float, constant: bool) -> Signal:
        """A number of `size`; unless `constant`, with a swing and up to two terms of the motion."""
        if constant or self.rng.random() < 0.3:
            return Signal(self.number(-size, size))
        terms = tuple(self.term(size) for _ in range(self.rng.integers(3)))
        return Signal(self.number(-size, size), self.number(-size, size), self.number(1.0, 9.0), terms)

    def term(self, size: float) -> Term:
        factor, rate, body = self.number(-0.3, 0.3) * size, bool(self.rng.random() < 0.5), self.body()
        if self.rng.random() < 0.5:
            return Term(factor, rate, int(self.rng.integers(3)), body)
        return Term(factor, rate, int(self.rng.integers(2)), local(body, self.q, self.place()))

    def load(self, conservative: bool) -> Load:
        """A force element; a conservative one neither dissipates nor drives."""
        body, other = self.body(), int(self.rng.integers(-1, self.count))
        other = GROUND if other == body else other
        damping = 0.0 if conservative or self.rng.random() < 0.3 else self.number(0.1, 2.0)
        kind = self.rng.integers(2) if conservative else self.rng.integers(4)
        if kind == 0:
            first, second, apart = self.two_ends(other, body)
            free = 0.0 if self.rng.random() < 0.25 else apart * self.number(0.5, 1.5)
            return Spring(first, second, self.number(10.0, 200.0), free, damping)
        if kind == 1:
            wound = self.angle(body) - self.angle(other) + self.number(-1.0, 1.0)
            return RotationalSpring(other, body, self.number(0.1, 3.0), wound, 0.05 * damping)
        if kind == 2:
            at, constant = local(body, self.q, self.place()), bool(self.rng.random() < 0.3)
            return Force(at, self.signal(5.0, constant), self.signal(5.0, constant), bool(self.rng.random() < 0.5))
        return Torque(body, other, self.signal(0.5, bool(self.rng.random() < 0.3)))


def is_independent(linkage: Linkage, q: np.ndarray, freedom: int = 0) -> bool:
    """Are the rows well away from dependent, with at least `freedom` degrees of freedom left?"""
    r = rows(linkage, 0.0, q, np.zeros(q.size)).phi_q
    if r.shape[0] + freedom > q.size:
        return False
    r = r / np.maximum(np.linalg.norm(r, axis=1, keepdims=True), 1e-9)
    return bool(not r.size or np.linalg.svd(r, compute_uv=False)[-1] > INDEPENDENT)


def random_mechanism(seed: int) -> Case:
    """1 to 6 bodies; every third seed is conservative: springs and gravity only, no drives."""
    rng = np.random.default_rng(50_000 + seed)
    conservative, bodies = seed % 3 == 0, int(rng.integers(1, 7))
    parts = tuple(Body(float(rng.uniform(0.1, 2.0)), float(rng.uniform(1e-3, 2e-2))) for _ in range(bodies))
    q = rng.uniform(-0.3, 0.3, 3 * bodies)
    q[2::3] = rng.uniform(-np.pi, np.pi, bodies)
    gravity = (0.0, 0.0) if rng.random() < 0.2 else (float(rng.uniform(-2.0, 2.0)), -9.81)
    make, linkage = _Maker(rng, q), Linkage(parts, (), gravity=gravity)
    for b in range(bodies):  # the tree
        linkage = _with_joint(make, linkage, int(rng.integers(-1, b)), b)
    for _ in range(int(rng.integers(3)) if bodies > 1 else 0):  # the loops
        one, two = (int(x) for x in rng.choice(bodies, 2, replace=False))
        linkage = _with_joint(make, linkage, GROUND if rng.random() < 0.4 else one, two)
    for _ in range(0 if conservative else int(rng.integers(3))):
        driven = replace(linkage, drives=(*linkage.drives, make.drive()))
        linkage = driven if is_independent(driven, q) else linkage
    loads = tuple(make.load(conservative) for _ in range(rng.integers(4)))
    linkage = replace(linkage, loads=loads)
    return Case(linkage, q, consistent_velocity(rng, linkage, q), seed, tuple(type(j).__name__ for j in linkage.joints))


def _with_joint(make: _Maker, linkage: Linkage, first: int, second: int) -> Linkage:
    """With one joint more if one of three tries leaves the rows independent and a degree of freedom."""
    for _ in range(3):
        ends = (second, first) if make.rng.random() < 0.3 else (first, second)
        more = replace(linkage, joints=(*linkage.joints, make.joint(*ends)))
        if is_independent(more, make.q, freedom=1):
            return more
    return linkage


def near(case: Case, seed: int) -> tuple[float, np.ndarray, np.ndarray]:
    """A state beside the case's own, which need not satisfy the constraints; its rows are independent, too."""
    rng = np.random.default_rng([seed, case.seed])
    while True:
        q = case.q + rng.uniform(-0.03, 0.03, case.q.size)
        apart = [j for j in (*case.linkage.drives, *case.linkage.loads) if isinstance(j, DistanceDrive | Spring)]
        spans = [place(j.first, q, q).r - place(j.second, q, q).r for j in apart]
        if is_independent(case.linkage, q) and all(np.hypot(*span) > 0.2 * APART for span in spans):
            return float(rng.uniform(0.0, 1.0)), q, rng.uniform(-2.0, 2.0, case.q.size)

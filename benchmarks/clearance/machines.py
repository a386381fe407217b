"""Define published linkages for simulations without gudgeon, with independent copies of all values."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from benchmarks.clearance.guided import Guided
from benchmarks.clearance.rigid import Rigid
from benchmarks.clearance.second import Joint, Pin, Second
from tests.oracles import dry
from tests.oracles.linkage_joints import CoordinateDrive
from tests.oracles.numpy_linkage import GROUND, Body, Drive, End, Linkage, Play, Revolute, Translational, Wave
from tests.oracles.press_dense import Press

DEGREE = math.pi / 180.0


class Chain:
    """Bars by index, with ends in frames of their centres, and guesses of their positions."""

    def __init__(self, lengths: Mapping[int, float]) -> None:
        """Store the lengths in m."""
        self.lengths = lengths

    def tail(self, k: int) -> End:
        """Return the tail of a bar."""
        return End(k, (-self.lengths[k] / 2.0, 0.0))

    def head(self, k: int) -> End:
        """Return the head of a bar."""
        return End(k, (self.lengths[k] / 2.0, 0.0))

    def middle(self, k: int, tail: tuple[float, float], degrees: float) -> list[float]:
        """Return x, y and angle of a bar from the position of its tail and its angle in degrees."""
        angle = degrees * DEGREE
        half = self.lengths[k] / 2.0
        return [tail[0] + half * math.cos(angle), tail[1] + half * math.sin(angle), angle]


def pin(at: tuple[float, float], end: End) -> Revolute:
    """Return a revolute joint with the ground."""
    return Revolute(End(GROUND, at), end)


def press(speed: float, clearance: float, young: float, viscosity: float) -> tuple[Second, list[float]]:
    """Return the press and a guess of its coordinates.

    Bodies: L1, L2, L3, L4, L6, L7, L8, S9; play between L1 and L2 (A), and between L4 and L3 (B).
    """
    data = Press().at_speed(speed)
    g = data.geometry
    links = Chain(dict(enumerate((g.l1, g.l2, g.l3, g.l4, g.l6, g.l7, g.l8))))
    slider = End(7, (0.0, 0.0))
    joints = (
        pin((0.0, 0.0), links.tail(0)),
        pin((0.0, -g.l5), links.tail(3)),
        pin((g.hx, g.hy), links.tail(4)),
        Revolute(links.head(1), links.tail(5)),
        Revolute(links.head(2), links.tail(5)),
        Revolute(links.head(5), links.head(4)),
        Revolute(links.head(5), links.tail(6)),
        Revolute(links.head(6), slider),
        Translational(End(GROUND, (g.hx, g.hy)), slider, (0.0, 1.0), math.pi / 2.0),
    )
    drives = (Drive(0, GROUND, Wave(g.theta1, g.omega1)), Drive(3, GROUND, Wave(g.theta4, g.omega4)))
    bodies = tuple(Body(m, j) for m, j in zip(data.mass, data.inertia, strict=True))
    linkage = Linkage(bodies, joints, drives, (), (0.0, -data.gravity))
    law = Pin(clearance=clearance, young=young, viscosity=viscosity)
    ends = ((links.head(0), links.tail(1)), (links.head(3), links.tail(2)))
    plays = [Joint(Play(one, two, law), law) for one, two in ends]
    guess = [
        *links.middle(0, (0.0, 0.0), -39.52),
        *links.middle(1, (0.06, -0.05), -39.5),
        *links.middle(2, (-0.075, -0.327), 19.5),
        *links.middle(3, (0.0, -0.3), 199.47),
        *links.middle(4, (0.5, 0.0), -90.0),
        *links.middle(5, (0.254, -0.21), 7.0),
        *links.middle(6, (0.5, -0.18), -90.0),
        0.5,
        -0.48,
        90.0 * DEGREE,
    ]
    return Second(linkage, plays), guess


def slider_crank(
    masses: Sequence[float], inertias: Sequence[float], law: Pin, drive: Wave, gravity: float = 0.0
) -> tuple[Second, list[float]]:
    """Return a slider-crank and a guess: crank of 50 mm, rod of 120 mm; play between rod and slider."""
    links, slider = Chain({0: 0.05, 1: 0.12}), End(2, (0.0, 0.0))
    joints = (
        pin((0.0, 0.0), links.tail(0)),
        Revolute(links.head(0), links.tail(1)),
        Translational(End(GROUND, (0.0, 0.0)), slider, (1.0, 0.0), 0.0),
    )
    bodies = tuple(Body(m, j) for m, j in zip(masses, inertias, strict=True))
    linkage = Linkage(bodies, joints, (Drive(0, GROUND, drive),), (), (0.0, -gravity))
    angle = drive.a
    across = -math.asin(5.0 / 12.0 * math.sin(angle))
    tip = (0.05 * math.cos(angle), 0.05 * math.sin(angle))
    guess = [
        *links.middle(0, (0.0, 0.0), angle / DEGREE),
        *links.middle(1, tip, across / DEGREE),
        tip[0] + 0.12 * math.cos(across),
        0.0,
        0.0,
    ]
    return Second(linkage, [Joint(Play(links.head(1), slider, law), law)]), guess


@dataclass(frozen=True)
class Cosine:
    """Function of time a + b cos(w t)."""

    a: float
    b: float
    w: float

    def value(self, t: float) -> float:
        """Return the value at t."""
        return self.a + self.b * math.cos(self.w * t)

    def rate(self, t: float) -> float:
        """Return the first derivative at t."""
        return -self.b * self.w * math.sin(self.w * t)

    def acceleration(self, t: float) -> float:
        """Return the second derivative at t."""
        return -self.b * self.w**2 * math.cos(self.w * t)


def landing_gear() -> tuple[Second, list[float]]:
    """Return a landing gear (crosshead, link, plate, brace, leg) and a guess.

    Play between plate and brace (A), and between brace and leg (B).
    """
    links = Chain({1: 0.7, 3: 1.08, 4: 1.2})
    crosshead, brace_on_leg = End(0, (0.0, 0.0)), End(4, (0.36 - 0.6, 0.0))
    joints = (
        Translational(End(GROUND, (0.0, 1.5)), crosshead, (0.0, 1.0), 0.0),
        Revolute(crosshead, links.tail(1)),
        Revolute(links.head(1), End(2, (0.0, -0.514))),
        pin((1.0, 1.85), End(2, (0.0, 0.49))),
        pin((1.45, 1.05), links.tail(4)),
    )
    bodies = (Body(7.66, 2.422e-2), Body(23.51, 1.137), Body(147.94, 12.98), Body(39.16, 4.291), Body(140.77, 10.76))
    drives = (CoordinateDrive(0, 1, Cosine(1.5, 0.3, math.pi)),)
    linkage = Linkage(bodies, joints, drives, (), (0.0, -9.8))
    law = Pin(radius=0.01, clearance=0.05e-3, width=0.015, young=200e9, sign=-1, mu=0.2, v0=1e-3, v1=5e-2)
    ends = ((End(2, (0.723, 0.0)), links.tail(3)), (links.head(3), brace_on_leg))
    turned = -128.0 * DEGREE
    plate = (1.0 + 0.49 * math.sin(turned), 1.85 - 0.49 * math.cos(turned))
    at = (plate[0] + 0.723 * math.cos(turned), plate[1] + 0.723 * math.sin(turned))
    guess = [
        0.0,
        1.8,
        0.0,
        *links.middle(1, (0.0, 1.8), 73.0),
        *plate,
        turned,
        *links.middle(3, at, -31.0),
        *links.middle(4, (1.45, 1.05), -175.0),
    ]
    return Second(linkage, [Joint(Play(one, two, law), law) for one, two in ends]), guess


def corners(pq: float, qr: float, pr: float, side: int) -> tuple[list[tuple[float, float]], float]:
    """Return the corners of a triangle with sides pq, qr, pr from its centroid, and the sum of their squares.

    side: 1 or −1, the side of pq on which the third corner is.
    """
    along = (pq**2 + pr**2 - qr**2) / (2.0 * pq)
    raw = np.array([[0.0, 0.0], [pq, 0.0], [along, side * math.sqrt(pr**2 - along**2)]])
    return [(float(x), float(y)) for x, y in raw - raw.mean(axis=0)], pq**2 + qr**2 + pr**2


def jansen(pins: int) -> tuple[Second, list[float]]:
    """Return Jansen's leg with play in one or two pins of the crank, and a guess."""
    length = {0: 0.15, 1: 0.5, 2: 0.619, 4: 0.393, 5: 0.394}
    links = Chain(length)
    upper, of_upper = corners(0.415, 0.558, 0.401, 1)
    lower, of_lower = corners(0.367, 0.49, 0.657, -1)
    mass = {0: 0.15, 1: 0.5, 2: 0.619, 3: 2.0, 4: 0.393, 5: 0.394, 6: 2.0}
    inertia = {k: mass[k] * length[k] ** 2 / 12.0 for k in length}
    inertia |= {3: 2.0 * of_upper / 36.0, 6: 2.0 * of_lower / 36.0}
    y = (-0.38, -0.078)
    joints = (
        pin((0.0, 0.0), links.tail(0)),
        pin(y, End(3, upper[0])),
        Revolute(links.head(1), End(3, upper[1])),
        pin(y, links.tail(4)),
        Revolute(links.head(2), links.head(4)),
        Revolute(End(3, upper[2]), links.tail(5)),
        Revolute(links.head(5), End(6, lower[0])),
        Revolute(End(6, lower[1]), links.head(4)),
    )
    drives = (Drive(0, GROUND, Wave(0.0, 2.0 * math.pi)),)
    linkage = Linkage(tuple(Body(mass[k], inertia[k]) for k in range(7)), joints, drives, (), (0.0, -9.81))
    stiffness = dry.stiffness(0.01, 0.01 - 0.2e-3, (110e9, 207e9), (0.34, 0.3))  # steel in bronze
    law = Pin(radius=0.01, clearance=0.2e-3, width=0.02, restitution=0.8, mu=0.1, v0=1e-3, v1=1e-2, stiffness=stiffness)
    linkage = replace(linkage, joints=(*joints, *(Revolute(links.head(0), links.tail(k)) for k in (1, 2)[pins:])))
    plays = [Joint(Play(links.head(0), links.tail(k), law), law) for k in (1, 2)[:pins]]
    return Second(linkage, plays), _jansen_guess(links, upper, lower, y)


def _jansen_guess(
    links: Chain, upper: Sequence[tuple[float, float]], lower: Sequence[tuple[float, float]], y: tuple[float, float]
) -> list[float]:
    """Return the coordinates at θ = 0 of the crank, by intersections of circles on the branch of the file's guess."""

    def meet(one: np.ndarray, first: float, two: np.ndarray, second: float, side: int) -> np.ndarray:
        """Return an intersection of two circles, on one side of the line of their centres."""
        d = two - one
        along = (d @ d + first**2 - second**2) / (2.0 * d @ d)
        return one + along * d + side * math.sqrt(first**2 / (d @ d) - along**2) * np.array([-d[1], d[0]])

    def angle(start: np.ndarray, end: np.ndarray) -> float:
        """Return the direction from start to end in rad."""
        return math.atan2(*(end - start)[::-1])

    def triangle(at: np.ndarray, turned: float, own: Sequence[tuple[float, float]]) -> list[float]:
        """Return x, y and angle of a triangle from the position of its first corner and its angle."""
        a = np.array([[math.cos(turned), -math.sin(turned)], [math.sin(turned), math.cos(turned)]])
        return [*(at - a @ np.array(own[0])), turned]

    x, fixed = np.array([0.15, 0.0]), np.array(y)
    w, v = meet(x, 0.5, fixed, 0.415, -1), meet(x, 0.619, fixed, 0.393, 1)
    u = meet(fixed, 0.401, w, 0.558, 1)
    t = meet(u, 0.394, v, 0.367, -1)
    return [
        0.075,
        0.0,
        0.0,
        *((x + w) / 2.0),
        angle(x, w),
        *((x + v) / 2.0),
        angle(x, v),
        *triangle(fixed, angle(fixed, w), upper),
        *((fixed + v) / 2.0),
        angle(fixed, v),
        *((u + t) / 2.0),
        angle(u, t),
        *triangle(t, angle(t, v), lower),
    ]


@dataclass(frozen=True)
class Led:
    """Torque on the crank (body 0) that tracks the angle reach sin(pace t), computed from the ideal four-bar at the
    crank's angle.

    lengths: ground, crank, coupler, rocker (m), each of `mass` (kg); `rate` (1/s) and `gain` (N m s) of the deviation.
    """

    lengths: tuple[float, float, float, float]
    mass: float
    gravity: float
    reach: float
    pace: float
    rate: float
    gain: float

    def potential(self, q: np.ndarray) -> float:
        """Return the potential energy, 0."""
        return 0.0

    def angles(self, theta: float) -> tuple[float, float]:
        """Return the angles of the coupler (α) and the rocker (φ), by the half-angle tangent of φ."""
        l0, l1, l2, l3 = self.lengths
        k1, k2 = -2.0 * l1 * l3 * math.sin(theta), 2.0 * l3 * (l0 - l1 * math.cos(theta))
        k3 = l0**2 + l1**2 - l2**2 + l3**2 - 2.0 * l0 * l1 * math.cos(theta)
        phi = 2.0 * math.atan2(-k1 - math.sqrt(k1**2 + k2**2 - k3**2), k3 - k2)
        up, across = l3 * math.sin(phi) - l1 * math.sin(theta), l0 + l3 * math.cos(phi) - l1 * math.cos(theta)
        return math.atan2(up, across), phi

    def torque(self, t: float, theta: float, omega: float) -> float:
        """Return the torque in N·m."""
        _, l1, l2, l3 = self.lengths
        alpha, phi = self.angles(theta)
        sine, cosine = math.sin(alpha - phi), math.cos(alpha - phi)
        a, b = l1 * math.sin(phi - theta) / (l2 * sine), l1 * math.sin(alpha - theta) / (l3 * sine)
        da = (l1 * math.cos(phi - theta) * (b - 1.0) - l2 * cosine * a * (a - b)) / (l2 * sine)
        db = (l1 * math.cos(alpha - theta) * (a - 1.0) - l3 * cosine * b * (a - b)) / (l3 * sine)
        j = [self.mass * length**2 / 12.0 for length in (l1, l2, l3)]  # about the middle, a quarter of that at an end
        p, cross = 0.5 * self.mass * l1 * l2, math.cos(alpha - theta)
        inertia = 4.0 * (j[0] + j[1] * a**2 + j[2] * b**2) + self.mass * l1**2 + 2.0 * p * cross * a
        curving = 4.0 * j[1] * a * da + 2.0 * j[2] * b * db  # half of the rocker's term, as in the source
        curving += p * (cross * da + a * (1.0 - a) * math.sin(alpha - theta))
        angle, w = self.pace * t, self.pace
        e, rate = theta - self.reach * math.sin(angle), omega - self.reach * w * math.cos(angle)
        weights = 1.5 * l1 * math.cos(theta) + 0.5 * l2 * a * math.cos(alpha) + 0.5 * l3 * b * math.cos(phi)
        return (
            inertia * (-self.reach * w**2 * math.sin(angle) - self.rate * rate)
            + curving * omega * (omega - self.rate * e)
            - self.gain * (rate + self.rate * e)
            + self.mass * self.gravity * weights
        )

    def forces(self, t: float, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Return the generalized forces."""
        g = np.zeros(q.size)
        g[2] = self.torque(t, q[2], v[2])
        return g


def four_bar() -> tuple[Rigid, list[float]]:
    """Return a four-bar and its start; rigid play between crank and coupler, coupler and rocker, rocker and ground."""
    lengths = (3.0, 1.0, 4.0, 2.5)
    links = Chain(dict(enumerate(lengths[1:])))
    law = Pin(radius=0.06, clearance=5e-3, mu=0.1, v0=1e-3)
    ends = ((links.tail(1), links.head(0)), (links.head(2), links.head(1)), (End(GROUND, (3.0, 0.0)), links.tail(2)))
    led = Led(lengths, 1.0, 9.81, 6.0, 0.75 * 3.14159265, 10.0, 200.0)
    bodies = tuple(Body(1.0, length**2 / 12.0) for length in lengths[1:])
    linkage = Linkage(bodies, (pin((0.0, 0.0), links.tail(0)),), gravity=(0.0, -9.81), loads=(led,))
    theta = 1.570823772407980
    guess = [
        0.5 * math.cos(theta),
        0.5 * math.sin(theta),
        theta,
        1.876454585097650,
        1.691962091335582,
        0.3532842020624460,
        3.0 + 0.3764686197082958,
        1.191962183453451,
        1.264872058968431,
    ]
    return Rigid(linkage, [Joint(Play(one, two, law), law) for one, two in ends]), guess


def slider_in_guide() -> tuple[Guided, list[float]]:
    """Return a slider-crank with a guide and its start: released at 150 rad/s with all bars in one line."""
    lengths, speed = (0.153, 0.306), 150.0
    links, slider = Chain(dict(enumerate(lengths))), End(2, (0.0, 0.0))
    joints = (pin((0.0, 0.0), links.tail(0)), Revolute(links.head(0), links.tail(1)), Revolute(links.head(1), slider))
    bodies = (Body(0.038, 7.4e-5), Body(0.038, 5.9e-4), Body(0.076, 2.7e-6))
    linkage = Linkage(bodies, joints, gravity=(0.0, -9.81))
    law = Pin(radius=0.026, clearance=1e-3, mu=0.01, v0=1e-3)
    corners = [(front, upper) for front in (1, -1) for upper in (1, -1)]
    plays = [
        Joint(Play(End(GROUND, (0.0, 0.0)), End(2, (0.05 * front, 0.025 * upper)), law), law)
        for front, upper in corners
    ]
    start = [0.0765, 0.0, 0.0, 0.306, 0.0, 0.0, 0.459, 0.0, 0.0]
    rates = [0.0, 0.0765 * speed, speed, 0.0, 0.0765 * speed, -0.5 * speed, 0.0, 0.0, 0.0]
    upper = tuple(side for _, side in corners)
    return Guided(linkage, plays, upper=upper, half=0.025, restitution=0.4), start + rates

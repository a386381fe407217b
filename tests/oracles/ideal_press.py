r"""The ideal nine-bar press in closed form: three intersections of circles, no iteration.

           O1 (0,0)                       O6 (.5, 0)
            \L1                            |L6
             A---L2---.                    |
                       P-------L7----------Q
             B---L3---'                    |L8
            /L4                            S9  slides on x = .5
           O4 (0,-l5)

    P = circle(A, l2) ∩ circle(B, l3), Q = circle(P, l7) ∩ circle(O6, l6), S9 = circle(Q, l8) ∩ {x = h_x}

Branches (physics of the source, Nonlinear Dynamics, doi 10.1007/s11071-022-07478-4): P to the right of
A→B's foot point, Q below its pivot, the slider below Q. Velocities and accelerations come from differentiating
the circles' equations, (X − C)·(Ẋ − Ċ) = 0 and (X − C)·(Ẍ − C̈) = −|Ẋ − Ċ|², which is two 2×2 solves.
All quantities in SI; every function works on arrays of times.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

BODIES = ("L1", "L2", "L3", "L4", "L6", "L7", "L8", "S9")
DEGREE = np.pi / 180.0


@dataclass(frozen=True)
class PressData:
    """Lengths (m), speeds (rad/s) and initial crank angles (rad) of the press."""

    l1: float = 0.080
    l2: float = 0.250
    l3: float = 0.350
    l4: float = 0.080
    l5: float = 0.300
    l6: float = 0.180
    l7: float = 0.247
    l8: float = 0.300
    hx: float = 0.500
    hy: float = 0.0
    omega1: float = 2.0 * np.pi
    omega4: float = -2.0 * np.pi
    theta1: float = -39.52 * DEGREE
    theta4: float = 199.47 * DEGREE


class Point(NamedTuple):
    """Position (m), velocity (m/s), acceleration (m/s²) of a point; each of shape (2, N)."""

    r: Any
    v: Any
    a: Any


@dataclass(frozen=True)
class Motion:
    """Positions, velocities, accelerations of all bodies, each of shape (N, 24): x, y, θ of BODIES in order.

    x and y are those of the centre of mass (mid-length of a bar).
    """

    q: np.ndarray
    v: np.ndarray
    a: np.ndarray


def _dot(a: Any, b: Any) -> Any:
    return a[0] * b[0] + a[1] * b[1]


def _cross(a: Any, b: Any) -> Any:
    return a[0] * b[1] - a[1] * b[0]


def _solve(row1: Any, row2: Any, b1: Any, b2: Any) -> Any:
    """The vector x with row1·x = b1 and row2·x = b2 (Cramer's rule)."""
    det = _cross(row1, row2)
    return np.array([b1 * row2[1] - b2 * row1[1], row1[0] * b2 - row2[0] * b1]) / det


def crank(origin: tuple[float, float], length: float, angle: Any, speed: float) -> Point:
    """Tip of a crank that turns at constant speed."""
    c, s = np.cos(angle), np.sin(angle)
    r = np.array([origin[0] + length * c, origin[1] + length * s])
    return Point(
        r,
        length * speed * np.array([-s, c]),
        -length * speed**2 * np.array([c, s]),
    )


def intersect(first: Point, radius1: float, second: Point, radius2: float, side: int) -> Point:
    """Intersection of two circles with moving centres; side +1: to the left of first → second, −1: right."""
    d = second.r - first.r
    square = _dot(d, d)
    along = (square + radius1**2 - radius2**2) / (2.0 * square)
    height = np.sqrt(radius1**2 / square - along**2)
    r = first.r + along * d + side * height * np.array([-d[1], d[0]])
    row1, row2 = r - first.r, r - second.r
    v = _solve(row1, row2, _dot(row1, first.v), _dot(row2, second.v))
    w1, w2 = v - first.v, v - second.v
    a = _solve(row1, row2, _dot(row1, first.a) - _dot(w1, w1), _dot(row2, second.a) - _dot(w2, w2))
    return Point(r, v, a)


def slide(point: Point, length: float, x: float) -> Point:
    """End of a rod that hangs from `point` and slides on the vertical line at `x`, below it."""
    dx = x - point.r[0]
    dy = -np.sqrt(length**2 - dx**2)
    wx = -point.v[0]
    wy = -dx * wx / dy  # dx wx + dy wy = 0
    ay = -(wx**2 + wy**2 - dx * point.a[0]) / dy  # dx (−ax) + dy ay = −|w|²
    zero = np.zeros_like(dx)
    return Point(
        np.array([x + zero, point.r[1] + dy]),
        np.array([zero, point.v[1] + wy]),
        np.array([zero, point.a[1] + ay]),
    )


def _bar(tail: Point, head: Point) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(x, y, θ) of a bar with its centre of mass at mid-length, and two derivatives; shapes (3, N).

    θ is atan2: none of the press's couplers crosses ±180°; the cranks' angles come from the drives.
    """
    d, dv, da = (np.asarray(h) - np.asarray(t) for t, h in zip(tail, head, strict=True))
    square = _dot(d, d)
    omega = _cross(d, dv) / square
    alpha = _cross(d, da) / square
    q, v, a = ((np.asarray(h) + np.asarray(t)) / 2.0 for t, h in zip(tail, head, strict=True))
    return (
        np.array([q[0], q[1], np.arctan2(d[1], d[0])]),
        np.array([v[0], v[1], omega]),
        np.array([a[0], a[1], alpha]),
    )


def points(t: Any, data: PressData | None = None) -> dict[str, Point]:
    """All joint centres at times t (N,): O1, O4, O6, A, B, P, Q, S."""
    d = data or PressData()
    t = np.atleast_1d(np.asarray(t, dtype=float))
    still = np.zeros((2, t.size))
    fixed = {
        name: Point(still + np.array(at)[:, None], still, still)
        for name, at in {"O1": (0.0, 0.0), "O4": (0.0, -d.l5), "O6": (d.hx, d.hy)}.items()
    }
    a = crank((0.0, 0.0), d.l1, d.theta1 + d.omega1 * t, d.omega1)
    b = crank((0.0, -d.l5), d.l4, d.theta4 + d.omega4 * t, d.omega4)
    p = intersect(a, d.l2, b, d.l3, +1)  # left of A → B (which points down) is the right of the drawing
    q = intersect(p, d.l7, fixed["O6"], d.l6, -1)
    return fixed | {"A": a, "B": b, "P": p, "Q": q, "S": slide(q, d.l8, d.hx)}


def motion(t: Any, data: PressData | None = None) -> Motion:
    """All bodies at times t (s), scalar or (N,)."""
    d = data or PressData()
    t = np.atleast_1d(np.asarray(t, dtype=float))
    p = points(t, d)
    ends = {
        "L1": ("O1", "A"),
        "L2": ("A", "P"),
        "L3": ("B", "P"),
        "L4": ("O4", "B"),
        "L6": ("O6", "Q"),
        "L7": ("P", "Q"),
        "L8": ("Q", "S"),
    }
    bars = {name: _bar(p[tail], p[head]) for name, (tail, head) in ends.items()}
    for name, angle, speed in (("L1", d.theta1, d.omega1), ("L4", d.theta4, d.omega4)):
        bars[name][0][2], bars[name][1][2], bars[name][2][2] = angle + speed * t, speed, 0.0
    still = np.zeros(t.size)
    s = p["S"]
    bars["S9"] = (
        np.array([*s.r, still + np.pi / 2.0]),  # the guide's angle: 90° ("θ9 − 90°" of the source's Eq. 19)
        np.array([*s.v, still]),
        np.array([*s.a, still]),
    )
    q, v, a = (np.concatenate([bars[name][i] for name in BODIES]).T for i in range(3))
    return Motion(q, v, a)


def slider_mp(t: Any, data: PressData | None = None, digits: int = 50) -> tuple[Any, Any, Any]:
    """y9, its velocity and acceleration at one time in `digits` digits, derivatives by mpmath.diff.

    A second route to `motion`: positions by the cosine rule in angles (not by intersecting coordinates), then
    numerical differentiation in high precision (not by differentiating the circles).
    """
    import mpmath as mp

    d = data or PressData()
    with mp.workdps(digits):

        def third(ax: Any, ay: Any, ra: Any, bx: Any, by: Any, rb: Any, side: int) -> tuple[Any, Any]:
            distance = mp.hypot(bx - ax, by - ay)
            angle = mp.atan2(by - ay, bx - ax) + side * mp.acos((ra**2 + distance**2 - rb**2) / (2 * ra * distance))
            return ax + ra * mp.cos(angle), ay + ra * mp.sin(angle)

        def y9(time: Any) -> Any:
            l1, l2, l3, l4, l5, l6, l7, l8, hx, hy = map(
                mp.mpf, (d.l1, d.l2, d.l3, d.l4, d.l5, d.l6, d.l7, d.l8, d.hx, d.hy)
            )
            a1, a4 = mp.mpf(d.theta1) + d.omega1 * time, mp.mpf(d.theta4) + d.omega4 * time
            px, py = third(l1 * mp.cos(a1), l1 * mp.sin(a1), l2, l4 * mp.cos(a4), -l5 + l4 * mp.sin(a4), l3, +1)
            qx, qy = third(px, py, l7, hx, hy, l6, -1)
            return qy - mp.sqrt(l8**2 - (hx - qx) ** 2)

        time = mp.mpf(t)
        return y9(time), mp.diff(y9, time), mp.diff(y9, time, 2)

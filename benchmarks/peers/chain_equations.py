"""State the equations of pendulums of several links in two forms, and compute reference solutions in long double.

Links of length l, mass m and moment of inertia J about their middles hang from each other, theta from the x axis:

    sum_j c_ij cos(theta_i - theta_j) theta_j'' + c_ij sin(theta_i - theta_j) theta_j'^2 = -g w_i cos theta_i,

c_ij = m l^2 (n - max(i, j) - 1/2) for i != j, c_ii = J + m l^2 (n - i - 3/4), w_i = m l (n - i - 1/2), i = 0 ... n - 1.
`accelerations` solves this system by L D L^T, in O(n^3) operations. `recursive_accelerations` needs O(n): the
articulated-body algorithm (R. Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 7), written for links in a
plane. Both take numbers, arrays or expressions of another program, whose functions sin and cos are arguments.

Error: the largest error of an angle at the end, over all runs. Reference: Gragg's midpoint rule extrapolated to order
16, in long double. With fewer steps the difference is 4e-16 for 2 links, 3e-11 for 6, and
to the value in chain_angles.json for 64 links. `python -m benchmarks.peers.chain_equations` writes that file.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable
from functools import cache, reduce
from operator import add
from pathlib import Path
from typing import Any

import numpy as np

ANGLES = Path(__file__).with_name("chain_angles.json")
WORKS = {"double": 2, "links": 6, "chain": 64}  # number of links of each problem of the race
T_END = {2: 3.0, 6: 1.5, 64: 1.0}  # s
STEPS = {2: 200, 6: 200, 64: 120}  # of the reference
M, L, J, G = 1.0, 1.0, 0.1, 9.81  # kg, m, kg m^2, m/s^2
RECURSIVE = 16  # links: from here on, equations for other programs have the form of O(n)
SPREAD = 1e-3  # rad: difference of the first angle between two runs of a batch
AMPLITUDE, WAVE = 0.4, 16  # rad, links: a long chain hangs down in waves


def starts(n: int, runs: int = 1) -> np.ndarray:
    """Return initial angles, then velocities (2n, runs); a long chain is a wave, a short one is curved."""
    wave = [AMPLITUDE * math.sin(2.0 * math.pi * (k + 0.5) / WAVE) - 0.5 * math.pi for k in range(n)]
    angles = wave if n >= RECURSIVE else [0.5 * k for k in range(n)]
    y = np.repeat([[angle] for angle in angles] + [[0.0]] * n, runs, axis=1)
    y[0] += SPREAD * np.arange(runs)
    return y


def coefficients(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Return c (n, n) and w (n,)."""
    i = np.arange(n)
    c = M * L**2 * (n - np.maximum.outer(i, i) - 0.5)
    np.fill_diagonal(c, J + M * L**2 * (n - i - 0.75))
    return c, M * L * (n - i - 0.5)


def accelerations(theta: Any, omega: Any, sin: Any, cos: Any) -> list[Any]:
    """Return the accelerations by L D L^T of the matrix, for numbers or expressions."""
    n = len(theta)
    c, w = (some.tolist() for some in coefficients(n))
    x = [-G * w[i] * cos(theta[i]) for i in range(n)]
    for i in range(n):
        for j in range(n):
            if i != j:
                x[i] = x[i] - c[i][j] * sin(theta[i] - theta[j]) * (omega[j] * omega[j])
    low: dict[tuple[int, int], Any] = {}
    own: list[Any] = []
    for i in range(n):
        row: list[Any] = []
        for j in range(i):
            row.append(c[i][j] * cos(theta[i] - theta[j]) - sum_of(row[k] * low[j, k] for k in range(j)))
            low[i, j] = row[j] / own[j]
        own.append(c[i][i] - sum_of(row[k] * low[i, k] for k in range(i)))
        x[i] = x[i] - sum_of(low[i, k] * x[k] for k in range(i))
    for i in reversed(range(n)):
        x[i] = x[i] / own[i] - sum_of(low[k, i] * x[k] for k in range(i + 1, n))
    return x


def sum_of(terms: Iterable[Any]) -> Any:
    """Return the sum of terms; 0.0 without terms."""
    return reduce(add, terms) if (terms := list(terms)) else 0.0


Keep = Callable[[Any], Any]
Carried = tuple[Any, ...]


def keep_expression(value: Any) -> Any:
    """Return the value: the default of `keep`, with which another program may name partial results."""
    return value


def go_inward(
    carried: Carried, theta: Any, omega: Any, sin: Any, cos: Any, keep: Keep = keep_expression
) -> tuple[Carried, Carried]:
    """Return A, b of a link from those of the next link, and the values of the link that `go_outward` needs.

    The force on the tail of a link is A a + b, a being the acceleration of the tail. With u = (cos, sin) and
    n = (-sin, cos): theta'' = -(w a + e)/D, D = J + m l^2/4 + l^2 n A' n, w = m l/2 n + l A' n,
    e = l n (b' - l theta'^2 A' u) + m l g cos/2; ' marks the next link.
    """
    a11, a12, a22, b1, b2 = carried
    c, s = keep(cos(theta)), keep(sin(theta))
    p1, p2 = keep(a12 * c - a11 * s), keep(a22 * c - a12 * s)  # A' n
    d = keep(L * (omega * omega))
    q1, q2 = keep(b1 - d * (a11 * c + a12 * s)), keep(b2 - d * (a12 * c + a22 * s))  # b' - l theta'^2 A' u
    inverse = keep(1.0 / (J + 0.25 * M * L * L + L * L * (c * p2 - s * p1)))
    w1, w2 = keep(L * p1 - 0.5 * M * L * s), keep(L * p2 + 0.5 * M * L * c)
    e = keep(L * (c * q2 - s * q1) + 0.5 * M * L * G * c)
    half, f1, f2 = 0.5 * M * d, keep(w1 * inverse), keep(w2 * inverse)
    inertia = keep(M + a11 - w1 * f1), keep(a12 - w1 * f2), keep(M + a22 - w2 * f2)
    bias = keep(q1 - half * c - e * f1), keep(q2 - half * s + M * G - e * f2)
    return (*inertia, *bias), (c, s, d, w1, w2, e, inverse)


def go_outward(tail: Carried, link: Carried, keep: Keep = keep_expression) -> tuple[Carried, Any]:
    """Return the acceleration of a link's head from that of the tail, and the angular acceleration."""
    (x1, x2), (c, s, d, w1, w2, e, inverse) = tail, link
    alpha = keep(-(w1 * x1 + w2 * x2 + e) * inverse)
    return (keep(x1 - L * alpha * s - d * c), keep(x2 + L * alpha * c - d * s)), alpha


def recursive_accelerations(theta: Any, omega: Any, sin: Any, cos: Any, keep: Keep = keep_expression) -> list[Any]:
    """Return the accelerations from articulated inertias, tip to root and back."""
    n, carried, tail, found = len(theta), (0.0,) * 5, (0.0, 0.0), []
    links: list[Carried] = [()] * n
    for i in reversed(range(n)):
        carried, links[i] = go_inward(carried, theta[i], omega[i], sin, cos, keep)
    for link in links:
        tail, alpha = go_outward(tail, link, keep)
        found.append(alpha)
    return found


def equations(theta: Any, omega: Any, sin: Any, cos: Any, keep: Keep = keep_expression) -> list[Any]:
    """Return the accelerations in the form that suits the number of links."""
    if len(theta) >= RECURSIVE:
        return recursive_accelerations(theta, omega, sin, cos, keep)
    return accelerations(theta, omega, sin, cos)


def energy(y: np.ndarray) -> np.ndarray:
    """Return the energy in J of states (2n, ...): angles, then velocities; zero height is the pivot's."""
    theta, omega = np.split(np.asarray(y), 2)
    x, height = -L * np.sin(theta) * omega, L * np.sin(theta)
    z = L * np.cos(theta) * omega
    vx, vz = np.cumsum(x, axis=0) - 0.5 * x, np.cumsum(z, axis=0) - 0.5 * z
    up = np.cumsum(height, axis=0) - 0.5 * height
    return (0.5 * M * (vx**2 + vz**2) + 0.5 * J * omega**2 + M * G * up).sum(axis=0)


@cache
def reference(n: int, runs: int = 1) -> np.ndarray:
    """Return the reference angles at the end (n, runs); those of a long chain are stored in ANGLES."""
    if n >= RECURSIVE:
        return np.array(json.loads(ANGLES.read_text())["angles"])[:, None]
    return extrapolated(n, runs, STEPS[n])


def extrapolated(n: int, runs: int, steps: int) -> np.ndarray:
    """Return the angles at the end (n, runs) by the extrapolated midpoint rule in long double."""
    y = starts(n, runs).astype(np.longdouble)
    h = np.longdouble(T_END[n]) / steps

    def rate(y: np.ndarray) -> np.ndarray:
        """Return y'."""
        return np.array([*y[n:], *equations(y[:n], y[n:], np.sin, np.cos)], dtype=np.longdouble)

    for _ in range(steps):
        rows: list[list[np.ndarray]] = []
        for count in range(2, 17, 2):
            before, now, part = y, y + h / count * rate(y), h / count
            for _ in range(count - 1):
                before, now = now, before + 2 * part * rate(now)
            row = [(before + now + part * rate(now)) / 2]
            for k, last in enumerate(rows[-1] if rows else [], 1):
                row.append(row[-1] + (row[-1] - last) / ((count / np.longdouble(count - 2 * k)) ** 2 - 1))
            rows.append(row)
        y = rows[-1][-1]
    return y[:n].astype(float)


def error(n: int, theta: np.ndarray) -> float:
    """Return the largest error of an angle (n,) at the end of one run."""
    return float(np.abs(np.asarray(theta) - reference(n)[:, 0]).max())


def main() -> None:
    """Store the reference of the long chain; print the difference of each reference from that with fewer steps."""
    for name, n in WORKS.items():
        angles = extrapolated(n, 1, STEPS[n])
        gap = float(np.abs(angles - extrapolated(n, 1, STEPS[n] * 2 // 3)).max())
        print(f"{name}: {gap:.1e}")
        if n >= RECURSIVE:
            about = f"Angles (rad) of a chain of {n} links at t = {T_END[n]} s; see chain_equations.py."
            data = {"about": about, "differs_from_fewer_steps_by": gap, "angles": angles[:, 0].tolist()}
            ANGLES.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

"""Simulate a slider with clearance in a fixed guide without gudgeon: rigid corners that bounce, as a reference.

It extends rigid.py, whose joints with play are corners here. End `second` is the corner, End `first` a point of the
guide's middle line, n the outward normal of its wall. If a gap closes at the rate u, the impact leaves the rate −e u,
or 0 below the threshold. Other touching contacts must not penetrate.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from benchmarks.clearance.rigid import RESTING, SLIDES, Gap, Rigid, subsets
from benchmarks.clearance.second import Joint
from tests.oracles.numpy_linkage import TURN, mass, place, rows


@dataclass
class Guided(Rigid):
    """Corners with one wall each: `upper` is 1 or −1 by joint; `half`: half of the slider's height, m; restitution
    e."""

    upper: tuple[int, ...] = ()
    half: float = 0.0
    restitution: float = 0.0
    threshold: float = 1e-4

    def gap(self, joint: Joint, q: np.ndarray, v: np.ndarray) -> Gap:
        """Return the gap of a corner."""
        normal = self.normal(joint)
        one, two = place(joint.play.first, q, v), place(joint.play.second, q, v)
        row, slip_row = normal @ two.r_q, (TURN @ normal) @ two.r_q
        delta = float(normal @ (two.r - one.r)) - self.half - joint.law.clearance
        return Gap(delta, float(row @ v), row, float(normal @ two.quadratic), slip_row, float(slip_row @ v))

    def normal(self, joint: Joint) -> np.ndarray:
        """Return the outward normal of a corner's wall."""
        k = next(i for i, own in enumerate(self.joints) if own is joint)
        return np.array([0.0, float(self.upper[k])])

    def _of(self, t: float, q: np.ndarray, v: np.ndarray) -> tuple[list[np.ndarray], list[np.ndarray]]:
        """Return the eccentricity of each corner and the force on it."""
        pressed = self.accelerations(t, q, v, sorted(self.closed))[1]
        places, on_slider = [], []
        for k, (joint, gap) in enumerate(zip(self.joints, self.gaps(q, v), strict=True)):
            n = self.normal(joint)
            places.append((gap.delta + joint.law.clearance) * n)
            on_slider.append(-pressed.get(k, 0.0) * (n + self.friction(k, gap.slip) * (TURN @ n)))
        return places, on_slider

    def start(self, guess: np.ndarray) -> np.ndarray:
        """Return given coordinates and velocities. Raises ValueError if the linkage is not closed."""
        y = np.array(guess, dtype=float)
        n = y.size // 2
        found = rows(self.linkage, 0.0, y[:n], y[n:])
        if abs(found.phi).max() > 1e-14 or abs(found.phi_q @ y[n:] - found.nu).max() > 1e-12:
            raise ValueError("the linkage is not closed here")
        return y

    def blow(self, t: float, q: np.ndarray, v: np.ndarray, touching: list[int]) -> np.ndarray:
        """Return the velocities after an impact of the touching corners. Raises ValueError if no impulses are
        consistent.
        """
        gaps = self.gaps(q, v)
        near = [k for k in touching if gaps[k].rate >= -RESTING]  # others part already
        back = {k: self.restitution * gaps[k].rate for k in near}
        left = {k: -x if gaps[k].rate > RESTING and x > self.threshold else 0.0 for k, x in back.items()}
        pressed, smooth = next(
            (held, w)
            for held in subsets(near)
            for w, normal, _ in [self._bounce(t, q, v, gaps, held, {}, left)]
            if min(normal, default=0.0) >= 0.0 and all(gaps[k].row @ w < left[k] + RESTING for k in near)
        )
        ratio = {k: abs(self.friction(k, float(gaps[k].slip_row @ smooth))) for k in pressed}
        for way in product((0.0, *SLIDES), repeat=len(pressed)):  # 0: it sticks
            if (
                way.count(0.0) > 1
            ):  # corners of one slider have equal slip: sticking of more than one gives the same motion
                continue
            w, normal, along = self._bounce(
                t,
                q,
                v,
                gaps,
                pressed,
                {k: None if sign == 0.0 else -sign * ratio[k] for k, sign in zip(pressed, way, strict=True)},
                left,
            )
            slides = all(
                sign == 0.0 or sign * (gaps[k].slip_row @ w) > 0.0 for k, sign in zip(pressed, way, strict=True)
            )
            sticks = all(abs(P) <= ratio[k] * N for k, N, P in zip(pressed, normal, along, strict=True))
            if min(normal) >= 0.0 and slides and (sticks or 0.0 not in way):
                return w
        raise ValueError("no impulses fit")

    def _bounce(
        self,
        t: float,
        q: np.ndarray,
        v: np.ndarray,
        gaps: list[Gap],
        held: tuple[int, ...],
        along: dict[int, float | None],
        left: dict[int, float],
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return velocities and impulses as `_jump`, with the remaining normal rates `left`."""
        r = rows(self.linkage, t, q, v)
        phi_q = np.vstack([r.phi_q, *(gaps[k].row for k in held)])
        push = np.vstack([r.phi_q, *(gaps[k].row - (along.get(k) or 0.0) * gaps[k].slip_row for k in held)])
        rates = [*r.nu, *(left[k] for k in held)]
        stuck = [k for k in held if k in along and along[k] is None]
        for k in stuck:
            phi_q, push = np.vstack([phi_q, gaps[k].slip_row]), np.vstack([push, -gaps[k].slip_row])
            rates.append(0.0)
        n, m, diagonal = q.size, phi_q.shape[0], mass(self.linkage)
        matrix = np.block([[np.diag(diagonal), push.T], [phi_q, np.zeros((m, m))]])
        x = np.linalg.solve(matrix, np.concatenate([diagonal * v, rates]))
        normal = x[n + r.nu.size :][: len(held)]
        stopping = dict(zip(stuck, x[n + r.nu.size + len(held) :], strict=True))
        return x[:n], normal, np.array([stopping.get(k, (along.get(k) or 0.0) * normal[i]) for i, k in enumerate(held)])

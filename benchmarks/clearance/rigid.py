"""Simulate joints with rigid surfaces without gudgeon: contacts as constraints, plastic impacts; a reference.

Absolute coordinates and multipliers as in second.py, with Signorini's and Coulomb's laws in each joint with play:

    M q̈ + Φ_qᵀ λ_Φ + Σ (δ_q + f s_q)ᵀ λ = g,   Φ_q q̈ = γ,   δ̈ = 0 where closed,   f = μ tanh(s/v0)

with the penetration δ = |e| − c, the slip s of the journal's surface on the bearing's, and the force λ ≥ 0 along the
normal. A step ends where a gap closes or a λ vanishes. An impact has impulses Λ of all touching contacts: δ̇⁺ = 0 of the
pressed ones, and along the surfaces P that stops the slip, or f Λ. All combinations of pressed and sticking contacts
are tried. J. J. Moreau, in: Nonsmooth Mechanics and Applications (1988); F. Pfeiffer, C. Glocker, Multibody
Dynamics with Unilateral Contacts (1996).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from itertools import chain, combinations, product
from typing import Any, NamedTuple

import numpy as np

from benchmarks.clearance.second import STABLE, Joint, Second, ending
from tests.oracles.numpy_linkage import GROUND, TURN, forces, mass, place, rows

SLIDES = (1.0, -1.0)  # signs of the slip after an impact
TOUCHING = 1e-10  # gap over clearance up to which surfaces touch
SHORT = 1e-6  # s
RESTING = 1e-9  # m/s


class Gap(NamedTuple):
    """Gap of a joint with play, with its derivatives."""

    delta: float  # m
    rate: float  # m/s
    row: np.ndarray  # δ_q (n,)
    gamma: float  # δ̈ − δ_q q̈, m/s²
    slip_row: np.ndarray  # s = s_q q̇ (n,)
    slip: float  # m/s


@dataclass
class Rigid(Second):
    """A machine with rigid journals and plastic impacts. `closed`: indices of joints in contact."""

    closed: set[int] = field(default_factory=set)

    def gap(self, joint: Joint, q: np.ndarray, v: np.ndarray) -> Gap:
        """Return the gap of a joint."""
        one, two = place(joint.play.first, q, v), place(joint.play.second, q, v)
        e, rate, e_q = two.r - one.r, two.v - one.v, two.r_q - one.r_q
        size = float(np.hypot(*e))
        n = e / size
        row, slip_row = n @ e_q, (TURN @ n) @ e_q
        for end, arm in (
            (joint.play.second, joint.law.radius - joint.law.clearance),
            (joint.play.first, -joint.law.radius),
        ):
            if end.body != GROUND:
                slip_row[3 * end.body + 2] += arm
        along = float(n @ rate)
        gamma = float(n @ (two.quadratic - one.quadratic)) + (float(rate @ rate) - along**2) / size
        return Gap(size - joint.law.clearance, along, row, gamma, slip_row, float(slip_row @ v))

    def friction(self, k: int, slip: float) -> float:
        """Return F_t/F_n, directed against the slip."""
        law = self.joints[k].law
        return law.mu * math.tanh(slip / law.v0)

    def accelerations(self, t: float, q: np.ndarray, v: np.ndarray, held: Iterable[int]) -> tuple[np.ndarray, Any]:
        """Return q̈ (n,) with the joints `held` closed, and λ of each (N); deviations of Φ and δ decay."""
        r, found, held = rows(self.linkage, t, q, v), self.gaps(q, v), list(held)
        gaps = [found[k] for k in held]
        phi_q = np.vstack([r.phi_q, *(gap.row for gap in gaps)])
        push = np.vstack(
            [r.phi_q, *(gap.row + self.friction(k, gap.slip) * gap.slip_row for k, gap in zip(held, gaps, strict=True))]
        )
        gamma = [r.gamma - 2.0 * STABLE * (r.phi_q @ v - r.nu) - STABLE**2 * r.phi]
        gamma += [np.array([-g.gamma - 2.0 * STABLE * g.rate - STABLE**2 * g.delta]) for g in gaps]
        n, m = q.size, phi_q.shape[0]
        matrix = np.block([[np.diag(mass(self.linkage)), push.T], [phi_q, np.zeros((m, m))]])
        x = np.linalg.solve(matrix, np.concatenate([forces(self.linkage, q, v, t), *gamma]))
        return x[:n], dict(zip(held, x[n + r.phi.size :], strict=True))

    def __call__(self, t: float, y: np.ndarray) -> np.ndarray:
        """Return y' for the integrator."""
        self.calls += 1
        n = y.size // 2
        return np.concatenate([y[n:], self.accelerations(t, y[:n], y[n:], sorted(self.closed))[0]])

    def gaps(self, q: np.ndarray, v: np.ndarray) -> list[Gap]:
        """Return the gaps of all joints."""
        return [self.gap(joint, q, v) for joint in self.joints]

    def start(self, guess: np.ndarray) -> np.ndarray:
        """Return the state at rest at given coordinates. Raises ValueError if the linkage is not closed."""
        q = np.array(guess, dtype=float)
        if abs(rows(self.linkage, 0.0, q, np.zeros(q.size)).phi).max() > 1e-14:
            raise ValueError("the linkage is not closed here")
        return np.concatenate([q, np.zeros(q.size)])

    def _of(self, t: float, q: np.ndarray, v: np.ndarray) -> tuple[list[np.ndarray], list[np.ndarray]]:
        """Return the eccentricity of each joint and the force on its journal."""
        pressed = self.accelerations(t, q, v, sorted(self.closed))[1]
        eccentricities, on_journals = [], []
        for k, (joint, gap) in enumerate(zip(self.joints, self.gaps(q, v), strict=True)):
            e = place(joint.play.second, q, v).r - place(joint.play.first, q, v).r
            n = e / np.hypot(*e)
            eccentricities.append(e)
            on_journals.append(-pressed.get(k, 0.0) * (n + self.friction(k, gap.slip) * (TURN @ n)))
        return eccentricities, on_journals

    def _stride(self, y: np.ndarray) -> float:
        """Return the largest step in s: separating surfaces at most double their distance.

        A step must not lead away from a wall and back into it.
        """
        free = [gap for i, gap in enumerate(self.gaps(*np.split(y, 2))) if i not in self.closed]
        return max(SHORT, min((gap.delta / gap.rate for gap in free if gap.rate < 0.0), default=math.inf))

    def blow(self, t: float, q: np.ndarray, v: np.ndarray, touching: list[int]) -> np.ndarray:
        """Return the velocities after an impact: normal impulses without friction first, then the changes by friction.

        Raises ValueError if no impulses are consistent.
        """
        gaps = self.gaps(q, v)
        pressed, smooth = next(
            (held, w)
            for held in subsets(touching)
            for w, normal, _ in [self._jump(t, q, v, gaps, held, {})]
            if min(normal, default=0.0) >= 0.0 and all(gaps[k].row @ w < RESTING for k in touching)
        )
        ratio = {k: abs(self.friction(k, float(gaps[k].slip_row @ smooth))) for k in pressed}
        for way in product((0.0, *SLIDES), repeat=len(pressed)):  # 0: it sticks
            w, normal, along = self._jump(
                t,
                q,
                v,
                gaps,
                pressed,
                {k: None if sign == 0.0 else -sign * ratio[k] for k, sign in zip(pressed, way, strict=True)},
            )
            slides = all(
                sign == 0.0 or sign * (gaps[k].slip_row @ w) > 0.0 for k, sign in zip(pressed, way, strict=True)
            )
            sticks = all(abs(P) <= ratio[k] * N for k, N, P in zip(pressed, normal, along, strict=True))
            if min(normal) >= 0.0 and slides and (sticks or 0.0 not in way):
                return w
        raise ValueError("no impulses fit")

    def _jump(
        self,
        t: float,
        q: np.ndarray,
        v: np.ndarray,
        gaps: list[Gap],
        held: Iterable[int],
        along: dict[int, float | None],
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return q̇⁺, Λ and P (N s) with δ̇⁺ = 0 of all held joints; `along`: P over Λ, or None if P stops the slip."""
        r, held = rows(self.linkage, t, q, v), list(held)
        phi_q = np.vstack([r.phi_q, *(gaps[k].row for k in held)])
        push = np.vstack([r.phi_q, *(gaps[k].row - (along.get(k) or 0.0) * gaps[k].slip_row for k in held)])
        stuck = [k for k in held if k in along and along[k] is None]
        for k in stuck:
            phi_q, push = np.vstack([phi_q, gaps[k].slip_row]), np.vstack([push, -gaps[k].slip_row])
        n, m = q.size, phi_q.shape[0]
        diagonal = mass(self.linkage)
        matrix = np.block([[np.diag(diagonal), push.T], [phi_q, np.zeros((m, m))]])
        x = np.linalg.solve(matrix, np.concatenate([diagonal * v, r.nu, np.zeros(m - r.nu.size)]))
        normal = x[n + r.nu.size :][: len(held)]
        stopping = dict(zip(stuck, x[n + r.nu.size + len(held) :], strict=True))
        return x[:n], normal, np.array([stopping.get(k, (along.get(k) or 0.0) * normal[i]) for i, k in enumerate(held)])

    def settle(self, t: float, q: np.ndarray, v: np.ndarray, touching: list[int]) -> None:
        """Set the closed contacts among the touching ones, so that λ ≥ 0 and δ̈ ≤ 0. Raises ValueError."""
        resting = [k for k in touching if abs(self.gaps(q, v)[k].rate) < RESTING]
        for held in subsets(resting):
            a, pressed = self.accelerations(t, q, v, held)
            gaps = self.gaps(q, v)
            if min(pressed.values(), default=1.0) > 0.0 and all(
                gaps[k].row @ a + gaps[k].gamma <= 0.0 for k in set(resting) - set(held)
            ):
                self.closed = set(held)
                return
        raise ValueError("no forces fit")

    def _events(self, n: int) -> Iterator[tuple[Any, Callable[[float, np.ndarray, np.ndarray], None]]]:
        """Yield each event function with the change of contacts after its zero."""
        for k, joint in enumerate(self.joints):
            if k in self.closed:

                def contact_force(t: float, y: np.ndarray, k: int = k) -> float:
                    """Return the contact force λ of joint k."""
                    return float(self.accelerations(t, y[:n], y[n:], sorted(self.closed))[1][k])

                def open_contact(t: float, q: np.ndarray, v: np.ndarray, k: int = k) -> None:
                    """Open joint k."""
                    self.settle(t, q, v, sorted(self.closed - {k}))

                yield ending(contact_force, -1.0), open_contact
                continue

            def delta(t: float, y: np.ndarray, joint: Joint = joint) -> float:
                """Return the penetration of a joint."""
                return self.gap(joint, y[:n], y[n:]).delta

            def apply_impact(t: float, q: np.ndarray, v: np.ndarray, k: int = k) -> None:
                """Apply the impact of all touching joints, and store the onsets."""
                known, near = set(self.closed), [-TOUCHING * one.law.clearance for one in self.joints]
                touching = [i for i, gap in enumerate(self.gaps(q, v)) if i in known or gap.delta >= near[i]]
                while any(self.gaps(q, v)[i].rate > RESTING for i in touching):  # friction may bring others to meet
                    v[:] = self.blow(t, q, v, touching)
                self.settle(t, q, v, touching)
                for i in sorted(self.closed - known):
                    self.onsets[i].append(t)

            yield ending(delta, 1.0), apply_impact


def subsets(of: list[int]) -> Iterator[tuple[int, ...]]:
    """Yield all subsets, the largest first."""
    return chain.from_iterable(combinations(of, size) for size in range(len(of), -1, -1))

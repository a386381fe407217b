"""A linkage that does not close: which links are too short or too long, and by how much.

One body at a time is made longer or shorter, its points moving away from its centre of mass, until the rows close
with the least change there is. Where they cannot close, what is left of them is least at some configuration, and there
Φ_qᵀ Φ = 0: no motion makes it smaller, but a change of length s does, by Φᵀ Φ_s. So s follows by Newton's steps on the
norm of what is left.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from gudgeon.assembly.closure import Closure
from gudgeon.assembly.linkage import arm_of
from gudgeon.model.compiled import Array

STEPS = 30
NUDGE = 1e-6  # relative, of a body's length: for the derivative by it
SHUT = 1e-7  # share of the size that is left where a length counts as found
ENDS = {"tail", "head"}
MOST, LEAST = 4.0, -0.95  # times its length: what would have to grow or shrink further is not what is wrong


@dataclass(frozen=True)
class WrongLength:
    """A body that would close the linkage if it alone were longer by `missing` (m); negative: shorter."""

    body: str
    points: tuple[str, str]  # those that joints or drives hold and that lie furthest apart
    length: float  # m, between them
    missing: float

    @property
    def told(self) -> str:
        """The body; with its points where these are not the ends of its length."""
        return self.body if {*self.points} == ENDS else f"{self.body}, {'–'.join(self.points)}"


def wrong_lengths(closure: Closure, q: Array) -> list[WrongLength]:
    """What would close the rows, the least change first. q: where they are nearest to closing."""
    with np.errstate(all="ignore"):
        return sorted(_found(closure, q), key=lambda wrong: abs(wrong.missing))


def _found(closure: Closure, q: Array) -> Iterator[WrongLength]:
    source = closure.linkage.source
    held = {end for part in source.parts if part.section != "forces" for end in part.ends}
    for index, body in enumerate(source.bodies):
        arms = [(p, arm_of(closure.p, p)) for p in source.points if p.body == index and p.name in held]
        apart = {(one, other): float(np.hypot(*(a - b))) for (one, a), (other, b) in combinations(arms, 2)}
        furthest = max(apart, key=apart.__getitem__, default=None)
        if furthest is not None and apart[furthest] > 0.0:
            one, other = (point.name.partition(".")[2] for point in furthest)
            places = sorted({k for point, _ in arms for k in (point.x, point.y) if k >= 0})
            share = _share(closure, q, places)
            if share is not None:
                yield WrongLength(body.name, (one, other), apart[furthest], share * apart[furthest])


def _share(closure: Closure, q: Array, places: list[int]) -> float | None:
    """By which share the numbers at `places` of p must grow so that the rows just close; None: that does not help."""
    p, opens, shut, share = closure.p, 0.0, None, 0.0

    def scaled(by: float) -> Array:
        changed = np.array(p)
        changed[places] *= 1.0 + by
        return changed

    for _ in range(STEPS):
        at = closure.least(q, scaled(share))
        left = closure.residual(at, scaled(share)) / closure.row_scale
        size = float(np.linalg.norm(left))
        if not np.isfinite(size):
            return None
        if size < SHUT:  # it may be more than is needed: what just closes lies between
            if share == opens or abs(share - opens) < NUDGE:
                return share
            shut, share = share, 0.5 * (opens + share)
            continue
        ahead, behind = (closure.residual(at, scaled(share + e)) / closure.row_scale for e in (NUDGE, -NUDGE))
        slope = float(left @ (ahead - behind)) / (2.0 * NUDGE)
        if abs(slope) < 1e-9 * size:
            return shut
        q, opens, share = at, share, share - size**2 / slope
        if shut is not None and not min(opens, shut) < share < max(opens, shut):
            share = 0.5 * (opens + shut)
        if abs(share) > MOST or share <= LEAST:
            return shut
    return shut

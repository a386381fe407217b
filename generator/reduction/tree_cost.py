"""What a tree would cost: operations of its right-hand side, estimated before anything is derived on it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from gudgeon.generator.equations.model import Model
from gudgeon.generator.mechanism.mechanism import GROUND, Joint
from gudgeon.generator.reduction.shared_points import Hub
from gudgeon.generator.sparsity.elimination import choose_elimination

if TYPE_CHECKING:
    from gudgeon.generator.reduction.affine import Affine
    from gudgeon.generator.reduction.links import Link

# operations: an entry of M with its velocity term, an entry of a closure's row, a product of the elimination
PAIR, ENTRY, PRODUCT = 14, 4, 2
LIGHT_END = 10**6  # a body at the end of a chain whose mass is lumped at the joint that carries it
PLAIN = 5  # an entry of M with x or y of a body that moves freely


def _coupled(place: Mapping[str, int], moving: Iterable[frozenset[str]], plain: set[int]) -> list[set[int]]:
    """Who meets whom in M; x and y of a body that moves freely do not."""
    near: list[set[int]] = [set() for _ in place]
    for keys in moving:
        numbers = {place[name] for name in keys}
        for k in numbers:
            near[k] |= numbers - {k} - (plain if k in plain else set())
    return near


class Estimate:
    """Operations of a tree's right-hand side, counted from which coordinates meet where."""

    def __init__(self, model: Model, angles: Mapping[str, Affine], used: frozenset[str], hubs: Sequence[Hub]) -> None:
        self.model, self.hubs = model, hubs
        self._light: dict[tuple[str, str], bool] = {}  # by body and joint
        self.costs: dict[frozenset[tuple[str, str]], int] = {}  # by the joint that places each body
        body_of = {q: body.name for body in model.bodies for q in body.q}
        self.angles = angles
        self.turns = {b: frozenset(k for k in a if k in angles) for b, a in angles.items()}
        said = used.union(*(hub.rows for hub in hubs))
        self.rows = [(r.name, sorted({body_of[q] for q in r.phi_q})) for r in model.rows if r.name not in said]

    def __call__(self, links: tuple[Link, ...]) -> int:
        key = frozenset((link.body, link.joint.name if link.joint else "") for link in links)
        if key not in self.costs:
            self.costs[key] = self._count(links)
        return self.costs[key]

    def _count(self, links: tuple[Link, ...]) -> int:
        held = {row for link in links for row in link.rows}
        paths: dict[str, list[Link]] = {}
        reach: dict[str, frozenset[str]] = {GROUND: frozenset()}  # what a body's points move with
        moving: list[frozenset[str]] = []  # what a centre of mass moves with
        for link in links:
            paths[link.body] = [*paths.get(link.parent, []), link]
            reach[link.body] = reach[link.parent] | self.turns[link.body] | set(link.coordinates)
            moving.append(frozenset(link.coordinates) if link.joint is None else reach[link.body])
        place = {name: k for k, name in enumerate(sorted(frozenset().union(*reach.values())))}
        plain = {place[name] for link in links if link.joint is None for name in link.coordinates}
        near = _coupled(place, moving, plain)
        cost = sum(PLAIN if k in plain or j in plain else PAIR for k, js in enumerate(near) for j in js if j < k)
        open_pairs = [(joint.name, [joint.first.body, joint.second.body]) for joint in self.closing(links)]
        for name, bodies in (*self.rows, *open_pairs, *open_pairs):  # two rows each
            if name not in held:
                keys = {place[key] for key in self._moving(paths, bodies)}
                cost += sum(1 if key in plain else ENTRY for key in keys)
                near.append(keys)
                for key in keys:
                    near[key] = near[key] | {len(near) - 1}
        cost += LIGHT_END * len(self._light_ends(links))
        return cost + PRODUCT * choose_elimination(tuple(map(frozenset, near)), len(place)).cost

    def _light_ends(self, links: tuple[Link, ...]) -> list[Link]:
        """Links whose body carries no other and has hardly any inertia about its joint, or its own centre."""
        carry = {link.parent for link in links}
        ends = [link for link in links if link.body not in carry and set(self.angles[link.body]) == {link.body}]
        return [link for link in ends if not link.slides and self._is_light(link)]

    def _is_light(self, link: Link) -> bool:
        key = link.body, link.joint.name if link.joint else ""
        if key not in self._light:
            self._light[key] = self.model.is_light(link.body, link.joint)
        return self._light[key]

    def closing(self, links: tuple[Link, ...]) -> list[Joint]:
        """Pairs that the hubs need beside the tree's."""
        paths: dict[str, list[Link]] = {}
        for link in links:
            paths[link.body] = [*paths.get(link.parent, []), link]

        def cost(joint: Joint) -> int:
            return len(self._moving(paths, [joint.first.body, joint.second.body]))

        inside = [link.joint for link in links if link.joint]
        return [joint for hub in self.hubs for joint in hub.closing(inside, cost)]

    def _moving(self, paths: Mapping[str, list[Link]], bodies: Sequence[str]) -> set[str]:
        """Coordinates between the bodies of a row: what they share of their way from the root does not count."""
        shared = 0
        if len(bodies) == 2:
            one, two = (paths.get(b, []) for b in bodies)
            parted = (k for k, (a, b) in enumerate(zip(one, two, strict=False)) if a is not b)
            shared = max(next(parted, min(len(one), len(two))) - 1, 0)
        links = [link for b in bodies for link in paths.get(b, [])[shared:]]
        return {key for link in links for key in (*self.turns[link.body], *link.coordinates)}

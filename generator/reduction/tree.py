"""Tree coordinates of a linkage: angles that are free, and a spanning tree of joints that position the bodies.

Equations that are linear in angles with constant coefficients (a weld, a slide, gears, a driven angle) express angles
by others. The other joints form a graph of bodies; along a spanning tree of it each body is positioned by its
parent, and only the joints that are not in the tree stay as loop closures (R. Featherstone, Rigid Body Dynamics
Algorithms, 2008, chapters 4 and 8). Angles are absolute: in the plane the position of a point is then a sum of
arms, each of which turns with one angle. The cost of a tree is estimated as the operations of its right-hand side,
before anything is derived on it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.equations.constraints import Row, rate_jumps
from gudgeon.generator.equations.model import Model
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.mechanism import GROUND, Joint
from gudgeon.generator.reduction.frames import CONSTANT, Affine, substitute
from gudgeon.generator.reduction.shared_points import Hub, find_hubs
from gudgeon.generator.solvers.sparsity import choose_elimination


@dataclass(frozen=True)
class Link:
    """A body with the parent that positions it; without a `joint` the body moves freely (two slides of its own)."""

    body: str
    parent: str
    joint: Joint | None = None

    @property
    def slides(self) -> bool:
        """Return whether the joint carries the body along an axis."""
        return self.joint is not None and len(joint_types()[self.joint.kind].carries) == 1

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Return the names of the slides that the link adds."""
        if self.joint is None:
            return f"{self.body}.x", f"{self.body}.y"
        return (f"{self.joint.name}.slide",) if self.slides else ()

    @property
    def rows(self) -> tuple[str, ...]:
        """Return the names of the constraint equations that the link satisfies by itself."""
        if self.joint is None:
            return ()
        return tuple(f"{self.joint.name}.{row}" for row in joint_types()[self.joint.kind].carries)


def path(links: Iterable[Link], body: str) -> list[Link]:
    """Return the links from the root to a body."""
    by_body = {link.body: link for link in links}
    found: list[Link] = []
    while body != GROUND:
        found.append(by_body[body])
        body = by_body[body].parent
    return found[::-1]


# operations: an entry of M with its velocity term, an entry of a closure's row, a product of the elimination
PAIR, ENTRY, PRODUCT = 14, 4, 2
LIGHT_END = 10**6  # a body at the end of a chain whose mass is lumped at the joint that carries it
PLAIN = 5  # an entry of M with x or y of a body that moves freely


def _coupled_coordinates(place: Mapping[str, int], moving: Iterable[frozenset[str]], plain: set[int]) -> list[set[int]]:
    """Return the coordinates that are coupled with each one in M; x and y of a free body are not coupled."""
    near: list[set[int]] = [set() for _ in place]
    for keys in moving:
        numbers = {place[name] for name in keys}
        for k in numbers:
            near[k] |= numbers - {k} - (plain if k in plain else set())
    return near


class Estimate:
    """Estimated operations of a tree's right-hand side, counted from which coordinates are coupled."""

    def __init__(self, model: Model, angles: Mapping[str, Affine], used: frozenset[str], hubs: Sequence[Hub]) -> None:
        """Prepare the estimate for a model; `used`: equations that the angles satisfy already."""
        self.model, self.hubs = model, hubs
        self._light: dict[tuple[str, str], bool] = {}  # by body and joint
        self.costs: dict[frozenset[tuple[str, str]], int] = {}  # by the joint that places each body
        body_of = {q: body.name for body in model.bodies for q in body.q}
        self.angles = angles
        self.turns = {b: frozenset(k for k in a if k in angles) for b, a in angles.items()}
        specified = used.union(*(hub.rows for hub in hubs))
        self.rows = [(r.name, sorted({body_of[q] for q in r.phi_q})) for r in model.rows if r.name not in specified]

    def __call__(self, links: tuple[Link, ...]) -> int:
        """Return the estimated operations of a tree, computed once."""
        key = frozenset((link.body, link.joint.name if link.joint else "") for link in links)
        if key not in self.costs:
            self.costs[key] = self._count(links)
        return self.costs[key]

    def _count(self, links: tuple[Link, ...]) -> int:
        """Return the estimated operations of a tree."""
        held = {row for link in links for row in link.rows}
        paths: dict[str, list[Link]] = {}
        reach: dict[str, frozenset[str]] = {GROUND: frozenset()}  # coordinates that move a body's points
        moving: list[frozenset[str]] = []  # coordinates that move a centre of mass
        for link in links:
            paths[link.body] = [*paths.get(link.parent, []), link]
            reach[link.body] = reach[link.parent] | self.turns[link.body] | set(link.coordinates)
            moving.append(frozenset(link.coordinates) if link.joint is None else reach[link.body])
        place = {name: k for k, name in enumerate(sorted(frozenset().union(*reach.values())))}
        plain = {place[name] for link in links if link.joint is None for name in link.coordinates}
        near = _coupled_coordinates(place, moving, plain)
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
        """Return the links whose body carries no other and has nearly no inertia about its joint or its centre."""
        carry = {link.parent for link in links}
        ends = [link for link in links if link.body not in carry and set(self.angles[link.body]) == {link.body}]
        return [link for link in ends if not link.slides and self._is_light(link)]

    def _is_light(self, link: Link) -> bool:
        """Return whether a body has nearly no inertia about the joint that carries it."""
        key = link.body, link.joint.name if link.joint else ""
        if key not in self._light:
            self._light[key] = self.model.is_light(link.body, link.joint)
        return self._light[key]

    def closing(self, links: tuple[Link, ...]) -> list[Joint]:
        """Return the pairs that the hubs need in addition to the tree's."""
        paths: dict[str, list[Link]] = {}
        for link in links:
            paths[link.body] = [*paths.get(link.parent, []), link]

        def cost(joint: Joint) -> int:
            """Return the number of coordinates in the closure of a pair."""
            return len(self._moving(paths, [joint.first.body, joint.second.body]))

        inside = [link.joint for link in links if link.joint]
        return [joint for hub in self.hubs for joint in hub.closing(inside, cost)]

    def _moving(self, paths: Mapping[str, list[Link]], bodies: Sequence[str]) -> set[str]:
        """Return the coordinates in an equation between bodies; those of their common path do not count."""
        shared = 0
        if len(bodies) == 2:
            one, two = (paths.get(b, []) for b in bodies)
            parted = (k for k, (a, b) in enumerate(zip(one, two, strict=False)) if a is not b)
            shared = max(next(parted, min(len(one), len(two))) - 1, 0)
        links = [link for b in bodies for link in paths.get(b, [])[shared:]]
        return {key for link in links for key in (*self.turns[link.body], *link.coordinates)}


DEPTHS = (None, 5, 3, 2, 1)  # how many bodies a chain may have before it is cut
SEARCHED = 24  # more coordinates than that: the tree is not improved by exchanges


@dataclass(frozen=True)
class Tree:
    """A spanning tree: angles of the bodies in free ones ("L7") and drives ("crank1"), and links, parents first."""

    angles: Mapping[str, Affine]
    free: tuple[str, ...]  # bodies whose angles are coordinates
    links: tuple[Link, ...]
    rows: frozenset[str]  # equations that angles and links satisfy by themselves, or that hubs replace
    closing: tuple[Joint, ...]  # pairs of bodies at a hub that the tree does not connect
    hubs: tuple[Hub, ...]
    solved: Mapping[str, str]  # equations used for angles, each with the body whose angle it gives
    costs: tuple[int, ...]  # estimated operations of the trees tried, the first one grown breadth first

    def multiplier(self, row: str) -> dict[str, int]:
        """Return the multiplier of a closure as a sum of those of the file's equations, with signs."""
        name, _, which = row.rpartition(".")
        for hub in self.hubs:
            for joint in self.closing:
                if joint in hub.pairs and joint.name == name:
                    spanning = [link.joint for link in self.links if link.joint in hub.pairs]
                    spanning += [other for other in self.closing if other in hub.pairs]
                    shares = hub.share([j for j in spanning if j is not None], joint)
                    return {f"{owner}.{which}": sign for owner, sign in shares.items()}
        return {row: 1}


def stays_constraint(model: Model, row: Row) -> bool:
    """Return whether a drive stays an equation: its rate jumps in a scene with degrees of freedom.

    The jump is an impulse on its equation.
    """
    return row.kind == "drive" and model.degrees_of_freedom > 0 and rate_jumps(model.scene.mechanism.drives[row.name])


def solve_angles(model: Model) -> tuple[dict[str, Affine], dict[str, str]]:
    """Return the angles in free ones and drives, and the equations that this uses, each with its body."""
    angles: dict[str, Affine] = {body.name: {body.name: sp.Integer(1)} for body in model.bodies}
    used: dict[str, str] = {}
    for row in sorted(model.rows, key=lambda row: row.kind != "drive"):  # what a drive prescribes is never free
        total = _linear_angles(model, row, angles)
        pivots = {b: c for b, c in (total or {}).items() if b in angles and c != 0}
        if total is None or not pivots:
            continue
        order = list(angles)
        pivot = max(pivots, key=lambda b: (abs(pivots[b]) == 1, order.index(b)))
        solved = {k: -c / pivots[pivot] for k, c in total.items() if k != pivot}
        angles = {b: substitute(a, pivot, solved) for b, a in angles.items()}
        used[row.name] = pivot
    return angles, used


def _linear_angles(model: Model, row: Row, angles: Mapping[str, Affine]) -> Affine | None:
    """Return an equation in free angles and drives; None if it is not linear in angles with constant coefficients."""
    body_of = {body.theta: body.name for body in model.bodies}
    if not all(q in body_of and model.slots.is_constant(c) for q, c in row.phi_q.items()):
        return None
    drives = {value: name for name, (value, *_) in model.constraints.drive_angles.items()}
    if stays_constraint(model, row):
        return None
    rest = sp.expand(row.phi - sum(c * q for q, c in row.phi_q.items()))
    total: dict[str, sp.Expr] = {}
    for value in sorted(rest.free_symbols & set(drives), key=lambda s: s.name):
        total[drives[value]] = rest.coeff(value)
        rest = rest - rest.coeff(value) * value
    if not model.slots.is_constant(rest):
        return None
    affine: Affine = {**total, CONSTANT: rest}
    for q, c in row.phi_q.items():
        affine = substitute({**affine, "?": c}, "?", angles[body_of[q]])
    return affine


def choose_tree(model: Model) -> Tree:
    """Return the tree of the least estimated operations among a few, improved by exchanges of joints in loops."""
    angles, solved = solve_angles(model)
    used = frozenset(solved)
    free = tuple(b for b in angles if angles[b] == {b: 1})
    edges = _edges(model, angles)
    hubs = find_hubs(edges)
    gathered = {joint.name for hub in hubs for joint in hub.joints}
    edges = [j for j in edges if j.name not in gathered] + [j for hub in hubs for j in hub.pairs]
    estimate = Estimate(model, angles, used, hubs)
    best = min((_grow_tree(model, edges, edges, depth) for depth in DEPTHS), key=estimate)
    if len(free) <= SEARCHED and best == _grow_tree(model, edges, edges, None):
        best = _exchange(model, edges, best, estimate)
    rows = used.union(*(link.rows for link in best), *(hub.rows for hub in hubs))
    closing = tuple(estimate.closing(best))
    return Tree(angles, free, best, rows, closing, tuple(hubs), solved, tuple(estimate.costs.values()))


def _edges(model: Model, angles: Mapping[str, Affine]) -> list[Joint]:
    """Return the joints that can position a body: all their equations exist, and a slide's bodies turn together."""
    kept = {row.name for row in model.rows}

    def turning(body: str) -> dict[str, sp.Expr]:
        """Return the coordinates with which a body turns, and their coefficients."""
        return {k: c for k, c in angles.get(body, {}).items() if k != CONSTANT}

    def carries(joint: Joint) -> bool:
        """Return whether a joint can position a body."""
        rows = joint_types()[joint.kind].carries
        if not rows or not all(f"{joint.name}.{row}" in kept for row in rows):
            return False
        return len(rows) == 2 or turning(joint.first.body) == turning(joint.second.body)

    return list(filter(carries, model.scene.mechanism.joints.values()))


def _grow_tree(model: Model, edges: Sequence[Joint], expected: Sequence[Joint], depth: int | None) -> tuple[Link, ...]:
    """Return a tree, grown breadth first from the ground along the joints in `expected`.

    Bodies that no joint reaches move freely; with a `depth`, longer chains are cut.
    """
    near: dict[str, list[Joint]] = {name: [] for name in (GROUND, *model.geometry.bodies)}
    names = {joint.name for joint in expected}
    for joint in edges:
        if joint.name in names:
            near[joint.first.body].append(joint)
            near[joint.second.body].append(joint)
    links: list[Link] = []
    placed: dict[str, int] = {GROUND: 0}
    waiting = [GROUND]
    bodies = list(model.geometry.bodies)
    while waiting or len(placed) <= len(bodies):
        if not waiting:
            root = next(b for b in bodies if b not in placed)
            links.append(Link(root, GROUND))
            placed[root] = 1
            waiting = [root]
        body = waiting.pop(0)
        for joint in near[body]:
            other = joint.second.body if joint.first.body == body else joint.first.body
            if other not in placed and (depth is None or placed[body] < depth):
                links.append(Link(other, body, joint))
                placed[other] = placed[body] + 1
                waiting.append(other)
    return tuple(links)


def _exchange(model: Model, edges: Sequence[Joint], links: tuple[Link, ...], estimate: Estimate) -> tuple[Link, ...]:
    """Return the tree after exchanging joints of loops with those of the tree as long as that reduces the estimate."""
    best = estimate(links)
    improved = True
    while improved:
        improved = False
        inside = [link.joint for link in links if link.joint]
        for joint in [j for j in edges if j not in inside]:
            for other in _loop_joints(links, joint):
                candidate = _grow_tree(model, edges, [j for j in (*inside, joint) if j is not other], None)
                if len(candidate) == len(links) and (cost := estimate(candidate)) < best:
                    links, best, improved = candidate, cost, True
                    break
            if improved:
                break
    return links


def _loop_joints(links: Sequence[Link], joint: Joint) -> list[Joint]:
    """Return the tree's joints in the loop that `joint` closes."""
    one, two = path(links, joint.first.body), path(links, joint.second.body)
    return [link.joint for link in (*one, *two) if (link in one) != (link in two) and link.joint]

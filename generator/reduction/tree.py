"""Choice of tree coordinates: a spanning tree of joints that positions all bodies, and the free angles.

Equations that are linear in angles with constant coefficients (a weld, a slide, gears, a driven angle) express angles
by others. The other joints form a graph of bodies; along a spanning tree of it each body is positioned by its
parent, and only the joints that are not in the tree stay as loop closures (R. Featherstone, Rigid Body Dynamics
Algorithms, 2008, chapters 4 and 8). Angles are absolute: in the plane the position of a point is then a sum of
arms, each of which turns with one angle. The cost of a tree is estimated as the operations of its right-hand side,
before anything is derived on it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.equations.constraints import Row, has_jumping_rate
from gudgeon.generator.equations.model import Model
from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.mechanism import GROUND, Joint
from gudgeon.generator.reduction.frames import CONSTANT, Affine, substitute_coordinate
from gudgeon.generator.reduction.shared_points import SharedPoint, find_shared_points
from gudgeon.generator.solvers.sparsity import find_elimination_below


@dataclass(frozen=True)
class Link:
    """A body with the parent that positions it; without a `joint` the body moves freely (two slides of its own)."""

    body: str
    parent: str
    joint: Joint | None = None

    @property
    def slides(self) -> bool:
        """Return whether the joint positions the body along an axis only, so that one coordinate is a slide."""
        return self.joint is not None and len(joint_types()[self.joint.kind].carries) == 1

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Return the names of the slides that the link adds: two without a joint, one of a slide, else none."""
        if self.joint is None:
            return f"{self.body}.x", f"{self.body}.y"
        return (f"{self.joint.name}.slide",) if self.slides else ()

    @property
    def rows(self) -> tuple[str, ...]:
        """Return the names of the constraint equations that the link satisfies by itself; none without a joint."""
        if self.joint is None:
            return ()
        return tuple(f"{self.joint.name}.{row}" for row in joint_types()[self.joint.kind].carries)


def find_path(links: Iterable[Link], body: str) -> list[Link]:
    """Return the links from the root to a body, the root's first; empty for the ground."""
    by_body = {link.body: link for link in links}
    result: list[Link] = []
    while body != GROUND:
        result.append(by_body[body])
        body = by_body[body].parent
    return result[::-1]


# operations: an entry of M with its velocity term, an entry of a closure's row, a product of the elimination
_PAIR_COST, _ENTRY_COST, _PRODUCT_COST = 14, 4, 2
_LEAF_WITHOUT_INERTIA_COST = 10**6  # a body at the end of a chain whose mass is lumped at the joint that carries it
_FREE_ENTRY_COST = 5  # an entry of M with x or y of a body that moves freely


def _find_coupled_coordinates(
    index_of: Mapping[str, int], moving_coordinates: Iterable[frozenset[str]], free_indices: set[int]
) -> list[set[int]]:
    """Return the coordinates that are coupled with each one in M; x and y of a free body are not coupled.

    `index_of`: number of each coordinate; `moving_coordinates`: coordinates that move each centre of mass;
    `free_indices`: numbers of x and y of free bodies.
    """
    coupled: list[set[int]] = [set() for _ in index_of]
    for names in moving_coordinates:
        indices = {index_of[name] for name in names}
        for k in indices:
            coupled[k] |= indices - {k} - (free_indices if k in free_indices else set())
    return coupled


def _make_key(links: Iterable[Link]) -> frozenset[tuple[str, str]]:
    """Return the set of (body, joint that places it) that distinguishes a tree from others."""
    return frozenset((link.body, link.joint.name if link.joint else "") for link in links)


class OperationEstimate:
    """Estimated operations of a tree's right-hand side, counted from which coordinates are coupled."""

    def __init__(
        self,
        model: Model,
        angles: Mapping[str, Affine],
        used_rows: frozenset[str],
        shared_points: Sequence[SharedPoint],
    ) -> None:
        """Prepare the estimate for a model.

        `angles`: those of the bodies in free ones; `used_rows`: equations that the angles satisfy already.
        """
        self.model, self.shared_points = model, shared_points
        self._light: dict[tuple[str, str], bool] = {}  # by body and joint
        self.costs: dict[frozenset[tuple[str, str]], int] = {}  # by the joint that places each body
        body_of = {q: body.name for body in model.bodies for q in body.q}
        self.angles = angles
        self.angle_coordinates = {
            body_name: frozenset(k for k in affine if k in angles) for body_name, affine in angles.items()
        }
        satisfied = used_rows.union(*(shared_point.rows for shared_point in shared_points))
        self.rows = [(r.name, sorted({body_of[q] for q in r.phi_q})) for r in model.rows if r.name not in satisfied]

    def __call__(self, links: tuple[Link, ...], limit: float = math.inf) -> int:
        """Return the estimated operations of the right-hand side on a tree, computed once for equal trees.

        If they exceed `limit`, a lower bound above it may be returned.
        """
        key = _make_key(links)
        if key not in self.costs:
            self.costs[key] = self._count_operations(links, limit)
        return self.costs[key]

    def find_cheapest(self, trees: Sequence[tuple[Link, ...]]) -> tuple[Link, ...]:
        """Return the first of the cheapest trees, the last one being estimated first.

        `costs` contains a lower bound for a tree that costs more than a later one. `costs` is replaced.
        """
        limit = math.inf
        for links in reversed(trees):
            limit = min(limit, self(links, limit))
        self.costs = {_make_key(links): self(links) for links in trees}
        return min(trees, key=self)

    def _count_operations(self, links: tuple[Link, ...], limit: float) -> int:
        """Return the estimated operations of the right-hand side on a tree, or a lower bound above `limit`.

        Entries of M and of closures count, and the elimination. Each leaf body with nearly no inertia about its joint
        costs 10⁶ more.
        """
        satisfied_rows = {row for link in links for row in link.rows}
        paths: dict[str, list[Link]] = {}
        moving_coordinates: dict[str, frozenset[str]] = {GROUND: frozenset()}  # coordinates that move a body's points
        coordinates_of_masses: list[frozenset[str]] = []  # coordinates that move a centre of mass
        carriers = {link.parent for link in links if link.joint}  # what moves them also moves the bodies on them
        for link in links:
            paths[link.body] = [*paths.get(link.parent, []), link]
            moving_coordinates[link.body] = (
                moving_coordinates[link.parent] | self.angle_coordinates[link.body] | set(link.coordinates)
            )
            if link.body not in carriers:
                coordinates_of_masses.append(
                    frozenset(link.coordinates) if link.joint is None else moving_coordinates[link.body]
                )
        index_of = {name: k for k, name in enumerate(sorted(frozenset().union(*moving_coordinates.values())))}
        free_indices = {index_of[name] for link in links if link.joint is None for name in link.coordinates}
        neighbours = _find_coupled_coordinates(index_of, coordinates_of_masses, free_indices)
        cost = sum(
            _FREE_ENTRY_COST if k in free_indices or j in free_indices else _PAIR_COST
            for k, coupled in enumerate(neighbours)
            for j in coupled
            if j < k
        )
        open_pairs = [(joint.name, [joint.first.body, joint.second.body]) for joint in self.find_closing_pairs(links)]
        for name, bodies in (*self.rows, *open_pairs, *open_pairs):  # two rows each
            if name not in satisfied_rows:
                indices = {index_of[index] for index in self._find_moving_coordinates(paths, bodies)}
                cost += sum(1 if index in free_indices else _ENTRY_COST for index in indices)
                neighbours.append(indices)
                for index in indices:
                    neighbours[index] = neighbours[index] | {len(neighbours) - 1}
        cost += _LEAF_WITHOUT_INERTIA_COST * len(self._find_leaves_without_inertia(links))
        if cost > limit:
            return cost
        elimination = find_elimination_below(
            (limit - cost) / _PRODUCT_COST, tuple(map(frozenset, neighbours)), len(index_of)
        )
        return cost + _PRODUCT_COST * elimination.cost if elimination else math.floor(limit) + 1

    def _find_leaves_without_inertia(self, links: tuple[Link, ...]) -> list[Link]:
        """Return the links of leaf bodies with nearly no moment of inertia about their joint or centre of mass.

        A leaf carries no other body. Bodies that slide or do not turn freely are left out.
        """
        parents = {link.parent for link in links}
        ends = [link for link in links if link.body not in parents and set(self.angles[link.body]) == {link.body}]
        return [link for link in ends if not link.slides and self._has_negligible_inertia(link)]

    def _has_negligible_inertia(self, link: Link) -> bool:
        """Return whether a body has nearly no inertia about the joint that carries it, from a cache."""
        key = link.body, link.joint.name if link.joint else ""
        if key not in self._light:
            self._light[key] = self.model.has_negligible_inertia(link.body, link.joint)
        return self._light[key]

    def find_closing_pairs(self, links: tuple[Link, ...]) -> list[Joint]:
        """Return the pairs of bodies that the shared points need in addition to those of the tree."""
        paths: dict[str, list[Link]] = {}
        for link in links:
            paths[link.body] = [*paths.get(link.parent, []), link]

        def count_coordinates(joint: Joint) -> int:
            """Return the number of coordinates in the closure of a pair."""
            return len(self._find_moving_coordinates(paths, [joint.first.body, joint.second.body]))

        tree_joints = [link.joint for link in links if link.joint]
        return [
            joint
            for shared_point in self.shared_points
            for joint in shared_point.find_closing_pairs(tree_joints, count_coordinates)
        ]

    def _find_moving_coordinates(self, paths: Mapping[str, list[Link]], bodies: Sequence[str]) -> set[str]:
        """Return the coordinates in an equation between bodies; those of their common path do not count.

        `paths`: the links from the root to each body. `bodies`: one body or two; a body without a path is the ground.
        """
        n_shared = 0
        if len(bodies) == 2:
            first_path, second_path = (paths.get(body, []) for body in bodies)
            differing_indices = (
                k for k, (a, body) in enumerate(zip(first_path, second_path, strict=False)) if a is not body
            )
            n_shared = max(next(differing_indices, min(len(first_path), len(second_path))) - 1, 0)
        links = [link for body in bodies for link in paths.get(body, [])[n_shared:]]
        return {key for link in links for key in (*self.angle_coordinates[link.body], *link.coordinates)}


_MAX_DEPTHS = (None, 5, 3, 2, 1)  # how many bodies a chain may have before it is cut
_MAX_COORDINATES_FOR_EXCHANGE = 24  # more coordinates than that: the tree is not improved by exchanges


@dataclass(frozen=True)
class Tree:
    """A spanning tree: angles of the bodies in free ones ("L7") and drives ("crank1"), and links, parents first."""

    angles: Mapping[str, Affine]
    free: tuple[str, ...]  # bodies whose angles are coordinates
    links: tuple[Link, ...]
    rows: frozenset[str]  # equations that angles and links satisfy by themselves, or that shared points replace
    closing_pairs: tuple[Joint, ...]  # pairs of bodies at a shared point that the tree does not connect
    shared_points: tuple[SharedPoint, ...]
    solved: Mapping[str, str]  # equations used for angles, each with the body whose angle it gives
    costs: tuple[int, ...]  # estimated operations (or a lower bound) of the trees tried, the first grown breadth first

    def find_multiplier_terms(self, row: str) -> dict[str, int]:
        """Return the multiplier of a closure as a sum of those of the file's equations: sign by equation.

        A closure that is an equation of the file itself gives {row: 1}.
        """
        name, _, component = row.rpartition(".")
        for shared_point in self.shared_points:
            for joint in self.closing_pairs:
                if joint in shared_point.pairs and joint.name == name:
                    spanning = [link.joint for link in self.links if link.joint in shared_point.pairs]
                    spanning += [pair for pair in self.closing_pairs if pair in shared_point.pairs]
                    signs = shared_point.find_multiplier_signs([j for j in spanning if j is not None], joint)
                    return {f"{owner}.{component}": sign for owner, sign in signs.items()}
        return {row: 1}


def is_impulsive_drive(model: Model, row: Row) -> bool:
    """Return whether an equation is that of a drive whose rate jumps in a scene with degrees of freedom.

    It remains a constraint equation, since the jump causes an impulse.
    """
    return (
        row.kind == "drive"
        and model.degrees_of_freedom > 0
        and has_jumping_rate(model.scene.mechanism.drives[row.name])
    )


def solve_angles(model: Model) -> tuple[dict[str, Affine], dict[str, str]]:
    """Return the angles of all bodies in free ones and drives, and the equations used.

    Each of these is stored with the body whose angle it gives.
    """
    angles: dict[str, Affine] = {body.name: {body.name: sp.Integer(1)} for body in model.bodies}
    used_rows: dict[str, str] = {}
    for row in sorted(model.rows, key=lambda row: row.kind != "drive"):  # what a drive prescribes is never free
        equation = _express_linear_angles(model, row, angles)
        pivots = {
            body_name: coefficient
            for body_name, coefficient in (equation or {}).items()
            if body_name in angles and coefficient != 0
        }
        if equation is None or not pivots:
            continue
        order = list(angles)
        pivot = max(pivots, key=lambda body_name: (abs(pivots[body_name]) == 1, order.index(body_name)))
        solved = {k: -coefficient / pivots[pivot] for k, coefficient in equation.items() if k != pivot}
        angles = {body_name: substitute_coordinate(affine, pivot, solved) for body_name, affine in angles.items()}
        used_rows[row.name] = pivot
    return angles, used_rows


def _express_linear_angles(model: Model, row: Row, angles: Mapping[str, Affine]) -> Affine | None:
    """Return an equation as an affine expression in free angles and drives.

    Return None if it is not linear in angles with constant coefficients, or if it is a drive whose rate jumps.
    """
    body_of = {body.theta: body.name for body in model.bodies}
    if not all(q in body_of and model.parameter_table.is_constant(coefficient) for q, coefficient in row.phi_q.items()):
        return None
    drives = {value: name for name, (value, *_) in model.constraints.drive_angles.items()}
    if is_impulsive_drive(model, row):
        return None
    remainder = sp.expand(row.phi - sum(coefficient * q for q, coefficient in row.phi_q.items()))
    coefficients: dict[str, sp.Expr] = {}
    for value in sorted(remainder.free_symbols & set(drives), key=lambda s: s.name):
        coefficients[drives[value]] = remainder.coeff(value)
        remainder = remainder - remainder.coeff(value) * value
    if not model.parameter_table.is_constant(remainder):
        return None
    affine: Affine = {**coefficients, CONSTANT: remainder}
    for q, coefficient in row.phi_q.items():
        affine = substitute_coordinate({**affine, "?": coefficient}, "?", angles[body_of[q]])
    return affine


def choose_tree(model: Model) -> Tree:
    """Return the tree of the least estimated operations among a few, improved by exchanges of joints in loops.

    Candidates are grown breadth first with chains of different greatest lengths. Trees with many coordinates are not
    improved.
    """
    angles, solved = solve_angles(model)
    used_rows = frozenset(solved)
    free = tuple(body_name for body_name in angles if angles[body_name] == {body_name: 1})
    edges = _find_edges(model, angles)
    shared_points = find_shared_points(edges)
    shared_joint_names = {joint.name for shared_point in shared_points for joint in shared_point.joints}
    edges = [joint for joint in edges if joint.name not in shared_joint_names] + [
        joint for shared_point in shared_points for joint in shared_point.pairs
    ]
    estimate = OperationEstimate(model, angles, used_rows, shared_points)
    trees = [_grow_tree(model, edges, edges, depth) for depth in _MAX_DEPTHS]
    if len(free) > _MAX_COORDINATES_FOR_EXCHANGE:
        best = estimate.find_cheapest(trees)
    elif (best := min(trees, key=estimate)) == trees[0]:
        best = _improve_by_exchange(model, edges, best, estimate)
    rows = used_rows.union(*(link.rows for link in best), *(shared_point.rows for shared_point in shared_points))
    closing = tuple(estimate.find_closing_pairs(best))
    return Tree(angles, free, best, rows, closing, tuple(shared_points), solved, tuple(estimate.costs.values()))


def _find_edges(model: Model, angles: Mapping[str, Affine]) -> list[Joint]:
    """Return the joints that can position a body: all their equations exist, and a slide's bodies turn together."""
    row_names = {row.name for row in model.rows}

    def find_angle_coefficients(body: str) -> dict[str, sp.Expr]:
        """Return the coordinates with which a body turns, and their coefficients; empty for the ground."""
        return {k: c for k, c in angles.get(body, {}).items() if k != CONSTANT}

    def can_position(joint: Joint) -> bool:
        """Return whether a joint can position a body: it has equations for that, and none of them was left out.

        A joint with a slide also needs bodies that turn together.
        """
        rows = joint_types()[joint.kind].carries
        if not rows or not all(f"{joint.name}.{row}" in row_names for row in rows):
            return False
        return len(rows) == 2 or find_angle_coefficients(joint.first.body) == find_angle_coefficients(joint.second.body)

    return list(filter(can_position, model.scene.mechanism.joints.values()))


def _grow_tree(
    model: Model, edges: Sequence[Joint], selected_joints: Sequence[Joint], max_depth: int | None
) -> tuple[Link, ...]:
    """Return a tree, grown breadth first from the ground along some joints, as links with parents first.

    `selected_joints`: the joints that may be used. Bodies that no joint reaches move freely; with a `max_depth`, longer
    chains are cut. None: no limit.
    """
    joints_of_body: dict[str, list[Joint]] = {name: [] for name in (GROUND, *model.geometry.bodies)}
    names = {joint.name for joint in selected_joints}
    for joint in edges:
        if joint.name in names:
            joints_of_body[joint.first.body].append(joint)
            joints_of_body[joint.second.body].append(joint)
    links: list[Link] = []
    depth_of_body: dict[str, int] = {GROUND: 0}
    pending = [GROUND]
    bodies = list(model.geometry.bodies)
    while pending or len(depth_of_body) <= len(bodies):
        if not pending:
            root = next(body_name for body_name in bodies if body_name not in depth_of_body)
            links.append(Link(root, GROUND))
            depth_of_body[root] = 1
            pending = [root]
        body = pending.pop(0)
        for joint in joints_of_body[body]:
            neighbour = joint.second.body if joint.first.body == body else joint.first.body
            if neighbour not in depth_of_body and (max_depth is None or depth_of_body[body] < max_depth):
                links.append(Link(neighbour, body, joint))
                depth_of_body[neighbour] = depth_of_body[body] + 1
                pending.append(neighbour)
    return tuple(links)


def _improve_by_exchange(
    model: Model, edges: Sequence[Joint], links: tuple[Link, ...], estimate: OperationEstimate
) -> tuple[Link, ...]:
    """Return the tree after exchanging joints of loops with those of the tree as long as that reduces the estimate.

    The first exchange that reduces it is made; trees with other numbers of links do not count.
    """
    lowest_cost = estimate(links)
    improved = True
    while improved:
        improved = False
        tree_joints = [link.joint for link in links if link.joint]
        for joint in [candidate_joint for candidate_joint in edges if candidate_joint not in tree_joints]:
            for other in _find_loop_joints(links, joint):
                candidate = _grow_tree(
                    model,
                    edges,
                    [candidate_joint for candidate_joint in (*tree_joints, joint) if candidate_joint is not other],
                    None,
                )
                if len(candidate) == len(links) and (cost := estimate(candidate)) < lowest_cost:
                    links, lowest_cost, improved = candidate, cost, True
                    break
            if improved:
                break
    return links


def _find_loop_joints(links: Sequence[Link], joint: Joint) -> list[Joint]:
    """Return the tree's joints in the loop that `joint` closes.

    They are on one path from the root to its bodies but not on both.
    """
    first_path, second_path = find_path(links, joint.first.body), find_path(links, joint.second.body)
    return [
        link.joint
        for link in (*first_path, *second_path)
        if (link in first_path) != (link in second_path) and link.joint
    ]

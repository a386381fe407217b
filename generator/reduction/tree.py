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
from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.mechanism import GROUND, Joint
from gudgeon.generator.reduction.frames import CONSTANT, Affine, substitute_coordinate
from gudgeon.generator.reduction.multiple_joints import MultipleJoint, find_multiple_joints
from gudgeon.generator.solvers.sparsity import find_elimination_below


@dataclass(frozen=True)
class TreeEdge:
    """An edge of the spanning tree: a body and the parent that positions it; without `joint` the body moves freely.

    A body that moves freely has two slides of its own, along x and y.
    """

    body: str
    parent: str
    joint: Joint | None = None

    @property
    def slides(self) -> bool:
        """Return whether the joint positions the body along an axis only: the edge then adds a coordinate."""
        return self.joint is not None and len(find_joint_types()[self.joint.kind].positioning_rows) == 1

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Return the names of the translational coordinates that the tree edge adds.

        They are "<body>.x" and "<body>.y" without a joint, "<joint>.slide" for a joint with a slide, else none.
        """
        if self.joint is None:
            return f"{self.body}.x", f"{self.body}.y"
        return (f"{self.joint.name}.slide",) if self.slides else ()

    @property
    def satisfied_rows(self) -> tuple[str, ...]:
        """Return the names of the constraint equations that the tree edge satisfies by itself; none without a joint."""
        if self.joint is None:
            return ()
        return tuple(f"{self.joint.name}.{row}" for row in find_joint_types()[self.joint.kind].positioning_rows)


def find_path_from_root(tree_edges: Iterable[TreeEdge], body: str) -> list[TreeEdge]:
    """Return the tree edges among `tree_edges` from the root to a body, the root's first; empty for the ground."""
    by_body = {tree_edge.body: tree_edge for tree_edge in tree_edges}
    result: list[TreeEdge] = []
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
    """Return for each coordinate the numbers of those with which it is coupled in M.

    `index_of`: number of each coordinate; `moving_coordinates`: coordinates that move each centre of mass.
    `free_indices`: numbers of x and y of free bodies, which are not coupled with each other.
    """
    coupled: list[set[int]] = [set() for _ in index_of]
    for names in moving_coordinates:
        indices = {index_of[name] for name in names}
        for k in indices:
            coupled[k] |= indices - {k} - (free_indices if k in free_indices else set())
    return coupled


def _make_tree_key(tree_edges: Iterable[TreeEdge]) -> frozenset[tuple[str, str]]:
    """Return the set of (body, joint that positions it) of a tree's edges, which identifies the tree.

    The joint is "" for a body that moves freely.
    """
    return frozenset((tree_edge.body, tree_edge.joint.name if tree_edge.joint else "") for tree_edge in tree_edges)


class OperationEstimate:
    """Estimated operations of a tree's right-hand side, counted from which coordinates are coupled."""

    def __init__(
        self,
        model: Model,
        angles: Mapping[str, Affine],
        used_rows: frozenset[str],
        multiple_joints: Sequence[MultipleJoint],
    ) -> None:
        """Begin without estimates for the trees of a model.

        `angles`: those of the bodies in free ones; `used_rows`: equations that the angles satisfy already.
        """
        self.model, self.multiple_joints = model, multiple_joints
        self._negligible_inertia: dict[tuple[str, str], bool] = {}  # by body and joint
        self.costs: dict[frozenset[tuple[str, str]], int] = {}  # by the joint that places each body
        body_of = {q: body.name for body in model.bodies for q in body.q}
        self.angles = angles
        self.angle_coordinates = {
            body_name: frozenset(k for k in affine if k in angles) for body_name, affine in angles.items()
        }
        satisfied = used_rows.union(*(multiple_joint.row_names for multiple_joint in multiple_joints))
        self.rows = [(r.name, sorted({body_of[q] for q in r.phi_q})) for r in model.rows if r.name not in satisfied]

    def __call__(self, tree_edges: tuple[TreeEdge, ...], limit: float = math.inf) -> int:
        """Return the estimated operations of the right-hand side in the coordinates of a tree, from a cache.

        `tree_edges`: the edges of the spanning tree. If the operations exceed `limit`, a lower bound above it may be
        returned.
        """
        key = _make_tree_key(tree_edges)
        if key not in self.costs:
            self.costs[key] = self._estimate_operations(tree_edges, limit)
        return self.costs[key]

    def find_cheapest(self, trees: Sequence[tuple[TreeEdge, ...]]) -> tuple[TreeEdge, ...]:
        """Return the tree with the least estimated operations, the first of several; the last tree is estimated first.

        `costs` is replaced by those of these trees, in their order. It has a lower bound for a tree that costs more
        than a later one.
        """
        limit = math.inf
        for tree_edges in reversed(trees):
            limit = min(limit, self(tree_edges, limit))
        self.costs = {_make_tree_key(tree_edges): self(tree_edges) for tree_edges in trees}
        return min(trees, key=self)

    def _estimate_operations(self, tree_edges: tuple[TreeEdge, ...], limit: float) -> int:
        """Return the estimated operations of the right-hand side on a tree, or a lower bound above `limit`.

        Entries of M and of the closures count, and the elimination. Each leaf body without inertia adds
        `_LEAF_WITHOUT_INERTIA_COST`.
        """
        satisfied_rows = {row for tree_edge in tree_edges for row in tree_edge.satisfied_rows}
        paths: dict[str, list[TreeEdge]] = {}
        moving_coordinates: dict[str, frozenset[str]] = {GROUND: frozenset()}  # coordinates that move a body's points
        coordinates_of_masses: list[frozenset[str]] = []  # coordinates that move a centre of mass
        carriers = {
            tree_edge.parent for tree_edge in tree_edges if tree_edge.joint
        }  # the coordinates that move them also move the bodies on them
        for tree_edge in tree_edges:
            paths[tree_edge.body] = [*paths.get(tree_edge.parent, []), tree_edge]
            moving_coordinates[tree_edge.body] = (
                moving_coordinates[tree_edge.parent]
                | self.angle_coordinates[tree_edge.body]
                | set(tree_edge.coordinates)
            )
            if tree_edge.body not in carriers:
                coordinates_of_masses.append(
                    frozenset(tree_edge.coordinates) if tree_edge.joint is None else moving_coordinates[tree_edge.body]
                )
        index_of = {name: k for k, name in enumerate(sorted(frozenset().union(*moving_coordinates.values())))}
        free_indices = {
            index_of[name] for tree_edge in tree_edges if tree_edge.joint is None for name in tree_edge.coordinates
        }
        neighbours = _find_coupled_coordinates(index_of, coordinates_of_masses, free_indices)
        cost = sum(
            _FREE_ENTRY_COST if k in free_indices or j in free_indices else _PAIR_COST
            for k, coupled in enumerate(neighbours)
            for j in coupled
            if j < k
        )
        open_pairs = [
            (joint.name, [joint.first.body, joint.second.body]) for joint in self.find_closing_pairs(tree_edges)
        ]
        for name, bodies in (*self.rows, *open_pairs, *open_pairs):  # two rows each
            if name not in satisfied_rows:
                indices = {index_of[index] for index in self._find_relative_coordinates(paths, bodies)}
                cost += sum(1 if index in free_indices else _ENTRY_COST for index in indices)
                neighbours.append(indices)
                for index in indices:
                    neighbours[index] = neighbours[index] | {len(neighbours) - 1}
        cost += _LEAF_WITHOUT_INERTIA_COST * len(self._find_leaves_without_inertia(tree_edges))
        if cost > limit:
            return cost
        elimination = find_elimination_below(
            (limit - cost) / _PRODUCT_COST, tuple(map(frozenset, neighbours)), len(index_of)
        )
        return cost + _PRODUCT_COST * elimination.cost if elimination else math.floor(limit) + 1

    def _find_leaves_without_inertia(self, tree_edges: tuple[TreeEdge, ...]) -> list[TreeEdge]:
        """Return the edges of leaf bodies with negligible moment of inertia about their joint or centre of mass.

        The centre of mass counts for a body that moves freely. A leaf carries no other body. Bodies with a slide, and
        those whose angle is not a coordinate of their own, are left out.
        """
        parents = {tree_edge.parent for tree_edge in tree_edges}
        ends = [
            tree_edge
            for tree_edge in tree_edges
            if tree_edge.body not in parents and set(self.angles[tree_edge.body]) == {tree_edge.body}
        ]
        return [tree_edge for tree_edge in ends if not tree_edge.slides and self._has_negligible_inertia(tree_edge)]

    def _has_negligible_inertia(self, tree_edge: TreeEdge) -> bool:
        """Return `Model.has_negligible_inertia` of a body about the joint that positions it, from a cache.

        `tree_edge`: the edge of the spanning tree. For a body that moves freely the centre of mass replaces the joint.
        """
        key = tree_edge.body, tree_edge.joint.name if tree_edge.joint else ""
        if key not in self._negligible_inertia:
            self._negligible_inertia[key] = self.model.has_negligible_inertia(tree_edge.body, tree_edge.joint)
        return self._negligible_inertia[key]

    def find_closing_pairs(self, tree_edges: tuple[TreeEdge, ...]) -> list[Joint]:
        """Return the pairs of bodies, as joints, that close the points that several bodies share (multiple joints).

        They connect the bodies of such a point that the pairs of the tree do not connect. Pairs whose equations contain
        few coordinates are preferred (`MultipleJoint.find_connecting_pairs`).
        """
        paths: dict[str, list[TreeEdge]] = {}
        for tree_edge in tree_edges:
            paths[tree_edge.body] = [*paths.get(tree_edge.parent, []), tree_edge]

        def count_coordinates(joint: Joint) -> int:
            """Return the number of coordinates in the closure of a pair."""
            return len(self._find_relative_coordinates(paths, [joint.first.body, joint.second.body]))

        tree_joints = [tree_edge.joint for tree_edge in tree_edges if tree_edge.joint]
        return [
            joint
            for multiple_joint in self.multiple_joints
            for joint in multiple_joint.find_connecting_pairs(tree_joints, count_coordinates)
        ]

    def _find_relative_coordinates(self, paths: Mapping[str, list[TreeEdge]], bodies: Sequence[str]) -> set[str]:
        """Return the names of the tree coordinates on which the relative pose of the bodies of an equation depends.

        `paths`: the tree edges from the root to each body. `bodies`: one body or two; a body without a path is the
        ground. For two bodies the coordinates of their common path do not count, except those of its last body.
        """
        n_shared = 0
        if len(bodies) == 2:
            first_path, second_path = (paths.get(body, []) for body in bodies)
            differing_indices = (
                k for k, (a, body) in enumerate(zip(first_path, second_path, strict=False)) if a is not body
            )
            n_shared = max(next(differing_indices, min(len(first_path), len(second_path))) - 1, 0)
        tree_edges = [tree_edge for body in bodies for tree_edge in paths.get(body, [])[n_shared:]]
        return {
            key for tree_edge in tree_edges for key in (*self.angle_coordinates[tree_edge.body], *tree_edge.coordinates)
        }


_MAX_DEPTHS = (None, 5, 3, 2, 1)  # bodies of the longest path from the root; None: no limit
_MAX_COORDINATES_FOR_EXCHANGE = 24  # free angles of a tree that exchanges of joints may improve


@dataclass(frozen=True)
class Tree:
    """A spanning tree: angles of the bodies in free ones ("L7") and drives ("crank1"), and edges, parents first."""

    angles: Mapping[str, Affine]
    free: tuple[str, ...]  # bodies whose angles are coordinates
    edges: tuple[TreeEdge, ...]
    satisfied_rows: frozenset[
        str
    ]  # equations that angles and edges satisfy by themselves, or that shared points replace
    closing_pairs: tuple[Joint, ...]  # pairs of bodies at a shared point that the tree does not connect
    multiple_joints: tuple[MultipleJoint, ...]
    solved: Mapping[str, str]  # equations used for angles, each with the body whose angle it gives
    costs: tuple[int, ...]  # estimated operations (or a lower bound) of the trees tried, the first grown breadth first

    def find_multiplier_terms(self, row: str) -> dict[str, int]:
        """Return the multiplier of a closure as a sum of multipliers of the file's equations: sign 1 or −1 by equation.

        `row`: the name of the closure. A closure that is an equation of the file itself gives {row: 1}.
        """
        name, _, component = row.rpartition(".")
        for multiple_joint in self.multiple_joints:
            for joint in self.closing_pairs:
                if joint in multiple_joint.pairs and joint.name == name:
                    spanning = [tree_edge.joint for tree_edge in self.edges if tree_edge.joint in multiple_joint.pairs]
                    spanning += [pair for pair in self.closing_pairs if pair in multiple_joint.pairs]
                    signs = multiple_joint.find_multiplier_signs([j for j in spanning if j is not None], joint)
                    return {f"{owner}.{component}": sign for owner, sign in signs.items()}
        return {row: 1}


def is_impulsive_drive(model: Model, row: Row) -> bool:
    """Return whether an equation is that of a drive whose rate may jump, in a scene with degrees of freedom.

    Such an equation is not used to eliminate a coordinate: the jump causes an impulse, computed with the equation.
    """
    return (
        row.kind == "drive"
        and model.degrees_of_freedom > 0
        and has_jumping_rate(model.scene.mechanism.drives[row.name])
    )


def solve_angles(model: Model) -> tuple[dict[str, Affine], dict[str, str]]:
    """Return the angles of all bodies as affine expressions in free angles and drives, and the equations used.

    The equations are solved by elimination, those of drives first. Each is solved for an angle with the coefficient ±1
    if there is one, and for the last such body in the order of the file. The second result maps each equation to the
    body whose angle it gives.
    """
    angles: dict[str, Affine] = {body.name: {body.name: sp.Integer(1)} for body in model.bodies}
    used_rows: dict[str, str] = {}
    for row in sorted(
        model.rows, key=lambda row: row.kind != "drive"
    ):  # an angle that a drive prescribes is never free
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
    """Return the left side Φ of a constraint equation Φ = 0 as an affine expression in free angles and drives.

    `angles`: the angles of the bodies so far. Return None if the equation is not linear in angles with constant
    coefficients, or if it is that of a drive whose rate may jump.
    """
    body_of = {body.theta: body.name for body in model.bodies}
    if not all(q in body_of and model.parameter_table.is_constant(coefficient) for q, coefficient in row.phi_q.items()):
        return None
    drives = {value: name for name, (value, *_) in model.constraints.drive_functions.items()}
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
    """Return the spanning tree with the least estimated operations among a few candidates.

    Candidates are grown breadth first with the different maximum depths `_MAX_DEPTHS`. The first one, without a limit,
    is improved by exchanges of joints in loops (local search) if it is the best. This is left out above
    _MAX_COORDINATES_FOR_EXCHANGE free angles.
    """
    angles, solved = solve_angles(model)
    used_rows = frozenset(solved)
    free = tuple(body_name for body_name in angles if angles[body_name] == {body_name: 1})
    edges = _find_edges(model, angles)
    multiple_joints = find_multiple_joints(edges)
    shared_joint_names = {joint.name for multiple_joint in multiple_joints for joint in multiple_joint.joints}
    edges = [joint for joint in edges if joint.name not in shared_joint_names] + [
        joint for multiple_joint in multiple_joints for joint in multiple_joint.pairs
    ]
    estimate = OperationEstimate(model, angles, used_rows, multiple_joints)
    trees = [_grow_tree(model, edges, edges, depth) for depth in _MAX_DEPTHS]
    if len(free) > _MAX_COORDINATES_FOR_EXCHANGE:
        best = estimate.find_cheapest(trees)
    elif (best := min(trees, key=estimate)) == trees[0]:
        best = _improve_by_exchange(model, edges, best, estimate)
    rows = used_rows.union(
        *(tree_edge.satisfied_rows for tree_edge in best),
        *(multiple_joint.row_names for multiple_joint in multiple_joints),
    )
    closing = tuple(estimate.find_closing_pairs(best))
    return Tree(angles, free, best, rows, closing, tuple(multiple_joints), solved, tuple(estimate.costs.values()))


def _find_edges(model: Model, angles: Mapping[str, Affine]) -> list[Joint]:
    """Return the joints that can position a body: those with equations for it, none of which is redundant.

    A joint with a slide also needs bodies that turn together: their angles differ by a constant. `angles`: those of
    the bodies as affine expressions in free angles and drives.
    """
    row_names = {row.name for row in model.rows}

    def find_angle_coefficients(body: str) -> dict[str, sp.Expr]:
        """Return the coordinates with which a body turns, and their coefficients; empty for the ground."""
        return {k: c for k, c in angles.get(body, {}).items() if k != CONSTANT}

    def can_position(joint: Joint) -> bool:
        """Return whether a joint can position a body: it has equations for that, and none is missing in the model.

        A joint with a slide also needs bodies that turn together.
        """
        rows = find_joint_types()[joint.kind].positioning_rows
        if not rows or not all(f"{joint.name}.{row}" in row_names for row in rows):
            return False
        return len(rows) == 2 or find_angle_coefficients(joint.first.body) == find_angle_coefficients(joint.second.body)

    return list(filter(can_position, model.scene.mechanism.joints.values()))


def _grow_tree(
    model: Model, edges: Sequence[Joint], selected_joints: Sequence[Joint], max_depth: int | None
) -> tuple[TreeEdge, ...]:
    """Return a spanning tree as edges with parents first, grown breadth first from the ground along some joints.

    `edges`: all joints that can position a body; `selected_joints`: those that may be used. Bodies that no joint
    reaches, or only beyond `max_depth` bodies, move freely. `max_depth` None: no limit.
    """
    joints_of_body: dict[str, list[Joint]] = {name: [] for name in (GROUND, *model.geometry.bodies)}
    names = {joint.name for joint in selected_joints}
    for joint in edges:
        if joint.name in names:
            joints_of_body[joint.first.body].append(joint)
            joints_of_body[joint.second.body].append(joint)
    tree_edges: list[TreeEdge] = []
    depth_of_body: dict[str, int] = {GROUND: 0}
    pending = [GROUND]
    bodies = list(model.geometry.bodies)
    while pending or len(depth_of_body) <= len(bodies):
        if not pending:
            root = next(body_name for body_name in bodies if body_name not in depth_of_body)
            tree_edges.append(TreeEdge(root, GROUND))
            depth_of_body[root] = 1
            pending = [root]
        body = pending.pop(0)
        for joint in joints_of_body[body]:
            neighbour = joint.second.body if joint.first.body == body else joint.first.body
            if neighbour not in depth_of_body and (max_depth is None or depth_of_body[body] < max_depth):
                tree_edges.append(TreeEdge(neighbour, body, joint))
                depth_of_body[neighbour] = depth_of_body[body] + 1
                pending.append(neighbour)
    return tuple(tree_edges)


def _improve_by_exchange(
    model: Model, edges: Sequence[Joint], tree_edges: tuple[TreeEdge, ...], estimate: OperationEstimate
) -> tuple[TreeEdge, ...]:
    """Return the tree after edge exchanges that reduce the estimate: local search, first improvement.

    An exchange replaces a joint of the tree by one outside, in the loop that the latter closes. The search begins
    again after each exchange. Trees with another number of edges do not count.
    """
    lowest_cost = estimate(tree_edges)
    improved = True
    while improved:
        improved = False
        tree_joints = [tree_edge.joint for tree_edge in tree_edges if tree_edge.joint]
        for joint in [candidate_joint for candidate_joint in edges if candidate_joint not in tree_joints]:
            for other in _find_loop_joints(tree_edges, joint):
                candidate = _grow_tree(
                    model,
                    edges,
                    [candidate_joint for candidate_joint in (*tree_joints, joint) if candidate_joint is not other],
                    None,
                )
                if len(candidate) == len(tree_edges) and (cost := estimate(candidate)) < lowest_cost:
                    tree_edges, lowest_cost, improved = candidate, cost, True
                    break
            if improved:
                break
    return tree_edges


def _find_loop_joints(tree_edges: Sequence[TreeEdge], joint: Joint) -> list[Joint]:
    """Return the tree's joints in the loop that `joint` closes.

    They are those on the path from the root to one of its bodies but not to the other.
    """
    first_path, second_path = (
        find_path_from_root(tree_edges, joint.first.body),
        find_path_from_root(tree_edges, joint.second.body),
    )
    return [
        tree_edge.joint
        for tree_edge in (*first_path, *second_path)
        if (tree_edge in first_path) != (tree_edge in second_path) and tree_edge.joint
    ]

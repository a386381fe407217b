"""Elimination order of the KKT matrix: each coordinate together with the constraint equation that gives it.

The equation "x" of a revolute joint has the entries 1 and −1 in the x of its two bodies. With one of them it makes
the pivot block [m ±1; ±1 0], which is regular for every m and needs no division. Elimination leaves sums: the moment
of inertia J + m s² of θ about the joint, and the mass for the body that carries it (R. Featherstone, Rigid Body
Dynamics Algorithms, 2008, chapter 7). With J alone as a pivot, equations would be left with s²/J + 1/m, in which 1/m
is rounded off if J is small compared with m s². A line along which a point slides, with the unit normal n, makes a
block with x and y together, whose last pivot is n²/m.
"""

from __future__ import annotations

from collections.abc import Sequence

import sympy as sp

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.system import System

Pairs = Sequence[tuple[int, int]]  # coordinate, row


class DependentCoordinates:
    """Assignment of equations to bodies' coordinates from the ground outwards, for the elimination order.

    A coordinate is assigned if an equation gives it from coordinates assigned before, or if it was selected as
    independent. An assigned coordinate and its equation form one pivot block. `groups`, in the order of assignment: a
    coordinate and its equation, or x, y and the equation of a line. No equation depends on a coordinate that is
    assigned after its own.
    """

    def __init__(
        self, system: System, rows: Sequence[Row], avoided_pairs: frozenset[tuple[str, str]] = frozenset()
    ) -> None:
        """Assign to each coordinate, where possible, the equation that gives it from coordinates assigned before.

        `rows`: the equations; `avoided_pairs`: pairs (body, joint) that are used only if nothing else gives the body's
        position.
        """
        self.model: Model = system.model
        self.rows, self._avoided_pairs = rows, avoided_pairs
        index_of_coordinate = {q: k for k, q in enumerate(system.q)}
        self._entries = [{index_of_coordinate[q]: entry for q, entry in row.phi_q.items()} for row in rows]
        self._constant_coordinates = [self._find_constant_coordinates(entries) for entries in self._entries]
        self.groups: list[tuple[tuple[int, ...], int]] = []
        self._assigned: set[int] = set()
        self._used_rows: set[int] = set()
        while self._assign_single_coordinates() or self._assign_body_on_line() or self._select_independent_coordinate():
            pass

    def _find_constant_coordinates(self, entries: dict[int, sp.Expr]) -> set[int]:
        """Return the coordinates that an equation can give without division: x and y whose entry is 1 or −1.

        If all entries belong to angles and are constant, all coordinates of the equation are returned. `entries`:
        entries of Φ_q of the equation by coordinate.
        """
        if all(k % 3 == 2 and self.model.parameter_table.is_constant(entry) for k, entry in entries.items()):
            return set(entries)
        return {k for k, entry in entries.items() if k % 3 < 2 and is_unit(entry)}

    def _find_unassigned_coordinates(self, r: int) -> set[int]:
        """Return the coordinates with a constant entry in equation r that are not assigned yet."""
        return self._constant_coordinates[r] - self._assigned

    def _assign_single_coordinates(self) -> bool:
        """Assign to coordinates the equations in which they are the only unassigned coordinate with a constant entry.

        Return whether such an equation exists. Entries ±1 of x and y count, and constant entries of equations in angles
        alone. Only the best candidates are assigned (`_select_candidates`).
        """
        candidates = [
            (min(self._find_unassigned_coordinates(r)), r)
            for r in range(len(self.rows))
            if len(self._find_unassigned_coordinates(r)) == 1
        ]
        for k, r in self._select_candidates(candidates):
            if k not in self._assigned:
                self._record_group((k,), r)
        return bool(candidates)

    def _assign_body_on_line(self) -> bool:
        """Assign to x and y of a body the first unused equation that contains both; return whether one exists.

        The equation must not contain an unassigned x or y of another body.
        """
        for r, entries in enumerate(self._entries):
            line_coordinates = sorted(k for k in entries if k % 3 < 2 and k not in self._assigned)
            if r in self._used_rows or len(line_coordinates) != 2:
                continue
            if line_coordinates[0] // 3 == line_coordinates[1] // 3:
                self._record_group(tuple(line_coordinates), r)
                return True
        return False

    def _select_independent_coordinate(self) -> bool:
        """Mark as assigned a coordinate that no equation gives by assigned ones; return whether there was any.

        It is the first unassigned coordinate of an equation; x and y of a body are marked together. Equations can then
        give other coordinates from them.
        """
        constrained_coordinates = [
            *self._constant_coordinates,
            *({k for k in entries if k % 3 < 2} for entries in self._entries),
        ]
        first_unassigned = next(
            (k for coordinates in constrained_coordinates for k in sorted(coordinates - self._assigned)), None
        )
        if first_unassigned is not None:
            self._assigned |= _add_sibling_coordinate(first_unassigned)
        return first_unassigned is not None

    def _record_group(self, coordinates: tuple[int, ...], r: int) -> None:
        """Record that equation r gives `coordinates`: one, or x and y of a body on a line.

        The group (coordinates, r) is appended, the coordinates are marked as assigned and the equation as used.
        """
        self.groups.append((coordinates, r))
        self._assigned |= set(coordinates)
        self._used_rows.add(r)

    def _select_candidates(self, candidates: Pairs) -> Pairs:
        """Return the best of the candidates (coordinate, equation that gives it): pairs that are not avoided first.

        Among these, joints that give both x and y of a body come first. If only avoided pairs (body, joint) are left,
        those of one body are returned.
        """
        joint_candidates = {(k, self.rows[r].owner) for k, r in candidates}
        is_complete = {
            (k, r): all((j, self.rows[r].owner) in joint_candidates for j in _add_sibling_coordinate(k))
            for k, r in candidates
        }
        names = [body.name for body in self.model.bodies]
        rank = {
            (k, r): ((names[k // 3], self.rows[r].owner) in self._avoided_pairs, not is_complete[k, r])
            for k, r in candidates
        }
        best_rank = min(rank.values(), default=None)
        best = [pair for pair in candidates if rank[pair] == best_rank]
        only_avoided = bool(best) and rank[best[0]][0]  # once one body has a position, others may get theirs from it
        return [(k, r) for k, r in best if not only_avoided or k // 3 == best[0][0] // 3]

    def find_leaves_without_inertia(self) -> set[tuple[str, str]]:
        """Return pairs (body, joint) of leaf bodies with negligible moment of inertia about their positioning joint.

        That joint gives the position of the body from that of the body that carries it. A leaf carries no other body;
        bodies whose angle an equation gives are left out. Both are names. The criterion is
        `Model.has_negligible_inertia`.
        """
        joints, bodies = self.model.scene.mechanism.joints, self.model.bodies
        positioning_joints = {
            (bodies[first_coordinate // 3].name, owner)
            for (first_coordinate, *_), r in self.groups
            if first_coordinate % 3 < 2 and (owner := self.rows[r].owner) in joints
        }
        ends = [(body, joints[owner]) for body, owner in positioning_joints]
        carriers = {joint.first.body if joint.second.body == body else joint.second.body for body, joint in ends}
        rotating_bodies = {
            bodies[first_coordinate // 3].name
            for coordinates, _ in self.groups
            for first_coordinate in coordinates
            if first_coordinate % 3 == 2
        }
        free_ends = [(body, joint) for body, joint in ends if body not in carriers | rotating_bodies]
        return {(body, joint.name) for body, joint in free_ends if self.model.has_negligible_inertia(body, joint)}


def order_dependent_coordinates(system: System, rows: Sequence[Row]) -> DependentCoordinates:
    """Return the assignment of equations to coordinates that avoids joints about which a leaf body has no inertia.

    Pairs that `find_leaves_without_inertia` returns are avoided where possible; the assignment is repeated until it
    returns no new ones.
    """
    avoided_pairs: set[tuple[str, str]] = set()
    while True:
        dependent_coordinates = DependentCoordinates(system, rows, frozenset(avoided_pairs))
        leaves_without_inertia = dependent_coordinates.find_leaves_without_inertia()
        if leaves_without_inertia <= avoided_pairs:
            return dependent_coordinates
        avoided_pairs |= leaves_without_inertia


class FirstPivots:
    """The nodes that are eliminated first, from the leaves of the tree of bodies to the ground.

    `order`: coordinates; a line's equation after its x and y. `partner`: the equation that is eliminated together with
    a coordinate. `rows`: all equations among them. Nodes are coordinates, then equations.
    """

    def __init__(self, system: System, rows: Sequence[Row]) -> None:
        """Determine the order in absolute coordinates; in tree coordinates there are no such nodes.

        `rows`: the constraint equations, which are nodes after the coordinates.
        """
        groups = [] if system.in_tree else order_dependent_coordinates(system, rows).groups
        n = len(system.q)
        self.partner = {coordinates[0]: n + r for coordinates, r in reversed(groups) if len(coordinates) == 1}
        self.order = [
            k
            for coordinates, r in reversed(groups)
            for k in (coordinates if len(coordinates) == 1 else (*coordinates, n + r))
        ]
        self.rows = frozenset(n + r for _, r in groups)


def _add_sibling_coordinate(k: int) -> set[int]:
    """Return the indices {x, y} of a body if coordinate k is one of them, else {k} for its angle."""
    return {k} if k % 3 == 2 else {k - k % 3, k - k % 3 + 1}


def is_unit(entry: sp.Expr) -> bool:
    """Return whether an entry of Φ_q is 1 or −1."""
    return bool(entry.is_Number and abs(entry) == 1)

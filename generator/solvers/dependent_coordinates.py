"""The order in which coordinates of the bodies are eliminated together with the constraint equations that give them.

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
    """Places the bodies from the ground on, each by equations whose other coordinates are placed already.

    `groups`, in the order of placing: a coordinate and its equation, or x, y and the equation of a line. No equation
    depends on a coordinate that is placed after its own.
    """

    def __init__(self, system: System, rows: Sequence[Row], avoided: frozenset[tuple[str, str]] = frozenset()) -> None:
        """Place all bodies; `avoided` pairs (body, joint) are used only if nothing else places the body."""
        self.model: Model = system.model
        self.rows, self._avoided = rows, avoided
        place = {q: k for k, q in enumerate(system.q)}
        self._entries = [{place[q]: entry for q, entry in row.phi_q.items()} for row in rows]
        self._constant = [self._with_constant_entry(entries) for entries in self._entries]
        self.groups: list[tuple[tuple[int, ...], int]] = []
        self._known: set[int] = set()
        self._used: set[int] = set()
        while self._place_pairs() or self._place_by_line() or self._place_freely():
            pass

    def _with_constant_entry(self, entries: dict[int, sp.Expr]) -> set[int]:
        """Return the coordinates whose entry in an equation is ±1.

        Of an equation in angles alone these are all, if their entries are constant.
        """
        if all(k % 3 == 2 and self.model.slots.is_constant(entry) for k, entry in entries.items()):
            return set(entries)
        return {k for k, entry in entries.items() if k % 3 < 2 and is_unit(entry)}

    def _open_coordinates(self, r: int) -> set[int]:
        """Return the coordinates with a constant entry in equation r that are not placed yet."""
        return self._constant[r] - self._known

    def _place_pairs(self) -> bool:
        """Place a coordinate by each equation that leaves only that one open; return whether any was.

        If there are several candidates, only the best of them are used.
        """
        ready = [
            (min(self._open_coordinates(r)), r) for r in range(len(self.rows)) if len(self._open_coordinates(r)) == 1
        ]
        for k, r in self._best_candidates(ready):
            if k not in self._known:
                self._place((k,), r)
        return bool(ready)

    def _place_by_line(self) -> bool:
        """Place x and y of a body by the first equation that has both; return whether any was placed."""
        for r, entries in enumerate(self._entries):
            places = sorted(k for k in entries if k % 3 < 2 and k not in self._known)
            if r not in self._used and len(places) == 2 and places[0] // 3 == places[1] // 3:
                self._place(tuple(places), r)
                return True
        return False

    def _place_freely(self) -> bool:
        """Mark a body as placed that no equation ties to placed ones; return whether there was any."""
        tied = [*self._constant, *({k for k in entries if k % 3 < 2} for entries in self._entries)]
        first = next((k for coordinates in tied for k in sorted(coordinates - self._known)), None)
        if first is not None:
            self._known |= _with_sibling(first)
        return first is not None

    def _place(self, coordinates: tuple[int, ...], r: int) -> None:
        """Record the coordinates as placed by equation r."""
        self.groups.append((coordinates, r))
        self._known |= set(coordinates)
        self._used.add(r)

    def _best_candidates(self, ready: Pairs) -> Pairs:
        """Return the candidates (coordinate, equation) whose joint places both x and y of a body, if any."""
        owners = {(k, self.rows[r].owner) for k, r in ready}
        whole = {(k, r): all((j, self.rows[r].owner) in owners for j in _with_sibling(k)) for k, r in ready}
        names = [body.name for body in self.model.bodies]
        order = {(k, r): ((names[k // 3], self.rows[r].owner) in self._avoided, not whole[k, r]) for k, r in ready}
        best = [pair for pair in ready if order[pair] == min(order.values())]
        alone = bool(best) and order[best[0]][0]  # with one body that is placed others may be placed by it
        return [(k, r) for k, r in best if not alone or k // 3 == best[0][0] // 3]

    def light_ends(self) -> set[tuple[str, str]]:
        """Return pairs (body, joint) of bodies that turn freely and have no inertia about the joint.

        Such a body carries no other, and is placed by that joint.
        """
        joints, bodies = self.model.scene.mechanism.joints, self.model.bodies
        placed = {
            (bodies[k // 3].name, owner)
            for (k, *_), r in self.groups
            if k % 3 < 2 and (owner := self.rows[r].owner) in joints
        }
        ends = [(body, joints[owner]) for body, owner in placed]
        carry = {joint.first.body if joint.second.body == body else joint.second.body for body, joint in ends}
        turned = {bodies[k // 3].name for own, _ in self.groups for k in own if k % 3 == 2}
        free = [(body, joint) for body, joint in ends if body not in carry | turned]
        return {(body, joint.name) for body, joint in free if self.model.is_light(body, joint)}


def place_bodies(system: System, rows: Sequence[Row]) -> DependentCoordinates:
    """Return the order of placing in which bodies are placed by joints about which they have inertia, if possible."""
    avoided: set[tuple[str, str]] = set()
    while True:
        found = DependentCoordinates(system, rows, frozenset(avoided))
        light = found.light_ends()
        if light <= avoided:
            return found
        avoided |= light


class FirstPivots:
    """The nodes that are eliminated first, bodies at the ends of chains before those that carry them.

    `order`: coordinates; a line's equation after its x and y. `partner`: the equation that is eliminated together with
    a
    coordinate. `rows`: all equations among them. Nodes are coordinates, then equations.
    """

    def __init__(self, system: System, rows: Sequence[Row]) -> None:
        """Determine the order in absolute coordinates; in tree coordinates there are no such nodes."""
        groups = [] if system.in_tree else place_bodies(system, rows).groups
        n = len(system.q)
        self.partner = {own[0]: n + r for own, r in reversed(groups) if len(own) == 1}
        self.order = [k for own, r in reversed(groups) for k in (own if len(own) == 1 else (*own, n + r))]
        self.rows = frozenset(n + r for _, r in groups)


def _with_sibling(k: int) -> set[int]:
    """Return x and y of the body if coordinate k is one of them, else {k} for an angle."""
    return {k} if k % 3 == 2 else {k - k % 3, k - k % 3 + 1}


def is_unit(entry: sp.Expr) -> bool:
    """Return whether an entry of Φ_q is 1 or −1."""
    return bool(entry.is_Number and abs(entry) == 1)

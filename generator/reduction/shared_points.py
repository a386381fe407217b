"""Points where three or more bodies meet (hubs): the choice of joints between them is free.

k points that coincide need k − 1 pairs of equations, but any tree of pairs will do. The tree of the bodies may use
any of them, and a loop is closed between the two bodies whose difference has the fewest moving arms.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from gudgeon.generator.kinds.joints.joint_type import joint_types
from gudgeon.generator.mechanism import Joint

Point = tuple[str, str]  # body, point


def ends(joint: Joint) -> tuple[Point, Point]:
    """Return both points (body, point) of a joint."""
    return (joint.first.body, joint.first.point), (joint.second.body, joint.second.point)


@dataclass(frozen=True)
class Hub:
    """Points that coincide, the joints of the file that connect them, and every pair of their bodies as a joint."""

    points: frozenset[Point]
    joints: tuple[Joint, ...]
    pairs: tuple[Joint, ...]

    @property
    def rows(self) -> list[str]:
        """Return the names of the equations of the file's joints that make the points coincide."""
        return [row for joint in self.joints for row in self.rows_of(joint)]

    @staticmethod
    def rows_of(joint: Joint) -> list[str]:
        """Return the names of the equations of a pair that make its points coincide."""
        return [f"{joint.name}.{row}" for row in joint_types()[joint.kind].carries]

    def closing(self, tree: Iterable[Joint], cost: Callable[[Joint], int]) -> list[Joint]:
        """Return the cheapest pairs that connect the points which the tree leaves apart (Kruskal's algorithm)."""
        groups = {point: {point} for point in self.points}
        found = []
        names = {joint.name for joint in tree}
        held = [joint for joint in self.pairs if joint.name in names]
        for joint in [*held, *sorted(self.pairs, key=cost)]:
            one, two = (groups[point] for point in ends(joint))
            if one is two:
                continue
            if joint.name not in names:
                found.append(joint)
            for point in two:
                groups[point] = one
            one |= two
        return found

    def share(self, spanning: Sequence[Joint], joint: Joint) -> dict[str, int]:
        """Return the multiplier of a pair as a sum of those of the file's joints, with signs.

        They are the joints that cross the cut which removing the pair from `spanning` makes.
        """
        side = {ends(joint)[0]}
        grown = True
        while grown:
            grown = False
            for one, two in (ends(other) for other in spanning if other is not joint):
                if (one in side) != (two in side):
                    side |= {one, two}
                    grown = True
        crossing = {}
        for other in self.joints:
            one, two = ends(other)
            if (one in side) != (two in side):
                crossing[other.name] = 1 if one in side else -1
        return crossing


def find_hubs(joints: Iterable[Joint]) -> list[Hub]:
    """Return the hubs: points of three or more bodies with as many joints as a tree needs."""
    groups: dict[Point, list[Joint]] = {}
    for joint in joints:
        if joint_types()[joint.kind].holds_points:
            one, two = (groups.get(point, []) for point in ends(joint))
            merged = [*one, *(j for j in two if j not in one), joint]
            for point in {p for j in merged for p in ends(j)}:
                groups[point] = merged
    found = []
    for group in {tuple(j.name for j in group): group for group in groups.values()}.values():
        points = frozenset(p for joint in group for p in ends(joint))
        plain = [j for j in group if joint_types()[j.kind].is_pivot]
        if plain and len(points) == len(group) + 1 >= 3:
            found.append(Hub(points, tuple(group), tuple(_pairs(group, plain[0]))))
    return found


def _pairs(group: Sequence[Joint], plain: Joint) -> list[Joint]:
    """Return the file's joints, and a joint for every other pair of points on different bodies."""
    known = {frozenset(ends(joint)) for joint in group}
    refs = {end: ref for joint in group for end, ref in zip(ends(joint), (joint.first, joint.second), strict=True)}
    others = [
        replace(plain, name=f"{a.body}.{a.point}={b.body}.{b.point}", first=a, second=b)
        for (one, a), (two, b) in combinations(refs.items(), 2)
        if a.body != b.body and frozenset((one, two)) not in known
    ]
    return [*group, *others]

"""Multiple joints: points where three or more bodies meet, and the choice of the pairs of bodies that are connected.

k points that coincide need k − 1 pairs of equations, but any tree of pairs will do. The spanning tree of the bodies
may use any of them. A loop is closed between the two bodies whose difference contains the fewest coordinates.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from gudgeon.generator.kinds.joints.joint_type import find_joint_types
from gudgeon.generator.mechanism import Joint

Point = tuple[str, str]  # body, point


def find_end_points(joint: Joint) -> tuple[Point, Point]:
    """Return both points of a joint, each as (body, point)."""
    return (joint.first.body, joint.first.point), (joint.second.body, joint.second.point)


@dataclass(frozen=True)
class MultipleJoint:
    """A multiple joint: points that coincide, the joints of the file that connect them, and all pairs of bodies.

    A pair is a joint between two of the points: one of the file, or a new revolute joint.
    """

    points: frozenset[Point]
    joints: tuple[Joint, ...]
    pairs: tuple[Joint, ...]

    @property
    def row_names(self) -> list[str]:
        """Return the names of the constraint equations by which the file's joints make the points coincide."""
        return [row for joint in self.joints for row in self.list_pair_rows(joint)]

    @staticmethod
    def list_pair_rows(joint: Joint) -> list[str]:
        """Return the names of the constraint equations by which a joint makes its two points coincide."""
        return [f"{joint.name}.{row}" for row in find_joint_types()[joint.kind].positioning_rows]

    def find_connecting_pairs(self, tree_joints: Iterable[Joint], compute_cost: Callable[[Joint], int]) -> list[Joint]:
        """Return the cheapest pairs that connect the points which the tree leaves unconnected (Kruskal's algorithm).

        A pair is a joint between two of the points. `tree_joints`: joints of the spanning tree; `compute_cost` returns
        the cost of a pair.
        """
        groups = {point: {point} for point in self.points}
        result = []
        names = {joint.name for joint in tree_joints}
        tree_pairs = [joint for joint in self.pairs if joint.name in names]
        for joint in [*tree_pairs, *sorted(self.pairs, key=compute_cost)]:
            first_group, second_group = (groups[point] for point in find_end_points(joint))
            if first_group is second_group:
                continue
            if joint.name not in names:
                result.append(joint)
            for point in second_group:
                groups[point] = first_group
            first_group |= second_group
        return result

    def find_multiplier_signs(self, spanning_pairs: Sequence[Joint], joint: Joint) -> dict[str, int]:
        """Return the multiplier of a pair as a sum of those of the file's joints: {joint: 1 or −1}.

        They are the joints that cross the cut which removing the pair from `spanning_pairs` makes. `joint`: the pair;
        `spanning_pairs`: the pairs that connect all points.
        """
        connected = {find_end_points(joint)[0]}
        has_grown = True
        while has_grown:
            has_grown = False
            for first, second in (find_end_points(other) for other in spanning_pairs if other is not joint):
                if (first in connected) != (second in connected):
                    connected |= {first, second}
                    has_grown = True
        signs = {}
        for other in self.joints:
            first, second = find_end_points(other)
            if (first in connected) != (second in connected):
                signs[other.name] = 1 if first in connected else -1
        return signs


def find_multiple_joints(joints: Iterable[Joint]) -> list[MultipleJoint]:
    """Return the multiple joints: coincident points of three or more bodies, connected by joints without a loop.

    Only joints that make their points coincide count, and at least one must be revolute. Points whose joints form a
    loop are left out.
    """
    groups: dict[Point, list[Joint]] = {}
    for joint in joints:
        if find_joint_types()[joint.kind].has_coincident_points:
            first_group, second_group = (groups.get(point, []) for point in find_end_points(joint))
            merged = [*first_group, *(j for j in second_group if j not in first_group), joint]
            for point in {p for j in merged for p in find_end_points(j)}:
                groups[point] = merged
    multiple_joints = []
    for group in {tuple(j.name for j in group): group for group in groups.values()}.values():
        points = frozenset(p for joint in group for p in find_end_points(joint))
        pivots = [j for j in group if find_joint_types()[j.kind].is_pivot]
        if pivots and len(points) == len(group) + 1 >= 3:
            multiple_joints.append(MultipleJoint(points, tuple(group), tuple(_make_pairs(group, pivots[0]))))
    return multiple_joints


def _make_pairs(group: Sequence[Joint], template: Joint) -> list[Joint]:
    """Return the joints `group` of a shared point, and a new joint for every other pair of points of different bodies.

    `template`: a revolute joint of the group, of which the new joints are copies with other points. Their names are
    "<body>.<point>=<body>.<point>".
    """
    known_pairs = {frozenset(find_end_points(joint)) for joint in group}
    ref_of_point = {
        end: ref
        for joint in group
        for end, ref in zip(find_end_points(joint), (joint.first, joint.second), strict=True)
    }
    others = [
        replace(template, name=f"{a.body}.{a.point}={b.body}.{b.point}", first=a, second=b)
        for (first, a), (second, b) in combinations(ref_of_point.items(), 2)
        if a.body != b.body and frozenset((first, second)) not in known_pairs
    ]
    return [*group, *others]

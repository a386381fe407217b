"""What a joint type declares. One file in this folder is one joint type; it exports `JOINT`.

As with the laws, nothing here imports SymPy at the top: the reader needs only the YAML fields.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from gudgeon.generator.field import Field
from gudgeon.generator.kinds.discovery import declared

# Of a slider with play: in front, along the axis (1), or behind; at the wall to the left of the axis (1), or the right.
CORNERS: Mapping[str, tuple[int, int]] = {
    "front_upper": (1, 1), "front_lower": (1, -1), "rear_upper": (-1, 1), "rear_lower": (-1, -1),
}  # fmt: skip


@dataclass(frozen=True)
class JointType:
    """A joint type: the YAML key `kind: [first.point, second.point]`, more fields, its Φ rows.

    `rows(first, second, fields)` gets two PointFrames (generator/equations/geometry.py) and the JointFields
    (generator/equations/constraints.py) and returns one SymPy expression a row name.
    """

    kind: str
    title: str
    fields: tuple[Field, ...]  # the keys beside its own, such as `axis` of a translational joint
    play: str  # what its play is that of, a key of a scene's `play`: "bearing", "guide", or "" where it can have none
    row_names: tuple[str, ...]  # one short name a row of Φ: the row is called "<joint>.<row name>"
    row_units: tuple[str, ...]  # "m" or "rad", a row each
    rows: Callable[..., list[Any]]
    joins: str = "points"  # "points": [L1.head, L2.tail]; "bodies": [L1, L4]
    reaction_at: str = "second"  # the point of which body the reaction is given at
    # rows that hold by themselves where tree coordinates place one body by the other: two rows where the points
    # coincide, one where the second's point slides along the first's `axis` (generator/reduction/tree.py)
    carries: tuple[str, ...] = ()
    also: tuple[str, ...] = ()  # what others call it: told to whoever writes that


@cache
def joint_types() -> Mapping[str, JointType]:
    """All the joint types in this folder by kind."""
    return {joint.kind: joint for joint in declared("gudgeon.generator.kinds.joints", "JOINT", JointType)}

"""A scene at one position, as a drawing asks for it: where its points are, its numbers by their addresses."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from gudgeon.assembly.linkage import place_of
from gudgeon.contract.clearance_info import ClearanceInfo
from gudgeon.contract.kernel_source import BodyInfo, KernelSource, PartInfo, PointInfo
from gudgeon.errors import GudgeonError
from gudgeon.generator.field import VECTOR
from gudgeon.generator.kinds.drives import DRIVES
from gudgeon.generator.kinds.forces.force_type import element_types
from gudgeon.generator.kinds.joints.joint_type import JointType, joint_types
from gudgeon.language.units import DIMENSIONLESS
from gudgeon.model.compiled import Array
from gudgeon.model.contours import slider_of

GROUND = "ground"
UNKNOWN = JointType("", "joint", (), "", (), (), lambda *_: [], None)  # of a file that a later gudgeon wrote


@dataclass(frozen=True, eq=False)
class Posture:
    """q (n,) of a scene with the numbers p (as `prepare` gives them), at t (s).

    `v` (n,) turns arrows of drives the right way round; `loads` are the values of the elements `force` (N, ground axes)
    and `torque` (N·m, 0), by name. Raises GudgeonError where the scene does not say what it joins.
    """

    source: KernelSource
    p: Array
    q: Array
    t: float = 0.0
    v: Array | None = None
    loads: Mapping[str, tuple[float, float]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.source.start_rows and not self.source.parts:
            raise GudgeonError(
                "this result does not say what its joints, drives and forces join: an earlier version of gudgeon wrote"
                " it\n  run the scene again"
            )

    @cached_property
    def points(self) -> Mapping[str, PointInfo]:
        """By name."""
        return {point.name: point for point in self.source.points}

    @cached_property
    def bodies(self) -> Mapping[str, BodyInfo]:
        """By name."""
        return {body.name: body for body in self.source.bodies}

    @cached_property
    def held(self) -> Mapping[str, tuple[str, ...]]:
        """Of each body the points that are held or named, in this order."""
        used = [end for part in self.source.parts if _joins_points(part) for end in part.ends]
        used += [name for name in self.points if name.partition(".")[2] not in ("origin", "com")]
        found = dict[str, list[str]]()
        for name in dict.fromkeys(used):
            found.setdefault(body_of(name), []).append(name)
        return {body: tuple(names) for body, names in found.items()}

    @cached_property
    def _slots(self) -> Mapping[str, int]:
        return {slot.address: k for k, slot in enumerate(self.source.slots)}

    @cached_property
    def clearances(self) -> Mapping[str, ClearanceInfo]:
        """Joints with play by name: journals, whose play is a circle."""
        return {joint.name: joint for joint in self.source.clearances if not joint.at_wall}

    @cached_property
    def guides(self) -> Mapping[str, tuple[ClearanceInfo, ...]]:
        """Sliders with play in their guides by joint: their corners."""
        corners = [one for one in self.source.clearances if one.at_wall]
        return {name: tuple(one for one in corners if one.joint == name) for name in self.source.guides}

    def play(self, joint: str) -> float:
        """Radial clearance of a joint with play, of a guide the gap on each side, m."""
        return float(self.p[next(one.clearance for one in self.source.clearances if one.joint == joint)])

    def slider(self, joint: ClearanceInfo) -> tuple[str, float, float, float]:
        """Of a corner's slider the guide's address, half its length and height and the radius of its corners, m."""
        return slider_of(self.source, self.p, joint)

    def parts(self, section: str, *kinds: str) -> Iterator[PartInfo]:
        """Those of a section of the file, of these kinds or of all."""
        for part in self.source.parts:
            if part.section == section and (not kinds or part.kind in kinds):
                yield part

    def parts_named(self, name: str) -> Iterator[PartInfo]:
        """The one of that name: joints, drives and forces share one set of names."""
        return (part for part in self.source.parts if part.name == name)

    @cached_property
    def _places(self) -> dict[str, Array]:
        return {}

    def place(self, point: str) -> Array:
        """Where a point is in ground axes, (2,), m; the origin for the ground itself."""
        if point not in self._places:
            info = self.points.get(point)
            self._places[point] = place_of(self.source, self.p, self.q, info) if info is not None else np.zeros(2)
        return self._places[point]

    def centre(self, body: str) -> Array:
        """Its centre of mass, (2,), m."""
        k = self.bodies[body].index
        return self.q[k : k + 2]

    def theta(self, body: str) -> float:
        """Its angle, rad; 0 of the ground."""
        return float(self.q[self.bodies[body].index + 2]) if body in self.bodies else 0.0

    def omega(self, body: str) -> float:
        """Its angular velocity, rad/s; 0 where none is known."""
        if self.v is None or body not in self.bodies:
            return 0.0
        return float(self.v[self.bodies[body].index + 2])

    def number(self, address: str) -> float:
        """A number of the file, SI; 0 where nothing or a plain 0 is written."""
        return float(self.p[self._slots[address]]) if address in self._slots else 0.0

    def has(self, address: str) -> bool:
        """Whether the file says a number, 0 too."""
        return address in self._slots or any(one.address == address for one in self.source.written)

    def direction(self, part: PartInfo, key: str, body: str) -> Array:
        """A part's vector in the axes of a body as a unit vector in ground axes, (2,)."""
        x, y = (self.number(f"{part.section}.{part.name}.{key}.{axis}") for axis in "xy")
        size, angle = float(np.hypot(x, y)), self.theta(body)
        if not size > 0.0:
            return np.array([1.0, 0.0])
        c, s = np.cos(angle), np.sin(angle)
        return np.array([c * x - s * y, s * x + c * y]) / size


def type_of(joint: PartInfo) -> JointType:
    """What a joint's kind declares."""
    return joint_types().get(joint.kind, UNKNOWN)


def _joins_points(part: PartInfo) -> bool:
    """Whether a part's ends are points, and not whole bodies."""
    if part.section == "joints":
        return type_of(part).joins == "points"
    kinds = DRIVES if part.section == "drives" else element_types()
    return part.kind not in kinds or kinds[part.kind].targets == "points"


def directions(part: PartInfo) -> list[str]:
    """Keys of a joint or force element that are directions: vectors without a dimension."""
    fields = type_of(part).fields if part.section == "joints" else ()
    if part.section == "forces" and part.kind in element_types():
        fields = element_types()[part.kind].fields
    return [own.name for own in fields if own.kind == VECTOR and own.dimension == DIMENSIONLESS]


def body_of(end: str) -> str:
    """Whose point it is: "L1.head" is a point of L1."""
    return end.partition(".")[0]


def anchors(posture: Posture, body: str) -> dict[str, Array]:
    """Points of a body that its outline goes through, by name: what joints, drives and forces hold, a bar's ends, what
    the file names; without two of these the centre of mass too."""
    found = {name: posture.place(name) for name in posture.held.get(body, ())}
    if len(distinct(found.values())) < 2:
        found[f"{body}.com"] = posture.centre(body)
    return found


def distinct(places: object) -> list[Array]:
    """Places that differ, in their order."""
    found: list[Array] = []
    for place in places:  # type: ignore[attr-defined]
        if all(float(np.linalg.norm(place - other)) > 1e-9 * (1.0 + float(np.linalg.norm(place))) for other in found):
            found.append(place)
    return found

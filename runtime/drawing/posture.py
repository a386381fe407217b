"""Own `Posture`, a scene at one position: positions of its points, and its parameters by address."""

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
    """A scene at the position q (n,) and time t (s), with parameters p as returned by `prepare`.

    `v` (n,) decides the directions of drives' arrows; `loads` are the values of the elements `force` (N, ground axes)
    and `torque` (N·m, 0), by name. Raises GudgeonError for a scene whose file lacks the ends of its parts.
    """

    source: KernelSource
    p: Array
    q: Array
    t: float = 0.0
    v: Array | None = None
    loads: Mapping[str, tuple[float, float]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Raise GudgeonError for a scene whose file lacks the ends of its parts."""
        if self.source.start_rows and not self.source.parts:
            raise GudgeonError(
                "this result does not say what its joints, drives and forces join: an earlier version of gudgeon wrote"
                " it\n  run the scene again"
            )

    @cached_property
    def points(self) -> Mapping[str, PointInfo]:
        """Points of the scene by name."""
        return {point.name: point for point in self.source.points}

    @cached_property
    def bodies(self) -> Mapping[str, BodyInfo]:
        """Bodies of the scene by name."""
        return {body.name: body for body in self.source.bodies}

    @cached_property
    def held(self) -> Mapping[str, tuple[str, ...]]:
        """Names of the points of each body that joints or elements use or the file names, in this order."""
        used = [end for part in self.source.parts if _joins_points(part) for end in part.ends]
        used += [name for name in self.points if name.partition(".")[2] not in ("origin", "com")]
        found = dict[str, list[str]]()
        for name in dict.fromkeys(used):
            found.setdefault(body_of(name), []).append(name)
        return {body: tuple(names) for body, names in found.items()}

    @cached_property
    def _slots(self) -> Mapping[str, int]:
        """Index of each parameter by address."""
        return {slot.address: k for k, slot in enumerate(self.source.slots)}

    @cached_property
    def clearances(self) -> Mapping[str, ClearanceInfo]:
        """Joints with play by name whose play is a circle."""
        return {joint.name: joint for joint in self.source.clearances if not joint.at_wall}

    @cached_property
    def guides(self) -> Mapping[str, tuple[ClearanceInfo, ...]]:
        """Corners of the sliders with play by joint."""
        corners = [one for one in self.source.clearances if one.at_wall]
        return {name: tuple(one for one in corners if one.joint == name) for name in self.source.guides}

    def play(self, joint: str) -> float:
        """Return the radial clearance of a joint with play, or the gap on each side of a guide, m."""
        return float(self.p[next(one.clearance for one in self.source.clearances if one.joint == joint)])

    def slider(self, joint: ClearanceInfo) -> tuple[str, float, float, float]:
        """Return the guide's address, half the slider's length and height, and the radius of its corners (m), for a
        corner.
        """
        return slider_of(self.source, self.p, joint)

    def parts(self, section: str, *kinds: str) -> Iterator[PartInfo]:
        """Yield the parts of a section of the file, of some kinds or of all."""
        for part in self.source.parts:
            if part.section == section and (not kinds or part.kind in kinds):
                yield part

    def parts_named(self, name: str) -> Iterator[PartInfo]:
        """Return the part of that name, as an iterator: joints, drives and forces have different names."""
        return (part for part in self.source.parts if part.name == name)

    @cached_property
    def _places(self) -> dict[str, Array]:
        """Cache of positions by point."""
        return {}

    def place(self, point: str) -> Array:
        """Return the position of a point in ground axes, (2,), m; the origin for the ground itself."""
        if point not in self._places:
            info = self.points.get(point)
            self._places[point] = place_of(self.source, self.p, self.q, info) if info is not None else np.zeros(2)
        return self._places[point]

    def centre(self, body: str) -> Array:
        """Return the position of a body's centre of mass, (2,), m."""
        k = self.bodies[body].index
        return self.q[k : k + 2]

    def theta(self, body: str) -> float:
        """Return the angle of a body, rad; 0 for the ground."""
        return float(self.q[self.bodies[body].index + 2]) if body in self.bodies else 0.0

    def omega(self, body: str) -> float:
        """Return the angular velocity of a body, rad/s; 0 if it is not known."""
        if self.v is None or body not in self.bodies:
            return 0.0
        return float(self.v[self.bodies[body].index + 2])

    def number(self, address: str) -> float:
        """Return a parameter of the file, SI; 0 if it is absent or a plain 0."""
        return float(self.p[self._slots[address]]) if address in self._slots else 0.0

    def has(self, address: str) -> bool:
        """Return whether the file specifies a value at an address."""
        return address in self._slots or any(one.address == address for one in self.source.written)

    def direction(self, part: PartInfo, key: str, body: str) -> Array:
        """Return a vector of a part, given in the axes of a body, as a unit vector in ground axes, (2,)."""
        x, y = (self.number(f"{part.section}.{part.name}.{key}.{axis}") for axis in "xy")
        size, angle = float(np.hypot(x, y)), self.theta(body)
        if not size > 0.0:
            return np.array([1.0, 0.0])
        c, s = np.cos(angle), np.sin(angle)
        return np.array([c * x - s * y, s * x + c * y]) / size


def type_of(joint: PartInfo) -> JointType:
    """Return the declaration of a joint's kind."""
    return joint_types().get(joint.kind, UNKNOWN)


def _joins_points(part: PartInfo) -> bool:
    """Return whether the ends of a part are points rather than bodies."""
    if part.section == "joints":
        return type_of(part).joins == "points"
    kinds = DRIVES if part.section == "drives" else element_types()
    return part.kind not in kinds or kinds[part.kind].targets == "points"


def directions(part: PartInfo) -> list[str]:
    """Return the keys of a joint or force element that are directions: vectors without a dimension."""
    fields = type_of(part).fields if part.section == "joints" else ()
    if part.section == "forces" and part.kind in element_types():
        fields = element_types()[part.kind].fields
    return [own.name for own in fields if own.kind == VECTOR and own.dimension == DIMENSIONLESS]


def body_of(end: str) -> str:
    """Return the body of a point: "L1.head" is a point of L1."""
    return end.partition(".")[0]


def anchors(posture: Posture, body: str) -> dict[str, Array]:
    """Return the points of a body's outline by name: ends of joints, drives, forces and bars, and named points.

    If there are fewer than two, the centre of mass is added.
    """
    found = {name: posture.place(name) for name in posture.held.get(body, ())}
    if len(distinct(found.values())) < 2:
        found[f"{body}.com"] = posture.centre(body)
    return found


def distinct(places: object) -> list[Array]:
    """Return the positions without repetitions, in their order."""
    found: list[Array] = []
    for place in places:  # type: ignore[attr-defined]
        if all(float(np.linalg.norm(place - other)) > 1e-9 * (1.0 + float(np.linalg.norm(place))) for other in found):
            found.append(place)
    return found

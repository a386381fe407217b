"""Define `Configuration`, a mechanism at one position for drawing: coordinates q, parameters p, velocities, loads."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from gudgeon.assembly.linkage import compute_point_position
from gudgeon.contract.clearance_info import ClearanceInfo
from gudgeon.contract.kernel_source import BodyInfo, KernelSource, PartInfo, PointInfo
from gudgeon.errors import GudgeonError
from gudgeon.generator.field import VECTOR
from gudgeon.generator.kinds.drives import DRIVES
from gudgeon.generator.kinds.forces.force_type import find_element_types
from gudgeon.generator.kinds.joints.joint_type import JointType, find_joint_types
from gudgeon.language.units import DIMENSIONLESS
from gudgeon.model.compiled import Array
from gudgeon.model.contours import find_slider_dimensions

GROUND = "ground"
UNKNOWN = JointType("", "joint", (), "", (), (), lambda *_: [], None)  # a kind of a file from a later version


@dataclass(frozen=True, eq=False)
class Configuration:
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
        if self.source.start_equations and not self.source.parts:
            raise GudgeonError(
                "this result lacks the ends of its joints, drives and forces: an earlier version of gudgeon wrote it\n"
                "  run the scene again"
            )

    @cached_property
    def points(self) -> Mapping[str, PointInfo]:
        """Return the points of the scene by name."""
        return {point.name: point for point in self.source.points}

    @cached_property
    def bodies(self) -> Mapping[str, BodyInfo]:
        """Return the bodies of the scene by name."""
        return {body.name: body for body in self.source.bodies}

    @cached_property
    def outline_points(self) -> Mapping[str, tuple[str, ...]]:
        """Return the names of the points of each body that are drawn, by body.

        First the ends of joints, drives and force elements that join points, then named points of the file other than
        origin and com. A body without such points is absent.
        """
        end_names = [end for part in self.source.parts if _is_between_points(part) for end in part.ends]
        end_names += [name for name in self.points if name.partition(".")[2] not in ("origin", "com")]
        names_by_body = dict[str, list[str]]()
        for name in dict.fromkeys(end_names):
            names_by_body.setdefault(get_body_name(name), []).append(name)
        return {body: tuple(names) for body, names in names_by_body.items()}

    @cached_property
    def _parameter_indices(self) -> Mapping[str, int]:
        """Return the index of each parameter by address."""
        return {parameter.address: k for k, parameter in enumerate(self.source.parameters)}

    @cached_property
    def clearances(self) -> Mapping[str, ClearanceInfo]:
        """Return the joints with a circular clearance (bearings with play) by name."""
        return {joint.name: joint for joint in self.source.clearances if not joint.is_corner}

    @cached_property
    def guides(self) -> Mapping[str, tuple[ClearanceInfo, ...]]:
        """Return the contacts of the four corners of each slider with play, by the name of the joint."""
        corners = [contact for contact in self.source.clearances if contact.is_corner]
        return {name: tuple(contact for contact in corners if contact.joint == name) for name in self.source.guides}

    def get_clearance(self, joint: str) -> float:
        """Return the radial clearance of a joint with play, or the gap on each side of a guide, in m.

        `joint` is the name in the file. Raises StopIteration for a joint without play.
        """
        return float(
            self.p[next(clearance.clearance for clearance in self.source.clearances if clearance.joint == joint)]
        )

    def get_slider_dimensions(self, corner: ClearanceInfo) -> tuple[str, float, float, float]:
        """Return the guide's address, half the length and half the height of a slider, and the radius of its corners,
        all in m.

        `corner` is one of the contacts in `guides`.
        """
        return find_slider_dimensions(self.source, self.p, corner)

    def iterate_parts(self, section: str, *kinds: str) -> Iterator[PartInfo]:
        """Yield the joints, drives or force elements of the scene, in the order of the file.

        `section` is "joints", "drives" or "forces"; `kinds` are the kinds to yield, by default all.
        """
        for part in self.source.parts:
            if part.section == section and (not kinds or part.kind in kinds):
                yield part

    def find_parts(self, name: str) -> Iterator[PartInfo]:
        """Return an iterator over the parts of that name: one joint, drive or force element, or none."""
        return (part for part in self.source.parts if part.name == name)

    @cached_property
    def _positions(self) -> dict[str, Array]:
        """Cache of positions by point."""
        return {}

    def get_position(self, point: str) -> Array:
        """Return the position of a point in ground axes, (2,), in m; the origin if the scene has no point of that name.

        `point` is a name such as "L1.head". The position is cached in this configuration.
        """
        if point not in self._positions:
            info = self.points.get(point)
            self._positions[point] = (
                compute_point_position(self.source, self.p, self.q, info) if info is not None else np.zeros(2)
            )
        return self._positions[point]

    def get_centre_of_mass(self, body: str) -> Array:
        """Return the position of a body's centre of mass, (2,), m."""
        k = self.bodies[body].index
        return self.q[k : k + 2]

    def get_angle(self, body: str) -> float:
        """Return the angle of a body, rad; 0 for the ground."""
        return float(self.q[self.bodies[body].index + 2]) if body in self.bodies else 0.0

    def get_angular_velocity(self, body: str) -> float:
        """Return the angular velocity of a body in rad/s; 0 for the ground, and if the velocities are unknown."""
        if self.v is None or body not in self.bodies:
            return 0.0
        return float(self.v[self.bodies[body].index + 2])

    def get_parameter(self, address: str) -> float:
        """Return a parameter of the file, SI; 0 if it is absent or a plain 0."""
        return float(self.p[self._parameter_indices[address]]) if address in self._parameter_indices else 0.0

    def is_specified(self, address: str) -> bool:
        """Return whether the file specifies a value, a number or an expression, at an address."""
        return address in self._parameter_indices or any(
            entry.address == address for entry in self.source.file_expressions
        )

    def compute_direction(self, part: PartInfo, key: str, body: str) -> Array:
        """Return a vector of a joint or force element as a unit vector in ground axes, (2,).

        The file gives the vector under `key` in the axes of `body`. The result is (1, 0) if the vector is zero.
        """
        x, y = (self.get_parameter(f"{part.section}.{part.name}.{key}.{axis}") for axis in "xy")
        length, angle = float(np.hypot(x, y)), self.get_angle(body)
        if not length > 0.0:
            return np.array([1.0, 0.0])
        c, s = np.cos(angle), np.sin(angle)
        return np.array([c * x - s * y, s * x + c * y]) / length


def get_joint_type(joint: PartInfo) -> JointType:
    """Return the declaration of a joint's kind; UNKNOWN for a kind that this version does not have."""
    return find_joint_types().get(joint.kind, UNKNOWN)


def _is_between_points(part: PartInfo) -> bool:
    """Return whether a joint, drive or force element connects points; otherwise it connects bodies.

    A drive or force element of an unknown kind counts as one that connects points.
    """
    if part.section == "joints":
        return get_joint_type(part).joins == "points"
    kinds = DRIVES if part.section == "drives" else find_element_types()
    return part.kind not in kinds or kinds[part.kind].targets == "points"


def list_direction_keys(part: PartInfo) -> list[str]:
    """Return the keys of a joint's or force element's vectors without a dimension, which are directions.

    A drive has none, nor has a force element of an unknown kind.
    """
    fields = get_joint_type(part).fields if part.section == "joints" else ()
    if part.section == "forces" and part.kind in find_element_types():
        fields = find_element_types()[part.kind].fields
    return [item.name for item in fields if item.kind == VECTOR and item.dimension == DIMENSIONLESS]


def get_body_name(end: str) -> str:
    """Return the body of a point: "L1.head" is a point of L1."""
    return end.partition(".")[0]


def find_outline_points(configuration: Configuration, body: str) -> dict[str, Array]:
    """Return the positions (2,) in m of the points on a body's outline, by name.

    They are the ends of joints, drives and force elements, and the named points. If fewer than two positions differ,
    the centre of mass is added as "BODY.com".
    """
    positions = {name: configuration.get_position(name) for name in configuration.outline_points.get(body, ())}
    if len(remove_repeated_positions(positions.values())) < 2:
        positions[f"{body}.com"] = configuration.get_centre_of_mass(body)
    return positions


def remove_repeated_positions(positions: object) -> list[Array]:
    """Return positions (2,) without repetitions, in their order.

    Positions are equal if they differ by less than 1e-9 of 1 m plus their distance from the origin.
    """
    unique: list[Array] = []
    for position in positions:  # type: ignore[attr-defined]
        if all(
            float(np.linalg.norm(position - earlier)) > 1e-9 * (1.0 + float(np.linalg.norm(position)))
            for earlier in unique
        ):
            unique.append(position)
    return unique

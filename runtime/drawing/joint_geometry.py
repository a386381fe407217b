"""Define `JointGeometry`, the geometry of a joint at one position of the mechanism, from which its symbol is drawn.

Also a slider with play in its guide: the drawn distance of its walls, its tilt, and its corners.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from gudgeon.contract.kernel_source import PartInfo
from gudgeon.drawing.configuration import GROUND, Configuration, get_body_name, get_joint_type
from gudgeon.drawing.shapes import rotate_quarter_turn, unit_vector
from gudgeon.model.compiled import Array
from gudgeon.model.contours import compute_corner_approach

MIN_WALL_GAP = 0.5  # units, smallest drawn gap between a slider with play and each wall of its guide


@dataclass(frozen=True, eq=False)
class JointGeometry:
    """A joint at a configuration. Positions are arrays (2,) in ground axes, m."""

    configuration: Configuration
    part: PartInfo

    unit_vector = staticmethod(unit_vector)
    rotate_quarter_turn = staticmethod(rotate_quarter_turn)

    @property
    def bodies(self) -> list[str]:
        """Return the names of the first and the second body."""
        return [get_body_name(end) for end in self.part.ends]

    @property
    def first(self) -> Array:
        """Return the position of the first point."""
        return self.configuration.get_position(self.part.ends[0])

    @property
    def second(self) -> Array:
        """Return the position of the second point."""
        return self.configuration.get_position(self.part.ends[1])

    def get_parameter(self, key: str) -> float:
        """Return a parameter of the joint, SI; of a vector by "axis.x"."""
        return self.configuration.get_parameter(f"joints.{self.part.name}.{key}")

    def get_option(self, key: str) -> str:
        """Return an option of the joint, or a body's name."""
        return self.part.options.get(key, "")

    def direction(self, key: str, body: str) -> Array:
        """Return a vector of the joint in the axes of a body as a unit vector."""
        return self.configuration.compute_direction(self.part, key, body)

    def find_pivot(self, k: int, carrier: str) -> Array:
        """Return the pivot of one body of the joint on the body `carrier`, (2,), in m.

        `k` is 0 for the first body and 1 for the second. Without a pivot it is the joint's point on that body.
        """
        body = self.bodies[k]
        pivot = find_pivot_joint(self.configuration, body, carrier)
        end = self.part.ends[k] if pivot is None else next(end for end in pivot.ends if get_body_name(end) == body)
        return self.configuration.get_position(end)

    @cached_property
    def _axis(self) -> tuple[Array, Array, Array]:
        """Return a point on the guide's line, its direction (unit vector), and the sliding point."""
        return find_sliding_axis(self.configuration, self.part)

    @property
    def on_line(self) -> Array:
        """Return the point of the guiding body on its line."""
        return self._axis[0]

    @property
    def along(self) -> Array:
        """Return the direction of the line, a unit vector."""
        return self._axis[1]

    @property
    def slider(self) -> Array:
        """Return the position of the point that slides on the line."""
        return self._axis[2]

    @property
    def ground_guides(self) -> bool:
        """Return whether the line belongs to the ground."""
        return has_rail(self.part)


def iterate_sliding_joints(configuration: Configuration) -> Iterator[PartInfo]:
    """Return an iterator over the joints with a line on which a body slides: guides and slots."""
    return (part for part in configuration.iterate_parts("joints") if get_joint_type(part).slides)


def find_guide_and_slider(joint: PartInfo) -> tuple[str, str]:
    """Return the names of the guiding point and of the sliding point of a sliding joint.

    They are exchanged if the declared slider is the ground and the joint keeps the angle: the ground is then the guide.
    """
    slides, (first_end, second_end) = get_joint_type(joint).slides, joint.ends
    assert slides is not None
    guide, slider = (first_end, second_end) if slides.guide == "first" else (second_end, first_end)
    is_exchanged = get_joint_type(joint).has_fixed_angle and get_body_name(slider) == GROUND
    return (slider, guide) if is_exchanged else (guide, slider)


def find_sliding_axis(configuration: Configuration, joint: PartInfo) -> tuple[Array, Array, Array]:
    """Return a point on the line of a sliding joint, its direction (unit vector), and the sliding point, each (2,).

    Points are in m. The direction belongs to the body that the joint's kind declares as the guide, also if
    `find_guide_and_slider` exchanges the points.
    """
    slides, (guide, slider) = get_joint_type(joint).slides, find_guide_and_slider(joint)
    assert slides is not None
    axis_body = get_body_name(joint.ends[0 if slides.guide == "first" else 1])
    return (
        configuration.get_position(guide),
        configuration.compute_direction(joint, slides.direction, axis_body),
        configuration.get_position(slider),
    )


def has_rail(joint: PartInfo) -> bool:
    """Return whether a sliding joint's guide is the ground, so that it is drawn as a rail; False for other joints."""
    return get_joint_type(joint).slides is not None and get_body_name(find_guide_and_slider(joint)[0]) == GROUND


def is_block(joint: PartInfo) -> bool:
    """Return whether the slider cannot rotate in its guide."""
    return get_joint_type(joint).has_fixed_angle


def find_pivot_joint(configuration: Configuration, body: str, other_body: str) -> PartInfo | None:
    """Return the first joint of the file that lets two bodies rotate relative to each other, or None."""
    for joint in configuration.iterate_parts("joints"):
        if get_joint_type(joint).is_pivot and {body, other_body} <= set(map(get_body_name, joint.ends)):
            return joint
    return None


def compute_wall_gap(configuration: Configuration, joint: PartInfo, unit: float) -> float:
    """Return the drawn gap between slider and each wall of a guide, m: at least MIN_WALL_GAP units; 0 without play."""
    return (
        max(MIN_WALL_GAP * unit, configuration.get_clearance(joint.name)) if joint.name in configuration.guides else 0.0
    )


def compute_guide_directions(configuration: Configuration, joint: PartInfo) -> tuple[Array, Array]:
    """Return the drawn directions of guide and slider of a sliding joint, two unit vectors.

    Both are equal without play. With play they differ by the tilt of the slider; the ground counts as the guide if it
    is one of the bodies.
    """
    _, second = map(get_body_name, joint.ends)
    _, axis, _ = find_sliding_axis(configuration, joint)
    if joint.name not in configuration.guides:
        return axis, axis
    tilt = _compute_tilt_in_guide(configuration, joint)
    tilted_axis = math.cos(tilt) * axis + math.sin(tilt) * rotate_quarter_turn(axis)
    return (tilted_axis, axis) if second == GROUND else (axis, tilted_axis)


def _compute_tilt_in_guide(configuration: Configuration, joint: PartInfo) -> float:
    """Return the tilt of the slider of a joint with play, in rad, within ±π.

    It is the angle of the second body relative to the first, less the mounting angle `angle` of the file, or the
    direction of `axis` if there is none.
    """
    first, second = map(get_body_name, joint.ends)
    address = f"joints.{joint.name}.angle"
    if configuration.is_specified(address):
        angle = configuration.get_parameter(address)
    else:
        angle = math.atan2(*(configuration.get_parameter(f"joints.{joint.name}.axis.{axis}") for axis in "yx"))
    return math.remainder(configuration.get_angle(second) - configuration.get_angle(first) - angle, 2.0 * math.pi)


def compute_corner_approaches(configuration: Configuration, joint: str) -> Mapping[str, float]:
    """Return the displacement (m) of each corner of a slider towards its wall from the middle of its guide, by corner.

    `joint` is the name of a sliding joint with play. A corner touches its wall if the value equals the clearance.
    """
    part = next(configuration.find_parts(joint))
    first, second = part.ends
    (_, axis, _), tilt = find_sliding_axis(configuration, part), _compute_tilt_in_guide(configuration, part)
    offset = float((configuration.get_position(second) - configuration.get_position(first)) @ rotate_quarter_turn(axis))
    return {
        corner.name: compute_corner_approach(configuration.source, configuration.p, corner, offset, tilt)
        for corner in configuration.guides[joint]
    }


def find_touching_corners(configuration: Configuration) -> frozenset[str]:
    """Return the names of the corners of all sliders with play that touch or penetrate their walls."""
    return frozenset(
        name
        for joint in configuration.guides
        for name, approach in compute_corner_approaches(configuration, joint).items()
        if approach >= configuration.get_clearance(joint)
    )

"""A joint at a posture: what the functions of its `Symbol` (generator/kinds/joints/joint_type.py) may ask for.

And a slider with play in its guide: how far apart its walls are drawn, how it lies in them, where its corners are.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from gudgeon.contract.kernel_source import PartInfo
from gudgeon.drawing.posture import GROUND, Posture, body_of, type_of
from gudgeon.drawing.shapes import turned, unit_vector
from gudgeon.model.compiled import Array
from gudgeon.model.contours import corner_at

GAP = 0.5  # units: between a slider and each wall of its guide, if not more


@dataclass(frozen=True, eq=False)
class JointAt:
    """Places are arrays (2,) in ground axes, m."""

    posture: Posture
    part: PartInfo

    unit_vector = staticmethod(unit_vector)
    turned = staticmethod(turned)

    @property
    def bodies(self) -> list[str]:
        """The first and the second body."""
        return [body_of(end) for end in self.part.ends]

    @property
    def first(self) -> Array:
        """The first point."""
        return self.posture.place(self.part.ends[0])

    @property
    def second(self) -> Array:
        """The second point."""
        return self.posture.place(self.part.ends[1])

    def number(self, key: str) -> float:
        """A number of the joint, SI; of a vector "axis.x"."""
        return self.posture.number(f"joints.{self.part.name}.{key}")

    def option(self, key: str) -> str:
        """A word of the joint, or a body's name."""
        return self.part.options.get(key, "")

    def direction(self, key: str, body: str) -> Array:
        """A vector of the joint in the axes of a body, as a unit vector."""
        return self.posture.direction(self.part, key, body)

    def centre(self, k: int, carrier: str) -> Array:
        """Where the first (0) or second (1) body turns on another one: at their pivot; its point without one."""
        body = self.bodies[k]
        pivot = pivot_between(self.posture, body, carrier)
        end = self.part.ends[k] if pivot is None else next(end for end in pivot.ends if body_of(end) == body)
        return self.posture.place(end)

    @cached_property
    def _axis(self) -> tuple[Array, Array, Array]:
        return axis_of(self.posture, self.part)

    @property
    def on_line(self) -> Array:
        """The place of the body that guides through which its line goes."""
        return self._axis[0]

    @property
    def along(self) -> Array:
        """The line's direction, a unit vector."""
        return self._axis[1]

    @property
    def slider(self) -> Array:
        """The point that slides on the line."""
        return self._axis[2]

    @property
    def ground_guides(self) -> bool:
        """Whether the line is the ground's."""
        return has_rail(self.part)


def sliding(posture: Posture) -> Iterator[PartInfo]:
    """Joints with a line on which a body slides."""
    return (part for part in posture.parts("joints") if type_of(part).slides)


def guide_and_slider(part: PartInfo) -> tuple[str, str]:
    """Points of a joint that slides: the one of the body with the line, and the other one.

    The ground guides what does not turn on it, whichever of the two has the line.
    """
    slides, (first, second) = type_of(part).slides, part.ends
    assert slides is not None
    guide, slider = (first, second) if slides.guide == "first" else (second, first)
    turns_round = type_of(part).keeps_angle and body_of(slider) == GROUND
    return (slider, guide) if turns_round else (guide, slider)


def axis_of(posture: Posture, part: PartInfo) -> tuple[Array, Array, Array]:
    """Of a joint that slides: a place on its line, the direction (unit vector), and the place that slides on it."""
    slides, (guide, slider) = type_of(part).slides, guide_and_slider(part)
    assert slides is not None
    holder = body_of(part.ends[0 if slides.guide == "first" else 1])
    return posture.place(guide), posture.direction(part, slides.direction, holder), posture.place(slider)


def has_rail(part: PartInfo) -> bool:
    """Whether the ground guides: a slot's pin stands on the ground as others do."""
    return type_of(part).slides is not None and body_of(guide_and_slider(part)[0]) == GROUND


def is_block(part: PartInfo) -> bool:
    """Whether what slides does not turn in its guide."""
    return type_of(part).keeps_angle


def pivot_between(posture: Posture, body: str, other: str) -> PartInfo | None:
    """The first joint by which two bodies turn on each other; None without one."""
    for joint in posture.parts("joints"):
        if type_of(joint).is_pivot and {body, other} <= set(map(body_of, joint.ends)):
            return joint
    return None


def gap_of(posture: Posture, part: PartInfo, unit: float) -> float:
    """How far each wall of a joint that slides is drawn from the slider, m; 0: it has no play."""
    return max(GAP * unit, posture.play(part.name)) if part.name in posture.guides else 0.0


def axes_of(posture: Posture, part: PartInfo) -> tuple[Array, Array]:
    """Directions of guide and slider, unit vectors; the ground guides where it is one of the two."""
    _, second = map(body_of, part.ends)
    _, along, _ = axis_of(posture, part)
    if part.name not in posture.guides:
        return along, along
    tilt = _tilt(posture, part)
    tilted = math.cos(tilt) * along + math.sin(tilt) * turned(along)
    return (tilted, along) if second == GROUND else (along, tilted)


def _tilt(posture: Posture, part: PartInfo) -> float:
    """By how much the second body is turned in the first, rad: in no turn's excess."""
    first, second = map(body_of, part.ends)
    address = f"joints.{part.name}.angle"
    if posture.has(address):
        angle = posture.number(address)
    else:
        angle = math.atan2(*(posture.number(f"joints.{part.name}.axis.{axis}") for axis in "yx"))
    return math.remainder(posture.theta(second) - posture.theta(first) - angle, 2.0 * math.pi)


def corners(posture: Posture, joint: str) -> Mapping[str, float]:
    """How much nearer to its wall than in the middle of the guide each corner is, m, by its name."""
    part = next(posture.parts_named(joint))
    first, second = part.ends
    (_, along, _), tilt = axis_of(posture, part), _tilt(posture, part)
    offset = float((posture.place(second) - posture.place(first)) @ turned(along))
    return {one.name: corner_at(posture.source, posture.p, one, offset, tilt) for one in posture.guides[joint]}


def in_walls(posture: Posture) -> frozenset[str]:
    """Corners that are in their walls."""
    return frozenset(
        name for joint in posture.guides for name, e in corners(posture, joint).items() if e >= posture.play(joint)
    )

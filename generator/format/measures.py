"""What bearings and guides are measured by: the keys of these two sections."""

from __future__ import annotations

from gudgeon.generator.field import Bound, name_in, number, record
from gudgeon.language.units import LENGTH

BEARING = record(
    "bearing", "a pin in a hole",
    number(
        "radius", "radius of the hole", LENGTH, required=True,
        bounds=(Bound(">", 0.0, "a bearing's radius is positive"),),
    ),
    number(
        "clearance", "radial clearance: radius of the hole − radius of the pin", LENGTH, required=True,
        bounds=(
            Bound(">", 0.0, "a clearance is positive"),
            Bound("<", "radius", "a clearance is smaller than the bearing's radius"),
        ),
    ),
    number(
        "length", "length of the pin in the hole", LENGTH, required=True,
        bounds=(Bound(">", 0.0, "a bearing's length is positive"),),
    ),
    name_in("materials", "bearing_material", "of the hole"),
    name_in("materials", "journal_material", "of the pin"),
)  # fmt: skip

GUIDE = record(
    "guide", "a block in a slot with parallel walls: what a translational joint with play is",
    number(
        "gap", "half of what the slot is wider than the slider", LENGTH, required=True,
        bounds=(Bound(">", 0.0, "a gap is positive"),),
    ),
    number(
        "half_length", "half the slider's length, along the axis", LENGTH, required=True,
        bounds=(Bound(">", 0.0, "half a length is positive"),),
    ),
    number(
        "half_height", "half the slider's height, across the axis", LENGTH, required=True,
        bounds=(Bound(">", 0.0, "half a height is positive"),),
    ),
    number(
        "corner_radius", "radius of the slider's corners, within its length and height", LENGTH, otherwise="sharp ones",
        bounds=(
            Bound(">", 0.0, "a corner's radius is positive"),
            Bound("<", "half_length", "a corner's radius is less than half the slider's length"),
            Bound("<=", "half_height", "a corner's radius is at most half the slider's height"),
        ),
    ),
    name_in("materials", "guide_material", "of the slot"),
    name_in("materials", "slider_material", "of the slider"),
)  # fmt: skip

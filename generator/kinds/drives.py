"""Declares the kinds of drives: a prescribed angle, coordinate or distance as an expression of t."""

from __future__ import annotations

from collections.abc import Mapping

from gudgeon.generator.field import OF_TIME, Field, Kind, number
from gudgeon.language.units import DIMENSIONLESS, LENGTH, Dimension


def _make_value_field(
    dimension: Dimension | None, meaning: str = "prescribed value as a continuous expression of t"
) -> tuple[Field, ...]:
    """Return the required field `value` of a drive, an expression of t, as a tuple with this one field.

    dimension: of the value; None: the reader of the drive checks it against the coordinate that is prescribed.
    """
    return (number("value", meaning, dimension, required=True, varies=OF_TIME),)


DRIVES: Mapping[str, Kind] = {
    "angle": Kind(
        "angle of a body, or of a body relative to another body",
        _make_value_field(DIMENSIONLESS),
        "bodies",
        (1, 2),
        ("rotation", "theta", "motor", "turn"),
    ),
    "coordinate": Kind(
        "x or y of a body's centre of mass, in ground axes, or theta",
        _make_value_field(
            None, "prescribed value as a continuous expression of t: a length for x and y, an angle for theta"
        ),
        "coordinates",
        (1,),
        ("position", "translation", "displacement", "x", "y"),
    ),
    "distance": Kind(
        "distance of two points", _make_value_field(LENGTH), "points", (2,), ("length", "actuator", "cylinder")
    ),
}

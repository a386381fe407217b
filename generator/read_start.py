"""The start: guesses, exact values and rates of coordinates; the names of coordinates."""

from __future__ import annotations

from collections.abc import Mapping

from gudgeon.errors import BadValueError, Location
from gudgeon.generator.mechanism import Quantity, Start
from gudgeon.generator.names import unknown_name
from gudgeon.generator.read_bodies import Places
from gudgeon.generator.reading import Reader
from gudgeon.generator.schema import FileShape
from gudgeon.generator.units import DIMENSIONLESS, LENGTH, RATE, VELOCITY, Dimension
from gudgeon.generator.yaml_tree import Text

COORDINATES: Mapping[str, Dimension] = {"x": LENGTH, "y": LENGTH, "theta": DIMENSIONLESS}
RATES: Mapping[str, Dimension] = {"vx": VELOCITY, "vy": VELOCITY, "omega": RATE}


def read_start(reader: Reader, shape: FileShape, places: Places) -> Start:
    """Guesses, exact values and rates of coordinates."""
    if shape.start is None:
        return Start()
    guess = _coordinates(reader, shape.start.guess, "guess", COORDINATES, places)
    fixed = _coordinates(reader, shape.start.set, "set", COORDINATES, places)
    rates = _coordinates(reader, shape.start.rates, "rates", RATES, places)
    for key in shape.start.set:
        if key in guess:
            hint = f"it is guessed at {guess[key].where}; expected one of the two"
            reader.errors.append(BadValueError(f"{str(key)} is set and guessed", key.where, hint))
    return Start(guess, fixed, rates)


def _coordinates(
    reader: Reader, section: Mapping[Text, Text], name: str, known: Mapping[str, Dimension], places: Places
) -> dict[str, Quantity]:
    found = {}
    for key, text in section.items():
        with reader.collect():
            dimension = coordinate_of(key, known, places, key.where)
            found[str(key)] = reader.quantity(text, f"start.{name}.{key}", dimension)
    return found


def coordinate_of(key: str, known: Mapping[str, Dimension], places: Places, where: Location) -> Dimension:
    """The dimension of "L7.theta". Raises UnknownNameError at the part that is wrong."""
    body, _, coordinate = key.partition(".")
    if body not in places.bodies:
        raise unknown_name("body", body, places.bodies, where)
    if coordinate not in known:
        place = Location(where.file, where.line, where.column + len(body) + 1)
        raise unknown_name(f"coordinate of {body}", coordinate, known, place)
    return known[coordinate]

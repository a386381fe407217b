"""Bodies, their points, the ground's points and gravity."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress

from gudgeon.errors import BadNameError, BadValueError, InputError, Location
from gudgeon.generator.mechanism.mechanism import GROUND, Body, PointRef, Quantity, Start, Vector
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.yaml.shapes import BodyShape, FileShape
from gudgeon.generator.yaml.tree import Text, kind_of
from gudgeon.language.names import Namespace, check_name
from gudgeon.language.suggestions import known_hint, unknown_name
from gudgeon.language.units import ACCELERATION, DIMENSIONLESS, INERTIA, LENGTH, MASS, RATE, VELOCITY, Dimension

COORDINATES: Mapping[str, Dimension] = {"x": LENGTH, "y": LENGTH, "theta": DIMENSIONLESS}
RATES: Mapping[str, Dimension] = {"vx": VELOCITY, "vy": VELOCITY, "omega": RATE}

IMPLIED_POINTS = ("origin", "com", "tail", "head")
# `L1.x` is a coordinate of the body: a point of that name could not be told from it
_COORDINATES = ("x", "y", "theta", "vx", "vy", "omega", "ax", "ay", "alpha")


def read_gravity(reader: Reader, shape: FileShape) -> Vector | None:
    """Gravity in ground axes; None if the file has none."""
    return reader.vector(shape.gravity, "gravity", ACCELERATION) if shape.gravity else None


def read_bodies(reader: Reader, shape: FileShape, namespace: Namespace) -> dict[str, Body]:
    """All bodies, in the order of the file: it is the order of the coordinates."""
    if not shape.bodies and not reader.left_out:
        reader.errors.append(BadValueError("bodies is empty", shape.where, "expected one body at least"))
    bodies = {}
    for name, body in shape.bodies.items():
        with reader.collect():
            namespace.add(name, "body", name.where)
        bodies[str(name)] = _body(reader, name, body)
    return bodies


def _body(reader: Reader, name: Text, body: BodyShape) -> Body:
    address = f"bodies.{name}"
    mass = reader.quantity(body.mass, f"{address}.mass", MASS)
    inertia = reader.quantity(body.inertia, f"{address}.inertia", INERTIA)
    length = reader.quantity(body.length, f"{address}.length", LENGTH) if body.length is not None else None
    reader.require(mass, ">", 0.0, "a mass is positive")
    reader.require(inertia, ">", 0.0, "a moment of inertia is positive")
    if length:
        reader.require(length, ">", 0.0, "a length is positive")
    com = reader.vector(body.com, f"{address}.com", LENGTH) if body.com else None
    points = {}
    for point, pair in body.points.items():
        with reader.collect():
            check_name(point, "point", point.where)
            if point in IMPLIED_POINTS or point in _COORDINATES:
                what = "every body has it" if point in IMPLIED_POINTS else f"{name}.{point} is a coordinate"
                raise BadNameError(f"{str(point)!r} cannot name a point: {what}", point.where, "expected another name")
        points[str(point)] = reader.vector(pair, f"{address}.points.{point}", LENGTH)
    return Body(str(name), mass, inertia, length, com, points, name.where)


def read_ground(reader: Reader, shape: FileShape) -> dict[str, Vector]:
    """The ground's points, in ground axes."""
    points = {}
    for point, pair in shape.ground.items():
        with reader.collect():
            check_name(point, "point", point.where)
            if point in _COORDINATES:
                raise BadNameError(f"{str(point)!r} cannot name a point: it names a coordinate", point.where)
        points[str(point)] = reader.vector(pair, f"ground.{point}", LENGTH)
    return points


class Places:
    """Resolves `body` and `body.point`."""

    def __init__(self, bodies: Mapping[str, Body], ground: Mapping[str, Vector]) -> None:
        self.bodies, self.ground = bodies, ground

    def points(self, body: str) -> list[str]:
        """The points of a body, the user's first; KeyError for no body."""
        if body == GROUND:
            return list(self.ground)
        bar = self.bodies[body].length is not None
        implied = IMPLIED_POINTS if bar else IMPLIED_POINTS[:2]
        return [*(p for p in self.bodies[body].points if p not in implied), *reversed(implied)]

    def check_body(self, name: str, where: Location) -> str:
        """The name of a body or `ground`. Raises UnknownNameError."""
        if name not in self.bodies and name != GROUND:
            raise unknown_name("body", name, (*self.bodies, GROUND), where)
        return str(name)

    def point(self, text: object, where: Location) -> PointRef:
        """`L1.head` as a reference. Raises BadValueError or UnknownNameError at the part that is wrong."""
        if not isinstance(text, Text) or text.count(".") != 1:
            hint = "expected body.point, such as L1.head or ground.O1"
            with suppress(InputError, KeyError):
                body = self.check_body(str(text), where)
                hint = f"expected one of: {', '.join(f'{body}.{p}' for p in self.points(body))}"
            raise BadValueError(f"{kind_of(text)} is no point", getattr(text, "where", where), hint)
        body, _, point = text.partition(".")
        self.check_body(body, text.where)
        known = self.points(body)
        if point not in known:
            place = Location(text.where.file, text.where.line, text.where.column + len(body) + 1)
            raise unknown_name(f"point of {body}", point, known, place)
        return PointRef(body, point, text.where)

    def body(self, text: object, where: Location) -> PointRef:
        """A body as a reference to its centre of mass, the ground as one to no point in particular."""
        if not isinstance(text, Text):
            raise BadValueError(f"{kind_of(text)} is no body", where, known_hint("", (*self.bodies, GROUND)))
        name = self.check_body(text, where)
        return PointRef(str(name), "" if name == GROUND else "com", where)

    def names(self) -> Iterator[str]:
        """Every point: "L1.head"."""
        for body in (*self.bodies, GROUND):
            yield from (f"{body}.{point}" for point in self.points(body))


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

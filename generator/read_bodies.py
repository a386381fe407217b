"""Bodies, their points, the ground's points and gravity."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress

from gudgeon.errors import BadNameError, BadValueError, InputError, Location
from gudgeon.generator.mechanism import GROUND, Body, PointRef, Vector
from gudgeon.generator.names import Namespace, check_name, known_hint, unknown_name
from gudgeon.generator.reading import Reader
from gudgeon.generator.schema import BodyShape, FileShape
from gudgeon.generator.units import ACCELERATION, INERTIA, LENGTH, MASS
from gudgeon.generator.yaml_tree import Text, kind_of

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

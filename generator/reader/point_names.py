"""Resolves names of bodies, points and coordinates in a file: `body`, `body.point` and `body.coordinate`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from types import MappingProxyType

from gudgeon.errors import BadValueError, InputError, Location, UnknownNameError
from gudgeon.generator.mechanism import GROUND, PointRef
from gudgeon.generator.yaml import Map, Text, kind_of
from gudgeon.language.names import known_hint, unknown_name
from gudgeon.language.units import Dimension

IMPLIED_POINTS = ("origin", "com", "tail", "head")
CORNERS_OF_SIDES = ("P", "Q", "R")


_NONE: Mapping[str, str] = MappingProxyType({})


class PointNames:
    """Resolve `body` and `body.point` by the names that a file's tree declares."""

    def __init__(self, root: Map) -> None:
        self.bodies, self.ground = root["bodies"], root.part("ground")

    def points(self, body: str) -> list[str]:
        """Return the names of a body's points, declared ones first. Raises KeyError if there is no such body."""
        if body == GROUND:
            return [str(point) for point in self.ground]
        node = self.bodies[body]
        implied = IMPLIED_POINTS if "length" in node else IMPLIED_POINTS[:2]
        named = dict.fromkeys((*CORNERS_OF_SIDES * ("sides" in node), *map(str, node.part("points"))))
        return [*(point for point in named if point not in implied), *reversed(implied)]

    def check_body(self, name: str, where: Location) -> str:
        """Return the name if it is a body or `ground`. Raises UnknownNameError."""
        if name not in self.bodies and name != GROUND:
            raise unknown_name("body", name, (*self.bodies, GROUND), where)
        return str(name)

    def point(self, text: object, where: Location) -> PointRef:
        """Return the reference for a text such as `L1.head`.

        Raises BadValueError or UnknownNameError at the wrong part.
        """
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
        """Return a body as a reference to its centre of mass; for the ground, the name of the point is empty."""
        if not isinstance(text, Text):
            raise BadValueError(f"{kind_of(text)} is no body", where, known_hint("", (*self.bodies, GROUND)))
        name = self.check_body(text, where)
        return PointRef(str(name), "" if name == GROUND else "com", where)

    def names(self) -> Iterator[str]:
        """Yield every point of the file, such as "L1.head"."""
        for body in (*self.bodies, GROUND):
            yield from (f"{body}.{point}" for point in self.points(body))


def coordinate_of(
    key: str, known: Mapping[str, Dimension], places: PointNames, where: Location, hints: Mapping[str, str] = _NONE
) -> Dimension:
    """Return the dimension of a coordinate such as "L7.theta". Raises UnknownNameError at the wrong part.

    `known` maps allowed coordinates to dimensions; `hints` maps coordinates of other sections to a hint.
    """
    body, _, coordinate = key.partition(".")
    if body not in places.bodies:
        raise unknown_name("body", body, places.bodies, where)
    if not coordinate:
        hint = f"expected one of: {', '.join(f'{body}.{name}' for name in known)}"
        raise UnknownNameError(f"{body} is a body, no coordinate", where, hint)
    if coordinate not in known:
        place = Location(where.file, where.line, where.column + len(body) + 1)
        if coordinate in hints:
            raise UnknownNameError(f"unknown coordinate of {body} {coordinate!r}", place, hints[coordinate])
        raise unknown_name(f"coordinate of {body}", coordinate, known, place)
    return known[coordinate]

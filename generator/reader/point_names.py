"""Resolves names of bodies, points and coordinates in a file: `body`, `body.point` and `body.coordinate`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from types import MappingProxyType

from gudgeon.errors import BadValueError, InputError, Location, UnknownNameError
from gudgeon.generator.mechanism import GROUND, PointRef
from gudgeon.generator.yaml import Map, Text, describe_node
from gudgeon.language.names import format_name_hint, make_unknown_name_error
from gudgeon.language.units import Dimension

IMPLIED_POINTS = ("origin", "com", "tail", "head")
CORNERS_OF_SIDES = ("P", "Q", "R")


_NO_HINTS: Mapping[str, str] = MappingProxyType({})


class PointNames:
    """Resolve `body` and `body.point` by the names that a file's tree declares."""

    def __init__(self, root: Map) -> None:
        self.bodies, self.ground = root["bodies"], root.get_mapping("ground")

    def list_points(self, body: str) -> list[str]:
        """Return the names of a body's points: declared ones and corners of `sides` first, then the implied ones.

        Raises KeyError if there is no such body. The ground has declared points only.
        """
        if body == GROUND:
            return [str(point) for point in self.ground]
        node = self.bodies[body]
        implied_points = IMPLIED_POINTS if "length" in node else IMPLIED_POINTS[:2]
        declared = dict.fromkeys((*CORNERS_OF_SIDES * ("sides" in node), *map(str, node.get_mapping("points"))))
        return [*(point for point in declared if point not in implied_points), *reversed(implied_points)]

    def check_body(self, name: str, location: Location) -> str:
        """Return the name if it is a body or `ground`. Raises UnknownNameError at `location`."""
        if name not in self.bodies and name != GROUND:
            raise make_unknown_name_error("body", name, (*self.bodies, GROUND), location)
        return str(name)

    def resolve_point(self, text: object, default_location: Location) -> PointRef:
        """Return the reference for a text such as `L1.head`.

        Raises BadValueError for a text that is not a body and a point, UnknownNameError at the wrong part.
        `default_location` locates the error if `text` is not a scalar.
        """
        if not isinstance(text, Text) or text.count(".") != 1:
            hint = "expected body.point, such as L1.head or ground.O1"
            with suppress(InputError, KeyError):
                body = self.check_body(str(text), default_location)
                hint = f"expected one of: {', '.join(f'{body}.{point_name}' for point_name in self.list_points(body))}"
            raise BadValueError(f"{describe_node(text)} is not a point", getattr(text, "where", default_location), hint)
        body, _, point = text.partition(".")
        self.check_body(body, text.where)
        points = self.list_points(body)
        if point not in points:
            location = Location(text.where.file, text.where.line, text.where.column + len(body) + 1)
            raise make_unknown_name_error(f"point of {body}", point, points, location)
        return PointRef(body, point, text.where)

    def resolve_body(self, text: object, location: Location) -> PointRef:
        """Return a body as a reference to its centre of mass; for the ground, the name of the point is empty.

        Raises BadValueError if `text` is not a scalar, UnknownNameError for an unknown body.
        """
        if not isinstance(text, Text):
            raise BadValueError(
                f"{describe_node(text)} is not a body", location, format_name_hint("", (*self.bodies, GROUND))
            )
        name = self.check_body(text, location)
        return PointRef(str(name), "" if name == GROUND else "com", location)

    def iterate_point_names(self) -> Iterator[str]:
        """Yield the name of every point of the file, such as "L1.head", body by body, the ground last."""
        for body in (*self.bodies, GROUND):
            yield from (f"{body}.{point}" for point in self.list_points(body))


def find_coordinate_dimension(
    key: str,
    dimensions: Mapping[str, Dimension],
    point_names: PointNames,
    location: Location,
    hints: Mapping[str, str] = _NO_HINTS,
) -> Dimension:
    """Return the dimension of a coordinate such as "L7.theta". Raises UnknownNameError at the wrong part.

    `dimensions` maps allowed coordinates to dimensions; `point_names` contains the bodies; `hints` maps coordinates of
    other sections to a hint.
    """
    body, _, coordinate = key.partition(".")
    if body not in point_names.bodies:
        raise make_unknown_name_error("body", body, point_names.bodies, location)
    if not coordinate:
        hint = f"expected one of: {', '.join(f'{body}.{name}' for name in dimensions)}"
        raise UnknownNameError(f"{body} is a body, not a coordinate", location, hint)
    if coordinate not in dimensions:
        location_of_coordinate = Location(location.file, location.line, location.column + len(body) + 1)
        if coordinate in hints:
            raise UnknownNameError(
                f"unknown coordinate of {body} {coordinate!r}", location_of_coordinate, hints[coordinate]
            )
        raise make_unknown_name_error(f"coordinate of {body}", coordinate, dimensions, location_of_coordinate)
    return dimensions[coordinate]

"""Derives mass, centre of mass and moment of inertia from a body's shape, and points from their distances.

All are expressions of the file's numbers, so that they follow these in every run.
"""

from __future__ import annotations

from collections.abc import Mapping

from gudgeon.errors import BadValueError, Location
from gudgeon.generator.field import Kind
from gudgeon.generator.format.sections import SHAPE, SIDES
from gudgeon.generator.format.shapes import missing_key
from gudgeon.generator.mechanism import Quantity, Vector
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import FieldContext, Values, find_kind, read_fields
from gudgeon.generator.reader.materials import Materials
from gudgeon.generator.reader.point_names import CORNERS_OF_SIDES
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.names import unknown_name
from gudgeon.language.parser import parse
from gudgeon.language.tree import Binary, Call, Expr, Name, Number, Unary
from gudgeon.language.units import INERTIA, LENGTH, MASS, Dimension

_KINDS = {
    "bar": Kind("a bar with a width", ()),
    "rectangle": Kind("a rectangle", (), also=("plate", "square")),
    "disc": Kind("a disc", (), also=("circle", "disk")),
    "triangle": Kind("a triangle", ()),
}
_AUTO = "m * l**2 / 12"
_AREA = "abs((qx - px) * (ry - py) - (rx - px) * (qy - py)) / 2"
_SQUARED_RADIUS_OF_GYRATION = (
    "((qx - px)**2 + (qy - py)**2 + (rx - qx)**2 + (ry - qy)**2 + (px - rx)**2 + (py - ry)**2) / 36"
)


def derive_quantity(
    reader: Reader, formula: str, of: Mapping[str, Quantity], address: str, dimension: Dimension, where: Location
) -> Quantity:
    """Return the quantity at an address as a formula of others, whose letters `of` maps to quantities."""
    value = _with_addresses(parse(formula, where), of)
    return reader.keep(Quantity(address, value, dimension, where, tuple(of.values())))


def _with_addresses(expr: Expr, of: Mapping[str, Quantity]) -> Expr:
    """Replace the letters of a formula by the addresses of their quantities, literal zeros by 0."""
    match expr:
        case Name(path=path):
            return Number(0.0, "0") if of[path].is_zero else Name(of[path].address)
        case Unary(operator=operator, operand=operand):
            return Unary(operator, _with_addresses(operand, of))
        case Binary(operator=operator, left=left, right=right):
            return Binary(operator, _with_addresses(left, of), _with_addresses(right, of))
        case Call(function=function, arguments=arguments):
            return Call(function, tuple(_with_addresses(argument, of) for argument in arguments))
    return expr


def read_sides(reader: Reader, node: Map, address: str) -> dict[str, Vector]:
    """Return the points P, Q and R of a body with `sides`; R follows from three distances. {} without `sides`."""
    if "sides" not in node:
        return {}
    address, where = f"{address}.sides", node.key("sides").where
    own = read_fields(reader, node.part("sides"), SIDES.fields, FieldContext(address))
    a, b, c = sides = [own.quantities[name] for name in ("PQ", "QR", "PR")]
    for k, side in enumerate(sides):
        others = " + ".join(other.address for other in (sides[k - 1], sides[k - 2]))
        reader.require_less(side, others, "each side of a triangle is shorter than the other two together")
    zero = Quantity(f"{address}.P", Number(0.0, "0"), LENGTH, where)
    of = {"a": a, "b": b, "c": c}
    sign = "-" if own.options.get("side") == "right" else ""
    height = f"{sign}sqrt((a + b + c) * (b + c - a) * (a + c - b) * (a + b - c)) / (2 * a)"
    x = derive_quantity(reader, "(a**2 + c**2 - b**2) / (2 * a)", of, f"{address}.R.x", LENGTH, where)
    y = derive_quantity(reader, height, of, f"{address}.R.y", LENGTH, where)
    return dict(zip(CORNERS_OF_SIDES, ((zero, zero), (a, zero), (x, y)), strict=True))


class MassProperties:
    """Contain mass, moment of inertia and centre of mass of one body, and the keys that dynamics lacks."""

    def __init__(self, reader: Reader, address: str, own: Values, materials: Materials) -> None:
        self._reader, self._address, self._materials = reader, address, materials
        self.mass, self.inertia = own.quantities.get("mass"), own.quantities.get("inertia")
        self.length, self.com = own.quantities.get("length"), own.vectors.get("com")
        self.follows_mass = False  # whether the moment of inertia follows from the mass

    @property
    def lacks(self) -> tuple[str, ...]:
        """Return the keys that dynamics needs and the body does not have."""
        inertia = self.inertia is None and not self.follows_mass
        return (*(("mass",) if self.mass is None else ()), *(("inertia",) if inertia else ()))

    def set_slender_inertia(self, where: Location) -> None:
        """Set the inertia of a slender bar, m l²/12, for `inertia: auto`.

        Raises BadValueError if the body is no such bar.
        """
        address, hint = f"{self._address}.inertia", "expected a number, or a body with length: and mass: alone"
        if self.length is None:
            raise BadValueError(f"{address} is auto, that of a slender bar, and there is no length", where, hint)
        if self.com is not None:
            what = f"{address} is auto, that of a slender bar about its middle, and com is elsewhere"
            raise BadValueError(what, where, "expected no com, or a number for inertia")
        self._set_inertia(_AUTO, {"l": self.length}, where)

    def set_shape(self, node: Map, key: Text, points: Mapping[str, Vector], has_inertia: bool) -> None:
        """Set mass, inertia and centre of mass that follow from the body's shape. Raises InputError."""
        address = f"{self._address}.shape"
        kind = find_kind(node, _KINDS, [field.name for field in SHAPE.fields], address)
        own = read_fields(self._reader, node, SHAPE.fields, FieldContext(address))
        if has_inertia:
            raise BadValueError(f"{self._address} has inertia and a shape", key.where, "expected one of the two")
        if kind == "triangle":
            area, squared_radius, of = self._triangle(node, kind, points)
        else:
            area, squared_radius, of = self._centred_shape(kind, own)
        self._set_mass(node, own, area, of, key)
        self._set_inertia(f"m * {squared_radius}", of, key.where)

    def _density(self, node: Map, own: Values) -> Quantity | None:
        """Return the shape's density or that of its material, None without both. Raises an InputError for both."""
        if "material" not in node:
            return own.quantities.get("density")
        address, text = f"{self._address}.shape", node["material"]
        if "density" in node:
            raise BadValueError(f"{address} has density and material", text.where, "expected one of the two")
        return self._materials.values_of_material(f"{address}.material", text, ("density",))["density"]

    def _set_mass(self, node: Map, own: Values, area: str, of: Mapping[str, Quantity], key: Text) -> None:
        """Set the mass to density times thickness times `area`, unless the body gives it."""
        plate = {"d": self._density(node, own), "h": own.quantities.get("thickness")}
        given = {letter: quantity for letter, quantity in plate.items() if quantity is not None}
        if given and self.mass is not None:
            hint = "expected the mass, or density or material, and thickness"
            what = "material" if "material" in node else "density"
            raise BadValueError(f"{self._address} has mass and a shape with {what} or thickness", key.where, hint)
        if len(given) == 1:
            raise missing_key("thickness" if "d" in given else "density", key.where, f"{self._address}.shape")
        if given:
            address = f"{self._address}.mass"
            self.mass = derive_quantity(self._reader, f"d * h * ({area})", {**given, **of}, address, MASS, key.where)
            self._reader.require(self.mass, ">", 0.0, "a mass is positive")

    def _set_inertia(self, formula: str, of: Mapping[str, Quantity], where: Location) -> None:
        """Set the moment of inertia to a formula of the mass m and the lengths `of`, if the mass is known."""
        self.follows_mass = True
        if self.mass is not None:
            address = f"{self._address}.inertia"
            self.inertia = derive_quantity(self._reader, formula, {"m": self.mass, **of}, address, INERTIA, where)
            self._reader.require(self.inertia, ">", 0.0, "a moment of inertia is positive")

    def _centred_shape(self, kind: Text, own: Values) -> tuple[str, str, dict[str, Quantity]]:
        """Return area, squared radius of gyration and their letters for a shape centred on the centre of mass."""
        if kind == "disc":
            return "pi * r**2", "r**2 / 2", {"r": own.quantities["disc"]}
        if kind == "rectangle":
            a, b = own.vectors["rectangle"]
        elif self.length is None:
            what, hint = (
                f"{self._address}.shape is a bar, and there is no length",
                "expected rectangle: [length, width]",
            )
            raise BadValueError(what, kind.where, hint)
        else:
            a, b = self.length, own.quantities["bar"]
        return "a * b", "(a**2 + b**2) / 12", {"a": a, "b": b}

    def _triangle(self, node: Map, kind: Text, points: Mapping[str, Vector]) -> tuple[str, str, dict[str, Quantity]]:
        """Return area, squared radius of gyration and their letters for a triangle, and set its centre of mass."""
        if self.com is not None:
            what = f"{self._address} has com and a triangle, whose centre of mass is its own"
            raise BadValueError(what, kind.where, "expected one of the two")
        of: dict[str, Quantity] = {}
        for letter, name in zip("pqr", node["triangle"], strict=True):
            if name not in points:
                owner = self._address.removeprefix("bodies.")
                raise unknown_name(f"point of {owner}", name, points, name.where)
            of |= {f"{letter}{axis}": x for axis, x in zip("xy", points[name], strict=True)}
        middle = [
            derive_quantity(
                self._reader,
                f"(p{axis} + q{axis} + r{axis}) / 3",
                {k: x for k, x in of.items() if k[1] == axis},
                f"{self._address}.com.{axis}",
                LENGTH,
                kind.where,
            )
            for axis in "xy"
        ]
        self.com = (middle[0], middle[1])
        return _AREA, _SQUARED_RADIUS_OF_GYRATION, of

"""Mass, centre of mass and inertia of bodies that say their shape, and points that say their distances.

All are expressions of what the file gives, so that they follow it in every run.
"""

from __future__ import annotations

from collections.abc import Mapping

from gudgeon.errors import BadValueError, Location
from gudgeon.generator.field import Kind
from gudgeon.generator.format.sections import BRANCHES, SHAPE
from gudgeon.generator.format.shapes import missing_key
from gudgeon.generator.mechanism import Quantity, Vector
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import Around, Values, kind_key, read_fields
from gudgeon.generator.reader.materials import Materials
from gudgeon.generator.reader.places import CORNERS_OF_SIDES
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
_SPREAD = "((qx - px)**2 + (qy - py)**2 + (rx - qx)**2 + (ry - qy)**2 + (px - rx)**2 + (py - ry)**2) / 36"


def follows(
    reader: Reader, formula: str, of: Mapping[str, Quantity], address: str, dimension: Dimension, where: Location
) -> Quantity:
    """The number at an address as a formula of others, which it calls by the letters of `of`."""
    value = _with_addresses(parse(formula, where), of)
    return reader.keep(Quantity(address, value, dimension, where, tuple(of.values())))


def _with_addresses(expr: Expr, of: Mapping[str, Quantity]) -> Expr:
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
    """P, Q and R, where R follows from three distances; nothing if the body gives none."""
    if "sides" not in node:
        return {}
    address, where = f"{address}.sides", node.key("sides").where
    own = read_fields(reader, node.part("sides"), BRANCHES.fields, Around(address))
    a, b, c = sides = [own.quantities[name] for name in ("PQ", "QR", "PR")]
    for k, side in enumerate(sides):
        others = " + ".join(other.address for other in (sides[k - 1], sides[k - 2]))
        reader.require_less(side, others, "each side of a triangle is shorter than the other two together")
    zero = Quantity(f"{address}.P", Number(0.0, "0"), LENGTH, where)
    of = {"a": a, "b": b, "c": c}
    sign = "-" if own.options.get("side") == "right" else ""
    height = f"{sign}sqrt((a + b + c) * (b + c - a) * (a + c - b) * (a + b - c)) / (2 * a)"
    x = follows(reader, "(a**2 + c**2 - b**2) / (2 * a)", of, f"{address}.R.x", LENGTH, where)
    y = follows(reader, height, of, f"{address}.R.y", LENGTH, where)
    return dict(zip(CORNERS_OF_SIDES, ((zero, zero), (a, zero), (x, y)), strict=True))


class Weighed:
    """Mass, inertia and centre of mass of one body, of what its file gives, and which of them are missing."""

    def __init__(self, reader: Reader, address: str, own: Values, materials: Materials) -> None:
        self._reader, self._address, self._materials = reader, address, materials
        self.mass, self.inertia = own.quantities.get("mass"), own.quantities.get("inertia")
        self.length, self.com = own.quantities.get("length"), own.vectors.get("com")
        self.follows_mass = False  # the inertia

    @property
    def lacks(self) -> tuple[str, ...]:
        """What dynamics would ask for."""
        inertia = self.inertia is None and not self.follows_mass
        return (*(("mass",) if self.mass is None else ()), *(("inertia",) if inertia else ()))

    def slender(self, where: Location) -> None:
        """`inertia: auto`. Raises BadValueError where it is not that of a bar about its middle."""
        address, hint = f"{self._address}.inertia", "expected a number, or a body with length: and mass: alone"
        if self.length is None:
            raise BadValueError(f"{address} is auto, that of a slender bar, and there is no length", where, hint)
        if self.com is not None:
            what = f"{address} is auto, that of a slender bar about its middle, and com is elsewhere"
            raise BadValueError(what, where, "expected no com, or a number for inertia")
        self._set_inertia(_AUTO, {"l": self.length}, where)

    def shaped(self, node: Map, key: Text, points: Mapping[str, Vector], has_inertia: bool) -> None:
        """What follows from a shape. Raises InputError."""
        address = f"{self._address}.shape"
        kind = kind_key(node, _KINDS, [field.name for field in SHAPE.fields], address)
        own = read_fields(self._reader, node, SHAPE.fields, Around(address))
        if has_inertia:
            raise BadValueError(f"{self._address} has inertia and a shape", key.where, "expected one of the two")
        if kind == "triangle":
            area, spread, of = self._triangle(node, kind, points)
        else:
            area, spread, of = self._about_com(kind, own)
        self._weigh(node, own, area, of, key)
        self._set_inertia(f"m * {spread}", of, key.where)

    def _density(self, node: Map, own: Values) -> Quantity | None:
        """The shape's own, or that of its material. Raises BadValueError for both, and what the material is told."""
        if "material" not in node:
            return own.quantities.get("density")
        address, text = f"{self._address}.shape", node["material"]
        if "density" in node:
            raise BadValueError(f"{address} has density and material", text.where, "expected one of the two")
        return self._materials.take(f"{address}.material", text, ("density",))["density"]

    def _weigh(self, node: Map, own: Values, area: str, of: Mapping[str, Quantity], key: Text) -> None:
        """The mass, from density and thickness unless the body gives it."""
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
            self.mass = follows(self._reader, f"d * h * ({area})", {**given, **of}, address, MASS, key.where)
            self._reader.require(self.mass, ">", 0.0, "a mass is positive")

    def _set_inertia(self, formula: str, of: Mapping[str, Quantity], where: Location) -> None:
        self.follows_mass = True
        if self.mass is not None:
            address = f"{self._address}.inertia"
            self.inertia = follows(self._reader, formula, {"m": self.mass, **of}, address, INERTIA, where)
            self._reader.require(self.inertia, ">", 0.0, "a moment of inertia is positive")

    def _about_com(self, kind: Text, own: Values) -> tuple[str, str, dict[str, Quantity]]:
        """Area, squared radius of gyration and their numbers, of a shape whose middle is the centre of mass."""
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
        """The same of a triangle, which says where its centre of mass is."""
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
            follows(
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
        return _AREA, _SPREAD, of

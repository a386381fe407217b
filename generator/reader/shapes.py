"""Derives mass, centre of mass and moment of inertia from a body's shape, and points from their distances.

All are expressions of the file's numbers, so that they follow these in every run.
"""

from __future__ import annotations

from collections.abc import Mapping

from gudgeon.errors import BadValueError, Location
from gudgeon.generator.field import Kind
from gudgeon.generator.format.sections import SHAPE, SIDES
from gudgeon.generator.format.shapes import make_missing_key_error
from gudgeon.generator.mechanism import Quantity, Vector
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import FieldContext, Values, find_kind_key, read_fields
from gudgeon.generator.reader.materials import Materials
from gudgeon.generator.reader.point_names import CORNERS_OF_SIDES
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.names import make_unknown_name_error
from gudgeon.language.parser import parse
from gudgeon.language.tree import Binary, Call, Expr, Name, Number, Unary
from gudgeon.language.units import INERTIA, LENGTH, MASS, Dimension

_KINDS = {
    "bar": Kind("a bar with a width", ()),
    "rectangle": Kind("a rectangle", (), foreign_names=("plate", "square")),
    "disc": Kind("a disc", (), foreign_names=("circle", "disk")),
    "triangle": Kind("a triangle", ()),
}
_SLENDER_BAR_INERTIA = "m * l**2 / 12"
_AREA = "abs((qx - px) * (ry - py) - (rx - px) * (qy - py)) / 2"
_SQUARED_RADIUS_OF_GYRATION = (
    "((qx - px)**2 + (qy - py)**2 + (rx - qx)**2 + (ry - qy)**2 + (px - rx)**2 + (py - ry)**2) / 36"
)


def derive_quantity(
    reader: Reader,
    formula: str,
    quantities: Mapping[str, Quantity],
    address: str,
    dimension: Dimension,
    location: Location,
) -> Quantity:
    """Return a registered quantity at an address whose value is a formula of other quantities, such as "d * h * a".

    `quantities` maps the variables of `formula` to quantities. `location` is the location in the file.
    """
    value = _substitute_quantities(parse(formula, location), quantities)
    return reader.register_quantity(Quantity(address, value, dimension, location, tuple(quantities.values())))


def _substitute_quantities(expr: Expr, quantities: Mapping[str, Quantity]) -> Expr:
    """Return a formula's tree with variables replaced by the addresses of their quantities, literal zeros by 0."""
    match expr:
        case Name(path=path):
            return Number(0.0, "0") if quantities[path].is_zero else Name(quantities[path].address)
        case Unary(operator=operator, operand=operand):
            return Unary(operator, _substitute_quantities(operand, quantities))
        case Binary(operator=operator, left=left, right=right):
            return Binary(operator, _substitute_quantities(left, quantities), _substitute_quantities(right, quantities))
        case Call(function=function, arguments=arguments):
            return Call(function, tuple(_substitute_quantities(argument, quantities) for argument in arguments))
    return expr


def read_triangle_points(reader: Reader, node: Map, address: str) -> dict[str, Vector]:
    """Return the points P, Q and R of a body with `sides`; R follows from three distances. {} without `sides`.

    P is the origin, Q is on the x axis; R is to the left of PQ unless `side` is right. The triangle inequality is
    recorded as three conditions.
    """
    if "sides" not in node:
        return {}
    address, location = f"{address}.sides", node.find_key("sides").where
    values = read_fields(reader, node.get_mapping("sides"), SIDES.fields, FieldContext(address))
    a, b, c = sides = [values.quantities[name] for name in ("PQ", "QR", "PR")]
    for k, side in enumerate(sides):
        addresses_of_others = " + ".join(other_side.address for other_side in (sides[k - 1], sides[k - 2]))
        reader.add_sum_condition(
            side, addresses_of_others, "each side of a triangle is shorter than the other two together"
        )
    zero = Quantity(f"{address}.P", Number(0.0, "0"), LENGTH, location)
    quantities = {"a": a, "b": b, "c": c}
    sign = "-" if values.options.get("side") == "right" else ""
    height = f"{sign}sqrt((a + b + c) * (b + c - a) * (a + c - b) * (a + b - c)) / (2 * a)"
    x = derive_quantity(reader, "(a**2 + c**2 - b**2) / (2 * a)", quantities, f"{address}.R.x", LENGTH, location)
    y = derive_quantity(reader, height, quantities, f"{address}.R.y", LENGTH, location)
    return dict(zip(CORNERS_OF_SIDES, ((zero, zero), (a, zero), (x, y)), strict=True))


class MassProperties:
    """Contain mass, moment of inertia and centre of mass of one body; a shape sets those that the file omits."""

    def __init__(self, reader: Reader, address: str, body_values: Values, materials: Materials) -> None:
        """Begin with the values of the body with an address, as far as the file has them."""
        self._reader, self._address, self._materials = reader, address, materials
        self.mass, self.inertia = body_values.quantities.get("mass"), body_values.quantities.get("inertia")
        self.length, self.com = body_values.quantities.get("length"), body_values.vectors.get("com")
        self.follows_mass = False  # whether the moment of inertia follows from the mass

    @property
    def missing_keys(self) -> tuple[str, ...]:
        """Return the keys, "mass" or "inertia", that dynamics needs and the body does not have."""
        needs_inertia = self.inertia is None and not self.follows_mass
        return (*(("mass",) if self.mass is None else ()), *(("inertia",) if needs_inertia else ()))

    def set_slender_inertia(self, location: Location) -> None:
        """Set the inertia of a slender bar about its centre, m l²/12, for `inertia: auto` at `location`.

        Raises BadValueError if the body has no length, or a centre of mass that the file gives.
        """
        address, hint = f"{self._address}.inertia", "expected a number, or a body with length: and mass: only"
        if self.length is None:
            raise BadValueError(f"{address} is auto, that of a slender bar, and the body has no length", location, hint)
        if self.com is not None:
            fault = f"{address} is auto, that of a slender bar about its middle, and the body has com"
            raise BadValueError(fault, location, "expected no com, or a number for inertia")
        self._set_inertia(_SLENDER_BAR_INERTIA, {"l": self.length}, location)

    def set_properties_from_shape(self, node: Map, key: Text, points: Mapping[str, Vector], has_inertia: bool) -> None:
        """Set mass, inertia and centre of mass that follow from the body's shape.

        `node` and `key` are the shape's node and key; `points` are the points that a triangle may name. Raises
        InputError, also if the body has both a moment of inertia and a shape.
        """
        address = f"{self._address}.shape"
        kind = find_kind_key(node, _KINDS, [field.name for field in SHAPE.fields], address)
        values = read_fields(self._reader, node, SHAPE.fields, FieldContext(address))
        if has_inertia:
            raise BadValueError(f"{self._address} has inertia and a shape", key.where, "expected one of the two")
        if kind == "triangle":
            area, squared_radius, lengths = self._describe_triangle(node, kind, points)
        else:
            area, squared_radius, lengths = self._describe_centred_shape(kind, values)
        self._set_mass(node, values, area, lengths, key)
        self._set_inertia(f"m * {squared_radius}", lengths, key.where)

    def _read_density(self, node: Map, values: Values) -> Quantity | None:
        """Return the shape's density or that of its material, None without both. Raises an InputError for both."""
        if "material" not in node:
            return values.quantities.get("density")
        address, text = f"{self._address}.shape", node["material"]
        if "density" in node:
            raise BadValueError(f"{address} has density and material", text.where, "expected one of the two")
        return self._materials.read_properties(f"{address}.material", text, ("density",))["density"]

    def _set_mass(self, node: Map, values: Values, area: str, lengths: Mapping[str, Quantity], key: Text) -> None:
        """Set the mass to density times thickness times `area`, unless the shape has neither density nor thickness.

        `area` is a formula of the variables `lengths`. Raises an InputError if the body also gives its mass, or if one
        of density and thickness is missing.
        """
        plate_quantities = {"d": self._read_density(node, values), "h": values.quantities.get("thickness")}
        known_quantities = {letter: quantity for letter, quantity in plate_quantities.items() if quantity is not None}
        if known_quantities and self.mass is not None:
            hint = "expected the mass, or density or material, and thickness"
            phrase = "material" if "material" in node else "density"
            raise BadValueError(f"{self._address} has mass and a shape with {phrase} or thickness", key.where, hint)
        if len(known_quantities) == 1:
            raise make_missing_key_error(
                "thickness" if "d" in known_quantities else "density", key.where, f"{self._address}.shape"
            )
        if known_quantities:
            address = f"{self._address}.mass"
            self.mass = derive_quantity(
                self._reader, f"d * h * ({area})", {**known_quantities, **lengths}, address, MASS, key.where
            )
            self._reader.add_condition(self.mass, ">", 0.0, "a mass is positive")

    def _set_inertia(self, formula: str, lengths: Mapping[str, Quantity], location: Location) -> None:
        """Set the moment of inertia to a formula of the mass m and the lengths `lengths`, if the mass is known.

        Otherwise only `follows_mass` is set. The condition that the inertia is positive is recorded.
        """
        self.follows_mass = True
        if self.mass is not None:
            address = f"{self._address}.inertia"
            self.inertia = derive_quantity(
                self._reader, formula, {"m": self.mass, **lengths}, address, INERTIA, location
            )
            self._reader.add_condition(self.inertia, ">", 0.0, "a moment of inertia is positive")

    def _describe_centred_shape(self, kind: Text, values: Values) -> tuple[str, str, dict[str, Quantity]]:
        """Return area, squared radius of gyration and their variables for a shape centred on the centre of mass.

        The first two are formulas, the last maps names of variables to quantities. Raises BadValueError for a bar
        without a length.
        """
        if kind == "disc":
            return "pi * r**2", "r**2 / 2", {"r": values.quantities["disc"]}
        if kind == "rectangle":
            a, b = values.vectors["rectangle"]
        elif self.length is None:
            fault, hint = (
                f"{self._address}.shape is a bar, and the body has no length",
                "expected rectangle: [length, width]",
            )
            raise BadValueError(fault, kind.where, hint)
        else:
            a, b = self.length, values.quantities["bar"]
        return "a * b", "(a**2 + b**2) / 12", {"a": a, "b": b}

    def _describe_triangle(
        self, node: Map, kind: Text, points: Mapping[str, Vector]
    ) -> tuple[str, str, dict[str, Quantity]]:
        """Return area, squared radius of gyration and their variables for a triangle, and set its centre of mass.

        Raises BadValueError if the body has a centre of mass already, UnknownNameError for an unknown corner.
        """
        if self.com is not None:
            fault = f"{self._address} has com and a triangle, which determines the centre of mass"
            raise BadValueError(fault, kind.where, "expected one of the two")
        coordinates: dict[str, Quantity] = {}
        for letter, name in zip("pqr", node["triangle"], strict=True):
            if name not in points:
                owner = self._address.removeprefix("bodies.")
                raise make_unknown_name_error(f"point of {owner}", name, points, name.where)
            coordinates |= {f"{letter}{axis}": x for axis, x in zip("xy", points[name], strict=True)}
        centroid = [
            derive_quantity(
                self._reader,
                f"(p{axis} + q{axis} + r{axis}) / 3",
                {k: x for k, x in coordinates.items() if k[1] == axis},
                f"{self._address}.com.{axis}",
                LENGTH,
                kind.where,
            )
            for axis in "xy"
        ]
        self.com = (centroid[0], centroid[1])
        return _AREA, _SQUARED_RADIUS_OF_GYRATION, coordinates

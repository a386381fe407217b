"""Lists the fields of the C struct Parameters, each with its address and its SI unit for the comment."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

import sympy as sp

from gudgeon.generator.field import Field
from gudgeon.generator.format.sections import MECHANISM_FILE
from gudgeon.generator.symbols.parameter_table import ParameterTable
from gudgeon.generator.targets.c.printer import sanitize_comment
from gudgeon.language.units import DIMENSIONLESS, POWER, PRESSURE, VISCOSITY, Dimension

_UNIT_NAMES = {PRESSURE: "Pa", VISCOSITY: "Pa*s", POWER: "W"}


def list_parameter_fields(parameter_table: ParameterTable) -> list[tuple[str, str]]:
    """Return (name, comment) of each field of the C struct Parameters, in order.

    Entries of the file come first, then derived parameters. A table is one array field. The comment has the address
    and the unit.
    """
    dimensions: dict[sp.Symbol, Dimension | None] = {}
    fields = []
    table_entries = {symbol for table in parameter_table.tables.values() for symbol in table[1:]}
    sizes = {table[0]: f"{name}[{len(table)}]" for name, table in parameter_table.tables.items()}
    for entry in parameter_table.entries.values():
        dimensions[entry.symbol] = entry.dimension
        if entry.symbol in table_entries:
            continue
        is_angle = entry.address.endswith(".theta") and entry.dimension == DIMENSIONLESS
        unit = "rad" if is_angle else _find_coefficient_meaning(entry.address) or format_dimension(entry.dimension)
        name = sizes.get(entry.symbol, parameter_table.find_member_name(entry.symbol))
        address = entry.address.rpartition(".")[0] if entry.symbol in sizes else entry.address
        fields.append((name, sanitize_comment(f"{address}, {unit}")))
    for symbol, value in parameter_table.derived.items():
        dimensions[symbol] = _derive_dimension(value, dimensions)
        dimension = dimensions[symbol]
        comment_parts = (parameter_table.symbols.info[symbol].meaning, format_dimension(dimension) if dimension else "")
        fields.append(
            (parameter_table.find_member_name(symbol), sanitize_comment(", ".join(filter(None, comment_parts))))
        )
    return fields


def _find_coefficient_meaning(address: str) -> str:
    """Return the meaning of a law's coefficient whose unit depends on an exponent, such as K in N/m^n.

    The comment of its field states the meaning instead of a unit. "" is returned for other addresses.
    """
    field: Field | None = MECHANISM_FILE if address.startswith("contacts.") else None
    for part in address.split("."):
        field = field and field.find_field(part)
    return field.meaning if field and field.accepts_any_dimension else ""


def format_dimension(dimension: Dimension) -> str:
    """Return the SI unit of a dimension in ASCII, such as "N*m" or "N*s/m^1.5"; "1" for a plain number and rad."""
    if unit := _UNIT_NAMES.get(dimension):
        return unit
    powers = {"kg": dimension.mass, "m": dimension.length, "s": dimension.time}
    if dimension.mass == 1 and dimension.time in (-1, -2):
        powers = {"N": Fraction(1), "m": dimension.length - 1, "s": dimension.time + 2}
    numerator, divisors = _print_unit_product(powers), _print_unit_product({unit: -n for unit, n in powers.items()})
    denominator = f"({divisors})" if "*" in divisors else divisors
    return f"{numerator or 1}/{denominator}" if divisors else numerator or "1"


def _print_unit_product(powers: Mapping[str, Fraction]) -> str:
    """Return the product of the units with positive powers as text: "N*s", "m^1.5"; "" if there are none.

    powers: {unit: exponent}. An exponent with a denominator other than 1, 2 or 4 is printed as a fraction: "m^(1/3)".
    """
    printed_powers = {
        unit: f"{float(n):g}" if n.denominator in (1, 2, 4) else f"({n})" for unit, n in powers.items() if n > 0
    }
    return "*".join(unit if n == "1" else f"{unit}^{n}" for unit, n in printed_powers.items())


def _derive_dimension(value: sp.Expr, dimensions: dict[sp.Symbol, Dimension | None]) -> Dimension | None:
    """Return the dimension of a derived parameter's expression; None if an exponent in it is not a rational number.

    dimensions: those of the parameters before it. A sum has the dimension of its first term that has one; max, min and
    abs have that of their first argument. Numbers and other functions are dimensionless. Dimensions are not checked.
    """
    if value.is_Symbol:
        return dimensions.get(value)
    if value.is_Add:
        return next((d for term in value.args if (d := _derive_dimension(term, dimensions))), DIMENSIONLESS)
    if value.is_Mul:
        product: Dimension | None = DIMENSIONLESS
        for factor in value.args:
            factor_dimension = _derive_dimension(factor, dimensions)
            product = product * factor_dimension if product and factor_dimension else None
        return product
    if value.is_Pow:
        base, exponent = _derive_dimension(value.base, dimensions), value.exp
        if base is None or base == DIMENSIONLESS:
            return base
        return base ** Fraction(int(exponent.p), int(exponent.q)) if exponent.is_Rational else None
    if isinstance(value, (sp.Max, sp.Min, sp.Abs)):
        return _derive_dimension(value.args[0], dimensions)
    return DIMENSIONLESS

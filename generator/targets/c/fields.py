"""The fields of Parameters: what each number is, its unit, and under which address a user sets it."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

import sympy as sp

from gudgeon.generator.field import Field
from gudgeon.generator.format.sections import FILE
from gudgeon.generator.symbols.numbers import Slots
from gudgeon.generator.targets.c.printer import comment_text
from gudgeon.language.units import DIMENSIONLESS, POWER, PRESSURE, VISCOSITY, Dimension

_NAMED = {PRESSURE: "Pa", VISCOSITY: "Pa*s", POWER: "W"}


def parameter_fields(slots: Slots) -> list[tuple[str, str]]:
    """Name and comment of each field, in the order of the struct."""
    known: dict[sp.Symbol, Dimension | None] = {}
    fields = []
    inner = {symbol for table in slots.tables.values() for symbol in table[1:]}
    sizes = {table[0]: f"{name}[{len(table)}]" for name, table in slots.tables.items()}
    for entry in slots.entries.values():
        known[entry.symbol] = entry.dimension
        if entry.symbol in inner:
            continue
        turn = entry.address.endswith(".theta") and entry.dimension == DIMENSIONLESS
        unit = "rad" if turn else _unit_of_law(entry.address) or unit_text(entry.dimension)
        name = sizes.get(entry.symbol, slots.field(entry.symbol))
        address = entry.address.rpartition(".")[0] if entry.symbol in sizes else entry.address
        fields.append((name, comment_text(f"{address}, {unit}")))
    for symbol, value in slots.derived.items():
        known[symbol] = _dimension(value, known)
        own = known[symbol]
        told = (slots.symbols.info[symbol].meaning, unit_text(own) if own else "")
        fields.append((slots.field(symbol), comment_text(", ".join(filter(None, told)))))
    return fields


def _unit_of_law(address: str) -> str:
    """What a law says of its number whose unit hangs on another one: "force at unit penetration, N/m^n"."""
    field: Field | None = FILE if address.startswith("contacts.") else None
    for part in address.split("."):
        field = field and field.below(part)
    return field.meaning if field and field.any_dimension else ""


def unit_text(dimension: Dimension) -> str:
    """As people write it: N*m, Pa, N*s/m^1.5, kg*m^2; 1 of a plain number, rad too."""
    if unit := _NAMED.get(dimension):
        return unit
    powers = {"kg": dimension.mass, "m": dimension.length, "s": dimension.time}
    if dimension.mass == 1 and dimension.time in (-1, -2):
        powers = {"N": Fraction(1), "m": dimension.length - 1, "s": dimension.time + 2}
    above, below = _product(powers), _product({unit: -n for unit, n in powers.items()})
    many = f"({below})" if "*" in below else below
    return f"{above or 1}/{many}" if below else above or "1"


def _product(powers: Mapping[str, Fraction]) -> str:
    """Of those above zero: N*s, m^1.5."""
    exact = {unit: f"{float(n):g}" if n.denominator in (1, 2, 4) else f"({n})" for unit, n in powers.items() if n > 0}
    return "*".join(unit if n == "1" else f"{unit}^{n}" for unit, n in exact.items())


def _dimension(value: sp.Expr, known: dict[sp.Symbol, Dimension | None]) -> Dimension | None:
    """Of a derived number; None where an exponent is a number of the run, and with it the dimension."""
    if value.is_Symbol:
        return known.get(value)
    if value.is_Add:
        return next((d for term in value.args if (d := _dimension(term, known))), DIMENSIONLESS)
    if value.is_Mul:
        product: Dimension | None = DIMENSIONLESS
        for factor in value.args:
            own = _dimension(factor, known)
            product = product * own if product and own else None
        return product
    if value.is_Pow:
        base, exponent = _dimension(value.base, known), value.exp
        if base is None or base == DIMENSIONLESS:
            return base
        return base ** Fraction(int(exponent.p), int(exponent.q)) if exponent.is_Rational else None
    if isinstance(value, (sp.Max, sp.Min, sp.Abs)):
        return _dimension(value.args[0], known)
    return DIMENSIONLESS

"""Decides what a product such as `400 N/m` means if `m` is also a name of the file.

A name of the file takes precedence over a unit in a product (parser.py): `0.1 m*N*mu` is a length times two parameters.
Two things limit that rule:

- A value that holds nothing but numbers and published units (units.py), `k: 400 N/m`, is a quantity, unless its
  dimension shows that a name is meant.
- Where both readings have a possible dimension and the name's dimension cannot distinguish them, the value is refused.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping

from gudgeon.errors import ExpressionError, InputError, UnitError
from gudgeon.generator.yaml import Text
from gudgeon.language.curves import Curve
from gudgeon.language.dimension_check import check_dimension, names_over_units
from gudgeon.language.parser import parse
from gudgeon.language.tree import Expr, names, units
from gudgeon.language.units import UNITS, Dimension, symbol_dimension

DimensionOf = Callable[[str], Dimension | None]  # None: defined without a unit


def choose_reading(
    text: Text, by_name: Expr, expected: Dimension | None, dimension_of: DimensionOf, curves: Mapping[str, Curve]
) -> Expr:
    """Return the tree of `text`: `by_name`, in which names precede units, or the one in which they are all units.

    `expected` is the dimension of the value, None if any. Raises ExpressionError if both readings are possible.
    """
    shadowed = sorted(set(names_over_units(by_name)))
    if not shadowed:
        return by_name
    try:
        by_unit = parse(text, text.where, (), curves)
    except InputError:
        return by_name
    if by_unit == by_name:  # in brackets: 3 N*(m)
        return by_name
    is_quantity = next(names(by_unit), None) is None and all(unit in UNITS for unit in units(by_unit))
    name_fits, unit_fits = (_fits(tree, expected, dimension_of, text) for tree in (by_name, by_unit))
    if name_fits and not unit_fits:
        return by_name
    dimensions = [(dimension_of(name), symbol_dimension(name)) for name in shadowed]
    if is_quantity and unit_fits and all(of is not None and of != its for of, its in dimensions):
        return by_unit
    if not is_quantity and all(of is not None for of, _ in dimensions):
        return by_name
    raise _ambiguity_error(text, shadowed)


def _fits(tree: Expr, expected: Dimension | None, dimension_of: DimensionOf, text: Text) -> bool:
    """Return whether a tree has the expected dimension."""
    try:
        check_dimension(tree, expected, dimension_of, text.where)
    except UnitError:
        return False
    return True


def _ambiguity_error(text: Text, shadowed: list[str]) -> ExpressionError:
    """Return the error for a value with two readings, with both unambiguous spellings as a hint."""
    compact = re.sub(r" *([*/]) *", r"\1", text)
    factor = re.compile(rf"(?<=[*/])({'|'.join(shadowed)})(?![\w.^(])")
    are = f"{' and '.join(shadowed)} {'are names and units' if shadowed[1:] else 'is a name of this file and a unit'}"
    by_name, by_unit = factor.sub(r"(\1)", compact), factor.sub(r"\1^1", compact)
    hint = f"write {by_name} for the name, {by_unit} for the unit"
    return ExpressionError(f"{str(text)!r} can mean two things: {are}", text.where, hint)

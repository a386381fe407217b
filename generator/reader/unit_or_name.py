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
from gudgeon.language.dimension_check import check_dimension, find_unit_shadowing_names
from gudgeon.language.parser import parse
from gudgeon.language.tree import Expr, iterate_names, iterate_units
from gudgeon.language.units import UNITS, Dimension, find_symbol_dimension

DimensionOf = Callable[[str], Dimension | None]  # None: defined without a unit


def choose_interpretation(
    text: Text,
    tree_with_names: Expr,
    expected: Dimension | None,
    find_name_dimension: DimensionOf,
    curves: Mapping[str, Curve],
) -> Expr:
    """Return the tree of `text`: `tree_with_names`, in which names precede units, or the one in which all are units.

    `expected` is the dimension of the value, None if any. `find_name_dimension` returns that of a name. The tree with
    names is returned if no name is also a unit, if the text cannot be parsed with units, or if only names give the
    expected dimension. Raises ExpressionError if both readings are possible and dimensions do not decide.
    """
    ambiguous_names = sorted(set(find_unit_shadowing_names(tree_with_names)))
    if not ambiguous_names:
        return tree_with_names
    try:
        tree_with_units = parse(text, text.where, (), curves)
    except InputError:
        return tree_with_names
    if tree_with_units == tree_with_names:  # in brackets: 3 N*(m)
        return tree_with_names
    is_quantity = next(iterate_names(tree_with_units), None) is None and all(
        unit in UNITS for unit in iterate_units(tree_with_units)
    )
    name_fits, unit_fits = (
        _has_dimension(tree, expected, find_name_dimension, text) for tree in (tree_with_names, tree_with_units)
    )
    if name_fits and not unit_fits:
        return tree_with_names
    dimensions = [(find_name_dimension(name), find_symbol_dimension(name)) for name in ambiguous_names]
    if (
        is_quantity
        and unit_fits
        and all(
            dimension_of_name is not None and dimension_of_name != dimension_of_unit
            for dimension_of_name, dimension_of_unit in dimensions
        )
    ):
        return tree_with_units
    if not is_quantity and all(dimension_of_name is not None for dimension_of_name, _ in dimensions):
        return tree_with_names
    raise _make_ambiguity_error(text, ambiguous_names)


def _has_dimension(tree: Expr, expected: Dimension | None, find_name_dimension: DimensionOf, text: Text) -> bool:
    """Return whether a tree has the expected dimension; `text` locates the expression.

    `expected` None: any dimension, if the tree is consistent.
    """
    try:
        check_dimension(tree, expected, find_name_dimension, text.where)
    except UnitError:
        return False
    return True


def _make_ambiguity_error(text: Text, ambiguous_names: list[str]) -> ExpressionError:
    """Return the error for a value with two readings, with both unambiguous spellings as a hint."""
    text_without_spaces = re.sub(r" *([*/]) *", r"\1", text)
    pattern = re.compile(rf"(?<=[*/])({'|'.join(ambiguous_names)})(?![\w.^(])")
    predicate = "are names and units" if ambiguous_names[1:] else "is a name of this file and a unit"
    phrase = f"{' and '.join(ambiguous_names)} {predicate}"
    spelling_for_names, spelling_for_units = (
        pattern.sub(r"(\1)", text_without_spaces),
        pattern.sub(r"\1^1", text_without_spaces),
    )
    hint = f"write {spelling_for_names} for the name, {spelling_for_units} for the unit"
    return ExpressionError(f"{str(text)!r} can mean two things: {phrase}", text.where, hint)

"""Expressions by name: parts of drives, forces, events and outputs that a file writes once and uses by their names.

A name stands for its tree: where it is used, the tree takes its place, the same object each time, so that what is
derived of it is derived once. What it may hold is asked where it is used too: a drive takes t and parameters alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from gudgeon.errors import LimitError, Location
from gudgeon.generator.field import OF_MOTION, OF_TIME
from gudgeon.generator.mechanism import Quantity
from gudgeon.generator.reader.collector import NamedExpression, Reader
from gudgeon.generator.reader.parameters import dependency_order
from gudgeon.generator.reader.unit_or_name import settle_reading
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.dimension_check import check_dimension
from gudgeon.language.parser import COPIES
from gudgeon.language.tree import Binary, Call, Expr, Name, Unary, names, replaced
from gudgeon.language.units import DIMENSIONLESS

MOST = 4000  # parts of an expression with all names written out
DEEPEST = 100  # levels of it


def read_expressions(reader: Reader, root: Map) -> dict[str, Quantity]:
    """The section `expressions:` in the order of the file; reader.expressions knows them afterwards."""
    texts = {str(name): text for name, text in root.part("expressions").pairs() if name in reader.expressions}
    trees: dict[str, Expr] = {}
    for name, text in texts.items():
        with reader.collect():
            trees[name] = reader.parse(text, f"expressions.{name}")
    order: Iterable[str] = ()
    with reader.collect():
        order = dependency_order(trees, {name: text.where for name, text in texts.items()}, "expressions")
    sizes: dict[str, tuple[int, int]] = {}
    for name in order:
        with reader.collect():
            reader.expressions[name] = _named(reader, name, texts[name], trees[name], sizes)
    for name, one in reader.expressions.items():
        reader.made_of[f"expressions.{name}"] = reader.expressions_in_tree(one.written)
    return {
        name: reader.keep(
            Quantity(f"expressions.{name}", one.value, one.dimension or DIMENSIONLESS, one.where, written=one.written)
        )
        for name, one in reader.expressions.items()
    }


def _named(reader: Reader, name: str, text: Text, tree: Expr, sizes: dict[str, tuple[int, int]]) -> NamedExpression:
    """An expression, when those in it are known. Raises an InputError at what it may not hold."""
    tree = settle_reading(text, tree, None, reader.dimension_of_number, reader.curves)
    sizes[name] = _size(name, tree, text.where, sizes)
    value = replaced(tree, {other: one.value for other, one in reader.expressions.items()})
    moves = any("." in inner.path for inner in names(value))
    known = reader.dimensions_of_names(tree, text.where, OF_MOTION if moves else OF_TIME)
    return NamedExpression(tree, value, check_dimension(tree, None, known.get, text.where), text.where)


def _size(name: str, tree: Expr, where: Location, of: Mapping[str, tuple[int, int]]) -> tuple[int, int]:
    """How many parts and levels a tree has with all names written out. Raises LimitError where these are too many."""
    parts, levels = _measured(tree, of)
    if parts > MOST or levels > DEEPEST:
        message = f"expressions.{name} has {parts} parts in {levels} levels with all names written out"
        raise LimitError(message, where, f"expected at most {MOST} in {DEEPEST}")
    return parts, levels


def _measured(tree: Expr, of: Mapping[str, tuple[int, int]]) -> tuple[int, int]:
    match tree:
        case Name(path=path):
            return of.get(path, (1, 1))
        case Unary(operand=operand):
            below = [_measured(operand, of)]
        case Binary(left=left, right=right):
            below = [_measured(left, of), _measured(right, of)]
        case Call(arguments=arguments):
            below = [_measured(argument, of) for argument in arguments]
        case _:
            return 1, 1
    copies = COPIES.get(getattr(tree, "function", ""), 1)
    return 1 + copies * sum(parts for parts, _ in below), 1 + max(levels for _, levels in below)

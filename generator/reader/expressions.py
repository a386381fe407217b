"""Expressions by name: parts of drives, forces, events and outputs that a file writes once and uses by their names.

A name stands for its tree: where it is used, the tree takes its place, the same object each time, so that what is
derived of it is derived once. What it may hold is asked where it is used too: a drive takes t and parameters alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from gudgeon.errors import BadNameError, LimitError, Location
from gudgeon.generator.mechanism.mechanism import Quantity
from gudgeon.generator.reader.collector import Named, Reader, ResultDimension
from gudgeon.generator.reader.parameters import dependency_order
from gudgeon.generator.reader.unit_or_name import settle_reading
from gudgeon.generator.yaml.tree import Map, Text
from gudgeon.language.dimension_check import check_dimension
from gudgeon.language.names import check_name
from gudgeon.language.parser import COPIES
from gudgeon.language.tree import Binary, Call, Expr, Name, Unary, names, replaced
from gudgeon.language.units import DIMENSIONLESS

TIME = "t"
MOST = 4000  # parts of an expression with all names written out
DEEPEST = 100  # levels of it
_BROKEN = Name("t")  # stands for what cannot be read: whoever uses it is not told of it again


def read_expressions(reader: Reader, root: Map) -> None:
    """The section `expressions:`; reader.expressions knows them afterwards, without the dimensions of what moves."""
    section, trees = root.part("expressions"), dict[str, Expr]()
    for name, text in section.pairs():
        reader.expressions[str(name)] = Named(_BROKEN, _BROKEN, None, text.where)
    for name, text in section.pairs():
        with reader.collect():
            _check_name(root, name)
        if name == TIME:  # it was refused: elsewhere it is the time
            del reader.expressions[str(name)]
            continue
        with reader.collect():
            trees[str(name)] = reader.parse(text, f"expressions.{name}")
    texts = {str(name): text for name, text in section.pairs() if name != TIME}
    places = {name: text.where for name, text in texts.items()}
    order: Iterable[str] = ()
    with reader.collect():
        order = dependency_order(trees, places, "expressions")
    sizes: dict[str, tuple[int, int]] = {}
    for used in order:
        with reader.collect():
            trees[used] = settle_reading(texts[used], trees[used], None, reader.dimension_of_number, reader.curves)
            sizes[used] = _size(used, trees[used], places[used], sizes)
            value = replaced(trees[used], {other: named.value for other, named in reader.expressions.items()})
            one = Named(trees[used], value, None, places[used])
            reader.expressions[used] = one if _moves(value) else _settled(reader, one, None)


def settle_expressions(reader: Reader, motion: ResultDimension) -> dict[str, Quantity]:
    """All of them by name, those of motion with their dimensions too, now that its names are known."""
    order = dependency_order({name: one.written for name, one in reader.expressions.items()}, {}, "expressions")
    for name in order:
        if _moves((one := reader.expressions[name]).value):
            reader.expressions[name] = replace(one, written=_BROKEN)
            with reader.collect():
                reader.expressions[name] = _settled(reader, one, motion)
    for name, one in reader.expressions.items():
        reader.made_of[f"expressions.{name}"] = reader.expressions_in(one.written)
    return {
        name: reader.keep(
            Quantity(f"expressions.{name}", one.value, one.dimension or DIMENSIONLESS, one.where, written=one.written)
        )
        for name, one in reader.expressions.items()
    }


def _moves(value: Expr) -> bool:
    return any("." in name.path for name in names(value))


def _settled(reader: Reader, one: Named, motion: ResultDimension | None) -> Named:
    """An expression with its dimension. Raises an InputError at what it may not hold."""
    known = reader.check_names(one.written, one.where, True, motion)
    return replace(one, dimension=check_dimension(one.written, None, known.get, one.where))


def _check_name(root: Map, name: Text) -> None:
    check_name(name, "expression", name.where)
    for section, what in (("parameters", "a parameter"), ("curves", "a curve"), ("outputs", "an output")):
        if name in root.part(section):
            hint = "expected a name of its own: both stand in expressions"
            raise BadNameError(f"{name!r} names this expression and {what}", name.where, hint)


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

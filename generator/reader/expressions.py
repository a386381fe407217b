"""Reads named expressions: parts of drives, forces, events and outputs that a file writes once and uses by name.

Where a name is used, its tree replaces it, always the same object, so that it is differentiated once. Each use checks
what the expression may depend on: a drive allows t and parameters only.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from gudgeon.errors import LimitError, Location
from gudgeon.generator.field import OF_MOTION, OF_TIME
from gudgeon.generator.mechanism import Quantity
from gudgeon.generator.reader.collector import NamedExpression, Reader
from gudgeon.generator.reader.parameters import sort_by_dependencies
from gudgeon.generator.reader.unit_or_name import choose_interpretation
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.dimension_check import check_dimension
from gudgeon.language.parser import ARGUMENT_COPIES
from gudgeon.language.tree import Binary, Call, Expr, Name, Unary, iterate_names, replace_names
from gudgeon.language.units import DIMENSIONLESS

MAX_PARTS = 4000  # parts of an expression with all names replaced by their trees
MAX_LEVELS = 100  # levels of such a tree


def read_expressions(reader: Reader, root: Map) -> dict[str, Quantity]:
    """Return the section `expressions:` as quantities in the order of the file, and fill reader.expressions.

    Each is read after those that it uses. Errors are collected; a placeholder remains for an entry with an error.
    """
    texts = {
        str(name): text for name, text in root.get_mapping("expressions").list_entries() if name in reader.expressions
    }
    trees: dict[str, Expr] = {}
    for name, text in texts.items():
        with reader.collect_errors():
            trees[name] = reader.parse_expression(text, f"expressions.{name}")
    order: Iterable[str] = ()
    with reader.collect_errors():
        order = sort_by_dependencies(trees, {name: text.where for name, text in texts.items()}, "expressions")
    sizes: dict[str, tuple[int, int]] = {}
    for name in order:
        with reader.collect_errors():
            reader.expressions[name] = _read_named_expression(reader, name, texts[name], trees[name], sizes)
    for name, expression in reader.expressions.items():
        reader.named_expressions_used[f"expressions.{name}"] = reader.find_named_expressions(expression.source_tree)
    return {
        name: reader.register_quantity(
            Quantity(
                f"expressions.{name}",
                expression.expanded_tree,
                expression.dimension or DIMENSIONLESS,
                expression.where,
                source_tree=expression.source_tree,
            )
        )
        for name, expression in reader.expressions.items()
    }


def _read_named_expression(
    reader: Reader, name: str, text: Text, tree: Expr, sizes: dict[str, tuple[int, int]]
) -> NamedExpression:
    """Return one named expression whose parts are already known; `sizes` gets its size.

    Raises an InputError for a name that is not allowed, for another error of dimension, and for too large an
    expression.
    """
    tree = choose_interpretation(text, tree, None, reader.find_number_dimension, reader.curves)
    sizes[name] = _compute_expression_size(name, tree, text.where, sizes)
    value = replace_names(
        tree, {other_name: expression.expanded_tree for other_name, expression in reader.expressions.items()}
    )
    depends_on_motion = any("." in inner.path for inner in iterate_names(value))
    dimensions = reader.find_name_dimensions(tree, text.where, OF_MOTION if depends_on_motion else OF_TIME)
    return NamedExpression(tree, value, check_dimension(tree, None, dimensions.get, text.where), text.where)


def _compute_expression_size(
    name: str, tree: Expr, location: Location, sizes: Mapping[str, tuple[int, int]]
) -> tuple[int, int]:
    """Return the number of nodes and levels of an expression tree with all names replaced.

    `sizes` contains these numbers for each named expression that was read before. Raises LimitError above MAX_PARTS or
    MAX_LEVELS.
    """
    parts, levels = _measure_tree(tree, sizes)
    if parts > MAX_PARTS or levels > MAX_LEVELS:
        message = f"expressions.{name} has {parts} parts in {levels} levels with all names replaced"
        raise LimitError(message, location, f"expected at most {MAX_PARTS} parts in {MAX_LEVELS} levels")
    return parts, levels


def _measure_tree(tree: Expr, sizes: Mapping[str, tuple[int, int]]) -> tuple[int, int]:
    """Return (nodes, levels) of an expression tree; `sizes` contains them for each named expression.

    The arguments of a function in COPIES count as often as its SymPy form repeats them.
    """
    match tree:
        case Name(path=path):
            return sizes.get(path, (1, 1))
        case Unary(operand=operand):
            sizes_of_parts = [_measure_tree(operand, sizes)]
        case Binary(left=left, right=right):
            sizes_of_parts = [_measure_tree(left, sizes), _measure_tree(right, sizes)]
        case Call(arguments=arguments):
            sizes_of_parts = [_measure_tree(argument, sizes) for argument in arguments]
        case _:
            return 1, 1
    copies = ARGUMENT_COPIES.get(getattr(tree, "function", ""), 1)
    return 1 + copies * sum(parts for parts, _ in sizes_of_parts), 1 + max(levels for _, levels in sizes_of_parts)

"""Reads parameters, which may be defined by each other without cycles, and orders them by their dependencies."""

from __future__ import annotations

import graphlib
from collections.abc import Callable, Mapping
from dataclasses import replace

from gudgeon.errors import CycleError, InputError, Location, combine_errors
from gudgeon.generator.mechanism import Quantity
from gudgeon.generator.reader.collector import Reader, make_unreadable_number
from gudgeon.generator.reader.unit_or_name import choose_interpretation
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.dimension_check import check_dimension
from gudgeon.language.tree import Expr, evaluate, iterate_names
from gudgeon.language.unit_remedies import add_unit_hints
from gudgeon.language.units import DIMENSIONLESS, Dimension

MAX_REPORTED = 8  # names of a cycle in a message


def read_parameters(reader: Reader, section: Map) -> dict[str, Quantity]:
    """Return the section `parameters:` by name, in the order of the file.

    Dimensions are then in reader.parameters, None for a parameter without a unit. Errors are collected: the value of
    such a parameter is NaN.
    """
    texts = {str(name): text for name, text in section.list_entries()}
    trees: dict[str, Expr] = {name: make_unreadable_number(text) for name, text in texts.items()}
    for name, text in texts.items():
        if name in reader.invalid_names:
            continue
        with reader.collect_errors():

            def read_spelling(spelling_text: str, name: str = name, text: Text = text) -> Expr:
                """Return the tree of one spelling of a parameter's value, after checks of its names and dimension.

                `add_unit_hints` calls this function with other spellings. Raises InputError.
                """
                spelling = Text.make_text(spelling_text, text.where, text.plain, text.one_line)
                tree = reader.parse_expression(spelling, f"parameters.{name}", constant=True)
                reader.find_name_dimensions(tree, text.where)
                _find_parameter_dimension(name, tree, lambda _: None, text.where)
                return tree

            with add_unit_hints(text, text.where, read_spelling, None, reader.parameters):
                trees[name] = read_spelling(text)
    order: tuple[str, ...] = tuple(trees)
    with reader.collect_errors():
        order = sort_by_dependencies(trees, {name: text.where for name, text in texts.items()})
    for parameter in order:
        with reader.collect_errors():
            trees[parameter] = choose_interpretation(
                texts[parameter], trees[parameter], None, reader.parameters.get, {}
            )
            reader.parameters[parameter] = _find_parameter_dimension(
                parameter, trees[parameter], reader.parameters.get, texts[parameter].where
            )
    return {
        name: reader.register_quantity(
            Quantity(f"parameters.{name}", trees[name], reader.parameters[name] or DIMENSIONLESS, text.where)
        )
        for name, text in texts.items()
    }


def _find_parameter_dimension(
    name: str, tree: Expr, find_name_dimension: Callable[[str], Dimension | None], location: Location
) -> Dimension | None:
    """Return the dimension of a parameter, None without a unit. Raises InputError for exponents finer than halves.

    `find_name_dimension` returns the dimension of another parameter. `location` locates errors.
    """
    dimension = check_dimension(tree, None, find_name_dimension, location)
    if dimension is not None and not dimension.has_halves_at_most:
        raise InputError(
            f"the unit of parameter {name} has an exponent that is not a multiple of 1/2",
            location,
            "expected whole or half powers of m, kg, s",
        )
    return dimension


def infer_dimensions(reader: Reader, parameters: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """Return all parameters; those without a unit get the dimension in which they are used, if there is only one.

    They are registered again with this dimension. A parameter that is used in several dimensions stays without a unit.
    """
    inferred = dict(parameters)
    for name, dimensions in reader.candidate_dimensions.items():
        if len(dimensions) == 1:  # a number that is used in several dimensions stays without a unit
            inferred[name] = reader.register_quantity(replace(inferred[name], dimension=next(iter(dimensions))))
    return inferred


def sort_by_dependencies(
    trees: Mapping[str, Expr], locations: Mapping[str, Location], section: str = "parameters"
) -> tuple[str, ...]:
    """Return names in topological order: each comes after those that it uses.

    `trees` and `locations` are the expression and location of each name; `section` names the section in messages.
    Raises CycleError, or InputErrors for several cycles.
    """
    uses = {
        name: [dependency.path for dependency in iterate_names(tree) if dependency.path in trees]
        for name, tree in trees.items()
    }
    cycles: list[InputError] = []
    while True:
        try:
            order = tuple(graphlib.TopologicalSorter(uses).static_order())
            break
        except graphlib.CycleError as error:
            cycle = error.args[1][:0:-1]  # graphlib lists users first and the first one twice
            cycles.append(_make_cycle_error(cycle, locations, section))
            uses = {
                name: [other_name for other_name in dependencies if other_name not in cycle]
                for name, dependencies in uses.items()
                if name not in cycle
            }
    if cycles:
        raise combine_errors(cycles)
    return order


def _make_cycle_error(cycle: list[str], locations: Mapping[str, Location], section: str) -> CycleError:
    """Return the error for a cycle of names, which begins at the one that the file contains first.

    At most MAX_REPORTED names are listed.
    """
    first = min(range(len(cycle)), key=lambda i: locations[cycle[i]])
    path = [*cycle[first:], *cycle[:first]]
    if len(path) > MAX_REPORTED:
        path[MAX_REPORTED - 1 :] = [f"… ({len(path) - MAX_REPORTED + 1} more)"]
    message = f"{section} depend on each other: {' → '.join([*path, cycle[first]])}"
    return CycleError(
        message,
        locations[cycle[first]],
        "expected at least one of them with a value that does not depend on the others",
    )


def evaluate_parameters(parameters: Mapping[str, Quantity]) -> dict[str, float]:
    """Return the value of every parameter in SI units by name. Raises CycleError.

    The names are ordered by their dependencies: each comes after those that it uses.
    """
    trees = {name: quantity.value for name, quantity in parameters.items()}
    values: dict[str, float] = {}
    for name in sort_by_dependencies(trees, {name: quantity.where for name, quantity in parameters.items()}):
        values[name] = float(evaluate(trees[name], values.__getitem__))
    return values

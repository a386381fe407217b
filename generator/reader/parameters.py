"""Reads parameters, which may be defined by each other without cycles, and orders them by their dependencies."""

from __future__ import annotations

import graphlib
from collections.abc import Callable, Mapping
from dataclasses import replace

from gudgeon.errors import CycleError, InputError, Location, together
from gudgeon.generator.mechanism import Quantity
from gudgeon.generator.reader.collector import Reader, unreadable_number
from gudgeon.generator.reader.unit_or_name import choose_reading
from gudgeon.generator.yaml import Map, Text
from gudgeon.language.dimension_check import check_dimension
from gudgeon.language.tree import Expr, evaluate, names
from gudgeon.language.unit_remedies import unit_remedies
from gudgeon.language.units import DIMENSIONLESS, Dimension

MAX_REPORTED = 8  # names of a cycle in a message


def read_parameters(reader: Reader, section: Map) -> dict[str, Quantity]:
    """Read the section `parameters:` in the order of the file; reader.parameters then contains their dimensions."""
    texts = {str(name): text for name, text in section.pairs()}
    trees: dict[str, Expr] = {name: unreadable_number(text) for name, text in texts.items()}
    for name, text in texts.items():
        if name in reader.refused:
            continue
        with reader.collect():

            def read(value: str, name: str = name, text: Text = text) -> Expr:
                """Parse one spelling of a parameter's value and check its names and dimension."""
                written = Text.make(value, text.where, text.plain, text.one_line)
                tree = reader.parse(written, f"parameters.{name}", constant=True)
                reader.dimensions_of_names(tree, text.where)
                _parameter_dimension(name, tree, lambda _: None, text.where)
                return tree

            with unit_remedies(text, text.where, read, None, reader.parameters):
                trees[name] = read(text)
    order: tuple[str, ...] = tuple(trees)
    with reader.collect():
        order = dependency_order(trees, {name: text.where for name, text in texts.items()})
    for used in order:
        with reader.collect():
            trees[used] = choose_reading(texts[used], trees[used], None, reader.parameters.get, {})
            reader.parameters[used] = _parameter_dimension(used, trees[used], reader.parameters.get, texts[used].where)
    return {
        name: reader.keep(
            Quantity(f"parameters.{name}", trees[name], reader.parameters[name] or DIMENSIONLESS, text.where)
        )
        for name, text in texts.items()
    }


def _parameter_dimension(
    name: str, tree: Expr, of: Callable[[str], Dimension | None], where: Location
) -> Dimension | None:
    """Return the dimension of a parameter, None without a unit. Raises InputError for exponents finer than halves."""
    found = check_dimension(tree, None, of, where)
    if found is not None and not found.has_halves_at_most:
        raise InputError(
            f"the unit of parameter {name} has a broken exponent", where, "expected whole or half powers of m, kg, s"
        )
    return found


def infer_dimensions(reader: Reader, parameters: Mapping[str, Quantity]) -> dict[str, Quantity]:
    """Give parameters without a unit the dimension in which they are used, if there is only one."""
    inferred = dict(parameters)
    for name, used_as in reader.uses.items():
        if len(used_as) == 1:  # a number that is used in several dimensions stays without a unit
            inferred[name] = reader.keep(replace(inferred[name], dimension=next(iter(used_as))))
    return inferred


def dependency_order(
    trees: Mapping[str, Expr], places: Mapping[str, Location], what: str = "parameters"
) -> tuple[str, ...]:
    """Return names so that each comes after those that it uses.

    Raises CycleError, or InputErrors for several cycles.
    """
    uses = {name: [used.path for used in names(tree) if used.path in trees] for name, tree in trees.items()}
    cycles: list[InputError] = []
    while True:
        try:
            order = tuple(graphlib.TopologicalSorter(uses).static_order())
            break
        except graphlib.CycleError as error:
            cycle = error.args[1][:0:-1]  # graphlib lists users first and the first one twice
            cycles.append(_cycle_error(cycle, places, what))
            uses = {name: [x for x in of if x not in cycle] for name, of in uses.items() if name not in cycle}
    if cycles:
        raise together(cycles)
    return order


def _cycle_error(cycle: list[str], places: Mapping[str, Location], what: str) -> CycleError:
    """Return the error for a cycle, beginning at the name that the file contains first; long cycles are shortened."""
    first = min(range(len(cycle)), key=lambda i: places[cycle[i]])
    path = [*cycle[first:], *cycle[:first]]
    if len(path) > MAX_REPORTED:
        path[MAX_REPORTED - 1 :] = [f"… ({len(path) - MAX_REPORTED + 1} more)"]
    message = f"{what} defined through each other: {' → '.join([*path, cycle[first]])}"
    return CycleError(message, places[cycle[first]], "expected one of them to have a value of its own")


def parameter_values(parameters: Mapping[str, Quantity]) -> dict[str, float]:
    """Return the value of every parameter in SI units, by name. Raises CycleError."""
    trees = {name: quantity.value for name, quantity in parameters.items()}
    values: dict[str, float] = {}
    for name in dependency_order(trees, {name: quantity.where for name, quantity in parameters.items()}):
        values[name] = float(evaluate(trees[name], values.__getitem__))
    return values

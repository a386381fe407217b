"""Backward data-flow analysis of a generated function: from marked lines to all lines on which they depend."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import sympy as sp

from gudgeon.generator.ir.branches import Branch
from gudgeon.generator.ir.readable import Readable
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.symbols.storage import Key, StorageLocation, find_value_key
from gudgeon.generator.symbols.switches import Select

Criteria = frozenset[str]
NO_CRITERIA: Criteria = frozenset()


@dataclass(frozen=True)
class SliceMembership:
    """The slicing criteria of each line of a function, by what it stores to, and of the parameters that it reads."""

    by_target: Mapping[Key, Criteria]
    by_parameter: Mapping[StorageLocation, Criteria]


def compute_backward_slices(
    function: Readable, find_criteria: Callable[[Statement | Branch], Criteria]
) -> SliceMembership:
    """Return the slicing criteria whose backward slices contain each line and each parameter of a function.

    A criterion is a text, such as the name of a result. A line is in the slices of its own criteria,
    `find_criteria(line)`, and in those of all later lines that depend on it. The result maps the target of each line,
    and the storage location of each parameter that is read, to a set of criteria; entries without criteria are left
    out.
    """
    criteria_by_name: defaultdict[Key, set[str]] = defaultdict(set)
    criteria_of_stored: defaultdict[Key, set[str]] = defaultdict(set)
    name_of_place: dict[Key, Key] = {
        place: name for name, place in function.names.items() if isinstance(place, StorageLocation)
    }
    for section in reversed(function.sections):
        for line in reversed(section.statements):
            if not isinstance(line, (Statement, Branch)):
                continue
            name = line.declared_local or name_of_place.get(line.target, line.target)
            line_criteria = criteria_by_name[name] | find_criteria(line)
            criteria_of_stored[line.target] |= line_criteria
            for key in _find_used_variables(line, function):
                criteria_by_name[key] |= line_criteria
    criteria_of_parameters: defaultdict[StorageLocation, set[str]] = defaultdict(set)
    for name, line_criteria in criteria_by_name.items():
        place = function.names.get(name, name)
        if isinstance(place, StorageLocation) and place.is_parameter:
            criteria_of_parameters[place] |= line_criteria
    return SliceMembership(_freeze_sets(criteria_of_stored), _freeze_sets(criteria_of_parameters))


def _find_used_variables(line: Statement | Branch, function: Readable) -> set[Key]:
    """Return the variables that a line uses: names of symbols, storage locations, names of conditional values.

    A conditional value is one that a `Branch` line computes. The target of the line itself is not included.
    """
    keys = {find_value_key(symbol) for expression in line.expressions for symbol in expression.free_symbols} | set(
        line.reads
    )
    if isinstance(line, Statement) and isinstance(line.value, StorageLocation):
        keys.add(line.value)
    for expression in line.expressions:
        if function.branches and expression.has(Select):
            keys |= {
                function.branches[selection] for selection in expression.atoms(Select) if selection in function.branches
            }
    return keys - {line.target}


def _freeze_sets(criteria_by_key: Mapping[Any, set[str]]) -> dict[Any, Criteria]:
    """Return the non-empty entries of a mapping with their sets of marks as frozen sets."""
    return {key: frozenset(marks) for key, marks in criteria_by_key.items() if marks}


def find_symbol_names(expression: sp.Expr) -> set[str]:
    """Return the set of names of the free symbols of an expression."""
    return {symbol.name for symbol in expression.free_symbols}

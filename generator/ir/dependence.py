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
from gudgeon.generator.symbols.storage import Key, Place, find_value_key
from gudgeon.generator.symbols.switches import Select

Marks = frozenset[str]
NO_MARKS: Marks = frozenset()


@dataclass(frozen=True)
class LineMarks:
    """Marks of each line of a function by what it stores to, and of the parameters that it reads."""

    by_target: Mapping[Key, Marks]
    by_parameter: Mapping[Place, Marks]


def propagate_marks(function: Readable, find_marks: Callable[[Statement | Branch], Marks]) -> LineMarks:
    """Return the marks of all statements and parameters of a function, propagated backwards along the data dependence.

    The lines with one mark are a backward slice of the function. A mark is a text, such as the name of a result. A line
    has its own marks, `find_marks(line)`, and those of all later lines that depend on it. The result has two maps:
    marks by the target of each line, and marks by the storage location of each parameter that is read. Entries without
    marks are left out.
    """
    marks_by_name: defaultdict[Key, set[str]] = defaultdict(set)
    marks_of_stored: defaultdict[Key, set[str]] = defaultdict(set)
    name_of_place: dict[Key, Key] = {place: name for name, place in function.names.items() if isinstance(place, Place)}
    for section in reversed(function.sections):
        for line in reversed(section.statements):
            if not isinstance(line, (Statement, Branch)):
                continue
            name = line.declared_local or name_of_place.get(line.target, line.target)
            line_marks = marks_by_name[name] | find_marks(line)
            marks_of_stored[line.target] |= line_marks
            for key in _find_used_variables(line, function):
                marks_by_name[key] |= line_marks
    marks_of_parameters: defaultdict[Place, set[str]] = defaultdict(set)
    for name, line_marks in marks_by_name.items():
        place = function.names.get(name, name)
        if isinstance(place, Place) and place.is_parameter:
            marks_of_parameters[place] |= line_marks
    return LineMarks(_freeze_sets(marks_of_stored), _freeze_sets(marks_of_parameters))


def _find_used_variables(line: Statement | Branch, function: Readable) -> set[Key]:
    """Return the variables that a line uses: names of symbols, storage locations, names of conditional values.

    A conditional value is one that a `Branch` line computes. The target of the line itself is not included.
    """
    keys = {find_value_key(symbol) for expression in line.expressions for symbol in expression.free_symbols} | set(
        line.reads
    )
    if isinstance(line, Statement) and isinstance(line.value, Place):
        keys.add(line.value)
    for expression in line.expressions:
        if function.branches and expression.has(Select):
            keys |= {
                function.branches[selection] for selection in expression.atoms(Select) if selection in function.branches
            }
    return keys - {line.target}


def _freeze_sets(marks_by_key: Mapping[Any, set[str]]) -> dict[Any, Marks]:
    """Return the non-empty entries of a mapping with their sets of marks as frozen sets."""
    return {key: frozenset(marks) for key, marks in marks_by_key.items() if marks}


def find_symbol_names(expression: sp.Expr) -> set[str]:
    """Return the set of names of the free symbols of an expression."""
    return {symbol.name for symbol in expression.free_symbols}

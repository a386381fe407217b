"""Data dependence within a function: marks of some lines, passed to all lines that these depend on."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import sympy as sp

from gudgeon.generator.ir.branches import Branch
from gudgeon.generator.ir.readable import Readable
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.symbols.storage import Key, Place, key_of
from gudgeon.generator.symbols.switches import Pick

Marks = frozenset[str]
NO_MARKS: Marks = frozenset()


@dataclass(frozen=True)
class Slices:
    """Marks of each line of a function by what it stores to, and of the parameters that it reads."""

    stored: Mapping[Key, Marks]
    numbers: Mapping[Place, Marks]


def slices(own: Readable, marks: Callable[[Statement | Branch], Marks]) -> Slices:
    """Return the marks of all lines; those of a line are passed to every line, and parameter, on which it depends.

    `marks` gives the marks of a line by itself.
    """
    needed: defaultdict[Key, set[str]] = defaultdict(set)
    stored: defaultdict[Key, set[str]] = defaultdict(set)
    called: dict[Key, Key] = {place: name for name, place in own.names.items() if isinstance(place, Place)}
    for section in reversed(own.sections):
        for line in reversed(section.statements):
            if not isinstance(line, (Statement, Branch)):
                continue
            name = line.defines or called.get(line.target, line.target)
            found = needed[name] | marks(line)
            stored[line.target] |= found
            for used in _reads(line, own):
                needed[used] |= found
    numbers: defaultdict[Place, set[str]] = defaultdict(set)
    for name, found in needed.items():
        place = own.names.get(name, name)
        if isinstance(place, Place) and place.is_parameter:
            numbers[place] |= found
    return Slices(_frozen(stored), _frozen(numbers))


def _reads(line: Statement | Branch, own: Readable) -> set[Key]:
    """Return what a line reads: names of symbols, places, names of branches that have a line of their own."""
    found = {key_of(symbol) for x in line.expressions for symbol in x.free_symbols} | set(line.reads)
    if isinstance(line, Statement) and isinstance(line.value, Place):
        found.add(line.value)
    for expression in line.expressions:
        if own.branches and expression.has(Pick):
            found |= {own.branches[part] for part in expression.atoms(Pick) if part in own.branches}
    return found - {line.target}


def _frozen(found: Mapping[Any, set[str]]) -> dict[Any, Marks]:
    """Return the entries with marks, as frozen sets."""
    return {name: frozenset(marks) for name, marks in found.items() if marks}


def free_names(expression: sp.Expr) -> set[str]:
    """Return the names of an expression's symbols."""
    return {symbol.name for symbol in expression.free_symbols}

"""What of a function hangs on what: marks of some lines, carried to all lines that these need."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.ir.branches import Branch
from gudgeon.generator.ir.readable import NUMBERS, Readable
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.ir.values import Place
from gudgeon.generator.symbols.corners import Pick

Marks = frozenset[str]
NO_MARKS: Marks = frozenset()


@dataclass(frozen=True)
class Slices:
    """Marks of each line of a function by what it stores to, and of the numbers `p->…` that it reads."""

    stored: Mapping[str, Marks]
    numbers: Mapping[str, Marks]


def slices(own: Readable, marks: Callable[[Statement | Branch], Marks]) -> Slices:
    """`marks` of a line go to every line that computes what it reads, and so on, up to the numbers of the run."""
    needed: defaultdict[str, set[str]] = defaultdict(set)
    stored: defaultdict[str, set[str]] = defaultdict(set)
    called = {text: name for name, text in own.names.items() if text.startswith(NUMBERS)}
    for section in reversed(own.sections):
        for line in reversed(section.statements):
            if not isinstance(line, (Statement, Branch)):
                continue
            name = line.defines or called.get(line.target, line.target)
            found = needed[name] | marks(line)
            stored[line.target] |= found
            for used in _reads(line, own):
                needed[used] |= found
    numbers: defaultdict[str, set[str]] = defaultdict(set)
    for name, found in needed.items():
        if (text := own.names.get(name, name)).startswith(NUMBERS):
            numbers[text] |= found
    return Slices(_frozen(stored), _frozen(numbers))


def _reads(line: Statement | Branch, own: Readable) -> set[str]:
    """Names of symbols, of numbers in full, of branches that have a line of their own."""
    found = {symbol.name for x in line.expressions for symbol in x.free_symbols} | set(line.reads)
    if isinstance(line, Statement) and isinstance(line.value, Place):
        found.add(line.value.text)
    for expression in line.expressions:
        if own.branches and expression.has(Pick):
            found |= {own.branches[part] for part in expression.atoms(Pick) if part in own.branches}
    return found - {line.target}


def _frozen(found: Mapping[str, set[str]]) -> dict[str, Marks]:
    return {name: frozenset(marks) for name, marks in found.items() if marks}


def free_names(expression: sp.Expr) -> set[str]:
    """Names of an expression's symbols."""
    return {symbol.name for symbol in expression.free_symbols}

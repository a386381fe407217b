"""Splits sums of hundreds of terms, such as the energy of all bodies, into partial sums, each in its own statement.

Compile time grows faster than linearly with the length of one expression, and functions can only be outlined between
statements. The terms are added from left to right as before, so that the rounded sums are the same bit for bit.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import count

import sympy as sp

from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.statements import Instruction, Statement
from gudgeon.generator.ir.values import ContinuedSum, Value
from gudgeon.generator.symbols.derivatives import find_operation_classes
from gudgeon.generator.symbols.storage import make_real_symbol
from gudgeon.generator.targets.cached_printer import order_terms

_MAX_TERMS = 200  # terms of a sum that stays in one statement
_MIN_STATEMENT_TERMS = 12  # terms of each statement of a split sum; 12 to 13, since groups differ by at most one term


def split_long_sums(kernel: Kernel) -> Kernel:
    """Return a kernel in which each sum of more than _MAX_TERMS terms is computed by partial sums.

    Called before a kernel is split into parts. Sums with functions other than powers stay in one statement.
    """
    counter = count(1)
    sections = tuple(
        Section(section.title, tuple(new_line for line in section.statements for new_line in _split_sum(line, counter)))
        for section in kernel.sections
    )
    return replace(kernel, sections=sections)


def _split_sum(line: Instruction, counter: Iterator[int]) -> Iterator[Instruction]:
    """Yield the statements of the partial sums of a line that assigns a long sum, or else the line itself.

    A long sum has more than _MAX_TERMS terms, and no functions but powers. Each statement adds at least
    _MIN_STATEMENT_TERMS terms to the local `partial_sum_N` of the previous one; the last one assigns to the original
    target. `counter` yields the numbers N, from 1 in each kernel.
    """
    value = line.value if isinstance(line, Statement) else None
    is_long = isinstance(value, sp.Add) and len(value.args) > _MAX_TERMS
    if not (is_long and isinstance(line, Statement) and find_operation_classes(value) <= {sp.Pow}):
        yield line
        return
    terms = order_terms(value)
    n_groups = len(terms) // _MIN_STATEMENT_TERMS
    ends = [len(terms) * k // n_groups for k in range(n_groups + 1)]
    partial_sum: Value = sp.Add(*terms[: ends[1]])
    for start, end in zip(ends[1:], ends[2:], strict=False):
        name = f"partial_sum_{next(counter)}"
        yield Statement(name, partial_sum)
        partial_sum = ContinuedSum(make_real_symbol(name), sp.Add(*terms[start:end]))
    yield replace(line, value=partial_sum)

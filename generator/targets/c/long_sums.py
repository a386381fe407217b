"""Divides sums of hundreds of terms, such as the energy of all bodies, into statements that continue each other.

A compiler takes more than linear time for one long expression, and parts of a function can only be cut between
statements. The terms are added from left to right as before: the sums are the same, bit for bit.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import count

import sympy as sp

from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.ir.values import ContinuedSum, Value
from gudgeon.generator.symbols.derivatives import find_operation_classes
from gudgeon.generator.symbols.storage import make_real_symbol
from gudgeon.generator.targets.cached_printer import order_terms

_MAX_TERMS, _TERMS_OF_STATEMENT = 200, 12  # terms of an undivided sum; of each statement of a divided one


def divide_long_sums(kernel: Kernel) -> Kernel:
    """Return a function with each sum of more than _MAX_TERMS terms computed in several statements."""
    numbers = count(1)
    sections = tuple(
        Section(section.title, tuple(new_line for line in section.statements for new_line in _divide(line, numbers)))
        for section in kernel.sections
    )
    return replace(kernel, sections=sections)


def _divide(line: Line, numbers: Iterator[int]) -> Iterator[Line]:
    """Yield the statements that replace a line: itself, unless it assigns a long sum without branches.

    `numbers`: numbers for the names of partial sums.
    """
    value = line.value if isinstance(line, Statement) else None
    is_long = isinstance(value, sp.Add) and len(value.args) > _MAX_TERMS
    if not (is_long and isinstance(line, Statement) and find_operation_classes(value) <= {sp.Pow}):
        yield line
        return
    terms = order_terms(value)
    n_groups = len(terms) // _TERMS_OF_STATEMENT
    ends = [len(terms) * k // n_groups for k in range(n_groups + 1)]
    partial_sum: Value = sp.Add(*terms[: ends[1]])
    for start, end in zip(ends[1:], ends[2:], strict=False):
        name = f"partial_sum_{next(numbers)}"
        yield Statement(name, partial_sum)
        partial_sum = ContinuedSum(make_real_symbol(name), sp.Add(*terms[start:end]))
    yield replace(line, value=partial_sum)

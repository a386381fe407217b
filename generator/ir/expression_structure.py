"""Structure of an expression: a canonical form up to the renaming of its symbols (structural hash).

The structure is everything that determines the printed code of an expression except the names of its symbols.
"""

from __future__ import annotations

from collections.abc import Hashable
from functools import lru_cache
from itertools import count

import sympy as sp

from gudgeon.generator.symbols.derivatives import find_operation_classes
from gudgeon.generator.symbols.storage import Key, StoredSymbol, find_value_key
from gudgeon.generator.symbols.switches import ComparedMagnitude
from gudgeon.generator.symbols.unevaluated import Unevaluated, UnevaluatedQuotient

# Operations whose text depends on the text of their arguments only, not on its order as a string or on a table.
_PLAIN_OPERATIONS = frozenset({sp.Pow, sp.sin, sp.cos, ComparedMagnitude, Unevaluated, UnevaluatedQuotient})
_number_by_structure: dict[Hashable, int] = {}
_new_numbers = count()


@lru_cache(1_000_000)
def find_expression_structure(expression: sp.Basic) -> tuple[int, tuple[Key, ...]] | None:
    """Return (number that only expressions of equal structure share, keys of the symbols by their first occurrence).

    Expressions of equal structure have the same text but for the texts of their symbols: the structure contains the
    order of the symbols' names, by which terms and factors are ordered. None for operations whose text depends on more.
    Results are cached. Used to print, or to count the operations of, expressions of equal structure only once.
    """
    if not find_operation_classes(expression) <= _PLAIN_OPERATIONS:
        return None
    number_by_symbol: dict[sp.Basic, int] = {}
    structure = _describe_expression(expression, number_by_symbol)
    symbols = tuple(number_by_symbol)
    if not all(type(symbol) in (sp.Symbol, StoredSymbol) for symbol in symbols):
        return None
    order = tuple(sorted(range(len(symbols)), key=lambda k: symbols[k].name))
    number = _number_by_structure.setdefault((structure, order), next(_new_numbers))
    return number, tuple(map(find_value_key, symbols))


def _describe_expression(expression: sp.Basic, number_by_symbol: dict[sp.Basic, int]) -> Hashable:
    """Return an expression as nested tuples, with the number of each symbol; symbols are numbered as they are met."""
    if expression.is_Symbol:
        return number_by_symbol.setdefault(expression, len(number_by_symbol))
    if not expression.args:
        return type(expression), expression
    return type(expression), *[_describe_expression(operand, number_by_symbol) for operand in expression.args]

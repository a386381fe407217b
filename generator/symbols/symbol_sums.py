"""Sums of products of symbols, equal to SymPy's but computed several times faster.

SymPy's operators expand, collect and compare expressions of any kind. The elimination of a linear system forms sums of
products of different symbols, a million times for a long chain. Such sums are built here in SymPy's canonical order.
All others are left to SymPy.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from typing import TypeAlias

import sympy as sp
from sympy.core.basic import ordering_of_classes

from gudgeon.generator.symbols.storage import StoredSymbol

_ZERO, _ONE, _MINUS_ONE = sp.S.Zero, sp.S.One, sp.S.NegativeOne
_ASSUMPTIONS = sp.Symbol("x", real=True).assumptions0
_RANK_OF_CLASS = {
    sp.Symbol: ordering_of_classes.index("Symbol"),
    StoredSymbol: len(ordering_of_classes) + 1,
}
_MUL_RANK, _MINUS_ONE_KEY = ordering_of_classes.index("Mul"), (ordering_of_classes.index("NegativeOne"), "")
_SymbolKey: TypeAlias = tuple[int, str]  # position of a symbol in SymPy's order of arguments: rank of its class, name
_Monomial: TypeAlias = tuple[bool, tuple[_SymbolKey, ...], tuple[sp.Symbol, ...]]  # is negative, keys, symbols


def add_products(start: sp.Expr, factors: Iterable[tuple[sp.Expr, sp.Expr]]) -> sp.Expr:
    """Return start + Σ a b over pairs (a, b) of factors, in SymPy's canonical form."""
    return _add_or_subtract_products(start, factors, False)


def subtract_products(start: sp.Expr, factors: Iterable[tuple[sp.Expr, sp.Expr]]) -> sp.Expr:
    """Return start − Σ a b over pairs (a, b) of factors, in SymPy's canonical form."""
    return _add_or_subtract_products(start, factors, True)


def _add_or_subtract_products(
    start: sp.Expr, factors: Iterable[tuple[sp.Expr, sp.Expr]], is_subtracted: bool
) -> sp.Expr:
    """Return start − Σ a b over pairs (a, b) of factors if `is_subtracted`, else start + Σ a b.

    The fast method needs sums of products of different symbols without like terms; otherwise SymPy's operators are
    used.
    """
    pairs = list(factors)
    if not pairs:
        return start
    monomials = list(_split_sum(start)) if start is not _ZERO else []
    is_plain = start is _ZERO or bool(monomials)
    for a, b in pairs if is_plain else ():
        if a is _ZERO or b is _ZERO:
            continue
        if (product := _multiply_monomials(a, b, is_subtracted)) is None:
            is_plain = False
            break
        monomials.append(product)
    if is_plain and len({keys for _, keys, _ in monomials}) == len(monomials):
        return _make_sum(monomials)
    total = sp.Add(*(a * b for a, b in pairs))
    return start - total if is_subtracted else start + total


def is_signed_symbol(value: sp.Basic) -> bool:
    """Return whether a value is a symbol or the negative of a symbol."""
    if value.is_Symbol:
        return True
    return bool(value.is_Mul and len(value.args) == 2 and value.args[0] is _MINUS_ONE and value.args[1].is_Symbol)


@lru_cache(1_000_000)
def _split_sum(expression: sp.Expr) -> tuple[_Monomial, ...]:
    """Return the terms of a sum of products of symbols, from a cache; () for any other expression."""
    terms = expression.args if expression.is_Add else (expression,)
    monomials = tuple(monomial for term in terms if (monomial := _split_product(term)) is not None)
    return monomials if len(monomials) == len(terms) else ()


@lru_cache(1_000_000)
def _split_product(expression: sp.Expr) -> _Monomial | None:
    """Return ± a product of different real symbols as a monomial, from a cache; None for any other expression."""
    factors, is_negative = (expression,), False
    if expression is _ONE or expression is _MINUS_ONE:
        return expression is _MINUS_ONE, (), ()
    if expression.is_Mul:
        is_negative = expression.args[0] is _MINUS_ONE
        factors = expression.args[1:] if is_negative else expression.args
    keys = tuple(key for factor in factors if (key := _find_key(factor)) is not None)
    return (is_negative, keys, factors) if len(keys) == len(factors) else None


@lru_cache(1_000_000)
def _find_key(expression: sp.Expr) -> _SymbolKey | None:
    """Return the position of a real symbol in SymPy's order, from a cache; None for any other expression."""
    rank = _RANK_OF_CLASS.get(type(expression))
    return (rank, expression.name) if rank is not None and expression.assumptions0 == _ASSUMPTIONS else None


def _multiply_monomials(a: sp.Expr, b: sp.Expr, is_negative: bool) -> _Monomial | None:
    """Return ± a b as (is_negative, keys, symbols), negated if `is_negative`.

    None unless it is ± a product of one or more different symbols, without a number other than ±1.
    """
    first, second = _split_product(a), _split_product(b)
    if first is None or second is None:
        return None
    sign = is_negative ^ first[0] ^ second[0]
    pairs = sorted(zip((*first[1], *second[1]), (*first[2], *second[2]), strict=True), key=_get_pair_key)
    keys = tuple(key for key, _ in pairs)
    return (sign, keys, tuple(symbol for _, symbol in pairs)) if keys and len(set(keys)) == len(keys) else None


def _get_pair_key(pair: tuple[_SymbolKey, sp.Symbol]) -> _SymbolKey:
    """Return the key of a pair of a key and its symbol."""
    return pair[0]


def _make_sum(monomials: Iterable[_Monomial]) -> sp.Expr:
    """Return the sum of different monomials with its terms in SymPy's order."""
    terms = sorted(map(_make_ordered_term, monomials), key=_get_term_key)
    return sp.Add._from_args([term for _, term in terms], True)


_TermKey: TypeAlias = tuple[int, int, tuple[_SymbolKey, ...]]  # rank of the class, number of arguments, their keys


def _make_ordered_term(monomial: _Monomial) -> tuple[_TermKey, sp.Expr]:
    """Return a monomial as an expression, and its position in SymPy's order of terms."""
    is_negative, keys, symbols = monomial
    if not is_negative and len(symbols) == 1:
        return (keys[0][0], 0, keys), symbols[0]
    if is_negative:
        keys, symbols = (_MINUS_ONE_KEY, *keys), (_MINUS_ONE, *symbols)
    return (_MUL_RANK, len(keys), keys), sp.Mul._from_args(symbols, True)


def _get_term_key(ordered_term: tuple[_TermKey, sp.Expr]) -> _TermKey:
    """Return the key of a pair of a key and its term."""
    return ordered_term[0]

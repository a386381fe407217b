"""Free symbols, classes of operations and derivatives of expressions, faster than by SymPy's general functions."""

from __future__ import annotations

from functools import lru_cache

import sympy as sp

_ZERO, _ONE = sp.S.Zero, sp.S.One
_CHAIN_RULE = sp.Function._eval_derivative


@lru_cache(1_000_000)
def find_symbols(expression: sp.Basic) -> frozenset[sp.Symbol]:
    """Return the free symbols of an expression; results of sums and products are combined from cached ones."""
    if expression.is_Symbol:
        return frozenset((expression,))
    if expression.is_Add or expression.is_Mul:
        return frozenset[sp.Symbol]().union(*map(find_symbols, expression.args))
    return frozenset(expression.free_symbols)


@lru_cache(1_000_000)
def find_operation_classes(expression: sp.Basic) -> frozenset[type[sp.Basic]]:
    """Return the classes of the operations in an expression other than sums and products, from a cache.

    They are the classes of its functions, and Pow if it contains a power.
    """
    if expression.is_Atom:
        return frozenset()
    classes = frozenset[type[sp.Basic]]().union(*map(find_operation_classes, expression.args))
    return classes if expression.is_Add or expression.is_Mul else classes | {type(expression)}


@lru_cache(500_000)
def differentiate(expression: sp.Expr, symbol: sp.Symbol) -> sp.Expr:
    """Return the derivative of an expression by `symbol`, as `sympy.diff` does but faster; results are cached.

    Sums are differentiated term by term, products factor by factor, powers with constant exponents and functions of
    one argument by the chain rule. SymPy differentiates all others.
    """
    if expression == symbol:
        return _ONE
    if symbol not in find_symbols(expression):
        return _ZERO
    arguments = expression.args
    if expression.is_Add:
        return sp.Add(*(differentiate(term, symbol) for term in arguments))
    if expression.is_Mul:
        rates = ((k, differentiate(factor, symbol)) for k, factor in enumerate(arguments))
        return sp.Add(*(sp.Mul(*arguments[:k], rate, *arguments[k + 1 :]) for k, rate in rates if rate is not _ZERO))
    if expression.is_Pow and expression.exp.is_number:
        return expression * (differentiate(expression.base, symbol) * expression.exp / expression.base)
    if len(arguments) == 1 and getattr(type(expression), "_eval_derivative", None) is _CHAIN_RULE:
        return expression.fdiff() * differentiate(arguments[0], symbol)
    return sp.diff(expression, symbol)

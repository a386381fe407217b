"""Symbols and derivatives of expressions, faster than SymPy's general functions."""

from __future__ import annotations

from functools import lru_cache

import sympy as sp

_ZERO, _ONE = sp.S.Zero, sp.S.One
_BY_ITS_ARGUMENTS = sp.Function._eval_derivative


@lru_cache(100_000)
def symbols_of(expression: sp.Basic) -> frozenset[sp.Symbol]:
    """Return the free symbols of an expression."""
    if expression.is_Add or expression.is_Mul:
        return frozenset[sp.Symbol]().union(*map(symbols_of, expression.args))
    return frozenset(expression.free_symbols)


@lru_cache(50_000)
def derivative(expression: sp.Expr, by: sp.Symbol) -> sp.Expr:
    """Return the derivative as `sympy.diff` does, sums term by term and products factor by factor.

    SymPy asks of every factor of every product whether it is differentiated by several variables, and how often.
    """
    if expression == by:
        return _ONE
    if by not in symbols_of(expression):
        return _ZERO
    args = expression.args
    if expression.is_Add:
        return sp.Add(*(derivative(term, by) for term in args))
    if expression.is_Mul:
        rates = ((k, derivative(factor, by)) for k, factor in enumerate(args))
        return sp.Add(*(sp.Mul(*args[:k], rate, *args[k + 1 :]) for k, rate in rates if rate is not _ZERO))
    if expression.is_Pow and expression.exp.is_number:
        return expression * (derivative(expression.base, by) * expression.exp / expression.base)
    if len(args) == 1 and getattr(type(expression), "_eval_derivative", None) is _BY_ITS_ARGUMENTS:
        return expression.fdiff() * derivative(args[0], by)
    return sp.diff(expression, by)

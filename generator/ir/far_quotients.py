"""Derivatives of u/v where v is a number of C and v² is none: (1/v)′ is −(1/v)(v′/v), the quotient kept together.

As −v′/v² it would be 0, a number, in silence. Which denominators are like that, their form says; parameters do not.
"""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.ir.finite_slopes import Slope, without_slopes
from gudgeon.generator.symbols.derivatives import derivative, symbols_of
from gudgeon.generator.symbols.from_expressions import derivative_at
from gudgeon.generator.symbols.functions import CLASSES, classes_where
from gudgeon.generator.symbols.wholes import Share

_GROWING = classes_where(lambda f: f.is_exponential)
_SQUARING = classes_where(lambda f: f.squares_argument)  # whose derivatives square a product factor by factor
_HIGH = 8  # a power of which the square overflows for no number of a mechanism
_FAR = 100  # decades from 1 beyond which a number's square, with what it is a factor of, may be none


def far_terms(expression: sp.Expr, by: sp.Symbol) -> list[sp.Expr]:
    """The outermost terms that are differentiated in this way, or hold such derivatives."""
    if by not in symbols_of(expression):
        return []
    if isinstance(expression, (Share, Slope)) or _is_squared(expression):
        return [expression]
    return [term for argument in expression.args for term in far_terms(argument, by)]


def written(expression: sp.Expr, by: sp.Symbol) -> sp.Expr:
    """∂/∂by of smooth pieces as their forms say it."""
    if isinstance(expression, Slope):
        return written(expression.args[0], by)
    if isinstance(expression, Share):
        return Share(written(expression.args[0], by))
    terms = {term: sp.Dummy(real=True) for term in far_terms(expression, by)}
    if not terms:
        return _plain(expression, by)
    if expression in terms and expression.is_Pow:
        return expression.exp * expression * Share(written(expression.base, by) / expression.base)
    if expression in terms:
        (argument,), inner = expression.args, sp.Dummy(real=True)
        if far := _far_derivative(expression):
            outer = derivative_at(far, inner, expression)
        else:
            outer = derivative(expression.func(inner), inner)
        outer = outer.xreplace({inner: Share(argument)})
        return outer * written(argument, by)
    named, back = expression.xreplace(terms), {dummy: term for term, dummy in terms.items()}
    inner = (derivative(named, dummy) * written(term, by) for term, dummy in terms.items())
    return sp.Add(_plain(named, by), *inner).xreplace(back)


def for_readers(expression: sp.Expr) -> sp.Expr:
    """The expression without what keeps its numbers finite."""
    shown = without_slopes(expression)
    return shown.replace(Share, lambda x: x) if shown.has(Share) else shown


def _plain(expression: sp.Expr, by: sp.Symbol) -> sp.Expr:
    """∂/∂by as SymPy writes it."""
    rate = derivative(expression, by)
    if any(power.exp.free_symbols and power.base.has(by) for power in expression.atoms(sp.Pow)):
        rate = sp.powsimp(rate, combine="exp")
    return rate


def _is_squared(power: sp.Expr) -> bool:
    """Whether it is v^-n, n a number, and v² may be no number of C; or atan(v), and so may a factor of v squared."""
    if isinstance(power, _SQUARING):
        squares = power.args[0].is_Mul or bool(_far_derivative(power))
        return squares and any(map(_is_far, sp.preorder_traversal(power.args[0])))
    if not (power.is_Pow and power.exp.is_number and power.exp.is_extended_negative):
        return False
    return any(map(_is_far, sp.preorder_traversal(power.base)))


def _far_derivative(term: sp.Expr) -> str:
    """Return the derivative that does not square the argument, as the table of functions writes it; "": none."""
    return CLASSES[type(term)].far_derivative if type(term) in CLASSES else ""


def _is_far(part: sp.Basic) -> bool:
    if part.is_Number:
        return bool(part.is_finite and abs(part) >= sp.Float(f"1e{_FAR}"))
    if part.is_Mul and part.args[0].is_Number:  # a small term alone keeps a sum from 0
        return bool(0 < abs(part.args[0]) <= sp.Float(f"1e-{_FAR}"))
    return isinstance(part, _GROWING) or bool(part.is_Pow and (not part.exp.is_number or abs(part.exp) > _HIGH))

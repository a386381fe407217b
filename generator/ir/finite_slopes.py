"""Slopes of terms that stay finite while what they are made of overflows: 1/(1 + e^u), 1/cosh u, atan(e^u), e^(-1/x).

Such a term is saturated where its derivative as written is ∞/∞ or 0 · ∞, so that its rise over a short way tells the
slope: most often exactly 0. Which terms are like that, their form says; all others are differentiated alone.
"""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.symbols.corners import Largest, Pick, Smallest
from gudgeon.generator.symbols.derivatives import derivative
from gudgeon.generator.symbols.functions import classes_where

_SATURATING = classes_where(lambda f: f.saturates)
_GROWING = classes_where(lambda f: f.is_exponential or f.has_pole)
_ZERO = (sp.Integer(0), sp.Integer(0), sp.Integer(1))  # a rise, and a way
_HIGH = 8  # a whole power that overflows for no number of a mechanism


class Slope(sp.Function):
    """Slope(d, ahead, behind, way): the derivative d where it is finite, else (ahead − behind)/way."""

    nargs = 4
    is_real = True

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """Where d is finite."""
        return derivative(self.args[0], s)


class Upon(sp.Function):
    """The sign of x as a factor that has no derivative."""

    nargs = 1

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        return sp.Integer(0)


_CORNERS = (sp.Abs, sp.Max, sp.Min, sp.sign, sp.Heaviside, Upon, Pick, Largest, Smallest)


class JustAhead(sp.Function):
    """A number a little above its argument."""

    nargs = 1
    is_real = True


class JustBehind(sp.Function):
    """A number a little below its argument."""

    nargs = 1
    is_real = True


def overflowing(expression: sp.Expr, by: sp.Symbol) -> list[sp.Expr]:
    """The outermost terms of an expression that may be finite where their derivative by a symbol is not."""
    if not any(map(_saturates, expression.atoms(sp.Pow, *_SATURATING))) or by not in expression.free_symbols:
        return []
    if isinstance(expression, Slope):
        return [expression]
    if _saturates(expression):
        within = (part for argument in expression.args for part in sp.preorder_traversal(argument))
        if any(_grows(part, by) for part in within):
            return [expression]
    return [term for argument in expression.args for term in overflowing(argument, by)]


def _saturates(term: sp.Expr) -> bool:
    """Whether it may be finite where what it is made of is not."""
    if term.is_Pow:
        return bool(term.exp.is_extended_negative or not term.exp.is_number)
    return isinstance(term, _SATURATING)


def _grows(part: sp.Basic, by: sp.Symbol) -> bool:
    """Whether a part may overflow."""
    if by not in part.free_symbols:
        return False
    return isinstance(part, _GROWING) or bool(
        part.is_Pow and (not part.exp.is_number or part.exp < 0 or part.exp > _HIGH)
    )


def finite_slope(term: sp.Expr, by: sp.Symbol, derivative: sp.Expr) -> Slope:
    """∂ term/∂ by, as the derivative has it where that is a number.

    Elsewhere 0 of a term with corners, which are at their own places only, and of the slope of a slope's slope.
    """
    if term.has(*_CORNERS) or isinstance(term, Slope) and any(x.has(Slope) for x in term.args[1:3]):
        return Slope(derivative, *_ZERO)
    ahead, behind = JustAhead(by), JustBehind(by)
    return Slope(derivative, term.xreplace({by: ahead}), term.xreplace({by: behind}), ahead - behind)


def has_distance(expression: sp.Expr, by: sp.Symbol) -> bool:
    """Whether a root of a sum of squares is in it, a distance or speed: at 0 its slope is 0/0, of products mostly 0."""
    return any(
        power.exp.is_number and power.exp > 0 and not power.exp.is_integer and power.base.is_Add
        and by in power.base.free_symbols and all(map(_is_square, power.base.args))
        for power in expression.atoms(sp.Pow)
    )  # fmt: skip


def _is_square(term: sp.Expr) -> bool:
    number, rest = term.as_coeff_Mul()
    return bool(number > 0 and all(factor.is_Pow and factor.exp.is_even for factor in sp.Mul.make_args(rest)))


def flat_at_zero(derivative: sp.Expr) -> Slope:
    """The derivative, and 0 where it is no number."""
    return Slope(derivative, *_ZERO)


def as_written(expression: sp.Expr) -> sp.Expr:
    """The same, and branches by the step function: for ranges, in which 0 · ∞ is 0."""
    expression = without_slopes(expression)
    return expression.replace(Pick, _stepped) if expression.has(Pick) else expression


def without_slopes(expression: sp.Expr) -> sp.Expr:
    """The expression with its slopes as their derivatives are written."""
    return expression.replace(Slope, lambda derivative, *_: derivative) if expression.has(Slope) else expression


def _stepped(side: sp.Expr, a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """A branch picked by a sign, by the step function; by a held side as it is."""
    if not side.has(sp.sign):
        return Pick(side, a, b)
    return b + sp.Heaviside(side.replace(sp.sign, lambda x: x)) * (a - b)

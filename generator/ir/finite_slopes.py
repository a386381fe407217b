"""Slopes of terms that stay finite while what they are made of, or its square, overflows.

A term such as 1/(1 + e^u), 1/cosh u, atan(e^u) or e^(-1/x) is saturated where its derivative as written is ∞/∞ or 0 ·
∞, so that its rise over a short way tells the slope: most often exactly 0. Which terms are like that, their form says;
all others are differentiated alone.

Where v is a number of C and v² is none, the derivative of 1/v is −(1/v)(v′/v), the quotient kept together. As −v′/v² it
would be 0, a number, in silence. Which denominators are like that, their form says; parameters do not.
"""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.symbols.corners import Largest, Pick, Smallest
from gudgeon.generator.symbols.derivatives import derivative, symbols_of
from gudgeon.generator.symbols.from_expressions import CLASSES, classes_where, derivative_at
from gudgeon.generator.symbols.wholes import Share

_SATURATING = classes_where(lambda f: f.saturates)
_GROWING = classes_where(lambda f: f.is_exponential or f.has_pole)
_ZERO = (sp.Integer(0), sp.Integer(0), sp.Integer(1))  # a rise, and a way
_HIGH = 8  # a power of which neither the value nor its square overflows for a number of a mechanism


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
        power.exp.is_number
        and power.exp > 0
        and not power.exp.is_integer
        and power.base.is_Add
        and by in power.base.free_symbols
        and all(map(_is_square, power.base.args))
        for power in expression.atoms(sp.Pow)
    )


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


_EXPONENTIAL = classes_where(lambda f: f.is_exponential)
_SQUARING = classes_where(lambda f: f.squares_argument)  # whose derivatives square a product factor by factor
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
    return isinstance(part, _EXPONENTIAL) or bool(part.is_Pow and (not part.exp.is_number or abs(part.exp) > _HIGH))

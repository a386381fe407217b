"""Derivatives that stay finite where the inner values of a term, or their squares, overflow.

A term such as 1/(1 + e^u), 1/cosh u, atan(e^u) or e^(-1/x) is saturated where its derivative as written is ∞/∞ or
0 · ∞. There a difference quotient over a short distance gives the derivative: most often exactly 0. The form of a term
shows whether it can saturate; all others are differentiated as usual.
If v is a finite number of C and v² is not, the derivative of 1/v is −(1/v)(v′/v), with the quotient kept together. As
−v′/v² it would silently be 0. The form of a denominator shows this case; values of parameters do not.
"""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.symbols.derivatives import derivative, symbols_of
from gudgeon.generator.symbols.from_expressions import CLASSES, classes_where, derivative_at
from gudgeon.generator.symbols.switches import Largest, Pick, Smallest
from gudgeon.generator.symbols.unevaluated import Share

_SATURATING = classes_where(lambda f: f.saturates)
_GROWING = classes_where(lambda f: f.is_exponential or f.has_pole)
_ZERO = (sp.Integer(0), sp.Integer(0), sp.Integer(1))  # a rise, and a way
_HIGH = 8  # a power of which neither the value nor its square overflows for a number of a mechanism


class Slope(sp.Function):
    """Slope(d, ahead, behind, distance): the derivative d if it is finite, else (ahead − behind)/distance."""

    nargs = 4
    is_real = True

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """Return the derivative of d, which holds where d is finite."""
        return derivative(self.args[0], s)


class Upon(sp.Function):
    """The sign of x as a factor that has no derivative."""

    nargs = 1

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return 0."""
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
    """Return the outermost terms of an expression that may be finite where their derivative `by` a symbol is not."""
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
    """Return whether a term may be finite where its inner values are not."""
    if term.is_Pow:
        return bool(term.exp.is_extended_negative or not term.exp.is_number)
    return isinstance(term, _SATURATING)


def _grows(part: sp.Basic, by: sp.Symbol) -> bool:
    """Return whether a part of an expression may overflow as a function of a symbol."""
    if by not in part.free_symbols:
        return False
    return isinstance(part, _GROWING) or bool(
        part.is_Pow and (not part.exp.is_number or part.exp < 0 or part.exp > _HIGH)
    )


def finite_slope(term: sp.Expr, by: sp.Symbol, derivative: sp.Expr) -> Slope:
    """Return ∂ term/∂ by as a Slope: the derivative as written where it is finite, else a difference quotient.

    It is 0 instead of the quotient for terms with switching points and for derivatives of derivatives.
    """
    if term.has(*_CORNERS) or isinstance(term, Slope) and any(x.has(Slope) for x in term.args[1:3]):
        return Slope(derivative, *_ZERO)
    ahead, behind = JustAhead(by), JustBehind(by)
    return Slope(derivative, term.xreplace({by: ahead}), term.xreplace({by: behind}), ahead - behind)


def has_distance(expression: sp.Expr, by: sp.Symbol) -> bool:
    """Return whether an expression contains a root of a sum of squares: at 0 its derivative is 0/0."""
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
    """Return whether a term is a positive number times even powers."""
    number, rest = term.as_coeff_Mul()
    return bool(number > 0 and all(factor.is_Pow and factor.exp.is_even for factor in sp.Mul.make_args(rest)))


def flat_at_zero(derivative: sp.Expr) -> Slope:
    """Return the derivative as a Slope that is 0 where the derivative is not finite."""
    return Slope(derivative, *_ZERO)


def as_written(expression: sp.Expr) -> sp.Expr:
    """Return the expression without Slopes and with branches as step functions, for ranges, in which 0 · ∞ is 0."""
    expression = without_slopes(expression)
    return expression.replace(Pick, _stepped) if expression.has(Pick) else expression


def without_slopes(expression: sp.Expr) -> sp.Expr:
    """Return the expression with Slopes replaced by the derivatives as written."""
    return expression.replace(Slope, lambda derivative, *_: derivative) if expression.has(Slope) else expression


def _stepped(side: sp.Expr, a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """Return a branch that a sign chooses as a step function; a held branch as it is."""
    if not side.has(sp.sign):
        return Pick(side, a, b)
    return b + sp.Heaviside(side.replace(sp.sign, lambda x: x)) * (a - b)


_EXPONENTIAL = classes_where(lambda f: f.is_exponential)
_SQUARING = classes_where(lambda f: f.squares_argument)  # whose derivatives square a product factor by factor
_FAR = 100  # decades from 1 beyond which the square of a number may overflow together with other factors


def far_terms(expression: sp.Expr, by: sp.Symbol) -> list[sp.Expr]:
    """Return the outermost terms whose derivative keeps quotients together, or that contain such derivatives."""
    if by not in symbols_of(expression):
        return []
    if isinstance(expression, (Share, Slope)) or _is_squared(expression):
        return [expression]
    return [term for argument in expression.args for term in far_terms(argument, by)]


def written(expression: sp.Expr, by: sp.Symbol) -> sp.Expr:
    """Return ∂/∂by of smooth pieces in the form that keeps quotients v′/v together."""
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
    """Return the expression as a document shows it, without the forms that keep its values finite."""
    shown = without_slopes(expression)
    return shown.replace(Share, lambda x: x) if shown.has(Share) else shown


def _plain(expression: sp.Expr, by: sp.Symbol) -> sp.Expr:
    """Return ∂/∂by in SymPy's form."""
    rate = derivative(expression, by)
    if any(power.exp.free_symbols and power.base.has(by) for power in expression.atoms(sp.Pow)):
        rate = sp.powsimp(rate, combine="exp")
    return rate


def _is_squared(power: sp.Expr) -> bool:
    """Return whether differentiation would square a value whose square may overflow.

    Such terms are v^-n with a number n, and atan(v).
    """
    if isinstance(power, _SQUARING):
        squares = power.args[0].is_Mul or bool(_far_derivative(power))
        return squares and any(map(_is_far, sp.preorder_traversal(power.args[0])))
    if not (power.is_Pow and power.exp.is_number and power.exp.is_extended_negative):
        return False
    return any(map(_is_far, sp.preorder_traversal(power.base)))


def _far_derivative(term: sp.Expr) -> str:
    """Return the derivative that does not square the argument, as in the table of functions; "" if none."""
    return CLASSES[type(term)].far_derivative if type(term) in CLASSES else ""


def _is_far(part: sp.Basic) -> bool:
    """Return whether a part is, or may become, so large or small that its square leaves the range of numbers."""
    if part.is_Number:
        return bool(part.is_finite and abs(part) >= sp.Float(f"1e{_FAR}"))
    if part.is_Mul and part.args[0].is_Number:  # a small term alone keeps a sum from 0
        return bool(0 < abs(part.args[0]) <= sp.Float(f"1e-{_FAR}"))
    return isinstance(part, _EXPONENTIAL) or bool(part.is_Pow and (not part.exp.is_number or abs(part.exp) > _HIGH))

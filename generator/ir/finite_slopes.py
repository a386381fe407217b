"""Derivatives of force terms that stay finite where inner values of a term, or their squares, overflow.

A term such as 1/(1 + e^u), 1/cosh u, atan(e^u) or e^(-1/x) is saturated where its derivative as written is ∞/∞ or
0 · ∞. There a difference quotient over a short distance gives the derivative: most often exactly 0. The form of a term
shows whether it can saturate; all others are differentiated as usual.
If v is a finite number of C and v² is not, the derivative of 1/v is −(1/v)(v′/v), with the quotient kept together. As
−v′/v² it would silently be 0. The form of a denominator shows this case; values of parameters do not.
"""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.symbols.derivatives import differentiate, find_operation_classes, find_symbols
from gudgeon.generator.symbols.from_expressions import CLASSES, convert_derivative, find_classes
from gudgeon.generator.symbols.switches import DifferentiableMax, DifferentiableMin, Select
from gudgeon.generator.symbols.unevaluated import UnevaluatedQuotient

_SATURATING_CLASSES = find_classes(lambda f: f.saturates)
_OVERFLOWING_CLASSES = find_classes(lambda f: f.is_exponential or f.has_pole)
_ZERO_QUOTIENT = (sp.Integer(0), sp.Integer(0), sp.Integer(1))  # f above, f below, distance
_MAX_SAFE_POWER = 8  # a power of which neither the value nor its square overflows for a number of a mechanism


class Slope(sp.Function):
    """Slope(d, f_above, f_below, distance): the derivative d if it is finite, else (f_above − f_below)/distance."""

    nargs = 4
    is_real = True

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """Return the derivative by `s` of the first argument d, also where the quotient replaces d. Called by SymPy."""
        return differentiate(self.args[0], s)


class FrozenSign(sp.Function):
    """Sign of x as a factor whose derivative is 0 everywhere, also at a change of sign."""

    nargs = 1

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return 0."""
        return sp.Integer(0)


_SWITCHING_CLASSES = (
    sp.Abs,
    sp.Max,
    sp.Min,
    sp.sign,
    sp.Heaviside,
    FrozenSign,
    Select,
    DifferentiableMax,
    DifferentiableMin,
)


class NextAbove(sp.Function):
    """A number a little above its argument."""

    nargs = 1
    is_real = True


class NextBelow(sp.Function):
    """A number a little below its argument."""

    nargs = 1
    is_real = True


def find_overflowing_terms(expression: sp.Expr, symbol: sp.Symbol) -> list[sp.Expr]:
    """Return the outermost terms of an expression that may be finite where their derivative by `symbol` overflows.

    These are powers with negative or variable exponent and saturating functions such as tanh, if an inner value may
    overflow as a function of the symbol. Terms that are a `Slope` already count too. Empty if the expression does not
    depend on the symbol or no term of it can saturate.
    """
    if (
        not any(map(_is_saturating, expression.atoms(sp.Pow, *_SATURATING_CLASSES)))
        or symbol not in expression.free_symbols
    ):
        return []
    if isinstance(expression, Slope):
        return [expression]
    if _is_saturating(expression):
        parts = (part for argument in expression.args for part in sp.preorder_traversal(argument))
        if any(_may_overflow(part, symbol) for part in parts):
            return [expression]
    return [term for argument in expression.args for term in find_overflowing_terms(argument, symbol)]


def _is_saturating(term: sp.Expr) -> bool:
    """Return whether the form of a term allows a finite value where inner values overflow.

    Such terms are powers with a negative or variable exponent, and functions that saturate, such as tanh.
    """
    if term.is_Pow:
        return bool(term.exp.is_extended_negative or not term.exp.is_number)
    return isinstance(term, _SATURATING_CLASSES)


def _may_overflow(part: sp.Basic, symbol: sp.Symbol) -> bool:
    """Return whether a part of an expression depends on `symbol` and may overflow.

    Such parts are exponentials, functions with poles, and powers with an exponent that is negative, variable or above
    `_MAX_SAFE_POWER`.
    """
    if symbol not in part.free_symbols:
        return False
    return isinstance(part, _OVERFLOWING_CLASSES) or bool(
        part.is_Pow and (not part.exp.is_number or part.exp < 0 or part.exp > _MAX_SAFE_POWER)
    )


def make_finite_slope(term: sp.Expr, symbol: sp.Symbol, derivative: sp.Expr) -> Slope:
    """Return ∂term/∂symbol as a `Slope`: `derivative` where that is finite, else a difference quotient of the term.

    The quotient is (f(x⁺) − f(x⁻))/(x⁺ − x⁻) with x⁺, x⁻ slightly above and below x. It is 0 for terms with switching
    points, and for a `Slope` whose quotient contains a `Slope`.
    """
    if term.has(*_SWITCHING_CLASSES) or isinstance(term, Slope) and any(x.has(Slope) for x in term.args[1:3]):
        return Slope(derivative, *_ZERO_QUOTIENT)
    above, below = NextAbove(symbol), NextBelow(symbol)
    return Slope(derivative, term.xreplace({symbol: above}), term.xreplace({symbol: below}), above - below)


def has_root_of_squares(expression: sp.Expr, symbol: sp.Symbol) -> bool:
    """Return whether an expression contains a power (sum of squares)**a with a > 0, not an integer, of `symbol`.

    An example is √(x² + 2 y²). Each term of the sum is a positive number times even powers, and one term depends on
    `symbol`. The derivative of such a root is 0/0 where the sum vanishes.
    """
    return any(
        power.exp.is_number
        and power.exp > 0
        and not power.exp.is_integer
        and power.base.is_Add
        and symbol in power.base.free_symbols
        and all(map(_is_square, power.base.args))
        for power in expression.atoms(sp.Pow)
    )


def _is_square(term: sp.Expr) -> bool:
    """Return whether a term is a positive number times even powers only."""
    number, rest = term.as_coeff_Mul()
    return bool(number > 0 and all(factor.is_Pow and factor.exp.is_even for factor in sp.Mul.make_args(rest)))


def make_slope_or_zero(derivative: sp.Expr) -> Slope:
    """Return the derivative as a Slope that is 0 where the derivative is not finite."""
    return Slope(derivative, *_ZERO_QUOTIENT)


def convert_to_heaviside_form(expression: sp.Expr) -> sp.Expr:
    """Return the expression without `Slope`, and with conditional values by a sign as Heaviside functions.

    In this form interval arithmetic sets 0 · ∞ to 0, and SymPy can print it. Each `Slope` becomes its derivative.
    Branches that are frozen over a step stay.
    """
    expression = remove_slopes(expression)
    return (
        expression.replace(Select, _replace_branch_by_heaviside)
        if Select in find_operation_classes(expression)
        else expression
    )


def remove_slopes(expression: sp.Expr) -> sp.Expr:
    """Return the expression with each `Slope` replaced by its derivative, without the test for overflow."""
    return (
        expression.replace(Slope, lambda derivative, *_: derivative)
        if Slope in find_operation_classes(expression)
        else expression
    )


def _replace_branch_by_heaviside(branch: sp.Expr, a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """Return the conditional value "a if x ≥ 0 else b" as b + H(x) (a − b), for `branch` = sign(x).

    For another `branch`, which is frozen over a step, return `Select(branch, a, b)` unchanged.
    """
    if not branch.has(sp.sign):
        return Select(branch, a, b)
    return b + sp.Heaviside(branch.replace(sp.sign, lambda x: x)) * (a - b)


_EXPONENTIAL_CLASSES = find_classes(lambda f: f.is_exponential)
_SQUARING_CLASSES = find_classes(lambda f: f.squares_argument)  # whose derivatives square a product factor by factor
_MAX_SAFE_DECADES = 100  # decades from 1 beyond which the square of a number may overflow together with other factors


def find_overflowing_squares(expression: sp.Expr, symbol: sp.Symbol) -> list[sp.Expr]:
    """Return the outermost terms of an expression whose derivative must keep quotients v′/v together.

    The usual derivative of such a term squares a value v whose square may overflow or underflow. Terms that are a
    `Slope` or an `UnevaluatedQuotient` count too. Empty if the expression does not depend on `symbol`.
    """
    if symbol not in find_symbols(expression):
        return []
    if isinstance(expression, (UnevaluatedQuotient, Slope)) or _may_overflow_when_squared(expression):
        return [expression]
    return [term for argument in expression.args for term in find_overflowing_squares(argument, symbol)]


def differentiate_with_quotients(expression: sp.Expr, symbol: sp.Symbol) -> sp.Expr:
    """Return ∂/∂symbol of a smooth expression in the form that keeps quotients v′/v together.

    A `Slope` is differentiated through its first argument, an `UnevaluatedQuotient` inside it. A power vⁿ whose square
    may overflow gives n vⁿ UnevaluatedQuotient(v′/v). A function f(v) whose derivative squares v gives f′(v) v′ with v
    as an `UnevaluatedQuotient`. An expression without such terms is differentiated by SymPy.
    """
    if isinstance(expression, Slope):
        return differentiate_with_quotients(expression.args[0], symbol)
    if isinstance(expression, UnevaluatedQuotient):
        return UnevaluatedQuotient(differentiate_with_quotients(expression.args[0], symbol))
    terms = {term: sp.Dummy(real=True) for term in find_overflowing_squares(expression, symbol)}
    if not terms:
        return _differentiate_by_sympy(expression, symbol)
    if expression in terms and expression.is_Pow:
        return (
            expression.exp
            * expression
            * UnevaluatedQuotient(differentiate_with_quotients(expression.base, symbol) / expression.base)
        )
    if expression in terms:
        (argument,), inner_terms = expression.args, sp.Dummy(real=True)
        if derivative_text := _find_unsquared_derivative(expression):
            outer_derivative = convert_derivative(derivative_text, inner_terms, expression)
        else:
            outer_derivative = differentiate(expression.func(inner_terms), inner_terms)
        outer_derivative = outer_derivative.xreplace({inner_terms: UnevaluatedQuotient(argument)})
        return outer_derivative * differentiate_with_quotients(argument, symbol)
    renamed, terms_by_dummy = expression.xreplace(terms), {dummy: term for term, dummy in terms.items()}
    inner_terms = (
        differentiate(renamed, dummy) * differentiate_with_quotients(term, symbol) for term, dummy in terms.items()
    )
    return sp.Add(_differentiate_by_sympy(renamed, symbol), *inner_terms).xreplace(terms_by_dummy)


def remove_numerical_forms(expression: sp.Expr) -> sp.Expr:
    """Return the expression as a document prints it, without `Slope` and `UnevaluatedQuotient`.

    These only keep its values finite.
    """
    expression_without_slopes = remove_slopes(expression)
    return (
        expression_without_slopes.replace(UnevaluatedQuotient, lambda x: x)
        if expression_without_slopes.has(UnevaluatedQuotient)
        else expression_without_slopes
    )


def _differentiate_by_sympy(expression: sp.Expr, symbol: sp.Symbol) -> sp.Expr:
    """Return ∂expression/∂symbol as SymPy computes it, with powers of variable exponents combined: x^n/x as x^(n−1)."""
    rate = differentiate(expression, symbol)
    if any(power.exp.free_symbols and power.base.has(symbol) for power in expression.atoms(sp.Pow)):
        rate = sp.powsimp(rate, combine="exp")
    return rate


def _may_overflow_when_squared(term: sp.Expr) -> bool:
    """Return whether differentiation of a term would square a value whose square may overflow or underflow.

    Such terms are v^-n with a number n, and atan(v) and similar functions, if v contains extreme parts
    (`_has_extreme_magnitude`).
    """
    if isinstance(term, _SQUARING_CLASSES):
        squares = term.args[0].is_Mul or bool(_find_unsquared_derivative(term))
        return squares and any(map(_has_extreme_magnitude, sp.preorder_traversal(term.args[0])))
    if not (term.is_Pow and term.exp.is_number and term.exp.is_extended_negative):
        return False
    return any(map(_has_extreme_magnitude, sp.preorder_traversal(term.base)))


def _find_unsquared_derivative(term: sp.Expr) -> str:
    """Return the text of a function's derivative in the form that does not square its argument, such as that of atan.

    `term`: a call of the function. Return "" if the table of functions has no such form.
    """
    return CLASSES[type(term)].far_derivative if type(term) in CLASSES else ""


def _has_extreme_magnitude(expression: sp.Basic) -> bool:
    """Return whether an expression may be so large or small that its square overflows or underflows.

    Such expressions are numbers of magnitude 10^_MAX_SAFE_DECADES or more, products with a factor up to its reciprocal,
    and exponentials. Powers count if the exponent is variable or its magnitude is above `_MAX_SAFE_POWER`.
    """
    if expression.is_Number:
        return bool(expression.is_finite and abs(expression) >= sp.Float(f"1e{_MAX_SAFE_DECADES}"))
    if expression.is_Mul and expression.args[0].is_Number:  # a small term alone keeps a sum from 0
        return bool(0 < abs(expression.args[0]) <= sp.Float(f"1e-{_MAX_SAFE_DECADES}"))
    return isinstance(expression, _EXPONENTIAL_CLASSES) or bool(
        expression.is_Pow and (not expression.exp.is_number or abs(expression.exp) > _MAX_SAFE_POWER)
    )

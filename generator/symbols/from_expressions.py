"""Conversion of expression trees of a mechanism file to SymPy, function by function (gudgeon.language.functions)."""

from __future__ import annotations

import operator as operator_of
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import sympy as sp

from gudgeon.errors import BadValueError, Location
from gudgeon.generator.mechanism import Quantity
from gudgeon.generator.symbols.curves import make_curve_expression
from gudgeon.generator.symbols.squares import DEGREE, convert_to_decimal, extract_squares
from gudgeon.generator.symbols.switches import ModOf, Select
from gudgeon.generator.symbols.unevaluated import apply_unexpanded
from gudgeon.language.functions import IN_SYMPY, Function
from gudgeon.language.parser import parse
from gudgeon.language.tree import Binary, Call, CurveCall, Expr, Name, Number, Unary

CLASSES: Mapping[Any, Function] = {getattr(sp, name): function for name, function in IN_SYMPY.items()}


def find_classes(predicate: Callable[[Function], bool]) -> tuple[Any, ...]:
    """Return SymPy's classes of the functions of a file's expressions whose table entry satisfies the predicate."""
    return tuple(class_ for class_, function in CLASSES.items() if predicate(function))


def make_smooth_step(t: sp.Expr, start: sp.Expr, duration: sp.Expr) -> sp.Expr:
    """Return the step that is 0 before `start`, 1 after `start + duration`, and 10s³ − 15s⁴ + 6s⁵ between them."""
    s = make_ramp(t, start, duration)
    return s**3 * (10 + s * (6 * s - 15))


def make_ramp(t: sp.Expr, start: sp.Expr, duration: sp.Expr) -> sp.Expr:
    """Return the ramp that is 0 before `start`, 1 after `start + duration`, and linear between them."""
    return sp.Max(0, sp.Min(1, (t - start) / duration))


def make_conditional(left: sp.Expr, right: sp.Expr, then: sp.Expr, otherwise: sp.Expr) -> sp.Expr:
    """Return the conditional expression: `then` where left < right, else `otherwise`; the function `where` of files.

    The result is a `Select` by the sign of left − right, or the common value if `then` and `otherwise` are equal.
    """
    return then if then == otherwise else Select(sp.sign(left - right), otherwise, then)


_HALF = sp.Rational(1, 2)
_MAX_BITS = 4096  # of a numerator or denominator that SymPy computes


def make_exponential(exponent: sp.Expr) -> sp.Expr:
    """Return e^x; floats in an exponent that is a sum become exact rational numbers.

    Otherwise SymPy would take e^5000.0 out of e^(5000.0 − u), and that overflows.
    """
    if not exponent.is_Add:
        return sp.exp(exponent)
    return sp.exp(sp.Add(*(_make_exact(x) for x in exponent.args)))


def _make_exact(expression: sp.Expr) -> sp.Expr:
    """Return a float as the rational number that it is exactly; other expressions unchanged."""
    return sp.Rational(expression) if expression.is_Float else expression


_BUILDERS: dict[str, Callable[..., sp.Expr]] = {
    **{function.name: kind for kind, function in CLASSES.items()},
    "exp": make_exponential,
    "smooth_step": make_smooth_step,
    "ramp": make_ramp,
    "where": make_conditional,
    "mod": ModOf,
}


def convert_to_sympy(expr: Expr, find_symbol: Callable[[str], sp.Expr]) -> sp.Expr:
    """Return a parsed expression `expr` of a file as a SymPy expression.

    `find_symbol(path)` returns the SymPy expression of a name. A number stays the binary64 value that the user wrote;
    one of integer value becomes an exact integer, so that SymPy combines it with others.
    """
    return _Converter(find_symbol).convert_node(expr)


def convert_derivative(derivative: str, x: sp.Expr, f: sp.Expr) -> sp.Expr:
    """Return the text of a derivative in the table of functions as a SymPy expression.

    `derivative`: the text, in x and f; `x`: the argument; `f`: the value of the function there.
    """
    return convert_to_sympy(parse(derivative, Location("functions.py", 1, 1)), {"x": x, "f": f}.__getitem__)


class _Converter:
    """Converter of one expression tree to SymPy, each part once."""

    def __init__(self, find_symbol: Callable[[str], sp.Expr]) -> None:
        """Begin with the resolver of names."""
        self._find_symbol = find_symbol
        self._expression_by_id: dict[int, sp.Expr] = {}  # by the part's id

    def convert_node(self, expr: Expr) -> sp.Expr:
        """Return the SymPy expression of a node of the tree, from a cache if it has been converted."""
        if id(expr) not in self._expression_by_id:
            self._expression_by_id[id(expr)] = self._convert_node_uncached(expr)
        return self._expression_by_id[id(expr)]

    def _convert_node_uncached(self, expr: Expr) -> sp.Expr:
        """Return the SymPy expression of one node of the tree, without reading the cache.

        Floats of integer value below 1e15 become integers; names become the results of the resolver. Operands are
        converted through the cache. Products and powers that SymPy would expand to extreme numbers stay unevaluated.
        """
        match expr:
            case Number(value=value):
                return sp.Integer(int(value)) if value == int(value) and abs(value) < 1e15 else sp.Float(value, 17)
            case Name(path=path):
                return self._find_symbol(path)
            case Unary(operand=operand):
                return -self.convert_node(operand)
            case Call(function="sqrt", arguments=(argument_,)):
                return apply_unexpanded(
                    lambda a: self._extract_squares_from_power(a, _HALF, argument_), self.convert_node(argument_)
                )
            case Call(function="hypot", arguments=sides):
                return apply_unexpanded(
                    lambda a, b: self._extract_squares_from_power(
                        _make_unexpanded_square(a) + _make_unexpanded_square(b), _HALF, *sides
                    ),
                    *map(self.convert_node, sides),
                )
            case CurveCall(arguments=(argument,), curve=curve):
                return apply_unexpanded(lambda x: make_curve_expression(curve, x), self.convert_node(argument))
            case Call(function=function, arguments=arguments):
                return apply_unexpanded(_BUILDERS[function], *map(self.convert_node, arguments))
            case Binary(operator="**", left=left, right=right):
                return self._convert_power(left, self.convert_node(left), self.convert_node(right))
            case Binary(operator=operator, left=left, right=right):
                return _apply_operator(operator, self.convert_node(left), self.convert_node(right))

    def _convert_power(self, left: Expr, a: sp.Expr, b: sp.Expr) -> sp.Expr:
        """Return the power a**b of two converted operands; `left` is the unconverted base.

        A power of two numbers is computed in binary64. Exponents such as 0.5 are made exact, and so is every exponent
        of a base with an exponential. Operands stay unevaluated where SymPy would expand them to extreme numbers.
        """
        if a.is_number and b.is_number:
            return _compute_numeric_power(a, b)
        exponent = (
            _make_exact(b) if a.has(sp.exp) else _make_exact_if_simple(b)
        )  # (e^(5000 − u))^0.3 as e^(1500 − 0.3 u)
        return apply_unexpanded(lambda a, b: self._extract_squares_from_power(a, b, left), a, exponent)

    def _extract_squares_from_power(self, base: sp.Expr, exponent: sp.Expr, *operands: Expr) -> sp.Expr:
        """Return base**exponent; from a sum to the power k/2, perfect squares are taken out of the root.

        `operands`: the unconverted base, or both arguments of hypot; their numbers are read as exact decimals of the
        file.
        """
        if not (base.is_Add and exponent.is_Rational and exponent.q == 2):
            return base**exponent
        exact_operands = [self._convert_with_decimals(operand) for operand in operands]
        return extract_squares(
            base,
            exponent,
            exact_operands[0] if len(operands) == 1 else sp.Add(*(operand**2 for operand in exact_operands)),
        )

    def _convert_with_decimals(self, expr: Expr) -> sp.Expr:
        """Return an expression with its numbers as exact rational numbers, the decimals that the user wrote.

        Only sums, products, quotients and small integer powers are converted in this way.
        """
        match expr:
            case Unary(operand=operand):
                return -self._convert_with_decimals(operand)
            case Binary(operator="**", left=left, right=right):
                exponent, base = self.convert_node(right), self._convert_with_decimals(left)
                if exponent.is_Integer and 1 < exponent <= DEGREE and exponent * _count_bits(base) < _MAX_BITS:
                    return base**exponent
            case Binary(operator=operator, left=left, right=right):
                return _apply_operator(operator, self._convert_with_decimals(left), self._convert_with_decimals(right))
        return convert_to_decimal(self.convert_node(expr))


def _count_bits(expression: sp.Expr) -> int:
    """Return the number of bits of the longest numerator or denominator in an expression.

    It is 0 without rational numbers.
    """
    return max(
        (max(int(number.p).bit_length(), int(number.q).bit_length()) for number in expression.atoms(sp.Rational)),
        default=0,
    )


def _apply_operator(operator: str, a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """Return a + b, a − b, a · b or a / b for the operator "+", "-", "*" or "/".

    In a product or quotient, several exponentials become the exponential of a sum, and operands that SymPy would expand
    to extreme numbers stay unevaluated.
    """
    match operator:
        case "+":
            return a + b
        case "-":
            return a - b
        case "*":
            return _merge_exponentials(apply_unexpanded(operator_of.mul, a, b))
    return _merge_exponentials(apply_unexpanded(operator_of.truediv, a, b))


def _merge_exponentials(product: sp.Expr) -> sp.Expr:
    """Return a product with e^a e^b written as e^(a + b), because one factor may be ∞ where the other is 0.

    A product with fewer than two exponentials is returned unchanged.
    """
    powers = [factor for factor in product.args if isinstance(factor, sp.exp)] if product.is_Mul else []
    if len(powers) < 2:
        return product
    other_factors = [factor for factor in product.args if not isinstance(factor, sp.exp)]
    return sp.Mul(make_exponential(sp.Add(*(factor.exp for factor in powers))), *other_factors)


def _make_unexpanded_square(a: sp.Expr) -> sp.Expr:
    """Return the square of an expression, which becomes `Unevaluated` where SymPy would form extreme numbers."""
    return apply_unexpanded(sp.Pow, a, sp.Integer(2))


def _make_exact_if_simple(exponent: sp.Expr) -> sp.Expr:
    """Return a float exponent such as 0.5 or 1.5 as a rational number if its denominator is at most 8.

    Other exponents are returned unchanged. (u**2)**0.5 is then |u| and has its switching point.
    """
    exact = _make_exact(exponent)
    return exact if exact.is_Rational and exact.q <= 8 else exponent


def _compute_numeric_power(a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """Return the power of two numbers as binary64 computes it, as an integer if it is one below 1e15.

    The exact value of 10**10**10, for example, would not fit into memory.
    """
    with np.errstate(all="ignore"):
        value = float(np.power(np.float64(a), np.float64(b)))
    return sp.Integer(int(value)) if abs(value) < 1e15 and value == int(value) else sp.Float(value, 17)


def convert_quantity_to_sympy(quantity: Quantity, find_symbol: Callable[[str], sp.Expr]) -> sp.Expr:
    """Return the expression of a quantity of the file in t, parameters and motion.

    `find_symbol(path)` returns the SymPy expression of a name. Raise BadValueError if the expression contains an
    infinite, undefined or imaginary constant.
    """
    value = convert_to_sympy(quantity.value, find_symbol)
    if value.has(sp.zoo, sp.nan, sp.oo, -sp.oo, sp.I):
        message, hint = (
            f"{quantity.address} is not finite for any motion",
            "expected a finite number: check for a division by zero",
        )
        raise BadValueError(message, quantity.where, hint)
    return value

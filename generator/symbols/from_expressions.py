"""Conversion of expression trees of a mechanism file to SymPy, function by function (gudgeon.language.functions)."""

from __future__ import annotations

import operator as operator_of
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import sympy as sp

from gudgeon.errors import BadValueError, Location
from gudgeon.generator.mechanism import Quantity
from gudgeon.generator.symbols.curves import curve_of
from gudgeon.generator.symbols.squares import DEGREE, decimal, root
from gudgeon.generator.symbols.switches import ModOf, Pick
from gudgeon.generator.symbols.unevaluated import kept
from gudgeon.language.functions import IN_SYMPY, Function
from gudgeon.language.parser import parse
from gudgeon.language.tree import Binary, Call, CurveCall, Expr, Name, Number, Unary

CLASSES: Mapping[Any, Function] = {getattr(sp, name): function for name, function in IN_SYMPY.items()}


def classes_where(has: Callable[[Function], bool]) -> tuple[Any, ...]:
    """Return SymPy's classes of the functions for which `has` holds."""
    return tuple(kind for kind, function in CLASSES.items() if has(function))


def smooth_step(t: sp.Expr, start: sp.Expr, duration: sp.Expr) -> sp.Expr:
    """Return the step that is 0 before `start`, 1 after `start + duration`, and 10s³ − 15s⁴ + 6s⁵ between them."""
    s = ramp(t, start, duration)
    return s**3 * (10 + s * (6 * s - 15))


def ramp(t: sp.Expr, start: sp.Expr, duration: sp.Expr) -> sp.Expr:
    """Return the ramp that is 0 before `start`, 1 after `start + duration`, and linear between them."""
    return sp.Max(0, sp.Min(1, (t - start) / duration))


def where(left: sp.Expr, right: sp.Expr, then: sp.Expr, otherwise: sp.Expr) -> sp.Expr:
    """Return `then` where left < right, else `otherwise`."""
    return then if then == otherwise else Pick(sp.sign(left - right), otherwise, then)


_HALF = sp.Rational(1, 2)
_BITS = 4096  # of numbers that were not written, at most


def exponential(exponent: sp.Expr) -> sp.Expr:
    """Return e^x with the numbers of a sum exact.

    SymPy would take e^5000.0 out of e^(5000.0 − u), and that overflows.
    """
    if not exponent.is_Add:
        return sp.exp(exponent)
    return sp.exp(sp.Add(*(_exact(x) for x in exponent.args)))


def _exact(number: sp.Expr) -> sp.Expr:
    """Return a float as the rational number that it is; other expressions as they are."""
    return sp.Rational(number) if number.is_Float else number


_FUNCTIONS: dict[str, Callable[..., sp.Expr]] = {
    **{function.name: kind for kind, function in CLASSES.items()},
    "exp": exponential,
    "smooth_step": smooth_step,
    "ramp": ramp,
    "where": where,
    "mod": ModOf,
}


def to_sympy(expr: Expr, symbol_of: Callable[[str], sp.Expr]) -> sp.Expr:
    """Return `expr` as a SymPy expression; `symbol_of(path)` gives the symbol of a name.

    A number stays the binary64 value that the user wrote; integers stay exact, so that they fold.
    """
    return _Reading(symbol_of).value(expr)


def derivative_at(derivative: str, x: sp.Expr, f: sp.Expr) -> sp.Expr:
    """Return a derivative of the table of functions at the argument `x`, where the function's value is `f`."""
    return to_sympy(parse(derivative, Location("functions.py", 1, 1)), {"x": x, "f": f}.__getitem__)


class _Reading:
    """Converter of one expression tree to SymPy, each part once."""

    def __init__(self, symbol_of: Callable[[str], sp.Expr]) -> None:
        """Begin with the resolver of names."""
        self._symbol_of = symbol_of
        self._known: dict[int, sp.Expr] = {}  # by the part's id

    def value(self, expr: Expr) -> sp.Expr:
        """Return the SymPy expression of a part, converted once."""
        if id(expr) not in self._known:
            self._known[id(expr)] = self._read(expr)
        return self._known[id(expr)]

    def _read(self, expr: Expr) -> sp.Expr:
        """Convert one part, without looking it up in the cache."""
        match expr:
            case Number(value=value):
                return sp.Integer(int(value)) if value == int(value) and abs(value) < 1e15 else sp.Float(value, 17)
            case Name(path=path):
                return self._symbol_of(path)
            case Unary(operand=operand):
                return -self.value(operand)
            case Call(function="sqrt", arguments=(of,)):
                return kept(lambda a: self._root(a, _HALF, of), self.value(of))
            case Call(function="hypot", arguments=sides):
                return kept(lambda a, b: self._root(_square(a) + _square(b), _HALF, *sides), *map(self.value, sides))
            case CurveCall(arguments=(argument,), curve=curve):
                return kept(lambda x: curve_of(curve, x), self.value(argument))
            case Call(function=function, arguments=arguments):
                return kept(_FUNCTIONS[function], *map(self.value, arguments))
            case Binary(operator="**", left=left, right=right):
                return self._power(left, self.value(left), self.value(right))
            case Binary(operator=operator, left=left, right=right):
                return _combine(operator, self.value(left), self.value(right))

    def _power(self, left: Expr, a: sp.Expr, b: sp.Expr) -> sp.Expr:
        """Return a power; exponents such as 0.5 are made exact."""
        if a.is_number and b.is_number:
            return _power(a, b)
        exponent = _exact(b) if a.has(sp.exp) else _halves(b)  # (e^(5000 − u))^0.3 as e^(1500 − 0.3 u)
        return kept(lambda a, b: self._root(a, b, left), a, exponent)

    def _root(self, base: sp.Expr, exponent: sp.Expr, *of: Expr) -> sp.Expr:
        """Return a power of an expression, or of the sum of the squares of two; squares under a root are taken out."""
        if not (base.is_Add and exponent.is_Rational and exponent.q == 2):
            return base**exponent
        written = [self._decimals(x) for x in of]
        return root(base, exponent, written[0] if len(of) == 1 else sp.Add(*(x**2 for x in written)))

    def _decimals(self, expr: Expr) -> sp.Expr:
        """Return the expression with the numbers of its sums, products and small powers exactly as written."""
        match expr:
            case Unary(operand=operand):
                return -self._decimals(operand)
            case Binary(operator="**", left=left, right=right):
                exponent, base = self.value(right), self._decimals(left)
                if exponent.is_Integer and 1 < exponent <= DEGREE and exponent * _bits(base) < _BITS:
                    return base**exponent
            case Binary(operator=operator, left=left, right=right):
                return _combine(operator, self._decimals(left), self._decimals(right))
        return decimal(self.value(expr))


def _bits(e: sp.Expr) -> int:
    """Return the number of bits of the longest number in an expression."""
    return max((max(int(x.p).bit_length(), int(x.q).bit_length()) for x in e.atoms(sp.Rational)), default=0)


def _combine(operator: str, a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """Return a sum, difference, product or quotient."""
    match operator:
        case "+":
            return a + b
        case "-":
            return a - b
        case "*":
            return _joined(kept(operator_of.mul, a, b))
    return _joined(kept(operator_of.truediv, a, b))


def _joined(product: sp.Expr) -> sp.Expr:
    """Return a product with e^a e^b as e^(a + b): one factor may be ∞ where the other is 0."""
    powers = [x for x in product.args if isinstance(x, sp.exp)] if product.is_Mul else []
    if len(powers) < 2:
        return product
    rest = [x for x in product.args if not isinstance(x, sp.exp)]
    return sp.Mul(exponential(sp.Add(*(x.exp for x in powers))), *rest)


def _square(a: sp.Expr) -> sp.Expr:
    """Return the square of an expression."""
    return kept(sp.Pow, a, sp.Integer(2))


def _halves(exponent: sp.Expr) -> sp.Expr:
    """Return an exponent such as 0.5 or 1.5 exactly, so that (u**2)**0.5 is |u| and has its switching point."""
    exact = _exact(exponent)
    return exact if exact.is_Rational and exact.q <= 8 else exponent


def _power(a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """Return a power of numbers as binary64 has it: the exact 10**10**10 would not fit into memory."""
    with np.errstate(all="ignore"):
        value = float(np.power(np.float64(a), np.float64(b)))
    return sp.Integer(int(value)) if abs(value) < 1e15 and value == int(value) else sp.Float(value, 17)


def quantity_to_sympy(quantity: Quantity, symbol_of: Callable[[str], sp.Expr]) -> sp.Expr:
    """Return the expression of a quantity in t and motion. Raises BadValueError if it is never finite."""
    value = to_sympy(quantity.value, symbol_of)
    if value.has(sp.zoo, sp.nan, sp.oo, -sp.oo, sp.I):
        message, hint = f"{quantity.address} is finite for no motion", "expected a number: is there a division by zero?"
        raise BadValueError(message, quantity.where, hint)
    return value

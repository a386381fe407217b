"""Expression trees of a mechanism file as SymPy expressions, function by function."""

from __future__ import annotations

import operator as operator_of
import sys
from collections.abc import Callable

import numpy as np
import sympy as sp

from gudgeon.errors import BadValueError
from gudgeon.generator.mechanism.mechanism import Quantity
from gudgeon.generator.symbols.near_squares import near_square_root
from gudgeon.generator.symbols.wholes import kept
from gudgeon.language.tree import Binary, Call, Expr, Name, Number, Unary


def smooth_step(t: sp.Expr, start: sp.Expr, duration: sp.Expr) -> sp.Expr:
    """0 before `start`, 1 after `start + duration`, between them 10s³ − 15s⁴ + 6s⁵."""
    s = ramp(t, start, duration)
    return s**3 * (10 + s * (6 * s - 15))


def ramp(t: sp.Expr, start: sp.Expr, duration: sp.Expr) -> sp.Expr:
    """0 before `start`, 1 after `start + duration`, linear between them."""
    return sp.Max(0, sp.Min(1, (t - start) / duration))


_HALF = sp.Rational(1, 2)
_LONG, _DEGREE = 60, 8  # operations under a root, and a power there, beyond which nobody wrote a square


def exponential(exponent: sp.Expr) -> sp.Expr:
    """e^x with the numbers of a sum exact: SymPy would take e^5000.0 out of e^(5000.0 − u), and that overflows."""
    if not exponent.is_Add:
        return sp.exp(exponent)
    return sp.exp(sp.Add(*(_exact(x) for x in exponent.args)))


def _exact(number: sp.Expr) -> sp.Expr:
    return sp.Rational(number) if number.is_Float else number


_FUNCTIONS: dict[str, Callable[..., sp.Expr]] = {
    "sin": sp.sin, "cos": sp.cos, "tan": sp.tan, "asin": sp.asin, "acos": sp.acos, "atan": sp.atan,
    "atan2": sp.atan2, "sinh": sp.sinh, "cosh": sp.cosh, "tanh": sp.tanh, "exp": exponential, "log": sp.log,
    "sqrt": lambda a: root(a, _HALF), "hypot": lambda a, b: root(_square(a) + _square(b), _HALF),
    "abs": sp.Abs, "sign": sp.sign, "min": sp.Min, "max": sp.Max, "smooth_step": smooth_step, "ramp": ramp,
}  # fmt: skip


def to_sympy(expr: Expr, symbol_of: Callable[[str], sp.Expr]) -> sp.Expr:
    """`expr` in SymPy; `symbol_of(path)` gives the symbol of a name.

    A number stays the binary64 value that the user wrote; integers stay exact, so that they fold.
    """
    match expr:
        case Number(value=value):
            return sp.Integer(int(value)) if value == int(value) and abs(value) < 1e15 else sp.Float(value, 17)
        case Name(path=path):
            return symbol_of(path)
        case Unary(operand=operand):
            return -to_sympy(operand, symbol_of)
        case Call(function=function, arguments=arguments):
            return kept(_FUNCTIONS[function], *(to_sympy(a, symbol_of) for a in arguments))
        case Binary(operator=operator, left=left, right=right):
            return _combine(operator, to_sympy(left, symbol_of), to_sympy(right, symbol_of))


def _combine(operator: str, a: sp.Expr, b: sp.Expr) -> sp.Expr:
    match operator:
        case "+":
            return a + b
        case "-":
            return a - b
        case "*":
            return _joined(kept(operator_of.mul, a, b))
        case "/":
            return _joined(kept(operator_of.truediv, a, b))
    if a.is_number and b.is_number:
        return _power(a, b)
    return kept(root, a, _exact(b) if a.has(sp.exp) else _halves(b))  # (e^(5000 − u))^0.3 as e^(1500 − 0.3 u)


def _joined(product: sp.Expr) -> sp.Expr:
    """e^a e^b as e^(a + b): one may be ∞ where the other is 0."""
    powers = [x for x in product.args if isinstance(x, sp.exp)] if product.is_Mul else []
    if len(powers) < 2:
        return product
    rest = [x for x in product.args if not isinstance(x, sp.exp)]
    return sp.Mul(exponential(sp.Add(*(x.exp for x in powers))), *rest)


def _square(a: sp.Expr) -> sp.Expr:
    return kept(sp.Pow, a, sp.Integer(2))


def root(base: sp.Expr, exponent: sp.Expr) -> sp.Expr:
    """A power; of a sum under a root its squares are taken out: sqrt(t**2 - 2*t + 1) is |t - 1|, a corner and all."""
    if not (base.is_Add and exponent.is_Rational and exponent.q == 2) or base.count_ops() > _LONG:
        return base**exponent
    atoms: dict[sp.Expr, sp.Dummy] = {}
    polynomial = _polynomial(base, atoms)
    try:
        factor, parts = sp.sqf_list(polynomial)
    except sp.PolynomialError:
        return base**exponent
    if all(count == 1 for _, count in parts):
        names = [atoms[atom] for atom in sorted(atoms, key=sp.default_sort_key)]
        near = near_square_root(polynomial, names) if base.has(sp.Float) else None
        if near is None:
            return base**exponent
        factor, parts = sp.Integer(1), [(near, 2)]
    meant = {dummy: atom for atom, dummy in atoms.items()}
    return sp.Mul(factor, *(sp.Pow(part.xreplace(meant), count) for part, count in parts)) ** exponent


def _polynomial(e: sp.Expr, atoms: dict[sp.Expr, sp.Dummy]) -> sp.Expr:
    """`e` with a name for all in it that is no sum, product or small power, so that its degree is the one written.

    Left to itself SymPy takes x^0.1 and x^0.0001 for powers of one generator, with as many terms as memory holds.
    """
    if e.is_Number:
        simple = sp.nsimplify(e, rational=True)  # 0.2 as 1/5; it would have 0.11111111111122 as 1/9
        return simple if abs(simple - e) <= 4 * sys.float_info.epsilon * abs(e) else sp.Rational(e)
    if e.is_Add or e.is_Mul:
        return e.func(*(_polynomial(a, atoms) for a in e.args))
    base, exponent = e.as_base_exp() if e.is_Pow else (e, sp.Integer(1))
    if exponent.is_Integer and 1 < exponent <= _DEGREE:
        return _polynomial(base, atoms) ** exponent
    if exponent.is_Rational and 1 < abs(exponent.p) <= _DEGREE:
        return _polynomial(base ** (exponent / abs(exponent.p)), atoms) ** abs(exponent.p)
    if isinstance(e, sp.exp):
        count, rest = e.exp.as_coeff_Mul()
        if count.is_Rational and 1 < abs(count.p) <= _DEGREE:
            return _polynomial(sp.exp(rest * count / abs(count.p)), atoms) ** abs(count.p)
    return atoms.setdefault(e, sp.Dummy(real=True))


def _halves(exponent: sp.Expr) -> sp.Expr:
    """An exponent such as 0.5 or 1.5 exactly, so that (u**2)**0.5 is |u| and has its corner."""
    exact = _exact(exponent)
    return exact if exact.is_Rational and exact.q <= 8 else exponent


def _power(a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """A power of numbers as binary64 has it: exactly, 10**10**10 has more digits than there is memory."""
    with np.errstate(all="ignore"):
        value = float(np.power(np.float64(a), np.float64(b)))
    return sp.Integer(int(value)) if abs(value) < 1e15 and value == int(value) else sp.Float(value, 17)


def quantity_to_sympy(quantity: Quantity, symbol_of: Callable[[str], sp.Expr]) -> sp.Expr:
    """An expression of t and motion. Raises BadValueError where it is finite for none."""
    value = to_sympy(quantity.value, symbol_of)
    if value.has(sp.zoo, sp.nan, sp.oo, -sp.oo, sp.I):
        message, hint = f"{quantity.address} is finite for no motion", "expected a number: is there a division by zero?"
        raise BadValueError(message, quantity.where, hint)
    return value

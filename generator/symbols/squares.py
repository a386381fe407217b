"""Perfect squares under roots, factored with exact decimals: t² − 2·0.2202 t + 0.2202² is (t − 0.2202)².

There is no tolerance: a sum that is not exactly a square of these decimals stays under its root, however near it is.
"""

from __future__ import annotations

import sympy as sp

_MAX_OPERATIONS, DEGREE = 60, 8  # maximum number of operations, and maximum power, of an expression under a root
_MAX_INTEGER = 10**15  # binary64 represents all whole numbers up to it


def extract_squares(base: sp.Expr, exponent: sp.Expr, decimals: sp.Expr | None = None) -> sp.Expr:
    """Return base**exponent with squares under a square root taken out: sqrt(t**2 - 2*t + 1) becomes |t - 1|.

    The method is square-free factorization. `decimals`: the base with the exact decimals of the file; None: the
    shortest decimals that identify its binary64 numbers. Other exponents, bases of more than `_MAX_OPERATIONS` and
    bases without squares give the plain power.
    """
    if not (base.is_Add and exponent.is_Rational and exponent.q == 2) or base.count_ops() > _MAX_OPERATIONS:
        return base**exponent
    atoms: dict[sp.Expr, sp.Dummy] = {}
    polynomial = _convert_to_polynomial(base if decimals is None else decimals, atoms)
    if not polynomial.is_finite and polynomial.has(sp.zoo, sp.nan, sp.oo, -sp.oo):
        return base**exponent
    try:
        factor, parts = sp.sqf_list(polynomial)
    except sp.PolynomialError:
        return base**exponent
    if all(count == 1 for _, count in parts):
        return base**exponent
    atom_by_dummy = {dummy: atom for atom, dummy in atoms.items()}
    powers = []
    for part, count in parts:
        size = _find_coefficient_divisor(part)
        factor *= size**count
        powers.append(sp.Pow((part / size).expand().xreplace(atom_by_dummy), count))
    return sp.Mul(factor, *powers) ** exponent


def convert_to_decimal(number: sp.Expr) -> sp.Expr:
    """Return a float as the shortest decimal that rounds to it, an exact rational; other expressions unchanged."""
    return sp.Rational(repr(float(number))) if number.is_Float and number.is_finite else number


def _find_coefficient_divisor(polynomial: sp.Expr) -> sp.Expr:
    """Return the divisor that keeps the integer coefficients of a polynomial below `_MAX_INTEGER`.

    It is 1 if they are below that already, else the magnitude of the leading coefficient.
    """
    magnitudes = [abs(coefficient) for coefficient in sp.Poly(polynomial).coeffs()]
    return sp.Integer(1) if max(magnitudes) < _MAX_INTEGER else magnitudes[0]


def _convert_to_polynomial(expression: sp.Expr, atoms: dict[sp.Expr, sp.Dummy]) -> sp.Expr:
    """Return an expression as a polynomial in dummy symbols (generators), with its floats as exact decimals.

    Powers x^(p/q) and exponentials e^(p x/q) with 1 < |p| up to DEGREE become powers |p| of x^(±1/q) and e^(±x/q).
    Each other part that is not a sum or product gets a dummy. `atoms` maps these parts to their dummies and is
    extended in place. The exponents are explicit: SymPy would take x^0.1 and x^0.0001 for powers of one generator,
    with as many terms as memory holds.
    """
    if expression.is_Number:
        return convert_to_decimal(expression)
    if expression.is_Add or expression.is_Mul:
        return expression.func(*(_convert_to_polynomial(argument, atoms) for argument in expression.args))
    base, exponent = expression.as_base_exp() if expression.is_Pow else (expression, sp.Integer(1))
    if exponent.is_Integer and 1 < exponent <= DEGREE:
        return _convert_to_polynomial(base, atoms) ** exponent
    if exponent.is_Rational and 1 < abs(exponent.p) <= DEGREE:
        return _convert_to_polynomial(base ** (exponent / abs(exponent.p)), atoms) ** abs(exponent.p)
    if isinstance(expression, sp.exp):
        count, remaining_exponent = expression.exp.as_coeff_Mul()
        if count.is_Rational and 1 < abs(count.p) <= DEGREE:
            return _convert_to_polynomial(sp.exp(remaining_exponent * count / abs(count.p)), atoms) ** abs(count.p)
    return atoms.setdefault(expression, sp.Dummy(real=True))

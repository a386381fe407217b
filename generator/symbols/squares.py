"""Squares under roots, by the decimals that were written: t² − 2·0.2202 t + 0.2202² is (t − 0.2202)².

There is no tolerance: a sum that is not exactly a square of these decimals stays under its root, however near it is.
"""

from __future__ import annotations

import sympy as sp

_LONG, DEGREE = 60, 8  # operations under a root, and a power there, up to which squares are looked for
_DIGITS = 10**15  # a whole number that binary64 has


def root(base: sp.Expr, exponent: sp.Expr, decimals: sp.Expr | None = None) -> sp.Expr:
    """Return a power; squares under a root are taken out: sqrt(t**2 - 2*t + 1) is |t - 1|, with its switching point.

    decimals: the base with its numbers as written; else the shortest decimals that identify the binary64 numbers are
    used.
    """
    if not (base.is_Add and exponent.is_Rational and exponent.q == 2) or base.count_ops() > _LONG:
        return base**exponent
    atoms: dict[sp.Expr, sp.Dummy] = {}
    polynomial = _polynomial(base if decimals is None else decimals, atoms)
    if not polynomial.is_finite and polynomial.has(sp.zoo, sp.nan, sp.oo, -sp.oo):
        return base**exponent
    try:
        factor, parts = sp.sqf_list(polynomial)
    except sp.PolynomialError:
        return base**exponent
    if all(count == 1 for _, count in parts):
        return base**exponent
    meant = {dummy: atom for atom, dummy in atoms.items()}
    powers = []
    for part, count in parts:
        size = _size(part)
        factor *= size**count
        powers.append(sp.Pow((part / size).expand().xreplace(meant), count))
    return sp.Mul(factor, *powers) ** exponent


def decimal(number: sp.Expr) -> sp.Expr:
    """Return a binary64 number as the shortest decimal that is read as it."""
    return sp.Rational(repr(float(number))) if number.is_Float and number.is_finite else number


def _size(part: sp.Expr) -> sp.Expr:
    """Return the number by which a polynomial with integer coefficients is divided, so that they are numbers of C."""
    sizes = [abs(c) for c in sp.Poly(part).coeffs()]
    return sp.Integer(1) if max(sizes) < _DIGITS else sizes[0]


def _polynomial(e: sp.Expr, atoms: dict[sp.Expr, sp.Dummy]) -> sp.Expr:
    """Return `e` with a dummy for each part that is not a sum, product or small power.

    Its degree is then the one written. SymPy would take x^0.1 and x^0.0001 for powers of one generator, with as many
    terms as memory holds.
    """
    if e.is_Number:
        return decimal(e)
    if e.is_Add or e.is_Mul:
        return e.func(*(_polynomial(a, atoms) for a in e.args))
    base, exponent = e.as_base_exp() if e.is_Pow else (e, sp.Integer(1))
    if exponent.is_Integer and 1 < exponent <= DEGREE:
        return _polynomial(base, atoms) ** exponent
    if exponent.is_Rational and 1 < abs(exponent.p) <= DEGREE:
        return _polynomial(base ** (exponent / abs(exponent.p)), atoms) ** abs(exponent.p)
    if isinstance(e, sp.exp):
        count, rest = e.exp.as_coeff_Mul()
        if count.is_Rational and 1 < abs(count.p) <= DEGREE:
            return _polynomial(sp.exp(rest * count / abs(count.p)), atoms) ** abs(count.p)
    return atoms.setdefault(e, sp.Dummy(real=True))

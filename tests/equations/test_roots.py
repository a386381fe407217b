"""Squares under a root are taken out, corner and all; what is no polynomial under it stays small."""

from __future__ import annotations

import pytest
import sympy as sp

from gudgeon.errors import Location
from gudgeon.generator.symbols.from_expressions import convert_to_sympy
from gudgeon.generator.symbols.squares import extract_squares
from gudgeon.language.parser import parse

x, y, t = sp.symbols("x y t", real=True)
HALF = sp.Rational(1, 2)


@pytest.mark.parametrize(
    ("base", "expected"),
    [
        (t**2 - 1.0 * t + 0.25, sp.Abs(2 * t - 1) / 2),
        (x**4 - 2 * x**2 * y**2 + y**4, sp.Abs(x**2 - y**2)),
        (sp.sin(t) ** 2 - 2 * sp.sin(t) + 1, sp.Abs(sp.sin(t) - 1)),
        (sp.exp(2 * t) - 2 * sp.exp(t) + 1, sp.Abs(sp.exp(t) - 1)),
        (x**3 - 2 * x**2 + x, sp.sqrt(x) * sp.Abs(x - 1)),
        (t**2 - 2 * t * 0.4 + 0.16, sp.Abs(5 * t - 2) / 5),
    ],
)
def test_squares_under_a_root(base: sp.Expr, expected: sp.Expr) -> None:
    assert extract_squares(base, HALF) == expected


def read(text: str) -> sp.Expr:
    return convert_to_sympy(parse(text, Location("f", 1, 1)), lambda name: sp.Symbol(name, real=True))


@pytest.mark.parametrize("c", ["0.2202", "1/3", "1.7e-9", "12345.678", "0.123456789012345"])
def test_decimals_are_taken_as_written(c: str) -> None:
    """In binary64 c² and 2 c are not the square and the double of one number any more."""
    exact = sp.Rational(c)
    for text, slope, at in (
        (f"sqrt(t**2 - 2*({c})*t + ({c})**2)", 1, exact),
        (f"sqrt((({c})*t)**2 - 3.4*({c})*t + 2.89)", exact, sp.Rational("1.7") / exact),
        (f"(25*t**2 - 50*({c})*t + 25*({c})**2)**0.5", 5, exact),
    ):
        value = read(text)
        (of,) = value.atoms(sp.Abs)
        assert float(sp.solve(of.args[0], t)[0]) == pytest.approx(float(at), rel=1e-15)
        assert float(value.subs(t, 7)) == pytest.approx(float(abs(7 - at) * slope), rel=1e-14)
    value = read(f"(x**2 - 2*({c})*x*y + ({c})**2*y**2)**1.5")
    assert value.subs({x: 3, y: 2}) == pytest.approx(abs(3 - 2 * exact) ** 3, rel=1e-12)


@pytest.mark.parametrize(
    "text",
    [
        "sqrt(x**2 - 20*x + 100.0000000000002)",
        "sqrt(x**2 - 1.8e8*x + 8100000000000001)",
        "sqrt(x**2 - 0.4404*x + 0.04848804000000001)",
        "sqrt(x**2 - 0.8*x + 0.16000000000000003)",
        "hypot(x - 1e8, 1)",
    ],
)
def test_what_is_nearly_a_square_stays_a_root(text: str) -> None:
    """It was taken for one within a few ulp of its terms, and was 0 where binary64 has another number."""
    value = read(text)
    assert value.is_Pow and value.exp == HALF and not value.has(sp.Abs)


@pytest.mark.parametrize(
    "base",
    [
        1 + x**0.1 + x**0.0001,  # a polynomial of degree 1000 in x^0.0001
        (1.5 + sp.sin(0.1 * y)) ** (2 * sp.sqrt(0.5 * x * t)) + (sp.sinh(0.5 * y) - 3.7e-3 * x) ** 2,
        sp.exp(x) + sp.exp(1e-4 * x) + 2,
        (1 + x) ** 1_000_000 + y**2,
    ],
)
def test_other_roots_stay_as_they_are(base: sp.Expr) -> None:
    """No more is made of them than was written, in time or memory."""
    assert extract_squares(base, HALF) == sp.sqrt(base)

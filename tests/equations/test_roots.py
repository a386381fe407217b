"""Squares under a root are taken out, corner and all; what is no polynomial under it stays small."""

from __future__ import annotations

import pytest
import sympy as sp

from gudgeon.generator.symbols.from_expressions import root

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
        (t**2 - 0.8 * t + 0.4**2, sp.Abs(5 * t - 2) / 5),
    ],
)
def test_squares_under_a_root(base: sp.Expr, expected: sp.Expr) -> None:
    assert root(base, HALF) == expected


@pytest.mark.parametrize("c", [0.2202, 1 / 3, 1.7e-9, 12345.678])
def test_squares_but_for_rounding(c: float) -> None:
    """c² and 2 c are not the square and the double of one number any more."""
    for base, at in ((t**2 - 2 * c * t + c * c, c), ((c * t) ** 2 - 3.4 * c * t + 2.89, 1.7 / c)):
        value = root(base, HALF)
        (of,) = value.atoms(sp.Abs)
        assert float(sp.solve(of.args[0], t)[0]) == pytest.approx(at, rel=1e-14)
        assert float(value.subs(t, 7.0)) == pytest.approx(float(sp.sqrt(base.subs(t, 7.0))), rel=1e-9)
    value = root((x**2 - 2 * c * x * y + c * c * y**2), sp.Rational(3, 2))
    assert value.subs({x: 3, y: 2}) == pytest.approx(abs(3 - 2 * c) ** 3, rel=1e-12)
    assert not root(t**2 - 2 * c * t + c * c * (1 + 1e-12), HALF).has(sp.Abs)


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
    assert root(base, HALF) == sp.sqrt(base)

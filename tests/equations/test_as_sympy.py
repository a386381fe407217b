"""What is computed here to save SymPy's time: the very expressions and texts that SymPy gives."""

from __future__ import annotations

import pickle
import random
from collections.abc import Iterator

import pytest
import sympy as sp
from sympy.printing.c import C99CodePrinter
from sympy.printing.pycode import PythonCodePrinter

from gudgeon.generator.symbols.derivatives import differentiate, find_operation_classes, find_symbols
from gudgeon.generator.symbols.storage import StorageLocation, StoredSymbol
from gudgeon.generator.symbols.switches import Select
from gudgeon.generator.symbols.symbol_sums import add_products, is_signed_symbol, subtract_products
from gudgeon.generator.targets.cached_printer import CachedPrinter

SYMBOLS = x, y, z = sp.symbols("x y z", real=True)
NUMBERS = (*map(sp.Integer, (-3, -1, 2, 7)), sp.Rational(-1, 2), sp.Rational(3, 7), sp.Float(0.3), sp.Float(-1.5))
POWERS = (*map(sp.Integer, (-3, -2, -1, 2, 3)), sp.Rational(1, 2), sp.Rational(-1, 2), sp.Rational(3, 2))


def expressions(count: int) -> Iterator[sp.Expr]:
    rng = random.Random(18)

    def some(depth: int) -> sp.Expr:
        if depth == 0 or rng.random() < 0.15:
            return rng.choice(SYMBOLS)
        kind = rng.choice(("sum", "product", "product", "power", "function"))
        if kind == "power":
            return some(depth - 1) ** rng.choice((*POWERS, y))
        if kind == "function":
            return rng.choice((sp.sin, sp.cos, sp.exp, sp.atan, sp.log))(some(depth - 1))
        parts = [some(depth - 1) for _ in range(rng.randint(1, 3))] + [rng.choice(NUMBERS)] * rng.randint(0, 1)
        return sp.Add(*parts) if kind == "sum" else sp.Mul(*parts)

    while count:
        made = some(4)
        if not made.has(sp.nan, sp.zoo, sp.oo):
            yield made
            count -= 1


@pytest.mark.parametrize(
    "expression",
    [
        sp.atan2(x * y, 3 - x),
        sp.Max(x, y * x),
        Select(x - y, x**2, x * sp.sin(y)),
        sp.Abs(x * y) * x,
        2 * (x + y),
        sp.Mul(2, x + y * x, evaluate=False),
        x**x,
        sp.Heaviside(x - y) * x,
        sp.sqrt(x**2 + y**2) ** -3,
        sp.Integer(4),
    ],
    ids=str,
)
def test_derivatives_of_each_kind(expression: sp.Expr) -> None:
    for symbol in SYMBOLS:
        assert differentiate(expression, symbol) == sp.diff(expression, symbol)


def test_derivatives_and_symbols_of_random_expressions() -> None:
    for expression in expressions(60):
        assert find_symbols(expression) == expression.free_symbols
        for operation in (sp.Pow, sp.sin, sp.log):
            assert (operation in find_operation_classes(expression)) == expression.has(operation)
        for symbol in SYMBOLS:
            assert differentiate(expression, symbol) == sp.diff(expression, symbol), (expression, symbol)


@pytest.mark.parametrize("printer", [C99CodePrinter, PythonCodePrinter])
def test_texts_of_random_expressions(printer: type[C99CodePrinter | PythonCodePrinter]) -> None:
    quick = type("Printer", (CachedPrinter, printer), {})()
    for expression in expressions(200):
        if expression.has(sp.Float) and printer is PythonCodePrinter:
            continue  # every printer of gudgeon writes these in its own way
        assert quick.doprint(expression) == printer().doprint(expression)
    for expression in (
        -1 / x,
        -x / (y * z),
        1 / (x * (y + 1)),
        -(x + y),
        -2 / (x * y) ** 2,
        x / (y * sp.sqrt(z)),
        sp.Mul(x, 1 / sp.Mul(y, z, evaluate=False), evaluate=False),
    ):
        assert quick.doprint(expression) == printer().doprint(expression)


def test_sums_of_products_of_random_factors() -> None:
    rng = random.Random(52)
    symbols = [
        *sp.symbols("b9 b10 a a_1 Z", real=True),
        StoredSymbol(StorageLocation("p")["mass"]),
        StoredSymbol(StorageLocation("x")[3]),
    ]
    others = [sp.Integer(0), sp.Integer(1), sp.Integer(-1), sp.Rational(1, 2), x + y, x**2, sp.sin(x), sp.Symbol("a")]

    def choose_factor() -> sp.Expr:
        if rng.random() < 0.15:
            return rng.choice(others)
        return rng.choice((1, -1)) * sp.Mul(*rng.sample(symbols, rng.randint(1, 3)))

    for _ in range(400):
        factors = [(choose_factor(), choose_factor()) for _ in range(rng.randint(0, 5))]
        start = sp.Add(*(choose_factor() for _ in range(rng.randint(0, 3))))
        expected = sum((a * b for a, b in factors), sp.Integer(0))
        for result, same in (
            (add_products(start, factors), start + expected),
            (subtract_products(start, factors), start - expected),
        ):
            assert result == same and sp.srepr(result) == sp.srepr(same)
            assert hash(result) == hash(same) and result.is_commutative is True


@pytest.mark.parametrize("value", [x, -x, x * y, -x * y, 2 * x, x + y, sp.Integer(-1), -sp.sin(x)], ids=str)
def test_signed_symbols(value: sp.Expr) -> None:
    assert is_signed_symbol(value) == (value.is_Symbol or (-value).is_Symbol)


def test_texts_of_sums_of_products_of_symbols() -> None:
    rng = random.Random(53)
    symbols = sp.symbols("b9 b10 a a_1 Z", real=True)
    for _ in range(300):
        terms = (
            rng.choice((1, 1, -1, 2)) * sp.Mul(*rng.sample(symbols, rng.randint(1, 3))) * rng.choice((1, 1, x + y))
            for _ in range(rng.randint(1, 5))
        )
        expression = sp.Add(*terms)
        for printer in (C99CodePrinter, PythonCodePrinter):
            assert type("Printer", (CachedPrinter, printer), {})().doprint(expression) == printer().doprint(expression)


def test_a_symbol_of_a_place_is_pickled_with_its_place() -> None:
    symbol = StoredSymbol(StorageLocation("rhs")["clearance"][0]["Fx"])
    copy = pickle.loads(pickle.dumps(symbol))
    assert copy == symbol and copy.storage_location == symbol.storage_location and copy.name == "rhs.clearance[0].Fx"

"""Parts and expressions of equal structure are printed once; the text is that of printing each of them."""

from __future__ import annotations

import numpy as np
import pytest
import sympy as sp

from benchmarks.peers.chains import written
from gudgeon.generator.ir import part_structure
from gudgeon.generator.ir.expression_structure import find_expression_structure
from gudgeon.generator.ir.readable import Readable
from gudgeon.generator.pipeline import generate_kernel_source
from gudgeon.generator.symbols.storage import StorageLocation, StoredSymbol, make_real_symbol
from gudgeon.generator.targets.c import equal_parts
from gudgeon.generator.targets.c.lanes_printer import LanesPrinter
from gudgeon.generator.targets.c.printer import CPrinter
from gudgeon.mechanisms.n_four_bar import text as four_bars_text
from tests.kernels.test_parts import shorten
from tests.slow import slow_but

NAMES = ("a", "b_", "b_2_", "c", "c10", "c9", "theta_1", "x", "z")
PLACES = (
    StorageLocation("q")[3],
    StorageLocation("q")[12],
    StorageLocation("p")["mass"],
    StorageLocation("rhs")["clearance"][0]["Fx"],
)


def make_expression(random: np.random.Generator, symbols: list[sp.Symbol], depth: int) -> sp.Expr:
    """Return a random expression of sums, products, quotients, powers and functions."""
    if depth == 0 or random.random() < 0.2:
        number = [sp.Integer(-1), sp.Rational(1, 3), sp.Float(0.25), 3 * sp.pi / 2, sp.Integer(2)]
        return symbols[random.integers(len(symbols))] if random.random() < 0.8 else number[random.integers(5)]
    arguments = [make_expression(random, symbols, depth - 1) for _ in range(random.integers(2, 5))]
    kind = random.integers(6)
    if kind < 2:
        return sp.Add(*arguments)
    if kind < 4:
        return sp.Mul(*arguments)
    power = sp.Integer([-2, -1, 2, 3][random.integers(4)])
    return sp.sin(arguments[0]) if kind == 4 else sp.Add(*arguments, symbols[0] ** 2) ** power


@pytest.mark.parametrize("printer", [CPrinter, LanesPrinter])
def test_expressions_printed_by_structure_have_the_text_of_direct_printing(printer: type[CPrinter]) -> None:
    random = np.random.default_rng(5)
    texts = set()
    for _ in range(400):
        symbols = [*map(make_real_symbol, NAMES), *map(StoredSymbol, PLACES)]
        random.shuffle(symbols)
        expression = make_expression(random, symbols[:4], 3)
        readable = Readable((), {"c10": "c_", "x": StorageLocation("p")["x"]})
        assert printer(readable).print_by_structure(expression) == printer(readable)._print(expression)
        texts.add(str(expression))
    assert len(texts) > 200


def test_structure_contains_the_order_of_names() -> None:
    a, b, c = map(make_real_symbol, "abc")
    structures = [find_expression_structure(x) for x in (a - 2 * b, b - 2 * c, b - 2 * a, a - 3 * b)]
    assert all(structures)
    first, same, swapped, other = (x[0] for x in structures if x)
    assert first == same and first not in (swapped, other)
    assert find_expression_structure(sp.Max(a, b)) is None  # its arguments are ordered by their text


@pytest.mark.parametrize("mechanism", slow_but(["four_bars"], ["four_bars", "chain"]))
@pytest.mark.parametrize("formulation", slow_but(["reduced"], ["reduced", "full"]))
def test_parts_printed_once_have_the_text_of_printing_each(
    mechanism: str, formulation: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    shorten(monkeypatch)
    text = four_bars_text(4) if mechanism == "four_bars" else written(8, tuple(0.3 * k for k in range(8)))

    def print_files() -> dict[str, str]:
        return dict(generate_kernel_source(text.encode(), "m.yaml", "ideal", None, formulation).files)

    filled: list[object] = []
    format_operand = equal_parts._format_operand

    def count_operand(structure: part_structure.PartStructure, source: int | str) -> str:
        filled.append(source)
        return format_operand(structure, source)

    monkeypatch.setattr(equal_parts, "_format_operand", count_operand)
    once = print_files()
    assert len(filled) > 100
    monkeypatch.setattr(equal_parts, "find_part_structure", lambda part: None)
    assert print_files() == once

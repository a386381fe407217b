"""Every function that expressions may use, through every target: what is tested follows the table of functions."""

from __future__ import annotations

import json
import math
import subprocess
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy as sp

from gudgeon.errors import ExpressionError, UnitError
from gudgeon.generator.ir.differentiation import compute_partial_derivative
from gudgeon.generator.ir.readable import Readable
from gudgeon.generator.ir.series_rules import NoTaylorSeries
from gudgeon.generator.symbols.from_expressions import convert_derivative
from gudgeon.generator.targets.c.function_table import print_function_table
from gudgeon.generator.targets.javascript.printer import PRELUDE, JavaScriptPrinter
from gudgeon.generator.targets.latex.printers import TexPrinter, TextPrinter
from gudgeon.generator.targets.numpy.printer import NumPyPrinter
from gudgeon.language.functions import Function, Units
from gudgeon.language.parser import check_dimension, parse
from gudgeon.language.tree import Call, to_json
from gudgeon.language.units import DIMENSIONLESS, LENGTH, TIME
from tests.functions.table import (
    HERE,
    draw,
    every_function,
    in_sympy,
    interval,
    names,
    sorted_symbols,
    tree,
    values,
)
from tests.integrators.test_taylor import MOTION, X, Y, coefficients
from tests.web.node import needs_node, node

ROOT = Path(__file__).resolve().parent.parent.parent


@every_function
def test_it_is_parsed_with_its_arguments_alone(function: Function) -> None:
    call = parse(function.format_call(*function.arguments), HERE)
    assert isinstance(call, Call) and (call.function, len(call.arguments)) == (function.name, len(function.arguments))
    with pytest.raises(ExpressionError, match=f"{function.name} takes"):
        parse(function.format_call(*names(function), "1"), HERE)


@every_function
def test_dimensions(function: Function) -> None:
    """Of arguments in metres; of one in seconds among them."""
    expected = {
        Units.SAME: LENGTH,
        Units.RATIO: DIMENSIONLESS,
        Units.CHOICE: LENGTH,
        Units.ROOT: parse_dimension("sqrt(1 m)"),
    }
    if function.units is Units.PURE:
        with pytest.raises(UnitError, match="pure number"):
            check_dimension(tree(function), None, lambda name: LENGTH, HERE)
        return
    assert check_dimension(tree(function), None, lambda name: LENGTH, HERE) == expected[function.units]
    if len(function.arguments) > 1:
        with pytest.raises(UnitError):
            check_dimension(tree(function), None, lambda name: TIME if name == "x1" else LENGTH, HERE)


@every_function
def test_values_follow_the_unit_of_length(function: Function) -> None:
    """In half metres lengths are twice as many, their ratios the same."""
    if function.units is not Units.PURE:
        factor = {Units.RATIO: 1.0, Units.ROOT: math.sqrt(2.0)}.get(function.units, 2.0)
        in_metres, in_half_metres = (values(function, unit * draw(function)) for unit in (1.0, 2.0))
        np.testing.assert_allclose(in_half_metres, factor * in_metres, rtol=1e-14)


def parse_dimension(text: str) -> Any:
    return check_dimension(parse(text, HERE), None, lambda name: None, HERE)


@every_function
def test_values_of_numpy_and_sympy(function: Function) -> None:
    """Outputs and the NumPy target against SymPy in 30 digits; undefined outside the domain."""
    expression, arguments = in_sympy(function), draw(function)
    exact = [
        float(expression.subs(dict(zip(sorted_symbols(function), map(sp.Float, row.tolist()), strict=True))).n(30))
        for row in arguments
    ]
    np.testing.assert_allclose(values(function, arguments), exact, rtol=1e-14, atol=1e-15)
    code = NumPyPrinter(Readable(())).doprint(expression)
    known = dict(zip(names(function), arguments.T, strict=True))
    np.testing.assert_allclose(eval(code, {"np": np}, known), exact, rtol=1e-13, atol=1e-14)  # noqa: S307
    low, high = function.domain
    for beyond in [x for x in (low - 0.1, high + 0.1) if math.isfinite(x)]:
        assert np.isnan(values(function, np.full(len(function.arguments), beyond)))


@every_function
def test_where_it_overflows_or_is_undefined(function: Function) -> None:
    """By values far from zero; by infinite ones if the function is smooth."""
    far = np.concatenate([100.0 * draw(function), -100.0 * draw(function)])
    if function.is_total:
        assert np.isfinite(values(function, far)).all()
    if function.in_sympy and function.jump_order is None:
        with np.errstate(all="ignore"):
            endless, large = (values(function, np.array(2 * [len(function.arguments) * [x]])) for x in (np.inf, 800.0))
            negative = values(function, np.array(2 * [len(function.arguments) * [-np.inf]]))
        assert function.saturates == (np.isfinite(endless) | np.isfinite(negative)).any()
        assert function.is_exponential == np.isinf(large).any()


@every_function
def test_slopes(function: Function) -> None:
    """SymPy's, and that of the table, against differences."""
    arguments, h = 0.98 * draw(function) + 0.02 * np.mean(interval(function)), 1e-5
    for k, symbol in enumerate(sorted_symbols(function)):
        if function.divides and k == len(function.arguments) - 1:
            continue
        ahead, behind = arguments.copy(), arguments.copy()
        ahead[:, k] += h
        behind[:, k] -= h
        differences = (values(function, ahead) - values(function, behind)) / (2.0 * h)
        slope = compute_partial_derivative(in_sympy(function), symbol).replace(sp.DiracDelta, lambda *x: 0)
        code = NumPyPrinter(Readable(())).doprint(slope)
        found = eval(code, {"np": np}, dict(zip(names(function), arguments.T, strict=True)))  # noqa: S307
        smooth = abs(differences) < 1e3
        np.testing.assert_allclose((found + 0.0 * differences)[smooth], differences[smooth], rtol=1e-5, atol=1e-7)
    for text in filter(None, (function.derivative, function.far_derivative)):
        x, f = sp.symbols("x f", real=True)
        known = {"x": arguments[:, 0], "f": values(function, arguments)}
        found = eval(NumPyPrinter(Readable(())).doprint(convert_derivative(text, x, f)), {"np": np}, known)  # noqa: S307
        np.testing.assert_allclose(found + 0.0 * differences, differences, rtol=1e-5, atol=1e-7)


@needs_node
@every_function
def test_javascript(function: Function) -> None:
    """Expressions of pages, and outputs by runtime/web/run.js."""
    program, arguments = node(), draw(function)
    assert program
    text = JavaScriptPrinter(Readable(()), set()).doprint(in_sympy(function))
    outputs = (ROOT / "runtime" / "web" / "run.js").read_text(encoding="utf-8").partition("const DECODED_TABLES")[0]
    code = f"""{PRELUDE}{outputs}
const tree = {json.dumps(to_json(tree(function)))};
const found = {json.dumps(arguments.tolist())}.map(([{", ".join(names(function))}]) =>
    [{text}, evaluateExpression(tree, (name) => ({{{", ".join(names(function))}}})[name])]);
console.log(JSON.stringify(found));"""
    done = subprocess.run([program, "-e", code], capture_output=True, text=True, check=True)
    found = np.array(json.loads(done.stdout))
    np.testing.assert_allclose(found.T, 2 * [values(function, arguments)], rtol=1e-13, atol=1e-14)


@every_function
def test_taylor_series(function: Function) -> None:
    """Coefficients against mpmath; what changes over has none."""
    middle = [sp.Rational(sum(interval(function)) / 2.0 + 0.1) + moves for moves in (X, Y, X, Y)]
    expression = in_sympy(function).subs(dict(zip(sorted_symbols(function), middle, strict=False)))
    if function.jump_order is not None:
        with pytest.raises(NoTaylorSeries):
            coefficients(expression, 1)
        return
    exact = sp.lambdify((X, Y), expression, "mpmath")
    with mpmath.workdps(40):
        x, y = ([mpmath.mpf(c) for c in reversed(some)] for some in MOTION)
        expected = mpmath.taylor(lambda t: exact(mpmath.polyval(x, t), mpmath.polyval(y, t)), 0, 8)
    assert coefficients(expression, 8) == pytest.approx([float(c) for c in expected], rel=1e-12, abs=1e-13)


@every_function
def test_documents(function: Function) -> None:
    """LaTeX and text name it; MathML can be made of the LaTeX."""
    expression = in_sympy(function)
    latex, text = TexPrinter({}, {}).doprint(expression), TextPrinter({}, {}).doprint(expression)
    assert function.latex in latex and (function.text or "") in text
    assert all(f"x_{{{k}}}" in latex and f"x{k}" in text for k in range(len(function.arguments)))
    mathml = pytest.importorskip("latex2mathml.converter")
    assert "merror" not in mathml.convert(latex)


def test_what_is_written_from_the_table_is_current() -> None:
    """`make tables` writes the header; the table of docs/format.md has a test of its own."""
    assert (ROOT / "engine" / "scene" / "function_table.h").read_text(encoding="utf-8") == print_function_table()

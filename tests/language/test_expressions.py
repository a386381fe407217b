"""The expression parser: against Python's own arithmetic, against hostile text, column by column."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from gudgeon.errors import ExpressionError, InputError, LimitError, Location, UnitError
from gudgeon.language.functions import FUNCTIONS
from gudgeon.language.parser import MAX_LENGTH, check_dimension, parse
from gudgeon.language.tree import Binary, Call, Expr, Name, Number, Unary, evaluate, from_json, to_json
from gudgeon.language.units import LENGTH

HERE = Location("file.yaml", 3, 10)
PRECEDENCE = {"+": 1, "-": 1, "*": 2, "/": 2, "**": 4}
VALUES = {"a": 1.5, "b_2": -0.75, "Long": 3.0}


def number(expr: Expr, **values: float) -> float:
    return float(evaluate(expr, {**VALUES, **values}.__getitem__))


def write(expr: Expr, above: int = 0, right: bool = False) -> str:
    """The tree as text with the fewest parentheses that our grammar, and Python's, need."""
    match expr:
        case Number(value=value):
            return repr(value)
        case Name(path=path):
            return path
        case Call(function="where", arguments=(a, b, *selected)):
            return f"where({write(a)} < {write(b)}, {', '.join(map(write, selected))})"
        case Call(function=function, arguments=arguments):
            return f"{function}({', '.join(write(a) for a in arguments)})"
        case Unary(operand=operand):
            text = f"-{write(operand, 3)}"
            return f"({text})" if above > 3 and not right else text
        case Binary(operator=operator, left=left, right=other):
            own = PRECEDENCE[operator]
            if operator == "**":
                text = f"{write(left, 5)}**{write(other, 4, True)}"
            else:
                text = f"{write(left, own)} {operator} {write(other, own + 1)}"
            return f"({text})" if own < above else text
    raise AssertionError


trees = st.recursive(
    st.one_of(
        st.floats(0, 1e6, allow_nan=False).filter(lambda x: x == 0 or x > 1e-6).map(Number),
        st.sampled_from(sorted(VALUES)).map(Name),
    ),
    lambda inner: st.one_of(
        inner.map(lambda x: Unary("-", x)),
        st.builds(Binary, st.sampled_from(sorted(PRECEDENCE)), inner, inner),
        st.builds(lambda f, a: Call(f, (a,)), st.sampled_from(["sin", "cos", "exp", "atan", "abs"]), inner),
        st.builds(lambda f, *a: Call(f, a), st.sampled_from(["atan2", "hypot", "min", "max", "mod"]), inner, inner),
        st.builds(lambda *a: Call("where", a), inner, inner, inner, inner),
    ),
    max_leaves=20,
)


@given(trees)
def test_written_trees_read_back(tree: Expr) -> None:
    assert to_json(parse(write(tree), HERE)) == to_json(tree)


@given(trees)
def test_against_pythons_own_arithmetic(tree: Expr) -> None:
    """Precedence and associativity are Python's: its eval, with NumPy's functions, gives the same number.

    But for the last bit: NumPy's power of scalars is not always that of arrays.
    """
    text = write(tree)
    functions = {name: function.evaluate for name, function in FUNCTIONS.items()} | {"either": either}
    values = {name: np.float64(value) for name, value in VALUES.items()}
    # every literal a NumPy number, so that overflow and 0/0 are inf and nan on both sides
    wrapped = write_wrapped(tree)
    with np.errstate(all="ignore"):
        expected = float(eval(wrapped, {"__builtins__": {}}, {**functions, **values, "F": np.float64}))  # noqa: S307
        found = number(parse(text, HERE))
    assert math.isclose(found, expected, rel_tol=1e-14) or (math.isnan(found) and math.isnan(expected))


def either(left: float, right: float, then: float, otherwise: float) -> float:
    """where(left < right, then, otherwise): no number where a comparison has none."""
    return math.nan if math.isnan(left) or math.isnan(right) else then if left < right else otherwise


def write_wrapped(tree: Expr) -> str:
    """`write`, with numbers as F(…) and where(…) as either(…)."""

    def wrap(expr: Expr) -> Expr:
        match expr:
            case Number(value=value):
                return Name(f"F({value!r})")
            case Unary(operator=operator, operand=operand):
                return Unary(operator, wrap(operand))
            case Binary(operator=operator, left=left, right=right):
                return Binary(operator, wrap(left), wrap(right))
            case Call(function=function, arguments=arguments):
                return Call("either" if function == "where" else function, tuple(wrap(a) for a in arguments))
        return expr

    return write(wrap(tree))


@given(st.text(max_size=60))
def test_any_text_parses_or_raises_an_input_error(text: str) -> None:
    try:
        parse(text, HERE)
    except InputError as error:
        assert error.where is not None and error.where.line == HERE.line
        assert HERE.column <= error.where.column <= HERE.column + len(text)


@given(st.text(alphabet="0123456789.eE+-*/() ,_^abtpimksrdgNP\u00b5", max_size=40))
def test_likely_text_parses_or_raises_an_input_error(text: str) -> None:
    try:
        tree = parse(text, HERE)
    except InputError as error:
        assert error.where is not None
        assert HERE.column <= error.where.column <= HERE.column + len(text)
    else:
        try:
            check_dimension(tree, LENGTH, lambda path: None, HERE)
        except UnitError as error:
            assert error.where is not None


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("80 mm", 0.08),
        ("0.3 mm", 0.0003),
        ("3.030e-4 kg*m^2", 3.030e-4),
        ("2*pi rad/s", math.tau),
        ("pi rad", math.pi),
        ("-39.52 deg", -math.radians(39.52)),
        ("100 1/s", 100.0),
        ("3 in", 0.0762),
        ("5 min", 300.0),
        ("80mm", 0.08),
        ("2e3mm", 2.0),
        ("2e3", 2000.0),
        ("-39.52deg", -math.radians(39.52)),
        ("0.1m/s * 2", 0.2),
        ("0bar", 0.0),
        ("2 ft + 1 inch", 0.635),
        ("2 lb + 5 grams", 0.91218474),
        ("2 lbf", 8.896443230521),
        ("3 kg m²", 3.0),
        ("3mm²", 3e-6),
        ("6 m/min(2, 3)", 3.0),
        ("5 \u00b5m + 5 \u03bcm", 1e-5),
        (".5 + 5. + 1e-1", 5.6),
        ("-2**2", -4.0),
        ("2**3**2", 512.0),
        ("2**-1", 0.5),
        ("-2**-2", -0.25),
        ("1 - 2 - 3", -4.0),
        ("8 / 4 / 2", 1.0),
        ("+-+3", -3.0),
        ("6 mm*a", 0.009),
        ("(3 mm)**2", 9e-6),
        ("1/(2 s)", 0.5),
        ("smooth_step(0.25, 0, 0.5 s) * 90 deg", math.pi / 4),
        ("ramp(3, 1, 4)", 0.5),
        ("min(1, 2) * max(3, 4)", 4.0),
    ],
)
def test_value(text: str, expected: float) -> None:
    assert number(parse(text, HERE)) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    ("text", "kind", "offset"),
    [
        ("", ExpressionError, 0),
        ("   ", ExpressionError, 3),
        ("1 +", ExpressionError, 3),
        ("(1 + 2", ExpressionError, 6),
        ("1 + 2)", ExpressionError, 5),
        ("a b_2", ExpressionError, 2),
        ("1 2", ExpressionError, 2),
        ("80mmm", ExpressionError, 2),
        ("2e", ExpressionError, 1),
        ("2a", ExpressionError, 1),
        ("2pi", ExpressionError, 1),
        ("3m**2", ExpressionError, 2),
        ("pi/4deg", ExpressionError, 3),
        ("0b1", ExpressionError, 0),
        ("3 N/m s", ExpressionError, 6),
        ("a²", ExpressionError, 1),
        ("80  mm", ExpressionError, 4),
        ("2 + 3 mm^12", UnitError, 6),
        ("2 a", UnitError, 2),
        ("2 pi", UnitError, 2),
        ("2 t", UnitError, 2),
        ("3 m**2", ExpressionError, 3),
        ("3 m ** 2", ExpressionError, 3),
        ("pi/4 deg", ExpressionError, 3),
        ("0x1F", ExpressionError, 0),
        ("0o17", ExpressionError, 0),
        ("1 + 017", ExpressionError, 4),
        ("1_000", ExpressionError, 1),
        ("1e999", ExpressionError, 0),
        ("1e-999", ExpressionError, 0),
        ("1e99999999999", ExpressionError, 0),
        ("1e308 km", ExpressionError, 0),
        ("true", ExpressionError, 0),
        ("null", ExpressionError, 0),
        (".inf", ExpressionError, 0),
        ("nan", ExpressionError, 0),
        ("~", ExpressionError, 0),
        ("omega.__class__", ExpressionError, 6),
        ("a.b.__init__", ExpressionError, 4),
        ("__import__", ExpressionError, 0),
        ("_private", ExpressionError, 0),
        ("a[0]", ExpressionError, 1),
        ("a < b_2", ExpressionError, 2),
        ("a == b_2", ExpressionError, 2),
        ("'a'", ExpressionError, 0),
        ("lambda: 0", ExpressionError, 0),
        ("1 if a else 2", ExpressionError, 2),
        ("a ^ 2", ExpressionError, 2),
        ("a % 2", ExpressionError, 2),
        ("\u2212 2", ExpressionError, 0),
        ("1\t+ 2", ExpressionError, 1),
        ("foo(1)", ExpressionError, 0),
        ("a(1)", ExpressionError, 0),
        ("sin", ExpressionError, 0),
        ("2 * sin(1, 2)", ExpressionError, 4),
        ("atan2(1)", ExpressionError, 0),
        ("smooth_step(t, 1)", ExpressionError, 0),
        ("sin()", ExpressionError, 4),
        ("a,", ExpressionError, 1),
        ("1; 2", ExpressionError, 1),
    ],
)
def test_refused_at_its_column(text: str, kind: type[InputError], offset: int) -> None:
    with pytest.raises(InputError) as caught:
        parse(text, HERE)
    error = caught.value
    assert error.where == Location("file.yaml", 3, 10 + offset)
    # "1 if …" reads "if" as a unit first; both classes say that it is no expression
    assert type(error) is kind or (text.startswith("1 if") and isinstance(error, UnitError))


@pytest.mark.parametrize(
    "text",
    [
        "1" + "+1" * 25000,
        "(" * 60 + "1" + ")" * 60,
        "-" * 200 + "1",
        "2**" * 100 + "2",
        "1" + "+1" * 6000,
        "sin(" * 80 + "1" + ")" * 80,
        "a" * (MAX_LENGTH + 1),
    ],
)
def test_bounds(text: str) -> None:
    with pytest.raises(LimitError):
        parse(text, HERE)


def test_wide_expressions_are_bounded_too() -> None:
    def balanced(depth: int) -> str:
        return "a" if depth == 0 else f"({balanced(depth - 1)}+{balanced(depth - 1)})"

    parse(balanced(6), HERE)
    with pytest.raises(LimitError):
        parse(balanced(14), HERE)


@pytest.mark.parametrize("count", [2, 50, 51, 52, 1000])
@pytest.mark.parametrize("signs", ["+", "-", "+-", "*", "/", "*/", "+-*/"])
def test_depth_is_that_of_nesting(signs: str, count: int) -> None:
    """Sums and products have any number of terms; up to 50 they are computed from left to right."""
    draw = np.random.default_rng(count)
    values = (1.0 + 0.1 * draw.random(count)).round(6)
    terms = zip(draw.choice([*signs], count - 1), values[1:].tolist(), strict=True)
    written = str(values[0]) + "".join(f" {sign} {value}" for sign, value in terms)
    tree = parse(written, HERE)
    assert number(tree) == pytest.approx(eval(written), rel=1e-12, abs=0.0 if count <= 50 else 1e-12)
    assert count > 50 or signs == "+-*/" or number(tree) == eval(written)
    nested = parse(f"where(a < ({written})*2, sin({written}), ({written})**2)", HERE)
    assert number(from_json(json.loads(json.dumps(to_json(nested))))) == number(nested)


@given(trees, st.integers(-3, 3))
def test_scaling_the_unit_scales_the_value(tree: Expr, power: int) -> None:
    """`(tree) * 1 km^n` is 1000ⁿ times the tree, whatever the tree."""
    value = number(parse(write(tree), HERE))
    assume(math.isfinite(value) and 1e-200 < abs(value) < 1e200 and power)
    scaled = number(parse(f"({write(tree)}) * 1 km^{power}", HERE))
    assert scaled == pytest.approx(value * 1000.0**power, rel=1e-14)

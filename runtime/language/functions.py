"""Define the functions that expressions may use, one table entry each; all other code reads this table.

| field | who reads it |
|---|---|
| name, arguments, usage, copies | the parser of expressions |
| units, is_angle | the checks of dimensions, the units of outputs |
| numpy, compute | values of outputs and parameters, the NumPy target; JavaScript's `Math` has the name of the file |
| sympy, derivative, far_derivative | SymPy, Taylor series, slopes (`generator/symbols`, `generator/ir`) |
| c, has_vector_code, bounds, domain | C for numbers, vectors and ranges (`engine/scene/function_table.h`) |
| latex, text | documents of equations |
| jump_order, divides, hides_switching_points, is_total, saturates, is_exponential, has_pole | tests whether an \
expression may jump, overflow or be undefined |
| meaning | docs/format.md |

`make tables` writes the header of the engine and the table of docs/format.md. `tests/functions` evaluates
every function in every target.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from typing import Any

import numpy as np


class Units(Enum):
    """Classify a function by the dimensions of its arguments and value."""

    PURE = "pure numbers give a pure number"
    SAME = "arguments and value have one dimension"
    RATIO = "arguments have one dimension, the value is a pure number"
    ROOT = "the value has the root of the argument's dimension"
    CHOICE = "the first two have one dimension; the others and the value have one"


@dataclass(frozen=True, eq=False, repr=False)
class Rising:
    """Bounds of a monotonically increasing function, for interval arithmetic.

    Its slope increases or decreases on each side of at most one point. slope: C code of the derivative in x, where the
    derivative as written cancels digits.
    """

    slope_extremum: float = math.nan
    slope: str = ""


@dataclass(frozen=True, eq=False, repr=False)
class Function:
    """Declaration of a function of expressions.

    sympy, c, numpy, text: its name there if it differs; latex: where SymPy's own LaTeX is not used. sympy None: SymPy
    has no such class; generator/symbols/from_expressions.py composes it of powers and functions. compute: values by
    NumPy where NumPy has no such function. derivative: of a function of one argument, as files write it, of the
    argument `x` and the function's value `f`. far_derivative: the same without the square of an argument, which may
    overflow where the derivative matters. domain: outside it the function is undefined. bounds: None where
    engine/watch/ranges.h has `interval_` and the C name. has_vector_code: engine/batch/lane_functions.h has `lanes_`
    and the C name; else lane after lane calls the library. jump_order: order of the lowest derivative that jumps at a
    switching point; None: smooth in its domain. is_total: defined and finite for all numbers. saturates: finite where
    its argument is infinite. divides: by its last argument. hides_switching_points: a smooth argument may
    give a value whose slope jumps, as acos(cos t) does. copies: number of occurrences of each argument in the formula
    of generator/symbols. usage: the hint after a wrong call.
    """

    name: str
    meaning: str
    arguments: tuple[str, ...] = ("x",)
    units: Units = Units.PURE
    sympy: str | None = ""
    c: str = ""
    numpy: str = ""
    compute: Callable[..., Any] | None = None
    derivative: str = ""
    far_derivative: str = ""
    domain: tuple[float, float] = (-math.inf, math.inf)
    bounds: Rising | None = None
    has_vector_code: bool = False
    latex: str = ""
    text: str = ""
    jump_order: int | None = None
    is_total: bool = False
    is_angle: bool = False
    saturates: bool = False
    is_exponential: bool = False
    has_pole: bool = False
    hides_switching_points: bool = False
    divides: bool = False
    copies: int = 1
    usage: str = ""

    def format_call(self, *arguments: str) -> str:
        """Return a call of the function as text: "hypot(a, b)"; of `where` with "<" between the first two arguments."""
        if self.units is Units.CHOICE:
            arguments = (" < ".join(arguments[:2]), *arguments[2:])
        return f"{self.name}({', '.join(arguments)})"

    @property
    def in_sympy(self) -> str:
        """Return the name of SymPy's class for the function; "" if SymPy has none."""
        return "" if self.sympy is None else self.sympy or self.name

    @property
    def in_c(self) -> str:
        """Return the name of the function in C code."""
        return self.c or self.name

    @property
    def in_numpy(self) -> str:
        """Return the name of NumPy's function, which `compute` replaces where NumPy has none."""
        return self.numpy or self.name

    @cached_property
    def evaluate(self) -> Callable[..., Any]:
        """Return the Python function that computes values for numbers or arrays."""
        return self.compute or getattr(np, self.in_numpy)

    @property
    def squares_argument(self) -> bool:
        """Return whether the derivative contains the square of the argument, which may overflow."""
        return "x**2" in self.derivative


def smooth_step(t: Any, start: Any, duration: Any) -> Any:
    """Return 0 up to `start`, 1 from `start + duration`, between them 10s³ − 15s⁴ + 6s⁵ (C² at both ends)."""
    s = ramp(t, start, duration)
    return s**3 * (10.0 + s * (6.0 * s - 15.0))


def ramp(t: Any, start: Any, duration: Any) -> Any:
    """Return 0 up to `start`, 1 from `start + duration`, linear between them (its rate jumps at both ends)."""
    return np.clip((t - start) / duration, 0.0, 1.0)


def where(left: Any, right: Any, then: Any, otherwise: Any) -> Any:
    """Return `then` where left < right, else `otherwise`; NaN where left or right is NaN."""
    undefined = np.isnan(left) | np.isnan(right)
    return np.where(undefined, np.nan, np.where(np.less(left, right), then, otherwise))[()]


def mod(a: Any, b: Any) -> Any:
    """Return the remainder of a after the last whole multiple of b: from 0 to b, with the sign of b."""
    return np.mod(a, b)


_HALF_LINE, _UNIT = (0.0, math.inf), (-1.0, 1.0)
_STEP = "smooth_step(t, start, duration) increases from 0 to 1"
# all functions, in the order of docs/format.md
_TABLE = (
    Function("sin", "sine", derivative="cos(x)", has_vector_code=True, is_total=True),
    Function("cos", "cosine", derivative="-sin(x)", has_vector_code=True, is_total=True),
    Function("tan", "tangent", derivative="1 + f**2", has_pole=True, hides_switching_points=True),
    Function(
        "asin",
        "arc sine, from −π/2 to π/2",
        numpy="arcsin",
        derivative="1/sqrt(1 - x**2)",
        domain=_UNIT,
        bounds=Rising(0.0),
        is_angle=True,
        hides_switching_points=True,
    ),
    Function(
        "acos",
        "arc cosine, from 0 to π",
        numpy="arccos",
        derivative="-1/sqrt(1 - x**2)",
        domain=_UNIT,
        is_angle=True,
        hides_switching_points=True,
    ),
    Function(
        "atan",
        "arc tangent, from −π/2 to π/2",
        numpy="arctan",
        derivative="1/(1 + x**2)",
        bounds=Rising(0.0),
        is_total=True,
        is_angle=True,
        saturates=True,
        hides_switching_points=True,
    ),
    Function(
        "atan2",
        "direction of the vector (x, y), from −π to π",
        ("y", "x"),
        Units.RATIO,
        numpy="arctan2",
        latex=r"\mathrm{atan2}",
        is_angle=True,
        saturates=True,
        hides_switching_points=True,
    ),
    Function("sinh", "hyperbolic sine", derivative="cosh(x)", bounds=Rising(0.0), is_total=True, is_exponential=True),
    Function("cosh", "hyperbolic cosine", derivative="sinh(x)", is_total=True, is_exponential=True),
    Function(
        "tanh",
        "hyperbolic tangent",
        derivative="1 - f**2",
        bounds=Rising(0.0, "1.0 / pow(cosh(x), 2.0)"),
        is_total=True,
        saturates=True,
    ),
    Function(
        "asinh",
        "inverse hyperbolic sine",
        numpy="arcsinh",
        derivative="1/sqrt(1 + x**2)",
        far_derivative="2/(exp(f) + exp(-f))",
        bounds=Rising(0.0),
        text="arsinh",
        is_total=True,
    ),
    Function(
        "acosh",
        "inverse hyperbolic cosine, from 0 on",
        numpy="arccosh",
        derivative="1/sqrt(x**2 - 1)",
        domain=(1.0, math.inf),
        bounds=Rising(),
        text="arcosh",
        hides_switching_points=True,
    ),
    Function(
        "atanh",
        "inverse hyperbolic tangent",
        numpy="arctanh",
        derivative="1/(1 - x**2)",
        domain=_UNIT,
        bounds=Rising(0.0),
        text="artanh",
        has_pole=True,
        hides_switching_points=True,
    ),
    Function("exp", "eˣ", derivative="f", has_vector_code=True, saturates=True, is_exponential=True),
    Function(
        "log",
        "natural logarithm",
        derivative="1/x",
        domain=_HALF_LINE,
        has_vector_code=True,
        has_pole=True,
        hides_switching_points=True,
    ),
    Function("sqrt", "square root", units=Units.ROOT, sympy=None, domain=_HALF_LINE, hides_switching_points=True),
    Function("hypot", "length of the vector (a, b)", ("a", "b"), Units.SAME, sympy=None, hides_switching_points=True),
    Function(
        "abs",
        "absolute value",
        units=Units.SAME,
        sympy="Abs",
        c="fabs",
        has_vector_code=True,
        jump_order=1,
        is_total=True,
    ),
    Function(
        "sign",
        "−1, 0 or 1",
        units=Units.RATIO,
        c="sign_of",
        has_vector_code=True,
        latex=r"\operatorname{sgn}",
        text="sgn",
        jump_order=0,
        is_total=True,
    ),
    Function(
        "min",
        "the smaller one",
        ("a", "b"),
        Units.SAME,
        sympy="Min",
        c="min_of",
        numpy="minimum",
        has_vector_code=True,
        latex=r"\operatorname{min}",
        text="min",
        jump_order=1,
        is_total=True,
    ),
    Function(
        "max",
        "the larger one",
        ("a", "b"),
        Units.SAME,
        sympy="Max",
        c="max_of",
        numpy="maximum",
        has_vector_code=True,
        latex=r"\operatorname{max}",
        text="max",
        jump_order=1,
        is_total=True,
    ),
    Function(
        "smooth_step",
        "from 0 to 1 with continuous accelerations",
        ("t", "start", "duration"),
        Units.RATIO,
        sympy=None,
        compute=smooth_step,
        jump_order=3,
        divides=True,
        copies=3,
        usage=_STEP,
    ),
    Function(
        "ramp",
        "from 0 to 1 along a line",
        ("t", "start", "duration"),
        Units.RATIO,
        sympy=None,
        compute=ramp,
        jump_order=1,
        divides=True,
        usage=_STEP,
    ),
    Function(
        "where",
        "`then` while the comparison (`<`, `<=`, `>` or `>=`) is true",
        ("a", "b", "then", "otherwise"),
        Units.CHOICE,
        sympy=None,
        compute=where,
        jump_order=0,
        usage="where(t < 1 s, then, otherwise) is `then` while the comparison is true",
    ),
    Function(
        "mod",
        "remainder of a divided by b, from 0 to b",
        ("a", "b"),
        Units.SAME,
        sympy=None,
        compute=mod,
        jump_order=0,
        divides=True,
        copies=2,
        usage="mod(t, 1 s) restarts at 0 each second",
    ),
)
# functions by the name that files use
FUNCTIONS: Mapping[str, Function] = {function.name: function for function in _TABLE}
# functions by the name of their SymPy class
IN_SYMPY: Mapping[str, Function] = {function.in_sympy: function for function in _TABLE if function.in_sympy}


def select_function_names(predicate: Callable[[Function], bool]) -> frozenset[str]:
    """Return the names of the functions in the table for which `predicate` is true."""
    return frozenset(function.name for function in _TABLE if predicate(function))


WITH_SWITCHING_POINTS = select_function_names(
    lambda f: f.jump_order in (0, 1)
)  # functions whose value or slope jumps: steps end there
JUMPING = select_function_names(lambda f: f.jump_order == 0)  # functions whose value jumps
PIECEWISE = select_function_names(lambda f: f.jump_order is not None)  # functions with a derivative that jumps

"""Prints SymPy expressions and values of generated functions as C11, in lines of at most WIDTH characters."""

from __future__ import annotations

import math
import re
import sys
import textwrap

import sympy as sp
from sympy.printing.c import C99CodePrinter

from gudgeon.generator.ir.expression_structure import find_expression_structure
from gudgeon.generator.ir.readable import Readable, convert_to_fraction_of_pi
from gudgeon.generator.ir.values import Conditional, ContinuedSum, ParameterOrDefault, Sum, Test, Threshold, Value
from gudgeon.generator.symbols.curves import ContourOf, CurveOf, CurveOn, KnotsOf, make_curve_name
from gudgeon.generator.symbols.from_expressions import CLASSES
from gudgeon.generator.symbols.storage import PARAMETERS, Key, Result, StorageLocation, find_value_key
from gudgeon.generator.targets import line_breaks
from gudgeon.generator.targets.cached_printer import CachedPrinter

_PLAIN = Readable(())
_TEMPLATES: dict[tuple[type, int], str] = {}  # (class of printer, number of structure) -> text with {k} for symbol k


class CPrinter(CachedPrinter, C99CodePrinter):
    """Print expressions as C: doubles that round-trip, small powers as products, min and max that propagate NaN.

    `readable_lines`: the readable lines of the printed function, with the names of its symbols and branches.
    """

    def __init__(self, readable_lines: Readable = _PLAIN) -> None:
        super().__init__({"math_macros": {}})  # M_PI_2 and the like are not in C11
        self.readable = readable_lines

    def doprint(self, expr: sp.Expr) -> str:
        """Return an expression as C. Raises ValueError for an operation that C does not have."""
        return self.print_by_structure(sp.sympify(expr))

    def print_by_structure(self, expr: sp.Expr) -> str:
        """Print an expression; those that differ in their symbols only are printed once by SymPy, as a template."""
        if (found := find_expression_structure(expr)) is None:
            return self._print(expr)
        structure, keys = found
        template = _TEMPLATES.get((type(self), structure))
        if template is None:
            names: dict[Key, Key] = {key: f"{{{k}}}" for k, key in enumerate(keys)}
            template = _TEMPLATES[type(self), structure] = self.make_printer(Readable((), names))._print(expr)
        return template.format(*map(self.get_name, keys))

    def make_printer(self, readable_lines: Readable) -> CPrinter:
        """Return a printer of the same class for other names."""
        return type(self)(readable_lines)

    def get_name(self, key: Key) -> str:
        """Return the C name of a symbol, local or place in this function."""
        c_name_or_place = self.readable.names.get(key, key)
        return (
            self.print_storage_location(c_name_or_place)
            if isinstance(c_name_or_place, StorageLocation)
            else c_name_or_place
        )

    def print_storage_location(self, place: StorageLocation) -> str:
        """Return a storage location as an lvalue in C: a result as `*name`, members by `->`, `.` or index."""
        if isinstance(place, Result):
            return f"*{place.base}"
        text = place.base if place.path else self.get_name(place.base)
        for step in place.path:
            arrow = "->" if text == place.base else "."
            text += f"[{step}]" if isinstance(step, int) else f"{arrow}{step}"
        return text

    def _print_Symbol(self, expr: sp.Symbol) -> str:
        """Print a symbol by its name in the function."""
        return self.get_name(find_value_key(expr))

    def parenthesize(self, item: sp.Expr, level: float, strict: bool = False) -> str:
        """Print an operand, in brackets if its precedence is lower than `level`, or equal unless `strict`.

        A positive rational number that is printed without a quotient gets no brackets. A number that is printed as a
        fraction of π, such as 2*PI/3, always gets them.
        """
        if item.is_Float and (fraction := convert_to_fraction_of_pi(item)) and not fraction.is_pi:
            return f"({self._print(item)})"
        if item.is_Rational and item.p > 0 and "/" not in (text := self._print(item)):
            return text
        return super().parenthesize(item, level, strict)

    def _print_Float(self, expr: sp.Float) -> str:
        """Print a float, a fraction of π as such."""
        fraction = convert_to_fraction_of_pi(expr)
        return fraction.format("PI", ".0") if fraction else _print_double(expr)

    def _print_NumberSymbol(self, expr: sp.NumberSymbol) -> str:
        """Print a constant such as e as a double."""
        return repr(float(expr))

    _print_Exp1 = _print_NumberSymbol

    def _print_Pi(self, expr: sp.Expr) -> str:
        """Print π."""
        return "PI"

    def _print_Integer(self, expr: sp.Integer) -> str:
        """Print an integer as a double."""
        return f"{int(expr)}.0" if abs(int(expr)) < 10**300 else _print_double(expr)

    def _print_int(self, expr: int) -> str:
        """Print a Python integer as a double."""
        return f"{expr}.0"

    def _print_Rational(self, expr: sp.Rational) -> str:
        """Print a rational number as a quotient of doubles, "1.0/3.0", or as a double if that is exact.

        It is exact if the denominator is a power of two. A numerator or denominator above 10¹⁵ rounds the quotient to a
        double.
        """
        if max(abs(int(expr.p)), int(expr.q)) > 10**15:
            return _print_double(expr)
        p, q = int(expr.p), int(expr.q)
        return repr(p / q) if q & (q - 1) == 0 else f"{p}.0/{q}.0"

    def _print_Mul(self, expr: sp.Mul) -> str:
        """Print a product; a coefficient that is not a normal double is split into two factors, first and last.

        A rational multiple of π is printed as a fraction of PI if that has the same bits.
        """
        if text := self.print_symbol_product(expr):
            return text
        if fraction := convert_to_fraction_of_pi(expr):
            return fraction.format("PI", ".0")
        number, other_factors = expr.as_coeff_Mul()
        if is_normal(number):
            return str(super()._print_Mul(expr))
        first, last = split_number(number)
        return f"{self._print(first)} * ({self._print(other_factors)}) * {self._print(last)}"

    def _print_Pow(self, expr: sp.Pow) -> str:
        """Print a power: exponents ±2 to ±4 as products, −1 as a quotient, ±1/2 by sqrt(), others by pow()."""
        base, exponent = expr.as_base_exp()
        if exponent.is_Integer and 2 <= abs(int(exponent)) <= 4:
            factor = self.parenthesize(base, 50)
            product = " * ".join([factor] * abs(int(exponent)))
            return f"({product})" if exponent > 0 else f"1.0/({product})"
        if exponent == -1:
            return f"1.0/{self.parenthesize(base, 60)}"
        if exponent == sp.Rational(1, 2):
            return self._print_call("sqrt", base)
        if exponent == sp.Rational(-1, 2):
            return f"1.0/{self._print_call('sqrt', base)}"
        return self._print_call("pow", base, exponent)

    def _print_call(self, function_name: str, *arguments: sp.Expr) -> str:
        """Print a call of a C function with its arguments."""
        return f"{function_name}({', '.join(map(self._print, arguments))})"

    def _print_nested_calls(self, function_name: str, expr: sp.Expr) -> str:
        """Print an associative function as nested calls of two arguments, such as max_of(max_of(x, y), 0.0).

        Numbers come last, since max_of(x, 0.0) returns NaN for x = NaN.
        """
        arguments = sorted(expr.args, key=lambda a: (a.is_Number, str(a)))
        text = self._print(arguments[0])
        for argument in arguments[1:]:
            text = f"{function_name}({text}, {self._print(argument)})"
        return text

    def _print_table_function(self, expr: sp.Expr) -> str:
        """Print a function of the table of functions (gudgeon.language.functions) by its C name.

        A minimum or maximum of several arguments becomes nested calls.
        """
        name = CLASSES[type(expr)].in_c
        return (
            self._print_nested_calls(name, expr)
            if isinstance(expr, (sp.Max, sp.Min))
            else self._print_call(name, *expr.args)
        )

    def _print_ComparedMagnitude(self, expr: sp.Expr) -> str:
        """Print an absolute value."""
        return self._print_call("fabs", expr.args[0])

    def _print_Unevaluated(self, expr: sp.Expr) -> str:
        """Print an unevaluated operand (symbols/unevaluated.py) in brackets."""
        return f"({self._print(expr.args[0])})"

    _print_UnevaluatedQuotient = _print_Unevaluated

    def _print_Heaviside(self, expr: sp.Expr) -> str:
        """Print a step function, 1 at 0, so that a ramp that begins at the start moves at once."""
        return f"({self._print(expr.args[0])} >= 0.0 ? 1.0 : 0.0)"

    def _print_BranchOf(self, expr: sp.Expr) -> str:
        """Print the active branch of a switching function (symbols/switches.py): frozen, or the sign of its value."""
        return f"branch_of(branch, g, {self.print_switch_index(int(expr.args[0]))}, {self._print(expr.args[1])})"

    def print_switch_index(self, index: int) -> str:
        """Return the index of a switching function in C: "5", or "corner + 2" in a function that joints share.

        `corner` is then the argument with the index of the calling joint's first switching function.
        """
        if self.readable.first_switch is None:
            return str(index)
        offset = index - self.readable.first_switch
        return f"corner + {offset}" if offset else "corner"

    def _print_Magnitude(self, expr: sp.Expr) -> str:
        """Print an absolute value that is never 0 (symbols/switches.py)."""
        return f"(fabs({self._print(expr.args[0])}) + 1e-150)"

    def _print_Select(self, expr: sp.Expr) -> str:
        """Print Select(branch, a, b) as a conditional expression: b for branch < 0, else a (also for NaN).

        If `readable.branches` contains the expression, the name of its local is printed.
        """
        if expr in self.readable.branches:
            return self.readable.branches[expr]
        branch, a, b = (self._print(argument) for argument in expr.args)
        return f"({branch} < 0.0 ? {b} : {a})"

    def _print_CurveOf(self, expr: CurveOf) -> str:
        """Print the value of a curve or its derivative (symbols/curves.py)."""
        return f"curve({make_curve_name(expr.name)}, {expr.order}, {self._print(expr.args[2])})"

    def _print_CurveOn(self, expr: CurveOn) -> str:
        """Print the value of a curve, or its derivative, on the piece that its frozen branch selects."""
        x, branch = map(self._print, expr.args[2:])
        return f"curve_on({make_curve_name(expr.name)}, {expr.order}, {x}, {branch})"

    def _print_KnotsOf(self, expr: KnotsOf) -> str:
        """Print the event function of a curve's knots."""
        return f"knots({make_curve_name(expr.name)}, {self._print(expr.args[1])})"

    def _print_ContourOf(self, expr: ContourOf) -> str:
        """Print the depth of a contour or its derivative (symbols/curves.py)."""
        table, angle = self.get_name(StorageLocation(PARAMETERS)[expr.table]), self._print(expr.args[3])
        return f"evaluate_contour({table}, {expr.count}, {expr.order}, {angle})"

    def _print_ModOf(self, expr: sp.Expr) -> str:
        """Print a remainder (symbols/switches.py)."""
        return self._print_call("mod_of", *expr.args)

    def _print_ModOn(self, expr: sp.Expr) -> str:
        """Print a remainder on the period that its branch selects."""
        return self._print_call("mod_on_branch", *expr.args)

    def _print_PeriodsOf(self, expr: sp.Expr) -> str:
        """Print the event function of a remainder's periods."""
        return self._print_call("mod_switching_function", *expr.args)

    def _print_Slope(self, expr: sp.Expr) -> str:
        """Print a derivative, or a difference quotient where it is not finite (symbols/finite_slopes.py)."""
        return self._print_call("finite_slope", *expr.args)

    def _print_NextAbove(self, expr: sp.Expr) -> str:
        """Print a value slightly above its argument."""
        return self._print_call("slightly_above", expr.args[0])

    def _print_NextBelow(self, expr: sp.Expr) -> str:
        """Print a value slightly below its argument."""
        return self._print_call("slightly_below", expr.args[0])


def is_normal(number: sp.Expr) -> bool:
    """Return whether a number is in the range of normal doubles (binary64), or 0; `split_number` splits others.

    Integers below 1e15 are not converted. The function of this name in C (engine/scene/functions.h) is false for 0.
    """
    return (
        number.is_Integer
        and abs(int(number)) < 10**15
        or sys.float_info.min <= abs(_convert_to_float(number)) < math.inf
    )


def split_number(number: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Return two factors, of similar magnitude, of a number outside the range of normal doubles.

    The first is a float of 17 digits, the second a power of two.
    """
    power_of_two = sp.Integer(2) ** (int(sp.floor(sp.log(abs(number), 2).n())) // 2)
    return sp.Float(number, 17) / power_of_two, power_of_two


def _convert_to_float(number: sp.Expr) -> float:
    """Return a SymPy number as a Python float, from 17 digits."""
    return float(sp.Float(number, 17))


def _print_double(number: sp.Expr) -> str:
    """Return a number as a C double that round-trips; INFINITY with its sign if the number is too large."""
    value = _convert_to_float(number)
    return repr(value) if math.isfinite(value) else f"{'-' if value < 0 else ''}INFINITY"


class ValuePrinter:
    """Print values of kernels as C: places, conditions, sums, defaults and expressions."""

    def __init__(self, printer: CPrinter) -> None:
        self.printer = printer

    def print_expression(self, value: Value) -> str:
        """Return a value of a kernel as a C expression, by its class; other values are SymPy expressions."""
        match value:
            case StorageLocation():
                return self.printer.get_name(value)
            case Conditional():
                then, otherwise = self.print_expression(value.then), self.print_expression(value.otherwise)
                return f"{self.print_test(value.test)} ? {then} : {otherwise}"
            case Sum():
                return " + ".join(map(self.printer.get_name, value.places))
            case ContinuedSum():
                more = self.print_expression(value.more)
                sign, term = ("-", more[1:]) if more.startswith("-") else ("+", more)
                return f"{self.print_expression(value.first)} {sign} {term}"
            case ParameterOrDefault():
                return f"is_given[{value.k}] ? given[{value.k}] : {self.print_expression(value.default)}"
            case _:
                return self.printer.doprint(value)

    def print_test(self, test: Test) -> str:
        """Return a comparison as a C condition; a test without a relation is its value.

        A test that is relative to the value itself (`is_relative_to_value`) checks that the value is positive (with
        magnitudes: not 0) and finite.
        """
        value = self.print_expression(test.value)
        left_side = f"fabs({value})" if test.compares_magnitude else value
        if test.is_relative_to_value:
            return (
                f"{left_side} > 0.0 && {value} < INFINITY"
                if not test.compares_magnitude
                else f"{value} != 0.0 && isfinite({value})"
            )
        bound = " * ".join(map(self._print_bound_factor, test.bound))
        return f"{left_side} {test.relation} {bound}" if test.relation else left_side

    def _print_bound_factor(self, value: sp.Basic | float) -> str:
        """Return a factor of a test's bound as a C expression.

        A threshold is printed as its storage location if it has one, else as its macro in model.h. Other floats are
        printed as literals.
        """
        if isinstance(value, Threshold):
            return self.printer.get_name(value.storage_location) if value.storage_location else value.name
        return repr(value) if isinstance(value, float) else self.print_expression(value)


_text = ValuePrinter(CPrinter())
print_expression, print_test = _text.print_expression, _text.print_test


def sanitize_comment(text: str) -> str:
    """Return a user's text in ASCII so that it can neither end a C comment nor continue a line.

    "*/" and "/*" get a space, a backslash becomes "/". Characters that are not printable ASCII, and "?", become ".".
    """
    return (
        re.sub(r"[^\x20-\x7e]", "?", text)
        .replace("*/", "* /")
        .replace("/*", "/ *")
        .replace("\\", "/")
        .replace("?", ".")
    )


WIDTH = 120


def break_code(line: str) -> list[str]:
    """Return a line of C code as lines of at most WIDTH characters, as far as it can be broken (line_breaks.py)."""
    return line_breaks.break_code(line, WIDTH)


def wrap_file(text: str) -> str:
    """Return the text of a C file with no line longer than WIDTH: code is broken, comments are wrapped."""
    wrapped: list[str] = []
    in_comment = False
    for line in text.split("\n"):
        wrapped += _wrap_comment_line(line) if in_comment else _break_code_line(line)
        in_comment = line.rfind("/*") > line.rfind("*/") or in_comment and "*/" not in line
    return "\n".join(wrapped)


def _wrap_comment_line(line: str) -> list[str]:
    """Return a line inside a block comment as lines of at most WIDTH; lines without the prefix " * " are kept."""
    if len(line) <= WIDTH or not line.startswith(" * "):
        return [line]
    return textwrap.wrap(line[3:], WIDTH, initial_indent=" * ", subsequent_indent=" * ")


def _break_code_line(line: str) -> list[str]:
    """Return a line outside of block comments as lines of at most WIDTH; preprocessor directives stay long.

    A long comment becomes a block comment. A comment after code that is too long with it is put before the code.
    """
    if len(line) <= WIDTH:
        return [line]
    indent = line[: len(line) - len(line.lstrip())]
    if (stripped := line.strip()).startswith("/* ") and stripped.endswith(" */") and stripped.count("*/") == 1:
        prefix = f"{indent} * "
        comment_lines = textwrap.wrap(stripped[3:-3], WIDTH, initial_indent=prefix, subsequent_indent=prefix)
        return [f"{indent}/*", *comment_lines, f"{indent} */"]
    code, comment_start, comment = line.rpartition("/* ")
    if comment_start and comment.endswith(" */") and code.strip() and "/*" not in code:
        return [*_break_code_line(f"{indent}/* {comment}"), *_break_code_line(code.rstrip())]
    return [line] if line.startswith("#") else break_code(line)

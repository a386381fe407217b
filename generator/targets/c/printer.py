"""SymPy expressions and kernels as C11, in lines that fit a page."""

from __future__ import annotations

import math
import re
import sys
import textwrap

import sympy as sp
from sympy.printing.c import C99CodePrinter

from gudgeon.generator.ir.readable import Readable, share_of_pi
from gudgeon.generator.ir.values import Chosen, Given, Sum, Test, Threshold, Value
from gudgeon.generator.symbols.curves import ContourOf, CurveOf, CurveOn, KnotsOf, c_name
from gudgeon.generator.symbols.from_expressions import CLASSES
from gudgeon.generator.symbols.storage import PARAMETERS, Key, Place, Result, key_of
from gudgeon.generator.targets import breaks
from gudgeon.generator.targets.quick import Quick

_PLAIN = Readable(())


class CPrinter(Quick, C99CodePrinter):
    """C99 with doubles written to round-trip, small powers as products, NaN-keeping min and max.

    `of`: the function that is written, with what it calls its symbols and branches.
    """

    def __init__(self, of: Readable = _PLAIN) -> None:
        super().__init__({"math_macros": {}})  # M_PI_2 and the like are not in C11
        self.of = of

    def called(self, key: Key) -> str:
        """What a symbol, local or place is called in this function."""
        found = self.of.names.get(key, key)
        return self.place(found) if isinstance(found, Place) else found

    def place(self, place: Place) -> str:
        """Return the lvalue; arguments that are structs are pointers."""
        if isinstance(place, Result):
            return f"*{place.base}"
        text = place.base if place.path else self.called(place.base)
        for step in place.path:
            arrow = "->" if text == place.base else "."
            text += f"[{step}]" if isinstance(step, int) else f"{arrow}{step}"
        return text

    def _print_Symbol(self, expr: sp.Symbol) -> str:
        return self.called(key_of(expr))

    def parenthesize(self, item: sp.Expr, level: float, strict: bool = False) -> str:
        """A number such as 0.5 needs no brackets; 2*PI/3 in a product does, for it is one number."""
        if item.is_Float and (share := share_of_pi(item)) and not share.is_one:
            return f"({self._print(item)})"
        if item.is_Rational and item.p > 0 and "/" not in (text := self._print(item)):
            return text
        return super().parenthesize(item, level, strict)

    def _print_Float(self, expr: sp.Float) -> str:
        share = share_of_pi(expr)
        return share.text("PI", ".0") if share else _double(expr)

    def _print_NumberSymbol(self, expr: sp.NumberSymbol) -> str:
        return repr(float(expr))

    _print_Exp1 = _print_NumberSymbol

    def _print_Pi(self, expr: sp.Expr) -> str:
        return "PI"

    def _print_Integer(self, expr: sp.Integer) -> str:
        return f"{int(expr)}.0" if abs(int(expr)) < 10**300 else _double(expr)

    def _print_int(self, expr: int) -> str:
        return f"{expr}.0"

    def _print_Rational(self, expr: sp.Rational) -> str:
        if max(abs(int(expr.p)), int(expr.q)) > 10**15:
            return _double(expr)
        p, q = int(expr.p), int(expr.q)
        return repr(p / q) if q & (q - 1) == 0 else f"{p}.0/{q}.0"  # a power of two divides exactly

    def _print_Mul(self, expr: sp.Mul) -> str:
        """A coefficient that binary64 has not stands as two numbers, one on each side of what it is a factor of."""
        if share := share_of_pi(expr):
            return share.text("PI", ".0")
        number, rest = expr.as_coeff_Mul()
        if is_normal(number):
            return str(super()._print_Mul(expr))
        first, last = two_of(number)
        return f"{self._print(first)} * ({self._print(rest)}) * {self._print(last)}"

    def _print_Pow(self, expr: sp.Pow) -> str:
        base, exponent = expr.as_base_exp()
        if exponent.is_Integer and 2 <= abs(int(exponent)) <= 4:
            factor = self.parenthesize(base, 50)
            product = " * ".join([factor] * abs(int(exponent)))
            return f"({product})" if exponent > 0 else f"1.0/({product})"
        if exponent == -1:
            return f"1.0/{self.parenthesize(base, 60)}"
        if exponent == sp.Rational(1, 2):
            return self._call("sqrt", base)
        if exponent == sp.Rational(-1, 2):
            return f"1.0/{self._call('sqrt', base)}"
        return self._call("pow", base, exponent)

    def _call(self, function: str, *arguments: sp.Expr) -> str:
        return f"{function}({', '.join(map(self._print, arguments))})"

    def _nested(self, function: str, expr: sp.Expr) -> str:
        """Numbers come last: max_of(x, 0) keeps a NaN in x."""
        arguments = sorted(expr.args, key=lambda a: (a.is_Number, str(a)))
        text = self._print(arguments[0])
        for argument in arguments[1:]:
            text = f"{function}({text}, {self._print(argument)})"
        return text

    def _print_of_table(self, expr: sp.Expr) -> str:
        """Of the table of functions."""
        name = CLASSES[type(expr)].in_c
        return self._nested(name, expr) if isinstance(expr, (sp.Max, sp.Min)) else self._call(name, *expr.args)

    def _print_Size(self, expr: sp.Expr) -> str:
        return self._call("fabs", expr.args[0])

    def _print_Whole(self, expr: sp.Expr) -> str:
        """From wholes.py."""
        return f"({self._print(expr.args[0])})"

    _print_Share = _print_Whole

    def _print_Heaviside(self, expr: sp.Expr) -> str:
        """From the rates of ramps and corners; 1 at 0, so that a ramp that begins at the start moves at once."""
        return f"({self._print(expr.args[0])} >= 0.0 ? 1.0 : 0.0)"

    def _print_BranchOf(self, expr: sp.Expr) -> str:
        """From corners.py."""
        return f"branch_of(branch, g, {self.corner(int(expr.args[0]))}, {self._print(expr.args[1])})"

    def corner(self, index: int) -> str:
        """Its number, or how far behind the function's first one it is."""
        if self.of.first_corner is None:
            return str(index)
        further = index - self.of.first_corner
        return f"corner + {further}" if further else "corner"

    def _print_Magnitude(self, expr: sp.Expr) -> str:
        """From corners.py."""
        return f"(fabs({self._print(expr.args[0])}) + 1e-150)"

    def _print_Pick(self, expr: sp.Expr) -> str:
        """Not below zero picks the first: a NaN stays in it."""
        if expr in self.of.branches:
            return self.of.branches[expr]
        side, a, b = (self._print(argument) for argument in expr.args)
        return f"({side} < 0.0 ? {b} : {a})"

    def _print_CurveOf(self, expr: CurveOf) -> str:
        """From curves.py."""
        return f"curve({c_name(expr.name)}, {expr.order}, {self._print(expr.args[2])})"

    def _print_CurveOn(self, expr: CurveOn) -> str:
        x, side = map(self._print, expr.args[2:])
        return f"curve_on({c_name(expr.name)}, {expr.order}, {x}, {side})"

    def _print_KnotsOf(self, expr: KnotsOf) -> str:
        return f"knots({c_name(expr.name)}, {self._print(expr.args[1])})"

    def _print_ContourOf(self, expr: ContourOf) -> str:
        """From curves.py."""
        table, angle = self.called(Place(PARAMETERS)[expr.table]), self._print(expr.args[3])
        return f"contour({table}, {expr.count}, {expr.order}, {angle})"

    def _print_ModOf(self, expr: sp.Expr) -> str:
        """From corners.py."""
        return self._call("mod_of", *expr.args)

    def _print_ModOn(self, expr: sp.Expr) -> str:
        return self._call("mod_on", *expr.args)

    def _print_PeriodsOf(self, expr: sp.Expr) -> str:
        return self._call("period_branch", *expr.args)

    def _print_Slope(self, expr: sp.Expr) -> str:
        """From finite_slopes.py."""
        return self._call("finite_slope", *expr.args)

    def _print_JustAhead(self, expr: sp.Expr) -> str:
        return self._call("just_ahead", expr.args[0])

    def _print_JustBehind(self, expr: sp.Expr) -> str:
        return self._call("just_behind", expr.args[0])


def is_normal(number: sp.Expr) -> bool:
    """Whether binary64 has a number with all its digits."""
    return number.is_Integer and abs(int(number)) < 10**15 or sys.float_info.min <= abs(_value(number)) < math.inf


def two_of(number: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """Two numbers of about the same size, the second a power of two, whose product it is."""
    last = sp.Integer(2) ** (int(sp.floor(sp.log(abs(number), 2).n())) // 2)
    return sp.Float(number, 17) / last, last


def _value(number: sp.Expr) -> float:
    return float(sp.Float(number, 17))


def _double(number: sp.Expr) -> str:
    """A number as binary64; one that is too large is what the arithmetic of C would make of it."""
    value = _value(number)
    return repr(value) if math.isfinite(value) else f"{'-' if value < 0 else ''}INFINITY"


class Text:
    """Values of one function as text."""

    def __init__(self, printer: CPrinter) -> None:
        self.printer = printer

    def expression(self, value: Value) -> str:
        """C text of a value."""
        match value:
            case Place():
                return self.printer.called(value)
            case Chosen():
                then, otherwise = self.expression(value.then), self.expression(value.otherwise)
                return f"{self.test(value.test)} ? {then} : {otherwise}"
            case Sum():
                return " + ".join(map(self.printer.called, value.places))
            case Given():
                return f"is_given[{value.k}] ? given[{value.k}] : {self.expression(value.default)}"
            case _:
                return self.printer.doprint(value)

    def test(self, item: Test) -> str:
        """A comparison."""
        value = self.expression(item.value)
        left = f"fabs({value})" if item.size else value
        if item.of_itself:
            return f"{left} > 0.0 && {value} < INFINITY" if not item.size else f"{value} != 0.0 && isfinite({value})"
        bound = " * ".join(map(self._factor, item.bound))
        return f"{left} {item.relation} {bound}" if item.relation else left

    def _factor(self, value: sp.Basic | float) -> str:
        """Of a bound: model.h has the names of thresholds."""
        if isinstance(value, Threshold):
            return self.printer.called(value.place) if value.place else value.name
        return repr(value) if isinstance(value, float) else self.expression(value)


_text = Text(CPrinter())
expression, test = _text.expression, _text.test


def comment_text(text: str) -> str:
    """Text that cannot end a C comment or continue a line, in ASCII."""
    return (
        re.sub(r"[^\x20-\x7e]", "?", text)
        .replace("*/", "* /")
        .replace("/*", "/ *")
        .replace("\\", "/")
        .replace("?", ".")
    )


WIDTH = 120


def broken(line: str) -> list[str]:
    """A line of code as lines that fit."""
    return breaks.broken(line, WIDTH)


def within(text: str) -> str:
    """A whole file with no line over WIDTH: its code broken, its comments wrapped or put in front of what they tell."""
    found: list[str] = []
    in_comment = False
    for line in text.split("\n"):
        found += _comment(line) if in_comment else _fitting(line)
        in_comment = line.rfind("/*") > line.rfind("*/") or in_comment and "*/" not in line
    return "\n".join(found)


def _comment(line: str) -> list[str]:
    """A line of a comment of several."""
    if len(line) <= WIDTH or not line.startswith(" * "):
        return [line]
    return textwrap.wrap(line[3:], WIDTH, initial_indent=" * ", subsequent_indent=" * ")


def _fitting(line: str) -> list[str]:
    if len(line) <= WIDTH:
        return [line]
    indent = line[: len(line) - len(line.lstrip())]
    if (bare := line.strip()).startswith("/* ") and bare.endswith(" */") and bare.count("*/") == 1:
        star = f"{indent} * "
        told = textwrap.wrap(bare[3:-3], WIDTH, initial_indent=star, subsequent_indent=star)
        return [f"{indent}/*", *told, f"{indent} */"]
    code, mark, told_behind = line.rpartition("/* ")
    if mark and told_behind.endswith(" */") and code.strip() and "/*" not in code:
        return [*_fitting(f"{indent}/* {told_behind}"), *_fitting(code.rstrip())]
    return [line] if line.startswith("#") else broken(line)

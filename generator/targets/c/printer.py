"""SymPy expressions and kernels as C11."""

from __future__ import annotations

import math
import re
import sys
import textwrap
from collections.abc import Callable, Sequence

import sympy as sp
from sympy.printing.c import C99CodePrinter

from gudgeon.generator.ir.kernels import Argument, Kernel
from gudgeon.generator.ir.split import cut
from gudgeon.generator.ir.statements import (
    NONE,
    Call,
    Chosen,
    Declare,
    Ended,
    Given,
    Guard,
    Jump,
    Largest,
    LargestRow,
    Line,
    Passed,
    Place,
    Rescue,
    Return,
    RunNumbers,
    Sides,
    Sines,
    Statement,
    Status,
    Sum,
    Test,
    Unread,
    Value,
    When,
)  # fmt: skip

WIDTH = 110


class CPrinter(C99CodePrinter):
    """C99 with doubles written to round-trip, small powers as products, NaN-keeping min and max."""

    def _print_Float(self, expr: sp.Float) -> str:
        return _double(expr)

    def _print_NumberSymbol(self, expr: sp.NumberSymbol) -> str:
        return repr(float(expr))

    _print_Pi = _print_Exp1 = _print_NumberSymbol

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

    def _print_Max(self, expr: sp.Max) -> str:
        return self._nested("max_of", expr)

    def _print_Min(self, expr: sp.Min) -> str:
        return self._nested("min_of", expr)

    def _nested(self, function: str, expr: sp.Expr) -> str:
        """Numbers come last: max_of(x, 0) keeps a NaN in x."""
        arguments = sorted(expr.args, key=lambda a: (a.is_Number, str(a)))
        text = self._print(arguments[0])
        for argument in arguments[1:]:
            text = f"{function}({text}, {self._print(argument)})"
        return text

    def _print_Abs(self, expr: sp.Expr) -> str:
        return self._call("fabs", expr.args[0])

    _print_Size = _print_Abs

    def _print_Whole(self, expr: sp.Expr) -> str:
        """From wholes.py."""
        return f"({self._print(expr.args[0])})"

    def _print_sign(self, expr: sp.Expr) -> str:
        return self._call("sign_of", expr.args[0])

    def _print_Heaviside(self, expr: sp.Expr) -> str:
        """From the rates of ramps and corners; 1 at 0, so that a ramp that begins at the start moves at once."""
        return f"({self._print(expr.args[0])} >= 0.0 ? 1.0 : 0.0)"

    def _print_SideOf(self, expr: sp.Expr) -> str:
        """From switches.py."""
        return f"side_of(side, g, {int(expr.args[0])}, {self._print(expr.args[1])})"

    def _print_Magnitude(self, expr: sp.Expr) -> str:
        """From switches.py."""
        return f"(fabs({self._print(expr.args[0])}) + 1e-150)"

    def _print_Pick(self, expr: sp.Expr) -> str:
        """Not below zero picks the first: a NaN stays in it."""
        side, a, b = (self._print(argument) for argument in expr.args)
        return f"({side} < 0.0 ? {b} : {a})"

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


_printer = CPrinter({"math_macros": {}})  # M_PI_2 and the like are not in C11


def expression(value: Value) -> str:
    """C text of a value."""
    match value:
        case Place():
            return value.text
        case Chosen():
            return f"{test(value.test)} ? {expression(value.then)} : {expression(value.otherwise)}"
        case Sum():
            return " + ".join(place.text for place in value.places)
        case Given():
            return f"is_given[{value.k}] ? given[{value.k}] : {expression(value.default)}"
        case _:
            return _printer.doprint(value)


def test(item: Test) -> str:
    """A comparison; the numbers of its bound as they are."""
    left = f"fabs({expression(item.value)})" if item.size else expression(item.value)
    bound = " * ".join(repr(x) if isinstance(x, float) else expression(x) for x in item.bound)
    return f"{left} {item.relation} {bound}" if item.relation else left


def line(item: Line, number: str = "double") -> str:
    """Any line of a function; `number` is the type of locals."""
    if isinstance(item, Statement):
        return statement(item, number)
    return "\n".join(f"    {text}" for text in _lines(item))


def _lines(item: Line) -> Sequence[str]:
    match item:
        case Declare():
            return [f"{item.type} {item.name}{''.join(f'[{n}]' for n in item.sizes)};"]
        case Call():
            return [f"{_call(item)};"]
        case Guard():
            return [_guard(item)]
        case When():
            return [f"if ({test(item.test)})", f"    {statement(item.statement).lstrip()}"]
        case Return():
            return ["return pivot;" if item.pivot else "return 0;"]
        case Passed():
            return [f"{'' if item.status == 'pivot' else 'const int '}{item.status} = {_call(item.call)};"]
        case Ended():
            return [f"if ({item.status}) {'goto dependent' if item.jumps else f'return {item.status}'};"]
        case Sides():
            return _sides(item)
        case Sines():
            return _sines(item)
        case Rescue():
            return _rescue(item)
        case Largest():
            name = f"*{item.target}"
            return [f"{name} = 0.0;", *(f"{name} = max_of({name}, fabs({expression(x)}));" for x in item.values)]
        case LargestRow():
            return _largest_row(item)
    return [_PLAIN[type(item)].format(item)]


_PLAIN: dict[type, str] = {
    Status: "int pivot = 0;", Jump: "goto powers;", Unread: "(void){0.name};",
    RunNumbers: "const Parameters *const p = lin->p;",
}  # fmt: skip


def _call(item: Call) -> str:
    given = [_handed_over(x) if isinstance(x, Place) else expression(x) for x in item.given]
    return f"{item.function}({', '.join([*given, *map(_handed_over, item.results)])})"


def _handed_over(place: Place) -> str:
    """A struct within another one by its address, all else as it is."""
    return f"&{place.text}" if "->" in place.text else place.text


def _guard(item: Guard) -> str:
    fails = _call(item.test) if isinstance(item.test, Call) else f"!({test(item.test)})"
    only = f"{test(item.only)} && " if item.only else ""
    fail = f"{{ pivot = {item.number}; goto dependent; }}" if item.jumps else f"return {item.number}"
    return f"if ({only}{fails}) {fail};"


def _sides(item: Sides) -> list[str]:
    held = "memory->held ? memory->side : NULL;" if item.held else "NULL; /* of corners within corners: as they are */"
    told = {"": [], "nobody": ["double g[N_SWITCHES + 1];"], "aside": ["double *const g = aside->g;"]}[item.told]
    return [f"const double *const side = {held}", *told]


def _sines(item: Sines) -> list[str]:
    names, of = list(map(str, item.angles)), item.suffix
    if item.lanes:
        return [f"Lanes sines_{of}, cosines_{of};", f"sines_and_cosines({names[0]}, &sines_{of}, &cosines_{of}, rare);"]
    groups = [", ".join(names[k : k + 4]) for k in range(0, len(names), 4)]
    if item.count:
        values = ", ".join(f"{{{group}}}" for group in groups)
        return [
            f"const Four angles_{of}[{item.count}] = {{{values}}};",
            f"Four sines_{of}[{item.count}], cosines_{of}[{item.count}];",
            f"many_sines_and_cosines({item.count}, angles_{of}, sines_{of}, cosines_{of});",
        ]
    return [
        f"const Four angles_{of} = {{{groups[0]}}};", f"Four sines_{of}, cosines_{of};",
        f"sines_and_cosines(&angles_{of}, &sines_{of}, &cosines_{of});",
    ]  # fmt: skip


def _rescue(item: Rescue) -> list[str]:
    if not item.force:
        return ["dependent:", "pivot = solve_by_absolute(t, q, v, memory, p, a, aside);", "powers:"]
    given = (("force", item.force), ("rhs", item.rhs))
    values = [Statement(f"    {name}[{k}]", x, False) for name, some in given for k, x in enumerate(some)]
    return [
        "dependent: {", "    double force[N_Q], rhs[N_ROWS];", *(statement(x)[4:] for x in values),
        "    pivot = solve_dependent(t, q, p, force, rhs, a, aside->lambda, pivot, memory);", "}", "powers:",
    ]  # fmt: skip


def _largest_row(item: LargestRow) -> list[str]:
    first, *others = map(expression, item.values)
    lines = ["*row = 1;", *([f"double most = fabs({first});"] if others else [])]
    for r, value in enumerate(others, 2):
        lines += [f"if (fabs({value}) > most) {{", f"    most = fabs({value});", f"    *row = {r};", "}"]
    return lines


def statement(item: Statement, number: str = "double") -> str:
    """One statement, wrapped at operators; `number` is the type of locals."""
    return assignment(item, expression(item.value), number)


def assignment(item: Statement, value: str, number: str) -> str:
    """The same with the text of its value."""
    head = f"const {number} {item.target}" if item.local else item.target
    comment = f"  /* {comment_text(item.comment)} */" if item.comment else ""
    text = f"    {head} = {value};"
    if len(text) > WIDTH:
        text = "\n".join(
            textwrap.wrap(text, WIDTH, subsequent_indent=" " * 8, break_long_words=False, break_on_hyphens=False)
        )
    return text + comment


def comment_text(text: str) -> str:
    """Text that cannot end a C comment or continue a line, in ASCII."""
    return (
        re.sub(r"[^\x20-\x7e]", "?", text)
        .replace("*/", "* /")
        .replace("/*", "/ *")
        .replace("\\", "/")
        .replace("?", ".")
    )


def arguments(items: tuple[Argument, ...]) -> str:
    return ", ".join(f"{a.type}{a.name}" if a.type.endswith("*") else f"{a.type} {a.name}" for a in items)


def kernel(item: Kernel) -> str:
    """A whole function, a long one behind its parts."""
    return "\n".join(function(part, line) for part in cut(item))


def function(item: Kernel, written: Callable[[Line], str], touched: frozenset[str] = NONE) -> str:
    """Its doc comment in front; arguments that it does not touch are voided."""
    body = "\n\n".join(
        "\n".join([f"    /* {comment_text(section.title)} */", *map(written, section.statements)])
        for section in item.sections
    )
    touched = touched.union(*(x.reads | x.writes for section in item.sections for x in section.statements))
    voids = "".join(f"    (void){a.name};\n" for a in item.arguments if a.name not in touched)
    doc = "\n".join(f" * {comment_text(text)}" for text in item.doc)
    attribute = f"__attribute__(({item.attribute})) " if item.attribute else ""
    inline = "inline " if item.inline else ""
    head = f"{attribute}static {inline}{item.returns} {item.name}({arguments(item.arguments)})"
    wrapped = textwrap.wrap(head.replace(" *", "\0*"), WIDTH, subsequent_indent="    ")  # no break inside a type
    head = "\n".join(wrapped).replace("\0*", " *")
    return f"/*\n{doc}\n */\n{head}\n{{\n{voids}{body}\n}}\n"

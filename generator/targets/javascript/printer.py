"""Lines and functions as JavaScript: expressions are C's, letter by letter, so that the same bits are computed.

Names of C's functions are those of PRELUDE; p is an object with a member a number. No side of a corner is held.
"""

from __future__ import annotations

from collections.abc import Collection

import sympy as sp

from gudgeon.generator.ir.branches import Branch
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import NUMBERS, Readable, readable
from gudgeon.generator.ir.signatures import SIDES
from gudgeon.generator.ir.statements import Line, Sides, Statement
from gudgeon.generator.kernels.shared import CORNER
from gudgeon.generator.symbols.curves import CurveOf, c_name
from gudgeon.generator.targets.c.printer import CPrinter, Text

PRELUDE = """\
const {sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, exp, log, sqrt, pow, abs: fabs, PI} = Math;
const max_of = (x, y) => (x < y ? y : x), min_of = (x, y) => (x > y ? y : x), INFINITY = Infinity;
const sign_of = (x) => (x > 0 ? 1 : x < 0 ? -1 : x);
const just_ahead = (x) => x + 1e-9 * (1 + fabs(x)), just_behind = (x) => x - 1e-9 * (1 + fabs(x));
const finite_slope = (slope, ahead, behind, way) => (isFinite(slope) ? slope : (ahead - behind) / way);
const mod_of = (a, b) => {
    const rest = a % b;
    return rest !== 0 && rest < 0 !== b < 0 ? rest + b : rest;
};
const mod_on = (a, b) => mod_of(a, b);
const period_side = (a, b) => sin(PI * a / b);
"""
_WORDS = frozenset({
    "abstract", "arguments", "await", "async", "boolean", "byte", "catch", "class", "debugger", "delete", "eval",
    "export", "extends", "false", "final", "finally", "function", "implements", "import", "in", "instanceof",
    "interface", "let", "new", "null", "of", "package", "private", "protected", "public", "super", "synchronized",
    "this", "throw", "throws", "transient", "true", "try", "typeof", "undefined", "var", "with", "yield", "isFinite",
    "Infinity", "NaN", "Math", "functions",
})  # fmt: skip
_FILLED = "double *"  # the type of what a function returns by its arguments


def name(text: str) -> str:
    """A local or place of C in JavaScript: `p->mass` is `p.mass`."""
    plain = text.replace("->", ".").lstrip("*")
    return f"{plain}_" if plain in _WORDS else plain


class JavaScriptPrinter(CPrinter):
    """C's expressions with JavaScript's names of places; `numbers` are the members of p that were read."""

    def __init__(self, of: Readable, numbers: set[str]) -> None:
        super().__init__(of)
        self.numbers = numbers

    def called(self, text: str) -> str:
        """By what it is called in this function."""
        plain = super().called(text)
        if plain.startswith(NUMBERS):
            self.numbers.add(plain.removeprefix(NUMBERS))
        return name(plain)

    def _print_SideOf(self, expr: sp.Expr) -> str:
        """The side on which its difference is."""
        return self._call("sign_of", expr.args[1])

    def _print_CurveOf(self, expr: CurveOf) -> str:
        raise ValueError(f"a curve, {c_name(expr.name)}, has no counterpart in JavaScript")

    _print_CurveOn = _print_KnotsOf = _print_CurveOf

    def _print_Pick(self, expr: sp.Expr) -> str:
        return name(super()._print_Pick(expr))


def function(kernel: Kernel, numbers: set[str], only: Collection[str] | None = None) -> str:
    """A method that returns its locals and arrays by name; `numbers` gets the members of p that it reads.

    `only`: the locals that are computed, nothing else is then. Raises ValueError for what has no counterpart.
    """
    own = readable(kernel)
    writer = Lines(own, numbers)
    body = writer.all(only)
    outs = [a.name for a in kernel.arguments if a.type == _FILLED and a not in SIDES] if only is None else []
    outs = [out for out in outs if out not in writer.locals]
    arrays = [f"    const {', '.join(f'{out} = []' for out in outs)};"] if outs else []
    given = ", ".join(arguments(kernel))
    told = ", ".join(dict.fromkeys([*writer.locals, *outs]))
    lines = [*arrays, *(f"    {line}" for line in body), f"    return {{{told}}};"]
    return "\n".join([f"{kernel.name}({given}) {{", *lines, "}"])


def arguments(kernel: Kernel) -> list[str]:
    """What a function is given: not the arrays that it returns."""
    given = (a for a in kernel.arguments if a not in (*SIDES, CORNER))
    return [name(a.name) for a in given if a.type.startswith("const") or not a.type.endswith("*")]


def results(kernel: Kernel) -> list[str]:
    """Numbers that a law returns by its pointers, in their order."""
    return [name(a.name) for a in kernel.arguments if a.type == _FILLED and a not in SIDES]


class Lines:
    """Lines of one function; `locals` are what they declare."""

    def __init__(self, own: Readable, numbers: set[str]) -> None:
        self.own, self.text = own, Text(JavaScriptPrinter(own, numbers))
        self.locals: list[str] = []

    def all(self, only: Collection[str] | None = None) -> list[str]:
        """Every line, or those that store to one of `only`."""
        every = (line for section in self.own.sections for line in section.statements)
        wanted = (line for line in every if only is None or getattr(line, "target", "") in only)
        return [text for line in wanted for text in self.lines(line)]

    def lines(self, item: Line) -> list[str]:
        """One statement or branch."""
        if isinstance(item, Sides):
            return []
        if not isinstance(item, (Statement, Branch)):
            raise ValueError(f"a line of a function that has no counterpart in JavaScript: {item}")
        target = self.text.printer.called(item.target)
        declared = "const " * (item.local or item.target.startswith("*"))
        if declared:
            self.locals.append(target)
        if isinstance(item, Statement):
            return [f"{declared}{target} = {self.text.expression(item.value)};"]
        below, other = self.text.expression(item.otherwise), self.text.expression(item.then)
        return [f"{declared}{target} = {self.text.expression(item.side)} < 0 ? {below} : {other};"]

"""Prints lines and functions as JavaScript; expressions are those of C, so that the same bits are computed.

Functions of C are defined in PRELUDE; p is an object with a member for each parameter. Branches are not frozen.
"""

from __future__ import annotations

from collections.abc import Collection

import sympy as sp

from gudgeon.generator.ir.branches import Branch, JointsAlone
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import Readable, readable
from gudgeon.generator.ir.signatures import BRANCHES, RHS, Access, Number
from gudgeon.generator.ir.statements import (
    Branches,
    Call,
    Guard,
    Jump,
    LargestRow,
    Line,
    Rescue,
    Return,
    Sines,
    Statement,
    Status,
)
from gudgeon.generator.ir.values import Test
from gudgeon.generator.kernels.shared import CORNER
from gudgeon.generator.symbols.curves import ContourOf, CurveOf, c_name
from gudgeon.generator.symbols.storage import Place, Result
from gudgeon.generator.targets.c.printer import CPrinter, Text
from gudgeon.language.functions import IN_SYMPY

PRELUDE = (
    f"""\
const {{{", ".join(name for name in IN_SYMPY if name == IN_SYMPY[name].in_c)}, sqrt, pow, abs: fabs, PI}} = Math;
"""
    + """\
const max_of = (x, y) => (x < y ? y : x), min_of = (x, y) => (x > y ? y : x), INFINITY = Infinity;
const sign_of = (x) => (x > 0 ? 1 : x < 0 ? -1 : x);
const just_ahead = (x) => x + 1e-9 * (1 + fabs(x)), just_behind = (x) => x - 1e-9 * (1 + fabs(x));
const finite_slope = (slope, ahead, behind, way) => (isFinite(slope) ? slope : (ahead - behind) / way);
const mod_of = (a, b) => {
    const rest = a % b;
    return rest !== 0 && rest < 0 !== b < 0 ? rest + b : rest;
};
const mod_on = (a, b) => mod_of(a, b), isfinite = isFinite;
const turned = ({n, t, M_i, M_j}, n_x, n_y, of) => Object.assign(of, {
    force: {Fx: n * n_x - t * n_y, Fy: n * n_y + t * n_x, F_n: n, F_t: t, moment_first: M_i, moment_second: M_j},
});
const period_branch = (a, b) => sin(PI * a / b);
"""
)
CONTOUR = """\
const contour = (depth, order, angle) => {
    const count = depth.length, turns = angle / (2 * PI), x = count * (turns - Math.floor(turns));
    const k = Math.min(Math.floor(x), count - 1), s = x - k, per = count / (2 * PI);
    const [a, b, c, d] = [-1, 0, 1, 2].map((i) => depth[(k + i + count) % count]);
    const slope = 0.5 * (c - a), bend = (a - b) + (c - b), rest = 3 * (c - b) + (a - d);
    if (order === 0) return b + s * (slope + s * (0.5 * bend + s * rest * (1.5 + s * (s - 2.5))));
    return per * (slope + s * (bend + s * rest * (4.5 + s * (5 * s - 10))));
};
"""
_SIDES = tuple(Place(argument.name) for argument in BRANCHES)


class JavaScriptPrinter(CPrinter):
    """Print C's expressions with JavaScript's names of places; `numbers` collects the members of p that are read."""

    def __init__(self, of: Readable, numbers: set[str]) -> None:
        super().__init__(of)
        self.numbers = numbers

    def place(self, place: Place) -> str:
        """Return the path of a place."""
        if place.is_parameter:
            self.numbers.add(place.member)
        return str(place)

    def _print_BranchOf(self, expr: sp.Expr) -> str:
        """Print the active branch of a switching function: its sign, since branches are not frozen."""
        return self._call("sign_of", expr.args[1])

    def _print_CurveOf(self, expr: CurveOf) -> str:
        """Raise ValueError: curves have no counterpart in JavaScript."""
        raise ValueError(f"a curve, {c_name(expr.name)}, has no counterpart in JavaScript")

    _print_CurveOn = _print_KnotsOf = _print_CurveOf

    def _print_ContourOf(self, expr: ContourOf) -> str:
        """Print the depth of a contour or its derivative (symbols/curves.py); its depths are an array of p."""
        return f"contour(p.{expr.table}, {expr.order}, {self._print(expr.args[3])})"


def function(kernel: Kernel, numbers: set[str], only: Collection[str] | None = None) -> str:
    """Return a kernel as a method that returns its locals and arrays by name; `numbers` gets the members of p.

    If a pivot vanishes, the method ends and later values are undefined. `only`: the only locals that are computed.
    Raises ValueError for a line without a counterpart.
    """
    own = readable(kernel)
    ends = only is None and any(isinstance(line, Guard) for part in kernel.sections for line in part.statements)
    writer = Lines(own, numbers, "var" if ends else "const")
    body = writer.all(only)
    body = ["solved: {", *(f"    {line}" for line in body), "}"] if ends else body
    outs = results(kernel) if only is None else []
    outs = [out for out in outs if out not in writer.locals]
    arrays = [f"    const {', '.join(f'{out} = []' for out in outs)};"] if outs else []
    if rhs := _outputs_literal(kernel) if only is None else "":
        arrays, outs = [*arrays, f"    const rhs = {rhs};"], [*outs, "rhs"]
    given = ", ".join(arguments(kernel))
    message = ", ".join(dict.fromkeys([*writer.locals, *outs]))
    lines = [*arrays, *(f"    {line}" for line in body), f"    return {{{message}}};"]
    return "\n".join([f"{kernel.name}({given}) {{", *lines, "}"])


def arguments(kernel: Kernel) -> list[str]:
    """Return the names of a function's arguments without the arrays that it returns."""
    given = (a for a in kernel.arguments if a not in (*BRANCHES, CORNER))
    return [a.name for a in given if a.access is not Access.WRITTEN]


def results(kernel: Kernel) -> list[str]:
    """Return the names of numbers and arrays that a function returns through arguments, in their order."""
    written = (a for a in kernel.arguments if a.access is Access.WRITTEN and a not in BRANCHES)
    return [a.name for a in written if a.type is Number.REAL]


def _outputs_literal(kernel: Kernel) -> str:
    """Return an object literal for the further outputs (RhsOutputs) that a function fills; "" if there are none."""
    lines = [line for section in kernel.sections for line in section.statements]
    places = [line.target for line in lines if isinstance(line, Statement)]
    places += [place for line in lines if isinstance(line, Call) for place in line.results]
    parts = dict[str, int]()
    for place in places:
        match place:
            case Place(RHS.name, (str() as array, int() as k, *member)):
                structs = 1 + k if member or array == "clearance" else 0
                parts[array] = max(structs, parts.get(array, 0))
    message = ", ".join(f"{name}: [{', '.join(['{}'] * count)}]" for name, count in parts.items())
    return f"{{{message}}}" if parts else ""


class _JavaScript(Text):
    """Print values; thresholds become numbers."""

    def _factor(self, value: sp.Basic | float) -> str:
        """Return a factor of a bound as a number."""
        return repr(float(value)) if isinstance(value, float) else self.expression(value)


class Lines:
    """Print the lines of one function; `locals` are the names that they declare with `word`."""

    def __init__(self, own: Readable, numbers: set[str], word: str = "const") -> None:
        self.own, self.text, self.word = own, _JavaScript(JavaScriptPrinter(own, numbers)), word
        self.locals: list[str] = []

    def all(self, only: Collection[str] | None = None) -> list[str]:
        """Return every line, or those that store to one of `only`."""
        every = (line for section in self.own.sections for line in section.statements)
        expected = (line for line in every if only is None or getattr(line, "target", "") in only)
        return [text for line in expected for text in self.lines(line)]

    def lines(self, item: Line) -> list[str]:
        """Return one statement or branch as lines of JavaScript."""
        if isinstance(item, (Branches, Status, JointsAlone, Jump, Rescue, Return, LargestRow)):
            return []
        if isinstance(item, Sines):
            return self._sines(item)
        if isinstance(item, Guard) and isinstance(item.test, Test):
            only = f"{self.text.test(item.only)} && " if item.only else ""
            return [f"if ({only}!({self.text.test(item.test)})) break solved;"]
        if isinstance(item, Call) and item.function.startswith("clearance_"):
            given = ", ".join(self._given(x) for x in item.given if x not in _SIDES)
            return [f"Object.assign({item.results[0]}, functions.{item.function}({given}, {{}}).force);"]
        if not isinstance(item, (Statement, Branch)):
            raise ValueError(f"a line of a function that has no counterpart in JavaScript: {item}")
        target = self.text.printer.called(item.target)
        declared = f"{self.word} " * isinstance(item.target, (str, Result))
        if declared:
            self.locals.append(target)
        if isinstance(item, Statement):
            return [f"{declared}{target} = {self.text.expression(item.value)};"]
        below, other = self.text.expression(item.otherwise), self.text.expression(item.then)
        return [f"{declared}{target} = {self.text.expression(item.side)} < 0 ? {below} : {other};"]

    def _given(self, value: sp.Basic | Place) -> str:
        """Return an argument of a call."""
        return str(value) if isinstance(value, Place) else self.text.expression(value)

    def _sines(self, item: Sines) -> list[str]:
        """Return the sines and cosines of angles as arrays: one of all, or groups of four."""
        angles, found = [self.text.expression(angle) for angle in item.angles], []
        for function, array in zip(("sin", "cos"), item.arrays, strict=True):
            message = [f"{function}({angle})" for angle in angles]
            groups = ", ".join(f"[{', '.join(message[k : k + 4])}]" for k in range(0, len(message), 4))
            found.append(f"const {array} = {f'[{groups}]' if item.count else groups};")
        return found

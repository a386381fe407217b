"""Kernels a second time, for several runs side by side: the same statements with vectors for numbers (lanes.h).

Nothing is derived anew and no operation changes its place, so that each lane rounds as a single run does. What a
single run decides by branching is picked by masks; where it would go another way, the lane is marked as rare.
"""

from __future__ import annotations

import re
from dataclasses import replace

import sympy as sp

from gudgeon.generator.ir.kernels import Argument, Guard, Kernel, Section, Statement
from gudgeon.generator.ir.signatures import SIDES
from gudgeon.generator.ir.sine_pairs import lane_by_lane
from gudgeon.generator.targets.c import printer

FUNCTIONS = ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log")
FUNCTIONS_OF_TWO = ("pow", "atan2")
_TYPES = (("double", "Lanes"), ("Parameters", "LaneParameters"), ("Memory", "LaneRun"), ("Aside", "LaneAside"))
_RARE = Argument("LaneBits *", "rare")
# Lines of single runs that have no counterpart: what becomes of a vanished pivot, corners that are held.
_LEFT_OUT = re.compile(
    r"int pivot = 0;|goto powers;|dependent:|pivot = solve_by_absolute\(.*|powers:|return \w+;"
    r"|const double \*const side = .*|double \*const g = .*|double g\[.*"
)


class LanesPrinter(printer.CPrinter):
    """Symbols are vectors, numbers stay numbers wherever C lets them meet."""

    def _vector(self, expr: sp.Expr) -> str:
        text: str = self._print(expr)
        return text if expr.free_symbols else f"all_of({text})"

    def _call(self, function: str, *arguments: sp.Expr) -> str:
        if not any(argument.free_symbols for argument in arguments):
            return super()._call(function, *arguments)
        return f"lanes_{function}({', '.join(map(self._vector, arguments))})"

    def _function(self, expr: sp.Expr) -> str:
        return self._call(type(expr).__name__, *expr.args)

    _print_sin = _print_cos = _print_tan = _print_asin = _print_acos = _print_atan = _function
    _print_sinh = _print_cosh = _print_tanh = _print_exp = _print_log = _print_atan2 = _function

    def _nested(self, function: str, expr: sp.Expr) -> str:
        if not expr.free_symbols:
            return super()._nested(function, expr)
        arguments = sorted(expr.args, key=lambda a: (a.is_Number, str(a)))
        text = self._vector(arguments[0])
        for argument in arguments[1:]:
            text = f"lanes_{function}({text}, {self._vector(argument)})"
        return text

    def _print_Heaviside(self, expr: sp.Expr) -> str:
        return f"pick({self._vector(expr.args[0])} >= 0.0, all_of(1.0), all_of(0.0))"

    def _print_SideOf(self, expr: sp.Expr) -> str:
        """rk4 holds no side."""
        return f"lanes_sign_of({self._vector(expr.args[1])})"

    def _print_Magnitude(self, expr: sp.Expr) -> str:
        return f"(lanes_fabs({self._vector(expr.args[0])}) + 1e-150)"

    def _print_Pick(self, expr: sp.Expr) -> str:
        side, a, b = map(self._vector, expr.args)
        return f"pick({side} < 0.0, {b}, {a})"


_printer = LanesPrinter({"math_macros": {}})


def expression(expr: sp.Expr | str) -> str:
    """A vector; text passes unchanged."""
    return expr if isinstance(expr, str) else _printer._vector(expr)


def statement(item: Statement) -> str:
    """One statement, wrapped at operators."""
    return printer.statement(replace(item, value=expression(item.value)), "Lanes")


def kernel(item: Kernel) -> str:
    """The function for vectors. It returns nothing and takes no sides; lanes that it cannot do are set in `rare`."""
    grouped = lane_by_lane(item)
    sections = tuple(kept for section in grouped.sections if (kept := _section(section)).statements)
    arguments = tuple(Argument(_type(a.type), a.name) for a in item.arguments if a not in SIDES)
    return printer.kernel(replace(item, sections=sections, arguments=arguments, returns="void"), "Lanes")


def motion_kernel(item: Kernel) -> str:
    """A kernel that may meet something rare."""
    return kernel(replace(item, arguments=(*item.arguments, _RARE)))


def _type(name: str) -> str:
    for single, lanes in _TYPES:
        name = re.sub(rf"\b{single}\b", lanes, name)
    return name


def _section(section: Section) -> Section:
    statements: list[Statement | str] = []
    for item in section.statements:
        if isinstance(item, Statement):
            statements.append(replace(item, value=expression(item.value)))
        elif isinstance(item, Guard):
            statements.append(f"*rare |= ~({item.condition});")
        elif not _LEFT_OUT.fullmatch(item):
            statements.append(_line(item))
    return replace(section, statements=tuple(statements))


def _line(text: str) -> str:
    """A line of C that both have. Raises ValueError for one that nobody has thought of."""
    if re.match(r"Lanes |sines_and_cosines\(", text):
        return text
    if text.startswith("clearance_"):
        text = text.replace(", p, side, g,", ", p,")
        return re.sub(r"(?<=, )(-?[\d.]+)(?=,)", r"all_of(\1)", text)  # the ground's angular velocity
    if text.startswith("*worst = "):
        value = text.removeprefix("*worst = ").replace("max_of(*worst, fabs(", "lanes_max_of(*worst, lanes_fabs(")
        return f"*worst = {'all_of(0.0);' if value == '0.0;' else value}"
    raise ValueError(f"a line of a kernel that has no counterpart for vectors: {text}")

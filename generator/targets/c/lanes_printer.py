"""Prints generated functions for SIMD lanes, one run per lane: the same statements with vectors (lanes.h).

The order of operations is kept, so that each lane rounds as a single run does. Masks replace branches. A lane in which
a single run would take another path is marked as rare.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from gudgeon.generator.ir.branches import Branch, ReturnIfOnlyJoints
from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.readable import make_readable, make_readable_statements
from gudgeon.generator.ir.series_rules import WIDE, StoreRow
from gudgeon.generator.ir.signatures import Number, Type, make_output_argument
from gudgeon.generator.ir.sine_pairs import call_sines_by_lane
from gudgeon.generator.ir.statements import (
    Branches,
    Call,
    Declare,
    DeclareParameters,
    Guard,
    Jump,
    Largest,
    Line,
    Return,
    Sines,
    SolveDependentRows,
    Statement,
    Status,
)
from gudgeon.generator.ir.values import Conditional, Test, Value
from gudgeon.generator.symbols.curves import CurveOf, CurveOn, KnotsOf, make_curve_name
from gudgeon.generator.symbols.storage import Place
from gudgeon.generator.targets.c import functions, printer
from gudgeon.generator.targets.c.printer import ValuePrinter

_TYPES: dict[Type, Type] = {
    Number.REAL: "Lanes",
    "Parameters": "LaneParameters",
    "DiscreteState": "LaneDiscreteState",
    "RhsOutputs": "LaneRhsOutputs",
    "ContactState": "LaneContactState",
    "Linear": "LaneLinear",
    "ComplexLinear": "LaneComplexLinear",
    "PinSlopes": "LaneSlopes",
    "Wide": "Lanes",
}
_RARE = make_output_argument("rare", "LaneBits")
# Lines of single runs without a counterpart in lanes, such as the treatment of vanishing pivots.
_LEFT_OUT = (Status, ReturnIfOnlyJoints, Jump, SolveDependentRows, Return)


class LanesPrinter(printer.CPrinter):
    """Print symbols as vectors; numbers stay numbers where C allows it."""

    def _print_vector(self, expr: sp.Expr) -> str:
        """Print an expression as a vector: a constant fills all lanes."""
        text: str = self._print(expr)
        return text if expr.free_symbols else f"all_of({text})"

    def _print_call(self, function: str, *arguments: sp.Expr) -> str:
        """Print a call of a function of vectors; with constant arguments only, the call of the function of numbers."""
        if not any(argument.free_symbols for argument in arguments):
            return super()._print_call(function, *arguments)
        return f"lanes_{function}({', '.join(map(self._print_vector, arguments))})"

    def _print_nested_calls(self, function: str, expr: sp.Expr) -> str:
        """Print nested calls of a function of two vectors, for example a maximum; constants come last."""
        if not expr.free_symbols:
            return super()._print_nested_calls(function, expr)
        arguments = sorted(expr.args, key=lambda a: (a.is_Number, str(a)))
        text = self._print_vector(arguments[0])
        for argument in arguments[1:]:
            text = f"lanes_{function}({text}, {self._print_vector(argument)})"
        return text

    def _print_Heaviside(self, expr: sp.Expr) -> str:
        """Print the step function of a vector."""
        return f"pick({self._print_vector(expr.args[0])} >= 0.0, all_of(1.0), all_of(0.0))"

    def _print_BranchOf(self, expr: sp.Expr) -> str:
        """Print the active branch of a switching function of vectors."""
        index = self.print_switch_index(int(expr.args[0]))
        return f"lanes_branch_of(branch, g, {index}, {self._print_vector(expr.args[1])})"

    def _print_Magnitude(self, expr: sp.Expr) -> str:
        """Print the absolute value of a vector."""
        return f"(lanes_fabs({self._print_vector(expr.args[0])}) + 1e-150)"

    def _print_CurveOf(self, expr: CurveOf) -> str:
        """Print the value of a curve at a vector."""
        if not expr.free_symbols:
            return super()._print_CurveOf(expr)
        return f"lanes_curve({make_curve_name(expr.name)}, {expr.order}, {self._print_vector(expr.args[2])})"

    def _print_CurveOn(self, expr: CurveOn) -> str:
        """Print the value of a curve at a vector, on the pieces that its branch selects."""
        x, piece = map(self._print_vector, expr.args[2:])
        return f"lanes_curve_on({make_curve_name(expr.name)}, {expr.order}, {x}, {piece})"

    def _print_KnotsOf(self, expr: KnotsOf) -> str:
        """Print the event function of a curve's knots at a vector."""
        return f"lanes_knots({make_curve_name(expr.name)}, {self._print_vector(expr.args[1])})"

    def _print_Pick(self, expr: sp.Expr) -> str:
        """Print a choice by the signs of a vector."""
        if expr in self.of.branches:
            return self.of.branches[expr]
        branch, a, b = map(self._print_vector, expr.args)
        return f"pick({branch} < 0.0, {b}, {a})"


class LaneLines(functions.LinePrinter):
    """Print lines of functions for vectors. Raises ValueError for a kind of line without a counterpart."""

    printer: LanesPrinter

    def __init__(self, printer: LanesPrinter) -> None:
        super().__init__(printer, "Lanes")

    def expression(self, value: Value) -> str:
        """Return a value as a vector in C; a condition becomes a choice by a mask."""
        match value:
            case sp.Basic():
                return self.printer._print_vector(value)
            case Conditional():
                then, otherwise = self.expression(value.then), self.expression(value.otherwise)
                return f"pick({self.test(value.test)}, {then}, {otherwise})"
            case _:
                return super().expression(value)

    def test(self, item: Test) -> str:
        """Return a comparison as a mask of lanes in C; bounds stay numbers where possible."""
        value_printer = ValuePrinter(self.printer)
        if not item.relation:
            return f"{value_printer.expression(item.value)} > 0.0"
        if not item.is_relative_to_value:
            number_test = value_printer.test(replace(item, compares_magnitude=False))
            return (
                f"lanes_fabs({value_printer.expression(item.value)}){number_test.removeprefix(value_printer.expression(item.value))}"
                if item.compares_magnitude
                else number_test
            )
        value = value_printer.expression(item.value)
        size = f"lanes_fabs({value})" if item.compares_magnitude else value
        return f"({size} > 0.0) & ({size} < INFINITY)"

    def _print_line(self, item: Line) -> Sequence[str]:
        """Return one line of a kernel as lines of C for vectors.

        Branches become choices by masks. A lane whose pivot fails its test is marked in `rare` instead of leaving.
        """
        match item:
            case Branch():
                declaration = f"{'const Lanes ' * bool(item.declared_local)}{self.printer.get_name(item.target)}"
                branch, then, otherwise = map(self.expression, (item.branch, item.value_above, item.value_below))
                return [f"{declaration} = pick({branch} < 0.0, {otherwise}, {then});"]
            case Guard(test=Test() as test, condition=None):
                return [f"*rare |= ~({self.test(test)});"]
            case Call():
                values = (*item.given, *item.results)
                arguments = [self.print_argument(x) if isinstance(x, Place) else self.expression(x) for x in values]
                return [f"{item.function}({', '.join(arguments)});"]
            case Declare(type=Number.REAL):
                return super()._print_line(replace(item, type="Lanes"))
            case DeclareParameters():
                return ["const LaneParameters *const p = lin->p;"]
            case Branches():
                stored_branches, local_array = (
                    "held_branches(discrete)" if item.held else "NULL",
                    "Lanes g[N_SWITCHES + 1];",
                )
                declarations_of_target = {
                    "": [],
                    "nobody": [local_array],
                    "rhs": ["Lanes *const g = reported_branches(rhs);"],
                }
                return [f"const Lanes *const branch = {stored_branches};", *declarations_of_target[item.output_target]]
            case Largest():
                name = f"*{item.target}"
                before = ["all_of(0.0)", *[name] * len(item.values)]
                largest = [
                    f"{name} = lanes_max_of({old}, lanes_fabs({self.expression(x)}));"
                    for old, x in zip(before, item.values, strict=False)
                ]
                return largest or [f"{name} = all_of(0.0);"]
            case StoreRow():
                return [
                    f"{item.array}[{WIDE * item.row + i}] = {self.expression(x)};" for i, x in enumerate(item.values)
                ]
            case Sines():
                return super()._print_line(item)
        raise ValueError(f"a line of a kernel that has no counterpart for vectors: {item}")


def print_expression(value: Value) -> str:
    """Return a value as a vector in C, for use outside of a printed function."""
    return LaneLines(LanesPrinter()).expression(value)


def print_statements(items: Sequence[Statement]) -> str:
    """Return statements as lines of C for the body of a lane function in a template; "" without statements."""
    readable_lines = make_readable_statements(items)
    return (
        "\n".join(map(LaneLines(LanesPrinter(readable_lines)).line, readable_lines.sections[0].statements))
        if readable_lines.sections
        else ""
    )


def print_kernel(item: Kernel) -> str:
    """Return a kernel as a C function for vectors, which marks the lanes that it cannot compute in `rare`.

    Lines of single runs without a counterpart in lanes are left out. The function returns no status.
    """
    kept_sections = (
        Section(section.title, tuple(x for x in section.statements if not isinstance(x, _LEFT_OUT)))
        for section in item.sections
    )
    arguments = tuple(replace(a, type=_TYPES.get(a.type, a.type)) for a in item.arguments)
    sections = tuple(section for section in kept_sections if section.statements)
    lanes_kernel = replace(item, sections=sections, arguments=arguments, status=False)
    marks_rare = any(isinstance(x, (Guard, Sines)) for section in sections for x in section.statements)
    readable_lines = make_readable(lanes_kernel)
    return functions.print_function(
        lanes_kernel,
        LaneLines(LanesPrinter(readable_lines)),
        readable_lines,
        frozenset([_RARE.name] if marks_rare else []),
    )


def print_motion_kernel(item: Kernel) -> str:
    """Return a kernel as a C function for vectors whose sines are computed one angle at a time for all lanes.

    The function has the further argument `rare`. Kernels of the motion are printed so.
    """
    return print_kernel_with_rare(call_sines_by_lane(item))


def print_kernel_with_rare(item: Kernel) -> str:
    """Return a kernel as a C function for vectors with the further argument `rare`.

    It is the mask of lanes that need a single run.
    """
    return print_kernel(replace(item, arguments=(*item.arguments, _RARE)))

"""Prints generated functions for SIMD lanes, one run per lane: vectors for numbers (lanes.h), masks for branches.

The order of operations is kept, so that each lane rounds as a single run does. Lanes in which a single run would take
another path are added to the mask `needs_scalar`. Their steps fall back to the scalar code of single runs.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from gudgeon.generator.ir.branches import Branch, ReturnIfOnlyJoints
from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.readable import make_readable, make_readable_statements
from gudgeon.generator.ir.series_rules import ROW_LENGTH, StoreRow
from gudgeon.generator.ir.signatures import Number, Type, make_output_argument
from gudgeon.generator.ir.sine_groups import call_sines_by_lane
from gudgeon.generator.ir.statements import (
    Call,
    Declare,
    DeclareBranches,
    DeclareParameters,
    Guard,
    Instruction,
    Jump,
    MaxMagnitude,
    Return,
    Sines,
    SolveDependentRows,
    Statement,
    Status,
)
from gudgeon.generator.ir.values import Conditional, Test, Value
from gudgeon.generator.symbols.curves import CurveOf, CurveOn, KnotsOf, make_curve_name
from gudgeon.generator.symbols.storage import StorageLocation
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
_FALLBACK_MASK = make_output_argument("needs_scalar", "LaneBits")  # lanes that the scalar code must compute
# Lines of single runs without a counterpart in lanes, such as the treatment of vanishing pivots.
_SINGLE_RUN_LINES = (Status, ReturnIfOnlyJoints, Jump, SolveDependentRows, Return)


class LanesPrinter(printer.CPrinter):
    """Print expressions of vectors in C; symbols are vectors, constants stay scalars where C allows it."""

    def _print_vector(self, expr: sp.Expr) -> str:
        """Print an expression as a vector: a constant is broadcast to all lanes."""
        text = self.print_by_structure(expr)
        return text if expr.free_symbols else f"broadcast({text})"

    def _print_call(self, function_name: str, *arguments: sp.Expr) -> str:
        """Print a call of a vector function; with constant arguments only, the call of the scalar function."""
        if not any(argument.free_symbols for argument in arguments):
            return super()._print_call(function_name, *arguments)
        return f"lanes_{function_name}({', '.join(map(self._print_vector, arguments))})"

    def _print_nested_calls(self, function_name: str, expr: sp.Expr) -> str:
        """Print an associative function, such as a maximum, as nested calls of two vectors; constants come last.

        An expression without symbols is printed as a scalar.
        """
        if not expr.free_symbols:
            return super()._print_nested_calls(function_name, expr)
        arguments = sorted(expr.args, key=lambda a: (a.is_Number, str(a)))
        text = self._print_vector(arguments[0])
        for argument in arguments[1:]:
            text = f"lanes_{function_name}({text}, {self._print_vector(argument)})"
        return text

    def _print_Heaviside(self, expr: sp.Expr) -> str:
        """Print the step function of a vector."""
        return f"select_value({self._print_vector(expr.args[0])} >= 0.0, broadcast(1.0), broadcast(0.0))"

    def _print_BranchOf(self, expr: sp.Expr) -> str:
        """Print the active branch of a switching function of vectors."""
        index = self.print_switch_index(int(expr.args[0]))
        return f"lanes_branch_of(branch, g, {index}, {self._print_vector(expr.args[1])})"

    def _print_Magnitude(self, expr: sp.Expr) -> str:
        """Print the absolute value of a vector."""
        return f"(lanes_fabs({self._print_vector(expr.args[0])}) + 1e-150)"

    def _print_CurveOf(self, expr: CurveOf) -> str:
        """Print the value of a curve, or its derivative, at a vector; at a constant, the scalar call."""
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

    def _print_Select(self, expr: sp.Expr) -> str:
        """Print Select(branch, a, b), a select by the sign of a vector: b for branch < 0, else a (also for NaN).

        If `readable.branches` contains the expression, the name of its local is printed.
        """
        if expr in self.readable.branches:
            return self.readable.branches[expr]
        branch, a, b = map(self._print_vector, expr.args)
        return f"select_value({branch} < 0.0, {b}, {a})"


class LaneLinePrinter(functions.LinePrinter):
    """Print lines of functions for vectors. Raises ValueError for a kind of line without a counterpart."""

    printer: LanesPrinter

    def __init__(self, printer: LanesPrinter) -> None:
        super().__init__(printer, "Lanes")

    def print_expression(self, value: Value) -> str:
        """Return a value as a vector in C; a conditional value becomes a select by the mask of its test."""
        match value:
            case sp.Basic():
                return self.printer._print_vector(value)
            case Conditional():
                then, otherwise = self.print_expression(value.then), self.print_expression(value.otherwise)
                return f"select_value({self.print_test(value.test)}, {then}, {otherwise})"
            case _:
                return super().print_expression(value)

    def print_test(self, test: Test) -> str:
        """Return a comparison as a mask of lanes in C; constant bounds stay scalars.

        A test without a relation is value > 0. A test that is relative to the value itself (`is_relative_to_value`)
        checks that the value, or its magnitude if that is compared, is positive and finite.
        """
        value_printer = ValuePrinter(self.printer)
        value = value_printer.print_expression(test.value)
        if not test.relation:
            return f"{value} > 0.0"
        left_side = f"lanes_fabs({value})" if test.compares_magnitude else value
        if test.is_relative_to_value:
            return f"({left_side} > 0.0) & ({left_side} < INFINITY)"
        return left_side + value_printer.print_test(replace(test, compares_magnitude=False)).removeprefix(value)

    def _print_instruction(self, line: Instruction) -> Sequence[str]:
        """Return one line of a kernel as lines of C for vectors.

        Branches become choices by masks. A lane whose pivot fails its test is marked in `needs_scalar` instead of
        leaving the function. Raises ValueError for a line without a counterpart.
        """
        match line:
            case Branch():
                declaration = f"{'const Lanes ' * bool(line.declared_local)}{self.printer.get_name(line.target)}"
                branch, then, otherwise = map(
                    self.print_expression, (line.active_branch, line.value_above, line.value_below)
                )
                return [f"{declaration} = select_value({branch} < 0.0, {otherwise}, {then});"]
            case Guard(test=Test() as test, condition=None):
                return [f"*needs_scalar |= ~({self.print_test(test)});"]
            case Call():
                values = (*line.inputs, *line.results)
                arguments = [
                    self.print_argument(x) if isinstance(x, StorageLocation) else self.print_expression(x)
                    for x in values
                ]
                return [f"{line.function}({', '.join(arguments)});"]
            case Declare(type=Number.REAL):
                return super()._print_instruction(replace(line, type="Lanes"))
            case DeclareParameters():
                return ["const LaneParameters *const p = lin->p;"]
            case DeclareBranches():
                stored_branches, local_array = (
                    "frozen_branches(discrete)" if line.may_be_frozen else "NULL",
                    "Lanes g[N_SWITCHES + 1];",
                )
                declarations_of_target = {
                    "": [],
                    "local": [local_array],
                    "rhs": ["Lanes *const g = reported_branches(rhs);"],
                }
                return [f"const Lanes *const branch = {stored_branches};", *declarations_of_target[line.output_target]]
            case MaxMagnitude():
                name = f"*{line.target}"
                before = ["broadcast(0.0)", *[name] * len(line.values)]
                largest = [
                    f"{name} = lanes_max_of({old}, lanes_fabs({self.print_expression(x)}));"
                    for old, x in zip(before, line.values, strict=False)
                ]
                return largest or [f"{name} = broadcast(0.0);"]
            case StoreRow():
                return [
                    f"{line.array}[{ROW_LENGTH * line.row + i}] = {self.print_expression(x)};"
                    for i, x in enumerate(line.values)
                ]
            case Sines():
                return super()._print_instruction(line)
        raise ValueError(f"a line of a kernel has no counterpart for vectors: {line}")


def print_expression(value: Value) -> str:
    """Return a value as a vector in C, for use outside of a printed function."""
    return LaneLinePrinter(LanesPrinter()).print_expression(value)


def print_statements(statements: Sequence[Statement]) -> str:
    """Return statements as lines of C for the body of a lane function in a template; "" without statements."""
    readable_lines = make_readable_statements(statements)
    return (
        "\n".join(
            map(LaneLinePrinter(LanesPrinter(readable_lines)).print_instruction, readable_lines.sections[0].statements)
        )
        if readable_lines.sections
        else ""
    )


def print_lanes_kernel(kernel: Kernel) -> str:
    """Return a kernel as a C function for vectors without a status.

    Lines of single runs without a counterpart in lanes, such as the treatment of vanishing pivots, are left out.
    `Guard` (test of a pivot) and `Sines` (sines and cosines of several angles) mark lanes that they cannot compute in
    the argument `needs_scalar` (_FALLBACK_MASK). A kernel with such lines must have this argument, which is not tested
    here; `print_kernel_with_fallback` adds it.
    """
    lane_sections = (
        Section(section.title, tuple(x for x in section.statements if not isinstance(x, _SINGLE_RUN_LINES)))
        for section in kernel.sections
    )
    arguments = tuple(replace(a, type=_TYPES.get(a.type, a.type)) for a in kernel.arguments)
    sections = tuple(section for section in lane_sections if section.statements)
    lanes_kernel = replace(kernel, sections=sections, arguments=arguments, status=False)
    marks_lanes = any(isinstance(x, (Guard, Sines)) for section in sections for x in section.statements)
    readable_lines = make_readable(lanes_kernel)
    return functions.print_function(
        lanes_kernel,
        LaneLinePrinter(LanesPrinter(readable_lines)),
        readable_lines,
        frozenset([_FALLBACK_MASK.name] if marks_lanes else []),
    )


def print_motion_kernel(kernel: Kernel) -> str:
    """Return a kernel of the motion as a C function for vectors, with the additional argument `needs_scalar`.

    Its sines and cosines are computed one angle at a time for all lanes, which marks lanes with large angles in
    `needs_scalar`.
    """
    return print_kernel_with_fallback(call_sines_by_lane(kernel))


def print_kernel_with_fallback(kernel: Kernel) -> str:
    """Return a kernel as a C function for vectors with the additional argument `needs_scalar`, a mask of lanes.

    The C function adds the lanes in which a pivot fails its test; for these the engine falls back to single runs.
    """
    return print_lanes_kernel(replace(kernel, arguments=(*kernel.arguments, _FALLBACK_MASK)))

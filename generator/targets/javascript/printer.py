"""Prints generated functions as JavaScript; expressions are those of C, so that results are equal bit for bit.

PRELUDE defines the functions of C that the expressions call. p is an object with a member for each parameter. Branches
are not frozen.
"""

from __future__ import annotations

from collections.abc import Collection

import sympy as sp

from gudgeon.generator.ir.branches import Branch, ReturnIfOnlyJoints
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import Readable, make_readable
from gudgeon.generator.ir.signatures import BRANCHES, RHS, Access, Number
from gudgeon.generator.ir.statements import (
    Call,
    DeclareBranches,
    Guard,
    Instruction,
    Jump,
    MaxMagnitudeRow,
    Return,
    Sines,
    SolveDependentRows,
    Statement,
    Status,
)
from gudgeon.generator.ir.values import Test
from gudgeon.generator.kernels.shared import FIRST_SWITCH
from gudgeon.generator.symbols.curves import ContourOf, CurveOf, make_curve_name
from gudgeon.generator.symbols.storage import Result, StorageLocation
from gudgeon.generator.targets.c.printer import CPrinter, ValuePrinter
from gudgeon.language.functions import IN_SYMPY

PRELUDE = (
    f"""\
const {{{", ".join(name for name in IN_SYMPY if name == IN_SYMPY[name].in_c)}, sqrt, pow, abs: fabs, PI}} = Math;
"""
    + """\
const max_of = (x, y) => (x < y ? y : x), min_of = (x, y) => (x > y ? y : x), INFINITY = Infinity;
const sign_of = (x) => (x > 0 ? 1 : x < 0 ? -1 : x);
const slightly_above = (x) => x + 1e-9 * (1 + fabs(x)), slightly_below = (x) => x - 1e-9 * (1 + fabs(x));
const finite_slope = (derivative, value_after, value_before, distance) =>
    (isFinite(derivative) ? derivative : (value_after - value_before) / distance);
const mod_of = (a, b) => {
    const remainder = a % b;
    return remainder !== 0 && remainder < 0 !== b < 0 ? remainder + b : remainder;
};
const mod_on_branch = (a, b) => mod_of(a, b), isfinite = isFinite;
const in_ground_axes = ({n, t, M_i, M_j}, n_x, n_y, stored) => Object.assign(stored, {
    force: {Fx: n * n_x - t * n_y, Fy: n * n_y + t * n_x, F_n: n, F_t: t, moment_first: M_i, moment_second: M_j},
});
const mod_switching_function = (a, b) => sin(PI * a / b);
"""
)
CONTOUR = """\
const evaluate_contour = (depths, order, angle) => {
    const count = depths.length, turns = angle / (2 * PI), position = count * (turns - Math.floor(turns));
    const piece = Math.min(Math.floor(position), count - 1), s = position - piece, per_angle = count / (2 * PI);
    const [a, b, c, d] = [-1, 0, 1, 2].map((i) => depths[(piece + i + count) % count]);
    const slope = 0.5 * (c - a), bend = (a - b) + (c - b), jump = 3 * (c - b) + (a - d);
    if (order === 0) return b + s * (slope + s * (0.5 * bend + s * jump * (1.5 + s * (s - 2.5))));
    return per_angle * (slope + s * (bend + s * jump * (4.5 + s * (5 * s - 10))));
};
"""
_BRANCH_PLACES = tuple(StorageLocation(argument.name) for argument in BRANCHES)


class JavaScriptPrinter(CPrinter):
    """Print expressions as in C, but storage places by their JavaScript paths.

    `members_read` is a set to which the members of p that are read are added.
    """

    def __init__(self, readable_lines: Readable, members_read: set[str]) -> None:
        super().__init__(readable_lines)
        self.members_read = members_read

    def make_printer(self, readable_lines: Readable) -> JavaScriptPrinter:
        """Return a printer for other names that adds to the same set."""
        return JavaScriptPrinter(readable_lines, self.members_read)

    def print_storage_location(self, place: StorageLocation) -> str:
        """Return the path of a storage location in JavaScript; the member of a parameter is added to `members_read`."""
        if place.is_parameter:
            self.members_read.add(place.member)
        return str(place)

    def _print_BranchOf(self, expr: sp.Expr) -> str:
        """Print the active branch of a switching function: its sign, since branches are not frozen."""
        return self._print_call("sign_of", expr.args[1])

    def _print_CurveOf(self, expr: CurveOf) -> str:
        """Raise ValueError: curves have no counterpart in JavaScript."""
        raise ValueError(f"a curve, {make_curve_name(expr.name)}, has no counterpart in JavaScript")

    _print_CurveOn = _print_KnotsOf = _print_CurveOf

    def _print_ContourOf(self, expr: ContourOf) -> str:
        """Print the depth of a contour or its derivative (symbols/curves.py); its depths are an array of p."""
        return f"evaluate_contour(p.{expr.table}, {expr.order}, {self._print(expr.args[3])})"


def print_method(kernel: Kernel, members_read: set[str], local_names: Collection[str] | None = None) -> str:
    """Return a kernel as a JavaScript method that returns an object with its locals and arrays by name.

    local_names: the locals to compute and return, without arrays and `rhs`; None: all locals, the arrays, and `rhs` if
    the kernel fills it. Only a method with all locals ends early if a pivot vanishes; later values are then undefined.
    `members_read` is a set to which the members of p that are read are added. Raises ValueError for a line without a
    counterpart.
    """
    readable_lines = make_readable(kernel)
    may_end = local_names is None and any(
        isinstance(line, Guard) for part in kernel.sections for line in part.statements
    )
    writer = LinePrinter(readable_lines, members_read, "var" if may_end else "const")
    body = writer.print_lines(local_names)
    body = ["solved: {", *(f"    {line}" for line in body), "}"] if may_end else body
    outputs = list_results(kernel) if local_names is None else []
    outputs = [out for out in outputs if out not in writer.locals]
    arrays = [f"    const {', '.join(f'{out} = []' for out in outputs)};"] if outputs else []
    if rhs := _print_outputs_literal(kernel) if local_names is None else "":
        arrays, outputs = [*arrays, f"    const rhs = {rhs};"], [*outputs, "rhs"]
    argument_names = ", ".join(list_arguments(kernel))
    returned = ", ".join(dict.fromkeys([*writer.locals, *outputs]))
    lines = [*arrays, *(f"    {line}" for line in body), f"    return {{{returned}}};"]
    return "\n".join([f"{kernel.name}({argument_names}) {{", *lines, "}"])


def list_arguments(kernel: Kernel) -> list[str]:
    """Return the names of the arguments of a kernel's JavaScript method: neither branches nor arrays that it fills."""
    read_arguments = (a for a in kernel.arguments if a not in (*BRANCHES, FIRST_SWITCH))
    return [a.name for a in read_arguments if a.access is not Access.WRITTEN]


def list_results(kernel: Kernel) -> list[str]:
    """Return the names of the numbers and arrays that a kernel stores through its arguments, in their order.

    `rhs` (RhsOutputs) is not among them.
    """
    written_arguments = (a for a in kernel.arguments if a.access is Access.WRITTEN and a not in BRANCHES)
    return [a.name for a in written_arguments if a.type is Number.REAL]


def _print_outputs_literal(kernel: Kernel) -> str:
    """Return a JavaScript literal of the `rhs` (RhsOutputs) that a kernel fills: "{lambda: [], clearance: [{}]}".

    Arrays of structs have an empty object for each element. "" is returned if the kernel fills none.
    """
    lines = [line for section in kernel.sections for line in section.statements]
    places = [line.target for line in lines if isinstance(line, Statement)]
    places += [place for line in lines if isinstance(line, Call) for place in line.results]
    lengths = dict[str, int]()
    for place in places:
        match place:
            case StorageLocation(RHS.name, (str() as array, int() as k, *member)):
                structs = 1 + k if member or array == "clearance" else 0
                lengths[array] = max(structs, lengths.get(array, 0))
    members = ", ".join(f"{name}: [{', '.join(['{}'] * count)}]" for name, count in lengths.items())
    return f"{{{members}}}" if lengths else ""


class JavaScriptValuePrinter(ValuePrinter):
    """Print values of kernels as JavaScript; thresholds of pivots become numbers."""

    def _print_bound_factor(self, value: sp.Basic | float) -> str:
        """Return a factor of a bound in JavaScript; a threshold is printed as a number."""
        return repr(float(value)) if isinstance(value, float) else self.print_expression(value)


class LinePrinter:
    """Print the lines of one function as JavaScript; `locals` are the names that they declare with `keyword`."""

    def __init__(self, readable_lines: Readable, members_read: set[str], keyword: str = "const") -> None:
        self.readable_lines, self.value_printer, self.keyword = (
            readable_lines,
            JavaScriptValuePrinter(JavaScriptPrinter(readable_lines, members_read)),
            keyword,
        )
        self.locals: list[str] = []

    def print_lines(self, local_names: Collection[str] | None = None) -> list[str]:
        """Return in JavaScript the lines of the function that store to one of `local_names`; all lines for None."""
        all_lines = (line for section in self.readable_lines.sections for line in section.statements)
        selected = (line for line in all_lines if local_names is None or getattr(line, "target", "") in local_names)
        return [text for line in selected for text in self.print_instruction(line)]

    def print_instruction(self, line: Instruction) -> list[str]:
        """Return one line of a kernel in JavaScript; [] for lines for vanished pivots and branches.

        A new local is declared and added to `locals`. A guard leaves the block `solved` if its test fails. The call of
        a joint's function stores its force in ground axes. Raises ValueError for a line without a counterpart.
        """
        if isinstance(
            line, (DeclareBranches, Status, ReturnIfOnlyJoints, Jump, SolveDependentRows, Return, MaxMagnitudeRow)
        ):
            return []
        if isinstance(line, Sines):
            return self._print_sines(line)
        if isinstance(line, Guard) and isinstance(line.test, Test):
            condition = f"{self.value_printer.print_test(line.condition)} && " if line.condition else ""
            return [f"if ({condition}!({self.value_printer.print_test(line.test)})) break solved;"]
        if isinstance(line, Call) and line.function.startswith("clearance_"):
            call_arguments = ", ".join(self._print_argument(x) for x in line.inputs if x not in _BRANCH_PLACES)
            return [f"Object.assign({line.results[0]}, functions.{line.function}({call_arguments}, {{}}).force);"]
        if not isinstance(line, (Statement, Branch)):
            raise ValueError(f"a line of a function has no counterpart in JavaScript: {line}")
        target = self.value_printer.printer.get_name(line.target)
        declaration = f"{self.keyword} " * isinstance(line.target, (str, Result))
        if declaration:
            self.locals.append(target)
        if isinstance(line, Statement):
            return [f"{declaration}{target} = {self.value_printer.print_expression(line.value)};"]
        branch, below, above = (
            self.value_printer.print_expression(value)
            for value in (line.active_branch, line.value_below, line.value_above)
        )
        return [f"{declaration}{target} = {branch} < 0 ? {below} : {above};"]

    def _print_argument(self, value: sp.Basic | StorageLocation) -> str:
        """Return an argument of a call in JavaScript."""
        return str(value) if isinstance(value, StorageLocation) else self.value_printer.print_expression(value)

    def _print_sines(self, sines: Sines) -> list[str]:
        """Return the declarations of two arrays, the sines and the cosines of several angles.

        With `sines.count`, they are arrays of groups of four, as in C; otherwise one group of at most four.
        """
        angles, declarations = [self.value_printer.print_expression(angle) for angle in sines.angles], []
        for function, array in zip(("sin", "cos"), sines.arrays, strict=True):
            values = [f"{function}({angle})" for angle in angles]
            groups = ", ".join(f"[{', '.join(values[k : k + 4])}]" for k in range(0, len(values), 4))
            declarations.append(f"const {array} = {f'[{groups}]' if sines.count else groups};")
        return declarations

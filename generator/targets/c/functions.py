"""Prints generated functions as C11: each class of lines, calls, and long functions outlined into parts."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Sequence

import sympy as sp

from gudgeon.generator.ir.branches import Branch, ReturnIfOnlyJoints
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import Readable, make_readable_statements
from gudgeon.generator.ir.series_rules import StoreRow
from gudgeon.generator.ir.signatures import Access, Argument, Number, Type
from gudgeon.generator.ir.split import split_kernel
from gudgeon.generator.ir.statements import (
    AssignStatus,
    Call,
    Declare,
    DeclareBranches,
    DeclareParameters,
    Guard,
    Instruction,
    Jump,
    MarkUnused,
    MaxMagnitude,
    MaxMagnitudeRow,
    Return,
    ReturnIfFailed,
    Sines,
    SolveDependentRows,
    Statement,
    Status,
    When,
)
from gudgeon.generator.ir.values import NO_NAMES
from gudgeon.generator.kernels.shared import FIRST_SWITCH, SharedFunctionCall
from gudgeon.generator.symbols.derivatives import find_symbols
from gudgeon.generator.symbols.storage import StorageLocation, find_value_key
from gudgeon.generator.targets.c.equal_parts import PrintedPart, merge_equal_parts, print_part, redirect_calls
from gudgeon.generator.targets.c.long_sums import split_long_sums
from gudgeon.generator.targets.c.printer import (
    WIDTH,
    CPrinter,
    ValuePrinter,
    break_code,
    print_expression,
    sanitize_comment,
)

# Functions that engine/scene/kernels.h declares: the engine calls them from another compilation unit.
CALLED_BY_ENGINE = frozenset(
    {
        "prepare",
        "mass_matrix",
        "constraints",
        "jacobian",
        "velocity_rhs",
        "acceleration_rhs",
        "start_values",
        "dynamics",
        "outputs",
        "expand",
        "reduce_state",
        "reduce_accelerations",
        "reduced_dynamics",
        "closures",
        "closure_rates",
        "reduced_project",
        "compute_closure_step",
        "linearize",
        "newton_factor",
        "newton_substitute",
        "newton_solve",
        "newton_factor_complex",
        "newton_solve_complex",
        "evaluate_loop_directions",
        "compute_loop_step",
        "compute_loop_rates",
        "compute_third_loop_rates",
        "evaluate_loop_switching_functions",
        "close_step",
        "compute_body_motion",
        "project",
        "monitored_functions",
        "bound_monitored_functions",
        "time_terms",
    }
)

_NUMBERS = {Number.REAL: "double", Number.INTEGER: "int", Number.BYTE: "unsigned char"}
_PLAIN: dict[type, str] = {
    Status: "int pivot = 0;",
    Jump: "goto powers;",
    DeclareParameters: "const Parameters *const p = lin->p;",
}


class LinePrinter(ValuePrinter):
    """Print the lines of one function as C; `number_type` is the C type of its locals."""

    def __init__(self, printer: CPrinter, number_type: str = "double") -> None:
        super().__init__(printer)
        self.number_type = number_type

    def print_instruction(self, line: Instruction) -> str:
        """Return a line of a kernel as indented C, broken into several lines if it is longer than WIDTH."""
        if isinstance(line, Statement):
            return self.print_statement(line)
        return "\n".join(part for text in self._print_instruction(line) for part in break_code(f"    {text}"))

    def _print_instruction(self, line: Instruction) -> Sequence[str]:
        """Return one line of a kernel that is not an assignment as unindented lines of C.

        Each class of lines has its own form. A class with a fixed text is looked up in `_PLAIN`.
        """
        match line:
            case Branch():
                return self._print_branch(line)
            case Declare():
                return [f"{print_type(line.type)} {line.name}{''.join(f'[{n}]' for n in line.sizes)};"]
            case Call():
                return [f"{self._print_call(line)};"]
            case Guard():
                return self._print_guard(line)
            case When():
                return [f"if ({self.print_test(line.test)})", f"    {self.print_statement(line.statement).lstrip()}"]
            case ReturnIfOnlyJoints():
                return ["if (!a)", "    return 0;"]
            case Return():
                return ["return pivot;" if line.pivot else "return 0;"]
            case AssignStatus():
                return [
                    f"{'' if line.status == 'pivot' else 'const int '}{line.status} = {self._print_call(line.call)};"
                ]
            case ReturnIfFailed():
                return [f"if ({line.status})", f"    {'goto dependent' if line.jumps else f'return {line.status}'};"]
            case DeclareBranches():
                return _print_branch_arrays(line)
            case Sines():
                return self._print_sines(line)
            case SolveDependentRows():
                return self._print_redundant_equation_solution(line)
            case MaxMagnitude():
                name = f"*{line.target}"
                before = ["0.0", *[name] * len(line.values)]
                largest = [
                    f"{name} = max_of({old}, fabs({self.print_expression(x)}));"
                    for old, x in zip(before, line.values, strict=False)
                ]
                return largest or [f"{name} = 0.0;"]
            case MaxMagnitudeRow():
                return self._print_largest_row(line)
            case StoreRow():
                values = ", ".join(map(self.print_expression, line.values))
                return [f"{line.array}[{line.row}] = (Wide){{{values}}};"]
            case MarkUnused():
                return [f"(void){self.printer.get_name(line.name)};"]
        return [_PLAIN[type(line)]]

    def _print_branch(self, branch: Branch) -> list[str]:
        """Return an if statement that assigns one of two values: below zero, or else (also for NaN).

        The comment of the branch, if it has one, and the declaration of a new local precede the statement.
        """
        target = self.printer.get_name(branch.target)
        declaration = [f"{self.number_type} {target};"] if branch.declared_local else []
        comment = [f"/* {sanitize_comment(branch.comment)} */"] if branch.comment else []
        return [
            *comment,
            *declaration,
            f"if ({self.print_expression(branch.active_branch)} < 0.0)",
            f"    {target} = {self.print_expression(branch.value_below)};",
            "else",
            f"    {target} = {self.print_expression(branch.value_above)};",
        ]

    def _print_call(self, call: Call) -> str:
        """Return the call of a function in C without a semicolon: its arguments, then the storage locations of its
        results.
        """
        arguments = [
            self.print_argument(x) if isinstance(x, StorageLocation) else self._print_argument_value(x)
            for x in call.inputs
        ]
        return f"{call.function}({', '.join([*arguments, *map(self.print_argument, call.results)])})"

    def _print_argument_value(self, value: sp.Basic) -> str:
        """Return the value of an argument as C; an integer stays an integer, all others are printed as doubles."""
        return str(value) if isinstance(value, sp.Integer) else self.print_expression(value)

    def print_argument(self, place: StorageLocation) -> str:
        """Return a place as an argument in C: a struct inside another struct by its address, all others by name."""
        text = self.printer.get_name(place)
        return f"&{text}" if place.path else text

    def _print_guard(self, guard: Guard) -> list[str]:
        """Return the if statement that leaves the function, or jumps to `dependent`, if a pivot fails its test.

        The function then returns the number of the pivot, or stores it in `pivot` before the jump. The test is a
        comparison, which must hold, or a call of a function, which must return 0. `guard.condition` restricts the test
        to states that satisfy a condition.
        """
        failure = self._print_call(guard.test) if isinstance(guard.test, Call) else f"!({self.print_test(guard.test)})"
        condition = f"{self.print_test(guard.condition)} && " if guard.condition else ""
        if not guard.jumps:
            return [f"if ({condition}{failure})", f"    return {guard.number};"]
        return [f"if ({condition}{failure}) {{", f"    pivot = {guard.number};", "    goto dependent;", "}"]

    def _print_sines(self, sines: Sines) -> list[str]:
        """Return the declarations and the call that compute sines and cosines of several angles in vectors of four.

        In lanes one call computes one angle of all runs, and marks lanes with large angles in `needs_scalar`. Otherwise
        four angles share a call, and `sines.count` groups of four share one call of compute_sine_and_cosine_groups.
        """
        angles, suffix = [self.print_expression(angle) for angle in sines.angles], sines.suffix
        if sines.lanes:
            lanes_call = f"compute_sines_and_cosines({angles[0]}, &sines_{suffix}, &cosines_{suffix}, needs_scalar);"
            return [f"Lanes sines_{suffix}, cosines_{suffix};", lanes_call]
        groups = [", ".join(angles[k : k + 4]) for k in range(0, len(angles), 4)]
        if sines.count:
            values = ", ".join(f"{{{group}}}" for group in groups)
            return [
                f"const Four angles_{suffix}[{sines.count}] = {{{values}}};",
                f"Four sines_{suffix}[{sines.count}], cosines_{suffix}[{sines.count}];",
                f"compute_sine_and_cosine_groups({sines.count}, angles_{suffix}, sines_{suffix}, cosines_{suffix});",
            ]
        return [
            f"const Four angles_{suffix} = {{{groups[0]}}};",
            f"Four sines_{suffix}, cosines_{suffix};",
            f"compute_sines_and_cosines(&angles_{suffix}, &sines_{suffix}, &cosines_{suffix});",
        ]

    def _print_redundant_equation_solution(self, solution: SolveDependentRows) -> list[str]:
        """Return the code after the label `dependent`, to which the function jumps if a pivot vanishes.

        With forces in `solution`, the code solves redundant constraint equations by their rank. Without forces, it
        calls solve_by_absolute_equations() of the engine. At the label `powers` the function continues in all cases.
        """
        if not (solution.force or solution.call):
            return ["dependent:", "pivot = solve_by_absolute_equations(t, q, v, discrete, p, a, rhs);", "powers:"]
        arrays = (("force", solution.force), ("gamma_stab", solution.rhs))
        stores = (f"{name}[{k}] = {self.print_expression(x)};" for name, values in arrays for k, x in enumerate(values))
        return [
            "dependent: {",
            "    double force[N_Q], gamma_stab[N_ROWS];",
            *("\n".join(break_code(f"        {code}"))[4:] for code in stores),
            *([f"    {self._print_call(solution.call)};"] if solution.call else []),
            "    pivot = solve_dependent_equations(t, q, p, force, gamma_stab, a, rhs->lambda, pivot, discrete);",
            "}",
            "powers:",
        ]

    def _print_largest_row(self, largest_row: MaxMagnitudeRow) -> list[str]:
        """Return the code that sets *row to the number (from 1) of the value with the largest magnitude."""
        first, *others = map(self.print_expression, largest_row.values)
        lines = ["*row = 1;", *([f"double max_magnitude = fabs({first});"] if others else [])]
        for r, value in enumerate(others, 2):
            magnitude = f"fabs({value})"
            lines += [
                f"if ({magnitude} > max_magnitude) {{",
                f"    max_magnitude = {magnitude};",
                f"    *row = {r};",
                "}",
            ]
        return lines

    def print_statement(self, statement: Statement) -> str:
        """Return one assignment as indented C, broken into several lines if it is longer than WIDTH.

        A statement that defines a local declares it as const. The comment follows if it fits in the line, else
        precedes.
        """
        target = self.printer.get_name(statement.target)
        left_side = f"const {self.number_type} {target}" if statement.declared_local else target
        code = break_code(f"    {left_side} = {self.print_expression(statement.value)};")
        if not statement.comment:
            return "\n".join(code)
        comment = f"/* {sanitize_comment(statement.comment)} */"
        if len(code) == 1 and len(code[0]) + len(comment) + 2 <= WIDTH:
            return f"{code[0]}  {comment}"
        return "\n".join([f"    {comment}", *code])


def _print_branch_arrays(branches: DeclareBranches) -> list[str]:
    """Return the declarations of `branch` (the frozen branches) and of `g` (values of switching functions).

    `branch` is NULL if no branch is frozen. By `branches.output_target`, `g` is omitted (""), a local array ("unread")
    or a member of the results ("rhs").
    """
    stored_branches = (
        "discrete->is_frozen ? discrete->branch : NULL;"
        if branches.may_be_frozen
        else "NULL; /* branches are not frozen */"
    )
    declarations = {"": [], "local": ["double g[N_SWITCHES + 1];"], "rhs": ["double *const g = rhs->g;"]}[
        branches.output_target
    ]
    return [f"const double *const branch = {stored_branches}", *declarations]


def print_statements(statements: Sequence[Statement]) -> str:
    """Return statements as lines of C for the body of a function in a template; "" without statements."""
    return "\n".join(text for text, _ in print_each_statement(statements))


def print_each_statement(statements: Sequence[Statement]) -> list[tuple[str, Instruction]]:
    """Return (text in C, line of the kernel) of each statement for a template; [] without statements.

    Select expressions become if statements of their own before the statement that reads them.
    """
    readable_lines = make_readable_statements(statements)
    line_printer = LinePrinter(CPrinter(readable_lines))
    return [
        (line_printer.print_instruction(line), line)
        for section in readable_lines.sections
        for line in section.statements
    ]


def print_shared_call(call: SharedFunctionCall, arguments: Sequence[str], results: Sequence[str]) -> str:
    """Return in C the statement by which a joint calls a function that several joints share, with its semicolon.

    The call passes `arguments`, the parameters of this joint, then `branch`, `g` and the index of the first switching
    function if there are any, then `results`.
    """
    branch_arguments = ["branch", "g", str(call.first_switch)] if call.first_switch is not None else []
    parameters = map(print_expression, call.parameters)
    return f"{call.kernel.name}({', '.join([*arguments, *parameters, *branch_arguments, *results])});"


def find_unused_branch_arguments(
    calls: Iterable[SharedFunctionCall], statements: Iterable[Statement] = ()
) -> list[str]:
    """Return which of the arguments `branch` and `g` are unused, so that the C function must cast them to void.

    `branch`: the frozen branches; `g`: the values of the switching functions. An argument is unused if no statement
    reads it. The list is empty if any of the called functions has switching functions, since such a call passes both.
    """
    names_read = NO_NAMES.union(*(line.reads for line in statements))
    has_switches = any(call.first_switch is not None for call in calls)
    return [] if has_switches else [name for name in ("branch", "g") if name not in names_read]


def print_arguments(arguments: tuple[Argument, ...]) -> str:
    """Return the declarations of a function's arguments in C, separated by commas."""
    return ", ".join(map(_declare_argument, arguments))


def _declare_argument(argument: Argument) -> str:
    """Return the declaration of one argument in C; arguments that are read or written through a pointer get a star."""
    constant = "const " * (argument.access in (Access.CONSTANT, Access.READ))
    pointer = "*" * (argument.access in (Access.READ, Access.WRITTEN))
    return f"{constant}{print_type(argument.type)} {pointer}{argument.name}"


def print_type(number_or_struct: Type) -> str:
    """Return the C type of a number, or the name of a struct as it is."""
    return _NUMBERS[number_or_struct] if isinstance(number_or_struct, Number) else number_or_struct


def print_kernel(kernel: Kernel) -> str:
    """Return a kernel as a C function; a long kernel is split into parts, whose functions precede it."""
    return "\n".join("".join(f"{text}\n" for text, _ in texts) for _, _, texts in print_kernel_parts(kernel))


def _find_names_used(kernel: Kernel) -> frozenset[str]:
    """Return the C names of all arguments and locals that a function's lines read or write.

    The argument for the index of the first switching function is included if the kernel has one. Arguments that are not
    in the result are cast to void.
    """
    names, symbols = set[str](), set[sp.Symbol]()
    for section in kernel.sections:
        for line in section.statements:
            names.update(line.reads, line.writes)
            symbols.update(*map(find_symbols, line.expressions))
    keys = names.union(map(find_value_key, symbols))
    called = (kernel.names.get(key, key) for key in keys)
    first_switch = NO_NAMES if kernel.first_switch is None else {FIRST_SWITCH.name}
    return frozenset(names) | first_switch | {key.base if isinstance(key, StorageLocation) else key for key in called}


def print_comment(doc: Sequence[str]) -> str:
    """Return paragraphs as a block comment in C."""
    text = "\n".join(f" * {sanitize_comment(paragraph)}".rstrip() for paragraph in doc)
    return f"/*\n{text}\n */\n"


def print_function(
    kernel: Kernel,
    line_printer: LinePrinter,
    readable_sections: Readable,
    names_used: frozenset[str] = NO_NAMES,
    *,
    is_called_by_engine: bool = False,
) -> str:
    """Return a kernel as one C function with its comment; arguments that no line uses are cast to void.

    readable_sections: the kernel's lines in readable form, with the names of their symbols. names_used: further names
    that count as used. is_called_by_engine: another compilation unit calls the function, so that it is not static.
    """
    return "".join(
        f"{text}\n"
        for text, _ in print_function_lines(
            kernel, line_printer, readable_sections, names_used, is_called_by_engine=is_called_by_engine
        )
    )


def print_function_lines(
    kernel: Kernel,
    line_printer: LinePrinter,
    readable_sections: Readable,
    names_used: frozenset[str] = NO_NAMES,
    *,
    is_called_by_engine: bool = False,
) -> Iterator[tuple[str, Instruction | None]]:
    """Yield (text, line of the kernel or None) of a function in C, in order.

    None belongs to the head (comment and signature), to the casts of unused arguments, to titles of sections and to the
    closing brace. The arguments are those of `print_function`.
    """
    attribute = f"__attribute__(({kernel.attribute})) " if kernel.attribute else ""
    inline = "inline " if kernel.inline else ""
    static = "" if is_called_by_engine else "static "
    result = "int" if kernel.status else "void"
    signature = f"{attribute}{static}{inline}{result} {kernel.name}({print_arguments(kernel.arguments)})"
    joined = signature.replace(", ", ",\n").replace(" ", "\0").replace("\n", " ")  # no line break within an argument
    signature = "\n".join(textwrap.wrap(joined, WIDTH, subsequent_indent="    ")).replace("\0", " ")
    yield f"{print_comment(kernel.doc)}{signature}\n{{", None
    names_used |= _find_names_used(kernel)
    if void_casts := ", ".join(f"(void){a.name}" for a in kernel.arguments if a.name not in names_used):
        yield "\n".join(break_code(f"    {void_casts};")), None
    for k, section in enumerate(readable_sections.sections):
        title = [f"    /* {sanitize_comment(section.title)} */"] * bool(section.title)
        if heading := [*([""] * bool(k)), *title]:
            yield "\n".join(heading), None
        yield from ((line_printer.print_instruction(line), line) for line in section.statements)
    if not readable_sections.sections:
        yield "    /* this scene has none */", None
    yield "}", None


def print_kernel_parts(kernel: Kernel) -> Iterator[PrintedPart]:
    """Yield (kernel, its readable form, [(C text, line or None)]) of each function into which a kernel is outlined.

    A short kernel is its only part. Parts come before the function that calls them, and clones are merged
    (equal_parts.py). The first text of each is its head, or the table of a merged part.
    """
    *parts, main = split_kernel(split_long_sums(kernel))
    printed, calls = merge_equal_parts(parts, _print_part_lines)
    yield from printed
    yield print_part(redirect_calls(main, calls), _print_part_lines)


def _print_part_lines(part: Kernel, readable_lines: Readable) -> Iterator[tuple[str, Instruction | None]]:
    """Yield (C text, line of the kernel or None) of a kernel as one function, not static if in CALLED_BY_ENGINE."""
    line_printer = LinePrinter(CPrinter(readable_lines))
    is_called_by_engine = part.name in CALLED_BY_ENGINE
    return print_function_lines(part, line_printer, readable_lines, is_called_by_engine=is_called_by_engine)

"""Prints lines of functions, and whole functions, as C11."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Sequence

import sympy as sp

from gudgeon.generator.ir.branches import Branch, JointsAlone
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import Readable, lines, readable
from gudgeon.generator.ir.series_rules import Gathered
from gudgeon.generator.ir.signatures import Access, Argument, Number, Type
from gudgeon.generator.ir.split import cut
from gudgeon.generator.ir.statements import (
    AssignStatus,
    Branches,
    Call,
    Declare,
    Guard,
    Jump,
    Largest,
    LargestRow,
    Line,
    Rescue,
    Return,
    ReturnIfFailed,
    RunNumbers,
    Sines,
    Statement,
    Status,
    Unread,
    When,
)
from gudgeon.generator.ir.values import NONE
from gudgeon.generator.kernels.shared import CORNER, SharedFunctionCall
from gudgeon.generator.symbols.derivatives import symbols_of
from gudgeon.generator.symbols.storage import Place, key_of
from gudgeon.generator.targets.c.printer import WIDTH, CPrinter, Text, broken, comment_text, expression

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
        "closing_step",
        "linearize",
        "newton_factor",
        "newton_substitute",
        "newton_solve",
        "newton_factor_complex",
        "newton_solve_complex",
        "chain_directions",
        "chain_step",
        "chain_rates",
        "chain_third",
        "loop_switches",
        "close_step",
        "arrive",
        "project",
        "watched_functions",
        "watched_ranges",
        "time_terms",
    }
)

_NUMBERS = {Number.REAL: "double", Number.INTEGER: "int", Number.BYTE: "unsigned char"}
_PLAIN: dict[type, str] = {
    Status: "int pivot = 0;",
    Jump: "goto powers;",
    RunNumbers: "const Parameters *const p = lin->p;",
}


class Lines(Text):
    """Print the lines of one function as C; `number` is the type of its locals."""

    def __init__(self, printer: CPrinter, number: str = "double") -> None:
        super().__init__(printer)
        self.number = number

    def line(self, item: Line) -> str:
        """Return any line of a kernel as C, broken where it is too long."""
        if isinstance(item, Statement):
            return self.statement(item)
        return "\n".join(part for text in self._lines(item) for part in broken(f"    {text}"))

    def _lines(self, item: Line) -> Sequence[str]:
        """Return one line of a kernel as lines of C without indent."""
        match item:
            case Branch():
                return self._branch(item)
            case Declare():
                return [f"{type_name(item.type)} {item.name}{''.join(f'[{n}]' for n in item.sizes)};"]
            case Call():
                return [f"{self._call(item)};"]
            case Guard():
                return self._guard(item)
            case When():
                return [f"if ({self.test(item.test)})", f"    {self.statement(item.statement).lstrip()}"]
            case JointsAlone():
                return ["if (!a)", "    return 0;"]
            case Return():
                return ["return pivot;" if item.pivot else "return 0;"]
            case AssignStatus():
                return [f"{'' if item.status == 'pivot' else 'const int '}{item.status} = {self._call(item.call)};"]
            case ReturnIfFailed():
                return [f"if ({item.status})", f"    {'goto dependent' if item.jumps else f'return {item.status}'};"]
            case Branches():
                return _branch_arrays(item)
            case Sines():
                return self._sines(item)
            case Rescue():
                return self._rescue(item)
            case Largest():
                name = f"*{item.target}"
                before = ["0.0", *[name] * len(item.values)]
                largest = [
                    f"{name} = max_of({old}, fabs({self.expression(x)}));"
                    for old, x in zip(before, item.values, strict=False)
                ]
                return largest or [f"{name} = 0.0;"]
            case LargestRow():
                return self._largest_row(item)
            case Gathered():
                values = ", ".join(map(self.expression, item.values))
                return [f"{item.array}[{item.row}] = (Wide){{{values}}};"]
            case Unread():
                return [f"(void){self.printer.called(item.name)};"]
        return [_PLAIN[type(item)]]

    def _branch(self, item: Branch) -> list[str]:
        """Return an if statement that assigns one of two values by the sign of a condition."""
        target = self.printer.called(item.target)
        declared = [f"{self.number} {target};"] if item.defines else []
        comment = [f"/* {comment_text(item.comment)} */"] if item.comment else []
        return [
            *comment,
            *declared,
            f"if ({self.expression(item.side)} < 0.0)",
            f"    {target} = {self.expression(item.otherwise)};",
            "else",
            f"    {target} = {self.expression(item.then)};",
        ]

    def _call(self, item: Call) -> str:
        """Return the call of a function."""
        given = [self.as_argument(x) if isinstance(x, Place) else self._number(x) for x in item.given]
        return f"{item.function}({', '.join([*given, *map(self.as_argument, item.results)])})"

    def _number(self, value: sp.Basic) -> str:
        """Return an argument as C; integers are not written as doubles."""
        return str(value) if isinstance(value, sp.Integer) else self.expression(value)

    def as_argument(self, place: Place) -> str:
        """Return a place as an argument: a struct inside another by its address, others as they are."""
        text = self.printer.called(place)
        return f"&{text}" if place.path else text

    def _guard(self, item: Guard) -> list[str]:
        """Return the code that returns, or jumps to the fallback, if a pivot fails its test."""
        fails = self._call(item.test) if isinstance(item.test, Call) else f"!({self.test(item.test)})"
        only = f"{self.test(item.only)} && " if item.only else ""
        if not item.jumps:
            return [f"if ({only}{fails})", f"    return {item.number};"]
        return [f"if ({only}{fails}) {{", f"    pivot = {item.number};", "    goto dependent;", "}"]

    def _sines(self, item: Sines) -> list[str]:
        """Return the calls that compute sines and cosines of several angles in vectors."""
        names, of = [self.expression(angle) for angle in item.angles], item.suffix
        if item.lanes:
            call = f"sines_and_cosines({names[0]}, &sines_{of}, &cosines_{of}, rare);"
            return [f"Lanes sines_{of}, cosines_{of};", call]
        groups = [", ".join(names[k : k + 4]) for k in range(0, len(names), 4)]
        if item.count:
            values = ", ".join(f"{{{group}}}" for group in groups)
            return [
                f"const Four angles_{of}[{item.count}] = {{{values}}};",
                f"Four sines_{of}[{item.count}], cosines_{of}[{item.count}];",
                f"many_sines_and_cosines({item.count}, angles_{of}, sines_{of}, cosines_{of});",
            ]
        return [
            f"const Four angles_{of} = {{{groups[0]}}};",
            f"Four sines_{of}, cosines_{of};",
            f"sines_and_cosines(&angles_{of}, &sines_{of}, &cosines_{of});",
        ]

    def _rescue(self, item: Rescue) -> list[str]:
        """Return the code after a vanished pivot: a solution with dependent constraint equations."""
        if not item.force:
            return ["dependent:", "pivot = solve_by_absolute(t, q, v, discrete, p, a, rhs);", "powers:"]
        given = (("force", item.force), ("gamma_stab", item.rhs))
        stored = (f"{name}[{k}] = {self.expression(x)};" for name, some in given for k, x in enumerate(some))
        return [
            "dependent: {",
            "    double force[N_Q], gamma_stab[N_ROWS];",
            *("\n".join(broken(f"        {code}"))[4:] for code in stored),
            "    pivot = solve_dependent(t, q, p, force, gamma_stab, a, rhs->lambda, pivot, discrete);",
            "}",
            "powers:",
        ]

    def _largest_row(self, item: LargestRow) -> list[str]:
        """Return the code that finds the row of the largest absolute value."""
        first, *others = map(self.expression, item.values)
        lines = ["*row = 1;", *([f"double most = fabs({first});"] if others else [])]
        for r, value in enumerate(others, 2):
            lines += [f"if (fabs({value}) > most) {{", f"    most = fabs({value});", f"    *row = {r};", "}"]
        return lines

    def statement(self, item: Statement) -> str:
        """Return one assignment; its comment follows if it fits in the line, else precedes."""
        target = self.printer.called(item.target)
        head = f"const {self.number} {target}" if item.defines else target
        code = broken(f"    {head} = {self.expression(item.value)};")
        if not item.comment:
            return "\n".join(code)
        comment = f"/* {comment_text(item.comment)} */"
        if len(code) == 1 and len(code[0]) + len(comment) + 2 <= WIDTH:
            return f"{code[0]}  {comment}"
        return "\n".join([f"    {comment}", *code])


def _branch_arrays(item: Branches) -> list[str]:
    """Return the declarations of the arrays of active branches and of switching functions."""
    held = (
        "discrete->held ? discrete->branch : NULL;"
        if item.held
        else "NULL; /* of corners within corners: as they are */"
    )
    message = {"": [], "nobody": ["double g[N_SWITCHES + 1];"], "rhs": ["double *const g = rhs->g;"]}[item.message]
    return [f"const double *const branch = {held}", *message]


def statements(items: Sequence[Statement]) -> str:
    """Return statements as lines within a function of a template."""
    return "\n".join(text for text, _ in one_by_one(items))


def one_by_one(items: Sequence[Statement]) -> list[tuple[str, Line]]:
    """Return each statement as text, with branches before it, and the line that it prints."""
    own = lines(items)
    writer = Lines(CPrinter(own))
    return [(writer.line(line), line) for section in own.sections for line in section.statements]


def shared_call(call: SharedFunctionCall, given: Sequence[str], results: Sequence[str]) -> str:
    """Return a joint's call of a function that several joints share."""
    held = ["branch", "g", str(call.corner)] if call.corner is not None else []
    numbers = map(expression, call.numbers)
    return f"{call.kernel.name}({', '.join([*given, *numbers, *held, *results])});"


def unread_branches(calls: Iterable[SharedFunctionCall], statements: Iterable[Statement] = ()) -> list[str]:
    """Return which of the arguments `branch` and `g` neither the calls nor the statements read."""
    read = NONE.union(*(line.reads for line in statements))
    corners = any(call.corner is not None for call in calls)
    return [] if corners else [name for name in ("branch", "g") if name not in read]


def declare_arguments(items: tuple[Argument, ...]) -> str:
    """Return the declaration of a function's arguments."""
    return ", ".join(map(_declare_argument, items))


def _declare_argument(item: Argument) -> str:
    """Return the declaration of one argument."""
    constant = "const " * (item.access in (Access.CONSTANT, Access.READ))
    pointer = "*" * (item.access in (Access.READ, Access.WRITTEN))
    return f"{constant}{type_name(item.type)} {pointer}{item.name}"


def type_name(of: Type) -> str:
    """Return the type of one number or struct."""
    return _NUMBERS[of] if isinstance(of, Number) else of


def kernel(item: Kernel) -> str:
    """Return a whole function as C; the parts of a long one precede it."""
    return "\n".join("".join(f"{text}\n" for text, _ in own) for _, _, own in printed_parts(item))


def _names_used(item: Kernel) -> frozenset[str]:
    """Return the names of everything that a function's lines read or write."""
    lines = [line for section in item.sections for line in section.statements]
    names = NONE.union(*(line.reads | line.writes for line in lines))
    keys = names | {key_of(s) for line in lines for x in line.expressions for s in symbols_of(x)}
    called = (item.names.get(key, key) for key in keys)
    corner = NONE if item.first_corner is None else {CORNER.name}
    return names | corner | {key.base if isinstance(key, Place) else key for key in called}


def comment(doc: Sequence[str]) -> str:
    """Return paragraphs as a comment of C."""
    text = "\n".join(f" * {comment_text(one)}".rstrip() for one in doc)
    return f"/*\n{text}\n */\n"


def function(
    item: Kernel, writer: Lines, own: Readable, names_used: frozenset[str] = NONE, *, called: bool = False
) -> str:
    """Return a function with its comment; unread arguments are cast to void.

    `called`: from another unit, not static.
    """
    return "".join(f"{text}\n" for text, _ in pieces(item, writer, own, names_used, called=called))


def pieces(
    item: Kernel, writer: Lines, own: Readable, names_used: frozenset[str] = NONE, *, called: bool = False
) -> Iterator[tuple[str, Line | None]]:
    """Yield the texts of a function in order, each with the line of the kernel that it prints, or None."""
    attribute = f"__attribute__(({item.attribute})) " if item.attribute else ""
    inline = "inline " if item.inline else ""
    static = "" if called else "static "
    result = "int" if item.status else "void"
    head = f"{attribute}{static}{inline}{result} {item.name}({declare_arguments(item.arguments)})"
    together = head.replace(", ", ",\n").replace(" ", "\0").replace("\n", " ")  # an argument is never parted
    head = "\n".join(textwrap.wrap(together, WIDTH, subsequent_indent="    ")).replace("\0", " ")
    yield f"{comment(item.doc)}{head}\n{{", None
    names_used |= _names_used(item)
    if unread := ", ".join(f"(void){a.name}" for a in item.arguments if a.name not in names_used):
        yield "\n".join(broken(f"    {unread};")), None
    for k, section in enumerate(own.sections):
        title = [f"    /* {comment_text(section.title)} */"] * bool(section.title)
        if before := [*([""] * bool(k)), *title]:
            yield "\n".join(before), None
        yield from ((writer.line(line), line) for line in section.statements)
    if not own.sections:
        yield "    /* this scene has none */", None
    yield "}", None


def printed_parts(item: Kernel) -> Iterator[tuple[Kernel, Readable, list[tuple[str, Line | None]]]]:
    """Yield the parts of a function in the order of their use, with their text line by line."""
    for part in cut(item):
        own = readable(part)
        yield part, own, list(pieces(part, Lines(CPrinter(own)), own, called=part.name in CALLED_BY_ENGINE))

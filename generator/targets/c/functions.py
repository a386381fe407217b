"""Lines of functions, and whole functions, as C11."""

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
    Branches,
    Call,
    Declare,
    Ended,
    Guard,
    Jump,
    Largest,
    LargestRow,
    Line,
    Passed,
    Rescue,
    Return,
    RunNumbers,
    Sines,
    Statement,
    Status,
    Unread,
    When,
)
from gudgeon.generator.ir.values import NONE
from gudgeon.generator.kernels.shared import CORNER, SharedCall
from gudgeon.generator.symbols.derivatives import symbols_of
from gudgeon.generator.symbols.storage import Place, key_of
from gudgeon.generator.targets.c.printer import WIDTH, CPrinter, Text, broken, comment_text, expression

# Functions that engine/scene/kernels.h declares: the engine calls them from a unit of its own.
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
    """Lines of one function as C; `number` is the type of its locals."""

    def __init__(self, printer: CPrinter, number: str = "double") -> None:
        super().__init__(printer)
        self.number = number

    def line(self, item: Line) -> str:
        """Any line, as long as it must be."""
        if isinstance(item, Statement):
            return self.statement(item)
        return "\n".join(part for text in self._lines(item) for part in broken(f"    {text}"))

    def _lines(self, item: Line) -> Sequence[str]:
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
            case Passed():
                return [f"{'' if item.status == 'pivot' else 'const int '}{item.status} = {self._call(item.call)};"]
            case Ended():
                return [f"if ({item.status})", f"    {'goto dependent' if item.jumps else f'return {item.status}'};"]
            case Branches():
                return _sides(item)
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
        given = [self.handed_over(x) if isinstance(x, Place) else self._number(x) for x in item.given]
        return f"{item.function}({', '.join([*given, *map(self.handed_over, item.results)])})"

    def _number(self, value: sp.Basic) -> str:
        """A count, or 0, is no double."""
        return str(value) if isinstance(value, sp.Integer) else self.expression(value)

    def handed_over(self, place: Place) -> str:
        """A struct within another one by its address, all else as it is."""
        text = self.printer.called(place)
        return f"&{text}" if place.path else text

    def _guard(self, item: Guard) -> list[str]:
        fails = self._call(item.test) if isinstance(item.test, Call) else f"!({self.test(item.test)})"
        only = f"{self.test(item.only)} && " if item.only else ""
        if not item.jumps:
            return [f"if ({only}{fails})", f"    return {item.number};"]
        return [f"if ({only}{fails}) {{", f"    pivot = {item.number};", "    goto dependent;", "}"]

    def _sines(self, item: Sines) -> list[str]:
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
        first, *others = map(self.expression, item.values)
        lines = ["*row = 1;", *([f"double most = fabs({first});"] if others else [])]
        for r, value in enumerate(others, 2):
            lines += [f"if (fabs({value}) > most) {{", f"    most = fabs({value});", f"    *row = {r};", "}"]
        return lines

    def statement(self, item: Statement) -> str:
        """One assignment; its comment behind it where there is room, else in front."""
        target = self.printer.called(item.target)
        head = f"const {self.number} {target}" if item.defines else target
        code = broken(f"    {head} = {self.expression(item.value)};")
        if not item.comment:
            return "\n".join(code)
        comment = f"/* {comment_text(item.comment)} */"
        if len(code) == 1 and len(code[0]) + len(comment) + 2 <= WIDTH:
            return f"{code[0]}  {comment}"
        return "\n".join([f"    {comment}", *code])


def _sides(item: Branches) -> list[str]:
    held = (
        "discrete->held ? discrete->branch : NULL;"
        if item.held
        else "NULL; /* of corners within corners: as they are */"
    )
    told = {"": [], "nobody": ["double g[N_SWITCHES + 1];"], "rhs": ["double *const g = rhs->g;"]}[item.told]
    return [f"const double *const branch = {held}", *told]


def statements(items: Sequence[Statement]) -> str:
    """Those that stand in a function of a template."""
    return "\n".join(text for text, _ in one_by_one(items))


def one_by_one(items: Sequence[Statement]) -> list[tuple[str, Line]]:
    """The text of each, and the branches in front of it, with the line that it is."""
    own = lines(items)
    writer = Lines(CPrinter(own))
    return [(writer.line(line), line) for section in own.sections for line in section.statements]


def shared_call(call: SharedCall, given: Sequence[str], results: Sequence[str]) -> str:
    """A joint's call of a function that joints share."""
    held = ["branch", "g", str(call.corner)] if call.corner is not None else []
    numbers = map(expression, call.numbers)
    return f"{call.kernel.name}({', '.join([*given, *numbers, *held, *results])});"


def unread_branches(calls: Iterable[SharedCall], statements: Iterable[Statement] = ()) -> list[str]:
    """Which of `branch` and `g` neither the calls, if they have corners, nor the statements read."""
    read = NONE.union(*(line.reads for line in statements))
    corners = any(call.corner is not None for call in calls)
    return [] if corners else [name for name in ("branch", "g") if name not in read]


def arguments(items: tuple[Argument, ...]) -> str:
    return ", ".join(map(_argument, items))


def _argument(item: Argument) -> str:
    constant = "const " * (item.access in (Access.CONSTANT, Access.READ))
    pointer = "*" * (item.access in (Access.READ, Access.WRITTEN))
    return f"{constant}{type_name(item.type)} {pointer}{item.name}"


def type_name(of: Type) -> str:
    """Return the type of one number or struct."""
    return _NUMBERS[of] if isinstance(of, Number) else of


def kernel(item: Kernel) -> str:
    """A whole function, a long one behind its parts."""
    return "\n".join("".join(f"{text}\n" for text, _ in own) for _, _, own in printed(item))


def _touched(item: Kernel) -> frozenset[str]:
    """What its lines read and write, by what it is called there."""
    lines = [line for section in item.sections for line in section.statements]
    names = NONE.union(*(line.reads | line.writes for line in lines))
    keys = names | {key_of(s) for line in lines for x in line.expressions for s in symbols_of(x)}
    called = (item.names.get(key, key) for key in keys)
    corner = NONE if item.first_corner is None else {CORNER.name}
    return names | corner | {key.base if isinstance(key, Place) else key for key in called}


def comment(doc: Sequence[str]) -> str:
    """Paragraphs as a comment of C."""
    text = "\n".join(f" * {comment_text(one)}".rstrip() for one in doc)
    return f"/*\n{text}\n */\n"


def function(
    item: Kernel, writer: Lines, own: Readable, touched: frozenset[str] = NONE, *, called: bool = False
) -> str:
    """Its doc comment in front; arguments that it does not touch are voided. `called`: from another unit."""
    return "".join(f"{text}\n" for text, _ in pieces(item, writer, own, touched, called=called))


def pieces(
    item: Kernel, writer: Lines, own: Readable, touched: frozenset[str] = NONE, *, called: bool = False
) -> Iterator[tuple[str, Line | None]]:
    """The text of a function in its order, what is a line's own with that line."""
    attribute = f"__attribute__(({item.attribute})) " if item.attribute else ""
    inline = "inline " if item.inline else ""
    static = "" if called else "static "
    head = f"{attribute}{static}{inline}{'int' if item.status else 'void'} {item.name}({arguments(item.arguments)})"
    together = head.replace(", ", ",\n").replace(" ", "\0").replace("\n", " ")  # an argument is never parted
    head = "\n".join(textwrap.wrap(together, WIDTH, subsequent_indent="    ")).replace("\0", " ")
    yield f"{comment(item.doc)}{head}\n{{", None
    touched |= _touched(item)
    if unread := ", ".join(f"(void){a.name}" for a in item.arguments if a.name not in touched):
        yield "\n".join(broken(f"    {unread};")), None
    for k, section in enumerate(own.sections):
        title = [f"    /* {comment_text(section.title)} */"] * bool(section.title)
        if before := [*([""] * bool(k)), *title]:
            yield "\n".join(before), None
        yield from ((writer.line(line), line) for line in section.statements)
    if not own.sections:
        yield "    /* this scene has none */", None
    yield "}", None


def printed(item: Kernel) -> Iterator[tuple[Kernel, Readable, list[tuple[str, Line | None]]]]:
    """The parts of a function, as they are read, with their text line by line."""
    for part in cut(item):
        own = readable(part)
        yield part, own, list(pieces(part, Lines(CPrinter(own)), own, called=part.name in CALLED_BY_ENGINE))

"""Lines of functions, and whole functions, as C11."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence

import sympy as sp

from gudgeon.generator.ir.kernels import Argument, Kernel
from gudgeon.generator.ir.split import cut
from gudgeon.generator.ir.statements import (
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
    Sides,
    Sines,
    Statement,
    Status,
    Unread,
    When,
)
from gudgeon.generator.ir.values import NONE, Place
from gudgeon.generator.targets.c.printer import comment_text, expression, test

WIDTH = 110
# Functions that engine/scene/kernels.h declares: the engine calls them from a unit of its own.
CALLED_BY_ENGINE = frozenset({
    "prepare", "mass_matrix", "constraints", "jacobian", "velocity_rhs", "acceleration_rhs", "start_values", "dynamics",
    "outputs", "expand", "reduce_state", "reduce_accelerations", "reduced_dynamics", "closures", "closure_rates",
    "reduced_project", "closing_step", "linearize", "newton_factor", "newton_substitute", "newton_solve",
    "chain_directions", "chain_step", "chain_rates", "chain_third", "chain_corners", "close_step", "arrive", "project",
    "watched_functions", "watched_ranges", "time_terms", "drive_corners", "drive_corner_ranges",
})  # fmt: skip


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
    given = [handed_over(x) if isinstance(x, Place) else _number(x) for x in item.given]
    return f"{item.function}({', '.join([*given, *map(handed_over, item.results)])})"


def _number(value: sp.Basic) -> str:
    """A count, or 0, is no double."""
    return str(value) if isinstance(value, sp.Integer) else expression(value)


def handed_over(place: Place) -> str:
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
    return wrapped(text, " " * 8) + comment


def wrapped(text: str, indent: str = "    ") -> str:
    """Lines no longer than WIDTH, broken at spaces."""
    lines = textwrap.wrap(text, WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
    return "\n".join(lines) if len(text) > WIDTH else text


def arguments(items: tuple[Argument, ...]) -> str:
    return ", ".join(f"{a.type}{a.name}" if a.type.endswith("*") else f"{a.type} {a.name}" for a in items)


def kernel(item: Kernel) -> str:
    """A whole function, a long one behind its parts."""
    return "\n".join(function(part, line, called=part.name in CALLED_BY_ENGINE) for part in cut(item))


def function(
    item: Kernel, written: Callable[[Line], str], touched: frozenset[str] = NONE, *, called: bool = False
) -> str:
    """Its doc comment in front; arguments that it does not touch are voided. `called`: from another unit."""
    body = "\n\n".join(
        "\n".join([f"    /* {comment_text(section.title)} */", *map(written, section.statements)])
        for section in item.sections
    )
    touched = touched.union(*(x.reads | x.writes for section in item.sections for x in section.statements))
    voids = "".join(f"    (void){a.name};\n" for a in item.arguments if a.name not in touched)
    doc = "\n".join(f" * {comment_text(text)}" for text in item.doc)
    attribute = f"__attribute__(({item.attribute})) " if item.attribute else ""
    inline = "inline " if item.inline else ""
    static = "" if called else "static "
    head = f"{attribute}{static}{inline}{item.returns} {item.name}({arguments(item.arguments)})"
    wrapped = textwrap.wrap(head.replace(" *", "\0*"), WIDTH, subsequent_indent="    ")  # no break inside a type
    head = "\n".join(wrapped).replace("\0*", " *")
    return f"/*\n{doc}\n */\n{head}\n{{\n{voids}{body}\n}}\n"

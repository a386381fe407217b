"""Joins the parts of a long function that are equal but for names, numbers of elements, parameters and statuses.

Such parts belong to equal bars or joints. They are printed once, as a function that reads what differs from a table of
indices, and each part becomes a call with its row of the table. Statements and their order stay as they are: the
numbers are the same, bit for bit.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.readable import Readable
from gudgeon.generator.ir.repeats import MIN_REPETITIONS
from gudgeon.generator.ir.signatures import Access, Number, make_input_argument
from gudgeon.generator.ir.statements import AssignStatus, Call, Line, Statement
from gudgeon.generator.symbols.storage import PARAMETERS, Place
from gudgeon.generator.targets.c.printer import WIDTH

_TABLE = make_input_argument("at", Number.INTEGER)  # the argument with a part's row of the table
PARAMETER_INDEX = "PARAMETER_INDEX"  # the macro of engine/scene/types.h that numbers the parameters
_COMMENT = re.compile(r"(/\*.*?\*/)", re.DOTALL)
_SPACE = re.compile(r"\s+")
# What may differ between equal parts, a parameter, the number of an element or a status; and names.
_OPERAND = rf"\b{PARAMETERS}->\w+(?![\w\[])|\[\d+\]|return \d+;"
_TOKEN = re.compile(rf"({_OPERAND}|(?<![\w>.])[A-Za-z_]\w*)")
_NAME = re.compile(r"[A-Za-z_]\w*")
_DECLARED = re.compile(r"\bdouble (\w+)\b")
_TAKES_ADDRESS = "evaluate_contour("  # the function that is called with the address of a parameter

TextOfLine = tuple[str, Line | None]
PrintedPart = tuple[Kernel, Readable, list[TextOfLine]]  # the first text is the head of the function


@dataclass(frozen=True)
class _Body:
    """The texts of a part without its head, each copy of an argument or passed value before the first use of its name.

    `key`: the text without what may differ; `operands`: what may differ, in the order of the text, as elements of a
    table in C.
    """

    texts: list[TextOfLine]
    key: str
    operands: list[str]


def join_equal_parts(
    parts: Sequence[PrintedPart], print_head: Callable[[Kernel, Readable], str]
) -> tuple[list[PrintedPart], dict[str, Call]]:
    """Return the printed parts of a function, equal ones once, and the beginning of each new call by the part's name.

    Parts with equal text are joined if there are MIN_REPETITIONS or more. `print_head` prints the head of a function.
    A call begins with the function's name and the address of the part's row; the arguments of the old call follow.
    """
    bodies = [_read_body(part) for part in parts]
    groups: dict[str, list[int]] = {}
    for k, body in enumerate(bodies):
        groups.setdefault(body.key, []).append(k)
    joined: list[PrintedPart] = []
    calls: dict[str, Call] = {}
    for k, part in enumerate(parts):
        group = groups[bodies[k].key]
        if len(group) < MIN_REPETITIONS:
            joined.append(part)
        elif k == group[0]:
            table = _Table(f"{part[0].name}_rows", [bodies[member].operands for member in group])
            joined.append(_print_joined_part(part, bodies[k], table, print_head))
            calls |= {parts[member][0].name: table.make_call(part[0].name, row) for row, member in enumerate(group)}
    return joined, calls


def redirect_calls(kernel: Kernel, calls: Mapping[str, Call]) -> Kernel:
    """Return the function with the calls of parts that were joined replaced. `calls`: as of `join_equal_parts`."""

    def redirect(call: Call) -> Call:
        """Return the new call of a part."""
        new = calls.get(call.function, call)
        return call if new is call else replace(new, inputs=(*new.inputs, *call.inputs), results=call.results)

    def redirect_line(line: Line) -> Line:
        """Return a line with its call replaced."""
        if isinstance(line, Call):
            return redirect(line)
        return replace(line, call=redirect(line.call)) if isinstance(line, AssignStatus) else line

    sections = (Section(section.title, tuple(map(redirect_line, section.statements))) for section in kernel.sections)
    return replace(kernel, sections=tuple(sections))


class _Table:
    """The table of what differs between equal parts: a row for each part.

    Operands that are equal in all parts are not in it, and of those that differ by the same constant in all parts only
    the first: `elements` has the text of each operand in the function, None for an operand that stays as it is.
    """

    def __init__(self, name: str, operands_of_parts: Sequence[Sequence[str]]) -> None:
        """Make the table `name` of the operands of each part, lists of equal lengths."""
        self.name, self.n_rows = name, len(operands_of_parts)
        self.columns: list[tuple[str, ...]] = []
        self.elements: list[str | None] = []
        column_by_increments: dict[tuple[int, ...] | tuple[str, ...], int] = {}
        for column in zip(*operands_of_parts, strict=True):
            if column.count(column[0]) == len(column):
                self.elements.append(None)
                continue
            increments = tuple(int(x) - int(column[0]) for x in column) if column[0].isdigit() else column
            k = column_by_increments.setdefault(increments, len(self.columns))
            if k == len(self.columns):
                self.columns.append(column)
            offset = int(column[0]) - int(self.columns[k][0]) if column[0].isdigit() else 0
            distance = f" {'-' if offset < 0 else '+'} {abs(offset)}" if offset else ""
            self.elements.append(f"{_TABLE.name}[{k}]{distance}")

    def make_call(self, function: str, row: int) -> Call:
        """Return the beginning of the call of the joined function with a row."""
        return Call(function, (Place(self.name)[row * len(self.columns)],) if self.columns else (), ())

    def print_definition(self) -> str:
        """Return the table in C; "" without columns."""
        if not self.columns:
            return ""
        lines, line = list[str](), "   "
        for element in (element for row in zip(*self.columns, strict=True) for element in row):
            if len(line) + len(element) + 2 > WIDTH:
                lines.append(line)
                line = "   "
            line += f" {element},"
        return "\n".join([f"static const int {self.name}[] = {{", *lines, line, "};\n"])


def _read_body(part: PrintedPart) -> _Body:
    """Return the texts of a printed part without its head, with what it has in common with equal parts."""
    kernel, _, (_, *texts) = part
    ordered = list(_move_copies_to_first_use(texts))
    text = _COMMENT.sub("", "\n".join([text for text, _ in ordered]))
    names = {name: f"%{k}" for k, name in enumerate(dict.fromkeys(_DECLARED.findall(text)))}
    pieces = _TOKEN.split(text)
    operands: list[str] = []
    for k in range(1, len(pieces), 2):
        token = pieces[k]
        if token in names:
            pieces[k] = names[token]
        elif operand := _find_operand(token):
            operands.append(operand[1])
            pieces[k] = operand[0]
    key = _SPACE.sub(" ", f"{kernel.status} {''.join(pieces)}")
    return _Body(ordered, kernel.name if _TAKES_ADDRESS in key else key, operands)


def _find_operand(token: str) -> tuple[str, str] | None:
    """Return what a token has in common with those of equal parts, and what may differ; None for other names."""
    if token[0] == "[":
        return "[]", token[1:-1]
    if token.startswith(f"{PARAMETERS}->"):
        return f"{PARAMETERS}->", f"{PARAMETER_INDEX}({token[len(PARAMETERS) + 2 :]})"
    return ("return ;", token[7:-1]) if token[-1] == ";" else None


def _move_copies_to_first_use(texts: Iterable[TextOfLine]) -> Iterator[TextOfLine]:
    """Yield the texts of a part, copies of arguments and of passed values just before the first use of their names.

    Their order is then that of the text, not that of their names.
    """
    copies: dict[str, TextOfLine] = {}
    for text, line in texts:
        if isinstance(line, Statement) and line.declared_local and isinstance(line.value, Place):
            copies[_DECLARED.findall(text)[0]] = text, line
            continue
        if line is not None and copies:
            for name in _NAME.findall(text):
                if name in copies:
                    yield copies.pop(name)
        yield text, line
    assert not copies


def _replace_tokens(text: str, replace_token: Callable[[re.Match[str]], str]) -> str:
    """Return a text of C with the tokens outside of comments replaced."""
    pieces = _COMMENT.split(text)
    pieces[::2] = [_TOKEN.sub(replace_token, piece) for piece in pieces[::2]]
    return "".join(pieces)


def _print_joined_part(
    part: PrintedPart, body: _Body, table: _Table, print_head: Callable[[Kernel, Readable], str]
) -> PrintedPart:
    """Return the function of equal parts with its table. `part` and `body`: the first of these parts."""
    kernel, readable, _ = part
    is_constant = any(a.name == PARAMETERS and a.access is Access.READ for a in kernel.arguments)
    parameters = f"(({'const ' * is_constant}double *){PARAMETERS})"
    elements = iter(table.elements)

    def replace_token(match: re.Match[str]) -> str:
        """Return a token as the function reads it from its row of the table."""
        operand = _find_operand(match[0])
        element = next(elements) if operand else None
        if not operand or element is None:
            return match[0]
        return {"[]": f"[{element}]", "return ;": f"return {element};"}.get(operand[0], f"{parameters}[{element}]")

    texts = [(_replace_tokens(text, replace_token), line) for text, line in body.texts]
    note = f"{table.n_rows} parts are equal; names are those of the first, `{_TABLE.name}` is a row of a table."
    arguments = (*((_TABLE,) if table.columns else ()), *kernel.arguments)
    head = print_head(replace(kernel, doc=(*kernel.doc, note), arguments=arguments), readable)
    definition: list[TextOfLine] = [(table.print_definition(), None)] if table.columns else []
    return kernel, readable, [*definition, (head, None), *texts]

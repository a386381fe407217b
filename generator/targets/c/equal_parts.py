"""Merges clones among the outlined parts of a long C function: parts that differ in names, indices and parameters only.

Such parts belong to equal bars or joints. They are printed once, as a function that reads the differing operands
(indices, parameters, statuses) from a table. Each part becomes a call with its row of the table. Statements and
their order stay as they are, so that results are the same bit for bit.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.part_structure import PartStructure, find_part_structure, format_parameter_placeholder
from gudgeon.generator.ir.readable import Readable, make_readable
from gudgeon.generator.ir.repeats import MIN_REPETITIONS
from gudgeon.generator.ir.signatures import Access, Number, make_input_argument
from gudgeon.generator.ir.statements import AssignStatus, Call, Instruction, Statement
from gudgeon.generator.symbols.storage import PARAMETERS, StorageLocation
from gudgeon.generator.targets.c.printer import WIDTH

_TABLE_ROW = make_input_argument("table_row", Number.INTEGER)  # the argument with a part's row of the table
PARAMETER_INDEX = "PARAMETER_INDEX"  # the macro of engine/scene/types.h that numbers the parameters
_COMMENT = re.compile(r"(/\*.*?\*/)", re.DOTALL)
_SPACE = re.compile(r"\s+")
# Operands, which may differ between clones: a parameter, the index of an element or a returned status; and names.
_OPERAND = rf"\b{PARAMETERS}->\w+(?![\w\[])|\[\d+\]|return \d+;"
_TOKEN = re.compile(rf"({_OPERAND}|(?<![\w>.])[A-Za-z_]\w*)")
_NAME = re.compile(r"[A-Za-z_]\w*")
_DECLARED = re.compile(r"\bdouble (\w+)\b")
_CALL_WITH_ADDRESS = "evaluate_contour("  # the call that gets the address of a parameter; a table cannot replace that

TextOfLine = tuple[str, Instruction | None]
PrintedPart = tuple[Kernel, Readable, list[TextOfLine]]  # the first text is the head of the function
PrintLines = Callable[[Kernel, Readable], Iterator[TextOfLine]]


@dataclass(frozen=True)
class _NormalizedPart:
    """The texts of a part without its head, each copy of an argument or passed value before the first use of its name.

    `key`: the text without operands and with numbered locals, equal for clones. `operands`: the operands in the order
    of the text, as elements of a table in C.
    """

    texts: list[TextOfLine]
    key: str
    operands: list[str]


def print_part(part: Kernel, print_lines: PrintLines) -> PrintedPart:
    """Return (kernel, its readable form, [(C text, line or None)]) of a kernel that is one C function."""
    readable = make_readable(part)
    return part, readable, list(print_lines(part, readable))


def merge_equal_parts(parts: Sequence[Kernel], print_lines: PrintLines) -> tuple[list[PrintedPart], dict[str, Call]]:
    """Return (printed parts with clones merged, {name of a merged part: its new call without the old arguments}).

    Parts with the same normalized text are merged if there are at least MIN_REPETITIONS; the first of them becomes the
    function. `print_lines` prints a kernel line by line, head first. `redirect_calls` applies the new calls.
    """
    normalized_parts, printed = _normalize_parts(parts, print_lines)
    groups: dict[str, list[int]] = {}
    for k, normalized in enumerate(normalized_parts):
        groups.setdefault(normalized.key, []).append(k)
    joined: list[PrintedPart] = []
    calls: dict[str, Call] = {}
    for k, part in enumerate(parts):
        group = groups[normalized_parts[k].key]
        if len(group) < MIN_REPETITIONS:
            joined.append(printed.get(k) or print_part(part, print_lines))
        elif k == group[0]:
            table = _OperandTable(f"{part.name}_rows", [normalized_parts[member].operands for member in group])
            joined.append(_print_joined_part(printed[k], normalized_parts[k], table, print_lines))
            calls |= {parts[member].name: table.make_call(part.name, row) for row, member in enumerate(group)}
    return joined, calls


def _normalize_parts(
    parts: Sequence[Kernel], print_lines: PrintLines
) -> tuple[list[_NormalizedPart], dict[int, PrintedPart]]:
    """Return the parts in normalized form, and by number those of them that are printed.

    Of MIN_REPETITIONS or more parts with equal structure (ir/part_structure.py) the first is printed; the others differ
    from it in their operands only, and have its texts.
    """
    structures = [find_part_structure(part) for part in parts]
    counts = Counter(structure.key for structure in structures if structure)
    normalized_parts: list[_NormalizedPart] = []
    printed: dict[int, PrintedPart] = {}
    first_by_structure: dict[Hashable, int] = {}
    sources: dict[int, list[int | str]] = {}
    for k, (part, structure) in enumerate(zip(parts, structures, strict=True)):
        repeats = structure is not None and counts[structure.key] >= MIN_REPETITIONS
        first = first_by_structure.setdefault(structure.key, k) if structure and repeats else k
        if structure is None or first == k:
            printed[k] = print_part(part, print_lines)
            normalized_parts.append(_normalize_part(printed[k]))
            continue
        if first not in sources:
            sources[first] = _find_operand_sources(printed[first], normalized_parts[first].key, print_lines)
        operands = [_format_operand(structure, source) for source in sources[first]]
        normalized_parts.append(replace(normalized_parts[first], operands=operands))
    return normalized_parts, printed


def _find_operand_sources(part: PrintedPart, key: str, print_lines: PrintLines) -> list[int | str]:
    """Return for each operand in the order of the text its placeholder, or its text if equal parts share it.

    The placeholders stand for the operands that differ between parts of equal structure; the part is printed with them
    to find their order. `key`: that of the normalized part, which must not change.
    """
    kernel, readable, _ = part
    structure = find_part_structure(kernel)
    assert structure
    part_with_placeholders = structure.insert_placeholders(readable)
    normalized = _normalize_part((kernel, part_with_placeholders, list(print_lines(kernel, part_with_placeholders))))
    assert normalized.key == key
    placeholder_by_text = {str(number): number for number in structure.list_placeholders()}
    placeholder_by_text |= {
        f"{PARAMETER_INDEX}({format_parameter_placeholder(number)})": number for number in structure.list_placeholders()
    }
    return [placeholder_by_text.get(text, text) for text in normalized.operands]


def _format_operand(structure: PartStructure, source: int | str) -> str:
    """Return an operand of a part as text, from its placeholder; a text is returned unchanged."""
    if isinstance(source, str):
        return source
    value = structure.get_replaced_value(source)
    return f"{PARAMETER_INDEX}({value})" if isinstance(value, str) else str(value)


def redirect_calls(kernel: Kernel, calls: Mapping[str, Call]) -> Kernel:
    """Return a function that calls the merged functions in place of its parts.

    `calls`: {name of a part: new call}, as `merge_equal_parts` returns them. Calls of other functions stay.
    """

    def redirect_call(call: Call) -> Call:
        """Return the new call of a part, with the arguments of the old call after the table row."""
        new_call = calls.get(call.function, call)
        if new_call is call:
            return call
        return replace(new_call, inputs=(*new_call.inputs, *call.inputs), results=call.results)

    def redirect_line(line: Instruction) -> Instruction:
        """Return a line with its call redirected: a call, or the assignment of its status; other lines unchanged."""
        if isinstance(line, Call):
            return redirect_call(line)
        return replace(line, call=redirect_call(line.call)) if isinstance(line, AssignStatus) else line

    sections = (Section(section.title, tuple(map(redirect_line, section.statements))) for section in kernel.sections)
    return replace(kernel, sections=tuple(sections))


class _OperandTable:
    """Contain the operands that differ between clones: one row for each part, one column for each operand.

    Operands that are equal in all parts have no column. Operands that differ by the same constant in all parts share
    one column. `elements` has the text of each operand in the merged function; None for an operand that is equal.
    """

    def __init__(self, name: str, operands_of_parts: Sequence[Sequence[str]]) -> None:
        """Store the columns of the table `name` for the operands of each part, lists of equal lengths."""
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
            self.elements.append(f"{_TABLE_ROW.name}[{k}]{distance}")

    def make_call(self, function: str, row: int) -> Call:
        """Return the call of the merged function whose only argument is a row of the table; none without columns."""
        return Call(function, (StorageLocation(self.name)[row * len(self.columns)],) if self.columns else (), ())

    def print_definition(self) -> str:
        """Return the table as a static array of int in C, row by row, wrapped at WIDTH; "" without columns."""
        if not self.columns:
            return ""
        lines, line = list[str](), "   "
        for element in (element for row in zip(*self.columns, strict=True) for element in row):
            if len(line) + len(element) + 2 > WIDTH:
                lines.append(line)
                line = "   "
            line += f" {element},"
        return "\n".join([f"static const int {self.name}[] = {{", *lines, line, "};\n"])


def _normalize_part(part: PrintedPart) -> _NormalizedPart:
    """Return a printed part without its head, with its operands and the key that is equal for clones.

    In the key, locals are numbered in the order of their declarations, comments are removed and operands are empty. A
    part with _CALL_WITH_ADDRESS has its own name as the key, so that it is never merged.
    """
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
        elif operand := _split_operand(token):
            operands.append(operand[1])
            pieces[k] = operand[0]
    key = _SPACE.sub(" ", f"{kernel.status} {''.join(pieces)}")
    return _NormalizedPart(ordered, kernel.name if _CALL_WITH_ADDRESS in key else key, operands)


def _split_operand(token: str) -> tuple[str, str] | None:
    """Return (text that clones share, text that may differ) of an operand; None for a token that is a name.

    Examples: "[3]" gives ("[]", "3"), "return 2;" gives ("return ;", "2"), and "p->mass" gives
    ("p->", "PARAMETER_INDEX(mass)").
    """
    if token[0] == "[":
        return "[]", token[1:-1]
    if token.startswith(f"{PARAMETERS}->"):
        return f"{PARAMETERS}->", f"{PARAMETER_INDEX}({token[len(PARAMETERS) + 2 :]})"
    return ("return ;", token[7:-1]) if token[-1] == ";" else None


def _move_copies_to_first_use(texts: Iterable[TextOfLine]) -> Iterator[TextOfLine]:
    """Yield the texts of a part in order, but each copy of a storage place just before the first use of its name.

    A copy is a statement that declares a local with the value of an argument or element. Its position then no longer
    depends on its name. Every copy must be used.
    """
    copies: dict[str, TextOfLine] = {}
    for text, line in texts:
        if isinstance(line, Statement) and line.declared_local and isinstance(line.value, StorageLocation):
            copies[_DECLARED.findall(text)[0]] = text, line
            continue
        if line is not None and copies:
            for name in _NAME.findall(text):
                if name in copies:
                    yield copies.pop(name)
        yield text, line
    assert not copies


def _replace_tokens(text: str, replace_token: Callable[[re.Match[str]], str]) -> str:
    """Return a text of C in which `replace_token` replaces each match of _TOKEN outside of comments."""
    pieces = _COMMENT.split(text)
    pieces[::2] = [_TOKEN.sub(replace_token, piece) for piece in pieces[::2]]
    return "".join(pieces)


def _print_joined_part(
    part: PrintedPart,
    normalized: _NormalizedPart,
    table: _OperandTable,
    print_lines: PrintLines,
) -> PrintedPart:
    """Return the merged function of clones, after the definition of its table if the table has columns.

    `part`, `normalized`: the first of the clones. The table row is the first argument of the function, and its comment
    gets a note.
    """
    kernel, readable, _ = part
    is_constant = any(a.name == PARAMETERS and a.access is Access.READ for a in kernel.arguments)
    parameters = f"(({'const ' * is_constant}double *){PARAMETERS})"
    elements = iter(table.elements)

    def read_operand_from_table(match: re.Match[str]) -> str:
        """Return an operand as an element of the table row, "[at[0]]" for "[3]"; names and equal operands unchanged.

        Called once for each token in the order of the text, since each operand takes the next of `elements`.
        """
        operand = _split_operand(match[0])
        element = next(elements) if operand else None
        if not operand or element is None:
            return match[0]
        return {"[]": f"[{element}]", "return ;": f"return {element};"}.get(operand[0], f"{parameters}[{element}]")

    texts = [(_replace_tokens(text, read_operand_from_table), line) for text, line in normalized.texts]
    note = f"{table.n_rows} parts are equal; names are those of the first, `{_TABLE_ROW.name}` is a row of a table."
    arguments = (*((_TABLE_ROW,) if table.columns else ()), *kernel.arguments)
    head, _ = next(iter(print_lines(replace(kernel, doc=(*kernel.doc, note), arguments=arguments), readable)))
    definition: list[TextOfLine] = [(table.print_definition(), None)] if table.columns else []
    return kernel, readable, [*definition, (head, None), *texts]

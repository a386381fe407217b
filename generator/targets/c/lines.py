"""Maps functions and assignments to their lines in the emitted C files, for highlighting in a page of equations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from gudgeon.generator.ir.branches import Branch
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import Readable
from gudgeon.generator.ir.statements import Instruction, Statement
from gudgeon.generator.symbols.storage import Key
from gudgeon.generator.targets.c.functions import print_kernel_parts
from gudgeon.generator.targets.c.printer import wrap_file


@dataclass(frozen=True)
class StoredLines:
    """Represent the lines (from 1) of a file that store to a variable; a branch has two such entries.

    `condition`: "<" and the name of the condition for the store where the condition is below zero, ">" for the other
    store; "" for a line without a branch.
    """

    target: Key
    lines: range
    condition: str = ""


@dataclass(frozen=True)
class LocatedFunction:
    """Represent a function, or a part of one, with its lines in a file and the stores in these lines."""

    file: str
    name: str
    readable_part: Readable
    first: int
    last: int
    lines: tuple[StoredLines, ...]


def locate_function(kernel: Kernel, files: Mapping[str, str]) -> Iterator[LocatedFunction]:
    """Yield the printed parts of a kernel with their locations in the C files.

    files: the text of each file by name. Parts that no file contains are left out.
    """
    for part, readable_part, texts_with_lines in print_kernel_parts(kernel):
        texts = [wrap_file(text).split("\n") for text, _ in texts_with_lines]
        function_text = "\n".join(line for text in texts for line in text)
        file = next((name for name, text in files.items() if f"{function_text}\n" in text), None)
        if file is None:
            continue
        line_number = first_line = 1 + files[file].count("\n", 0, files[file].index(f"{function_text}\n"))
        stores: list[StoredLines] = []
        for text, (_, line) in zip(texts, texts_with_lines, strict=True):
            stores += _find_stores(text, line, line_number)
            line_number += len(text)
        yield LocatedFunction(file, part.name, readable_part, first_line, line_number - 1, tuple(stores))


def _find_stores(text: Sequence[str], line: Instruction | str | None, first_line: int) -> list[StoredLines]:
    """Return the variables to which a printed line stores, each with its lines in the file; [] without an assignment.

    A branch gives two entries, one for each of its two values.

    text: the printed C, which begins at line `first_line` of the file. line: the line of the kernel that it prints, or
    the name of the local that it sets; None for neither.
    """
    lines = range(first_line, first_line + len(text))
    if isinstance(line, str):
        return [StoredLines(line, lines)]
    if isinstance(line, Statement):
        return [StoredLines(line.target, lines)]
    if not isinstance(line, Branch):
        return []
    else_line, condition = (
        first_line + text.index("    else"),
        line.active_branch.name if line.active_branch.is_Symbol else "",
    )
    below, above = range(first_line, else_line), range(else_line, lines.stop)
    return [StoredLines(line.target, below, f"<{condition}"), StoredLines(line.target, above, f">{condition}")]


def locate_stores(
    function_text: str, stores: Iterable[tuple[str, Instruction | str]], files: Mapping[str, str]
) -> tuple[str, list[StoredLines]]:
    """Return (file, stores with their lines) of a function that a template printed; ("", []) if no file contains it.

    stores: (C text, line of the kernel or name of the local) of each assignment, in the order of the function. files:
    the text of each file by name.
    """
    file, lines = locate_text(function_text, files)
    remaining_text, line_number, located_stores = wrap_file(function_text), lines.start, list[StoredLines]()
    for text, line in stores if file else ():
        store_text = wrap_file(text)
        skipped, _, remaining_text = remaining_text.partition(f"{store_text}\n")
        line_number += skipped.count("\n")
        located_stores += _find_stores(store_text.split("\n"), line, line_number)
        line_number += store_text.count("\n") + 1
    return file, located_stores


def locate_text(text: str, files: Mapping[str, str]) -> tuple[str, range]:
    """Return the file that contains a text, and its lines there, counted from 1; ("", empty range) if none does.

    The text is first wrapped as emitted files are (`wrap_file`). An empty text is in no file.
    """
    wrapped = wrap_file(text)
    file = next((name for name, file_text in files.items() if wrapped in file_text), "")
    if not file or not wrapped.strip():
        return "", range(0)
    first_line = 1 + files[file].count("\n", 0, files[file].index(wrapped))
    return file, range(first_line, first_line + wrapped.rstrip("\n").count("\n") + 1)

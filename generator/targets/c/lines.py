"""Finds the lines of a function in the emitted files, which a page highlights."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from gudgeon.generator.ir.branches import Branch
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import Readable
from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.symbols.storage import Key
from gudgeon.generator.targets.c.functions import printed_parts
from gudgeon.generator.targets.c.printer import within


@dataclass(frozen=True)
class Stored:
    """Represent a store to a variable and its lines (from 1); a branch has two.

    `where`: "<" and the name of the condition for the store where it is below zero, ">" for the other; "": a plain
    line.
    """

    target: Key
    lines: range
    where: str = ""


@dataclass(frozen=True)
class Found:
    """Represent a function, or a part of one, and its lines in a file."""

    file: str
    name: str
    own: Readable
    first: int
    last: int
    lines: tuple[Stored, ...]


def find_function(kernel: Kernel, files: Mapping[str, str]) -> Iterator[Found]:
    """Yield the printed parts of a function with their locations; parts that no file contains are left out."""
    for part, own, pieces in printed_parts(kernel):
        texts = [within(text).split("\n") for text, _ in pieces]
        whole = "\n".join(line for text in texts for line in text)
        file = next((name for name, text in files.items() if f"{whole}\n" in text), None)
        if file is None:
            continue
        number = first = 1 + files[file].count("\n", 0, files[file].index(f"{whole}\n"))
        stored: list[Stored] = []
        for text, (_, line) in zip(texts, pieces, strict=True):
            stored += _find_stores(text, line, number)
            number += len(text)
        yield Found(file, part.name, own, first, number - 1, tuple(stored))


def _find_stores(text: Sequence[str], line: Line | str | None, first: int) -> list[Stored]:
    """Return the stores in a text of C; `line` is its statement, or the name of a local."""
    here = range(first, first + len(text))
    if isinstance(line, str):
        return [Stored(line, here)]
    if isinstance(line, Statement):
        return [Stored(line.target, here)]
    if not isinstance(line, Branch):
        return []
    other, side = first + text.index("    else"), line.side.name if line.side.is_Symbol else ""
    below, above = range(first, other), range(other, here.stop)
    return [Stored(line.target, below, f"<{side}"), Stored(line.target, above, f">{side}")]


def find_stores_in_text(
    whole: str, stores: Iterable[tuple[str, Line | str]], files: Mapping[str, str]
) -> tuple[str, list[Stored]]:
    """Return the file and the stores in a text that a template printed, in order, each with its own text."""
    file, lines = locate_text(whole, files)
    left, number, found = within(whole), lines.start, list[Stored]()
    for text, line in stores if file else ():
        own = within(text)
        before, _, left = left.partition(f"{own}\n")
        number += before.count("\n")
        found += _find_stores(own.split("\n"), line, number)
        number += own.count("\n") + 1
    return file, found


def locate_text(text: str, files: Mapping[str, str]) -> tuple[str, range]:
    """Return file and lines of a text that was printed whole; ("", empty range) if no file contains it."""
    whole = within(text)
    file = next((name for name, own in files.items() if whole in own), "")
    if not file or not whole.strip():
        return "", range(0)
    first = 1 + files[file].count("\n", 0, files[file].index(whole))
    return file, range(first, first + whole.rstrip("\n").count("\n") + 1)

"""Where the lines of a function stand in the files that were emitted: what a page lights up."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from gudgeon.generator.ir.branches import Branch
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import Readable
from gudgeon.generator.ir.statements import Line, Statement
from gudgeon.generator.symbols.storage import Key
from gudgeon.generator.targets.c.functions import printed
from gudgeon.generator.targets.c.printer import within


@dataclass(frozen=True)
class Stored:
    """What is stored to, and the lines (from 1) of it; a branch is two.

    `where`: "<" and the side's name of what is stored where that is below zero, ">" of the other; "": a plain line.
    """

    target: Key
    lines: range
    where: str = ""


@dataclass(frozen=True)
class Found:
    """A function, or a part of one, in a file."""

    file: str
    name: str
    own: Readable
    first: int
    last: int
    lines: tuple[Stored, ...]


def find(kernel: Kernel, files: Mapping[str, str]) -> Iterator[Found]:
    """The parts of a function, each where it was printed; a part that no file has is left out."""
    for part, own, pieces in printed(kernel):
        texts = [within(text).split("\n") for text, _ in pieces]
        whole = "\n".join(line for text in texts for line in text)
        file = next((name for name, text in files.items() if f"{whole}\n" in text), None)
        if file is None:
            continue
        number = first = 1 + files[file].count("\n", 0, files[file].index(f"{whole}\n"))
        stored: list[Stored] = []
        for text, (_, line) in zip(texts, pieces, strict=True):
            stored += _stored(text, line, number)
            number += len(text)
        yield Found(file, part.name, own, first, number - 1, tuple(stored))


def _stored(text: Sequence[str], line: Line | str | None, first: int) -> list[Stored]:
    """What a text of C stores to; `line`: what it is of, or the name of a local."""
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


def find_within(
    whole: str, stores: Iterable[tuple[str, Line | str]], files: Mapping[str, str]
) -> tuple[str, list[Stored]]:
    """File, and what is stored to in a text that a template printed: each store in its order, with its own text."""
    file, lines = place_of(whole, files)
    left, number, found = within(whole), lines.start, list[Stored]()
    for text, line in stores if file else ():
        own = within(text)
        before, _, left = left.partition(f"{own}\n")
        number += before.count("\n")
        found += _stored(own.split("\n"), line, number)
        number += own.count("\n") + 1
    return file, found


def place_of(text: str, files: Mapping[str, str]) -> tuple[str, range]:
    """File and lines of a text that was printed whole; ("", none) where no file has it."""
    whole = within(text)
    file = next((name for name, own in files.items() if whole in own), "")
    if not file or not whole.strip():
        return "", range(0)
    first = 1 + files[file].count("\n", 0, files[file].index(whole))
    return file, range(first, first + whole.rstrip("\n").count("\n") + 1)

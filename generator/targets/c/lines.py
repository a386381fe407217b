"""Where the lines of a function stand in the files that were emitted: what a page lights up."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from gudgeon.generator.ir.branches import Branch
from gudgeon.generator.ir.kernels import Kernel
from gudgeon.generator.ir.readable import Readable
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.targets.c.functions import printed
from gudgeon.generator.targets.c.layout import within


@dataclass(frozen=True)
class Found:
    """A function, or a part of one, in a file: what it stores to, and the lines (from 1) of each such statement."""

    file: str
    name: str
    own: Readable
    first: int
    last: int
    lines: tuple[tuple[str, range], ...]


def find(kernel: Kernel, files: Mapping[str, str]) -> Iterator[Found]:
    """The parts of a function, each where it was printed; a part that no file has is left out."""
    for part, own, pieces in printed(kernel):
        texts = [within(text).split("\n") for text, _ in pieces]
        whole = "\n".join(line for text in texts for line in text)
        file = next((name for name, text in files.items() if f"{whole}\n" in text), None)
        if file is None:
            continue
        number = first = 1 + files[file].count("\n", 0, files[file].index(f"{whole}\n"))
        stored: list[tuple[str, range]] = []
        for text, (_, line) in zip(texts, pieces, strict=True):
            if isinstance(line, (Statement, Branch)):
                stored.append((line.target, range(number, number + len(text))))
            number += len(text)
        yield Found(file, part.name, own, first, number - 1, tuple(stored))


def place_of(text: str, files: Mapping[str, str]) -> tuple[str, range]:
    """File and lines of a text that was printed whole; ("", none) where no file has it."""
    whole = within(text)
    file = next((name for name, own in files.items() if whole in own), "")
    if not file or not whole.strip():
        return "", range(0)
    first = 1 + files[file].count("\n", 0, files[file].index(whole))
    return file, range(first, first + whole.rstrip("\n").count("\n") + 1)

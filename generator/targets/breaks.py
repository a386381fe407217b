"""Where a long line of code is broken: as far out of brackets as it can be, and as late."""

from __future__ import annotations

from collections.abc import Iterator

_INDENT = "    "
_BEFORE = (" + ", " - ", " ? ", " : ", " && ", " || ", " * ", " / ")  # the operator begins the next line
_AFTER = (", ", " = ", "{")
_TIGHT = "*"  # in a product that is written without spaces: where there is nothing better


def broken(line: str, width: int, within: int | None = None) -> list[str]:
    """A line of code as lines of at most `width`; what goes on stands four spaces further in.

    `within`: at least so many brackets are open wherever it is broken.
    """
    indent = line[: len(line) - len(line.lstrip())]
    lines: list[str] = []
    while len(line) > width and (place := _place(line, len(indent), width, within)):
        lines.append(line[:place].rstrip())
        if within is not None:
            within -= sum((c in "([{") - (c in ")]}") for c in lines[-1])  # of those that were open before
        line = f"{indent}{_INDENT}{line[place:].lstrip()}"
    return [*lines, line]


def _place(line: str, first: int, width: int, within: int | None) -> int:
    """Where a line is broken: in its latter half if it can be, as far out of brackets and as late as it can be."""
    found: list[tuple[float, int]] = []
    for depth, place in _places(line):
        if place > width and found:
            break  # of a line of a megabyte no more is read than of a short one
        if place > first + len(_INDENT) and (within is None or depth >= within):
            found.append((depth, place))
    late = [(depth, place) for depth, place in found if place > width // 2] or found
    return min(late, key=lambda x: (x[0], -x[1]))[1] if late else 0


def _places(line: str) -> Iterator[tuple[float, int]]:
    """(How many brackets are open, where) of each place at which a line may be broken."""
    depth = 0
    for k, c in enumerate(line):
        if c in ")]}":
            depth -= 1
        if c == " " and line.startswith(_BEFORE, k):
            yield depth + (line[k + 1] in "*/") / 2, k + 1  # a sum sooner than a product in it
        elif k and line[k - 1] in " {" and line.endswith(_AFTER, 0, k) and line[k : k + 8].strip(" ,;"):  # inside it
            yield depth, k
        elif c == _TIGHT and k and (line[k - 1].isalnum() or line[k - 1] in "_)]"):
            yield depth + 100, k
        if c in "([{":
            depth += 1

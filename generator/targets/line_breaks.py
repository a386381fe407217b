"""Breaks long lines of code: as far outside brackets, and as late in the line, as possible."""

from __future__ import annotations

from collections.abc import Iterator

_INDENT = "    "
_BEFORE = (" + ", " - ", " ? ", " : ", " && ", " || ", " * ", " / ")  # the operator begins the next line
_AFTER = (", ", " = ", "{")
_TIGHT = "*"  # in a product that is written without spaces: where there is nothing better


def broken(line: str, width: int, within: int | None = None) -> list[str]:
    """Return a line of code as lines of at most `width`; continuation lines are indented by four more spaces.

    `within`: each break has at least this number of open brackets before it (1 for Python).
    """
    indent = line[: len(line) - len(line.lstrip())]
    lines: list[str] = []
    while len(line) > width and (index := _find_break(line, len(indent), width, within)):
        lines.append(line[:index].rstrip())
        if within is not None:
            within -= sum((c in "([{") - (c in ")]}") for c in lines[-1])  # of those that were open before
        line = f"{indent}{_INDENT}{line[index:].lstrip()}"
    return [*lines, line]


def _find_break(line: str, first: int, width: int, within: int | None) -> int:
    """Return the index at which a line is broken; 0 if there is none.

    A break in the latter half is preferred, then the one with the fewest open brackets, then the latest.
    """
    found: list[tuple[float, int]] = []
    for depth, place in _possible_breaks(line):
        if place > width and found:
            break  # of a line of a megabyte no more is read than of a short one
        if place > first + len(_INDENT) and (within is None or depth >= within):
            found.append((depth, place))
    late = [(depth, place) for depth, place in found if place > width // 2] or found
    return min(late, key=lambda x: (x[0], -x[1]))[1] if late else 0


def _possible_breaks(line: str) -> Iterator[tuple[float, int]]:
    """Yield (number of open brackets, index) of each place at which a line may be broken."""
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

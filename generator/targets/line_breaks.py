"""Breaks long lines of code: as far outside brackets, and as late in the line, as possible."""

from __future__ import annotations

from collections.abc import Iterator

_INDENT = "    "
_BEFORE = (" + ", " - ", " ? ", " : ", " && ", " || ", " * ", " / ")  # the operator begins the next line
_AFTER = (", ", " = ", "{")
_TIGHT = "*"  # in a product that is written without spaces: where there is nothing better
_MARKS = frozenset("()[]{} *")  # brackets, and characters at which a line may be broken


def break_code(line: str, width: int, min_depth: int | None = None) -> list[str]:
    """Return a line of code as lines of at most `width`; continuation lines are indented by four more spaces.

    min_depth: the number of open brackets that each break needs before it (1 for Python); None for C. A line without
    a possible break stays long.
    """
    indent = line[: len(line) - len(line.lstrip())]
    lines: list[str] = []
    while len(line) > width and (index := _find_break(line, len(indent), width, min_depth)):
        lines.append(line[:index].rstrip())
        if min_depth is not None:
            min_depth -= sum((c in "([{") - (c in ")]}") for c in lines[-1])  # of those that were open before
        line = f"{indent}{_INDENT}{line[index:].lstrip()}"
    return [*lines, line]


def _find_break(line: str, first_index: int, width: int, min_depth: int | None) -> int:
    """Return the index at which a line is broken; 0 if there is none.

    first_index: the index of the first character after the indent. A break in the latter half of `width` is preferred,
    then the one with the fewest open brackets, then the latest.
    """
    candidates: list[tuple[float, int]] = []
    for depth, index in _find_possible_breaks(line):
        if index > width and candidates:
            break  # of a line of a megabyte no more is read than of a short one
        if index > first_index + len(_INDENT) and (min_depth is None or depth >= min_depth):
            candidates.append((depth, index))
    late_breaks = [(depth, index) for depth, index in candidates if index > width // 2] or candidates
    return min(late_breaks, key=lambda x: (x[0], -x[1]))[1] if late_breaks else 0


def _find_possible_breaks(line: str) -> Iterator[tuple[float, int]]:
    """Yield (number of open brackets, index) of each position at which a line may be broken.

    The number is a rank: a product within a sum gets 0.5 more, a break without spaces 100 more.
    """
    depth = 0
    for k, c in enumerate(line):
        if c not in _MARKS and line[k - 1] not in " {":
            continue
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

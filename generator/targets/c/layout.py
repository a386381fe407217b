"""Lines of C that fit a page: a long one is broken where the fewest brackets are open."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

WIDTH = 120
_INDENT = "    "
_BEFORE = (" + ", " - ", " ? ", " : ", " && ", " || ", " * ", " / ")  # the operator begins the next line
_AFTER = (", ", " = ", "{")
_TIGHT = "*"  # in a product that is written without spaces: where there is nothing better


def broken(line: str, width: int = WIDTH) -> list[str]:
    """A line of code as lines of at most `width`; what goes on stands four spaces further in."""
    indent = line[: len(line) - len(line.lstrip())]
    lines: list[str] = []
    while len(line) > width and (place := _place(line, len(indent), width)):
        lines.append(line[:place].rstrip())
        line = f"{indent}{_INDENT}{line[place:].lstrip()}"
    return [*lines, line]


def _place(line: str, first: int, width: int) -> int:
    """Where a line is broken: in its latter half if it can be, as far out of brackets and as late as it can be."""
    found: list[tuple[float, int]] = []
    for depth, place in _places(line):
        if place > width and found:
            break  # of a line of a megabyte no more is read than of a short one
        if place > first + len(_INDENT):
            found.append((depth, place))
    late = [(depth, place) for depth, place in found if place > width // 2] or found
    return min(late, key=lambda x: (x[0], -x[1]))[1] if late else 0


def _places(line: str) -> Iterator[tuple[float, int]]:
    """(How many brackets are open, where) of each place at which a line may be broken."""
    depth = 0
    for k, c in enumerate(line):
        if c in ")]}":
            depth -= 1
        if line.startswith(_BEFORE, k):
            yield depth + (line[k + 1] in "*/") / 2, k + 1  # a sum sooner than a product in it
        elif any(line.endswith(mark, 0, k) for mark in _AFTER) and line[k : k + 8].strip(" ,;"):  # not at its end
            yield depth, k
        elif c == _TIGHT and k and (line[k - 1].isalnum() or line[k - 1] in "_)]"):
            yield depth + 100, k
        if c in "([{":
            depth += 1


def within(text: str) -> str:
    """A whole file with no line over WIDTH: its code broken, its comments wrapped or put in front of what they tell."""
    found: list[str] = []
    in_comment = False
    for line in text.split("\n"):
        found += _comment(line) if in_comment else _fitting(line)
        in_comment = line.rfind("/*") > line.rfind("*/") or in_comment and "*/" not in line
    return "\n".join(found)


def _comment(line: str) -> list[str]:
    """A line of a comment of several."""
    if len(line) <= WIDTH or not line.startswith(" * "):
        return [line]
    return textwrap.wrap(line[3:], WIDTH, initial_indent=" * ", subsequent_indent=" * ")


def _fitting(line: str) -> list[str]:
    if len(line) <= WIDTH:
        return [line]
    indent = line[: len(line) - len(line.lstrip())]
    if (bare := line.strip()).startswith("/* ") and bare.endswith(" */") and bare.count("*/") == 1:
        star = f"{indent} * "
        told = textwrap.wrap(bare[3:-3], WIDTH, initial_indent=star, subsequent_indent=star)
        return [f"{indent}/*", *told, f"{indent} */"]
    code, mark, told_behind = line.rpartition("/* ")
    if mark and told_behind.endswith(" */") and code.strip() and "/*" not in code:
        return [*_fitting(f"{indent}/* {told_behind}"), *_fitting(code.rstrip())]
    return [line] if line.startswith("#") else broken(line)

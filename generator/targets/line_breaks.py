"""Wraps long lines of code: breaks are outside brackets as far as possible, and late in the line."""

from __future__ import annotations

from collections.abc import Iterator

_INDENT = "    "
_OPERATORS = (" + ", " - ", " ? ", " : ", " && ", " || ", " * ", " / ")  # a break is before the operator
_SEPARATORS = (", ", " = ", "{")  # a break is after the separator
_UNSPACED_OPERATOR = "*"  # a product without spaces is broken if there is no other position
_RELEVANT_CHARACTERS = frozenset("()[]{} *")  # brackets, and characters at which a line may be broken


def break_code(line: str, width: int, min_depth: int | None = None) -> list[str]:
    """Return a line of code as lines of at most `width` characters; continuation lines have four more spaces of indent.

    min_depth: the minimum number of open brackets at a break (1 for Python, which continues lines within brackets
    only); None for C. A line without a possible break stays long.
    """
    indent = line[: len(line) - len(line.lstrip())]
    lines: list[str] = []
    while len(line) > width and (index := _select_break(line, len(indent), width, min_depth)):
        lines.append(line[:index].rstrip())
        if min_depth is not None:
            min_depth -= sum((c in "([{") - (c in ")]}") for c in lines[-1])  # brackets that are still open count
        line = f"{indent}{_INDENT}{line[index:].lstrip()}"
    return [*lines, line]


def _select_break(line: str, first_index: int, width: int, min_depth: int | None) -> int:
    """Return the index of the character that begins the next line; 0 if the line has no possible break.

    Of the breaks at most `width` from the start, those beyond `width` // 2 are preferred. The lowest rank of
    `_list_breaks` is selected, then the last break of it. If all breaks lie beyond `width`, the first is selected.

    first_index: the index of the first character after the indent. A break needs more than four characters before it.
    """
    candidates: list[tuple[float, int]] = []
    for rank, index in _list_breaks(line):
        if index > width and candidates:
            break  # the rest of a line of many megabytes is not read
        if index > first_index + len(_INDENT) and (min_depth is None or rank >= min_depth):
            candidates.append((rank, index))
    preferred = [(rank, index) for rank, index in candidates if index > width // 2] or candidates
    return min(preferred, key=lambda x: (x[0], -x[1]))[1] if preferred else 0


def _list_breaks(line: str) -> Iterator[tuple[float, int]]:
    """Yield (rank, index) of each position at which a line may be broken: before an operator, after a separator.

    The rank, of which low values are preferred, is the number of open brackets. Before * and / it is higher by 0.5, and
    in a product without spaces by 100.
    """
    depth = 0
    for k, c in enumerate(line):
        if c not in _RELEVANT_CHARACTERS and line[k - 1] not in " {":
            continue
        if c in ")]}":
            depth -= 1
        if c == " " and line.startswith(_OPERATORS, k):
            yield depth + (line[k + 1] in "*/") / 2, k + 1
        elif k and line[k - 1] in " {" and line.endswith(_SEPARATORS, 0, k) and line[k : k + 8].strip(" ,;"):
            yield depth, k  # text follows the separator
        elif c == _UNSPACED_OPERATOR and k and (line[k - 1].isalnum() or line[k - 1] in "_)]"):
            yield depth + 100, k
        if c in "([{":
            depth += 1

"""Lines of Python that fit a page, without an indent: code is broken within brackets, comments stand behind it."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence

from gudgeon.generator.targets import breaks

WIDTH = 100
_WIDTH = WIDTH - 12  # of what stands in a function and in two conditions at most


def code(text: str) -> list[str]:
    """A line that has brackets where it is long."""
    return breaks.broken(text, _WIDTH, within=1)


def assigned(target: str, value: str, comment: str = "", is_call: bool = False) -> list[str]:
    """`target = value`; a long value that is not one call stands in brackets."""
    line = f"{target} = {value}"
    lines = code(line if is_call or len(line) <= _WIDTH else f"{target} = ({value})")
    told = f"# {one_line(comment)}" if comment else ""
    if len(lines) == 1 and len(line) + 2 + len(told) <= _WIDTH:
        return [f"{line}  {told}".rstrip()]
    return [*remark(comment), *lines]


def remark(text: str) -> list[str]:
    """Comments of their own; none of no text."""
    return [f"# {line}" for line in textwrap.wrap(one_line(text), _WIDTH - 2)]


def docstring(doc: Sequence[str]) -> list[str]:
    """Lines of one; a long line goes on further in."""
    plain = (one_line(line, keep=True).replace("\\", "/").replace('"', "'") for line in doc)
    first, *others = [part for line in plain for part in _wrapped(line)]
    return [f'"""{first}"""'] if not others else [f'"""{first}', *others, '"""']


def _wrapped(line: str) -> list[str]:
    indent = line[: len(line) - len(line.lstrip())]
    return textwrap.wrap(line, WIDTH - 7, subsequent_indent=f"{indent}  ", break_on_hyphens=False) or [""]


def one_line(text: str, keep: bool = False) -> str:
    """What a user wrote, without what could end a line; `keep`: spaces as they are."""
    plain = "".join(c if c.isprintable() else " " for c in text)
    return plain.rstrip() if keep else " ".join(plain.split())


def indented(text: Iterable[str]) -> list[str]:
    """Four columns to the right."""
    return [f"    {line}" if line else "" for line in text]

"""Lines of C that fit a page: code is broken, comments are wrapped."""

from __future__ import annotations

import textwrap

from gudgeon.generator.targets import breaks

WIDTH = 120


def broken(line: str) -> list[str]:
    """A line of code as lines that fit."""
    return breaks.broken(line, WIDTH)


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

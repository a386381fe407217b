"""Text of a file, of an error or of another program, shown as what it is: text. And documents for other programs.

On a terminal nothing of it is a command, a link, a colour or an emoji; in a figure nothing of it is mathematics.
"""

from __future__ import annotations

import math
import textwrap
import unicodedata
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console

LONGEST = 240  # characters of a title that is shown; a mechanism file has one of 200 at most
FORMULAS = ("=", "+", "-", "@")  # first characters for which a spreadsheet computes a cell
JOINERS = "\u200c\u200d"  # of letters and emoji: text, though no sign of their own


def visible(text: object) -> str:
    """What a terminal would obey (control characters, directions of writing) as Python writes it; lines stay lines."""
    return "\n".join(map(_visible, str(text).split("\n")))


def _visible(text: str) -> str:
    if text.isprintable():
        return text
    return "".join(c if _is_shown(c) else c.encode("unicode_escape").decode("ascii") for c in text)


def _is_shown(character: str) -> bool:
    return character.isprintable() or character in JOINERS or unicodedata.category(character) == "Zs"


def path_text(path: object) -> str:
    """A file's name: visible, and in a line."""
    return _visible(str(path))


def one_line(text: str) -> str:
    """A title: visible, and no longer than one should be."""
    text = _visible(text)
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 1]}…"


def in_figure(text: str, width: int = LONGEST) -> str:
    """A title for matplotlib, folded into lines of `width` characters; $ begins no formula."""
    return "\n".join(textwrap.wrap(one_line(text), width)).replace("$", r"\$")


def in_spreadsheet(value: Any) -> Any:
    """Return a value for a cell of a CSV file: a text visible, after an apostrophe if a spreadsheet would compute it.

    Numbers, and texts that are numbers, stay as they are.
    """
    if not isinstance(value, str):
        return value
    text = visible(value)
    if not text.startswith(FORMULAS):
        return text
    try:
        float(text)
    except ValueError:
        return f"'{text}"
    return text


def plain_console(width: int | None = None, **options: Any) -> Console:
    """A console that shows texts as they are; what is to be coloured is a rich Text of its own."""
    from rich.console import Console

    return Console(width=width, markup=False, emoji=False, highlight=False, **options)


def print_json(document: dict[str, Any]) -> None:
    """JSON without NaN or infinity, which it does not have: they are null."""
    import json  # here: no help text needs it

    print(json.dumps(_plain(document), ensure_ascii=False, allow_nan=False, indent=1))


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def counted(count: int, noun: str, plural: str = "") -> str:
    """Return a count with its noun: 1 run, 2 runs, 2 bodies."""
    return f"{count} {noun if count == 1 else plural or f'{noun}s'}"

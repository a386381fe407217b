"""Show text of files, errors or other programs safely on terminals and in figures, and write JSON and CSV.

On a terminal, such text is never a command, a link, a colour or an emoji; in a figure it is never a formula.
"""

from __future__ import annotations

import math
import textwrap
import unicodedata
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console

MAX_TITLE = 240  # characters of a title that are shown
FORMULA_SIGNS = ("=", "+", "-", "@")  # first characters of cells that a spreadsheet evaluates
JOINERS = "\u200c\u200d"  # invisible joiners within words and emoji, which are not escaped


def escape_invisible(text: object) -> str:
    """Return text in which control characters and writing directions are escaped as in Python; line breaks are kept."""
    return "\n".join(map(_escape_line, str(text).split("\n")))


def _escape_line(text: str) -> str:
    """Return one line of text in which all characters that are not visible are escaped; it contains no line break."""
    if text.isprintable():
        return text
    return "".join(c if _is_shown(c) else c.encode("unicode_escape").decode("ascii") for c in text)


def _is_shown(character: str) -> bool:
    """Return whether a character is visible, a space or a joiner within emoji and letters."""
    return character.isprintable() or character in JOINERS or unicodedata.category(character) == "Zs"


def format_path(path: object) -> str:
    """Return a path as visible text on one line."""
    return _escape_line(str(path))


def format_one_line(text: str) -> str:
    """Return a title as visible text on one line, shortened to MAX_TITLE characters with "…"."""
    text = _escape_line(text)
    return text if len(text) <= MAX_TITLE else f"{text[: MAX_TITLE - 1]}…"


def format_figure_title(text: str, width: int = MAX_TITLE) -> str:
    """Return a title for matplotlib, wrapped to lines of `width` characters; $ is escaped, so that it begins no
    formula.
    """
    return "\n".join(textwrap.wrap(format_one_line(text), width)).replace("$", r"\$")


def escape_for_spreadsheet(value: Any) -> Any:
    """Return a value for a cell of a CSV file: a text that a spreadsheet would evaluate gets an apostrophe before it.

    Control characters of texts are escaped. Numbers, and texts that are numbers, are returned unchanged.
    """
    if not isinstance(value, str):
        return value
    text = escape_invisible(value)
    if not text.startswith(FORMULA_SIGNS):
        return text
    try:
        float(text)
    except ValueError:
        return f"'{text}"
    return text


def make_plain_console(width: int | None = None, **options: Any) -> Console:
    """Return a rich console that prints texts as they are, without markup, emoji and highlighting.

    width: columns, None for that of the terminal. options: further arguments of rich's Console.
    """
    from rich.console import Console

    return Console(width=width, markup=False, emoji=False, highlight=False, **options)


def print_json(document: dict[str, Any]) -> None:
    """Print a document as indented JSON; NaN and infinity become null, since JSON lacks them."""
    import json  # here: no help text needs it

    print(json.dumps(_replace_nan(document), ensure_ascii=False, allow_nan=False, indent=1))


def _replace_nan(value: Any) -> Any:
    """Return a copy of JSON data in which NaN and infinity are None."""
    if isinstance(value, dict):
        return {key: _replace_nan(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_replace_nan(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def format_count(count: int, noun: str, plural: str = "") -> str:
    """Return a count with its noun: "1 run", "2 runs", "2 bodies"; `plural` is needed if it is not the noun with an
    s.
    """
    return f"{count} {noun if count == 1 else plural or f'{noun}s'}"

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

LONGEST = 240  # largest number of characters of a title that is shown
FORMULAS = ("=", "+", "-", "@")  # first characters for which a spreadsheet computes a cell
JOINERS = "\u200c\u200d"  # joiners within letters and emoji: text, though invisible


def visible(text: object) -> str:
    """Return text with control characters and writing directions escaped as Python writes them; lines are kept."""
    return "\n".join(map(_escape_line, str(text).split("\n")))


def _escape_line(text: str) -> str:
    """Return one line of text with invisible characters escaped."""
    if text.isprintable():
        return text
    return "".join(c if _is_shown(c) else c.encode("unicode_escape").decode("ascii") for c in text)


def _is_shown(character: str) -> bool:
    """Return whether a character is visible, a space or a joiner."""
    return character.isprintable() or character in JOINERS or unicodedata.category(character) == "Zs"


def path_text(path: object) -> str:
    """Return the name of a file as visible text on one line."""
    return _escape_line(str(path))


def one_line(text: str) -> str:
    """Return a title as visible text on one line, shortened to LONGEST characters."""
    text = _escape_line(text)
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 1]}…"


def figure_title(text: str, width: int = LONGEST) -> str:
    """Return a title for matplotlib, folded into lines of `width` characters; $ begins no formula."""
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
    """Return a rich console that shows texts as they are, without markup and emoji."""
    from rich.console import Console

    return Console(width=width, markup=False, emoji=False, highlight=False, **options)


def print_json(document: dict[str, Any]) -> None:
    """Print a document as JSON; NaN and infinity become null, since JSON lacks them."""
    import json  # here: no help text needs it

    print(json.dumps(_without_nan(document), ensure_ascii=False, allow_nan=False, indent=1))


def _without_nan(value: Any) -> Any:
    """Return JSON data in which NaN and infinity are None."""
    if isinstance(value, dict):
        return {key: _without_nan(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_without_nan(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def counted(count: int, noun: str, plural: str = "") -> str:
    """Return a count with its noun: 1 run, 2 runs, 2 bodies."""
    return f"{count} {noun if count == 1 else plural or f'{noun}s'}"

"""Tables: two columns of decimal numbers as text, with the place of each."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from gudgeon.errors import BadValueError, Location

_NOT_FINITE = re.compile(r"(nan|inf|infinity)\b", re.IGNORECASE)
_MARKS = ";", "\t", ","  # between the columns: the first that the text has


@dataclass(frozen=True)
class Row:
    """A point as it is written, and where."""

    text: tuple[str, str]
    where: tuple[Location, Location]


def read_table(data: bytes, file: str, is_number: Callable[[str], bool]) -> list[Row]:
    """The rows of a CSV file: a header may stand first, empty lines and lines with # count for nothing.

    Raises BadValueError, at line and column of the table, for what is no number and for other than two columns.
    """
    text = _decoded(data, file)
    mark = next((mark for mark in _MARKS if mark in text), ",")
    rows: list[Row] = []
    first = True
    for number, line in enumerate(re.split(r"\r\n|\n|\r", text), start=1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        row = _row(line, mark, file, number)
        wrong = [k for k in (0, 1) if not is_number(row.text[k])]
        if wrong and not (first and len(wrong) == 2 and is_header(row.text)):
            hint = "expected a decimal number such as -0.5: with a point, '-' as its sign, and no quotes or brackets"
            raise BadValueError(f"{row.text[wrong[0]][:40]!r} is no number", row.where[wrong[0]], hint)
        rows += [] if wrong else [row]
        first = False
    return rows


def is_header(cells: Sequence[str]) -> bool:
    """Return whether both cells of a first row can be names of columns: a letter in one of them, in neither a number.

    A cell is meant as a number if a digit stands before its first letter: "\u22121", "(1)", '"-1"', "0 mm".
    """
    names = [re.sub(r"^[\W_]+", "", cell) for cell in cells]
    return (
        len(cells) == 2
        and any(name[:1].isalpha() for name in names)
        and all((not name or name[0].isalpha()) and not _NOT_FINITE.match(name) for name in names)
    )


def _decoded(data: bytes, file: str) -> str:
    try:
        return data.decode("utf-8").removeprefix("\ufeff")
    except UnicodeDecodeError as error:
        before = data[: error.start]
        where = Location(file, before.count(b"\n") + 1, len(before.rpartition(b"\n")[2]) + 1)
        hint = "expected a UTF-8 text file"
        raise BadValueError(f"byte 0x{data[error.start]:02x} is no UTF-8", where, hint) from None


def _row(line: str, mark: str, file: str, number: int) -> Row:
    """Both cells of a line."""
    cells = line.split(mark)
    if len(cells) != 2:
        columns = f"{len(cells)} column{'s' * (len(cells) != 1)}"
        hint = f"expected two, x and y, with {mark!r} between them, and numbers with a decimal point"
        raise BadValueError(f"{columns} in a table", Location(file, number, 1), hint)
    starts = (0, len(cells[0]) + 1)
    places = [start + len(cell) - len(cell.lstrip()) + 1 for start, cell in zip(starts, cells, strict=True)]
    one, two = (cell.strip() for cell in cells)
    return Row((one, two), (Location(file, number, places[0]), Location(file, number, places[1])))

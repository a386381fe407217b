"""Reads curves: cubic interpolants through points in the file or in a CSV table of two columns."""

from __future__ import annotations

import hashlib
import io
import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np

from gudgeon.errors import BadValueError, LimitError, Location, MissingKeyError, UnitError
from gudgeon.files.reading import MAX_BYTES, MAX_TABLE_BYTES, read_beside
from gudgeon.generator.field import WORD
from gudgeon.generator.format.sections import CURVE
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import FieldContext, read_fields
from gudgeon.generator.yaml import Items, Map, Text, kind_of
from gudgeon.language.curves import LEAST, MONOTONE, NOT_A_KNOT, PERIODIC, STOP, Curve, even_pieces, spline
from gudgeon.language.functions import FUNCTIONS
from gudgeon.language.units import DIMENSIONLESS, Unit, parse_unit, si_unit

_NOT_FINITE = re.compile(r"(nan|inf|infinity)\b", re.IGNORECASE)
_SEPARATORS = ";", "\t", ","  # column separators; the first one that the text contains counts


@dataclass(frozen=True)
class Row:
    """Represent one point of a curve as two texts with their locations."""

    text: tuple[str, str]
    where: tuple[Location, Location]


def read_table(data: bytes, file: str, is_number: Callable[[str], bool]) -> list[Row]:
    """Return the rows of a CSV file; a header line, empty lines and lines that begin with # are skipped.

    Raises BadValueError, at line and column of the table, if a cell is not a number or a row has not two columns.
    """
    text = _decode(data, file)
    mark = next((mark for mark in _SEPARATORS if mark in text), ",")
    rows: list[Row] = []
    first = True
    for number, line in enumerate(re.split(r"\r\n|\n|\r", text), start=1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        row = _split_row(line, mark, file, number)
        wrong = [k for k in (0, 1) if not is_number(row.text[k])]
        if wrong and not (first and len(wrong) == 2 and is_header(row.text)):
            hint = "expected a decimal number such as -0.5: with a point, '-' as its sign, and no quotes or brackets"
            raise BadValueError(f"{row.text[wrong[0]][:40]!r} is no number", row.where[wrong[0]], hint)
        rows += [] if wrong else [row]
        first = False
    return rows


def is_header(cells: Sequence[str]) -> bool:
    """Return whether both cells of a first row can be column names: one contains a letter, neither is a number.

    A cell counts as a number if a digit stands before its first letter: "\u22121", "(1)", '"-1"', "0 mm".
    """
    names = [re.sub(r"^[\W_]+", "", cell) for cell in cells]
    return (
        len(cells) == 2
        and any(name[:1].isalpha() for name in names)
        and all((not name or name[0].isalpha()) and not _NOT_FINITE.match(name) for name in names)
    )


def _decode(data: bytes, file: str) -> str:
    """Decode UTF-8 bytes of a table. Raises BadValueError at the first invalid byte."""
    try:
        return data.decode("utf-8").removeprefix("\ufeff")
    except UnicodeDecodeError as error:
        before = data[: error.start]
        where = Location(file, before.count(b"\n") + 1, len(before.rpartition(b"\n")[2]) + 1)
        hint = "expected a UTF-8 text file"
        raise BadValueError(f"byte 0x{data[error.start]:02x} is no UTF-8", where, hint) from None


def _split_row(line: str, mark: str, file: str, number: int) -> Row:
    """Split a line of a table into its two cells. Raises BadValueError if it has another number of columns."""
    cells = line.split(mark)
    if len(cells) != 2:
        columns = f"{len(cells)} column{'s' * (len(cells) != 1)}"
        hint = f"expected two, x and y, with {mark!r} between them, and numbers with a decimal point"
        raise BadValueError(f"{columns} in a table", Location(file, number, 1), hint)
    starts = (0, len(cells[0]) + 1)
    places = [start + len(cell) - len(cell.lstrip()) + 1 for start, cell in zip(starts, cells, strict=True)]
    one, two = (cell.strip() for cell in cells)
    return Row((one, two), (Location(file, number, places[0]), Location(file, number, places[1])))


MAX_POINTS = 1 << 21  # points of a curve
_DECIMAL = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?", re.ASCII)
_MAX_DECIMAL_LENGTH = 40  # characters
_PLACEHOLDER = Curve(
    "", (0.0, 1.0), ((0.0, 0.0, 0.0, 0.0),), extrapolate="line"
)  # replaces a curve that cannot be read


def read_curves(reader: Reader, root: Map) -> dict[str, Curve]:
    """Read the section `curves:` into reader.curves, and the hashes of its tables into reader.tables."""
    for name, node in root.part("curves").pairs():
        reader.curves[str(name)] = _PLACEHOLDER
        with reader.collect():
            reader.curves[str(name)] = _read_curve(reader, name, node) or _PLACEHOLDER
        if name in FUNCTIONS:  # the name was refused: a call of it calls the function
            del reader.curves[str(name)]
    return reader.curves


def _read_curve(reader: Reader, name: Text, node: Map) -> Curve | None:
    """Read one curve; None if it cannot be read and the error was collected."""
    owner = f"curves.{name}"
    errors_before = len(reader.errors)
    options = read_fields(reader, node, [f for f in CURVE.fields if f.kind == WORD], FieldContext(owner)).options
    over, of = _read_unit(node, "x", owner), _read_unit(node, "y", owner)
    if ("points" in node) == ("table" in node):
        both = "both points and a table" if "points" in node else "neither points nor a table"
        raise MissingKeyError(f"{owner} has {both}", name.where, "expected points: [[x, y], …] or table: FILE.csv")
    data = _read_table_bytes(reader, node["table"]) if "table" in node else b""
    if len(reader.errors) > errors_before:
        return None
    ends, extrapolate = str(options["ends"]), str(options["extrapolate"])
    if ends == PERIODIC and extrapolate != STOP:
        where = node["extrapolate"].where
        raise BadValueError(f"{owner} is periodic and goes on {extrapolate!r}", where, "leave extrapolate out")
    interpolation = str(options["interpolation"])
    if interpolation == MONOTONE and ends == NOT_A_KNOT:
        hint = "expected natural, clamped or periodic"
        raise BadValueError(f"{owner} is monotone with ends: not_a_knot", node["ends"].where, hint)
    long = _parse_long_table(data, over, of, ends)
    if long is None:
        rows = (
            _rows_of_table(reader, node["table"], data) if "table" in node else _rows_of_points(node["points"], owner)
        )
        x, y = _column_in_si(rows, 0, over), _column_in_si(rows, 1, of)
        _check_points(owner, ends, rows, x, y, name.where)
    else:
        x, y = long
    coefficients = spline(x, y, ends, interpolation)
    knots, coefficients = even_pieces(x, coefficients) if ends == PERIODIC else (x, coefficients)
    if not np.isfinite(np.array(coefficients)).all():
        hint = "expected points whose slopes are numbers: are two of them too close?"
        raise BadValueError(f"{owner} has a slope that is no number", name.where, hint)
    return Curve(
        str(name),
        knots,
        coefficients,
        ends,
        extrapolate,
        over.dimension if over else None,
        of.dimension if of else None,
        _si_unit_text(of),
        str(node["x"]) if over else "",
        str(node["table"]) if "table" in node else "",
        interpolation,
        len(x),
    )


def _read_unit(node: Map, key: str, owner: str) -> Unit | None:
    """Return the unit of a column, `x` or `y`; None for bare SI numbers, which fit any dimension."""
    if key not in node:
        return None
    text = node[key]
    found = parse_unit(str(text))
    if found is None or found[1] != len(text):
        raise UnitError(f"{owner}.{key} is {kind_of(text)}, which is no unit", text.where, "expected one such as deg")
    return found[0]


def _si_unit_text(of: Unit | None) -> str | None:
    """Return the SI unit of a curve's values as text, None if they have no declared unit."""
    return None if of is None else "rad" if of.dimension == DIMENSIONLESS else si_unit(of.dimension)


def _rows_of_points(items: Items, owner: str) -> list[Row]:
    """Return the points of a list in the file as rows."""
    return [Row((str(x), str(y)), (x.where, y.where)) for x, y in items]


def _read_table_bytes(reader: Reader, name: Text) -> bytes:
    """Return the bytes of a table next to the mechanism file and record their sha256."""
    data = read_beside(reader.file, str(name), MAX_TABLE_BYTES, name.where)
    reader.tables[str(name)] = hashlib.sha256(data).hexdigest()
    return data


def _rows_of_table(reader: Reader, name: Text, data: bytes) -> list[Row]:
    """Return the rows of a table whose bytes were read."""
    return read_table(data, str(Path(reader.file).parent / name), lambda text: _parse_decimal(text) is not None)


def _parse_long_table(
    data: bytes, over: Unit | None, of: Unit | None, ends: str
) -> tuple[tuple[float, ...], tuple[float, ...]] | None:
    """Return both columns (SI) of a table of more than a megabyte, parsed at once; None if it must be read row by row.

    Numbers are converted to SI in binary64: their last digit may differ from that of a shorter table.
    """
    if len(data) <= MAX_BYTES:
        return None
    mark = next((mark for mark in (";", "\t", ",") if mark.encode() in data), ",")
    head, _, rows = data.partition(b"\n")
    if not re.search(rb"[0-9]|\r.", head):  # the first line has no digit
        line = head.decode("utf-8-sig", "replace")
        data = rows if line.lstrip().startswith("#") or is_header(line.split(mark)) else data
    if re.search(rb"[^-+.,;\t\r\n 0-9eE]", data):
        return None
    try:
        table = np.loadtxt(io.BytesIO(data), delimiter=mark, ndmin=2)
    except ValueError:
        return None
    scales = [float(unit.to_si(Fraction(1))) if unit else 1.0 for unit in (over, of)]
    if table.shape[1:] != (2,) or len(table) > MAX_POINTS:
        return None
    x, y = (table * scales).T
    sizes = np.abs(table[table != 0.0])
    fits = np.isfinite(table).all() and (sizes < _HIGH).all() and (sizes > _LOW).all() and (np.diff(x) > 0.0).all()
    if not fits or (ends == PERIODIC and y[0] != y[-1]):
        return None
    return tuple(x.tolist()), tuple(y.tolist())


_LOW, _HIGH = 1e-140, 1e140  # magnitudes that stay within binary64 after conversion of units


def _parse_decimal(text: str) -> Fraction | None:
    """Return a decimal number as an exact fraction, None if the text is not one."""
    return Fraction(text) if len(text) <= _MAX_DECIMAL_LENGTH and _DECIMAL.fullmatch(text) else None


def _column_in_si(rows: Sequence[Row], column: int, unit: Unit | None) -> tuple[float, ...]:
    """Return a column of the rows in SI units. Raises BadValueError at a cell that is not a number or out of range."""
    if len(rows) > MAX_POINTS:
        raise LimitError(f"{len(rows)} points", rows[0].where[0], f"expected at most {MAX_POINTS} in a curve")
    found = []
    for row in rows:
        text, where = row.text[column], row.where[column]
        exact = _parse_decimal(text)
        if exact is None:
            hint = "expected a decimal number, with its unit in x: or y:"
            raise BadValueError(f"{text[:_MAX_DECIMAL_LENGTH]!r} is no number", where, hint)
        try:
            value = unit.to_si(exact) if unit else float(exact)
        except OverflowError:
            value = math.inf
        if not abs(value) < 1e150 or exact and abs(value) < 1e-150:  # their powers must be finite in C
            raise BadValueError(f"{text!r} is out of range", where, "expected a magnitude from 1e-150 to 1e150")
        found.append(value)
    return tuple(found)


def _check_points(
    owner: str, ends: str, rows: Sequence[Row], x: Sequence[float], y: Sequence[float], where: Location
) -> None:
    """Raise BadValueError unless there are enough points, x rises strictly, and periodic curves end as they begin."""
    if len(x) < LEAST[ends]:
        hint = f"expected at least {LEAST[ends]} for ends: {ends}"
        raise BadValueError(f"{owner} has {len(x)} point{'s' * (len(x) != 1)}", where, hint)
    for k in range(1, len(x)):
        if not x[k] > x[k - 1]:
            texts = rows[k].text[0], rows[k - 1].text[0]
            hint = "expected rising x, each once"
            raise BadValueError(f"{owner}: x is {texts[0]} behind {texts[1]}", rows[k].where[0], hint)
    if ends == PERIODIC and y[0] != y[-1]:
        hint = f"expected {rows[0].text[1]}, as in the first point, or other ends"
        raise BadValueError(f"{owner} is periodic and ends at {rows[-1].text[1]}", rows[-1].where[1], hint)

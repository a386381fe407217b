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
from gudgeon.files.reading import MAX_BYTES, MAX_TABLE_BYTES, read_table_file
from gudgeon.generator.field import WORD
from gudgeon.generator.format.sections import CURVE
from gudgeon.generator.reader.collector import Reader
from gudgeon.generator.reader.fields import FieldContext, read_fields
from gudgeon.generator.yaml import Items, Map, Text, describe_node
from gudgeon.language.curves import (
    MIN_POINTS,
    MONOTONE,
    NOT_A_KNOT,
    PERIODIC,
    STOP,
    Curve,
    compute_spline,
    make_even_pieces,
)
from gudgeon.language.functions import FUNCTIONS
from gudgeon.language.units import DIMENSIONLESS, Unit, find_si_unit, parse_unit

_NOT_FINITE = re.compile(r"(nan|inf|infinity)\b", re.IGNORECASE)
_SEPARATORS = ";", "\t", ","  # column separators; the first one that the text contains counts


@dataclass(frozen=True)
class Row:
    """Represent one point of a curve as two texts with their locations."""

    cells: tuple[str, str]
    locations: tuple[Location, Location]


def read_table(data: bytes, file: str, is_number: Callable[[str], bool]) -> list[Row]:
    """Return the rows of a CSV file; a header line, empty lines and lines that begin with # are skipped.

    Columns are separated by the first of `;`, tab and `,` that the text contains. Raises BadValueError, at line and
    column of the table, if a cell is not a number (`is_number`) or a row has not two columns.
    """
    text = _decode_table(data, file)
    separator = next((separator for separator in _SEPARATORS if separator in text), ",")
    rows: list[Row] = []
    is_first_row = True
    for line_number, line in enumerate(re.split(r"\r\n|\n|\r", text), start=1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        row = _split_row(line, separator, file, line_number)
        wrong_columns = [k for k in (0, 1) if not is_number(row.cells[k])]
        if wrong_columns and not (is_first_row and len(wrong_columns) == 2 and is_header_row(row.cells)):
            hint = "expected a decimal number such as -0.5: with a point, '-' as its sign, and no quotes or brackets"
            raise BadValueError(
                f"{row.cells[wrong_columns[0]][:40]!r} is not a number", row.locations[wrong_columns[0]], hint
            )
        rows += [] if wrong_columns else [row]
        is_first_row = False
    return rows


def is_header_row(cells: Sequence[str]) -> bool:
    """Return whether both cells of a first row can be column names: one contains a letter, neither is a number.

    A cell counts as a number if a digit stands before its first letter: "−1", "(1)", '"-1"', "0 mm"; nan and inf are
    numbers.
    """
    names = [re.sub(r"^[\W_]+", "", cell) for cell in cells]
    return (
        len(cells) == 2
        and any(name[:1].isalpha() for name in names)
        and all((not name or name[0].isalpha()) and not _NOT_FINITE.match(name) for name in names)
    )


def _decode_table(data: bytes, file: str) -> str:
    """Return the UTF-8 bytes of a table as text without a byte order mark.

    Raises BadValueError at the first invalid byte.
    """
    try:
        return data.decode("utf-8").removeprefix("\ufeff")
    except UnicodeDecodeError as error:
        before = data[: error.start]
        location = Location(file, before.count(b"\n") + 1, len(before.rpartition(b"\n")[2]) + 1)
        hint = "expected a UTF-8 text file"
        raise BadValueError(f"byte 0x{data[error.start]:02x} is not UTF-8", location, hint) from None


def _split_row(line: str, separator: str, file: str, line_number: int) -> Row:
    """Split a line of a table into its two cells, without spaces around them, each with its location.

    Raises BadValueError if the line has another number of columns. `line_number` is the line's number in the file.
    """
    cells = line.split(separator)
    if len(cells) != 2:
        columns = f"{len(cells)} column{'s' * (len(cells) != 1)}"
        hint = f"expected two columns, x and y, separated by {separator!r}, and numbers with a decimal point"
        raise BadValueError(f"{columns} in a table", Location(file, line_number, 1), hint)
    starts = (0, len(cells[0]) + 1)
    columns_of_cells = [start + len(cell) - len(cell.lstrip()) + 1 for start, cell in zip(starts, cells, strict=True)]
    first_cell, second_cell = (cell.strip() for cell in cells)
    return Row(
        (first_cell, second_cell),
        (Location(file, line_number, columns_of_cells[0]), Location(file, line_number, columns_of_cells[1])),
    )


MAX_POINTS = 1 << 21  # points of a curve
_DECIMAL = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?", re.ASCII)
_MAX_DECIMAL_LENGTH = 40  # characters
_PLACEHOLDER = Curve(
    "", (0.0, 1.0), ((0.0, 0.0, 0.0, 0.0),), extrapolate="line"
)  # replaces a curve that cannot be read


def read_curves(reader: Reader, root: Map) -> dict[str, Curve]:
    """Read the section `curves:` into reader.curves, and return it; hashes of tables go to reader.tables.

    A placeholder replaces a curve that cannot be read. A curve with the name of a function is left out: its name was
    refused.
    """
    for name, node in root.get_mapping("curves").list_entries():
        reader.curves[str(name)] = _PLACEHOLDER
        with reader.collect_errors():
            reader.curves[str(name)] = _read_curve(reader, name, node) or _PLACEHOLDER
        if name in FUNCTIONS:  # the name was refused: a call of it calls the function
            del reader.curves[str(name)]
    return reader.curves


def _read_curve(reader: Reader, name: Text, node: Map) -> Curve | None:
    """Return the curve of one entry, with its values and knots in SI; None if an error was collected.

    Raises an InputError for contradicting keys and invalid points. Tables of more than a megabyte are parsed at once.
    """
    address = f"curves.{name}"
    errors_before = len(reader.errors)
    options = read_fields(reader, node, [f for f in CURVE.fields if f.kind == WORD], FieldContext(address)).options
    x_unit, y_unit = _read_column_unit(node, "x", address), _read_column_unit(node, "y", address)
    if ("points" in node) == ("table" in node):
        fault = "both points and a table" if "points" in node else "neither points nor a table"
        raise MissingKeyError(f"{address} has {fault}", name.where, "expected points: [[x, y], …] or table: FILE.csv")
    data = _read_table_bytes(reader, node["table"]) if "table" in node else b""
    if len(reader.errors) > errors_before:
        return None
    end_condition, extrapolate = str(options["ends"]), str(options["extrapolate"])
    if end_condition == PERIODIC and extrapolate != STOP:
        location = node["extrapolate"].where
        raise BadValueError(
            f"{address} is periodic and has extrapolate: {extrapolate}", location, "remove the key extrapolate"
        )
    interpolation = str(options["interpolation"])
    if interpolation == MONOTONE and end_condition == NOT_A_KNOT:
        hint = "expected natural, clamped or periodic"
        raise BadValueError(f"{address} is monotone with ends: not_a_knot", node["ends"].where, hint)
    long_table = _parse_long_table(data, x_unit, y_unit, end_condition)
    if long_table is None:
        rows = (
            _parse_table_rows(reader, node["table"], data)
            if "table" in node
            else _convert_points_to_rows(node["points"], address)
        )
        x, y = _convert_column_to_si(rows, 0, x_unit), _convert_column_to_si(rows, 1, y_unit)
        _check_points(address, end_condition, rows, x, y, name.where)
    else:
        x, y = long_table
    coefficients = compute_spline(x, y, end_condition, interpolation)
    knots, coefficients = make_even_pieces(x, coefficients) if end_condition == PERIODIC else (x, coefficients)
    if not np.isfinite(np.array(coefficients)).all():
        hint = "expected finite slopes: check whether two points are too close"
        raise BadValueError(f"{address} has a slope that is not finite", name.where, hint)
    return Curve(
        str(name),
        knots,
        coefficients,
        end_condition,
        extrapolate,
        x_unit.dimension if x_unit else None,
        y_unit.dimension if y_unit else None,
        _format_si_unit(y_unit),
        str(node["x"]) if x_unit else "",
        str(node["table"]) if "table" in node else "",
        interpolation,
        len(x),
    )


def _read_column_unit(node: Map, key: str, address: str) -> Unit | None:
    """Return the unit of a column, `x` or `y`; None for bare SI numbers, which fit any dimension. Raises UnitError."""
    if key not in node:
        return None
    text = node[key]
    unit_and_length = parse_unit(str(text))
    if unit_and_length is None or unit_and_length[1] != len(text):
        raise UnitError(
            f"{address}.{key} is {describe_node(text)}, which is not a unit", text.where, "expected a unit such as deg"
        )
    return unit_and_length[0]


def _format_si_unit(unit: Unit | None) -> str | None:
    """Return the SI unit of a curve's values as text, "rad" for a dimensionless unit; None without a declared unit."""
    return None if unit is None else "rad" if unit.dimension == DIMENSIONLESS else find_si_unit(unit.dimension)


def _convert_points_to_rows(items: Items, owner: str) -> list[Row]:
    """Return the points of a list in the file as rows, in the order of the file."""
    return [Row((str(x), str(y)), (x.where, y.where)) for x, y in items]


def _read_table_bytes(reader: Reader, name: Text) -> bytes:
    """Return the bytes of a table next to the mechanism file, at most MAX_TABLE_BYTES.

    Their SHA-256 is recorded in reader.tables. Raises InputError.
    """
    data = read_table_file(reader.file, str(name), MAX_TABLE_BYTES, name.where)
    reader.tables[str(name)] = hashlib.sha256(data).hexdigest()
    return data


def _parse_table_rows(reader: Reader, name: Text, data: bytes) -> list[Row]:
    """Return the rows of a table whose bytes were read; `name` is its path relative to the mechanism file.

    Raises BadValueError at a cell that is not a number.
    """
    return read_table(data, str(Path(reader.file).parent / name), lambda text: _parse_decimal(text) is not None)


def _parse_long_table(
    data: bytes, x_unit: Unit | None, y_unit: Unit | None, end_condition: str
) -> tuple[tuple[float, ...], tuple[float, ...]] | None:
    """Return both columns (SI) of a table of more than MAX_BYTES, parsed at once; None if it must be read row by row.

    That is so for shorter tables and for those with an error, whose location only the rows show. Numbers are converted
    to SI in binary64: their last digit may differ from that of a shorter table.
    """
    if len(data) <= MAX_BYTES:
        return None
    separator = next((separator for separator in (";", "\t", ",") if separator.encode() in data), ",")
    first_line, _, rows = data.partition(b"\n")
    if not re.search(rb"[0-9]|\r.", first_line):  # the first line has no digit
        first_line_text = first_line.decode("utf-8-sig", "replace")
        data = (
            rows
            if first_line_text.lstrip().startswith("#") or is_header_row(first_line_text.split(separator))
            else data
        )
    if re.search(rb"[^-+.,;\t\r\n 0-9eE]", data):
        return None
    try:
        table = np.loadtxt(io.BytesIO(data), delimiter=separator, ndmin=2)
    except ValueError:
        return None
    scales = [float(unit.to_si(Fraction(1))) if unit else 1.0 for unit in (x_unit, y_unit)]
    if table.shape[1:] != (2,) or len(table) > MAX_POINTS:
        return None
    x, y = (table * scales).T
    sizes = np.abs(table[table != 0.0])
    fits = (
        np.isfinite(table).all()
        and (sizes < _MAX_MAGNITUDE).all()
        and (sizes > _MIN_MAGNITUDE).all()
        and (np.diff(x) > 0.0).all()
    )
    if not fits or (end_condition == PERIODIC and y[0] != y[-1]):
        return None
    return tuple(x.tolist()), tuple(y.tolist())


_MIN_MAGNITUDE, _MAX_MAGNITUDE = 1e-140, 1e140  # magnitudes that stay within binary64 after conversion of units


def _parse_decimal(text: str) -> Fraction | None:
    """Return a decimal number as an exact fraction.

    Return None if the text is not a decimal number or has more than `_MAX_DECIMAL_LENGTH` characters.
    """
    return Fraction(text) if len(text) <= _MAX_DECIMAL_LENGTH and _DECIMAL.fullmatch(text) else None


def _convert_column_to_si(rows: Sequence[Row], column: int, unit: Unit | None) -> tuple[float, ...]:
    """Return a column (0: x, 1: y) of the rows in SI units; without a unit, the numbers as they are.

    Raises LimitError for too many points, BadValueError at a cell that is not a number or out of range.
    """
    if len(rows) > MAX_POINTS:
        raise LimitError(f"{len(rows)} points", rows[0].locations[0], f"expected at most {MAX_POINTS} in a curve")
    values = []
    for row in rows:
        text, location = row.cells[column], row.locations[column]
        fraction = _parse_decimal(text)
        if fraction is None:
            hint = "expected a decimal number, with its unit in x: or y:"
            raise BadValueError(f"{text[:_MAX_DECIMAL_LENGTH]!r} is not a number", location, hint)
        try:
            value = unit.to_si(fraction) if unit else float(fraction)
        except OverflowError:
            value = math.inf
        if not abs(value) < 1e150 or fraction and abs(value) < 1e-150:  # their powers must be finite in C
            raise BadValueError(f"{text!r} is out of range", location, "expected a magnitude from 1e-150 to 1e150")
        values.append(value)
    return tuple(values)


def _check_points(
    address: str, end_condition: str, rows: Sequence[Row], x: Sequence[float], y: Sequence[float], location: Location
) -> None:
    """Raise BadValueError unless there are enough points, x rises strictly, and periodic curves end as they begin.

    `address`: the curve's address; `end_condition`: its key `ends`; `location`: the location of its name.
    """
    if len(x) < MIN_POINTS[end_condition]:
        hint = f"expected at least {MIN_POINTS[end_condition]} for ends: {end_condition}"
        raise BadValueError(f"{address} has {len(x)} point{'s' * (len(x) != 1)}", location, hint)
    for k in range(1, len(x)):
        if not x[k] > x[k - 1]:
            texts = rows[k].cells[0], rows[k - 1].cells[0]
            hint = "expected strictly rising x"
            raise BadValueError(f"{address}: x is {texts[0]} after {texts[1]}", rows[k].locations[0], hint)
    if end_condition == PERIODIC and y[0] != y[-1]:
        hint = f"expected {rows[0].cells[1]}, as in the first point, or another value of ends"
        raise BadValueError(f"{address} is periodic and ends at {rows[-1].cells[1]}", rows[-1].locations[1], hint)

"""Curves: splines through points that the file gives, or a table of two columns beside it."""

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
from gudgeon.generator.reader.fields import Around, read_fields
from gudgeon.generator.yaml import Items, Map, Text, kind_of
from gudgeon.language.curves import LEAST, MONOTONE, NOT_A_KNOT, PERIODIC, STOP, Curve, in_pairs, spline
from gudgeon.language.functions import FUNCTIONS
from gudgeon.language.units import DIMENSIONLESS, Unit, parse_unit, si_unit

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


MOST_POINTS = 1 << 21  # of a curve
_DECIMAL = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?", re.ASCII)
_LONGEST = 40  # characters of a number
_NOTHING = Curve("", (0.0, 1.0), ((0.0, 0.0, 0.0, 0.0),), extrapolate="line")  # stands for one that cannot be read


def read_curves(reader: Reader, root: Map) -> dict[str, Curve]:
    """The section `curves:`; reader.curves and reader.tables know them afterwards."""
    for name, node in root.part("curves").pairs():
        reader.curves[str(name)] = _NOTHING
        with reader.collect():
            reader.curves[str(name)] = _curve(reader, name, node) or _NOTHING
        if name in FUNCTIONS:  # it was refused: a call is that of the function
            del reader.curves[str(name)]
    return reader.curves


def _curve(reader: Reader, name: Text, node: Map) -> Curve | None:
    """A curve; None if it cannot be read for a reason that was told."""
    owner = f"curves.{name}"
    told = len(reader.errors)
    options = read_fields(reader, node, [f for f in CURVE.fields if f.kind == WORD], Around(owner)).options
    over, of = _unit(node, "x", owner), _unit(node, "y", owner)
    if ("points" in node) == ("table" in node):
        both = "both points and a table" if "points" in node else "neither points nor a table"
        raise MissingKeyError(f"{owner} has {both}", name.where, "expected points: [[x, y], …] or table: FILE.csv")
    data = _data(reader, node["table"]) if "table" in node else b""
    if len(reader.errors) > told:
        return None
    ends, extrapolate = str(options["ends"]), str(options["extrapolate"])
    if ends == PERIODIC and extrapolate != STOP:
        where = node["extrapolate"].where
        raise BadValueError(f"{owner} is periodic and goes on {extrapolate!r}", where, "leave extrapolate out")
    interpolation = str(options["interpolation"])
    if interpolation == MONOTONE and ends == NOT_A_KNOT:
        hint = "expected natural, clamped or periodic"
        raise BadValueError(f"{owner} is monotone with ends: not_a_knot", node["ends"].where, hint)
    long = _long_table(data, over, of, ends)
    if long is None:
        rows = _table(reader, node["table"], data) if "table" in node else _points(node["points"], owner)
        x, y = _numbers(rows, 0, over), _numbers(rows, 1, of)
        _check(owner, ends, rows, x, y, name.where)
    else:
        x, y = long
    coefficients = spline(x, y, ends, interpolation)
    knots, coefficients = in_pairs(x, coefficients) if ends == PERIODIC else (x, coefficients)
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
        _si_of(of),
        str(node["x"]) if over else "",
        str(node["table"]) if "table" in node else "",
        interpolation,
        len(x),
    )


def _unit(node: Map, key: str, owner: str) -> Unit | None:
    """The unit of a column; None: bare numbers, SI, which fit any dimension."""
    if key not in node:
        return None
    text = node[key]
    found = parse_unit(str(text))
    if found is None or found[1] != len(text):
        raise UnitError(f"{owner}.{key} is {kind_of(text)}, which is no unit", text.where, "expected one such as deg")
    return found[0]


def _si_of(of: Unit | None) -> str | None:
    """What results call the unit of its values."""
    return None if of is None else "rad" if of.dimension == DIMENSIONLESS else si_unit(of.dimension)


def _points(items: Items, owner: str) -> list[Row]:
    return [Row((str(x), str(y)), (x.where, y.where)) for x, y in items]


def _data(reader: Reader, name: Text) -> bytes:
    """What a table holds; its sha256 is noted."""
    data = read_beside(reader.file, str(name), MAX_TABLE_BYTES, name.where)
    reader.tables[str(name)] = hashlib.sha256(data).hexdigest()
    return data


def _table(reader: Reader, name: Text, data: bytes) -> list[Row]:
    """The rows of a table."""
    return read_table(data, str(Path(reader.file).parent / name), lambda text: _fraction(text) is not None)


def _long_table(
    data: bytes, over: Unit | None, of: Unit | None, ends: str
) -> tuple[tuple[float, ...], tuple[float, ...]] | None:
    """Return both columns, SI, of a table of more than a megabyte, read at once; None where a row must be looked at.

    Numbers are converted to SI in binary64: their last digit may differ from that of a shorter table.
    """
    if len(data) <= MAX_BYTES:
        return None
    mark = next((mark for mark in (";", "\t", ",") if mark.encode() in data), ",")
    head, _, rows = data.partition(b"\n")
    if not re.search(rb"[0-9]|\r.", head):  # one line without a digit
        line = head.decode("utf-8-sig", "replace")
        data = rows if line.lstrip().startswith("#") or is_header(line.split(mark)) else data
    if re.search(rb"[^-+.,;\t\r\n 0-9eE]", data):
        return None
    try:
        table = np.loadtxt(io.BytesIO(data), delimiter=mark, ndmin=2)
    except ValueError:
        return None
    scales = [float(unit.to_si(Fraction(1))) if unit else 1.0 for unit in (over, of)]
    if table.shape[1:] != (2,) or len(table) > MOST_POINTS:
        return None
    x, y = (table * scales).T
    sizes = np.abs(table[table != 0.0])
    fits = np.isfinite(table).all() and (sizes < _HIGH).all() and (sizes > _LOW).all() and (np.diff(x) > 0.0).all()
    if not fits or (ends == PERIODIC and y[0] != y[-1]):
        return None
    return tuple(x.tolist()), tuple(y.tolist())


_LOW, _HIGH = 1e-140, 1e140  # magnitudes that units leave within the range of numbers


def _fraction(text: str) -> Fraction | None:
    """A decimal number exactly; None where it is none."""
    return Fraction(text) if len(text) <= _LONGEST and _DECIMAL.fullmatch(text) else None


def _numbers(rows: Sequence[Row], column: int, unit: Unit | None) -> tuple[float, ...]:
    """A column in SI. Raises BadValueError at what is no number."""
    if len(rows) > MOST_POINTS:
        raise LimitError(f"{len(rows)} points", rows[0].where[0], f"expected at most {MOST_POINTS} in a curve")
    found = []
    for row in rows:
        text, where = row.text[column], row.where[column]
        exact = _fraction(text)
        if exact is None:
            hint = "expected a decimal number, with its unit in x: or y:"
            raise BadValueError(f"{text[:_LONGEST]!r} is no number", where, hint)
        try:
            value = unit.to_si(exact) if unit else float(exact)
        except OverflowError:
            value = math.inf
        if not abs(value) < 1e150 or exact and abs(value) < 1e-150:  # powers of them must be numbers of C
            raise BadValueError(f"{text!r} is out of range", where, "expected a magnitude from 1e-150 to 1e150")
        found.append(value)
    return tuple(found)


def _check(owner: str, ends: str, rows: Sequence[Row], x: Sequence[float], y: Sequence[float], where: Location) -> None:
    """Enough points, one behind the other; raises BadValueError at the first that is not."""
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

"""Interpolate curves through points: cubic splines and monotone cubics, as coefficients and as values.

A spline has a continuous second derivative: C. de Boor, A Practical Guide to Splines (2001), chapter IV. A monotone
cubic is C¹ and stays between neighbouring points: F. N. Fritsch, R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238–246;
F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300–304.

Between knots k and k + 1 a curve is y = c0 + h (c1 + h (c2 + h c3)) with h = x − x_k. All targets evaluate this by
Horner's rule, in this order.
"""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from gudgeon.language.units import Dimension

NATURAL, CLAMPED, PERIODIC, NOT_A_KNOT = ENDS = ("natural", "clamped", "periodic", "not_a_knot")
SPLINE, MONOTONE = INTERPOLATIONS = ("spline", "monotone")
STOP, HOLD, LINE = EXTRAPOLATE = ("none", "hold", "line")
MIN_POINTS = {NATURAL: 2, CLAMPED: 2, PERIODIC: 3, NOT_A_KNOT: 4}  # smallest number of points by condition at the ends
_INTERPOLATION_NAMES = {SPLINE: "cubic spline", MONOTONE: "monotone cubic"}  # names of the interpolations in messages
MAX_LISTED_KNOTS = 4000  # tables of longer curves are stored and emitted as bytes, in a tenth of the time
RANGE_TOL = 1e-9  # fraction of the range by which an argument may be outside, because of rounding


@dataclass(frozen=True)
class Curve:
    """A piecewise cubic curve over increasing knots x (n + 1) with coefficients (n, 4), SI units.

    A dimension of None fits any dimension.
    """

    name: str
    x: tuple[float, ...]
    coefficients: tuple[tuple[float, float, float, float], ...]
    ends: str = NATURAL
    extrapolate: str = STOP  # outside the range; not used by periodic curves
    argument: Dimension | None = None
    value: Dimension | None = None
    unit: str | None = None  # SI, of the value: an angle's is rad
    over: str = ""  # unit of x in the file; "": SI
    source: str = ""  # file of the points
    interpolation: str = SPLINE
    points: int = 0  # number of points; there may be one more knot (`make_even_pieces`)

    @property
    def is_periodic(self) -> bool:
        """Return whether the curve is periodic."""
        return self.ends == PERIODIC

    @property
    def is_extrapolated(self) -> bool:
        """Return whether the curve is extrapolated beyond its range (held or straight), which begins at a switching
        point.
        """
        return self.extrapolate != STOP

    @property
    def is_long(self) -> bool:
        """Return whether the curve has more than MAX_LISTED_KNOTS knots, so that its tables are stored and emitted as
        bytes.
        """
        return len(self.x) > MAX_LISTED_KNOTS

    def __hash__(self) -> int:
        """Return a hash of name, range, number of knots and options; the coefficients would take too long."""
        return hash((self.name, self.x[0], self.x[-1], len(self.x), self.ends, self.extrapolate))

    @cached_property
    def _tables(self) -> tuple[Any, Any]:
        """Return knots (n + 1,) and coefficients (n, 4) as arrays."""
        return np.array(self.x), np.array(self.coefficients)

    @property
    def range_text(self) -> str:
        """Return the range of the argument as text, in SI units: "from 0 to 0.5 s"."""
        from gudgeon.language.units import find_si_unit

        unit = find_si_unit(self.argument) if self.argument is not None else ""
        return f"from {self.x[0]:.6g} to {self.x[-1]:.6g} {unit or '(SI, angles in rad)'}"

    def describe_out_of_range(self, x: float) -> str:
        """Return a text for a message: argument x lies outside the range, which is given in SI and in the file's unit.

        The numbers have enough digits to differ. The text names keys that extend the curve.
        """
        from gudgeon.language.plot_units import format_distinct_numbers
        from gudgeon.language.units import parse_unit

        low, high = self.x[0], self.x[-1]
        value_text, end = format_distinct_numbers(x, high if x > high else low, 6)
        ends = (f"{low:.6g}", end) if x > high else (end, f"{high:.6g}")
        unit_and_end = parse_unit(self.over) if self.over else None
        size = unit_and_end[0].to_si(Fraction(1)) if unit_and_end else 1.0
        file_range = f", from {low / size:.6g} to {high / size:.6g} {self.over}" if size != 1.0 else ""
        return (
            f"at {value_text}, outside its range, from {ends[0]} to {ends[1]} (SI, angles in rad){file_range};"
            f" in curves.{self.name}, ends: periodic repeats it, extrapolate: hold or line extends it"
        )

    def describe(self) -> str:
        """Return a description: "cubic spline through 5 points, natural ends, from 0 to 1 s, outside none"."""
        ends = f"{self.ends.replace('_', '-')} ends"
        after = "repeated" if self.is_periodic else {STOP: "none", HOLD: "held", LINE: "linear"}[self.extrapolate]
        points = f"{self.points} points{f' of {self.source}' * bool(self.source)}"
        return (
            f"{_INTERPOLATION_NAMES[self.interpolation]} through {points}, {ends}, {self.range_text}, outside {after}"
        )

    def compute_end_derivative(self, order: int) -> float:
        """Return the derivative of the given order (0: value) at the last knot."""
        return float(_evaluate_cubic(np.array(self.coefficients[-1]), np.float64(self.x[-1] - self.x[-2]), order))

    def is_within(self, x: Any) -> Any:
        """Return whether the curve has a value at x (number or array), with a tolerance of RANGE_TOL times the range.

        Periodic and extrapolated curves have one at every finite x.
        """
        if self.is_periodic or self.extrapolate != STOP:
            return np.isfinite(x)
        margin = RANGE_TOL * (self.x[-1] - self.x[0])
        return (x >= self.x[0] - margin) & (x <= self.x[-1] + margin)

    def evaluate(self, x: Any, order: int = 0) -> Any:
        """Return the values or derivatives of the given order (0 to 3) at x, a number or an array, in SI.

        At a knot the piece to the right counts. Outside its range a curve is periodic, constant (hold) or linear as its
        options say, else NaN.
        """
        x = np.asarray(x, dtype=float)
        (knots, pieces), first, last = self._tables, self.x[0], self.x[-1]
        with np.errstate(invalid="ignore"):
            inside = self.is_within(x)
            if self.is_periodic:
                x = x - (last - first) * np.floor((x - first) / (last - first))
            held = np.clip(x, first, last) if self.extrapolate != STOP else x
            k = np.clip(np.searchsorted(knots, held, side="right") - 1, 0, len(knots) - 2)
            value = _evaluate_cubic(np.moveaxis(pieces[k], -1, 0), held - knots[k], order)
            value = self._extrapolate(value, x, order)
        return np.where(inside, value, np.nan)[()]

    def _extrapolate(self, value: Any, x: Any, order: int) -> Any:
        """Return `value` with the entries outside the range replaced by those of the extrapolation; unchanged without
        one.

        value, x: values or derivatives of the given order at arguments x, already evaluated at the nearest end. With
        `hold`, derivatives are 0 outside; with `line`, the slope of the end continues and higher derivatives are 0.
        """
        if self.extrapolate == HOLD and order:
            return np.where((x < self.x[0]) | (x > self.x[-1]), 0.0, value)
        if self.extrapolate == LINE and order < 2:
            down, up = self.coefficients[0][1], self.compute_end_derivative(1)
            if order == 1:
                return np.where(x < self.x[0], down, np.where(x > self.x[-1], up, value))
            return value + down * np.minimum(x - self.x[0], 0.0) + up * np.maximum(x - self.x[-1], 0.0)
        if self.extrapolate == LINE:
            return np.where((x < self.x[0]) | (x > self.x[-1]), 0.0, value)
        return value

    def to_data(self) -> list[Any]:
        """Return the curve as a list of JSON data for a stored expression, without dimensions.

        Tables of long curves are base64 texts.
        """
        x, pieces = (encode_table(table) if self.is_long else table.tolist() for table in self._tables)
        return [self.name, x, pieces, self.ends, self.extrapolate, self.unit, self.over]

    @staticmethod
    def from_data(data: Sequence[Any]) -> Curve:
        """Return the curve from the list that `to_data` wrote; lists of earlier versions lack the last entry, the
        file's unit.
        """
        name, x, coefficients, ends, extrapolate, unit, *over = data  # earlier versions did not store `over`
        if isinstance(x, str):
            x, pieces = _decode_tables(x, coefficients)
        else:
            x, pieces = tuple(x), tuple(tuple(c) for c in coefficients)
        return Curve(name, x, pieces, ends, extrapolate, unit=unit, over=over[0] if over else "")


def encode_table(values: Any) -> str:
    """Return the numbers of an array as base64 of binary64, little-endian, row by row."""
    return base64.b64encode(np.asarray(values, "<f8").tobytes()).decode()


@lru_cache(maxsize=8)
def _decode_tables(x: str, pieces: str) -> tuple[tuple[float, ...], tuple[tuple[float, float, float, float], ...]]:
    """Return knots and coefficients of the base64 texts that `encode_table` wrote; the last 8 results are cached."""
    knots, rows = (np.frombuffer(base64.b64decode(text), "<f8") for text in (x, pieces))
    return tuple(knots.tolist()), tuple(map(tuple, rows.reshape(-1, 4).tolist()))


def make_even_pieces(
    x: Sequence[float], pieces: Sequence[tuple[float, float, float, float]]
) -> tuple[tuple[float, ...], tuple[tuple[float, float, float, float], ...]]:
    """Return knots and coefficients with an even number of pieces; if it is odd, the last piece is halved.

    Switching functions distinguish neighbouring pieces by odd and even index, also across the end of a periodic curve.
    """
    if len(pieces) % 2 == 0:
        return tuple(x), tuple(pieces)
    half = 0.5 * (x[-1] - x[-2])
    c = np.array(pieces[-1])
    value, slope, bend = (float(_evaluate_cubic(c, half, order)) for order in range(3))
    second = (value, slope, bend / 2.0, pieces[-1][3])
    return (*x[:-1], x[-2] + half, x[-1]), (*pieces, second)


def _evaluate_cubic(coefficients: Any, h: Any, order: int) -> Any:
    """Return the cubic c0 + h (c1 + h (c2 + h c3)), or its derivative of the given order (1 to 3), at h.

    coefficients: c0 to c3, numbers or arrays.
    """
    match order:
        case 0:
            return coefficients[0] + h * (coefficients[1] + h * (coefficients[2] + h * coefficients[3]))
        case 1:
            return coefficients[1] + h * (2.0 * coefficients[2] + h * (3.0 * coefficients[3]))
        case 2:
            return 2.0 * coefficients[2] + h * (6.0 * coefficients[3])
    return 6.0 * coefficients[3]


def compute_spline(
    x: Sequence[float], y: Sequence[float], ends: str, interpolation: str = SPLINE
) -> tuple[tuple[float, float, float, float], ...]:
    """Return the coefficients (n, 4) of the cubic spline or monotone cubic through the points (x, y), x increasing.

    Row k has the factors of the powers 0 to 3 of x − x[k]. Ends: natural (no second derivative), clamped (no slope),
    not_a_knot (the first two pieces are one polynomial, and the last two), periodic (slope and second derivative of the
    end equal those of the beginning). For a monotone cubic, natural means end slopes from three points, limited to keep
    it monotone.
    """
    h = [b - a for a, b in zip(x, x[1:], strict=False)]
    mean_slopes = [(b - a) / step for a, b, step in zip(y, y[1:], h, strict=False)]
    if interpolation == MONOTONE:
        slopes = compute_monotone_slopes(h, mean_slopes, ends == PERIODIC, ends == CLAMPED)
    else:
        slopes = (
            _compute_periodic_slopes(h, mean_slopes)
            if ends == PERIODIC
            else _compute_slopes_with_ends(h, mean_slopes, ends)
        )
    return tuple(
        (
            y[k],
            slopes[k],
            (3.0 * mean_slopes[k] - 2.0 * slopes[k] - slopes[k + 1]) / h[k],
            (slopes[k] + slopes[k + 1] - 2.0 * mean_slopes[k]) / h[k] / h[k],
        )
        for k in range(len(h))
    )


def _build_knot_equation(a: float, b: float, p: float, q: float) -> tuple[float, float, float, float]:
    """Return the linear equation of a spline at a knot between pieces of lengths a, b and mean slopes p, q.

    The result has the entries below, on and above the diagonal, and the right-hand side.
    """
    return b, 2.0 * (a + b), a, 3.0 * (b * p + a * q)


def _compute_slopes_with_ends(h: Sequence[float], mean_slopes: Sequence[float], ends: str) -> list[float]:
    """Return the slopes at all knots of a spline that is clamped, natural or not_a_knot at its ends.

    h, mean_slopes: lengths and mean slopes of the pieces.
    """
    rows = [
        _build_knot_equation(a, b, p, q) for a, b, p, q in zip(h, h[1:], mean_slopes, mean_slopes[1:], strict=False)
    ]
    if ends == CLAMPED:
        first, last = (0.0, 1.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0)
    elif ends == NATURAL:
        first, last = (0.0, 2.0, 1.0, 3.0 * mean_slopes[0]), (1.0, 2.0, 0.0, 3.0 * mean_slopes[-1])
    else:
        above, right = _build_not_a_knot_equation(h[0], h[1], mean_slopes[0], mean_slopes[1])
        first = (0.0, h[1], above, right)
        below, right = _build_not_a_knot_equation(h[-1], h[-2], mean_slopes[-1], mean_slopes[-2])
        last = (below, h[-2], 0.0, right)
    return _solve_tridiagonal([first, *rows, last])


def _build_not_a_knot_equation(a: float, b: float, p: float, q: float) -> tuple[float, float]:
    """Return the end equation of not_a_knot: the factor of the inner slope, and the right-hand side.

    The outer piece has length a and mean slope p, its neighbour b and q.
    """
    total_length = a + b
    return total_length, ((a + 2.0 * total_length) * b * p + a * a * q) / total_length


def _compute_periodic_slopes(h: Sequence[float], mean_slopes: Sequence[float]) -> list[float]:
    """Return the slopes at all knots of a periodic spline, by two tridiagonal solves (Sherman–Morrison formula).

    h, mean_slopes: lengths and mean slopes of the n pieces. The last of the n + 1 slopes equals the first.
    """
    before = [h[-1], *h[:-1]]
    rows = [
        _build_knot_equation(a, b, p, q)
        for a, b, p, q in zip(before, h, [mean_slopes[-1], *mean_slopes[:-1]], mean_slopes, strict=True)
    ]
    corner_up, corner_down = rows[0][0], rows[-1][2]  # entries (first, last) and (last, first)
    shift = -rows[0][1]
    modified_rows = [list(row) for row in rows]
    modified_rows[0][1] -= shift
    modified_rows[-1][1] -= corner_up * corner_down / shift
    correction = _solve_tridiagonal(modified_rows)
    for row in modified_rows:
        row[3] = 0.0
    modified_rows[0][3], modified_rows[-1][3] = shift, corner_down
    correction_by_corner = _solve_tridiagonal(modified_rows)
    fraction = corner_up / shift
    factor = (correction[0] + fraction * correction[-1]) / (
        1.0 + correction_by_corner[0] + fraction * correction_by_corner[-1]
    )
    slopes = [a - factor * b for a, b in zip(correction, correction_by_corner, strict=True)]
    return [*slopes, slopes[0]]


def _solve_tridiagonal(rows: Sequence[Sequence[float]]) -> list[float]:
    """Return the solution of a diagonally dominant tridiagonal system by elimination without pivoting.

    rows: entries below, on and above the diagonal, and right-hand side, for each equation.
    """
    above, right = [0.0] * len(rows), [0.0] * len(rows)
    for k, (below, diagonal, superdiagonal, value) in enumerate(rows):
        pivot = diagonal - (below * above[k - 1] if k else 0.0)
        above[k], right[k] = superdiagonal / pivot, (value - (below * right[k - 1] if k else 0.0)) / pivot
    for k in range(len(rows) - 2, -1, -1):
        right[k] -= above[k] * right[k + 1]
    return right


def compute_monotone_slopes(
    h: Sequence[float], mean_slopes: Sequence[float], is_periodic: bool, has_flat_ends: bool
) -> list[float]:
    """Return the slopes at all knots of a monotone cubic: weighted harmonic means of the mean slopes on both sides, 0
    at extrema.

    h, mean_slopes: lengths and mean slopes of the pieces, (n,). is_periodic: of the curve. has_flat_ends: the slopes at
    both ends are 0; else they follow from three points, or are the mean slope of a single piece.
    """
    if is_periodic:
        inner = [
            _compute_harmonic_mean(*neighbours)
            for neighbours in zip([h[-1], *h[:-1]], h, [mean_slopes[-1], *mean_slopes[:-1]], mean_slopes, strict=True)
        ]
        return [*inner, inner[0]]
    inner = [
        _compute_harmonic_mean(*neighbours) for neighbours in zip(h, h[1:], mean_slopes, mean_slopes[1:], strict=False)
    ]
    if has_flat_ends:
        return [0.0, *inner, 0.0]
    if not inner:
        return [mean_slopes[0], mean_slopes[0]]
    first, last = _compute_end_slope(*h[:2], *mean_slopes[:2]), _compute_end_slope(*h[:-3:-1], *mean_slopes[:-3:-1])
    return [first, *inner, last]


def _compute_harmonic_mean(a: float, b: float, p: float, q: float) -> float:
    """Return the slope of a monotone cubic (PCHIP) at a knot between pieces of lengths a, b and mean slopes p, q.

    It is their weighted harmonic mean, and 0 if p and q have different signs.
    """
    if p * q <= 0.0:
        return 0.0
    w, v = 2.0 * b + a, b + 2.0 * a
    return (w + v) / (w / p + v / q)


def _compute_end_slope(a: float, b: float, p: float, q: float) -> float:
    """Return the limited slope at the end of a monotone cubic (PCHIP), from the parabola through the last three points.

    a, b: lengths of the outer piece and of its neighbour; p, q: their mean slopes. It is 0 if its sign differs from
    that of p, and at most 3 p at an extremum (p and q of different signs).
    """
    slope = ((2.0 * a + b) * p - a * q) / (a + b)
    if slope * p <= 0.0:
        return 0.0
    return 3.0 * p if p * q <= 0.0 and abs(slope) > 3.0 * abs(p) else slope

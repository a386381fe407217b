"""Curves of a file and contours of bearings as functions of SymPy; their values are stored elsewhere."""

from __future__ import annotations

import sympy as sp
from sympy.core.symbol import Str

from gudgeon.generator.symbols.derivatives import derivative
from gudgeon.language.curves import HOLD, STOP, Curve

_LAST = 3  # derivatives of a cubic: the third has jumps at the knots, and no derivative in between


class CurveOf(sp.Function):
    """CurveOf(name, k, x): the k-th derivative of a curve at x within its range."""

    nargs = 3
    is_real = True

    @property
    def name(self) -> str:
        """Return the name of the curve."""
        return str(self.args[0].name)

    @property
    def order(self) -> int:
        """Return which derivative this is."""
        return int(self.args[1])

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """Return the next derivative; the third derivative is piecewise constant."""
        name, order, x = self.args
        rate = derivative(x, s)
        return sp.Integer(0) if rate == 0 or order == _LAST else CurveOf(name, order + 1, x) * rate


class CurveOn(sp.Function):
    """CurveOn(name, k, x, side): the curve on the pieces of one held branch, each continued beyond its knots."""

    nargs = 4
    is_real = True
    name, order = CurveOf.name, CurveOf.order

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """Return the next derivative on the same branch."""
        name, order, x, side = self.args
        rate = derivative(x, s)
        return sp.Integer(0) if rate == 0 or order == _LAST else CurveOn(name, order + 1, x, side) * rate


class KnotsOf(sp.Function):
    """KnotsOf(name, x): the switching function of a curve's knots.

    It is positive in the first piece, negative in the second, and so on; 0 at knots.
    """

    nargs = 2
    is_real = True
    name = CurveOf.name


def curve_of(curve: Curve, x: sp.Expr) -> sp.Expr:
    """Return a curve at x; its continuation beyond the range is by min and max, whose switching points end steps."""
    name, zero, one = Str(curve.name), sp.Integer(0), sp.Integer(1)
    if curve.repeats or curve.extrapolate == STOP:
        return CurveOf(name, zero, x)
    first, last = sp.Float(curve.x[0], 17), sp.Float(curve.x[-1], 17)
    value = CurveOf(name, zero, sp.Max(first, sp.Min(last, x)))
    if curve.extrapolate == HOLD:
        return value
    down, up = CurveOf(name, one, first), CurveOf(name, one, last)
    return value + down * sp.Min(0, x - first) + up * sp.Max(0, x - last)


def c_name(name: str) -> str:
    """Return the name of a curve in the emitted functions."""
    return f"CURVE_{name}_"


_LAST_OF_CONTOUR = 2  # derivatives of a contour: the third jumps from slot to slot


class ContourOf(sp.Function):
    """ContourOf(table, n, k, x): the k-th derivative by the angle x of the contour through n depths."""

    nargs = 4
    is_real = True

    @property
    def table(self) -> str:
        """Return the name of the array of depths in Parameters."""
        return str(self.args[0].name)

    @property
    def count(self) -> int:
        """Return the number of depths."""
        return int(self.args[1])

    @property
    def order(self) -> int:
        """Return which derivative this is."""
        return int(self.args[2])

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """Return the next derivative; that of the second is taken as 0."""
        table, count, order, x = self.args
        rate = derivative(x, s)
        return sp.Integer(0) if rate == 0 or order == _LAST_OF_CONTOUR else ContourOf(table, count, order + 1, x) * rate


def contour_of(table: str, count: int, order: int, angle: sp.Expr) -> sp.Expr:
    """Return the derivative of an `order` of the contour with the depths `table`, at an angle."""
    return ContourOf(Str(table), sp.Integer(count), sp.Integer(order), angle)

"""Curves of a file and contours of bearings as SymPy functions; tables of their values are stored separately."""

from __future__ import annotations

import sympy as sp
from sympy.core.symbol import Str

from gudgeon.generator.symbols.derivatives import differentiate
from gudgeon.language.curves import HOLD, STOP, Curve

_MAX_ORDER = 3  # derivatives of a cubic: the third has jumps at the knots, and no derivative in between


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
        """Return the order k of the derivative."""
        return int(self.args[1])

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """Return the derivative by `s` (chain rule): the derivative of order + 1 at the argument x, times dx/ds.

        The result is 0 for order 3: third derivatives of a curve of cubic pieces are constant. Called by SymPy.
        """
        name, order, x = self.args
        rate = differentiate(x, s)
        return sp.Integer(0) if rate == 0 or order == _MAX_ORDER else CurveOf(name, order + 1, x) * rate


class CurveOn(sp.Function):
    """CurveOn(name, k, x, side): the curve on the pieces of one frozen branch, each continued beyond its knots."""

    nargs = 4
    is_real = True
    name, order = CurveOf.name, CurveOf.order

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """Return the derivative by `s` (chain rule): that of order + 1 at x on the same branch, times dx/ds.

        The result is 0 for order 3: third derivatives of a curve of cubic pieces are constant. Called by SymPy.
        """
        name, order, x, branch = self.args
        rate = differentiate(x, s)
        return sp.Integer(0) if rate == 0 or order == _MAX_ORDER else CurveOn(name, order + 1, x, branch) * rate


class KnotsOf(sp.Function):
    """KnotsOf(name, x): the switching function of a curve's knots.

    It is positive in the first piece, negative in the second, and so on; 0 at knots.
    """

    nargs = 2
    is_real = True
    name = CurveOf.name


def make_curve_expression(curve: Curve, x: sp.Expr) -> sp.Expr:
    """Return the value of a curve of the file at x as a SymPy expression.

    Beyond its range the curve is constant or linear, by its `extrapolate`, through min and max, whose switching points
    end steps. A periodic curve, or one that stops a run there, is not continued.
    """
    name, zero, one = Str(curve.name), sp.Integer(0), sp.Integer(1)
    if curve.is_periodic or curve.extrapolate == STOP:
        return CurveOf(name, zero, x)
    first_x, last_x = sp.Float(curve.x[0], 17), sp.Float(curve.x[-1], 17)
    value = CurveOf(name, zero, sp.Max(first_x, sp.Min(last_x, x)))
    if curve.extrapolate == HOLD:
        return value
    down, up = CurveOf(name, one, first_x), CurveOf(name, one, last_x)
    return value + down * sp.Min(0, x - first_x) + up * sp.Max(0, x - last_x)


def make_curve_name(name: str) -> str:
    """Return the name of a curve of the file in emitted code, such as `CURVE_load_`."""
    return f"CURVE_{name}_"


_MAX_CONTOUR_ORDER = 2  # derivatives of a contour: the third jumps from one interval to the next


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
        """Return the order k of the derivative."""
        return int(self.args[2])

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """Return the derivative by `s`: the next derivative by the angle times that of the angle.

        The derivative of the second one is 0. Called by SymPy.
        """
        table, count, order, x = self.args
        rate = differentiate(x, s)
        return (
            sp.Integer(0) if rate == 0 or order == _MAX_CONTOUR_ORDER else ContourOf(table, count, order + 1, x) * rate
        )


def make_contour_expression(table: str, n_depths: int, order: int, angle: sp.Expr) -> sp.Expr:
    """Return the depth of a bearing's contour at an angle, or its derivative of an `order` by the angle.

    The result is a SymPy expression. `table`: the array of Parameters that holds its depths in m; `n_depths`: their
    number.
    """
    return ContourOf(Str(table), sp.Integer(n_depths), sp.Integer(order), angle)

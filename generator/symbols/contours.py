"""Contours of bearings as functions of SymPy: depths that a run may set, as an array of Parameters, over an angle."""

from __future__ import annotations

import sympy as sp
from sympy.core.symbol import Str

from gudgeon.generator.symbols.derivatives import derivative

_LAST = 2  # derivatives of a contour: the third jumps from slot to slot


class ContourOf(sp.Function):
    """ContourOf(table, n, k, x): the k-th derivative by the angle x of the contour through n depths."""

    nargs = 4
    is_real = True

    @property
    def table(self) -> str:
        """What the array of depths is called in Parameters."""
        return str(self.args[0].name)

    @property
    def count(self) -> int:
        """How many depths there are."""
        return int(self.args[1])

    @property
    def order(self) -> int:
        """Which derivative."""
        return int(self.args[2])

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        table, count, order, x = self.args
        rate = derivative(x, s)
        return sp.Integer(0) if rate == 0 or order == _LAST else ContourOf(table, count, order + 1, x) * rate


def contour_of(table: str, count: int, order: int, angle: sp.Expr) -> sp.Expr:
    """A derivative of the contour whose depths are called `table`."""
    return ContourOf(Str(table), sp.Integer(count), sp.Integer(order), angle)

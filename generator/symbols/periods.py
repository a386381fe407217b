"""Remainders as functions of SymPy: mod(a, b) = a − b⌊a/b⌋, whose jumps at the ends of periods are corners."""

from __future__ import annotations

import sympy as sp


class ModOf(sp.Function):
    """ModOf(a, b): from 0 to b, with the sign of b."""

    nargs = 2
    is_real = True

    @classmethod
    def eval(cls, a: sp.Expr, b: sp.Expr) -> sp.Expr | None:
        """Of numbers their remainder, exactly."""
        return a - b * sp.floor(a / b) if a.is_Rational and b.is_Rational and b != 0 else None

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """That of a, less what b grows in each of the periods that are behind."""
        a, b = self.args[:2]
        rate = sp.diff(b, s)
        return sp.diff(a, s) - (0 if rate == 0 else rate * (a - self) / b)


class ModOn(ModOf):
    """ModOn(a, b, side): the same in periods of one side, each as it goes on beyond its ends."""

    nargs = 3

    @classmethod
    def eval(cls, a: sp.Expr, b: sp.Expr, side: sp.Expr) -> sp.Expr | None:
        """As it stands."""
        return None


class PeriodsOf(sp.Function):
    """PeriodsOf(a, b): above zero in the periods of even number, below it in the others; 0 where they meet."""

    nargs = 2
    is_real = True

"""Remainders as functions of SymPy: mod(a, b) = a − b⌊a/b⌋, whose jumps at the ends of periods are corners."""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.symbols.derivatives import derivative
from gudgeon.language.functions import mod


class _Remainder(sp.Function):
    is_real = True

    def _eval_derivative(self, s: sp.Symbol) -> sp.Expr:
        """That of a, less what b grows in each of the periods that are behind."""
        a, b = self.args[:2]
        rate = derivative(b, s)
        return derivative(a, s) - (0 if rate == 0 else rate * (a - self) / b)


class ModOf(_Remainder):
    """ModOf(a, b): from 0 to b, with the sign of b."""

    nargs = 2

    @classmethod
    def eval(cls, a: sp.Expr, b: sp.Expr) -> sp.Expr | None:
        """Of numbers their remainder: exactly, or as binary64 has it."""
        if not (a.is_number and b.is_number):
            return None
        if a.is_Rational and b.is_Rational and b != 0:
            return a - b * sp.floor(a / b)
        return sp.Float(mod(float(a), float(b)), 17) if b != 0 else sp.nan


class ModOn(_Remainder):
    """ModOn(a, b, side): the same in periods of one side, each as it goes on beyond its ends."""

    nargs = 3


class PeriodsOf(sp.Function):
    """PeriodsOf(a, b): above zero in the periods of even number, below it in the others; 0 where they meet."""

    nargs = 2
    is_real = True

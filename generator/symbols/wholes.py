"""Products that stay together: SymPy takes (0.01 x)^161 apart, and neither 1e-322 nor x^161 need be numbers of C.

What it would make of an operation is looked at; where that has a number far from 1 that was not written, or powers
that each may leave binary64 while the product of them does not, the operands become wholes that it cannot look into.
"""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

_FAR = 60  # decades from 1 beyond which no number is made that was not written
_HIGH = 16  # a power that is given to the factors of its base one by one, at most


class Whole(sp.Function):
    """Whole(x): x, as one factor or the base of a power."""

    nargs = 1

    @classmethod
    def eval(cls, x: sp.Expr) -> sp.Expr | None:
        """What cannot be taken apart anyway stays as it is."""
        return x if x.is_Atom or isinstance(x, Whole) else None

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        return sp.Integer(1)

    def _eval_is_extended_real(self) -> bool | None:
        return self.args[0].is_extended_real

    def _eval_is_finite(self) -> bool | None:
        return self.args[0].is_finite

    def _eval_is_extended_nonnegative(self) -> bool | None:
        return self.args[0].is_extended_nonnegative

    def _eval_is_extended_positive(self) -> bool | None:
        return self.args[0].is_extended_positive

    def _eval_is_extended_negative(self) -> bool | None:
        return self.args[0].is_extended_negative

    def _eval_is_zero(self) -> bool | None:
        return self.args[0].is_zero


class Share(Whole):
    """v′/v, whose derivative too stays together: SymPy would make v² of two of them, which may be no number of C."""


def kept(make: Callable[..., sp.Expr], *operands: sp.Expr) -> sp.Expr:
    """What an operation makes of its operands; of wholes where it would take them apart to numbers that C has not."""
    made = make(*operands)
    if all(x.is_number for x in operands) or not _is_torn(made, operands):
        return made
    return make(*(x if x.is_number else Whole(x) for x in operands))


def _is_torn(made: sp.Expr, operands: tuple[sp.Expr, ...]) -> bool:
    far = {x for x in made.atoms(sp.Number) if _is_far(x)}
    if far and not far <= set().union(*(x.atoms(sp.Number) for x in operands)):
        return True
    return made.is_Mul and not any(x.is_Mul and _powers(x) for x in operands) and _powers(made) > 1


def _powers(product: sp.Mul) -> int:
    """How many of its factors are high powers."""
    exponents = [x.exp for x in product.args if x.is_Pow]
    return sum(bool(e.is_Number and abs(e) > _HIGH) for e in exponents)


def _is_far(number: sp.Number) -> bool:
    size = abs(number)
    return bool(size.is_finite and size != 0 and not sp.Float(f"1e-{_FAR}") < size < sp.Float(f"1e{_FAR}"))

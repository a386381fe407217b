"""Products that stay together: SymPy expands (0.01 x)^161, but 1e-322 and x^161 may leave the range of C numbers.

An operation is checked after SymPy has performed it. If the result has a number far from 1 that was not written, or
powers that each may leave binary64 while their product does not, the operands become `Whole`s, which SymPy cannot
expand.
"""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

_FAR = 60  # decades from 1 within which numbers that were not written are accepted
_HIGH = 16  # a power that is given to the factors of its base one by one, at most


class Whole(sp.Function):
    """Whole(x): x as one unevaluated factor or base of a power."""

    nargs = 1

    @classmethod
    def eval(cls, x: sp.Expr) -> sp.Expr | None:
        """Return x itself if it cannot be expanded anyway; else None."""
        return x if x.is_Atom or isinstance(x, Whole) else None

    def fdiff(self, argindex: int = 1) -> sp.Expr:
        """Return 1, the derivative by x."""
        return sp.Integer(1)

    def _eval_is_extended_real(self) -> bool | None:
        """Return whether x is known to be real."""
        return self.args[0].is_extended_real

    def _eval_is_finite(self) -> bool | None:
        """Return whether x is known to be finite."""
        return self.args[0].is_finite

    def _eval_is_extended_nonnegative(self) -> bool | None:
        """Return whether x is known to be non-negative."""
        return self.args[0].is_extended_nonnegative

    def _eval_is_extended_positive(self) -> bool | None:
        """Return whether x is known to be positive."""
        return self.args[0].is_extended_positive

    def _eval_is_extended_negative(self) -> bool | None:
        """Return whether x is known to be negative."""
        return self.args[0].is_extended_negative

    def _eval_is_zero(self) -> bool | None:
        """Return whether x is known to be zero."""
        return self.args[0].is_zero


class Share(Whole):
    """The quotient v′/v, whose derivative stays together too: SymPy would form v², which may overflow."""


def kept(make: Callable[..., sp.Expr], *operands: sp.Expr) -> sp.Expr:
    """Return the result of an operation, with operands as `Whole`s if SymPy would expand them to extreme numbers."""
    made = make(*operands)
    if all(x.is_number for x in operands) or not _is_torn(made, operands):
        return made
    return make(*(x if x.is_number else Whole(x) for x in operands))


def _is_torn(made: sp.Expr, operands: tuple[sp.Expr, ...]) -> bool:
    """Return whether a result has extreme numbers, or separate high powers, that its operands do not have."""
    far = {x for x in made.atoms(sp.Number) if _is_far(x)}
    if far and not far <= set().union(*(x.atoms(sp.Number) for x in operands)):
        return True
    return made.is_Mul and not any(x.is_Mul and _powers(x) for x in operands) and _powers(made) > 1


def _powers(product: sp.Mul) -> int:
    """Return how many factors of a product are high powers."""
    exponents = [x.exp for x in product.args if x.is_Pow]
    return sum(bool(e.is_Number and abs(e) > _HIGH) for e in exponents)


def _is_far(number: sp.Number) -> bool:
    """Return whether a number is more than _FAR decades from 1."""
    size = abs(number)
    return bool(size.is_finite and size != 0 and not sp.Float(f"1e-{_FAR}") < size < sp.Float(f"1e{_FAR}"))

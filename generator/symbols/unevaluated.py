"""Products that are not expanded: SymPy would print (0.01 x)^161 as 1e-322 x^161, outside the range of C numbers.

An operation is checked after SymPy has performed it. The check fails if the result has a number far from 1 that no
operand has, or powers that each may leave binary64 while their product does not. The operands then become
`Unevaluated`s, which SymPy cannot expand.
"""

from __future__ import annotations

from collections.abc import Callable

import sympy as sp

_MAX_DECADES = 60  # decades from 1 within which numbers that SymPy computes are accepted
_MAX_POWER = 16  # largest exponent of a product that is expanded into powers of its factors


class Unevaluated(sp.Function):
    """Unevaluated(x): x as one unevaluated factor or base of a power."""

    nargs = 1

    @classmethod
    def eval(cls, x: sp.Expr) -> sp.Expr | None:
        """Return x itself if it is an atom or unevaluated already; else None, which keeps it unevaluated.

        Called by SymPy.
        """
        return x if x.is_Atom or isinstance(x, Unevaluated) else None

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


class UnevaluatedQuotient(Unevaluated):
    """The quotient v′/v, whose derivative stays together too: SymPy would form v², which may overflow."""


def apply_unexpanded(operation: Callable[..., sp.Expr], *operands: sp.Expr) -> sp.Expr:
    """Return `operation(*operands)`, with the operands as `Unevaluated` if SymPy would expand them to extreme numbers.

    Operands that are numbers are never wrapped.
    """
    result = operation(*operands)
    if all(operand.is_number for operand in operands) or not _has_new_extreme_numbers(result, operands):
        return result
    return operation(*(operand if operand.is_number else Unevaluated(operand) for operand in operands))


def _has_new_extreme_numbers(result: sp.Expr, operands: tuple[sp.Expr, ...]) -> bool:
    """Return whether a result contains extreme numbers that no operand has, or is a product of several high powers.

    Extreme numbers are beyond `_MAX_DECADES` decades from 1. The product counts only if no operand is a product with a
    high power.
    """
    extreme_numbers = {part for part in result.atoms(sp.Number) if _is_extreme_number(part)}
    if extreme_numbers and not extreme_numbers <= set().union(*(part.atoms(sp.Number) for part in operands)):
        return True
    return (
        result.is_Mul
        and not any(part.is_Mul and _count_high_powers(part) for part in operands)
        and _count_high_powers(result) > 1
    )


def _count_high_powers(product: sp.Mul) -> int:
    """Return the number of factors of a product that are powers with an exponent of magnitude above `_MAX_POWER`."""
    exponents = [factor.exp for factor in product.args if factor.is_Pow]
    return sum(bool(exponent.is_Number and abs(exponent) > _MAX_POWER) for exponent in exponents)


def _is_extreme_number(x: sp.Number) -> bool:
    """Return whether a number is finite, not zero, and at least `_MAX_DECADES` decades larger or smaller than 1."""
    magnitude = abs(x)
    return bool(
        magnitude.is_finite
        and magnitude != 0
        and not sp.Float(f"1e-{_MAX_DECADES}") < magnitude < sp.Float(f"1e{_MAX_DECADES}")
    )

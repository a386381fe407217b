"""Makes SymPy's code printers faster: caches the method that prints a class, and the order of the terms of a sum.

The printed text is the same as SymPy's.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import sympy as sp
from sympy.core.exprtools import decompose_power
from sympy.core.function import AppliedUndef
from sympy.printing.precedence import PRECEDENCE, precedence

from gudgeon.generator.symbols.from_expressions import CLASSES

Method = Callable[..., str]


class CachedPrinter:
    """Provide cached versions of methods of SymPy's code printers; a base class before one of these."""

    def doprint(self, expr: sp.Expr) -> str:
        """Return one expression as code, without a statement. Raises ValueError if the language has no counterpart."""
        return self._print(sp.sympify(expr))

    def _print(self, expr: Any, **settings: Any) -> str:
        """Print an expression by the method of its class, which is cached."""
        key = (type(self), type(expr))
        if (method := _METHODS.get(key)) is None:
            method = _METHODS[key] = _find_method(*key)
        return method(self, expr, **settings)

    def _print_not_supported(self, expr: sp.Expr) -> str:
        """Raise ValueError for an expression that the language does not have."""
        raise ValueError(f"{type(self).__name__} does not know {expr}")

    def _print_Add(self, expr: sp.Add, order: str | None = None) -> str:
        """Print the sum of terms in SymPy's order."""
        text = ""
        for term in order_terms(expr):
            own = self._print(term)
            minus = own.startswith("-") and not term.is_Add
            own = own[1:] if minus else own
            if term.is_Add or not (term.is_Mul or term.is_Symbol or term.is_Pow) and _precedence(term) < _SUM:
                own = f"({own})"
            text += f" {'-' if minus else '+'} {own}" if text else f"-{own}" if minus else own
        return text

    def _print_Mul(self, expr: sp.Mul) -> str:
        """Print a product; divisors come last, in brackets if there are several."""
        number, rest = expr.as_coeff_Mul()
        factors = list(rest.as_ordered_factors())
        negative = number.is_extended_negative
        if (size := -number if negative else number) is not sp.S.One:
            factors.insert(0, size)
        above, below = list[sp.Expr](), list[sp.Expr]()
        bracketed = set[sp.Expr]()
        for factor in factors:
            if not (factor.is_Pow and factor.exp.is_Rational and factor.exp.is_negative):
                above.append(factor)
                continue
            below.append(sp.Pow(factor.base, -factor.exp, evaluate=factor.exp is sp.S.NegativeOne))
            if factor.exp is sp.S.NegativeOne and factor.base.is_Mul:
                bracketed.add(factor.base)
        binds = _precedence(expr)
        alone = _UNARY_MINUS if negative and len(above) == 1 else binds
        text = "*".join([self.parenthesize(factor, alone) for factor in above or [sp.S.One]])
        text = f"-{text}" if negative else text
        if not below:
            return text
        divisors = [self.parenthesize(factor, binds) for factor in below]
        divisors = [f"({own})" if factor in bracketed else own for own, factor in zip(divisors, below, strict=True)]
        return f"{text}/{divisors[0]}" if len(below) == 1 else f"{text}/({'*'.join(divisors)})"

    def parenthesize(self, item: sp.Expr, level: float, strict: bool = False) -> str:
        """Print an expression, in brackets if its operator binds less than `level`."""
        binds = _precedence(item)
        return f"({self._print(item)})" if binds < level or (not strict and binds <= level) else self._print(item)


_precedence = lru_cache(100_000)(precedence)
_SUM = PRECEDENCE["Add"]
_UNARY_MINUS = (PRECEDENCE["Pow"] + PRECEDENCE["Mul"]) / 2
_METHODS: dict[tuple[type, type], Method] = {}  # of printers, by the class that is printed


def _find_method(printer: type, kind: type) -> Method:
    """Return the printer's method for a class, found as SymPy does; functions match by their own name only."""
    if kind in CLASSES and (of_table := getattr(printer, "_print_of_table", None)):
        return of_table
    classes = kind.__mro__
    if sp.Function in classes:
        first = classes.index(sp.Function)
        named = [c for c in classes[:first] if c.__name__ == kind.__name__ or c.__name__.endswith("Base")]
        classes = (*named, *classes[first:])
    if issubclass(kind, AppliedUndef):
        classes = classes[classes.index(AppliedUndef) :]
    for each in classes:
        if method := getattr(printer, f"_print_{each.__name__}", None):
            return method
    raise ValueError(f"{printer.__name__} does not know {kind.__name__}")


@lru_cache(20_000)
def order_terms(total: sp.Expr) -> tuple[sp.Expr, ...]:
    """Return the terms of a sum in SymPy's printing order: by the powers of their factors, higher ones first."""
    terms = total.args
    if not total.is_Add or any(
        isinstance(term, (sp.Number, sp.NumberSymbol)) or not term.is_commutative for term in terms
    ):
        return tuple(total.as_ordered_terms())
    parts = {term: _powers(term) for term in terms}
    bases = sorted({base for powers, _ in parts.values() for base in powers}, key=sp.default_sort_key)

    def key(term: sp.Expr) -> tuple[list[int], bool, float, float]:
        """Return the sort key of a term."""
        powers, number = parts[term]
        return [-powers.get(base, 0) for base in bases], bool(number.imag), number.imag, number.real

    return tuple(sorted(terms, key=key))


def _powers(term: sp.Expr) -> tuple[dict[sp.Expr, int], complex]:
    """Return the whole powers of a term's factors by base, and its numerical coefficient."""
    number, rest = term.as_coeff_Mul()
    size = complex(float(number)) if number.is_Rational or number.is_Float else complex(number)
    powers = {}
    for factor in sp.Mul.make_args(rest):
        if factor.is_Symbol:
            powers[factor] = 1
        elif factor.is_number:
            size *= complex(factor)
        else:
            base, power = decompose_power(factor)
            powers[base] = power
    return powers, size

"""Speeds up SymPy's code printers: caches the print method of each class, and the order of the terms of a sum.

The printed text is the same as SymPy's.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from functools import lru_cache
from operator import attrgetter
from typing import Any

import sympy as sp
from sympy.core.exprtools import decompose_power
from sympy.core.function import AppliedUndef
from sympy.printing.precedence import PRECEDENCE, precedence

from gudgeon.generator.symbols.from_expressions import CLASSES
from gudgeon.generator.symbols.storage import StoredSymbol

Method = Callable[..., str]


class CachedPrinter:
    """Provide cached versions of methods of SymPy's code printers; a base class before one of these."""

    def doprint(self, expr: sp.Expr) -> str:
        """Return an expression as code. Raises ValueError if the language has no counterpart."""
        return self._print(sp.sympify(expr))

    def _print(self, expr: Any, **settings: Any) -> str:
        """Print an expression by the printer's method for its class, which is cached by both classes.

        `settings` are passed on to the method. Raises ValueError if the printer has no method for the class.
        """
        key = (type(self), type(expr))
        if (method := _METHODS.get(key)) is None:
            method = _METHODS[key] = _find_method(*key)
        return method(self, expr, **settings)

    def _print_not_supported(self, expr: sp.Expr) -> str:
        """Raise ValueError for an expression that the language does not have."""
        raise ValueError(f"{type(self).__name__} does not know {expr}")

    def _print_Add(self, expr: sp.Add, order: str | None = None) -> str:
        """Print a sum in the order of `order_terms`; a term that begins with a minus is subtracted.

        Terms whose precedence is lower than that of a sum get brackets. `order`: an argument of SymPy, not used.
        """
        text = ""
        for term in order_terms(expr):
            printed = self._print(term)
            is_negative = printed.startswith("-") and not term.is_Add
            printed = printed[1:] if is_negative else printed
            if term.is_Add or not (term.is_Mul or term.is_Symbol or term.is_Pow) and _precedence(term) < _SUM:
                printed = f"({printed})"
            text += f" {'-' if is_negative else '+'} {printed}" if text else f"-{printed}" if is_negative else printed
        return text

    def _print_Mul(self, expr: sp.Mul) -> str:
        """Print a product as a quotient such as -2*x/(y*z), with brackets around several divisors.

        Factors with a negative rational exponent are divisors. A negative coefficient gives a leading minus; without
        other factors the numerator is 1.
        """
        if text := self.print_symbol_product(expr):
            return text
        coefficient, others = expr.as_coeff_Mul()
        factors = order_factors(others)
        negative = coefficient.is_extended_negative
        if (size := -coefficient if negative else coefficient) is not sp.S.One:
            factors.insert(0, size)
        numerator, denominator = list[sp.Expr](), list[sp.Expr]()
        bracketed = set[sp.Expr]()
        for factor in factors:
            if not (factor.is_Pow and factor.exp.is_Rational and factor.exp.is_negative):
                numerator.append(factor)
                continue
            denominator.append(sp.Pow(factor.base, -factor.exp, evaluate=factor.exp is sp.S.NegativeOne))
            if factor.exp is sp.S.NegativeOne and factor.base.is_Mul:
                bracketed.add(factor.base)
        level = _precedence(expr)
        numerator_level = _UNARY_MINUS if negative and len(numerator) == 1 else level
        text = "*".join([self.parenthesize(factor, numerator_level) for factor in numerator or [sp.S.One]])
        text = f"-{text}" if negative else text
        if not denominator:
            return text
        divisors = [self.parenthesize(factor, level) for factor in denominator]
        divisors = [
            f"({printed})" if factor in bracketed else printed
            for printed, factor in zip(divisors, denominator, strict=True)
        ]
        return f"{text}/{divisors[0]}" if len(denominator) == 1 else f"{text}/({'*'.join(divisors)})"

    def print_symbol_product(self, expr: sp.Mul) -> str:
        """Print a product of symbols in the order of their names, or its negative; return "" for other products."""
        is_negative = expr.args[0] is sp.S.NegativeOne
        factors = expr.args[1:] if is_negative else expr.args
        if not _are_plain_symbols(factors):
            return ""
        text = "*".join([self._print(factor) for factor in sorted(factors, key=_get_symbol_name)])
        return f"-{text}" if is_negative else text

    def parenthesize(self, item: sp.Expr, level: float, strict: bool = False) -> str:
        """Print an expression, in brackets if its precedence is lower than `level`, or equal unless `strict`."""
        item_level = _precedence(item)
        needs_brackets = item_level < level or (not strict and item_level <= level)
        return f"({self._print(item)})" if needs_brackets else self._print(item)


_ORDERED_BY_NAME = (sp.Symbol, StoredSymbol)
_get_symbol_name = attrgetter("name")
_LAST_NAME = "\U0010ffff"  # is sorted after all names of symbols
_precedence = lru_cache(1_000_000)(precedence)
_SUM = PRECEDENCE["Add"]
_UNARY_MINUS = (PRECEDENCE["Pow"] + PRECEDENCE["Mul"]) / 2
_METHODS: dict[tuple[type, type], Method] = {}  # (class of printer, class of expression) -> print method


def _find_method(printer: type, expression_class: type) -> Method:
    """Return the method `_print_<class>` of a printer for a class of expressions or the nearest of its bases.

    Functions of the table of functions are printed by `_print_table_function`, if the printer has it. Bases of other
    functions below sp.Function are skipped, as in SymPy. Raises ValueError if there is no method.
    """
    if expression_class in CLASSES and (table_method := getattr(printer, "_print_table_function", None)):
        return table_method
    classes = expression_class.__mro__
    if sp.Function in classes:
        first = classes.index(sp.Function)
        named = [c for c in classes[:first] if c.__name__ == expression_class.__name__ or c.__name__.endswith("Base")]
        classes = (*named, *classes[first:])
    if issubclass(expression_class, AppliedUndef):
        classes = classes[classes.index(AppliedUndef) :]
    for candidate in classes:
        if method := getattr(printer, f"_print_{candidate.__name__}", None):
            return method
    raise ValueError(f"{printer.__name__} does not know {expression_class.__name__}")


@lru_cache(200_000)
def order_terms(expr: sp.Expr) -> tuple[sp.Expr, ...]:
    """Return the terms of a sum in SymPy's printing order: lexicographic by the powers of their factors, high to low.

    A sum of products of symbols only is ordered by the names of its factors, which gives the same order faster. SymPy
    itself orders sums with numbers. An expression that is not a sum is its only term. Results are cached.
    """
    terms = expr.args
    if expr.is_Add and (names := list(map(_find_factor_names, terms))) and all(names):
        order = sorted(range(len(terms)), key=names.__getitem__)
        return tuple(terms[k] for k in order)
    if not expr.is_Add or any(
        isinstance(term, (sp.Number, sp.NumberSymbol)) or not term.is_commutative for term in terms
    ):
        return tuple(expr.as_ordered_terms())
    powers_and_number = {term: _split_powers(term) for term in terms}
    bases = _sort_expressions({base for powers, _ in powers_and_number.values() for base in powers})

    def get_sort_key(term: sp.Expr) -> tuple[list[int], bool, float, float]:
        """Return the sort key of a term: powers of all bases, high to low, then its coefficient."""
        powers, number = powers_and_number[term]
        return [-powers.get(base, 0) for base in bases], bool(number.imag), number.imag, number.real

    return tuple(sorted(terms, key=get_sort_key))


def _find_factor_names(term: sp.Expr) -> tuple[str, ...]:
    """Return the sorted names of the factors of a product of symbols or of its negative; () for other terms.

    _LAST_NAME follows, so that x*y is ordered before x.
    """
    if type(term) in _ORDERED_BY_NAME:
        return (term.name, _LAST_NAME)
    if not term.is_Mul:
        return ()
    factors = term.args[1:] if term.args[0] is sp.S.NegativeOne else term.args
    return (*sorted(map(_get_symbol_name, factors)), _LAST_NAME) if _are_plain_symbols(factors) else ()


def order_factors(expr: sp.Expr) -> list[sp.Expr]:
    """Return the factors of a product in SymPy's printing order, in a new list.

    Symbols and their numerical powers are ordered by name, a single sum after them. SymPy orders products with other
    factors, and expressions that are not products.
    """
    if not expr.is_Mul:
        return list(expr.as_ordered_factors())
    powers, others = list[sp.Expr](), list[sp.Expr]()
    for factor in expr.args:
        base = factor.base if factor.is_Pow and factor.exp.is_Number else factor
        (powers if type(base) in _ORDERED_BY_NAME else others).append(factor)
    if not others or (len(others) == 1 and others[0].is_Add):
        return [*sorted(powers, key=_get_base_name), *others]
    return list(expr.as_ordered_factors())


def _get_base_name(factor: sp.Expr) -> str:
    """Return the name of a symbol, or of the symbol that is the base of a power."""
    name: str = (factor.base if factor.is_Pow else factor).name
    return name


def _sort_expressions(expressions: Collection[sp.Expr]) -> list[sp.Expr]:
    """Return expressions in SymPy's order, which for symbols is the order of their names."""
    return sorted(expressions, key=_get_symbol_name if _are_plain_symbols(expressions) else sp.default_sort_key)


def _are_plain_symbols(expressions: Iterable[sp.Expr]) -> bool:
    """Return whether all expressions are symbols that SymPy orders by their names."""
    return all(type(expression) in _ORDERED_BY_NAME for expression in expressions)


def _split_powers(term: sp.Expr) -> tuple[dict[sp.Expr, int], complex]:
    """Return ({base: integer power} of a term's factors, numerical coefficient as a complex number).

    Example: 3*x**2*y gives ({x: 2, y: 1}, 3). A power that is not an integer stays part of the base.
    """
    coefficient, others = term.as_coeff_Mul()
    value = complex(float(coefficient)) if coefficient.is_Rational or coefficient.is_Float else complex(coefficient)
    powers = {}
    for factor in sp.Mul.make_args(others):
        if factor.is_Symbol:
            powers[factor] = 1
        elif factor.is_number:
            value *= complex(factor)
        else:
            base, power = decompose_power(factor)
            powers[base] = power
    return powers, value

"""Forward-mode automatic differentiation: expressions by the chain rule, through intermediate variables.

A derived symbol has a tangent, the non-zero derivatives by the base symbols (coordinates, velocities, time, or other
variables by which a kernel is differentiated). It follows from the symbol's rules, else from its definition. Tangents
that are more than a symbol become locals of the kernel, so that nothing is computed twice.
A. Griewank, A. Walther, Evaluating Derivatives, SIAM (2008), chapter 3.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import sympy as sp

from gudgeon.generator.ir.finite_slopes import (
    differentiate_with_quotients,
    find_overflowing_terms,
    has_root_of_squares,
    make_finite_slope,
    make_slope_or_zero,
)
from gudgeon.generator.ir.kernels import KernelBuilder
from gudgeon.generator.ir.reciprocals import find_base_name, is_division
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.symbols.derivatives import find_operation_classes, find_symbols
from gudgeon.generator.symbols.symbol_sums import is_signed_symbol
from gudgeon.generator.symbols.symbols import Symbols

Tangent = Mapping[sp.Symbol, sp.Expr]  # base symbol -> derivative by it; absent: zero

ZERO, ONE = sp.Integer(0), sp.Integer(1)
# Added to √x in its derivative: where x vanishes so does dx here, and 0/0 is meant to be 0.
TINY = sp.Float(1e-150)


class Tangents:
    """Tangents of symbols in one kernel; branches are those of the switches of `owner` (symbols/switches.py).

    `share_powers`: x^n with n ≥ 1, as in contact laws, is written as x · x^(n−1), which its derivative needs too.
    """

    def __init__(
        self,
        symbols: Symbols,
        builder: KernelBuilder,
        bases: Iterable[sp.Symbol],
        owner: str = "",
        share_powers: bool = False,
    ) -> None:
        """Begin with the base symbols, each with the derivative 1 by itself.

        Locals that the tangents need are appended to `builder`. `owner`: whose switches fix the branches; "" is the
        scene.
        """
        self._symbols, self._builder, self._owner, self._share_powers = symbols, builder, owner, share_powers
        self._branches: dict[sp.Symbol, sp.Expr] = {}
        self._symbol_map: Mapping[sp.Symbol, sp.Symbol] = {}
        self._powers: dict[sp.Expr, sp.Symbol] = {}
        self._known: dict[sp.Symbol, Tangent] = {base: {base: ONE} for base in bases}

    def make_tangents_for_variables(self, symbol_map: Mapping[sp.Symbol, sp.Symbol]) -> Tangents:
        """Return tangents in the same kernel for expressions that use other symbols for the variables.

        Such expressions are those of a law. `symbol_map` maps each of their symbols to its symbol in this kernel; these
        are the new base symbols. Branches and shared powers are common to both objects.
        """
        tangents = Tangents(self._symbols, self._builder, symbol_map.values(), self._owner, self._share_powers)
        tangents._branches, tangents._powers, tangents._symbol_map = self._branches, self._powers, symbol_map
        return tangents

    def store_tangent(self, symbol: sp.Symbol, tangent: Tangent) -> None:
        """Store the tangent of a symbol that the kernel computes without a definition: its derivatives by base symbol.

        Entries that are more than a number or ± a symbol become locals of the kernel.
        """
        self._known[symbol] = {base: self._store_derivative(symbol, base, value) for base, value in tangent.items()}

    def get_tangent(self, symbol: sp.Symbol) -> Tangent:
        """Return the tangent of a symbol, its non-zero derivatives by base symbol; empty for a constant.

        It is computed once, from the symbol's rules or else its definition, and stored. Its longer entries become
        locals of the kernel at the first call.
        """
        if symbol not in self._known:
            self._known[symbol] = {}  # a parameter, or a multiplier that is held constant
            if symbol in self._symbols.derivative_rules:
                self.store_tangent(symbol, self.apply_chain_rule(self._symbols.derivative_rules[symbol]))
            elif symbol in self._symbols.definitions and not self._symbols.info[symbol].storage_location:
                self.store_tangent(symbol, self.compute_gradient(self._symbols.definitions[symbol], symbol))
        return self._known[symbol]

    def apply_chain_rule(self, tangent: Tangent) -> Tangent:
        """Return the derivatives of a value by base symbol, from its derivatives `tangent` by other symbols."""
        return self.sum_tangents((factor, self.get_tangent(symbol)) for symbol, factor in tangent.items())

    def freeze_branches(self, expression: sp.Expr) -> sp.Expr:
        """Return the expression with min, max, abs, sign and similar functions on their active branches.

        Each branch is a symbol; at its first use a statement that assigns it is appended to the kernel. The variables
        of `make_tangents_for_variables` are replaced by those of the kernel.
        """
        n_known = len(self._branches)
        fixed = self._symbols.switches.freeze_branches(expression, self._owner, self._branches)
        for branch, value in list(self._branches.items())[n_known:]:
            self._builder.append_instruction(Statement(branch.name, value.xreplace(self._symbol_map)))
        return fixed.xreplace(self._symbol_map)

    def compute_gradient(self, expression: sp.Expr, value_symbol: sp.Symbol | None = None) -> Tangent:
        """Return the non-zero derivatives of an expression by base symbol, with branches fixed.

        `value_symbol`: a symbol that holds the value of the expression. A square root √x then has the derivative x′/(2
        (value + TINY)), which is finite at 0. Branches and tangents that are read for the first time are appended to
        the kernel.
        """
        fixed = self.freeze_branches(expression)
        order = sorted(fixed.free_symbols, key=lambda s: s.name)
        if value_symbol is not None and fixed.is_Pow and fixed.exp == sp.Rational(1, 2):
            scale = sp.Rational(1, 2) / (value_symbol + TINY)
            return self.sum_tangents(
                (compute_partial_derivative(fixed.base, s) * scale, self.get_tangent(s)) for s in order
            )
        return self.sum_tangents(
            (compute_partial_derivative(fixed, s), self.get_tangent(s)) for s in order if self.get_tangent(s)
        )

    def sum_tangents(self, factors_and_tangents: Iterable[tuple[sp.Expr, Tangent]]) -> Tangent:
        """Return Σ factor · tangent of pairs (factor, tangent), by base symbol; sums that vanish are left out."""
        terms: dict[sp.Symbol, list[sp.Expr]] = {}
        for factor, tangent in factors_and_tangents:
            for base, value in tangent.items():
                terms.setdefault(base, []).append(factor * value)
        sums = {base: sp.Add(*values) for base, values in terms.items()}
        return {base: value for base, value in sums.items() if value != 0}

    def _store_derivative(self, symbol: sp.Symbol, base: sp.Symbol, value: sp.Expr) -> sp.Expr:
        """Return the derivative `value` of a symbol by a base symbol, as a new local unless it is a number or ±symbol.

        The local is called `<symbol>_by_<base>`; denominators in it become locals too (`store_powers`).
        """
        if value.is_Number or is_signed_symbol(value):
            return value
        return self._builder.append_local(f"{symbol.name}_by_{base.name}", self.store_powers(value))

    def store_powers(self, value: sp.Expr) -> sp.Expr:
        """Return the value with its denominators stored as locals that derivatives reuse.

        With `share_powers` its powers become locals too. A value without powers is returned unchanged.
        """
        if sp.Pow not in find_operation_classes(value):
            return value
        divided = value.replace(is_division, lambda part: self._store_power("inverse", 1 / part.base) ** -part.exp)
        if not self._share_powers:
            return divided
        return divided.replace(lambda part: part.is_Pow and bool(part.exp.free_symbols), self._split_power)

    def _split_power(self, power: sp.Pow) -> sp.Expr:
        """Return the power x^n, whose exponent contains symbols, as x · x^(n−1), with the second factor as a local.

        The power and its derivative n x^(n−1) then share that factor. A power whose exponent has the constant term −1
        becomes a local as it is: it is such a factor already.
        """
        if power.exp.as_coeff_Add()[0] == -1:
            return self._store_power("power", power)
        return power.base * self._store_power("power", power.base ** (power.exp - 1))

    def _store_power(self, prefix: str, value: sp.Expr) -> sp.Symbol:
        """Return the local that stores a power or reciprocal, created at its first use.

        Its name is `prefix` and the name of the power's base, or "sum" if the base is not a symbol.
        """
        if value not in self._powers:
            self._powers[value] = self._builder.append_local(f"{prefix}_{find_base_name(value)}", value)
        return self._powers[value]


def compute_partial_derivative(expression: sp.Expr, symbol: sp.Symbol) -> sp.Expr:
    """Return ∂/∂symbol of a smooth expression; x^n gives n x^(n−1), not n x^n/x, which is 0/0 at 0.

    Sums are differentiated term by term, and a product that is linear in `symbol` gives its other factors. Terms that
    may overflow get a `Slope` with a difference quotient. A root of a sum of squares gets derivative 0 where it is 0/0.
    """
    if expression.is_Add:
        return sp.Add(
            *(compute_partial_derivative(term, symbol) for term in expression.args if symbol in find_symbols(term))
        )
    if expression.is_Mul and symbol in expression.args:  # most terms are linear: SymPy's own way is slower
        other_factors = [factor for factor in expression.args if factor != symbol]
        if not any(symbol in find_symbols(factor) for factor in other_factors):
            return sp.Mul(*other_factors)
    terms = {term: sp.Dummy(real=True) for term in find_overflowing_terms(expression, symbol)}
    if terms and expression not in terms:
        renamed, terms_by_dummy = expression.xreplace(terms), {dummy: term for term, dummy in terms.items()}
        inner_terms = (
            differentiate_with_quotients(renamed, dummy) * compute_partial_derivative(term, symbol)
            for term, dummy in terms.items()
        )
        return sp.Add(compute_partial_derivative(renamed, symbol), *inner_terms).xreplace(terms_by_dummy)
    derivative = differentiate_with_quotients(expression, symbol)
    if terms:
        return make_finite_slope(expression, symbol, derivative)
    return make_slope_or_zero(derivative) if has_root_of_squares(expression, symbol) else derivative

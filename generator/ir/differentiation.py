"""Forward differentiation: d expression / d base, through the derived symbols of a model.

A derived symbol has a tangent, the non-zero derivatives by the base symbols (coordinates, velocities, time, or other
variables by which a kernel is differentiated). It follows from the symbol's rules, else from its definition. Tangents
that are more than a symbol become locals of the kernel, so that nothing is computed twice.
A. Griewank, A. Walther, Evaluating Derivatives, SIAM (2008), chapter 3.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import sympy as sp

from gudgeon.generator.ir.finite_slopes import finite_slope, flat_at_zero, has_distance, overflowing, written
from gudgeon.generator.ir.kernels import KernelBuilder
from gudgeon.generator.ir.reciprocals import base_name, is_division
from gudgeon.generator.ir.statements import Statement
from gudgeon.generator.symbols.derivatives import symbols_of
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
        build: KernelBuilder,
        bases: Iterable[sp.Symbol],
        owner: str = "",
        share_powers: bool = False,
    ) -> None:
        """Begin with the base symbols, each with derivative 1 by itself."""
        self._symbols, self._build, self._owner, self._share_powers = symbols, build, owner, share_powers
        self._sides: dict[sp.Symbol, sp.Expr] = {}
        self._renamed: Mapping[sp.Symbol, sp.Symbol] = {}
        self._powers: dict[sp.Expr, sp.Symbol] = {}
        self._known: dict[sp.Symbol, Tangent] = {base: {base: ONE} for base in bases}

    def inside(self, renamed: Mapping[sp.Symbol, sp.Symbol]) -> Tangents:
        """Return tangents in the same kernel for expressions in other variables.

        renamed: the symbols of these variables here.
        """
        inner = Tangents(self._symbols, self._build, renamed.values(), self._owner, self._share_powers)
        inner._sides, inner._powers, inner._renamed = self._sides, self._powers, renamed
        return inner

    def know(self, symbol: sp.Symbol, tangent: Tangent) -> None:
        """Set the tangent of a symbol that C computes in its own way; longer entries become locals."""
        self._known[symbol] = {base: self._named(symbol, base, value) for base, value in tangent.items()}

    def of(self, symbol: sp.Symbol) -> Tangent:
        """Return the tangent of a symbol; empty for a constant."""
        if symbol not in self._known:
            self._known[symbol] = {}  # a parameter, or a multiplier that is held constant
            if symbol in self._symbols.rules:
                self.know(symbol, self.through(self._symbols.rules[symbol]))
            elif symbol in self._symbols.definitions and not self._symbols.info[symbol].home:
                self.know(symbol, self.gradient(self._symbols.definitions[symbol], symbol))
        return self._known[symbol]

    def through(self, tangent: Tangent) -> Tangent:
        """Return a tangent by other symbols as a tangent by the bases (chain rule)."""
        return self.sum((factor, self.of(symbol)) for symbol, factor in tangent.items())

    def held(self, expression: sp.Expr) -> sp.Expr:
        """Return the expression with branches taken from the switches, whose functions are printed."""
        before = len(self._sides)
        held = self._symbols.switches.hold(expression, self._owner, self._sides)
        for side, value in list(self._sides.items())[before:]:
            self._build.line(Statement(side.name, value.xreplace(self._renamed)))
        return held.xreplace(self._renamed)

    def gradient(self, expression: sp.Expr, known_as: sp.Symbol | None = None) -> Tangent:
        """Return the non-zero derivatives of an expression by base; `known_as`: a symbol of its value."""
        held = self.held(expression)
        order = sorted(held.free_symbols, key=lambda s: s.name)
        if known_as is not None and held.is_Pow and held.exp == sp.Rational(1, 2):
            scale = sp.Rational(1, 2) / (known_as + TINY)
            return self.sum((partial(held.base, s) * scale, self.of(s)) for s in order)
        return self.sum((partial(held, s), self.of(s)) for s in order if self.of(s))

    def sum(self, parts: Iterable[tuple[sp.Expr, Tangent]]) -> Tangent:
        """Return Σ factor · tangent."""
        terms: dict[sp.Symbol, list[sp.Expr]] = {}
        for factor, tangent in parts:
            for base, value in tangent.items():
                terms.setdefault(base, []).append(factor * value)
        sums = {base: sp.Add(*values) for base, values in terms.items()}
        return {base: value for base, value in sums.items() if value != 0}

    def _named(self, symbol: sp.Symbol, base: sp.Symbol, value: sp.Expr) -> sp.Expr:
        """Return a derivative as it is if it is simple, else as a local of the kernel."""
        if value.is_Number or value.is_Symbol or (-value).is_Symbol:
            return value
        return self._build.local(f"{symbol.name}_by_{base.name}", self.shared(value))

    def shared(self, value: sp.Expr) -> sp.Expr:
        """Return the value with denominators and powers as locals that its derivatives share."""
        if not value.has(sp.Pow):
            return value
        divided = value.replace(is_division, lambda part: self._local("inverse", 1 / part.base) ** -part.exp)
        if not self._share_powers:
            return divided
        return divided.replace(lambda part: part.is_Pow and bool(part.exp.free_symbols), self._power)

    def _power(self, power: sp.Pow) -> sp.Expr:
        """Return x^n as x · x^(n−1), with the power as a local."""
        if power.exp.as_coeff_Add()[0] == -1:
            return self._local("power", power)
        return power.base * self._local("power", power.base ** (power.exp - 1))

    def _local(self, what: str, value: sp.Expr) -> sp.Symbol:
        """Return the local that holds a power, named after its base if that is a symbol."""
        if value not in self._powers:
            self._powers[value] = self._build.local(f"{what}_{base_name(value)}", value)
        return self._powers[value]


def partial(expression: sp.Expr, by: sp.Symbol) -> sp.Expr:
    """Return ∂/∂by of smooth pieces; x^n gives n x^(n−1), not n x^n/x, which is 0/0 at 0."""
    if expression.is_Add:
        return sp.Add(*(partial(term, by) for term in expression.args if by in symbols_of(term)))
    if expression.is_Mul and by in expression.args:  # most terms are linear: SymPy's own way is slower
        rest = [factor for factor in expression.args if factor != by]
        if not any(by in symbols_of(factor) for factor in rest):
            return sp.Mul(*rest)
    terms = {term: sp.Dummy(real=True) for term in overflowing(expression, by)}
    if terms and expression not in terms:
        named, back = expression.xreplace(terms), {dummy: term for term, dummy in terms.items()}
        inner = (written(named, dummy) * partial(term, by) for term, dummy in terms.items())
        return sp.Add(partial(named, by), *inner).xreplace(back)
    derivative = written(expression, by)
    if terms:
        return finite_slope(expression, by, derivative)
    return flat_at_zero(derivative) if has_distance(expression, by) else derivative

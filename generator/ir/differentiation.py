"""Forward differentiation: d expression / d base, through the derived symbols of a model.

A derived symbol carries its tangent, the non-zero derivatives by the base symbols (coordinates, velocities,
time, or whatever a kernel is differentiated by). Its rules give it where it has some, else its definition
does. Tangents that are more than a symbol become locals of the kernel, so that nothing is computed twice.

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
    """Tangents in one kernel; corners are sides of the switches of `owner` (switches.py).

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
        self._symbols, self._build, self._owner, self._share_powers = symbols, build, owner, share_powers
        self._sides: dict[sp.Symbol, sp.Expr] = {}
        self._renamed: Mapping[sp.Symbol, sp.Symbol] = {}
        self._powers: dict[sp.Expr, sp.Symbol] = {}
        self._known: dict[sp.Symbol, Tangent] = {base: {base: ONE} for base in bases}

    def inside(self, renamed: Mapping[sp.Symbol, sp.Symbol]) -> Tangents:
        """Tangents in the same kernel of expressions in other variables, by what these are called here."""
        inner = Tangents(self._symbols, self._build, renamed.values(), self._owner, self._share_powers)
        inner._sides, inner._powers, inner._renamed = self._sides, self._powers, renamed
        return inner

    def know(self, symbol: sp.Symbol, tangent: Tangent) -> None:
        """Tells the tangent of a symbol that C computes in its own way; longer entries become locals."""
        self._known[symbol] = {base: self._named(symbol, base, value) for base, value in tangent.items()}

    def of(self, symbol: sp.Symbol) -> Tangent:
        """The tangent of a symbol; empty for a constant."""
        if symbol not in self._known:
            self._known[symbol] = {}  # a number of `prepare`, a held multiplier
            if symbol in self._symbols.rules:
                self.know(symbol, self.through(self._symbols.rules[symbol]))
            elif symbol in self._symbols.definitions and not self._symbols.info[symbol].home:
                self.know(symbol, self.gradient(self._symbols.definitions[symbol], symbol))
        return self._known[symbol]

    def through(self, tangent: Tangent) -> Tangent:
        """A tangent by other symbols, whose own tangents are known here, by the bases."""
        return self.sum((factor, self.of(symbol)) for symbol, factor in tangent.items())

    def held(self, expression: sp.Expr) -> sp.Expr:
        """The expression with its corners as sides, which are told to the kernel."""
        before = len(self._sides)
        held = self._symbols.switches.hold(expression, self._owner, self._sides)
        for side, value in list(self._sides.items())[before:]:
            self._build.line(Statement(side.name, value.xreplace(self._renamed)))
        return held.xreplace(self._renamed)

    def gradient(self, expression: sp.Expr, known_as: sp.Symbol | None = None) -> Tangent:
        """The non-zero derivatives; `known_as` is a symbol that holds the expression's value."""
        held = self.held(expression)
        order = sorted(held.free_symbols, key=lambda s: s.name)
        if known_as is not None and held.is_Pow and held.exp == sp.Rational(1, 2):
            scale = sp.Rational(1, 2) / (known_as + TINY)
            return self.sum((partial(held.base, s) * scale, self.of(s)) for s in order)
        return self.sum((partial(held, s), self.of(s)) for s in order if self.of(s))

    def sum(self, parts: Iterable[tuple[sp.Expr, Tangent]]) -> Tangent:
        """Σ factor · tangent."""
        terms: dict[sp.Symbol, list[sp.Expr]] = {}
        for factor, tangent in parts:
            for base, value in tangent.items():
                terms.setdefault(base, []).append(factor * value)
        sums = {base: sp.Add(*values) for base, values in terms.items()}
        return {base: value for base, value in sums.items() if value != 0}

    def _named(self, symbol: sp.Symbol, base: sp.Symbol, value: sp.Expr) -> sp.Expr:
        if value.is_Number or value.is_Symbol or (-value).is_Symbol:
            return value
        return self._build.local(f"{symbol.name}_by_{base.name}", self.shared(value))

    def shared(self, value: sp.Expr) -> sp.Expr:
        """The value with what a function and its derivatives share as locals: denominators, powers of contact laws."""
        if not value.has(sp.Pow):
            return value
        divided = value.replace(is_division, lambda part: self._local("inverse", 1 / part.base) ** -part.exp)
        if not self._share_powers:
            return divided
        return divided.replace(lambda part: part.is_Pow and bool(part.exp.free_symbols), self._power)

    def _power(self, power: sp.Pow) -> sp.Expr:
        """x^n as x · x^(n−1)."""
        if power.exp.as_coeff_Add()[0] == -1:
            return self._local("power", power)
        return power.base * self._local("power", power.base ** (power.exp - 1))

    def _local(self, what: str, value: sp.Expr) -> sp.Symbol:
        """The local that holds a power; named after its base where that is a symbol."""
        if value not in self._powers:
            self._powers[value] = self._build.local(f"{what}_{base_name(value)}", value)
        return self._powers[value]


def partial(expression: sp.Expr, by: sp.Symbol) -> sp.Expr:
    """∂/∂by of smooth pieces; x^n gives n x^(n−1), not n x^n/x, which is 0/0 at 0."""
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

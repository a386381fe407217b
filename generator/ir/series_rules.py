"""Order k of each operation on Taylor series, from order k of its operands and from sums over lower orders.

A function c = f(u) satisfies a differential equation whose other coefficients are known series: sines have
c' = u' cos u, a power a c' = n a' c, an inverse tangent (1 + u^2) c' = u'. Rates stand in sums as j u_j, so that the
results are k c_k.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.ir.statements import Line
from gudgeon.generator.symbols.from_expressions import CLASSES, derivative_at
from gudgeon.generator.symbols.storage import Place, PlaceSymbol

VALUES, SUMS = "at", "sum"  # arguments: coefficients of order 0, sums S_k
ORDER, SHARE = sp.Symbol("k", real=True), sp.Symbol("share", real=True)  # k, 1/k
NEXT = sp.Symbol("next", real=True)  # 1/(k + 1)
WIDE = 8  # products of a row
_HALF = sp.Rational(1, 2)


class NoSeries(Exception):
    """Raised with the reason, in words, why a function has no Taylor series."""


@dataclass(frozen=True)
class Factor:
    """A local in a sum S_k: its coefficients or, for its rate, each coefficient times its order."""

    name: str
    rate: bool = False


@dataclass(frozen=True)
class Product:
    """A sum S_k = left_1 right_{k-1} + ... + left_{k-1} right_1 by its name."""

    name: str
    left: Factor
    right: Factor


@dataclass(frozen=True)
class Gathered(Line):
    """A line that stores values as one row of an array of vectors, so that readers of the row need not wait."""

    array: str
    row: int
    values: tuple[sp.Expr, ...]

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the values."""
        return self.values


Lowered = tuple[sp.Expr, sp.Expr]  # a value at order 0 and at order k, both by names


class Rules(ABC):
    """Series of expressions of locals; locals in `moving` have orders above 0, `numbers` are parameters of the run."""

    def __init__(self, used: set[str]) -> None:
        """Begin with time as the only moving local; `used`: names in use."""
        self.moving, self.numbers = {"t"}, set[str]()
        self.products: dict[tuple[Factor, Factor], Product] = {}
        self.known: dict[sp.Expr, sp.Symbol] = {}  # expressions that have a name
        self.later: list[tuple[str, sp.Expr]] = []  # to be defined after the current definition
        self.reciprocals: dict[sp.Symbol, sp.Symbol] = {}  # c by what it is 1 over: products with c are quotients
        self.inverses: dict[str, sp.Symbol] = {}  # 1/b_0 by name
        self._taken = used

    @abstractmethod
    def define(self, target: str, value: sp.Expr, moving: bool = False) -> sp.Symbol:
        """Define a local and return its symbol; `moving`: as a series even if it is constant."""

    @abstractmethod
    def beside(self, value: sp.Expr) -> sp.Symbol:
        """Return the symbol of another function of the same argument."""

    def is_fixed(self, value: sp.Basic) -> bool:
        """Return whether a value has only order 0."""
        return not any(s.name in self.moving for s in value.free_symbols)

    def unique(self, name: str) -> str:
        """Return an unused name."""
        k = 1
        while f"{name}_{k}" in self._taken:
            k += 1
        self._taken.add(f"{name}_{k}")
        return f"{name}_{k}"

    def atom(self, value: sp.Expr) -> sp.Symbol:
        """Return a symbol for a value, defined if necessary."""
        if value.is_Symbol:
            return value
        return self.known[value] if value in self.known else self.define(self.unique("part"), value)

    def series(self, value: sp.Expr) -> sp.Symbol:
        """Return a symbol for a value as a series; a constant gets zeros at higher orders."""
        return self.define(self.unique("still"), value, True) if self.is_fixed(value) else self.atom(value)

    def lower(self, value: sp.Expr, whole: sp.Symbol | None = None) -> Lowered:
        """Return a value at orders 0 and k in names of locals; `whole` is its own symbol, which a rule may read."""
        if self.is_fixed(value):
            return value, sp.Integer(0)
        if value.is_Symbol:
            return value, value
        if value.is_Add:
            parts = [self.lower(x) for x in value.args]
            return sp.Add(*(zero for zero, _ in parts)), sp.Add(*(term for _, term in parts))
        if value.is_Mul or (value.is_Pow and value.exp.is_Integer and value.exp >= 2):
            return self._product(value, whole)
        if whole is None:
            symbol = self.atom(value)
            return symbol, symbol
        return self._power(value, whole) if value.is_Pow else self._function(value, whole)

    def _product(self, value: sp.Expr, whole: sp.Symbol | None) -> Lowered:
        """Return a product of a constant and of two names or a quotient of names, at orders 0 and k."""
        fixed = sp.Mul(*(x for x in sp.Mul.make_args(value) if self.is_fixed(x)))
        moving = [x for x in sp.Mul.make_args(value) if not self.is_fixed(x)]
        below = [x for x in moving if x.is_Pow and x.exp.is_number and x.exp.is_negative]
        below += [self.reciprocals[x] ** -1 for x in moving if x in self.reciprocals]
        above = self._parts([x for x in moving if x not in below and x not in self.reciprocals])
        if below and above:
            a, b = self._one(above), self._one(self._parts([1 / x for x in below]))
            if fixed != 1 or whole is None:
                above = [self.atom(a / b)]
            else:
                return a / b, self.quotient(a, b, whole)
        elif below:
            above = [self.atom(1 / self._one(self._parts([1 / x for x in below])))]
        if len(above) == 1:
            zero, term = self.lower(above[0])
            return fixed * zero, self.fixed(fixed) * term
        a, b = above
        summed = self.sum(Factor(a.name), Factor(b.name))
        return fixed * a * b, self.fixed(fixed) * (at(a) * b + at(b) * a + summed)

    def _parts(self, values: list[sp.Expr]) -> list[sp.Symbol]:
        """Return at most two names whose product is that of the values; or one sum as it is."""
        if len(values) == 1 and values[0].is_Add:
            return values
        parts: list[sp.Symbol] = []
        for x in values:
            times = int(x.exp) if x.is_Pow and x.exp.is_Integer and x.exp >= 2 else 1
            if times > 4:
                parts += [self.atom(x.base ** (times // 2))] * 2 + [self.atom(x.base)] * (times % 2)
            else:
                parts += [self.atom(x.base if times > 1 else x)] * times
        while len(parts) > 2:
            parts = [self.atom(parts[0] * parts[1]), *parts[2:]]
        return parts

    def _one(self, parts: list[sp.Symbol]) -> sp.Symbol:
        """Return one name for the product of some names."""
        return self.atom(sp.Mul(*parts))

    def _power(self, value: sp.Expr, whole: sp.Symbol) -> Lowered:
        """Return c = a^n by a c' = n a' c; a root by a = c c; 1/a as a quotient."""
        if not self.is_fixed(value.exp):
            raise NoSeries("a power has an exponent that moves")
        a, n = self.atom(value.base), value.exp
        if n.is_Integer and n < -1:
            a, n = self.atom(value.base**-n), sp.Integer(-1)
        if n == -1:
            self.reciprocals[whole] = a
            return 1 / a, self.quotient(sp.Integer(0), a, whole)
        if n == _HALF:
            summed = self.sum(Factor(whole.name), Factor(whole.name))
            return a**n, (a - summed) * _HALF * self.inverse(whole)
        first = self.sum(Factor(a.name, True), Factor(whole.name))
        second = self.sum(Factor(a.name), Factor(whole.name, True))
        n = self.fixed(n)
        return a**value.exp, (n * a * at(whole) + (n * first - second) * SHARE) * self.inverse(a)

    def _function(self, value: sp.Expr, whole: sp.Symbol) -> Lowered:
        """Return a function of series by its derivative. Raises NoSeries if that is unknown."""
        derivative = CLASSES[type(value)].derivative if type(value) in CLASSES else ""
        if not derivative and not isinstance(value, sp.atan2):
            raise NoSeries(f"{type(value).__name__.lower()}() has corners, or its series is not known")
        u = [self.series(x) for x in value.args]
        term = _by_derivative(self, derivative, u[0], whole) if derivative else _arc(self, u[0], u[1], whole)
        return value.func(*u), term

    def fixed(self, value: sp.Expr) -> sp.Expr:
        """Return a constant as higher orders read it: parameters of the run, and locals of order 0."""
        if value.free_symbols and not (value.is_Symbol or (-value).is_Symbol):
            value = self.atom(value)
        return value.xreplace({s: at(s) for s in value.free_symbols if s.name not in self.numbers})

    def quotient(self, a: sp.Expr, b: sp.Symbol, whole: sp.Symbol) -> sp.Expr:
        """Return order k of c = a/b: a_k = c_0 b_k + c_k b_0 + S_k."""
        return (a - at(whole) * b - self.sum(Factor(whole.name), Factor(b.name))) * self.inverse(b)

    def inverse(self, b: sp.Symbol) -> sp.Expr:
        """Return the stored number 1/b_0."""
        name = f"{b.name}_inverse"
        self.inverses[name] = b
        return PlaceSymbol(Place(VALUES)[name])

    def by_rate(self, u: sp.Symbol, w: sp.Symbol) -> sp.Expr:
        """Return order k of c with c' = u' w."""
        return u * at(w) + self.sum(Factor(u.name, True), Factor(w.name)) * SHARE

    def over(self, u: sp.Expr, w: sp.Symbol, whole: sp.Symbol) -> sp.Expr:
        """Return order k of c with w c' = u'."""
        return (u - self.sum(Factor(w.name), Factor(whole.name, True)) * SHARE) * self.inverse(w)

    def sum(self, left: Factor, right: Factor) -> sp.Symbol:
        """Return the symbol of the sum S_k of a product."""
        pair = (left, right) if (left.name, left.rate) <= (right.name, right.rate) else (right, left)
        words = "__".join(f"{x.name}{'_rate' * x.rate}" for x in pair)
        product = self.products.setdefault(pair, Product(words, *pair))
        return PlaceSymbol(Place(SUMS)[product.name])

    def square(self, whole: sp.Symbol) -> sp.Symbol:
        """Return a symbol for the square of the value that is being defined; it is defined right after."""
        name = self.unique("square")
        self.later.append((name, whole**2))
        return sp.Symbol(name, real=True)


def at(symbol: sp.Symbol) -> sp.Symbol:
    """Return the symbol of order 0 of a local."""
    return PlaceSymbol(Place(VALUES)[symbol.name])


def _arc(rules: Rules, y: sp.Symbol, x: sp.Symbol, whole: sp.Symbol) -> sp.Expr:
    """Return order k of the angle c of (x, y): (x^2 + y^2) c' = x y' - y x'."""
    r = rules.atom(x**2 + y**2)
    one = rules.sum(Factor(x.name), Factor(y.name, True))
    other = rules.sum(Factor(y.name), Factor(x.name, True))
    return rules.over(at(x) * y - at(y) * x + (one - other) * SHARE, r, whole)


def _by_derivative(rules: Rules, derivative: str, u: sp.Symbol, whole: sp.Symbol) -> sp.Expr:
    """Return order k of c = f(u) by its derivative n/w, n a number: w c' = n u'.

    A derivative that is a sum of terms gives c' = u' w for each.
    """
    above, below = sp.fraction(derivative_at(derivative, u, whole))
    if below != 1:
        return rules.over(above * u, below if below.is_Symbol else rules.atom(below), whole)
    terms = []
    for number, w in (term.as_coeff_Mul() for term in sp.Add.make_args(above)):
        if w == whole**2:
            w = rules.square(whole)
        elif w.is_Function:
            w = rules.beside(w)
        elif not w.is_Symbol and w != 1:
            w = rules.atom(w)
        terms.append(number * (u if w == 1 else rules.by_rate(u, w)))
    return sp.Add(*terms)

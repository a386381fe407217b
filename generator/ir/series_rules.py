"""Rules for the Taylor coefficients of order k of each operation, from the coefficients of its operands.

A function c = f(u) satisfies a differential equation whose other coefficients are known series: sines have c' = u' cos
u, a power a c' = n a' c, an inverse tangent (1 + u^2) c' = u'. Rates stand in sums as j u_j, so that the results are k
c_k.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.ir.statements import Instruction
from gudgeon.generator.symbols.from_expressions import CLASSES, convert_derivative
from gudgeon.generator.symbols.storage import StorageLocation, StoredSymbol

VALUES, SUMS = "at", "sum"  # arguments: coefficients of order 0, sums S_k
ORDER, INVERSE_ORDER = sp.Symbol("k", real=True), sp.Symbol("share", real=True)  # k, 1/k
INVERSE_NEXT_ORDER = sp.Symbol("next", real=True)  # 1/(k + 1)
ROW_LENGTH = 8  # products of a row
_HALF = sp.Rational(1, 2)


class NoTaylorSeries(Exception):
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
class StoreRow(Instruction):
    """A line that stores values as one row of an array of vectors, so that readers of the row need not wait."""

    array: str
    row: int
    values: tuple[sp.Expr, ...]

    @property
    def expressions(self) -> tuple[sp.Basic, ...]:
        """Return the values."""
        return self.values


OrderPair = tuple[sp.Expr, sp.Expr]  # a value at order 0 and at order k, both by names


class Rules(ABC):
    """Recurrences of Taylor coefficients of expressions of locals and parameters.

    `varying`: locals with orders above 0; `parameters`: locals that read parameters of the run.
    """

    def __init__(self, used_names: set[str]) -> None:
        """Begin with time as the only local that varies.

        `used_names`: the names in use, to which new names are added.
        """
        self.varying, self.parameters = {"t"}, set[str]()
        self.products: dict[tuple[Factor, Factor], Product] = {}
        self.symbol_by_value: dict[sp.Expr, sp.Symbol] = {}  # expressions that have a name
        self.pending: list[tuple[str, sp.Expr]] = []  # to be defined after the current definition
        self.reciprocals: dict[sp.Symbol, sp.Symbol] = {}  # a by the symbol of c = 1/a
        self.inverses: dict[str, sp.Symbol] = {}  # 1/b_0 by name
        self._used_names = used_names

    @abstractmethod
    def define_local(self, target: str, value: sp.Expr, as_series: bool = False) -> sp.Symbol:
        """Define a local and return its symbol; `as_series`: as a series even if it is constant."""

    @abstractmethod
    def define_auxiliary_function(self, value: sp.Expr) -> sp.Symbol:
        """Return the symbol of an auxiliary function of the same argument, such as cos u for sin u."""

    def is_constant_in_time(self, value: sp.Basic) -> bool:
        """Return whether a value has only order 0: it contains no local that varies with time."""
        return not any(s.name in self.varying for s in value.free_symbols)

    def make_unique_name(self, name: str) -> str:
        """Return an unused name `<name>_<k>`, k = 1, 2, …, and mark it as used."""
        k = 1
        while f"{name}_{k}" in self._used_names:
            k += 1
        self._used_names.add(f"{name}_{k}")
        return f"{name}_{k}"

    def define_value(self, value: sp.Expr) -> sp.Symbol:
        """Return a symbol for a value, which is defined as a local if it has none yet.

        A value that is a symbol is returned unchanged.
        """
        if value.is_Symbol:
            return value
        return (
            self.symbol_by_value[value]
            if value in self.symbol_by_value
            else self.define_local(self.make_unique_name("part"), value)
        )

    def define_series_symbol(self, value: sp.Expr) -> sp.Symbol:
        """Return the symbol of a local that holds a value as a series in time.

        A constant gets a new local, whose coefficients are 0 above order 0.
        """
        return (
            self.define_local(self.make_unique_name("still"), value, True)
            if self.is_constant_in_time(value)
            else self.define_value(value)
        )

    def expand_orders(self, value: sp.Expr, symbol_of_value: sp.Symbol | None = None) -> OrderPair:
        """Return the coefficients of order 0 and of order k of a value, both in names of locals.

        A constant is 0 at order k, a symbol is itself at both, and a sum is expanded term by term. `symbol_of_value`:
        the symbol of the local that is being defined as this value, which a rule may read. If it is None, a function or
        a power other than x^n with an integer n > 1 becomes a new local.
        """
        if self.is_constant_in_time(value):
            return value, sp.Integer(0)
        if value.is_Symbol:
            return value, value
        if value.is_Add:
            order_pairs = [self.expand_orders(x) for x in value.args]
            return sp.Add(*(order_zero for order_zero, _ in order_pairs)), sp.Add(
                *(order_k for _, order_k in order_pairs)
            )
        if value.is_Mul or (value.is_Pow and value.exp.is_Integer and value.exp >= 2):
            return self._expand_product(value, symbol_of_value)
        if symbol_of_value is None:
            local = self.define_value(value)
            return local, local
        return (
            self._expand_power(value, symbol_of_value)
            if value.is_Pow
            else self._expand_function(value, symbol_of_value)
        )

    def _expand_product(self, value: sp.Expr, symbol_of_value: sp.Symbol | None) -> OrderPair:
        """Return the coefficients of order 0 and of order k of a product or quotient.

        It is a constant times a product of two locals, or a quotient of two; more factors are combined in new locals
        first. `symbol_of_value`: the symbol of the value, or None.
        """
        constant = sp.Mul(*(factor for factor in sp.Mul.make_args(value) if self.is_constant_in_time(factor)))
        varying = [factor for factor in sp.Mul.make_args(value) if not self.is_constant_in_time(factor)]
        denominators = [
            factor for factor in varying if factor.is_Pow and factor.exp.is_number and factor.exp.is_negative
        ]
        denominators += [self.reciprocals[factor] ** -1 for factor in varying if factor in self.reciprocals]
        numerators = self._reduce_to_two_factors(
            [factor for factor in varying if factor not in denominators and factor not in self.reciprocals]
        )
        if denominators and numerators:
            numerator, denominator = (
                self._define_product(numerators),
                self._define_product(self._reduce_to_two_factors([1 / factor for factor in denominators])),
            )
            if constant != 1 or symbol_of_value is None:
                numerators = [self.define_value(numerator / denominator)]
            else:
                return numerator / denominator, self.divide_series(numerator, denominator, symbol_of_value)
        elif denominators:
            numerators = [
                self.define_value(
                    1 / self._define_product(self._reduce_to_two_factors([1 / factor for factor in denominators]))
                )
            ]
        if len(numerators) == 1:
            order_zero, order_k = self.expand_orders(numerators[0])
            return constant * order_zero, self.express_at_order_zero(constant) * order_k
        a, b = numerators
        lower_orders = self.add_convolution(Factor(a.name), Factor(b.name))
        return constant * a * b, self.express_at_order_zero(constant) * (
            make_order_zero_symbol(a) * b + make_order_zero_symbol(b) * a + lower_orders
        )

    def _reduce_to_two_factors(self, values: list[sp.Expr]) -> list[sp.Symbol]:
        """Return at most two symbols whose product is that of the values; a single sum is returned as it is.

        Integer powers up to 4 are repeated factors, higher ones squares of lower ones; new locals hold partial
        products.
        """
        if len(values) == 1 and values[0].is_Add:
            return values
        symbols: list[sp.Symbol] = []
        for factor in values:
            exponent = int(factor.exp) if factor.is_Pow and factor.exp.is_Integer and factor.exp >= 2 else 1
            if exponent > 4:
                symbols += [self.define_value(factor.base ** (exponent // 2))] * 2 + [
                    self.define_value(factor.base)
                ] * (exponent % 2)
            else:
                symbols += [self.define_value(factor.base if exponent > 1 else factor)] * exponent
        while len(symbols) > 2:
            symbols = [self.define_value(symbols[0] * symbols[1]), *symbols[2:]]
        return symbols

    def _define_product(self, parts: list[sp.Symbol]) -> sp.Symbol:
        """Return one symbol for the product of the symbols `parts`; it is defined as a local if there are several."""
        return self.define_value(sp.Mul(*parts))

    def _expand_power(self, value: sp.Expr, symbol_of_value: sp.Symbol) -> OrderPair:
        """Return the coefficients of order 0 and of order k of a power.

        c = a^n follows from a c' = n a' c, a square root from a = c c, and 1/a as a quotient. `symbol_of_value`: the
        symbol of c. Raise NoTaylorSeries if the exponent varies with time.
        """
        if not self.is_constant_in_time(value.exp):
            raise NoTaylorSeries("a power has an exponent that varies")
        a, n = self.define_value(value.base), value.exp
        if n.is_Integer and n < -1:
            a, n = self.define_value(value.base**-n), sp.Integer(-1)
        if n == -1:
            self.reciprocals[symbol_of_value] = a
            return 1 / a, self.divide_series(sp.Integer(0), a, symbol_of_value)
        if n == _HALF:
            lower_orders = self.add_convolution(Factor(symbol_of_value.name), Factor(symbol_of_value.name))
            return a**n, (a - lower_orders) * _HALF * self.store_inverse(symbol_of_value)
        varying_base = self.add_convolution(Factor(a.name, True), Factor(symbol_of_value.name))
        varying_power = self.add_convolution(Factor(a.name), Factor(symbol_of_value.name, True))
        n = self.express_at_order_zero(n)
        return a**value.exp, (
            n * a * make_order_zero_symbol(symbol_of_value) + (n * varying_base - varying_power) * INVERSE_ORDER
        ) * self.store_inverse(a)

    def _expand_function(self, value: sp.Expr, symbol_of_value: sp.Symbol) -> OrderPair:
        """Return the coefficients of order 0 and of order k of a function of series, such as sin(u) or atan2(y, x).

        Order k follows from the derivative in the table of functions. `symbol_of_value`: the symbol of the value.
        Raise NoTaylorSeries if the table has none.
        """
        derivative = CLASSES[type(value)].derivative if type(value) in CLASSES else ""
        if not derivative and not isinstance(value, sp.atan2):
            raise NoTaylorSeries(f"{type(value).__name__.lower()}() has switching points, or its series is not known")
        u = [self.define_series_symbol(x) for x in value.args]
        order_k = (
            _expand_by_derivative(self, derivative, u[0], symbol_of_value)
            if derivative
            else _expand_angle(self, u[0], u[1], symbol_of_value)
        )
        return value.func(*u), order_k

    def express_at_order_zero(self, value: sp.Expr) -> sp.Expr:
        """Return a value that is constant in time as the lines of order k read it.

        Parameters are read by name, other locals by their stored value of order 0. A longer expression becomes a local
        first.
        """
        if value.free_symbols and not (value.is_Symbol or (-value).is_Symbol):
            value = self.define_value(value)
        return value.xreplace(
            {s: make_order_zero_symbol(s) for s in value.free_symbols if s.name not in self.parameters}
        )

    def divide_series(self, a: sp.Expr, b: sp.Symbol, symbol_of_quotient: sp.Symbol) -> sp.Expr:
        """Return order k of c = a/b from a_k = c_0 b_k + c_k b_0 + S_k; `symbol_of_quotient` is the symbol of c.

        S_k is the convolution of lower orders of c and b. `a` is the coefficient a_k.
        """
        return (
            a
            - make_order_zero_symbol(symbol_of_quotient) * b
            - self.add_convolution(Factor(symbol_of_quotient.name), Factor(b.name))
        ) * self.store_inverse(b)

    def store_inverse(self, b: sp.Symbol) -> sp.Expr:
        """Return the symbol of 1/b_0, b_0 the coefficient of order 0 of b, and have it stored for all higher orders."""
        name = f"{b.name}_inverse"
        self.inverses[name] = b
        return StoredSymbol(StorageLocation(VALUES)[name])

    def integrate_product(self, u: sp.Symbol, w: sp.Symbol) -> sp.Expr:
        """Return order k > 0 of the series c with c' = u' w: u_k w_0 + (1/k) Σ j u_j w_{k-j}, j from 1 to k − 1."""
        return (
            u * make_order_zero_symbol(w) + self.add_convolution(Factor(u.name, True), Factor(w.name)) * INVERSE_ORDER
        )

    def integrate_quotient(self, u: sp.Expr, w: sp.Symbol, symbol_of_value: sp.Symbol) -> sp.Expr:
        """Return order k > 0 of the series c with w c' = u'; `symbol_of_value` is the symbol of c, `u` order k of u."""
        return (
            u - self.add_convolution(Factor(w.name), Factor(symbol_of_value.name, True)) * INVERSE_ORDER
        ) * self.store_inverse(w)

    def add_convolution(self, left: Factor, right: Factor) -> sp.Symbol:
        """Return the symbol of the sum S_k = Σ left_j right_{k-j}, j from 1 to k − 1, of two series (Cauchy product).

        The sum is recorded once: exchanged factors give the same sum.
        """
        factors = (left, right) if (left.name, left.rate) <= (right.name, right.rate) else (right, left)
        name = "__".join(f"{factor.name}{'_rate' * factor.rate}" for factor in factors)
        product = self.products.setdefault(factors, Product(name, *factors))
        return StoredSymbol(StorageLocation(SUMS)[product.name])

    def postpone_square_definition(self, symbol_of_value: sp.Symbol) -> sp.Symbol:
        """Return a new symbol for the square of the local that is being defined.

        Its definition is appended to `pending`, so that it follows that of the local.
        """
        name = self.make_unique_name("square")
        self.pending.append((name, symbol_of_value**2))
        return sp.Symbol(name, real=True)


def make_order_zero_symbol(symbol: sp.Symbol) -> sp.Symbol:
    """Return the symbol of the coefficient of order 0 of a local, as higher orders read it."""
    return StoredSymbol(StorageLocation(VALUES)[symbol.name])


def _expand_angle(rules: Rules, y: sp.Symbol, x: sp.Symbol, symbol_of_angle: sp.Symbol) -> sp.Expr:
    """Return order k of the angle c of the vector (x, y), by (x^2 + y^2) c' = x y' - y x'.

    `symbol_of_angle`: the symbol of c.
    """
    squared_radius = rules.define_value(x**2 + y**2)
    x_dy = rules.add_convolution(Factor(x.name), Factor(y.name, True))
    y_dx = rules.add_convolution(Factor(y.name), Factor(x.name, True))
    return rules.integrate_quotient(
        make_order_zero_symbol(x) * y - make_order_zero_symbol(y) * x + (x_dy - y_dx) * INVERSE_ORDER,
        squared_radius,
        symbol_of_angle,
    )


def _expand_by_derivative(rules: Rules, derivative: str, u: sp.Symbol, symbol_of_value: sp.Symbol) -> sp.Expr:
    """Return order k of c = f(u) from the text of its derivative in the table of functions.

    A derivative n/w with a number n gives w c' = n u'; one that is a sum of terms n w gives c' = Σ n u' w.
    `symbol_of_value`: the symbol of c.
    """
    numerator, denominator = sp.fraction(convert_derivative(derivative, u, symbol_of_value))
    if denominator != 1:
        return rules.integrate_quotient(
            numerator * u, denominator if denominator.is_Symbol else rules.define_value(denominator), symbol_of_value
        )
    terms = []
    for coefficient, w in (term.as_coeff_Mul() for term in sp.Add.make_args(numerator)):
        if w == symbol_of_value**2:
            w = rules.postpone_square_definition(symbol_of_value)
        elif w.is_Function:
            w = rules.define_auxiliary_function(w)
        elif not w.is_Symbol and w != 1:
            w = rules.define_value(w)
        terms.append(coefficient * (u if w == 1 else rules.integrate_product(u, w)))
    return sp.Add(*terms)

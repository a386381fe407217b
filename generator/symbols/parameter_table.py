"""The run-time parameters of a scene: those that the user may override, and those that `prepare` derives.

Every physical number has an address and becomes a member of the C struct `Parameters`; a literal zero is structural
and stays a zero. Derived parameters (inverse masses, K, S, …) are computed from the others.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.mechanism import Quantity, Scene
from gudgeon.generator.symbols.from_expressions import to_sympy
from gudgeon.generator.symbols.storage import PARAMETERS, Freezable, Place
from gudgeon.generator.symbols.symbols import OWN_FIELD, Symbols
from gudgeon.language.tree import Expr, evaluate, names
from gudgeon.language.units import DIMENSIONLESS, Dimension


@dataclass(frozen=True)
class ParameterEntry:
    """One parameter with its address; `value` is the default in symbols of earlier parameters, or a number."""

    symbol: sp.Symbol
    address: str
    value: sp.Expr
    default: float
    dimension: Dimension
    words: tuple[str, ...] = ()  # what its number, 0, 1, …, stands for
    written: Expr | None = None  # as the file has it

    @property
    def follows(self) -> bool:
        """Return whether the default depends on other parameters."""
        return bool(self.value.free_symbols)


@dataclass(frozen=True)
class Owned:
    """The role of a derived parameter in a joint or element: `axis` of the unit vector `what`, or `what` itself."""

    owner: str
    what: str
    axis: str = ""


class ParameterTable(Freezable):
    """The parameter table, in order of first use; entries of the section `parameters` come first, in dependency order.

    The model's parameters are complete; derived ones are those of the model, then those of each program.
    """

    def __init__(self, scene: Scene, symbols: Symbols) -> None:
        """Begin with the section `parameters` of a scene."""
        self.symbols = symbols
        self.entries: dict[str, ParameterEntry] = {}
        self.derived: dict[sp.Symbol, sp.Expr] = {}
        self.of_owner: dict[sp.Symbol, Owned] = {}  # roles of derived parameters of one joint or element
        self.unwritten: set[sp.Expr] = set()  # derived parameters of the integration only, which no document prints
        self.signs: dict[str, str] = {}  # address -> ">" or "<": the sign to zero that the equations rely on
        self.tables: dict[str, list[sp.Symbol]] = {}  # parameters in arrays of Parameters, by the array's name
        self._derived_by: dict[sp.Expr, sp.Symbol] = {}
        self._parameters, self._instead = scene.parameters, scene.instead
        for name in scene.parameters:
            self._parameter(name)

    def beside(self, symbols: Symbols) -> ParameterTable:
        """Return the same table for functions with other symbols (`Symbols.beside`)."""
        other = copy.copy(self)
        other.symbols = symbols
        return other

    def is_constant(self, expression: sp.Expr) -> bool:
        """Return whether `prepare` could compute an expression: it contains only parameters and numbers."""
        info = self.symbols.info
        return all(s in info and info[s].is_parameter for s in expression.free_symbols)

    def _parameter(self, name: str) -> sp.Symbol:
        """Return the symbol of an entry of `parameters`, added with those on which it depends."""
        waiting = [name]  # not by recursion: thousands may be defined through each other
        while waiting:
            quantity = self._parameters[waiting[-1]]
            used = (used.path for used in names(quantity.value) if f"parameters.{used.path}" not in self.entries)
            if (first := next(used, None)) is not None:
                waiting.append(first)
                continue
            last = waiting.pop()
            if f"parameters.{last}" not in self.entries:
                self._add(f"parameters.{last}", last, quantity)
        return self.entries[f"parameters.{name}"].symbol

    def _add(self, address: str, expected: str, quantity: Quantity, home: Place = OWN_FIELD) -> sp.Symbol:
        """Add a parameter with the expression of a quantity and return its symbol."""
        parts = {part.address: part for part in quantity.of}

        def symbol(path: str) -> sp.Expr:
            """Return the symbol of a name in the expression."""
            return self.use(parts[path]) if path in parts else self._parameter(path)

        def number(path: str) -> float:
            """Return the default value of a name in the expression."""
            return self.entries[path if path in parts else f"parameters.{path}"].default

        follows = to_sympy(quantity.value, symbol) if names_any(quantity) else None
        default = float(evaluate(quantity.value, number))
        value = sp.Float(default, 17) if follows is None else follows
        short = "." not in expected and not address.startswith("parameters.")  # gravity.y is not y
        shown = address if short else ""
        symbol = self.symbols.new(expected, home, address, shown=shown)
        self.entries[address] = ParameterEntry(symbol, address, value, default, quantity.dimension, (), quantity.value)
        return symbol

    def use(self, quantity: Quantity, zero: bool = False) -> sp.Expr:
        """Return the parameter of a quantity, or of the scene's replacement; 0 for a literal zero unless `zero`."""
        quantity = self._instead.get(quantity.address, quantity)
        if quantity.is_zero and not zero:
            return sp.Integer(0)
        if quantity.address not in self.entries:
            _, _, rest = quantity.address.partition(".")
            self._add(quantity.address, rest or quantity.address, quantity)
        self.symbols.adopt(self.entries[quantity.address].symbol)
        return self.entries[quantity.address].symbol

    def table(self, expected: str, quantities: Sequence[Quantity]) -> str:
        """Return the name of an array of Parameters that holds several quantities."""
        known = next((k for k, s in self.tables.items() if s[0] == self._slot(quantities[0])), "")
        if not known:
            known = self.symbols.unique(expected)
            self.tables[known] = [
                self._add(own.address, f"{known}_{k}", own, Place(PARAMETERS)[known][k])
                for k, own in enumerate(quantities)
            ]
        for symbol in self.tables[known]:
            self.symbols.adopt(symbol)
        return known

    def _slot(self, quantity: Quantity) -> sp.Symbol | None:
        """Return the symbol of a quantity's parameter; None if it has none."""
        entry = self.entries.get(quantity.address)
        return entry.symbol if entry else None

    def constant(self, address: str, expected: str, default: float, dimension: Dimension = DIMENSIONLESS) -> sp.Symbol:
        """Return the parameter of an address that no file names, such as a Baumgarte gain."""
        if address not in self.entries:
            symbol = self.symbols.new(expected, OWN_FIELD, address)
            self.entries[address] = ParameterEntry(symbol, address, sp.Float(default, 17), default, dimension)
        self.symbols.adopt(self.entries[address].symbol)
        return self.entries[address].symbol

    def choice(self, address: str, words: tuple[str, ...], default: str) -> None:
        """Add a parameter whose value is the index of the chosen word."""
        self.constant(address, address.partition(".")[2], float(words.index(default)))
        self.entries[address] = replace(self.entries[address], words=words)

    def derive(
        self, expected: str, expression: sp.Expr, meaning: str = "", shown: str = "", of: Owned | None = None
    ) -> sp.Expr:
        """Return a derived parameter, which `prepare` computes once a run; numbers and parameters stay as they are.

        `expected`: base of its name; `shown`: name of its field.
        """
        if expression.is_number or (expression.is_Symbol and self.symbols.info[expression].is_parameter):
            return expression
        if expression not in self._derived_by:
            symbol = self.symbols.define(expected, expression, OWN_FIELD, meaning, shown=shown)
            self.derived[symbol] = expression
            if of is not None:
                self.of_owner[symbol] = of
            self._derived_by[expression] = symbol
        self.symbols.adopt(self._derived_by[expression])
        return self._derived_by[expression]

    def derive_signed(self, expected: str, expression: sp.Expr, meaning: str = "", shown: str = "") -> sp.Expr:
        """Return a derived parameter as `derive`, but −s is written with the symbol of s.

        Opposite arms are shared in this way.
        """
        opposite = self._derived_by.get(-expression)
        return self.derive(expected, expression, meaning, shown) if opposite is None else -opposite

    def default(self, expression: sp.Expr) -> float:
        """Return the value of a constant expression with every parameter at its default."""
        defaults = {entry.symbol: sp.Float(entry.default, 17) for entry in self.entries.values()}
        value = sp.sympify(expression)
        while value.free_symbols:
            value = value.xreplace(self.derived).xreplace(defaults)
        return float(value)

    def members(self) -> list[sp.Symbol]:
        """Return the symbols of all parameters: those of the file, then derived ones."""
        return [*(entry.symbol for entry in self.entries.values()), *self.derived]

    def field(self, symbol: sp.Symbol) -> str:
        """Return the name of a parameter's field in Parameters."""
        return self.place(symbol).member

    def place(self, symbol: sp.Symbol) -> Place:
        """Return the place of a parameter in Parameters."""
        home = self.symbols.info[symbol].home
        assert home is not None
        return home


def names_any(quantity: Quantity) -> bool:
    """Return whether a quantity's expression contains a name."""
    return any(True for _ in names(quantity.value))

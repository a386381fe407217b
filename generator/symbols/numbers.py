"""The run-time numbers of a scene: slots that the user may override, and what `prepare` derives.

Every physical number has an address and becomes a member of the C struct `Parameters`; a literal
zero is structural and stays a zero. Derived numbers (inverse masses, K, S, …) follow the slots.
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
class SlotEntry:
    """`value` is the default in symbols of earlier slots; a number unless it follows parameters."""

    symbol: sp.Symbol
    address: str
    value: sp.Expr
    default: float
    dimension: Dimension
    words: tuple[str, ...] = ()  # what its number, 0, 1, …, stands for
    written: Expr | None = None  # as the file has it

    @property
    def follows(self) -> bool:
        return bool(self.value.free_symbols)


@dataclass(frozen=True)
class Owned:
    """What a derived number is to a joint or force element: `axis` of the unit vector `what`, or `what` itself."""

    owner: str
    what: str
    axis: str = ""


class Slots(Freezable):
    """Collects slots in order of use; parameters come first, in dependency order.

    The model's slots are complete; derived numbers are those of the model, then those of each program.
    """

    def __init__(self, scene: Scene, symbols: Symbols) -> None:
        self.symbols = symbols
        self.entries: dict[str, SlotEntry] = {}
        self.derived: dict[sp.Symbol, sp.Expr] = {}
        self.of_owner: dict[sp.Symbol, Owned] = {}  # of derived numbers those that one joint or element has
        self.unwritten: set[sp.Expr] = set()  # derived numbers of the integration alone, which no document writes
        self.signs: dict[str, str] = {}  # address -> ">" or "<": the sign to zero that the equations rely on
        self.tables: dict[str, list[sp.Symbol]] = {}  # numbers that are an array of Parameters, by its name
        self._derived_by: dict[sp.Expr, sp.Symbol] = {}
        self._parameters, self._instead = scene.parameters, scene.instead
        for name in scene.parameters:
            self._parameter(name)

    def beside(self, symbols: Symbols) -> Slots:
        """The same slots for functions with other symbols (`Symbols.beside`)."""
        other = copy.copy(self)
        other.symbols = symbols
        return other

    def is_constant(self, expression: sp.Expr) -> bool:
        """Whether `prepare` could compute it: nothing but slots and numbers in it."""
        info = self.symbols.info
        return all(s in info and info[s].is_parameter for s in expression.free_symbols)

    def _parameter(self, name: str) -> sp.Symbol:
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

    def _add(self, address: str, wanted: str, quantity: Quantity, home: Place = OWN_FIELD) -> sp.Symbol:
        parts = {part.address: part for part in quantity.of}

        def symbol(path: str) -> sp.Expr:
            return self.use(parts[path]) if path in parts else self._parameter(path)

        def number(path: str) -> float:
            return self.entries[path if path in parts else f"parameters.{path}"].default

        follows = to_sympy(quantity.value, symbol) if names_any(quantity) else None
        default = float(evaluate(quantity.value, number))
        value = sp.Float(default, 17) if follows is None else follows
        short = "." not in wanted and not address.startswith("parameters.")  # gravity.y is no y
        shown = address if short else ""
        symbol = self.symbols.new(wanted, home, address, shown=shown)
        self.entries[address] = SlotEntry(symbol, address, value, default, quantity.dimension, (), quantity.value)
        return symbol

    def use(self, quantity: Quantity, zero: bool = False) -> sp.Expr:
        """The slot of a quantity, or of what the scene has instead; 0 for a literal zero unless that may be a slot."""
        quantity = self._instead.get(quantity.address, quantity)
        if quantity.is_zero and not zero:
            return sp.Integer(0)
        if quantity.address not in self.entries:
            _, _, rest = quantity.address.partition(".")
            self._add(quantity.address, rest or quantity.address, quantity)
        self.symbols.adopt(self.entries[quantity.address].symbol)
        return self.entries[quantity.address].symbol

    def table(self, wanted: str, quantities: Sequence[Quantity]) -> str:
        """Slots of several quantities as an array of Parameters; what it is called there."""
        known = next((k for k, s in self.tables.items() if s[0] == self._slot(quantities[0])), "")
        if not known:
            known = self.symbols.unique(wanted)
            self.tables[known] = [
                self._add(own.address, f"{known}_{k}", own, Place(PARAMETERS)[known][k])
                for k, own in enumerate(quantities)
            ]
        for symbol in self.tables[known]:
            self.symbols.adopt(symbol)
        return known

    def _slot(self, quantity: Quantity) -> sp.Symbol | None:
        entry = self.entries.get(quantity.address)
        return entry.symbol if entry else None

    def constant(self, address: str, wanted: str, default: float, dimension: Dimension = DIMENSIONLESS) -> sp.Symbol:
        """A slot that no file names, such as the Baumgarte gains."""
        if address not in self.entries:
            symbol = self.symbols.new(wanted, OWN_FIELD, address)
            self.entries[address] = SlotEntry(symbol, address, sp.Float(default, 17), default, dimension)
        self.symbols.adopt(self.entries[address].symbol)
        return self.entries[address].symbol

    def choice(self, address: str, words: tuple[str, ...], default: str) -> None:
        """A slot for which of some words the run has chosen: the equations know their numbers only."""
        self.constant(address, address.partition(".")[2], float(words.index(default)))
        self.entries[address] = replace(self.entries[address], words=words)

    def derive(
        self, wanted: str, expression: sp.Expr, meaning: str = "", shown: str = "", of: Owned | None = None
    ) -> sp.Expr:
        """A number that `prepare` computes once a run; numbers and slots themselves stay as they are."""
        if expression.is_number or (expression.is_Symbol and self.symbols.info[expression].is_parameter):
            return expression
        if expression not in self._derived_by:
            symbol = self.symbols.define(wanted, expression, OWN_FIELD, meaning, shown=shown)
            self.derived[symbol] = expression
            if of is not None:
                self.of_owner[symbol] = of
            self._derived_by[expression] = symbol
        self.symbols.adopt(self._derived_by[expression])
        return self._derived_by[expression]

    def derive_signed(self, wanted: str, expression: sp.Expr, meaning: str = "", shown: str = "") -> sp.Expr:
        """Like `derive`, but −s is written with the symbol of s, so that opposite arms are shared."""
        opposite = self._derived_by.get(-expression)
        return self.derive(wanted, expression, meaning, shown) if opposite is None else -opposite

    def default(self, expression: sp.Expr) -> float:
        """The value of a constant expression with every slot at its default."""
        defaults = {entry.symbol: sp.Float(entry.default, 17) for entry in self.entries.values()}
        value = sp.sympify(expression)
        while value.free_symbols:
            value = value.xreplace(self.derived).xreplace(defaults)
        return float(value)

    def members(self) -> list[sp.Symbol]:
        """Every number of a run: slots, then what is derived."""
        return [*(entry.symbol for entry in self.entries.values()), *self.derived]

    def field(self, symbol: sp.Symbol) -> str:
        """What a number is called in Parameters."""
        return self.place(symbol).member

    def place(self, symbol: sp.Symbol) -> Place:
        """Where a number is in Parameters."""
        home = self.symbols.info[symbol].home
        assert home is not None
        return home


def names_any(quantity: Quantity) -> bool:
    """Whether a quantity's expression has any name in it."""
    return any(True for _ in names(quantity.value))

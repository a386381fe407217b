"""The symbols of a model: one C name each, the place where it is stored, and its derivatives.

A derived symbol (`cos_theta_L7`, the arm `arm_L7_head_x`, a drive's `crank1_angle`) stands for an expression and knows
its derivatives. Differentiation uses the chain rule over these symbols, so that Φ_q and γ are expressed in the terms
of the geometry and need no search for common subexpressions.
Names of two kinds meet in emitted code: those that are made here, from names in a file, and fixed ones (arguments, the
laws' letters, the engine, C). They differ by construction: a name that is made here ends in `_` and does not contain
`__`, and no fixed name ends so.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.symbols.derivatives import derivative, symbols_of
from gudgeon.generator.symbols.storage import PARAMETERS, Freezable, Key, Place, PlaceSymbol
from gudgeon.generator.symbols.switches import Switches

OWN_FIELD = Place(PARAMETERS)[""]  # the home of a parameter whose field is called as the symbol


def made_name(expected: str) -> str:
    """Return the identifier of what a file calls `expected`: single underscores, the last one at its end.

    No fixed name of the generator, of the engine or of a language has that form, so none can be equal to it.
    """
    return re.sub(r"[\W_]+", "_", expected).strip("_") + "_"


def plain_name(symbol: sp.Symbol) -> str:
    """Return what the file calls a symbol, as documents show it: its name without the ending of `made_name`."""
    return str(symbol.name).rstrip("_")


@dataclass(frozen=True)
class SymbolInfo:
    """Place, meaning and unit of a symbol; `home` is where the symbol is read, None for a local of its kernel."""

    home: Place | None
    meaning: str
    unit: str

    @property
    def is_parameter(self) -> bool:
        """Return whether the symbol is a parameter of the run."""
        return self.home is not None and self.home.base == PARAMETERS


class Symbols(Freezable):
    """All the symbols of one model, in the order in which they were made."""

    def __init__(self) -> None:
        """Begin without symbols."""
        self.info: dict[sp.Symbol, SymbolInfo] = {}
        self.definitions: dict[sp.Symbol, sp.Expr] = {}
        self.rules: dict[sp.Symbol, dict[sp.Symbol, sp.Expr]] = {}
        self.switches = Switches()
        self._names: set[str] = set()
        self._shared: Symbols | None = None  # who else has the members of Parameters
        self._numbered: dict[str, str] = {}  # names that others had before: what was wanted

    def freeze(self) -> None:
        """Make these tables and the switches read only: a later request for a new name is a defect."""
        super().freeze()
        self.switches.freeze()

    def thawed(self) -> Symbols:
        """Return a copy, with switches of its own, which may grow."""
        other = super().thawed()
        other.switches = self.switches.thawed()
        return other

    def beside(self) -> Symbols:
        """Return a table for other functions of the same library, which shares only the members of Parameters."""
        other = Symbols()
        other._shared, other.switches = self, self.switches.beside()
        for symbol, info in self.info.items():
            if info.is_parameter:
                other.adopt(symbol)
        return other

    def adopt(self, symbol: sp.Symbol) -> None:
        """Add a member of Parameters that was made in the other table."""
        if self._shared is not None and symbol not in self.info:
            self.info[symbol] = self._shared.info[symbol]
            self._names.add(symbol.name)
            if symbol in self._shared.definitions:
                self.definitions[symbol] = self._shared.definitions[symbol]

    def unique(self, expected: str) -> str:
        """Return `expected` as an identifier that nothing else has in any target: see `made_name`."""
        assert not self.frozen, f"{expected}: derived after the tables were frozen"
        name = candidate = made_name(expected)
        count = 1
        while candidate in self._names:
            count += 1
            candidate = f"{name}{count}_"
        self._names.add(candidate)
        if count > 1:
            self._numbered[candidate] = name
        return candidate

    def shorter(self, used: Collection[str]) -> dict[Key, Key]:
        """Return shorter names for those that carry a number: without the number, or with the smallest one.

        `used`: the names in the function.
        """
        own = [name for name in used if not ((home := self._home(name)) and home.is_parameter)]
        numbered = sorted((name for name in own if name in self._numbered), key=lambda name: (len(name), name))
        reserved = {*own} - {*numbered}
        found: dict[str, str] = {}
        for name in numbered:
            base = self._numbered[name]
            free = base not in reserved and not self._is_member(base)
            found[name] = (
                base
                if free
                else next(called for k in range(2, len(used) + 3) if (called := f"{base}{k}_") not in reserved)
            )
            reserved.add(found[name])
        return {name: called for name, called in found.items() if name != called}

    def _is_member(self, name: str) -> bool:
        """Return whether a parameter has this name, which must not stand for something else."""
        return self._home(name) == Place(PARAMETERS)[name]

    def _home(self, name: str) -> Place | None:
        """Return the place of a name's symbol; None for a local."""
        info = self.info.get(sp.Symbol(name, real=True))
        return info.home if info else None

    def new(
        self, expected: str, home: Place | None = None, meaning: str = "", unit: str = "", shown: str = ""
    ) -> sp.Symbol:
        """Return a new real symbol; with home OWN_FIELD its field is called `shown`, or as the symbol.

        Terms are ordered by the symbol's own name.
        """
        shared = self._shared if home and home.is_parameter else None
        name, called = (self._unshared(text, shared) if text else "" for text in (expected, shown))
        symbol = sp.Symbol(name, real=True)
        home = Place(PARAMETERS)[called or name] if home == OWN_FIELD else home
        self.info[symbol] = SymbolInfo(home, meaning, unit)
        if shared is not None:
            shared.info[symbol] = self.info[symbol]
        return symbol

    def _unshared(self, expected: str, shared: Symbols | None) -> str:
        """Return a name that is new in the other table too."""
        name = self.unique(expected)
        while shared is not None and name in shared._names:
            name = self.unique(expected)
        if shared is not None:
            shared._names.add(name)
        return name

    def define(
        self,
        expected: str,
        expression: sp.Expr,
        home: Place | None = None,
        meaning: str = "",
        unit: str = "",
        shown: str = "",
    ) -> sp.Symbol:
        """Return a new symbol that stands for `expression`."""
        symbol = self.new(expected, home, meaning, unit, shown)
        self.definitions[symbol] = expression
        if self._shared is not None and home is not None and home.is_parameter:
            self._shared.definitions[symbol] = expression
        return symbol

    def diff(self, expression: sp.Expr, by: sp.Symbol) -> sp.Expr:
        """Return d expression / d by, through the derived symbols."""
        total = sp.Integer(0)
        for symbol in sorted(symbols_of(expression), key=lambda s: s.name):
            inner = sp.Integer(1) if symbol == by else self.rules.get(symbol, {}).get(by)
            if inner is not None:
                total += derivative(expression, symbol) * inner
        return total

    def written_out(self, expression: sp.Expr, by: sp.Symbol) -> sp.Expr:
        """Return d expression / d by through definitions, for a symbol that no rule names.

        Such a symbol is a rate that a drive prescribes.
        """
        total = sp.Integer(0)
        for symbol in sorted(symbols_of(expression), key=lambda s: s.name):
            known = symbol != by and symbol in self.definitions
            inner = self.written_out(self.definitions[symbol], by) if known else sp.Integer(symbol == by)
            if inner != 0:
                total += derivative(expression, symbol) * inner
        return total

    def in_place(self, value: sp.Expr) -> sp.Expr:
        """Return the value with every symbol that has a home read there."""
        homes = ((s, self.info[s].home) for s in value.free_symbols if s in self.info)
        return value.xreplace({s: PlaceSymbol(home) for s, home in homes if home})

    def explicit(self, expression: sp.Expr) -> sp.Expr:
        """Return `expression` with every derived symbol replaced by its definition."""
        while found := {s: self.definitions[s] for s in expression.free_symbols if s in self.definitions}:
            expression = expression.xreplace(found)
        return expression

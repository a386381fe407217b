"""Symbols of a scene's equations: each has a C name, a storage location, and derivatives.

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

from gudgeon.generator.symbols.derivatives import differentiate, find_symbols
from gudgeon.generator.symbols.storage import (
    PARAMETERS,
    Freezable,
    Key,
    StorageLocation,
    StoredSymbol,
    make_real_symbol,
)
from gudgeon.generator.symbols.switches import Switches

PARAMETER_MEMBER = StorageLocation(PARAMETERS)[""]  # stands for the field of a parameter that is called as the symbol


def make_identifier(base_name: str) -> str:
    """Return the identifier for a name of a file: with single underscores, the last one at its end.

    Other characters than letters and digits become underscores: "rod.head" gives "rod_head_". No fixed name of the
    generator, of the engine or of a language has that form, so that none can be equal to it.
    """
    return re.sub(r"[\W_]+", "_", base_name).strip("_") + "_"


def get_document_name(symbol: sp.Symbol) -> str:
    """Return the name of a symbol as documents print it: without the underscore that `make_identifier` appends."""
    return str(symbol.name).rstrip("_")


@dataclass(frozen=True)
class SymbolInfo:
    """Storage location, meaning and unit of a symbol.

    `storage_location` is None for a symbol that is a local of each kernel, computed from its definition.
    """

    storage_location: StorageLocation | None
    meaning: str
    unit: str

    @property
    def is_parameter(self) -> bool:
        """Return whether the symbol is a parameter of the run."""
        return self.storage_location is not None and self.storage_location.base == PARAMETERS


class Symbols(Freezable):
    """All the symbols of one model, in the order in which they were made."""

    def __init__(self) -> None:
        """Begin without symbols, definitions and rules, and with an empty table of switches."""
        self.info: dict[sp.Symbol, SymbolInfo] = {}
        self.definitions: dict[sp.Symbol, sp.Expr] = {}
        self.derivative_rules: dict[sp.Symbol, dict[sp.Symbol, sp.Expr]] = {}
        self.switches = Switches()
        self._names: set[str] = set()
        self._shared_table: Symbols | None = None  # the other table of the same library
        self._base_of_numbered_name: dict[str, str] = {}  # base of each name that got a number

    def freeze(self) -> None:
        """Make these tables and the switches read only; a later request for a new name raises AssertionError."""
        super().freeze()
        self.switches.freeze()

    def copy_mutable(self) -> Symbols:
        """Return a copy of the tables, with a copy of the switches, which may grow."""
        copy_ = super().copy_mutable()
        copy_.switches = self.switches.copy_mutable()
        return copy_

    def copy_parameters_only(self) -> Symbols:
        """Return a new symbol table for other functions of the same scene, which shares only the parameters.

        Switches of joints are shared too. A parameter that is added to the new table gets a name and entry in both.
        """
        other_table = Symbols()
        other_table._shared_table, other_table.switches = self, self.switches.copy_joint_switches()
        for symbol, info in self.info.items():
            if info.is_parameter:
                other_table.add_shared_parameter(symbol)
        return other_table

    def add_shared_parameter(self, symbol: sp.Symbol) -> None:
        """Add a parameter of the other symbol table of the same scene to this table, with its definition.

        Nothing happens if there is no other table or the symbol is known.
        """
        if self._shared_table is not None and symbol not in self.info:
            self.info[symbol] = self._shared_table.info[symbol]
            self._names.add(symbol.name)
            if symbol in self._shared_table.definitions:
                self.definitions[symbol] = self._shared_table.definitions[symbol]

    def make_unique_name(self, base_name: str) -> str:
        """Return an identifier made from `base_name` that no other symbol has, and mark it as used.

        A suffix 2, 3, … is appended if necessary. A frozen table raises AssertionError.
        """
        assert not self.frozen, f"{base_name}: derived after the tables were frozen"
        name = candidate = make_identifier(base_name)
        count = 1
        while candidate in self._names:
            count += 1
            candidate = f"{name}{count}_"
        self._names.add(candidate)
        if count > 1:
            self._base_of_numbered_name[candidate] = name
        return candidate

    def find_shorter_names(self, used_names: Collection[str]) -> dict[Key, Key]:
        """Return shorter names for names that end with a number: {"x_2_": "x_"}.

        The number is omitted, or replaced by the smallest unused one. `used_names`: all names in the function. Names
        that stay are left out.
        """
        locals_ = [
            name for name in used_names if not ((place := self._find_storage_location(name)) and place.is_parameter)
        ]
        numbered_names = sorted(
            (name for name in locals_ if name in self._base_of_numbered_name), key=lambda name: (len(name), name)
        )
        reserved = {*locals_} - {*numbered_names}
        short_names: dict[str, str] = {}
        for name in numbered_names:
            short_name = self._base_of_numbered_name[name]
            is_free = short_name not in reserved and not self._is_parameter_member(short_name)
            short_names[name] = (
                short_name
                if is_free
                else next(
                    candidate
                    for k in range(2, len(used_names) + 3)
                    if (candidate := f"{short_name}{k}_") not in reserved
                )
            )
            reserved.add(short_names[name])
        return {name: candidate for name, candidate in short_names.items() if name != candidate}

    def _is_parameter_member(self, name: str) -> bool:
        """Return whether a parameter's field in the struct Parameters has this name."""
        return self._find_storage_location(name) == StorageLocation(PARAMETERS)[name]

    def _find_storage_location(self, name: str) -> StorageLocation | None:
        """Return the storage location of the symbol with a name; None for a local or an unknown name."""
        info = self.info.get(make_real_symbol(name))
        return info.storage_location if info else None

    def add_symbol(
        self,
        base_name: str,
        place: StorageLocation | None = None,
        meaning: str = "",
        unit: str = "",
        member_base_name: str = "",
    ) -> sp.Symbol:
        """Return a new real symbol, with an unused name made from `base_name`, and record its place, meaning and unit.

        `place`: the storage location where it is read; None: it is defined by an expression. With PARAMETER_MEMBER it
        is a member of Parameters, called as `member_base_name`, or as the symbol if that is "".
        """
        shared_table = self._shared_table if place and place.is_parameter else None
        name, field_name = (
            self._make_name_for_both_tables(text, shared_table) if text else ""
            for text in (base_name, member_base_name)
        )
        symbol = make_real_symbol(name)
        place = StorageLocation(PARAMETERS)[field_name or name] if place == PARAMETER_MEMBER else place
        self.info[symbol] = SymbolInfo(place, meaning, unit)
        if shared_table is not None:
            shared_table.info[symbol] = self.info[symbol]
        return symbol

    def _make_name_for_both_tables(self, base_name: str, shared_table: Symbols | None) -> str:
        """Return an unused name made from `base_name` that the table `shared_table` does not contain either.

        The name is marked as used in both. `shared_table` None: only this table counts.
        """
        name = self.make_unique_name(base_name)
        while shared_table is not None and name in shared_table._names:
            name = self.make_unique_name(base_name)
        if shared_table is not None:
            shared_table._names.add(name)
        return name

    def add_definition(
        self,
        base_name: str,
        expression: sp.Expr,
        place: StorageLocation | None = None,
        meaning: str = "",
        unit: str = "",
        member_base_name: str = "",
    ) -> sp.Symbol:
        """Return a new symbol that stands for `expression`, its definition; other arguments are those of `add_symbol`.

        A parameter's definition is stored in the shared table too.
        """
        symbol = self.add_symbol(base_name, place, meaning, unit, member_base_name)
        self.definitions[symbol] = expression
        if self._shared_table is not None and place is not None and place.is_parameter:
            self._shared_table.definitions[symbol] = expression
        return symbol

    def differentiate(self, expression: sp.Expr, variable: sp.Symbol) -> sp.Expr:
        """Return the derivative of an expression by `variable`: the chain rule with its symbols' derivative rules.

        A symbol other than `variable` that has no rule for it counts as constant.
        """
        result = sp.Integer(0)
        for symbol in sorted(find_symbols(expression), key=lambda s: s.name):
            inner_derivative = (
                sp.Integer(1) if symbol == variable else self.derivative_rules.get(symbol, {}).get(variable)
            )
            if inner_derivative is not None:
                result += differentiate(expression, symbol) * inner_derivative
        return result

    def find_differentiation_variables(self, expression: sp.Expr) -> set[sp.Symbol]:
        """Return the variables by which `differentiate` may give a derivative of an expression other than 0.

        They are its symbols, and the variables in the `derivative_rules` of its symbols.
        """
        symbols = find_symbols(expression)
        return set(symbols).union(
            *(self.derivative_rules[symbol] for symbol in symbols if symbol in self.derivative_rules)
        )

    def differentiate_definitions(self, expression: sp.Expr, variable: sp.Symbol) -> sp.Expr:
        """Return the derivative of an expression by `variable`, through the definitions of derived symbols.

        It is for variables without derivative rules: rates that a drive prescribes.
        """
        result = sp.Integer(0)
        for symbol in sorted(find_symbols(expression), key=lambda s: s.name):
            is_defined = symbol != variable and symbol in self.definitions
            inner_derivative = (
                self.differentiate_definitions(self.definitions[symbol], variable)
                if is_defined
                else sp.Integer(symbol == variable)
            )
            if inner_derivative != 0:
                result += differentiate(expression, symbol) * inner_derivative
        return result

    def read_from_storage_locations(self, value: sp.Expr) -> sp.Expr:
        """Return the value with each symbol that has a storage location replaced by its `StoredSymbol`."""
        places = ((s, self.info[s].storage_location) for s in value.free_symbols if s in self.info)
        return value.xreplace({s: StoredSymbol(place) for s, place in places if place})

    def expand_definitions(self, expression: sp.Expr) -> sp.Expr:
        """Return `expression` with every derived symbol replaced by its definition, repeatedly, until none is left."""
        while definitions := {s: self.definitions[s] for s in expression.free_symbols if s in self.definitions}:
            expression = expression.xreplace(definitions)
        return expression

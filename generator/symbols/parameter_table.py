"""Run-time parameters of a scene: those that users may change, and those that are computed from them.

Every physical number has an address and becomes a member of the C struct `Parameters`; a literal zero is structural
and stays a zero. Derived parameters (inverse masses, K, S, …) are computed from the others.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.mechanism import Quantity, Scene
from gudgeon.generator.symbols.from_expressions import convert_to_sympy
from gudgeon.generator.symbols.storage import PARAMETERS, Freezable, StorageLocation
from gudgeon.generator.symbols.symbols import PARAMETER_MEMBER, Symbols
from gudgeon.language.tree import Expr, evaluate, iterate_names
from gudgeon.language.units import DIMENSIONLESS, Dimension


@dataclass(frozen=True)
class ParameterEntry:
    """One parameter with its address; `value` is the default in symbols of earlier parameters, or a number."""

    symbol: sp.Symbol
    address: str
    value: sp.Expr
    default: float
    dimension: Dimension
    choice_words: tuple[str, ...] = ()  # words that the values 0, 1, … stand for
    expression: Expr | None = None  # the default as an expression of the file

    @property
    def depends_on_parameters(self) -> bool:
        """Return whether the default is an expression of other parameters."""
        return bool(self.value.free_symbols)


@dataclass(frozen=True)
class ParameterRole:
    """The role of a derived parameter in a joint or element: `axis` of the unit vector `quantity`, or it itself."""

    owner: str
    quantity: str
    axis: str = ""


class ParameterTable(Freezable):
    """The parameter table, in order of first use; entries of the section `parameters` come first, in dependency order.

    The model's parameters are complete; derived ones are those of the model, then those of each program.
    """

    def __init__(self, scene: Scene, symbols: Symbols) -> None:
        """Begin with the parameters in the section `parameters` of a scene, each after those on which it depends."""
        self.symbols = symbols
        self.entries: dict[str, ParameterEntry] = {}
        self.derived: dict[sp.Symbol, sp.Expr] = {}
        self.roles: dict[sp.Symbol, ParameterRole] = {}  # roles of derived parameters of one joint or element
        self.internal_parameters: set[sp.Expr] = (
            set()
        )  # derived parameters of the integration only, which no document prints
        self.signs: dict[str, str] = {}  # address -> ">" or "<": the sign to zero that the equations rely on
        self.tables: dict[str, list[sp.Symbol]] = {}  # parameters in arrays of Parameters, by the array's name
        self._derived_by: dict[sp.Expr, sp.Symbol] = {}
        self._default_of: dict[sp.Symbol, float] = {}  # of the entries
        self._parameters, self._chosen_quantities = scene.parameters, scene.chosen_properties
        for name in scene.parameters:
            self._get_or_add_named_parameter(name)

    def copy_for_symbols(self, symbols: Symbols) -> ParameterTable:
        """Return a shallow copy of the table that adds new symbols to the symbol table `symbols`.

        Copy and original share the dictionaries of parameters: a parameter added to one is in both.
        """
        copy_ = copy.copy(self)
        copy_.symbols = symbols
        return copy_

    def is_constant(self, expression: sp.Expr) -> bool:
        """Return whether an expression contains only parameters and numbers, so that it is constant in a run.

        The function `prepare` can then compute it once a run.
        """
        info = self.symbols.info
        return all(s in info and info[s].is_parameter for s in expression.free_symbols)

    def _get_or_add_named_parameter(self, name: str) -> sp.Symbol:
        """Return the symbol of the entry `name` of the section `parameters`.

        The entry is added if necessary, after all entries on which it depends.
        """
        pending = [name]  # not by recursion: thousands may be defined through each other
        while pending:
            quantity = self._parameters[pending[-1]]
            missing = (
                missing.path
                for missing in iterate_names(quantity.value)
                if f"parameters.{missing.path}" not in self.entries
            )
            if (first_missing := next(missing, None)) is not None:
                pending.append(first_missing)
                continue
            last_name = pending.pop()
            if f"parameters.{last_name}" not in self.entries:
                self._add_parameter(f"parameters.{last_name}", last_name, quantity)
        return self.entries[f"parameters.{name}"].symbol

    def _add_parameter(
        self, address: str, base_name: str, quantity: Quantity, place: StorageLocation = PARAMETER_MEMBER
    ) -> sp.Symbol:
        """Add the parameter of a quantity at an address, after those in its expression; return its symbol.

        `base_name`: base of the symbol's name; `place`: its storage location in Parameters. Its default is the value
        of the expression with all defaults. The entry's `value` is the expression in symbols, or the number if the
        expression contains no names.
        """
        parts = {part.address: part for part in quantity.operands}

        def find_symbol(path: str) -> sp.Expr:
            """Return the SymPy expression of a name in the quantity's expression: a named part of it or a parameter."""
            return self.get_or_add_parameter(parts[path]) if path in parts else self._get_or_add_named_parameter(path)

        def find_default(path: str) -> float:
            """Return the default value of a name in the quantity's expression."""
            return self.entries[path if path in parts else f"parameters.{path}"].default

        default_expression = convert_to_sympy(quantity.value, find_symbol) if _has_names(quantity) else None
        default = float(evaluate(quantity.value, find_default))
        value = sp.Float(default, 17) if default_expression is None else default_expression
        is_unqualified = "." not in base_name and not address.startswith("parameters.")  # gravity.y is not y
        member_base_name = address if is_unqualified else ""
        symbol = self.symbols.add_symbol(base_name, place, address, member_base_name=member_base_name)
        self.entries[address] = ParameterEntry(symbol, address, value, default, quantity.dimension, (), quantity.value)
        self._default_of[symbol] = default
        return symbol

    def get_or_add_parameter(self, quantity: Quantity, adds_zero: bool = False) -> sp.Expr:
        """Return the symbol of a quantity's parameter, added at its first use.

        A scene's quantity at the same address replaces the argument. A number 0 in the file gives 0, without a
        parameter, unless `adds_zero` is True.
        """
        quantity = self._chosen_quantities.get(quantity.address, quantity)
        if quantity.is_zero and not adds_zero:
            return sp.Integer(0)
        if quantity.address not in self.entries:
            _, _, short_address = quantity.address.partition(".")
            self._add_parameter(quantity.address, short_address or quantity.address, quantity)
        self.symbols.add_shared_parameter(self.entries[quantity.address].symbol)
        return self.entries[quantity.address].symbol

    def get_or_add_array(self, base_name: str, quantities: Sequence[Quantity]) -> str:
        """Return the name of an array in Parameters that holds the values of several quantities, in their order.

        The array is named after `base_name`. If the first quantity is the first one of an existing array, that array is
        used. The symbols of the elements are copied to the symbol table of the table if they belong to the scene's
        other one (`Symbols.add_shared_parameter`).
        """
        name = next((k for k, s in self.tables.items() if s[0] == self._find_symbol(quantities[0])), "")
        if not name:
            name = self.symbols.make_unique_name(base_name)
            self.tables[name] = [
                self._add_parameter(quantity.address, f"{name}_{k}", quantity, StorageLocation(PARAMETERS)[name][k])
                for k, quantity in enumerate(quantities)
            ]
        for symbol in self.tables[name]:
            self.symbols.add_shared_parameter(symbol)
        return name

    def _find_symbol(self, quantity: Quantity) -> sp.Symbol | None:
        """Return the symbol of a quantity's parameter, or None if none has been added for its address."""
        entry = self.entries.get(quantity.address)
        return entry.symbol if entry else None

    def get_or_add_constant(
        self, address: str, base_name: str, default: float, dimension: Dimension = DIMENSIONLESS
    ) -> sp.Symbol:
        """Return the symbol of a parameter that no file specifies, such as a Baumgarte gain; added at first use.

        `base_name`: base of its name; `default`: its value in SI units.
        """
        if address not in self.entries:
            symbol = self.symbols.add_symbol(base_name, PARAMETER_MEMBER, address)
            self.entries[address] = ParameterEntry(symbol, address, sp.Float(default, 17), default, dimension)
            self._default_of[symbol] = default
        self.symbols.add_shared_parameter(self.entries[address].symbol)
        return self.entries[address].symbol

    def add_choice(self, address: str, words: tuple[str, ...], default: str) -> None:
        """Add a parameter whose value is the index of the chosen word in `words`; `default` is one of them."""
        self.get_or_add_constant(address, address.partition(".")[2], float(words.index(default)))
        self.entries[address] = replace(self.entries[address], choice_words=words)

    def derive_parameter(
        self,
        base_name: str,
        expression: sp.Expr,
        meaning: str = "",
        member_base_name: str = "",
        role: ParameterRole | None = None,
    ) -> sp.Expr:
        """Return the symbol of a derived parameter, which the function `prepare` computes once a run.

        A number or a parameter is returned unchanged; an equal expression gets the same symbol. `base_name`: base of
        its name; `member_base_name`: that of its field in Parameters, if it differs; `role`: its role in a joint or
        element, or None.
        """
        if expression.is_number or (expression.is_Symbol and self.symbols.info[expression].is_parameter):
            return expression
        if expression not in self._derived_by:
            symbol = self.symbols.add_definition(
                base_name, expression, PARAMETER_MEMBER, meaning, member_base_name=member_base_name
            )
            self.derived[symbol] = expression
            if role is not None:
                self.roles[symbol] = role
            self._derived_by[expression] = symbol
        self.symbols.add_shared_parameter(self._derived_by[expression])
        return self._derived_by[expression]

    def derive_signed_parameter(
        self, base_name: str, expression: sp.Expr, meaning: str = "", member_base_name: str = ""
    ) -> sp.Expr:
        """Return the derived parameter of an expression, or −s if the opposite expression has the symbol s already.

        Opposite arms then share one parameter. The arguments are those of `derive_parameter`.
        """
        opposite = self._derived_by.get(-expression)
        return (
            self.derive_parameter(base_name, expression, meaning, member_base_name) if opposite is None else -opposite
        )

    def compute_default(self, expression: sp.Expr) -> float:
        """Return the value of a constant expression with every parameter at its default.

        Derived parameters are replaced by their definitions; other symbols must not occur.
        """
        value = sp.sympify(expression)
        while symbols := value.free_symbols:
            value = value.xreplace(
                {s: self.derived[s] if s in self.derived else sp.Float(self._default_of[s], 17) for s in symbols}
            )
        return float(value)

    def list_symbols(self) -> list[sp.Symbol]:
        """Return the symbols of all parameters: those of the file in order of first use, then derived ones."""
        return [*(entry.symbol for entry in self.entries.values()), *self.derived]

    def find_member_name(self, symbol: sp.Symbol) -> str:
        """Return the name of a parameter's field in Parameters."""
        return self.find_storage_location(symbol).member

    def find_storage_location(self, symbol: sp.Symbol) -> StorageLocation:
        """Return the storage location of a parameter in the struct Parameters; the symbol must be a parameter."""
        place = self.symbols.info[symbol].storage_location
        assert place is not None
        return place


def _has_names(quantity: Quantity) -> bool:
    """Return whether the expression of a quantity contains any name, that is, depends on a parameter."""
    return any(True for _ in iterate_names(quantity.value))

"""Names the symbols of one scene in a document of equations, and replaces derived ones by their expressions."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.finite_slopes import remove_numerical_forms
from gudgeon.generator.symbols.symbols import Symbols, get_document_name
from gudgeon.generator.targets.latex.letters import Formula, add_primes, make_symbol_name, make_user_symbol_name
from gudgeon.generator.targets.latex.printers import TexPrinter, TextPrinter
from gudgeon.generator.targets.latex.theory import collect_theory_symbols

MAX_DRIVE_OPERATIONS = 8  # of a drive's value that equations contain in full; a longer one has a symbol
MAX_CONSTANT_OPERATIONS = 4  # the same for a derived parameter

_ONE_LETTER = {
    "mass": "m",
    "inertia": "I",
    "length": "l",
    "radius": "R",
    "clearance": "c",
    "stiffness": "k",
    "damping": "d",
    "angle": "phi",
    "axis": "a",
    "direction": "u",
    "radii": "r",
    "gap": "c",
    "half_length": "a",
    "half_height": "b",
    "corner_radius": "rho",
    "density": "rho",
    "thickness": "h",
    "bar": "b",
    "disc": "r",
}
_UNSTRESSED = {"free_length": "l", "free_angle": "theta"}  # get the superscript 0
_TEMPORARY = {  # quantity of a force element -> (letter, number of dots)
    "span": ("Delta", 0),
    "span_rate": ("Delta", 1),
    "length": ("l", 0),
    "length_rate": ("l", 1),
    "force": ("F", 0),
    "moment": ("M", 0),
    "torque": ("M", 0),
}
_RATES = {"vx": ("x", 1), "vy": ("y", 1), "omega": ("theta", 1)}


@dataclass(frozen=True)
class PrimedSymbol:
    """Represent a symbol that has primes because another symbol has its name without primes (`plain_name`)."""

    name: Formula
    meaning: str
    plain_name: Formula
    plain_meaning: str


@dataclass(frozen=True)
class Notation:
    """Contain the names of a model's symbols; `shown_symbols`: derived ones that keep a name of their own."""

    symbols: Symbols
    names: Mapping[sp.Symbol, Formula]
    shown_symbols: frozenset[sp.Symbol]
    order: Mapping[sp.Symbol, int]  # coordinates and velocities by body: the order of a sum's terms
    primed_symbols: tuple[PrimedSymbol, ...] = ()  # in the order of the file

    def rename_symbols(self, names: Mapping[sp.Symbol, Formula]) -> Notation:
        """Return a copy of the notation with other names for some symbols, as in the section of a joint."""
        return replace(self, names={**self.names, **names})

    def expand_symbols(self, expression: sp.Expr) -> sp.Expr:
        """Return an expression with derived symbols replaced by their definitions, except those in `shown_symbols`."""
        definitions = self.symbols.definitions
        while replacements := {
            s: definitions[s] for s in expression.free_symbols if s in definitions and s not in self.shown_symbols
        }:
            expression = expression.xreplace(replacements)
        return expression

    def format_expression(self, expression: sp.Expr) -> Formula:
        """Return an expression as a formula in LaTeX and text, without expanding derived symbols."""
        expression = remove_numerical_forms(sp.sympify(expression))
        return Formula(self._latex.doprint(expression), self._text.doprint(expression))

    def format_terms(
        self, expression: sp.Expr, list_tokens: Callable[[sp.Expr], Sequence[str]] = lambda _: ()
    ) -> tuple[Formula, ...]:
        """Return the terms of a sum as formulas with their signs, between which a line may break.

        An expression that is not a sum is its only term. Forms for numerics (`Slope`, `UnevaluatedQuotient`) are
        removed. list_tokens: returns the highlighting tokens of a term; the default returns none.
        """
        expression = remove_numerical_forms(sp.sympify(expression))
        signs = self._text.split_signed_terms(expression)
        return tuple(
            Formula(
                sign + self._latex.print_breakable_formula(term),
                sign.replace("{}", "") + self._text.doprint(term),
                list_tokens(term),
            )
            for sign, term in signs
        )

    @cached_property
    def _latex(self) -> TexPrinter:
        """Return the LaTeX printer of the notation."""
        return TexPrinter(self.names, self.order)

    @cached_property
    def _text(self) -> TextPrinter:
        """Return the text printer of the notation."""
        return TextPrinter({symbol: name.text for symbol, name in self.names.items()}, self.order)


def make_notation(model: Model) -> Notation:
    """Return the notation of a model, in which every symbol has a unique name, by the conventions of docs/physics.md.

    The order of the terms of sums follows the order of the bodies.
    """
    order = {s: body.index for body in model.bodies for s in (*body.q, *body.v)}
    for symbol in list_rotated_components(model):  # after the coordinates of their body
        order[symbol] = 1 + min(order[q] for q in model.symbols.derivative_rules[symbol])
    names, primed_symbols = _assign_unique_names(model)
    return Notation(model.symbols, names, frozenset(_list_shown_symbols(model)), order, primed_symbols)


def _assign_unique_names(model: Model) -> tuple[dict[sp.Symbol, Formula], tuple[PrimedSymbol, ...]]:
    """Return ({symbol: unique name}, symbols with primes) of a model.

    A proposed name that an earlier symbol or the theory (theory.py) uses gets primes.
    """
    names: dict[sp.Symbol, Formula] = {}
    used_symbol_names, primed_symbols = collect_theory_symbols(model), list[PrimedSymbol]()
    for symbol, proposed_name in _propose_names(model):
        if isinstance(symbol, sp.Symbol) and symbol not in names:
            names[symbol], meaning = add_primes(proposed_name, used_symbol_names), _describe_symbol(model, symbol)
            if names[symbol] != proposed_name:
                primed_symbols.append(
                    PrimedSymbol(names[symbol], meaning, proposed_name, used_symbol_names[proposed_name.text])
                )
            used_symbol_names[names[symbol].text] = meaning
    return names, tuple(primed_symbols)


def _describe_symbol(model: Model, symbol: sp.Symbol) -> str:
    """Return the meaning of a symbol, such as its address in the file; its identifier if no meaning is stored."""
    info = model.symbols.info.get(symbol)
    return (info.meaning if info else "") or get_document_name(symbol)


def _propose_names(model: Model) -> Iterator[tuple[sp.Symbol, Formula]]:
    """Yield (symbol, proposed name) of all symbols of a model; names may repeat, and the first symbol keeps a name.

    The order is: time, coordinates, drives, parameters of the file with user-defined ones last, derived parameters,
    temporaries of force elements, distances of drives, rotated components.
    """
    yield model.t, make_symbol_name("t")
    for body in model.bodies:
        for quantity, symbol in zip(("x", "y", "theta", "vx", "vy", "omega"), (*body.q, *body.v), strict=True):
            base, dots = _RATES.get(quantity, (quantity, 0))
            yield symbol, make_symbol_name(base, body.name, dots=dots)
    for drive, symbols in model.constraints.drive_functions.items():
        for dots, symbol in enumerate(symbols):
            yield symbol, make_symbol_name("f", drive, dots=dots)
    entries = [*model.parameter_table.entries.values()]
    for entry in sorted(entries, key=lambda e: e.address.startswith("parameters.")):
        yield entry.symbol, name_parameter(entry.address)
    for symbol in model.parameter_table.derived:
        yield symbol, _name_derived_parameter(model, symbol)
    for symbol in list_intermediate_symbols(model):
        yield symbol, _name_intermediate_quantity(model.symbols.info[symbol].meaning)
    for symbol in list_drive_distances(model):
        yield symbol, _name_drive_distance(get_document_name(symbol))
    for symbol in list_rotated_components(model):
        component = model.geometry.rotated_components.get(symbol)
        if component is None:
            yield symbol, make_symbol_name(get_document_name(symbol))
        elif component.point:
            yield symbol, make_symbol_name("s", component.axis, component.body, component.point)
        else:  # the first direction of a body has no number
            number = [str(component.number)] if component.number > 1 else []
            yield symbol, make_symbol_name("u", component.axis, component.body, *number)


def name_parameter(address: str) -> Formula:
    """Return the name of a parameter by its address: "bodies.L1.length" is l with the subscript L1.

    An address of another form becomes a word, with "_" for ".".
    """
    match address.split("."):
        case ["parameters", name]:
            return make_user_symbol_name(name)
        case ["baumgarte", gain]:
            return make_symbol_name(gain)
        case ["gravity", axis]:
            return make_symbol_name("g", axis)
        case ["ground", point, axis]:
            return make_symbol_name(axis, point)
        case ["bodies", body, "com", axis]:
            return make_symbol_name({"x": "xi", "y": "eta"}[axis], body, "com")
        case ["bodies", body, "points", point, axis]:
            return make_symbol_name({"x": "xi", "y": "eta"}[axis], body, point)
        case ["bodies", body, "sides", sides]:
            return make_symbol_name("l", body, sides)
        case ["bodies", body, "sides", point, axis]:
            return make_symbol_name({"x": "xi", "y": "eta"}[axis], body, point)
        case ["materials", material, constant]:
            return make_symbol_name(get_field_symbol(constant), material)
        case ["bearings", bearing, "length"]:
            return make_symbol_name("L", bearing)
        case ["bearings", bearing, "bearing_material" | "journal_material" as role, constant]:
            return make_symbol_name(constant, "j" if role == "journal_material" else "i", bearing)
        case ["guides", guide, "guide_material" | "slider_material" as role, constant]:
            return make_symbol_name(constant, "j" if role == "slider_material" else "i", guide)
        case ["bodies", body, "shape", "rectangle", axis]:
            return make_symbol_name({"x": "a", "y": "b"}[axis], body)
        case ["bodies", body, "shape", *_, field]:
            return make_symbol_name(get_field_symbol(field), body)
        case ["contacts", contact, *rest]:
            return make_symbol_name(rest[-1], contact)
        case ["start", _, body, coordinate]:
            base, dots = _RATES.get(coordinate, (coordinate, 0))
            return make_symbol_name(base, body, dots=dots, superscript="0")
        case [_, owner, field]:
            return (
                make_symbol_name(_UNSTRESSED[field], owner, superscript="0")
                if field in _UNSTRESSED
                else make_symbol_name(get_field_symbol(field), owner)
            )
        case [_, owner, field, axis]:
            axis = {"x": "1", "y": "2"}[axis] if field == "radii" else axis
            return make_symbol_name(get_field_symbol(field), axis, owner)
    return make_symbol_name(address.replace(".", "_"))


def get_field_symbol(field: str) -> str:
    """Return the symbol of a field by its name, "m" for "mass"; a field without one keeps its name."""
    return _ONE_LETTER.get(field, field)


def _name_derived_parameter(model: Model, symbol: sp.Symbol) -> Formula:
    """Return the name of a derived parameter: the letter of its quantity with the joint or element as subscript.

    Components of unit vectors get an axis and a hat. A parameter without an owner keeps its identifier.
    """
    owner_info = model.parameter_table.roles.get(symbol)
    if owner_info is None:
        return make_symbol_name(get_document_name(symbol))
    return make_symbol_name(
        get_field_symbol(owner_info.quantity),
        *([owner_info.axis] if owner_info.axis else []),
        owner_info.owner,
        hat=bool(owner_info.axis),
    )


def _name_intermediate_quantity(meaning: str) -> Formula:
    """Return the name of a temporary of a force element from its meaning, "span_x of coil": Δ_x,coil."""
    quantity, _, owner = meaning.partition(" of ")
    base, _, axis = quantity.rpartition("_")
    if axis not in ("x", "y"):
        base, axis = quantity, ""
    base_letter, dots = _TEMPORARY.get(base, (base, 0))
    return make_symbol_name(base_letter, *([axis] if axis else []), owner, dots=dots)


def _name_drive_distance(name: str) -> Formula:
    """Return the name of a component of the vector that a distance drive prescribes, from its identifier in C.

    name: for a drive `pull`, "pull_span_x" (Δ_x), "pull_length" (l) or "pull_along_x" (unit vector ê_x).
    """
    for marker, base, hat in (("_span_", "Delta", False), ("_along_", "e", True)):
        owner, is_found, axis = name.rpartition(marker)
        if is_found:
            return make_symbol_name(base, axis, owner, hat=hat)
    return make_symbol_name("l", name.removesuffix("_length"))


def list_drive_distances(model: Model) -> list[sp.Symbol]:
    """Return the symbols of vector, length and direction between the two points of each distance drive."""
    meanings = ("span", "its length", "its direction")
    return [s for s in model.symbols.definitions if model.symbols.info[s].meaning in meanings]


def list_intermediate_symbols(model: Model) -> list[sp.Symbol]:
    """Return the symbols of intermediate quantities of force elements, such as a spring's length and force.

    They are the symbols with a definition, without those that are read from a storage location (parameters), angles
    and distances of drives, and symbols with derivative rules: sines, cosines and components of rotated vectors.
    """
    excluded = {symbol for symbols in model.constraints.drive_functions.values() for symbol in symbols}
    excluded.update(list_drive_distances(model), model.symbols.derivative_rules)
    return [s for s in model.symbols.definitions if not model.symbols.info[s].storage_location and s not in excluded]


def list_rotated_components(model: Model) -> list[sp.Symbol]:
    """Return the symbols of components of vectors that rotate with a body: lever arms and directions.

    Sines and cosines themselves, and angles and distances of drives, are left out.
    """
    excluded = {symbol for symbols in model.constraints.drive_functions.values() for symbol in symbols}
    excluded.update(list_drive_distances(model))
    return [
        symbol
        for symbol, value in model.symbols.definitions.items()
        if symbol in model.symbols.derivative_rules
        and symbol not in excluded
        and not isinstance(value, (sp.cos, sp.sin))
    ]


def _list_shown_symbols(model: Model) -> Iterator[sp.Symbol]:
    """Yield the derived symbols that equations show by their own name instead of their definition.

    They are rotated components that are sums, distances of drives, drives above MAX_DRIVE_OPERATIONS, constants of
    laws, derived parameters above MAX_CONSTANT_OPERATIONS, and temporaries of force elements.
    """
    definitions = model.symbols.definitions
    yield from (symbol for symbol in list_rotated_components(model) if definitions[symbol].is_Add)
    yield from list_drive_distances(model)
    for symbols in model.constraints.drive_functions.values():
        if sp.count_ops(definitions[symbols[0]]) > MAX_DRIVE_OPERATIONS:
            yield from symbols
    for clearance in model.clearances:
        yield from (value for value in clearance.constants.values() if value in definitions)
    for symbol, value in model.parameter_table.derived.items():
        if sp.count_ops(value) > MAX_CONSTANT_OPERATIONS and symbol not in model.parameter_table.internal_parameters:
            yield symbol
    yield from list_intermediate_symbols(model)

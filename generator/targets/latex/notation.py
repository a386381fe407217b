"""Names the symbols of one model, and selects those that are written out."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.ir.finite_slopes import for_readers
from gudgeon.generator.symbols.symbols import Symbols, plain_name
from gudgeon.generator.targets.latex.letters import Name, letter, primed, word
from gudgeon.generator.targets.latex.printers import TexPrinter, TextPrinter
from gudgeon.generator.targets.latex.theory import theory

LONG_DRIVE = 8  # operations beyond which a drive's value keeps a letter of its own
LONG_CONSTANT = 4  # the same for what is computed once a run

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
_FREE = {"free_length": "l", "free_angle": "theta"}
_TEMPORARY = {
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
    """Represent a symbol that has a prime because its letter is used for another one."""

    name: Name
    what: str
    letter: Name
    other: str


@dataclass(frozen=True)
class Notation:
    """Contain the names of symbols; `kept` are derived symbols that equations show by their own letter."""

    symbols: Symbols
    names: Mapping[sp.Symbol, Name]
    kept: frozenset[sp.Symbol]
    order: Mapping[sp.Symbol, int]  # coordinates and velocities by body: the order of a sum's terms
    gave_way: tuple[PrimedSymbol, ...] = ()  # in the order of the file

    def called(self, names: Mapping[sp.Symbol, Name]) -> Notation:
        """Return the notation with other names for some symbols, for example inside the section of a joint."""
        return replace(self, names={**self.names, **names})

    def expand(self, expression: sp.Expr) -> sp.Expr:
        """Return `expression` with derived symbols written out, except those that are kept."""
        definitions = self.symbols.definitions
        while found := {s: definitions[s] for s in expression.free_symbols if s in definitions and s not in self.kept}:
            expression = expression.xreplace(found)
        return expression

    def math(self, expression: sp.Expr) -> Name:
        """Return an expression as a formula."""
        expression = for_readers(sp.sympify(expression))
        return Name(self._latex.doprint(expression), self._text.doprint(expression))

    def terms(self, expression: sp.Expr, of: Callable[[sp.Expr], Sequence[str]] = lambda _: ()) -> tuple[Name, ...]:
        """Return the terms of a sum with signs; a line may break between them. `of`: the tokens of a term."""
        expression = for_readers(sp.sympify(expression))
        signs = self._text.signed_terms(expression)
        return tuple(
            Name(sign + self._latex.long(term), sign.replace("{}", "") + self._text.doprint(term), of(term))
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
    """Return the notation of physics.md for a model, in which every symbol has a unique name."""
    order = {s: body.index for body in model.bodies for s in (*body.q, *body.v)}
    for symbol in turned(model):  # behind the coordinates of their body
        order[symbol] = 1 + min(order[q] for q in model.symbols.rules[symbol])
    names, gave_way = _apart(model)
    return Notation(model.symbols, names, frozenset(_kept(model)), order, gave_way)


def _apart(model: Model) -> tuple[dict[sp.Symbol, Name], tuple[PrimedSymbol, ...]]:
    """Return a unique name for each symbol: those after another, or after the theory, have primes."""
    names: dict[sp.Symbol, Name] = {}
    used, gave_way = theory(model), list[PrimedSymbol]()
    for symbol, expected in _names(model):
        if isinstance(symbol, sp.Symbol) and symbol not in names:
            names[symbol], what = primed(expected, used), _what(model, symbol)
            if names[symbol] != expected:
                gave_way.append(PrimedSymbol(names[symbol], what, expected, used[expected.text]))
            used[names[symbol].text] = what
    return names, tuple(gave_way)


def _what(model: Model, symbol: sp.Symbol) -> str:
    """Return what a symbol is: its address in the file, or its meaning."""
    info = model.symbols.info.get(symbol)
    return (info.meaning if info else "") or plain_name(symbol)


def _names(model: Model) -> Iterator[tuple[sp.Symbol, Name]]:
    """Yield symbols and names, fixed letters first, so that user-defined names give way."""
    yield model.t, letter("t")
    for body in model.bodies:
        for what, symbol in zip(("x", "y", "theta", "vx", "vy", "omega"), (*body.q, *body.v), strict=True):
            base, dots = _RATES.get(what, (what, 0))
            yield symbol, letter(base, body.name, dots=dots)
    for drive, symbols in model.constraints.drive_angles.items():
        for dots, symbol in enumerate(symbols):
            yield symbol, letter("f", drive, dots=dots)
    entries = [*model.slots.entries.values()]
    for entry in sorted(entries, key=lambda e: e.address.startswith("parameters.")):
        yield entry.symbol, of_address(entry.address)
    for symbol in model.slots.derived:
        yield symbol, _constant(model, symbol)
    for symbol in temporaries(model):
        yield symbol, _temporary(model.symbols.info[symbol].meaning)
    for symbol in spans(model):
        yield symbol, _span(plain_name(symbol))
    for symbol in turned(model):
        of = model.geometry.turned.get(symbol)
        if of is None:
            yield symbol, letter(plain_name(symbol))
        elif of.point:
            yield symbol, letter("s", of.axis, of.body, of.point)
        else:  # numbered from a body's second one on
            yield symbol, letter("u", of.axis, of.body, *([str(of.number)] if of.number > 1 else []))


def of_address(address: str) -> Name:
    """Return the letter of a parameter by its address: "bodies.L1.length" is l with the subscript L1."""
    match address.split("."):
        case ["parameters", name]:
            return word(name)
        case ["baumgarte", gain]:
            return letter(gain)
        case ["gravity", axis]:
            return letter("g", axis)
        case ["ground", point, axis]:
            return letter(axis, point)
        case ["bodies", body, "com", axis]:
            return letter({"x": "xi", "y": "eta"}[axis], body, "com")
        case ["bodies", body, "points", point, axis]:
            return letter({"x": "xi", "y": "eta"}[axis], body, point)
        case ["bodies", body, "sides", sides]:
            return letter("l", body, sides)
        case ["bodies", body, "sides", point, axis]:
            return letter({"x": "xi", "y": "eta"}[axis], body, point)
        case ["materials", material, constant]:
            return letter(letter_of_field(constant), material)
        case ["bearings", bearing, "length"]:
            return letter("L", bearing)
        case ["bearings", bearing, "bearing_material" | "journal_material" as role, constant]:
            return letter(constant, "j" if role == "journal_material" else "i", bearing)
        case ["guides", guide, "guide_material" | "slider_material" as role, constant]:
            return letter(constant, "j" if role == "slider_material" else "i", guide)
        case ["bodies", body, "shape", "rectangle", axis]:
            return letter({"x": "a", "y": "b"}[axis], body)
        case ["bodies", body, "shape", *_, field]:
            return letter(letter_of_field(field), body)
        case ["contacts", contact, *rest]:
            return letter(rest[-1], contact)
        case ["start", _, body, coordinate]:
            base, dots = _RATES.get(coordinate, (coordinate, 0))
            return letter(base, body, dots=dots, raised="0")
        case [_, owner, field]:
            return letter(_FREE[field], owner, raised="0") if field in _FREE else letter(letter_of_field(field), owner)
        case [_, owner, field, axis]:
            axis = {"x": "1", "y": "2"}[axis] if field == "radii" else axis
            return letter(letter_of_field(field), axis, owner)
    return letter(address.replace(".", "_"))


def letter_of_field(field: str) -> str:
    """Return the letter of a field."""
    return _ONE_LETTER.get(field, field)


def _constant(model: Model, symbol: sp.Symbol) -> Name:
    """Return the name of a derived parameter, by the joint or element to which it belongs."""
    of = model.slots.of_owner.get(symbol)
    if of is None:
        return letter(plain_name(symbol))
    return letter(letter_of_field(of.what), *([of.axis] if of.axis else []), of.owner, hat=bool(of.axis))


def _temporary(meaning: str) -> Name:
    """Return the name of a temporary of a force element, "span_x of coil"."""
    what, _, owner = meaning.partition(" of ")
    base, _, axis = what.rpartition("_")
    if axis not in ("x", "y"):
        base, axis = what, ""
    sign, dots = _TEMPORARY.get(base, (base, 0))
    return letter(sign, *([axis] if axis else []), owner, dots=dots)


def _span(name: str) -> Name:
    """Return the name of a distance that a drive prescribes: "pull_span_x", "pull_length", "pull_along_x"."""
    for what, base, hat in (("_span_", "Delta", False), ("_along_", "e", True)):
        owner, found, axis = name.rpartition(what)
        if found:
            return letter(base, axis, owner, hat=hat)
    return letter("l", name.removesuffix("_length"))


def spans(model: Model) -> list[sp.Symbol]:
    """Yield the symbols of distances that drives prescribe, with their directions."""
    meanings = ("span", "its length", "its direction")
    return [s for s in model.symbols.definitions if model.symbols.info[s].meaning in meanings]


def temporaries(model: Model) -> list[sp.Symbol]:
    """Yield the symbols of parts of force elements: locals that are neither angle, arm nor drive."""
    others = {symbol for symbols in model.constraints.drive_angles.values() for symbol in symbols}
    others.update(spans(model), model.symbols.rules)
    return [s for s in model.symbols.definitions if not model.symbols.info[s].home and s not in others]


def turned(model: Model) -> list[sp.Symbol]:
    """Yield the components of arms and directions that rotate with a body."""
    others = {symbol for symbols in model.constraints.drive_angles.values() for symbol in symbols}
    others.update(spans(model))
    return [
        symbol
        for symbol, value in model.symbols.definitions.items()
        if symbol in model.symbols.rules and symbol not in others and not isinstance(value, (sp.cos, sp.sin))
    ]


def _kept(model: Model) -> Iterator[sp.Symbol]:
    """Yield the derived symbols that equations show by their own letter."""
    definitions = model.symbols.definitions
    yield from (symbol for symbol in turned(model) if definitions[symbol].is_Add)
    yield from spans(model)
    for symbols in model.constraints.drive_angles.values():
        if sp.count_ops(definitions[symbols[0]]) > LONG_DRIVE:
            yield from symbols
    for clearance in model.clearances:
        yield from (value for value in clearance.constants.values() if value in definitions)
    for symbol, value in model.slots.derived.items():
        if sp.count_ops(value) > LONG_CONSTANT and symbol not in model.slots.unwritten:
            yield symbol
    yield from temporaries(model)

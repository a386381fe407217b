"""Writes one force law by itself: its equations for each of its options, its keys, validity and reference."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.field import NUMBER, Field
from gudgeon.generator.kinds.laws.built import PAIR, probe
from gudgeon.generator.kinds.laws.law import Law
from gudgeon.generator.symbols.symbols import Symbols
from gudgeon.generator.targets.format_tables import condition
from gudgeon.generator.targets.latex.document import (
    Block,
    Document,
    Equation,
    Section,
    cells,
    paragraph,
    sentence,
    table,
)
from gudgeon.generator.targets.latex.kinematics import equation
from gudgeon.generator.targets.latex.letters import Name, distinct, letter, of_latex, word
from gudgeon.generator.targets.latex.notation import Notation
from gudgeon.generator.targets.latex.play import as_word, describe_states
from gudgeon.generator.targets.latex.play_letters import LAW_LETTERS, NAMES, RATIO, sign_of, step_name
from gudgeon.generator.targets.latex.render import render
from gudgeon.language.plot_units import pretty
from gudgeon.language.units import si_unit

_ROLES: Mapping[str, str] = {
    "normal": "the normal force",
    "friction": "dry friction",
    "film": "the oil film",
    "mixed": "mixed lubrication",
}
GIVEN = "given"  # what is chosen of a number that may be left out
# What a law is given and gives: meaning, SI unit.
_MEANINGS: Mapping[str, tuple[str, str]] = {
    "delta": ("penetration", "m"),
    "ratio": ("rate of penetration over that at the onset", "-"),
    "deltadot": ("rate of penetration", "m/s"),
    "held_force": ("force that keeps a contact closed, found by the run", "N"),
    "F_n": ("normal force, which pushes the surfaces apart", "N"),
    "v_t": ("slip of the journal's surface on the bearing's, along t", "m/s"),
    "epsilon": ("eccentricity over the film's clearance", "-"),
    "w_n": ("effective squeeze velocity along n over the clearance", "1/s"),
    "w_t": ("the same along t", "1/s"),
    "F_r": ("force on the journal along n, from the bearing's centre to the journal's", "N"),
    "F_t": ("force on the journal along t, n turned by +90°", "N"),
    "share": ("share of the dry contact in force and moments; the rest is the film's", "-"),
    "T0": ("shear torque by the difference of the angular velocities", "N·m·s"),
    "R_i": ("radius of the bearing", "m"),
    "R_j": ("radius of the journal", "m"),
    "c": ("radial clearance", "m"),
    "L": ("length of the bearing", "m"),
    "E_i": ("modulus of elasticity of the bearing", "Pa"),
    "E_j": ("the same of the journal", "Pa"),
    "nu_i": ("Poisson's ratio of the bearing", "-"),
    "nu_j": ("the same of the journal", "-"),
}


@dataclass(frozen=True)
class Form:
    """Represent a law for one choice of its options: the choice, and its equations, constants of a run first."""

    selected: Mapping[str, str | bool]
    constants: tuple[Equation, ...]
    steps: tuple[Equation, ...]
    used: tuple[tuple[str, Name], ...]  # what it is given and gives, by the name in Python

    @property
    def equations(self) -> tuple[Equation, ...]:
        """Return all equations: constants, then steps."""
        return self.constants + self.steps


def forms(law: Law, name: str) -> list[Form]:
    """Return a law under one of its names with default options, then the equations that each other choice changes.

    Optional numbers are left out unless they are chosen. Raises LawError for a user-defined law.
    """
    made = law.also.get(name, {})
    defaults = {own.name: own.choice for own in law.options} | {**made}
    needed = [own.name for own in law.parameters if not _may_lack(own)]
    nothing = {name for name, value in probe(law, defaults, needed).steps.items() if value == 0}
    first = _form(law, {}, defaults, (), nothing)
    known = {in_a_line(one) for one in first.equations}
    found = [first]
    selected: list[tuple[str, str | bool]] = [
        (own.name, value) for own in law.options if own.name not in made for value in own.values if value != own.choice
    ]
    for key, value in (*selected, *((own.name, GIVEN) for own in law.parameters if _may_lack(own))):
        number = key not in defaults
        options, given = defaults if number else {**defaults, key: value}, (key,) if number else ()
        form = _form(law, {key: value}, options, given, nothing)
        found.append(replace(form, constants=_new(form.constants, known), steps=_new(form.steps, known)))
    return found


def _new(some: Sequence[Equation], known: Set[str]) -> tuple[Equation, ...]:
    """Return the equations that are not yet known."""
    return tuple(one for one in some if in_a_line(one) not in known)


def law_text(law: Law, name: str) -> str:
    """Return the description of a law under one of its names as plain Unicode text, 100 columns wide.

    Raises LawError.
    """
    return render(_document(law, name), "txt")


def _document(law: Law, name: str) -> Document:
    """Return the document about a law."""
    first, *others = forms(law, name)
    made = ", ".join(f"{key}: {value}" for key, value in law.also.get(name, {}).items())
    facts = [(f"A law of {_ROLES[law.role]}, {name}" + (f": {law.name} with {made}" if made else ""),)]
    if law.also and not made:
        facts.append((f"also as {', '.join(law.also)}",))
    own = law.fields_as(name)
    blocks: Mapping[str, Iterable[Block]] = {
        "Equations": _equations(law, first, others),
        "Other choices": _choices(others),
        "Numbers": table(
            cells("key", "letter", "unit", "bounds", "default", "meaning"),
            [_number(field) for field in own if field.kind == NUMBER],
            (5,),
        ),
        "Options": [_option(field) for field in own if field.kind != NUMBER],
        "Validity": [paragraph(sentence(law.validity))],
        "Reference": _references(law, name),
    }
    found = {title: tuple(some) for title, some in blocks.items()}
    return Document(law.title, tuple(facts), tuple(Section(title, some) for title, some in found.items() if some))


def _equations(law: Law, form: Form, others: Sequence[Form]) -> Iterator[Block]:
    """Yield the blocks with the letters and equations of a law."""
    used = {name: called for some in (*reversed(others), form) for name, called in some.used}
    rows = [cells(used[name], *_MEANINGS[name]) for name in _MEANINGS if name in used]
    yield from table(cells("letter", "meaning", "unit"), rows)
    yield from describe_states(law)
    if form.constants:
        yield paragraph("Once a run:")
        yield from form.constants
    yield paragraph("At each evaluation:")
    yield from form.steps


def _choices(others: Sequence[Form]) -> Iterator[Block]:
    """Yield the blocks with the equations of other choices."""
    for form in others:
        if form.equations:
            message = ", ".join(f"{key}: {as_word(value)}" for key, value in form.selected.items())
            yield paragraph(f"With {message}:")
            yield from form.equations


def _number(own: Field) -> tuple[tuple[str | Name, ...], ...]:
    """Return the table row of a number of a law."""
    unit = "any" if own.dimension is None else pretty(si_unit(own.dimension)) or "-"
    default = "needed" if own.required else "-" if own.default is None else f"{own.default:g}"
    meaning = f"{own.meaning}; without it {own.otherwise}" if own.otherwise else own.meaning
    return cells(own.name, of_latex(sign_of(own)), unit, condition(own).replace("`", "") or "-", default, meaning)


def _option(own: Field) -> Block:
    """Return the paragraph on an option of a law."""
    words = ", ".join(map(as_word, own.values))
    return paragraph(f"{own.name}: {words}; without it {as_word(own.choice)} ({own.meaning}).")


def _references(law: Law, name: str) -> Iterator[Block]:
    """Yield the references of the law and of words of its options that have a source."""
    yield paragraph(f"{law.reference or law.source}.")
    made = law.also.get(name, {})
    for own in law.options:
        for value, source in (own.sources or {}).items():
            if made.get(own.name, value) == value:
                yield paragraph(f"{own.name}: {value}: {source}.")


def _may_lack(own: Field) -> bool:
    """Return whether a key is optional and has no default."""
    return own.default is None and not own.required


def _form(
    law: Law,
    selected: Mapping[str, str | bool],
    options: Mapping[str, str | bool],
    given: Sequence[str],
    nothing: Set[str],
) -> Form:
    """Return a law's equations in letters of its own, without constants that only repeat a number."""
    numbers = [own.name for own in law.parameters if not _may_lack(own) or own.name in given]
    made = probe(law, options, numbers)
    same = {_probed(name): value for name, value in made.derived.items() if value.is_Symbol}

    def plain(value: sp.Expr) -> sp.Expr:
        """Return a value with repeated constants replaced by their numbers."""
        while value.free_symbols & {*same}:
            value = value.xreplace(same)
        return value

    names = _plain(distinct(_names(law, numbers, made.derived, made.steps)))
    notation = Notation(Symbols(), names, frozenset(), {})
    constants = {_probed(name): plain(value) for name, value in made.derived.items() if _probed(name) not in same}
    steps = {
        sp.Symbol(name, real=True): plain(value)
        for name, value in made.steps.items()
        if value != 0 or name not in nothing
    }
    found = [value.free_symbols for value in (*constants.values(), *steps.values())]
    read = {step for step, value in steps.items() if value != 0}.union(*found)
    places = {name: sp.Symbol(name, real=True) for name in (*law.variables, *law.results)}
    places |= {name: _probed(name) for name in PAIR}
    used = tuple(
        (name, notation.math(symbol)) for name, symbol in places.items() if symbol in read and name in _MEANINGS
    )

    def written(some: Mapping[sp.Symbol, sp.Expr]) -> tuple[Equation, ...]:
        """Return definitions as equations."""
        return tuple(equation(left, right, notation) for left, right in some.items())

    return Form(selected, written(constants), written(steps), used)


def _names(
    law: Law, numbers: Sequence[str], constants: Mapping[str, sp.Expr], steps: Mapping[str, sp.Expr]
) -> Iterator[tuple[sp.Symbol, Name]]:
    """Return the names of symbols; fixed letters come first, the law's own abbreviations give way."""
    own = {parameter.name: parameter for parameter in law.parameters}
    for name in law.variables:
        symbol = sp.Symbol(name, real=True)
        yield symbol, RATIO if name == "ratio" else NAMES.get(symbol) or letter(name)
    for name in law.results:
        symbol = sp.Symbol(name, real=True)
        if name in ("F_n", "F_r", "F_t"):
            yield symbol, NAMES.get(symbol) or letter("F", "t")
    for name in numbers:
        yield _probed(name), of_latex(sign_of(own[name]))
    for name in PAIR:
        head, _, index = name.partition("_")
        yield _probed(name), letter(head, index) if index else letter(head)
    for name in constants:
        yield _probed(name), LAW_LETTERS.get(name) or word(name)
    for name in steps:
        yield sp.Symbol(name, real=True), step_name(law, name)


def _plain(names: Mapping[sp.Symbol, Name]) -> dict[sp.Symbol, Name]:
    """Return the name of a symbol that gave way: its own, not that of its symbol here."""
    used = {name.text for name in names.values()}
    found = dict(names)
    for symbol, name in names.items():
        own = letter(symbol.name.removeprefix(_probed("").name))
        if name == letter(symbol.name) and own.text not in used:
            found[symbol] = own
    return found


def _probed(name: str) -> sp.Symbol:
    """Return the symbol of a number in the result of `probe`."""
    return sp.Symbol(f"probe_{name}", real=True)


def in_a_line(one: Equation) -> str:
    """Return an equation as plain text."""
    return f"{one.left.text} = {''.join(term.text for term in one.terms)}"

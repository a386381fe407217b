"""Writes the description of one force law: its equations for each of its options, its keys, validity and reference."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.field import NUMBER, Field
from gudgeon.generator.kinds.laws.built import PAIR_QUANTITIES, probe_law
from gudgeon.generator.kinds.laws.law import Law
from gudgeon.generator.symbols.symbols import Symbols
from gudgeon.generator.targets.format_tables import describe_condition
from gudgeon.generator.targets.latex.document import (
    Block,
    Document,
    Equation,
    Section,
    make_paragraph,
    make_row,
    make_sentence,
    make_tables,
)
from gudgeon.generator.targets.latex.kinematics import make_equation
from gudgeon.generator.targets.latex.letters import (
    Formula,
    assign_unique_names,
    make_name_from_latex,
    make_symbol_name,
    make_user_symbol_name,
)
from gudgeon.generator.targets.latex.notation import Notation
from gudgeon.generator.targets.latex.play import describe_internal_states, format_option
from gudgeon.generator.targets.latex.play_letters import (
    LAW_SYMBOL_NAMES,
    NAMES,
    RATIO,
    get_latex_symbol,
    name_law_variable,
)
from gudgeon.generator.targets.latex.render import render_document
from gudgeon.language.plot_units import format_unit
from gudgeon.language.units import find_si_unit

_ROLES: Mapping[str, str] = {
    "normal": "the normal force",
    "friction": "dry friction",
    "film": "the oil film",
    "mixed": "mixed lubrication",
}
GIVEN = "given"  # the choice of an optional number: the file specifies it
# Inputs and results of laws: meaning, SI unit.
_MEANINGS: Mapping[str, tuple[str, str]] = {
    "delta": ("penetration", "m"),
    "ratio": ("rate of penetration divided by its value at the onset", "-"),
    "deltadot": ("rate of penetration", "m/s"),
    "held_force": ("force that keeps a contact closed, computed by the run", "N"),
    "F_n": ("normal force, which pushes the surfaces apart", "N"),
    "v_t": ("slip of the journal's surface on the bearing's, along t", "m/s"),
    "epsilon": ("eccentricity divided by the film's clearance", "-"),
    "w_n": ("effective squeeze velocity along n divided by the clearance", "1/s"),
    "w_t": ("effective squeeze velocity along t divided by the clearance", "1/s"),
    "F_r": ("force on the journal along n, from the bearing's centre to the journal's", "N"),
    "F_t": ("force on the journal along t, n turned by +90°", "N"),
    "share": ("weight of the dry contact in force and moments; the film has the rest to 1", "-"),
    "T0": ("shear torque divided by the difference of the angular velocities", "N·m·s"),
    "R_i": ("radius of the bearing", "m"),
    "R_j": ("radius of the journal", "m"),
    "c": ("radial clearance", "m"),
    "L": ("length of the bearing", "m"),
    "E_i": ("modulus of elasticity of the bearing", "Pa"),
    "E_j": ("modulus of elasticity of the journal", "Pa"),
    "nu_i": ("Poisson's ratio of the bearing", "-"),
    "nu_j": ("Poisson's ratio of the journal", "-"),
}


@dataclass(frozen=True)
class EquationVariant:
    """Represent the equations of a law for one choice of its options.

    `selected`: the choice, {} for the defaults. `constants`: equations that are evaluated once per run. `evaluated`:
    equations of each evaluation. `used`: (name in Python, symbol) of inputs and results.
    """

    selected: Mapping[str, str | bool]
    constants: tuple[Equation, ...]
    evaluated: tuple[Equation, ...]
    used: tuple[tuple[str, Formula], ...]

    @property
    def equations(self) -> tuple[Equation, ...]:
        """Return all equations of the variant: constants of a run, then those of each evaluation."""
        return self.constants + self.evaluated


def derive_equation_variants(law: Law, name: str) -> list[EquationVariant]:
    """Return the equations of a law with default options, then for each other choice those that it changes.

    A choice is another value of one option, or an optional number that is specified (GIVEN). name: the law's name or
    one of its aliases, which fix options. Raises LawError for a user-defined law.
    """
    alias_options = law.also.get(name, {})
    defaults = {law_field.name: law_field.default_option for law_field in law.options} | {**alias_options}
    required_names = [law_field.name for law_field in law.parameters if not _is_optional(law_field)]
    zero_names = {
        name for name, value in probe_law(law, defaults, required_names).equations_by_name.items() if value == 0
    }
    default_variant = _derive_equation_variant(law, {}, defaults, (), zero_names)
    known_equations = {print_equation(equation) for equation in default_variant.equations}
    all_variants = [default_variant]
    selected: list[tuple[str, str | bool]] = [
        (law_field.name, value)
        for law_field in law.options
        if law_field.name not in alias_options
        for value in law_field.values
        if value != law_field.default_option
    ]
    for key, value in (
        *selected,
        *((law_field.name, GIVEN) for law_field in law.parameters if _is_optional(law_field)),
    ):
        is_number = key not in defaults
        options, chosen_names = defaults if is_number else {**defaults, key: value}, (key,) if is_number else ()
        variant = _derive_equation_variant(law, {key: value}, options, chosen_names, zero_names)
        all_variants.append(
            replace(
                variant,
                constants=_select_new_equations(variant.constants, known_equations),
                evaluated=_select_new_equations(variant.evaluated, known_equations),
            )
        )
    return all_variants


def _select_new_equations(equations: Sequence[Equation], known_equations: Set[str]) -> tuple[Equation, ...]:
    """Return the equations whose text (`print_equation`) is not in `known_equations`."""
    return tuple(equation for equation in equations if print_equation(equation) not in known_equations)


def print_law(law: Law, name: str) -> str:
    """Return the description of a law under one of its names as plain Unicode text, 100 columns wide.

    `gudgeon laws NAME` prints it. Raises LawError.
    """
    return render_document(_make_document(law, name), "txt")


def _make_document(law: Law, name: str) -> Document:
    """Return the document about a law under one of its names; sections without content are left out."""
    first, *others = derive_equation_variants(law, name)
    alias_options = ", ".join(f"{key}: {value}" for key, value in law.also.get(name, {}).items())
    facts = [
        (f"A law of {_ROLES[law.role]}, {name}" + (f": {law.name} with {alias_options}" if alias_options else ""),)
    ]
    if law.also and not alias_options:
        facts.append((f"also as {', '.join(law.also)}",))
    fields = law.list_fields_of_name(name)
    blocks: Mapping[str, Iterable[Block]] = {
        "Equations": _describe_equations(law, first, others),
        "Other choices": _describe_choices(others),
        "Numbers": make_tables(
            make_row("key", "symbol", "unit", "bounds", "default", "meaning"),
            [_list_parameter_cells(field) for field in fields if field.kind == NUMBER],
            (5,),
        ),
        "Options": [_describe_option(field) for field in fields if field.kind != NUMBER],
        "Validity": [make_paragraph(make_sentence(law.validity))],
        "Properties": [make_paragraph(make_sentence(law.properties))] if law.properties else [],
        "Reference": _describe_references(law, name),
    }
    sections = {title: tuple(section_blocks) for title, section_blocks in blocks.items()}
    return Document(
        law.title,
        tuple(facts),
        tuple(Section(title, section_blocks) for title, section_blocks in sections.items() if section_blocks),
    )


def _describe_equations(
    law: Law, default_variant: EquationVariant, other_variants: Sequence[EquationVariant]
) -> Iterator[Block]:
    """Yield the blocks on a law's default variant: table of symbols, internal states, constants and equations.

    other_variants: variants of other choices, whose inputs and results are listed in the table, too.
    """
    symbol_by_name = {
        name: symbol for variant in (*reversed(other_variants), default_variant) for name, symbol in variant.used
    }
    rows = [make_row(symbol_by_name[name], *_MEANINGS[name]) for name in _MEANINGS if name in symbol_by_name]
    yield from make_tables(make_row("symbol", "meaning", "unit"), rows)
    yield from describe_internal_states(law)
    if default_variant.constants:
        yield make_paragraph("Once per run:")
        yield from default_variant.constants
    yield make_paragraph("At each evaluation:")
    yield from default_variant.evaluated


def _describe_choices(other_variants: Sequence[EquationVariant]) -> Iterator[Block]:
    """Yield a paragraph and the changed equations for each other choice; a choice that changes none is left out."""
    for variant in other_variants:
        if variant.equations:
            choice = ", ".join(f"{key}: {format_option(value)}" for key, value in variant.selected.items())
            yield make_paragraph(f"With {choice}:")
            yield from variant.equations


def _list_parameter_cells(parameter: Field) -> tuple[tuple[str | Formula, ...], ...]:
    """Return the table row of a parameter of a law: key, symbol, unit, bounds, default, meaning."""
    unit = "any" if parameter.dimension is None else format_unit(find_si_unit(parameter.dimension)) or "-"
    default = "needed" if parameter.required else "-" if parameter.default is None else f"{parameter.default:g}"
    meaning = f"{parameter.meaning}; without it {parameter.otherwise}" if parameter.otherwise else parameter.meaning
    return make_row(
        parameter.name,
        make_name_from_latex(get_latex_symbol(parameter)),
        unit,
        describe_condition(parameter).replace("`", "") or "-",
        default,
        meaning,
    )


def _describe_option(option: Field) -> Block:
    """Return the paragraph on an option of a law: "NAME: VALUES; without it DEFAULT (MEANING)."."""
    words = ", ".join(map(format_option, option.values))
    return make_paragraph(
        f"{option.name}: {words}; without it {format_option(option.default_option)} ({option.meaning})."
    )


def _describe_references(law: Law, name: str) -> Iterator[Block]:
    """Yield the reference of the law, then those of its options' values that have a source.

    Values that the alias `name` excludes are left out.
    """
    yield make_paragraph(f"{law.reference or law.source}.")
    alias_options = law.also.get(name, {})
    for option in law.options:
        for value, source in (option.sources or {}).items():
            if alias_options.get(option.name, value) == value:
                yield make_paragraph(f"{option.name}: {value}: {source}.")


def _is_optional(parameter: Field) -> bool:
    """Return whether a key of a law is optional and has no default."""
    return parameter.default is None and not parameter.required


def _derive_equation_variant(
    law: Law,
    selected: Mapping[str, str | bool],
    options: Mapping[str, str | bool],
    chosen_names: Sequence[str],
    zero_names: Set[str],
) -> EquationVariant:
    """Return a law's equations for one choice, evaluated with symbols for its parameters (`probe_law`).

    Constants and intermediate quantities that are equal to a parameter are replaced by it.

    selected: the choice. options: the values of all options. chosen_names: optional numbers that are specified.
    zero_names: names of equations whose value is zero by default; they are left out while they are zero.
    """
    parameter_names = [
        law_field.name for law_field in law.parameters if not _is_optional(law_field) or law_field.name in chosen_names
    ]
    probed_law = probe_law(law, options, parameter_names)
    repeated_values = {
        _make_probe_symbol(name): value for name, value in probed_law.derived.items() if value.is_Symbol
    } | {
        sp.Symbol(name, real=True): value
        for name, value in probed_law.equations_by_name.items()
        if value in map(_make_probe_symbol, parameter_names) and name not in law.results
    }

    def replace_repeated_values(value: sp.Expr) -> sp.Expr:
        """Return a value with constants that are equal to a parameter replaced by the parameter, also transitively."""
        while value.free_symbols & {*repeated_values}:
            value = value.xreplace(repeated_values)
        return value

    names = _restore_law_names(
        assign_unique_names(
            _propose_symbol_names(law, parameter_names, probed_law.derived, probed_law.equations_by_name)
        )
    )
    notation = Notation(Symbols(), names, frozenset(), {})
    constants = {
        _make_probe_symbol(name): replace_repeated_values(value)
        for name, value in probed_law.derived.items()
        if _make_probe_symbol(name) not in repeated_values
    }
    equations_by_name = {
        sp.Symbol(name, real=True): replace_repeated_values(value)
        for name, value in probed_law.equations_by_name.items()
        if (value != 0 or name not in zero_names) and sp.Symbol(name, real=True) not in repeated_values
    }
    free_symbols = [value.free_symbols for value in (*constants.values(), *equations_by_name.values())]
    symbols_read = {name for name, value in equations_by_name.items() if value != 0}.union(*free_symbols)
    described_symbols = {name: sp.Symbol(name, real=True) for name in (*law.variables, *law.results)}
    described_symbols |= {name: _make_probe_symbol(name) for name in PAIR_QUANTITIES}
    used_symbols = tuple(
        (name, notation.format_expression(symbol))
        for name, symbol in described_symbols.items()
        if symbol in symbols_read and name in _MEANINGS
    )

    def make_equations(definitions: Mapping[sp.Symbol, sp.Expr]) -> tuple[Equation, ...]:
        """Return {symbol: value} as equations in the notation of the law, in the same order."""
        return tuple(make_equation(left, right, notation) for left, right in definitions.items())

    return EquationVariant(selected, make_equations(constants), make_equations(equations_by_name), used_symbols)


def _propose_symbol_names(
    law: Law, parameter_names: Sequence[str], constants: Mapping[str, sp.Expr], equations_by_name: Mapping[str, sp.Expr]
) -> Iterator[tuple[sp.Symbol, Formula]]:
    """Yield (symbol, proposed name) for a law: variables, results, parameters, pair, constants, abbreviations.

    Names may repeat; the first symbol keeps a name (`assign_unique_names`), so that fixed names come first.
    """
    parameters = {parameter.name: parameter for parameter in law.parameters}
    for name in law.variables:
        symbol = sp.Symbol(name, real=True)
        yield symbol, RATIO if name == "ratio" else NAMES.get(symbol) or make_symbol_name(name)
    for name in law.results:
        symbol = sp.Symbol(name, real=True)
        if name in ("F_n", "F_r", "F_t"):
            yield symbol, NAMES.get(symbol) or make_symbol_name("F", "t")
    for name in parameter_names:
        yield _make_probe_symbol(name), make_name_from_latex(get_latex_symbol(parameters[name]))
    for name in PAIR_QUANTITIES:
        base, _, index = name.partition("_")
        yield _make_probe_symbol(name), make_symbol_name(base, index) if index else make_symbol_name(base)
    for name in constants:
        yield _make_probe_symbol(name), LAW_SYMBOL_NAMES.get(name) or make_user_symbol_name(name)
    for name in equations_by_name:
        yield sp.Symbol(name, real=True), name_law_variable(law, name)


def _restore_law_names(names: Mapping[sp.Symbol, Formula]) -> dict[sp.Symbol, Formula]:
    """Return the names, in which the name "probe_X" of a symbol of `probe_law` becomes "X" if that is unused."""
    used_texts = {name.text for name in names.values()}
    restored = dict(names)
    for symbol, name in names.items():
        law_name = make_symbol_name(symbol.name.removeprefix(_make_probe_symbol("").name))
        if name == make_symbol_name(symbol.name) and law_name.text not in used_texts:
            restored[symbol] = law_name
    return restored


def _make_probe_symbol(name: str) -> sp.Symbol:
    """Return the symbol of a parameter, constant or property in the result of `probe_law`."""
    return sp.Symbol(f"probe_{name}", real=True)


def print_equation(equation: Equation) -> str:
    """Return an equation as one line of plain text."""
    return f"{equation.left.text} = {''.join(term.text for term in equation.terms)}"

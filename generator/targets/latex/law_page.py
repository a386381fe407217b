"""Writes docs/laws.md: every force law from its declaration, as `gudgeon laws NAME` prints it, in Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from gudgeon.generator.field import NUMBER, Field
from gudgeon.generator.kinds.laws.dissipation import DISSIPATION, EXACT, FACTORS, SOURCES, compute_delivered_restitution
from gudgeon.generator.kinds.laws.law import RESULTS, Law, find_bundled_laws
from gudgeon.generator.targets.format_tables import describe_condition
from gudgeon.generator.targets.latex.document import Equation, make_sentence
from gudgeon.generator.targets.latex.law import GIVEN, Form, derive_forms, print_equation
from gudgeon.generator.targets.latex.letters import make_name_from_latex
from gudgeon.generator.targets.latex.play import format_option
from gudgeon.generator.targets.latex.play_letters import get_latex_symbol
from gudgeon.language.plot_units import format_unit
from gudgeon.language.units import find_si_unit

SPECIFIED_RESTITUTIONS = (0.9, 0.7, 0.5)  # coefficients of restitution
_GREEK = {"omega_": "ω_", "epsilon": "ε", "sigma_1": "σ_1", "sigma": "σ_r", "Sigma": "σ_r"}
# What a choice of an option changes, and the options whose sentence needs no equations.
_CHOICES = {
    "geometry": "R_i + R_j in the equation of K becomes R_i − R_j.",
    "pulls": "the equation of F_n applies without max(0, …).",
    "shear": "the film also transmits the [shear torque](physics.md#line-of-action-and-shear-torque)"
    " M_τ = D_s (ω_j − ω_i) in N·m. D_s, in N·m·s, is D_0 for a centred journal, and c_film = c + c_a is the clearance"
    " of the film.",
    "cavitation": "the whole film contributes, with S = μ R_j L³/c_film²:",
    "as_printed": "the radial force has the sign that Chen, Gao and Wang (2022) print:",
}
_WITHOUT_EQUATIONS = {"geometry", "pulls"}
# Sentence before the equations of each law of a role. The first table of the page defines the symbols.
_SYMBOLS = "The [table at the beginning](#force-laws) defines all symbols."
_INTRODUCTIONS = {
    "normal": "The normal force F_n, in N, follows from the penetration δ, in m, and its rate δ̇, in m/s.",
    "friction": "The friction force F_t, in N, follows from the normal force F_n, in N, and the slip v_t, in m/s.",
    "film": "The components F_r and F_t of the film force, in N, follow from the eccentricity ratio ε and the effective"
    " squeeze velocity, w_n and w_t in 1/s.",
    "rigid": "In an impact of rigid surfaces, the rate of the penetration changes from δ̇⁻ to δ̇⁺, in m/s. In a closed"
    " contact, the normal force F_n, in N, is zero or the acceleration δ̈ of the penetration, in m/s², is zero.",
    "mixed": "The force F, in N, is a mean of the dry force and the film force with the weights b and 1 − b.",
}
_HEADINGS = {"normal": "The normal force", "friction": "Friction", "film": "Oil films", "mixed": "Mixed lubrication"}


# Laws that most scenes use; they are described first in their role.
_COMMON_LAWS = (
    "lankarani_nikravesh",
    "hertz",
    "kelvin_voigt",
    "modified_coulomb",
    "coulomb",
    "stribeck",
    "pinkus_sternlicht",
)


def list_laws_of_role(role: str) -> list[Law]:
    """Return the bundled laws of a role ("normal", "friction", "film", "mixed"): _COMMON_LAWS, then others by name."""
    laws = [law for law in find_bundled_laws().values() if law.role == role]
    return sorted(
        laws,
        key=lambda law: (_COMMON_LAWS.index(law.name) if law.name in _COMMON_LAWS else len(_COMMON_LAWS), law.name),
    )


def print_laws_page() -> str:
    """Return docs/laws.md below its introduction as Markdown: a heading for each role, then for each law.

    Called by `make tables`.
    """
    lines = []
    for role in RESULTS:
        laws = list_laws_of_role(role)
        lines += [f"## {_HEADINGS[role]}", ""]
        lines += [line for law in laws for line in _describe_law_in_markdown(law)]
        lines += _describe_dissipation() if role == "normal" else ()
    return "\n".join(lines)


def _describe_dissipation() -> Iterator[str]:
    """Yield the Markdown lines on the dissipation factors that several normal laws offer.

    The table has each factor a with the restitution that it delivers for three specified ones.
    """
    yield from ("## The dissipation of a normal force", "")
    yield (
        "The key `dissipation` chooses the hysteresis damping factor a of 1 + a δ̇/δ̇⁻ in the laws `esdu_78035`,"
        " `expression`, `hertz`, `johnson` and `liu`. Each column `c_e = …` gives the restitution e_r that a free"
        " impact delivers for that specified restitution c_e. The restitution e_r solves"
        " a (1 + e_r) = ln[(1 + a)/(1 − a e_r)]."
    )
    restitutions = " | ".join(f"c_e = {c_e:g}" for c_e in SPECIFIED_RESTITUTIONS)
    yield from ("", f"| `dissipation` | a | {restitutions} | source |", "|" + "---|" * 6)
    default_form, *other_forms = derive_forms(find_bundled_laws()["hertz"], "hertz")
    form_by_value = {DISSIPATION.default: default_form} | {
        form.selected.get(DISSIPATION.name): form for form in other_forms
    }
    for name in DISSIPATION.values:
        a = next(print_equation(form) for form in form_by_value[name].equations if form.left.text in ("a", "a_0"))
        formula = (
            "the a that delivers c_e, by Newton's method from Hu and Guo's factor" if name == EXACT else f"`{a[4:]}`"
        )
        e = (
            f"{c_e if name == EXACT else compute_delivered_restitution(float(FACTORS[str(name)](c_e))):.4f}"
            for c_e in SPECIFIED_RESTITUTIONS
        )
        yield f"| `{name}` | {formula} | {' | '.join(e)} | {SOURCES.get(str(name), '')} |"
    yield from (
        "",
        "These steps of Newton's method compute the factor a_4 for `dissipation: exact`, here with the force of"
        " `hertz`; `decay` is an intermediate value:",
        "",
        *_print_text_block(form_by_value[EXACT].equations),
    )


def _describe_law_in_markdown(law: Law) -> Iterator[str]:
    """Yield the Markdown lines on a law: title, other names, equations, choices, states, keys, validity and source."""
    yield from (f"### `{law.name}`", "", f"{make_sentence(law.title)}", "")
    if law.also:
        names_text = ", ".join(f"`{name}`" for name in law.also)
        yield from (f"Other names, each for `{law.name}` with the `dissipation` of that name: {names_text}.", "")
    default_form, *other_forms = derive_forms(law, law.name)
    yield from (f"{_INTRODUCTIONS['rigid' if law.rigid else law.role]} {_SYMBOLS}", "")
    yield from _print_display_equations(law) if law.equation else _print_text_block(default_form.equations)
    for form in other_forms:
        if DISSIPATION.name not in form.selected:
            yield from _describe_choice(form, law)
    if DISSIPATION in law.fields:
        yield from (
            "[The dissipation of a normal force](#the-dissipation-of-a-normal-force) lists the factor a for each"
            " value of `dissipation`.",
            "",
        )
    if law.states:
        states_text = "; ".join(
            f"The state {make_name_from_latex(state.name).text}, in m, is the {state.meaning};"
            " it is 0 at each onset of a contact"
            for state in law.states
        )
        yield from (f"{states_text}.", "")
    yield from _print_keys_table(law.fields)
    yield from _print_validity(law)
    yield from (f"**Source**: {law.reference or law.source}.", "")


def _print_validity(law: Law) -> Iterator[str]:
    """Yield the Markdown lines on the validity of a law: one sentence, or a list with an item for each clause.

    Clauses are separated by "; " in `law.validity`. The first one is completed to "the law is valid for …" if needed.
    """
    first, *others = law.validity.split("; ")
    if not first.startswith(("the law ", "the force ", "for ")):
        article = "a " if first.startswith(("long bearing", "short bearing")) else ""
        first = f"the law is valid for {article}{first}"
    clauses = [_replace_greek_names(make_sentence(clause)) for clause in (first, *others)]
    if len(clauses) == 1:
        yield from (f"**Validity**: {clauses[0]}", "")
    else:
        yield from ("**Validity**:", "", *(f"- {clause}" for clause in clauses), "")


def _replace_greek_names(text: str) -> str:
    """Return a text of a declaration with Greek letters for their English names, "epsilon" → "ε" (_GREEK).

    Declarations are ASCII, since they are also comments in C.
    """
    for name, letter in _GREEK.items():
        text = text.replace(name, letter)
    return text


def _describe_choice(form: Form, law: Law) -> Iterator[str]:
    """Yield the Markdown lines on the changes by another choice of an option: a sentence, its equations, or both.

    Nothing is yielded for a choice without either. _CHOICES has the sentences.
    """
    choice = ", ".join(
        key if value == GIVEN else f"{key}: {format_option(value)}" for key, value in form.selected.items()
    )
    explanation = " ".join(_CHOICES[key] for key in form.selected if key in _CHOICES)
    if explanation:
        yield from (f"With `{choice}`, {explanation}", "")
    if not form.equations or _WITHOUT_EQUATIONS & form.selected.keys():
        return
    if explanation:
        yield from _print_text_block(form.equations)
    elif len(form.equations) == 1:
        yield from (f"With `{choice}`, an equation becomes `{print_equation(form.equations[0])}`.", "")
    else:
        yield from (f"With `{choice}`, these equations apply:", "", *_print_text_block(form.equations))


def _print_display_equations(law: Law) -> Iterator[str]:
    """Yield the Markdown lines of the equations in `law.equation` (LaTeX of the source), each between dollar signs."""
    yield from (line for latex in law.equation for line in ("$$", latex, "$$", ""))


def _print_text_block(equations: Iterable[Equation]) -> Iterator[str]:
    """Yield equations as a Markdown block of plain text."""
    yield from ("```text", *map(print_equation, equations), "```", "")


def _print_keys_table(fields: Sequence[Field]) -> Iterator[str]:
    """Yield the lines of the Markdown table of a law's keys, then an empty line.

    Columns: key, symbol, unit, condition, default, meaning.
    """
    yield from ("| key | symbol | unit | condition | without it | meaning |", "|" + "---|" * 6)
    for parameter in fields:
        cells = _list_number_cells(parameter) if parameter.kind == NUMBER else _list_option_cells(parameter)
        yield (
            "| "
            + " | ".join(
                cell.replace("|", "\\|")
                for cell in (f"`{parameter.name}`", *cells, _replace_greek_names(parameter.meaning))
            )
            + " |"
        )
    yield ""


def _list_number_cells(parameter: Field) -> tuple[str, ...]:
    """Return the cells of a numerical key of a law: symbol, unit, condition, effect without the key.

    The last one is "needed", the default, or the words of `parameter.otherwise`.
    """
    unit = "any" if parameter.dimension is None else format_unit(find_si_unit(parameter.dimension))
    default = (
        "needed"
        if parameter.required
        else parameter.otherwise
        if parameter.default is None
        else f"{parameter.default:g}"
    )
    return make_name_from_latex(get_latex_symbol(parameter)).text, unit, describe_condition(parameter), default


def _list_option_cells(option: Field) -> tuple[str, ...]:
    """Return the cells of an option of a law: its values and its default; it has neither symbol nor unit."""
    return (
        "",
        "",
        " or ".join(f"`{format_option(value)}`" for value in option.values),
        f"`{format_option(option.default_option)}`",
    )

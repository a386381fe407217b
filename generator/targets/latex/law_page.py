"""Writes docs/laws.md: every force law from its declaration, as `gudgeon laws NAME` prints it, in Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from gudgeon.generator.field import NUMBER, Field
from gudgeon.generator.kinds.laws.dissipation import DISSIPATION, EXACT, FACTORS, SOURCES, delivered
from gudgeon.generator.kinds.laws.law import RESULTS, Law, bundled_laws
from gudgeon.generator.targets.format_tables import condition
from gudgeon.generator.targets.latex.document import Equation, sentence
from gudgeon.generator.targets.latex.law import GIVEN, Form, forms, in_a_line
from gudgeon.generator.targets.latex.letters import of_latex
from gudgeon.generator.targets.latex.play import as_word
from gudgeon.generator.targets.latex.play_letters import sign_of
from gudgeon.language.plot_units import pretty
from gudgeon.language.units import si_unit

ASKED = (0.9, 0.7, 0.5)  # coefficients of restitution
_HEADS = {"normal": "The normal force", "friction": "Friction", "film": "Oil films", "mixed": "Mixed lubrication"}


# Laws that most scenes use come first in their role; the others follow by name.
_FIRST = (
    "lankarani_nikravesh",
    "hertz",
    "kelvin_voigt",
    "modified_coulomb",
    "coulomb",
    "stribeck",
    "pinkus_sternlicht",
)


def laws_in_order(role: str) -> list[Law]:
    """Return the bundled laws of a role: first those that most scenes use, then the others by name."""
    laws = [law for law in bundled_laws().values() if law.role == role]
    return sorted(laws, key=lambda law: (_FIRST.index(law.name) if law.name in _FIRST else len(_FIRST), law.name))


def laws_page() -> str:
    """Return docs/laws.md below its introduction: a heading for each role and law, as Markdown."""
    lines = []
    for role in RESULTS:
        laws = laws_in_order(role)
        lines += [f"## {_HEADS[role]}", ""]
        lines += [line for law in laws for line in _describe_law(law)]
        lines += _describe_dissipation() if role == "normal" else ()
    return "\n".join(lines)


def _describe_dissipation() -> Iterator[str]:
    """Yield the Markdown lines on the dissipation factors that several normal laws offer.

    The table has each factor a with the restitution that it delivers for three specified ones.
    """
    yield from ("## The dissipation of a normal force", "")
    yield (
        "The factor a of 1 + a δ̇/δ̇⁻ in `esdu_78035`, `expression`, `hertz`, `johnson` and `liu`, by `dissipation`,"
        " and the restitution that a free impact then has, by a (1 + e) = ln[(1 + a)/(1 − a e)], for what c_e asks."
    )
    restitutions = " | ".join(f"c_e = {c_e:g}" for c_e in ASKED)
    yield from ("", f"| `dissipation` | a | {restitutions} | source |", "|" + "---|" * 6)
    default_form, *other_forms = forms(bundled_laws()["hertz"], "hertz")
    form_by_value = {DISSIPATION.default: default_form} | {
        form_.selected.get(DISSIPATION.name): form_ for form_ in other_forms
    }
    for name in DISSIPATION.values:
        a = next(in_a_line(form_) for form_ in form_by_value[name].equations if form_.left.text in ("a", "a_0"))
        formula = "what delivers c_e, by Newton's method from Hu and Guo's" if name == EXACT else f"`{a[4:]}`"
        e = (f"{c_e if name == EXACT else delivered(float(FACTORS[str(name)](c_e))):.4f}" for c_e in ASKED)
        yield f"| `{name}` | {formula} | {' | '.join(e)} | {SOURCES.get(str(name), '')} |"
    yield from ("", "`exact`, written out:", "", *_print_text_block(form_by_value[EXACT].equations))


def _describe_law(law: Law) -> Iterator[str]:
    """Yield the Markdown lines on one law: equations, other choices, inner states, keys, validity and source."""
    yield from (f"### `{law.name}`", "", f"{sentence(law.title)}", "")
    if law.also:
        yield from (f"Also as {', '.join(f'`{name}`' for name in law.also)}.", "")
    default_form, *other_forms = forms(law, law.name)
    yield from _print_display_equations(law) if law.equation else _print_text_block(default_form.equations)
    for form in other_forms:
        if DISSIPATION.name not in form.selected:
            yield from _describe_choice(form)
    if DISSIPATION in law.fields:
        yield from ("With another `dissipation`: [below](#the-dissipation-of-a-normal-force).", "")
    if law.states:
        states_text = "; ".join(
            f"{of_latex(state.name).text} is the {state.meaning}, 0 at each onset" for state in law.states
        )
        yield from (f"{states_text}.", "")
    yield from _print_keys_table(law.fields)
    yield from (f"**Valid**: {sentence(law.validity)}", "", f"**Source**: {law.reference or law.source}.", "")


def _describe_choice(form: Form) -> Iterator[str]:
    """Yield the equations that a choice changes: one in a line, several as a block, none for no change."""
    choice = ", ".join(key if value == GIVEN else f"{key}: {as_word(value)}" for key, value in form.selected.items())
    if len(form.equations) == 1:
        yield from (f"With `{choice}`: `{in_a_line(form.equations[0])}`.", "")
    elif form.equations:
        yield from (f"With `{choice}`:", "", *_print_text_block(form.equations))


def _print_display_equations(law: Law) -> Iterator[str]:
    """Yield the law as its source writes it, each equation displayed between dollar signs."""
    yield from (line for latex in law.equation for line in ("$$", latex, "$$", ""))


def _print_text_block(equations: Iterable[Equation]) -> Iterator[str]:
    """Yield equations as a Markdown block of plain text."""
    yield from ("```text", *map(in_a_line, equations), "```", "")


def _print_keys_table(fields: Sequence[Field]) -> Iterator[str]:
    """Yield the Markdown table of a law's keys."""
    yield from ("| key | letter | unit | condition | without it | meaning |", "|" + "---|" * 6)
    for parameter in fields:
        cells = _list_number_cells(parameter) if parameter.kind == NUMBER else _list_option_cells(parameter)
        yield (
            "| "
            + " | ".join(cell.replace("|", "\\|") for cell in (f"`{parameter.name}`", *cells, parameter.meaning))
            + " |"
        )
    yield ""


def _list_number_cells(parameter: Field) -> tuple[str, ...]:
    """Return the cells of a number: letter, unit, condition, default."""
    unit = "any" if parameter.dimension is None else pretty(si_unit(parameter.dimension))
    default = (
        "needed"
        if parameter.required
        else parameter.otherwise
        if parameter.default is None
        else f"{parameter.default:g}"
    )
    return of_latex(sign_of(parameter)).text, unit, condition(parameter), default


def _list_option_cells(option: Field) -> tuple[str, ...]:
    """Return the cells of an option of a law: its values and its default; it has neither letter nor unit."""
    return "", "", " or ".join(f"`{as_word(value)}`" for value in option.values), f"`{as_word(option.choice)}`"

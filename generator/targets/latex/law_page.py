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
    """Return the laws of a role, those that most scenes use first."""
    laws = [law for law in bundled_laws().values() if law.role == role]
    return sorted(laws, key=lambda law: (_FIRST.index(law.name) if law.name in _FIRST else len(_FIRST), law.name))


def laws_page() -> str:
    """Return docs/laws.md below its introduction: a heading for each role and law."""
    found = []
    for role in RESULTS:
        some = laws_in_order(role)
        found += [f"## {_HEADS[role]}", ""]
        found += [line for law in some for line in _of_law(law)]
        found += _damping() if role == "normal" else ()
    return "\n".join(found)


def _damping() -> Iterator[str]:
    """Yield the dissipation factors that several laws offer."""
    yield from ("## The dissipation of a normal force", "")
    yield (
        "The factor a of 1 + a δ̇/δ̇⁻ in `esdu_78035`, `expression`, `hertz`, `johnson` and `liu`, by `dissipation`,"
        " and the restitution that a free impact then has, by a (1 + e) = ln[(1 + a)/(1 − a e)], for what c_e asks."
    )
    requested = " | ".join(f"c_e = {c_e:g}" for c_e in ASKED)
    yield from ("", f"| `dissipation` | a | {requested} | source |", "|" + "---|" * 6)
    first, *others = forms(bundled_laws()["hertz"], "hertz")
    written = {DISSIPATION.default: first} | {one.selected.get(DISSIPATION.name): one for one in others}
    for name in DISSIPATION.values:
        a = next(in_a_line(one) for one in written[name].equations if one.left.text in ("a", "a_0"))
        message = "what delivers c_e, by Newton's method from Hu and Guo's" if name == EXACT else f"`{a[4:]}`"
        e = (f"{c_e if name == EXACT else delivered(float(FACTORS[str(name)](c_e))):.4f}" for c_e in ASKED)
        yield f"| `{name}` | {message} | {' | '.join(e)} | {SOURCES.get(str(name), '')} |"
    yield from ("", "`exact`, written out:", "", *_block(written[EXACT].equations))


def _of_law(law: Law) -> Iterator[str]:
    """Yield the lines on one law."""
    yield from (f"### `{law.name}`", "", f"{sentence(law.title)}", "")
    if law.also:
        yield from (f"Also as {', '.join(f'`{name}`' for name in law.also)}.", "")
    first, *others = forms(law, law.name)
    yield from _typeset(law) if law.equation else _block(first.equations)
    for form in others:
        if DISSIPATION.name not in form.selected:
            yield from _choice(form)
    if DISSIPATION in law.fields:
        yield from ("With another `dissipation`: [below](#the-dissipation-of-a-normal-force).", "")
    if law.states:
        message = "; ".join(
            f"{of_latex(state.name).text} is the {state.meaning}, 0 at each onset" for state in law.states
        )
        yield from (f"{message}.", "")
    yield from _table(law.fields)
    yield from (f"**Valid**: {sentence(law.validity)}", "", f"**Source**: {law.reference or law.source}.", "")


def _choice(form: Form) -> Iterator[str]:
    """Yield the equations that a choice changes: one in a line, several as a block."""
    message = ", ".join(key if value == GIVEN else f"{key}: {as_word(value)}" for key, value in form.selected.items())
    if len(form.equations) == 1:
        yield from (f"With `{message}`: `{in_a_line(form.equations[0])}`.", "")
    elif form.equations:
        yield from (f"With `{message}`:", "", *_block(form.equations))


def _typeset(law: Law) -> Iterator[str]:
    """Yield the law as its source writes it, a displayed equation each."""
    yield from (line for one in law.equation for line in ("$$", one, "$$", ""))


def _block(equations: Iterable[Equation]) -> Iterator[str]:
    """Yield equations as a block of text."""
    yield from ("```text", *map(in_a_line, equations), "```", "")


def _table(fields: Sequence[Field]) -> Iterator[str]:
    """Yield the table of a law's keys."""
    yield from ("| key | letter | unit | condition | without it | meaning |", "|" + "---|" * 6)
    for own in fields:
        cells = _number(own) if own.kind == NUMBER else _option(own)
        yield "| " + " | ".join(cell.replace("|", "\\|") for cell in (f"`{own.name}`", *cells, own.meaning)) + " |"
    yield ""


def _number(own: Field) -> tuple[str, ...]:
    """Return the cells of a number: letter, unit, condition, default."""
    unit = "any" if own.dimension is None else pretty(si_unit(own.dimension))
    default = "needed" if own.required else own.otherwise if own.default is None else f"{own.default:g}"
    return of_latex(sign_of(own)).text, unit, condition(own), default


def _option(own: Field) -> tuple[str, ...]:
    """Return the cells of an option."""
    return "", "", " or ".join(f"`{as_word(value)}`" for value in own.values), f"`{as_word(own.choice)}`"

"""Writes docs/laws.md: every force law from its declaration, as `gudgeon laws NAME` prints it, in Markdown."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from gudgeon.generator.field import NUMBER, Field
from gudgeon.generator.kinds.laws.dissipation import (
    DISSIPATION,
    EXACT,
    FACTORS,
    SOURCES,
    compute_delivered_restitution,
)
from gudgeon.generator.kinds.laws.law import RESULTS, Law, find_bundled_laws
from gudgeon.generator.marked_text import get_markdown
from gudgeon.generator.targets.format_tables import describe_condition
from gudgeon.generator.targets.latex.document import Equation, make_sentence
from gudgeon.generator.targets.latex.law import EquationVariant, derive_equation_variants
from gudgeon.generator.targets.latex.law_choice import describe_choice_of_laws
from gudgeon.generator.targets.latex.law_symbols import find_symbols_of_law, list_symbol_rows
from gudgeon.generator.targets.latex.play import format_option
from gudgeon.generator.targets.latex.play_letters import get_latex_symbol
from gudgeon.language.plot_units import format_unit
from gudgeon.language.units import find_si_unit

_SOURCE_OF_EXACT = r"the equation of the delivered restitution with $e_r = c_e$, solved for $a$"
SPECIFIED_RESTITUTIONS = (0.9, 0.7, 0.5)  # coefficients of restitution
_SHEAR_SYMBOLS = r"D_0, L, R_j, \mu, c_{\text{film}}, c_a, s_\varepsilon, \varepsilon"  # of the equations of D_s
_CAVITATION_SYMBOLS = r"w_n, w_t, s_\varepsilon"  # of the equations of a full film
# What a choice of an option changes: text before the equations of the variant, and text in place of the equations.
_CHOICES = {"cavitation": "the whole film contributes, with the same film factor $S$:"}
_CHOICES_IN_WORDS = {
    "as_printed": "the radial force has the sign that Chen, Gao and Wang (2022) print: $F_r$ of the first equation for"
    r" $w_n \ge 0$, and $-F_r$ for $w_n < 0$.",
}
# Values of required keys in the line of YAML of each law, by key, or by law and key.
_EXAMPLES = {
    "restitution": "0.9",
    "mu": "0.1",
    "mu_s": "0.15",
    "v0": "1e-4 m/s",
    "v1": "1e-3 m/s",
    "v_s": "1e-2 m/s",
    "v_r": "1e-3 m/s",
    "decay": "1e-2 m/s",
    "presliding": "20 um",
    "force": "1e7 N/m * delta",
    "viscosity": "100 cP",
    "roughness": "1 um",
    "kelvin_voigt.stiffness": "1e8 N/m",
    "kelvin_voigt.damping": "2e3 N*s/m",
    "lugre.stiffness": "1e5",
}
# Keys of the example of a law with the option `dissipation`: without them, its restitution of 1 has no damping.
_DISSIPATIVE_EXAMPLE = {"restitution": "0.8", "dissipation": EXACT}
# Value of `dissipation`: author and year in its table; the references at the end of the page have the rest.
_AUTHORS = {
    "hunt_crossley": "Hunt and Crossley (1975)",
    "herbert_mcwhannell": "Herbert and McWhannell (1977)",
    "lee_wang": "Lee and Wang (1983)",
    "lankarani_nikravesh": "Lankarani and Nikravesh (1990)",
    "gonthier": "Gonthier et al. (2004)",
    "zhiying_qishao": "Qin and Lu (2006)",
    "flores": "Flores et al. (2011)",
    "hu_guo": "Hu and Guo (2015)",
}
# The role's sentence before its laws, and that of the law of rigid surfaces.
_INTRODUCTIONS = {
    "normal": r"The normal force $F_n$ follows from the penetration $\delta$ and its rate $\dot\delta$.",
    "friction": "The friction force $F_t$ follows from the normal force $F_n$ and the slip $v_t$.",
    "film": r"The components $F_r$ and $F_t$ of the film force follow from the eccentricity ratio $\varepsilon$ and the"
    " effective squeeze velocity, $w_n$ and $w_t$.",
    "mixed": "The force $F$ is a mean of the dry force and the film force with the weights $b$ and $1 - b$. The dry"
    r" contact carries the fraction $b F_{\text{dry}}/F$ of the load, which is not $b$.",
}
_RIGID = (
    r"In an impact of rigid surfaces, the rate of the penetration changes from $\dot\delta^{-}$ to $\dot\delta^{+}$. In"
    r" a closed contact, the normal force $F_n$ or the acceleration $\ddot\delta$ of the penetration is zero."
)
_HEADINGS = {
    "normal": "The normal force",
    "friction": "Friction",
    "film": "Lubricant films",
    "mixed": "Mixed lubrication",
}
_CONTACT_MODULUS = r"\frac{1}{E^{*}} = \frac{1 - \nu_i^2}{E_i} + \frac{1 - \nu_j^2}{E_j}"
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
    laws_by_role = {role: list_laws_of_role(role) for role in RESULTS}
    lines = [*describe_choice_of_laws(laws_by_role), *_describe_common_keys()]
    for role, laws in laws_by_role.items():
        lines += [f"## {_HEADINGS[role]}", "", _INTRODUCTIONS[role], ""]
        common = _find_common_symbols(laws)
        lines += ["These symbols occur in several laws of this group:", ""]
        lines += list_symbol_rows([", ".join(common)], "")
        lines += [line for law in laws for line in _describe_law_in_markdown(law, common)]
        lines += _describe_dissipation() if role == "normal" else ()
    return "\n".join([*lines, *_list_references()])


def _list_equations(law: Law) -> list[str]:
    """Return the equations that a law declares, as the page prints them, and after them further symbols of its page.

    The equation of the contact modulus is left out. Further symbols are those of other variants and of `validity`.
    """
    equations = [_name_film_clearance(law, latex) for latex in law.equation if latex != _CONTACT_MODULUS]
    added = [_CAVITATION_SYMBOLS] if any(option.name == "cavitation" for option in law.options) else []
    return [*equations, *added, *get_markdown(law.validity).split("$")[1::2]]


def _find_common_symbols(laws: Iterable[Law]) -> list[str]:
    """Return the symbols that equations of at least two of the laws have, in the order of their first use."""
    users: dict[str, list[str]] = {}
    for law in laws:
        keys = [get_latex_symbol(parameter) for parameter in law.parameters]
        for symbol in find_symbols_of_law(_list_equations(law), law.name, keys):
            users.setdefault(symbol, []).append(law.name)
    return [symbol for symbol, names in users.items() if len(names) > 1]


def _find_common_options() -> dict[str, tuple[Field, list[str]]]:
    """Return the options that at least two bundled laws have, by name, each with the names of its laws."""
    found: dict[str, tuple[Field, list[str]]] = {}
    for role in RESULTS:
        for law in list_laws_of_role(role):
            for option in law.options:
                found.setdefault(option.name, (option, []))[1].append(law.name)
    return {name: (option, laws) for name, (option, laws) in found.items() if len(laws) > 1}


def _describe_common_keys() -> Iterator[str]:
    """Yield the Markdown lines on the contact modulus and on the keys that several laws have."""
    yield from ("## Common equations and keys", "", "The contact modulus $E^{*}$ of both surfaces:", "")
    yield from ("$$", _CONTACT_MODULUS, "$$", "", *list_symbol_rows([_CONTACT_MODULUS], ""))
    yield from ("These keys are common to several laws; each section lists the common keys of its law.", "")
    yield from ("| key | laws | values | default | meaning |", "|" + "---|" * 5)
    for name, (option, laws) in _find_common_options().items():
        values, default = _list_option_cells(option)[2:]
        links = ", ".join(f"[`{law}`](#{law})" for law in laws)
        yield f"| `{name}` | {links} | {values} | {default} | {get_markdown(option.meaning)} |"
    yield ""
    yield (
        "- [The dissipation of a normal force](#the-dissipation-of-a-normal-force) lists the factor $a$ for each value"
        " of `dissipation`."
    )
    yield (
        "- With `geometry: internal`, $R_i + R_j$ in the equation of $K$ becomes $R_i - R_j$. For steel with radii of"
        " 10 and 9.5 mm, `external` gives 1.06·10¹⁰ N/m$^{1.5}$ and `internal` 6.61·10¹⁰ N/m$^{1.5}$. The literature on"
        " such slider-cranks prints 6.61·10¹⁰."
    )
    yield (
        "- Where other forces drive the surfaces apart fast, the formula of $F_n$ gives a negative force. `pulls: true`"
        " applies this force; `pulls: false` sets it to 0."
    )
    yield (
        r"- The key `angular_velocity` chooses the effective angular velocity $\omega_s$ of a film, in rad/s:"
        " [squeeze velocity](physics.md#squeeze-velocity-of-the-film)."
    )
    torque = r"M_\tau = D_s (\omega_j - \omega_i)"
    yield (
        "- With `shear: true`, a film also transmits the [shear torque](physics.md#line-of-action-and-shear-torque)"
        f" ${torque}$:"
    )
    film = find_bundled_laws()["pinkus_sternlicht"]
    variant = next(variant for variant in derive_equation_variants(film, film.name) if "shear" in variant.selected)
    equations = [_print_latex(equation) for equation in variant.equations]
    yield from ("", *_print_display(equations), *list_symbol_rows([torque, _SHEAR_SYMBOLS], ""))


def _describe_dissipation() -> Iterator[str]:
    """Yield the Markdown lines on the dissipation factors that several normal laws offer.

    The table has each factor a with the restitution that it delivers for three specified ones.
    """
    yield from ("## The dissipation of a normal force", "")
    yield (
        r"The key `dissipation` chooses the hysteresis damping factor $a$ of $1 + a\,\dot\delta/\dot\delta^{-}$ in the"
        " laws `esdu_78035`, `expression`, `hertz`, `johnson` and `liu`. Each column of $c_e$ gives the restitution"
        " $e_r$ that a free impact delivers for that specified restitution $c_e$. The restitution $e_r$ solves"
        r" $a (1 + e_r) = \ln[(1 + a)/(1 - a e_r)]$."
    )
    restitutions = " | ".join(f"$c_e$ = {c_e:g}" for c_e in SPECIFIED_RESTITUTIONS)
    yield from ("", f"| `dissipation` | $a$ | {restitutions} | source |", "|" + "---|" * 6)
    default_variant, *other_variants = derive_equation_variants(find_bundled_laws()["hertz"], "hertz")
    variant_by_value = {DISSIPATION.default: default_variant} | {
        variant.selected.get(DISSIPATION.name): variant for variant in other_variants
    }
    for name in DISSIPATION.values:
        a = next(
            _print_latex(variant).partition(" = ")[2]
            for variant in variant_by_value[name].equations
            if variant.left.text in ("a", "a_0")
        )
        formula = (
            "the $a$ that delivers $c_e$, by Newton's method from Hu and Guo's factor" if name == EXACT else f"${a}$"
        )
        e = (
            f"{c_e if name == EXACT else compute_delivered_restitution(float(FACTORS[str(name)](c_e))):.4f}"
            for c_e in SPECIFIED_RESTITUTIONS
        )
        source = f"[{_AUTHORS[str(name)]}](#references)" if name in _AUTHORS else "–"
        yield f"| `{name}` | {formula} | {' | '.join(e)} | {_SOURCE_OF_EXACT if name == EXACT else source} |"
    yield from ("", "`gudgeon laws hertz` prints the steps of Newton's method for `dissipation: exact`.", "")


def _list_references() -> Iterator[str]:
    """Yield the Markdown lines with the publications of the dissipation factors, one item for each."""
    yield from (
        "## References",
        "",
        "Sources of the [hysteresis damping factors](#the-dissipation-of-a-normal-force):",
        "",
    )
    yield from (f"- **{author}**: {_format_source(SOURCES[name])}." for name, author in _AUTHORS.items())
    yield ""


def _describe_law_in_markdown(law: Law, common_symbols: Iterable[str]) -> Iterator[str]:
    """Yield the Markdown lines on a law: title, example, equations, symbols, choices, keys, validity, source.

    `common_symbols` are those of the chapter's table, which the law's table leaves out.
    """
    yield from (f"### `{law.name}`", "", f"{make_sentence(get_markdown(law.title))}", "")
    yield from (f"Example: `{make_example(law)}`", "")
    if law.also:
        names_text = ", ".join(f"`{name}`" for name in law.also)
        yield from (f"Other names, each for `{law.name}` with the `dissipation` of that name: {names_text}.", "")
    if law.rigid:
        yield from (_RIGID, "")
    default_variant, *other_variants = derive_equation_variants(law, law.name)
    common_options = _find_common_options()
    variants = [variant for variant in other_variants if not common_options.keys() & variant.selected.keys()]
    if law.equation:
        equations = [latex for latex in _list_equations(law) if " = " in latex or r"\perp" in latex]
        keys = [get_latex_symbol(parameter) for parameter in law.parameters]
        yield from _print_display(equations)
        yield from list_symbol_rows(_list_equations(law), law.name, keys, common_symbols)
    else:
        yield from _print_display(map(_print_latex, default_variant.equations))
        yield from (f"`gudgeon laws {law.name}` defines the symbols of these equations.", "")
    for variant in variants:
        yield from _describe_choice(variant)
    yield from _print_keys_table([field for field in law.fields if field.name not in common_options])
    if shared := [f"`{option.name}`" for option in law.options if option.name in common_options]:
        *first, last = shared
        names = f"{', '.join(first)} and {last}" if first else last
        plural = "s" if first else ""
        yield from (f"The law also has the [common key{plural}](#common-equations-and-keys) {names}.", "")
    yield from _print_validity(law)
    yield from (f"**Source**: {_format_source(law.reference or law.source)}.", "")


def make_example(law: Law) -> str:
    """Return a line of YAML of a contact with the law, its required keys, and a dissipation if the law has a choice."""
    required = [field.name for field in law.fields if field.required]
    values = {name: _EXAMPLES.get(f"{law.name}.{name}") or _EXAMPLES[name] for name in required}
    if any(option.name == DISSIPATION.name for option in law.options):
        values |= _DISSIPATIVE_EXAMPLE
    return f"{law.role}: {{{', '.join([f'law: {law.name}', *(f'{name}: {value}' for name, value in values.items())])}}}"


def _print_validity(law: Law) -> Iterator[str]:
    """Yield the Markdown lines on the validity of a law and on its properties: a sentence, or a list of clauses.

    The first clause of `law.validity` is completed to "the law is valid for …" if needed.
    """
    first, *others = get_markdown(law.validity).split("; ")
    if not first.startswith(("the law ", "the force ", "for ")):
        first = f"the law is valid for {first}"
    properties = get_markdown(law.properties).split("; ") if law.properties else []
    for heading, clauses in (("Validity", [first, *others]), ("Properties", properties)):
        sentences = [make_sentence(clause) for clause in clauses]
        if len(sentences) == 1:
            yield from (f"**{heading}**: {sentences[0]}", "")
        elif sentences:
            yield from (f"**{heading}**:", "", *(f"- {sentence}" for sentence in sentences), "")


def _format_source(text: str) -> str:
    """Return the source of a declaration in Markdown with an en dash in ranges of pages."""
    return re.sub(r"(?<= )(\d+)--?(\d+)(?=[,;. ]|$)", r"\1–\2", get_markdown(text))


def _describe_choice(variant: EquationVariant) -> Iterator[str]:
    """Yield the Markdown lines on the changes by another choice of an option: a sentence and its equations.

    Nothing is yielded for a choice that changes no equation. _CHOICES has the sentences.
    """
    if not variant.equations:
        return
    choice = ", ".join(f"{key}: {format_option(value)}" for key, value in variant.selected.items())
    if words := " ".join(_CHOICES_IN_WORDS[key] for key in variant.selected if key in _CHOICES_IN_WORDS):
        yield from (f"With `{choice}`, {words}", "")
        return
    explanation = " ".join(_CHOICES[key] for key in variant.selected if key in _CHOICES)
    yield from (f"With `{choice}`, {explanation or 'these equations apply:'}", "")
    yield from _print_display(map(_print_latex, variant.equations))


def _print_display(equations: Iterable[str]) -> Iterator[str]:
    """Yield the Markdown lines of equations in LaTeX, each between dollar signs."""
    yield from (line for latex in equations for line in ("$$", _print_indices(latex), "$$", ""))


def _print_indices(latex: str) -> str:
    r"""Return LaTeX with the indices in words of the tables of symbols: F_{\mathrm{el}} → F_{\text{el}}."""
    latex = latex.replace(r"_{\mathrm{max}}", r"_{\max}")
    for index in ("el", "th", "dry", "film"):
        text = rf"_{{\text{{{index}}}}}"
        latex = latex.replace(rf"_{{\mathrm{{{index}}}}}", text).replace(rf"_\mathrm{{{index}}}", text)
    return latex


def _name_film_clearance(law: Law, latex: str) -> str:
    """Return an equation of a law with the film's clearance c_film where the source of a film writes c."""
    return re.sub(r"(?<![\w\\])c(?!\w)", r"c_{\\text{film}}", latex) if law.role == "film" else latex


def _print_latex(equation: Equation) -> str:
    """Return an equation as LaTeX without hints for line breaks."""
    latex = f"{equation.left.latex} = {''.join(term.latex for term in equation.terms)}"
    for letter in "rs":
        latex = latex.replace(rf"_{{\text{{{letter}}}}}", f"_{letter}")
    return latex.replace(r"\allowbreak ", "").replace(r"\operatorname{max}", r"\max").replace("{} ", " ")


def _print_keys_table(fields: Sequence[Field]) -> Iterator[str]:
    """Yield the lines of the Markdown table of a law's keys, then an empty line.

    Columns: key, symbol, unit, condition, default, meaning.
    """
    yield from ("| key | symbol | unit | condition | default | meaning |", "|" + "---|" * 6)
    for parameter in fields:
        cells = _list_number_cells(parameter) if parameter.kind == NUMBER else _list_option_cells(parameter)
        yield (
            "| "
            + " | ".join(
                cell.replace("|", "\\|") for cell in (f"`{parameter.name}`", *cells, get_markdown(parameter.meaning))
            )
            + " |"
        )
    yield ""


def _list_number_cells(parameter: Field) -> tuple[str, ...]:
    """Return the cells of a numerical key of a law: symbol, unit, condition, effect without the key.

    The last one is "required", the default, or the words of `parameter.otherwise`.
    """
    unit = "N/m$^n$" if parameter.dimension is None else format_unit(find_si_unit(parameter.dimension)) or "1"
    default = (
        "required"
        if parameter.required
        else parameter.otherwise
        if parameter.default is None
        else f"{parameter.default:g}"
    )
    condition = describe_condition(parameter).replace(">=", "≥").replace("<=", "≤") or "–"
    return f"${_print_indices(get_latex_symbol(parameter))}$", unit, condition, default


def _list_option_cells(option: Field) -> tuple[str, ...]:
    """Return the cells of an option of a law: its values and its default; it has neither symbol nor unit."""
    return (
        "–",
        "–",
        ", ".join(f"`{format_option(value)}`" for value in option.values),
        f"`{format_option(option.default_option)}`",
    )

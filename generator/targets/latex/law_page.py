"""Writes docs/laws.md: every force law from its declaration, as `gudgeon laws NAME` prints it, in Markdown."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from gudgeon.generator.field import NUMBER, Field
from gudgeon.generator.kinds.laws.dissipation import (
    DISSIPATION,
    EXACT,
    FACTORS,
    SEPARATION,
    SOURCES,
    compute_delivered_restitution,
)
from gudgeon.generator.kinds.laws.law import RESULTS, Law, find_bundled_laws
from gudgeon.generator.targets.format_tables import describe_condition
from gudgeon.generator.targets.latex.document import Equation, make_sentence
from gudgeon.generator.targets.latex.law import Form, derive_forms
from gudgeon.generator.targets.latex.law_choice import describe_choice_of_laws
from gudgeon.generator.targets.latex.law_symbols import list_symbol_rows
from gudgeon.generator.targets.latex.play import format_option
from gudgeon.generator.targets.latex.play_letters import get_latex_symbol
from gudgeon.language.plot_units import format_unit
from gudgeon.language.units import find_si_unit

_SOURCE_OF_EXACT = r"the equation of the delivered restitution with $e_r = c_e$, solved for $a$"
SPECIFIED_RESTITUTIONS = (0.9, 0.7, 0.5)  # coefficients of restitution
# Names and words of declarations, which are ASCII since they are also comments in C, and the page's spelling.
_SPELLINGS = {
    "Guembel": "Gümbel",
    "Poeschel": "Pöschel",
    "Astrom": "Åström",
    "Ambrosio": "Ambrósio",
    "Pennestri": "Pennestrì",
    "Ueber die Beruehrung fester elastischer Koerper": "Über die Berührung fester elastischer Körper",
    "fuer ": "für ",
}
# Symbols in the words of declarations: regular expression and the formula, applied in this order.
_FORMULAS = (
    (r"\|omega_s\| >> \|d epsilon/dt\|", r"$\\lvert\\omega_s\\rvert \\gg \\lvert\\dot\\varepsilon\\rvert$"),
    (r"sigma_1 <= 4 (g_v|c_f)/\|v_t\|", r"$\\sigma_1 \\le 4 \1/\\lvert v_t\\rvert$"),
    (r"L/D >> 1", r"$L/(2R_j) \\gg 1$"),
    (r"L/D < 1/2", r"$L/(2R_j) < 1/2$"),
    (r"L/D", r"$L/(2R_j)$"),
    (r"R_i ([+-]) R_j", r"$R_i \1 R_j$"),
    (r"omega_([ij]) ([+-]) omega_([ij])", r"$\\omega_\1 \2 \\omega_\3$"),
    (r"(?<!\\)\bomega_s\b", r"$\\omega_s$"),
    (r"(?<!\\)\bepsilon\b", r"$\\varepsilon$"),
    (r"c \+ (\d) sigma\b", r"$c + \1\\sigma_r$"),
    (r"(-?\d) sigma\b", r"$\1\\sigma_r$"),
    (r"clearance c\b", "clearance $c$"),
    (r"added to c,", "added to the radial clearance,"),
    (r"fraction b\b", "fraction $b$"),
    (r"approximation of b\b", "approximation of $b$"),
    (r"\b0\.9502 mu\b", "0.9502 $c_f$"),
    (r"at most mu times", "at most `mu` times"),
    (r"1/xi\b", r"$1/\\xi$"),
    (r"tanh\(v_t/v0\)", r"$\\tanh(v_t/v_0)$"),
    (r"tanh 1 = 0\.76", r"$\\tanh 1 = 0.76$"),
    (r"fallen to 1/e\b", r"fallen to $1/\\mathrm{e}$"),
    (r"(?<![`\w])v([01])\b", r"$v_\1$"),
    (r"(?<![`\w$({])v_([rs])\b", r"$v_\1$"),
    (r"(?<![`\w$])c_e\b", "$c_e$"),
    (r"\bF_el\b", r"$F_{\\text{el}}$"),
    (r"factor a; none is a = 0, exact delivers", "factor $a$; `none` is $a = 0$, `exact` delivers"),
    (r"(\d\.\d+)e10 N/m\^1\.5", "\\1·10¹⁰ N/m$^{1.5}$"),
    (r"(\d\.\d+)e10\b", "\\1·10¹⁰"),
    (r"N/m\^n", "N/m$^n$"),
    (r"penetration delta", "penetration `delta`"),
    (r"max\(0, \.\.\.\)", r"$\\max(0, \\dots)$"),
    (r"with pulls: false", "with `pulls: false`"),
    (r"unless geometry is internal", "unless `geometry` is `internal`"),
)
_SHEAR_SYMBOLS = r"D_0, L, R_j, \mu, c_{\text{film}}, c_a, s_\varepsilon, \varepsilon"  # of the equations of D_s
_CAVITATION_SYMBOLS = r"w_n, w_t, s_\varepsilon"  # of the equations of a full film
# What a choice of an option changes, in a law whose equations the form has.
_CHOICES = {
    "cavitation": "the whole film contributes, with the same film factor $S$:",
    "as_printed": "the radial force has the sign that Chen, Gao and Wang (2022) print:",
}
# The role's sentence before its laws, and that of the law of rigid surfaces.
_INTRODUCTIONS = {
    "normal": r"The normal force $F_n$ follows from the penetration $\delta$ and its rate $\dot\delta$.",
    "friction": "The friction force $F_t$ follows from the normal force $F_n$ and the slip $v_t$.",
    "film": r"The components $F_r$ and $F_t$ of the film force follow from the eccentricity ratio $\varepsilon$ and the"
    " effective squeeze velocity, $w_n$ and $w_t$.",
    "mixed": "The force $F$ is a mean of the dry force and the film force with the weights $b$ and $1 - b$.",
}
_RIGID = (
    r"In an impact of rigid surfaces, the rate of the penetration changes from $\dot\delta^{-}$ to $\dot\delta^{+}$. In"
    r" a closed contact, the normal force $F_n$ or the acceleration $\ddot\delta$ of the penetration is zero."
)
_HEADINGS = {"normal": "The normal force", "friction": "Friction", "film": "Oil films", "mixed": "Mixed lubrication"}
_CONTACT_MODULUS = r"\frac{1}{E^{*}} = \frac{1 - \nu_i^2}{E_i} + \frac{1 - \nu_j^2}{E_j}"
# Clauses of `validity` that the page leaves out, since the common keys or the symbols say the same.
_LEFT_OUT = (SEPARATION, "sigma is the combined roughness")
# Clauses of `validity` that define or describe the law and do not limit its use: how they begin.
_PROPERTIES = (
    "the stiffness is that of",
    "the force begins with",
    "near the end of each contact",
    "gudgeon checks",
    "an impact ",
    "a closed contact ",
    "in an impact,",
    "the sources write",
    "the largest coefficient",
    "above epsilon",
    "the film acts alone",
    "the clearance c is",
    "the fraction b",
    "the approximation of b",
)


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
        lines += [line for law in laws for line in _describe_law_in_markdown(law)]
        lines += _describe_dissipation() if role == "normal" else ()
    return "\n".join(lines)


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
    yield from ("Several laws have these keys. The section of a law names those that it has.", "")
    yield from ("| key | laws | values | without it | meaning |", "|" + "---|" * 5)
    for name, (option, laws) in _find_common_options().items():
        values, default = _list_option_cells(option)[2:]
        links = ", ".join(f"[`{law}`](#{law})" for law in laws)
        yield f"| `{name}` | {links} | {values} | {default} | {_format_declared_text(option.meaning)} |"
    yield ""
    yield (
        "- [The dissipation of a normal force](#the-dissipation-of-a-normal-force) lists the factor $a$ for each value"
        " of `dissipation`."
    )
    yield "- With `geometry: internal`, $R_i + R_j$ in the equation of $K$ becomes $R_i - R_j$."
    yield (
        r"- With `pulls: true`, the equation of $F_n$ applies without $\max(0, \dots)$. The formula pulls where"
        " surfaces are driven apart fast; with `pulls: false`, the force is then 0."
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
    form = next(form for form in derive_forms(film, film.name) if "shear" in form.selected)
    equations = [_print_latex(equation) for equation in form.equations]
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
    default_form, *other_forms = derive_forms(find_bundled_laws()["hertz"], "hertz")
    form_by_value = {DISSIPATION.default: default_form} | {
        form.selected.get(DISSIPATION.name): form for form in other_forms
    }
    for name in DISSIPATION.values:
        a = next(
            _print_latex(form).partition(" = ")[2]
            for form in form_by_value[name].equations
            if form.left.text in ("a", "a_0")
        )
        formula = (
            "the $a$ that delivers $c_e$, by Newton's method from Hu and Guo's factor" if name == EXACT else f"${a}$"
        )
        e = (
            f"{c_e if name == EXACT else compute_delivered_restitution(float(FACTORS[str(name)](c_e))):.4f}"
            for c_e in SPECIFIED_RESTITUTIONS
        )
        source = _format_source(SOURCES.get(str(name), ""))
        yield f"| `{name}` | {formula} | {' | '.join(e)} | {_SOURCE_OF_EXACT if name == EXACT else source} |"
    yield from ("", "`gudgeon laws hertz` prints the steps of Newton's method for `dissipation: exact`.", "")


def _describe_law_in_markdown(law: Law) -> Iterator[str]:
    """Yield the Markdown lines on a law: title, other names, equations, symbols, choices, keys, validity, source."""
    yield from (f"### `{law.name}`", "", f"{make_sentence(_format_declared_text(law.title))}", "")
    if law.also:
        names_text = ", ".join(f"`{name}`" for name in law.also)
        yield from (f"Other names, each for `{law.name}` with the `dissipation` of that name: {names_text}.", "")
    if law.rigid:
        yield from (_RIGID, "")
    default_form, *other_forms = derive_forms(law, law.name)
    common_options = _find_common_options()
    forms = [form for form in other_forms if not common_options.keys() & form.selected.keys()]
    if law.equation:
        equations = [_name_film_clearance(law, latex) for latex in law.equation if latex != _CONTACT_MODULUS]
        added = [_CAVITATION_SYMBOLS] if any("cavitation" in form.selected for form in forms) else []
        keys = [get_latex_symbol(parameter) for parameter in law.parameters]
        yield from (*_print_display(equations), *list_symbol_rows([*equations, *added], law.name, keys))
    else:
        yield from _print_display(map(_print_latex, default_form.equations))
        yield from (f"`gudgeon laws {law.name}` defines the symbols of these equations.", "")
    for form in forms:
        yield from _describe_choice(form)
    yield from _print_keys_table([field for field in law.fields if field.name not in common_options])
    if shared := [f"`{option.name}`" for option in law.options if option.name in common_options]:
        *first, last = shared
        names = f"{', '.join(first)} and {last}" if first else last
        plural = "s" if first else ""
        yield from (f"The law also has the [common key{plural}](#common-equations-and-keys) {names}.", "")
    yield from _print_validity(law)
    yield from (f"**Source**: {_format_source(law.reference or law.source)}.", "")


def _print_validity(law: Law) -> Iterator[str]:
    """Yield the Markdown lines on the validity of a law and on its properties: a sentence, or a list of clauses.

    Clauses are separated by "; " in `law.validity`. The first one is completed to "the law is valid for …" if needed.
    _PROPERTIES tells the properties from the limits of use.
    """
    first, *others = law.validity.split("; ")
    if not first.startswith(("the law ", "the force ", "for ")):
        article = "a " if first.startswith(("long bearing", "short bearing")) else ""
        first = f"the law is valid for {article}{first}"
    clauses = [clause for clause in (first, *others) if clause not in _LEFT_OUT]
    properties = [clause for clause in clauses if clause.startswith(_PROPERTIES)]
    limits = [clause for clause in clauses if clause not in properties]
    for heading, items in (("Validity", limits), ("Properties", properties)):
        sentences = [_format_declared_text(make_sentence(clause)) for clause in items]
        if len(sentences) == 1:
            yield from (f"**{heading}**: {sentences[0]}", "")
        elif sentences:
            yield from (f"**{heading}**:", "", *(f"- {sentence}" for sentence in sentences), "")


def _format_declared_text(text: str) -> str:
    """Return a text of a declaration with names in full spelling and symbols as formulas (_SPELLINGS, _FORMULAS)."""
    for name, spelling in _SPELLINGS.items():
        text = text.replace(name, spelling)
    for pattern, formula in _FORMULAS:
        text = re.sub(pattern, formula, text)
    return text


def _format_source(text: str) -> str:
    """Return the source of a declaration with names in full spelling and an en dash in ranges of pages."""
    for name, spelling in _SPELLINGS.items():
        text = text.replace(name, spelling)
    return re.sub(r"(?<= )(\d+)--?(\d+)(?=[,;. ]|$)", r"\1–\2", text)


def _describe_choice(form: Form) -> Iterator[str]:
    """Yield the Markdown lines on the changes by another choice of an option: a sentence and its equations.

    Nothing is yielded for a choice that changes no equation. _CHOICES has the sentences.
    """
    if not form.equations:
        return
    choice = ", ".join(f"{key}: {format_option(value)}" for key, value in form.selected.items())
    explanation = " ".join(_CHOICES[key] for key in form.selected if key in _CHOICES)
    yield from (f"With `{choice}`, {explanation or 'these equations apply:'}", "")
    yield from _print_display(map(_print_latex, form.equations))


def _print_display(equations: Iterable[str]) -> Iterator[str]:
    """Yield the Markdown lines of equations in LaTeX, each between dollar signs."""
    yield from (line for latex in equations for line in ("$$", latex, "$$", ""))


def _name_film_clearance(law: Law, latex: str) -> str:
    """Return an equation of a law with the film's clearance c_film where the source of a film writes c."""
    return re.sub(r"(?<![\w\\])c(?!\w)", r"c_{\\text{film}}", latex) if law.role == "film" else latex


def _print_latex(equation: Equation) -> str:
    """Return an equation as LaTeX without hints for line breaks."""
    latex = f"{equation.left.latex} = {''.join(term.latex for term in equation.terms)}"
    return latex.replace(r"\allowbreak ", "").replace(r"\operatorname{max}", r"\max").replace("{} ", " ")


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
                for cell in (f"`{parameter.name}`", *cells, _format_declared_text(parameter.meaning))
            )
            + " |"
        )
    yield ""


def _list_number_cells(parameter: Field) -> tuple[str, ...]:
    """Return the cells of a numerical key of a law: symbol, unit, condition, effect without the key.

    The last one is "needed", the default, or the words of `parameter.otherwise`.
    """
    unit = "N/m$^n$" if parameter.dimension is None else format_unit(find_si_unit(parameter.dimension))
    default = (
        "needed"
        if parameter.required
        else parameter.otherwise
        if parameter.default is None
        else f"{parameter.default:g}"
    )
    condition = describe_condition(parameter).replace(">=", "≥").replace("<=", "≤")
    return f"${get_latex_symbol(parameter)}$", unit, condition, default


def _list_option_cells(option: Field) -> tuple[str, ...]:
    """Return the cells of an option of a law: its values and its default; it has neither symbol nor unit."""
    return (
        "",
        "",
        " or ".join(f"`{format_option(value)}`" for value in option.values),
        f"`{format_option(option.default_option)}`",
    )

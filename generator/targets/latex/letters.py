"""Makes the names of symbols in LaTeX and plain text, with subscripts and accents: \\theta_{\\text{L7}} and θ_L7."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field
from itertools import groupby, takewhile

import sympy as sp

from gudgeon.generator.symbols.symbols import get_document_name

GREEK = {
    "alpha": "α",
    "beta": "β",
    "gamma": "γ",
    "delta": "δ",
    "epsilon": "ε",
    "zeta": "ζ",
    "eta": "η",
    "theta": "θ",
    "iota": "ι",
    "kappa": "κ",
    "lambda": "λ",
    "mu": "μ",
    "nu": "ν",
    "xi": "ξ",
    "pi": "π",
    "rho": "ρ",
    "sigma": "σ",
    "tau": "τ",
    "upsilon": "υ",
    "phi": "φ",
    "chi": "χ",
    "psi": "ψ",
    "omega": "ω",
    "Gamma": "Γ",
    "Delta": "Δ",
    "Theta": "Θ",
    "Lambda": "Λ",
    "Xi": "Ξ",
    "Pi": "Π",
    "Sigma": "Σ",
    "Phi": "Φ",
    "Psi": "Ψ",
    "Omega": "Ω",
}
_VARIANT = {"epsilon": r"\varepsilon", "phi": r"\varphi"}  # LaTeX commands that differ from the English name
_ITALIC_SUBSCRIPTS = frozenset("xyijnt")  # axes, bodies i and j, directions n and t; names of parts are upright
_DOTS = {0: ("", ""), 1: (r"\dot", "\u0307"), 2: (r"\ddot", "\u0308")}


@dataclass(frozen=True)
class Formula:
    """Represent a symbol or formula in LaTeX and in plain text, with highlighting tokens and the name of its value."""

    latex: str
    text: str
    tokens: Sequence[str] = field(default=(), compare=False)
    value: str = field(default="", compare=False)

    @property
    def width(self) -> int:
        """Return the approximate width in letters: a subscript is small, accents and signs take none."""
        return 2 + sum(c.isascii() and (c.isalnum() or c == "_") for c in self.text) // 2


def make_symbol_name(base: str, *subscripts: str, dots: int = 0, hat: bool = False, superscript: str = "") -> Formula:
    """Return the name of a symbol in LaTeX and plain text: a letter or word with accents, subscripts and superscript.

    base: a letter, a word, or a Greek letter's English name. dots: number of time derivatives. superscript: "" or "0".
    hat: whether a hat marks a unit vector; it replaces the dots.
    """
    latex = (
        get_greek_command(base)
        if base in GREEK
        else base
        if len(base) == 1
        else rf"\text{{{_escape_underscores(base)}}}"
    )
    text = GREEK.get(base, base)
    latex_accent, text_accent = (r"\hat", "\u0302") if hat else _DOTS[dots]
    if latex_accent:
        latex, text = f"{latex_accent}{{{latex}}}", text + text_accent
    if subscripts:
        latex += f"_{{{_print_subscripts(subscripts)}}}"
        text += "_" + ".".join(GREEK.get(s, s) for s in subscripts)
    return Formula(latex + (f"^{{{superscript}}}" if superscript else ""), text + {"": "", "0": "⁰"}[superscript])


def get_greek_command(word: str) -> str:
    """Return the LaTeX command of a Greek letter."""
    return _VARIANT.get(word, f"\\{word}")


def make_user_symbol_name(name: str) -> Formula:
    """Return the name of a user-defined identifier: omega4 is ω with subscript 4, v_max is v with subscript max.

    Only a letter or the name of a Greek letter gets a subscript; other identifiers, such as "speed", stay words.
    """
    base, _, subscript = name.partition("_")
    numbered = re.fullmatch(r"([A-Za-z]+?)(\d+)", base)
    if numbered and (len(numbered[1]) == 1 or numbered[1] in GREEK):
        base, subscript = numbered[1], f"{numbered[2]}_{subscript}" if subscript else numbered[2]
    if subscript and (len(base) == 1 or base in GREEK):
        return make_symbol_name(base, subscript)
    return make_symbol_name(name)


def make_name_from_latex(latex: str) -> Formula:
    r"""Return a formula from its LaTeX ("c_e", "\mu", "\sigma_{0}"), with the plain text "c_e", "μ", "σ_0".

    Commands of fonts and accents, braces and spaces are left out of the text.
    """
    unicode_by_command = {
        **{f"\\{name}": sign for name, sign in GREEK.items()},
        **{v: GREEK[k] for k, v in _VARIANT.items()},
    }
    text, *commands = latex.split("\\")
    for rest in commands:
        word = "".join(takewhile(str.isalpha, rest))
        text += unicode_by_command.get(f"\\{word}", "" if word in _FONTS else word) + rest.removeprefix(word)
    return Formula(latex, "".join(c for c in text if c not in "{}" and not c.isspace()))


def assign_unique_names(proposed: Iterable[tuple[sp.Expr, Formula]]) -> dict[sp.Symbol, Formula]:
    """Return {symbol: unique name} for pairs (expression, proposed name); other expressions than symbols are left out.

    The first symbol with a proposed name keeps it. Others get their identifier in C if it has no "_" ("T0"), else the
    proposed name with primes.
    """
    names: dict[sp.Symbol, Formula] = {}
    used_names: set[str] = set()
    for symbol, name in proposed:
        if not isinstance(symbol, sp.Symbol) or symbol in names:
            continue
        uses_identifier = name.text in used_names and "_" not in get_document_name(symbol)
        name = add_primes(make_symbol_name(get_document_name(symbol)) if uses_identifier else name, used_names)
        used_names.add(name.text)
        names[symbol] = name
    return names


def add_primes(name: Formula, used_names: Collection[str]) -> Formula:
    """Return a name with the smallest number of primes that makes its text differ from all `used_names`."""
    while name.text in used_names:
        name = Formula(f"{{{name.latex}}}'", f"{name.text}'")
    return name


_FONTS = {"mathrm", "text", "mathit", "operatorname", "bar", "hat", "tilde"}  # commands without a text of their own


def _print_subscripts(subscripts: Sequence[str]) -> str:
    r"""Return subscripts in LaTeX, separated by commas: Greek letters and axes in italics, names in \text{…}.

    Numbers are in \text{…} only next to a name.
    """
    texts = list[str]()
    for is_upright, group in groupby(subscripts, key=lambda text: text not in GREEK and text not in _ITALIC_SUBSCRIPTS):
        members = list(group)
        if is_upright and not all(text.isdigit() for text in members):
            texts.append(rf"\text{{{','.join(map(_escape_underscores, members))}}}")
        else:
            texts += members if is_upright else [get_greek_command(text) if text in GREEK else text for text in members]
    return ",".join(texts)


def _escape_underscores(name: str) -> str:
    """Return a name with LaTeX's underscores escaped."""
    return name.replace("_", r"\_")

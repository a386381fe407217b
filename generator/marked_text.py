"""Defines the text of a declaration that contains formulas: ASCII in comments of C and in the terminal, LaTeX in pages.

A declaration writes formulas in LaTeX between dollar signs and names of persons with their accents. The text itself is
the plain form, so that every other user of declarations needs to know nothing about formulas.
"""

from __future__ import annotations

from collections.abc import Mapping

# LaTeX and its plain form, replaced in this order. Other commands lose their backslash: \omega_s becomes omega_s.
_PLAIN_FORMS: Mapping[str, str] = {
    "$": "",
    r"\lvert": "|",
    r"\rvert": "|",
    r"\dot\varepsilon": "d epsilon/dt",
    r"\varepsilon": "epsilon",
    r"_{\text{el}}": "_el",
    r"\mathrm{e}": "e",
    r"\gg": ">>",
    r"\le": "<=",
    r"\dots": "...",
    "(2R_j)": "D",
    "\\": "",
    "–": "-",
    "å": "a",
    "Å": "A",
    "ì": "i",
    "ó": "o",
    "ö": "oe",
    "ü": "ue",
    "Ü": "Ue",
}


class MarkedText(str):
    r"""A plain text in ASCII with the same text in Markdown, whose formulas are LaTeX: `MarkedText(r"slip $v_0$")`.

    The value is the plain text; `markdown` is the argument. `plain` replaces the conversion by another plain text.
    """

    markdown: str

    def __new__(cls, markdown: str, plain: str = "") -> MarkedText:
        """Return the plain form of a text in Markdown."""
        text = super().__new__(cls, plain or _convert_to_plain(markdown))
        text.markdown = markdown
        return text


def get_markdown(text: str) -> str:
    """Return a text of a declaration in Markdown: with formulas in LaTeX if it is marked, else unchanged."""
    return text.markdown if isinstance(text, MarkedText) else text


def _convert_to_plain(markdown: str) -> str:
    """Return a text in Markdown with its formulas and letters in ASCII. Raises ValueError for an unknown character."""
    text = markdown
    for latex, plain in _PLAIN_FORMS.items():
        text = text.replace(latex, plain)
    if not text.isascii():
        raise ValueError(f"marked_text.py has no plain form of a character in {markdown!r}")
    return text

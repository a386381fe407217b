"""Renders a document as LaTeX, plain text or HTML: layout and escaping; the frames are in templates/latex.

Text in LaTeX can only be read as text: nothing in it is a command, all of it is ASCII.
"""

from __future__ import annotations

import html
import textwrap
import unicodedata
from functools import cache
from importlib import resources

import jinja2

from gudgeon.generator.targets.latex import to_html
from gudgeon.generator.targets.latex.document import Document, Equation, Paragraph, Picture, Sketch, Table, Text
from gudgeon.generator.targets.latex.letters import GREEK, Name, greek

_SPECIAL = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "$": r"\$",
    "&": r"\&",
    "#": r"\#",
    "%": r"\%",
    "_": r"\_",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    '"': "''",
    "`": r"\textquoteleft{}",
    "\n": " ",
    "\t": " ",
    "\u00a0": "~",
    "–": "--",
    "—": "---",
    "’": "'",
    "‘": "`",
    "“": "``",
    "”": "''",
    "…": r"\ldots{}",
    "■": r"\rule{1ex}{1ex}",
    "ß": r"\ss{}",
    "ø": r"\o{}",
    "Ø": r"\O{}",
    "æ": r"\ae{}",
    "Æ": r"\AE{}",
    "œ": r"\oe{}",
    "ł": r"\l{}",
    "Ł": r"\L{}",
    "ı": r"\i{}",
}
_MATH = {
    **{sign: greek(name) for name, sign in GREEK.items()},
    "−": "-",
    "±": r"\pm",
    "·": r"\cdot",
    "×": r"\times",
    "≤": r"\leq",
    "≥": r"\geq",
    "≠": r"\neq",
    "≈": r"\approx",
    "‖": r"\Vert",
    "→": r"\to",
    "∂": r"\partial",
    "√": r"\surd",
    "°": r"{}^{\circ}",
    "½": r"\frac{1}{2}",
    **{sign: f"{{}}^{{{k}}}" for k, sign in enumerate("⁰¹²³⁴⁵⁶⁷⁸⁹")},
    "∞": r"\infty",
    "µ": r"\mu",
    "⁻": "{}^{-}",
    "ᵀ": r"{}^{\top}",
}
_MARKS = {
    "\u0300": "`",
    "\u0301": "'",
    "\u0302": "^",
    "\u0303": "~",
    "\u0304": "=",
    "\u0306": "u",
    "\u0307": ".",
    "\u0308": '"',
    "\u030a": "r",
    "\u030b": "H",
    "\u030c": "v",
    "\u0327": "c",
    "\u0328": "k",
}
_ACCENTS = {"\u0302": "hat", "\u0307": "dot", "\u0308": "ddot"}  # of a mathematical sign


def tex(text: str) -> str:
    """Return `text` for running LaTeX; a character that plain pdflatex lacks becomes its number."""
    return "".join(map(_character, _clusters(text)))


def sketch_line(line: str) -> str:
    """Return a line of a sketch, in which every character has the same width."""
    return "".join(map(_sketch_character, _clusters(line)))


def _sketch_character(cluster: str) -> str:
    """Return a character of a sketch in LaTeX."""
    if cluster == " ":
        return "~"
    if cluster.isascii():  # a typewriter font has all of ASCII in its places
        return cluster if cluster.isalnum() or cluster in "()[]=+-.,:;'/*!@" else rf"\char{ord(cluster)}{{}}"
    return rf"\cell{{{tex(cluster)}}}"


def _clusters(text: str) -> list[str]:
    """Return letters with the marks above them."""
    found: list[str] = []
    for character in unicodedata.normalize("NFC", text):
        if unicodedata.combining(character) and found:
            found[-1] += character
        else:
            found.append(character)
    return found


def _character(cluster: str) -> str:
    """Return a character in LaTeX."""
    if cluster in _SPECIAL:
        return _SPECIAL[cluster]
    if cluster in _MATH:
        return f"${_MATH[cluster]}$"
    if cluster.isascii():
        return cluster if cluster.isprintable() else ""
    base, *marks = list(unicodedata.normalize("NFD", cluster))
    if len(marks) == 1 and marks[0] in _MARKS and (base in _MATH or base.isascii()):
        if base in _MATH:
            return rf"$\{_ACCENTS.get(marks[0], 'bar')}{{{_MATH[base]}}}$"
        return rf"\{_MARKS[marks[0]]}{{{_character(base)}}}"
    return "".join(f"[U+{ord(c):04X}]" for c in cluster)


WIDTH = 100  # characters of a line of text
WIDE = 44  # characters of a column with running text
LETTER = {r"\small": 0.0106, r"\footnotesize": 0.0096, r"\scriptsize": 0.009}  # shares of a line that one takes
GAP = 0.025  # between two columns


def render(document: Document, suffix: str, **slots: str) -> str:
    """Return the document in the format of a file's suffix: "tex", "txt" or "html"; slots of its frame contain HTML."""
    text = _environment().get_template(f"equations.{suffix}.jinja").render(document=document, **slots)
    return "\n".join(line.rstrip() for line in text.splitlines()).strip("\n") + "\n"


@cache
def _environment() -> jinja2.Environment:
    """Return the environment of the templates, with delimiters that LaTeX does not use."""

    def load(name: str) -> str:
        """Return the text of a template."""
        return resources.files("gudgeon.templates").joinpath("latex", name).read_text(encoding="utf-8")

    environment = jinja2.Environment(
        loader=jinja2.FunctionLoader(load),
        undefined=jinja2.StrictUndefined,
        autoescape=False,
        trim_blocks=True,
        lstrip_blocks=True,
        # LaTeX is full of braces
        variable_start_string="<<",
        variable_end_string=">>",
        block_start_string="<%",
        block_end_string="%>",
        comment_start_string="<#",
        comment_end_string="#>",
    )
    environment.filters.update(
        tex=tex,
        tex_line=_tex_line,
        tex_terms=_tex_terms,
        tex_sketch=sketch_line,
        tex_columns=_tex_columns,
        tex_row=_tex_row,
        tex_size=_tex_size,
        html=html.escape,
        html_line=to_html.line,
        formula=to_html.formula,
        attributes=to_html.attributes,
        output=to_html.output,
        listing=to_html.listing,
        plain_line=_plain_line,
        plain_paragraph=_plain_paragraph,
        plain_equation=_plain_equation,
        plain_table=_plain_table,
        underline=_underline,
    )
    return environment


def _tex_line(text: Text) -> str:
    """Return words and formulas in LaTeX."""
    return "".join(f"${part.latex}$" if isinstance(part, Name) else tex(part) for part in text)


def _tex_row(row: tuple[Text, ...], wide: tuple[int, ...]) -> str:
    """Return a row of a table in LaTeX."""
    cells = [rf"\raggedright {_tex_line(cell)}" if k in wide else _tex_line(cell) for k, cell in enumerate(row)]
    return " & ".join(cells) + r" \tabularnewline"


def _tex_terms(equation: Equation) -> str:
    """Return the terms of an equation in LaTeX."""
    return "\n  ".join(term.latex for term in equation.terms)


def _tex_columns(table: Table) -> str:
    """Return the columns of a table; running text gets the remaining width."""
    others = [_width(table, k) for k in range(len(table.header)) if k not in table.wide]
    used = LETTER[_tex_size(table)] * sum(others) + GAP * len(table.header)
    share = max(0.12, min(0.34, 1.0 - used)) / max(1, len(table.wide))
    return "".join(rf"p{{{share:.2f}\linewidth}}" if k in table.wide else "l" for k in range(len(table.header)))


def _tex_size(block: Sketch | Picture | Table) -> str:
    """Return the font size of a sketch, small for long lines."""
    if not isinstance(block, Table):
        return r"\footnotesize" if max(map(len, block.lines), default=0) <= 98 else r"\scriptsize"
    widths = [_width(block, k) for k in range(len(block.header))]
    width = sum(2 + min(WIDE, w) if k in block.wide else 2 + w for k, w in enumerate(widths))
    return r"\small" if width <= 105 else r"\footnotesize" if width <= 125 else r"\scriptsize"


def _width(table: Table, k: int) -> int:
    """Return the number of characters of a column."""
    return max(_columns(_plain_line(row[k])) for row in (table.header, *table.rows))


def _plain_line(text: Text) -> str:
    """Return words and formulas as plain text."""
    return "".join(part.text if isinstance(part, Name) else part for part in text)


def _plain_paragraph(paragraph: Paragraph) -> str:
    """Return a paragraph as plain text."""
    return textwrap.fill(_plain_line(paragraph.text), WIDTH, break_long_words=False, break_on_hyphens=False)


def _plain_equation(equation: Equation) -> str:
    """Return an equation in one line or more, indented after the first."""
    line = f"  {equation.left.text} = {''.join(term.text for term in equation.terms)}"
    return textwrap.fill(line, WIDTH, subsequent_indent=" " * 8, break_long_words=False, break_on_hyphens=False)


def _plain_table(table: Table) -> str:
    """Return a table with aligned columns; running text is wrapped."""
    rows = [[[_plain_line(cell)] for cell in table.header]]
    rows += [
        [
            textwrap.wrap(_plain_line(cell), WIDE) or [""] if k in table.wide else [_plain_line(cell)]
            for k, cell in enumerate(row)
        ]
        for row in table.rows
    ]
    widths = [max(_columns(line) for row in rows for line in row[k]) for k in range(len(table.header))]
    lines = []
    for row in rows:
        for level in range(max(map(len, row))):
            parts = [cell[level] if level < len(cell) else "" for cell in row]
            padded = (part + " " * (width - _columns(part)) for part, width in zip(parts, widths, strict=True))
            lines.append("  " + "   ".join(padded).rstrip())
    lines.insert(1, "  " + "   ".join("-" * width for width in widths))
    return "\n".join(lines)


def _columns(text: str) -> int:
    """Return the width of a text on a terminal: combining marks take none."""
    return sum(not unicodedata.combining(character) for character in text)


def _underline(text: str, sign: str) -> str:
    """Return a heading with a line of signs below it."""
    return f"{text}\n{sign * _columns(text)}"

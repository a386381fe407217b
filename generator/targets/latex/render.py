"""Renders a document of equations as LaTeX, plain text or HTML: layout and escaping.

Text in LaTeX is escaped completely: it contains no command of the user, and all of it is ASCII.
"""

from __future__ import annotations

import html
import textwrap
import unicodedata
from functools import cache
from importlib import resources

import jinja2

from gudgeon.generator.targets.javascript.compression import compress_style_sheet
from gudgeon.generator.targets.latex import to_html
from gudgeon.generator.targets.latex.document import Document, Equation, Paragraph, Picture, Sketch, Table, Text
from gudgeon.generator.targets.latex.letters import GREEK, Formula, get_greek_command

_TEXT_COMMANDS = {
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
_MATH_COMMANDS = {
    **{sign: get_greek_command(name) for name, sign in GREEK.items()},
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
_TEXT_ACCENTS = {
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
_MATH_ACCENTS = {"\u0302": "hat", "\u0307": "dot", "\u0308": "ddot"}  # of a mathematical sign


def escape_latex(text: str) -> str:
    """Return a text escaped for LaTeX paragraphs; a character that plain pdflatex lacks becomes "[U+0416]"."""
    return "".join(map(_escape_character, _split_graphemes(text)))


def escape_sketch_line(line: str) -> str:
    r"""Return a line of a sketch in LaTeX for a typewriter font; characters beyond ASCII are in cells of one width."""
    return "".join(map(_escape_sketch_character, _split_graphemes(line)))


def _escape_sketch_character(cluster: str) -> str:
    r"""Return a character of a sketch in LaTeX: a space as ~, ASCII as it is or by \char, others in a \cell."""
    if cluster == " ":
        return "~"
    if cluster.isascii():  # a typewriter font has all of ASCII in its places
        return cluster if cluster.isalnum() or cluster in "()[]=+-.,:;'/*!@" else rf"\char{ord(cluster)}{{}}"
    return rf"\cell{{{escape_latex(cluster)}}}"


def _split_graphemes(text: str) -> list[str]:
    """Return the characters of a text in normal form C, each together with the combining marks after it."""
    clusters: list[str] = []
    for character in unicodedata.normalize("NFC", text):
        if unicodedata.combining(character) and clusters:
            clusters[-1] += character
        else:
            clusters.append(character)
    return clusters


def _escape_character(cluster: str) -> str:
    """Return a character with its combining marks in LaTeX: escaped, as a formula, with one accent, or as [U+number].

    Control characters become "". Each code point of a character that LaTeX lacks is written, such as "[U+0416]".
    """
    if cluster in _TEXT_COMMANDS:
        return _TEXT_COMMANDS[cluster]
    if cluster in _MATH_COMMANDS:
        return f"${_MATH_COMMANDS[cluster]}$"
    if cluster.isascii():
        return cluster if cluster.isprintable() else ""
    letter, *marks = list(unicodedata.normalize("NFD", cluster))
    if len(marks) == 1 and marks[0] in _TEXT_ACCENTS and (letter in _MATH_COMMANDS or letter.isascii()):
        if letter in _MATH_COMMANDS:
            return rf"$\{_MATH_ACCENTS.get(marks[0], 'bar')}{{{_MATH_COMMANDS[letter]}}}$"
        return rf"\{_TEXT_ACCENTS[marks[0]]}{{{_escape_character(letter)}}}"
    return "".join(f"[U+{ord(c):04X}]" for c in cluster)


WIDTH = 100  # characters of a line of text
TEXT_COLUMN_WIDTH = 44  # characters of a column with running text
# Widths of a character in each size, and of the gap between two columns, as fractions of \linewidth.
_CHARACTER_WIDTHS = {r"\small": 0.0106, r"\footnotesize": 0.0096, r"\scriptsize": 0.009}
_COLUMN_GAP = 0.025


def render_document(document: Document, suffix: str, **page_parts: str) -> str:
    """Return the document in the format of a file's suffix, "tex", "txt" or "html", without trailing spaces.

    page_parts: text of the template's variables: `head`, `app` and `scripts` for "html" (required), `drawing` and
    `caption` for "tex" (optional).
    """
    text = _get_template_environment().get_template(f"equations.{suffix}.jinja").render(document=document, **page_parts)
    return "\n".join(line.rstrip() for line in text.splitlines()).strip("\n") + "\n"


@cache
def _get_template_environment() -> jinja2.Environment:
    """Return the Jinja environment of the document templates; it is created at the first call and cached.

    Its delimiters << >>, <% %> do not occur in LaTeX. Its filters print parts of a document in each format.
    """

    def load_template(name: str) -> str:
        """Return the text of a template from the package folder templates/latex."""
        return resources.files("gudgeon.templates").joinpath("latex", name).read_text(encoding="utf-8")

    environment = jinja2.Environment(
        loader=jinja2.FunctionLoader(load_template),
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
        tex=escape_latex,
        tex_line=_print_tex_line,
        tex_terms=_print_tex_terms,
        tex_sketch=escape_sketch_line,
        tex_columns=_print_tex_columns,
        tex_row=_print_tex_row,
        tex_size=_select_tex_size,
        html=html.escape,
        html_line=to_html.print_instruction,
        formula=to_html.print_formula,
        attributes=to_html.print_attributes,
        output=to_html.print_value_element,
        listing=to_html.print_listing,
        compress_css=compress_style_sheet,
        plain_line=_print_plain_line,
        plain_paragraph=_print_plain_paragraph,
        plain_equation=_print_plain_equation,
        plain_table=_print_plain_table,
        underline=_underline_heading,
    )
    return environment


def _print_tex_line(text: Text) -> str:
    """Return words and formulas in LaTeX."""
    return "".join(f"${part.latex}$" if isinstance(part, Formula) else escape_latex(part) for part in text)


def _print_tex_row(row: tuple[Text, ...], text_columns: tuple[int, ...]) -> str:
    """Return a row of a table in LaTeX; columns with running text, `text_columns`, are ragged."""
    cells = [
        rf"\raggedright {_print_tex_line(cell)}" if k in text_columns else _print_tex_line(cell)
        for k, cell in enumerate(row)
    ]
    return " & ".join(cells) + r" \tabularnewline"


def _print_tex_terms(equation: Equation) -> str:
    """Return the terms of an equation in LaTeX, one per line."""
    return "\n  ".join(term.latex for term in equation.terms)


def _print_tex_columns(table: Table) -> str:
    r"""Return the column specification of a table in LaTeX, such as "llp{0.34\linewidth}".

    Columns with running text share the remaining width, each from 0.12 to 0.34 of a line.
    """
    widths = [_measure_column(table, k) for k in range(len(table.header)) if k not in table.text_columns]
    used_width = _CHARACTER_WIDTHS[_select_tex_size(table)] * sum(widths) + _COLUMN_GAP * len(table.header)
    column_width = max(0.12, min(0.34, 1.0 - used_width)) / max(1, len(table.text_columns))
    return "".join(
        rf"p{{{column_width:.2f}\linewidth}}" if k in table.text_columns else "l" for k in range(len(table.header))
    )


def _select_tex_size(block: Sketch | Picture | Table) -> str:
    r"""Return the LaTeX font size that fits the longest line of a sketch, picture or table.

    A table is \small, \footnotesize from 106 characters on, \scriptsize from 126 on; others are \footnotesize
    up to 98 characters, \scriptsize beyond.
    """
    if not isinstance(block, Table):
        return r"\footnotesize" if max(map(len, block.lines), default=0) <= 98 else r"\scriptsize"
    widths = [_measure_column(block, k) for k in range(len(block.header))]
    width = sum(2 + min(TEXT_COLUMN_WIDTH, w) if k in block.text_columns else 2 + w for k, w in enumerate(widths))
    return r"\small" if width <= 105 else r"\footnotesize" if width <= 125 else r"\scriptsize"


def _measure_column(table: Table, column: int) -> int:
    """Return the number of characters of a table's column `column`, the header included."""
    return max(_measure_width(_print_plain_line(row[column])) for row in (table.header, *table.rows))


def _print_plain_line(text: Text) -> str:
    """Return words and formulas as plain text."""
    return "".join(part.text if isinstance(part, Formula) else part for part in text)


def _print_plain_paragraph(paragraph: Paragraph) -> str:
    """Return a paragraph as plain text, wrapped at WIDTH characters."""
    return textwrap.fill(_print_plain_line(paragraph.text), WIDTH, break_long_words=False, break_on_hyphens=False)


def _print_plain_equation(equation: Equation) -> str:
    """Return an equation as plain text, wrapped at WIDTH characters; continuation lines are indented further."""
    line = f"  {equation.left.text} = {''.join(term.text for term in equation.terms)}"
    return textwrap.fill(line, WIDTH, subsequent_indent=" " * 8, break_long_words=False, break_on_hyphens=False)


def _print_plain_table(table: Table) -> str:
    """Return a table as plain text with aligned columns and a rule below the header.

    Columns with running text are wrapped at TEXT_COLUMN_WIDTH characters; their rows have several lines.
    """
    rows = [[[_print_plain_line(cell)] for cell in table.header]]
    rows += [
        [
            textwrap.wrap(_print_plain_line(cell), TEXT_COLUMN_WIDTH) or [""]
            if k in table.text_columns
            else [_print_plain_line(cell)]
            for k, cell in enumerate(row)
        ]
        for row in table.rows
    ]
    widths = [max(_measure_width(line) for row in rows for line in row[k]) for k in range(len(table.header))]
    lines = []
    for row in rows:
        for line_index in range(max(map(len, row))):
            cell_lines = [cell[line_index] if line_index < len(cell) else "" for cell in row]
            padded = (
                part + " " * (width - _measure_width(part)) for part, width in zip(cell_lines, widths, strict=True)
            )
            lines.append("  " + "   ".join(padded).rstrip())
    lines.insert(1, "  " + "   ".join("-" * width for width in widths))
    return "\n".join(lines)


def _measure_width(text: str) -> int:
    """Return the width of a text on a terminal in characters; combining marks take none."""
    return sum(not unicodedata.combining(character) for character in text)


def _underline_heading(text: str, character: str) -> str:
    """Return a heading with a line of the given character below it."""
    return f"{text}\n{character * _measure_width(text)}"

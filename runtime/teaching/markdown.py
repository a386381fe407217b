"""A document as Markdown with formulas between dollar signs, as notebooks and many sites show it."""

from __future__ import annotations

import re

from gudgeon.generator.targets.latex.document import Block, Carried, Document, Equation, Paragraph, Table, Text
from gudgeon.generator.targets.latex.letters import Name

_SIGNS = re.compile(r"([\\`*_{}\[\]<>#|$~])")


def markdown(document: Document) -> str:
    """The whole document."""
    parts = [f"# {plain(document.title)}", *map(line, document.facts)]
    for section in document.sections:
        parts.append(f"{'#' * (section.level + 1)} {plain(section.title)}")
        parts += map(block, section.blocks)
    return "\n\n".join(parts) + "\n"


def block(shown: Block) -> str:
    """A paragraph, equation, table or sketch; what a page alone has is left out."""
    if isinstance(shown, Paragraph):
        return line(shown.text)
    if isinstance(shown, Equation):
        return f"$$ {shown.left.latex} = {' '.join(term.latex for term in shown.terms)} $$"
    if isinstance(shown, Table):
        return _table(shown)
    if isinstance(shown, Carried):
        return ""
    return "\n".join(("```text", *shown.lines, "```"))


def line(text: Text) -> str:
    """Words and formulas."""
    return "".join(f"${part.latex.strip()}$" if isinstance(part, Name) else plain(part) for part in text)


def plain(text: str) -> str:
    """Text of a file is text, never markup."""
    return _SIGNS.sub(r"\\\1", text)


def _table(shown: Table) -> str:
    def row(cells: tuple[Text, ...]) -> str:
        return "| " + " | ".join(line(cell).replace(r"\|", "&#124;").replace("|", r"\vert ") for cell in cells) + " |"

    return "\n".join((row(shown.header), "|" + " --- |" * len(shown.header), *map(row, shown.rows)))

"""What is shown, before it is laid out: sections of paragraphs, equations, tables and sketches.

Every formula is there in LaTeX and in plain text; HTML takes the LaTeX as MathML.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeAlias

from gudgeon.generator.targets.latex.letters import Name

Text: TypeAlias = tuple[str | Name, ...]  # words and formulas in one line


@dataclass(frozen=True)
class Paragraph:
    text: Text
    kind: str = "paragraph"

    @property
    def leads(self) -> bool:
        """Whether what follows belongs on the same page."""
        return isinstance(self.text[-1], str) and self.text[-1].endswith(":")


@dataclass(frozen=True)
class Equation:
    """left = terms; a line may break in front of a term."""

    left: Name
    terms: tuple[Name, ...]
    kind: str = "equation"


@dataclass(frozen=True)
class Table:
    """`wide` are the columns with running text."""

    header: tuple[Text, ...]
    rows: tuple[tuple[Text, ...], ...]
    wide: tuple[int, ...] = ()
    kind: str = "table"


@dataclass(frozen=True)
class Sketch:
    """Lines whose columns must stay under each other."""

    lines: tuple[str, ...]
    kind: str = "sketch"


Block: TypeAlias = Paragraph | Equation | Table | Sketch


@dataclass(frozen=True)
class Section:
    title: str
    blocks: tuple[Block, ...]
    level: int = 1


@dataclass(frozen=True)
class Document:
    title: str
    facts: tuple[Text, ...]  # under the title
    sections: tuple[Section, ...] = field(default=())


def paragraph(*text: str | Name) -> Paragraph:
    """Words and formulas as a paragraph."""
    return Paragraph(text)


def sentence(text: str) -> str:
    """Text that begins with a capital and ends with a stop."""
    return f"{text[:1].upper()}{text[1:]}."


def cells(*items: str | Name | Text) -> tuple[Text, ...]:
    """A row of a table."""
    return tuple(item if isinstance(item, tuple) else (item,) for item in items)


MOST_ROWS = 32  # a table does not break over pages


def table(header: tuple[Text, ...], rows: list[tuple[Text, ...]], wide: tuple[int, ...] = ()) -> list[Block]:
    """Rows in as many tables as they need; nothing for no rows."""
    parts = [rows[k : k + MOST_ROWS] for k in range(0, len(rows), MOST_ROWS)]
    return [Table(header, tuple(part), wide) for part in parts]

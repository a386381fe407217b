"""Represents a document of equations before its layout: sections of paragraphs, equations, tables and sketches.

Every formula has a LaTeX and a plain text form; HTML converts the LaTeX to MathML. `of` are the tokens of a block
(trace.py); blocks that share a token are highlighted together (highlighting.js). `value` is the value that a running
page shows next to the block (current_values.js); both are for HTML only.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import TypeAlias

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.targets.latex.letters import Name

COLUMN_GAP = 4  # columns without a letter between parts of a sketch

Text: TypeAlias = tuple[str | Name, ...]  # words and formulas in one line


@dataclass(frozen=True)
class Paragraph:
    """Represent a paragraph of words and formulas."""

    text: Text
    of: Sequence[str] = ()
    kind: str = "paragraph"

    @property
    def leads(self) -> bool:
        """Return whether the next block belongs on the same page, since the paragraph ends with a colon."""
        return isinstance(self.text[-1], str) and self.text[-1].endswith(":")


@dataclass(frozen=True)
class Equation:
    """Represent an equation left = terms; a line may break before a term."""

    left: Name
    terms: tuple[Name, ...]
    of: Sequence[str] = ()
    pick: str = ""  # what selecting it lights, if that is not all of `tokens`
    value: str = ""
    kind: str = "equation"


@dataclass(frozen=True)
class Table:
    """Represent a table; `wide` are the columns with running text, `of` tokens by row.

    `upright`: on a phone its columns become rows.
    """

    header: tuple[Text, ...]
    rows: tuple[tuple[Text, ...], ...]
    wide: tuple[int, ...] = ()
    of: tuple[Sequence[str], ...] = ()
    upright: bool = False
    kind: str = "table"

    def tokens(self, row: int) -> Sequence[str]:
        """Return the highlighting tokens of a row, counted from 0; () if the row has none."""
        return self.of[row] if row < len(self.of) else ()


@dataclass(frozen=True)
class Sketch:
    """Represent a sketch in characters, whose columns must stay aligned."""

    lines: tuple[str, ...]
    kind: str = "sketch"

    @property
    def parts(self) -> list[tuple[str, ...]]:
        """Return the parts of a sketch that may stand below each other; COLUMN_GAP empty columns separate them."""
        parts = list[tuple[str, ...]]()
        for is_blank, group in groupby(self.lines, lambda line: not line.strip()):
            lines = [] if is_blank else list(group)
            while lines:
                width = max(map(len, lines))
                is_column_used = [any(line[k : k + 1].strip() for line in lines) for k in range(width)]
                gap_starts = (
                    k
                    for k in range(is_column_used.index(True) + 1, width - COLUMN_GAP)
                    if not any(is_column_used[k : k + COLUMN_GAP])
                )
                end = next(gap_starts, width)
                parts.append(tuple("\n".join(line[:end].rstrip() for line in lines).strip("\n").split("\n")))
                next_start = next((k for k in range(end, width) if is_column_used[k]), width)
                lines = [line[next_start:] for line in lines] if next_start < width else []
        return parts


@dataclass(frozen=True)
class Picture:
    """Represent a drawing: SVG in HTML, elsewhere aligned lines of characters, or nothing."""

    caption: str
    svg: str
    lines: tuple[str, ...] = ()
    kind: str = "picture"


@dataclass(frozen=True)
class Listing:
    """Represent a file line by line, folded, with tokens by line from 1; in HTML only."""

    title: str
    lines: tuple[str, ...]
    of: Mapping[int, Collection[str]]
    kind: str = "listing"


@dataclass(frozen=True)
class EmbeddedHtml:
    """Represent HTML that only a page has."""

    html: str
    kind: str = "carried"


Block: TypeAlias = Paragraph | Equation | Table | Sketch | Picture | Listing | EmbeddedHtml


@dataclass(frozen=True)
class Section:
    """Represent a section: its title, its blocks, and the level of its heading."""

    title: str
    blocks: tuple[Block, ...]
    level: int = 1
    of: Sequence[str] = ()


@dataclass(frozen=True)
class Document:
    """Represent a document: its title, facts under the title, and sections."""

    title: str
    facts: tuple[Text, ...]  # under the title
    sections: tuple[Section, ...] = field(default=())


def make_paragraph(*text: str | Name, tokens: Sequence[str] = ()) -> Paragraph:
    """Return words and formulas as a paragraph with highlighting tokens `tokens`."""
    return Paragraph(text, tokens)


def make_sentence(text: str) -> str:
    """Return a text with a capital first letter and a full stop."""
    return f"{text[:1].upper()}{text[1:]}."


def make_row(*items: str | Name | Text) -> tuple[Text, ...]:
    """Return a row of a table: a string or a formula becomes a cell with one part."""
    return tuple(item if isinstance(item, tuple) else (item,) for item in items)


MAX_TABLE_ROWS = 32  # a table does not break over pages


def make_tables(
    header: tuple[Text, ...],
    rows: list[tuple[Text, ...]],
    text_columns: tuple[int, ...] = (),
    tokens: Sequence[Sequence[str]] = (),
    transposes_on_phone: bool = False,
) -> list[Block]:
    """Return rows as tables of at most MAX_TABLE_ROWS rows, since a table does not break over pages; [] for no rows.

    text_columns: the columns with running text. tokens: highlighting tokens by row. transposes_on_phone:
    whether columns become rows on a phone.
    """
    starts = range(0, len(rows), MAX_TABLE_ROWS)
    return [
        Table(
            header,
            tuple(rows[k : k + MAX_TABLE_ROWS]),
            text_columns,
            tuple(tokens[k : k + MAX_TABLE_ROWS]),
            transposes_on_phone,
        )
        for k in starts
    ]


def make_row_token(number: int) -> str:
    """Return the token of a constraint equation, counted from 1; it also stands for its entries of Φ_q."""
    return f"row-{number}"


def make_entry_token(row: int, column: int) -> str:
    """Return the token of an entry of Φ_q, counted from 1."""
    return f"entry-{row}-{column}"


def make_sum_token(row: int) -> str:
    """Return the token of the line of C that sums a component of Φ, highlighted with each of its terms."""
    return f"sum-{row}"


def make_owner_token(row: Row) -> str:
    """Return the token of the joint or drive to which a row belongs."""
    return f"{row.kind}-{row.owner}"


def list_entry_tokens(model: Model, number: int, row: Row) -> Iterator[str]:
    """Return the tokens of the nonzero entries of Φ_q of a constraint equation, whose `number` counts from 1."""
    column_of = {q: k for k, q in enumerate(model.q, 1)}
    return (make_entry_token(number, column_of[q]) for q in row.phi_q)


def list_joint_tokens(clearance: Clearance) -> list[str]:
    """Return the tokens of a joint with play; a slider's corner has one of its own in addition."""
    return [*dict.fromkeys((f"joint-{clearance.label}", f"joint-{clearance.joint.name}"))]

"""Represents a document of equations before its layout: sections of paragraphs, equations, tables and sketches.

Every formula has a LaTeX and a plain text form; HTML converts the LaTeX to MathML. `tokens` are the highlighting tokens
of a block (trace.py); blocks that share a token are highlighted together (highlighting.js). `value` is the name of the
value that a running page shows next to the block (current_values.js); both are for HTML only.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import TypeAlias

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.play import Clearance
from gudgeon.generator.targets.latex.letters import Formula

COLUMN_GAP = 4  # columns without a letter between parts of a sketch

Text: TypeAlias = tuple[str | Formula, ...]  # words and formulas in one line


@dataclass(frozen=True)
class Paragraph:
    """Represent a paragraph of words and formulas."""

    text: Text
    tokens: Sequence[str] = ()
    kind: str = "paragraph"

    @property
    def keeps_with_next(self) -> bool:
        """Return whether the next block belongs on the same page, since the paragraph ends with a colon."""
        return isinstance(self.text[-1], str) and self.text[-1].endswith(":")


@dataclass(frozen=True)
class Equation:
    """Represent an equation left = terms; a line may break before a term."""

    left: Formula
    terms: tuple[Formula, ...]
    tokens: Sequence[str] = ()
    selection_token: str = ""  # the token that selecting the equation highlights; "" for all of `tokens`
    value: str = ""
    kind: str = "equation"


@dataclass(frozen=True)
class Table:
    """Represent a table; `text_columns` are the indices of columns with running text.

    `transposes_on_phone`: on a phone its columns become rows.
    """

    header: tuple[Text, ...]
    rows: tuple[tuple[Text, ...], ...]
    text_columns: tuple[int, ...] = ()
    row_tokens: tuple[Sequence[str], ...] = ()
    transposes_on_phone: bool = False
    kind: str = "table"

    def get_row_tokens(self, row: int) -> Sequence[str]:
        """Return the highlighting tokens of a row, counted from 0; () if the row has none."""
        return self.row_tokens[row] if row < len(self.row_tokens) else ()


@dataclass(frozen=True)
class Sketch:
    """Represent a sketch in characters, whose columns must stay aligned."""

    lines: tuple[str, ...]
    kind: str = "sketch"

    @property
    def parts(self) -> list[tuple[str, ...]]:
        """Return the parts of a sketch that narrow pages may put below each other, each as its lines.

        Parts are separated by a blank line, or by at least COLUMN_GAP columns without a letter.
        """
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
    """Represent a drawing: SVG in HTML; aligned lines of characters in LaTeX and text, () for none."""

    caption: str
    svg: str
    lines: tuple[str, ...] = ()
    kind: str = "picture"


@dataclass(frozen=True)
class Listing:
    """Represent the listing of a file in HTML, with highlighting tokens by line from 1; other formats omit it."""

    title: str
    lines: tuple[str, ...]
    tokens_by_line: Mapping[int, Collection[str]]
    kind: str = "listing"


@dataclass(frozen=True)
class EmbeddedHtml:
    """Represent HTML that is inserted as it is; other formats omit it."""

    html: str
    kind: str = "html"


Block: TypeAlias = Paragraph | Equation | Table | Sketch | Picture | Listing | EmbeddedHtml


@dataclass(frozen=True)
class Section:
    """Represent a section: its title, its blocks, and the level of its heading."""

    title: str
    blocks: tuple[Block, ...]
    level: int = 1
    tokens: Sequence[str] = ()


@dataclass(frozen=True)
class Document:
    """Represent a document: its title, facts under the title, and sections."""

    title: str
    facts: tuple[Text, ...]  # under the title
    sections: tuple[Section, ...] = field(default=())


def make_paragraph(*text: str | Formula, tokens: Sequence[str] = ()) -> Paragraph:
    """Return words and formulas as a paragraph with the given highlighting tokens."""
    return Paragraph(text, tokens)


def make_sentence(text: str) -> str:
    """Return a text with a capital first letter and a full stop."""
    return f"{text[:1].upper()}{text[1:]}."


def make_row(*items: str | Formula | Text) -> tuple[Text, ...]:
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
    """Return the highlighting token of a constraint equation, counted from 1: "row-3"."""
    return f"row-{number}"


def make_entry_token(row: int, column: int) -> str:
    """Return the highlighting token of an entry of Φ_q, row and column counted from 1: "entry-3-1"."""
    return f"entry-{row}-{column}"


def make_sum_token(row: int) -> str:
    """Return the token of the line of C that sums a component of Φ, highlighted with each of its terms."""
    return f"sum-{row}"


def make_owner_token(row: Row) -> str:
    """Return the token of the joint or drive to which a row belongs."""
    return f"{row.kind}-{row.owner}"


def list_entry_tokens(model: Model, number: int, row: Row) -> Iterator[str]:
    """Return the highlighting tokens of the nonzero entries of Φ_q of a constraint equation; `number` counts from 1."""
    column_of = {q: k for k, q in enumerate(model.q, 1)}
    return (make_entry_token(number, column_of[q]) for q in row.phi_q)


def list_joint_tokens(clearance: Clearance) -> list[str]:
    """Return the highlighting tokens of a joint with play, without duplicates.

    A slider's corner has two: its own and that of its joint.
    """
    return [*dict.fromkeys((f"joint-{clearance.label}", f"joint-{clearance.joint.name}"))]

"""Assembles the document of a scene's equations and renders it as LaTeX, plain text or HTML (`gudgeon equations`)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.notes import write_scene_notes
from gudgeon.generator.targets.latex.document import (
    Block,
    Document,
    Equation,
    Paragraph,
    Picture,
    Section,
    Sketch,
    Table,
    Text,
    make_paragraph,
    make_row,
    make_sentence,
    make_tables,
)
from gudgeon.generator.targets.latex.kinematics import make_kinematics_sections
from gudgeon.generator.targets.latex.letters import Formula
from gudgeon.generator.targets.latex.listings import make_listing_sections, print_scripts
from gudgeon.generator.targets.latex.mechanism import make_mechanism_sections
from gudgeon.generator.targets.latex.motion import make_motion_sections
from gudgeon.generator.targets.latex.notation import Notation, make_notation
from gudgeon.generator.targets.latex.play import make_play_sections
from gudgeon.generator.targets.latex.reduction import make_reduction_sections
from gudgeon.generator.targets.latex.render import render_document
from gudgeon.generator.targets.latex.trace import Functions, make_highlight_index, make_scene_functions
from gudgeon.language.text_output import format_one_line

# docs/physics.md
PAPER = (
    "The numbers of laws of joints with play are those of the paper: X. Chen, S. Gao, T. Wang, Experimental "
    "verification of dynamic behavior for multi-link press mechanism with 2D revolute joint considering dry friction "
    "clearances and lubricated clearances, Nonlinear Dynamics, doi 10.1007/s11071-022-07478-4."
)


def make_document(model: Model, functions: Functions) -> Document:
    """Return the document of a scene: mechanism, kinematics, motion, joints with play, reduction, parts left out.

    A table of primed symbols comes first, and the reference of the paper last, if the sections use them. functions: the
    functions of the scene (trace.py).
    """
    mechanism, notation = model.scene.mechanism, make_notation(model)
    scene_notes = write_scene_notes(model)
    sections = [
        *make_mechanism_sections(model, notation),
        *make_kinematics_sections(model, notation),
        *make_motion_sections(model, notation),
        *make_play_sections(model, notation, functions),
        *make_reduction_sections(functions),
        *(
            [Section("Left out of this scene", tuple(make_paragraph(make_sentence(n)) for n in scene_notes))]
            if scene_notes
            else []
        ),
    ]
    facts = (("mechanism ", mechanism.name, ", scene ", model.scene.name),)
    return Document(
        format_one_line(mechanism.title or mechanism.name),
        facts,
        append_paper_section(prepend_symbols_section(sections, notation)),
    )


def prepend_symbols_section(sections: Sequence[Section], notation: Notation) -> tuple[Section, ...]:
    """Return the sections, preceded by a table of the primed symbols and their meaning if there are any."""
    table_blocks = make_primed_symbols_table(
        notation, (name for section in sections for block in section.blocks for name in _list_formulas(block))
    )
    return (Section("Symbols", tuple(table_blocks)), *sections) if table_blocks else (*sections,)


def make_primed_symbols_table(notation: Notation, formulas: Iterable[Formula]) -> list[Block]:
    """Return an introduction and the table of the primed symbols that occur in `formulas`; [] if there are none."""
    text = " ".join(name.text for name in formulas)
    rows = [
        make_row(primed_symbol.name, primed_symbol.meaning, primed_symbol.plain_name, primed_symbol.plain_meaning)
        for primed_symbol in notation.primed_symbols
        if primed_symbol.name.text in text
    ]
    introduction = make_paragraph("A prime distinguishes two quantities with the same symbol. It is not a derivative:")
    header = make_row("symbol", "meaning", "without the prime", "meaning")
    return [introduction, *make_tables(header, rows, (3,))] if rows else []


def _list_formulas(block: Block) -> Iterator[Formula]:
    """Yield the formulas of a block: of an equation, a paragraph or a table; other blocks have none."""
    if isinstance(block, Equation):
        yield from (block.left, *block.terms)
    yield from (part for text in _list_texts(block) for part in text if isinstance(part, Formula))


def _list_texts(block: Block) -> list[Text]:
    """Return the texts of a block, a paragraph's or those of a table's cells and header; [] for other blocks."""
    if isinstance(block, Table):
        return [cell for row in (block.header, *block.rows) for cell in row]
    return [block.text] if isinstance(block, Paragraph) else []


def append_paper_section(sections: Sequence[Section]) -> tuple[Section, ...]:
    """Return the sections, followed by one with the reference of the paper if any block contains "the paper"."""
    is_named = any(_mentions_paper(block) for section in sections for block in section.blocks)
    return (*sections, Section("The paper", (make_paragraph(PAPER),))) if is_named else (*sections,)


def _mentions_paper(block: Block) -> bool:
    """Return whether a block contains the words "the paper": a sketch, picture, paragraph or cell of a table."""
    if isinstance(block, (Sketch, Picture)):
        return any("the paper" in line for line in block.lines)
    return any(isinstance(part, str) and "the paper" in part for text in _list_texts(block) for part in text)


def render_equations_tex(model: Model) -> str:
    """Return the equations of a scene as a LaTeX file for pdflatex and amsmath, in ASCII."""
    return render_document(make_document(model, make_scene_functions(model)), "tex")


def render_equations_text(model: Model) -> str:
    """Return the equations of a scene as plain Unicode text, 100 columns wide."""
    return render_document(make_document(model, make_scene_functions(model)), "txt")


def render_equations_html(
    model: Model, *, head: str = "", app: str = "", scripts: str = "", source: KernelSource | None = None
) -> str:
    """Return the equations of a scene as one HTML file with MathML, its file and its C, linked with each other.

    head, app, scripts: further HTML in the page's head, below its title and at its end. source: the emitted C, if it
    is known. Raises GudgeonError without the extra `docs`.
    """
    page_trace = make_highlight_index(model, source)
    document = make_document(model, page_trace)
    document = replace(document, sections=(*document.sections, *make_listing_sections(model, page_trace)))
    return render_document(document, "html", head=head, app=app, scripts=print_scripts() + scripts)

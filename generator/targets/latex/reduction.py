"""Writes the part of the document on the integrated equations: log of the reduction, tree, formulations, C files."""

from __future__ import annotations

from collections.abc import Collection

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.reduction_log import Solve
from gudgeon.contract.reduction_words import outcome, reduction_lines
from gudgeon.generator.targets.c.readme import purposes
from gudgeon.generator.targets.latex.document import Block, Section, cells, paragraph, sentence, table
from gudgeon.generator.targets.latex.pictures import tree
from gudgeon.generator.targets.latex.trace import Functions


def reduction_sections(found: Functions) -> list[Section]:
    """Return the sections on how the equations are reduced, what that saves, and where the C is."""
    source = found.source
    return [
        Section("From all coordinates to few", tuple(_reduction_log(source, found.model.scene.mechanism.joints))),
        Section("Full and reduced, side by side", tuple(_comparison_table(found))),
        Section("The C, file by file", tuple(_files(found))),
    ]


def _reduction_log(source: KernelSource, joints: Collection[str]) -> list[Block]:
    """Return the log of the reduction as `gudgeon check -v` prints it."""
    ledger = [cells(f"{n:,}", f"{m:,}", f"{text}.") for n, m, text in reduction_lines(source)]
    story = [cells(name, f"{text}.") for name, text in outcome(source)]
    return [
        paragraph("Coordinates and rows that are left, step by step, and what took the others:"),
        *table(cells("coordinates", "rows", "step"), ledger, (2,)),
        *table(cells("", "what it comes to"), story, (1,)),
        *tree(source.story, joints),
    ]


def _comparison_table(found: Functions) -> list[Block]:
    """Return the table of sizes and operations of both formulations."""
    source, story = found.source, found.source.story
    counts = source.operations
    reduced = "arrive" if "arrive" in counts else "reduced_dynamics"
    rows = [
        ("coordinates", len(source.coordinates), len(source.tree)),
        ("rows of constraints", len(source.rows), len(source.closures)),
        *_of_matrix(story.before, story.after),
        ("operations of a right-hand side", counts["dynamics"], counts.get(reduced)),
    ]
    shown = [cells(name, *("none" if x is None else f"{x:,}" for x in both)) for name, *both in rows]
    operations = [cells(name, f"{count:,}") for name, count in counts.items() if count]
    return [
        *table(cells("", "full", "reduced"), shown),
        paragraph("Additions, multiplications, divisions and calls of functions that each function of the C performs:"),
        *table(cells("function", "operations"), operations),
    ]


def _of_matrix(before: Solve | None, after: Solve | None) -> list[tuple[str, int | None, int | None]]:
    """Return rows of the table on the factored matrix: (what, full, reduced)."""

    def both(of: str) -> tuple[int | None, int | None]:
        """Return a property of the factored matrix in the full and in the reduced formulation."""
        full, reduced = (getattr(solve, of) if solve else None for solve in (before, after))
        return full, reduced

    return [
        ("rows of the matrix that is factored", *both("size")),
        ("its entries that are not zero", *both("entries")),
        ("entries of its factor", *both("factor")),
    ]


def _files(found: Functions) -> list[Block]:
    """Return the list of files in the order in which they are to be read."""
    message = purposes(found.program)
    names = [name for name in message if name in found.files]
    rows = [cells(name, sentence(message[name].replace("`", ""))) for name in names]
    return [
        paragraph("What gudgeon emit writes. First comes model.h, for the names, then dynamics.c, the textbook's."),
        *table(cells("file", "what it holds"), rows, (1,)),
    ]

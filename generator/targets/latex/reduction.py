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


def reduction_sections(functions: Functions) -> list[Section]:
    """Return the sections on the reduction to few coordinates, the sizes of both formulations, and the C files."""
    source = functions.source
    return [
        Section(
            "From all coordinates to few", tuple(_describe_reduction(source, functions.model.scene.mechanism.joints))
        ),
        Section("Full and reduced, side by side", tuple(_compare_formulations(functions))),
        Section("The C, file by file", tuple(_describe_files(functions))),
    ]


def _describe_reduction(source: KernelSource, joints: Collection[str]) -> list[Block]:
    """Return the log of the reduction as `gudgeon check -v` prints it, and the picture of the tree.

    joints: the names of the file's joints.
    """
    step_rows = [cells(f"{n:,}", f"{m:,}", f"{text}.") for n, m, text in reduction_lines(source)]
    outcome_rows = [cells(name, f"{text}.") for name, text in outcome(source)]
    return [
        paragraph("Coordinates and rows that are left, step by step, and what took the others:"),
        *table(cells("coordinates", "rows", "step"), step_rows, (2,)),
        *table(cells("", "what it comes to"), outcome_rows, (1,)),
        *tree(source.story, joints),
    ]


def _compare_formulations(functions: Functions) -> list[Block]:
    """Return a table of sizes and operations of both formulations, and one of operations of each C function."""
    source, log = functions.source, functions.source.story
    counts = source.operations
    reduced_function = "arrive" if "arrive" in counts else "reduced_dynamics"
    rows = [
        ("coordinates", len(source.coordinates), len(source.tree)),
        ("rows of constraints", len(source.rows), len(source.closures)),
        *_compare_matrices(log.before, log.after),
        ("operations of a right-hand side", counts["dynamics"], counts.get(reduced_function)),
    ]
    size_rows = [cells(name, *("none" if x is None else f"{x:,}" for x in values)) for name, *values in rows]
    operations = [cells(name, f"{count:,}") for name, count in counts.items() if count]
    return [
        *table(cells("", "full", "reduced"), size_rows),
        paragraph("Additions, multiplications, divisions and calls of functions that each function of the C performs:"),
        *table(cells("function", "operations"), operations),
    ]


def _compare_matrices(
    full_solve: Solve | None, reduced_solve: Solve | None
) -> list[tuple[str, int | None, int | None]]:
    """Return (meaning, full, reduced) of the factored matrix: its size, its entries and those of its factor.

    None stands for a formulation that factors no matrix.
    """

    def get_both(property_name: str) -> tuple[int | None, int | None]:
        """Return a property of the factored matrix in the full and in the reduced formulation."""
        full, reduced = (getattr(solve, property_name) if solve else None for solve in (full_solve, reduced_solve))
        return full, reduced

    return [
        ("rows of the matrix that is factored", *get_both("size")),
        ("its entries that are not zero", *get_both("entries")),
        ("entries of its factor", *get_both("factor")),
    ]


def _describe_files(functions: Functions) -> list[Block]:
    """Return the table of the scene's C files with their purposes, in the order in which they are to be read."""
    purpose_by_file = purposes(functions.program)
    names = [name for name in purpose_by_file if name in functions.files]
    rows = [cells(name, sentence(purpose_by_file[name].replace("`", ""))) for name in names]
    return [
        paragraph("What gudgeon emit writes. First comes model.h, for the names, then dynamics.c, the textbook's."),
        *table(cells("file", "what it holds"), rows, (1,)),
    ]

"""Writes the sections on the reduction to tree coordinates for a document.

They contain the reduction steps, the spanning tree, the numbers of coordinates, equations and operations of both
formulations, and the C files.
"""

from __future__ import annotations

from collections.abc import Collection

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.contract.reduction_description import describe_reduced_system, describe_reduction_steps
from gudgeon.contract.reduction_log import Solve
from gudgeon.generator.targets.c.readme import list_file_purposes
from gudgeon.generator.targets.latex.document import (
    Block,
    Section,
    make_paragraph,
    make_row,
    make_sentence,
    make_tables,
)
from gudgeon.generator.targets.latex.pictures import draw_tree
from gudgeon.generator.targets.latex.trace import Functions


def make_reduction_sections(functions: Functions) -> list[Section]:
    """Return the sections on the reduction to few coordinates, the sizes of both formulations, and the C files."""
    source = functions.source
    return [
        Section(
            "Reduction to tree coordinates", tuple(_describe_reduction(source, functions.model.scene.mechanism.joints))
        ),
        Section("Full and reduced formulation compared", tuple(_compare_formulations(functions))),
        Section("The files of C", tuple(_describe_files(functions))),
    ]


def _describe_reduction(source: KernelSource, joints: Collection[str]) -> list[Block]:
    """Return tables of the reduction's steps and results, as `gudgeon check -v` prints them, and the tree's picture.

    joints: the names of the file's joints, which the picture links with their equations.
    """
    step_rows = [make_row(f"{n:,}", f"{m:,}", f"{text}.") for n, m, text in describe_reduction_steps(source)]
    outcome_rows = [make_row(name, f"{text}.") for name, text in describe_reduced_system(source)]
    return [
        make_paragraph(
            "Remaining coordinates and constraint equations after each step, and the step that eliminated the others:"
        ),
        *make_tables(make_row("coordinates", "rows", "step"), step_rows, (2,)),
        *make_tables(make_row("", "result"), outcome_rows, (1,)),
        *draw_tree(source.reduction_log, joints),
    ]


def _compare_formulations(functions: Functions) -> list[Block]:
    """Return a table that compares sizes and operations of both formulations, and one of operations of each C function.

    "none" stands for a formulation without the quantity.
    """
    source, log = functions.source, functions.source.reduction_log
    counts = source.operations
    reduced_function = "compute_body_motion" if "compute_body_motion" in counts else "reduced_dynamics"
    rows = [
        ("coordinates", len(source.coordinates), len(source.tree_coordinates)),
        ("constraint equations", len(source.equations), len(source.closures)),
        *_compare_matrices(log.before, log.after),
        ("operations of a right-hand side", counts["dynamics"], counts.get(reduced_function)),
    ]
    size_rows = [make_row(name, *("none" if x is None else f"{x:,}" for x in values)) for name, *values in rows]
    operations = [make_row(name, f"{count:,}") for name, count in counts.items() if count]
    return [
        *make_tables(make_row("", "full", "reduced"), size_rows),
        make_paragraph("Additions, multiplications, divisions and function calls in each function of the C:"),
        *make_tables(make_row("function", "operations"), operations),
    ]


def _compare_matrices(
    full_solve: Solve | None, reduced_solve: Solve | None
) -> list[tuple[str, int | None, int | None]]:
    """Return (meaning, full, reduced) of the factored matrix: its size, its entries and those of its factor.

    None stands for a formulation that factors no matrix.
    """

    def get_full_and_reduced(property_name: str) -> tuple[int | None, int | None]:
        """Return (full, reduced) of a property of the factored matrix; None without a matrix."""
        full, reduced = (getattr(solve, property_name) if solve else None for solve in (full_solve, reduced_solve))
        return full, reduced

    return [
        ("rows of the factored matrix", *get_full_and_reduced("size")),
        ("nonzero entries of this matrix", *get_full_and_reduced("entries")),
        ("entries of the factor", *get_full_and_reduced("factor")),
    ]


def _describe_files(functions: Functions) -> list[Block]:
    """Return the table of the scene's C files with their purposes, in the order in which they are to be read."""
    purpose_by_file = list_file_purposes(functions.program)
    names = [name for name in purpose_by_file if name in functions.files]
    rows = [make_row(name, make_sentence(purpose_by_file[name].replace("`", ""))) for name in names]
    return [
        make_paragraph(
            "Files that gudgeon emit writes. Read model.h first, for the names, then dynamics.c, the equations "
            "of a textbook."
        ),
        *make_tables(make_row("file", "contents"), rows, (1,)),
    ]

"""Print and write the results of `gudgeon map --box`: counts of verdicts, the worst points, a CSV table, a figure."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.language.text_output import format_path, print_json
from gudgeon.studies.map import VerdictBox
from gudgeon.studies.show.map import (
    COLOURS,
    FULL_FORMULATION_NOTE,
    VERDICT_SIGNS,
    describe_comparison,
    describe_interruption,
    list_cell_rows,
    print_failures,
)
from gudgeon.studies.show.tables import (
    format_fraction,
    format_seconds,
    make_console,
    make_rich_table,
    write_table_and_figure,
)
from gudgeon.studies.verdicts import SEVERITY, Cell, Status

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.table import Table

MAX_WORST_POINTS = 8  # points that are printed with their command; the others are in the table on disk
_NUMBER = re.compile(r"(?:[<>] ?)?\d[\d.,]*(?:e[-+]?\d+)?(?: %)?")


def report_box(
    source: KernelSource, mechanism: str, boxes: Sequence[VerdictBox], table_path: Path, as_json: bool = False
) -> None:
    """Write the verdicts of `gudgeon map --box` as a CSV table and a figure next to it, and print a summary.

    mechanism: name or file as typed, for the commands that repeat runs. as_json: print JSON instead. An OutputError for
    a file is raised after printing.
    """
    rows = [row for box in boxes for row in list_cell_rows(box)]

    def draw_figure() -> Figure:
        """Return the figure of the boxes."""
        from gudgeon.studies.show.box_figure import draw_box_figure

        return draw_box_figure(source.title or source.mechanism, boxes)

    written_paths, failed = write_table_and_figure(table_path, rows, draw_figure)
    _print_box(source, mechanism, boxes, written_paths, as_json)
    if failed:
        raise failed


def _print_box(
    source: KernelSource, mechanism: str, boxes: Sequence[VerdictBox], written_paths: Sequence[Path], as_json: bool
) -> None:
    """Print for each box the counts and the table of verdicts and the worst points with the commands that repeat them.

    The written files follow. With `as_json` it prints one JSON document with the rows of the CSV table instead.
    """
    if as_json:
        rows = [row for verdict_box in boxes for row in list_cell_rows(verdict_box)]
        print_json(
            {
                "mechanism": source.mechanism,
                "interrupted": any(box.interrupted for box in boxes),
                "cells": rows,
                "files": [str(path) for path in written_paths],
            }
        )
        return
    console = make_console()
    for box in boxes:
        ranges_text = ", ".join(f"{range_.name} {range_.low:.4g} … {range_.high:.4g}" for range_ in box.ranges)
        title = (
            f"{box.scene}, {box.setting.method} at {box.setting}, {format_seconds(box.t_long)} per point: {ranges_text}"
        )
        console.print(title + describe_interruption(box), style="bold")
        if box.full:
            console.print(f"  {FULL_FORMULATION_NOTE}")
        console.print(f"  {describe_verdict_counts(box.cells)}")
        console.print(f"  {describe_comparison(box)}")
        console.print(_build_verdict_table(box.cells))
        if worst := select_worst_cells(box.cells):
            console.print("  the worst points, and the commands that repeat them")
            print_failures(console, mechanism, box, worst)
    for path in written_paths:
        console.print(f"wrote {format_path(path)}")


def describe_verdict_counts(cells: Sequence[Cell]) -> str:
    """Return the number of points of each verdict: "28 points: 27 stable, 1 outside the model; slowest 0.3 s".

    "slowest" is the longest processor time of a long run.
    """
    counts = Counter(cell.status for cell in cells)
    message = ", ".join(f"{counts[status]} {status.value}" for status in Status if counts[status])
    slowest = max((cell.seconds for cell in cells if math.isfinite(cell.seconds)), default=math.nan)
    return f"{len(cells)} points: {message}; slowest {format_seconds(slowest)}"


def group_cells(cells: Sequence[Cell]) -> list[tuple[Status, str, list[Cell]]]:
    """Return the cells in groups (status, reason, cells) of equal verdict and equal reason without its numbers.

    Groups are sorted by verdict, the worst first, then by size, the largest first.
    """
    groups: dict[tuple[Status, str], list[Cell]] = {}
    for cell in cells:
        groups.setdefault((cell.status, remove_numbers(cell.reason)), []).append(cell)
    sorted_groups = sorted(groups.items(), key=lambda group: (SEVERITY.index(group[0][0]), -len(group[1]), group[0][1]))
    return [(status, reason, cells_of_group) for (status, reason), cells_of_group in sorted_groups]


def remove_numbers(reason: str) -> str:
    """Return a reason with "…" for numbers and cut before " at t = " or ": ", as a key that equal reasons share.

    "no step is small enough at t = 0.3 s" becomes "no step is small enough".
    """
    return _NUMBER.sub("…", re.split(r",? at t = |: ", reason)[0]).strip(", ")


def select_worst_cells(cells: Sequence[Cell]) -> list[Cell]:
    """Return at most MAX_WORST_POINTS failed cells, in turn one from each group of equal reason, the worst group first.

    Without failed cells they are the MAX_WORST_POINTS // 2 cells with the largest errors, largest first.
    """
    if not any(cell.failed for cell in cells):
        finite_cells = [cell for cell in cells if math.isfinite(cell.error.largest)]
        return sorted(finite_cells, key=lambda cell: -cell.error.largest)[: MAX_WORST_POINTS // 2]
    groups = [failed_cells for status, _, failed_cells in group_cells([cell for cell in cells if cell.failed])]
    rounds = [group[k] for k in range(MAX_WORST_POINTS) for group in groups if k < len(group)]
    return rounds[:MAX_WORST_POINTS]


def _build_verdict_table(cells: Sequence[Cell]) -> Table:
    """Return the rich table of verdicts: for each verdict and reason the number of points and the largest error."""
    from rich.text import Text

    table = make_rich_table(("verdict", "points", "largest error", "reason"), left_aligned=("verdict", "reason"))
    for status, reason, cells_of_group in group_cells(cells):
        errors = [cell.error.largest for cell in cells_of_group if math.isfinite(cell.error.largest)]
        sign = Text(f"{VERDICT_SIGNS[status]} {status.value}", COLOURS[status])
        table.add_row(sign, str(len(cells_of_group)), format_fraction(max(errors, default=math.nan)), reason)
    return table

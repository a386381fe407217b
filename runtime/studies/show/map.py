"""Print and write the results of `gudgeon map`: maps, failures with all their values, CSV, JSON, a figure."""

from __future__ import annotations

import math
import shlex
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.language.plot_units import format_quantity
from gudgeon.language.text_output import format_path, print_json
from gudgeon.studies.axes import Axis
from gudgeon.studies.map import VerdictBox, VerdictMap
from gudgeon.studies.runs import Setting
from gudgeon.studies.show.tables import (
    format_clearance,
    format_fraction,
    format_seconds,
    make_console,
    make_table,
    write_table_and_figure,
)
from gudgeon.studies.verdicts import Cell, Status

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

COLOURS = {
    Status.STABLE: "green",
    Status.OUTSIDE: "bright_black",
    Status.INACCURATE: "yellow",
    Status.DIVERGED: "red",
    Status.MISSING: "bright_black",
}
FULL = "integrated in the full formulation (absolute coordinates): the gains act there alone"
SIGNS = {Status.STABLE: "✓", Status.OUTSIDE: "○", Status.INACCURATE: "≈", Status.DIVERGED: "✗", Status.MISSING: "·"}
PASCAL = {"kg/m/s^2": "Pa", "kg/m/s": "Pa*s"}  # what only base units are known of
# meaning of the first word of a cell's label; printed if a cell has it
LABELS = {
    "at": "at: when the run failed",
    "energy": "energy: residual, or it comes from nowhere",
    "motion": "motion: coordinates off by, of the size",
    "force": "force: a joint's force off by, of its peak",
    "path": "path: a journal's path off by, of the clearance",
    "through": "through: a journal left its bearing",
    "lost": "lost: a contact was",
    "|Φ|": "|Φ|: constraints open",
    "?": "?: the finer run fails",
    "–": "–: not judged",
    "δ": "δ: penetration beyond half the clearance or a hundredth of the bearing's radius",
}


def report_map(
    source: KernelSource,
    mechanism: str,
    maps: Sequence[VerdictMap],
    table_path: Path,
    marked_step: float | None,
    as_json: bool = False,
) -> None:
    """Print the maps of `gudgeon map` (with `as_json` as JSON), and write the table as CSV and the figure next to it.

    mechanism: name or file as typed, for the commands that repeat runs. marked_step (s): step that is marked, or None.
    An OutputError for a file is raised after printing.
    """
    rows = [row for verdict_map in maps for row in list_cell_rows(verdict_map)]

    def draw_figure() -> Figure:
        """Return the figure of the maps."""
        from gudgeon.studies.show.map_figure import draw_map_figure

        return draw_map_figure(source.title or source.mechanism, maps, marked_step)

    written_paths, failed = write_table_and_figure(table_path, rows, draw_figure)
    _print_maps(source, mechanism, maps, written_paths, marked_step, as_json)
    if failed:
        raise failed


def _print_maps(
    source: KernelSource,
    mechanism: str,
    maps: Sequence[VerdictMap],
    written_paths: Sequence[Path],
    marked_step: float | None,
    as_json: bool,
) -> None:
    """Print the maps with stability limits or failures, legend, the marked step and written files; or one JSON
    document.
    """
    if as_json:
        rows = [row for verdict_map in maps for row in list_cell_rows(verdict_map)]
        print_json(
            {
                "mechanism": source.mechanism,
                "interrupted": any(verdict_map.interrupted for verdict_map in maps),
                "cells": rows,
                "files": [str(path) for path in written_paths],
            }
        )
        return
    out = make_console()
    for verdict_map in maps:
        title = (
            f"{verdict_map.scene}, {verdict_map.setting.method}: sane over {format_seconds(verdict_map.t_long)}, "
            f"{describe_comparison(verdict_map)}"
        )
        out.print(title + describe_interruption(verdict_map), style="bold")
        if verdict_map.full:
            out.print(f"  {FULL}")
        if verdict_map.columns.ratios:
            out.print(f"  {verdict_map.rows.name} down, {verdict_map.columns.name} across")
        out.print(_build_map_table(verdict_map))
        if verdict_map.rows.name == "step":
            out.print(_build_boundary_table(verdict_map))
        elif failures := [cell for cell in verdict_map.cells if cell.failed]:
            out.print("  what failed, and what runs it again")
            print_failures(out, mechanism, verdict_map, failures)
    out.print(make_legend(maps))
    for line in explain_labels(maps).splitlines():
        out.print(f"  {line}")
    for line in describe_marked_step(maps, marked_step):
        out.print(line)
    for path in written_paths:
        out.print(f"wrote {format_path(path)}")


def _build_map_table(verdict_map: VerdictMap) -> Table:
    """Return the table of a map; each cell has the sign of its verdict and its label."""
    from rich.text import Text

    heads = [format_axis_value(verdict_map.columns, x) for x in verdict_map.columns.values]
    table = make_table([verdict_map.rows.name, *heads])
    for row in verdict_map.rows.values:
        cells = (verdict_map.get_cell(row, x) for x in verdict_map.columns.values)
        marked = (Text(f"{SIGNS[cell.status]} {cell.label}", COLOURS[cell.status]) for cell in cells)
        table.add_row(format_axis_value(verdict_map.rows, row), *marked)
    return table


def _build_boundary_table(verdict_map: VerdictMap) -> Table:
    """Return the table of the largest stable step for each column, with the fault of the next longer step."""
    name = verdict_map.columns.name
    table = make_table((name, "largest stable step", "the next one"), left_aligned=("the next one",))
    for x in verdict_map.columns.values:
        largest = verdict_map.find_largest_stable_row(x)
        next_step = next((step for step in verdict_map.rows.values if not step <= largest), None)
        cell = verdict_map.get_cell(next_step, x) if next_step is not None else None
        after = f"{cell.setting}, {cell.status.value}: {cell.reason}" if cell else "the grid ends"
        table.add_row(
            format_axis_value(verdict_map.columns, x), format_seconds(largest) if largest == largest else "none", after
        )
    return table


def print_failures(console: Console, mechanism: str, verdicts: VerdictMap | VerdictBox, cells: Sequence[Cell]) -> None:
    """Print the reasons of cells and the command that repeats each, on one line so that it can be copied.

    mechanism: name or file as typed. A cell without a reason is shown with its largest error.
    """
    laws = list_law_files()
    for cell in cells:
        specified = cell.reason or f"largest error {format_fraction(cell.error.largest)}"
        console.print(f"  {SIGNS[cell.status]} {specified}", markup=False, emoji=False)
        again = format_run_command(mechanism, verdicts.scene, cell, verdicts.t_long, verdicts.full, laws)
        console.print(f"    {again}", markup=False, emoji=False, soft_wrap=True)


def describe_interruption(verdicts: VerdictMap | VerdictBox) -> str:
    """Return the part of a title that says how many runs were finished before Ctrl-C; "" if it was not interrupted."""
    return " (partial: interrupted after {} of {} runs)".format(*verdicts.done) if verdicts.interrupted else ""


def make_legend(verdicts: Sequence[VerdictMap | VerdictBox]) -> Text:
    """Return the signs and names of all verdicts in colour; "not judged" only after Ctrl-C."""
    from rich.text import Text

    shown = [s for s in Status if s is not Status.MISSING or any(verdict_map.interrupted for verdict_map in verdicts)]
    return Text("   ").join(Text(f"{SIGNS[status]} {status.value}", COLOURS[status]) for status in shown)


def format_run_command(
    mechanism: str, scene: str, cell: Cell, t_end: float, full: bool = False, laws: Sequence[str] = ()
) -> str:
    """Return the shell command that repeats the run of a cell: `gudgeon run` with scene, setting, parameters and end
    time.

    mechanism: name or file as typed. full: in the full formulation. laws: files of user-defined laws.
    """
    words = ["gudgeon", "run", f"./{mechanism}" if mechanism.startswith("-") else mechanism, "--scene", scene]
    words += [
        "--method",
        cell.setting.method,
        "--step" if cell.setting.has_fixed_step else "--rtol",
        repr(cell.setting.value),
    ]
    words += ["--formulation", "full"] if full else []
    for name, message in cell.parameters.items():
        words += ["--set", f"{name}={message}"]
    for law in laws:
        words += ["--laws", law]
    return shlex.join([*words, "--t-end", repr(t_end)])


def list_law_files() -> list[str]:
    """Return the files of the registered user-defined laws, as they were typed; laws registered otherwise are left
    out.
    """
    from gudgeon.generator.kinds.laws.registered import ORIGINS

    return [origin.typed for origin in ORIGINS.values() if origin.typed]


def describe_marked_step(maps: Sequence[VerdictMap], marked_step: float | None) -> list[str]:
    """Return a line for each map over steps on the marked step: counts of its verdicts, and the step that suits all
    columns.

    Empty without a marked step, or if no map has it.
    """
    lines = []
    for verdict_map in (s for s in maps if s.rows.name == "step"):
        step = next(
            (x for x in verdict_map.rows.values if marked_step is not None and math.isclose(x, marked_step)), None
        )
        if step is None:
            continue
        cells = [verdict_map.get_cell(step, x) for x in verdict_map.columns.values]
        counts = Counter(cell.status for cell in cells)
        message = ", ".join(f"{counts[status]} {status.value}" for status in Status if counts[status])
        best = [x for x in map(verdict_map.find_largest_stable_row, verdict_map.columns.values) if x == x]
        shortest = format_seconds(min(best)) if len(best) == len(cells) else "below the grid"
        lines.append(
            f"step {format_seconds(step)}, {verdict_map.scene}: of {len(cells)} columns {message}; "
            f"a step for all: {shortest}"
        )
    return lines


def list_cell_rows(verdicts: VerdictMap | VerdictBox) -> list[dict[str, Any]]:
    """Return the rows of the CSV and JSON files: for each cell its setting, parameters, verdict, errors and times
    (SI).
    """
    return [
        {
            "scene": verdicts.scene,
            "method": cell.setting.method,
            "step_or_tolerance": cell.setting.value,
            "parameters": " ".join(f"{name}={x}" for name, x in cell.parameters.items()),
            "status": cell.status.value,
            "reason": cell.reason,
            "energy_residual_share": cell.energy,
            "penetration_m": cell.penetration,
            "error_coordinates": cell.error.motion,
            "error_path": cell.error.path,
            "error_force": cell.error.force,
            "compared_s": cell.compared,
            "seconds": cell.seconds,
        }
        for cell in verdicts.cells
    ]


def format_axis_value(axis: Axis, x: float) -> str:
    """Return a value of an axis as text: the word of a choice, a clearance in mm, a tolerance, or a quantity with its
    unit.
    """
    if axis.words:
        return axis.words[int(x)]
    if axis.name == "clearance":
        return format_clearance(x)
    if axis.name == "rtol":
        return str(Setting("auto", x))
    return format_seconds(x) if axis.unit == "s" else format_quantity(x, PASCAL.get(axis.unit, axis.unit), 3)


def explain_labels(maps: Sequence[VerdictMap]) -> str:
    """Return lines with the meaning of the labels that occur in the cells, two explanations in each."""
    used = {cell.label.split(" ")[0] for verdict_map in maps for cell in verdict_map.cells}
    message = dict.fromkeys(text for word, text in LABELS.items() if word in used)
    parts = ["a number: largest error against a finer run, over the time compared", *message]
    return "\n".join(" · ".join(parts[k : k + 2]) for k in range(0, len(parts), 2))


def describe_comparison(verdicts: VerdictMap | VerdictBox) -> str:
    """Return a text: over which time errors were computed, and against which finer setting.

    With dry contacts runs are comparable over the first few contacts only.
    """
    finer = "a 10× shorter step" if verdicts.setting.has_fixed_step else "a 100× tighter tolerance"
    ends = [cell.compared for cell in verdicts.cells if cell.compared == cell.compared]
    shortest, longest = (format_seconds(end) for end in (min(ends, default=0.0), max(ends, default=0.0)))
    over = shortest if shortest == longest else f"{shortest} … {longest}"
    return f"errors over the first {over}, against {finer}" if ends else f"nothing to compare with {finer}"

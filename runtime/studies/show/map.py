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
    make_rich_table,
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
FULL_FORMULATION_NOTE = "integrated in the full formulation (absolute coordinates), the only one with gains"
VERDICT_SIGNS = {
    Status.STABLE: "✓",
    Status.OUTSIDE: "○",
    Status.INACCURATE: "≈",
    Status.DIVERGED: "✗",
    Status.MISSING: "·",
}
PRESSURE_UNITS = {"kg/m/s^2": "Pa", "kg/m/s": "Pa*s"}  # derived units for parameters that have base units only
# meaning of the first word of a cell's label; printed if a cell has it
LABEL_MEANINGS = {
    "at": "at: time at which the run failed",
    "energy": "energy: energy residual",
    "motion": "motion: error of the coordinates, relative to the mechanism's size",
    "force": "force: error of a joint force, relative to its peak",
    "path": "path: error of a journal path, relative to the clearance",
    "through": "through: a journal passed through its bearing",
    "lost": "lost: a contact was missed",
    "|Φ|": "|Φ|: constraints violated",
    "?": "?: the finer run failed",
    "–": "–: not judged",
    "δ": "δ: penetration above half the clearance or a hundredth of the bearing radius",
}


def report_map(
    source: KernelSource,
    mechanism: str,
    maps: Sequence[VerdictMap],
    table_path: Path,
    marked_step: float | None,
    as_json: bool = False,
) -> None:
    """Write the maps of `gudgeon map` as a CSV table and a figure next to it, and print them (as JSON with `as_json`).

    mechanism: name or file as typed, for the commands that repeat runs. marked_step (s): row of this step that is
    marked; None for none. An OutputError for a file is raised after printing.
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
    """Print each map with its stability limits or failed runs, the legend, the marked step and the written files.

    With `as_json` it prints one JSON document with the rows of the CSV table instead.
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
            f"{verdict_map.scene}, {verdict_map.setting.method}: checked over {format_seconds(verdict_map.t_long)}, "
            f"{describe_comparison(verdict_map)}"
        )
        out.print(title + describe_interruption(verdict_map), style="bold")
        if verdict_map.full:
            out.print(f"  {FULL_FORMULATION_NOTE}")
        if verdict_map.columns.ratios:
            out.print(f"  rows: {verdict_map.rows.name}, columns: {verdict_map.columns.name}")
        out.print(_build_map_table(verdict_map))
        if verdict_map.rows.name == "step":
            out.print(_build_boundary_table(verdict_map))
        elif failures := [cell for cell in verdict_map.cells if cell.failed]:
            out.print("  failed runs, and the commands that repeat them")
            print_failures(out, mechanism, verdict_map, failures)
    out.print(make_legend(maps))
    for line in explain_labels(maps).splitlines():
        out.print(f"  {line}")
    for line in describe_marked_step(maps, marked_step):
        out.print(line)
    for path in written_paths:
        out.print(f"wrote {format_path(path)}")


def _build_map_table(verdict_map: VerdictMap) -> Table:
    """Return the rich table of a map: a row for each value of the row axis; cells have verdict sign and label."""
    from rich.text import Text

    heads = [format_axis_value(verdict_map.columns, x) for x in verdict_map.columns.values]
    table = make_rich_table([verdict_map.rows.name, *heads])
    for row in verdict_map.rows.values:
        cells = (verdict_map.get_cell(row, x) for x in verdict_map.columns.values)
        marked = (Text(f"{VERDICT_SIGNS[cell.status]} {cell.label}", COLOURS[cell.status]) for cell in cells)
        table.add_row(format_axis_value(verdict_map.rows, row), *marked)
    return table


def _build_boundary_table(verdict_map: VerdictMap) -> Table:
    """Return the rich table of stability limits: the largest stable step of each column, and the fault of the next
    step.

    It is called for maps whose rows are steps.
    """
    name = verdict_map.columns.name
    table = make_rich_table((name, "largest stable step", "next step"), left_aligned=("next step",))
    for x in verdict_map.columns.values:
        largest = verdict_map.find_stability_limit(x)
        next_step = next((step for step in verdict_map.rows.values if not step <= largest), None)
        cell = verdict_map.get_cell(next_step, x) if next_step is not None else None
        next_cell_text = f"{cell.setting}, {cell.status.value}: {cell.reason}" if cell else "none on the axis"
        table.add_row(
            format_axis_value(verdict_map.columns, x),
            format_seconds(largest) if largest == largest else "none",
            next_cell_text,
        )
    return table


def print_failures(console: Console, mechanism: str, verdicts: VerdictMap | VerdictBox, cells: Sequence[Cell]) -> None:
    """Print for each cell its reason and, on one line without wrapping, the shell command that repeats the run.

    mechanism: name or file as typed. verdicts: the map or box of the cells. A cell without a reason is printed with its
    largest error.
    """
    laws = list_law_display_paths()
    for cell in cells:
        description = cell.reason or f"largest error {format_fraction(cell.error.largest)}"
        console.print(f"  {VERDICT_SIGNS[cell.status]} {description}", markup=False, emoji=False)
        command = format_run_command(mechanism, verdicts.scene, cell, verdicts.t_long, verdicts.full, laws)
        console.print(f"    {command}", markup=False, emoji=False, soft_wrap=True)


def describe_interruption(verdicts: VerdictMap | VerdictBox) -> str:
    """Return " (partial: interrupted after 3 of 8 runs)" for a title; "" for a sweep that Ctrl-C did not interrupt."""
    return " (partial: interrupted after {} of {} runs)".format(*verdicts.done) if verdicts.interrupted else ""


def make_legend(verdicts: Sequence[VerdictMap | VerdictBox]) -> Text:
    """Return one line of coloured text with sign and name of each verdict; "not judged" only after Ctrl-C."""
    from rich.text import Text

    shown = [s for s in Status if s is not Status.MISSING or any(verdict_map.interrupted for verdict_map in verdicts)]
    return Text("   ").join(Text(f"{VERDICT_SIGNS[status]} {status.value}", COLOURS[status]) for status in shown)


def format_run_command(
    mechanism: str, scene: str, cell: Cell, t_end: float, full: bool = False, laws: Sequence[str] = ()
) -> str:
    """Return the quoted shell command that repeats the run of a cell: `gudgeon run` with scene, setting and parameters.

    mechanism: name or file as typed. t_end (s): end of the run. full: in the full formulation. laws: files of
    user-defined laws.
    """
    words = ["gudgeon", "run", f"./{mechanism}" if mechanism.startswith("-") else mechanism, "--scene", scene]
    words += [
        "--method",
        cell.setting.method,
        "--step" if cell.setting.has_fixed_step else "--rtol",
        repr(cell.setting.value),
    ]
    words += ["--formulation", "full"] if full else []
    for name, parameter_value in cell.parameters.items():
        words += ["--set", f"{name}={parameter_value}"]
    for law in laws:
        words += ["--laws", law]
    return shlex.join([*words, "--t-end", repr(t_end)])


def list_law_display_paths() -> list[str]:
    """Return the files of the registered user-defined laws as the command line has them; other laws are left out.

    Laws that Python code registered have no such file.
    """
    from gudgeon.generator.kinds.laws.registered import ORIGINS

    return [origin.display_path for origin in ORIGINS.values() if origin.display_path]


def describe_marked_step(maps: Sequence[VerdictMap], marked_step: float | None) -> list[str]:
    """Return a line for each map over steps: the verdicts at the marked step, and the largest step that is stable
    everywhere.

    That is the minimum over the columns of the largest stable step. Maps without the marked step are left out; empty
    for None.
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
        counts_text = ", ".join(f"{counts[status]} {status.value}" for status in Status if counts[status])
        stable_steps = [x for x in map(verdict_map.find_stability_limit, verdict_map.columns.values) if x == x]
        shortest = format_seconds(min(stable_steps)) if len(stable_steps) == len(cells) else "none on the axis"
        lines.append(
            f"step {format_seconds(step)}, {verdict_map.scene}: of {len(cells)} columns {counts_text}; "
            f"largest step that is stable in all columns: {shortest}"
        )
    return lines


def list_cell_rows(verdicts: VerdictMap | VerdictBox) -> list[dict[str, Any]]:
    """Return the rows of the CSV and JSON files, one per cell: setting, parameters, verdict, errors, times (SI)."""
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
    """Return a value of an axis as text: the name of an option, "0.3 mm" for a clearance, "1e-8" for rtol, else a
    quantity.

    x: value in SI, or the index of an option. Other quantities have three digits and a suitable unit.
    """
    if axis.option_names:
        return axis.option_names[int(x)]
    if axis.name == "clearance":
        return format_clearance(x)
    if axis.name == "rtol":
        return str(Setting("auto", x))
    return format_seconds(x) if axis.unit == "s" else format_quantity(x, PRESSURE_UNITS.get(axis.unit, axis.unit), 3)


def explain_labels(maps: Sequence[VerdictMap]) -> str:
    """Return the legend of the labels in the cells of the maps: of numbers, then of the words that occur.

    There are two explanations on each line."""
    label_words = {cell.label.split(" ")[0] for verdict_map in maps for cell in verdict_map.cells}
    meanings = dict.fromkeys(text for word, text in LABEL_MEANINGS.items() if word in label_words)
    explanations = ["a number: largest error relative to a finer run, over the compared time", *meanings]
    return "\n".join(" · ".join(explanations[k : k + 2]) for k in range(0, len(explanations), 2))


def describe_comparison(verdicts: VerdictMap | VerdictBox) -> str:
    """Return a text on the errors: "errors over the first 20 ms … 30 ms, against a 10× shorter step".

    The times are the shortest and longest window of comparison of the cells. If no cell was compared, the text reports
    that.
    """
    finer = "a 10× shorter step" if verdicts.setting.has_fixed_step else "a 100× tighter tolerance"
    ends = [cell.compared for cell in verdicts.cells if cell.compared == cell.compared]
    shortest, longest = (format_seconds(end) for end in (min(ends, default=0.0), max(ends, default=0.0)))
    over = shortest if shortest == longest else f"{shortest} … {longest}"
    return f"errors over the first {over}, against {finer}" if ends else f"no run was compared with {finer}"

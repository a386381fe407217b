"""What `gudgeon stress` prints and writes: maps, boxes, failures with all their numbers, CSV, JSON, a figure."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gudgeon.kernel_source import KernelSource
from gudgeon.measure.axes import Axis
from gudgeon.measure.cells import Cell, Status
from gudgeon.measure.tables import console, new_table, print_json, write_csv
from gudgeon.measure.words import clearance, seconds
from gudgeon.measure.work import Setting
from gudgeon.plot_units import quantity
from gudgeon.stress import StressBox, StressMap

if TYPE_CHECKING:
    from rich.table import Table

COLOURS = {
    Status.STABLE: "green", Status.OUTSIDE: "bright_black", Status.INACCURATE: "yellow", Status.DIVERGED: "red",
}  # fmt: skip
PASCAL = {"kg/m/s^2": "Pa", "kg/m/s": "Pa*s"}  # what only base units are known of
SIGNS = {Status.STABLE: "✓", Status.OUTSIDE: "○", Status.INACCURATE: "≈", Status.DIVERGED: "✗"}


def show_stress(
    source: KernelSource, found: Sequence[StressMap], table: Path, mark_step: float | None, as_json: bool = False
) -> None:
    """Print everything (or only JSON), write the table and beside it the picture."""
    rows = [row for scene in found for row in stress_rows(scene)]
    write_csv(table, rows)
    written = [table]
    if find_spec("matplotlib"):
        from gudgeon.measure.figure_stress import stress_figure
        from gudgeon.plots import save_figure

        written.append(table.with_suffix(".png"))
        save_figure(stress_figure(source.title or source.mechanism, found, mark_step), written[-1])
    if as_json:
        print_json({"mechanism": source.mechanism, "cells": rows, "files": [str(path) for path in written]})
        return
    out = console()
    for scene in found:
        finer = "a ten times shorter step" if scene.setting.fixed else "a hundred times tighter tolerance"
        title = f"{scene.scene}, {scene.setting.method}: sane over {seconds(scene.t_long)}, and equal to {finer}?"
        out.print(title, style="bold", markup=False)
        if scene.columns.ratios:
            out.print(f"  {scene.rows.name} down, {scene.columns.name} across", markup=False)
        out.print(_map_table(scene))
        if scene.rows.name == "step":
            out.print(_boundary_table(scene))
        elif failures := [cell for cell in scene.cells if cell.failed]:
            out.print(_failure_table(source.mechanism, scene.scene, failures))
    out.print("   ".join(f"[{COLOURS[status]}]{sign} {status.value}[/]" for status, sign in SIGNS.items()))
    for line in verdict(found, mark_step):
        out.print(line, markup=False)
    for path in written:
        out.print(f"wrote {path}", markup=False)


def show_box(source: KernelSource, found: Sequence[StressBox], table: Path, as_json: bool = False) -> None:
    """The same of boxes: counts, then every failure."""
    rows = [row for box in found for row in stress_rows(box)]
    write_csv(table, rows)
    if as_json:
        print_json({"mechanism": source.mechanism, "cells": rows, "files": [str(table)]})
        return
    out = console()
    for box in found:
        edges = ", ".join(f"{edge.name} {edge.low:.4g} … {edge.high:.4g}" for edge in box.ranges)
        title = f"{box.scene}, {box.setting.method} at {box.setting}, {seconds(box.t_long)} a point: {edges}"
        out.print(title, style="bold", markup=False)
        out.print(f"  {count(box.cells)}", markup=False)
        if failures := [cell for cell in box.cells if cell.failed]:
            out.print(_failure_table(source.mechanism, box.scene, failures))
    out.print(f"wrote {table}", markup=False)


def count(cells: Sequence[Cell]) -> str:
    """ "28 points: 27 stable, 1 outside the model; slowest 0.3 s"."""
    counts = Counter(cell.status for cell in cells)
    told = ", ".join(f"{counts[status]} {status.value}" for status in Status if counts[status])
    slowest = max((cell.seconds for cell in cells if math.isfinite(cell.seconds)), default=math.nan)
    return f"{len(cells)} points: {told}; slowest {seconds(slowest)}"


def value(axis: Axis, x: float) -> str:
    """A value on an axis as people say it."""
    if axis.name == "clearance":
        return clearance(x)
    if axis.name == "rtol":
        return str(Setting("auto", x))
    return seconds(x) if axis.unit == "s" else quantity(x, PASCAL.get(axis.unit, axis.unit), 3)


def _map_table(scene: StressMap) -> Table:
    """Rows down, columns across; each cell its verdict and the number behind it."""
    heads = [value(scene.columns, x) for x in scene.columns.values]
    table = new_table([scene.rows.name, *heads])
    for row in scene.rows.values:
        cells = (scene.cell(row, x) for x in scene.columns.values)
        marked = (f"[{COLOURS[cell.status]}]{SIGNS[cell.status]} {cell.label}[/]" for cell in cells)
        table.add_row(value(scene.rows, row), *marked)
    return table


def _boundary_table(scene: StressMap) -> Table:
    name = scene.columns.name
    table = new_table((name, "largest stable step", "the next one"), left=("the next one",))
    for x in scene.columns.values:
        best = scene.largest_stable(x)
        beyond = next((step for step in scene.rows.values if not step <= best), None)
        cell = scene.cell(beyond, x) if beyond is not None else None
        after = f"{cell.setting}, {cell.status.value}: {cell.reason}" if cell else "the grid ends"
        table.add_row(value(scene.columns, x), seconds(best) if best == best else "none", after)
    return table


def _failure_table(mechanism: str, scene: str, failures: Sequence[Cell]) -> Table:
    """Why, and what to type to see it again."""
    table = new_table(("status", "reason", "to see it again"), left=("reason", "to see it again"))
    for cell in failures:
        table.add_row(cell.status.value, cell.reason, command(mechanism, scene, cell))
    return table


def command(mechanism: str, scene: str, cell: Cell) -> str:
    """The line that runs a cell again."""
    chosen = f"--method {cell.setting.method} --{'step' if cell.setting.fixed else 'rtol'} {cell.setting.value:g}"
    sets = " ".join(f"--set {name}={value}" for name, value in cell.parameters.items())
    return f"gudgeon run {mechanism} --scene {scene} {chosen} {sets}".rstrip()


def verdict(found: Sequence[StressMap], mark_step: float | None) -> list[str]:
    """One line a scene on the marked step, from the cells; nothing without one."""
    lines = []
    for scene in (s for s in found if s.rows.name == "step"):
        step = next((x for x in scene.rows.values if mark_step is not None and math.isclose(x, mark_step)), None)
        if step is None:
            continue
        cells = [scene.cell(step, x) for x in scene.columns.values]
        counts = Counter(cell.status for cell in cells)
        told = ", ".join(f"{counts[status]} {status.value}" for status in Status if counts[status])
        best = [x for x in map(scene.largest_stable, scene.columns.values) if x == x]
        shortest = seconds(min(best)) if len(best) == len(cells) else "below the grid"
        lines.append(f"step {seconds(step)}, {scene.scene}: of {len(cells)} columns {told};"
                     f" a step for all: {shortest}")  # fmt: skip
    return lines


def stress_rows(found: StressMap | StressBox) -> list[dict[str, Any]]:
    """A row a cell, with what it takes to see it again."""
    return [
        {
            "scene": found.scene, "method": cell.setting.method, "step_or_tolerance": cell.setting.value,
            "parameters": " ".join(f"{name}={x}" for name, x in cell.parameters.items()),
            "status": cell.status.value, "reason": cell.reason, "energy_residual_share": cell.energy,
            "penetration_m": cell.penetration, "error_coordinates": cell.error.motion,
            "error_path": cell.error.path, "error_force": cell.error.force, "seconds": cell.seconds,
        }
        for cell in found.cells
    ]  # fmt: skip

"""What `gudgeon bench` and `gudgeon stress` print and write: tables, sentences from the data, CSV, a figure."""

from __future__ import annotations

import csv
import io
import math
import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gudgeon.bench import SceneBench
from gudgeon.commands.common import write_text
from gudgeon.kernel_source import KernelSource
from gudgeon.measure.cells import Status
from gudgeon.measure.words import clearance, seconds, share
from gudgeon.stress import StressMap

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

COLOURS = {
    Status.STABLE: "green", Status.OUTSIDE: "bright_black", Status.INACCURATE: "yellow", Status.DIVERGED: "red",
}  # fmt: skip
BENCH_COLUMNS = ("step", "a simulated s", "right-hand sides", "coordinates", "journals' paths", "joint forces")
SIGNS = {Status.STABLE: "✓", Status.OUTSIDE: "○", Status.INACCURATE: "≈", Status.DIVERGED: "✗"}
GOOD_FORCE = 0.01  # share of the peak force that the sentence of `bench` asks for


def show_bench(source: KernelSource, found: Sequence[SceneBench], out: Path, mark_step: float | None) -> None:
    """Print everything, write `<mechanism>_bench.csv` and `.png`."""
    console = _console()
    for scene in found:
        console.print(_title(scene), style="bold", markup=False)
        console.print(_bench_table(scene))
        for line in notes(scene, mark_step):
            console.print(f"  {line}", markup=False)
    console.print("one right-hand side", style="bold")
    console.print(_rhs_table(found))
    path = out / f"{source.mechanism}_bench.csv"
    write_text(path, _csv(bench_rows(found)))
    console.print(f"wrote {path}", markup=False)
    if find_spec("matplotlib"):
        from gudgeon.measure.figures import bench_figure
        from gudgeon.plots import save_figure

        save_figure(bench_figure(source.title or source.mechanism, found, mark_step), path.with_suffix(".png"))
        console.print(f"wrote {path.with_suffix('.png')}", markup=False)


def show_stress(source: KernelSource, found: Sequence[StressMap], out: Path, mark_step: float | None) -> None:
    """Print everything, write `<mechanism>_stress.csv` and `.png`."""
    console = _console()
    for scene in found:
        title = f"{scene.scene}: stable over {seconds(scene.t_long)}, and equal to a ten times shorter step?"
        console.print(title, style="bold", markup=False)
        console.print(_map_table(scene))
        console.print(_boundary_table(scene))
    console.print("   ".join(f"[{COLOURS[status]}]{sign} {status.value}[/]" for status, sign in SIGNS.items()))
    for line in verdict(found, mark_step):
        console.print(line, markup=False)
    path = out / f"{source.mechanism}_stress.csv"
    write_text(path, _csv(stress_rows(found)))
    console.print(f"wrote {path}", markup=False)
    if find_spec("matplotlib"):
        from gudgeon.measure.figures import stress_figure
        from gudgeon.plots import save_figure

        save_figure(stress_figure(source.title or source.mechanism, found, mark_step), path.with_suffix(".png"))
        console.print(f"wrote {path.with_suffix('.png')}", markup=False)


def _console() -> Console:
    from rich.console import Console

    return Console(width=None if sys.stdout.isatty() else 200, highlight=False)


def _new_table(columns: Iterable[str]) -> Table:
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for column in columns:
        table.add_column(column, justify="right", no_wrap=True)
    return table


def _title(scene: SceneBench) -> str:
    text = f"{scene.scene}: {scene.method} over {seconds(scene.t_end)}" + (f" ({scene.why})" if scene.why else "")
    if math.isnan(scene.reference):
        return text
    return f"{text}, errors against {scene.method} with a step of {seconds(scene.reference)}"


def _bench_table(scene: SceneBench) -> Table:
    if scene.method == "kinematic":
        table = _new_table(("samples", "a simulated s", "a sample", "max |Φ| / size"))
        for row in scene.rows:
            cells = (seconds(row.seconds), seconds(row.seconds * row.step), _error(row.error.motion))
            table.add_row(f"{row.samples:,}", *(cells if not row.failure else (row.failure, "", "")))
        return table
    table = _new_table(BENCH_COLUMNS)
    for row in scene.rows:
        if row.failure:
            table.add_row(seconds(row.step), f"[red]fails at {seconds(row.failed_at)}[/red]")
        else:
            errors = (_error(x) for x in (row.error.motion, row.error.path, row.error.force))
            table.add_row(seconds(row.step), seconds(row.seconds), f"{row.right_hand_sides:,}", *errors)
    return table


def _error(value: float) -> str:
    return "–" if math.isnan(value) else f"{value:.1e}"


def notes(scene: SceneBench, mark_step: float | None) -> list[str]:
    """What the table says, in sentences."""
    if scene.method == "kinematic":
        return ["no degree of freedom: nothing is integrated, the error is what is left open of the constraints"]
    agreement = ", ".join(
        f"{name} {_error(x)}"
        for name, x in (("coordinates", scene.agreement.motion), ("forces", scene.agreement.force))
    )
    lines = [f"the reference is the same method; it and one with twice its step differ by: {agreement}"]
    orders = ((name, scene.order(m)) for name, m in (("coordinates", "motion"), ("forces", "force")))
    if told := ", ".join(f"{name} {order:.2f}" for name, order in orders if math.isfinite(order)):
        lines.append(f"observed order: {told}")
    good = [row for row in scene.rows if not row.failure and row.error.force < GOOD_FORCE]
    best = good[0].step if good else math.nan
    bad = [row.step for row in scene.rows if row.failure]
    told = seconds(best) if good else "none"
    line = f"largest tested step with every joint force within {share(GOOD_FORCE)} of its peak: {told}"
    lines.append(line + (f"; from {seconds(min(bad))} on the run diverges" if bad else ""))
    if mark_step is not None:
        lines.append(f"step {seconds(mark_step)}: {_marked(scene, mark_step)}")
    return lines


def _marked(scene: SceneBench, step: float) -> str:
    row = scene.row(step)
    if row is None:
        return "not tested"
    off = ((f"joint forces off by {share(row.error.force)} of their peak", row.error.force),
           (f"journals' paths by {share(row.error.path)} of c", row.error.path))  # fmt: skip
    said = row.failure or ", ".join(text for text, value in off if math.isfinite(value))
    if math.isfinite(scene.contact):
        said += f"; the shortest contact takes {scene.contact / step:.1f} steps"
    return said


def _rhs_table(found: Sequence[SceneBench]) -> Table:
    table = _new_table(("scene", "state", "time", "operations", "ns an operation"))
    for scene in found:
        for rhs in scene.rhs:
            table.add_row(scene.scene, rhs.state, f"{rhs.seconds * 1e6:.3f} µs", f"{rhs.operations:,}",
                          f"{rhs.seconds / max(rhs.operations, 1) * 1e9:.2f}")  # fmt: skip
    return table


def _map_table(scene: StressMap) -> Table:
    """Steps down, clearances across; each cell its verdict and the number behind it."""
    heads = [f"c = {clearance(c)}" if c == c else clearance(c) for c in scene.clearances]
    table = _new_table(["step", *heads])
    for step in scene.steps:
        cells = (scene.cell(step, c) for c in scene.clearances)
        marked = (f"[{COLOURS[cell.status]}]{SIGNS[cell.status]} {cell.label}[/]" for cell in cells)
        table.add_row(seconds(step), *marked)
    return table


def _boundary_table(scene: StressMap) -> Table:
    table = _new_table(("clearance", "largest stable step", "the next one"))
    table.columns[2].justify = "left"
    for c in scene.clearances:
        best = scene.largest_stable(c)
        beyond = next((x for x in scene.steps if not x <= best), None)
        cell = scene.cell(beyond, c) if beyond is not None else None
        after = f"{seconds(cell.step)}, {cell.status.value}: {cell.reason}" if cell else "the grid ends"
        table.add_row(clearance(c), seconds(best) if best == best else "none", after)
    return table


def verdict(found: Sequence[StressMap], mark_step: float | None) -> list[str]:
    """One line a scene on the marked step, from the cells; nothing without one."""
    lines = []
    for scene in found:
        step = next((x for x in scene.steps if mark_step is not None and math.isclose(x, mark_step)), None)
        if step is None:
            continue
        cells = [scene.cell(step, c) for c in scene.clearances]
        counts = Counter(cell.status for cell in cells)
        told = ", ".join(f"{counts[status]} {status.value}" for status in Status if counts[status])
        best = [x for x in map(scene.largest_stable, scene.clearances) if x == x]
        shortest = seconds(min(best)) if len(best) == len(cells) else "below the grid"
        lines.append(f"step {seconds(step)}, {scene.scene}: of {len(cells)} clearances {told};"
                     f" a step for all of them: {shortest}")  # fmt: skip
    return lines


def bench_rows(found: Sequence[SceneBench]) -> list[dict[str, Any]]:
    """The table as it is written to a file: SI units in the names."""
    return [
        {
            "scene": scene.scene, "method": scene.method, "t_end_s": scene.t_end, "step_s": row.step,
            "samples": row.samples, "seconds_per_simulated_second": row.seconds,
            "right_hand_sides": row.right_hand_sides, "error_coordinates": row.error.motion,
            "error_path": row.error.path, "error_force": row.error.force, "reference_step_s": scene.reference,
            "references_differ_coordinates": scene.agreement.motion, "references_differ_force": scene.agreement.force,
            "failure": row.failure,
        }
        for scene in found for row in scene.rows
    ]  # fmt: skip


def stress_rows(found: Sequence[StressMap]) -> list[dict[str, Any]]:
    """A row a cell."""
    return [
        {
            "scene": scene.scene, "step_s": cell.step, "clearance_m": cell.clearance, "status": cell.status.value,
            "reason": cell.reason, "energy_residual_share": cell.energy, "penetration_m": cell.penetration,
            "error_coordinates": cell.error.motion, "error_path": cell.error.path, "error_force": cell.error.force,
        }
        for scene in found for cell in scene.cells
    ]  # fmt: skip


def _csv(rows: Sequence[dict[str, Any]]) -> str:
    text = io.StringIO()
    writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    for row in rows:
        writer.writerow({key: f"{x:.6g}" if isinstance(x, float) else x for key, x in row.items()})
    return text.getvalue()

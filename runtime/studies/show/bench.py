"""Print and write the results of `gudgeon bench`: tables, sentences, CSV, JSON, a figure."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.integrators.peers.driver import NAMES
from gudgeon.language.text_output import format_path, print_json
from gudgeon.studies.bench import RESOLUTION_FACTOR, Row, SceneBench
from gudgeon.studies.runs import NAN, Setting
from gudgeon.studies.show.tables import (
    format_fraction,
    format_seconds,
    make_console,
    make_table,
    write_table_and_figure,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.table import Table

COLUMNS = ("method", "step, tol", "run time", "rhs", "Jacobians", "coordinates", "paths", "forces")
MAX_FORCE_ERROR = 0.01  # largest error of forces, as a fraction of the peak force, in the notes of `bench`
TARGETS = (1e-2, 1e-4, 1e-6, 1e-8)  # bounds of errors in the second table


def report_bench(
    source: KernelSource,
    scene_benches: Sequence[SceneBench],
    table_path: Path,
    marked_step: float | None,
    as_json: bool = False,
) -> None:
    """Print the results of `gudgeon bench` (with `as_json` as JSON), and write the table as CSV and the figure next to
    it.

    marked_step (s): step of rk4 that is marked in the figure and described; None for none. An OutputError for a file is
    raised after printing.
    """
    rows = list_bench_rows(scene_benches)

    def draw_figure() -> Figure:
        """Return the figure of the results."""
        from gudgeon.studies.show.bench_figure import draw_bench_figure

        return draw_bench_figure(source.title or source.mechanism, scene_benches, marked_step)

    written_paths, failed = write_table_and_figure(table_path, rows, draw_figure)
    _print_bench(source, scene_benches, written_paths, marked_step, as_json)
    if failed:
        raise failed


def _print_bench(
    source: KernelSource,
    scene_benches: Sequence[SceneBench],
    written_paths: Sequence[Path],
    marked_step: float | None,
    as_json: bool,
) -> None:
    """Print tables, notes and names of written files for all scenes, or one JSON document."""
    if as_json:
        scenes = [
            {
                "scene": scene_bench.scene,
                "t_end_s": scene_bench.t_end,
                "interrupted": scene_bench.interrupted,
                "notes": describe_bench(scene_bench, marked_step),
            }
            for scene_bench in scene_benches
        ]
        files = [str(path) for path in written_paths]
        print_json(
            {"mechanism": source.mechanism, "scenes": scenes, "rows": list_bench_rows(scene_benches), "files": files}
        )
        return
    out = make_console()
    for scene_bench in scene_benches:
        out.print(_format_title(scene_bench), style="bold")
        if scene_bench.methods == ("kinematic",):
            out.print(_build_kinematic_table(scene_bench))
        elif own_rows := [row for row in scene_bench.rows if row.setting.method not in NAMES]:
            out.print(_build_method_table(scene_bench, own_rows))
        if checks := [row for row in scene_bench.rows if row.setting.method in NAMES]:
            out.print("  cross-checks: others' methods on the full formulation, driven from Python")
            out.print(_build_method_table(scene_bench, checks, [name for name in COLUMNS if name != "Jacobians"]))
        for line in describe_bench(scene_bench, marked_step):
            out.print(f"  {line}")
        if scene_bench.references:
            out.print(_build_run_time_table(scene_bench))
    if any(scene_bench.rhs for scene_bench in scene_benches):
        out.print("one right-hand side", style="bold")
        out.print(_build_rhs_table(scene_benches))
    for path in written_paths:
        out.print(f"wrote {format_path(path)}")


def _format_title(scene_bench: SceneBench) -> str:
    """Return the title of a scene's tables: scene, length of the window, its reason, and completeness after Ctrl-C."""
    part = " (partial: interrupted after {} of {} rows)".format(*scene_bench.done) if scene_bench.interrupted else ""
    return (
        f"{scene_bench.scene}: the first {format_seconds(scene_bench.t_end)}"
        + (f" ({scene_bench.why})" if scene_bench.why else "")
        + part
    )


def _build_kinematic_table(scene_bench: SceneBench) -> Table:
    """Return the table of the kinematic method: samples, times, constraint residual; a failed row has its failure."""
    table = make_table(("samples", "a simulated s", "a sample", "max |Φ| / size"))
    for row in scene_bench.rows:
        cells = (
            format_seconds(row.seconds),
            format_seconds(row.seconds * row.setting.value),
            _format_error(row.error.motion),
        )
        table.add_row(f"{row.samples:,}", *(cells if not row.failure else (row.failure, "", "")))
    return table


def _build_method_table(scene_bench: SceneBench, rows: Sequence[Row], columns: Sequence[str] = COLUMNS) -> Table:
    """Return a table of rows of one scene: method, setting, run time, numbers of evaluations, errors.

    The run time is that of the window. columns: heads, without "Jacobians" to leave that column out. Errors in brackets
    are not resolved. Failed rows have the time of failure.
    """
    from rich.text import Text

    table = make_table(columns)
    before = ""
    for row in rows:
        method = row.setting.method if row.setting.method != before else ""
        before = row.setting.method
        if row.failure:
            table.add_row(
                method, str(row.setting), Text("fails", "red"), Text(f"at {format_seconds(row.failed_at)}", "red")
            )
            continue
        errors = (_format_error_cell(scene_bench, m, getattr(row.error, m)) for m in ("motion", "path", "force"))
        jacobians = [f"{row.jacobians:,}" if row.jacobians else "–"] if "Jacobians" in columns else []
        time = format_seconds(row.seconds * scene_bench.t_end)
        table.add_row(method, str(row.setting), time, f"{row.right_hand_sides:,}", *jacobians, *errors)
    return table


def _format_error_cell(scene_bench: SceneBench, measure: str, error: float) -> str:
    """Return an error with two digits as a cell, in brackets if the references do not resolve it."""
    return (
        _format_error(error)
        if math.isnan(error) or scene_bench.is_resolved(measure, error)
        else f"({_format_error(error)})"
    )


def _format_error(value: float) -> str:
    """Return an error with two digits, "–" for NaN."""
    return "–" if math.isnan(value) else f"{value:.1e}"


def _build_run_time_table(scene_bench: SceneBench) -> Table:
    """Return the table of the least run time (of the window) of each method for which all errors are below a bound.

    It has a column for each bound of TARGETS; "–" if a method does not reach it.
    """
    table = make_table(
        ("run time to errors below", *map(_format_error, TARGETS)), left_aligned=("run time to errors below",)
    )
    for method in scene_bench.methods:
        times = (scene_bench.find_run_time_for_error(target, method) * scene_bench.t_end for target in TARGETS)
        table.add_row(method, *(format_seconds(x) if x == x else "–" for x in times))
    return table


def describe_bench(scene_bench: SceneBench, marked_step: float | None) -> list[str]:
    """Return sentences on references, orders of convergence, the largest good step of rk4, `marked_step` and omitted
    rows.

    A scene without references (dof = 0) has a single sentence. marked_step (s): None for none.
    """
    if not scene_bench.references:
        return ["no degree of freedom: nothing is integrated, the error is what is left open of the constraints"]
    first, second = (f"{r.method} at {r}" for r in scene_bench.references)
    a = scene_bench.agreement
    differ = ", ".join(f"{name} {_format_error(x)}" for name, x in _pair_with_names(a.motion, a.path, a.force))
    lines = [
        f"references: {first} and {second}; a run is compared with another method",
        f"they differ by: {differ}; below {RESOLUTION_FACTOR} times that, in brackets, not resolved",
    ]
    if math.isinf(a.motion):
        lines[1] = "one of them fails: nothing confirms the errors"
    orders = _pair_with_names(*(scene_bench.estimate_order(m) for m in ("motion", "path", "force")))
    if text := ", ".join(f"{name} {order:.2f}" for name, order in orders):
        lines.append(f"observed order of rk4: {text}")
    if scene_bench.list_rows("rk4"):
        good = [row for row in scene_bench.list_rows("rk4") if not row.failure and row.error.force < MAX_FORCE_ERROR]
        bad = [row.setting.value for row in scene_bench.list_rows("rk4") if row.failure]
        text = str(good[0].setting) if good else "none"
        line = f"largest step of rk4 with forces within {format_fraction(MAX_FORCE_ERROR)} of their peak: {text}"
        lines.append(line + (f"; from {format_seconds(min(bad))} on the run diverges" if bad else ""))
    if marked_step is not None:
        lines.append(f"rk4 at {format_seconds(marked_step)}: {_describe_step(scene_bench, marked_step)}")
    return [*lines, *scene_bench.left_out]


def _pair_with_names(motion: float, path: float, force: float) -> list[tuple[str, float]]:
    """Return (name, value) of the three measures of an error, without those that are NaN."""
    pairs = (("coordinates", motion), ("paths", path), ("forces", force))
    return [(name, x) for name, x in pairs if not math.isnan(x)]


def _describe_step(scene_bench: SceneBench, step: float) -> str:
    """Return errors of rk4 with a step (s) in words, its failure, or "not tested"."""
    row: Row | None = scene_bench.find_row(Setting("rk4", step))
    if row is None:
        return "not tested"
    off = (
        (f"joint forces off by {format_fraction(row.error.force)} of their peak", row.error.force),
        (f"journals' paths by {format_fraction(row.error.path)} of c", row.error.path),
    )
    specified = row.failure or ", ".join(text for text, value in off if math.isfinite(value))
    if math.isfinite(scene_bench.contact):
        specified += f"; the shortest contact takes {scene_bench.contact / step:.1f} steps"
    return specified


def _build_rhs_table(scene_benches: Sequence[SceneBench]) -> Table:
    """Return the table of the times of one right-hand side, a row for each scene and state."""
    table = make_table(("scene", "state", "time", "operations", "ns an operation"))
    for scene_bench in scene_benches:
        for rhs in scene_bench.rhs:
            table.add_row(
                scene_bench.scene,
                rhs.state,
                f"{rhs.seconds * 1e6:.3f} µs",
                f"{rhs.operations:,}",
                f"{rhs.seconds / max(rhs.operations, 1) * 1e9:.2f}",
            )
    return table


def list_bench_rows(scene_benches: Sequence[SceneBench]) -> list[dict[str, Any]]:
    """Return the rows of the CSV file, column name (with SI unit) to value, for all scenes."""
    return [
        {
            "scene": scene_bench.scene,
            "method": row.setting.method,
            "t_end_s": scene_bench.t_end,
            "step_s": row.setting.value if row.setting.has_fixed_step else NAN,
            "tolerance": NAN if row.setting.has_fixed_step else row.setting.value,
            "samples": row.samples,
            "seconds": row.seconds * scene_bench.t_end,
            "seconds_per_simulated_second": row.seconds,
            "right_hand_sides": row.right_hand_sides,
            "jacobians": row.jacobians,
            "error_coordinates": row.error.motion,
            "error_path": row.error.path,
            "error_force": row.error.force,
            "reference": f"{row.reference.method} {row.reference.value:g}" if row.reference else "",
            "references_differ_coordinates": scene_bench.agreement.motion,
            "references_differ_path": scene_bench.agreement.path,
            "references_differ_force": scene_bench.agreement.force,
            "failure": row.failure,
        }
        for scene_bench in scene_benches
        for row in scene_bench.rows
    ]

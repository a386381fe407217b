"""Print and write the results of `gudgeon bench`: run time against error as tables, sentences, CSV, JSON, a figure."""

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
    make_rich_table,
    write_table_and_figure,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.table import Table

COLUMNS = ("method", "step, tol", "run time", "rhs", "Jacobians", "coordinates", "paths", "forces")
MAX_FORCE_ERROR = 0.01  # error of forces, as a fraction of the peak force, up to which a step of rk4 is recommended
TARGETS = (1e-2, 1e-4, 1e-6, 1e-8)  # error bounds in the table of run times


def report_bench(
    source: KernelSource,
    scene_benches: Sequence[SceneBench],
    table_path: Path,
    marked_step: float | None,
    as_json: bool = False,
) -> None:
    """Write the results of `gudgeon bench` as a CSV table and a figure next to it, and print them.

    marked_step (s): step of rk4 that is marked in the figure and described in words; None for none. as_json: print JSON
    instead. An OutputError for a file is raised after printing.
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
    """Print the tables and notes of all scenes and the names of written files; with `as_json` one JSON document."""
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
        out.print(_format_scene_title(scene_bench), style="bold")
        if scene_bench.methods == ("kinematic",):
            out.print(_build_kinematic_table(scene_bench))
        elif method_rows := [row for row in scene_bench.rows if row.setting.method not in NAMES]:
            out.print(_build_method_table(scene_bench, method_rows))
        if checks := [row for row in scene_bench.rows if row.setting.method in NAMES]:
            out.print("  cross-checks: methods of other libraries on the full formulation, called from Python")
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


def _format_scene_title(scene_bench: SceneBench) -> str:
    """Return the title of a scene's tables: "dry: the first 20 ms (the first 4 contacts)", with a note after Ctrl-C."""
    part = " (partial: interrupted after {} of {} rows)".format(*scene_bench.done) if scene_bench.interrupted else ""
    return (
        f"{scene_bench.scene}: the first {format_seconds(scene_bench.t_end)}"
        + (f" ({scene_bench.end_reason})" if scene_bench.end_reason else "")
        + part
    )


def _build_kinematic_table(scene_bench: SceneBench) -> Table:
    """Return the rich table of the kinematic analysis: samples, run times, residual of the constraint equations.

    A failed row has its failure instead of the run time.
    """
    table = make_rich_table(("samples", "per simulated s", "per sample", "max |Φ| / size"))
    for row in scene_bench.rows:
        cells = (
            format_seconds(row.seconds),
            format_seconds(row.seconds * row.setting.value),
            _format_error(row.error.motion),
        )
        table.add_row(f"{row.samples:,}", *(cells if not row.failure else (row.failure, "", "")))
    return table


def _build_method_table(scene_bench: SceneBench, rows: Sequence[Row], columns: Sequence[str] = COLUMNS) -> Table:
    """Return the rich table of rows of one scene: method, setting, run time, numbers of evaluations, errors.

    The run time is that of the whole window. columns: heads, without "Jacobians" to omit that column. Errors in
    brackets are not resolved by the references. Failed rows have the time of failure only.
    """
    from rich.text import Text

    table = make_rich_table(columns)
    previous_method = ""
    for row in rows:
        method = row.setting.method if row.setting.method != previous_method else ""
        previous_method = row.setting.method
        if row.failure:
            table.add_row(
                method, str(row.setting), Text("failed", "red"), Text(f"at {format_seconds(row.failed_at)}", "red")
            )
            continue
        errors = (_format_error_cell(scene_bench, m, getattr(row.error, m)) for m in ("motion", "path", "force"))
        jacobians = [f"{row.jacobians:,}" if row.jacobians else "–"] if "Jacobians" in columns else []
        time = format_seconds(row.seconds * scene_bench.t_end)
        table.add_row(method, str(row.setting), time, f"{row.right_hand_sides:,}", *jacobians, *errors)
    return table


def _format_error_cell(scene_bench: SceneBench, error_name: str, error: float) -> str:
    """Return an error as a table cell with two digits, in brackets if the references do not resolve it; "–" for NaN.

    error_name: "motion", "path" or "force".
    """
    return (
        _format_error(error)
        if math.isnan(error) or scene_bench.is_resolved(error_name, error)
        else f"({_format_error(error)})"
    )


def _format_error(error: float) -> str:
    """Return an error as text with two digits, "1.2e-06"; "–" for NaN."""
    return "–" if math.isnan(error) else f"{error:.1e}"


def _build_run_time_table(scene_bench: SceneBench) -> Table:
    """Return the rich table of the minimum run time of each method for errors of at most each bound of TARGETS.

    The run time is that of the whole window, and the largest error measure counts. "–": the method does not reach the
    bound, or the references do not resolve it.
    """
    table = make_rich_table(
        ("run time for errors below", *map(_format_error, TARGETS)), left_aligned=("run time for errors below",)
    )
    for method in scene_bench.methods:
        times = (scene_bench.find_run_time_for_error(target, method) * scene_bench.t_end for target in TARGETS)
        table.add_row(method, *(format_seconds(x) if x == x else "–" for x in times))
    return table


def describe_bench(scene_bench: SceneBench, marked_step: float | None) -> list[str]:
    """Return sentences on a scene: references, order of convergence and largest accurate step of rk4, omitted rows.

    marked_step (s): step of rk4 whose errors are described; None for none. A scene without references (dof = 0) has a
    single sentence.
    """
    if not scene_bench.references:
        return ["no degree of freedom: nothing is integrated, the error is the residual of the constraint equations"]
    first, second = (f"{r.method} at {r}" for r in scene_bench.references)
    a = scene_bench.reference_difference
    agreement_text = ", ".join(f"{name} {_format_error(x)}" for name, x in _pair_with_names(a.motion, a.path, a.force))
    lines = [
        f"references: {first} and {second}; a run is compared with the one by another method",
        f"difference of the references: {agreement_text}; errors below {RESOLUTION_FACTOR} times that are in brackets, "
        "not resolved",
    ]
    if math.isinf(a.motion):
        lines[1] = "a reference failed: the errors are not confirmed"
    orders = _pair_with_names(*(scene_bench.estimate_order(m) for m in ("motion", "path", "force")))
    if text := ", ".join(f"{name} {order:.2f}" for name, order in orders):
        lines.append(f"observed order of rk4: {text}")
    if scene_bench.list_rows("rk4"):
        accurate_rows = [
            row for row in scene_bench.list_rows("rk4") if not row.failure and row.error.force < MAX_FORCE_ERROR
        ]
        failed_steps = [row.setting.value for row in scene_bench.list_rows("rk4") if row.failure]
        text = str(accurate_rows[0].setting) if accurate_rows else "none"
        line = f"largest step of rk4 with forces within {format_fraction(MAX_FORCE_ERROR)} of their peak: {text}"
        lines.append(line + (f"; runs with {format_seconds(min(failed_steps))} or more fail" if failed_steps else ""))
    if marked_step is not None:
        lines.append(f"rk4 at {format_seconds(marked_step)}: {_describe_step(scene_bench, marked_step)}")
    return [*lines, *scene_bench.left_out]


def _pair_with_names(motion: float, path: float, force: float) -> list[tuple[str, float]]:
    """Return pairs (name for display, value) of the three error measures, without those that are NaN."""
    pairs = (("coordinates", motion), ("paths", path), ("forces", force))
    return [(name, x) for name, x in pairs if not math.isnan(x)]


def _describe_step(scene_bench: SceneBench, step: float) -> str:
    """Return the errors of rk4 with a step (s) in words, the reason of its failure, or "not tested".

    If the window has a contact, the number of steps in the shortest contact is added.
    """
    row: Row | None = scene_bench.find_row(Setting("rk4", step))
    if row is None:
        return "not tested"
    differences = (
        (f"joint forces differ by {format_fraction(row.error.force)} of their peak", row.error.force),
        (f"journal paths by {format_fraction(row.error.path)} of c", row.error.path),
    )
    description = row.failure or ", ".join(text for text, value in differences if math.isfinite(value))
    if math.isfinite(scene_bench.contact):
        description += f"; the shortest contact lasts {scene_bench.contact / step:.1f} steps"
    return description


def _build_rhs_table(scene_benches: Sequence[SceneBench]) -> Table:
    """Return the rich table of the times of one right-hand side, a row for each scene and state."""
    table = make_rich_table(("scene", "state", "time", "operations", "ns per operation"))
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
    """Return the rows of the CSV and JSON files for all scenes: column name to value (SI).

    `seconds` is the run time of the window. Of step_s and tolerance, the one that does not apply is NaN.
    """
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
            "references_differ_coordinates": scene_bench.reference_difference.motion,
            "references_differ_path": scene_bench.reference_difference.path,
            "references_differ_force": scene_bench.reference_difference.force,
            "failure": row.failure,
        }
        for scene_bench in scene_benches
        for row in scene_bench.rows
    ]

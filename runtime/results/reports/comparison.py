"""Compare runs by their main values: peak errors against the ideal scene, peak forces, accuracy and cost.

`compute_scene_report` computes them, `build_tables` displays them (rich, imported on first use),
`convert_to_json_values` returns them for scripts.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.language.plot_units import choose_plot_unit, format_quantity
from gudgeon.results.diagnostics import Diagnostics
from gudgeon.results.peaks import Extreme, build_extreme_rows, find_sample_extreme
from gudgeon.results.results import Result
from gudgeon.results.series import MOTION_UNITS, find_ideal_translational_joints, find_rate_names, list_drive_series

if TYPE_CHECKING:
    from rich.table import Table

ROUNDING_TOL, ZERO_CELL = 1e-9, "≈ 0"  # fraction of the run's largest value of the unit below which a cell is "≈ 0"
MAX_SCENE_COLUMNS = 4  # scenes in one table
# of a joint with play: name -> (unit that a table can scale, row label); other constants are in --json only
CONSTANTS = {"c": ("m", "clearance c"), "K": ("", "contact stiffness K [N/mⁿ]"), "S": ("N*s", "film factor S")}
MIN_SHOWN_AUDIT = 1e-3  # value, as a multiple of the limit, from which on a check of the audit has its own row
VERBOSE_ROWS = ("δ̇/δ̇⁻ during contact", "steps with it outside ±1", CONSTANTS["K"][1], CONSTANTS["S"][1])


@dataclass(frozen=True)
class SceneReport:
    """Main values of one scene, all in SI."""

    scene: str
    motion: tuple[Extreme, ...]  # of the watched names and their rates
    errors: tuple[Extreme, ...]  # of the same, run less ideal; empty for the ideal scene
    forces: Mapping[str, tuple[float, float]]  # joint -> peak force, its time (all steps with play, else all samples)
    constants: Mapping[str, float]
    diagnostics: Diagnostics
    events: Mapping[str, tuple[float, ...]] = field(default_factory=dict)  # event -> its times
    drives: tuple[Extreme, ...] = ()  # torques and forces of the drives
    guides: tuple[Extreme, ...] = ()  # force and moment of those with play; of an ideal scene of all
    constrained: bool = True  # whether constraint equations remain that can be violated
    max_magnitudes: Mapping[str, float] = field(default_factory=dict)  # unit -> largest magnitude in this run


def compute_scene_report(run: Result, reference: Result | None, watch: Sequence[str]) -> SceneReport:
    """Return the main values of one run for tables and JSON: extremes of series, errors, peak forces, events.

    `reference` is the ideal run at the same times, None for the ideal run itself; `watch` are names of series, which
    are shown with their rates. Names that the run lacks are left out. Without play, forces are of all ideal joints;
    without masses there are none.
    """
    watched_and_rates = dict.fromkeys(
        name for position_name in watch for name in (position_name, *find_rate_names(position_name)) if name
    )
    series = [name for name in watched_and_rates if name in run]
    motion = tuple(find_sample_extreme(name, run.unit(name), run.t, run[name]) for name in series)
    errors: tuple[Extreme, ...] = ()
    if reference is not None:
        common_names = [name for name in series if name in reference]
        errors = tuple(
            find_sample_extreme(name, run.unit(name), run.t, run[name] - reference[name]) for name in common_names
        )
    forces = {peak.joint: (peak.F, peak.t) for peak in run.diagnostics.peaks}
    for joint in run.source.joints if not (run.source.clearances or run.source.massless_bodies) else ():
        reaction = find_sample_extreme("", "N", run.t, run[f"{joint.name}.F"])
        forces[joint.name] = reaction.peak, reaction.t
    events = {event.name: tuple(run.events_of(event.name).tolist()) for event in run.source.events}
    drive_names = () if run.source.massless_bodies else list_drive_series(run.source)
    ideal_guides = [joint.name for joint in find_ideal_translational_joints(run.source) if not run.source.clearances]
    guide_names = [
        f"{name}.{component}"
        for name in run.source.guides or ideal_guides
        for component in "FM"
        if not run.source.massless_bodies
    ]
    drives, guides = (
        tuple(find_sample_extreme(name, run.unit(name), run.t, run[name]) for name in names)
        for names in (drive_names, guide_names)
    )
    remaining_rows = run.source.equations if run.source.formulation == "full" else run.source.closures
    values = run.source.scene, motion, errors, forces, run.constants, run.diagnostics, events, drives, guides
    return SceneReport(
        *values,
        bool(remaining_rows) or run.diagnostics.phi_max > 0.0,
        _find_largest_magnitudes(run, forces, (*drives, *guides)),
    )


def _find_largest_magnitudes(
    run: Result, forces: Mapping[str, tuple[float, float]], drives_and_guides: Sequence[Extreme]
) -> dict[str, float]:
    """Return the largest magnitude in a run by unit: of forces, drives and all of q, v and a.

    It is the scale of rounding errors. The entry of rad, rad/s, rad/s^2 is at least that of m, m/s, m/s^2 divided by
    the largest length.
    """
    largest: dict[str, float] = {}
    magnitudes = [("N", force) for force, _ in forces.values()] + [
        (drive.unit, abs(drive.peak)) for drive in drives_and_guides
    ]
    for order, array in enumerate((run.q, run.v, run.a)):
        magnitudes += [
            (MOTION_UNITS[k % 3][order], float(np.nanmax(np.abs(x), initial=0.0))) for k, x in enumerate(array.T)
        ]
    for unit, magnitude in magnitudes:
        if math.isfinite(magnitude):
            largest[unit] = max(magnitude, largest.get(unit, 0.0))
    for length_unit, angle_unit in zip(
        *MOTION_UNITS[::2], strict=True
    ):  # the scale of angles in a motion without rotation
        if max_length := largest.get("m", 0.0):
            largest[angle_unit] = max(largest.get(angle_unit, 0.0), largest.get(length_unit, 0.0) / max_length)
    return largest


def convert_to_json_values(reports: Sequence[SceneReport]) -> dict[str, Any]:
    """Return the values of all scenes as a dictionary by scene, for `gudgeon run --json`.

    Keys of a scene: motion, errors, peak_forces, drives, guides, peaks, peak_errors, constants, events, diagnostics.
    NaN and infinity, which JSON lacks, are None.
    """
    scenes = {}
    for report in reports:
        scenes[report.scene] = {
            "motion": {extreme.name: asdict(extreme) for extreme in report.motion},
            "errors": {extreme.name: asdict(extreme) for extreme in report.errors},
            "peak_forces": {joint: {"F": force, "t": t} for joint, (force, t) in report.forces.items()},
            "drives": {extreme.name: asdict(extreme) for extreme in report.drives},
            "guides": {extreme.name: asdict(extreme) for extreme in report.guides},
            "peaks": {
                extremes.name: asdict(extremes) for extremes in report.diagnostics.extremes if not extremes.against
            },
            "peak_errors": {
                extremes.name: asdict(extremes) for extremes in report.diagnostics.extremes if extremes.against
            },
            "constants": dict(report.constants),
            "events": {name: list(times) for name, times in report.events.items()},
            "diagnostics": {
                name: value for name, value in asdict(report.diagnostics).items() if name != "sliding_loads"
            },
        }
    json_values: dict[str, Any] = replace_non_finite_numbers(scenes)
    return json_values


def replace_non_finite_numbers(value: Any) -> Any:
    """Return a copy of a value with NaN and infinity, which JSON lacks, replaced by None at any depth.

    Tuples become lists, NumPy scalars Python numbers.
    """
    if isinstance(value, dict):
        return {key: replace_non_finite_numbers(element) for key, element in value.items()}
    if isinstance(value, (list, tuple)):
        return [replace_non_finite_numbers(element) for element in value]
    if hasattr(value, "item"):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value


def build_tables(title: str, reports: Sequence[SceneReport], width: int, verbose: bool = False) -> list[Table]:
    """Return rich tables for a terminal, with a column for each scene and a row for each quantity.

    Each table has as many columns as fit `width` characters, at least one and at most MAX_SCENE_COLUMNS. `verbose` adds
    the rows whose names end as in VERBOSE_ROWS. Only the first table has the title.
    """
    from rich.measure import Measurement

    from gudgeon.language.text_output import make_plain_console

    wide_console = make_plain_console(10_000)
    rows = [row for row in _build_rows(reports) if verbose or not row[0].endswith(VERBOSE_ROWS)]
    table_list: list[Table] = []
    for n_columns in range(min(MAX_SCENE_COLUMNS, len(reports)), 0, -1):
        column_ranges = [slice(first, first + n_columns) for first in range(0, len(reports), n_columns)]
        table_list = [_build_table("" if columns.start else title, reports, rows, columns) for columns in column_ranges]
        if all(Measurement.get(wide_console, wide_console.options, table).maximum <= width for table in table_list):
            break
    return table_list


def _build_table(
    title: str, reports: Sequence[SceneReport], rows: list[tuple[str, list[str]]], column_range: slice
) -> Table:
    """Return one rich Table with the columns `column_range` of the rows; a row without cells is a heading."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table
    from rich.text import Text

    from gudgeon.language.text_output import format_one_line

    title = format_one_line(title)
    table = Table(title=title or None, title_justify="left", title_style="bold", box=SIMPLE_HEAD, pad_edge=False)
    table.add_column("", no_wrap=True)
    for report in reports[column_range]:
        table.add_column(report.scene, justify="right", no_wrap=True)
    for name, cells in rows:
        if not cells:
            table.add_section()
            table.add_row(Text(name, style="bold"))
        else:
            table.add_row(f"  {name}", *cells[column_range])
    return table


def _build_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows (name, one cell a scene) of all sections; a heading has no cells.

    Rows that are empty in all scenes, and sections without rows, are left out.
    """
    rows: list[tuple[str, list[str]]] = []
    for heading, section_rows in (
        ("Peak error against ideal", _format_error_rows(reports)),
        ("Peak error against ideal, all steps", _format_extreme_rows(reports, True)),
        ("Peaks, all steps", _format_extreme_rows(reports, False)),
        ("Motion", _format_motion_rows(reports)),
        (
            "Peak force"
            if any(scene_report.diagnostics.peaks for scene_report in reports)
            else "Peak force, of samples",
            _format_force_rows(reports),
        ),
        ("Peak of guides, of samples", _format_guide_rows(reports)),
        ("Peak of drives, of samples", _format_peak_rows(reports, [report.drives for report in reports])),
        ("Joints with play", _format_play_rows(reports)),
        ("Events", _format_event_rows(reports)),
        ("Accuracy", _format_accuracy_rows(reports)),
        ("Cost", _format_cost_rows(reports)),
    ):
        filled_rows = [(name, cells) for name, cells in section_rows if any(cell not in ("", "–") for cell in cells)]
        rows += [(heading, []), *filled_rows] if filled_rows else []
    return rows


def _format_peak_cell(peak: float, unit: str, t: float, max_magnitudes: Mapping[str, float]) -> str:
    """Return a peak and its time as a cell, "–" if it is not known, "≈ 0" if it is rounding error.

    `max_magnitudes` has the largest magnitude of the run by unit.
    """
    if math.isfinite(t) and _is_rounding_error(abs(peak), unit, max_magnitudes):
        return ZERO_CELL
    factor, unit_text = choose_plot_unit(peak, unit)
    time_text = format_quantity(t, "s") if 0.0 < abs(t) < 1e-3 else f"{t:.4f} s"
    return f"{peak * factor + 0.0:.4g} {unit_text}".strip() + f" at {time_text}" if math.isfinite(t) else "–"


def _is_rounding_error(magnitude: float, unit: str, max_magnitudes: Mapping[str, float]) -> bool:
    """Return whether a magnitude is rounding error: not 0, but below ROUNDING_TOL times the largest of its unit."""
    return 0.0 < magnitude < ROUNDING_TOL * max_magnitudes.get(unit, 0.0)


def _format_error_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows (error, one cell a scene) of peak errors against the ideal scene at the samples."""
    names = dict.fromkeys(error.name for report in reports for error in report.errors)
    cells_by_scene = [
        {
            error.name: _format_peak_cell(error.peak, error.unit, error.t, report.max_magnitudes)
            for error in report.errors
        }
        for report in reports
    ]
    return [(name, [cells.get(name, "–") for cells in cells_by_scene]) for name in names]


def _format_motion_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows (series, one cell a scene) of the ranges of the watched series and their rates at the samples."""
    cells_by_scene = [
        {extreme.name: _format_range_cell(extreme, report.max_magnitudes) for extreme in report.motion}
        for report in reports
    ]
    names = dict.fromkeys(extreme.name for report in reports for extreme in report.motion)
    return [(name, [cells.get(name, "–") for cells in cells_by_scene]) for name in names]


def _format_extreme_rows(reports: Sequence[SceneReport], is_error: bool) -> list[tuple[str, list[str]]]:
    """Return the rows of peaks over all steps of the series in `peaks:` of a scene.

    With `is_error` they are peaks of the errors against another scene; other series have rows for max and min.
    """
    formatters = [partial(_format_peak_cell, max_magnitudes=report.max_magnitudes) for report in reports]
    return build_extreme_rows([report.diagnostics.extremes for report in reports], formatters, is_error)


def _format_range_cell(extreme: Extreme, max_magnitudes: Mapping[str, float]) -> str:
    """Return the smallest and largest value of a series as a cell; "≈ 0" if both are rounding errors."""
    if _is_rounding_error(magnitude := max(abs(extreme.low), abs(extreme.high)), extreme.unit, max_magnitudes):
        return ZERO_CELL
    factor, unit_text = choose_plot_unit(magnitude, extreme.unit)
    low, high = (
        0.0 if _is_rounding_error(abs(value), extreme.unit, max_magnitudes) else value * factor
        for value in (extreme.low, extreme.high)
    )
    return f"{low:.5g} … {high:.5g} {unit_text}".strip()


def _format_force_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of peak forces at the joints that have play in any scene, or else at all joints."""
    joints_with_play = dict.fromkeys(peak.joint for report in reports for peak in report.diagnostics.peaks)
    joints = joints_with_play or dict.fromkeys(joint for report in reports for joint in report.forces)
    unknown_peak = (math.nan, math.nan)
    return [
        (
            joint,
            [
                _format_peak_cell(
                    scene_report.forces.get(joint, unknown_peak)[0],
                    "N",
                    scene_report.forces.get(joint, unknown_peak)[1],
                    scene_report.max_magnitudes,
                )
                for scene_report in reports
            ],
        )
        for joint in joints
    ]


def _format_guide_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of peak forces and moments of the guides that have play in any scene, at the samples."""
    prefixes = {
        f"{peak.joint.partition('.')[0]}."
        for scene_report in reports
        for peak in scene_report.diagnostics.peaks
        if "." in peak.joint
    }
    guide_extremes = [
        tuple(extreme for extreme in report.guides if extreme.name[:-1] in prefixes) for report in reports
    ]
    return _format_peak_rows(reports, guide_extremes)


def _format_peak_rows(
    reports: Sequence[SceneReport], peaks: Sequence[tuple[Extreme, ...]]
) -> list[tuple[str, list[str]]]:
    """Return the rows of peaks at the samples, one cell a scene, without series whose peaks over all steps are known.

    `peaks` has the extremes of the series of each scene, in the order of `reports`.
    """
    cells_by_scene = [
        {
            peak.name: _format_peak_cell(peak.peak, peak.unit, peak.t, scene_report.max_magnitudes)
            for peak in scene_peaks
        }
        for scene_report, scene_peaks in zip(reports, peaks, strict=True)
    ]
    names_over_all_steps = {
        extremes.name for report in reports for extremes in report.diagnostics.extremes
    }  # these have a row with the peaks over all steps
    names = dict.fromkeys(
        peak.name for scene_peaks in peaks for peak in scene_peaks if peak.name not in names_over_all_steps
    )
    return [(name, [cells.get(name, "–") for cells in cells_by_scene]) for name in names]


def _format_play_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of each joint with play: first contact, its peak, largest eccentricity, constants of its laws."""
    peaks_by_scene = [{peak.joint: peak for peak in report.diagnostics.peaks} for report in reports]
    rows = []
    for joint in dict.fromkeys(name for peaks_by_joint in peaks_by_scene for name in peaks_by_joint):
        joint_peaks = [peaks_by_joint.get(joint) for peaks_by_joint in peaks_by_scene]
        contact_times = [joint_peak.first_contact if joint_peak else math.nan for joint_peak in joint_peaks]
        rows.append((f"{joint} first contact", [format_quantity(t, "s") for t in contact_times]))
        rows.append(
            (
                f"{joint} peak of that contact",
                [format_quantity(joint_peak.first_peak, "N", 5) if joint_peak else "–" for joint_peak in joint_peaks],
            )
        )
        rows.append(
            (
                f"{joint} largest e",
                [format_quantity(joint_peak.e_max, "m", 5) if joint_peak else "–" for joint_peak in joint_peaks],
            )
        )
        for name, (unit, meaning) in CONSTANTS.items():
            values = (report.constants.get(f"{joint}.{name}", math.nan) for report in reports)
            label = meaning.replace("clearance", "gap") if "." in joint else meaning
            rows.append((f"{joint} {label}", [format_quantity(value, unit) for value in values]))
    return rows


def _format_event_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of events: their number and first time; a dash in scenes that do not have the event."""

    def format_event_cell(times: tuple[float, ...] | None) -> str:
        """Return number and first time of an event as a cell; "none" without times, "–" for None."""
        if not times:
            return "–" if times is None else "none"
        return f"at {times[0]:.7g} s" if len(times) == 1 else f"{len(times)}, first at {times[0]:.7g} s"

    names = dict.fromkeys(name for report in reports for name in report.events)
    return [(name, [format_event_cell(report.events.get(name)) for report in reports]) for name in names]


def _format_accuracy_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of accuracy: drift, energy residual, predictability horizon, contacts, audit."""
    diagnostics = [report.diagnostics for report in reports]
    has_play = [bool(run.peaks) for run in diagnostics]
    ratio_cells = [
        f"{run.ratio_min:.3g} … {run.ratio_max:.3g}" if math.isfinite(run.ratio_min) else "–" for run in diagnostics
    ]
    return [
        (
            "max |Φ|",
            [
                f"{scene_report.diagnostics.phi_max:.2e}" if scene_report.constrained else "no constraints"
                for scene_report in reports
            ],
        ),
        (
            "max |Φ̇|",
            [
                f"{scene_report.diagnostics.phi_dot_max:.2e}" if scene_report.constrained else "–"
                for scene_report in reports
            ],
        ),
        ("energy residual", [format_quantity(run.energy_residual, "J", 3) for run in diagnostics]),
        ("energy throughput", [format_quantity(run.energy_turned_over, "J", 3) for run in diagnostics]),
        ("predictable until", [_format_horizon_cell(run.horizon) for run in diagnostics]),
        (
            "contacts that began",
            [str(run.onsets) if has_contacts else "–" for run, has_contacts in zip(diagnostics, has_play, strict=True)],
        ),
        ("δ̇/δ̇⁻ during contact", ratio_cells),
        (
            "steps with it outside ±1",
            [str(run.ratio_outside) if math.isfinite(run.ratio_min) else "–" for run in diagnostics],
        ),
        *_format_audit_rows(reports),
    ]


def _format_audit_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the row of the largest value of the audit in each scene, as a multiple of its limit, then a row a check.

    A check has a row if its value is MIN_SHOWN_AUDIT or more in any scene. "–": without audit.
    """
    worst_by_scene = [
        {worst_by_check.check: worst_by_check.worst for worst_by_check in report.diagnostics.audit}
        for report in reports
    ]
    checks = dict.fromkeys(
        check
        for worst_by_check in worst_by_scene
        for check, worst in worst_by_check.items()
        if worst >= MIN_SHOWN_AUDIT
    )
    max_values = [max(worst_by_check.values(), default=math.nan) for worst_by_check in worst_by_scene]
    return [
        ("audit, in limits", [f"{worst:.1e}" if math.isfinite(worst) else "–" for worst in max_values]),
        *(
            (
                f"audit of {check}",
                [
                    f"{worst_by_check[check]:.1e}" if check in worst_by_check else "–"
                    for worst_by_check in worst_by_scene
                ],
            )
            for check in checks
        ),
    ]


def _format_horizon_cell(horizon: float) -> str:
    """Return the predictability horizon (s) as a cell: "to the end" for infinity, "–" for NaN (not requested)."""
    return "to the end" if horizon == math.inf else format_quantity(horizon, "s", 3)


def _format_cost_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of cost (label, one cell a report), from the diagnostics of the reports.

    The rows are the method, the step and the last step (s), the tolerance, the number of steps, the evaluations of the
    right-hand side, and the run time in seconds per simulated second. An unknown tolerance or a count of 0 is "–".
    """
    diagnostics = [report.diagnostics for report in reports]
    return [
        ("method", [run.method for run in diagnostics]),
        ("step", [format_quantity(run.step, "s") for run in diagnostics]),
        ("last step", [format_quantity(run.last_step, "s") for run in diagnostics]),
        ("tolerance of a step", [f"{run.rtol:.3g}" if math.isfinite(run.rtol) else "–" for run in diagnostics]),
        ("steps", [f"{run.steps:,}" if run.steps else "–" for run in diagnostics]),
        ("right-hand sides", [f"{run.right_hand_sides:,}" if run.right_hand_sides else "–" for run in diagnostics]),
        ("s per simulated s", [f"{run.seconds_per_simulated_second:.3g}" for run in diagnostics]),
    ]

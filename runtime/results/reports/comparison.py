"""Compare runs by their main values: peak errors against the ideal scene, peak forces, accuracy and cost.

`compare` computes them, `tables` displays them (rich, imported on first use), `as_json` returns them for scripts.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.language.plot_units import drawn, quantity
from gudgeon.results.diagnostics import Diagnostics
from gudgeon.results.peaks import Extreme, sample_extreme, table_rows
from gudgeon.results.results import Result
from gudgeon.results.series import MOTION_UNITS, drive_series, rates, rigid_guides

if TYPE_CHECKING:
    from rich.table import Table

NOISE, ZERO = 1e-9, "≈ 0"  # a value below this fraction of the run's largest of its unit is shown as ≈ 0
COLUMNS = 4  # scenes in one table
# of a joint with play: name -> (unit that a table can scale, what it is); the rest is in --json
CONSTANTS = {"c": ("m", "clearance c"), "K": ("", "contact stiffness K [N/mⁿ]"), "S": ("N*s", "film factor S")}
AUDIT_SHOWN = 1e-3  # limits, from which on a check of the audit has a row of its own
NEED_A_LEGEND = ("δ̇/δ̇⁻ while latched", "steps with it outside ±1", CONSTANTS["K"][1], CONSTANTS["S"][1])


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
    constrained: bool = True  # whether rows are left that could open
    scales: Mapping[str, float] = field(default_factory=dict)  # unit -> how large such numbers are in this run


def compare(run: Result, reference: Result | None, watch: Sequence[str]) -> SceneReport:
    """Return the main values of one run.

    `reference` is the ideal run at the same times, None for the ideal run itself; `watch` are names of series.
    """
    expected = dict.fromkeys(name for watched in watch for name in (watched, *rates(watched)) if name)
    series = [name for name in expected if name in run]
    motion = tuple(sample_extreme(name, run.unit(name), run.t, run[name]) for name in series)
    errors: tuple[Extreme, ...] = ()
    if reference is not None:
        compared = [name for name in series if name in reference]
        errors = tuple(sample_extreme(name, run.unit(name), run.t, run[name] - reference[name]) for name in compared)
    forces = {peak.joint: (peak.F, peak.t) for peak in run.diagnostics.peaks}
    for joint in run.source.joints if not (run.source.clearances or run.source.massless) else ():
        reaction = sample_extreme("", "N", run.t, run[f"{joint.name}.F"])
        forces[joint.name] = reaction.peak, reaction.t
    events = {event.name: tuple(run.events_of(event.name).tolist()) for event in run.source.events}
    driven = () if run.source.massless else drive_series(run.source)
    sliding = [joint.name for joint in rigid_guides(run.source) if not run.source.clearances]
    guided = [f"{name}.{last}" for name in run.source.guides or sliding for last in "FM" if not run.source.massless]
    drives, guides = (
        tuple(sample_extreme(name, run.unit(name), run.t, run[name]) for name in names) for names in (driven, guided)
    )
    rows = run.source.rows if run.source.formulation == "full" else run.source.closures
    found = run.source.scene, motion, errors, forces, run.constants, run.diagnostics, events, drives, guides
    return SceneReport(
        *found, bool(rows) or run.diagnostics.phi_max > 0.0, _largest_by_unit(run, forces, (*drives, *guides))
    )


def _largest_by_unit(
    run: Result, forces: Mapping[str, tuple[float, float]], drives: Sequence[Extreme]
) -> dict[str, float]:
    """Return the largest magnitude in a run by unit, with which rounding errors are compared."""
    found: dict[str, float] = {}
    sizes = [("N", force) for force, _ in forces.values()] + [(drive.unit, abs(drive.peak)) for drive in drives]
    for order, array in enumerate((run.q, run.v, run.a)):
        sizes += [(MOTION_UNITS[k % 3][order], float(np.nanmax(np.abs(x), initial=0.0))) for k, x in enumerate(array.T)]
    for unit, size in sizes:
        if math.isfinite(size):
            found[unit] = max(size, found.get(unit, 0.0))
    for of_place, of_angle in zip(*MOTION_UNITS[::2], strict=True):  # where nothing turns: what turned as far would
        if extent := found.get("m", 0.0):
            found[of_angle] = max(found.get(of_angle, 0.0), found.get(of_place, 0.0) / extent)
    return found


def as_json(reports: Sequence[SceneReport]) -> dict[str, Any]:
    """Return plain values for `--json`; NaN and infinity, which JSON lacks, are null."""
    scenes = {}
    for report in reports:
        scenes[report.scene] = {
            "motion": {e.name: asdict(e) for e in report.motion},
            "errors": {e.name: asdict(e) for e in report.errors},
            "peak_forces": {joint: {"F": force, "t": t} for joint, (force, t) in report.forces.items()},
            "drives": {e.name: asdict(e) for e in report.drives},
            "guides": {e.name: asdict(e) for e in report.guides},
            "peaks": {x.name: asdict(x) for x in report.diagnostics.extremes if not x.against},
            "peak_errors": {x.name: asdict(x) for x in report.diagnostics.extremes if x.against},
            "constants": dict(report.constants),
            "events": {name: list(times) for name, times in report.events.items()},
            "diagnostics": asdict(report.diagnostics),
        }
    clean: dict[str, Any] = replace_non_finite(scenes)
    return clean


def replace_non_finite(value: Any) -> Any:
    """Return the value with NaN and infinity, which JSON lacks, replaced by None at any depth."""
    if isinstance(value, dict):
        return {key: replace_non_finite(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [replace_non_finite(item) for item in value]
    if hasattr(value, "item"):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value


def tables(title: str, reports: Sequence[SceneReport], width: int, verbose: bool = False) -> list[Table]:
    """Return tables with a column for each scene and a row for each quantity, as many columns as fit `width`
    characters.

    `verbose` adds the rows of NEED_A_LEGEND.
    """
    from rich.measure import Measurement

    from gudgeon.language.shown import plain_console

    endless = plain_console(10_000)
    rows = [row for row in _rows(reports) if verbose or not row[0].endswith(NEED_A_LEGEND)]
    found: list[Table] = []
    for count in range(min(COLUMNS, len(reports)), 0, -1):
        parts = [slice(first, first + count) for first in range(0, len(reports), count)]
        found = [_table("" if part.start else title, reports, rows, part) for part in parts]
        if all(Measurement.get(endless, endless.options, table).maximum <= width for table in found):
            break
    return found


def _table(title: str, reports: Sequence[SceneReport], rows: list[tuple[str, list[str]]], part: slice) -> Table:
    """Return one rich Table of some of the reports."""
    from rich.box import SIMPLE_HEAD
    from rich.table import Table
    from rich.text import Text

    from gudgeon.language.shown import one_line

    title = one_line(title)
    table = Table(title=title or None, title_justify="left", title_style="bold", box=SIMPLE_HEAD, pad_edge=False)
    table.add_column("", no_wrap=True)
    for report in reports[part]:
        table.add_column(report.scene, justify="right", no_wrap=True)
    for name, cells in rows:
        if not cells:
            table.add_section()
            table.add_row(Text(name, style="bold"))
        else:
            table.add_row(f"  {name}", *cells[part])
    return table


def _rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows (name, one cell a scene); a heading has no cells, and rows that are empty in all scenes are left
    out.
    """
    rows: list[tuple[str, list[str]]] = []
    for heading, part in (
        ("Peak error against ideal", _error_rows(reports)),
        ("Peak error against ideal, all steps", _extreme_rows(reports, True)),
        ("Peaks, all steps", _extreme_rows(reports, False)),
        ("Motion", _motion_rows(reports)),
        ("Peak force" if any(r.diagnostics.peaks for r in reports) else "Peak force, of samples", _force_rows(reports)),
        ("Peak of guides, of samples", _guide_rows(reports)),
        ("Peak of drives, of samples", _peak_rows(reports, [report.drives for report in reports])),
        ("Joints with play", _play_rows(reports)),
        ("Events", _event_rows(reports)),
        ("Trust", _trust_rows(reports)),
        ("Cost", _cost_rows(reports)),
    ):
        kept = [(name, cells) for name, cells in part if any(cell not in ("", "–") for cell in cells)]
        rows += [(heading, []), *kept] if kept else []
    return rows


def _peak_cell(value: float, unit: str, t: float, scales: Mapping[str, float]) -> str:
    """Return a peak and its time as a cell, "–" if it is not known."""
    if math.isfinite(t) and _is_noise(abs(value), unit, scales):
        return ZERO
    factor, text = drawn(value, unit)
    when = quantity(t, "s") if 0.0 < abs(t) < 1e-3 else f"{t:.4f} s"
    return f"{value * factor + 0.0:.4g} {text}".strip() + f" at {when}" if math.isfinite(t) else "–"


def _is_noise(size: float, unit: str, scales: Mapping[str, float]) -> bool:
    """Return whether a value is no larger than rounding errors."""
    return 0.0 < size < NOISE * scales.get(unit, 0.0)


def _error_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of peak errors against the ideal scene at the samples."""
    names = dict.fromkeys(e.name for report in reports for e in report.errors)
    found = [{e.name: _peak_cell(e.peak, e.unit, e.t, report.scales) for e in report.errors} for report in reports]
    return [(name, [cells.get(name, "–") for cells in found]) for name in names]


def _motion_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of the ranges of the watched series."""
    found = [{e.name: _range_cell(e, report.scales) for e in report.motion} for report in reports]
    names = dict.fromkeys(e.name for report in reports for e in report.motion)
    return [(name, [cells.get(name, "–") for cells in found]) for name in names]


def _extreme_rows(reports: Sequence[SceneReport], errors: bool) -> list[tuple[str, list[str]]]:
    """Return the rows of peaks over all steps of the series in `peaks:` of a scene."""
    cells = [partial(_peak_cell, scales=report.scales) for report in reports]
    return table_rows([report.diagnostics.extremes for report in reports], cells, errors)


def _range_cell(extreme: Extreme, scales: Mapping[str, float]) -> str:
    """Return the smallest and largest value of a series as a cell."""
    if _is_noise(size := max(abs(extreme.low), abs(extreme.high)), extreme.unit, scales):
        return ZERO
    factor, text = drawn(size, extreme.unit)
    low, high = (0.0 if _is_noise(abs(x), extreme.unit, scales) else x * factor for x in (extreme.low, extreme.high))
    return f"{low:.5g} … {high:.5g} {text}".strip()


def _force_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of peak forces at the joints that have play in any scene, or else at all joints."""
    played = dict.fromkeys(peak.joint for report in reports for peak in report.diagnostics.peaks)
    joints = played or dict.fromkeys(joint for report in reports for joint in report.forces)
    missing = (math.nan, math.nan)
    return [
        (
            joint,
            [
                _peak_cell(r.forces.get(joint, missing)[0], "N", r.forces.get(joint, missing)[1], r.scales)
                for r in reports
            ],
        )
        for joint in joints
    ]


def _guide_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of peak forces and moments of guides that have play in any scene."""
    played = {f"{peak.joint.partition('.')[0]}." for r in reports for peak in r.diagnostics.peaks if "." in peak.joint}
    own = [tuple(e for e in report.guides if e.name[:-1] in played) for report in reports]
    return _peak_rows(reports, own)


def _peak_rows(reports: Sequence[SceneReport], peaks: Sequence[tuple[Extreme, ...]]) -> list[tuple[str, list[str]]]:
    """Return the rows of peaks at the samples, without those that are known over all steps."""
    found = [
        {e.name: _peak_cell(e.peak, e.unit, e.t, r.scales) for e in own} for r, own in zip(reports, peaks, strict=True)
    ]
    known = {x.name for report in reports for x in report.diagnostics.extremes}  # over all steps, which is more
    names = dict.fromkeys(e.name for own in peaks for e in own if e.name not in known)
    return [(name, [cells.get(name, "–") for cells in found]) for name in names]


def _play_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of each joint with play: first contact, its peak, largest eccentricity, constants."""
    peaks = [{peak.joint: peak for peak in report.diagnostics.peaks} for report in reports]
    rows = []
    for joint in dict.fromkeys(name for found in peaks for name in found):
        shown = [found.get(joint) for found in peaks]
        contacts = [p.first_contact if p else math.nan for p in shown]
        rows.append((f"{joint} first contact", [quantity(t, "s") for t in contacts]))
        rows.append((f"{joint} peak of that contact", [quantity(p.first_peak, "N", 5) if p else "–" for p in shown]))
        rows.append((f"{joint} largest e", [quantity(p.e_max, "m", 5) if p else "–" for p in shown]))
        for name, (unit, what) in CONSTANTS.items():
            values = (report.constants.get(f"{joint}.{name}", math.nan) for report in reports)
            message = what.replace("clearance", "gap") if "." in joint else what
            rows.append((f"{joint} {message}", [quantity(value, unit) for value in values]))
    return rows


def _event_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of events: number and first time; a dash in scenes that do not have the event."""

    def cell(times: tuple[float, ...] | None) -> str:
        """Return number and first time of an event as a cell."""
        if not times:
            return "–" if times is None else "none"
        return f"at {times[0]:.7g} s" if len(times) == 1 else f"{len(times)}, first at {times[0]:.7g} s"

    names = dict.fromkeys(name for r in reports for name in r.events)
    return [(name, [cell(r.events.get(name)) for r in reports]) for name in names]


def _trust_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of accuracy: drift, energy residual, predictability horizon, contacts, audit."""
    every = [report.diagnostics for report in reports]
    play = [bool(d.peaks) for d in every]
    ratio = [f"{d.ratio_min:.3g} … {d.ratio_max:.3g}" if math.isfinite(d.ratio_min) else "–" for d in every]
    return [
        ("max |Φ|", [f"{r.diagnostics.phi_max:.2e}" if r.constrained else "no row is left" for r in reports]),
        ("max |Φ̇|", [f"{r.diagnostics.phi_dot_max:.2e}" if r.constrained else "–" for r in reports]),
        ("energy residual", [quantity(d.energy_residual, "J", 3) for d in every]),
        ("energy turned over", [quantity(d.energy_turned_over, "J", 3) for d in every]),
        ("trusted until", [_horizon_cell(d.horizon) for d in every]),
        ("contacts that began", [str(d.onsets) if p else "–" for d, p in zip(every, play, strict=True)]),
        ("δ̇/δ̇⁻ while latched", ratio),
        ("steps with it outside ±1", [str(d.ratio_outside) if math.isfinite(d.ratio_min) else "–" for d in every]),
        *_audit_rows(reports),
    ]


def _audit_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of the largest value of each check of the audit, in its limits, if it is above rounding."""
    found = [{one.check: one.worst for one in report.diagnostics.audit} for report in reports]
    checks = dict.fromkeys(check for one in found for check, worst in one.items() if worst >= AUDIT_SHOWN)
    largest = [max(one.values(), default=math.nan) for one in found]
    return [
        ("audit, in limits", [f"{worst:.1e}" if math.isfinite(worst) else "–" for worst in largest]),
        *((f"audit of {check}", [f"{one[check]:.1e}" if check in one else "–" for one in found]) for check in checks),
    ]


def _horizon_cell(horizon: float) -> str:
    """Return the predictability horizon as a cell; NaN: not requested. See predictability.py."""
    return "to the end" if horizon == math.inf else quantity(horizon, "s", 3)


def _cost_rows(reports: Sequence[SceneReport]) -> list[tuple[str, list[str]]]:
    """Return the rows of cost: method, steps, evaluations and run time."""
    every = [report.diagnostics for report in reports]
    return [
        ("method", [d.method for d in every]),
        ("step", [quantity(d.step, "s") for d in every]),
        ("last step", [quantity(d.last_step, "s") for d in every]),
        ("tolerance of a step", [f"{d.rtol:.3g}" if math.isfinite(d.rtol) else "–" for d in every]),
        ("steps", [f"{d.steps:,}" if d.steps else "–" for d in every]),
        ("right-hand sides", [f"{d.right_hand_sides:,}" if d.right_hand_sides else "–" for d in every]),
        ("s per simulated s", [f"{d.seconds_per_simulated_second:.3g}" for d in every]),
    ]

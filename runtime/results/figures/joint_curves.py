"""Compute curves of joints with play for figures: force extremes and journal paths over all steps of a run.

Contacts are a thousand times shorter than runs, and samples miss their peaks. The time loop in C stores for each joint,
over groups of consecutive steps, the smallest and largest force and the outermost and last position of the journal
(engine/run/envelope.c). If its rows are used up, pairs of rows are merged, so that an envelope has at most ROWS rows. A
curve through it contains every extreme. Batches, the cross-checks and older files have no envelope: their curves go
through the samples and the peaks of all contacts. `assign_panels` assigns forces to the panels of a figure.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.results.peaks import is_rigid_impact

if TYPE_CHECKING:
    from gudgeon.model.compiled import Array
    from gudgeon.results.results import Result

MAX_PANELS = 4  # panels of a figure


def get_force_curve(run: Result, joint: str) -> tuple[Array, Array]:
    """Return times and force magnitudes (N) of a joint, sorted by time, (k,) each: samples and extremes over steps.

    The extremes are those of the envelope (run.trace). Without an envelope they are the peaks of all impacts with a
    duration, and the peak of the run (diagnostics.peaks). For a joint without play there are samples only.
    """
    k = _find_clearance_index(run, joint)
    if k is None:
        return run.t, run[f"{joint}.F"]
    if run.trace is None:
        impacts = run.impacts[(run.impacts["joint"] == k) & ~is_rigid_impact(run.impacts)]
        peaks = [(peak.t, peak.F) for peak in run.diagnostics.peaks if peak.joint == joint]
        extreme_times, extreme_forces = (
            [impacts["t_peak"], [t for t, _ in peaks]],
            [impacts["F_peak"], [F for _, F in peaks]],
        )
    else:
        min_force, t_low, max_force, t_high = run.trace.joints[:, k, :4].T
        extreme_times, extreme_forces = [t_low, t_high], [min_force, max_force]
    return _sort_by_time(np.concatenate([run.t, *extreme_times]), np.concatenate([run[f"{joint}.F"], *extreme_forces]))


def get_journal_path(run: Result, joint: str) -> tuple[Array, Array, Array]:
    """Return times, x and y (m) of the journal in its bearing by time, (k,) each: samples, and positions of the
    envelope.
    """
    t, x, y = [run.t], [run[f"{joint}.ex"]], [run[f"{joint}.ey"]]
    k = _find_clearance_index(run, joint)
    if run.trace is not None and k is not None:
        x_out, y_out, t_out, x_end, y_end = run.trace.joints[:, k, 4:].T
        t, x, y = [*t, t_out, run.trace.t], [*x, x_out, x_end], [*y, y_out, y_end]
    times, x_sorted = _sort_by_time(np.concatenate(t), np.concatenate(x))
    return times, x_sorted, _sort_by_time(np.concatenate(t), np.concatenate(y))[1]


def _find_clearance_index(run: Result, joint: str) -> int | None:
    """Return the index in source.clearances of a joint with play; None for another name."""
    names = [clearance.name for clearance in run.source.clearances]
    return names.index(joint) if joint in names else None


def _sort_by_time(t: Array, values: Array) -> tuple[Array, Array]:
    """Return times and values (k,) sorted by time."""
    order = np.argsort(t, kind="stable")
    return t[order], values[order]


def assign_panels(runs: Iterable[Result]) -> dict[str, list[str]]:
    """Return the names of the series in each panel of a force figure, by the panel's title; the first MAX_PANELS.

    A bearing "A" has {"force at A": ["A.F"]}. A guide has panels for force and moment on its slider, at samples, and
    for the forces at its corners, with the extremes of all steps.
    """
    series_by_title = dict[str, list[str]]()
    for joint in dict.fromkeys(joint.name for run in runs for joint in run.source.clearances):
        guide, _, corner = joint.partition(".")
        series_by_title.setdefault(f"force at {guide}{', of samples' * bool(corner)}", [f"{guide}.F"])
        if corner:
            series_by_title.setdefault(f"moment at {guide}, of samples", [f"{guide}.M"])
            series_by_title.setdefault(f"forces at corners of {guide}", []).append(f"{joint}.F")
    return dict([*series_by_title.items()][:MAX_PANELS])


def get_curve(run: Result, name: str) -> tuple[Array, Array]:
    """Return times and values of a series of a panel, (k,) each; of a force "A.F" with the extremes over all steps."""
    return get_force_curve(run, name.removesuffix(".F")) if name.endswith(".F") else (run.t, run[name])


def find_peaks(run: Result, name: str) -> Iterator[tuple[float, float]]:
    """Yield time and value of the peak of a series over all steps, if it is known.

    It is known for forces in joints with play, and for series whose peaks were requested: of these, the maximum or
    minimum with the larger magnitude is yielded, with its sign.
    """
    yield from ((peak.t, peak.F) for peak in run.diagnostics.peaks if f"{peak.joint}.F" == name)
    for extremes in run.diagnostics.extremes:
        if extremes.name == name and not extremes.against:
            yield extremes.t_abs, extremes.max if extremes.max >= -extremes.min else extremes.min

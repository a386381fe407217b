"""Own the curves of joints with play in figures: forces and paths from the envelope over the steps, not from samples.

Contacts are a thousand times shorter than runs, and samples miss their peaks. The time loop in C stores for each joint,
over groups of consecutive steps, the smallest and largest force and the outermost and last position of the journal
(engine/run/envelope.c). If its rows are used up, pairs of rows are merged, so that an envelope has at most ROWS rows. A
curve through it contains every extreme. Batches, the cross-checks and older files have no envelope: their curves go
through the samples and the peaks of all contacts. `panels` assigns forces to the panels of a figure.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.results.peaks import is_rigid_impact

if TYPE_CHECKING:
    from gudgeon.model.compiled import Array
    from gudgeon.results.results import Result

MOST = 4  # panels of a figure


def force(run: Result, joint: str) -> tuple[Array, Array]:
    """Return times and magnitudes of the force at a joint, (k,) each: samples, and every extreme of the steps in
    between.
    """
    k = _clearance_index(run, joint)
    if k is None:
        return run.t, run[f"{joint}.F"]
    if run.trace is None:
        own = run.impacts[(run.impacts["joint"] == k) & ~is_rigid_impact(run.impacts)]
        peaks = [(peak.t, peak.F) for peak in run.diagnostics.peaks if peak.joint == joint]
        more_t, more = [own["t_peak"], [t for t, _ in peaks]], [own["F_peak"], [F for _, F in peaks]]
    else:
        low, t_low, high, t_high = run.trace.joints[:, k, :4].T
        more_t, more = [t_low, t_high], [low, high]
    return _sort_by_time(np.concatenate([run.t, *more_t]), np.concatenate([run[f"{joint}.F"], *more]))


def path(run: Result, joint: str) -> tuple[Array, Array, Array]:
    """Return times, x and y (m) of the journal in its bearing, (k,) each: samples, and positions from the steps in
    between.
    """
    t, x, y = [run.t], [run[f"{joint}.ex"]], [run[f"{joint}.ey"]]
    k = _clearance_index(run, joint)
    if run.trace is not None and k is not None:
        x_out, y_out, t_out, x_end, y_end = run.trace.joints[:, k, 4:].T
        t, x, y = [*t, t_out, run.trace.t], [*x, x_out, x_end], [*y, y_out, y_end]
    times, xs = _sort_by_time(np.concatenate(t), np.concatenate(x))
    return times, xs, _sort_by_time(np.concatenate(t), np.concatenate(y))[1]


def _clearance_index(run: Result, joint: str) -> int | None:
    """Return the number of a joint with play; None for another name."""
    names = [clearance.name for clearance in run.source.clearances]
    return names.index(joint) if joint in names else None


def _sort_by_time(t: Array, values: Array) -> tuple[Array, Array]:
    """Return times and values (k,) sorted by time."""
    order = np.argsort(t, kind="stable")
    return t[order], values[order]


def panels(runs: Iterable[Result]) -> dict[str, list[str]]:
    """Return the series of each panel of forces by its title.

    A bearing has a panel for its force. A guide has panels for force and moment on its slider, at samples, and for the
    forces at its corners, with the extremes of all steps.
    """
    found = dict[str, list[str]]()
    for joint in dict.fromkeys(joint.name for run in runs for joint in run.source.clearances):
        guide, _, corner = joint.partition(".")
        found.setdefault(f"force at {guide}{', of samples' * bool(corner)}", [f"{guide}.F"])
        if corner:
            found.setdefault(f"moment at {guide}, of samples", [f"{guide}.M"])
            found.setdefault(f"forces at corners of {guide}", []).append(f"{joint}.F")
    return dict([*found.items()][:MOST])


def curve(run: Result, name: str) -> tuple[Array, Array]:
    """Return times and values of a series of a panel, (k,) each."""
    return force(run, name.removesuffix(".F")) if name.endswith(".F") else (run.t, run[name])


def peaks(run: Result, name: str) -> Iterator[tuple[float, float]]:
    """Yield time and value of the peak of a series over all steps, if it is known; for a guide, if it was requested."""
    yield from ((peak.t, peak.F) for peak in run.diagnostics.peaks if f"{peak.joint}.F" == name)
    for one in run.diagnostics.extremes:
        if one.name == name and not one.against:
            yield one.t_abs, one.max if one.max >= -one.min else one.min

"""Curves of joints with play in figures: forces and paths from the steps of a run (its trace), not from its samples.

Contacts are a thousand times shorter than runs, and samples miss their peaks. The time loop in C keeps of each joint,
for so many steps in a row, the least and the largest force, the outermost and the last place of the journal; where
its rows are used up, two become one (engine/run/envelope.c). So a trace is never longer than ROWS, and a curve
through it meets every extreme. Batches, the cross-checks and older files have none: their curves go through the samples
and the peaks of all contacts. `panels` says which forces a figure shows beside each other.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.results.peaks import is_blow

if TYPE_CHECKING:
    from gudgeon.model.compiled import Array
    from gudgeon.results.results import Result

MOST = 4  # panels of a figure


def force(run: Result, joint: str) -> tuple[Array, Array]:
    """Times and magnitudes of the force at a joint, (k,) each: samples, with every extreme of all steps in between."""
    k = _index(run, joint)
    if k is None:
        return run.t, run[f"{joint}.F"]
    if run.trace is None:
        own = run.impacts[(run.impacts["joint"] == k) & ~is_blow(run.impacts)]
        peaks = [(peak.t, peak.F) for peak in run.diagnostics.peaks if peak.joint == joint]
        more_t, more = [own["t_peak"], [t for t, _ in peaks]], [own["F_peak"], [F for _, F in peaks]]
    else:
        low, t_low, high, t_high = run.trace.joints[:, k, :4].T
        more_t, more = [t_low, t_high], [low, high]
    return _in_order(np.concatenate([run.t, *more_t]), np.concatenate([run[f"{joint}.F"], *more]))


def path(run: Result, joint: str) -> tuple[Array, Array, Array]:
    """Times, x and y (m) of the journal in its bearing, (k,) each: samples, and what the steps passed through."""
    t, x, y = [run.t], [run[f"{joint}.ex"]], [run[f"{joint}.ey"]]
    k = _index(run, joint)
    if run.trace is not None and k is not None:
        x_out, y_out, t_out, x_end, y_end = run.trace.joints[:, k, 4:].T
        t, x, y = [*t, t_out, run.trace.t], [*x, x_out, x_end], [*y, y_out, y_end]
    times, xs = _in_order(np.concatenate(t), np.concatenate(x))
    return times, xs, _in_order(np.concatenate(t), np.concatenate(y))[1]


def _index(run: Result, joint: str) -> int | None:
    names = [clearance.name for clearance in run.source.clearances]
    return names.index(joint) if joint in names else None


def _in_order(t: Array, values: Array) -> tuple[Array, Array]:
    order = np.argsort(t, kind="stable")
    return t[order], values[order]


def panels(runs: Iterable[Result]) -> dict[str, list[str]]:
    """Series by what a panel is called: the force at each bearing; of a guide force and moment on its slider, at
    samples, and the forces at its corners, through the extremes of all steps."""
    found = dict[str, list[str]]()
    for joint in dict.fromkeys(joint.name for run in runs for joint in run.source.clearances):
        guide, _, corner = joint.partition(".")
        found.setdefault(f"force at {guide}{', of samples' * bool(corner)}", [f"{guide}.F"])
        if corner:
            found.setdefault(f"moment at {guide}, of samples", [f"{guide}.M"])
            found.setdefault(f"forces at corners of {guide}", []).append(f"{joint}.F")
    return dict([*found.items()][:MOST])


def curve(run: Result, name: str) -> tuple[Array, Array]:
    """Times and values of a series of a panel, (k,) each."""
    return force(run, name.removesuffix(".F")) if name.endswith(".F") else (run.t, run[name])


def peaks(run: Result, name: str) -> Iterator[tuple[float, float]]:
    """Time and value of its peak over all steps, where that is known: of a guide if the run was asked for it."""
    yield from ((peak.t, peak.F) for peak in run.diagnostics.peaks if f"{peak.joint}.F" == name)
    for one in run.diagnostics.extremes:
        if one.name == name and not one.against:
            yield one.t_abs, one.max if one.max >= -one.min else one.min

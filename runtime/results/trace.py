"""The trace of a run: forces and paths of the joints with play from its steps, not from its samples.

Contacts are a thousand times shorter than runs, and samples miss their peaks. The time loop in C keeps of each joint,
for so many steps in a row, the least and the largest force, the outermost and the last place of the journal; where
its rows are used up, two become one (engine/run/trace.c). So a trace is never longer than ROWS, and a curve
through it meets every extreme. Batches, the cross-checks and older files have none: their curves go through the samples
and the peaks of all contacts.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gudgeon.results.peaks import is_blow

if TYPE_CHECKING:
    from gudgeon.model.compiled import Array
    from gudgeon.results.results import Result

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

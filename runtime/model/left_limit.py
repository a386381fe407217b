"""Choose the times at which samples are evaluated: accelerations at the end of a run are limits from the left.

A drive's acceleration may switch exactly at the end (extrapolated curve, `where`, `ramp`). The last sample is then
evaluated just before. A jump of the rate is an impulse that the last velocities already contain. There, the side after
it is used, so that a run that resumes from this one begins with the same velocities.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gudgeon.language.functions import PIECEWISE
from gudgeon.language.tree import CurveCall, iterate_calls
from gudgeon.model.evaluation import compute_rounding_distance
from gudgeon.model.file_expressions import read_expression_trees

if TYPE_CHECKING:
    from gudgeon.model.compiled import Array, CompiledModel
    from gudgeon.results.results import Result

JUMP_TOL = 1e-6  # relative difference of the values on both sides from which on it counts as a jump
# largest ratio of a smooth change of ν between both sides to the change that the accelerations give
MAX_SMOOTH_CHANGE_RATIO = 1e3


def may_acceleration_jump(compiled: CompiledModel) -> bool:
    """Return whether the acceleration that a drive prescribes may jump at some time.

    It may if any drive's expression contains a piecewise function or a curve.
    """
    return any(
        call.function in PIECEWISE or isinstance(call, CurveCall)
        for _, tree in read_expression_trees(compiled.source, ("drives",))
        for call in iterate_calls(tree)
    )


def find_evaluation_times(
    compiled: CompiledModel, t: Array, q: Array, v: Array, p: Array, start_time: float = np.inf
) -> Array:
    """Return the times (N,) at which the samples of one run are evaluated; the last may be just before t[-1].

    That is so if the accelerations of drives jump at t[-1] and their rates do not: the last sample then has the
    accelerations before the jump. `start_time` (s): the begin of the run, for a single sample after it. q, v: (N, n).
    """
    previous_time = float(t[-2]) if len(t) > 1 else start_time
    if not len(t) or not previous_time < t[-1] or not compiled.may_drive_acceleration_jump:
        return t
    before, after = (float(t[-1] + sign * compute_rounding_distance(t[-1])) for sign in (-2.0, 2.0))
    gamma = [compiled.closed_gamma(time, q[-1], v[-1], p) for time in (before, after)]
    nu = [compiled.closed_nu(time, q[-1], p) for time in (before, after)]
    max_smooth_change = MAX_SMOOTH_CHANGE_RATIO * float(np.abs(gamma).max(initial=0.0)) * (after - before)
    is_switching_point = (
        _has_jump(*gamma).any() and not (_has_jump(*nu) & (np.abs(nu[1] - nu[0]) > max_smooth_change)).any()
    )
    return np.append(t[:-1], before) if is_switching_point and before > previous_time else t


def find_evaluation_times_of_result(run: Result, compiled: CompiledModel) -> Array:
    """Return the times (N,) at which the samples of a result are evaluated, as `find_evaluation_times`."""
    start_time = np.inf if run.start_row is None else float(run.start_row.t[0])
    return find_evaluation_times(compiled, run.t, run.q, run.v, run.p, start_time)


def _has_jump(before: Array, after: Array) -> NDArray[np.bool_]:
    """Return a mask of the values that differ by more than JUMP_TOL, relative to the sum of their magnitudes."""
    return np.asarray(np.abs(before - after) > JUMP_TOL * (np.abs(before) + np.abs(after)))

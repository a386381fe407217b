"""Find extremes of series: `run.peak("S9.ay")` over all steps, if requested before the run; others over samples.

Also peaks as rows of a table, and the largest forces in joints with play of many runs. An impact of rigid surfaces is a
record of a run's impacts with zero duration, whose F_peak is an impulse.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import PEAK_F, PEAK_e_max, PEAK_t
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.results.diagnostics import Extremes
from gudgeon.results.series import check_series

if TYPE_CHECKING:
    from gudgeon.model.compiled import Array
    from gudgeon.results.results import Result

PEAK_DTYPE = np.dtype([(name, "f8") for name in ("F", "t", "e_max", "first_contact", "first_peak")])
ENDS = ("max", "t_max", "min", "t_min")
MIN_ZENO_IMPACTS = 3  # impacts before a lasting contact from which on they count as a Zeno point
MAX_ZENO_MESSAGES = 3  # Zeno points of a joint that are reported one by one


@dataclass(frozen=True)
class Extreme:
    """Smallest and largest value of a series over the samples of a run, and value and time of the largest magnitude."""

    name: str
    unit: str
    low: float
    high: float
    peak: float
    t: float


def find_sample_extreme(name: str, unit: str, t: Array, values: Array) -> Extreme:
    """Return smallest value, largest value, and value and time of the largest magnitude of a series over its samples
    (N,).

    All are NaN if no value is finite.
    """
    if not np.isfinite(values).any():
        return Extreme(name, unit, math.nan, math.nan, math.nan, math.nan)
    index = int(np.nanargmax(np.abs(values)))
    return Extreme(
        name, unit, float(np.nanmin(values)), float(np.nanmax(values)), float(values[index]), float(t[index])
    )


def find_extremes_over_steps(run: Result, name: str, is_error: bool) -> Extremes:
    """Return the extremes of a series of a run over all steps, or with `is_error` those of its error against another
    scene.

    Extremes of the series itself are extended by the samples. Raises UnknownNameError for a series that the run does
    not have, BadValueError for one whose peaks were not requested.
    """
    if not isinstance(name, str) or name not in run.names:
        raise run.make_unknown_name_error(name)
    for extremes in run.diagnostics.extremes:
        if extremes.name == name and bool(extremes.against) == is_error:
            return extremes if is_error else _extend_by_samples(extremes, run)
    raise _make_peak_not_requested_error(name, is_error)


def _extend_by_samples(extremes: Extremes, run: Result) -> Extremes:
    """Return the extremes over all steps, extended so that no sample lies beyond them.

    Between the ends of a step its polynomial is only as accurate as the tolerance. They are returned unchanged if the
    series cannot be evaluated at a sample.
    """
    try:
        values = run[extremes.name]
    except GudgeonError:  # a sample cannot be evaluated
        return extremes
    maximum_and_minimum = ((extremes.max, extremes.t_max), (extremes.min, extremes.t_min))
    (max_value, max_time), (min_value, min_time) = (
        _extend_extremes(extreme, run.t[None], values[None], sign)
        for extreme, sign in zip(maximum_and_minimum, (1.0, -1.0), strict=True)
    )
    return replace(
        extremes, max=float(max_value[0]), t_max=float(max_time[0]), min=float(min_value[0]), t_min=float(min_time[0])
    )


def _extend_extremes(
    current_extremes: tuple[Array | float, Array | float], t: Array, values: Array, sign: float
) -> tuple[Array, Array]:
    """Return extremes (n,) of n runs and their times, replaced by samples that lie beyond.

    `current_extremes` has values and times; `t` and `values` are the samples (n, N), NaN where there is none. `sign` is
    1 for maxima, −1 for minima.
    """
    extreme_values, times = (np.atleast_1d(np.asarray(x, dtype=float)) for x in current_extremes)
    if not values.shape[1]:
        return extreme_values, times
    signed_samples = np.where(np.isfinite(values), sign * values, -np.inf)
    best_indices, run_indices = signed_samples.argmax(axis=1), np.arange(len(signed_samples))
    is_beyond = np.isfinite(signed_samples[run_indices, best_indices]) & ~(
        sign * extreme_values >= signed_samples[run_indices, best_indices]
    )
    return np.where(is_beyond, values[run_indices, best_indices], extreme_values), np.where(
        is_beyond, t[run_indices, best_indices], times
    )


def _make_peak_not_requested_error(name: str, is_error: bool) -> BadValueError:
    """Return the error for a peak that was not requested, with the call that requests it.

    `is_error` selects the text for the error of a series against another scene.
    """
    if is_error:
        message = f"the error of {name} over all steps is not known"
        return BadValueError(
            message, hint=f'simulate(…, peaks=["{name}"], against=ideal), where ideal is a loaded scene'
        )
    message = f"the peak of {name} over all steps was not requested and cannot be found from samples"
    return BadValueError(message, hint=f'simulate(…, peaks=["{name}"]), or peaks: [{name}] in the scene of the file')


def build_extreme_rows(
    scene_extremes: Sequence[Sequence[Extremes]],
    formatters: Sequence[Callable[[float, str, float], str]],
    is_error: bool,
) -> list[tuple[str, list[str]]]:
    """Return rows (name, one cell a scene) of a table of extremes; a scene without the series has the cell "–".

    `formatters` convert value, unit and time of each scene to text. With `is_error`, each error has one row with the
    largest magnitude; other series have two, "NAME max" and "NAME min".
    """
    extremes_by_scene = [
        {
            series_extremes.name: series_extremes
            for series_extremes in extremes
            if bool(series_extremes.against) == is_error
        }
        for extremes in scene_extremes
    ]
    rows = []
    for name in dict.fromkeys(name for by_name in extremes_by_scene for name in by_name):
        for bound in ("",) if is_error else ("max", "min"):
            cell_arguments = [
                _get_extreme(by_name[name], bound) if name in by_name else None for by_name in extremes_by_scene
            ]
            cell_texts = [
                formatter(*arguments) if arguments else "–"
                for formatter, arguments in zip(formatters, cell_arguments, strict=True)
            ]
            rows.append((f"{name} {bound}".strip(), cell_texts))
    return rows


def _get_extreme(extremes: Extremes, bound: str) -> tuple[float, str, float]:
    """Return value, unit and time (s) of an extreme of a series.

    `bound` is "max", "min", or "" for the one of the larger magnitude.
    """
    bound = bound or ("min" if -extremes.min > extremes.max else "max")
    return (
        (extremes.max, extremes.unit, extremes.t_max)
        if bound == "max"
        else (extremes.min, extremes.unit, extremes.t_min)
    )


@dataclass(frozen=True, eq=False)
class BatchPeaks:
    """Extremes of a series of n runs, (n,) each; NaN for a run that did not begin."""

    name: str
    unit: str
    max: Array
    t_max: Array  # s
    min: Array
    t_min: Array  # s
    against: str = ""  # the scene whose series was subtracted; "": none

    @property
    def abs(self) -> Array:
        """The largest magnitude of each run, (n,)."""
        return np.maximum(self.max, -self.min)

    @property
    def t_abs(self) -> Array:
        """Time of the largest magnitude of each run, (n,), s."""
        return np.where(-self.min > self.max, self.t_min, self.t_max)


def find_batch_extremes(
    source: KernelSource,
    run_extremes_list: Sequence[Sequence[Extremes]],
    name: str,
    is_error: bool,
    get_samples: Callable[[], tuple[Array, Array]],
) -> BatchPeaks:
    """Return the extremes of a series over all steps of each run, (n,) each; NaN for a run without them.

    `get_samples` returns times and values (n, N), by which extremes of the series itself are extended. Raises
    UnknownNameError, and BadValueError if no run has the extremes.
    """
    check_series(source, [name])
    extremes_by_run = [
        next(
            (extremes for extremes in run_extremes if extremes.name == name and bool(extremes.against) == is_error),
            None,
        )
        for run_extremes in run_extremes_list
    ]
    first_known = next(filter(None, extremes_by_run), None)
    if first_known is None:
        raise _make_peak_not_requested_error(name, is_error)
    values = {
        key: np.array([getattr(extremes, key) if extremes else np.nan for extremes in extremes_by_run]) for key in ENDS
    }
    if not is_error:
        t, sampled_values = get_samples()
        for end_name, sign in (("max", 1.0), ("min", -1.0)):
            values[end_name], values[f"t_{end_name}"] = _extend_extremes(
                (values[end_name], values[f"t_{end_name}"]), t, sampled_values, sign
            )
    return BatchPeaks(name, first_known.unit, **values, against=first_known.against)


def build_extreme_columns(run_extremes_list: Sequence[Sequence[Extremes]]) -> Iterator[tuple[str, str, Array]]:
    """Yield column name, unit and values (n,) of each extreme of n runs for tables; NaN for a run without it.

    Columns are "S9.ay.peak.max", "S9.ay.peak.t_max", "S9.ay.error.min" and so on.
    """
    for series_key in dict.fromkeys(
        (extremes.name, extremes.unit, extremes.against)
        for run_extremes in run_extremes_list
        for extremes in run_extremes
    ):
        extremes_by_run = [
            next(
                (
                    extremes
                    for extremes in run_extremes
                    if (extremes.name, extremes.unit, extremes.against) == series_key
                ),
                None,
            )
            for run_extremes in run_extremes_list
        ]
        for end_name in ENDS:
            values = np.array([getattr(extremes, end_name) if extremes else np.nan for extremes in extremes_by_run])
            yield (
                f"{series_key[0]}.{'error' if series_key[2] else 'peak'}.{end_name}",
                "s" if end_name.startswith("t_") else series_key[1],
                values,
            )


def build_peak_records(stored_peaks: Array, impacts: NDArray[Any], n_impacts: NDArray[np.int_]) -> NDArray[Any]:
    """Return the peak forces of all runs as PEAK_DTYPE (n, n_clearances), NaN where there is none.

    `stored_peaks` (n, n_clearances, N_PEAK) contains F, t and e_max. `impacts` are those of all runs one after the
    other, `n_impacts` (n,) the number of each run. `first_peak` is NaN if the first contact is a rigid impact.
    """
    peaks = np.full(stored_peaks.shape[:2], np.nan, dtype=PEAK_DTYPE)
    for k, name in ((PEAK_F, "F"), (PEAK_t, "t"), (PEAK_e_max, "e_max")):
        peaks[name] = stored_peaks[:, :, k]
    run_of_impact = np.repeat(np.arange(len(n_impacts)), n_impacts)
    for joint in range(stored_peaks.shape[1]):
        indices = np.flatnonzero(impacts["joint"] == joint)
        indices = indices[np.flatnonzero(np.diff(run_of_impact[indices], prepend=-1))]  # the first of each run
        run_indices, first_impacts = run_of_impact[indices], impacts[indices]
        peaks["first_contact"][run_indices, joint] = first_impacts["t_on"]
        peaks["first_peak"][run_indices, joint] = np.where(
            is_rigid_impact(first_impacts), np.nan, first_impacts["F_peak"]
        )
    return peaks


def is_rigid_impact(impacts: NDArray[Any]) -> NDArray[np.bool_]:
    """Return which of the impacts (k,) have zero duration: impacts of rigid surfaces."""
    is_instantaneous: NDArray[np.bool_] = impacts["t_off"] == impacts["t_on"]
    return is_instantaneous


def find_first_contact_force(impacts: NDArray[Any]) -> float:
    """Return the largest force of a joint's first contact, N; NaN for an impact of rigid surfaces, which has an impulse
    instead.
    """
    return math.nan if is_rigid_impact(impacts[:1])[0] else float(impacts["F_peak"][0])


def describe_zeno_points(joints: Sequence[str], impacts: NDArray[Any]) -> Iterator[str]:
    """Yield a note for each Zeno point of a run: MIN_ZENO_IMPACTS or more ever slower impacts, then a lasting contact.

    `impacts` are those of all `joints`. The first MAX_ZENO_MESSAGES of a joint have a note each; if there are more, one
    more note has their number.
    """
    for k, name in enumerate(joints):
        joint_impacts = impacts[impacts["joint"] == k]
        zeno_points = [
            (n_bounces, float(joint_impacts["t_on"][i]))
            for i in range(len(joint_impacts))
            if (n_bounces := _count_bounces_before(joint_impacts, i)) >= MIN_ZENO_IMPACTS
        ]
        for count, t in zeno_points[:MAX_ZENO_MESSAGES]:
            yield (
                f"{name}: {count} bounces accumulated until t = {t:.9g} s, where the contact is closed: the rebound is"
                " slower than the law's threshold"
            )
        if len(zeno_points) > MAX_ZENO_MESSAGES:
            yield f"{name}: bounces accumulated {len(zeno_points)} times, the last at t = {zeno_points[-1][1]:.9g} s"


def _count_bounces_before(impacts: NDArray[Any], i: int) -> int:
    """Return the number of consecutive rigid impacts, each slower than the one before, that lead to lasting contact i.

    The last of them has the time of the onset of contact i. Returns 0 if record i is itself an impact of zero duration.
    `impacts` are those of one joint, by time.
    """
    if bool(is_rigid_impact(impacts[i : i + 1])[0]):
        return 0
    count, max_speed = 0, 0.0
    for impact in impacts[:i][::-1]:
        is_consecutive = count > 0 or impact["t_on"] == impacts["t_on"][i]
        if not (is_consecutive and impact["t_off"] == impact["t_on"] and impact["deltadot"] > max_speed):
            break
        count, max_speed = count + 1, float(impact["deltadot"])
    return count

"""Compute the measures of a study, one number for each run: statistics of series, peaks, contacts, events, wear."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, InputError, UnknownNameError
from gudgeon.results.batch import Array
from gudgeon.results.series import check_series, get_catalogue
from gudgeon.results.wear import SlidingRequest, compute_shortest_arc
from gudgeon.simulation.examine import has_known_contact_force
from gudgeon.studies.ensemble.exponents import MOTION_CODES_TEXT, NEIGHBOUR_STATISTICS
from gudgeon.studies.ensemble.parameter_values import ROUNDING

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import Measure
    from gudgeon.results.batch import Batch

ReferenceSeries: TypeAlias = Mapping[
    str, Mapping[str, Array]
]  # scene -> series of runs, (n, N) each, at their own samples
Spans: TypeAlias = Mapping[str, tuple[Array | None, ...]]  # window -> begin and end (s) of each run; None: of the run

STEP_STATISTICS: Mapping[str, str] = {
    "max_of_steps": "max",
    "min_of_steps": "min",
    "peak_of_steps": "abs",
    "deviation_of_steps": "abs",
}
JOINT_PEAKS: Mapping[str, str] = {"peak_force": "F", "eccentricity": "e_max"}
CONTACT_STATISTICS, CROSSING_STATISTICS = ("impacts", "first_impact", "impact_speed"), ("crossings", "first_crossing")
WEAR_STATISTICS = ("wear_depth", "wear_arc")
JOINT_STATISTICS = (*CONTACT_STATISTICS, *JOINT_PEAKS, *WEAR_STATISTICS)
STATISTIC_UNITS = {
    "impacts": "",
    "first_impact": "s",
    "impact_speed": "m/s",
    "peak_force": "N",
    "eccentricity": "m",
    "wear_depth": "N/m",
    "wear_arc": "rad",
    "crossings": "",
    "first_crossing": "s",
}


def list_sampled_series(
    measures: tuple[Measure, ...], stored_names: tuple[str, ...], source: KernelSource
) -> list[str]:
    """Return the series of a scene whose samples are needed: those of sample statistics, and the stored series.

    Names that the scene lacks are left out. Statistics of contacts, events, steps and neighbouring trajectories need no
    samples.
    """
    catalogue = get_catalogue(source)
    others = (*JOINT_STATISTICS, *CROSSING_STATISTICS, *STEP_STATISTICS, *NEIGHBOUR_STATISTICS)
    expected = [*(str(measure.measured_name) for measure in measures if measure.statistic not in others), *stored_names]
    return [name for name in dict.fromkeys(expected) if name in catalogue]


def list_peak_series(measures: tuple[Measure, ...], source: KernelSource) -> list[str]:
    """Return the series of a scene whose peaks over all steps are measured (STEP_STATISTICS).

    Names that the scene lacks, and deviations of the scene from itself, which are 0, are left out.
    """
    catalogue = get_catalogue(source)
    expected = (
        str(measure.measured_name)
        for measure in measures
        if measure.statistic in STEP_STATISTICS and measure.reference_scene != source.scene
    )
    return [name for name in dict.fromkeys(expected) if name in catalogue]


def list_sliding_requests(measures: tuple[Measure, ...], source: KernelSource) -> tuple[SlidingRequest, ...]:
    """Return the requests for the sliding loads ∫F|v_t|dt of the joints whose wear is measured, without repetitions.

    Joints that the scene lacks, or whose wear cannot be measured, are left out.
    """
    joints = _list_joints_with_play(source, with_wear=True)
    expected = (str(measure.measured_name) for measure in measures if measure.statistic in WEAR_STATISTICS)
    return tuple(SlidingRequest(name) for name in dict.fromkeys(expected) if name in joints)


def find_measure_unit(measure: Measure, source: KernelSource) -> str | None:
    """Return the SI unit of a measure in a scene; None if the scene lacks its joint, event or series.

    It is also None for a measure of neighbouring trajectories in a scene with dof = 0. "" for a pure number.
    """
    if measure.statistic in JOINT_STATISTICS:
        return (
            STATISTIC_UNITS[measure.statistic]
            if measure.measured_name in _list_joints_with_play(source, measure.statistic in WEAR_STATISTICS)
            else None
        )
    if measure.statistic in CROSSING_STATISTICS:
        return STATISTIC_UNITS[measure.statistic] if measure.measured_name in _list_events(source) else None
    if measure.statistic in NEIGHBOUR_STATISTICS:
        return NEIGHBOUR_STATISTICS[measure.statistic] if source.degrees_of_freedom > 0 else None
    return get_catalogue(source)[measure.measured_name].unit if measure.measured_name in get_catalogue(source) else None


def make_unknown_measure_error(measure: Measure, source: KernelSource) -> InputError:
    """Return the error for a measure whose joint, event or series no scene of the study has.

    Its hint has the nearest names in this scene. Call it only if `find_measure_unit` returns None for the scene.
    """
    from gudgeon.language.names import make_unknown_name_error

    if measure.statistic in JOINT_STATISTICS:
        return make_unknown_name_error(
            "joint with play",
            measure.measured_name,
            _list_joints_with_play(source, measure.statistic in WEAR_STATISTICS),
            measure.measured_name.where,
        )
    if measure.statistic in CROSSING_STATISTICS:
        return make_unknown_name_error(
            "event", measure.measured_name, _list_events(source), measure.measured_name.where
        )
    if measure.statistic in NEIGHBOUR_STATISTICS:
        message = f"scene {source.scene} has no degree of freedom: perturbations cannot grow"
        return BadValueError(
            message, measure.measured_name.where, "expected a scene with at least one degree of freedom"
        )
    try:
        check_series(source, [str(measure.measured_name)])
    except UnknownNameError as error:
        return UnknownNameError(error.message, measure.measured_name.where, error.hint)
    raise AssertionError(measure)


def check_reference_series(measures: Iterable[Measure], source: KernelSource) -> None:
    """Raise UnknownNameError at the first measure whose reference scene is `source` but whose series it lacks.

    The reference scene is the one whose series is subtracted (key `from`). Measures with another one, or none, are not
    checked.
    """
    for measure in measures:
        if measure.reference_scene == source.scene and measure.measured_name not in get_catalogue(source):
            try:
                check_series(source, [str(measure.measured_name)])
            except UnknownNameError as error:
                message = f"scene {source.scene}: {error.message}"
                raise UnknownNameError(message, measure.measured_name.where, error.hint) from None


def _list_joints_with_play(source: KernelSource, with_wear: bool = False) -> list[str]:
    """Return the names of the joints with play of a scene, in the order of the columns of `Batch.peaks`.

    With `with_wear` only those whose wear can be measured: no corners of a guide, and with a contact force that the
    clearance columns contain (`has_known_contact_force`).
    """
    return [
        joint.name
        for joint in source.clearances
        if not with_wear or has_known_contact_force(source, joint) and not joint.is_corner
    ]


def _list_events(source: KernelSource) -> list[str]:
    """Return the names of the user-defined events of a scene."""
    return [event.name for event in source.events]


def describe_measure(measure: Measure) -> str:
    """Return a description of a measure, the long_name of its variable: "peak of slider.ax in window last"."""
    message = f"{measure.statistic.replace('_', ' ')} of {measure.measured_name}"
    message = f"{message} ({MOTION_CODES_TEXT})" if measure.statistic == "motion" else message
    message = f"{message} from scene {measure.reference_scene}" if measure.reference_scene is not None else message
    return f"{message} in window {measure.window}" if measure.window else message


def evaluate_measure(batch: Batch, measure: Measure, spans: Spans, reference_series: ReferenceSeries) -> Array:
    """Return the values of a measure for all runs of a batch, (n,); NaN for a run without a value.

    spans: begin and end of each window. reference_series: series of other scenes, at the samples of the batch. All
    values are NaN if the scene lacks the joint, event or series, and for statistics of neighbouring trajectories, which
    `compute_neighbour_measures` computes.
    """
    source, missing_values = batch.source, np.full(len(batch), np.nan)
    if find_measure_unit(measure, source) is None or measure.statistic in NEIGHBOUR_STATISTICS:
        return missing_values
    begin, end = spans.get(measure.window, (None, None))
    begin = np.full(len(batch), -np.inf) if begin is None else begin
    end = np.full(len(batch), np.inf) if end is None else end
    if measure.statistic in STEP_STATISTICS:
        return _read_step_peaks(batch, measure)
    if measure.statistic in JOINT_PEAKS:
        return np.asarray(
            batch.peaks[JOINT_PEAKS[measure.statistic]][:, _list_joints_with_play(source).index(measure.measured_name)]
        )
    if measure.statistic in WEAR_STATISTICS:
        return _compute_bearing_wear(batch, measure)
    if measure.statistic in CONTACT_STATISTICS:
        return _evaluate_contact_measure(batch, measure, begin, end)
    if measure.statistic in CROSSING_STATISTICS:
        return _evaluate_event_measure(batch, measure, begin, end)
    values = batch.kept[str(measure.measured_name)]
    if measure.reference_scene is not None:
        values = values - (
            values
            if measure.reference_scene == source.scene
            else reference_series[measure.reference_scene][measure.measured_name]
        )
    return SAMPLE_STATISTICS[measure.statistic](batch.kept["t"], values, begin, end)


def _read_step_peaks(batch: Batch, measure: Measure) -> Array:
    """Return the peak over all steps of a series, or of its deviation from another scene, for each run, (n,).

    The deviation of a scene from itself is 0, or NaN for a run without samples.
    """
    if measure.reference_scene is not None and measure.reference_scene == batch.source.scene:
        return np.where(np.asarray(batch.samples) > 0, 0.0, np.nan)
    peaks = (
        batch.peak(str(measure.measured_name))
        if measure.reference_scene is None
        else batch.peak_error(str(measure.measured_name))
    )
    return np.asarray(getattr(peaks, STEP_STATISTICS[measure.statistic]))


def _compute_bearing_wear(batch: Batch, measure: Measure) -> Array:
    """Return wear_depth or wear_arc of a bearing for each run, (n,); NaN for a run without sliding loads of the joint.

    The depth (N/m) is the maximum over the bearing's cells of ∫F|v_t|dt per area; the arc (rad) is the shortest one
    with 90 % of the wear.
    """
    values = np.full(len(batch), np.nan)
    for i, loads_of_run in enumerate(batch.sliding_loads):
        for sliding_loads in (loads for loads in loads_of_run if loads.requested.joint == measure.measured_name):
            values[i] = (
                compute_shortest_arc(sliding_loads.load[0])
                if measure.statistic == "wear_arc"
                else sliding_loads.compute_depth(0).max()
            )
    return values


def _evaluate_contact_measure(batch: Batch, measure: Measure, begin: Array, end: Array) -> Array:
    """Return the number, first onset (s) or largest approach speed (m/s) of the contacts of a joint for each run, (n,).

    Contacts count if their onset lies in the run's window, begin to end (s), (n,) each. A run without such a contact
    has 0 as number, else NaN.
    """
    joint, is_count = _list_joints_with_play(batch.source).index(measure.measured_name), measure.statistic == "impacts"
    values = _make_default_values(batch, is_count, begin)
    for i, impacts in ((i, impacts) for i, impacts in enumerate(batch.impacts) if len(impacts)):
        t_on = impacts["t_on"]
        contacts = impacts[(impacts["joint"] == joint) & (t_on >= begin[i]) & (t_on <= end[i])]
        if is_count:
            values[i] += len(contacts)
        elif len(contacts):
            values[i] = (
                contacts["t_on"].min() if measure.statistic == "first_impact" else np.abs(contacts["deltadot"]).max()
            )
    return values


def _evaluate_event_measure(batch: Batch, measure: Measure, begin: Array, end: Array) -> Array:
    """Return the number or the first time (s) of a user-defined event in the window of each run, (n,).

    begin, end: of the windows, s, (n,) each. A run without an occurrence has 0 as number, NaN as time.
    """
    event_index, is_count = _list_events(batch.source).index(measure.measured_name), measure.statistic == "crossings"
    values = _make_default_values(batch, is_count, begin)
    for i, events in ((i, events) for i, events in enumerate(batch.events) if len(events)):
        t = events["t"][events["event"] == event_index]
        t = t[(t >= begin[i]) & (t <= end[i])]
        if is_count:
            values[i] += len(t)
        elif len(t):
            values[i] = t.min()
    return values


def _make_default_values(batch: Batch, is_count: bool, begin: Array) -> Array:
    """Return the values of runs without a contact or event, (n,): 0 for counts, NaN for times and speeds.

    A run that ended before the begin of its window (s) has NaN in any case.
    """
    reached_window = np.asarray(batch.t_last) * (1.0 + ROUNDING) >= begin
    return np.where(reached_window & is_count, 0.0, np.nan)


def find_sampled_interval(measures: Iterable[Measure], spans: Spans, runs: Array) -> tuple[Array, Array] | None:
    """Return begin and end (s) of the smallest interval with all windows in which samples are needed, (n,) each.

    spans: begin and end of each window by its name, for all runs of a job. runs: indices (n,) into these. None if no
    measure needs samples, or one needs the whole run.
    """
    windows = {measure.window for measure in measures if measure.statistic in SAMPLE_STATISTICS}
    if not (windows and all(windows)):
        return None
    ends = [spans[str(window)] for window in windows]
    begin = np.min([np.full(len(runs), -np.inf) if begin is None else begin[runs] for begin, _ in ends], axis=0)
    return begin, np.max([np.full(len(runs), np.inf) if end is None else end[runs] for _, end in ends], axis=0)


def is_in_window(t: Array, begin: Array | float, end: Array | float) -> Array:
    """Return a flag for each sample time: whether it lies in [begin, end], with the relative tolerance ROUNDING."""
    tolerance = ROUNDING * np.abs(t)
    return np.asarray((t >= begin - tolerance) & (t <= end + tolerance))


def _is_in_window(t: Array, samples: Array, begin: Array, end: Array) -> Array:
    """Return a flag for each sample, (n, N): whether it lies in its run's window and its value is not NaN.

    t, samples: (n, N). begin, end (s): (n,).
    """
    with np.errstate(invalid="ignore"):
        return is_in_window(t, begin[:, None], end[:, None]) & ~np.isnan(samples)


def _make_extreme_statistic(
    reduce: Callable[..., Array], fill_value: float, transform: Callable[[Array], Array]
) -> Callable[..., Array]:
    """Return the function statistic(t, samples, begin, end) of an extreme, such as the maximum of |x| in each run's
    window.

    reduce: reduction over an axis, np.max or np.min. transform: applied to the samples first. fill_value: neutral
    value for samples outside the window.
    """

    def statistic(t: Array, samples: Array, begin: Array, end: Array) -> Array:
        """Return the extreme of each run, (n,); NaN for a run without samples in its window.

        t, samples: (n, N). begin, end (s): (n,).
        """
        inside = _is_in_window(t, samples, begin, end)
        values = reduce(np.where(inside, transform(samples), fill_value), axis=1)
        return np.asarray(np.where(inside.any(axis=1), values, np.nan))

    return statistic


_compute_max = _make_extreme_statistic(np.max, -np.inf, lambda x: x)
_compute_min = _make_extreme_statistic(np.min, np.inf, lambda x: x)
_compute_peak = _make_extreme_statistic(np.max, -np.inf, np.abs)


def _compute_range(t: Array, samples: Array, begin: Array, end: Array) -> Array:
    """Return the largest less the smallest sample of each run in its window, (n,); NaN without samples."""
    return np.asarray(_compute_max(t, samples, begin, end) - _compute_min(t, samples, begin, end))


def _compute_mean(t: Array, samples: Array, begin: Array, end: Array) -> Array:
    """Return the mean over time of each run in its window, (n,), by the trapezoidal rule between samples in the window.

    A single sample is the mean itself; NaN without samples.
    """
    inside = _is_in_window(t, samples, begin, end)
    both_inside = inside[:, 1:] & inside[:, :-1]
    dt = np.where(both_inside, np.diff(t, axis=1), 0.0)
    means = np.where(both_inside, (samples[:, 1:] + samples[:, :-1]) / 2, 0.0)
    span = dt.sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(
            np.where(span > 0.0, (dt * means).sum(axis=1) / span, _find_final_sample(t, samples, begin, end))
        )


def _compute_rms(t: Array, samples: Array, begin: Array, end: Array) -> Array:
    """Return the root mean square over time of each run in its window, (n,), as `_compute_mean` of x²."""
    return np.asarray(np.sqrt(_compute_mean(t, samples * samples, begin, end)))


def _find_final_sample(t: Array, samples: Array, begin: Array, end: Array) -> Array:
    """Return the last sample of each run in its window, (n,); NaN without samples."""
    inside = _is_in_window(t, samples, begin, end)
    last = inside.shape[1] - 1 - np.argmax(inside[:, ::-1], axis=1)
    return np.asarray(np.where(inside.any(axis=1), samples[np.arange(len(samples)), last], np.nan))


SAMPLE_STATISTICS: Mapping[str, Callable[[Array, Array, Array, Array], Array]] = {
    "max": _compute_max,
    "min": _compute_min,
    "peak": _compute_peak,
    "range": _compute_range,
    "mean": _compute_mean,
    "rms": _compute_rms,
    "final": _find_final_sample,
    "deviation": _compute_peak,
}

"""Compute one number for each run: statistics of series in a window, peaks over all steps, contacts, events."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, InputError, UnknownNameError
from gudgeon.results.batch import Array
from gudgeon.results.series import catalogue, check_series
from gudgeon.results.wear import SlidingRequest, arc
from gudgeon.simulation.examine import has_known_contact_force
from gudgeon.studies.ensemble.exponents import FOLLOWED, KINDS_TOLD
from gudgeon.studies.ensemble.numbers import ROUNDING

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import Measure
    from gudgeon.results.batch import Batch

Origins: TypeAlias = Mapping[str, Mapping[str, Array]]  # scene -> series of runs, (n, N) each, at their own samples
Spans: TypeAlias = Mapping[str, tuple[Array | None, ...]]  # window -> begin and end (s) of each run, None: its own

STEPS: Mapping[str, str] = {
    "max_of_steps": "max",
    "min_of_steps": "min",
    "peak_of_steps": "abs",
    "deviation_of_steps": "abs",
}
JOINT: Mapping[str, str] = {"peak_force": "F", "eccentricity": "e_max"}
CONTACTS, CROSSINGS = ("impacts", "first_impact", "impact_speed"), ("crossings", "first_crossing")
WEAR = ("wear_depth", "wear_arc")
OF_JOINTS = (*CONTACTS, *JOINT, *WEAR)
UNITS = {
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


def series_of(measures: tuple[Measure, ...], keep: tuple[str, ...], source: KernelSource) -> list[str]:
    """Return the series whose samples the measures and stored series of a scene need."""
    known = catalogue(source)
    others = (*OF_JOINTS, *CROSSINGS, *STEPS, *FOLLOWED)
    expected = [*(str(one.of) for one in measures if one.statistic not in others), *keep]
    return [name for name in dict.fromkeys(expected) if name in known]


def peak_series_of(measures: tuple[Measure, ...], source: KernelSource) -> list[str]:
    """Return the series whose peaks over all steps are measured; not the deviation of a scene from itself."""
    known = catalogue(source)
    expected = (str(one.of) for one in measures if one.statistic in STEPS and one.origin != source.scene)
    return [name for name in dict.fromkeys(expected) if name in known]


def sliding_requests_of(measures: tuple[Measure, ...], source: KernelSource) -> tuple[SlidingRequest, ...]:
    """Return the requests for sliding loads of joints whose wear is measured."""
    own = _joint_names(source, rubs=True)
    expected = (str(one.of) for one in measures if one.statistic in WEAR)
    return tuple(SlidingRequest(name) for name in dict.fromkeys(expected) if name in own)


def unit_of(measure: Measure, source: KernelSource) -> str | None:
    """Return the unit of a measure; None in a scene that does not have its object."""
    if measure.statistic in OF_JOINTS:
        return UNITS[measure.statistic] if measure.of in _joint_names(source, measure.statistic in WEAR) else None
    if measure.statistic in CROSSINGS:
        return UNITS[measure.statistic] if measure.of in _event_names(source) else None
    if measure.statistic in FOLLOWED:
        return FOLLOWED[measure.statistic] if source.degrees_of_freedom > 0 else None
    return catalogue(source)[measure.of].unit if measure.of in catalogue(source) else None


def unknown_of(measure: Measure, source: KernelSource) -> InputError:
    """Return the error for a measure of an object that no scene has."""
    from gudgeon.language.names import unknown_name

    if measure.statistic in OF_JOINTS:
        return unknown_name(
            "joint with play", measure.of, _joint_names(source, measure.statistic in WEAR), measure.of.where
        )
    if measure.statistic in CROSSINGS:
        return unknown_name("event", measure.of, _event_names(source), measure.of.where)
    if measure.statistic in FOLLOWED:
        message = f"scene {source.scene} has no degree of freedom: no difference can grow"
        return BadValueError(message, measure.of.where, "expected a scene whose drives do not decide all of the motion")
    try:
        check_series(source, [str(measure.of)])
    except UnknownNameError as error:
        return UnknownNameError(error.message, measure.of.where, error.hint)
    raise AssertionError(measure)


def check_origin(measures: Iterable[Measure], source: KernelSource) -> None:
    """Raise UnknownNameError at the measure for a series that the scene to subtract lacks."""
    for one in measures:
        if one.origin == source.scene and one.of not in catalogue(source):
            try:
                check_series(source, [str(one.of)])
            except UnknownNameError as error:
                message = f"scene {source.scene}: {error.message}"
                raise UnknownNameError(message, one.of.where, error.hint) from None


def _joint_names(source: KernelSource, rubs: bool = False) -> list[str]:
    """Return the names of the joints with play; with `rubs` those whose wear can be measured."""
    return [
        joint.name
        for joint in source.clearances
        if not rubs or has_known_contact_force(source, joint) and not joint.at_wall
    ]


def _event_names(source: KernelSource) -> list[str]:
    """Return the names of the events of a scene."""
    return [event.name for event in source.events]


def meaning(measure: Measure) -> str:
    """Return a measure in words: "peak of slider.ax in window last"."""
    message = f"{measure.statistic.replace('_', ' ')} of {measure.of}"
    message = f"{message} ({KINDS_TOLD})" if measure.statistic == "motion" else message
    message = f"{message} from scene {measure.origin}" if measure.origin is not None else message
    return f"{message} in window {measure.window}" if measure.window else message


def measure_runs(batch: Batch, measure: Measure, spans: Spans, origins: Origins) -> Array:
    """Return the values of a measure for all runs of a batch, (n,); NaN for a run without one.

    `origins`: series of other scenes to subtract.
    """
    source, none = batch.source, np.full(len(batch), np.nan)
    if unit_of(measure, source) is None or measure.statistic in FOLLOWED:  # which exponents.py has
        return none
    begin, end = spans.get(measure.window, (None, None))
    begin = np.full(len(batch), -np.inf) if begin is None else begin
    end = np.full(len(batch), np.inf) if end is None else end
    if measure.statistic in STEPS:
        return _peaks_over_steps(batch, measure)
    if measure.statistic in JOINT:
        return np.asarray(batch.peaks[JOINT[measure.statistic]][:, _joint_names(source).index(measure.of)])
    if measure.statistic in WEAR:
        return _bearing_wear(batch, measure)
    if measure.statistic in CONTACTS:
        return _contact_values(batch, measure, begin, end)
    if measure.statistic in CROSSINGS:
        return _event_values(batch, measure, begin, end)
    values = batch.kept[str(measure.of)]
    if measure.origin is not None:
        values = values - (values if measure.origin == source.scene else origins[measure.origin][measure.of])
    return STATISTICS[measure.statistic](batch.kept["t"], values, begin, end)


def _peaks_over_steps(batch: Batch, measure: Measure) -> Array:
    """Return a peak over all steps, (n,)."""
    if measure.origin is not None and measure.origin == batch.source.scene:
        return np.where(np.asarray(batch.samples) > 0, 0.0, np.nan)
    found = batch.peak(str(measure.of)) if measure.origin is None else batch.peak_error(str(measure.of))
    return np.asarray(getattr(found, STEPS[measure.statistic]))


def _bearing_wear(batch: Batch, measure: Measure) -> Array:
    """Return the wear of the bearing for a unit wear coefficient, (n,): depth of the deepest cell, or worn arc."""
    out = np.full(len(batch), np.nan)
    for i, found in enumerate(batch.rubbed):
        for rubbed in (one for one in found if one.requested.joint == measure.of):
            out[i] = arc(rubbed.load[0]) if measure.statistic == "wear_arc" else rubbed.depth(0).max()
    return out


def _contact_values(batch: Batch, measure: Measure, begin: Array, end: Array) -> Array:
    """Return number, first time or largest approach speed of the contacts of a joint in the window, (n,)."""
    joint, counted = _joint_names(batch.source).index(measure.of), measure.statistic == "impacts"
    out = _values_without_occurrence(batch, counted, begin)
    for i, impacts in ((i, impacts) for i, impacts in enumerate(batch.impacts) if len(impacts)):
        t_on = impacts["t_on"]
        own = impacts[(impacts["joint"] == joint) & (t_on >= begin[i]) & (t_on <= end[i])]
        if counted:
            out[i] += len(own)
        elif len(own):
            out[i] = own["t_on"].min() if measure.statistic == "first_impact" else np.abs(own["deltadot"]).max()
    return out


def _event_values(batch: Batch, measure: Measure, begin: Array, end: Array) -> Array:
    """Return number or first time of an event in the window, (n,)."""
    number, counted = _event_names(batch.source).index(measure.of), measure.statistic == "crossings"
    out = _values_without_occurrence(batch, counted, begin)
    for i, events in ((i, events) for i, events in enumerate(batch.events) if len(events)):
        t = events["t"][events["event"] == number]
        t = t[(t >= begin[i]) & (t <= end[i])]
        if counted:
            out[i] += len(t)
        elif len(t):
            out[i] = t.min()
    return out


def _values_without_occurrence(batch: Batch, counted: bool, begin: Array) -> Array:
    """Return values for runs without an occurrence, (n,): 0 for counts, NaN for times and for runs that ended before
    the window.
    """
    seen = np.asarray(batch.t_last) * (1.0 + ROUNDING) >= begin
    return np.where(seen & counted, 0.0, np.nan)


def sampled_interval(measures: Iterable[Measure], spans: Spans, runs: Array) -> tuple[Array, Array] | None:
    """Return the interval in which samples of these runs are needed, (n,) each; None if a measure needs a whole run."""
    windows = {one.window for one in measures if one.statistic in STATISTICS}
    if not (windows and all(windows)):
        return None
    ends = [spans[str(window)] for window in windows]
    begin = np.min([np.full(len(runs), -np.inf) if begin is None else begin[runs] for begin, _ in ends], axis=0)
    return begin, np.max([np.full(len(runs), np.inf) if end is None else end[runs] for _, end in ends], axis=0)


def is_within(t: Array, begin: Array | float, end: Array | float) -> Array:
    """Return which samples lie in a window, with a tolerance for rounding."""
    slack = ROUNDING * np.abs(t)
    return np.asarray((t >= begin - slack) & (t <= end + slack))


def _in_window(t: Array, x: Array, begin: Array, end: Array) -> Array:
    """Return which samples, (n, N), lie in each run's window and are not NaN."""
    with np.errstate(invalid="ignore"):
        return is_within(t, begin[:, None], end[:, None]) & ~np.isnan(x)


def _make_extreme(
    reduce: Callable[..., Array], outside: float, change: Callable[[Array], Array]
) -> Callable[..., Array]:
    """Return a statistic that reduces the samples in the window; `outside` replaces other samples."""

    def statistic(t: Array, x: Array, begin: Array, end: Array) -> Array:
        """Return the reduced value of each run, (n,)."""
        inside = _in_window(t, x, begin, end)
        found = reduce(np.where(inside, change(x), outside), axis=1)
        return np.asarray(np.where(inside.any(axis=1), found, np.nan))

    return statistic


_largest = _make_extreme(np.max, -np.inf, lambda x: x)
_smallest = _make_extreme(np.min, np.inf, lambda x: x)
_peak = _make_extreme(np.max, -np.inf, np.abs)


def _range(t: Array, x: Array, begin: Array, end: Array) -> Array:
    """Return the largest less the smallest sample in the window, (n,)."""
    return np.asarray(_largest(t, x, begin, end) - _smallest(t, x, begin, end))


def _mean(t: Array, x: Array, begin: Array, end: Array) -> Array:
    """Return the mean over time in the window, (n,), by the trapezoidal rule; of one sample its value."""
    inside = _in_window(t, x, begin, end)
    both = inside[:, 1:] & inside[:, :-1]
    dt = np.where(both, np.diff(t, axis=1), 0.0)
    middle = np.where(both, (x[:, 1:] + x[:, :-1]) / 2, 0.0)
    span = dt.sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.where(span > 0.0, (dt * middle).sum(axis=1) / span, _final(t, x, begin, end)))


def _rms(t: Array, x: Array, begin: Array, end: Array) -> Array:
    """Return the root mean square over time in the window, (n,)."""
    return np.asarray(np.sqrt(_mean(t, x * x, begin, end)))


def _final(t: Array, x: Array, begin: Array, end: Array) -> Array:
    """Return the last sample in the window, (n,)."""
    inside = _in_window(t, x, begin, end)
    last = inside.shape[1] - 1 - np.argmax(inside[:, ::-1], axis=1)
    return np.asarray(np.where(inside.any(axis=1), x[np.arange(len(x)), last], np.nan))


STATISTICS: Mapping[str, Callable[[Array, Array, Array, Array], Array]] = {
    "max": _largest,
    "min": _smallest,
    "peak": _peak,
    "range": _range,
    "mean": _mean,
    "rms": _rms,
    "final": _final,
    "deviation": _peak,
}

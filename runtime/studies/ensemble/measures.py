"""One number a run: statistics of series in a window, peaks over all steps, contacts, events."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import BadValueError, InputError, UnknownNameError
from gudgeon.results.batch import Array
from gudgeon.results.series import catalogue, check_series
from gudgeon.results.wear import Rubbing, arc
from gudgeon.simulation.examine import known_to_rub
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
    """Series whose samples a scene's runs must give."""
    known = catalogue(source)
    others = (*OF_JOINTS, *CROSSINGS, *STEPS, *FOLLOWED)
    wanted = [*(str(one.of) for one in measures if one.statistic not in others), *keep]
    return [name for name in dict.fromkeys(wanted) if name in known]


def steps_of(measures: tuple[Measure, ...], source: KernelSource) -> list[str]:
    """Series whose peaks over all steps are wanted; a scene's deviation from itself is nowhere sought."""
    known = catalogue(source)
    wanted = (str(one.of) for one in measures if one.statistic in STEPS and one.origin != source.scene)
    return [name for name in dict.fromkeys(wanted) if name in known]


def rubs_of(measures: tuple[Measure, ...], source: KernelSource) -> tuple[Rubbing, ...]:
    """Joints whose rubbing over all steps is wanted."""
    own = _joints(source, rubs=True)
    wanted = (str(one.of) for one in measures if one.statistic in WEAR)
    return tuple(Rubbing(name) for name in dict.fromkeys(wanted) if name in own)


def unit_of(measure: Measure, source: KernelSource) -> str | None:
    """The unit of a measure, None in a scene that has no such thing."""
    if measure.statistic in OF_JOINTS:
        return UNITS[measure.statistic] if measure.of in _joints(source, measure.statistic in WEAR) else None
    if measure.statistic in CROSSINGS:
        return UNITS[measure.statistic] if measure.of in _events(source) else None
    if measure.statistic in FOLLOWED:
        return FOLLOWED[measure.statistic] if source.degrees_of_freedom > 0 else None
    return catalogue(source)[measure.of].unit if measure.of in catalogue(source) else None


def unknown_of(measure: Measure, source: KernelSource) -> InputError:
    """What is said of a measure of something that no scene has."""
    from gudgeon.language.names import unknown_name

    if measure.statistic in OF_JOINTS:
        return unknown_name("joint with play", measure.of, _joints(source, measure.statistic in WEAR), measure.of.where)
    if measure.statistic in CROSSINGS:
        return unknown_name("event", measure.of, _events(source), measure.of.where)
    if measure.statistic in FOLLOWED:
        told = f"scene {source.scene} has no degree of freedom: no difference can grow"
        return BadValueError(told, measure.of.where, "expected a scene whose drives do not decide all of the motion")
    try:
        check_series(source, [str(measure.of)])
    except UnknownNameError as error:
        return UnknownNameError(error.message, measure.of.where, error.hint)
    raise AssertionError(measure)


def check_origin(measures: Iterable[Measure], source: KernelSource) -> None:
    """UnknownNameError at its place for a series that the scene that is to be subtracted has not."""
    for one in measures:
        if one.origin == source.scene and one.of not in catalogue(source):
            try:
                check_series(source, [str(one.of)])
            except UnknownNameError as error:
                told = f"scene {source.scene}: {error.message}"
                raise UnknownNameError(told, one.of.where, error.hint) from None


def _joints(source: KernelSource, rubs: bool = False) -> list[str]:
    return [joint.name for joint in source.clearances if not rubs or known_to_rub(source, joint) and not joint.at_wall]


def _events(source: KernelSource) -> list[str]:
    return [event.name for event in source.events]


def meaning(measure: Measure) -> str:
    """In a line: "peak of slider.ax in window last"."""
    told = f"{measure.statistic.replace('_', ' ')} of {measure.of}"
    told = f"{told} ({KINDS_TOLD})" if measure.statistic == "motion" else told
    told = f"{told} from scene {measure.origin}" if measure.origin is not None else told
    return f"{told} in window {measure.window}" if measure.window else told


def measured(batch: Batch, measure: Measure, spans: Spans, origins: Origins) -> Array:
    """The values of all runs, (n,); NaN where a run has none. `origins`: what series are less than."""
    source, none = batch.source, np.full(len(batch), np.nan)
    if unit_of(measure, source) is None or measure.statistic in FOLLOWED:  # which exponents.py has
        return none
    begin, end = spans.get(measure.window, (None, None))
    begin = np.full(len(batch), -np.inf) if begin is None else begin
    end = np.full(len(batch), np.inf) if end is None else end
    if measure.statistic in STEPS:
        return _of_steps(batch, measure)
    if measure.statistic in JOINT:
        return np.asarray(batch.peaks[JOINT[measure.statistic]][:, _joints(source).index(measure.of)])
    if measure.statistic in WEAR:
        return _worn(batch, measure)
    if measure.statistic in CONTACTS:
        return _contacts(batch, measure, begin, end)
    if measure.statistic in CROSSINGS:
        return _crossings(batch, measure, begin, end)
    values = batch.kept[str(measure.of)]
    if measure.origin is not None:
        values = values - (values if measure.origin == source.scene else origins[measure.origin][measure.of])
    return STATISTICS[measure.statistic](batch.kept["t"], values, begin, end)


def _of_steps(batch: Batch, measure: Measure) -> Array:
    if measure.origin is not None and measure.origin == batch.source.scene:
        return np.where(np.asarray(batch.samples) > 0, 0.0, np.nan)
    found = batch.peak(str(measure.of)) if measure.origin is None else batch.peak_error(str(measure.of))
    return np.asarray(getattr(found, STEPS[measure.statistic]))


def _worn(batch: Batch, measure: Measure) -> Array:
    """Of the bearing's surface: the deepest cell's load times slip over its area, and the arc that is worn."""
    out = np.full(len(batch), np.nan)
    for i, found in enumerate(batch.rubbed):
        for rubbed in (one for one in found if one.asked.joint == measure.of):
            out[i] = arc(rubbed.load[0]) if measure.statistic == "wear_arc" else rubbed.depth(0).max()
    return out


def _contacts(batch: Batch, measure: Measure, begin: Array, end: Array) -> Array:
    joint, counted = _joints(batch.source).index(measure.of), measure.statistic == "impacts"
    out = _none(batch, counted, begin)
    for i, impacts in ((i, impacts) for i, impacts in enumerate(batch.impacts) if len(impacts)):
        t_on = impacts["t_on"]
        own = impacts[(impacts["joint"] == joint) & (t_on >= begin[i]) & (t_on <= end[i])]
        if counted:
            out[i] += len(own)
        elif len(own):
            out[i] = own["t_on"].min() if measure.statistic == "first_impact" else np.abs(own["deltadot"]).max()
    return out


def _crossings(batch: Batch, measure: Measure, begin: Array, end: Array) -> Array:
    number, counted = _events(batch.source).index(measure.of), measure.statistic == "crossings"
    out = _none(batch, counted, begin)
    for i, events in ((i, events) for i, events in enumerate(batch.events) if len(events)):
        t = events["t"][events["event"] == number]
        t = t[(t >= begin[i]) & (t <= end[i])]
        if counted:
            out[i] += len(t)
        elif len(t):
            out[i] = t.min()
    return out


def _none(batch: Batch, counted: bool, begin: Array) -> Array:
    """Of runs in which nothing happened, (n,): 0 where that is counted, but for those that ended before the window."""
    seen = np.asarray(batch.t_last) * (1.0 + ROUNDING) >= begin
    return np.where(seen & counted, 0.0, np.nan)


def sampled(measures: Iterable[Measure], spans: Spans, runs: Array) -> tuple[Array, Array] | None:
    """From when to when samples of these runs are read, (n,) each; None where one is read from begin to end."""
    windows = {one.window for one in measures if one.statistic in STATISTICS}
    if not (windows and all(windows)):
        return None
    ends = [spans[str(window)] for window in windows]
    begin = np.min([np.full(len(runs), -np.inf) if begin is None else begin[runs] for begin, _ in ends], axis=0)
    return begin, np.max([np.full(len(runs), np.inf) if end is None else end[runs] for _, end in ends], axis=0)


def within(t: Array, begin: Array | float, end: Array | float) -> Array:
    """Which samples lie in a window."""
    slack = ROUNDING * np.abs(t)
    return np.asarray((t >= begin - slack) & (t <= end + slack))


def _inside(t: Array, x: Array, begin: Array, end: Array) -> Array:
    """Which samples, (n, N), lie in each run's window."""
    with np.errstate(invalid="ignore"):
        return within(t, begin[:, None], end[:, None]) & ~np.isnan(x)


def _extreme(reduce: Callable[..., Array], outside: float, change: Callable[[Array], Array]) -> Callable[..., Array]:
    def statistic(t: Array, x: Array, begin: Array, end: Array) -> Array:
        inside = _inside(t, x, begin, end)
        found = reduce(np.where(inside, change(x), outside), axis=1)
        return np.asarray(np.where(inside.any(axis=1), found, np.nan))

    return statistic


_largest = _extreme(np.max, -np.inf, lambda x: x)
_smallest = _extreme(np.min, np.inf, lambda x: x)
_peak = _extreme(np.max, -np.inf, np.abs)


def _range(t: Array, x: Array, begin: Array, end: Array) -> Array:
    return np.asarray(_largest(t, x, begin, end) - _smallest(t, x, begin, end))


def _mean(t: Array, x: Array, begin: Array, end: Array) -> Array:
    """Over time, by trapezoids between the samples in the window; of one sample that itself."""
    inside = _inside(t, x, begin, end)
    both = inside[:, 1:] & inside[:, :-1]
    dt = np.where(both, np.diff(t, axis=1), 0.0)
    middle = np.where(both, (x[:, 1:] + x[:, :-1]) / 2, 0.0)
    span = dt.sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.where(span > 0.0, (dt * middle).sum(axis=1) / span, _final(t, x, begin, end)))


def _rms(t: Array, x: Array, begin: Array, end: Array) -> Array:
    return np.asarray(np.sqrt(_mean(t, x * x, begin, end)))


def _final(t: Array, x: Array, begin: Array, end: Array) -> Array:
    """The last sample in the window."""
    inside = _inside(t, x, begin, end)
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

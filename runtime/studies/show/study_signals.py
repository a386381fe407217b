"""Process time series of a study's runs: resampling, spectra, low-pass filters, points on a Poincaré section.

Failed runs have no series.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.language.text_output import format_one_line
from gudgeon.results.series import apply_low_pass, compute_spectrum

TIME_TOL = 0.01  # of the time between two samples: so far apart, samples are of the same time
FRACTION_TOL = 1e-9  # tolerance of fractions of a run that count as equal


def have_equal_times(times: Any) -> bool:
    """Return whether all rows of times (runs, N) are equal to the first within TIME_TOL of its shortest interval."""
    first = times[0]
    step = np.nanmin(np.diff(first)) if np.isfinite(first).sum() > 1 else 0.0
    return bool(np.isclose(times, first, rtol=1e-12, atol=TIME_TOL * abs(float(step)), equal_nan=True).all())


def resample_over_fractions(t: Any, series: Any) -> tuple[Any, Any] | None:
    """Return fractions of the run's duration (M,), those of the longest run, and the series of all runs there (…, M).

    t: sample times. series: a DataArray. A run with other samples is interpolated linearly; it is NaN beyond its
    samples. None if no run has a duration.
    """
    times = np.broadcast_to(t, series.shape).reshape(-1, series.shape[-1])
    fractions_of_runs = [_scale_times(row[np.isfinite(row)]) for row in times]
    fractions = max(fractions_of_runs, key=len, default=np.zeros(0))
    if not len(fractions):
        return None
    values = np.full((len(fractions_of_runs), len(fractions)), np.nan)
    for out, x, row, run_fractions in zip(
        values, series.values.reshape(times.shape), times, fractions_of_runs, strict=True
    ):
        y = x[np.isfinite(row)]
        if len(run_fractions) == len(fractions) and np.allclose(run_fractions, fractions, rtol=0.0, atol=FRACTION_TOL):
            out[:] = y
        elif len(run_fractions) and (good := np.isfinite(y)).any():
            out[:] = np.interp(fractions, run_fractions[good], y[good], left=np.nan, right=np.nan)
    return fractions, series.isel({series.dims[-1]: slice(len(fractions))}).copy(
        data=values.reshape(*series.shape[:-1], len(fractions))
    )


def _scale_times(t: Any) -> Any:
    """Return the times of a run scaled to 0 … 1; empty for a run without a duration."""
    return (t - t[0]) / (t[-1] - t[0]) if len(t) > 1 and t[-1] > t[0] else np.zeros(0)


def compute_spectra(t: Any, series: Any, dimension: str | None, name: str, window: str) -> list[tuple[Any, Any]]:
    """Return frequencies (M,) in Hz and amplitudes (runs, M) for each value of a dimension; None means all runs.

    name: of the series, for messages. window: as in `compute_spectrum`. Raises BadValueError if runs of one value have
    different sample times.
    """
    times = np.broadcast_to(t, series.shape)
    values = [(times, series.values)]
    if dimension is not None:
        k = series.dims.index(dimension)
        values = [(np.take(times, i, axis=k), np.take(series.values, i, axis=k)) for i in range(series.shape[k])]
    return [_compute_spectrum_of_runs(*signals, name, window) for signals in values]


def _compute_spectrum_of_runs(times: Any, values: Any, name: str, window: str) -> tuple[Any, Any]:
    """Return frequencies (M,) in Hz and amplitudes (runs, M) of runs with equal sample times.

    Samples that are not finite are dropped, and runs without finite samples are left out. If no run is left, the
    result is one frequency 0 with the amplitude NaN. Raises BadValueError for different sample times.
    """
    rows = [
        (t[good], x[good]) for t, x in _iterate_runs(times, values) if (good := np.isfinite(t) & np.isfinite(x)).any()
    ]
    if not rows:
        return np.zeros(1), np.full((1, 1), np.nan)
    first = rows[0][0]
    if any(len(t) != len(first) for t, _ in rows) or not have_equal_times(np.array([t for t, _ in rows])):
        message = (
            f"{format_one_line(name)}: the runs have samples at different times, of which there is no common spectrum"
        )
        raise BadValueError(message, hint="pick runs with the same times (at=…), or name by= what their times follow")
    each = [compute_spectrum(first, x, window) for _, x in rows]
    return each[0][0], np.array([amplitudes for _, amplitudes in each])


def filter_low_pass(t: Any, series: Any, cutoff: float, order: int, causal: bool) -> Any:
    """Return the series after a Butterworth low-pass of each run; NaN where it has no finite samples.

    cutoff: Hz. causal: False filters forwards and backwards, without a phase shift.
    """
    filtered = np.full(series.shape, np.nan)
    for samples, out in zip(
        _iterate_runs(np.broadcast_to(t, series.shape), series.values), _iterate_runs(filtered), strict=True
    ):
        is_finite = np.isfinite(samples[0]) & np.isfinite(samples[1])
        if is_finite.any():
            out[0][is_finite] = apply_low_pass(samples[0][is_finite], samples[1][is_finite], cutoff, order, causal)
    return series.copy(data=filtered)


def _iterate_runs(*arrays: Any) -> Any:
    """Return an iterator over the runs, with the row (N,) of each array."""
    return zip(*(array.reshape(-1, array.shape[-1]) for array in arrays), strict=True)


def find_values_at_crossings(
    t: Any, section_values: Any, other_series: list[Any], level: float, is_falling: bool, min_time: float
) -> list[Any]:
    """Return the values of other series, (k,) each, where one series rises (or falls) through a level.

    t, section_values and other_series: (N,) samples of one run. is_falling: crossings from above instead of from
    below. min_time (s): earlier crossings are left out. Between samples all series are monotone cubics (PCHIP).
    Empty for fewer than two finite samples.
    """
    from scipy.interpolate import PchipInterpolator

    is_finite = (
        np.isfinite(t) & np.isfinite(section_values) & np.all([np.isfinite(values) for values in other_series], axis=0)
    )
    if is_finite.sum() < 2:
        return [np.zeros(0) for _ in other_series]
    t, signed_distance = t[is_finite], (section_values[is_finite] - level) * (-1.0 if is_falling else 1.0)
    path = PchipInterpolator(t, signed_distance)
    starts = np.flatnonzero((signed_distance[:-1] < 0.0) & (signed_distance[1:] >= 0.0))
    roots = path.roots(discontinuity=False, extrapolate=False)
    times = np.array([_find_root_between(roots, t[k], t[k + 1]) for k in starts])
    times = times[times >= min_time] if len(times) else times
    return [PchipInterpolator(t, values[is_finite])(times) for values in other_series]


def _find_root_between(roots: Any, begin: float, end: float) -> float:
    """Return the first of the sorted roots in [begin, end], or `end` if rounding lost it."""
    inner_roots = roots[(roots >= begin) & (roots <= end)]
    return float(inner_roots[0]) if len(inner_roots) else float(end)

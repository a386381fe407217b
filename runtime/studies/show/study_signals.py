"""Process time series of a study's runs: resampling, amplitude spectra, low-pass filters, Poincaré sections.

Failed runs have NaN in place of series.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.language.text_output import format_one_line
from gudgeon.results.signals import apply_low_pass, compute_spectrum

TIME_TOL = 0.01  # tolerance of equal sample times, as a fraction of the shortest sample interval
FRACTION_TOL = 1e-9  # tolerance of equal fractions of a run's duration


def have_equal_times(times: Any) -> bool:
    """Return whether all rows of sample times (runs, N) equal the first row within TIME_TOL of its shortest interval.

    NaN equals NaN.
    """
    first = times[0]
    step = np.nanmin(np.diff(first)) if np.isfinite(first).sum() > 1 else 0.0
    return bool(np.isclose(times, first, rtol=1e-12, atol=TIME_TOL * abs(float(step)), equal_nan=True).all())


def resample_over_fractions(t: Any, series: Any) -> tuple[Any, Any] | None:
    """Resample the series of all runs to common fractions of each run's duration; return fractions (M,) and series
    (…, M).

    The fractions, 0 to 1, are those of the run with the most samples. t: sample times, (N,) or (…, N). series: a
    DataArray (…, N). Other runs are interpolated linearly, with NaN outside their finite samples. None if no run has a
    duration.
    """
    times = np.broadcast_to(t, series.shape).reshape(-1, series.shape[-1])
    fractions_of_runs = [_scale_times(row[np.isfinite(row)]) for row in times]
    fractions = max(fractions_of_runs, key=len, default=np.zeros(0))
    if not len(fractions):
        return None
    values = np.full((len(fractions_of_runs), len(fractions)), np.nan)
    for resampled_row, x, row, run_fractions in zip(
        values, series.values.reshape(times.shape), times, fractions_of_runs, strict=True
    ):
        y = x[np.isfinite(row)]
        if len(run_fractions) == len(fractions) and np.allclose(run_fractions, fractions, rtol=0.0, atol=FRACTION_TOL):
            resampled_row[:] = y
        elif len(run_fractions) and (is_finite := np.isfinite(y)).any():
            resampled_row[:] = np.interp(fractions, run_fractions[is_finite], y[is_finite], left=np.nan, right=np.nan)
    return fractions, series.isel({series.dims[-1]: slice(len(fractions))}).copy(
        data=values.reshape(*series.shape[:-1], len(fractions))
    )


def _scale_times(t: Any) -> Any:
    """Return the sample times of a run, scaled linearly to 0 … 1; empty for fewer than two times or no duration."""
    return (t - t[0]) / (t[-1] - t[0]) if len(t) > 1 and t[-1] > t[0] else np.zeros(0)


def compute_spectra(t: Any, series: Any, dimension: str | None, name: str, window: str) -> list[tuple[Any, Any]]:
    """Return the amplitude spectra of all runs: a pair of frequencies (M,) in Hz and amplitudes (runs, M).

    There is a pair for each value of `dimension`; for None a single pair of all runs. name: of the series, for
    messages. window: as in `compute_spectrum`. Raises BadValueError if runs of one pair have different sample times.
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
        (t[is_finite], x[is_finite])
        for t, x in _iterate_runs(times, values)
        if (is_finite := np.isfinite(t) & np.isfinite(x)).any()
    ]
    if not rows:
        return np.zeros(1), np.full((1, 1), np.nan)
    first = rows[0][0]
    if any(len(t) != len(first) for t, _ in rows) or not have_equal_times(np.array([t for t, _ in rows])):
        message = f"{format_one_line(name)}: the runs have different sample times, so they have no common frequencies"
        hint = "select runs with the same times (at=…), or name the dimension on which their times depend (by=…)"
        raise BadValueError(message, hint=hint)
    spectra = [compute_spectrum(first, x, window) for _, x in rows]
    return spectra[0][0], np.array([amplitudes for _, amplitudes in spectra])


def filter_low_pass(t: Any, series: Any, cutoff: float, order: int, causal: bool) -> Any:
    """Return the series of each run after a Butterworth low-pass filter; NaN where a sample or its time is not finite.

    series: a DataArray (…, N), t: (N,) or (…, N). cutoff: Hz. causal: False filters forwards and backwards, with zero
    phase.
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
    """Return an iterator over runs that yields the row (N,) of each array (…, N) as a tuple, views of the arrays."""
    return zip(*(array.reshape(-1, array.shape[-1]) for array in arrays), strict=True)


def find_values_at_crossings(
    t: Any, section_values: Any, other_series: list[Any], level: float, is_falling: bool, min_time: float
) -> list[Any]:
    """Return the points of a Poincaré section: values of other series, (k,) each, where one rises through a level.

    t, section_values and other_series: samples (N,) of one run. is_falling: crossings from above instead of from below.
    min_time (s): earlier crossings are left out. Between samples all series are monotone cubics (PCHIP). Arrays are
    empty for fewer than two finite samples.
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
    """Return the first of the sorted roots in [begin, end], or `end` if there is none because of rounding."""
    inner_roots = roots[(roots >= begin) & (roots <= end)]
    return float(inner_roots[0]) if len(inner_roots) else float(end)

"""Process the stored series of a study run by run: resampling over fractions of the run, spectra, low-passes, sections.

Failed runs have no series.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.language.shown import one_line
from gudgeon.results.series import low_pass, spectrum

NEAR = 0.01  # of the time between two samples: so far apart, samples are of the same time
SAME = 1e-9  # tolerance of fractions of a run that count as equal


def alike(rows: Any) -> bool:
    """Return whether all runs of times (runs, N) have the same samples, within NEAR of an interval."""
    first = rows[0]
    step = np.nanmin(np.diff(first)) if np.isfinite(first).sum() > 1 else 0.0
    return bool(np.isclose(rows, first, rtol=1e-12, atol=NEAR * abs(float(step)), equal_nan=True).all())


def over_shares(t: Any, found: Any) -> tuple[Any, Any] | None:
    """Return fractions (M,) of the run, those of the longest run, and the series of all runs there (…, M).

    None without any run. A run with other samples is interpolated linearly; it is NaN beyond its samples.
    """
    times = np.broadcast_to(t, found.shape).reshape(-1, found.shape[-1])
    own = [_scaled_times(row[np.isfinite(row)]) for row in times]
    at = max(own, key=len, default=np.zeros(0))
    if not len(at):
        return None
    left = np.full((len(own), len(at)), np.nan)
    for out, x, row, message in zip(left, found.values.reshape(times.shape), times, own, strict=True):
        y = x[np.isfinite(row)]
        if len(message) == len(at) and np.allclose(message, at, rtol=0.0, atol=SAME):
            out[:] = y
        elif len(message) and (good := np.isfinite(y)).any():
            out[:] = np.interp(at, message[good], y[good], left=np.nan, right=np.nan)
    return at, found.isel({found.dims[-1]: slice(len(at))}).copy(data=left.reshape(*found.shape[:-1], len(at)))


def _scaled_times(t: Any) -> Any:
    """Return the times of a run scaled to 0 … 1; empty for a run without a duration."""
    return (t - t[0]) / (t[-1] - t[0]) if len(t) > 1 and t[-1] > t[0] else np.zeros(0)


def spectra(t: Any, found: Any, by: str | None, name: str, window: str) -> list[tuple[Any, Any]]:
    """Return frequencies (M,) and amplitudes (runs, M) for each value of `by`, or for all runs.

    Raises BadValueError for runs with different sample times.
    """
    times = np.broadcast_to(t, found.shape)
    values = [(times, found.values)]
    if by is not None:
        k = found.dims.index(by)
        values = [(np.take(times, i, axis=k), np.take(found.values, i, axis=k)) for i in range(found.shape[k])]
    return [_spectrum_of_runs(*own, name, window) for own in values]


def _spectrum_of_runs(times: Any, values: Any, name: str, window: str) -> tuple[Any, Any]:
    """Return frequencies (M,) and amplitudes (runs, M) of some runs."""
    rows = [(t[good], x[good]) for t, x in _rows(times, values) if (good := np.isfinite(t) & np.isfinite(x)).any()]
    if not rows:
        return np.zeros(1), np.full((1, 1), np.nan)
    first = rows[0][0]
    if any(len(t) != len(first) for t, _ in rows) or not alike(np.array([t for t, _ in rows])):
        message = f"{one_line(name)}: the runs have samples at different times, of which there is no common spectrum"
        raise BadValueError(message, hint="pick runs with the same times (at=…), or name by= what their times follow")
    each = [spectrum(first, x, window) for _, x in rows]
    return each[0][0], np.array([amplitudes for _, amplitudes in each])


def low_pass_runs(t: Any, found: Any, cutoff: float, order: int, causal: bool) -> Any:
    """Return the series after a low-pass; NaN where they have no samples."""
    left = np.full(found.shape, np.nan)
    for own, out in zip(_rows(np.broadcast_to(t, found.shape), found.values), _rows(left), strict=True):
        good = np.isfinite(own[0]) & np.isfinite(own[1])
        if good.any():
            out[0][good] = low_pass(own[0][good], own[1][good], cutoff, order, causal)
    return found.copy(data=left)


def _rows(*arrays: Any) -> Any:
    """Return an iterator over the runs, with (N,) of each array."""
    return zip(*(one.reshape(-1, one.shape[-1]) for one in arrays), strict=True)


def crossings(t: Any, through: Any, others: list[Any], level: float, falling: bool, after: float) -> list[Any]:
    """Return the values of other series, (k,) each, where one rises (or falls) through a level after a time.

    Between samples all series are monotone cubics (PCHIP).
    """
    from scipy.interpolate import PchipInterpolator

    good = np.isfinite(t) & np.isfinite(through) & np.all([np.isfinite(own) for own in others], axis=0)
    if good.sum() < 2:
        return [np.zeros(0) for _ in others]
    t, below = t[good], (through[good] - level) * (-1.0 if falling else 1.0)
    path = PchipInterpolator(t, below)
    starts = np.flatnonzero((below[:-1] < 0.0) & (below[1:] >= 0.0))
    roots = path.roots(discontinuity=False, extrapolate=False)
    at = np.array([_root_between(roots, t[k], t[k + 1]) for k in starts])
    at = at[at >= after] if len(at) else at
    return [PchipInterpolator(t, own[good])(at) for own in others]


def _root_between(roots: Any, begin: float, end: float) -> float:
    """Return the root between two samples, or the later sample if rounding lost it."""
    own = roots[(roots >= begin) & (roots <= end)]
    return float(own[0]) if len(own) else float(end)

"""A study's kept series, run by run: over shares, spectra, low-passes, sections; runs that failed have none."""

from __future__ import annotations

from typing import Any

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.language.shown import one_line
from gudgeon.results.series import low_pass, spectrum

NEAR = 0.01  # of the time between two samples: so far apart, samples are of the same time
SAME = 1e-9  # of a run: so far apart, samples are at the same share of it


def alike(rows: Any) -> bool:
    """Whether runs, (runs, N) times, have samples at the same times: ends that follow a number a millionth off do."""
    first = rows[0]
    step = np.nanmin(np.diff(first)) if np.isfinite(first).sum() > 1 else 0.0
    return bool(np.isclose(rows, first, rtol=1e-12, atol=NEAR * abs(float(step)), equal_nan=True).all())


def over_shares(t: Any, found: Any) -> tuple[Any, Any] | None:
    """Shares (M,) of the run, those of the one with the most samples, and all runs (…, M) there; None without any.

    A run with other shares lies on straight lines between its own samples; beyond them it is NaN.
    """
    times = np.broadcast_to(t, found.shape).reshape(-1, found.shape[-1])
    own = [_shares(row[np.isfinite(row)]) for row in times]
    at = max(own, key=len, default=np.zeros(0))
    if not len(at):
        return None
    left = np.full((len(own), len(at)), np.nan)
    for out, x, row, told in zip(left, found.values.reshape(times.shape), times, own, strict=True):
        y = x[np.isfinite(row)]
        if len(told) == len(at) and np.allclose(told, at, rtol=0.0, atol=SAME):
            out[:] = y
        elif len(told) and (good := np.isfinite(y)).any():
            out[:] = np.interp(at, told[good], y[good], left=np.nan, right=np.nan)
    return at, found.isel({found.dims[-1]: slice(len(at))}).copy(data=left.reshape(*found.shape[:-1], len(at)))


def _shares(t: Any) -> Any:
    """Times of a run from 0 to 1; none of one that has no length."""
    return (t - t[0]) / (t[-1] - t[0]) if len(t) > 1 and t[-1] > t[0] else np.zeros(0)


def spectra(t: Any, found: Any, by: str | None, name: str, window: str) -> list[tuple[Any, Any]]:
    """Frequencies (M,) and amplitudes (runs, M) of each value of `by`, or of all runs. BadValueError: see below."""
    times = np.broadcast_to(t, found.shape)
    values = [(times, found.values)]
    if by is not None:
        k = found.dims.index(by)
        values = [(np.take(times, i, axis=k), np.take(found.values, i, axis=k)) for i in range(found.shape[k])]
    return [_of_runs(*own, name, window) for own in values]


def _of_runs(times: Any, values: Any, name: str, window: str) -> tuple[Any, Any]:
    rows = [(t[good], x[good]) for t, x in _rows(times, values) if (good := np.isfinite(t) & np.isfinite(x)).any()]
    if not rows:
        return np.zeros(1), np.full((1, 1), np.nan)
    first = rows[0][0]
    if any(len(t) != len(first) for t, _ in rows) or not alike(np.array([t for t, _ in rows])):
        told = f"{one_line(name)}: the runs have samples at different times, of which there is no common spectrum"
        raise BadValueError(told, hint="pick runs with the same times (at=…), or name by= what their times follow")
    each = [spectrum(first, x, window) for _, x in rows]
    return each[0][0], np.array([amplitudes for _, amplitudes in each])


def filtered(t: Any, found: Any, cutoff: float, order: int, causal: bool) -> Any:
    """The same runs behind a low-pass; NaN where they have no samples."""
    left = np.full(found.shape, np.nan)
    for own, out in zip(_rows(np.broadcast_to(t, found.shape), found.values), _rows(left), strict=True):
        good = np.isfinite(own[0]) & np.isfinite(own[1])
        if good.any():
            out[0][good] = low_pass(own[0][good], own[1][good], cutoff, order, causal)
    return found.copy(data=left)


def _rows(*arrays: Any) -> Any:
    """(N,) of each array, run by run."""
    return zip(*(one.reshape(-1, one.shape[-1]) for one in arrays), strict=True)


def crossings(t: Any, through: Any, others: list[Any], level: float, falling: bool, after: float) -> list[Any]:
    """Values of other series, (k,) each, where one rises (falls) through a level after a time.

    Between samples all lie on PCHIP's monotone cubics.
    """
    from scipy.interpolate import PchipInterpolator

    good = np.isfinite(t) & np.isfinite(through) & np.all([np.isfinite(own) for own in others], axis=0)
    if good.sum() < 2:
        return [np.zeros(0) for _ in others]
    t, below = t[good], (through[good] - level) * (-1.0 if falling else 1.0)
    path = PchipInterpolator(t, below)
    starts = np.flatnonzero((below[:-1] < 0.0) & (below[1:] >= 0.0))
    roots = path.roots(discontinuity=False, extrapolate=False)
    at = np.array([_in_part(roots, t[k], t[k + 1]) for k in starts])
    at = at[at >= after] if len(at) else at
    return [PchipInterpolator(t, own[good])(at) for own in others]


def _in_part(roots: Any, begin: float, end: float) -> float:
    """The root between two samples; the later one where rounding lost it."""
    own = roots[(roots >= begin) & (roots <= end)]
    return float(own[0]) if len(own) else float(end)

"""Classify a motion by its points on a Poincaré section: periodic, quasi-periodic or chaotic, with evidence.

Three properties of the points, in the order of time, are used: recurrence, the smallest n for which each point lies
near the one n returns earlier; the sign of the exponent per return, with its uncertainty; and the 0-1 test.

The 0-1 test measures the growth of a sum that the points drive: K is near 1 in chaos, near 0 in regular motion (G. A.
Gottwald, I. Melbourne, SIAM J. Appl. Dyn. Syst. 8:129, 2009, with the modified mean square displacement and the
correlation). If the three disagree, the motion is undecided.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from gudgeon.results.state import Array

RECURRENCE_TOL = 1e-3  # of the motion's extent: distance within which a point recurs
MAX_PERIOD = 32  # returns
MIN_POINTS = 40  # points of a section below which the motion is undecided
MIN_REPETITIONS = 4  # of a period among the points
MIN_CONFIDENCE = 0.8  # confidence below which the kind is "undecided"
MAX_POWER_LAW_SLOPE = 6.0  # divided by the number of returns: largest apparent exponent of growth by a power of time
N_FREQUENCIES = 100  # frequencies of the 0-1 test
PERIODIC, QUASI, CHAOTIC, UNDECIDED = "periodic", "quasi-periodic", "chaotic", "undecided"


@dataclass(frozen=True)
class Motion:
    """The kind of a motion with its `confidence`, and the measures behind it.

    The confidence is the least support among the measures, 0 to 1; it is not a probability. A kind with less than 0.8
    is reported as "undecided", and `supports` has the support of each kind.
    """

    kind: str  # "periodic", "quasi-periodic", "chaotic" or "undecided"
    period: int  # returns until the motion repeats itself; 0 unless periodic
    confidence: float
    supports: Mapping[str, float] = field(repr=False)  # of each kind
    points: int  # of the section
    recurrence: float  # fraction of the points that recur after `nearest` returns
    nearest: int  # the number of returns, 1 to 32, after which most of the points recur
    distance: float  # median distance after so many, as a fraction of the motion's extent
    K: float  # of the 0-1 test; NaN where the points do not move
    per_return: float  # exponent; NaN where it is not known
    per_return_uncertainty: float

    def __repr__(self) -> str:
        """Return kind, confidence and measures in one line."""
        kind = f"{self.kind} {self.period}" if self.period else self.kind
        return (
            f"<Motion {kind}, confidence {self.confidence:.2f}: {self.points} points, {self.recurrence:.0%} recur after"
            f" {self.nearest}, exponent {self.per_return:.3g} ± {self.per_return_uncertainty:.2g} a return,"
            f" K = {self.K:.2f}>"
        )


def classify_motion(
    points: Array,
    extent: float,
    per_return: float = math.nan,
    exponent_error: float = math.nan,
    tolerance: float = RECURRENCE_TOL,
) -> Motion:
    """Return the kind of motion of the points (k, d) of a section in the order of time, with its confidence.

    `extent` is the rms size of the whole motion in the same measure; `tolerance` is the distance of recurrence as a
    fraction of it. `per_return` ± `exponent_error` is the Lyapunov exponent per return; NaN: not known. With fewer than
    MIN_POINTS points or support below MIN_CONFIDENCE the kind is "undecided".
    """
    period, fraction, distance = _find_recurrence(points, tolerance * extent)
    chaos_measure = (
        compute_zero_one_test(_compute_principal_coordinates(points))
        if _compute_max_deviation(points) > tolerance * extent
        else math.nan
    )
    growth_probability, neutral_probability = _compute_growth_probabilities(per_return, exponent_error, len(points))
    regular_measure = 1.0 - abs(chaos_measure) if math.isfinite(chaos_measure) else math.nan
    supports = {
        PERIODIC: _find_min_support(fraction, 1.0 - growth_probability),
        QUASI: _find_min_support(1.0 - fraction, neutral_probability, regular_measure),
        CHAOTIC: _find_min_support(1.0 - fraction, growth_probability, chaos_measure),
    }
    kind = max(supports, key=lambda name: supports[name])
    if len(points) < MIN_POINTS or supports[kind] < MIN_CONFIDENCE:
        kind = UNDECIDED
    confidence = max(supports.values()) if kind != UNDECIDED else 1.0 - max(supports.values())
    return Motion(
        kind,
        period if kind == PERIODIC else 0,
        confidence,
        supports,
        len(points),
        fraction,
        period,
        distance / extent if extent > 0.0 else math.nan,
        chaos_measure,
        per_return,
        exponent_error,
    )


def _find_min_support(*supports: float) -> float:
    """Return the smallest of the supports that are not NaN, at least 0; 0 if there is none."""
    finite_supports = [support for support in supports if math.isfinite(support)]
    return max(min(finite_supports), 0.0) if finite_supports else 0.0


def _find_recurrence(points: Array, tolerance: float) -> tuple[int, float, float]:
    """Return the smallest n after which the largest fraction of points recurs, that fraction, and the median distance.

    A point recurs if the point n returns later lies within `tolerance`. n is at most MAX_PERIOD and
    len(points)/MIN_REPETITIONS. Returns (0, 0, inf) for fewer than MIN_REPETITIONS points.
    """
    best = (0, 0.0, math.inf)
    for n in range(1, min(MAX_PERIOD, len(points) // MIN_REPETITIONS) + 1):
        distances = np.linalg.norm(points[n:] - points[:-n], axis=1)
        fraction = float(np.mean(distances <= tolerance))
        if fraction > best[1] + 1e-12 or best[0] == 0:
            best = (n, fraction, float(np.median(distances)))
    return best


def _compute_max_deviation(points: Array) -> float:
    """Return the largest distance of the points (k, d) from their mean; 0 without points."""
    return float(np.linalg.norm(points - points.mean(axis=0), axis=1).max(initial=0.0)) if len(points) else 0.0


def _compute_principal_coordinates(points: Array) -> Array:
    """Return the coordinates (k,) of the points (k, d) along their first principal component, about the mean."""
    centred = points - points.mean(axis=0)
    return np.asarray(centred @ np.linalg.svd(centred, full_matrices=False)[2][0])


def _compute_growth_probabilities(exponent: float, exponent_error: float, n_returns: int) -> tuple[float, float]:
    """Return the probabilities that differences grow exponentially, and that they neither grow nor decay.

    The exponent is normally distributed with the standard error `exponent_error`; both results are NaN if either is
    not finite, or with fewer than two returns. Rates within ±MAX_POWER_LAW_SLOPE/n_returns count as neither: in regular
    motion differences grow by powers of time, and t³ has the apparent rate 5.9/k over k returns.
    """
    if not (math.isfinite(exponent) and math.isfinite(exponent_error)) or n_returns < 2:
        return math.nan, math.nan
    max_regular_rate = MAX_POWER_LAW_SLOPE / n_returns

    def compute_probability_above(bound: float) -> float:
        """Return the probability that the normally distributed exponent exceeds `bound`."""
        return 0.5 * math.erfc((bound - exponent) / (math.sqrt(2.0) * max(exponent_error, 1e-300)))

    return compute_probability_above(max_regular_rate), compute_probability_above(
        -max_regular_rate
    ) - compute_probability_above(max_regular_rate)


def compute_zero_one_test(values: Array, seed: int = 1) -> float:
    """Return K of the 0-1 test for chaos of a series (k,): near 1 in chaos, near 0 in regular motion.

    K is the median over random frequencies of the correlation of lag n and displacement D(n), n up to k/10. Returns NaN
    for fewer than MIN_POINTS values.
    """
    n_values = len(values)
    if n_values < MIN_POINTS:
        return math.nan
    max_lag, indices = n_values // 10, np.arange(1, n_values + 1)
    lags = np.arange(1, max_lag + 1)
    correlations = []
    for frequency in np.random.default_rng(seed).uniform(math.pi / 5, 4 * math.pi / 5, N_FREQUENCIES):
        p, q = np.cumsum(values * np.cos(indices * frequency)), np.cumsum(values * np.sin(indices * frequency))
        mean_squares = [
            np.mean(
                (p[lag:][: n_values - max_lag] - p[: n_values - max_lag]) ** 2
                + (q[lag:][: n_values - max_lag] - q[: n_values - max_lag]) ** 2
            )
            for lag in lags
        ]
        displacement = np.array(mean_squares) - values.mean() ** 2 * (1.0 - np.cos(lags * frequency)) / (
            1.0 - math.cos(frequency)
        )
        correlations.append(np.corrcoef(lags, displacement)[0, 1] if np.ptp(displacement) > 0.0 else 0.0)
    return float(np.median(correlations))

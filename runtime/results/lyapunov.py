"""Define `Lyapunov`, an estimate of the largest Lyapunov exponent with its uncertainty, and Poincaré section points.

The measured rate is that at which neighbouring motions separate, λ = lim ln(d(t)/d(0))/t (G. Benettin, L. Galgani, A.
Giorgilli, J.-M. Strelcyn, Meccanica 15:9, 1980). The exponent per return, 1/return, is λ times the mean time between
returns (L. M. Abramov, Dokl. Akad. Nauk SSSR 128:873, 1959).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.language.argument_checks import check_positive
from gudgeon.language.deprecations import BELIEVABLE, MERGED, warn_deprecated
from gudgeon.results.motion import Motion, classify_motion

if TYPE_CHECKING:
    from gudgeon.results.state import Array, State

TRANSIENT_FRACTION = 0.1  # fraction of the time in which the difference turns to the direction of largest growth
N_BLOCKS = 10  # blocks of time, from whose means the uncertainty is estimated
AGREEMENT_LIMIT = 0.25  # fraction of the clearance (or size, or 1 rad) at which runs disagree, as in horizon=True


@dataclass(frozen=True, eq=False)
class Section:
    """A Poincaré section of a motion: its states at an event of the file, or once a period."""

    name: str  # of the event, or "every 0.5 s"
    t: Array  # (k,) s
    points: Array  # (k, d) without units: lengths over the size, cosine and sine of angles, velocities over the largest
    extent: float  # rms of the whole motion about its mean, in the same measure


@dataclass(frozen=True, eq=False)
class Lyapunov:
    """The largest Lyapunov exponent, `exponent` ± `uncertainty` in 1/s: positive where small differences grow, that is,
    in chaos.

    The uncertainty is one standard error, from the slopes in ten blocks of time and the time discretization of the
    tangent map.
    `mean_horizon` returns the mean predictability horizon.
    """

    by: str  # "tangent" or "two_trajectory"
    why: str  # why the tangent was not used; "" where it was, or where "two_trajectory" was requested
    t: Array  # (k + 1,) s: begin, and the end of each interval
    growth: Array  # (k,) ln of the growth of the difference in each interval
    unresolved: float  # 1/s: change of the tangent's growth rate with the last halving of its step
    coincidences: int  # times at which both trajectories became equal, as in stick; λ is then an upper bound
    transverse: bool  # whether differences along the motion were removed, as for a section at an event
    section: Section | None
    final: State = field(repr=False)  # to resume from

    @cached_property
    def series(self) -> Array:
        """The running exponent in 1/s, as estimated up to each of t[1:], (k,).

        It is the regression slope of the logarithm of the growth. It is NaN during the first tenth of the time, while
        the difference turns to the direction of largest growth.
        """
        exponents = np.full(len(self.growth), np.nan)
        exponents[self._first :] = _compute_regression_slopes(self.t[self._first :], self._logs[self._first :])
        return exponents

    @property
    def exponent(self) -> float:
        """Exponent, 1/s: the least-squares slope of ln of the growth over time, which oscillations within a period do
        not bias.
        """
        return float(self.series[-1])

    @cached_property
    def uncertainty(self) -> float:
        """One standard error of the exponent, 1/s; NaN for too few intervals."""
        error = _compute_slope_error(self.t[self._first :], self._logs[self._first :])
        return math.hypot(error, self.unresolved)

    @property
    def per_return(self) -> float:
        """Exponent per return to the section; NaN without a section, or with fewer than two returns."""
        logs = self._section_returns[1]
        return float(_compute_regression_slopes(np.arange(len(logs)), logs)[-1]) if len(logs) > 1 else math.nan

    @cached_property
    def per_return_uncertainty(self) -> float:
        """One standard error of `per_return`; NaN with fewer than two returns.

        It is the root of the sum of two squares: the standard error of the slope over the returns, and `unresolved`
        (1/s) times the mean time between returns.
        """
        times, logs = self._section_returns
        if len(times) < 2:
            return math.nan
        mean_time = (times[-1] - times[0]) / (len(times) - 1)
        return math.hypot(_compute_slope_error(np.arange(len(logs)), logs), self.unresolved * mean_time)

    @property
    def sign(self) -> int:
        """Sign of the exponent: 1 if it exceeds two uncertainties, −1 if it is below minus two, 0 if neither."""
        return int(np.sign(self.exponent)) if abs(self.exponent) > 2.0 * self.uncertainty else 0

    def mean_horizon(self, error: float = 1e-8, limit: float = AGREEMENT_LIMIT) -> float:
        """Return the mean predictability horizon in s, ln(limit/error)/λ: inf where λ ≤ 0, NaN where λ is unknown.

        `error` is the error of the run at its start, `limit` the distance at which runs disagree: fractions of the
        clearance, or of the mechanism's size or 1 rad. Raises BadValueError unless both are positive and `error` is
        smaller. `simulate(..., horizon=True)` repeats a run instead: its horizon is that of one run and depends on its
        first contacts; this one is a mean over all runs.
        """
        error, limit = check_positive(error, "error"), check_positive(limit, "limit")
        if error >= limit:
            raise BadValueError(f"error: {error:g}: expected less than limit, {limit:g}")
        if not math.isfinite(self.exponent):
            return math.nan
        return math.log(limit / error) / self.exponent if self.exponent > 0.0 else math.inf

    def believable(self, error: float = 1e-8, apart: float = AGREEMENT_LIMIT) -> float:
        """Return `mean_horizon(error, limit=apart)`. Deprecated, see the changes."""
        warn_deprecated(BELIEVABLE)
        return self.mean_horizon(error, apart)

    @property
    def merged(self) -> int:
        """The number `coincidences`. Deprecated, see the changes."""
        warn_deprecated(MERGED)
        return self.coincidences

    @cached_property
    def motion(self) -> Motion:
        """The kind of the motion that returns to the section, from the returns after the first tenth of the time.

        Raises BadValueError without a section.
        """
        if self.section is None:
            raise BadValueError("no section was requested", hint='lyapunov(..., section="an event", or a period in s)')
        is_settled = self.section.t >= self.t[self._first]
        points = self.section.points[is_settled]
        return classify_motion(points, self.section.extent, self.per_return, self.per_return_uncertainty)

    @property
    def _first(self) -> int:
        """Index of the first interval after the difference has turned to the direction of largest growth."""
        return int(np.searchsorted(self.t, self.t[0] + TRANSIENT_FRACTION * (self.t[-1] - self.t[0]), side="left"))

    @cached_property
    def _logs(self) -> Array:
        """The ln of the growth up to each of t, (k + 1,)."""
        return np.concatenate([[0.0], np.cumsum(self.growth)])

    @cached_property
    def _section_returns(self) -> tuple[Array, Array]:
        """The times of the returns after the first tenth of the time, (r,), and the logarithm of the growth up to each,
        (r,).

        Both are empty without a section.
        """
        times = self.section.t if self.section is not None else np.zeros(0)
        times = times[times >= self.t[self._first]]
        return times, np.interp(times, self.t, self._logs)

    def __repr__(self) -> str:
        """Return exponent, uncertainty, method and time span in one line."""
        text = f"{self.exponent:.4g} ± {self.uncertainty:.2g} 1/s"
        if self.section is not None:
            text += f", {self.per_return:.4g} ± {self.per_return_uncertainty:.2g} a return ({self.section.name})"
        text += f", at most: {self.coincidences} coincidences" if self.coincidences else ""
        return f"<Lyapunov {text}, by the {self.by.replace('_', '-')} method, {self.t[0]:g} … {self.t[-1]:g} s>"


def _compute_regression_slopes(x: Array, growth_logs: Array) -> Array:
    """Return the slopes (k,) of the least-squares lines through the first 2, 3, … k + 1 points (x, growth_logs).

    Each point is weighted by the interval before it. If the normal equations are singular (determinant below 1e-9 of
    its scale), the slope is that from the first point to the last.
    """
    weights = np.diff(x)
    x_shifted, y_shifted = x[1:] - x[0], growth_logs[1:] - growth_logs[0]
    sum_1, sum_x, sum_xx, sum_y, sum_xy = (
        np.cumsum(weights * term)
        for term in (x_shifted**0, x_shifted, x_shifted * x_shifted, y_shifted, x_shifted * y_shifted)
    )
    determinant = sum_1 * sum_xx - sum_x * sum_x
    with np.errstate(all="ignore"):
        return np.asarray(
            np.where(
                determinant > 1e-9 * sum_1 * sum_xx,
                (sum_1 * sum_xy - sum_x * sum_y) / determinant,
                y_shifted / x_shifted,
            )
        )


def _compute_slope_error(x: Array, growth_logs: Array) -> float:
    """Return the standard error of the slope of `growth_logs` over x, from the slopes in N_BLOCKS equal blocks of x.

    Values at block ends are interpolated. Returns NaN with fewer than three intervals a block.
    """
    if len(x) < 3 * N_BLOCKS + 1:
        return math.nan
    edges = np.linspace(x[0], x[-1], N_BLOCKS + 1)
    slopes = []
    for begin, end in zip(edges, edges[1:], strict=False):
        inside = x[(x > begin) & (x < end)]
        block_x = np.concatenate([[begin], inside, [end]])
        slopes.append(_compute_regression_slopes(block_x, np.interp(block_x, x, growth_logs))[-1])
    return float(np.std(slopes, ddof=1) / math.sqrt(N_BLOCKS))

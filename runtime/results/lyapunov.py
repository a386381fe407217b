"""The largest Lyapunov exponent of a run as it was found: growth by intervals, uncertainty, returns to a section.

What is measured is the rate at which neighbours part, λ = lim ln(d(t)/d(0))/t (G. Benettin, L. Galgani, A. Giorgilli,
J.-M. Strelcyn, Meccanica 15:9, 1980). Of an exponent per return, 1/return, it is λ times the mean time between returns
(L. M. Abramov, Dokl. Akad. Nauk SSSR 128:873, 1959).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.language.wanted import positive
from gudgeon.results.motion import Motion, classify

if TYPE_CHECKING:
    from gudgeon.results.state import Array, State

SETTLED = 0.1  # share of the time in which the difference turns into the direction that grows most
BLOCKS = 10  # whose means tell the uncertainty
APART = 0.25  # of the clearance (or size, or 1 rad): as simulate(..., horizon=True) has it


@dataclass(frozen=True, eq=False)
class Section:
    """Where a motion returns to: states at an event of the file, or once a period."""

    name: str  # of the event, or "every 0.5 s"
    t: Array  # (k,) s
    points: Array  # (k, d) without units: lengths over the size, cosine and sine of angles, velocities over the largest
    extent: float  # rms of the whole motion about its mean, in the same measure


@dataclass(frozen=True, eq=False)
class Lyapunov:
    """`exponent` ± `uncertainty` in 1/s: positive where small differences grow, that is, in chaos.

    The uncertainty is one standard error: of the means of ten blocks of time, with what the mesh of the tangent
    leaves open. `believable` tells until when a run may be believed.
    """

    by: str  # "tangent" or "twin"
    why: str  # why not by the tangent; "" where it is, or where nobody asked for it
    t: Array  # (k + 1,) s: begin, and the end of each interval
    growth: Array  # (k,) ln of what the difference grew by in each
    unresolved: float  # 1/s: change of the tangent's growth with the last halving of its mesh
    merged: int  # how often a twin became one with the run, as where friction sticks: λ is a bound from above then
    transverse: bool  # differences along the motion itself were taken away: of a section without a clock
    section: Section | None
    final: State = field(repr=False)  # to go on from

    @cached_property
    def series(self) -> Array:
        """(k,) the exponent (1/s) as it was known at t[1:]; NaN while the difference turns."""
        found = np.full(len(self.growth), np.nan)
        found[self._first :] = _slopes(self.t[self._first :], self._logs[self._first :])
        return found

    @property
    def exponent(self) -> float:
        """1/s: the slope of ln of the growth over time by least squares, to which swings within a period do no harm."""
        return float(self.series[-1])

    @cached_property
    def uncertainty(self) -> float:
        """One standard error, 1/s; NaN of a run with too few intervals to tell."""
        error = _standard_error(self.t[self._first :], self._logs[self._first :])
        return math.hypot(error, self.unresolved)

    @property
    def per_return(self) -> float:
        """Exponent per return to the section; NaN without one, or with fewer than two returns."""
        logs = self._returns[1]
        return float(_slopes(np.arange(len(logs)), logs)[-1]) if len(logs) > 1 else math.nan

    @cached_property
    def per_return_uncertainty(self) -> float:
        """One standard error of `per_return`."""
        times, logs = self._returns
        if len(times) < 2:
            return math.nan
        mean_time = (times[-1] - times[0]) / (len(times) - 1)
        return math.hypot(_standard_error(np.arange(len(logs)), logs), self.unresolved * mean_time)

    @property
    def sign(self) -> int:
        """1 where differences grow by more than two uncertainties, −1 where they die out, 0: neither is known."""
        return int(np.sign(self.exponent)) if abs(self.exponent) > 2.0 * self.uncertainty else 0

    def believable(self, error: float = 1e-8, apart: float = APART) -> float:
        """Time (s) for which a run may be believed: ln(apart/error)/λ; inf where λ ≤ 0, NaN where it is not known.

        `error` is what the run errs by at its start, as rtol of the same measure in which `apart` is: the clearance,
        or the mechanism's size or 1 rad. `simulate(..., horizon=True)` repeats a run instead: it is that run's own,
        with the good and bad luck of its first contacts; this one is that of the mean of all runs.
        """
        error, apart = positive(error, "error"), positive(apart, "apart")
        if error >= apart:
            raise BadValueError(f"error {error:g} is not below {apart:g}, where runs are apart")
        if not math.isfinite(self.exponent):
            return math.nan
        return math.log(apart / error) / self.exponent if self.exponent > 0.0 else math.inf

    @cached_property
    def motion(self) -> Motion:
        """What kind of motion returns to the section. Raises BadValueError where there is no section."""
        if self.section is None:
            raise BadValueError("no section was asked for", hint='lyapunov(..., section="an event", or a period in s)')
        late = self.section.t >= self.t[self._first]
        points = self.section.points[late]
        return classify(points, self.section.extent, self.per_return, self.per_return_uncertainty)

    @property
    def _first(self) -> int:
        """The first interval that counts."""
        return int(np.searchsorted(self.t, self.t[0] + SETTLED * (self.t[-1] - self.t[0]), side="left"))

    @cached_property
    def _logs(self) -> Array:
        """(k + 1,) ln of the growth up to each of t."""
        return np.concatenate([[0.0], np.cumsum(self.growth)])

    @cached_property
    def _returns(self) -> tuple[Array, Array]:
        """Times of the returns that count, (r,), and ln of the growth up to them."""
        times = self.section.t if self.section is not None else np.zeros(0)
        times = times[times >= self.t[self._first]]
        return times, np.interp(times, self.t, self._logs)

    def __repr__(self) -> str:
        found = f"{self.exponent:.4g} ± {self.uncertainty:.2g} 1/s"
        if self.section is not None:
            found += f", {self.per_return:.4g} ± {self.per_return_uncertainty:.2g} a return ({self.section.name})"
        found += f", at most: merged {self.merged} times" if self.merged else ""
        return f"<Lyapunov {found}, by the {self.by}, {self.t[0]:g} … {self.t[-1]:g} s>"


def _slopes(x: Array, logs: Array) -> Array:
    """(k,) slopes of the straight line through the first 2, 3, … k + 1 points, each weighted by the interval before."""
    weight = np.diff(x)
    u, y = x[1:] - x[0], logs[1:] - logs[0]
    s0, s1, s2, r0, r1 = (np.cumsum(weight * part) for part in (u**0, u, u * u, y, u * y))
    spread = s0 * s2 - s1 * s1
    with np.errstate(all="ignore"):
        return np.asarray(np.where(spread > 1e-9 * s0 * s2, (s0 * r1 - s1 * r0) / spread, y / u))


def _standard_error(x: Array, logs: Array) -> float:
    """Of the slopes of blocks of the same length; NaN where there are not three intervals for each."""
    if len(x) < 3 * BLOCKS + 1:
        return math.nan
    edges = np.linspace(x[0], x[-1], BLOCKS + 1)
    slopes = []
    for a, b in zip(edges, edges[1:], strict=False):
        inside = x[(x > a) & (x < b)]
        part = np.concatenate([[a], inside, [b]])
        slopes.append(_slopes(part, np.interp(part, x, logs))[-1])
    return float(np.std(slopes, ddof=1) / math.sqrt(BLOCKS))

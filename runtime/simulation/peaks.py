"""Search the peaks of any series over all steps of a run: `simulate(peaks=["S9.ay"])`.

The time loop passes the states of its steps (integrators/steps.py): ends and points between. Series are evaluated there
in blocks, as at samples. Between two states, the motion is a Hermite polynomial through them and their neighbours (C.
Hermite, J. reine angew. Math. 84, 1878), with an error of the method's order. Kinematic motions are computed exactly.

Where second differences show that a series may exceed the known peak, it is sampled more and more closely. Jumps need
no search, since the states on both sides are given. A step may be longer than the period of a force. Where the states
of a step do not resolve a series, intervals are halved until polynomials do.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.polynomial.chebyshev import chebval, chebvander
from numpy.typing import NDArray

from gudgeon.integrators.steps import Steps
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.results.diagnostics import Extremes
from gudgeon.simulation.between import INSIDE, Path
from gudgeon.simulation.step_observers import ComparedScene, Observation

# Chebyshev points, as fractions of an interval, at which a series is sampled
NODES = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 9))
# matrix from values at the points to Chebyshev coefficients
COEFFICIENTS = np.linalg.inv(chebvander(2.0 * NODES - 1.0, len(NODES) - 1))
FINE = chebvander(np.linspace(-1.0, 1.0, 129), len(NODES) - 1)  # matrix from coefficients to values at 129 points
ROUNDS, AT_AN_END = 12, 3  # largest number of refinements, and the number if the maximum is at an end
MOST = 16  # intervals of a block that are searched; the most promising first
SAME = 1e-14  # of a value: a smaller increase is rounding, and the earlier time is reported
RESOLVED = 2e-4  # of the largest value of a block: allowed error of states predicted from their neighbours
# matrix from five states to the values at INSIDE of their four intervals
PREDICT = np.vander(np.arange(4) + INSIDE, 5) @ np.linalg.inv(np.vander(np.arange(5.0)))
SMALL = 5e-9  # of the largest acceleration of its kind: smaller values are rounding
EQUAL = 1e-6  # relative difference up to which intervals of a step count as equal
MOST_HALVED = 4096  # largest number of intervals that are evaluated for one series of a block
CLOSE = 1e-11  # of the largest value of a block: largest last coefficients of a resolved polynomial


class Search:
    """Search the peaks of series over all steps of one run; `found` returns them."""

    def __init__(
        self,
        compiled: CompiledModel,
        names: Iterable[str],
        numbers: tuple[Array, Array, Array],
        beside: ComparedScene | None = None,
    ) -> None:
        self.names = tuple(names)
        self.ours = Path(compiled, numbers, self.names)
        self.beside = beside  # the scene with which errors are computed
        self.theirs = Path(beside.compiled, beside.numbers, self.names) if beside else None
        self.kinds = [(name, False) for name in self.names]
        if beside:
            self.kinds += [(name, True) for name in self.names if name in beside.names]
        self.unresolved: set[str] = set()  # series that vary too fast for the search
        self.best: dict[tuple[str, bool, int], tuple[float, float]] = {}  # (name, is an error, sign) → value, time

    def __call__(self, steps: Steps) -> None:
        """Process the next states of the run."""
        self.ours.take(steps)
        paths = [self.ours]
        if self.theirs and self.beside and (followed := self.beside.follow(steps.t)) is not None:
            self.theirs.take(followed)
            paths.append(self.theirs)
        for name, error in self.kinds:
            if not error or len(paths) == 2:
                self._update_peaks(name, error, paths if error else paths[:1])

    def message(self) -> Observation:
        """Return the peaks and notes as a Result stores them."""
        return Observation(self.found(), self.notes())

    def found(self) -> tuple[Extremes, ...]:
        """Return the extremes of each series, then those of errors against the other scene."""
        unknown = (math.nan, math.nan)
        message = []
        for name, error in self.kinds:
            if error and self.beside and self.beside.lost:
                continue
            high, low = (self.best.get((name, error, sign), unknown) for sign in (1, -1))
            against = self.beside.scene if error and self.beside else ""
            message.append(Extremes(name, self.ours.catalogue[name].unit, *high, 0.0 - low[0], low[1], against))
        return tuple(message)

    def notes(self) -> tuple[str, ...]:
        """Return the notes for the run: states left out, and series that could not be searched."""
        message = []
        if self.ours.lost:
            message.append(f"peaks: {self.ours.lost} states of steps have no accelerations and are left out")
        for name in sorted(self.unresolved):
            message.append(f"peaks: {name} varies too fast within a step to be searched: a larger value may exist")
        if self.beside and self.beside.lost:
            message.append(f"errors over all steps are not known: scene {self.beside.scene}: {self.beside.lost}")
        return tuple(message)

    def _update_peaks(self, name: str, error: bool, paths: list[Path]) -> None:
        """Update the peaks of one series from the present states and the intervals between them."""
        values = _subtract_other([path.values(name) for path in paths])
        t, inner = self.ours.steps.t, self.ours.inner
        scale = max(
            float(np.abs(values[np.isfinite(values)]).max(initial=0.0)), SMALL * self._largest_acceleration(name)
        )
        if not error:
            for k in np.flatnonzero(_find_unresolved(self.ours, name, values, RESOLVED * scale)).tolist():
                self._halve(name, k, scale)
        for sign in (1, -1):
            key = (name, error, sign)
            if np.isfinite(sign * values).any():
                k = int(np.nanargmax(np.where(np.isfinite(values), sign * values, -np.inf)))
                self._store_peak(key, float(sign * values[k]), float(t[k]))
            rises = _estimate_maxima(t, sign * values, inner)
            for k in np.argsort(-rises, kind="stable")[:MOST].tolist():
                if not rises[k] > self.best.get(key, (-math.inf, 0.0))[0]:
                    break
                self._refine_maximum(key, k, paths, scale)

    def _refine_maximum(
        self,
        key: tuple[str, bool, int],
        k: int,
        paths: list[Path],
        scale: float,
        within: tuple[float, float] | None = None,
    ) -> None:
        """Refine the maximum between states k and k + 1, until a polynomial through the samples resolves it.

        `within`: begin and end (s) of the part that is searched; None: the whole interval.
        """
        low, high = within or self.ours.steps.t[k : k + 2].tolist()
        for turn in range(ROUNDS):
            times = low + NODES * (high - low)
            values = key[2] * _subtract_other([path.between(k, times, key[0]) for path in paths])
            known = np.where(np.isfinite(values), values, -np.inf)
            best = int(known.argmax())
            self._store_peak(key, float(known[best]), float(times[best]))
            if np.isfinite(values).all():
                parts = COEFFICIENTS @ values
                if np.abs(parts[-2:]).max() <= CLOSE * scale:
                    top, share = _polynomial_maximum(parts)
                    self._store_peak(key, top, low + share * (high - low))
                    break
            if not times[1] > times[0] or (best in (0, len(NODES) - 1) and turn >= AT_AN_END):
                break
            low, high = float(times[max(best - 1, 0)]), float(times[min(best + 1, len(NODES) - 1)])

    def _halve(self, name: str, k: int, scale: float) -> None:
        """Sample a series between states k and k + 1 on intervals that are halved until polynomials resolve it."""
        parts, looked = self.ours.steps.t[np.newaxis, k : k + 2], 0
        while len(parts) and looked < MOST_HALVED:
            looked += len(parts)
            low, high = parts[:, :1], parts[:, 1:]
            times = low + NODES * (high - low)
            values = self.ours.between(k, times.ravel(), name).reshape(times.shape)
            known = np.asarray(np.isfinite(values).all(axis=1))
            coefficients = np.where(known[:, np.newaxis], values, 0.0) @ COEFFICIENTS.T
            split = np.abs(coefficients[:, -2:]).max(axis=1) > RESOLVED * scale
            split &= times[:, 1] > times[:, 0]
            for j in np.flatnonzero(known & ~split).tolist():
                for sign in (1, -1):
                    if _polynomial_maximum(sign * coefficients[j])[0] + RESOLVED * scale > self._highest(name, sign):
                        self._refine_maximum((name, False, sign), k, [self.ours], scale, (low[j, 0], high[j, 0]))
            middle = 0.5 * (low + high)
            parts = np.concatenate([np.hstack([low, middle])[split], np.hstack([middle, high])[split]])
        if len(parts):
            self.unresolved.add(name)

    def _largest_acceleration(self, name: str) -> float:
        """Return the largest acceleration of the block with the unit of a series; 0 for other series."""
        kinds = {"m/s^2": [0, 1], "rad/s^2": [2]}.get(self.ours.catalogue[name].unit, [])
        a = np.abs(self.ours.run.a[1:]).reshape(-1, self.ours.compiled.n // 3, 3)[:, :, kinds]
        return float(a[np.isfinite(a)].max(initial=0.0))

    def _highest(self, name: str, sign: int) -> float:
        """Return the largest known value of sign times a series."""
        return self.best.get((name, False, sign), (-math.inf, 0.0))[0]

    def _store_peak(self, key: tuple[str, bool, int], value: float, t: float) -> None:
        """Store a value and its time, if it exceeds the known peak by more than rounding."""
        if math.isfinite(value) and (key not in self.best or value - self.best[key][0] > SAME * abs(value)):
            self.best[key] = float(value), float(t)


def _polynomial_maximum(parts: Array) -> tuple[float, float]:
    """Return the maximum of a polynomial with given Chebyshev coefficients, and its position in [0, 1]."""
    fine = FINE @ parts
    k = int(fine.argmax())
    share = k / (len(fine) - 1)
    if 0 < k < len(fine) - 1:
        bend = fine[k - 1] - 2.0 * fine[k] + fine[k + 1]
        share += 0.5 * (fine[k - 1] - fine[k + 1]) / bend / (len(fine) - 1) if bend < 0.0 else 0.0
    return float(max(fine[k], chebval(2.0 * share - 1.0, parts))), share


def _subtract_other(values: list[Array]) -> Array:
    """Return a series, or its difference from that of another scene if two are given."""
    return values[0] if len(values) == 1 else values[0] - values[1]


def _find_unresolved(path: Path, name: str, values: Array, allowed: float) -> NDArray[np.bool_]:
    """Return a mask (K − 1,) of the intervals in which the states do not resolve a series.

    Five states at equal intervals of one step predict the series at INSIDE of each interval by a polynomial of order 4.
    The series is not resolved where the value differs by more than `allowed`.
    """
    out = np.zeros(max(len(values) - 1, 0), bool)
    if len(values) < len(PREDICT) + 1 or path.exact or path.films:
        return out
    windows = np.lib.stride_tricks.sliding_window_view
    h = np.where(path.inner, np.diff(path.steps.t), np.nan)
    with np.errstate(invalid="ignore"):
        four = windows(h, len(PREDICT))
        equal = np.flatnonzero(np.abs(four - four[:, :1]).max(axis=1) < EQUAL * four[:, 0])
        if len(equal):
            there = windows(path.inside(name), len(PREDICT))[equal]
            predicted = windows(values, len(PREDICT) + 1)[equal] @ PREDICT.T
            for k in equal[(np.abs(there - predicted) > allowed).any(axis=1)].tolist():
                out[k : k + len(PREDICT)] = True
    return out


def _estimate_maxima(t: Array, values: Array, inner: NDArray[np.bool_]) -> Array:
    """Return an upper estimate (K − 1,) of a series between states k and k + 1; −∞ if no value exceeds the ends.

    It is the maximum of a parabola through both ends, with twice the second derivative that neighbours show. `inner` (K
    − 1,): intervals within one step.
    """
    out = np.full(max(len(t) - 1, 0), -np.inf)
    if len(t) < 3:
        return out
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        h, way = np.diff(t), np.diff(values)
        bend = np.abs(np.diff(way / h)) / (t[2:] - t[:-2]) * 2.0  # at states 1 to K − 2
        bend = np.where(inner[1:] & inner[:-1] & np.isfinite(bend), bend, 0.0)
        most = 2.0 * np.maximum(np.append(bend, 0.0), np.insert(bend, 0, 0.0)) * h**2
        top = 0.5 + way / most  # share of the part at which the parabola is highest
        height = values[:-1] + way * top + 0.5 * most * top * (1.0 - top)
    return np.where(inner & (top > 0.0) & (top < 1.0) & np.isfinite(height), height, out)

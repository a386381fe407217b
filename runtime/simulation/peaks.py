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
from gudgeon.simulation.run_interpolant import INNER_FRACTION, RunInterpolant
from gudgeon.simulation.step_observers import ComparedScene, Observation

# Chebyshev points, as fractions of an interval, at which a series is sampled
NODES = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 9))
# matrix from values at the points to Chebyshev coefficients
COEFFICIENTS = np.linalg.inv(chebvander(2.0 * NODES - 1.0, len(NODES) - 1))
VALUES_FROM_CHEBYSHEV = chebvander(
    np.linspace(-1.0, 1.0, 129), len(NODES) - 1
)  # matrix from coefficients to values at 129 points
# largest number of refinements of a maximum, and that of a maximum at an end of its interval
MAX_REFINEMENTS, MAX_REFINEMENTS_AT_END = 12, 3
MAX_INTERVALS = 16  # intervals of a block that are searched; those with the largest estimates first
PEAK_TOL = 1e-14  # of a value: a smaller increase is rounding, and the earlier time is reported
RESOLUTION_TOL = 2e-4  # of the largest value of a block: allowed error of states predicted from their neighbours
# matrix from five states to the values at INNER_FRACTION of their four intervals
PREDICTION_MATRIX = np.vander(np.arange(4) + INNER_FRACTION, 5) @ np.linalg.inv(np.vander(np.arange(5.0)))
ACCELERATION_ROUNDING = 5e-9  # of the largest acceleration of its kind: smaller values are rounding
INTERVAL_TOL = 1e-6  # relative difference up to which intervals of a step count as equal
MAX_HALVED_INTERVALS = 4096  # largest number of intervals that are evaluated for one series of a block
COEFFICIENT_TOL = 1e-11  # of the largest value of a block: largest last coefficients of a resolved polynomial


class PeakSearch:
    """Search the peaks of series over all steps of one run; it is a step observer.

    `compared_scene`: the scene from which errors of the series are computed, or None.
    """

    def __init__(
        self,
        compiled: CompiledModel,
        names: Iterable[str],
        parameter_arrays: tuple[Array, Array, Array],
        compared_scene: ComparedScene | None = None,
    ) -> None:
        self.names = tuple(names)
        self.interpolant = RunInterpolant(compiled, parameter_arrays, self.names)
        self.compared_scene = compared_scene  # the scene with which errors are computed
        self.compared_interpolant = (
            RunInterpolant(compared_scene.compiled, compared_scene.parameter_arrays, self.names)
            if compared_scene
            else None
        )
        self.kinds = [(name, False) for name in self.names]
        if compared_scene:
            self.kinds += [(name, True) for name in self.names if name in compared_scene.names]
        self.unresolved: set[str] = set()  # series that vary too fast for the search
        self.best: dict[tuple[str, bool, int], tuple[float, float]] = {}  # (name, is an error, sign) → value, time

    def __call__(self, steps: Steps) -> None:
        """Process the next states of the run: update the peaks of all series, and of their errors while the other
        scene runs.
        """
        self.interpolant.load_states(steps)
        interpolants = [self.interpolant]
        if (
            self.compared_interpolant
            and self.compared_scene
            and (followed := self.compared_scene.integrate_to(steps.t)) is not None
        ):
            self.compared_interpolant.load_states(followed)
            interpolants.append(self.compared_interpolant)
        for name, error in self.kinds:
            if not error or len(interpolants) == 2:
                self._update_peaks(name, error, interpolants if error else interpolants[:1])

    def build_observation(self) -> Observation:
        """Return the peaks and notes as an Observation, which is stored in a Result."""
        return Observation(self.list_extremes(), self.list_notes())

    def list_extremes(self) -> tuple[Extremes, ...]:
        """Return the extremes of each series, then those of errors against the other scene if it ran to the end.

        Peaks are stored by (series, whether it is the error, sign): for the sign −1 the largest of the negated values.
        Values and times are NaN for series without a finite value.
        """
        unknown = (math.nan, math.nan)
        extremes = []
        for name, is_error in self.kinds:
            if is_error and self.compared_scene and self.compared_scene.failure_reason:
                continue
            high, low = (self.best.get((name, is_error, sign), unknown) for sign in (1, -1))
            against = self.compared_scene.scene if is_error and self.compared_scene else ""
            extremes.append(Extremes(name, self.interpolant.catalogue[name].unit, *high, 0.0 - low[0], low[1], against))
        return tuple(extremes)

    def list_notes(self) -> tuple[str, ...]:
        """Return the notes for the run: states left out, series that cannot be searched, and a failed other scene."""
        notes = []
        if self.interpolant.n_without_accelerations:
            notes.append(
                f"peaks: {self.interpolant.n_without_accelerations} states of steps have no "
                "accelerations and are left out"
            )
        for name in sorted(self.unresolved):
            notes.append(f"peaks: {name} varies too fast within a step to be searched: a larger value may exist")
        if self.compared_scene and self.compared_scene.failure_reason:
            notes.append(
                f"errors over all steps are not known: scene {self.compared_scene.scene}: "
                f"{self.compared_scene.failure_reason}"
            )
        return tuple(notes)

    def _update_peaks(self, name: str, is_error: bool, interpolants: list[RunInterpolant]) -> None:
        """Update the peaks of one series, or if `is_error` of its error, from the current block of states.

        `interpolants`: that of the run, then for errors that of the other scene. Intervals whose states do not resolve
        the series are halved first. Then at most MAX_INTERVALS intervals are searched, in the order of the estimates.
        """
        values = _subtract_compared_series([path.evaluate_series_at_states(name) for path in interpolants])
        t, inner = self.interpolant.steps.t, self.interpolant.is_within_step
        scale = max(
            float(np.abs(values[np.isfinite(values)]).max(initial=0.0)),
            ACCELERATION_ROUNDING * self._find_largest_acceleration(name),
        )
        if not is_error:
            for k in np.flatnonzero(
                _find_unresolved_intervals(self.interpolant, name, values, RESOLUTION_TOL * scale)
            ).tolist():
                self._refine_unresolved_interval(name, k, scale)
        for sign in (1, -1):
            key = (name, is_error, sign)
            if np.isfinite(sign * values).any():
                k = int(np.nanargmax(np.where(np.isfinite(values), sign * values, -np.inf)))
                self._store_peak(key, float(sign * values[k]), float(t[k]))
            estimates = _estimate_maxima(t, sign * values, inner)
            for k in np.argsort(-estimates, kind="stable")[:MAX_INTERVALS].tolist():
                if not estimates[k] > self.best.get(key, (-math.inf, 0.0))[0]:
                    break
                self._refine_maximum(key, k, interpolants, scale)

    def _refine_maximum(
        self,
        key: tuple[str, bool, int],
        k: int,
        interpolants: list[RunInterpolant],
        scale: float,
        time_range: tuple[float, float] | None = None,
    ) -> None:
        """Refine and store the maximum between states k and k + 1, until a polynomial through the samples resolves it.

        `key`: name of the series, whether it is the error, and sign. `scale`: size of its values. `time_range`: begin
        and end (s) of the part that is searched; None: the whole interval.
        """
        low, high = time_range or self.interpolant.steps.t[k : k + 2].tolist()
        for iteration in range(MAX_REFINEMENTS):
            times = low + NODES * (high - low)
            values = key[2] * _subtract_compared_series(
                [path.evaluate_series_between_states(k, times, key[0]) for path in interpolants]
            )
            finite_values = np.where(np.isfinite(values), values, -np.inf)
            best = int(finite_values.argmax())
            self._store_peak(key, float(finite_values[best]), float(times[best]))
            if np.isfinite(values).all():
                coefficients = COEFFICIENTS @ values
                if np.abs(coefficients[-2:]).max() <= COEFFICIENT_TOL * scale:
                    maximum, fraction = _find_polynomial_maximum(coefficients)
                    self._store_peak(key, maximum, low + fraction * (high - low))
                    break
            if not times[1] > times[0] or (best in (0, len(NODES) - 1) and iteration >= MAX_REFINEMENTS_AT_END):
                break
            low, high = float(times[max(best - 1, 0)]), float(times[min(best + 1, len(NODES) - 1)])

    def _refine_unresolved_interval(self, name: str, k: int, scale: float) -> None:
        """Sample a series between states k and k + 1 on intervals that are halved until polynomials resolve it.

        Maxima above the known peak are refined and stored. A series that needs too many intervals is recorded in
        `unresolved`. `scale`: size of its values.
        """
        intervals, n_sampled = self.interpolant.steps.t[np.newaxis, k : k + 2], 0
        while len(intervals) and n_sampled < MAX_HALVED_INTERVALS:
            n_sampled += len(intervals)
            low, high = intervals[:, :1], intervals[:, 1:]
            times = low + NODES * (high - low)
            values = self.interpolant.evaluate_series_between_states(k, times.ravel(), name).reshape(times.shape)
            is_finite = np.asarray(np.isfinite(values).all(axis=1))
            coefficients = np.where(is_finite[:, np.newaxis], values, 0.0) @ COEFFICIENTS.T
            is_unresolved = np.abs(coefficients[:, -2:]).max(axis=1) > RESOLUTION_TOL * scale
            is_unresolved &= times[:, 1] > times[:, 0]
            for j in np.flatnonzero(is_finite & ~is_unresolved).tolist():
                for sign in (1, -1):
                    if _find_polynomial_maximum(sign * coefficients[j])[0] + RESOLUTION_TOL * scale > self._get_peak(
                        name, sign
                    ):
                        self._refine_maximum((name, False, sign), k, [self.interpolant], scale, (low[j, 0], high[j, 0]))
            middle = 0.5 * (low + high)
            intervals = np.concatenate(
                [np.hstack([low, middle])[is_unresolved], np.hstack([middle, high])[is_unresolved]]
            )
        if len(intervals):
            self.unresolved.add(name)

    def _find_largest_acceleration(self, name: str) -> float:
        """Return the largest finite acceleration of the block in the unit of a series (m/s² or rad/s²); 0 for other
        units.
        """
        kinds = {"m/s^2": [0, 1], "rad/s^2": [2]}.get(self.interpolant.catalogue[name].unit, [])
        a = np.abs(self.interpolant.run.a[1:]).reshape(-1, self.interpolant.compiled.n // 3, 3)[:, :, kinds]
        return float(a[np.isfinite(a)].max(initial=0.0))

    def _get_peak(self, name: str, sign: int) -> float:
        """Return the largest known value of sign times a series; −infinity if there is none."""
        return self.best.get((name, False, sign), (-math.inf, 0.0))[0]

    def _store_peak(self, key: tuple[str, bool, int], value: float, t: float) -> None:
        """Store a value and its time t (s) as the peak of `key`, if it exceeds the known one by more than rounding.

        `key`: name of the series, whether it is the error, and sign. Values that are not finite are ignored.
        """
        if math.isfinite(value) and (key not in self.best or value - self.best[key][0] > PEAK_TOL * abs(value)):
            self.best[key] = float(value), float(t)


def _find_polynomial_maximum(coefficients: Array) -> tuple[float, float]:
    """Return the maximum over [0, 1] of a polynomial with Chebyshev coefficients `coefficients` (9,), and its position.

    The maximum is found on 129 points and refined by a parabola.
    """
    fine = VALUES_FROM_CHEBYSHEV @ coefficients
    k = int(fine.argmax())
    position = k / (len(fine) - 1)
    if 0 < k < len(fine) - 1:
        second_difference = fine[k - 1] - 2.0 * fine[k] + fine[k + 1]
        position += (
            0.5 * (fine[k - 1] - fine[k + 1]) / second_difference / (len(fine) - 1) if second_difference < 0.0 else 0.0
        )
    return float(max(fine[k], chebval(2.0 * position - 1.0, coefficients))), position


def _subtract_compared_series(series: list[Array]) -> Array:
    """Return the first of these series, minus the second (that of the compared scene) if there are two."""
    return series[0] if len(series) == 1 else series[0] - series[1]


def _find_unresolved_intervals(
    interpolant: RunInterpolant, name: str, values: Array, tolerance: float
) -> NDArray[np.bool_]:
    """Return a mask (K − 1,) of the intervals in which the states do not resolve a series.

    Five states at equal intervals of one step predict the series at INNER_FRACTION of each interval by a polynomial of
    order 4. The series is not resolved where the value differs by more than `tolerance`. Kinematic motions and films
    are not tested.
    """
    is_unresolved = np.zeros(max(len(values) - 1, 0), bool)
    if len(values) < len(PREDICTION_MATRIX) + 1 or interpolant.is_kinematic or interpolant.has_films:
        return is_unresolved
    windows = np.lib.stride_tricks.sliding_window_view
    h = np.where(interpolant.is_within_step, np.diff(interpolant.steps.t), np.nan)
    with np.errstate(invalid="ignore"):
        four = windows(h, len(PREDICTION_MATRIX))
        equal = np.flatnonzero(np.abs(four - four[:, :1]).max(axis=1) < INTERVAL_TOL * four[:, 0])
        if len(equal):
            inner_values = windows(interpolant.evaluate_series_at_inner_fraction(name), len(PREDICTION_MATRIX))[equal]
            predicted = windows(values, len(PREDICTION_MATRIX) + 1)[equal] @ PREDICTION_MATRIX.T
            for k in equal[(np.abs(inner_values - predicted) > tolerance).any(axis=1)].tolist():
                is_unresolved[k : k + len(PREDICTION_MATRIX)] = True
    return is_unresolved


def _estimate_maxima(t: Array, values: Array, is_within_step: NDArray[np.bool_]) -> Array:
    """Return an upper estimate (K − 1,) of a series between states k and k + 1; −∞ if no value exceeds the ends.

    It is the maximum of a parabola through both ends, with twice the second derivative that neighbours show.
    `is_within_step`: mask (K − 1,) of intervals within one step; others give −∞.
    """
    estimates = np.full(max(len(t) - 1, 0), -np.inf)
    if len(t) < 3:
        return estimates
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        h, differences = np.diff(t), np.diff(values)
        curvature = np.abs(np.diff(differences / h)) / (t[2:] - t[:-2]) * 2.0  # at states 1 to K − 2
        curvature = np.where(is_within_step[1:] & is_within_step[:-1] & np.isfinite(curvature), curvature, 0.0)
        curvature_term = 2.0 * np.maximum(np.append(curvature, 0.0), np.insert(curvature, 0, 0.0)) * h**2
        top = 0.5 + differences / curvature_term  # fraction of the interval at which the parabola has its maximum
        height = values[:-1] + differences * top + 0.5 * curvature_term * top * (1.0 - top)
    return np.where(is_within_step & (top > 0.0) & (top < 1.0) & np.isfinite(height), height, estimates)

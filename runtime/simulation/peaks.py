"""Peaks of any series over all steps of a run: `simulate(peaks=["S9.ay"])`.

The time loop shows the states of its steps (integrators/steps.py), ends and places between. Series are evaluated there
as at samples, in bulk, and a block of states is dropped when the next one comes. Between two neighbouring states motion
is the quintic through their positions, velocities and accelerations (C. Hermite, J. reine angew. Math. 84, 1878); its
error is of the order of the method's own, and without a freedom such states are closed on the constraints, which makes
them exact. Where a series may rise above what is known, by its second differences, it is looked at there, closer and
closer, until rounding is left. Nothing is sought across a jump, for both its sides are among the states.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.integrators.adaptive import RTOL
from gudgeon.integrators.steps import Steps
from gudgeon.integrators.trajectory import Problem
from gudgeon.language.wanted import listed
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.results.diagnostics import Extremes
from gudgeon.results.results import Result
from gudgeon.results.unknown import check_series
from gudgeon.simulation.beside import Beside
from gudgeon.simulation.between import Path

if TYPE_CHECKING:
    from gudgeon.simulation.simulation import Simulation

NODES = np.linspace(0.0, 1.0, 9)  # places at which a part of a step is looked at
ROUNDS, AT_AN_END = 16, 4  # of looking closer, each four or eight times as close; fewer where the top is at an end
MOST = 40  # parts of steps of a block that are looked at, the most promising ones first
FLAT = 1e-13  # of the largest value: what is left between the places is rounding


def wanted_peaks(source: KernelSource, peaks: Iterable[str] | None) -> tuple[str, ...]:
    """Names of series whose peaks are wanted: those given, else the scene's. Raises UnknownNameError, BadValueError."""
    if peaks is None:
        return check_series(source, source.peaks)
    names = [peaks] if isinstance(peaks, str) else listed(peaks, "peaks", str, "a list of names of series")
    return check_series(source, names)


class Search:
    """Whoever looks at all steps of one run; `found` says what came of it."""

    def __init__(
        self, compiled: CompiledModel, names: Iterable[str], numbers: tuple[Array, Array, Array],
        beside: Beside | None = None,
    ) -> None:  # fmt: skip
        self.names = tuple(names)
        self.ours = Path(compiled, numbers)
        self.beside = beside  # the scene against which errors are wanted
        self.theirs = Path(beside.compiled, beside.numbers) if beside else None
        self.kinds = [(name, False) for name in self.names]
        if beside:
            self.kinds += [(name, True) for name in self.names if name in beside.names]
        self.best: dict[tuple[str, bool, int], tuple[float, float]] = {}  # (name, error, sign) -> value, time

    @staticmethod
    def of(
        problem: Problem, given: Array, is_given: Array, names: tuple[str, ...], against: Simulation | None
    ) -> Search | None:
        """For a run; None where nothing is wanted."""
        if not names:
            return None
        source, numbers = problem.compiled.source, (problem.p, given, is_given)
        beside = Beside(against, source, problem.p, problem.rtol or RTOL) if against else None
        return Search(problem.compiled, names, numbers, beside)

    def __call__(self, steps: Steps) -> None:
        """The next states of the run."""
        self.ours.take(steps)
        paths = [self.ours]
        if self.theirs and self.beside and (followed := self.beside.follow(steps.t)) is not None:
            self.theirs.take(followed)
            paths.append(self.theirs)
        for name, error in self.kinds:
            if not error or len(paths) == 2:
                self._improve(name, error, paths if error else paths[:1])

    def tell(self, run: Result) -> None:
        """What was found becomes a part of what the run says of itself."""
        notes = (*run.diagnostics.notes, *self.notes())
        run.diagnostics = replace(run.diagnostics, extremes=self.found(), notes=notes)

    def found(self) -> tuple[Extremes, ...]:
        """Peaks, then errors, of what was shown."""
        unknown = (math.nan, math.nan)
        told = []
        for name, error in self.kinds:
            if error and self.beside and self.beside.lost:
                continue
            high, low = (self.best.get((name, error, sign), unknown) for sign in (1, -1))
            against = self.beside.scene if error and self.beside else ""
            told.append(Extremes(name, self.ours.catalogue[name].unit, *high, -low[0], low[1], against))
        return tuple(told)

    def notes(self) -> tuple[str, ...]:
        """What the run should say of it."""
        told = []
        if self.ours.lost:
            told.append(f"peaks: {self.ours.lost} states of steps have no accelerations (dead centres) and are left out")
        if self.beside and self.beside.lost:
            told.append(f"errors over all steps are not known: scene {self.beside.scene}: {self.beside.lost}")
        return tuple(told)

    def _improve(self, name: str, error: bool, paths: list[Path]) -> None:
        """What the present states, and what lies between them, say of one series."""
        values = _less([path.values(name) for path in paths])
        t, first = self.ours.steps.t, self.ours.inner
        for sign in (1, -1):
            key = (name, error, sign)
            if np.isfinite(sign * values).any():
                k = int(np.nanargmax(np.where(np.isfinite(values), sign * values, -np.inf)))
                self._note(key, float(sign * values[k]), float(t[k]))
            rises = _may_rise(t, sign * values, first)
            for k in np.argsort(-rises, kind="stable")[:MOST].tolist():
                if not rises[k] > self.best.get(key, (-math.inf, 0.0))[0]:
                    break
                self._look_closer(key, k, paths)

    def _look_closer(self, key: tuple[str, bool, int], k: int, paths: list[Path]) -> None:
        """The top between states k and k + 1."""
        low, high = self.ours.steps.t[k : k + 2].tolist()
        for turn in range(ROUNDS):
            times = low + NODES * (high - low)
            values = key[2] * _less([path.between(k, times, key[0]) for path in paths])
            known = np.where(np.isfinite(values), values, -np.inf)
            best = int(known.argmax())
            self._note(key, float(known[best]), float(times[best]))
            spread = known[best] - known.min()
            if not spread > FLAT * abs(known[best]) or not times[1] > times[0]:
                break
            if best in (0, len(NODES) - 1) and turn >= AT_AN_END:
                break
            low, high = float(times[max(best - 1, 0)]), float(times[min(best + 1, len(NODES) - 1)])

    def _note(self, key: tuple[str, bool, int], value: float, t: float) -> None:
        if value > self.best.get(key, (-math.inf, 0.0))[0]:
            self.best[key] = value, t


def _less(values: list[Array]) -> Array:
    """A series, or less that of another scene."""
    return values[0] if len(values) == 1 else values[0] - values[1]


def _may_rise(t: Array, values: Array, inner: Array) -> Array:
    """How high a series may be between states k and k + 1, (K − 1,); −∞ where nothing is sought.

    A parabola rises above the higher one of two ends by h²/8 of its second rate at most; twice what differences say of
    that is allowed for. `inner` (K − 1,): parts of one step.
    """
    out = np.full(max(len(t) - 1, 0), -np.inf)
    if len(t) < 3:
        return out
    with np.errstate(invalid="ignore", divide="ignore"):
        h = np.diff(t)
        slopes = np.diff(values) / h
        bend = np.abs(np.diff(slopes)) / (t[2:] - t[:-2]) * 2.0  # at states 1 to K − 2
    bend = np.where(inner[1:] & inner[:-1] & np.isfinite(bend), bend, 0.0)
    most = np.maximum(np.append(bend, 0.0), np.insert(bend, 0, 0.0))
    top = np.maximum(values[1:], values[:-1]) + 2.0 * most * h**2 / 8.0
    return np.where(inner & (most > 0.0) & np.isfinite(top), top, out)

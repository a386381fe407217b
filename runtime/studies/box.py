"""Judge a box of parameters: all its corners and Sobol points in it, by a long run and two runs over a window.

Two criteria apply to a point. A run over the whole time must remain valid: finite, closed, energy accounted for, no
contact lost. It must also agree with a hundred times tighter tolerance over a window that ends half-way between the
fourth onset and the next.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.integrators.trajectory import Progress
from gudgeon.language.argument_checks import number_of
from gudgeon.model.compiled import Array
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.runs import ONSETS, Attempt, Parameters, Setting, Work, apart
from gudgeon.studies.verdicts import Cell, Limits, Pair, judge, limits_of

FINER = 100.0
SEED = 20  # of Sobol's scrambling
SAMPLES = 1000  # of the window
DENSE = 10_000  # samples of the long run, in which a missed contact shows
TIGHT = 1e-10
MARGIN = 10.0  # errors need not fall with the tolerance as exactly as that
PATIENCE = 10.0  # the finer run may take so many times longer


@dataclass(frozen=True)
class Range:
    """An edge of the box, on a logarithmic scale, SI; `names` move together, and the first has these values."""

    name: str
    low: float
    high: float
    unit: str = ""

    def __post_init__(self) -> None:
        """Raise BadValueError unless 0 < low ≤ high."""
        if not 0.0 < number_of(self.low, f"range {self.name}") <= number_of(self.high, f"range {self.name}"):
            raise BadValueError(f"range {self.name}={self.low:g}..{self.high:g}: expected 0 < low ≤ high")

    def at(self, share: float) -> float:
        """Return the value at a fraction of the edge, exactly its ends at 0 and 1."""
        if share in (0.0, 1.0):
            return (self.low, self.high)[int(share)]
        return self.low * (self.high / self.low) ** share


def corners(ranges: Sequence[Range]) -> list[dict[str, float]]:
    """Return all 2^n corners of the box, the last range fastest."""
    return [_point_at(ranges, shares) for shares in itertools.product((0.0, 1.0), repeat=len(ranges))]


def sobol(ranges: Sequence[Range], count: int) -> list[dict[str, float]]:
    """Return the first `count` scrambled Sobol points (A. B. Owen, J. Complexity 14, 1998), always the same."""
    from scipy.stats import qmc

    if count < 1 or not ranges:
        return []
    shares = qmc.Sobol(len(ranges), seed=SEED).random_base2(max(0, math.ceil(math.log2(count))))
    return [_point_at(ranges, row) for row in shares[:count].tolist()]


def _point_at(ranges: Sequence[Range], shares: Sequence[float]) -> dict[str, float]:
    """Return the values at the fractions of all edges."""
    return {edge.name: edge.at(share) for edge, share in zip(ranges, shares, strict=True)}


def judge_point(
    simulation: Simulation,
    parameters: Parameters,
    t_end: float,
    setting: Setting,
    limits: Limits | None = None,
    limit: float = math.inf,
    progress: Progress | None = None,
) -> Cell:
    """Return the verdict on one point of a box over [0, t_end] (s).

    `limit` (s) bounds the processor time of its long run.
    """
    work, limits = Work(simulation, t_end, parameters, limit=limit), limits or limits_of(setting)
    long = work.sampled(setting, np.linspace(0.0, t_end, DENSE + 1), progress)
    if long.failure or long.run is None:
        return judge(parameters, long, [], limits)
    patient = replace(work, limit=PATIENCE * limit)
    times = predictable_times(long.run)
    pair = _run_pair(patient, setting, times)
    cell = judge(parameters, long, [pair], limits)
    if cell.failed and cell.error.beyond(limits.motion, limits.path, limits.force):
        kept = times[: _count_predictable_samples(patient, pair[1], limits)]
        cell = judge(parameters, long, [_run_pair(patient, setting, kept)] if len(kept) > 1 else [], limits)
    return cell


def predictable_times(run: Result) -> Array:
    """Return the times (s) of a comparison: up to half-way between the fourth onset and the next, or over the whole
    run.
    """
    onsets = np.sort(run.impacts["t_on"])
    end = float(onsets[ONSETS - 1] + onsets[ONSETS]) / 2 if len(onsets) > ONSETS else float(run.t[-1])
    return np.linspace(0.0, end, SAMPLES + 1)


def _run_pair(work: Work, setting: Setting, times: Array) -> Pair:
    """Run a setting and a finer one at the same times."""
    return work.sampled(setting, times), work.sampled(setting.finer(FINER), times)


def _count_predictable_samples(work: Work, fine: Attempt, limits: Limits) -> int:
    """Return the number of samples up to which a run can agree with the finer run `fine`.

    Joints in lasting contact may amplify differences like impacts. The amplification is a property of the motion, not
    of the tolerance. Two runs at very tight tolerances are compared. From the sample on at which they differ by more
    than the limits over the ratio of their tolerances, no run can meet the limits.
    """
    if fine.run is None:
        return SAMPLES + 1
    first = replace(fine.setting, value=min(fine.setting.value, TIGHT))
    a, b = (work.sampled(setting, fine.run.t) for setting in (first, first.finer(FINER)))
    if a.run is None or b.run is None or a.failure or b.failure:
        return SAMPLES + 1
    bounds = (limits.motion, limits.path, limits.force)
    over = np.any([gap > x / (MARGIN * FINER) for gap, x in zip(apart(a.run, b.run), bounds, strict=True)], axis=0)
    return int(np.argmax(over)) if over.any() else SAMPLES + 1

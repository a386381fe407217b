"""A box of parameters: all its corners and Sobol points in it, each judged by two runs and a window.

Two questions are asked of a point. Does a run over the whole time stay sane (finite, closed, its energy
accounted for, no contact lost)? And does it agree with a hundred times tighter tolerance as far as
contacts let anything be predicted: up to half-way between the fourth onset and the next?
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gudgeon.errors import BadValueError
from gudgeon.integrators.trajectory import Progress
from gudgeon.language.wanted import number_of
from gudgeon.model.compiled import Array
from gudgeon.results.results import Result
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.runs import ONSETS, Attempt, Parameters, Setting, Work, apart
from gudgeon.studies.verdicts import Cell, Limits, Pair, judge, limits_of

FINER = 100.0
SEED = 20  # of Sobol's scrambling
SAMPLES = 1000  # of the window
DENSE = 10_000  # of the long run: what a missed contact would be seen by
TIGHT = 1e-10
MARGIN = 10.0  # errors need not fall with the tolerance as exactly as that
PATIENCE = 10.0  # the finer run may take so many times longer


@dataclass(frozen=True)
class Range:
    """One edge of the box, on a logarithmic scale, SI; `names` move together: the first has these values."""

    name: str
    low: float
    high: float
    unit: str = ""

    def __post_init__(self) -> None:
        if not 0.0 < number_of(self.low, f"range {self.name}") <= number_of(self.high, f"range {self.name}"):
            raise BadValueError(f"range {self.name}={self.low:g}..{self.high:g}: expected 0 < low ≤ high")

    def at(self, share: float) -> float:
        """Its ends exactly at 0 and 1."""
        if share in (0.0, 1.0):
            return (self.low, self.high)[int(share)]
        return self.low * (self.high / self.low) ** share


def corners(ranges: Sequence[Range]) -> list[dict[str, float]]:
    """All 2^n of them, the last range fastest."""
    return [_point(ranges, shares) for shares in itertools.product((0.0, 1.0), repeat=len(ranges))]


def sobol(ranges: Sequence[Range], count: int) -> list[dict[str, float]]:
    """The first `count` scrambled Sobol points (A. B. Owen, J. Complexity 14, 1998), the same every time."""
    from scipy.stats import qmc

    if count < 1 or not ranges:
        return []
    shares = qmc.Sobol(len(ranges), seed=SEED).random_base2(max(0, math.ceil(math.log2(count))))
    return [_point(ranges, row) for row in shares[:count].tolist()]


def _point(ranges: Sequence[Range], shares: Sequence[float]) -> dict[str, float]:
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
    """One point of a box over [0, t_end] (s); `limit` (s) of processor time for its long run."""
    work, limits = Work(simulation, t_end, parameters, limit=limit), limits or limits_of(setting)
    long = work.sampled(setting, np.linspace(0.0, t_end, DENSE + 1), progress)
    if long.failure or long.run is None:
        return judge(parameters, long, [], limits)
    patient = replace(work, limit=PATIENCE * limit)
    times = predictable(long.run)
    pair = _pair(patient, setting, times)
    cell = judge(parameters, long, [pair], limits)
    if cell.failed and cell.error.beyond(limits.motion, limits.path, limits.force):
        kept = times[: _horizon(patient, pair[1], limits)]
        cell = judge(parameters, long, [_pair(patient, setting, kept)] if len(kept) > 1 else [], limits)
    return cell


def predictable(run: Result) -> Array:
    """Times (s) of a comparison: up to half-way between the fourth onset and the next, or all of the run."""
    onsets = np.sort(run.impacts["t_on"])
    end = float(onsets[ONSETS - 1] + onsets[ONSETS]) / 2 if len(onsets) > ONSETS else float(run.t[-1])
    return np.linspace(0.0, end, SAMPLES + 1)


def _pair(work: Work, setting: Setting, times: Array) -> Pair:
    return work.sampled(setting, times), work.sampled(setting.finer(FINER), times)


def _horizon(work: Work, fine: Attempt, limits: Limits) -> int:
    """How many samples say anything about a run that disagrees with the finer one, `fine`.

    Joints that stay in contact may multiply differences as impacts do. What multiplies them is a matter of the
    motion, not of the tolerance. So two runs at tolerances that nobody could call loose are compared, and where they
    come apart by more than the limits over the ratio of their tolerances, no run can be asked to keep the limits.
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

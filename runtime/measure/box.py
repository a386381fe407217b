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

from gudgeon.compiled import Array
from gudgeon.errors import BadValueError
from gudgeon.integrators.trajectory import Progress
from gudgeon.measure.cells import Cell, Limits, Pair, judge
from gudgeon.measure.work import ONSETS, Attempt, Parameters, Setting, Work
from gudgeon.simulation import Simulation

FINER = 100.0
SEED = 20  # of Sobol's scrambling
SAMPLES = 1000  # of the window
DENSE = 10_000  # of the long run: what a missed contact would be seen by
PATIENCE = 10.0  # the finer run may take so many times longer


@dataclass(frozen=True)
class Range:
    """One edge of the box, on a logarithmic scale, SI; `names` move together: the first has these values."""

    name: str
    low: float
    high: float

    def __post_init__(self) -> None:
        if not 0.0 < self.low <= self.high < math.inf:
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
    simulation: Simulation, parameters: Parameters, t_end: float, setting: Setting, limits: Limits | None = None,
    limit: float = math.inf, progress: Progress | None = None,
) -> Cell:  # fmt: skip
    """One point of a box over [0, t_end] (s); `limit` (s) of processor time for its long run."""
    work = Work(simulation, t_end, parameters, limit=limit)
    long = work.sampled(setting, np.linspace(0.0, t_end, DENSE + 1), progress)
    fails = bool(long.failure) or long.run is None
    return judge(parameters, long, [] if fails else [_pair(work, long)], limits)


def _pair(work: Work, long: Attempt) -> Pair:
    """The window that can be predicted, as it was run and with the finer setting."""
    fine = long.setting.finer(FINER)
    patient = replace(work, limit=PATIENCE * work.limit)
    assert long.run is not None
    onsets = np.sort(long.run.impacts["t_on"])
    if len(onsets) <= ONSETS:
        return long, patient.sampled(fine, long.run.t)
    times: Array = np.linspace(0.0, float(onsets[ONSETS - 1] + onsets[ONSETS]) / 2, SAMPLES + 1)
    return patient.sampled(long.setting, times), patient.sampled(fine, times)

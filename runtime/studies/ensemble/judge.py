"""What runs say of a claim: the probability that the next run of each scene shows it, over all combinations of runs.

Of few runs it is known to an interval only. A verdict is what the interval carries: holds, where all of it lies at 0.8
or above, fails, where all of it lies at 1/3 or below; what lies across, or between, is undecided. So ensembles of one
distribution contradict each other as seldom as the intervals say, wherever the probability lies.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass, replace
from statistics import NormalDist
from typing import TypeAlias

import numpy as np

from gudgeon.results.batch import Array

HOLDS, FAILS = 0.8, 1.0 / 3.0  # probabilities from and up to which a claim holds, and fails
MOST = 1 << 20  # combinations that are looked at, one by one; of more as many drawn ones
DOUBT = 0.05  # probability that a verdict rests on chance: each end of an interval is passed by so many
PLACES = ""  # in the place of a measure: which runs of a cell have all that is asked of it
VERDICTS = ("holds", "fails", "undecided")


@dataclass(frozen=True)
class Cell:
    """Runs that differ in their starts alone: a part, and places along its other dimensions."""

    part: str
    index: tuple[int, ...]


Look: TypeAlias = Callable[[int, str], Array]  # number of a check's cell, measure -> values of the runs in it
Runs: TypeAlias = Mapping[Cell, Mapping[str, Array]]  # measure -> (n,)


@dataclass(frozen=True, eq=False)
class Check:
    """Something that one run of each of some cells shows, or does not."""

    cells: tuple[Cell, ...]
    measures: tuple[str, ...]
    shows: Callable[[Look], Array]


@dataclass(frozen=True)
class Judged:
    """A claim that consists of checks: the least of their probabilities, and that single runs show all of them.

    `low`, `high`: the interval of that check. `denied`: verdicts that the intervals rule out.
    """

    verdict: str
    probability: float
    low: float
    high: float
    chance: float
    denied: frozenset[str]
    estimates: tuple[Estimate, ...]  # of each check


@dataclass(frozen=True)
class Estimate:
    """A probability as so many independent trials would tell it; without scatter these are infinitely many.

    `runs`: of the cell that has fewest. `again`, `again_runs`: trials and runs of those cells alone whose runs are the
    same in every ensemble.
    """

    p: float
    trials: float
    runs: float = math.inf
    again: float = math.inf
    again_runs: float = math.inf

    def bound(self, side: float, doubt: float = DOUBT) -> float:
        """The end of the interval below (-1) or above (1) that is passed with a probability of about `doubt`.

        E. B. Wilson, J. Am. Stat. Assoc. 22, 1927. Nothing is surer than what all of the runs show, or none.
        """
        if not math.isfinite(self.trials) or math.isnan(self.p):
            return self.p
        ends = _wilson(self.p, self.trials, side, doubt), _wilson(0.5 - 0.5 * side, self.runs, side, doubt)
        return max(ends) if side > 0 else min(ends)


def _wilson(p: float, n: float, side: float, doubt: float) -> float:
    z = NormalDist().inv_cdf(1.0 - doubt)
    middle, reach = p + z * z / (2.0 * n), z * math.sqrt(p * (1.0 - p) / n + (z / (2.0 * n)) ** 2)
    return min(max((middle + side * reach) / (1.0 + z * z / n), 0.0), 1.0)


def judged(checks: Sequence[Check], runs: Runs, certain: Container[Cell] = (), again: Container[Cell] = ()) -> Judged:
    """Holds where each check is likely, fails where one is unlikely, as far as that is known.

    A probability is that of independent runs, one of each cell, estimated by all combinations of the runs that there
    are: of two cells by all pairs (H. B. Mann, D. R. Whitney, Ann. Math. Stat. 18, 1947), ties count as not larger.
    NaN, and undecided, where a cell has no run with all of the measures. certain: cells whose runs do not scatter;
    again: cells whose runs are those of other ensembles too.
    """
    whole = _complete(checks, runs)
    chance = math.prod(_seen(group, whole)[0] for group in _together(checks))
    return _of([_estimated(check, whole, certain, again) for check in checks], chance)


def together(each: Sequence[Judged]) -> tuple[Judged, bool]:
    """What several ensembles say of one claim, and whether they agree: what one carries no other rules out.

    Probabilities are means over the ensembles, and their trials add up, but for runs that several of them have;
    ensembles that do not agree decide nothing.
    """
    mean = math.fsum(one.chance for one in each) / len(each)
    both = _of([_mean(several) for several in zip(*(one.estimates for one in each), strict=True)], mean)
    agreed = not any(one.verdict in other.denied for one in each for other in each)
    return (both if agreed else replace(both, verdict="undecided")), agreed


def _mean(several: Sequence[Estimate]) -> Estimate:
    """Variances of what each ensemble has for itself, 1/trials - 1/again, shrink as ensembles are many."""
    p, again = (math.fsum(values) / len(several) for values in zip(*((x.p, x.again) for x in several), strict=True))
    rests = [1.0 / one.trials - 1.0 / one.again for one in several]
    alone = math.inf if min(rests) <= 0.0 else math.fsum(1.0 / rest for rest in rests)
    trials = math.inf if alone == again == math.inf else 1.0 / (1.0 / alone + 1.0 / again)
    again_runs = min(one.again_runs for one in several)
    return Estimate(p, trials, min(math.fsum(one.runs for one in several), again_runs), again, again_runs)


def _of(each: Sequence[Estimate], chance: float) -> Judged:
    """All checks are likely where each is; that any of many is unlikely is sooner so by chance (Bonferroni)."""
    if not each or any(math.isnan(one.p) for one in each):
        return Judged("undecided", math.nan, math.nan, math.nan, chance, frozenset(), tuple(each))
    low = min(one.bound(-1.0) for one in each)
    high = min(one.bound(1.0, DOUBT / len(each)) for one in each)
    least = min(each, key=lambda one: one.p)
    verdict = "fails" if high <= FAILS else "holds" if low >= HOLDS else "undecided"
    denied = frozenset(name for name, is_so in (("holds", high < HOLDS), ("fails", low > FAILS)) if is_so)
    return Judged(verdict, least.p, least.bound(-1.0), least.bound(1.0), chance, denied, tuple(each))


def _complete(checks: Sequence[Check], runs: Runs) -> Runs:
    """Runs of each cell that have all that is asked of it."""
    asked: dict[Cell, dict[str, None]] = {}
    for check in checks:
        for cell in check.cells:
            asked.setdefault(cell, {}).update(dict.fromkeys(check.measures))
    found = {}
    for cell, measures in asked.items():
        own = {name: runs[cell][name] for name in measures}
        good = np.logical_and.reduce([np.isfinite(values) for values in own.values()])
        found[cell] = {name: values[good] for name, values in own.items()} | {PLACES: np.flatnonzero(good)}
    return found


def _estimated(check: Check, runs: Runs, certain: Container[Cell], again: Container[Cell]) -> Estimate:
    """As many trials as the shares of single runs of each cell vary like (W. Hoeffding, Ann. Math. Stat. 19, 1948)."""
    p, shown, chosen = _seen([check], runs)
    shares = {cell: _shares(own, shown, runs[cell][PLACES]) for cell, own in chosen.items() if cell not in certain}
    if not shares or math.isnan(p):
        return Estimate(p, math.inf)
    most = sum(int(np.isfinite(own).sum()) for own in shares.values())
    several = [own for cell, own in shares.items() if cell in again]
    return Estimate(p, *_trials(p, list(shares.values()), most), *_trials(p, several, most))


def _shares(chosen: Array, shown: Array, places: Array) -> Array:
    """Of each run of a cell the share of its combinations that shows it; NaN where the run is not there."""
    found, seen = np.full(int(places.max()) + 1, np.nan), np.bincount(chosen, minlength=len(places))
    with np.errstate(invalid="ignore"):
        found[places] = np.bincount(chosen, shown, len(places)) / seen
    return found


def _trials(p: float, shares: Sequence[Array], most: int) -> tuple[float, float]:
    """Independent trials, and runs of the cell that has fewest, of a probability with these shares of its cells.

    Runs of two cells may have the same deviations: where their shares go the same way, their variances add up to more.
    """
    if not shares:
        return math.inf, math.inf
    counts = [int(np.isfinite(own).sum()) for own in shares]
    variance = math.fsum(_covariance(own, own) for own in shares)
    if variance <= 0.0:
        return min(counts), min(counts)
    variance += max(2.0 * math.fsum(_covariance(a, b) for a, b in itertools.combinations(shares, 2)), 0.0)
    return min(p * (1.0 - p) / variance, most), min(counts)


def _covariance(a: Array, b: Array) -> float:
    """Of two means, of what has the same place in both."""
    counts, length = (np.isfinite(a).sum(), np.isfinite(b).sum()), min(len(a), len(b))
    both = np.isfinite(a[:length]) & np.isfinite(b[:length])
    n = int(both.sum())
    if n < 2:
        return 0.0
    return float(np.cov(a[:length][both], b[:length][both])[0, 1]) * n / float(counts[0] * counts[1])


def _seen(checks: Sequence[Check], runs: Runs) -> tuple[float, Array, dict[Cell, Array]]:
    """Of the combinations of one run of each cell: the share that shows all of the checks, which do, which runs."""
    cells = list(dict.fromkeys(cell for check in checks for cell in check.cells))
    sizes = [len(next(iter(runs[cell].values()))) for cell in cells]
    if not all(sizes):
        return math.nan, np.zeros(0), {}
    chosen = dict(zip(cells, _combinations(sizes), strict=True))
    shown = np.ones(len(chosen[cells[0]]) if cells else 1, dtype=bool)
    for check in checks:

        def look(k: int, name: str, check: Check = check) -> Array:
            cell = check.cells[k]
            return runs[cell][name][chosen[cell]]

        shown = shown & check.shows(look)
    return float(np.mean(shown)), shown, chosen


def _combinations(sizes: Sequence[int]) -> Sequence[Array]:
    """Of each cell which run: all combinations, or MOST of them drawn."""
    count = math.prod(sizes)
    if count <= MOST:
        return np.unravel_index(np.arange(count), tuple(sizes)) if sizes else ()
    rng = np.random.default_rng(0)
    return [rng.integers(0, size, MOST) for size in sizes]


def _together(checks: Sequence[Check]) -> list[list[Check]]:
    """Checks that share cells, directly or by others: what one group shows is independent of the next."""
    groups: list[tuple[set[Cell], list[Check]]] = []
    for check in checks:
        cells, own = set(check.cells), [check]
        apart = []
        for group in groups:
            if group[0] & cells:
                cells |= group[0]
                own = group[1] + own
            else:
                apart.append(group)
        groups = [*apart, (cells, own)]
    return [own for _, own in groups]

"""Estimate the probability that the next run of each scene shows a claim, from all combinations of runs, and its
verdict.

From few runs the probability is known as an interval only. The verdict is "holds" if the whole interval lies at 0.8 or
above, "fails" if it lies at 1/3 or below, else "undecided". Ensembles of one distribution therefore contradict each
other only as often as the intervals allow.
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
MOST = 1 << 20  # combinations that are evaluated one by one; of more, so many random ones
DOUBT = 0.05  # probability beyond each end of an interval
PLACES = ""  # in place of a measure: indices of the runs of a cell that have all measures
VERDICTS = ("holds", "fails", "undecided")


@dataclass(frozen=True)
class Cell:
    """Runs that differ in their starts only: a part, and indices along its other dimensions."""

    part: str
    index: tuple[int, ...]


Look: TypeAlias = Callable[[int, str], Array]  # number of a check's cell, measure -> values of the runs in it
Runs: TypeAlias = Mapping[Cell, Mapping[str, Array]]  # measure -> (n,)


@dataclass(frozen=True, eq=False)
class Check:
    """A condition on one run of each of some cells."""

    cells: tuple[Cell, ...]
    measures: tuple[str, ...]
    shows: Callable[[Look], Array]


@dataclass(frozen=True)
class Judged:
    """Verdict on a claim of several checks: the least of their probabilities, and the chance that single runs meet all.

    `low`, `high`: the interval of the least likely check. `denied`: verdicts that the intervals rule out.
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
    """A probability with the equivalent number of independent trials; infinite if the runs do not scatter.

    `runs`: runs of the smallest cell. `again`, `again_runs`: trials and runs of those cells alone whose runs are the
    same in every ensemble.
    """

    p: float
    trials: float
    runs: float = math.inf
    again: float = math.inf
    again_runs: float = math.inf

    def bound(self, side: float, doubt: float = DOUBT) -> float:
        """Return the end of the interval below (side −1) or above (1) that is exceeded with probability `doubt`.

        E. B. Wilson, J. Am. Stat. Assoc. 22, 1927. The interval is at least that of runs that all, or none, meet the
        condition.
        """
        if not math.isfinite(self.trials) or math.isnan(self.p):
            return self.p
        ends = _wilson_bound(self.p, self.trials, side, doubt), _wilson_bound(0.5 - 0.5 * side, self.runs, side, doubt)
        return max(ends) if side > 0 else min(ends)


def _wilson_bound(p: float, n: float, side: float, doubt: float) -> float:
    """Return an end of Wilson's interval for a probability p from n trials."""
    z = NormalDist().inv_cdf(1.0 - doubt)
    middle, reach = p + z * z / (2.0 * n), z * math.sqrt(p * (1.0 - p) / n + (z / (2.0 * n)) ** 2)
    return min(max((middle + side * reach) / (1.0 + z * z / n), 0.0), 1.0)


def judged(checks: Sequence[Check], runs: Runs, certain: Container[Cell] = (), again: Container[Cell] = ()) -> Judged:
    """Return the verdict on a claim: it holds if each check is likely, fails if one is unlikely, as far as is known.

    A probability is that of independent runs, one of each cell, estimated from all combinations of runs: for two cells
    from all pairs (H. B. Mann, D. R. Whitney, Ann. Math. Stat. 18, 1947); ties count as not larger. It is NaN, and the
    verdict undecided, if a cell has no run with all measures. certain: cells whose runs do not scatter; again: cells
    whose runs other ensembles share.
    """
    whole = _complete_runs(checks, runs)
    chance = math.prod(_evaluate_combinations(group, whole)[0] for group in _group_checks(checks))
    return _verdict_of([_estimate_check(check, whole, certain, again) for check in checks], chance)


def together(each: Sequence[Judged]) -> tuple[Judged, bool]:
    """Return the verdict of several ensembles on one claim, and whether no ensemble rules out the verdict of another.

    Probabilities are means over the ensembles. Their trials add up, except for shared runs. Without agreement the
    verdict is undecided.
    """
    mean = math.fsum(one.chance for one in each) / len(each)
    both = _verdict_of(
        [_mean_estimate(several) for several in zip(*(one.estimates for one in each), strict=True)], mean
    )
    agreed = not any(one.verdict in other.denied for one in each for other in each)
    return (both if agreed else replace(both, verdict="undecided")), agreed


def _mean_estimate(several: Sequence[Estimate]) -> Estimate:
    """Return the mean of the estimates of several ensembles.

    Variances of the ensembles' separate runs, 1/trials − 1/again, decrease with their number; those of shared runs do
    not.
    """
    p, again = (math.fsum(values) / len(several) for values in zip(*((x.p, x.again) for x in several), strict=True))
    rests = [1.0 / one.trials - 1.0 / one.again for one in several]
    alone = math.inf if min(rests) <= 0.0 else math.fsum(1.0 / rest for rest in rests)
    trials = math.inf if alone == again == math.inf else 1.0 / (1.0 / alone + 1.0 / again)
    again_runs = min(one.again_runs for one in several)
    return Estimate(p, trials, min(math.fsum(one.runs for one in several), again_runs), again, again_runs)


def _verdict_of(each: Sequence[Estimate], chance: float) -> Judged:
    """Return the verdict from the estimates of all checks.

    It holds if each check is likely; to fail, the bound of each check is corrected for their number (Bonferroni).
    """
    if not each or any(math.isnan(one.p) for one in each):
        return Judged("undecided", math.nan, math.nan, math.nan, chance, frozenset(), tuple(each))
    low = min(one.bound(-1.0) for one in each)
    high = min(one.bound(1.0, DOUBT / len(each)) for one in each)
    least = min(each, key=lambda one: one.p)
    verdict = "fails" if high <= FAILS else "holds" if low >= HOLDS else "undecided"
    denied = frozenset(name for name, is_so in (("holds", high < HOLDS), ("fails", low > FAILS)) if is_so)
    return Judged(verdict, least.p, least.bound(-1.0), least.bound(1.0), chance, denied, tuple(each))


def _complete_runs(checks: Sequence[Check], runs: Runs) -> Runs:
    """Return the runs of each cell that have all measures of the checks."""
    requested: dict[Cell, dict[str, None]] = {}
    for check in checks:
        for cell in check.cells:
            requested.setdefault(cell, {}).update(dict.fromkeys(check.measures))
    found = {}
    for cell, measures in requested.items():
        own = {name: runs[cell][name] for name in measures}
        good = np.logical_and.reduce([np.isfinite(values) for values in own.values()])
        found[cell] = {name: values[good] for name, values in own.items()} | {PLACES: np.flatnonzero(good)}
    return found


def _estimate_check(check: Check, runs: Runs, certain: Container[Cell], again: Container[Cell]) -> Estimate:
    """Return the estimate of a check.

    The number of trials follows from the variance of the fractions of single runs of each cell (W. Hoeffding, Ann.
    Math. Stat. 19, 1948).
    """
    p, shown, selected = _evaluate_combinations([check], runs)
    shares = {
        cell: _fractions_by_run(own, shown, runs[cell][PLACES]) for cell, own in selected.items() if cell not in certain
    }
    if not shares or math.isnan(p):
        return Estimate(p, math.inf)
    most = sum(int(np.isfinite(own).sum()) for own in shares.values())
    several = [own for cell, own in shares.items() if cell in again]
    return Estimate(p, *_effective_trials(p, list(shares.values()), most), *_effective_trials(p, several, most))


def _fractions_by_run(selected: Array, shown: Array, places: Array) -> Array:
    """Return for each run of a cell the fraction of its combinations that meets the check; NaN for a missing run."""
    found, seen = np.full(int(places.max()) + 1, np.nan), np.bincount(selected, minlength=len(places))
    with np.errstate(invalid="ignore"):
        found[places] = np.bincount(selected, shown, len(places)) / seen
    return found


def _effective_trials(p: float, shares: Sequence[Array], most: int) -> tuple[float, float]:
    """Return the independent trials, and the runs of the smallest cell, for a probability with these fractions of its
    cells.

    Runs of two cells may have the same deviations: if their fractions are correlated, the covariance adds to the
    variance.
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
    """Return the covariance of the means of two arrays, from entries with the same index."""
    counts, length = (np.isfinite(a).sum(), np.isfinite(b).sum()), min(len(a), len(b))
    both = np.isfinite(a[:length]) & np.isfinite(b[:length])
    n = int(both.sum())
    if n < 2:
        return 0.0
    return float(np.cov(a[:length][both], b[:length][both])[0, 1]) * n / float(counts[0] * counts[1])


def _evaluate_combinations(checks: Sequence[Check], runs: Runs) -> tuple[float, Array, dict[Cell, Array]]:
    """Return the fraction of combinations of runs that meet all checks, which ones do, and the chosen runs of each
    cell.
    """
    cells = list(dict.fromkeys(cell for check in checks for cell in check.cells))
    sizes = [len(next(iter(runs[cell].values()))) for cell in cells]
    if not all(sizes):
        return math.nan, np.zeros(0), {}
    selected = dict(zip(cells, _combinations(sizes), strict=True))
    shown = np.ones(len(selected[cells[0]]) if cells else 1, dtype=bool)
    for check in checks:

        def look(k: int, name: str, check: Check = check) -> Array:
            """Return a measure of the runs of a check's cell k in all combinations."""
            cell = check.cells[k]
            return runs[cell][name][selected[cell]]

        shown = shown & check.shows(look)
    return float(np.mean(shown)), shown, selected


def _combinations(sizes: Sequence[int]) -> Sequence[Array]:
    """Return for each cell the run in each combination: all combinations, or MOST random ones."""
    count = math.prod(sizes)
    if count <= MOST:
        return np.unravel_index(np.arange(count), tuple(sizes)) if sizes else ()
    rng = np.random.default_rng(0)
    return [rng.integers(0, size, MOST) for size in sizes]


def _group_checks(checks: Sequence[Check]) -> list[list[Check]]:
    """Return groups of checks that share cells, directly or by others; different groups are independent."""
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

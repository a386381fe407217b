"""Estimate the probability that a further run satisfies a published claim, with a confidence interval, and judge it.

The interval is Wilson's. The verdict is "holds" if the whole interval lies at 0.8 or above, "fails" if it lies at 1/3
or below, else "undecided". Ensembles of one distribution therefore disagree only as often as the intervals allow.
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

MIN_P_HOLDS, MAX_P_FAILS = 0.8, 1.0 / 3.0  # minimum probability of a claim that holds, maximum of one that fails
MAX_COMBINATIONS = 1 << 20  # with more combinations, a random sample of this size is evaluated
TAIL_PROBABILITY = 0.05  # probability beyond each end of an interval
RUN_INDICES = ""  # key in place of a measure: indices of the runs of a cell that have all measures
VERDICTS = ("holds", "fails", "undecided")


@dataclass(frozen=True)
class RunCell:
    """A cell of runs, which differ in ensemble and start only: a part, and indices along its other dimensions."""

    part: str
    index: tuple[int, ...]


ReadMeasure: TypeAlias = Callable[[int, str], Array]  # number of a check's cell, measure -> values of the runs in it
Runs: TypeAlias = Mapping[RunCell, Mapping[str, Array]]  # measure -> (n,)


@dataclass(frozen=True, eq=False)
class Check:
    """A condition on one run of each of its cells; several checks make up a claim."""

    cells: tuple[RunCell, ...]
    measures: tuple[str, ...]
    meets_condition: Callable[[ReadMeasure], Array]


@dataclass(frozen=True)
class ClaimVerdict:
    """Verdict on a claim of several checks, with the probability and the interval low … high of its least likely check.

    `chance`: probability that one run of each cell satisfies all checks. `excluded_verdicts`: verdicts that the
    intervals rule out.
    """

    verdict: str
    probability: float
    low: float
    high: float
    chance: float
    excluded_verdicts: frozenset[str]
    estimates: tuple[ProbabilityEstimate, ...]  # one for each check


@dataclass(frozen=True)
class ProbabilityEstimate:
    """An estimated probability p with the equivalent number of independent trials (effective sample size).

    `trials` is infinite if the runs do not scatter. `runs`: number of runs of the smallest cell. `shared_trials`,
    `n_shared_runs`: the same for the cells whose runs are shared by all ensembles.
    """

    p: float
    trials: float
    runs: float = math.inf
    shared_trials: float = math.inf
    n_shared_runs: float = math.inf

    def compute_bound(self, sign: float, tail_probability: float = TAIL_PROBABILITY) -> float:
        """Return the lower (sign −1) or upper (1) end of Wilson's confidence interval of the probability.

        tail_probability: that the true value lies beyond this end. The lower end is at most that of `runs` successes in
        `runs` trials, the upper end at least that of none. Without scatter (infinite trials) or for NaN the end is p.
        """
        if not math.isfinite(self.trials) or math.isnan(self.p):
            return self.p
        ends = (
            _compute_wilson_bound(self.p, self.trials, sign, tail_probability),
            _compute_wilson_bound(0.5 - 0.5 * sign, self.runs, sign, tail_probability),
        )
        return max(ends) if sign > 0 else min(ends)


def _compute_wilson_bound(p: float, n: float, sign: float, tail_probability: float) -> float:
    """Return the lower (sign −1) or upper (1) end of Wilson's score interval for a fraction p of n trials, in [0, 1].

    tail_probability: one-sided probability that the true value lies beyond the end. n need not be a whole number. E. B.
    Wilson, J. Am. Stat. Assoc. 22, 1927.
    """
    z = NormalDist().inv_cdf(1.0 - tail_probability)
    middle, half_width = p + z * z / (2.0 * n), z * math.sqrt(p * (1.0 - p) / n + (z / (2.0 * n)) ** 2)
    return min(max((middle + sign * half_width) / (1.0 + z * z / n), 0.0), 1.0)


def judge_claim(
    checks: Sequence[Check],
    runs: Runs,
    deterministic_cells: Container[RunCell] = (),
    shared_cells: Container[RunCell] = (),
) -> ClaimVerdict:
    """Return the verdict on a claim for one ensemble: it holds if each of its checks is likely, fails if one is
    unlikely.

    The probability of a check is the fraction of combinations of runs, one of each cell, that satisfy it: for two cells
    of all pairs (Mann-Whitney statistic, Ann. Math. Stat. 18, 1947). It is NaN, and the verdict undecided, if a cell
    has no run with all measures. runs: values of the measures by cell. deterministic_cells: cells whose runs do not
    scatter. shared_cells: cells whose runs other ensembles share. The `chance` of the verdict is the product of the
    fractions of combinations that satisfy all checks of each group of connected checks.
    """
    complete_runs = _select_complete_runs(checks, runs)
    chance = math.prod(_evaluate_combinations(group, complete_runs)[0] for group in _group_checks(checks))
    return _combine_estimates(
        [_estimate_check_probability(check, complete_runs, deterministic_cells, shared_cells) for check in checks],
        chance,
    )


def merge_verdicts(verdicts: Sequence[ClaimVerdict]) -> tuple[ClaimVerdict, bool]:
    """Return the common verdict of several ensembles on one claim, and whether the ensembles agree.

    They agree if no ensemble rules out the verdict of another; otherwise the common verdict is undecided. Probabilities
    are means over the ensembles. Their trials add up, except those of shared runs.
    """
    mean_chance = math.fsum(verdict.chance for verdict in verdicts) / len(verdicts)
    common = _combine_estimates(
        [_average_estimates(estimates) for estimates in zip(*(verdict.estimates for verdict in verdicts), strict=True)],
        mean_chance,
    )
    agreed = not any(verdict.verdict in other.excluded_verdicts for verdict in verdicts for other in verdicts)
    return (common if agreed else replace(common, verdict="undecided")), agreed


def _average_estimates(estimates: Sequence[ProbabilityEstimate]) -> ProbabilityEstimate:
    """Return the mean estimate of one check over several ensembles, with the trials of all ensembles together.

    The variance of separate runs, ∝ 1/trials − 1/shared_trials, decreases with the number of ensembles; the variance of
    shared runs does not.
    """
    p, shared_trials = (
        math.fsum(values) / len(estimates) for values in zip(*((x.p, x.shared_trials) for x in estimates), strict=True)
    )
    separate_variances = [1.0 / estimate.trials - 1.0 / estimate.shared_trials for estimate in estimates]
    separate_trials = (
        math.inf if min(separate_variances) <= 0.0 else math.fsum(1.0 / variance for variance in separate_variances)
    )
    trials = (
        math.inf
        if separate_trials == shared_trials == math.inf
        else 1.0 / (1.0 / separate_trials + 1.0 / shared_trials)
    )
    n_shared_runs = min(estimate.n_shared_runs for estimate in estimates)
    return ProbabilityEstimate(
        p, trials, min(math.fsum(estimate.runs for estimate in estimates), n_shared_runs), shared_trials, n_shared_runs
    )


def _combine_estimates(estimates: Sequence[ProbabilityEstimate], chance: float) -> ClaimVerdict:
    """Return the verdict on a claim from the estimates of all its checks.

    The claim holds if the lower bounds of all checks are at least MIN_P_HOLDS. It fails if the upper bound of one
    check, with a tail probability that is divided by the number of checks (Bonferroni), is at most MAX_P_FAILS. It is
    undecided otherwise, without checks, or with a NaN. Failure has precedence.

    In the verdict, the probability and its bounds are those of the check with the lowest p. `excluded_verdicts` are
    the verdicts, "holds" or "fails", that the bounds rule out. chance: the probability that one run of each cell
    satisfies all checks, which the verdict stores.
    """
    if not estimates or any(math.isnan(estimate.p) for estimate in estimates):
        return ClaimVerdict("undecided", math.nan, math.nan, math.nan, chance, frozenset(), tuple(estimates))
    low = min(estimate.compute_bound(-1.0) for estimate in estimates)
    high = min(estimate.compute_bound(1.0, TAIL_PROBABILITY / len(estimates)) for estimate in estimates)
    least_likely = min(estimates, key=lambda estimate: estimate.p)
    verdict = "fails" if high <= MAX_P_FAILS else "holds" if low >= MIN_P_HOLDS else "undecided"
    excluded_verdicts = frozenset(
        name for name, is_excluded in (("holds", high < MIN_P_HOLDS), ("fails", low > MAX_P_FAILS)) if is_excluded
    )
    return ClaimVerdict(
        verdict,
        least_likely.p,
        least_likely.compute_bound(-1.0),
        least_likely.compute_bound(1.0),
        chance,
        excluded_verdicts,
        tuple(estimates),
    )


def _select_complete_runs(checks: Sequence[Check], runs: Runs) -> Runs:
    """Return for each cell of the checks its complete runs: those with finite values of all measures that checks need.

    The result has the values of these measures by cell, and the indices of the complete runs as entry RUN_INDICES.
    """
    measures_by_cell: dict[RunCell, dict[str, None]] = {}
    for check in checks:
        for cell in check.cells:
            measures_by_cell.setdefault(cell, {}).update(dict.fromkeys(check.measures))
    complete_runs = {}
    for cell, measures in measures_by_cell.items():
        cell_values = {name: runs[cell][name] for name in measures}
        is_complete = np.logical_and.reduce([np.isfinite(values) for values in cell_values.values()])
        complete_runs[cell] = {name: values[is_complete] for name, values in cell_values.items()} | {
            RUN_INDICES: np.flatnonzero(is_complete)
        }
    return complete_runs


def _estimate_check_probability(
    check: Check, runs: Runs, deterministic_cells: Container[RunCell], shared_cells: Container[RunCell]
) -> ProbabilityEstimate:
    """Return the probability of a check, with the number of independent trials of the same variance.

    runs: complete runs, with RUN_INDICES. The variance is that of a U-statistic, from the fractions of satisfied
    combinations of single runs (W. Hoeffding, Ann. Math. Stat. 19, 1948). Trials are infinite if all cells are
    deterministic or the probability is NaN.
    """
    p, is_met, selected = _evaluate_combinations([check], runs)
    fractions = {
        cell: _compute_fractions_by_run(cell_values, is_met, runs[cell][RUN_INDICES])
        for cell, cell_values in selected.items()
        if cell not in deterministic_cells
    }
    if not fractions or math.isnan(p):
        return ProbabilityEstimate(p, math.inf)
    max_trials = sum(int(np.isfinite(cell_values).sum()) for cell_values in fractions.values())
    shared_fractions = [cell_values for cell, cell_values in fractions.items() if cell in shared_cells]
    return ProbabilityEstimate(
        p,
        *_estimate_trials(p, list(fractions.values()), max_trials),
        *_estimate_trials(p, shared_fractions, max_trials),
    )


def _compute_fractions_by_run(run_numbers: Array, is_met: Array, indices: Array) -> Array:
    """Return for each run of a cell the fraction of its combinations that satisfies the check; NaN for incomplete runs.

    run_numbers (n_combinations,): number of the cell's complete run in each combination. is_met (n_combinations,):
    whether the combination satisfies the check. indices: index in the cell of each complete run.
    """
    fractions, counts = np.full(int(indices.max()) + 1, np.nan), np.bincount(run_numbers, minlength=len(indices))
    with np.errstate(invalid="ignore"):
        fractions[indices] = np.bincount(run_numbers, is_met, len(indices)) / counts
    return fractions


def _estimate_trials(p: float, fractions: Sequence[Array], max_trials: int) -> tuple[float, float]:
    """Return the effective number of independent trials of a probability p, and the number of runs of the smallest
    cell.

    fractions: satisfied fraction of each run, an array for each cell. trials = p(1 − p)/variance, at most `max_trials`;
    a positive covariance of two cells, as with equal deviations, adds to the variance. If no fraction scatters, the
    trials are the runs of the smallest cell. Both results are infinite without cells.
    """
    if not fractions:
        return math.inf, math.inf
    counts = [int(np.isfinite(values).sum()) for values in fractions]
    variance = math.fsum(_compute_mean_covariance(values, values) for values in fractions)
    if variance <= 0.0:
        return min(counts), min(counts)
    variance += max(
        2.0 * math.fsum(_compute_mean_covariance(a, b) for a, b in itertools.combinations(fractions, 2)), 0.0
    )
    return min(p * (1.0 - p) / variance, max_trials), min(counts)


def _compute_mean_covariance(a: Array, b: Array) -> float:
    """Return the covariance of the means of two arrays over their finite entries; of an array with itself the variance.

    It is n cov/(n_a n_b): n pairs of entries with the same index are both finite and have the sample covariance cov;
    n_a, n_b: numbers of finite entries. Lengths may differ. It is 0 for fewer than two such pairs.
    """
    counts, length = (np.isfinite(a).sum(), np.isfinite(b).sum()), min(len(a), len(b))
    is_common = np.isfinite(a[:length]) & np.isfinite(b[:length])
    n = int(is_common.sum())
    if n < 2:
        return 0.0
    return float(np.cov(a[:length][is_common], b[:length][is_common])[0, 1]) * n / float(counts[0] * counts[1])


def _evaluate_combinations(checks: Sequence[Check], runs: Runs) -> tuple[float, Array, dict[RunCell, Array]]:
    """Evaluate checks on the combinations of complete runs, one of each cell; return fraction, flags and run numbers.

    fraction: of combinations that satisfy all checks; flags (n_combinations,): which do; run numbers (n_combinations,)
    of each cell. The fraction is NaN and the others are empty if a cell has no runs.
    """
    cells = list(dict.fromkeys(cell for check in checks for cell in check.cells))
    sizes = [len(next(iter(runs[cell].values()))) for cell in cells]
    if not all(sizes):
        return math.nan, np.zeros(0), {}
    selected = dict(zip(cells, _draw_combinations(sizes), strict=True))
    is_met = np.ones(len(selected[cells[0]]) if cells else 1, dtype=bool)
    for check in checks:

        def read_measure(k: int, name: str, check: Check = check) -> Array:
            """Return a measure of cell k of the check for all combinations, (n_combinations,)."""
            cell = check.cells[k]
            return runs[cell][name][selected[cell]]

        is_met = is_met & check.meets_condition(read_measure)
    return float(np.mean(is_met)), is_met, selected


def _draw_combinations(run_counts: Sequence[int]) -> Sequence[Array]:
    """Return for each cell the number of its run in each combination, (n_combinations,).

    All combinations are enumerated; if there are more than MAX_COMBINATIONS, that many are drawn at random with a fixed
    seed. run_counts: number of runs of each cell.
    """
    count = math.prod(run_counts)
    if count <= MAX_COMBINATIONS:
        return np.unravel_index(np.arange(count), tuple(run_counts)) if run_counts else ()
    rng = np.random.default_rng(0)
    return [rng.integers(0, size, MAX_COMBINATIONS) for size in run_counts]


def _group_checks(checks: Sequence[Check]) -> list[list[Check]]:
    """Return the connected components of checks: checks of a group share cells, directly or through other checks.

    Different groups are statistically independent.
    """
    groups: list[tuple[set[RunCell], list[Check]]] = []
    for check in checks:
        cells, group_checks = set(check.cells), [check]
        independent_groups = []
        for group in groups:
            if group[0] & cells:
                cells |= group[0]
                group_checks = group[1] + group_checks
            else:
                independent_groups.append(group)
        groups = [*independent_groups, (cells, group_checks)]
    return [group_checks for _, group_checks in groups]

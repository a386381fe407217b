"""Estimate the probability that a further run of a scene confirms a published claim, and derive a verdict.

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

MIN_P_HOLDS, MAX_P_FAILS = 0.8, 1.0 / 3.0  # probabilities from and up to which a claim holds, and fails
MAX_COMBINATIONS = 1 << 20  # combinations that are evaluated one by one; of more, so many random ones
TAIL_PROBABILITY = 0.05  # probability beyond each end of an interval
RUN_INDICES = ""  # in place of a measure: indices of the runs of a cell that have all measures
VERDICTS = ("holds", "fails", "undecided")


@dataclass(frozen=True)
class RunCell:
    """Runs that differ in their starts only: a part, and indices along its other dimensions."""

    part: str
    index: tuple[int, ...]


ReadMeasure: TypeAlias = Callable[[int, str], Array]  # number of a check's cell, measure -> values of the runs in it
Runs: TypeAlias = Mapping[RunCell, Mapping[str, Array]]  # measure -> (n,)


@dataclass(frozen=True, eq=False)
class Check:
    """A condition on one run of each of some cells."""

    cells: tuple[RunCell, ...]
    measures: tuple[str, ...]
    meets_condition: Callable[[ReadMeasure], Array]


@dataclass(frozen=True)
class ClaimVerdict:
    """Verdict on a claim of several checks: the least of their probabilities, and the chance that single runs meet all.

    `low`, `high`: the interval of the least likely check. `denied`: verdicts that the intervals rule out.
    """

    verdict: str
    probability: float
    low: float
    high: float
    chance: float
    denied: frozenset[str]
    estimates: tuple[ProbabilityEstimate, ...]  # of each check


@dataclass(frozen=True)
class ProbabilityEstimate:
    """A probability with the equivalent number of independent trials; infinite if the runs do not scatter.

    `runs`: runs of the smallest cell. `shared_trials`, `n_shared_runs`: trials and runs of those cells alone whose runs
    are the same in every ensemble.
    """

    p: float
    trials: float
    runs: float = math.inf
    shared_trials: float = math.inf
    n_shared_runs: float = math.inf

    def compute_bound(self, sign: float, tail_probability: float = TAIL_PROBABILITY) -> float:
        """Return the lower (sign −1) or upper (1) end of the confidence interval of the probability.

        tail_probability: that the true value lies beyond this end. E. B. Wilson, J. Am. Stat. Assoc. 22, 1927. The
        interval is at least as wide as that of runs that all, or none, meet the condition. Without scatter (infinite
        trials) or for NaN it is p itself.
        """
        if not math.isfinite(self.trials) or math.isnan(self.p):
            return self.p
        ends = (
            _compute_wilson_bound(self.p, self.trials, sign, tail_probability),
            _compute_wilson_bound(0.5 - 0.5 * sign, self.runs, sign, tail_probability),
        )
        return max(ends) if sign > 0 else min(ends)


def _compute_wilson_bound(p: float, n: float, sign: float, tail_probability: float) -> float:
    """Return the lower (sign −1) or upper (1) end of Wilson's interval for a probability p from n trials, in [0, 1].

    tail_probability: one-sided probability that the true value lies beyond the end.
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
    """Return the verdict on a claim: it holds if each of its checks is likely, and fails if one is unlikely.

    A probability is that of independent runs, one of each cell, estimated from all combinations of runs: for two cells
    from all pairs (H. B. Mann, D. R. Whitney, Ann. Math. Stat. 18, 1947); ties count as not larger. It is NaN, and the
    verdict undecided, if a cell has no run with all measures. deterministic_cells: cells whose runs do not scatter;
    shared_cells: cells whose runs other ensembles share.
    """
    complete_runs = _select_complete_runs(checks, runs)
    chance = math.prod(_evaluate_combinations(group, complete_runs)[0] for group in _group_checks(checks))
    return _combine_estimates(
        [_estimate_check_probability(check, complete_runs, deterministic_cells, shared_cells) for check in checks],
        chance,
    )


def merge_verdicts(verdicts: Sequence[ClaimVerdict]) -> tuple[ClaimVerdict, bool]:
    """Return the common verdict of several ensembles on one claim, and whether no ensemble rules out the verdict of
    another.

    Probabilities are means over the ensembles. Their trials add up, except for shared runs. Without agreement the
    verdict is undecided.
    """
    mean_chance = math.fsum(verdict.chance for verdict in verdicts) / len(verdicts)
    common = _combine_estimates(
        [_average_estimates(estimates) for estimates in zip(*(verdict.estimates for verdict in verdicts), strict=True)],
        mean_chance,
    )
    agreed = not any(verdict.verdict in other.denied for verdict in verdicts for other in verdicts)
    return (common if agreed else replace(common, verdict="undecided")), agreed


def _average_estimates(estimates: Sequence[ProbabilityEstimate]) -> ProbabilityEstimate:
    """Return the mean of the estimates of one check in several ensembles.

    The variances of the ensembles' separate runs, 1/trials − 1/shared_trials, decrease with their number; those of
    shared runs do not.
    """
    p, shared_trials = (
        math.fsum(values) / len(estimates) for values in zip(*((x.p, x.shared_trials) for x in estimates), strict=True)
    )
    separate_variances = [1.0 / estimate.trials - 1.0 / estimate.shared_trials for estimate in estimates]
    separate_trials = (
        math.inf if min(separate_variances) <= 0.0 else math.fsum(1.0 / rest for rest in separate_variances)
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

    chance: probability that one run of each cell meets all checks; it is only stored. The claim holds if each check is
    likely. To fail, the bound of each check is corrected for their number (Bonferroni). It is undecided without checks
    or with a NaN.
    """
    if not estimates or any(math.isnan(one.p) for one in estimates):
        return ClaimVerdict("undecided", math.nan, math.nan, math.nan, chance, frozenset(), tuple(estimates))
    low = min(one.compute_bound(-1.0) for one in estimates)
    high = min(one.compute_bound(1.0, TAIL_PROBABILITY / len(estimates)) for one in estimates)
    least_likely = min(estimates, key=lambda one: one.p)
    verdict = "fails" if high <= MAX_P_FAILS else "holds" if low >= MIN_P_HOLDS else "undecided"
    denied = frozenset(name for name, is_so in (("holds", high < MIN_P_HOLDS), ("fails", low > MAX_P_FAILS)) if is_so)
    return ClaimVerdict(
        verdict,
        least_likely.p,
        least_likely.compute_bound(-1.0),
        least_likely.compute_bound(1.0),
        chance,
        denied,
        tuple(estimates),
    )


def _select_complete_runs(checks: Sequence[Check], runs: Runs) -> Runs:
    """Return for each cell of the checks the runs that have finite values of all measures that the checks need there.

    The entry RUN_INDICES of a cell has the indices of these runs.
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
    """Return the probability of a check and the number of independent trials that it is worth.

    The trials follow from the variance of the fractions of single runs of each cell (W. Hoeffding, Ann. Math. Stat.
    19, 1948). They are infinite if no cell scatters or the probability is NaN.
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
    """Return for each run of a cell the fraction of its combinations that meets the check; NaN for a run left out.

    run_numbers (n_combinations,): number of the cell's run in each combination. is_met (n_combinations,): whether it
    meets the check. indices: index of each numbered run in the cell.
    """
    fractions, counts = np.full(int(indices.max()) + 1, np.nan), np.bincount(run_numbers, minlength=len(indices))
    with np.errstate(invalid="ignore"):
        fractions[indices] = np.bincount(run_numbers, is_met, len(indices)) / counts
    return fractions


def _estimate_trials(p: float, fractions: Sequence[Array], max_trials: int) -> tuple[float, float]:
    """Return the number of independent trials that a probability p is worth, and the runs of the smallest cell.

    fractions: those of the runs of each cell that meet the check. If fractions of two cells are correlated, as with
    equal deviations, their covariance adds to the variance. Both results are infinite without cells; trials are at
    most `max_trials`.
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
    """Return the covariance of the means of two arrays, each mean over the finite entries of its own array.

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
    """Return the fraction of combinations of runs that meet all checks, a flag for each, and the run of each cell in
    each.

    A combination has one run of each cell. The fraction is NaN and the arrays are empty if a cell has no runs.
    """
    cells = list(dict.fromkeys(cell for check in checks for cell in check.cells))
    sizes = [len(next(iter(runs[cell].values()))) for cell in cells]
    if not all(sizes):
        return math.nan, np.zeros(0), {}
    selected = dict(zip(cells, _draw_combinations(sizes), strict=True))
    is_met = np.ones(len(selected[cells[0]]) if cells else 1, dtype=bool)
    for check in checks:

        def read_measure(k: int, name: str, check: Check = check) -> Array:
            """Return a measure of cell k of the check for all combinations."""
            cell = check.cells[k]
            return runs[cell][name][selected[cell]]

        is_met = is_met & check.meets_condition(read_measure)
    return float(np.mean(is_met)), is_met, selected


def _draw_combinations(run_counts: Sequence[int]) -> Sequence[Array]:
    """Return for each cell the number of its run in each combination: all combinations, or MAX_COMBINATIONS random ones
    (fixed seed).

    run_counts: number of runs of each cell.
    """
    count = math.prod(run_counts)
    if count <= MAX_COMBINATIONS:
        return np.unravel_index(np.arange(count), tuple(run_counts)) if run_counts else ()
    rng = np.random.default_rng(0)
    return [rng.integers(0, size, MAX_COMBINATIONS) for size in run_counts]


def _group_checks(checks: Sequence[Check]) -> list[list[Check]]:
    """Return groups of checks that share cells, directly or through other checks; different groups are independent."""
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

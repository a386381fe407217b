"""How sure a claim is of an ensemble's runs: probabilities counted by hand, intervals, verdicts."""

from __future__ import annotations

import itertools
import math
from statistics import NormalDist
from typing import Any

import numpy as np
import pytest

from gudgeon.studies.ensemble import judge
from gudgeon.studies.ensemble.judge import Check, ReadMeasure, RunCell, judge_claim, merge_verdicts
from tests.slow import slow_rows_but

A, B, C, D = (RunCell("", (k,)) for k in range(4))


def larger(first: RunCell, second: RunCell) -> Check:
    return Check((first, second), ("m",), lambda x: x(1, "m") > x(0, "m"))


def runs(**values: list[float]) -> dict[RunCell, dict[str, Any]]:
    cells = {"a": A, "b": B, "c": C, "d": D}
    return {cells[name]: {"m": np.array(own)} for name, own in values.items()}


def test_the_probability_is_that_of_all_pairs() -> None:
    """Of 1, 2, 3 and 2, 4: (1,2) (1,4) (2,4) (3,4) rise, (2,2) is a tie, (3,2) falls."""
    found = judge_claim([larger(A, B)], runs(a=[1, 2, 3], b=[2, 4]))
    assert (found.probability, found.chance, found.verdict) == (4 / 6, 4 / 6, "undecided")
    sure = [A, B]  # of runs that do not scatter the probability is known as it is
    assert judge_claim([larger(B, A)], runs(a=[1, 2, 3], b=[2, 4]), sure).verdict == "fails"  # 1 of 6
    assert judge_claim([larger(A, B)], runs(a=[1, 2, 3, 4, 5], b=[5]), sure).verdict == "holds"  # 4 of 5
    assert judge_claim([larger(A, B)], runs(a=[1, 2, 3], b=[2]), sure).verdict == "fails"  # 1 of 3
    assert judge_claim([larger(A, B)], runs(a=[1, math.nan, 2], b=[3, math.nan])).probability == 1.0
    none = judge_claim([larger(A, B)], runs(a=[1, 2], b=[math.nan]))
    assert math.isnan(none.probability) and none.verdict == "undecided" and math.isnan(none.chance)


def below(number: float) -> Check:
    return Check((A,), ("m",), lambda x: x(0, "m") < number)


def test_an_interval_is_wilsons_where_a_check_is_of_single_runs() -> None:
    """k of n show it: both ends solve |p − k/n| = z sqrt(p (1 − p)/n), with the n − 1 that the shares' variance has."""
    found = judge_claim([below(7)], runs(a=list(range(10))))
    z = 1.6448536269514722
    for p, side in ((found.low, 1), (found.high, -1)):
        assert side * (0.7 - p) == pytest.approx(z * math.sqrt(p * (1 - p) / 9), rel=1e-12)
    whole = judge_claim([below(11)], runs(a=list(range(10))))
    assert whole.low == pytest.approx(10 / (10 + z * z), rel=1e-12) and whole.high == 1.0  # no run without it


ODDS = [(0.8, "holds"), (1 / 3, "fails"), (0.9, "holds"), (0.5, "undecided")]


@pytest.mark.parametrize(("p", "verdict"), slow_rows_but([(0.8, "holds"), (0.5, "undecided")], ODDS))
def test_verdicts_are_no_matter_of_chance(p: float, verdict: str) -> None:
    """Two normal cells of 32 runs, whose pairs rise with probability p = Φ(d/√2); 400 times three ensembles.

    At a threshold the verdict of an ensemble is the one beyond it as seldom as the interval says, and seldom does one
    ensemble carry what another rules out, wherever p lies.
    """
    rng, d, check = np.random.default_rng(8), math.sqrt(2.0) * NormalDist().inv_cdf(p), [larger(A, B)]
    many = [
        [judge_claim(check, {A: {"m": rng.normal(0, 1, 32)}, B: {"m": rng.normal(d, 1, 32)}}) for _ in range(3)]
        for _ in range(400)
    ]
    alone = [one for three in many for one in three]
    inside = np.mean([one.low <= p <= one.high for one in alone])
    assert 0.87 <= inside <= 0.96, inside  # 0.9, and what 1200 of them scatter
    if p in (0.8, 1 / 3):
        assert np.mean([one.verdict == verdict for one in alone]) < 0.08
    agree = np.mean([merge_verdicts(three)[1] for three in many])
    assert agree > 0.97
    same = np.mean([merge_verdicts(three)[0].verdict == verdict for three in many])
    assert same > 0.8 if p in (0.9, 0.5) else same < 0.08, same


def test_runs_of_the_same_deviations_are_fewer_trials() -> None:
    """Start by start one cell rises where the other falls: both know the same 32 draws, not 64; 600 times at 0.8."""
    rng, d, check = np.random.default_rng(1), math.sqrt(2.0) * NormalDist().inv_cdf(0.8), [larger(A, B)]
    draws = rng.normal(0, 1, (600, 32))
    found = [judge_claim(check, {A: {"m": own}, B: {"m": d - own}}) for own in draws]
    assert np.mean([one.verdict == "holds" for one in found]) < 0.08
    assert 0.87 <= np.mean([one.low <= 0.8 <= one.high for one in found]) <= 0.96
    gone = draws[0].copy()
    gone[3] = math.nan  # what is left keeps its place
    left, whole = judge_claim(check, {A: {"m": gone}, B: {"m": d - draws[0]}}), found[0]
    assert left.estimates[0].trials == pytest.approx(whole.estimates[0].trials, rel=0.1)


def test_runs_that_all_ensembles_have_count_once() -> None:
    """12 runs of one cell beside 32 of three ensembles; 600 times at 0.8, and all of a few runs."""
    rng, d, check = np.random.default_rng(1), math.sqrt(2.0) * NormalDist().inv_cdf(0.8), [larger(A, B)]
    held = 0
    for _ in range(600):
        b = rng.normal(d, 1, 12)
        each = [judge_claim(check, {A: {"m": rng.normal(0, 1, 32)}, B: {"m": b}}, shared_cells=[B]) for _ in range(3)]
        held += merge_verdicts(each)[0].verdict == "holds"
    assert held < 0.08 * 600
    few = [judge_claim(check, runs(a=[1.0] * 40, b=[2.0] * 4), shared_cells=[B])] * 3
    assert merge_verdicts(few)[0].verdict == "undecided" and merge_verdicts(few)[0].low == few[0].low


def test_nothing_is_surer_than_what_all_runs_show() -> None:
    """Of 8 and 8 all pairs rise; then all but one do, whose shares scatter like those of more trials."""
    for side, verdict in ((1.0, "holds"), (-1.0, "fails")):
        a, b = side * np.arange(8.0), side * np.arange(8.5, 16.0)
        whole = judge_claim([larger(A, B)], {A: {"m": a}, B: {"m": b}})
        b[0] = side * 6.5
        one_less = judge_claim([larger(A, B)], {A: {"m": a}, B: {"m": b}})
        assert abs(whole.probability - one_less.probability) == 1 / 64 and one_less.estimates[0].trials > 8
        assert one_less.low <= whole.low if side > 0 else one_less.high >= whole.high
        assert whole.verdict == one_less.verdict or whole.verdict == verdict


def test_ensembles_that_contradict_each_other_decide_nothing() -> None:
    rises, falls = (
        judge_claim([larger(A, B)], runs(a=own, b=other))
        for own, other in (([1.0] * 20, [2.0] * 20), ([2.0] * 20, [1.0] * 20))
    )
    assert (rises.verdict, falls.verdict) == ("holds", "fails") and rises.excluded_verdicts == {"fails"}
    whole, agreed = merge_verdicts([rises, rises, falls])
    assert not agreed and whole.verdict == "undecided" and whole.probability == pytest.approx(2 / 3)
    few = judge_claim([larger(A, B)], runs(a=[1.0] * 4, b=[2.0] * 4))
    assert few.verdict == "undecided"
    whole, agreed = merge_verdicts([few, few, few])  # twelve say what four cannot
    assert agreed and whole.verdict == "holds" and whole.low == pytest.approx(12 / (12 + 1.6448536269514722**2))


def test_the_chance_is_that_single_runs_show_all_of_it() -> None:
    """A chain is counted run by run, for its middle is in both; what shares no run is independent."""
    own = runs(a=[1, 5, 2], b=[3, 0, 4], c=[4, 2, 6], d=[1, 7])
    chain = judge_claim([larger(A, B), larger(B, C)], own)
    triples = [a < b < c for a, b, c in itertools.product([1, 5, 2], [3, 0, 4], [4, 2, 6])]
    assert chain.chance == pytest.approx(sum(triples) / 27, rel=1e-15)
    assert chain.probability == min(4 / 9, 6 / 9) and chain.verdict == "undecided"
    apart = judge_claim([larger(A, B), larger(D, C)], own)
    assert apart.chance == pytest.approx(4 / 9 * 3 / 6, rel=1e-15)


def test_measures_of_a_run_belong_together() -> None:
    """x rises in 3 of 4 pairs and y in 3 of 4, but never both fall: runs of both are 2 of 4."""
    own = {
        A: {"x": np.array([0.0, 2.0]), "y": np.array([2.0, 0.0])},
        B: {"x": np.array([1.0, 3.0]), "y": np.array([3.0, 1.0])},
    }
    checks = [
        Check((A, B), ("x",), lambda x: x(1, "x") > x(0, "x")),
        Check((A, B), ("y",), lambda x: x(1, "y") > x(0, "y")),
    ]
    found = judge_claim(checks, own)
    assert (found.probability, found.chance) == (0.75, 0.5)


def test_of_very_many_combinations_some_are_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    def middle(x: ReadMeasure) -> Any:
        return (x(0, "m") < x(1, "m")) & (x(1, "m") < x(2, "m"))

    rng = np.random.default_rng(3)
    own = {cell: {"m": rng.normal(k, 1.0, 30)} for k, cell in enumerate((A, B, C))}
    whole = judge_claim([Check((A, B, C), ("m",), middle)], own).probability
    monkeypatch.setattr(judge, "MAX_COMBINATIONS", 20_000)
    drawn = judge_claim([Check((A, B, C), ("m",), middle)], own).probability
    assert drawn != whole and abs(drawn - whole) < 4 * math.sqrt(whole * (1 - whole) / 20_000)

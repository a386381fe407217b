"""What runs say of a claim: the probability that the next run of each scene shows it, over all combinations of runs."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from gudgeon.results.batch import Array

HOLDS, FAILS = 0.8, 1.0 / 3.0  # probabilities from and up to which a claim holds, and fails
MOST = 1 << 20  # combinations that are looked at, one by one; of more as many drawn ones
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
    """A claim that consists of checks: the least of their probabilities, and that single runs show all of them."""

    verdict: str
    probability: float
    chance: float


def judged(checks: Sequence[Check], runs: Runs) -> Judged:
    """Holds where each check is likely, fails where one is unlikely.

    A probability is that of independent runs, one of each cell, estimated by all combinations of the runs that there
    are: of two cells by all pairs (H. B. Mann, D. R. Whitney, Ann. Math. Stat. 18, 1947), ties count as not larger.
    NaN, and undecided, where a cell has no run with all of the measures.
    """
    whole = _complete(checks, runs)
    each = [_share([check], whole) for check in checks]
    least = min(each, key=lambda p: -1.0 if math.isnan(p) else p, default=math.nan)
    chance = math.prod(_share(group, whole) for group in _together(checks))
    return Judged(verdict_of(each), least, chance)


def verdict_of(probabilities: Iterable[float]) -> str:
    """Of all checks of a claim."""
    each = list(probabilities)
    if any(math.isnan(p) for p in each) or not each:
        return "undecided"
    return "fails" if min(each) <= FAILS else "holds" if min(each) >= HOLDS else "undecided"


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
        found[cell] = {name: values[good] for name, values in own.items()}
    return found


def _share(checks: Sequence[Check], runs: Runs) -> float:
    """Of the combinations of one run of each cell: how many show all of the checks."""
    cells = list(dict.fromkeys(cell for check in checks for cell in check.cells))
    sizes = [len(next(iter(runs[cell].values()))) for cell in cells]
    if not all(sizes):
        return math.nan
    chosen = dict(zip(cells, _combinations(sizes), strict=True))
    shown = np.array(True)
    for check in checks:

        def look(k: int, name: str, check: Check = check) -> Array:
            cell = check.cells[k]
            return runs[cell][name][chosen[cell]]

        shown = shown & check.shows(look)
    return float(np.mean(shown))


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

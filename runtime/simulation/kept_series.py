"""Series of runs of a batch, computed as soon as runs are over: nobody needs their states any more."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.errors import SolverError
from gudgeon.model.evaluation import evaluate_runs
from gudgeon.model.left_limit import evaluation_times
from gudgeon.results.batch import parts_of
from gudgeon.results.results import Bare, Result, bare
from gudgeon.results.series import catalogue

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.integrators.batch import Runs
    from gudgeon.integrators.times import Times


class KeptSeries:
    """(n, N) arrays by the name of a series, and "t"; NaN where a run has no sample."""

    def __init__(self, source: KernelSource, names: tuple[str, ...], n: int, times: Times) -> None:
        self.names, self.parts = ("t", *names), parts_of(source, names)
        self.arrays = {name: np.full((n, times.most), np.nan) for name in self.names}
        known = [catalogue(source)[name] for name in names if name != "t"]
        self.columns = all(one.stored or one.evaluated for one in known)  # none of them reads a run's own numbers

    def take(self, runs: Runs, over: Sequence[int]) -> None:
        """Takes those of some runs; where one cannot be computed, that is what its run failed of."""
        begun = [i for i in over if runs.arrays["done"][i]]
        if len(begun) > 1 and self.columns:
            try:
                self._take(begun, *_joined(runs, begun, self.parts))
                return
            except SolverError:  # of one of them: alone it says which
                pass
        for i in begun:
            if run := bare_of(runs, i, self.parts):
                self.take_one(runs, i, run)

    def take_one(self, runs: Runs, i: int, run: Result) -> None:
        """The same of run i, which `run` is."""
        try:
            self._take([i], [len(run.t)], run, int(run.start_row is not None))
        except SolverError as error:
            runs.failures.setdefault(i, error)

    def _take(self, begun: Sequence[int], counts: Sequence[int], of: Result, row: int = 0) -> None:
        """counts[k] samples of run begun[k], one after the other, to rows from `row` on."""
        columns, first = [(self.arrays[name], of[name]) for name in self.names], 0
        for i, count in zip(begun, counts, strict=True):
            for kept, column in columns:
                kept[i, row : row + count] = column[first : first + count]
            first += count


def bare_of(runs: Runs, i: int, parts: frozenset[str]) -> Bare | None:
    """The samples of run i; None where there is none."""
    if not runs.arrays["done"][i]:
        return None
    n, source, p = runs.compiled.n, runs.compiled.source, runs.arrays["p"][i]
    t, y, memory, state = runs.samples(i)
    made = bare(source, runs.compiled, p, t, y[:, :n], y[:, n : 2 * n], y[:, 2 * n :], memory, state, parts)
    made.accelerations = runs.accelerations(i)
    return made


def _joined(runs: Runs, begun: Sequence[int], parts: frozenset[str]) -> tuple[list[int], Bare]:
    """How many samples each of these runs has, and all of them as if they were one's, with the numbers of none."""
    compiled, n, each = runs.compiled, runs.compiled.n, [runs.samples(i) for i in begun]
    counts = [len(own[0]) for own in each]
    t, y, memory, state = (np.concatenate(arrays) for arrays in zip(*each, strict=True))
    q, v = y[:, :n], y[:, n : 2 * n]
    none = np.full(compiled.n_p, np.nan)
    made = bare(compiled.source, compiled, none, t, q, v, y[:, 2 * n :], memory, state, parts)
    if parts:
        numbers = runs.arrays["p"][begun]
        if compiled.may_switch:
            last = zip(each, numbers, strict=True)
            t = np.concatenate([evaluation_times(compiled, t, y[:, :n], y[:, n : 2 * n], p) for (t, y, *_), p in last])
        made.evaluation = evaluate_runs(compiled, counts, t, q, v, memory, numbers, parts)
    return counts, made

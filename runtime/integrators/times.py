"""Output times of the runs of a batch: the same for all, or each run's own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gudgeon.model.compiled import Array


@dataclass(frozen=True, eq=False)
class Times:
    """`t` (N,) where all runs have the same, else (n, N), NaN behind a run's last."""

    t: Array  # s
    count: NDArray[np.int_]  # (n,) how many each run has

    @staticmethod
    def of_runs(each: Mapping[int, Array], n: int) -> Times:
        """Of n runs from the times of those that are to begin, at least one."""
        rows = [each.get(i) for i in range(n)]
        first = next(iter(each.values()))
        if all(row is None or row is first or np.array_equal(row, first) for row in rows):
            return Times(first, np.full(n, len(first)))
        count = np.array([0 if row is None else len(row) for row in rows])
        t = np.full((n, int(count.max())), np.nan)
        for i, row in each.items():
            t[i, : len(row)] = row
        return Times(t, count)

    @property
    def most(self) -> int:
        """N, rows of a run in the arrays of a batch."""
        return self.t.shape[-1]

    @property
    def apart(self) -> int:
        """Numbers between the times of two runs in memory; 0: they are the same."""
        return self.most if self.t.ndim == 2 else 0

    def of(self, i: int) -> Array:
        """Those of run i, (count[i],)."""
        return self.t[i, : self.count[i]] if self.t.ndim == 2 else self.t

    def ends(self) -> Array:
        """The last of each run, (n,); NaN where a run has none."""
        if self.t.ndim == 1:
            return np.full(len(self.count), self.t[-1])
        return np.where(self.count > 0, self.t[np.arange(len(self.count)), self.count - 1], np.nan)

    def same(self, i: int, j: int) -> bool:
        """Whether two runs have the same."""
        return self.t.ndim == 1 or np.array_equal(self.of(i), self.of(j))

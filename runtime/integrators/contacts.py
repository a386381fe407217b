"""Contacts of the runs of a batch: each thread's lists as it fetches them, and all of them by run and onset."""

from __future__ import annotations

from threading import local
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import IMPACT_COLUMN_NAMES, MAX_LISTED, N_IMPACT_COLUMNS, IMPACT_t_on
from gudgeon.integrators.trajectory import IMPACT_DTYPE
from gudgeon.model.compiled import Array, CompiledModel

BLOCK = 16 * MAX_LISTED  # contacts that have their room together


def as_impacts(numbers: Array, joints: NDArray[np.intc]) -> NDArray[Any]:
    """Return contacts (IMPACT_DTYPE) from their numbers (n, N_IMPACT_COLUMNS) and joints (n,) as C lists them."""
    impacts = np.empty(len(joints), dtype=IMPACT_DTYPE)
    impacts["joint"] = joints
    for name in (IMPACT_DTYPE.names or ())[1:]:
        impacts[name] = numbers[:, IMPACT_COLUMN_NAMES.index(name)]
    return impacts


class Contacts:
    """What the threads of a batch have fetched; each has its own lists."""

    def __init__(self, compiled: CompiledModel) -> None:
        self.compiled, self.own, self.all = compiled, local(), list[_Fetched]()

    def fetch(self, i: int, run: Any, last: bool) -> None:
        """Takes over the list of run i, which is emptied; with `last` the contacts that still go on too."""
        try:
            fetched: _Fetched = self.own.fetched
        except AttributeError:
            fetched = self.own.fetched = _Fetched(self.compiled)
            self.all.append(fetched)
        fetched.fetch(i, run, last)

    def joined(self, n: int) -> tuple[NDArray[Any], NDArray[np.int_]]:
        """IMPACT_DTYPE, those of runs 0 to n - 1, run by run and by their onset; where each run's begin, (n + 1,).

        To be asked once: the lists are let go.
        """
        if not self.all:
            return np.zeros(0, IMPACT_DTYPE), np.zeros(n + 1, np.int_)
        runs = np.array([i for each in self.all for i in each.runs], np.int_)
        counts = np.array([count for each in self.all for count in each.counts], np.int_)
        begins, by_run = np.cumsum(counts) - counts, np.argsort(runs, kind="stable")
        begins, counts = begins[by_run], counts[by_run]
        whose = np.repeat(runs[by_run], counts)
        row = np.repeat(begins - (np.cumsum(counts) - counts), counts) + np.arange(len(whose))
        blocks = [block for each in self.all for block in each.blocks()]
        numbers = np.concatenate([np.zeros((0, N_IMPACT_COLUMNS)), *(numbers for numbers, _ in blocks)])
        joints = np.concatenate([np.zeros(0, np.intc), *(joints for _, joints in blocks)])
        self.all.clear()
        # complex numbers are ordered by their real parts first; the rows nearly are, which a lexsort does not use
        row = row[np.argsort(whose + 1j * numbers[row, IMPACT_t_on], kind="stable")]
        return as_impacts(numbers[row], joints[row]), np.searchsorted(whose, np.arange(n + 1))


class _Fetched:
    """The lists of one thread, one behind the other: whose they are, how many contacts each has, these in blocks."""

    def __init__(self, compiled: CompiledModel) -> None:
        self.compiled, self.runs, self.counts = compiled, list[int](), list[int]()
        self.full: list[tuple[NDArray[Any], NDArray[Any]]] = []
        self._begin()

    def _begin(self) -> None:
        self.numbers, self.joints, self.n = np.empty((BLOCK, N_IMPACT_COLUMNS)), np.empty(BLOCK, np.intc), 0
        pointer = self.compiled.pointer
        self.to = pointer(self.numbers, written=True), pointer(self.joints, "int *", written=True)

    def fetch(self, i: int, run: Any, last: bool) -> None:
        self.runs.append(i)
        self.counts.append(0)
        while True:
            (numbers, joints), room = self.to, BLOCK - self.n
            to = numbers + N_IMPACT_COLUMNS * self.n, joints + self.n
            count = self.compiled.lib.gudgeon_run_impacts(run, last, room, *to)
            self.counts[-1] += count
            self.n += count
            if count < room:
                return
            self.full = self.blocks()
            self._begin()

    def blocks(self) -> list[tuple[NDArray[Any], NDArray[Any]]]:
        """Numbers (n, N_IMPACT_COLUMNS) and joints (n,), as far as they are filled."""
        return [*self.full, (self.numbers[: self.n], self.joints[: self.n])]

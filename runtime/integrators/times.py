"""Hold the output times of the runs of a batch, common to all or one row per run; compute the last fixed step."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from gudgeon.model.compiled import Array

LAST_STEP_TOL = 1e-9  # relative difference up to which the last step counts as equal: times are sums of rounded numbers


@dataclass(frozen=True, eq=False)
class Times:
    """Hold output times `t`: (N,) if they are common to all runs, else (n, N) with NaN after a run's last time."""

    t: Array  # s
    count: NDArray[np.int_]  # (n,) number of times of each run
    n_skipped: NDArray[np.int_]  # (n,) 1 if the first time, the start, was not requested and is not a sample

    @staticmethod
    def from_runs(times_of_runs: Mapping[int, tuple[Array, bool]], n_runs: int) -> Times:
        """Build the Times of n runs from sample times (s) by index, each with whether the start is requested.

        At least one run must have times; runs that are absent get none. Equal times of all runs are stored once.
        """
        first, all_requested = next(iter(times_of_runs.values()))
        skipped = np.array([int(not times_of_runs.get(i, (first, all_requested))[1]) for i in range(n_runs)])
        if all(row is first or np.array_equal(row, first) for row, _ in times_of_runs.values()):
            return Times(first, np.full(n_runs, len(first)), skipped)
        count = np.array([len(times_of_runs[i][0]) if i in times_of_runs else 0 for i in range(n_runs)])
        t = np.full((n_runs, int(count.max())), np.nan)
        for i, (row, _) in times_of_runs.items():
            t[i, : len(row)] = row
        return Times(t, count, skipped)

    @property
    def max_count(self) -> int:
        """Return N, the largest number of times of a run: the number of rows of a run in the arrays of a batch."""
        return self.t.shape[-1]

    @property
    def start(self) -> float:
        """Return the time (s) at which all runs begin."""
        return float(self.t[0] if self.t.ndim == 1 else np.nanmin(self.t[:, 0]))

    @property
    def stride(self) -> int:
        """Return the stride, in numbers, between the times of successive runs in `t`; 0 if all runs have the same."""
        return self.max_count if self.t.ndim == 2 else 0

    def get_times(self, i: int) -> Array:
        """Return the times (s) of run i, (count[i],), its start included; a view."""
        return (self.t[i] if self.t.ndim == 2 else self.t)[: self.count[i]]

    def cut_times_before(self, ends: Mapping[int, float]) -> Times:
        """Return Times in which each run has only times before its end (s) in `ends`, given by index.

        Runs without an end keep all times; the first time always stays.
        """
        count = self.count.copy()
        for i, end in ends.items():
            count[i] = max(int(np.searchsorted(self.get_times(i), end)), 1)
        return replace(self, count=count)

    def get_requested_times(self) -> Array:
        """Return the requested sample times, without starts that were not requested: (N',), or (n, N') as `t`.

        The shape is (n, N') too if only some runs skip their start; NaN follows a run's last time.
        """
        if self.t.ndim == 1 and (self.n_skipped == self.n_skipped[:1]).all():
            return self.t[self.n_skipped[:1].sum() :]
        return self.select_requested_samples(np.broadcast_to(self.t, (len(self.count), self.max_count)))

    def select_requested_samples(self, values: Array) -> Array:
        """Return the samples of all runs, (n, N, …), at the requested times, (n, N', …).

        Starts that were not requested are left out (n_skipped is 1 for such a run). Runs with fewer times are filled
        with NaN, arrays of integers with 0. A view is returned if all runs, or none, requested their start.
        """
        if (self.n_skipped == self.n_skipped[:1]).all():
            return values[:, self.n_skipped[:1].sum() :]
        max_count = int((self.count - self.n_skipped).max())
        selected = np.full(
            (len(values), max_count, *values.shape[2:]), np.nan if values.dtype.kind == "f" else 0, values.dtype
        )
        for i, skip in enumerate(self.n_skipped.tolist()):
            row = values[i, skip : skip + max_count]
            selected[i, : len(row)] = row
        return selected

    def get_ends(self) -> Array:
        """Return the last time of each run, (n,); NaN for runs without times."""
        t = np.broadcast_to(self.t, (len(self.count), self.max_count))
        return np.where(self.count > 0, t[np.arange(len(self.count)), self.count - 1], np.nan)


def compute_last_step(duration: float, step: float) -> float:
    """Return the length (s) of the last fixed step of a run over `duration` (s): `step`, or the remainder.

    A remainder equal to `step` up to rounding counts as `step`, as in step_end in numbers.h.
    """
    total = max(1, math.ceil(duration / step * (1.0 - 1e-12)))
    remainder = duration - (total - 1) * step
    return step if abs(remainder - step) < LAST_STEP_TOL * step else remainder

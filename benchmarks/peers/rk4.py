"""Classical RK4 with a fixed step inside press_dense.c: the step (s) takes the tolerance's place."""

from __future__ import annotations

from time import perf_counter

import numpy as np

from benchmarks.peers.press import OUTPUTS, Samples, Work
from tests.oracles import press_dense


def run(work: Work, step: float) -> tuple[Samples, float, int]:
    """(samples, seconds, right-hand sides); onsets are not listed by this run, so none are given."""
    every = max(1, round(work.t_end / (OUTPUTS - 1) / step))
    h = work.t_end / ((OUTPUTS - 1) * every)
    begin = perf_counter()
    found = press_dense.rk4(work.press, work.t_end, h, every=every)
    seconds = perf_counter() - begin
    nothing = np.full(0, np.nan)
    return Samples(found.q, (nothing, nothing)), seconds, 4 * every * (OUTPUTS - 1)

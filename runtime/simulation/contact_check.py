"""The contacts of a run, checked at many more times than its samples: `run.check()`, `gudgeon run --verify`."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.language.wanted import whole
from gudgeon.results.contact_check import ContactCheck, check_samples
from gudgeon.results.samples import with_start
from gudgeon.simulation.examine import as_it_was
from gudgeon.simulation.simulation import Simulation

if TYPE_CHECKING:
    from gudgeon.integrators.trajectory import Progress
    from gudgeon.results.results import Result

FEWEST, MOST = 2, 100_000_000
STORED = "the run could not be repeated bit for bit: only its stored samples were checked"


def check(run: Result, samples: int, progress: Progress | None = None) -> ContactCheck:
    """Check a run at `samples` equal intervals and at its own samples; see Result.check."""
    samples = whole(samples, "samples", FEWEST, MOST)
    run = with_start(run)
    if not run.source.clearances or len(run.t) < FEWEST:
        return check_samples(run)
    dense = run
    if run.compiled is not None:
        times = np.union1d(run.t, np.linspace(run.t[0], run.t[-1], samples + 1))
        dense = as_it_was(Simulation(run.compiled, ""), run, times, progress) or run
    found = check_samples(dense, run)
    return found if dense is not run else replace(found, notes=(STORED,))

"""What a study will take: runs, blocks, bytes on disk, and seconds by a few of its runs made on trial."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass

import numpy as np

from gudgeon.integrators.threads import available_threads
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.ensemble.block import Block, Job, run_block
from gudgeon.studies.ensemble.folder import image
from gudgeon.studies.ensemble.plan import Plan

TRIALS = 4  # runs a thread of each part, evenly over the part
FIRST = 1.0  # s; what takes less is made again, for most of a first time is not its runs'


@dataclass(frozen=True)
class Estimate:
    """All of a study, as far as a trial tells."""

    runs: int
    blocks: int
    bytes: int
    seconds: float
    failed: int  # runs of the trial that failed
    tried: int
    reasons: tuple[str, ...]  # of these, each once


def estimate(plan: Plan, threads: int | None) -> Estimate:
    """Make a few runs of each part, measure them, let them go."""
    count = min(plan.each, TRIALS * (threads or available_threads()))
    runs = np.unique(np.linspace(0, plan.each - 1, count).astype(int))
    seconds, size, failures = 0.0, 0, list[str]()
    for k, part in enumerate(plan.parts):
        job = plan.job_of(0, k, runs, threads)
        block, taken = _timed(job, part.simulation)
        if taken < FIRST:
            block, taken = _timed(job, part.simulation)
        seconds += taken * plan.each / len(runs)
        numbers = len(plan.wanted.measures) + 3 + (len(plan.wanted.keep) + 1) * block.t.shape[-1]
        more = max(0, len(image(block, plan.digest)) - 8 * numbers * len(runs))  # of a file, beside its numbers
        size += 2 * 8 * numbers * plan.each + more * math.ceil(plan.each / part.block)  # in blocks, and in the dataset
        failures += filter(None, block.failures)
    reasons = tuple(dict.fromkeys(failures))
    return Estimate(plan.runs, len(plan.blocks), size, seconds, len(failures), len(runs) * len(plan.parts), reasons)


def _timed(job: Job, simulation: Simulation) -> tuple[Block, float]:
    """A block and the seconds that it took."""
    before = time.perf_counter()
    return run_block(job, simulation=simulation), time.perf_counter() - before

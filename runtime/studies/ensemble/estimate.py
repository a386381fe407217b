"""What a study will take: runs, blocks, bytes on disk, and seconds by a few of its runs made on trial."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from gudgeon.integrators.batch import available_threads
from gudgeon.studies.ensemble.block import run_block
from gudgeon.studies.ensemble.plan import Plan

TRIALS = 4  # runs a thread of each part, evenly over the part


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
    seconds, samples, failures = 0.0, 0, list[str]()
    for k in range(len(plan.parts)):
        job = plan.job_of(0, k, runs, threads)
        before = time.perf_counter()
        block = run_block(job, simulation=plan.parts[k].simulation)
        seconds += (time.perf_counter() - before) * plan.each / len(runs)
        samples = max(samples, block.t.shape[-1])
        failures += filter(None, block.failures)
    numbers = len(plan.wanted.measures) + 3 + (len(plan.wanted.keep) + 1) * samples
    size = 2 * 8 * numbers * plan.runs  # in blocks, and in the dataset
    reasons = tuple(dict.fromkeys(failures))
    return Estimate(plan.runs, len(plan.blocks), size, seconds, len(failures), len(runs) * len(plan.parts), reasons)

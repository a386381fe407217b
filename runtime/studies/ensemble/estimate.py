"""Estimate the resources of a study: disk and memory from its plan, run time from trial runs."""

from __future__ import annotations

import math
import os
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gudgeon.files.free_space import check_disk, check_memory
from gudgeon.integrators.threads import count_available_threads
from gudgeon.model.evaluation import compute_evaluation_bytes, compute_sample_bytes
from gudgeon.results.batch import find_evaluation_fields
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.ensemble.block import Block, Job, run_block
from gudgeon.studies.ensemble.folder import encode_block
from gudgeon.studies.ensemble.loop import MAX_CONCURRENT_BLOCKS
from gudgeon.studies.ensemble.measures import list_sampled_series
from gudgeon.studies.ensemble.plan import Part, Plan, Plans

SERIES_COPIES = 3  # copies of a series in memory while it is measured: stored, read, and an intermediate array
BLOCK_NOTES_BYTES = 250  # approximate memory of the description of a block during a study
TRIAL_RUNS_PER_THREAD = 4  # of each part, at equal distances in the part
MIN_TRIAL_S = 1.0  # s, a shorter trial is repeated, since start-up dominates the first one


def check_disk_and_memory(plans: Plans, folder: Path, threads: int | None, in_process: bool) -> None:
    """Raise an error before a study begins if the disk or the memory does not suffice for all parts.

    threads: None means the number of cores. in_process: whether runs are simulated in this process, whose memory for
    states and series is then checked, too. Raises OutputError for blocks and datasets (files in `folder` count as
    existing ones), MemoryError for descriptions of blocks or samples.
    """
    cores = threads or count_available_threads()
    for plan in plans.by_part.values():
        check_memory(BLOCK_NOTES_BYTES * plan.n_blocks, f"a study of {plan.runs} runs in {plan.n_blocks} blocks")
        for part in plan.parts if in_process else ():
            _check_block_memory(plan, part, cores)
    size = sum(estimate_disk_bytes(plan) for plan in plans.by_part.values())
    check_disk(folder, size - _sum_existing_bytes(folder), f"the study, {plans.runs} runs,")


def estimate_disk_bytes(plan: Plan) -> float:
    """Return a lower bound of the size of all blocks and of the dataset of a plan, bytes: measures, end times, series.

    Blocks have the mean number of samples of a part for each run, the dataset the largest one.
    """
    n_values, n_series = len(plan.run_settings.measures) + 2, len(plan.run_settings.keep)
    samples = (part.mean_samples + part.max_samples for part in plan.parts)
    return sum(8.0 * plan.runs_per_part * (2 * n_values + n_series * count) for count in samples)


def _check_block_memory(plan: Plan, part: Part, cores: int) -> None:
    """Raise MemoryError if states and series of the concurrent blocks of a part do not fit into the free memory."""
    compiled, n_blocks = part.simulation.compiled, min(cores, MAX_CONCURRENT_BLOCKS, plan.n_blocks)
    n_runs = n_blocks * part.block_runs
    names = list_sampled_series(plan.run_settings.measures, plan.run_settings.keep, compiled.source)
    state = compute_sample_bytes(compiled) + compute_evaluation_bytes(
        compiled, find_evaluation_fields(compiled.source, names)
    )
    size = state * min(max(cores, n_blocks), n_runs) + n_runs * 8 * SERIES_COPIES * (len(names) + 1)
    runs = f"{n_runs} runs" if n_runs > 1 else "a run"
    check_memory(size * part.mean_samples, f"{runs} of {part.mean_samples:.0f} samples, simulated at once,")


def _sum_existing_bytes(folder: Path) -> int:
    """Return the total size (bytes) of all files in a folder and its subfolders; 0 if it does not exist."""
    n_bytes = 0
    for directory, _, names in os.walk(folder):
        for name in names:
            with suppress(OSError):
                n_bytes += os.stat(os.path.join(directory, name)).st_size
    return n_bytes


@dataclass(frozen=True)
class Estimate:
    """Size and run time of a part of a study, extrapolated from trial runs."""

    runs: int
    blocks: int
    bytes: int
    seconds: float
    failed: int  # failed trial runs
    tried: int  # trial runs
    reasons: tuple[str, ...]  # of failed trial runs, without repetitions


def estimate_study(plan: Plan, threads: int | None) -> Estimate:
    """Return size and run time of a plan, extrapolated linearly from trial runs of each scene and structure, which are
    not stored.

    The size counts each value twice, in a block and in the dataset. threads: None means the number of cores. A trial
    shorter than MIN_TRIAL_S seconds is repeated, since the first one includes the start-up.
    """
    count = min(plan.runs_per_part, TRIAL_RUNS_PER_THREAD * (threads or count_available_threads()))
    runs = np.unique(np.linspace(0, plan.runs_per_part - 1, count).astype(int))
    seconds, size, failures = 0.0, 0, list[str]()
    for k, part in enumerate(plan.parts):
        job = plan.make_job(0, k, runs, threads)
        block, trial_seconds = _run_timed_block(job, part.simulation)
        if trial_seconds < MIN_TRIAL_S:
            block, trial_seconds = _run_timed_block(job, part.simulation)
        seconds += trial_seconds * plan.runs_per_part / len(runs)
        n_values = len(plan.run_settings.measures) + 3 + (len(plan.run_settings.keep) + 1) * block.t.shape[-1]
        overhead = max(0, len(encode_block(block, plan.digest)) - 8 * n_values * len(runs))  # of the file of a block
        # each value is in a block and in the dataset
        size += 2 * 8 * n_values * plan.runs_per_part + overhead * math.ceil(plan.runs_per_part / part.block_runs)
        failures += filter(None, block.failures)
    reasons = tuple(dict.fromkeys(failures))
    return Estimate(plan.runs, len(plan.blocks), size, seconds, len(failures), len(runs) * len(plan.parts), reasons)


def _run_timed_block(job: Job, simulation: Simulation) -> tuple[Block, float]:
    """Run all runs of a job in this process, and return their results and the wall time (s)."""
    before = time.perf_counter()
    return run_block(job, simulation=simulation), time.perf_counter() - before

"""Estimate the needs of a study: disk, memory, number of runs, and seconds from trial runs."""

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
from gudgeon.results.batch import find_evaluation_parts
from gudgeon.simulation.simulation import Simulation
from gudgeon.studies.ensemble.block import Block, Job, run_block
from gudgeon.studies.ensemble.folder import encode_block
from gudgeon.studies.ensemble.loop import MAX_CONCURRENT_BLOCKS
from gudgeon.studies.ensemble.measures import list_sampled_series
from gudgeon.studies.ensemble.plan import Part, Plan, Plans

SERIES_COPIES = 3  # times a series is there while it is measured: kept, read, and what is between
BLOCK_NOTES_BYTES = 250  # bytes, about, of the notes of a block during a study
TRIAL_RUNS_PER_THREAD = 4  # runs a thread of each part, evenly over the part
MIN_TRIAL_S = 1.0  # s; a shorter trial is repeated, since most of a first time is start-up


def check_disk_and_memory(plans: Plans, folder: Path, threads: int | None, in_process: bool) -> None:
    """Check disk and memory before a study begins: blocks and datasets of all parts.

    threads: None means the number of cores. in_process: whether runs are simulated in this process, whose memory is
    then checked, too. Raises OutputError if blocks and datasets do not fit on the disk besides existing ones,
    MemoryError if notes or samples do not fit into memory.
    """
    cores = threads or count_available_threads()
    for plan in plans.each.values():
        check_memory(
            BLOCK_NOTES_BYTES * plan.count_of_blocks, f"a study of {plan.runs} runs in {plan.count_of_blocks} blocks"
        )
        for part in plan.parts if in_process else ():
            _check_block_memory(plan, part, cores)
    size = sum(estimate_disk_bytes(plan) for plan in plans.each.values())
    check_disk(folder, size - _sum_existing_bytes(folder), f"the study, {plans.runs} runs,")


def estimate_disk_bytes(plan: Plan) -> float:
    """Return the least size of all blocks and of the dataset of a plan, bytes: measures, ends of runs and stored
    series.
    """
    numbers, kept = len(plan.run_settings.measures) + 2, len(plan.run_settings.keep)
    return sum(8.0 * plan.each * (2 * numbers + kept * (part.samples + part.most)) for part in plan.parts)


def _check_block_memory(plan: Plan, part: Part, cores: int) -> None:
    """Raise MemoryError if states and series of the blocks of a part that run at the same time do not fit."""
    compiled, most = part.simulation.compiled, min(cores, MAX_CONCURRENT_BLOCKS, plan.count_of_blocks)
    names = list_sampled_series(plan.run_settings.measures, plan.run_settings.keep, compiled.source)
    state = compute_sample_bytes(compiled) + compute_evaluation_bytes(
        compiled, find_evaluation_parts(compiled.source, names)
    )
    size = state * min(max(cores, most), most * part.block) + most * part.block * 8 * SERIES_COPIES * (len(names) + 1)
    runs = f"{most * part.block} runs" if most * part.block > 1 else "a run"
    check_memory(size * part.samples, f"{runs} of {part.samples:.0f} samples, under way at once,")


def _sum_existing_bytes(folder: Path) -> int:
    """Return the bytes of all files in a folder and its subfolders; 0 if it does not exist."""
    n_bytes = 0
    for directory, _, names in os.walk(folder):
        for name in names:
            with suppress(OSError):
                n_bytes += os.stat(os.path.join(directory, name)).st_size
    return n_bytes


@dataclass(frozen=True)
class Estimate:
    """Size of a study and its run time, extrapolated from trial runs."""

    runs: int
    blocks: int
    bytes: int
    seconds: float
    failed: int  # runs of the trial that failed
    tried: int
    reasons: tuple[str, ...]  # of these, each once


def estimate_study(plan: Plan, threads: int | None) -> Estimate:
    """Return size and run time of a study, extrapolated from a few runs of each part, which are not stored.

    threads: None means the number of cores. A trial shorter than MIN_TRIAL_S seconds is repeated, since the first time
    includes the start-up.
    """
    count = min(plan.each, TRIAL_RUNS_PER_THREAD * (threads or count_available_threads()))
    runs = np.unique(np.linspace(0, plan.each - 1, count).astype(int))
    seconds, size, failures = 0.0, 0, list[str]()
    for k, part in enumerate(plan.parts):
        job = plan.make_job(0, k, runs, threads)
        block, used = _run_timed_block(job, part.simulation)
        if used < MIN_TRIAL_S:
            block, used = _run_timed_block(job, part.simulation)
        seconds += used * plan.each / len(runs)
        numbers = len(plan.run_settings.measures) + 3 + (len(plan.run_settings.keep) + 1) * block.t.shape[-1]
        more = max(0, len(encode_block(block, plan.digest)) - 8 * numbers * len(runs))  # overhead of a file
        size += 2 * 8 * numbers * plan.each + more * math.ceil(plan.each / part.block)  # in blocks, and in the dataset
        failures += filter(None, block.failures)
    reasons = tuple(dict.fromkeys(failures))
    return Estimate(plan.runs, len(plan.blocks), size, seconds, len(failures), len(runs) * len(plan.parts), reasons)


def _run_timed_block(job: Job, simulation: Simulation) -> tuple[Block, float]:
    """Run a job and return its block and the wall time, s."""
    before = time.perf_counter()
    return run_block(job, simulation=simulation), time.perf_counter() - before

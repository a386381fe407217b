"""Bytes that runs of a scene take in memory, so that too many samples are told of before the first."""

from __future__ import annotations

from collections.abc import Collection

from gudgeon.contract.boundary import N_WORK
from gudgeon.files.room import check_memory
from gudgeon.model.compiled import CompiledModel
from gudgeon.model.evaluation import evaluated_bytes

OF_A_RUN = 1000  # bytes, about: a run's own lists and counts


def sample_bytes(compiled: CompiledModel) -> int:
    """Of one sample as methods keep it: its time, motion (of a kinematic scene q̈ too), works, memory and codes."""
    orders = 2 if compiled.source.degrees_of_freedom else 3
    numbers = 1 + orders * compiled.n + N_WORK + max(compiled.n_memory, 1)
    return 8 * numbers + max(len(compiled.source.clearances), 1)


def check_room(
    compiled: CompiledModel, samples: float, runs: int = 1, kept: Collection[str] | None = None,
    parts: Collection[str] = (), at_once: int = 1,
) -> None:  # fmt: skip
    """MemoryError where the samples of so many runs, each with as many, are more than there is memory for.

    kept: these series of each run in place of its states, which then lie there `at_once` runs at a time, with the
    `parts` that they follow from.
    """
    if kept is None:
        size = float(samples) * sample_bytes(compiled) * runs
    else:
        size = float(samples) * (sample_bytes(compiled) + evaluated_bytes(compiled, parts)) * min(runs, at_once)
        size += float(samples) * 8 * (len(kept) + 1) * runs
    size += runs * (OF_A_RUN + 16 * compiled.n_p) if runs > 1 else 0
    several = f"{runs} runs of {samples:.0f} samples each" if runs > 1 else f"{samples:.0f} samples"
    check_memory(size, several)

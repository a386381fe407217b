"""Random numbers of a study, the same every time: points of a draw, deviations of perturbed starts."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gudgeon.results.batch import Array

if TYPE_CHECKING:
    from gudgeon.generator.study.spec import Spread, Starts

RANDOM, LATIN, HALTON = "random", "latin_hypercube", "halton"
NORMAL, GEOMETRIC = "normal", "geometric"


def shares(method: str, count: int, width: int, seed: int) -> Array:
    """Points of the unit cube, (count, width): independent ones, or scipy.stats.qmc's, scrambled where they can be."""
    if method == RANDOM:
        return np.random.default_rng(seed).random((count, width))
    from scipy.stats import qmc

    if method == LATIN:
        return np.asarray(qmc.LatinHypercube(width, seed=seed).random(count))
    if method == HALTON:
        return np.asarray(qmc.Halton(width, seed=seed).random(count))
    return np.asarray(qmc.Sobol(width, seed=seed).random_base2(math.ceil(math.log2(count)))[:count])


def spread_over(spread: Spread, first: float, second: float, share: Array) -> Array:
    """Values at shares (n,) of a distribution: mean and standard deviation, or two ends (SI)."""
    if spread.kind == NORMAL:
        from scipy.special import ndtri

        return np.asarray(first + second * ndtri(share))
    if spread.kind == GEOMETRIC:
        return np.asarray(first * (second / first) ** share)
    return np.asarray(first + (second - first) * share)


def deviations(starts: Starts, names: list[str]) -> Array:
    """Of each ensemble, start and number, (n_ensembles, count, n_names): within −1 and 1, or normal with σ = 1.

    They are the same at every other coordinate of the study, so that runs can be compared start by start.
    """
    each = [np.random.default_rng([starts.seed, k]) for k in range(len(starts.ensembles))]
    shape = (starts.count, len(names))
    return np.stack([rng.standard_normal(shape) if starts.distribution == NORMAL else rng.uniform(-1.0, 1.0, shape)
                     for rng in each])  # fmt: skip

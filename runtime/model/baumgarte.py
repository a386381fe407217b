"""Select the parameter values of a motion: Baumgarte's gains are zero unless the method integrates with their terms."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.parameters import find_gain_indices

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import KernelSource
    from gudgeon.model.compiled import Array, CompiledModel


def has_baumgarte_terms(source: KernelSource, method: str) -> bool:
    """Return whether a method stabilizes the motion by Baumgarte's terms: rk4 in the full formulation."""
    return method == "rk4" and source.formulation == "full"


def select_motion_values(compiled: CompiledModel, method: str, p: Array) -> Array:
    """Return the values p (…, n_p) with which a method integrates and its samples are evaluated.

    They are `p` itself if the method has Baumgarte's terms, else a copy in which the gains are zero.
    """
    if has_baumgarte_terms(compiled.source, method):
        return p
    values = p.copy()
    values[..., _find_gain_values(compiled)] = 0.0
    return values


@cache_by_values
def _find_gain_values(compiled: CompiledModel) -> NDArray[np.intp]:
    """Return the indices of the values of p that are Baumgarte's gains or are derived from them."""
    source = compiled.source
    indices = find_gain_indices(source)
    values = np.zeros((2, len(source.parameters)))
    is_given = np.zeros(values.shape, bool)
    values[1, indices], is_given[:, indices] = 1.0, True
    without, with_gains = (compiled.prepare(*row) for row in zip(values, is_given, strict=True))
    return np.flatnonzero((without != with_gains) & ~(np.isnan(without) & np.isnan(with_gains)))

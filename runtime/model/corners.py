"""Where the corners of a slider with play are in their guide."""

from __future__ import annotations

import math

import numpy as np

from gudgeon.errors import SingularError
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.evaluation import CLEARANCE_COLUMNS

_DEPTH, _RATE = (CLEARANCE_COLUMNS.index(name) for name in ("delta", "deltadot"))


def corner_gap(
    compiled: CompiledModel, p: Array, t: float, q: Array, v: Array, number: int
) -> tuple[float, float]:  # fmt: skip
    """Penetration δ (m) and δ̇ (m/s) at joint with play `number`, a corner, at q, v (n,).

    Where the equations of motion have no solution it is NaN: the run itself tells.
    """
    memory = np.zeros(compiled.n_memory)
    memory[: len(compiled.source.clearances)] = math.nan
    try:
        found = compiled.evaluate([t], [q], [v], [memory], p, parts=("clearance",)).clearance[0, number]
    except SingularError:
        return math.nan, math.nan
    return float(found[_DEPTH]), float(found[_RATE])

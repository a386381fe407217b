"""Where the corners of a slider with play are in their guide."""

from __future__ import annotations

import math
from typing import TypeVar

import numpy as np

from gudgeon.contract.clearance_info import ClearanceInfo
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import SingularError
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.evaluation import CLEARANCE_COLUMNS

Number = TypeVar("Number", float, Array)
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


def corner_at(source: KernelSource, p: Array, joint: ClearanceInfo, offset: Number, tilt: Number) -> Number:
    """Return how much nearer to its wall than in the middle of the guide a corner is, m, of one position or of many.

    With the slider's offset o across the guide (m), its tilt φ (rad), half length a, half height b and corner radius r
    it is ±(o ± (a − r) sin φ) + (b − r) (cos φ − 1).
    """
    _, a, b, radius = slider_of(source, p, joint)
    front, upper = (1.0 if word in joint.name.rpartition(".")[2] else -1.0 for word in ("front", "upper"))
    across = offset + front * (a - radius) * np.sin(tilt)
    return upper * across + (b - radius) * (np.cos(tilt) - 1.0)


def slider_of(source: KernelSource, p: Array, joint: ClearanceInfo) -> tuple[str, float, float, float]:
    """A guide's address, half the slider's length and height and the radius of its corners, m."""
    guide = source.slots[joint.clearance].address.rpartition(".")[0]
    a, b, radius = (
        float(p[source.place[address]]) if (address := f"{guide}.{what}") in source.place else 0.0
        for what in ("half_length", "half_height", "corner_radius")
    )
    return guide, a, b, radius

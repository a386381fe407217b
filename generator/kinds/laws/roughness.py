"""What laws of mixed lubrication share: the roughness of both surfaces, and where its tips first touch.

The bearing's clearance c is that of the tips: at δ = 0 the highest of them touch. There the mean surfaces are still
Λ₀ σ apart, so that the film thickness ratio is Λ = h/σ = Λ₀ − δ/σ, h = c + Λ₀ σ − e, and the film, which fills the gap
between the mean surfaces, has the clearance c + Λ₀ σ: where the tips touch it is finite.
"""

from __future__ import annotations

from typing import Any

from gudgeon.generator.field import Bound, number
from gudgeon.generator.kinds.laws.law import MEAN_CLEARANCE, LawInputs
from gudgeon.language.units import LENGTH

ROUGHNESS = number(
    "roughness", "of both surfaces together: the root of the sum of the squares of their rms roughness", LENGTH,
    symbol=r"\sigma", required=True, bounds=(Bound(">", 0.0),),
)  # fmt: skip


def overlap(s: LawInputs, first: int, last: int) -> Any:
    """How much of the way from Λ = `first`, where tips touch, to `last`, where all does, is gone: δ's share, 1 at most.

    The film's clearance follows from `first`.
    """
    import sympy as sp

    sigma = s.parameters["roughness"]
    s.derive(MEAN_CLEARANCE, s.pair.c + first * sigma, "clearance between the mean surfaces")
    way = s.derive("overlap", (first - last) * sigma, "from where tips touch to where no film is left")
    return sp.Min(1, s.variables["delta"] / way)

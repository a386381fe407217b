"""Arguments that kernels share."""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.ir.kernels import Argument
from gudgeon.generator.ir.values import Place

# Corners: the sides that are held over a step (NULL: none), and where the switching functions go.
SIDES = (Argument("const double *", "side"), Argument("double *", "g"))

STATE = (Argument("const double", "t"), Argument("const double *", "q"), Argument("const double *", "v"))
MEMORY = Argument("const Memory *", "memory")
PARAMETERS = Argument("const Parameters *", "p")
ZERO = sp.Integer(0)


def acting_on(index: int) -> tuple[Place, ...]:
    """What the function of a joint with play is given behind its motion."""
    return tuple(map(Place, (f"memory->latch[{index}]", "p", "side", "g")))

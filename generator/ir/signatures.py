"""Arguments that kernels share."""

from __future__ import annotations

import sympy as sp

from gudgeon.generator.ir.kernels import Argument

# Corners: the sides that are held over a step (NULL: none), and where the switching functions go.
SIDES = (Argument("const double *", "side"), Argument("double *", "g"))

STATE = (Argument("const double", "t"), Argument("const double *", "q"), Argument("const double *", "v"))
MEMORY = Argument("const Memory *", "memory")
PARAMETERS = Argument("const Parameters *", "p")
ZERO = sp.Integer(0)
# Corners in functions that nobody asks for their switching functions.
HELD_SIDES = ("const double *const side = memory->held ? memory->side : NULL;", "double g[N_SWITCHES + 1];")

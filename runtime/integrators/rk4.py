"""Classical Runge–Kutta of order 4 with fixed step (W. Kutta, Z. Math. Phys. 46:435, 1901; engine/methods/rk4.c).

Every step is as long as was asked for, the last one as is left; outputs do not touch them. Samples between two steps
come from the cubic through both. Python is called once a chunk of steps and fetches impacts and events; C asks it on
the way whether to go on. In the full formulation constraints are stabilised by Baumgarte's terms (physics.md,
section 1), in the reduced one they are closed after every step.
"""

from __future__ import annotations

import math

CHUNK = 20_000  # steps of one call of C, which asks Python on its way (asking.py)
ADVICE = "the step {:.3g} s is too long for this scene: take a smaller one"
SAME = 1e-9  # share of the step by which the last one may differ and counts as equal: times are sums of rounded numbers


def last_step(duration: float, step: float) -> float:
    """Length (s) of the last of the steps over `duration`: `step`, or what is left (step_end in numbers.h)."""
    total = max(1, math.ceil(duration / step * (1.0 - 1e-12)))
    rest = duration - (total - 1) * step
    return step if abs(rest - step) < SAME * step else rest

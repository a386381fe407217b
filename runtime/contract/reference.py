"""Parameters that are given to a library when it is compared with values of the NumPy target (model/reference.py)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gudgeon.contract.kernel_source import Slot

GIVEN = 1.001  # times a parameter's default
GIVEN_ZERO = 0.001  # where that is zero


def given_parameters(slots: Sequence[Slot], first: int) -> dict[int, float]:
    """Return a value for every second slot from `first` on, by its number. Choices of a name keep their defaults."""
    own = [(k, slot) for k, slot in enumerate(slots) if k % 2 == first and not slot.words]
    return {k: GIVEN * slot.default or GIVEN_ZERO for k, slot in own if math.isfinite(slot.default)}

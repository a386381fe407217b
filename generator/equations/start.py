"""Values of the file's start, in the order in which the start reads them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gudgeon.generator.mechanism.mechanism import Quantity

if TYPE_CHECKING:
    from gudgeon.generator.equations.model import Model


def start_values(model: Model) -> dict[str, list[tuple[Quantity, int]]]:
    """Return the quantities of `guess`, `set` and `rates`, each with its sign; after the last two those of journals."""
    start, apart = model.scene.mechanism.start, apart_rows(model)
    slides = {c.joint.name for c in model.clearances if c.wall}
    signs = [-1 if model.all_rows[k].owner in slides else 1 for k, _, _ in apart]
    return {
        "guess": [(quantity, 1) for quantity in start.guess.values()],
        "set": [*((quantity, 1) for quantity in start.set.values()),
                *((e, sign) for (_, e, _), sign in zip(apart, signs, strict=True))],
        "rates": [*((quantity, 1) for quantity in start.rates.values()),
                  *((rate, sign) for (_, _, rate), sign in zip(apart, signs, strict=True))],
    }  # fmt: skip


def apart_rows(model: Model) -> list[tuple[int, Quantity, Quantity]]:
    """Rows of Φ that the start holds apart: where they are, and the eccentricity e and its rate there.

    Φ of such a joint is r_i − r_j = −e (physics.md, section 3), so that Φ + e = 0 and Φ_q v = ν − ė. That of a slider
    is its offset and its tilt, which are −e there (`start_kernel`).
    """
    given, found = model.scene.mechanism.start.play, []
    for name in model.scene.play:
        rows = [k for k, row in enumerate(model.all_rows) if row.owner == name and name in given]
        found += [(k, given[name].e[axis], given[name].rate[axis]) for axis, k in enumerate(rows)]
    return found

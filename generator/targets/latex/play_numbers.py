"""The numbers of a joint with play: a table of the file's, and what follows from them once a run."""

from __future__ import annotations

from typing import TYPE_CHECKING

import sympy as sp

from gudgeon.generator.mechanism.mechanism import Quantity
from gudgeon.generator.targets.latex.document import Block, Text, cells, paragraph, table
from gudgeon.generator.targets.latex.kinematics import equation
from gudgeon.generator.targets.latex.letters import of_latex
from gudgeon.generator.targets.latex.values import LONGEST, Values, as_written
from gudgeon.language.plot_units import pretty
from gudgeon.language.units import si_unit

if TYPE_CHECKING:
    from gudgeon.generator.targets.latex.play import JointWithPlay


def numbers(joint: JointWithPlay) -> list[Block]:
    """The letters of this joint, and what follows from them once a run."""
    slots, values, rows = joint.model.slots, Values(joint.model, joint.notation), []
    for quantity, sign, meaning in joint.numbers:
        entry = slots.entries.get(quantity.address)
        value: Text = (_apart(quantity),) if entry is None else values.in_si(entry)
        if entry is not None and entry.follows:
            value = (*values.followed(entry), joint.notation.math(sp.Float(entry.default, 17)))
        called = of_latex(sign) if entry is None else joint.notation.math(entry.symbol)
        rows.append(cells(called, meaning, quantity.address, value, pretty(si_unit(quantity.dimension)) or "-"))
    definitions = joint.model.symbols.definitions
    constants = dict.fromkeys([joint.clearance.pair.R_j, *joint.clearance.constants.values()])
    follow = [equation(s, joint.notation.expand(definitions[s]), joint.notation) for s in constants if s in definitions]
    header = cells("letter", "meaning", "address", "value in the file", "unit")
    return [*table(header, rows, (1,)), *values.below(), paragraph("From these follow once a run:"), *follow]


def _apart(quantity: Quantity) -> str:
    """What is no number of the run: 0, or an expression of the penetration, a long one where its equation stands."""
    written = "0" if quantity.is_zero else as_written(quantity.value)
    return written if len(written) <= LONGEST else "below"

"""A law whose force is an expression of the penetration: as SymPy, and whether it is a force that pushes."""

from __future__ import annotations

import numpy as np
import sympy as sp

from gudgeon.errors import BadValueError
from gudgeon.generator.mechanism.mechanism import Quantity, at_onset
from gudgeon.generator.symbols.from_expressions import quantity_to_sympy
from gudgeon.generator.symbols.numbers import Slots
from gudgeon.language.tree import evaluate

LOOKS = 400  # penetrations at which a force is looked at
_SMALLEST = 1e-6  # of the largest of them


def force_of(force: Quantity, delta: sp.Symbol, most: float, slots: Slots) -> sp.Expr:
    """The force in `delta` and the numbers of a run; `most` is the penetration (m) up to which it is looked at.

    What it is at δ = 0 becomes a number of the run where SymPy does not see that it is 0: every run then asks for it.
    Raises BadValueError for what is no number there, pulls, or has no slope at δ = 0.
    """

    def symbol(path: str) -> sp.Expr:
        if path == "delta":
            return delta
        known: sp.Symbol = slots.entries[f"parameters.{path}"].symbol
        slots.symbols.adopt(known)
        return known

    value = quantity_to_sympy(force, symbol)
    if not value.has(delta):
        hint = "expected an expression such as 1e8 N/m * delta: its terms cancel"
        raise BadValueError(f"{force.address} does not follow delta, the penetration", force.where, hint)
    _look(force, most, slots)
    _look_at_slope(force, value, delta, slots)
    if value.subs(delta, 0) != 0:
        slots.use(at_onset(force))
    return value


def _look(force: Quantity, most: float, slots: Slots) -> None:
    """Raise BadValueError where the force is no number or negative, with the scene's own numbers."""
    depths = np.union1d(np.geomspace(_SMALLEST * most, most, LOOKS // 2), np.linspace(0.0, most, LOOKS // 2)[1:])
    found = np.broadcast_to(evaluate(force.value, lambda path: depths if path == "delta" else np.float64(
        slots.entries[f"parameters.{path}"].default)), depths.shape)  # fmt: skip
    if len(wrong := np.flatnonzero(~(np.isfinite(found) & (found >= 0.0)))):
        depth, load = depths[wrong[0]], found[wrong[0]]
        hint = "expected a force that is not negative up to the clearance, or to the key 'deepest'"
        raise BadValueError(f"{force.address} is {load:.6g} N at delta = {depth:.6g} m", force.where, hint)


def _look_at_slope(force: Quantity, value: sp.Expr, delta: sp.Symbol, slots: Slots) -> None:
    """Raise BadValueError where the slope at δ = 0 is infinite: no Jacobian has it."""
    numbers = {entry.symbol: sp.Float(entry.default, 17) for entry in slots.entries.values()}
    slope = sp.diff(value, delta).xreplace(numbers).subs(delta, 0)
    if slope.has(sp.zoo, sp.nan, sp.oo, -sp.oo):
        hint = "expected a slope that is a number there: delta**n has one for n >= 1"
        raise BadValueError(f"{force.address} has no slope at delta = 0", force.where, hint)

"""Events of the user: where an expression of t and motion crosses zero, a run records the time, or ends.

A crossing is a change of sign: "rising" from below zero to above it, "falling" the other way, "both" either. A
zero that is touched and left on the side from which it was reached is none, and a run does not cross a zero on
which it starts: so it goes on from where an event ended another.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from gudgeon.errors import BadValueError
from gudgeon.generator.equations.fields import VariableNames
from gudgeon.generator.equations.geometry import Geometry
from gudgeon.generator.mechanism.mechanism import EventSpec
from gudgeon.generator.symbols.from_expressions import quantity_to_sympy

SIGNS = {"rising": 1, "falling": -1, "both": 0}


@dataclass(frozen=True)
class Event:
    """`expression` is in t and the symbols of bodies and points; action: "record" or "stop"."""

    name: str
    expression: sp.Expr
    action: str
    direction: str


def make_event(event: EventSpec, geometry: Geometry, t: sp.Symbol) -> Event:
    """One event of a scene. Raises BadValueError for an expression that is finite for no motion."""
    expression = quantity_to_sympy(event.zero, VariableNames(geometry, t))
    return Event(event.name, expression, event.action, event.direction)


def refuse_constant(event: EventSpec, made: Event, geometry: Geometry, t: sp.Symbol) -> None:
    """Raise BadValueError where nothing that moves is left in the expression; geometry: of absolute coordinates."""
    moving = {t, *(symbol for body in geometry.bodies.values() for symbol in (*body.q, *body.v))}
    if not geometry.symbols.explicit(made.expression).free_symbols & moving:
        message, hint = f"{event.zero.address} never changes: its terms cancel", "expected an expression that varies"
        raise BadValueError(message, event.zero.where, hint)

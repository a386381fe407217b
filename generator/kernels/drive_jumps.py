"""Corners of drives for `rk4`: functions of time alone, at whose zeros the rate of what is prescribed may jump.

The adaptive methods look for them along a step with all others (watched.py). rk4 keeps to its grid and to no sides; it
needs to know the times only, which hang on no state: a part of its step ends there (engine/watch/jumps.c).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.equations.notes import jumping_drives
from gudgeon.generator.ir.kernels import Kernel, Section
from gudgeon.generator.ir.signatures import ASIDE, PARAMETERS, TIME, result
from gudgeon.generator.ir.statements import Sides, Statement
from gudgeon.generator.symbols.corners import SideOf
from gudgeon.generator.symbols.storage import Place

_DOC = ("Switching functions that hang on time alone.",)


@dataclass(frozen=True)
class Jumps:
    """Values of `count` switching functions at a time, and their ranges over a part of it."""

    count: int
    values: Kernel
    ranges: Kernel


def jumps_of(dynamics: Kernel, model: Model) -> Jumps | None:
    """From what a right-hand side reads; None where no drive's rate may jump."""
    if not jumping_drives(model):
        return None
    known, corners = _of_time(dynamics)
    if not corners:
        return None
    read: set[str] = set()
    waiting = [symbol.name for g in corners for symbol in g.free_symbols]
    while waiting:
        name = waiting.pop()
        if name not in read:
            read.add(name)
            value = known[name].value
            waiting += [symbol.name for symbol in value.free_symbols] if isinstance(value, sp.Expr) else []
    needed = [s for name, s in known.items() if name in read]
    nested = any(isinstance(s.value, SideOf) for s in needed)
    outs = Section("corners", tuple(Statement(Place("out")[k], g) for k, g in enumerate(corners)))
    front = ((Sides("", held=False),), (Sides("nobody", held=False),)) if nested else ((), ())
    ranges, values = (Section("parameters and time", (*lines, *needed)) for lines in front)
    own, bounds = (TIME, PARAMETERS, result("out")), (TIME, PARAMETERS, ASIDE)
    kernel = replace(dynamics, doc=_DOC, status=False, inline=False)
    return Jumps(
        len(corners), replace(kernel, name="drive_corners", arguments=own, sections=(values, outs)),
        replace(kernel, name="drive_corner_ranges", arguments=bounds, sections=(ranges, outs)),
    )  # fmt: skip


def _of_time(dynamics: Kernel) -> tuple[dict[str, Statement], list[sp.Expr]]:
    """Locals that time and parameters determine, in their order; corners among them that hang on time."""
    known: dict[str, Statement] = {}
    timed: set[str] = set()
    corners: dict[sp.Expr, None] = {}
    for s in _statements(dynamics):
        if not isinstance(s.value, sp.Basic):
            if s.defines and isinstance(s.value, Place) and s.value.base in (TIME.name, PARAMETERS.name):
                known[s.defines] = s
                timed |= {s.defines} if s.value.base == TIME.name else set()
            continue
        names = {symbol.name for symbol in s.value.free_symbols}
        if not names <= known.keys() or not s.defines:
            continue
        known[s.defines] = s
        if names & timed:
            timed.add(s.defines)
            if isinstance(s.value, SideOf):
                corners[s.value.args[1]] = None
    return known, list(corners)


def _statements(kernel: Kernel) -> Iterator[Statement]:
    for section in kernel.sections:
        yield from (s for s in section.statements if isinstance(s, Statement))

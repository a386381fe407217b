"""Kinematically determined loops (driven chains): tree coordinates that the drives alone determine through loops.

A driven crank moves the rest of its four-bar as well, whatever else is attached to it. In the pattern of closures by
coordinates such parts are the square blocks of the decomposition of A. L. Dulmage and N. S. Mendelsohn (Canad. J.
Math. 10:517, 1958): the coordinates that no free one reaches along a maximum matching. They are functions of t like a
driven angle: positions by Newton's method on their own closures, rates by linear solves
(generator/kernels/driven_chains.py). All other equations have them as prescribed, with
    M_s s̈ + Φ_sᵀ λ = g_s − M_sc c̈,    Φ_s s̈ = γ − Φ_c c̈,
and the effort of the drives is their own equation's M_cs s̈ + M_cc c̈ − g_c.
The constraint equations of the model are independent (redundancy.py), and those of a block have entries in its
coordinates only, so that each block is regular except at dead centres.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import sympy as sp

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.loads import Friction
from gudgeon.generator.equations.system import DependentCoordinate, Motion, PrescribedCoordinate, System
from gudgeon.generator.reduction.frames import Frame
from gudgeon.generator.solvers.sparsity import Block, match_rows, triangular_blocks
from gudgeon.generator.symbols.storage import Place
from gudgeon.generator.symbols.symbols import Symbols

ZERO = sp.Integer(0)
MAX_BLOCK_ROWS = 8  # a larger block is cheaper to solve with its multipliers, which keeps zeros


@dataclass(frozen=True)
class Direction:
    """Cosine and sine of an angle that drives and loops determine, and its rates by the dependent coordinates."""

    cos: sp.Symbol
    sin: sp.Symbol
    turns: Mapping[int, sp.Expr]  # by number of the chains' coordinate


@dataclass(frozen=True)
class Chain:
    """The dependent coordinates by name, with their rates, and the closures that determine them, by blocks."""

    names: tuple[str, ...]
    known: tuple[DependentCoordinate, ...]
    rows: tuple[Row, ...]
    directions: tuple[Direction, ...] = ()  # once for all kernels


def with_directions(chain: Chain, system: System, frames: Iterable[Frame], prescribed: set[str]) -> Chain:
    """Return the chain with the directions in its closures: C stores their cosines and sines after q.

    `prescribed`: names of the coordinates that drives prescribe.
    """
    symbols = system.model.symbols
    read = _symbols_read(symbols, [x for row in chain.rows for x in (row.phi, row.phi_q_v, row.nu, row.gamma)])
    place = {name: k for k, name in enumerate(chain.names)}
    directions: list[Direction] = []
    for frame in frames:
        if frame.turns and set(frame.turns) <= {*place, *prescribed} and {frame.cos, frame.sin} & read:
            first = len(system.q) + len(chain.names) + 2 * len(directions)
            for k, symbol in enumerate((frame.cos, frame.sin)):
                symbols.info[symbol] = replace(symbols.info[symbol], home=Place("q")[first + k])
            turns = {place[name]: c for name, c in frame.turns.items() if name in place}
            directions.append(Direction(frame.cos, frame.sin, turns))
    return replace(chain, directions=tuple(directions))


def _symbols_read(symbols: Symbols, expressions: Iterable[sp.Expr]) -> set[sp.Symbol]:
    """Return all symbols that expressions read, directly or through definitions."""
    found: set[sp.Symbol] = set()
    waiting = [s for e in expressions for s in e.free_symbols]
    while waiting:
        symbol = waiting.pop()
        if symbol not in found:
            found.add(symbol)
            waiting.extend(symbols.definitions[symbol].free_symbols if symbol in symbols.definitions else ())
    return found


def find_blocks(pattern: Sequence[set[int]], n: int, banned: set[int]) -> list[Block]:
    """Return the square blocks in solving order; none contains a banned coordinate.

    `pattern`: coordinates by equation, for usable equations. A coordinate is free if it has no equation of its own, or
    if
    a free one reaches it. Coordinates of an equation without a coordinate of its own stay as they are.
    """
    owner = match_rows(pattern)
    free = {column for column in range(n) if column not in owner}
    grown = True
    while grown:  # from a free coordinate to its equations, and to the coordinates matched with these
        reached = {column for column, row in owner.items() if pattern[row] & free}
        grown = not reached <= free
        free |= reached
    matched = set(owner.values())
    rows = [r for r, columns in enumerate(pattern) if r in matched and not columns & free]
    columns = sorted(column for column, row in owner.items() if column not in free)
    place = {column: k for k, column in enumerate(columns)}
    blocks = triangular_blocks([{place[c] for c in pattern[r]} for r in rows], len(columns)) or ()
    doubtful = {c for r, entries in enumerate(pattern) if r not in matched for c in entries}
    found: list[Block] = []
    known: set[int] = set()
    for block in blocks:
        own = {columns[k] for k in block.columns}
        used = {c for r in block.rows for c in pattern[rows[r]]}
        if len(own) <= MAX_BLOCK_ROWS and used <= known | own and not own & (banned | doubtful):
            known |= own
            found.append(Block(tuple(rows[r] for r in block.rows), tuple(columns[k] for k in block.columns)))
    return found


def determined(system: System, held: set[str]) -> tuple[list[int], list[int]]:
    """Return the dependent coordinates and their equations by number; equations in `held` determine nothing.

    Friction that may stick needs a free coordinate: if the drives alone determine its slip, its force is part of the
    closures' multipliers, and the loop is not reduced.
    """
    place = {q: k for k, q in enumerate(system.q)}
    usable = [r for r, row in enumerate(system.rows) if row.name not in held]
    pattern = [{place[q] for q in system.rows[r].phi_q} for r in usable]
    slips = [{place[q] for q in friction.jacobian} for friction in system.frictions]
    banned: set[int] = set()
    while True:
        blocks = find_blocks(pattern, len(place), banned)
        known = {c for block in blocks for c in block.columns}
        stuck = {c for slip in slips if slip and slip <= known for c in slip}
        if not stuck:
            return [c for block in blocks for c in block.columns], [usable[r] for block in blocks for r in block.rows]
        banned |= stuck


S = TypeVar("S", bound=System)


def prescribe(system: S, names: Sequence[str], columns: Sequence[int], rows: Sequence[int]) -> tuple[S, Chain]:
    """Return the system with these coordinates as functions of t and without these equations, and the chain.

    `names` are those of all coordinates. In C the free coordinates come first in q, then the dependent ones; in v their
    rates, then second and third rates of the dependent ones.
    """
    kept = [k for k in range(len(system.q)) if k not in columns]
    known = _move_to_places(system, names, kept, columns)
    second = {k.q: k.second for k in known}
    rates = {k.q: k.rate for k in known}
    place = {k: i for i, k in enumerate(kept)}

    def mass(k: int, j: int) -> sp.Expr:
        """Return an entry of M, whose lower triangle is stored."""
        return system.mass.get((max(k, j), min(k, j)), ZERO)

    def applied(k: int) -> sp.Expr:
        """Return the applied force on a coordinate minus M c̈ of the dependent coordinates."""
        return sp.Add(system.applied[k], *(-mass(k, c) * x.second for c, x in zip(columns, known, strict=True)))

    given = tuple(_reduce_given(g, place, columns, known) for g in system.given)
    given += tuple(
        PrescribedCoordinate(names[c], x.rate, {place[k]: m for k in kept if (m := mass(k, c)) != 0}, applied(c))
        for c, x in zip(columns, known, strict=True)
    )
    others = tuple(_reduce_row(row, rates, second, system) for r, row in enumerate(system.rows) if r not in rows)
    frictions = tuple(_reduce_friction(friction, second) for friction in system.frictions)
    model = replace(system.model, rows=others, all_rows=others, frictions=frictions)
    motions = {body: _reduce_motion(motion, place, columns, known) for body, motion in system.motions.items()}
    reduced = replace(
        system,
        model=model,
        q=tuple(system.q[k] for k in kept),
        v=tuple(system.v[k] for k in kept),
        motions=motions,
        mass={(place[k], place[j]): m for (k, j), m in system.mass.items() if k in place and j in place},
        applied=tuple(applied(k) for k in kept),
        given=given,
        rows=others,
        frictions=frictions,
        known=known,
    )
    return reduced, Chain(tuple(names[c] for c in columns), known, tuple(system.rows[r] for r in rows))


def _move_to_places(
    system: System, names: Sequence[str], kept: Sequence[int], columns: Sequence[int]
) -> tuple[DependentCoordinate, ...]:
    """Move the coordinates and rates to their new places in C; return the dependent coordinates with their rates."""
    symbols = system.model.symbols
    info = symbols.info

    def move(symbol: sp.Symbol, home: Place) -> None:
        """Set the place at which C reads a symbol."""
        info[symbol] = replace(info[symbol], home=home)

    for i, k in enumerate((*kept, *columns)):
        move(system.q[k], Place("q")[i])
        move(system.v[k], Place("v")[i])
    known = []
    for i, c in enumerate(columns, len(system.q)):
        name = system.q[c].name
        second = symbols.new(f"{name}_second", Place("v")[i], names[c])
        third = symbols.new(f"{name}_third", Place("v")[i + len(columns)], names[c])
        known.append(DependentCoordinate(system.q[c], system.v[c], second, third))
    return tuple(known)


def _reduce_given(
    given: PrescribedCoordinate, place: Mapping[int, int], columns: Sequence[int], known: Sequence[DependentCoordinate]
) -> PrescribedCoordinate:
    """Return a prescribed coordinate with the dependent accelerations in its applied force."""
    pushed = (-given.mass[c] * x.second for c, x in zip(columns, known, strict=True) if c in given.mass)
    own = {place[k]: m for k, m in given.mass.items() if k in place}
    return replace(given, mass=own, applied=sp.Add(given.applied, *pushed))


def _reduce_row(
    row: Row, rates: Mapping[sp.Symbol, sp.Symbol], second: Mapping[sp.Symbol, sp.Symbol], system: System
) -> Row:
    """Return a constraint equation with Φ_s ṡ = ν − Φ_c ċ and Φ_s s̈ = γ − Φ_c c̈."""
    rate_of = dict(zip(system.q, system.v, strict=True))
    own = {q: entry for q, entry in row.phi_q.items() if q not in rates}
    moved = {q: entry for q, entry in row.phi_q.items() if q in rates}
    return replace(
        row,
        phi_q=own,
        phi_q_v=sp.Add(*(entry * rate_of[q] for q, entry in own.items())),
        nu=sp.Add(row.nu, *(-entry * rates[q] for q, entry in moved.items())),
        gamma=sp.Add(row.gamma, *(-entry * second[q] for q, entry in moved.items())),
    )


def _reduce_friction(friction: Friction, second: Mapping[sp.Symbol, sp.Symbol]) -> Friction:
    """Return a friction with J s̈ = γ − J_c c̈; the slip itself contains the dependent rates."""
    moved = (-entry * second[q] for q, entry in friction.jacobian.items() if q in second)
    own = {q: entry for q, entry in friction.jacobian.items() if q not in second}
    return replace(friction, jacobian=own, gamma=sp.Add(friction.gamma, *moved))


def _reduce_motion(
    motion: Motion, place: Mapping[int, int], columns: Sequence[int], known: Sequence[DependentCoordinate]
) -> Motion:
    """Return the motion of a body with J of the free coordinates; dependent accelerations are in the bias."""
    second = {c: x.second for c, x in zip(columns, known, strict=True)}
    bias = tuple(
        sp.Add(own, *(entry * second[k] for k, entry in line.items() if k in second))
        for line, own in zip(motion.jacobian, motion.bias, strict=True)
    )
    return Motion(tuple({place[k]: e for k, e in line.items() if k in place} for line in motion.jacobian), bias)

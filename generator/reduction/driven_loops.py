"""Detection of driven loops: closed loops of a linkage whose coordinates are determined by drives alone.

A driven crank moves the rest of its four-bar as well, whatever else is attached to it. In the pattern of closures by
coordinates such parts are the square blocks of the decomposition of A. L. Dulmage and N. S. Mendelsohn (Canad. J.
Math. 10:517, 1958): the coordinates that no free one reaches along a maximum matching. They are functions of t like a
driven angle: positions by Newton's method on their own closures, rates by linear solves
(generator/kernels/driven_loops.py). All other equations have them as prescribed, with
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
from gudgeon.generator.solvers.sparsity import Block, find_triangular_blocks, match_rows
from gudgeon.generator.symbols.storage import StorageLocation
from gudgeon.generator.symbols.symbols import Symbols

ZERO = sp.Integer(0)
MAX_BLOCK_ROWS = 8  # a larger block costs less with its multipliers, which keeps the system sparse


@dataclass(frozen=True)
class Direction:
    """Cosine and sine of an angle that drives and loops determine, and its rates by the dependent coordinates."""

    cos: sp.Symbol
    sin: sp.Symbol
    angle_coefficients: Mapping[int, sp.Expr]  # by number of the dependent coordinate


@dataclass(frozen=True)
class DrivenLoops:
    """The coordinates that drives determine through loops, by name, and the closures that determine them.

    `coordinates`: the dependent coordinates with symbols of their rates; `rows`: their closures, block by block in
    solving order. `directions`: cosines and sines of angles in these closures, stored once for all kernels.
    """

    names: tuple[str, ...]
    coordinates: tuple[DependentCoordinate, ...]
    rows: tuple[Row, ...]
    directions: tuple[Direction, ...] = ()  # once for all kernels


def add_directions(
    driven_loops: DrivenLoops, system: System, frames: Iterable[Frame], prescribed_names: set[str]
) -> DrivenLoops:
    """Return the driven loops with the directions in their closures, whose cosines and sines C stores after q.

    A direction counts if its angle depends on dependent and prescribed coordinates only and a closure reads it. The
    storage locations of its symbols are set. `frames`: all frames; `prescribed_names`: names of the coordinates that
    drives prescribe.
    """
    symbols = system.model.symbols
    read_symbols = _find_read_symbols(
        symbols, [x for row in driven_loops.rows for x in (row.phi, row.phi_q_v, row.nu, row.gamma)]
    )
    index_of = {name: k for k, name in enumerate(driven_loops.names)}
    directions: list[Direction] = []
    for frame in frames:
        if (
            frame.angle_coefficients
            and set(frame.angle_coefficients) <= {*index_of, *prescribed_names}
            and {frame.cos, frame.sin} & read_symbols
        ):
            first_index = len(system.q) + len(driven_loops.names) + 2 * len(directions)
            for k, symbol in enumerate((frame.cos, frame.sin)):
                symbols.info[symbol] = replace(
                    symbols.info[symbol], storage_location=StorageLocation("q")[first_index + k]
                )
            angle_coefficients = {index_of[name]: c for name, c in frame.angle_coefficients.items() if name in index_of}
            directions.append(Direction(frame.cos, frame.sin, angle_coefficients))
    return replace(driven_loops, directions=tuple(directions))


def _find_read_symbols(symbols: Symbols, expressions: Iterable[sp.Expr]) -> set[sp.Symbol]:
    """Return all symbols that expressions read, directly or through the definitions of derived symbols."""
    result: set[sp.Symbol] = set()
    pending = [s for expression in expressions for s in expression.free_symbols]
    while pending:
        symbol = pending.pop()
        if symbol not in result:
            result.add(symbol)
            pending.extend(symbols.definitions[symbol].free_symbols if symbol in symbols.definitions else ())
    return result


def find_blocks(pattern: Sequence[set[int]], n: int, excluded_coordinates: set[int]) -> list[Block]:
    """Return the square blocks of a Dulmage–Mendelsohn decomposition in solving order, as far as they can be used.

    `pattern`: coordinates in each usable equation; `n`: number of coordinates. A coordinate is free if it is
    unmatched, or if its equation contains a free one. Blocks contain no free or excluded coordinate, none of an
    unmatched equation, and read only coordinates of earlier blocks and their own. Blocks of more than MAX_BLOCK_ROWS
    equations are left out.
    """
    row_of_column = match_rows(pattern)
    free = {column for column in range(n) if column not in row_of_column}
    has_grown = True
    while has_grown:  # from a free coordinate to its equations, and to the coordinates matched with these
        reached = {column for column, row in row_of_column.items() if pattern[row] & free}
        has_grown = not reached <= free
        free |= reached
    matched = set(row_of_column.values())
    rows = [row_index for row_index, columns in enumerate(pattern) if row_index in matched and not columns & free]
    columns = sorted(column for column, row in row_of_column.items() if column not in free)
    position = {column: k for k, column in enumerate(columns)}
    blocks = (
        find_triangular_blocks(
            [{position[column] for column in pattern[row_index]} for row_index in rows], len(columns)
        )
        or ()
    )
    ambiguous = {column for row_index, entries in enumerate(pattern) if row_index not in matched for column in entries}
    result: list[Block] = []
    determined_columns: set[int] = set()
    for block in blocks:
        block_columns = {columns[k] for k in block.columns}
        read_columns = {column for row_index in block.rows for column in pattern[rows[row_index]]}
        if (
            len(block_columns) <= MAX_BLOCK_ROWS
            and read_columns <= determined_columns | block_columns
            and not block_columns & (excluded_coordinates | ambiguous)
        ):
            determined_columns |= block_columns
            result.append(
                Block(tuple(rows[row_index] for row_index in block.rows), tuple(columns[k] for k in block.columns))
            )
    return result


def find_dependent_coordinates(system: System, excluded_names: set[str]) -> tuple[list[int], list[int]]:
    """Return the numbers of the coordinates that drives determine through loops, and of the equations that give them.

    Equations in `excluded_names` determine nothing. A loop is left out if the drives alone would then determine the
    slip of a friction that may stick: its force would be part of the closures' multipliers.
    """
    index_of = {q: k for k, q in enumerate(system.q)}
    usable = [r for r, row in enumerate(system.rows) if row.name not in excluded_names]
    pattern = [{index_of[q] for q in system.rows[r].phi_q} for r in usable]
    slips = [{index_of[q] for q in friction.jacobian} for friction in system.frictions]
    excluded_coordinates: set[int] = set()
    while True:
        blocks = find_blocks(pattern, len(index_of), excluded_coordinates)
        dependent = {c for block in blocks for c in block.columns}
        fixed_slip = {
            c
            for slip_coordinates in slips
            if slip_coordinates and slip_coordinates <= dependent
            for c in slip_coordinates
        }
        if not fixed_slip:
            return [c for block in blocks for c in block.columns], [usable[r] for block in blocks for r in block.rows]
        excluded_coordinates |= fixed_slip


S = TypeVar("S", bound=System)


def prescribe_coordinates(
    system: S, names: Sequence[str], columns: Sequence[int], rows: Sequence[int]
) -> tuple[S, DrivenLoops]:
    """Return the system with some coordinates as functions of t, without their equations, and the driven loops.

    `names` are those of all coordinates; `columns` and `rows`: numbers of the dependent coordinates and of their
    equations. Sets storage locations: in C the free coordinates come first in q, then the dependent ones; in v their
    rates, then second and third rates of the dependent ones.
    """
    free = [k for k in range(len(system.q)) if k not in columns]
    dependent = _set_storage_locations(system, names, free, columns)
    second_rates = {k.q: k.second for k in dependent}
    rates = {k.q: k.rate for k in dependent}
    free_index = {k: i for i, k in enumerate(free)}

    def find_mass_entry(k: int, j: int) -> sp.Expr:
        """Return an entry of the symmetric M, whose lower triangle is stored."""
        return system.mass.get((max(k, j), min(k, j)), ZERO)

    def compute_applied_force(k: int) -> sp.Expr:
        """Return the applied force on coordinate k minus Σ M_kc c̈ of the dependent coordinates c."""
        return sp.Add(
            system.applied[k], *(-find_mass_entry(k, c) * x.second for c, x in zip(columns, dependent, strict=True))
        )

    prescribed = tuple(
        _reduce_prescribed_coordinate(coordinate, free_index, columns, dependent) for coordinate in system.prescribed
    )
    prescribed += tuple(
        PrescribedCoordinate(
            names[c],
            x.rate,
            {free_index[k]: m for k in free if (m := find_mass_entry(k, c)) != 0},
            compute_applied_force(c),
        )
        for c, x in zip(columns, dependent, strict=True)
    )
    remaining_rows = tuple(
        _reduce_row(row, rates, second_rates, system) for r, row in enumerate(system.rows) if r not in rows
    )
    frictions = tuple(_reduce_friction(friction, second_rates) for friction in system.frictions)
    model = replace(system.model, rows=remaining_rows, all_rows=remaining_rows, frictions=frictions)
    motions = {body: _reduce_motion(motion, free_index, columns, dependent) for body, motion in system.motions.items()}
    reduced = replace(
        system,
        model=model,
        q=tuple(system.q[k] for k in free),
        v=tuple(system.v[k] for k in free),
        motions=motions,
        mass={
            (free_index[k], free_index[j]): m
            for (k, j), m in system.mass.items()
            if k in free_index and j in free_index
        },
        applied=tuple(compute_applied_force(k) for k in free),
        prescribed=prescribed,
        rows=remaining_rows,
        frictions=frictions,
        dependent=dependent,
    )
    return reduced, DrivenLoops(tuple(names[c] for c in columns), dependent, tuple(system.rows[r] for r in rows))


def _set_storage_locations(
    system: System, names: Sequence[str], free_indices: Sequence[int], dependent_indices: Sequence[int]
) -> tuple[DependentCoordinate, ...]:
    """Set the storage locations (array and index in C) of coordinates and rates; return the dependent coordinates.

    In q free coordinates come before dependent ones, in v their rates likewise. New symbols for the second and third
    time derivatives of the dependent coordinates follow in v.
    `free_indices`, `dependent_indices`: numbers of the free and of the dependent coordinates; `names`: those of all
    coordinates.
    """
    symbols = system.model.symbols
    info = symbols.info

    def set_location(symbol: sp.Symbol, place: StorageLocation) -> None:
        """Set the storage location from which C reads a symbol."""
        info[symbol] = replace(info[symbol], storage_location=place)

    for i, k in enumerate((*free_indices, *dependent_indices)):
        set_location(system.q[k], StorageLocation("q")[i])
        set_location(system.v[k], StorageLocation("v")[i])
    dependent = []
    for i, c in enumerate(dependent_indices, len(system.q)):
        name = system.q[c].name
        second_derivative = symbols.add_symbol(f"{name}_second", StorageLocation("v")[i], names[c])
        third_derivative = symbols.add_symbol(
            f"{name}_third", StorageLocation("v")[i + len(dependent_indices)], names[c]
        )
        dependent.append(DependentCoordinate(system.q[c], system.v[c], second_derivative, third_derivative))
    return tuple(dependent)


def _reduce_prescribed_coordinate(
    prescribed: PrescribedCoordinate,
    new_index: Mapping[int, int],
    dependent_indices: Sequence[int],
    dependent_coordinates: Sequence[DependentCoordinate],
) -> PrescribedCoordinate:
    """Return a coordinate that a drive prescribes with M c̈ of the dependent coordinates c moved to its applied force.

    `new_index`: new number of each free coordinate; `dependent_indices`: old numbers of the dependent ones.
    """
    dependent_forces = (
        -prescribed.mass[c] * x.second
        for c, x in zip(dependent_indices, dependent_coordinates, strict=True)
        if c in prescribed.mass
    )
    free_mass = {new_index[k]: m for k, m in prescribed.mass.items() if k in new_index}
    return replace(prescribed, mass=free_mass, applied=sp.Add(prescribed.applied, *dependent_forces))


def _reduce_row(
    row: Row, rates: Mapping[sp.Symbol, sp.Symbol], second_rates: Mapping[sp.Symbol, sp.Symbol], system: System
) -> Row:
    """Return a constraint equation in the free coordinates s: Φ_s ṡ = ν − Φ_c ċ and Φ_s s̈ = γ − Φ_c c̈.

    c are the dependent coordinates. `rates`, `second_rates`: their first and second rates, by coordinate.
    """
    rate_of = dict(zip(system.q, system.v, strict=True))
    free_entries = {q: entry for q, entry in row.phi_q.items() if q not in rates}
    dependent_entries = {q: entry for q, entry in row.phi_q.items() if q in rates}
    return replace(
        row,
        phi_q=free_entries,
        phi_q_v=sp.Add(*(entry * rate_of[q] for q, entry in free_entries.items())),
        nu=sp.Add(row.nu, *(-entry * rates[q] for q, entry in dependent_entries.items())),
        gamma=sp.Add(row.gamma, *(-entry * second_rates[q] for q, entry in dependent_entries.items())),
    )


def _reduce_friction(friction: Friction, second_rates: Mapping[sp.Symbol, sp.Symbol]) -> Friction:
    """Return a friction element in the free coordinates s, J s̈ = γ − J_c c̈, with the dependent coordinates c.

    The slip itself is unchanged. `second_rates`: c̈ by coordinate.
    """
    dependent_terms = (-entry * second_rates[q] for q, entry in friction.jacobian.items() if q in second_rates)
    free_entries = {q: entry for q, entry in friction.jacobian.items() if q not in second_rates}
    return replace(friction, jacobian=free_entries, gamma=sp.Add(friction.gamma, *dependent_terms))


def _reduce_motion(
    motion: Motion,
    new_index: Mapping[int, int],
    dependent_indices: Sequence[int],
    dependent_coordinates: Sequence[DependentCoordinate],
) -> Motion:
    """Return the motion of a body by free coordinates only: the dependent coordinates' accelerations join the bias.

    `new_index`: new number of each free coordinate; `dependent_indices`: old numbers of the dependent ones.
    """
    second_rates = {c: x.second for c, x in zip(dependent_indices, dependent_coordinates, strict=True)}
    bias = tuple(
        sp.Add(bias_entry, *(entry * second_rates[k] for k, entry in row_entries.items() if k in second_rates))
        for row_entries, bias_entry in zip(motion.jacobian, motion.bias, strict=True)
    )
    return Motion(
        tuple({new_index[k]: e for k, e in row_entries.items() if k in new_index} for row_entries in motion.jacobian),
        bias,
    )

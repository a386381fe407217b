"""Solution of Φ_q x = r with the constraint Jacobian Φ_q, where there are as many constraint equations as coordinates.

A linkage without degrees of freedom consists of groups of bodies that can be placed one after the other (the Assur
groups of kinematics, mostly dyads: two equations in two angles). In Φ_q they are the diagonal blocks of its block
triangular form: match every equation with a coordinate of its own, then take the strongly connected components of
their dependences, in order (A. Pothen, C.-J. Fan, ACM Trans. Math. Softw. 16:303, 1990). One equation is a division,
two are Cramer's rule, larger blocks are factorized densely with pivoting at run time (engine/scene/block.c).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import sqrt

import sympy as sp

from gudgeon.generator.equations.system import System
from gudgeon.generator.ir.kernels import KernelBuilder
from gudgeon.generator.ir.signatures import Number
from gudgeon.generator.ir.statements import Call, Declare, Guard
from gudgeon.generator.ir.values import Test, Threshold
from gudgeon.generator.solvers.pivots import SINGULAR
from gudgeon.generator.solvers.sparsity import Block, find_triangular_blocks
from gudgeon.generator.symbols.storage import StorageLocation
from gudgeon.generator.symbols.switches import ComparedMagnitude

ZERO = sp.Integer(0)
# A block is singular when its determinant is less than this fraction of its largest value for any direction of its
# arms: the sine of an angle, where KKT compares its square.
SINGULAR_SQUARE = Threshold("SINGULAR_SQUARE", sqrt(SINGULAR))


@dataclass(frozen=True)
class Solver:
    """Solver of one block at a state: the inverse of its pivot or determinant, or the name of its factors."""

    block: Block
    inverse: sp.Expr = ZERO
    name: str = ""


class SquareSystem:
    """Solution of Φ_q x = r as statements, for as many equations as coordinates; unusable unless `is_solvable`."""

    def __init__(self, system: System, is_slide: Sequence[bool]) -> None:
        """Find the blocks of the system's equations; `is_slide`: whether each coordinate is a length, not an angle."""
        rows, q = system.rows, system.q
        coordinate_index = {symbol: k for k, symbol in enumerate(q)}
        self._symbols, self._q, self._is_slide = system.model.symbols, tuple(q), is_slide
        self.names = [row.name.replace(".", "_").replace("=", "_") for row in rows]
        self.unknowns = [symbol.name for symbol in q]
        self.entries: list[Mapping[int, sp.Expr]] = [
            {coordinate_index[s]: c for s, c in row.phi_q.items()} for row in rows
        ]
        self.blocks = find_triangular_blocks([set(entries) for entries in self.entries], len(q))

    @property
    def is_solvable(self) -> bool:
        """Return whether there are as many equations as coordinates and each can be matched with one of its own."""
        return self.blocks is not None

    @property
    def max_block_size(self) -> int:
        """Return the number of equations of the largest block; more than two need engine/scene/block.c."""
        return max((len(block.rows) for block in self.blocks or ()), default=0)

    def factorize(self, builder: KernelBuilder) -> list[Solver]:
        """Append the factorization of all blocks and return their solvers, in solving order.

        The printed function fails with the number, from 1, of an equation of the block that is singular.
        """
        builder.begin_section("blocks of constraint equations that are solved one after the other")
        solvers = []
        for block in self.blocks or ():
            size = min(len(block.rows), 3)
            solvers.append(
                (self._factorize_single, self._factorize_pair, self._factorize_dense)[size - 1](builder, block)
            )
        return solvers

    def _factorize_single(self, builder: KernelBuilder, block: Block) -> Solver:
        """Return the solver of a block of one equation: 1/pivot, with a test of the pivot unless that is a number.

        The pivot is compared with a bound of its magnitude for any direction of the arms.
        """
        (row,), (column,) = block.rows, block.columns
        pivot = self.entries[row][column]
        if pivot.is_Number:
            return Solver(block, 1 / pivot)
        pivot_local = builder.append_local(f"pivot_{self.names[row]}", pivot)
        builder.append_instruction(
            Guard(
                Test(
                    pivot_local,
                    ">",
                    (SINGULAR_SQUARE, self._compute_entry_bound(builder, row, column, block)),
                    compares_magnitude=True,
                ),
                row + 1,
            )
        )
        return Solver(block, builder.append_local(f"inverse_{self.names[row]}", 1 / pivot_local))

    def _factorize_pair(self, builder: KernelBuilder, block: Block) -> Solver:
        """Return the solver of a block of two equations by Cramer's rule, with a test of its determinant.

        The determinant is compared with a bound of its magnitude for any direction of the arms.
        """
        name = f"{self.names[block.rows[0]]}__{self.names[block.rows[1]]}"
        (a, b), (c, d) = self._extract_block(block)
        determinant = builder.append_local(f"determinant_{name}", a * d - b * c)
        (A, B), (C, D) = ([self._compute_entry_bound(builder, r, k, block) for k in block.columns] for r in block.rows)
        bound = builder.append_local(f"bound_{name}", A * D + B * C)
        builder.append_instruction(
            Guard(Test(determinant, ">", (SINGULAR_SQUARE, bound), compares_magnitude=True), block.rows[1] + 1)
        )
        return Solver(block, builder.append_local(f"inverse_{name}", 1 / determinant))

    def _compute_entry_bound(self, builder: KernelBuilder, row: int, column: int, block: Block) -> sp.Expr:
        """Return a bound of the magnitude of an entry for any direction of its arms, at most twice the largest value.

        For an angle it is |c| + |∂c/∂θ|, for a slide the sum of |c| over the block's slides, so that units are not
        mixed. A longer expression becomes a local.
        """
        entries = self.entries[row]
        if self._is_slide[column]:
            magnitude = sp.Add(*(sp.Abs(entries.get(k, ZERO)) for k in block.columns if self._is_slide[k]))
        else:
            entry = entries.get(column, ZERO)
            magnitude = sp.Abs(entry) + sp.Abs(self._symbols.differentiate(entry, self._q[column]))
        if magnitude.is_Number:
            return magnitude
        return builder.append_local(
            f"size_{self.names[row]}__{self.unknowns[column]}", magnitude.replace(sp.Abs, ComparedMagnitude)
        )

    def _factorize_dense(self, builder: KernelBuilder, block: Block) -> Solver:
        """Return the solver of a block of three or more equations, which the engine factorizes with pivoting.

        If the block is singular at run time, the function fails with the number of the block's first equation.
        """
        n, name = len(block.rows), self._symbols.make_unique_name(f"block_{self.names[block.rows[0]]}")
        values, order = f"{name}_values", f"{name}_order"
        builder.append_instruction(Declare(Number.REAL, values, (n * n,)))
        builder.append_instruction(Declare(Number.INTEGER, order, (n,)))
        for k, value in enumerate(value for row in self._extract_block(block) for value in row):
            builder.append_store(StorageLocation(values)[k], value)
        factorization = Call("factor_block", (sp.Integer(n),), (StorageLocation(values), StorageLocation(order)))
        builder.append_instruction(Guard(factorization, block.rows[0] + 1))
        return Solver(block, name=name)

    def _extract_block(self, block: Block) -> list[list[sp.Expr]]:
        """Return the entries of a block as rows, zeros included."""
        return [[self.entries[r].get(c, ZERO) for c in block.columns] for r in block.rows]

    def solve(
        self, builder: KernelBuilder, solvers: Sequence[Solver], rhs: Sequence[sp.Expr], prefix: str
    ) -> list[sp.Expr]:
        """Append the solution x of Φ_q x = `rhs` and return its components in the order of the coordinates.

        `solvers`: the result of `factorize`; `rhs`: one value for each equation; `prefix` begins the names of the
        locals.
        """
        x: dict[int, sp.Expr] = {}
        for solver in solvers:
            block = solver.block
            block_rhs = [
                rhs[r] - sum((c * x[k] for k, c in self.entries[r].items() if k in x), ZERO) for r in block.rows
            ]
            if len(block_rhs) > 1:
                block_rhs = [
                    builder.append_local(f"{prefix}_rest_{self.names[r]}", value)
                    if len(value.free_symbols) > 1
                    else value
                    for r, value in zip(block.rows, block_rhs, strict=True)
                ]
            for k, value in zip(block.columns, self._solve_block(builder, solver, block_rhs, prefix), strict=True):
                x[k] = builder.append_local(f"{prefix}_{self.unknowns[k]}", value)
        return [x[k] for k in range(len(self.unknowns))]

    def _solve_block(
        self, builder: KernelBuilder, solver: Solver, rhs: Sequence[sp.Expr], prefix: str
    ) -> Sequence[sp.Expr | StorageLocation]:
        """Return the unknowns of one block for its right-hand side `rhs`, one value for each of its equations.

        Blocks of one and two equations are solved by expressions. A larger one appends a call of the engine; the
        result is then read from an array. `prefix` begins the names of its locals.
        """
        if len(rhs) == 1:
            return [rhs[0] * solver.inverse]
        if len(rhs) == 2:
            (a, b), (c, d) = self._extract_block(solver.block)
            return [(d * rhs[0] - b * rhs[1]) * solver.inverse, (a * rhs[1] - c * rhs[0]) * solver.inverse]
        name, n = self._symbols.make_unique_name(f"{solver.name}_{prefix}"), len(rhs)
        builder.append_instruction(Declare(Number.REAL, name, (n,)))
        for k, value in enumerate(rhs):
            builder.append_store(StorageLocation(name)[k], value)
        arguments = (sp.Integer(n), StorageLocation(f"{solver.name}_values"), StorageLocation(f"{solver.name}_order"))
        builder.append_instruction(Call("solve_block", arguments, (StorageLocation(name),)))
        return [StorageLocation(name)[k] for k in range(n)]

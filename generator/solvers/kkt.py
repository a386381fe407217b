"""The KKT system [M Φ_qᵀ; Φ_q 0][x; λ] = [b; r], factorized (L D Lᵀ) and solved by straight-line statements.

Each entry of its symbolic L D Lᵀ (generator/solvers/sparsity.py) becomes a named temporary; numbers and single symbols
are written in place. The pivots of coordinates are masses, or what elimination leaves of them. The pivot of a
constraint equation is compared with its value if the equation were independent of the others. In absolute coordinates
most equations give one coordinate by others and are eliminated together with it (dependent_coordinates.py).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import sympy as sp

from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.system import System
from gudgeon.generator.ir.kernels import KernelBuilder
from gudgeon.generator.ir.statements import Guard
from gudgeon.generator.ir.values import Conditional, Test, Threshold
from gudgeon.generator.solvers.dependent_coordinates import FirstPivots, is_unit
from gudgeon.generator.solvers.pivots import (
    EARLY,
    LIGHT_PIVOT,
    SINGULAR,
    VANISHING,
    ZERO,
    Factor,
    append_local_if_composite,
    find_row_pairs,
    make_pivot_guard,
)
from gudgeon.generator.solvers.sparsity import Elimination, choose_elimination
from gudgeon.generator.symbols.symbol_sums import add_products, subtract_products

Entries = dict[tuple[int, int], sp.Expr]
FACTORS = "L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0]"  # title of a section


class KKT:
    """Prints factorization and solution of the KKT system; nodes are coordinates, then constraint equations."""

    def __init__(self, system: System, rows: Sequence[Row] | None = None, allow_early_pairs: bool = False) -> None:
        """Choose the elimination order of a system with its equations, or with other `rows`.

        With other rows friction elements are left out. `allow_early_pairs`: both equations of a joint may be eliminated
        early. Such a pivot vanishes where links are in line although the system is regular; the code at which
        `factorize` jumps must then solve it.
        """
        self.system, self.n = system, len(system.q)
        self.rows = system.rows if rows is None else tuple(rows)
        self.frictions, self.first_friction = system.frictions if rows is None else (), self.n + len(self.rows)
        coordinate_index = {q: k for k, q in enumerate(system.q)}
        self.entries = {(i, j): value for (i, j), value in system.mass.items() if i != j}
        for row_index, jacobian in enumerate(
            (*(row.phi_q for row in self.rows), *(friction.jacobian for friction in self.frictions))
        ):
            self.entries |= {(self.n + row_index, coordinate_index[q]): value for q, value in jacobian.items()}
        neighbours: list[set[int]] = [set() for _ in range(self.first_friction + len(self.frictions))]
        for row_index, column in self.entries:
            neighbours[row_index].add(column)
            neighbours[column].add(row_index)
        pattern = tuple(map(frozenset, neighbours))
        early_pairs = find_row_pairs(self.rows, self.n, pattern) if allow_early_pairs else {}
        self.first_pivots = FirstPivots(system, self.rows)
        self.elimination: Elimination = choose_elimination(
            pattern, self.n, self.first_friction, early_pairs, self.first_pivots.order, self.first_pivots.partner
        )
        names = [row.name for row in self.rows] + [friction.name for friction in self.frictions]
        self.names = [q.name for q in system.q] + [name.replace(".", "_") for name in names]
        self.blocks = self._group_pivots()
        self.stick_symbols: dict[int, sp.Symbol] = {}  # node -> 1 in stick, 0 in slip
        self.pivots = tuple(names[k - self.n] for k in self.elimination.order if k >= self.n)
        self.inertias_of_angles = (
            self._find_inertias_of_angles() if self.rows and not system.model.has_intermittent_constraints else {}
        )
        if not system.in_tree:
            self.pivots += tuple(system.model.symbols.info[system.q[k]].meaning for k in self.inertias_of_angles)

    def _group_pivots(self) -> list[list[int]]:
        """Return the pivots as blocks of one or two nodes, in elimination order.

        A node is the number of a coordinate, then of a constraint equation, then of a friction. Two in a block are a
        coordinate with the equation that gives it, or neighbours of the same kind that elimination couples.
        """
        order, structure = self.elimination.order, self.elimination.structure
        changed_nodes = {i for column in structure.values() for i in column}
        blocks: list[list[int]] = []
        for k in order:
            last_block = blocks[-1] if blocks else []
            if k in self.first_pivots.partner.values():
                last_block.append(k)
                continue
            is_same_kind = (
                len(last_block) == 1
                and (last_block[0] < self.n) == (k < self.n)
                and {last_block[0], k} <= changed_nodes
            )
            if is_same_kind and k < self.first_friction and structure[last_block[0]] == (k, *structure[k]):
                last_block.append(k)
            else:
                blocks.append([k])
        return blocks

    def _find_inertias_of_angles(self) -> dict[int, sp.Expr]:
        """Return, by angle, the moment of inertia about the joints with which the angle's pivot is compared.

        Angles in a block with an equation are left out, and those whose inertia is their entry of M anyway, or 0.
        """
        single_nodes = [k for block in self.blocks for k in block if block[-1] < self.n]
        inertia_of_angle = {k: self.system.compute_inertia_about_joints(k) for k in single_nodes}
        return {
            k: inertia for k, inertia in inertia_of_angle.items() if inertia != 0 and inertia != self.system.mass[k, k]
        }

    def factorize(
        self,
        builder: KernelBuilder,
        jump_on_failure: bool = False,
        threshold: Threshold = SINGULAR,
        pair_threshold: Threshold = VANISHING,
    ) -> Factor:
        """Append the statements of L and D⁻¹ of the KKT matrix, with tests of the pivots, and return both.

        A pivot of an equation fails if it is below `threshold` times its size. With `jump_on_failure` the function then
        jumps to the code for vanishing pivots, else it returns the pivot's number, from 1. `pair_threshold`: the
        threshold for the two equations of a joint relative to their common size.
        """
        builder.begin_section(FACTORS)
        L: Entries = {}
        W: Entries = {}  # entries before the division by their pivot
        inverse: dict[int, dict[int, sp.Expr]] = {}
        earlier_columns: dict[int, list[int]] = {
            k: [] for k in self.elimination.order
        }  # columns with an entry in row k
        n_rows = 0
        for block in self.blocks:
            inverse |= self._invert_block(
                builder, block, earlier_columns, (L, W), (jump_on_failure, n_rows), (threshold, pair_threshold)
            )
            n_rows += sum(k >= self.n for k in block)
            later_nodes = [i for i in self.elimination.structure[block[-1]]]
            for i in later_nodes:
                for k in block:
                    common_columns = [j for j in earlier_columns[k] if (i, j) in L]
                    value = self.entries.get((i, k), self.entries.get((k, i), ZERO))
                    value = subtract_products(value, ((L[i, j], W[k, j]) for j in common_columns))
                    W[i, k] = append_local_if_composite(builder, f"w_{self.names[i]}__{self.names[k]}", value)
                for k in block:
                    value = add_products(ZERO, ((W[i, j], entry) for j, entry in inverse[k].items()))
                    L[i, k] = append_local_if_composite(builder, f"l_{self.names[i]}__{self.names[k]}", value)
            for i in later_nodes:
                earlier_columns[i] += block
        return Factor(L, inverse)

    def _invert_block(
        self,
        builder: KernelBuilder,
        block: Sequence[int],
        earlier_columns: Mapping[int, Sequence[int]],
        factors: tuple[Entries, Entries],
        on_failure: tuple[bool, int],
        thresholds: tuple[Threshold, Threshold],
    ) -> dict[int, dict[int, sp.Expr]]:
        """Return D⁻¹ of a block of one or two nodes, {node: {node: entry}}, and append its statements.

        Nodes are coordinates, then equations. `earlier_columns`: columns with an entry in each row; `factors`: L and W
        so far, W before the division by the pivots. `on_failure`: whether a vanishing pivot jumps, and the number of
        equations before the block. `thresholds`: those of one equation and of a joint's pair.
        """
        (L, W), (jump_on_failure, count) = factors, on_failure
        if block[0] in self.first_pivots.partner:
            return self._invert_coordinate_with_row(builder, block, earlier_columns, L, W)
        if len(block) == 2:
            return self._invert_pair(builder, block, earlier_columns, factors, on_failure, thresholds)
        (k,) = block
        if k < self.n:
            return {k: {k: self._invert_coordinate_pivot(builder, k, earlier_columns[k], L, W, jump_on_failure)}}
        return {
            k: {
                k: self._invert_row_pivot(
                    builder, k, earlier_columns[k], L, W, (jump_on_failure, count + 1), thresholds[0]
                )
            }
        }

    def _invert_coordinate_with_row(
        self,
        builder: KernelBuilder,
        block: Sequence[int],
        earlier_columns: Mapping[int, Sequence[int]],
        L: Mapping[tuple[int, int], sp.Expr],
        W: Mapping[tuple[int, int], sp.Expr],
    ) -> dict[int, dict[int, sp.Expr]]:
        """Return D⁻¹ of a coordinate with its equation: [m c; c 0]⁻¹ = [0 1/c; 1/c −m/c²] with the constant entry c.

        The result is {node: {node: entry}}, as `_invert_block` returns it. m is what elimination leaves of the mass; no
        pivot is tested.
        """
        k, row = block
        entry = self.entries[row, k]
        inverse_entry = (
            entry
            if is_unit(entry)
            else self.system.model.parameter_table.derive_parameter(f"inverse_{self.names[row]}", 1 / entry)
        )
        mass = subtract_products(self.system.mass[k, k], ((L[k, j], W[k, j]) for j in earlier_columns[k]))
        mass = append_local_if_composite(builder, f"inertia_{self.names[k]}", mass)
        return {
            k: {row: inverse_entry},
            row: {k: inverse_entry, row: -mass if is_unit(entry) else -mass * inverse_entry**2},
        }

    def _invert_pair(
        self,
        builder: KernelBuilder,
        block: Sequence[int],
        earlier_columns: Mapping[int, Sequence[int]],
        factors: tuple[Entries, Entries],
        on_failure: tuple[bool, int],
        thresholds: tuple[Threshold, Threshold],
    ) -> dict[int, dict[int, sp.Expr]]:
        """Return the inverse of a 2 × 2 block of D by its determinant, and append its statements with tests.

        The block has two coordinates or two constraint equations. D of equations is negative definite; its negative is
        formed and tested. Arguments and result are those of `_invert_block`.
        """
        L, W = factors
        first, second = block
        is_row_pair = first >= self.n
        mass = {
            (i, k): ZERO if is_row_pair else self.system.mass.get((max(i, k), min(i, k)), ZERO)
            for i in block
            for k in block
        }

        def compute_schur_entry(i: int, k: int, is_included: Callable[[int], bool]) -> sp.Expr:
            """Return entry (i, k) of the Schur complement; of two equations its negative.

            It is the entry of M minus Σ L W over the earlier columns j that `is_included(j)` selects. For two
            equations, whose entry is 0, it is Σ L W itself, which is positive on the diagonal.
            """
            eliminated = ((L[i, j], W[k, j]) for j in earlier_columns[i] if (k, j) in L and is_included(j))
            return add_products(ZERO, eliminated) if is_row_pair else subtract_products(mass[i, k], eliminated)

        name = [self.names[k] for k in block]
        scale_values = [compute_schur_entry(k, k, lambda j: j < self.n) for k in block] if is_row_pair else []
        scale = [builder.append_local(f"scale_{name[i]}", value) for i, value in enumerate(scale_values)]
        size = [
            self._compute_pivot_scale(builder, k, pivot_values)
            for k, pivot_values in zip(block, scale, strict=is_row_pair)
        ]
        pivots = [compute_schur_entry(k, k, lambda j: j >= self.n or not is_row_pair) for k in block]
        values = (
            [pivot_values + is_included for pivot_values, is_included in zip(scale, pivots, strict=True)]
            if is_row_pair
            else pivots
        )
        pivot_values = [append_local_if_composite(builder, f"pivot_{name[i]}", value) for i, value in enumerate(values)]
        cross_entry = append_local_if_composite(
            builder, f"pivot_{name[0]}__{name[1]}", compute_schur_entry(second, first, lambda j: True)
        )
        determinant = builder.append_local(
            f"determinant_{name[0]}__{name[1]}", pivot_values[0] * pivot_values[1] - cross_entry**2
        )
        if is_row_pair:
            is_early = any(i < self.n for i in self.elimination.structure[second])
            threshold = max(thresholds[0], EARLY) if is_early else thresholds[0]
            builder.append_instruction(make_pivot_guard(*on_failure, 1, pivot_values[0], threshold, size[0]))
            builder.append_instruction(
                make_pivot_guard(*on_failure, 2, determinant, threshold, size[1], pivot_values[0])
            )
            self._append_joint_pivot_tests(
                builder, block, scale, (pivot_values[0], determinant), (*on_failure, thresholds[1])
            )
        elif on_failure[0]:
            self._append_small_inertia_test(builder, first, pivot_values[0])
            self._append_small_inertia_test(builder, second, determinant, pivot_values[0])
        inverse = builder.append_local(f"inverse_{name[0]}__{name[1]}", (-1 if is_row_pair else 1) / determinant)
        inverse_first, inverse_second = (
            builder.append_local(f"inverse_pivot_{name[i]}", pivot_values[1 - i] * inverse) for i in range(2)
        )
        inverse_cross = builder.append_local(f"inverse_cross_{name[0]}__{name[1]}", -cross_entry * inverse)
        return {
            first: {first: inverse_first, second: inverse_cross},
            second: {first: inverse_cross, second: inverse_second},
        }

    def _compute_pivot_scale(self, builder: KernelBuilder, k: int, scale: sp.Symbol) -> sp.Symbol:
        """Return the size with which the pivot of equation k is compared in the test for a zero pivot.

        k is the number of the node. The size is `scale` in tree coordinates, for the equations of the first pivots,
        for friction, and for an equation without x and y. Otherwise Σ Φ_q²/m of the coordinates x and y is added, in a
        new local. Where bodies are in line, an equation that closes a loop may vanish as a whole once dependent
        coordinates are eliminated from it.
        """
        if self.system.in_tree or k in self.first_pivots.rows or k >= self.first_friction:
            return scale
        entries = self.rows[k - self.n].phi_q.items()
        coordinate_index = {q: j for j, q in enumerate(self.system.q)}
        mobility = sp.Add(
            *(
                entry**2 / self.system.mass[coordinate_index[q], coordinate_index[q]]
                for q, entry in entries
                if coordinate_index[q] % 3 < 2
            )
        )
        if self.system.model.parameter_table.is_constant(mobility):
            mobility = self.system.model.parameter_table.derive_parameter(
                f"mobility_{self.names[k]}", mobility, "1/m of the bodies of a row"
            )
        return builder.append_local(f"size_{self.names[k]}", scale + mobility) if mobility != 0 else scale

    def _append_joint_pivot_tests(
        self,
        builder: KernelBuilder,
        block: Sequence[int],
        scale: Sequence[sp.Symbol],
        pivots: tuple[sp.Expr, sp.Expr],
        on_failure: tuple[bool, int, Threshold],
    ) -> None:
        """Append tests of the pivots of a joint's x and y against the sum of their sizes; only in tree coordinates.

        One of these equations vanishes as a whole where bodies are in line, and is not small compared with itself
        there. `block`: both nodes; `scale`: their sizes; `pivots`: the first pivot and the determinant. `on_failure`:
        whether failure jumps, the number of equations before the block, and the threshold.
        """
        first_row, second_row = (self.rows[k - self.n] for k in block)
        if not self.system.in_tree or first_row.owner != second_row.owner or first_row.unit != second_row.unit:
            return
        size = builder.append_local(f"size_{self.names[block[0]]}", scale[0] + scale[1])
        jumps, n_before, threshold = on_failure
        builder.append_instruction(make_pivot_guard(jumps, n_before, 1, pivots[0], threshold, size))
        builder.append_instruction(make_pivot_guard(jumps, n_before, 2, pivots[1], threshold, size, pivots[0]))

    def _invert_coordinate_pivot(
        self,
        builder: KernelBuilder,
        k: int,
        earlier_columns: Sequence[int],
        L: Mapping[tuple[int, int], sp.Expr],
        W: Mapping[tuple[int, int], sp.Expr],
        jump_on_failure: bool,
    ) -> sp.Expr:
        """Return 1/D of coordinate k, with D = M_kk − Σ L W over the columns that are eliminated before it.

        It is a derived parameter if there are no such columns and M_kk is constant, else a new local. With
        `jump_on_failure`, the pivot of a coordinate in `inertias_of_angles` is tested first; 1/D is then a local also
        for a constant M_kk whose default is not positive.
        """
        mass = self.system.mass[k, k]
        if jump_on_failure and k in self.inertias_of_angles:
            value = subtract_products(mass, ((L[k, j], W[k, j]) for j in earlier_columns))
            pivot = append_local_if_composite(builder, f"pivot_{self.names[k]}", value)
            self._append_small_inertia_test(builder, k, pivot)
            constant = self.system.model.parameter_table.is_constant(mass)
            if earlier_columns or not constant or self.system.model.parameter_table.compute_default(mass) <= 0.0:
                return builder.append_local(f"inverse_pivot_{self.names[k]}", 1 / pivot)
        if not earlier_columns and self.system.model.parameter_table.is_constant(mass):
            inverse: sp.Expr = self.system.model.parameter_table.derive_parameter(
                f"inverse_{self._make_mass_name(mass, k)}", 1 / mass, "1/M"
            )
            return inverse
        value = subtract_products(mass, ((L[k, j], W[k, j]) for j in earlier_columns))
        return builder.append_local(f"inverse_pivot_{self.names[k]}", 1 / value)

    def _append_small_inertia_test(
        self, builder: KernelBuilder, k: int, pivot: sp.Expr, *earlier_pivots: sp.Expr
    ) -> None:
        """Append a jump to the code for vanishing pivots if elimination leaves nearly no inertia of the angle k.

        The bound is LIGHT_PIVOT times its entry in `inertias_of_angles`; nothing is appended for a coordinate without
        one. `pivot` is its own pivot times those in `earlier_pivots`, by which the bound is multiplied too. The status
        is the number of equations and friction elements plus the position of the angle in `inertias_of_angles`, from 1.
        """
        if k in self.inertias_of_angles:
            status = len(self.rows) + len(self.frictions) + 1 + list(self.inertias_of_angles).index(k)
            builder.append_instruction(
                Guard(Test(pivot, ">", (LIGHT_PIVOT, self.inertias_of_angles[k], *earlier_pivots)), status, True)
            )

    def _make_mass_name(self, mass: sp.Expr, k: int) -> str:
        """Return the name of M_kk for derived parameters: that of the mass's symbol, else "mass_<coordinate>"."""
        return mass.name if isinstance(mass, sp.Symbol) else f"mass_{self.names[k]}"

    def _invert_row_pivot(
        self,
        builder: KernelBuilder,
        k: int,
        earlier_columns: Sequence[int],
        L: Mapping[tuple[int, int], sp.Expr],
        W: Mapping[tuple[int, int], sp.Expr],
        on_failure: tuple[bool, int],
        threshold: Threshold,
    ) -> sp.Expr:
        """Return 1/D of an equation, negative, after a test that −D exceeds `threshold` times the equation's size.

        −D is the sum of L W over the columns that are eliminated before it. A NaN fails the test too. `on_failure`:
        whether failure jumps, and the pivot's number. The equation of a friction element is tested only while it
        sticks; if it slips, 0 is returned, so that its multiplier is zero.
        """
        name = self.names[k]
        eliminated = add_products(ZERO, ((L[k, j], W[k, j]) for j in earlier_columns if j < self.n))
        scale = builder.append_local(f"scale_{name}", eliminated)
        pivot: sp.Expr = scale
        earlier_rows = [j for j in earlier_columns if j >= self.n]
        if earlier_rows:
            value = add_products(scale, ((L[k, j], W[k, j]) for j in earlier_rows))
            pivot = builder.append_local(f"pivot_{name}", value)
        test, (jump_on_failure, status) = (
            Test(pivot, ">", (threshold, self._compute_pivot_scale(builder, k, scale))),
            on_failure,
        )
        if k < self.first_friction:
            builder.append_instruction(Guard(test, status, jump_on_failure))
            return -builder.append_local(f"inverse_pivot_{name}", 1 / pivot)
        stick = self.stick_symbols[k]  # a row that slips is switched off: its multiplier is zero
        is_sticking = Test(stick, "!=", (0.0,))
        builder.append_instruction(Guard(test, status, jump_on_failure, is_sticking))
        return -builder.append_local(f"inverse_pivot_{name}", Conditional(is_sticking, 1 / pivot, ZERO))

    def solve(
        self, builder: KernelBuilder, factor: Factor, b: Mapping[int, sp.Expr], prefix: str = ""
    ) -> dict[int, sp.Expr]:
        """Append the forward and backward substitution; return the solution by node: accelerations, then multipliers.

        `factor`: the result of `factorize`. `b`: the right-hand side by node (number of coordinate, equation,
        friction), absent ones zero; `prefix` begins the names of the locals.
        """
        builder.begin_section("forward substitution")
        columns: dict[int, list[int]] = {k: [] for k in self.elimination.order}
        for i, k in factor.L:
            columns[i].append(k)
        z: dict[int, sp.Expr] = {}
        for k in self.elimination.order:
            value = subtract_products(b.get(k, ZERO), ((factor.L[k, j], z[j]) for j in columns[k]))
            z[k] = append_local_if_composite(builder, f"{prefix}z_{self.names[k]}", value)
        builder.begin_section("backward substitution")
        x: dict[int, sp.Expr] = {}
        for k in reversed(self.elimination.order):
            value = add_products(ZERO, ((z[j], entry) for j, entry in factor.inverse[k].items()))
            later = (i for i in self.elimination.structure[k] if (i, k) in factor.L)
            value = subtract_products(value, ((factor.L[i, k], x[i]) for i in later))
            kind = "acceleration" if k < self.n else "lambda"
            x[k] = builder.append_local(f"{prefix}{kind}_{self.names[k]}", value)
        return x

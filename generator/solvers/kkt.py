"""The KKT system [M Φ_qᵀ; Φ_q 0][x; λ] = [b; r], factorized and solved by straight-line statements.

Each entry of its symbolic L D Lᵀ (generator/solvers/sparsity.py) becomes a named temporary; numbers and single
symbols are written in place. The pivots of coordinates are masses, or what elimination leaves of them. The pivot of a
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
    named,
    pivot_guard,
    row_pairs,
)
from gudgeon.generator.solvers.sparsity import Elimination, choose_elimination

Entries = dict[tuple[int, int], sp.Expr]
FACTORS = "L D L^T of the KKT matrix [M Phi_q^T; Phi_q 0]"  # title of a section


class KKT:
    """Prints factorization and solution of the KKT system; nodes are coordinates, then constraint equations."""

    def __init__(self, system: System, rows: Sequence[Row] | None = None, allow_early_pairs: bool = False) -> None:
        """Choose the elimination order of a system with its equations, or with other `rows`.

        `allow_early_pairs`: both equations of a joint may be eliminated early. Such a pivot vanishes where links are
        in line although
        the system is regular; the code at which `factorize` jumps must then solve it.
        """
        self.system, self.n = system, len(system.q)
        self.rows = system.rows if rows is None else tuple(rows)
        self.frictions, self.first_friction = system.frictions if rows is None else (), self.n + len(self.rows)
        place = {q: k for k, q in enumerate(system.q)}
        self.entry = {(i, j): value for (i, j), value in system.mass.items() if i != j}
        for r, linear in enumerate((*(row.phi_q for row in self.rows), *(f.jacobian for f in self.frictions))):
            self.entry |= {(self.n + r, place[q]): value for q, value in linear.items()}
        near: list[set[int]] = [set() for _ in range(self.first_friction + len(self.frictions))]
        for r, c in self.entry:
            near[r].add(c)
            near[c].add(r)
        pattern = tuple(map(frozenset, near))
        pairs = row_pairs(self.rows, self.n, pattern) if allow_early_pairs else {}
        self.first = FirstPivots(system, self.rows)
        self.elimination: Elimination = choose_elimination(
            pattern, self.n, self.first_friction, pairs, self.first.order, self.first.partner
        )
        names = [row.name for row in self.rows] + [friction.name for friction in self.frictions]
        self.names = [q.name for q in system.q] + [name.replace(".", "_") for name in names]
        self.blocks = self._blocks()
        self.sticks: dict[int, sp.Symbol] = {}  # node -> 1 in stick, 0 in slip
        self.pivots = tuple(names[k - self.n] for k in self.elimination.order if k >= self.n)
        self.turning = self._turning() if self.rows and not system.model.has_changing_constraints else {}
        if not system.in_tree:
            self.pivots += tuple(system.model.symbols.info[system.q[k]].meaning for k in self.turning)

    def _blocks(self) -> list[list[int]]:
        """Return the pivots as blocks of one or two nodes: coordinates with their equations, and coupled neighbours."""
        order, structure = self.elimination.order, self.elimination.structure
        changed = {i for column in structure.values() for i in column}
        blocks: list[list[int]] = []
        for k in order:
            last = blocks[-1] if blocks else []
            if k in self.first.partner.values():
                last.append(k)
                continue
            alike = len(last) == 1 and (last[0] < self.n) == (k < self.n) and {last[0], k} <= changed
            if alike and k < self.first_friction and structure[last[0]] == (k, *structure[k]):
                last.append(k)
            else:
                blocks.append([k])
        return blocks

    def _turning(self) -> dict[int, sp.Expr]:
        """Return the angles that are pivots by themselves, with the inertia that turns with them.

        An angle is left out if that inertia is its entry of M anyway.
        """
        single = [k for block in self.blocks for k in block if block[-1] < self.n]
        found = {k: self.system.turning_inertia(k) for k in single}
        return {k: size for k, size in found.items() if size != 0 and size != self.system.mass[k, k]}

    def factorize(
        self, build: KernelBuilder, jumps: bool = False, share: Threshold = SINGULAR, size: Threshold = VANISHING
    ) -> Factor:
        """Append the statements of L and D⁻¹; a pivot below `share` of its size ends or leaves the function.

        With `jumps` it jumps to the code for vanishing pivots, else the function returns the pivot's number, from 1.
        `size`: the same threshold for both equations of a joint together.
        """
        build.section(FACTORS)
        L: Entries = {}
        W: Entries = {}  # entries before the division by their pivot
        inverse: dict[int, dict[int, sp.Expr]] = {}
        earlier: dict[int, list[int]] = {k: [] for k in self.elimination.order}  # columns with an entry in row k
        count = 0
        for block in self.blocks:
            inverse |= self._pivots(build, block, earlier, (L, W), (jumps, count), (share, size))
            count += sum(k >= self.n for k in block)
            later = [i for i in self.elimination.structure[block[-1]]]
            for i in later:
                for k in block:
                    shared = [j for j in earlier[k] if (i, j) in L]
                    value = self.entry.get((i, k), self.entry.get((k, i), ZERO))
                    value -= sum((L[i, j] * W[k, j] for j in shared), ZERO)
                    W[i, k] = named(build, f"w_{self.names[i]}__{self.names[k]}", value)
                for k in block:
                    value = sum((W[i, j] * entry for j, entry in inverse[k].items()), ZERO)
                    L[i, k] = named(build, f"l_{self.names[i]}__{self.names[k]}", value)
            for i in later:
                earlier[i] += block
        return Factor(L, inverse)

    def _pivots(
        self,
        build: KernelBuilder,
        block: Sequence[int],
        earlier: Mapping[int, Sequence[int]],
        made: tuple[Entries, Entries],
        failing: tuple[bool, int],
        shares: tuple[Threshold, Threshold],
    ) -> dict[int, dict[int, sp.Expr]]:
        """Return D⁻¹ of a block by node; `made` are L and W so far.

        `failing`: whether a vanishing pivot jumps, and the number of equations before the block.
        """
        (L, W), (jumps, count) = made, failing
        if block[0] in self.first.partner:
            return self._dependent(build, block, earlier, L, W)
        if len(block) == 2:
            return self._pair(build, block, earlier, made, failing, shares)
        (k,) = block
        if k < self.n:
            return {k: {k: self._coordinate_pivot(build, k, earlier[k], L, W, jumps)}}
        return {k: {k: self._row_pivot(build, k, earlier[k], L, W, (jumps, count + 1), shares[0])}}

    def _dependent(
        self,
        build: KernelBuilder,
        block: Sequence[int],
        earlier: Mapping[int, Sequence[int]],
        L: Mapping[tuple[int, int], sp.Expr],
        W: Mapping[tuple[int, int], sp.Expr],
    ) -> dict[int, dict[int, sp.Expr]]:
        """Return D⁻¹ of a coordinate with its equation: [m c; c 0]⁻¹ = [0 1/c; 1/c −m/c²] with the constant entry c."""
        k, row = block
        entry = self.entry[row, k]
        over = entry if is_unit(entry) else self.system.model.slots.derive(f"inverse_{self.names[row]}", 1 / entry)
        mass = self.system.mass[k, k] - sum((L[k, j] * W[k, j] for j in earlier[k]), ZERO)
        mass = named(build, f"inertia_{self.names[k]}", mass)
        return {k: {row: over}, row: {k: over, row: -mass if is_unit(entry) else -mass * over**2}}

    def _pair(
        self,
        build: KernelBuilder,
        block: Sequence[int],
        earlier: Mapping[int, Sequence[int]],
        made: tuple[Entries, Entries],
        failing: tuple[bool, int],
        shares: tuple[Threshold, Threshold],
    ) -> dict[int, dict[int, sp.Expr]]:
        """Return the inverse of a 2 × 2 block by its determinant; for equations, D is negative."""
        L, W = made
        first, second = block
        rows = first >= self.n
        mass = {
            (i, k): ZERO if rows else self.system.mass.get((max(i, k), min(i, k)), ZERO) for i in block for k in block
        }

        def left(i: int, k: int, of: Callable[[int], bool]) -> sp.Expr:
            """Return what elimination leaves of entry (i, k), with the earlier columns j for which `of` holds."""
            done = sum((L[i, j] * W[k, j] for j in earlier[i] if (k, j) in L and of(j)), ZERO)
            return done if rows else mass[i, k] - done

        name = [self.names[k] for k in block]
        scales = [left(k, k, lambda j: j < self.n) for k in block] if rows else []
        scale = [build.local(f"scale_{name[i]}", value) for i, value in enumerate(scales)]
        size = [self._size(build, k, own) for k, own in zip(block, scale, strict=rows)]
        pivots = [left(k, k, lambda j: j >= self.n or not rows) for k in block]
        values = [own + of for own, of in zip(scale, pivots, strict=True)] if rows else pivots
        own = [named(build, f"pivot_{name[i]}", value) for i, value in enumerate(values)]
        cross = named(build, f"pivot_{name[0]}__{name[1]}", left(second, first, lambda j: True))
        determinant = build.local(f"determinant_{name[0]}__{name[1]}", own[0] * own[1] - cross**2)
        if rows:
            early = any(i < self.n for i in self.elimination.structure[second])
            share = max(shares[0], EARLY) if early else shares[0]
            build.line(pivot_guard(failing, 1, own[0], share, size[0]))
            build.line(pivot_guard(failing, 2, determinant, share, size[1], own[0]))
            self._test_joint_pivots(build, block, scale, (own[0], determinant), (*failing, shares[1]))
        elif failing[0]:
            self._test_light_pivot(build, first, own[0])
            self._test_light_pivot(build, second, determinant, own[0])
        inverse = build.local(f"inverse_{name[0]}__{name[1]}", (-1 if rows else 1) / determinant)
        one, two = (build.local(f"inverse_pivot_{name[i]}", own[1 - i] * inverse) for i in range(2))
        both = build.local(f"inverse_cross_{name[0]}__{name[1]}", -cross * inverse)
        return {first: {first: one, second: both}, second: {first: both, second: two}}

    def _size(self, build: KernelBuilder, k: int, scale: sp.Symbol) -> sp.Symbol:
        """Return the size with which the pivot of an equation is compared.

        In absolute coordinates it is at least what the masses in the equation make of it. Where links are in line, an
        equation that closes a loop may vanish as a whole once dependent coordinates are eliminated from it.
        """
        if self.system.in_tree or k in self.first.rows or k >= self.first_friction:
            return scale
        entries = self.rows[k - self.n].phi_q.items()
        place = {q: j for j, q in enumerate(self.system.q)}
        own = sp.Add(*(entry**2 / self.system.mass[place[q], place[q]] for q, entry in entries if place[q] % 3 < 2))
        if self.system.model.slots.is_constant(own):
            own = self.system.model.slots.derive(f"mobility_{self.names[k]}", own, "1/m of the bodies of a row")
        return build.local(f"size_{self.names[k]}", scale + own) if own != 0 else scale

    def _test_joint_pivots(
        self,
        build: KernelBuilder,
        block: Sequence[int],
        scale: Sequence[sp.Symbol],
        found: tuple[sp.Expr, sp.Expr],
        failing: tuple[bool, int, Threshold],
    ) -> None:
        """Append tests of the pivots of a joint's x and y against the sum of their sizes.

        `found`: the first pivot and the determinant. In tree coordinates one of these equations vanishes as a whole
        where
        links are in line, and is not small compared with itself there.
        """
        one, two = (self.rows[k - self.n] for k in block)
        if not self.system.in_tree or one.owner != two.owner or one.unit != two.unit:
            return
        size = build.local(f"size_{self.names[block[0]]}", scale[0] + scale[1])
        *failed, least = failing
        build.line(pivot_guard(failed, 1, found[0], least, size))
        build.line(pivot_guard(failed, 2, found[1], least, size, found[0]))

    def _coordinate_pivot(
        self,
        build: KernelBuilder,
        k: int,
        earlier: Sequence[int],
        L: Mapping[tuple[int, int], sp.Expr],
        W: Mapping[tuple[int, int], sp.Expr],
        jumps: bool,
    ) -> sp.Expr:
        """Return 1/D of a coordinate; if it is a mass alone, it is a derived parameter."""
        mass = self.system.mass[k, k]
        if jumps and k in self.turning:
            value = mass - sum((L[k, j] * W[k, j] for j in earlier), ZERO)
            pivot = named(build, f"pivot_{self.names[k]}", value)
            self._test_light_pivot(build, k, pivot)
            constant = self.system.model.slots.is_constant(mass)
            if earlier or not constant or self.system.model.slots.default(mass) <= 0.0:
                return build.local(f"inverse_pivot_{self.names[k]}", 1 / pivot)
        if not earlier and self.system.model.slots.is_constant(mass):
            inverse: sp.Expr = self.system.model.slots.derive(f"inverse_{self._mass_name(mass, k)}", 1 / mass, "1/M")
            return inverse
        value = mass - sum((L[k, j] * W[k, j] for j in earlier), sp.Integer(0))
        return build.local(f"inverse_pivot_{self.names[k]}", 1 / value)

    def _test_light_pivot(self, build: KernelBuilder, k: int, pivot: sp.Expr, *before: sp.Expr) -> None:
        """Append a jump for an angle of which elimination leaves nearly no inertia.

        `pivot` is its own pivot times those in `before`.
        """
        if k in self.turning:
            number = len(self.rows) + len(self.frictions) + 1 + list(self.turning).index(k)
            build.line(Guard(Test(pivot, ">", (LIGHT_PIVOT, self.turning[k], *before)), number, True))

    def _mass_name(self, mass: sp.Expr, k: int) -> str:
        """Return the name of the mass of node k in derived parameters."""
        return mass.name if isinstance(mass, sp.Symbol) else f"mass_{self.names[k]}"

    def _row_pivot(
        self,
        build: KernelBuilder,
        k: int,
        earlier: Sequence[int],
        L: Mapping[tuple[int, int], sp.Expr],
        W: Mapping[tuple[int, int], sp.Expr],
        failed: tuple[bool, int],
        least: Threshold,
    ) -> sp.Expr:
        """Return 1/D of an equation: D = −scale + what earlier equations explain; NaN fails the test too."""
        name = self.names[k]
        own = sum((L[k, j] * W[k, j] for j in earlier if j < self.n), sp.Integer(0))
        scale = build.local(f"scale_{name}", own)
        pivot: sp.Expr = scale
        others = [j for j in earlier if j >= self.n]
        if others:
            value = scale + sum((L[k, j] * W[k, j] for j in others), sp.Integer(0))
            pivot = build.local(f"pivot_{name}", value)
        test, (jumps, number) = Test(pivot, ">", (least, self._size(build, k, scale))), failed
        if k < self.first_friction:
            build.line(Guard(test, number, jumps))
            return -build.local(f"inverse_pivot_{name}", 1 / pivot)
        stick = self.sticks[k]  # a row that slips is switched off: its multiplier is zero
        sticks = Test(stick, "!=", (0.0,))
        build.line(Guard(test, number, jumps, sticks))
        return -build.local(f"inverse_pivot_{name}", Conditional(sticks, 1 / pivot, ZERO))

    def solve(
        self, build: KernelBuilder, factor: Factor, b: Mapping[int, sp.Expr], prefix: str = ""
    ) -> dict[int, sp.Expr]:
        """Return the solution by node for a right-hand side `b` by node (absent: zero).

        It appends the forward and backward substitution; `prefix` begins the names of its locals.
        """
        build.section("forward substitution")
        columns: dict[int, list[int]] = {k: [] for k in self.elimination.order}
        for i, k in factor.L:
            columns[i].append(k)
        z: dict[int, sp.Expr] = {}
        for k in self.elimination.order:
            value = b.get(k, sp.Integer(0)) - sum(
                (factor.L[k, j] * z[j] for j in columns[k] if z[j] != 0), sp.Integer(0)
            )
            z[k] = named(build, f"{prefix}z_{self.names[k]}", value)
        build.section("backward substitution")
        x: dict[int, sp.Expr] = {}
        for k in reversed(self.elimination.order):
            value = sum((z[j] * entry for j, entry in factor.inverse[k].items()), ZERO)
            value -= sum((factor.L[i, k] * x[i] for i in self.elimination.structure[k] if (i, k) in factor.L), ZERO)
            kind = "acceleration" if k < self.n else "lambda"
            x[k] = build.local(f"{prefix}{kind}_{self.names[k]}", value)
        return x

"""The KKT system [M Φ_qᵀ; Φ_q 0][x; λ] = [b; r] as straight-line statements.

Its symbolic L D Lᵀ (generator/factorization.py) becomes one named temporary an entry; entries that
are a number or a single symbol are written in place. The pivots of coordinates are masses, or what
elimination leaves of them; the pivot of a row is compared with what it would be if the row were
independent of the others.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import sympy as sp

from gudgeon.generator.constraints import Row
from gudgeon.generator.factorization import Elimination, choose_elimination
from gudgeon.generator.kernels import KernelBuilder
from gudgeon.generator.system import System

# A row counts as dependent when less than this share of its pivot is left after elimination: the
# share is the squared sine of the angle between the row and the others, rounding leaves some 1e-15.
SINGULAR = 1e-13
# Below this share the row is nearly dependent: drift δ of the constraints would act as δ/share^(1/2) there.
# The rank-revealing way (templates/c/singular.c.jinja) leaves it out for the moment if the others agree.
NEARLY_SINGULAR = 1e-8


@dataclass(frozen=True)
class Factor:
    """L by (row node, column node), 1/D by node: numbers, symbols, or negatives of symbols."""

    L: Mapping[tuple[int, int], sp.Expr]
    inverse: Mapping[int, sp.Expr]


class KKT:
    """Emits factorization and solution of a scene's KKT system; nodes are coordinates, then rows."""

    def __init__(self, system: System, rows: Sequence[Row] | None = None) -> None:
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
        self.elimination: Elimination = choose_elimination(tuple(map(frozenset, near)), self.n, self.first_friction)
        names = [row.name for row in self.rows] + [friction.name for friction in self.frictions]
        self.names = [q.name for q in system.q] + [name.replace(".", "_") for name in names]
        self.sticks: dict[int, sp.Symbol] = {}  # node -> 1 in stick, 0 in slip
        self.pivots = tuple(names[k - self.n] for k in self.elimination.order if k >= self.n)

    def factorize(self, build: KernelBuilder, failed: str = "return {}", share: float = SINGULAR) -> Factor:
        """Statements for L and 1/D; `failed` is what a pivot below its `share` does, its number, from 1, for {}."""
        build.section("L D L^T of the KKT matrix")
        L: dict[tuple[int, int], sp.Expr] = {}
        W: dict[tuple[int, int], sp.Expr] = {}  # entries before the division by their pivot
        inverse: dict[int, sp.Expr] = {}
        earlier: dict[int, list[int]] = {k: [] for k in self.elimination.order}  # columns with an entry in row k
        count = 0
        for k in self.elimination.order:
            if k < self.n:
                inverse[k] = self._coordinate_pivot(build, k, earlier[k], L, W)
            else:
                count += 1
                inverse[k] = self._row_pivot(build, k, earlier[k], L, W, failed.format(count), share)
            for i in self.elimination.structure[k]:
                shared = [j for j in earlier[k] if (i, j) in L]
                value = self.entry.get((i, k), self.entry.get((k, i), sp.Integer(0)))
                value -= sum((L[i, j] * W[k, j] for j in shared), sp.Integer(0))
                W[i, k] = self._named(build, f"w_{self.names[i]}__{self.names[k]}", value)
                L[i, k] = self._named(build, f"l_{self.names[i]}__{self.names[k]}", W[i, k] * inverse[k])
                earlier[i].append(k)
        return Factor(L, inverse)

    def _coordinate_pivot(
        self, build: KernelBuilder, k: int, earlier: Sequence[int],
        L: Mapping[tuple[int, int], sp.Expr], W: Mapping[tuple[int, int], sp.Expr],
    ) -> sp.Expr:  # fmt: skip
        """1/D of a coordinate: of a mass alone it is a number of `prepare`."""
        mass = self.system.mass[k, k]
        if not earlier and not mass.free_symbols & set(self.system.model.symbols.rules):
            inverse: sp.Expr = self.system.model.slots.derive(f"inverse_{self._mass_name(mass, k)}", 1 / mass, "1/M")
            return inverse
        value = mass - sum((L[k, j] * W[k, j] for j in earlier), sp.Integer(0))
        return build.local(f"inverse_pivot_{self.names[k]}", 1 / value)

    def _mass_name(self, mass: sp.Expr, k: int) -> str:
        return mass.name if isinstance(mass, sp.Symbol) else f"mass_{self.names[k]}"

    def _row_pivot(
        self, build: KernelBuilder, k: int, earlier: Sequence[int],
        L: Mapping[tuple[int, int], sp.Expr], W: Mapping[tuple[int, int], sp.Expr], failed: str,
        least: float,
    ) -> sp.Expr:  # fmt: skip
        """1/D of a row: D = −scale + what earlier rows explain; NaN fails the comparison with the scale too."""
        name = self.names[k]
        own = sum((L[k, j] * W[k, j] for j in earlier if j < self.n), sp.Integer(0))
        scale = build.local(f"scale_{name}", own)
        pivot: sp.Expr = scale
        others = [j for j in earlier if j >= self.n]
        if others:
            value = scale + sum((L[k, j] * W[k, j] for j in others), sp.Integer(0))
            pivot = build.local(f"pivot_{name}", value)
        test = f"!({pivot.name} > {least!r} * {scale.name})"
        if k < self.first_friction:
            build.line(f"if ({test}) {failed};")
            return -build.local(f"inverse_pivot_{name}", 1 / pivot)
        stick = self.sticks[k]  # a row that slips is switched off: its multiplier is zero
        build.line(f"if ({stick.name} != 0.0 && {test}) {failed};")
        return -build.local(f"inverse_pivot_{name}", f"{stick.name} != 0.0 ? 1.0 / {pivot.name} : 0.0")

    @staticmethod
    def _named(build: KernelBuilder, name: str, value: sp.Expr) -> sp.Expr:
        return value if is_simple(value) else build.local(name, value)

    def solve(
        self, build: KernelBuilder, factor: Factor, b: Mapping[int, sp.Expr], prefix: str = ""
    ) -> dict[int, sp.Expr]:
        """Solution by node for a right-hand side by node (absent: zero)."""
        build.section("forward substitution")
        columns: dict[int, list[int]] = {k: [] for k in self.elimination.order}
        for i, k in factor.L:
            columns[i].append(k)
        z: dict[int, sp.Expr] = {}
        for k in self.elimination.order:
            value = b.get(k, sp.Integer(0)) - sum(
                (factor.L[k, j] * z[j] for j in columns[k] if z[j] != 0), sp.Integer(0)
            )
            z[k] = self._named(build, f"{prefix}z_{self.names[k]}", value)
        build.section("backward substitution")
        x: dict[int, sp.Expr] = {}
        for k in reversed(self.elimination.order):
            value = z[k] * factor.inverse[k]
            value -= sum((factor.L[i, k] * x[i] for i in self.elimination.structure[k]), sp.Integer(0))
            kind = "acceleration" if k < self.n else "lambda"
            x[k] = build.local(f"{prefix}{kind}_{self.names[k]}", value)
        return x


def is_simple(value: sp.Expr) -> bool:
    """A number, a symbol or its negative: cheaper written in place than named."""
    return bool(value.is_Number or value.is_Symbol or (-value).is_Symbol)

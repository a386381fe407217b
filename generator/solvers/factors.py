"""L U of Newton's matrix as statements, pivot by pivot.

An unknown is found by its own equation or, where a row gives a coordinate, one of the two by the other's.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import sympy as sp

from gudgeon.generator.ir.kernels import KernelBuilder
from gudgeon.generator.ir.statements import Guard
from gudgeon.generator.ir.values import Chosen, Test
from gudgeon.generator.solvers.dependent_coordinates import is_unit
from gudgeon.generator.solvers.linearization import Pair
from gudgeon.generator.solvers.pivots import SINGULAR, is_simple
from gudgeon.generator.symbols.corners import Size

if TYPE_CHECKING:
    from gudgeon.generator.solvers.newton import Newton

ZERO = sp.Integer(0)
ETA, ETA_ROW, ETA_STICK = (sp.Symbol(name, real=True) for name in ("eta", "eta_row", "eta_stick"))


class Factors:
    """L, U and inverse pivots as they come, column by column."""

    def __init__(self, newton: Newton, build: KernelBuilder, entries: Mapping[Pair, sp.Expr]) -> None:
        self.newton, self.build, self.entries = newton, build, entries
        self.lower: dict[Pair, sp.Expr] = {}  # (later equation, earlier unknown)
        self.upper: dict[Pair, sp.Expr] = {}  # (earlier unknown, later unknown)
        self.inverse: dict[int, sp.Expr] = {}
        self._before: dict[int, list[int]] = {k: [] for k in range(newton.nodes)}

    def eliminate(self, k: int, later: Sequence[int]) -> None:
        """Pivot k, its column of L and its row of U."""
        self.inverse[k] = self._pivot(k)
        names, equation = self.newton.names, self.newton.equation.get(k, k)
        for i in later:
            other = k if i == equation else i  # the unknown's own equation stays for the multiplier
            column = self.entries.get((other, k), ZERO) - self._products(other, k)
            row = self.entries.get((equation, i), ZERO) - self._products(equation, i)
            self.lower[other, k] = self._kept(f"l_{names[other]}__{names[k]}", column * self.inverse[k])
            self.upper[k, i] = self._kept(f"u_{names[k]}__{names[i]}", row)
        for i in later:
            self._before[k if i == equation else i].append(k)

    def _products(self, i: int, k: int, of: Sequence[int] | None = None) -> sp.Expr:
        """What the pivots before, or some of them, take from the entry of equation i in the unknown k."""
        before = self._before[i] if of is None else of
        return sp.Add(*(self.lower[i, j] * self.upper[j, k] for j in before if (j, k) in self.upper))

    def _pivot(self, k: int) -> sp.Expr:
        """1/pivot; what is left of a row is compared with what it would be if it were independent of the others."""
        newton, build, name = self.newton, self.build, self.newton.names[k]
        own = self.entries.get((newton.equation.get(k, k), k), ZERO)
        if k in newton.equation:
            return own if is_unit(own) else newton.factors.adopt(build, build.local(f"inverse_pivot_{name}", 1 / own))
        if own.is_Number and own == 1:  # an inner state that this joint does not have
            return own
        if not self._before[k] and own in newton.model.masses:
            return newton.model.slots.derive(f"inverse_{own}", 1 / own, "1/M")
        states = newton.first_state
        first = [j for j in self._before[k]
                 if j < newton.n or j in newton.equation or j >= states or k < newton.n or k >= states]  # fmt: skip
        others = [j for j in self._before[k] if j not in first]
        scale = build.local(f"scale_{name}", own - self._products(k, k, first))
        pivot = build.local(f"pivot_{name}", scale - self._products(k, k, others)) if others else scale
        size = own if k < newton.n or k >= states else scale
        stick = newton.sticks[k - newton.n - newton.m] if newton.n + newton.m <= k < states else None
        sticks = Test(stick, "!=", (0.0,)) if stick is not None else None
        build.line(Guard(Test(pivot, ">", (SINGULAR, Size(size)), size=True), k + 1, only=sticks))
        # a row that slips is switched off: its multiplier is zero
        value = 1 / pivot if sticks is None else Chosen(sticks, 1 / pivot, ZERO)
        return newton.factors.adopt(build, build.local(f"inverse_pivot_{name}", value))

    def _kept(self, name: str, value: sp.Expr) -> sp.Expr:
        own = is_simple(value) and not value.free_symbols & {ETA, ETA_ROW, ETA_STICK}  # not what every call is given
        return self.newton.factors.adopt(self.build, value if own else self.build.local(name, value))

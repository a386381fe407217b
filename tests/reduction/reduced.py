"""The reduced formulation in NumPy, for its tests: calls of the library, and expressions of its symbols in numbers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import sympy as sp

from gudgeon.generator.equations.model import Model
from gudgeon.generator.reduction.reduction import TreeSystem, reduce_model
from gudgeon.model.compiled import Array, CompiledModel

# steps by name: SymPy would write each as a case distinction, simplified at great length
BY_NAME: dict[str, Callable[..., float]] = {
    "Heaviside": lambda x, at_zero=1.0: 1.0 if x >= 0.0 else at_zero * 0.0,
    "Unevaluated": lambda x: x,
}
MODULES = [BY_NAME, "math"]


@dataclass(frozen=True)
class Reduced:
    """The library's functions in tree coordinates: s and rates (n + c,), free ones, then those of driven chains.

    Of the latter s is a guess, which the functions close themselves, and the rates are not looked at.
    """

    library: CompiledModel
    p: Array

    @property
    def n(self) -> int:
        return len(self.library.source.tree_coordinates)

    @property
    def rows(self) -> int:
        return len(self.library.source.closures)

    @property
    def chained(self) -> int:
        return len(self.library.source.driven_loop_coordinates)

    def chains(self, t: float, s: Array) -> tuple[Array, Array]:
        """Coordinates of the chains (c,) next to the guess in s, and three rates of each (3, c)."""
        c, rates = s[self.n :].copy(), np.empty((3, self.chained))
        if self.chained:
            assert self.library.lib.gudgeon_driven_loops(t, *map(self.library.pointer, (c, self.p, rates))) == 0
        return c, rates

    def expand(self, t: float, s: Array, rate: Array) -> tuple[Array, Array]:
        """Absolute q and v."""
        q, v = np.empty(self.library.n), np.empty(self.library.n)
        self._call("expand", t, s, rate, self.p, q, v)
        return q, v

    def reduce(self, t: float, q: Array, v: Array) -> tuple[Array, Array]:
        """s and its rates of an absolute state."""
        n = self.n + self.chained
        s, rate = np.empty(n + 1), np.empty(n + 1)
        self._call("reduce", t, q, v, self.p, s, rate)
        return s[:n], rate[:n]

    def closures(self, t: float, s: Array, rate: Array) -> tuple[Array, Array]:
        """Φ of the loops and its rate."""
        phi, phi_dot = np.empty(self.rows + 1), np.empty(self.rows + 1)
        self._call("closures", t, s, rate, self.p, phi, phi_dot)
        return phi[: self.rows], phi_dot[: self.rows]

    def project(self, t: float, s: Array, r: Array) -> Array:
        """The smallest x with Φ_s x = r."""
        x = np.zeros(self.n + self.chained + 1)
        assert self._call("reduced_project", t, s, r, self.p, x) == 0
        return x[:-1]

    def accelerations(self, t: float, s: Array, rate: Array, memory: Array) -> tuple[Array, Array, Array]:
        """s̈, multipliers of the closures, powers."""
        a, multipliers, power = np.empty(self.n + 1), np.empty(self.rows + 1), np.empty(3)
        assert self._call("reduced_rhs", t, s, rate, memory, self.p, a, multipliers, power) == 0
        return a[: self.n], multipliers[: self.rows], power

    def rescue(self, t: float, s: Array, rate: Array, memory: Array) -> Array:
        """s̈ by way of the absolute formulation."""
        a = np.empty(self.n + 1)
        assert self._call("accelerations_by_absolute_equations", t, s, rate, memory, self.p, a) == 0
        return a[: self.n]

    def close(self, t: float, s: Array, rate: Array) -> tuple[Array, Array]:
        """The state with Φ = 0 and Φ̇ = 0 next to this one."""
        for _ in range(20):
            s = s - self.project(t, s, self.closures(t, s, rate)[0])
        return s, rate - self.project(t, s, self.closures(t, s, rate)[1])

    def _call(self, name: str, t: float, *arrays: Array) -> int:
        kept = [np.ascontiguousarray(a, dtype=float) if a.size else np.zeros(1) for a in arrays]
        status = getattr(self.library.lib, f"gudgeon_{name}")(t, *(self.library.pointer(a) for a in kept))
        for array, copy in zip(arrays, kept, strict=True):
            if array.size:
                array[:] = copy
        return status or 0


class Numbers:
    """Expressions of a reduced system as functions of (t, s, ṡ) and the slots; `chains` as Reduced has them."""

    def __init__(self, model: Model, p: Array) -> None:
        self.model, self.p = model, p
        self.system: TreeSystem = reduce_model(model.copy_mutable())
        self.chains = np.zeros(0), np.zeros((3, 0))

    def __call__(self, expressions: Sequence[sp.Expr], t: float, s: Array, rate: Array) -> Array:
        system, symbols = self.system, self.system.model.symbols
        slots = [entry.symbol for entry in self.model.parameter_table.entries.values()]
        known = [x for k in system.dependent for x in (k.q, k.rate, k.second, k.third)]
        steps = [(x, symbols.definitions[x]) for x in symbols.info if x in symbols.definitions]
        arguments = [[system.model.t], list(system.q), list(system.v), slots, known]
        function = sp.lambdify(arguments, list(expressions), MODULES, cse=lambda e: (steps, list(e)))
        n = len(system.q)
        chains = [x for c, rates in zip(self.chains[0], self.chains[1].T, strict=True) for x in (c, *rates)]
        return np.array(function([t], list(s[:n]), list(rate[:n]), list(self.p[: len(slots)]), chains), dtype=float)

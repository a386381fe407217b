"""Evaluates the closed linkage in NumPy for the assembly (runtime/assembly/linkage.py), before anything is compiled."""

from __future__ import annotations

from collections.abc import Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.generator.equations.model import Model
from gudgeon.generator.targets.numpy.module import Array, ClosedLinkage


class NumPyLinkage:
    """Evaluate functions of (t, q, p) of the closed linkage; p is in the order of `source`.

    `p` contains the defaults, or the `given` values as ClosedLinkage.prepare accepts them.
    """

    def __init__(
        self,
        model: Model,
        source: KernelSource,
        given: Mapping[str, float | str] | None = None,
        closed: ClosedLinkage | None = None,
    ) -> None:
        self.source, self.n, self.closed = source, len(model.q), closed or ClosedLinkage(model)
        self.defaults = self.closed.prepare(given)
        self.names = [model.slots.field(symbol) for symbol in model.slots.members()]
        self.p = np.array([_number(self.defaults, name) for name in self.names])

    def numbers(self, p: Array) -> SimpleNamespace:
        """Return p by names, tables as lists."""
        if p is self.p:
            return self.defaults
        values = dict(zip(self.names, np.asarray(p).tolist(), strict=True))
        tables = self.closed.model.slots.tables
        lists = {name: [values[f"{name}[{k}]"] for k in range(len(own))] for name, own in tables.items()}
        return SimpleNamespace(**values | lists)

    def closed_phi(self, t: float, q: Array, p: Array) -> Array:
        """Return Φ(q, t), (m,)."""
        return self.closed.phi(t, q, self.numbers(p))

    def closed_nu(self, t: float, q: Array, p: Array) -> Array:
        """Return ν = −Φ_t, (m,)."""
        return self.closed.nu(t, q, self.numbers(p))

    def closed_phi_q(self, t: float, q: Array, p: Array) -> Array:
        """Return the Jacobian ∂Φ/∂q, (m, n)."""
        return self.closed.phi_q(t, q, self.numbers(p))

    def mass(self, p: Array) -> Array:
        """Return the diagonal of M, (n,)."""
        return self.closed.mass(self.numbers(p))

    def start_values(self, p: Array) -> tuple[Array, Array, Array]:
        """Return guesses, exact values and rates of the start; the last two end with those of journals."""
        return self.closed.start_values(self.numbers(p))


def _number(of: SimpleNamespace, name: str) -> float:
    """Return a parameter by name, or an entry of a table such as "contour_A[3]"; NaN if there is none."""
    table, _, place = name.partition("[")
    found: Any = getattr(of, table, np.nan)
    return float(found[int(place[:-1])]) if place else float(found)

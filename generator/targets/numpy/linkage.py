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
    """Evaluate functions of (t, q, p) of the closed linkage; p is an array in the order of `source`.

    The attribute `p` contains the defaults, with `given_values` as ClosedLinkage.prepare accepts them; None: defaults.
    """

    def __init__(
        self,
        model: Model,
        source: KernelSource,
        given_values: Mapping[str, float | str] | None = None,
        closed_linkage: ClosedLinkage | None = None,
    ) -> None:
        self.source, self.n, self.closed = source, len(model.q), closed_linkage or ClosedLinkage(model)
        self.defaults = self.closed.prepare(given_values)
        self.names = [model.parameter_table.find_member_name(symbol) for symbol in model.parameter_table.list_symbols()]
        self.p = np.array([read_parameter(self.defaults, name) for name in self.names])

    def get_parameters(self, p: Array) -> SimpleNamespace:
        """Return the array p as a namespace of parameters by field name; tables are lists.

        For the object `self.p` itself the stored namespace is returned, without a copy.
        """
        if p is self.p:
            return self.defaults
        values = dict(zip(self.names, np.asarray(p).tolist(), strict=True))
        tables = self.closed.model.parameter_table.tables
        lists = {name: [values[f"{name}[{k}]"] for k in range(len(symbols))] for name, symbols in tables.items()}
        return SimpleNamespace(**values | lists)

    def closed_phi(self, t: float, q: Array, p: Array) -> Array:
        """Return Φ(q, t), (m,)."""
        return self.closed.phi(t, q, self.get_parameters(p))

    def closed_nu(self, t: float, q: Array, p: Array) -> Array:
        """Return ν = −Φ_t, (m,)."""
        return self.closed.nu(t, q, self.get_parameters(p))

    def closed_phi_q(self, t: float, q: Array, p: Array) -> Array:
        """Return the Jacobian ∂Φ/∂q, (m, n)."""
        return self.closed.phi_q(t, q, self.get_parameters(p))

    def mass(self, p: Array) -> Array:
        """Return the diagonal of M, (n,)."""
        return self.closed.mass(self.get_parameters(p))

    def start_values(self, p: Array) -> tuple[Array, Array, Array]:
        """Return (guesses, exact values, rates) of the start as arrays; the last two end with those of journals."""
        return self.closed.start_values(self.get_parameters(p))


def read_parameter(parameters: SimpleNamespace, name: str) -> float:
    """Return a parameter by its field name, or an entry of a table such as "contour_A[3]".

    NaN is returned for a parameter that does not exist.
    """
    table, _, index = name.partition("[")
    value: Any = getattr(parameters, table, np.nan)
    return float(value[int(index[:-1])]) if index else float(value)

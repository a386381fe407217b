"""Rows of Φ that say nothing new: found by rank at the start and near it, named, and left out.

A row may depend on the others everywhere (a second hinge on the same axis) or only where links stand in
one line for a moment. So the rank is taken at the assembled start and at configurations near it on the
same branch; the largest counts. Contradictory rows do not assemble: the run tells them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import sympy as sp

from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import GudgeonError
from gudgeon.generator.equations.constraints import Row
from gudgeon.generator.equations.model import Model, Redundancy
from gudgeon.model.assembly import search
from gudgeon.model.compiled import Array
from gudgeon.model.rank import RANK, rank, tied

SAMPLES = 3
REACH = 0.05  # rad or share of the size, how far from the start the other configurations are sought


def _heaviside(x: float, at_zero: float = 1.0) -> float:
    return 1.0 if x >= 0.0 else 0.0


def _finite(derivative: float, *_: float) -> float:
    """A slope (finite_slopes.py); where there is none it is close enough to 0 for a rank."""
    return derivative if math.isfinite(derivative) else 0.0


def _same(x: float) -> float:
    return x


# what grows beyond all numbers is infinite, as in C;
# steps by name: SymPy would write each as a case distinction, simplified at great length
MODULES = [
    {"Heaviside": _heaviside, "Whole": _same, "Share": _same, "Slope": _finite, "JustAhead": _same,
     "JustBehind": _same, "exp": np.exp, "sinh": np.sinh, "cosh": np.cosh},
    "math",
]  # fmt: skip


class NumericModel:
    """The closed linkage in NumPy, in the words of CompiledModel: just what `search` asks for."""

    def __init__(self, model: Model, source: KernelSource) -> None:
        self.source, self.n = source, len(model.q)
        symbols, start = model.symbols, model.scene.mechanism.start
        groups = [[model.slots.use(x) for x in group.values()] for group in (start.guess, start.set, start.rates)]
        entries = list(model.slots.entries.values())
        slots, derived = [e.symbol for e in entries], list(model.slots.derived)
        self.p = np.array([e.default for e in entries] + [0.0] * len(derived))
        values = sp.lambdify([slots], [symbols.explicit(e) for e in model.slots.derived.values()], MODULES)
        self.p[len(slots) :] = real(values(self.p[: len(slots)]))
        local = [s for s in symbols.definitions if not symbols.info[s].home]
        arguments = [[model.t], list(model.q), slots + derived]
        self._entries = [
            (r, model.q.index(q), value) for r, row in enumerate(model.all_rows) for q, value in row.phi_q.items()
        ]
        wanted = [row.phi for row in model.all_rows] + [row.nu for row in model.all_rows]
        wanted += [value for *_, value in self._entries]
        needed = _needed(wanted, local, symbols.definitions)
        steps = [(symbol, symbols.definitions[symbol]) for symbol in needed]
        self._rows = sp.lambdify(arguments, wanted, MODULES, cse=lambda expressions: (steps, list(expressions)))
        self._masses = sp.lambdify([slots + derived], list(model.masses), MODULES)
        self._start = [sp.lambdify([slots + derived], group, MODULES) for group in groups]

    def _values(self, t: float, q: Array, p: Array) -> Array:
        return real(self._rows([t], q, p))

    def closed_phi(self, t: float, q: Array, p: Array) -> Array:
        return self._values(t, q, p)[: len(self.source.start_rows)]

    def closed_nu(self, t: float, q: Array, p: Array) -> Array:
        m = len(self.source.start_rows)
        return self._values(t, q, p)[m : 2 * m]

    def closed_phi_q(self, t: float, q: Array, p: Array) -> Array:
        m = len(self.source.start_rows)
        out = np.zeros((m, self.n))
        for (r, c, _), value in zip(self._entries, self._values(t, q, p)[2 * m :], strict=True):
            out[r, c] = value
        return out

    def mass(self, p: Array) -> Array:
        return real(self._masses(p))

    def start_values(self, p: Array) -> tuple[Array, Array, Array]:
        guess, fixed, rates = (real(values(p)) for values in self._start)
        return guess, fixed, rates


def real(values: Sequence[complex]) -> Array:
    """Numbers that turned complex, the root of a negative one, are none: as C has them."""
    return np.array([math.nan if isinstance(x, complex) else x for x in values], dtype=float)


def _needed(
    wanted: Sequence[sp.Expr], local: Sequence[sp.Symbol], definitions: dict[sp.Symbol, sp.Expr]
) -> list[sp.Symbol]:
    """The local symbols that the wanted expressions use, directly or not, in order of definition."""
    found: set[sp.Symbol] = set()
    waiting = [s for e in wanted for s in e.free_symbols]
    known = set(local)
    while waiting:
        symbol = waiting.pop()
        if symbol in known and symbol not in found:
            found.add(symbol)
            waiting.extend(definitions[symbol].free_symbols)
    return [symbol for symbol in local if symbol in found]


def find_redundancy(model: Model, source: KernelSource) -> Redundancy:
    """Rows of the scene (joints with play open) that depend on the others at every configuration."""
    if not model.rows:
        return Redundancy()
    numeric = NumericModel(model, source)
    names = {row.name for row in model.rows}
    kept = [r for r, row in enumerate(model.all_rows) if row.name in names]
    try:
        with np.errstate(all="ignore"):
            q = search(numeric, numeric.p).q  # type: ignore[arg-type]
            matrices = [numeric.closed_phi_q(0.0, x, numeric.p)[kept] for x in _configurations(numeric, q, kept)]
        ranks = [rank(matrix) for matrix in matrices]
    except (GudgeonError, ArithmeticError, ValueError):  # not assembled, or not finite: the run will say why
        return Redundancy()
    best = int(np.argmax(ranks))
    if ranks[best] == len(kept):
        return Redundancy()
    return _name_rows([model.all_rows[r] for r in kept], matrices[best], ranks[best])


def _configurations(numeric: NumericModel, q: Array, kept: list[int]) -> list[Array]:
    """The start, and configurations near it: a random step along the motion, closed again by Newton."""
    rng = np.random.default_rng(0)
    found = [q]
    for _ in range(SAMPLES if rank(numeric.closed_phi_q(0.0, q, numeric.p)[kept]) < len(kept) else 0):
        x = q + REACH * rng.standard_normal(len(q)) * np.linalg.norm(q, np.inf)
        for _ in range(50):
            residual = numeric.closed_phi(0.0, x, numeric.p)[kept]
            if np.abs(residual).max() < 1e-13:
                break
            x = x - np.linalg.lstsq(numeric.closed_phi_q(0.0, x, numeric.p)[kept], residual, rcond=1e-10)[0]
        if np.abs(numeric.closed_phi(0.0, x, numeric.p)[kept]).max() < 1e-9:
            found.append(x)
    return found


def _name_rows(rows: Sequence[Row], matrix: Array, independent: int) -> Redundancy:
    """Drives are kept first, then rows in the order of the file; a dependent one is dropped."""
    order = sorted(range(len(rows)), key=lambda r: (rows[r].kind != "drive", r))
    basis = np.zeros((0, matrix.shape[1]))
    dropped = []
    for r in order:
        rest = matrix[r] - (basis @ matrix[r]) @ basis
        rest = rest - (basis @ rest) @ basis
        if len(basis) < independent and np.linalg.norm(rest) > 10 * RANK * np.linalg.norm(matrix[r]):
            basis = np.vstack([basis, rest / np.linalg.norm(rest)])
        else:
            dropped.append(r)
    free = tied(matrix) > 1e-7
    owners = dict.fromkeys(rows[r].owner for r in range(len(rows)) if free[r])
    return Redundancy(tuple(rows[r].name for r in sorted(dropped)), tuple(owners))

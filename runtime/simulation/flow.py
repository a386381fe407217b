"""The motion as a flow in the coordinates that are integrated: its rates, its exact Jacobian, gaps of joints with play.

Of the reduced formulation these are the coordinates of the tree, whose neighbours all joints of the tree allow; of the
full one those of all bodies. Gains of Baumgarte's terms are zero, as in the methods that project.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from gudgeon.contract.boundary import N_WORK
from gudgeon.integrators.adaptive import integrated_angles
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.contours import contour_of, corner_gap, depth_at
from gudgeon.model.parameters import without_baumgarte

if TYPE_CHECKING:
    from gudgeon.results.results import Result

NUDGE = 1e-5  # share of δ̇⁻ by which it is moved for the slope of forces along it: they hang on 1/δ̇⁻


class Flow:
    """y (2m,) holds m coordinates and their rates; `chain` what drives determine through loops, found from y alone."""

    def __init__(self, compiled: CompiledModel, run: Result) -> None:
        source = compiled.source
        self.compiled, self.p = compiled, without_baumgarte(compiled, run.given, run.is_given)
        self.tree = source.formulation == "reduced"
        self.m, self.chained = (len(source.tree), len(source.chain)) if self.tree else (compiled.n, 0)
        self.is_angle, self.joints = integrated_angles(source), len(source.clearances)
        rows = [row.owner for row in source.start_rows]
        self.rows = [[k for k, owner in enumerate(rows) if owner == joint.name] for joint in source.clearances]
        self.play = [float(self.p[joint.clearance]) for joint in source.clearances]
        self.depths = [contour_of(source, self.p, joint.name) for joint in source.clearances]
        first = (joint.first for joint in source.clearances)
        self.bearing = [source.bodies[body].index if body >= 0 else -1 for body in first]  # of x in q
        self._lasting()

    def _lasting(self) -> None:
        """Arrays that C reads and fills again and again, tens of thousands of times a run, with its views of them."""
        compiled, m, size, p = self.compiled, self.m, self.m + self.chained, self.pointers(self.p)
        self._full = np.zeros(compiled.n), np.zeros(compiled.n)
        self._reduced = np.zeros(max(size, 1)), np.zeros(max(size, 1))
        self._reduce = [*self.pointers(*self._full), *p, *self.pointers(*self._reduced, written=True)]
        self._state = np.zeros(max(size, 1)), np.zeros(max(size, 1)), np.zeros(max(compiled.n_memory, 1))
        self._a = np.zeros(max(m, 1))
        others = np.zeros(len(compiled.source.closures) + 1), np.zeros(N_WORK)
        self._rhs = [*self.pointers(*self._state), *p, *self.pointers(self._a, *others, written=True)]
        of_node = np.zeros(2 * m + N_WORK + self.chained), self._state[2]
        self._J, self._f_t = np.empty((2 * m + N_WORK,) * 2), np.empty(2 * m + N_WORK)
        self._jacobian = [*self.pointers(*of_node), *p, *self.pointers(self._J, self._f_t, written=True)]
        self._node, self._others = of_node[0], others  # C's views alone would not keep them

    def reduced(self, t: float, full: Array) -> tuple[Array, Array]:
        """y (2m,), and the chain's (2, n_chain), of (q, q̇) of all bodies (2n,)."""
        if not self.tree:
            return full.copy(), np.zeros((2, 0))
        n, m, size = self.compiled.n, self.m, self.m + self.chained
        (own_q, own_v), (q, v) = self._full, self._reduced
        own_q[:], own_v[:], q[:], v[:] = full[:n], full[n:], 0.0, 0.0
        self.compiled.lib.gudgeon_reduce(t, *self._reduce)
        return np.concatenate([q[:m], v[:m]]), np.stack([q[m:size], v[m:size]])

    def expanded(self, t: float, y: Array, chain: Array) -> Array:
        """(q, q̇) of all bodies, (2n,)."""
        if not self.tree:
            return y.copy()
        q, v = np.zeros(self.compiled.n), np.zeros(self.compiled.n)
        given = self.pointers(np.append(y[: self.m], chain[0]), np.append(y[self.m :], chain[1]), self.p)
        self.compiled.lib.gudgeon_expand(t, *given, *self.pointers(q, v, written=True))
        return np.concatenate([q, v])

    def lifted(self, t: float, y: Array, chain: Array, d: Array, h: float) -> Array:
        """The difference (2n,) of all bodies that d (2m,) of y is, by central differences with h d."""
        return (self.expanded(t, y + h * d, chain) - self.expanded(t, y - h * d, chain)) / (2.0 * h)

    def rates(self, t: float, y: Array, chain: Array, memory: Array) -> Array:
        """ẏ, (2m,). Raises SingularError."""
        if not self.tree:
            return self.compiled.rhs(t, y, self.p, memory)[: 2 * self.m]
        m, size, (q, v, held) = self.m, self.m + self.chained, self._state
        q[:m], q[m:size], v[:m], v[m:size], held[: len(memory)] = y[:m], chain[0], y[m:], chain[1], memory
        status = self.compiled.lib.gudgeon_reduced_rhs(t, *self._rhs)
        if status:
            self.compiled.check_pivot(status, t, self.compiled.source.motion_pivots or None)
        return np.concatenate([y[m:], self._a[:m]])

    def slopes(self, t: float, y: Array, chain: Array, memory: Array) -> Array:
        """Slopes of the rates of (y, δ̇⁻, t) along these, (2m + n_clearances + 1) square; δ̇⁻ stays as it is."""
        m, node, J = self.m, self._node, self._J
        A = np.zeros((2 * m + self.joints + 1,) * 2)
        node[: 2 * m], node[2 * m + N_WORK :], self._state[2][: len(memory)] = y, chain[0], memory
        status = self.compiled.lib.gudgeon_jacobian(t, *self._jacobian)
        self.compiled.check_node(status, t)
        A[: 2 * m, : 2 * m], A[: 2 * m, -1] = J[: 2 * m, : 2 * m], self._f_t[: 2 * m]
        for k in (k for k in range(self.joints) if np.isfinite(memory[k])):
            ends = []
            for share in (1.0 - NUDGE, 1.0 + NUDGE):
                other = memory.copy()
                other[k] *= share
                ends.append(self.rates(t, y, chain, other))
            A[: 2 * m, 2 * m + k] = (ends[1] - ends[0]) / (2.0 * NUDGE * memory[k])
        return A

    def chain_at(self, t: float, chain: Array) -> Array:
        """The chain (2, n_chain) at a time near that at which it was this one: drives alone determine it."""
        if not self.chained:
            return chain
        q, rates = chain[0].copy(), np.zeros(3 * self.chained)
        self.compiled.lib.gudgeon_chains(t, *self.pointers(q, written=True), *self.pointers(self.p),
                                         *self.pointers(rates, written=True))  # fmt: skip
        return np.stack([q, rates[: self.chained]])

    def gap(self, joint: int, t: float, y: Array, chain: Array) -> tuple[float, float]:
        """Penetration δ (m) and δ̇ (m/s) of a joint with play: its rows, were it closed, are ±e."""
        full, n, rows = self.expanded(t, y, chain), self.compiled.n, self.rows[joint]
        if self.compiled.source.clearances[joint].at_wall:
            return corner_gap(self.compiled, self.p, t, full[:n], full[n:], joint)
        e = self.compiled.closed_phi(t, full[:n], self.p)[rows]
        rate = self.compiled.closed_phi_q(t, full[:n], self.p)[rows] @ full[n:]
        rate -= self.compiled.closed_nu(t, full[:n], self.p)[rows]
        length = float(np.hypot(*e))
        gap, approach = length - self.play[joint], float(e @ rate) / length
        depths = self.depths[joint]
        if depths is None:
            return gap, approach
        place = self.bearing[joint]
        theta, omega = (full[place + 2], full[n + place + 2]) if place >= 0 else (0.0, 0.0)
        angle = np.arctan2(-e[1], -e[0]) - theta
        turning = float(e[0] * rate[1] - e[1] * rate[0]) / length**2 - omega
        worn, slope = (float(depth_at(depths, angle, order)) for order in (0, 1))
        return gap - worn, approach - slope * turning

    def pointers(self, *arrays: Array, written: bool = False) -> list[Any]:
        """C's views of arrays; an empty one is one number long."""
        return [self.compiled.pointer(array if array.size else np.zeros(1), written=written) for array in arrays]

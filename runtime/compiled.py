"""One compiled scene: the C functions with NumPy in and out.

Arrays are C-contiguous float64; anything else that is handed in is copied first. Nothing here keeps
state, so that any number of threads may use one CompiledModel; the GIL is released in every call.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter
from types import ModuleType
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.errors import SingularError
from gudgeon.kernel_source import KernelSource

Array: TypeAlias = NDArray[np.float64]

N_WORK = 3  # works that are integrated with the motion
CLEARANCE_COLUMNS = ("Fx", "Fy", "Fn", "Ft", "ex", "ey", "e", "deltadot", "vt")


@dataclass(frozen=True)
class Evaluation:
    """Everything that follows from N samples, SI."""

    a: Array  # (N, n) q̈
    multipliers: Array  # (N, m) λ
    reactions: Array  # (N, n_joints, 3) Fx, Fy, M on the second body at the joint's point, ground axes
    torques: Array  # (N, n_drives) torque (N·m) or force (N) of each drive
    clearance: Array  # (N, n_clearances, 9) CLEARANCE_COLUMNS: force on the journal; Fn > 0 pushes it back
    series: Array  # (N, n_series) results of force elements
    friction: Array  # (N, n_frictions, 2) force on the second body along the direction, slip
    energy: Array  # (N, 2) kinetic, potential
    power: Array  # (N, 3) of drives, of force elements (but what they store), of clearance forces (W)


def contiguous(values: ArrayLike) -> Array:
    """Float64, C order; the same array where it already is."""
    return np.ascontiguousarray(values, dtype=np.float64)


class CompiledModel:
    """The library of one scene. `p` is what `prepare` returns: slots, then derived numbers."""

    def __init__(self, source: KernelSource, module: ModuleType, portable: bool = False) -> None:
        self.source = source
        self.portable = portable  # how its library was compiled, and others beside it will be
        self.lib: Any = module.lib
        self.ffi: Any = module.ffi
        self.n = len(source.coordinates)
        self.n_memory = len(source.clearances) + len(source.frictions)
        self._kept = np.array([_index(source, row.name) for row in source.rows], dtype=int)

    def pointer(self, array: NDArray[Any], kind: str = "double *") -> Any:
        """A C pointer to an array's memory; the caller keeps the array alive."""
        return self.ffi.cast(kind, array.ctypes.data)

    def prepare(self, given: ArrayLike, is_given: ArrayLike) -> Array:
        """Every number of a run, (n_slots + n_derived,), from overridden slots (n_slots,) and a mask."""
        values, mask = contiguous(given), np.ascontiguousarray(is_given, dtype=np.uint8)
        self._expect(values, len(self.source.slots), "given")
        self._expect(mask, len(self.source.slots), "is_given")
        p = np.empty(len(self.source.slots) + len(self.source.derived))
        self.lib.gudgeon_prepare(self.pointer(values), self.pointer(mask, "unsigned char *"), self.pointer(p))
        return p

    def mass(self, p: Array) -> Array:
        """Diagonal of M, (n,)."""
        out = np.empty(self.n)
        self.lib.gudgeon_mass(self.pointer(p), self.pointer(out))
        return out

    def closed_phi(self, t: float, q: ArrayLike, p: Array) -> Array:
        """Φ of the closed linkage (every joint without play), in the order of source.start_rows."""
        return self._rows("gudgeon_phi", t, p, q)

    def closed_phi_q(self, t: float, q: ArrayLike, p: Array) -> Array:
        """Φ_q of the closed linkage, (rows, n)."""
        out = np.empty((len(self.source.start_rows), self.n))
        state = self._state(q)
        self.lib.gudgeon_phi_q(t, self.pointer(state), self.pointer(p), self.pointer(out))
        return out

    def closed_nu(self, t: float, q: ArrayLike, p: Array) -> Array:
        """ν of the closed linkage."""
        return self._rows("gudgeon_nu", t, p, q)

    def phi(self, t: float, q: ArrayLike, p: Array) -> Array:
        """Φ(q, t), (m,), rows of source.rows."""
        return self.closed_phi(t, q, p)[self._kept]

    def phi_q(self, t: float, q: ArrayLike, p: Array) -> Array:
        """Φ_q, (m, n)."""
        return self.closed_phi_q(t, q, p)[self._kept]

    def nu(self, t: float, q: ArrayLike, p: Array) -> Array:
        """ν = −Φ_t, (m,)."""
        return self.closed_nu(t, q, p)[self._kept]

    def gamma(self, t: float, q: ArrayLike, v: ArrayLike, p: Array) -> Array:
        """γ, (m,)."""
        return self._rows("gudgeon_gamma", t, p, q, v)[self._kept]

    def start_values(self, p: Array) -> tuple[Array, Array, Array]:
        """Numbers of the file's start: guess, set, rates."""
        s = self.source
        out = tuple(np.zeros(max(len(names), 1)) for names in (s.start_guess, s.start_set, s.start_rates))
        self.lib.gudgeon_start_values(self.pointer(p), *(self.pointer(array) for array in out))
        return out[0][: len(s.start_guess)], out[1][: len(s.start_set)], out[2][: len(s.start_rates)]

    def close(self, t: float, p: Array, size: float) -> tuple[Array, Array, float] | None:
        """The start's q and q̇ (n,), with max |Φ|, by plain Newton in C; None where that is not enough.

        `size` of the mechanism, m, weighs lengths against angles: see start.py, which does what this leaves.
        """
        q, v, residual = np.empty(self.n), np.empty(self.n), np.empty(1)
        status = self.lib.gudgeon_start(
            t, self.pointer(p), size, self.pointer(q), self.pointer(v), self.pointer(residual)
        )
        return None if status else (q, v, float(residual[0]))

    def rhs(self, t: float, y: ArrayLike, p: Array, memory: ArrayLike | None = None) -> Array:
        """(q̇, q̈, powers as in Evaluation), (2n + 3,), at y = (q, q̇), (2n,) or longer.

        `memory` (n_clearances,) holds δ̇⁻ of closed contacts, NaN for free ones (the default).
        """
        state, latched = self._full_state(y), self.memory_array(memory)
        out = np.empty(2 * self.n + N_WORK)
        status = self.lib.gudgeon_rhs(t, self.pointer(state), self.pointer(latched), self.pointer(p), self.pointer(out))
        self.check_pivot(status, t)
        return out

    def jacobian(self, t: float, y: ArrayLike, p: Array, memory: ArrayLike | None = None) -> tuple[Array, Array]:
        """∂f/∂y, (2n + 3, 2n + 3), and ∂f/∂t, (2n + 3,), of `rhs` f at y = (q, q̇), exact; SI.

        Contacts, the sides of corners and the modes of friction are those of this state. Raises SingularError
        where rows depend on each other, ValueError where nothing is integrated.
        """
        if not hasattr(self.lib, "gudgeon_jacobian"):
            raise ValueError("this scene has no Jacobian: without a degree of freedom nothing is integrated")
        state, latched = self._full_state(y), self.memory_array(memory)
        J, f_t = np.empty((2 * self.n + N_WORK,) * 2), np.empty(2 * self.n + N_WORK)
        arrays = (state, latched, p, J, f_t)
        self.check_node(self.lib.gudgeon_jacobian(t, *(self.pointer(array) for array in arrays)), t)
        return J, f_t

    def newton(
        self, t: float, y: ArrayLike, p: Array, eta: float, s: float, r: ArrayLike, memory: ArrayLike | None = None
    ) -> Array:
        """u, (2n + 3,), with u/η − J u = r + s f_t: a linear solve as the implicit methods do it."""
        state, latched, given = self._full_state(y), self.memory_array(memory), contiguous(r)
        u = np.empty(2 * self.n + N_WORK)
        self._expect(given, len(u), "r")
        arrays = (self.pointer(array) for array in (state, latched, p))
        self.check_node(self.lib.gudgeon_newton(t, *arrays, eta, s, self.pointer(given), self.pointer(u)), t)
        return u

    def check_node(self, status: int, t: float) -> None:
        """Raises SingularError for what the linearized equations return: −k is the k-th coordinate, row or friction."""
        s = self.source
        self.check_pivot(status, t)
        if status < 0:
            names = (*s.coordinates, *(row.name for row in s.rows), *s.frictions)
            self.check_pivot(-status, t, names)

    def evaluate(
        self, t: ArrayLike, q: ArrayLike, v: ArrayLike, memory: ArrayLike, p: Array,
        take: Callable[[], object] = lambda: None,
    ) -> Evaluation:  # fmt: skip
        """Everything at N samples: t (N,), q and v (N, n), memory (N, n_clearances).

        `take` is called every few milliseconds, and what it raises is passed on.
        """
        s, time = self.source, contiguous(t)
        N = len(time)
        inputs = [contiguous(a) for a in (q, v, memory)]
        out = Evaluation(
            np.empty((N, self.n)), np.empty((N, len(s.rows))), np.empty((N, len(s.joints), 3)),
            np.empty((N, len(s.drives))), np.empty((N, len(s.clearances), len(CLEARANCE_COLUMNS))),
            np.empty((N, len(s.series))), np.empty((N, len(s.frictions), 2)), np.empty((N, 2)), np.empty((N, 3)),
        )  # fmt: skip
        failed, first, chunk = self.ffi.new("long *"), 0, 1
        results = (
            out.a, out.multipliers, out.reactions, out.torques, out.clearance, out.series, out.friction, out.energy,
            out.power,
        )  # fmt: skip
        while first < N:
            before, count = perf_counter(), min(chunk, N - first)
            status = self.lib.gudgeon_evaluate(
                count, *(self.pointer(a[first:]) for a in (time, *inputs)), self.pointer(p),
                *(self.pointer(a[first:]) for a in results), failed,
            )  # fmt: skip
            if status:
                self.check_pivot(status, float(time[first + failed[0]]))
            first += count
            chunk = 4 * count if perf_counter() - before < 5e-3 else max(1, count // 4)
            take()
        self._mark_indeterminate(out)
        return out

    def _mark_indeterminate(self, out: Evaluation) -> None:
        """NaN where redundant constraints leave a reaction open: rigid bodies cannot tell it."""
        s = self.source
        for owner in s.indeterminate:
            out.multipliers[:, [k for k, row in enumerate(s.rows) if row.owner == owner]] = np.nan
            out.reactions[:, [k for k, joint in enumerate(s.joints) if joint.name == owner]] = np.nan
            out.torques[:, [k for k, drive in enumerate(s.drives) if drive.name == owner]] = np.nan

    def memory_array(self, memory: ArrayLike | None) -> Array:
        """δ̇⁻ a joint with play, mode a friction; None: all joints free, every mode still to be found."""
        return np.full(max(self.n_memory, 1), np.nan) if memory is None else contiguous(memory)

    def check_pivot(self, status: int, t: float, pivots: tuple[str, ...] | None = None) -> None:
        """Raises SingularError for a status k > 0, with the row that the pivot belongs to."""
        if status > 0:
            row = (pivots or self.source.pivots)[status - 1]
            raise SingularError(
                f"singular or non-finite at t = {t:.9g} s: the pivot of constraint row {row} vanished\n"
                "  the mechanism is at a singular position (dead centre), constraints are redundant,"
                " or the state is no longer finite: check the start, or take a smaller step",
                t,
                row,
            )

    def _rows(self, function: str, t: float, p: Array, *states: ArrayLike) -> Array:
        out = np.empty(len(self.source.start_rows))
        arrays = [self._state(state) for state in states]
        getattr(self.lib, function)(t, *(self.pointer(a) for a in arrays), self.pointer(p), self.pointer(out))
        return out

    def _full_state(self, y: ArrayLike) -> Array:
        state = contiguous(y)
        if state.ndim != 1 or len(state) not in (2 * self.n, 2 * self.n + N_WORK):
            raise ValueError(f"y has shape {state.shape}, expected ({2 * self.n},)")
        return state

    def _state(self, values: ArrayLike) -> Array:
        state = contiguous(values)
        self._expect(state, self.n, "state")
        return state

    @staticmethod
    def _expect(array: NDArray[Any], length: int, name: str) -> None:
        if array.shape != (length,):
            raise ValueError(f"{name} has shape {array.shape}, expected ({length},)")


def _index(source: KernelSource, row: str) -> int:
    return next(k for k, info in enumerate(source.start_rows) if info.name == row)

"""One compiled scene: the C functions with NumPy in and out.

Whatever is handed in goes through the door of arrays.py: lists, columns, arrays of any order, byte order or real
type give the numbers of the plain array, and a wrong length is refused. Nothing here keeps state, so that any number
of threads may use one CompiledModel; the GIL is released in every call. A CompiledModel may be pickled: its library
is taken from the cache (or compiled) again when it is first asked for there.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.contract.boundary import N_WORK
from gudgeon.contract.kernel_source import KernelSource
from gudgeon.errors import SingularError
from gudgeon.language.wanted import number_of, time
from gudgeon.model.arrays import FLAG, pointer, taken
from gudgeon.model.choices import choices, filled_in
from gudgeon.model.evaluation import PARTS, Evaluation, evaluate, nothing

if TYPE_CHECKING:
    from gudgeon.loading.library import Library

Array: TypeAlias = NDArray[np.float64]

AT_ONCE = 1024  # runs whose numbers are made together: they stay near
MOST_APART = 1e14  # times, that one may be another: a sum of both still knows the lighter one
MAX_RATIO_OF_POINTS = 1e12  # the same of masses if an inertia is 0: its body's rotation has the inertia m l^2 alone


class CompiledModel:
    """The library of one scene. `p` is what `prepare` returns: slots, then derived numbers."""

    def __init__(self, source: KernelSource, library: Library, portable: bool = False, text: str = "") -> None:
        self.source, self.portable = source, portable  # how its library was compiled, and others beside it will be
        self.text = text  # of the mechanism's file
        self.__dict__.update(lib=library.lib, ffi=library.ffi)
        self.n, self.n_p = len(source.coordinates), len(source.slots) + len(source.derived)
        self.n_memory = source.n_memory
        self._free = np.full(max(self.n_memory, 1), np.nan)
        self._free.flags.writeable = False
        self._choices = choices(source)
        closed = [row.name for row in source.start_rows]
        self._kept = np.array([closed.index(row.name) for row in source.rows], dtype=int)

    @cached_property
    def lib(self) -> Any:
        """The library's functions; of a pickled model when they are first asked for."""
        return self._library.lib

    @cached_property
    def ffi(self) -> Any:
        """cffi's view of what the engine declares."""
        return self._library.ffi

    @cached_property
    def compiler(self) -> str:
        """The first line of what the C compiler reports as its version."""
        from gudgeon.loading.compiler import version

        return version()

    @cached_property
    def beyond(self) -> bool:
        """Whether a drive has periods, at whose ends rounding decides on which side of a corner a time is."""
        from gudgeon.language.tree import functions
        from gudgeon.model.written import trees

        return any("mod" in functions(tree) for _, tree in trees(self.source, ("drives",)))

    @cached_property
    def may_switch(self) -> bool:
        """Whether the acceleration that a drive prescribes may jump at some time."""
        from gudgeon.model.left_limit import may_switch

        return may_switch(self)

    @cached_property
    def none(self) -> tuple[tuple[str, Array], ...]:
        """An Evaluation of no samples, part by part."""
        return nothing(self)

    @property
    def _library(self) -> Library:
        from gudgeon.loading.build import compile_kernels

        return compile_kernels(self.source, portable=self.portable)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name not in ("lib", "ffi")}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)

    def pointer(self, array: NDArray[Any], kind: str = "double *", written: bool = False) -> Any:
        """C's view of an array, which it keeps alive; ArrayError where C would read something else (arrays.py)."""
        return pointer(self.ffi, array, kind, written)

    def prepare(self, given: ArrayLike, is_given: ArrayLike) -> Array:
        """Every number of a run, (n_slots + n_derived,), from overridden slots (n_slots,) and a mask."""
        shape = (len(self.source.slots),)
        values, mask = taken(given, "given", shape), taken(is_given, "is_given", shape, dtype=FLAG)
        p, chosen = np.full(self.n_p, np.nan), [k for k in self._choices if mask[k]]
        for last in (False, True) if chosen else (True,):  # what is chosen has numbers of this run
            self.lib.gudgeon_prepare(self.pointer(values), self.pointer(mask, "unsigned char *"), self._out(p))
            values, mask = (values, mask) if last else filled_in(self.source, chosen, values, mask, p)
        return p

    def prepare_each(self, given: Array, is_given: NDArray[np.generic], zero: Sequence[int] = ()) -> Array:
        """The same of n runs, (n, n_slots + n_derived), from values and mask (n, n_slots); slots of `zero` are 0."""
        slots, p = len(self.source.slots), np.empty((len(given), self.n_p))
        chosen = is_given[:, list(self._choices)].any()
        for rows in (slice(k, k + AT_ONCE) for k in range(0, len(p), AT_ONCE)):
            values = np.array(taken(given[rows], "given", (None, slots)))
            mask = np.array(taken(is_given[rows], "is_given", (None, slots), dtype=FLAG))
            values[:, zero], mask[:, zero] = 0.0, True
            if chosen:
                p[rows] = [self.prepare(*pair) for pair in zip(values, mask, strict=True)]
                continue
            arguments = self.pointer(values), self.pointer(mask, "unsigned char *"), self._out(p[rows])
            self.lib.gudgeon_prepare_runs(len(values), slots, *arguments)
        return p

    def mass(self, p: ArrayLike) -> Array:
        """Diagonal of M, (n,)."""
        out = np.full(self.n, np.nan)
        self.lib.gudgeon_mass(self._numbers(p), self._out(out))
        return out

    def closed_phi(self, t: float, q: ArrayLike, p: ArrayLike) -> Array:
        """Φ of the closed linkage (every joint without play), in the order of source.start_rows."""
        return self._rows("gudgeon_phi", t, p, q)

    def closed_phi_q(self, t: float, q: ArrayLike, p: ArrayLike) -> Array:
        """Φ_q of the closed linkage, (rows, n)."""
        out = np.empty((len(self.source.start_rows), self.n))
        self.lib.gudgeon_phi_q(time(t), self._state(q, "q"), self._numbers(p), self._out(out))
        return out

    def closed_nu(self, t: float, q: ArrayLike, p: ArrayLike) -> Array:
        """ν of the closed linkage."""
        return self._rows("gudgeon_nu", t, p, q)

    def phi(self, t: float, q: ArrayLike, p: ArrayLike) -> Array:
        """Φ(q, t), (m,), rows of source.rows."""
        return self.closed_phi(t, q, p)[self._kept]

    def phi_q(self, t: float, q: ArrayLike, p: ArrayLike) -> Array:
        """Φ_q, (m, n)."""
        return self.closed_phi_q(t, q, p)[self._kept]

    def nu(self, t: float, q: ArrayLike, p: ArrayLike) -> Array:
        """ν = −Φ_t, (m,)."""
        return self.closed_nu(t, q, p)[self._kept]

    def gamma(self, t: float, q: ArrayLike, v: ArrayLike, p: ArrayLike) -> Array:
        """γ, (m,)."""
        return self.closed_gamma(t, q, v, p)[self._kept]

    def closed_gamma(self, t: float, q: ArrayLike, v: ArrayLike, p: ArrayLike) -> Array:
        """γ of the closed linkage."""
        return self._rows("gudgeon_gamma", t, p, q, v)

    def start_values(self, p: ArrayLike) -> tuple[Array, Array, Array]:
        """Numbers of the file's start: guess, set, rates; behind the last two e and ė of start_apart."""
        s, apart = self.source, len(self.source.start_apart)
        sizes = len(s.start_guess), len(s.start_set) + apart, len(s.start_rates) + apart
        guess, fixed, rates = (np.zeros(max(size, 1)) for size in sizes)
        self.lib.gudgeon_start_values(self._numbers(p), *(self._out(array) for array in (guess, fixed, rates)))
        return guess[: sizes[0]], fixed[: sizes[1]], rates[: sizes[2]]

    def close(self, t: float, p: ArrayLike, size: float) -> tuple[Array, Array, float] | None:
        """The start's q and q̇ (n,), with max |Φ|, by plain Newton in C; None where that is not enough.

        `size` of the mechanism, m, weighs lengths against angles: see start.py, which does what this leaves.
        """
        q, v, residual = np.empty(self.n), np.empty(self.n), np.empty(1)
        given = time(t), self._numbers(p), number_of(size, "size")
        status = self.lib.gudgeon_start(*given, *(self._out(array) for array in (q, v, residual)))
        return None if status else (q, v, float(residual[0]))

    def rhs(self, t: float, y: ArrayLike, p: ArrayLike, memory: ArrayLike | None = None) -> Array:
        """(q̇, q̈, powers as in Evaluation), (2n + 3,), at y = (q, q̇), (2n,) or longer.

        `memory` (n_clearances + n_frictions,) holds δ̇⁻ of closed contacts, NaN for free ones (the default), then
        the modes of frictions. Raises ArrayError for another length.
        """
        out = np.empty(2 * self.n + N_WORK)
        status = self.lib.gudgeon_rhs(time(t), *self._point(y, memory, p), self._out(out))
        self.check_pivot(status, t, p=p)
        return out

    def jacobian(self, t: float, y: ArrayLike, p: ArrayLike, memory: ArrayLike | None = None) -> tuple[Array, Array]:
        """∂f/∂y, (2n + 3 + k, 2n + 3 + k), and ∂f/∂t, (2n + 3 + k,), of `rhs` f at y = (q, q̇), exact; SI.

        Behind q̈ and the powers are the rates of the k inner states that laws have, and behind the works the states;
        what they are is in `memory`, as in a sample. Contacts, the sides of corners and the modes of friction are those
        of this state. Raises SingularError where rows depend on each other, ValueError where nothing is integrated.
        """
        if why := self.source.no_slopes:
            raise ValueError(f"this scene has no Jacobian: {why}")
        size = 2 * self.n + N_WORK + len(self.source.states)
        J, f_t = np.empty((size, size)), np.empty(size)
        status = self.lib.gudgeon_jacobian(time(t), *self._point(y, memory, p), self._out(J), self._out(f_t))
        self.check_node(status, t)
        return J, f_t

    def newton(
        self, t: float, y: ArrayLike, p: ArrayLike, eta: float, s: float, r: ArrayLike, memory: ArrayLike | None = None
    ) -> Array:
        """u, (2n + 3 + k,), with u/η − J u = r + s f_t: a linear solve as the implicit methods do it."""
        if why := self.source.no_slopes:
            raise ValueError(f"this scene has no Jacobian: {why}")
        u = np.empty(2 * self.n + N_WORK + len(self.source.states))
        right, eta, s = self.pointer(taken(r, "r", u.shape)), number_of(eta, "eta"), number_of(s, "s")
        status = self.lib.gudgeon_newton(time(t), *self._point(y, memory, p), eta, s, right, self._out(u))
        self.check_node(status, t)
        return u

    def check_node(self, status: int, t: float) -> None:
        """Raises SingularError for what the linearized equations return: −k is the k-th coordinate, row or friction."""
        s = self.source
        self.check_pivot(status, t)
        if status < 0:
            names = (*s.coordinates, *(row.name for row in s.rows), *s.frictions, *s.states)
            self.check_pivot(-status, t, names)

    def evaluate(
        self,
        t: ArrayLike,
        q: ArrayLike,
        v: ArrayLike,
        memory: ArrayLike,
        p: ArrayLike,
        take: Callable[[], object] = lambda: None,
        parts: Collection[str] = PARTS,
    ) -> Evaluation:
        """Everything at N samples: t (N,), q and v (N, n), memory (N, n_clearances + n_frictions).

        `take` is called every few milliseconds, and what it raises is passed on. `parts`: of an Evaluation, what is
        wanted. Raises SingularError for a sample that has no accelerations.
        """
        return evaluate(self, t, q, v, memory, p, take, parts)

    def memory_array(self, memory: ArrayLike | None) -> Array:
        """δ̇⁻ a joint with play, mode a friction; None: all joints free, every mode still to be found.

        (n_memory,); in a scene that remembers nothing one number stands for none. Not to be written.
        """
        if memory is None:
            return self._free
        array = taken(memory, "memory")
        return array if not self.n_memory and array.shape == (1,) else taken(array, "memory", (self.n_memory,))

    def check_pivot(
        self, status: int, t: float, pivots: tuple[str, ...] | None = None, p: ArrayLike | None = None
    ) -> None:
        """Raises SingularError for a status k > 0, with the row that the pivot belongs to; p: numbers to blame."""
        if status > 0:
            row = (pivots or self.source.pivots)[status - 1]
            of = f"constraint row {row} vanished" if row not in self.source.coordinates else f"{row} is too small"
            told = f"singular or non-finite at t = {t:.9g} s: the pivot of {of}\n"
            if p is not None and (masses := far_masses(self.source, self.mass(p))):
                raise SingularError(f"{told}  {masses}", t, row)
            raise SingularError(
                f"{told}  the mechanism is at a singular position (dead centre), constraints are redundant,"
                " or the state is no longer finite: check the start, or take a smaller step",
                t,
                row,
            )

    def _rows(self, function: str, t: float, p: ArrayLike, *states: ArrayLike) -> Array:
        out = np.full(len(self.source.start_rows), np.nan)
        pointers = [self._state(state, name) for name, state in zip("qv", states, strict=False)]
        getattr(self.lib, function)(time(t), *pointers, self._numbers(p), self._out(out))
        return out

    def _point(self, y: ArrayLike, memory: ArrayLike | None, p: ArrayLike) -> tuple[Any, Any, Any]:
        """Pointers to the arguments that every right-hand side takes."""
        state = taken(y, "y")
        if state.shape not in ((2 * self.n,), (2 * self.n + N_WORK,)):
            taken(state, "y", (2 * self.n,))  # says so
        return self.pointer(state), self.pointer(self.memory_array(memory)), self._numbers(p)

    def _numbers(self, p: ArrayLike) -> Any:
        """A pointer to what `prepare` returned."""
        return self.pointer(taken(p, "p", (self.n_p,)))

    def _state(self, values: ArrayLike, name: str) -> Any:
        """A pointer to q or v."""
        return self.pointer(taken(values, name, (self.n,)))

    def _out(self, array: Array) -> Any:
        """A pointer to what C fills."""
        return self.pointer(array, written=True)


def _index(source: KernelSource, row: str) -> int:
    return next(k for k, info in enumerate(source.start_rows) if info.name == row)


def far_masses(source: KernelSource, mass: NDArray[Any]) -> str:
    """Return which masses or inertias are too far apart for doubles, "" if none are.

    mass (n,): the diagonal of M, kg and kg*m^2. An inertia of 0 is allowed by the format, and is compared with none.
    """
    points = any(mass[body.index + 2] == 0.0 for body in source.bodies)
    for what, unit, row, limit in (
        ("masses", "kg", 0, MAX_RATIO_OF_POINTS if points else MOST_APART),
        ("inertias", "kg*m^2", 2, MOST_APART),
    ):
        of = {body.name: float(x) for body in source.bodies if (x := mass[body.index + row]) > 0.0}
        if not of:
            continue
        least, most = min(of, key=of.__getitem__), max(of, key=of.__getitem__)
        if of[most] >= limit * of[least]:
            told = f"the {what} of {most} ({of[most]:g} {unit}) and {least} ({of[least]:g} {unit}) are too far apart"
            beside = " where a body has an inertia of 0" if limit < MOST_APART else ""
            return f"{told} for doubles\n  expected none {limit:g} times another one{beside}; check their units"
    return ""

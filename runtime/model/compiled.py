"""Call the C functions of one compiled scene with NumPy arrays.

All arguments are converted by arrays.py: lists, columns and arrays of any order or real type are accepted, wrong
lengths are refused. A CompiledModel keeps no state, so that several threads may use it; each call releases the GIL. It
can be pickled: the library is then loaded from the cache (or compiled) at the first use.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.contract.boundary import N_WORK
from gudgeon.contract.kernel_source import CACHED_VALUES, KernelSource
from gudgeon.errors import GudgeonError, SingularError
from gudgeon.language.argument_checks import check_number, check_time
from gudgeon.model.arrays import FLAG, as_c_array, make_pointer
from gudgeon.model.choices import fill_in_chosen_values, find_choices
from gudgeon.model.evaluation import (
    FIELD_NAMES,
    Evaluation,
    MotionSeries,
    compute_sample_bytes,
    evaluate,
    evaluate_motion_series,
    find_field_shapes,
)

if TYPE_CHECKING:
    from gudgeon.loading.library import Library

Array: TypeAlias = NDArray[np.float64]

RUNS_PER_CALL = 1024  # runs whose parameter values are computed in one call, so that they stay in the CPU cache
MAX_MASS_RATIO = 1e14  # largest ratio of two masses: in doubles, a sum of both still contains the lighter one
# the same if an inertia is 0: the body's rotation then has the inertia m l² alone
MAX_MASS_RATIO_WITH_POINT_MASS = 1e12


class CompiledModel:
    """Evaluate the equations of one scene in C. `p` is what `prepare` returns: parameters, then derived values (SI)."""

    def __init__(self, source: KernelSource, library: Library, portable: bool = False, text: str = "") -> None:
        self.source, self.portable = source, portable  # whether libraries of this scene are compiled portably
        self.text = text  # of the mechanism's file
        self.__dict__.update(lib=library.lib, ffi=library.ffi)
        self.n, self.n_p = len(source.coordinates), len(source.parameters) + len(source.derived)
        self.n_discrete_states = source.n_discrete_states
        self._free_contact_states = np.full(max(self.n_discrete_states, 1), np.nan)
        self._free_contact_states.flags.writeable = False
        self._choices = find_choices(source)
        self.unused_runs: dict[Any, list[Any]] = {}  # unused runs with their arrays (integrators/single_run.py)
        closed = [row.name for row in source.start_equations]
        self._open_play_rows = np.array([closed.index(row.name) for row in source.equations], dtype=int)

    @cached_property
    def lib(self) -> Any:
        """Return the functions of the library; after unpickling, it is loaded at the first use."""
        return self._library.lib

    @cached_property
    def ffi(self) -> Any:
        """Return cffi's interface to the declarations of the engine."""
        return self._library.ffi

    @cached_property
    def compiler(self) -> str:
        """Return the first line of the C compiler's version; the compiler is run at the first use."""
        from gudgeon.loading.compiler import read_compiler_version

        return read_compiler_version()

    @cached_property
    def has_all_forces(self) -> bool:
        """Return whether all forces are determined: False without masses, and for redundant constraints."""
        return not (self.source.massless_bodies or self.source.indeterminate)

    @cached_property
    def may_drive_acceleration_jump(self) -> bool:
        """Return whether an acceleration that a drive prescribes may jump, as `may_acceleration_jump` finds it.

        The sample at a jump then stores the left limit of the accelerations (left_limit.py).
        """
        from gudgeon.model.left_limit import may_acceleration_jump

        return may_acceleration_jump(self)

    @cached_property
    def field_shapes(self) -> tuple[tuple[str, tuple[int, ...], int], ...]:
        """Return all fields of an Evaluation: name, shape of a sample, and numbers per sample."""
        return find_field_shapes(self)

    @cached_property
    def sample_bytes(self) -> int:
        """Return the bytes of a sample as methods store it."""
        return compute_sample_bytes(self)

    @property
    def has_choices(self) -> bool:
        """Return whether a parameter is a choice, such as one of a material."""
        return bool(self._choices)

    @property
    def _library(self) -> Library:
        """Return the library, loaded from the cache, or compiled if it is not there."""
        from gudgeon.loading.build import compile_kernels

        return compile_kernels(self.source, portable=self.portable)

    def __getstate__(self) -> dict[str, Any]:
        """Return the attributes for pickling, without the library, cached values and unused runs.

        The added hash identifies the arrays that Python and C exchange in this version.
        """
        from gudgeon.loading import declared

        left_out = "lib", "ffi", CACHED_VALUES
        attributes = {name: value for name, value in self.__dict__.items() if name not in left_out}
        return attributes | {"unused_runs": {}, "declarations": declared.SHA256}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Restore the pickled state. Raises GudgeonError if a version with other arrays has written it."""
        from gudgeon.loading import declared

        if state.pop("declarations", "") != declared.SHA256:
            raise GudgeonError(
                "this pickle was written by another version of gudgeon\n  repeat the run; files of save() keep results "
                "across versions"
            )
        self.__dict__.update(state)

    def pointer(self, array: NDArray[Any], kind: str = "double *", is_written: bool = False) -> Any:
        """Return a C pointer to an array, which it keeps alive; `is_written`: C writes there.

        Raises ArrayError for an array of another type than `kind`, or another layout.
        """
        return make_pointer(self.ffi, array, kind, is_written)

    def prepare(self, given: ArrayLike, is_given: ArrayLike) -> Array:
        """Return all values of a run, (n_parameters + n_derived,), from given parameters (n_parameters,) and a mask.

        Parameters that are not given get their defaults. If a choice is given, C is called twice: the first call
        computes the values of the chosen material. Nothing is checked except shapes (ArrayError).
        """
        shape = (len(self.source.parameters),)
        values, mask = as_c_array(given, "given", shape), as_c_array(is_given, "is_given", shape, dtype=FLAG)
        p, given_choices = np.full(self.n_p, np.nan), [k for k in self._choices if mask[k]]
        for is_last_call in (False, True) if given_choices else (True,):  # materials have values of this run
            self.lib.gudgeon_prepare(
                self.pointer(values), self.pointer(mask, "unsigned char *"), self._get_output_pointer(p)
            )
            values, mask = (
                (values, mask) if is_last_call else fill_in_chosen_values(self.source, given_choices, values, mask, p)
            )
        return p

    def prepare_parameters_of_runs(
        self, given: Array, is_given: NDArray[np.generic], zero_indices: Sequence[int] = ()
    ) -> Array:
        """Return the values of n runs, (n, n_parameters + n_derived), from parameters and mask (n, n_parameters).

        Parameters with an index in `zero_indices` are 0. RUNS_PER_CALL runs are computed at a time.
        """
        shape, p = (None, len(self.source.parameters)), np.empty((len(given), self.n_p))
        for rows in (slice(k, k + RUNS_PER_CALL) for k in range(0, len(p), RUNS_PER_CALL)):
            values = as_c_array(given[rows], "given", shape, always_copy=True)
            mask = as_c_array(is_given[rows], "is_given", shape, dtype=FLAG, always_copy=True)
            if zero_indices:
                values[:, zero_indices], mask[:, zero_indices] = 0.0, True
            self.prepare_runs_in_place(values, mask, p[rows])
        return p

    def prepare_runs_in_place(self, values: Array, mask: NDArray[np.uint8], p: Array) -> None:
        """Compute values p (n, n_parameters + n_derived) from arrays (n, n_parameters) in the layout of C, in place.

        Runs are computed one by one if a choice is given.
        """
        if self._choices and mask[:, list(self._choices)].any():
            p[...] = [self.prepare(*pair) for pair in zip(values, mask, strict=True)]
            return
        pointer = self.pointer
        arguments = pointer(values), pointer(mask, "unsigned char *"), pointer(p, is_written=True)
        self.lib.gudgeon_prepare_runs(len(values), values.shape[1], *arguments)

    def mass(self, p: ArrayLike) -> Array:
        """Return the diagonal of the mass matrix M, (n,)."""
        out = np.full(self.n, np.nan)
        self.lib.gudgeon_mass(self._get_parameter_pointer(p), self._get_output_pointer(out))
        return out

    def closed_phi(self, t: float, q: ArrayLike, p: ArrayLike) -> Array:
        """Return the residuals Φ with every joint closed (no play, e = 0), in the order of source.start_equations."""
        return self._evaluate_constraint_function("gudgeon_phi", t, p, q)

    def closed_phi_q(self, t: float, q: ArrayLike, p: ArrayLike) -> Array:
        """Return the Jacobian Φ_q with every joint closed (no play, e = 0), (number of start_rows, n)."""
        out = np.empty((len(self.source.start_equations), self.n))
        self.lib.gudgeon_phi_q(
            check_time(t),
            self._make_coordinate_pointer(q, "q"),
            self._get_parameter_pointer(p),
            self._get_output_pointer(out),
        )
        return out

    def closed_nu(self, t: float, q: ArrayLike, p: ArrayLike) -> Array:
        """Return ν = −Φ_t with every joint closed (no play), in the order of source.start_equations."""
        return self._evaluate_constraint_function("gudgeon_nu", t, p, q)

    def phi(self, t: float, q: ArrayLike, p: ArrayLike) -> Array:
        """Return the residuals Φ(q, t), (m,), of the constraint equations source.equations."""
        return self.closed_phi(t, q, p)[self._open_play_rows]

    def phi_q(self, t: float, q: ArrayLike, p: ArrayLike) -> Array:
        """Return the constraint Jacobian Φ_q, (m, n)."""
        return self.closed_phi_q(t, q, p)[self._open_play_rows]

    def nu(self, t: float, q: ArrayLike, p: ArrayLike) -> Array:
        """Return ν = −Φ_t, (m,)."""
        return self.closed_nu(t, q, p)[self._open_play_rows]

    def gamma(self, t: float, q: ArrayLike, v: ArrayLike, p: ArrayLike) -> Array:
        """Return the right-hand side γ of the acceleration constraints, (m,)."""
        return self.closed_gamma(t, q, v, p)[self._open_play_rows]

    def closed_gamma(self, t: float, q: ArrayLike, v: ArrayLike, p: ArrayLike) -> Array:
        """Return γ with all joints without play, in the order of source.start_equations."""
        return self._evaluate_constraint_function("gudgeon_gamma", t, p, q, v)

    def start_values(self, p: ArrayLike) -> tuple[Array, Array, Array]:
        """Return the values of the file's start: guess, set, rates; the last two end with e and ė of start_apart.

        Each is an array (number of coordinates,) in the order of source.start_guess, start_set and start_rates.
        """
        s, n_held_open = self.source, len(self.source.eccentricity_equations)
        n_guess, n_set = len(s.start_guess), len(s.start_guess) + len(s.start_set) + n_held_open
        values = np.zeros(n_set + len(s.start_rates) + n_held_open + 1)
        first = self._get_output_pointer(values)
        self.lib.gudgeon_start_values(self._get_parameter_pointer(p), first, first + n_guess, first + n_set)
        return values[:n_guess], values[n_guess:n_set], values[n_set:-1]

    def close_linkage(self, t: float, p: ArrayLike, size: float) -> tuple[Array, Array, float] | None:
        """Return the start's q and q̇ (n,) and max |Φ| by Newton's method in C; None if it does not converge.

        `size` of the mechanism (m) scales lengths against angles. runtime/assembly/start.py treats the other cases.
        """
        n, values = self.n, np.empty(2 * self.n + 1)
        arguments = check_time(t), self._get_parameter_pointer(p), check_number(size, "size")
        q = self._get_output_pointer(values)
        if self.lib.gudgeon_start(*arguments, q, q + n, q + 2 * n):
            return None
        return values[:n], values[n : 2 * n], values.item(2 * n)

    def close_configuration(self, t: float, p: ArrayLike, size: float, radius: float, q: Array) -> Array | None:
        """Return q (n,) after Newton's method in C, whether it is closed or not; None if equations are dependent.

        Angles that equations without positions determine are set first. `size` of the mechanism and `radius` of the
        search are in m.
        """
        q = as_c_array(q, "q", (self.n,), always_copy=True)
        arguments = check_time(t), self._get_parameter_pointer(p), check_number(size, "size")
        status = self.lib.gudgeon_close(*arguments, check_number(radius, "radius"), self._get_output_pointer(q))
        return q if status < 2 else None

    def rhs(self, t: float, y: ArrayLike, p: ArrayLike, discrete_states: ArrayLike | None = None) -> Array:
        """Return (q̇, q̈, powers of drives, forces and joints with play), (2n + 3,), at y = (q, q̇), (2n,) or longer.

        `discrete_states` (n_discrete_states,): δ̇⁻ of closed contacts, NaN for free ones (the default), modes of
        frictions, internal states of laws. Raises ArrayError for another length, SingularError for a vanished pivot or
        a state that is not finite.
        """
        out = np.empty(2 * self.n + N_WORK)
        status = self.lib.gudgeon_rhs(
            check_time(t), *self._make_state_pointers(y, discrete_states, p), self._get_output_pointer(out)
        )
        self.check_pivot(status, t, p=p)
        return out

    def jacobian(
        self, t: float, y: ArrayLike, p: ArrayLike, discrete_states: ArrayLike | None = None
    ) -> tuple[Array, Array]:
        """Return the exact ∂f/∂y and ∂f/∂t of `rhs` f at y = (q, q̇); SI.

        The shapes are (2n + 3 + k, 2n + 3 + k) and (2n + 3 + k,). k is the number of internal states of laws: their
        rates follow q̈ and the powers, the states follow the works. Their values are in `discrete_states`, as in a
        sample. Contacts, branches of switching functions and modes of friction are those of this state. Raises
        SingularError where constraint equations depend on each other, ValueError for scenes without a Jacobian.
        `discrete_states` None: all contacts are open.
        """
        if reason := self.source.reason_without_jacobian:
            raise ValueError(f"this scene has no Jacobian: {reason}")
        size = 2 * self.n + N_WORK + len(self.source.internal_states)
        J, f_t = np.empty((size, size)), np.empty(size)
        status = self.lib.gudgeon_jacobian(
            check_time(t),
            *self._make_state_pointers(y, discrete_states, p),
            self._get_output_pointer(J),
            self._get_output_pointer(f_t),
        )
        self.check_linearization(status, t)
        return J, f_t

    def solve_newton_system(
        self,
        t: float,
        y: ArrayLike,
        p: ArrayLike,
        eta: float,
        s: float,
        r: ArrayLike,
        discrete_states: ArrayLike | None = None,
    ) -> Array:
        """Return u, (2n + 3 + k,), with u/η − J u = r + s f_t: the linear system of Newton's method in the implicit
        methods.

        J and f_t are those of `jacobian` at t, y; eta (s) is the step times the method's coefficient, s (s) the factor
        of f_t, r the right-hand side (2n + 3 + k,). Raises ValueError for a scene without a Jacobian, SingularError for
        a singular matrix.
        """
        if reason := self.source.reason_without_jacobian:
            raise ValueError(f"this scene has no Jacobian: {reason}")
        u = np.empty(2 * self.n + N_WORK + len(self.source.internal_states))
        right_hand_side, eta, s = (
            self.pointer(as_c_array(r, "r", u.shape)),
            check_number(eta, "eta"),
            check_number(s, "s"),
        )
        status = self.lib.gudgeon_newton(
            check_time(t),
            *self._make_state_pointers(y, discrete_states, p),
            eta,
            s,
            right_hand_side,
            self._get_output_pointer(u),
        )
        self.check_linearization(status, t)
        return u

    def check_linearization(self, status: int, t: float) -> None:
        """Raise SingularError for a nonzero status of a linearization; return for status 0.

        −k names the k-th of coordinates, constraint equations, frictions and internal states; a positive status is that
        of `check_pivot`.
        """
        s = self.source
        self.check_pivot(status, t)
        if status < 0:
            names = (*s.coordinates, *(row.name for row in s.equations), *s.frictions, *s.internal_states)
            self.check_pivot(-status, t, names)

    def evaluate_motion_series(
        self, series: MotionSeries, sample_counts: Sequence[int], columns: Sequence[Array], p: Array
    ) -> Array:
        """Return a series (N,) of the motion at samples of runs that follow each other: evaluation.py."""
        return evaluate_motion_series(self, series, sample_counts, columns, p)

    def evaluate(
        self,
        t: ArrayLike,
        q: ArrayLike,
        v: ArrayLike,
        discrete_states: ArrayLike,
        p: ArrayLike,
        poll_cancellation: Callable[[], object] = lambda: None,
        field_names: Collection[str] = FIELD_NAMES,
    ) -> Evaluation:
        """Return all quantities of a run (accelerations, multipliers, joint forces and others) at N samples.

        t: (N,). q, v: (N, n). discrete_states: (N, n_discrete_states). p: one set of parameter values, (n_p,), for all
        samples.

        `poll_cancellation` is called every few milliseconds, and its exceptions are passed on. `field_names`: the
        requested fields of Evaluation. Raises SingularError for a sample that has no accelerations.
        """
        return evaluate(self, t, q, v, discrete_states, p, poll_cancellation, field_names)

    def as_discrete_states(self, discrete_states: ArrayLike | None) -> Array:
        """Return the discrete states (n_discrete_states,), as an array for C.

        They are δ̇⁻ per joint with play, mode per friction, internal states of laws.
        None: all joints free, modes unknown; this array is shared and read-only. In a scene without discrete states, an
        array of one number is accepted. Raises ArrayError for another length.
        """
        if discrete_states is None:
            return self._free_contact_states
        array = as_c_array(discrete_states, "memory")
        return (
            array
            if not self.n_discrete_states and array.shape == (1,)
            else as_c_array(array, "memory", (self.n_discrete_states,))
        )

    def check_pivot(
        self, status: int, t: float, pivot_names: tuple[str, ...] | None = None, p: ArrayLike | None = None
    ) -> None:
        """Raise SingularError for a status k > 0, with the constraint equation of the pivot; return for other values.

        `pivot_names`: names to which k refers, those of the source by default; the pivot of a coordinate is reported as
        too small. `p`: parameter values, to name masses whose ratio is too large. `p` None: no ratio of masses is
        tested.
        """
        if status > 0:
            row = (pivot_names or self.source.pivots)[status - 1]
            fault = (
                f"constraint equation {row} vanished" if row not in self.source.coordinates else f"{row} is too small"
            )
            message = f"singular or non-finite at t = {t:.9g} s: the pivot of {fault}\n"
            if p is not None and (masses := describe_mass_ratio(self.source, self.mass(p))):
                raise SingularError(f"{message}  {masses}", t, row)
            raise SingularError(
                f"{message}  the mechanism is at a singular position (dead centre), constraints are redundant,"
                " or the state is no longer finite: check the start, or use a smaller step",
                t,
                row,
            )

    def _evaluate_constraint_function(self, function_name: str, t: float, p: ArrayLike, *states: ArrayLike) -> Array:
        """Return the values of all constraint equations in source.start_equations by the C function `function_name`.

        It is Φ, ν or γ. `states` are q, or q and v, (n,) each.
        """
        out = np.full(len(self.source.start_equations), np.nan)
        pointers = [self._make_coordinate_pointer(state, name) for name, state in zip("qv", states, strict=False)]
        getattr(self.lib, function_name)(
            check_time(t), *pointers, self._get_parameter_pointer(p), self._get_output_pointer(out)
        )
        return out

    def _make_state_pointers(
        self, y: ArrayLike, discrete_states: ArrayLike | None, p: ArrayLike
    ) -> tuple[Any, Any, Any]:
        """Return C pointers to y, the discrete states and p, the arguments that every right-hand side takes.

        y: (2n,), or (2n + 3,) with the works. Raises ArrayError for another shape. `discrete_states` None: all contacts
        are open.
        """
        state = as_c_array(y, "y")
        if state.shape not in ((2 * self.n,), (2 * self.n + N_WORK,)):
            as_c_array(state, "y", (2 * self.n,))  # raises the error
        return (
            self.pointer(state),
            self.pointer(self.as_discrete_states(discrete_states)),
            self._get_parameter_pointer(p),
        )

    def _get_parameter_pointer(self, p: ArrayLike) -> Any:
        """Return a pointer to the parameter values."""
        return self.pointer(as_c_array(p, "p", (self.n_p,)))

    def _make_coordinate_pointer(self, values: ArrayLike, name: str) -> Any:
        """Return a pointer to q or v."""
        return self.pointer(as_c_array(values, name, (self.n,)))

    def _get_output_pointer(self, array: Array) -> Any:
        """Return a pointer to an array that C fills."""
        return self.pointer(array, is_written=True)


def describe_mass_ratio(source: KernelSource, mass: NDArray[Any]) -> str:
    """Return a text on masses or inertias whose ratio is too large for doubles; "" if there are none.

    mass (n,): the diagonal of M in kg and kg·m². Inertias of 0 are allowed and not compared; the limit of masses is
    then lower.
    """
    has_zero_inertia = any(mass[body.index + 2] == 0.0 for body in source.bodies)
    for quantity, unit, row, limit in (
        ("masses", "kg", 0, MAX_MASS_RATIO_WITH_POINT_MASS if has_zero_inertia else MAX_MASS_RATIO),
        ("inertias", "kg*m^2", 2, MAX_MASS_RATIO),
    ):
        values = {body.name: float(x) for body in source.bodies if (x := mass[body.index + row]) > 0.0}
        if not values:
            continue
        lightest, heaviest = min(values, key=values.__getitem__), max(values, key=values.__getitem__)
        if values[heaviest] >= limit * values[lightest]:
            message = f"the {quantity} of {heaviest} ({values[heaviest]:g} {unit})"
            message += f" and {lightest} ({values[lightest]:g} {unit}) have too large a ratio"
            condition = " where a body has an inertia of 0" if limit < MAX_MASS_RATIO else ""
            return f"{message} for doubles\n  expected less than {limit:g} times{condition}; check their units"
    return ""

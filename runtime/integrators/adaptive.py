"""Choose method, tolerances and scales of the adaptive integrators (engine/methods/adaptive.c).

- `dop853`: explicit, order 8, dense output of order 7 (E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary
  Differential Equations I, 1993, section II.5).
- `dopri5`: explicit, order 5, dense output of order 4 (J. R. Dormand, P. J. Prince, 1980;
  engine/scalar_simd/runge_kutta.h).
- `rodas5p`: Rosenbrock, order 5, L-stable, exact Jacobian, dense output of order 4 (G. Steinebach, BIT 63:27, 2023).
- `taylor`: Taylor series of the motion, of an order that follows from the tolerance, for smooth motion.
- `radau5`, `radau9`: Radau IIA of orders 5 and 9, L-stable, exact Jacobian, dense output of order 4
  (engine/scalar_simd/radau.h).
- `auto`: an explicit and a stiff method. It is explicit until h ρ(J) reaches the stability bound in some steps, and
  stiff until h ρ(J) is so small that the explicit method needs no more steps. The explicit method is `dop853`, or
  `taylor` where the motion is smooth and the series is cheap (`select_explicit_method`). The stiff method is
  `rodas5p`. In a scene with films it is `radau5`, below the tolerance FINE `radau9`, because a film's force is strongly
  non-linear.

The error of a step is controlled component by component: lengths to rtol · L, angles to rtol · L/S. Velocities are
controlled to rtol times the largest speed of their kind so far. S is the mechanism's size. L is the smallest radial
clearance, or S without play, since motion within the play determines the forces.

A film's force follows the journal's speed in its bearing, which is L/S of the links' speeds. With a film, rtol of
velocities is therefore at most MAX_FILM_SPEED_ERROR · L/S. Newton's iterations of `radau5` and `radau9` end when no
film's force changes by more than a fraction of rtol of it. Between the ends of steps, motion is the collocation
polynomial, whose accelerations do not amplify errors of velocities.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.assembly.linkage import find_angles
from gudgeon.contract.kernel_source import KernelSource, RuntimeParameter
from gudgeon.contract.methods import (
    ADAPTIVE,
    EXPLICIT,
    FINE,
    KINEMATIC,
    SMOOTH,
    STAGED,
    STEP_CONTROLLED_METHODS,
    STIFF,
    TAYLOR,
)
from gudgeon.errors import BadValueError, InputError
from gudgeon.model.arrays import FLAG, set_struct_pointers
from gudgeon.model.cached_values import cache_by_values
from gudgeon.model.compiled import Array, CompiledModel
from gudgeon.model.parameters import read_parameter_value
from gudgeon.model.sizes import (
    MIN_RELATIVE_CLEARANCE,
    compute_mechanism_sizes,
    find_size_indices,
    scatter_lengths,
    select_lengths,
)

RTOL = 1e-8  # default tolerance of a run
MAX_FILM_SPEED_ERROR = 0.015  # largest error of velocities relative to the speeds within a film
MIN_RTOL = 1e-14  # smallest rtol: below it, rounding errors would be controlled
MIN_RTOL_COMPENSATED = 1e-16  # the same for SMOOTH methods, which use compensated sums


def parse_tolerance(rtol: float | str | None, method: str, has_fixed_step: bool) -> float:
    """Return the checked relative tolerance of a step from the argument `rtol`; the default RTOL if it is None.

    rtol: a number or its text. Raises BadValueError below MIN_RTOL (MIN_RTOL_COMPENSATED for SMOOTH methods), from 1
    on, and for a method with a fixed step, except kinematic.
    """
    if rtol is None:
        return RTOL
    if method == "rk4" or (has_fixed_step and method != "kinematic"):
        raise BadValueError(
            f"method {method!r} with a fixed step has no tolerance",
            hint=f"leave out rtol; or leave out step and use {', '.join(('auto', *STEP_CONTROLLED_METHODS))}",
        )
    try:
        value = read_parameter_value(rtol, RuntimeParameter("rtol", "", 0.0, False, (0, 0, 0)))
    except InputError:
        value = math.nan
    smallest = MIN_RTOL_COMPENSATED if method in SMOOTH else MIN_RTOL
    if not smallest <= value < 1.0:
        message = f"{value:g}" if math.isfinite(value) else repr(rtol)
        raise BadValueError(
            f"rtol is {message}: expected a number from {smallest:g} to less than 1, such as 1e-8",
            hint="smaller tolerances are below rounding errors" if 0.0 < value < 1.0 else "",
        )
    return value


def select_stiff_method(source: KernelSource, rtol: float) -> str:
    """Return the name of the stiff method that `auto` uses for a scene at a tolerance.

    It is rodas5p, or with a film radau5 (radau9 for rtol below FINE) if the library has their stages.
    """
    return STAGED[rtol < FINE] if source.has_stage_matrices and _has_film(source) else STIFF


def select_first_method(source: KernelSource, rtol: float = RTOL) -> str:
    """Return the name of the method with which `auto` begins a run of the scene.

    It is the kinematic analysis without degrees of freedom, the stiff method with a film, else the explicit one
    (physics.md, section 4).
    """
    if KINEMATIC in source.methods:
        return KINEMATIC
    has_stiff_film = _has_film(source) and not source.is_explicit
    return select_stiff_method(source, rtol) if has_stiff_film else select_explicit_method(source, rtol)


def select_explicit_method(source: KernelSource, rtol: float) -> str:
    """Return the name of the explicit method of `auto`: TAYLOR for tolerances at which it is faster, else EXPLICIT.

    The generator predicts this tolerance from the number of operations (generator/kernels/taylor.py). A library without
    the series has EXPLICIT only: `lacks_taylor_series`.
    """
    return TAYLOR if source.taylor_file and rtol < source.max_taylor_tolerance else EXPLICIT


def lacks_taylor_series(source: KernelSource, rtol: float) -> bool:
    """Return whether `auto` integrates by Taylor series at a tolerance, but the library of the scene has none.

    The variant TAYLOR of the scene has them.
    """
    return not source.taylor_file and rtol < source.max_taylor_tolerance


def uses_taylor_series(source: KernelSource, method: str, rtol: float) -> bool:
    """Return whether a run by a method, as select_method returns it, makes its steps by Taylor series."""
    return (select_first_method(source, rtol) if method == ADAPTIVE else method) == TAYLOR


@cache_by_values
def _has_film(source: KernelSource) -> bool:
    """Return whether a joint with play has a lubricant film."""
    return any(joint.film for joint in source.clearances)


@cache_by_values
def find_method_numbers(compiled: CompiledModel, method: str, rtol: float) -> tuple[int, int]:
    """Return C's numbers of the first method and of the stiff one to which a run may switch; 0: it may not switch.

    Only runs by "adaptive", the internal name of the method of "auto", may switch.
    """
    if method != ADAPTIVE:
        return int(compiled.lib.gudgeon_method(method.encode())), 0
    names = select_first_method(compiled.source, rtol), select_stiff_method(compiled.source, rtol)
    first, stiff = (int(compiled.lib.gudgeon_method(name.encode())) for name in names)
    return first, stiff


def compute_error_lengths(compiled: CompiledModel, p: Array) -> tuple[Array, Array]:
    """Return the length L of allowed errors and the mechanism's size S (m), for parameter values p (..., n_p).

    L is the smallest positive clearance, else S. Both have the shape (...); see this module's head.
    """
    size = compute_mechanism_sizes(compiled.source, p)
    clearances = p[..., [joint.clearance for joint in compiled.source.clearances]]
    min_clearance = np.where(clearances > 0.0, clearances, np.inf).min(axis=-1, initial=np.inf)
    return np.where(np.isfinite(min_clearance), min_clearance, size), size


@cache_by_values
def find_integrated_angles(source: KernelSource) -> NDArray[np.bool_]:
    """Return a mask (n_x,) of the integrated coordinates that are angles, for either formulation."""
    if source.formulation == "reduced":  # tree coordinates: angles are named by their bodies, lengths "guide.slide"
        return np.array(["." not in name for name in source.tree_coordinates], dtype=bool)
    return find_angles(source)


def compute_tolerances(compiled: CompiledModel, p: Array, rtol: float) -> tuple[Array, Array]:
    """Return the error tolerances (..., 2 n_x) of a step, and L and L/S, (..., 2), for the time loop in C.

    The first n_x are those of coordinates, the others those of velocities per unit of speed. L: smallest positive
    clearance, or S without one; S: size of the mechanism (m). Without integrated coordinates there is one tolerance,
    rtol, for the works. With a film, tolerances of velocities are smaller. `p` (..., n_parameters + n_derived) holds
    the parameter values of one run, or of several.
    """
    return _compute_tolerances_and_sizes(compiled, p, rtol)[:2]


def _compute_tolerances_and_sizes(compiled: CompiledModel, p: Array, rtol: float) -> tuple[Array, Array, Array]:
    """Return what `compute_tolerances` returns, and the mechanism sizes S (...,) in m."""
    source = compiled.source
    with np.errstate(over="ignore", invalid="ignore"):  # runs with such values fail later, one by one
        lengths, sizes = compute_error_lengths(compiled, p)
        of_angles, of_lengths, of_speeds = compute_error_scales(source, lengths, sizes, rtol)
        ratio = lengths / sizes
    of_q = np.where(find_integrated_angles(source), of_angles[..., None], of_lengths[..., None])
    of_speed = np.broadcast_to(np.asarray(of_speeds)[..., None], of_q.shape)
    tolerances = np.concatenate([of_q, of_speed], axis=-1)
    if not tolerances.shape[-1]:
        tolerances = np.full((*lengths.shape, 1), rtol)
    return tolerances, np.stack([lengths, ratio], axis=-1), sizes


def compute_error_scales(source: KernelSource, length: Any, size: Any, rtol: float) -> tuple[Any, Any, Any]:
    """Return the error tolerances of angles, of lengths and of velocities per unit of speed, from L and S (m).

    `length`, `size`: floats or arrays; the tolerance of velocities is a float if all runs have the same.
    """
    ratio = length / size
    return (
        rtol * ratio,
        rtol * length,
        np.minimum(rtol, MAX_FILM_SPEED_ERROR * length / size) if _has_film(source) else rtol,
    )


def compute_tolerances_of_runs(compiled: CompiledModel, p: Array, rtol: float) -> tuple[Array, Array, Array]:
    """Return error tolerances (n, 2 n_x), L and L/S (n, 2), and mechanism sizes S (n,) in m of n runs.

    See `compute_tolerances`. Arrays of a single run are cached for equal lengths and must not be changed. `p` (n,
    n_parameters + n_derived): parameter values.
    """
    if len(p) > 1:
        return _compute_tolerances_and_sizes(compiled, p, rtol)
    return _compute_cached_tolerances_of_run(compiled, select_lengths(compiled.source, p[0]), rtol)


@cache_by_values
def _compute_cached_tolerances_of_run(
    compiled: CompiledModel, lengths: Array, rtol: float
) -> tuple[Array, Array, Array]:
    """Return what `compute_tolerances_of_runs` returns for one run: tolerances (1, 2 n_x), (L, L/S) (1, 2), S (1,).

    `lengths`: the parameter values (m) on which they depend, from `select_lengths`.
    """
    return _compute_tolerances_and_sizes(compiled, scatter_lengths(compiled.source, lengths)[None], rtol)


def make_tolerance_table(compiled: CompiledModel, rtol: float) -> tuple[Any, dict[str, NDArray[Any]]]:
    """Return C's struct ToleranceTable of a scene, and its arrays by name, which the caller keeps.

    gudgeon_compute_tolerances computes from it, bit for bit, what `compute_tolerances_of_runs` returns.
    """
    source, contours = compiled.source, {info.joint: (info.first, info.count) for info in compiled.source.contours}
    clearances = [(joint.clearance, *contours.get(joint.name, (0, 0))) for joint in source.clearances]
    arrays: dict[str, NDArray[Any]] = {
        "points": np.array(find_size_indices(source), np.int_).reshape(-1, 2),
        "clearances": np.array(clearances, np.int_).reshape(-1, 3),
        "is_angle": find_integrated_angles(source).astype(FLAG),
    }
    struct = compiled.ffi.new("ToleranceTable *")
    set_struct_pointers(compiled.ffi, struct, arrays)
    struct.n_points, struct.n_clearances, struct.n_coordinates = map(len, arrays.values())
    struct.rtol, struct.min_relative_clearance = rtol, MIN_RELATIVE_CLEARANCE
    struct.max_film_speed_error = MAX_FILM_SPEED_ERROR if _has_film(source) else math.inf
    return struct, arrays

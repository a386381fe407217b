"""Evaluate all quantities of a run at its sample times in C, and estimate the memory that the samples take."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, fields
from time import perf_counter
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.contract.boundary import (
    CLEARANCE_COLUMN_NAMES,
    N_CLEARANCE_COLUMNS,
    N_DRIFT,
    N_ENERGY,
    N_FRICTION_COLUMNS,
    N_REACTION_COLUMNS,
    N_WORK,
)
from gudgeon.files.free_space import MIN_CHECKED_BYTES, check_memory
from gudgeon.model.arrays import as_c_array

if TYPE_CHECKING:
    from gudgeon.model.compiled import CompiledModel

Array: TypeAlias = NDArray[np.float64]

CLEARANCE_COLUMNS = CLEARANCE_COLUMN_NAMES
MIN_CHECKED_SAMPLES = 10_000  # samples from which on the memory is checked before an evaluation
# samples of the first call of C, and the intended time (s) of a call, so that Ctrl-C is handled within it
FIRST_CHUNK_SAMPLES, MAX_CALL_TIME_S = 256, 5e-3
# quantities that one C function of the scene computes together
OUTPUTS = frozenset({"reactions", "torques", "series", "energy"})
BYTES_PER_RUN = 1000  # bytes, about: lists and counts of a run


@dataclass(frozen=True)
class Evaluation:
    """Hold the quantities at N samples, SI units; fields that were not requested have no rows."""

    a: Array  # (N, n) q̈
    multipliers: Array  # (N, m) λ
    reactions: Array  # (N, n_joints + n_guides, 3) Fx, Fy, M on the second body at its point, ground axes
    torques: Array  # (N, n_drives) torque (N·m) or force (N) of each drive
    clearance: Array  # (N, n_clearances, 10) CLEARANCE_COLUMNS: force on the second body; Fn > 0 pushes it back
    series: Array  # (N, n_series) results of force elements
    friction: Array  # (N, n_frictions, 2) force on the second body along the direction, slip
    energy: Array  # (N, 2) kinetic, potential
    power: Array  # (N, 3) of drives, of force elements (but what they store), of joints with play (W)
    drift: Array  # (N, 2) largest |Φ| (m, rad) and |Φ̇| (m/s, rad/s) of the constraint equations


class MotionSeries(NamedTuple):
    """Describe a coordinate of a body's centre of mass or of a point, or its time derivative, as C does."""

    order: int  # 0: position, 1: velocity, 2: acceleration
    axis: int  # 0: x, 1: y, 2: angle of a body
    body: int  # index of the body's x in q; -1: ground
    x: int = -1  # parameters with the point's components in the body's frame, times the signs; -1: 0
    y: int = -1
    sign_x: float = 1.0
    sign_y: float = 1.0


FIELD_NAMES = frozenset(field.name for field in fields(Evaluation))  # names of the fields of an Evaluation


def evaluate(
    compiled: CompiledModel,
    t: ArrayLike,
    q: ArrayLike,
    v: ArrayLike,
    discrete_states: ArrayLike,
    p: ArrayLike,
    poll_cancellation: Callable[[], object],
    field_names: Collection[str],
) -> Evaluation:
    """Return the quantities at N samples of one run; arguments as in CompiledModel.evaluate.

    C is called for chunks of samples, so that `poll_cancellation` is called every few milliseconds. Raises ArrayError
    for arrays of other shapes, MemoryError if the result does not fit, SingularError for a sample without
    accelerations.
    """
    time = as_c_array(t, "t", (None,))
    N = len(time)
    check = _check_matrix if N > FIRST_CHUNK_SAMPLES else _convert_matrix
    memory = check(discrete_states, "memory", N, None)
    if compiled.n_discrete_states or memory.shape[1] > 1:  # without discrete states, one column is accepted too
        check(memory, "memory", N, compiled.n_discrete_states)
    inputs = (("q", check(q, "q", N, compiled.n)), ("v", check(v, "v", N, compiled.n)), ("memory", memory))
    evaluation, outputs = allocate_evaluation(compiled, N, field_names)
    failed_index, first, chunk_size = compiled.ffi.new("long *"), 0, FIRST_CHUNK_SAMPLES
    parameter_pointer = compiled.pointer(as_c_array(p, "p", (compiled.n_p,)))
    while first < N:
        start_time, count = perf_counter(), min(chunk_size, N - first)
        chunk = slice(first, first + count)
        input_pointers = [compiled.pointer(as_c_array(values[chunk], name, (count, None))) for name, values in inputs]
        output_pointers = [pointer + first * width if first and width else pointer for pointer, width in outputs]
        status = compiled.lib.gudgeon_evaluate(
            count, compiled.pointer(time[chunk]), *input_pointers, parameter_pointer, *output_pointers, failed_index
        )
        if status:
            compiled.check_pivot(status, float(time[first + failed_index[0]]), p=p)
        first += count
        chunk_size = 4 * count if perf_counter() - start_time < MAX_CALL_TIME_S else max(1, count // 4)
        poll_cancellation()
    _mark_indeterminate_forces(compiled, evaluation)
    return evaluation


def evaluate_runs(
    compiled: CompiledModel,
    sample_counts: Sequence[int],
    t: Array,
    q: Array,
    v: Array,
    discrete_states: Array,
    p: Array,
    field_names: Collection[str],
) -> Evaluation:
    """Return the quantities at few samples of several runs: sample_counts[i] samples of run i with values p[i].

    The samples of the runs follow each other: t (N,), q and v (N, n), discrete_states (N, n_discrete_states), N =
    sum(sample_counts). `field_names`: the requested fields. Raises ArrayError, SingularError.
    """
    N = sum(sample_counts)
    shapes = (("t", t, (N,)), ("q", q, (N, compiled.n)), ("v", v, (N, compiled.n)))
    input_pointers = [compiled.pointer(as_c_array(values, name, shape)) for name, values, shape in shapes]
    input_pointers.append(compiled.pointer(as_c_array(discrete_states, "memory", (N, compiled.n_discrete_states))))
    parameter_pointer = compiled.pointer(as_c_array(p, "p", (len(sample_counts), compiled.n_p)))
    (evaluation, outputs), failed_index = (
        allocate_evaluation(compiled, N, field_names),
        compiled.ffi.new("long *"),
    )
    counts_pointer = compiled.ffi.new("long[]", sample_counts)
    status = compiled.lib.gudgeon_evaluate_runs(
        len(sample_counts),
        counts_pointer,
        *input_pointers,
        parameter_pointer,
        compiled.n_p,
        *(pointer for pointer, _ in outputs),
        failed_index,
    )
    compiled.check_pivot(status, math.nan)
    _mark_indeterminate_forces(compiled, evaluation)
    return evaluation


def evaluate_motion_series(
    compiled: CompiledModel, series: MotionSeries, sample_counts: Sequence[int], columns: Sequence[Array], p: Array
) -> Array:
    """Return a series (N,) of the motion at samples of several runs that follow each other: sample_counts[i] of run i.

    `columns`: position, velocity and acceleration of the series' body, (N, 3) each, as far as its order needs them;
    none for the ground. p (n_runs, n_p), or (n_p,) for one run. Raises ArrayError.
    """
    N, null = sum(sample_counts), compiled.ffi.NULL
    pointers = [compiled.pointer(as_c_array(values, "columns", (N, 3))) for values in columns]
    pointers += [null] * (3 - len(pointers))
    parameters, values = as_c_array(np.atleast_2d(p), "p", (len(sample_counts), compiled.n_p)), np.empty(N)
    compiled.lib.gudgeon_motion_series(
        compiled.ffi.new("MotionSeries *", series),
        len(sample_counts),
        compiled.ffi.new("long[]", sample_counts),
        *pointers,
        compiled.pointer(parameters),
        compiled.n_p,
        compiled.pointer(values, is_written=True),
    )
    return values


def view_evaluation(compiled: CompiledModel, block: Array, n_samples: int) -> Evaluation:
    """Return an Evaluation of `n_samples` samples whose fields are successive views of a block (1-D)."""
    arrays, offset = list[Array](), 0
    for _, shape, width in compiled.field_shapes:
        arrays.append(block[offset : offset + n_samples * width].reshape(n_samples, *shape))
        offset += n_samples * width
    return Evaluation(*arrays)


def select_evaluated_rows(evaluation: Evaluation, rows: slice | NDArray[np.intp]) -> Evaluation:
    """Return the quantities at some samples: views for a slice, copies for indices. All fields must have rows."""
    return Evaluation(*(part[rows] for part in vars(evaluation).values()))


def compute_rounding_distance(t: Array) -> Array:
    """Return the distance (s) from times t within which rounding decides on which side of a switching point t is.

    It is 32 |t| times the machine epsilon, at least 1e-100 s.
    """
    return np.asarray(np.maximum(32.0 * np.finfo(float).eps * np.abs(t), 1e-100))


def compute_evaluation_bytes(compiled: CompiledModel, field_names: Collection[str] | None = None) -> int:
    """Return the bytes of an evaluation per sample; `field_names`: the requested fields, None for all."""
    return 8 * sum(width for name, _, width in compiled.field_shapes if field_names is None or name in field_names)


def allocate_evaluation(
    compiled: CompiledModel, n_samples: int, field_names: Collection[str]
) -> tuple[Evaluation, list[tuple[Any, int]]]:
    """Return an Evaluation of `n_samples` rows of NaN for C to fill, and each field's C pointer and numbers per row.

    Fields that are not requested have no rows, a null pointer and width 0. Fields that C computes together are
    allocated together. The fields of few samples are views of one block. Raises MemoryError for many samples without
    enough memory.
    """
    requested_fields = {*field_names, *OUTPUTS} if not OUTPUTS.isdisjoint(field_names) else field_names
    if n_samples > MIN_CHECKED_SAMPLES:
        check_memory(
            float(n_samples) * compute_evaluation_bytes(compiled, requested_fields),
            f"the evaluated quantities of {n_samples} samples",
        )
    is_short = n_samples <= FIRST_CHUNK_SAMPLES
    n_block = n_samples * sum(width for name, _, width in compiled.field_shapes if name in requested_fields)
    block = np.full(n_block if is_short else 0, np.nan)
    block_pointer, offset = compiled.pointer(block, is_written=True), 0
    arrays, pointers = list[Array](), list[tuple[Any, int]]()
    for name, shape, width in compiled.field_shapes:
        if name not in requested_fields:
            arrays.append(np.empty((0, *shape)))
            pointers.append((compiled.ffi.NULL, 0))
        elif is_short:
            arrays.append(block[offset : offset + n_samples * width].reshape(n_samples, *shape))
            pointers.append((block_pointer + offset, width))
            offset += n_samples * width
        else:
            arrays.append(np.full((n_samples, *shape), np.nan))
            pointers.append((compiled.pointer(arrays[-1], is_written=True), width))
    return Evaluation(*arrays), pointers


def find_field_shapes(compiled: CompiledModel) -> tuple[tuple[str, tuple[int, ...], int], ...]:
    """Return all fields of an Evaluation in their order: name, shape of a sample, and number of doubles per sample."""
    s = compiled.source
    widths: dict[str, tuple[int, ...]] = {
        "a": (compiled.n,),
        "multipliers": (len(s.equations),),
        "reactions": (len(s.joints) + len(s.guides), N_REACTION_COLUMNS),
        "torques": (len(s.drives),),
        "clearance": (len(s.clearances), N_CLEARANCE_COLUMNS),
        "series": (len(s.series),),
        "friction": (len(s.frictions), N_FRICTION_COLUMNS),
        "energy": (N_ENERGY,),
        "power": (N_WORK,),
        "drift": (N_DRIFT,),
    }
    names = (field.name for field in fields(Evaluation))
    return tuple((name, widths[name], math.prod(widths[name])) for name in names)


def _mark_indeterminate_forces(compiled: CompiledModel, evaluation: Evaluation) -> None:
    """Set forces in an Evaluation to NaN, in place, if redundant constraints do not determine them.

    They are the multipliers, reactions and torques of the joints and drives in source.indeterminate. If masses are
    missing, all forces, energies and powers become NaN.
    """
    s = compiled.source
    for field_values in (
        (evaluation.multipliers, evaluation.reactions, evaluation.torques, evaluation.energy, evaluation.power)
        if s.massless_bodies
        else ()
    ):
        field_values[:] = np.nan
    for owner in s.indeterminate:
        evaluation.multipliers[:, [k for k, row in enumerate(s.equations) if row.owner == owner]] = np.nan
        evaluation.reactions[:, [k for k, joint in enumerate(s.joints) if joint.name == owner]] = np.nan
        evaluation.torques[:, [k for k, drive in enumerate(s.drives) if drive.name == owner]] = np.nan


def _convert_matrix(values: ArrayLike, name: str, n_rows: int, n_columns: int | None) -> Array:
    """Return checked values (n_rows, n_columns) as C reads them; n_columns: None for any number. Raises ArrayError."""
    return as_c_array(values, name, (n_rows, n_columns))


def _check_matrix(values: ArrayLike, name: str, n_rows: int, n_columns: int | None) -> Array:
    """Return checked values (n_rows, n_columns); arrays of doubles of any layout are not copied.

    n_columns: None for any number. Raises ArrayError for another shape or other values.
    """
    if type(values) is not np.ndarray or values.dtype != np.float64:
        return as_c_array(values, name, (n_rows, n_columns))
    as_c_array(values[:0] if values.ndim else values, name, (0, n_columns))
    return values if len(values) == n_rows else as_c_array(values, name, (n_rows, n_columns))


def compute_sample_bytes(compiled: CompiledModel) -> int:
    """Return the bytes of a sample as methods store it: time, motion, works, discrete states and codes.

    Accelerations are stored for linkages without degrees of freedom only.
    """
    n_derivatives = 2 if compiled.source.degrees_of_freedom else 3
    n_doubles = 1 + n_derivatives * compiled.n + N_WORK + max(compiled.n_discrete_states, 1)
    return 8 * n_doubles + max(len(compiled.source.clearances), 1)


def check_sample_memory(
    compiled: CompiledModel,
    n_samples: float,
    n_runs: int = 1,
    stored_series: Collection[str] | None = None,
    field_names: Collection[str] = (),
    max_concurrent_runs: int = 1,
) -> None:
    """Raise MemoryError if the samples of `n_runs` runs do not fit into memory.

    n_samples: of each run; stored_series: names of series that are stored in place of the states, None for the states.
    The states then exist for `max_concurrent_runs` runs at a time, with the `field_names` that the series need. A
    single run below MIN_CHECKED_BYTES is not checked.
    """
    if n_runs == 1 and stored_series is None and n_samples * compiled.sample_bytes < MIN_CHECKED_BYTES:
        return
    if stored_series is None:
        n_bytes = float(n_samples) * compiled.sample_bytes * n_runs
    else:
        n_bytes = (
            float(n_samples)
            * (compiled.sample_bytes + compute_evaluation_bytes(compiled, field_names))
            * min(n_runs, max_concurrent_runs)
        )
        n_bytes += float(n_samples) * 8 * (len(stored_series) + 1) * n_runs
    n_bytes += n_runs * (BYTES_PER_RUN + 16 * compiled.n_p) if n_runs > 1 else 0
    text_of_samples = f"{n_runs} runs of {n_samples:.0f} samples each" if n_runs > 1 else f"{n_samples:.0f} samples"
    check_memory(n_bytes, text_of_samples)

"""Evaluate all quantities of a run's samples in C, and estimate the memory that samples take."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, fields
from time import perf_counter
from typing import TYPE_CHECKING, TypeAlias

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
from gudgeon.files.free_space import check_memory
from gudgeon.model.arrays import as_c_array

if TYPE_CHECKING:
    from gudgeon.model.compiled import CompiledModel

Array: TypeAlias = NDArray[np.float64]

CLEARANCE_COLUMNS = CLEARANCE_COLUMN_NAMES
MANY = 10_000  # samples from which on the memory is checked before an evaluation
FIRST, SOON = 256, 5e-3  # samples of the first call of C, and the time (s) of a call, so that Ctrl-C is handled soon
# quantities that one C function of the scene computes together
OUTPUTS = frozenset({"reactions", "torques", "series", "energy"})
OF_A_RUN = 1000  # bytes, about: lists and counts of a run


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
    drift: Array  # (N, 2) largest |Φ| (m, rad) and |Φ̇| (m/s, rad/s) of the rows


PARTS = frozenset(field.name for field in fields(Evaluation))  # names of the fields of an Evaluation


def evaluate(
    compiled: CompiledModel,
    t: ArrayLike,
    q: ArrayLike,
    v: ArrayLike,
    memory: ArrayLike,
    p: ArrayLike,
    take: Callable[[], object],
    parts: Collection[str],
) -> Evaluation:
    """Return the quantities at N samples of one run; arguments as in CompiledModel.evaluate."""
    time = as_c_array(t, "t", (None,))
    if compiled.beyond:  # velocities are those after a switching point; rounding hides the side of t
        time = np.asarray(time + around(time))
    N = len(time)
    latched = _check_table(memory, "memory", N, None)
    if compiled.n_memory or latched.shape[1] > 1:  # in a scene that remembers nothing one number stands for none
        _check_table(latched, "memory", N, compiled.n_memory)
    inputs = (
        ("q", _check_table(q, "q", N, compiled.n)),
        ("v", _check_table(v, "v", N, compiled.n)),
        ("memory", latched),
    )
    out = _allocate(compiled, N, parts)
    failed, first, chunk, none = compiled.ffi.new("long *"), 0, FIRST, compiled.ffi.NULL
    results, numbers = tuple(vars(out).values()), compiled.pointer(as_c_array(p, "p", (compiled.n_p,)))  # in C's order
    while first < N:
        before, count = perf_counter(), min(chunk, N - first)
        rows = slice(first, first + count)
        given = [compiled.pointer(as_c_array(values[rows], name, (count, None))) for name, values in inputs]
        filled = [compiled.pointer(x[first:], written=True) if len(x) else none for x in results]
        status = compiled.lib.gudgeon_evaluate(count, compiled.pointer(time[rows]), *given, numbers, *filled, failed)
        if status:
            compiled.check_pivot(status, float(time[first + failed[0]]), p=p)
        first += count
        chunk = 4 * count if perf_counter() - before < SOON else max(1, count // 4)
        take()
    _mark_indeterminate(compiled, out)
    return out


def evaluate_runs(
    compiled: CompiledModel,
    counts: Sequence[int],
    t: Array,
    q: Array,
    v: Array,
    memory: Array,
    p: Array,
    parts: Collection[str],
) -> Evaluation:
    """Return the quantities at few samples of several runs: counts[i] samples of run i with values p[i].

    The samples of the runs follow each other.
    """
    N, time = sum(counts), t + around(t) if compiled.beyond else t
    shapes = (("t", time, (N,)), ("q", q, (N, compiled.n)), ("v", v, (N, compiled.n)))
    given = [compiled.pointer(as_c_array(values, name, shape)) for name, values, shape in shapes]
    given.append(compiled.pointer(as_c_array(memory, "memory", (N, compiled.n_memory))))
    numbers = compiled.pointer(as_c_array(p, "p", (len(counts), compiled.n_p)))
    out, failed = _allocate(compiled, N, parts), compiled.ffi.new("long *")
    filled = [compiled.pointer(x, written=True) if len(x) else compiled.ffi.NULL for x in vars(out).values()]
    of_each = compiled.ffi.new("long[]", counts)
    status = compiled.lib.gudgeon_evaluate_runs(len(counts), of_each, *given, numbers, compiled.n_p, *filled, failed)
    compiled.check_pivot(status, math.nan)
    _mark_indeterminate(compiled, out)
    return out


def around(t: Array) -> Array:
    """Return the distance (s) from times t within which rounding may hide on which side of a switching point t is."""
    return np.asarray(np.maximum(32.0 * np.finfo(float).eps * np.abs(t), 1e-100))


def evaluated_bytes(compiled: CompiledModel, parts: Collection[str] | None = None) -> int:
    """Return the bytes of an evaluation per sample; `parts` None: of all fields."""
    return 8 * sum(math.prod(none.shape[1:]) for name, none in compiled.none if parts is None or name in parts)


def _allocate(compiled: CompiledModel, N: int, parts: Collection[str]) -> Evaluation:
    """Return an Evaluation for C to fill, NaN until then; fields that are not requested have no rows."""
    expected = {*parts, *OUTPUTS} if not OUTPUTS.isdisjoint(parts) else parts
    if N > MANY:
        check_memory(float(N) * evaluated_bytes(compiled, expected), f"what follows from {N} samples")
    rows = [(N if name in expected else 0, *none.shape[1:]) for name, none in compiled.none]
    return Evaluation(*(np.full(shape, np.nan) for shape in rows))


def nothing(compiled: CompiledModel) -> tuple[tuple[str, Array], ...]:
    """Return the names of all fields of an Evaluation, with empty arrays of their shapes."""
    s = compiled.source
    widths: dict[str, tuple[int, ...]] = {
        "a": (compiled.n,),
        "multipliers": (len(s.rows),),
        "reactions": (len(s.joints) + len(s.guides), N_REACTION_COLUMNS),
        "torques": (len(s.drives),),
        "clearance": (len(s.clearances), N_CLEARANCE_COLUMNS),
        "series": (len(s.series),),
        "friction": (len(s.frictions), N_FRICTION_COLUMNS),
        "energy": (N_ENERGY,),
        "power": (N_WORK,),
        "drift": (N_DRIFT,),
    }
    return tuple((name, np.empty((0, *widths[name]))) for name in (field.name for field in fields(Evaluation)))


def _mark_indeterminate(compiled: CompiledModel, out: Evaluation) -> None:
    """Set forces to NaN that redundant constraints leave undetermined, or all if masses are missing."""
    s = compiled.source
    for unknown in (out.multipliers, out.reactions, out.torques, out.energy, out.power) if s.massless else ():
        unknown[:] = np.nan
    for owner in s.indeterminate:
        out.multipliers[:, [k for k, row in enumerate(s.rows) if row.owner == owner]] = np.nan
        out.reactions[:, [k for k, joint in enumerate(s.joints) if joint.name == owner]] = np.nan
        out.torques[:, [k for k, drive in enumerate(s.drives) if drive.name == owner]] = np.nan


def _check_table(values: ArrayLike, name: str, rows: int, columns: int | None) -> Array:
    """Return checked values (rows, columns); arrays of doubles of any layout are not copied."""
    if type(values) is not np.ndarray or values.dtype != np.float64:
        return as_c_array(values, name, (rows, columns))
    as_c_array(values[:0] if values.ndim else values, name, (0, columns))
    return values if len(values) == rows else as_c_array(values, name, (rows, columns))


def sample_bytes(compiled: CompiledModel) -> int:
    """Return the bytes of a sample as methods store it: time, motion, works, discrete states and codes."""
    orders = 2 if compiled.source.degrees_of_freedom else 3
    numbers = 1 + orders * compiled.n + N_WORK + max(compiled.n_memory, 1)
    return 8 * numbers + max(len(compiled.source.clearances), 1)


def check_room(
    compiled: CompiledModel,
    samples: float,
    runs: int = 1,
    kept: Collection[str] | None = None,
    parts: Collection[str] = (),
    at_once: int = 1,
) -> None:
    """Raise MemoryError if the samples of so many runs do not fit into memory.

    kept: names of series that are stored in place of the states. The states then exist for `at_once` runs at a time,
    with the `parts` that the series need.
    """
    if kept is None:
        size = float(samples) * sample_bytes(compiled) * runs
    else:
        size = float(samples) * (sample_bytes(compiled) + evaluated_bytes(compiled, parts)) * min(runs, at_once)
        size += float(samples) * 8 * (len(kept) + 1) * runs
    size += runs * (OF_A_RUN + 16 * compiled.n_p) if runs > 1 else 0
    several = f"{runs} runs of {samples:.0f} samples each" if runs > 1 else f"{samples:.0f} samples"
    check_memory(size, several)

"""Allocate the arrays of a batch that have a row for each run, and set the pointers to them in C's struct Batch.

The arrays of a single run, its samples and the struct are one block of memory, of which views are made at their first
use. They are small, and most of the time of a short run would be that of their allocation.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import N_CHECKS, N_COUNTS, N_PEAK, N_RESIDUALS, N_STEP_ENDS, N_WORK
from gudgeon.model.arrays import FLAG, POINTER_TYPES, find_memory_address, make_pointer

STRUCT_BYTES = 512  # reserved for the struct
Field = tuple[Any, tuple[int, ...], float]  # type, shape and initial value of an array


class RunSizes(NamedTuple):
    """Hold the sizes on which the arrays of a run depend."""

    n_coordinates: int
    n_discrete_states: int
    n_clearances: int
    n_p: int
    n_integrated: int  # 0 for a time loop in Python
    n_samples: int


def make_run_arrays(n: int, sizes: RunSizes) -> dict[str, NDArray[Any]]:
    """Return new arrays by name with a row for each of n > 1 runs, with the values of runs that have not begun."""
    return {
        name: np.full(shape, value, kind) if value else np.zeros(shape, kind)
        for name, (kind, shape, value) in _list_run_fields(n, sizes).items()
    }


def set_pointers(ffi: Any, struct: Any, arrays: dict[str, NDArray[Any]]) -> None:
    """Set the members of C's struct Batch to the addresses of the arrays with their names; callers own the arrays."""
    words = np.frombuffer(ffi.buffer(struct), np.uintp)
    positions = _list_pointer_positions(ffi, tuple((name, x.dtype.char) for name, x in arrays.items()))
    words[positions] = [find_memory_address(ffi, array, POINTER_TYPES[array.dtype.char]) for array in arrays.values()]


class SingleRunArrays(dict[str, NDArray[Any]]):
    """Own the arrays of one run by name, among them its samples, which have no values yet.

    A view of the block is made when an array is read for the first time.
    """

    def __init__(self, layout: RunLayout, block: NDArray[np.uint8]) -> None:
        self._layout, self._block = layout, block

    @staticmethod
    def allocate(sizes: RunSizes) -> SingleRunArrays:
        """Allocate and return the arrays of a run that has not begun; samples are not initialized."""
        layout = _compute_run_layout(sizes)
        arrays = SingleRunArrays(layout, np.empty(layout.n_bytes, FLAG))
        arrays.reset_head(layout.head)
        return arrays

    def copy_block(self) -> SingleRunArrays:
        """Return a copy of the arrays, in a block of its own."""
        return SingleRunArrays(self._layout, self._block.copy())

    def copy_head(self) -> NDArray[np.uint8]:
        """Return a copy of the head of the block, which holds the struct and all arrays but samples."""
        return self._block[: len(self._layout.head)].copy()

    def reset_head(self, head: NDArray[np.uint8]) -> None:
        """Set the head of the block to a copy from `copy_head`, and all contact codes to 0."""
        self._block[: self._layout.n_reset] = 0
        self._block[: len(head)] = head

    def __missing__(self, name: str) -> NDArray[Any]:
        """Create, store and return the view of the array `name`; Python calls it at the first access.

        Raises KeyError for another name.
        """
        offset, kind, shape = self._layout.fields[name]
        self[name] = view = np.ndarray(shape, kind, self._block, offset)
        return view

    def find_pointers(self, ffi: Any, names: Iterable[str]) -> list[Any]:
        """Return C pointers to the arrays `names` of doubles, which are valid as long as this object exists."""
        first, fields = ffi.cast("double *", make_pointer(ffi, self._block, "void *")), self._layout.fields
        return [first + fields[name][0] // 8 for name in names]

    def __reduce__(self) -> Any:
        """Return the arrays as a dictionary, for pickling."""
        return dict, ({name: self[name] for name in self._layout.fields} | self,)

    def make_struct(self, ffi: Any) -> Any:
        """Write the pointers to all arrays into the first STRUCT_BYTES of the block; return them as C's struct Batch.

        Nothing is allocated: keep this object as long as the struct is used.
        """
        names, offsets = self._layout.pointers
        memory = make_pointer(ffi, self._block, "unsigned char *", True)
        words = self._block[:STRUCT_BYTES].view(np.uintp)
        words[_list_pointer_positions(ffi, names)] = int(ffi.cast("uintptr_t", memory)) + offsets
        return ffi.cast("Batch *", memory)


class RunLayout(NamedTuple):
    """Hold the offsets of the arrays of a run in its block, and the initial values of the head of the block."""

    fields: dict[str, tuple[int, np.dtype[Any], tuple[int, ...]]]  # offset (bytes), type and shape by name
    pointers: tuple[tuple[tuple[str, str], ...], NDArray[np.uintp]]  # name and type, and offset, of each array
    head: NDArray[np.uint8]  # the struct, empty, and all arrays but samples
    n_reset: int  # bytes of the head and of the contact codes
    n_bytes: int


def _list_run_fields(n: int, sizes: RunSizes) -> dict[str, Field]:
    """Return type, shape and initial value of each array of n runs, by name: start, progress, results and audit of a
    run.

    Names are those of C's struct Batch (engine/scene/calls.h describes them). `remembered` and `codes` are the discrete
    states and contact codes at the start.
    """
    n_coordinates, n_discrete_states, n_clearances = (
        sizes.n_coordinates,
        max(sizes.n_discrete_states, 1),
        max(sizes.n_clearances, 1),
    )
    return {
        "start": (np.float64, (n, 2 * n_coordinates), np.nan),
        "started": (np.uint8, (n,), 0),
        "phase": (np.uint8, (n,), 0),
        "initial_discrete_states": (np.float64, (n, n_discrete_states), np.nan),
        "codes": (np.int8, (n, n_clearances), 0),
        "done": (np.int_, (n,), 0),
        "checked": (np.int_, (n,), 0),
        "status": (np.intc, (n,), 0),
        "t_last": (np.float64, (n,), np.nan),
        "last": (np.float64, (n, 2 * n_coordinates + N_WORK), np.nan),
        "seconds": (np.float64, (n,), 0),
        "counts": (np.int_, (n, N_COUNTS), 0),
        "residuals": (np.float64, (n, N_RESIDUALS), np.nan),
        "peaks": (np.float64, (n, n_clearances, N_PEAK), np.nan),
        "audit_values": (np.float64, (n, N_CHECKS), -1),
        "audit_times": (np.float64, (n, N_CHECKS), 0),
        "audit_locations": (np.intc, (n, N_CHECKS), -1),
        "time_gain": (np.float64, (n,), 0),
        "monitored_steps": (np.int_, (n, 2), 0),
        "ended": (np.int_, (n, N_STEP_ENDS), 0),
        "sample_block": (np.int_, (n,), 0),
        "n_envelope_rows": (np.int_, (n,), 0),
        "ending": (np.intc, (1,), 0),
    }


def _list_single_run_fields(sizes: RunSizes) -> tuple[dict[str, Field], dict[str, Field]]:
    """Return type, shape and initial value of the other arrays of a single run, by name: inputs, then samples.

    Samples begin with the contact codes, which are zero. Names are those of C's struct Batch; `discrete_states` has
    those of each sample, `min_size` L and L/S of `adaptive.compute_tolerances`.
    """
    N = sizes.n_samples
    inputs: dict[str, Field] = {
        "p": (np.float64, (1, sizes.n_p), 0),
        "p_motion": (np.float64, (1, sizes.n_p), 0),
        "step": (np.float64, (1,), 0),
        "scale": (np.float64, (1, max(2 * sizes.n_integrated, 1)), 0),
        "min_size": (np.float64, (1, 2), 0),
        "size": (np.float64, (1,), 0),
        "n_requested": (np.int_, (1,), N),
    }
    return inputs, {
        "state": (np.int8, (1, N, max(sizes.n_clearances, 1)), 0),
        "t": (np.float64, (N,), 0),
        "y": (np.float64, (1, N, 2 * sizes.n_coordinates + N_WORK), 0),
        "discrete_states": (np.float64, (1, N, max(sizes.n_discrete_states, 1)), 0),
    }


@lru_cache(maxsize=64)
def _compute_run_layout(sizes: RunSizes) -> RunLayout:
    """Return the memory layout of the block of one run, cached by sizes; each array begins at a multiple of 8 bytes.

    The block has C's struct Batch (STRUCT_BYTES), the arrays of the run, its inputs, then its samples. The layout
    contains the initial bytes of all arrays before the samples.
    """
    inputs, samples = _list_single_run_fields(sizes)
    values = _list_run_fields(1, sizes) | inputs
    fields, offset = dict[str, tuple[int, np.dtype[Any], tuple[int, ...]]](), STRUCT_BYTES
    for name, (kind, shape, _) in (values | samples).items():
        fields[name] = offset, np.dtype(kind), shape
        offset += -(-math.prod(shape) * np.dtype(kind).itemsize // 8) * 8
    head = np.zeros(fields["state"][0], FLAG)
    for name, (_, _, value) in values.items():
        begin, kind, shape = fields[name]
        np.ndarray(shape, kind, head, begin)[...] = value
    types = tuple((name, kind.char) for name, (_, kind, _) in fields.items())
    offsets = np.array([begin for begin, *_ in fields.values()], np.uintp)
    return RunLayout(fields, (types, offsets), head, fields["t"][0], offset)


@lru_cache(maxsize=64)
def _list_pointer_positions(ffi: Any, types: tuple[tuple[str, str], ...]) -> NDArray[np.intp]:
    """Return the positions, in words of 8 bytes, of the pointers to these arrays in C's struct Batch; cached.

    `types`: pairs of name and type character of NumPy. Raises AssertionError if the struct declares another type.
    """
    members = dict(ffi.typeof("Batch").fields)
    for name, kind in types:
        declared = members[name].type.cname.replace("const ", "").replace("volatile ", "")
        assert declared == POINTER_TYPES[kind] and ffi.sizeof("Batch") <= STRUCT_BYTES, (
            f"{name}: {declared} in C, {POINTER_TYPES[kind]} in Python"
        )
    return np.array([members[name].offset // 8 for name, _ in types], np.intp)

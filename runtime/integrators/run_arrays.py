"""Allocate the arrays of a batch that have a row for each run, and set the pointers to them in C's struct Batch.

The arrays of a single run are views of one block of memory, which is copied from a template: they are small, and most
of the time of a short run would be that of their allocation.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gudgeon.contract.boundary import N_CHECKS, N_COUNTS, N_PEAK, N_RESIDUALS, N_STEP_ENDS, N_WORK
from gudgeon.model.arrays import find_memory_address

C_TYPES = {"B": "unsigned char *", "b": "signed char *", "i": "int *", "l": "long *", "d": "double *"}


class RunArrays:
    """Own the arrays of n runs by name, with the values of runs that have not begun."""

    def __init__(self, n: int, n_coordinates: int, n_memory: int, n_clearances: int) -> None:
        self._block: NDArray[Any] | None = None
        self.arrays: dict[str, NDArray[Any]]
        if n == 1:
            self._block = block = _build_template(n_coordinates, n_memory, n_clearances).copy()
            self.arrays = {name: block[name] for name in block.dtype.names or ()}
        else:
            fields = _list_fields(n, n_coordinates, n_memory, n_clearances)
            self.arrays = {
                name: np.full(shape, value, kind) if value else np.zeros(shape, kind)
                for name, (kind, shape, value) in fields.items()
            }

    def set_pointers(self, ffi: Any, struct: Any) -> None:
        """Set the pointers of C's `struct` to the arrays, by their names; the caller keeps the arrays alive."""
        words = np.frombuffer(ffi.buffer(struct), np.uintp)
        positions = _list_pointer_positions(ffi, tuple((name, x.dtype.char) for name, x in self.arrays.items()))
        if self._block is not None:
            address = find_memory_address(ffi, self._block.reshape(1).view(np.uint8))
            words[positions] = address + _list_offsets(self._block.dtype)
        else:
            words[positions] = [
                find_memory_address(ffi, array, C_TYPES[array.dtype.char]) for array in self.arrays.values()
            ]


def _list_fields(
    n: int, n_coordinates: int, n_memory: int, n_clearances: int
) -> dict[str, tuple[Any, tuple[int, ...], float]]:
    """Return type, shape and initial value of each array of n runs, by name."""
    return {
        "start": (np.float64, (n, 2 * n_coordinates), np.nan),
        "started": (np.uint8, (n,), 0),
        "phase": (np.uint8, (n,), 0),
        "remembered": (np.float64, (n, max(n_memory, 1)), np.nan),
        "codes": (np.int8, (n, max(n_clearances, 1)), 0),
        "done": (np.int_, (n,), 0),
        "checked": (np.int_, (n,), 0),
        "status": (np.intc, (n,), 0),
        "t_last": (np.float64, (n,), np.nan),
        "last": (np.float64, (n, 2 * n_coordinates + N_WORK), np.nan),
        "seconds": (np.float64, (n,), 0),
        "counts": (np.int_, (n, N_COUNTS), 0),
        "residuals": (np.float64, (n, N_RESIDUALS), np.nan),
        "peaks": (np.float64, (n, max(n_clearances, 1), N_PEAK), np.nan),
        "audited": (np.float64, (n, N_CHECKS), -1),
        "audited_t": (np.float64, (n, N_CHECKS), 0),
        "audited_where": (np.intc, (n, N_CHECKS), -1),
        "gained": (np.float64, (n,), 0),
        "paced": (np.int_, (n, 2), 0),
        "ended": (np.int_, (n, N_STEP_ENDS), 0),
        "sample_block": (np.int_, (n,), 0),
        "traced": (np.int_, (n,), 0),
        "ending": (np.intc, (1,), 0),
    }


@lru_cache(maxsize=64)
def _build_template(n_coordinates: int, n_memory: int, n_clearances: int) -> NDArray[Any]:
    """Return a block () of a structured type, whose fields are the arrays of one run before it begins; not to be
    changed.
    """
    fields = _list_fields(1, n_coordinates, n_memory, n_clearances)
    types = [np.dtype((kind, shape)) for kind, shape, _ in fields.values()]
    ends = np.cumsum([-(-each.itemsize // 8) * 8 for each in types]).tolist()  # each begins at a multiple of 8 bytes
    layout = {"names": list(fields), "formats": types, "offsets": [0, *ends[:-1]], "itemsize": ends[-1]}
    template: NDArray[Any] = np.zeros((), np.dtype(layout))  # type: ignore[call-overload]
    for name, (_, _, value) in fields.items():
        template[name][...] = value
    return template


@lru_cache(maxsize=64)
def _list_pointer_positions(ffi: Any, types: tuple[tuple[str, str], ...]) -> NDArray[np.intp]:
    """Return the positions (words) in the struct Batch of the pointers to arrays with these names and types.

    Raises AssertionError if the struct declares a pointer of another type.
    """
    members = dict(ffi.typeof("Batch").fields)
    for name, kind in types:
        declared = members[name].type.cname.replace("const ", "").replace("volatile ", "")
        assert declared == C_TYPES[kind], f"{name}: {declared} in C, {C_TYPES[kind]} in Python"
    return np.array([members[name].offset // 8 for name, _ in types], np.intp)


@lru_cache(maxsize=64)
def _list_offsets(layout: np.dtype[Any]) -> NDArray[np.uintp]:
    """Return the offsets (bytes) of all fields of a structured type."""
    return np.array([offset for _, offset, *_ in (layout.fields or {}).values()], np.uintp)

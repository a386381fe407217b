"""Convert arrays to the form that C reads, and pass their memory to C; all arrays enter C through this module.

`as_c_array` converts a list, a table column or any NumPy array to an aligned, C-contiguous array of native byte order,
of the required shape and type. No number changes. `pointer` gives C the memory of such an array and of no other.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from numbers import Real
from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.errors import ArrayError

# types of numbers, contact codes and flags in C
FLOAT, CODE, FLAG = np.dtype(np.float64), np.dtype(np.int8), np.dtype(np.uint8)
# C's type -> what cffi calls an array of it, what NumPy does; memory of a struct is bytes
_KINDS = {
    "double *": ("double[]", FLOAT),
    "int *": ("int[]", np.dtype("i")),
    "long *": ("long[]", np.dtype("l")),
    "signed char *": ("signed char[]", CODE),
    "unsigned char *": ("unsigned char[]", FLAG),
    "void *": ("unsigned char[]", FLAG),
}
Shape = tuple[int | None, ...]  # required lengths; None for any length
MOST = 2**32  # largest number of entries that are copied


def pointer(ffi: Any, array: NDArray[Any], kind: str = "double *", written: bool = False) -> Any:
    """Return a C pointer to an array's memory, which keeps the array alive; `written`: C writes there.

    Raises ArrayError for an array that C would read wrongly: of another type or byte order, not contiguous, not
    aligned, or read-only where C writes.
    """
    name, dtype = _KINDS[kind]
    if array.dtype is dtype or array.dtype == dtype:
        if not array.flags.aligned:
            raise ArrayError(f"an array at an odd address for {kind}")
        try:
            return ffi.from_buffer(name, array, written)
        except (BufferError, ValueError) as error:
            laid = f"of shape {array.shape} and strides {array.strides}"
            raise ArrayError(f"an array {laid} for {kind}: {error}") from None
    raise ArrayError(f"an array of {array.dtype} for {kind}")


def as_c_array(
    values: ArrayLike,
    name: str,
    shape: Shape | None = None,
    *,
    dtype: np.dtype[Any] = FLOAT,
    finite: bool = False,
    own: bool = False,
    most: int = MOST,
) -> NDArray[Any]:
    """Return `values` as C reads them: aligned, C-contiguous, native byte order, `dtype`; unchanged if they are so.

    shape: required lengths, None for any. most: largest number of entries. finite: refuse NaN and infinities. own:
    always copy, so that later changes of `values` have no effect. Raises ArrayError, which names the array and the
    entry, for masked entries, text, booleans in place of numbers, complex numbers, other objects, or another shape.
    """
    if type(values) is np.ndarray and values.dtype is dtype and not own and values.flags.carray:
        array: NDArray[Any] = values
    elif type(values) is np.ndarray and values.dtype is dtype and values.size <= most and not values.flags.c_contiguous:
        array = np.array(values, order="C")  # rows or columns of another one
    else:
        array = _convert(values, name, shape, dtype, own, most)
    if shape is not None and array.shape != shape and not _fits(array.shape, shape):
        _check_shape(array, name, shape)
    if finite and not np.isfinite(array).all():
        at = tuple(np.argwhere(~np.isfinite(array))[0].tolist())
        raise ArrayError(f"{name}{_index_text(at)} is {array[at]}: expected finite numbers")
    return array


def address(ffi: Any, array: NDArray[Any], kind: str = "void *") -> int:
    """Return the memory address of an array for a library of another cffi; the caller keeps the array alive."""
    return int(ffi.cast("uintptr_t", pointer(ffi, array, kind, True)))


def _fits(have: tuple[int, ...], shape: Shape) -> bool:
    """Return whether an array's shape agrees with a required shape."""
    for expected, own in zip(shape, have, strict=False):
        if expected is not None and expected != own:
            return False
    return len(have) == len(shape)


def _check_shape(array: NDArray[Any], name: str, shape: Shape) -> None:
    """Raise ArrayError if an array's shape differs from the required one."""
    if not _fits(array.shape, shape):
        message = ", ".join("N" if size is None else str(size) for size in shape)
        raise ArrayError(f"{name} has shape {array.shape}, expected ({message}{',' * (len(shape) == 1)})")


def _convert(
    values: ArrayLike, name: str, shape: Shape | None, dtype: np.dtype[Any], own: bool, most: int
) -> NDArray[Any]:
    """Return values converted to a C-contiguous array of `dtype`; see `as_c_array` for the arguments."""
    _refuse_masked(values, name)
    try:
        given: NDArray[Any] = np.asarray(values)
    except (TypeError, ValueError, OverflowError, MemoryError) as error:
        raise ArrayError(f"{name}: no array of numbers: {error}") from None
    if given.size > most:  # before anything of its size is made: a view may stand for any number of entries
        raise ArrayError(f"{name} has {given.size} entries: expected {most} at most")
    if given.dtype.kind == "O":
        given = _floats_of_objects(given, name)
    if given.dtype.kind not in "biuf":
        kind = {"U": "text", "S": "bytes"}.get(given.dtype.kind, given.dtype.name)
        _raise_not_real(name, f"holds {kind if given.ndim else repr(values)[:60]}")
    if given.dtype.kind == "b" and dtype.kind == "f":
        _raise_not_real(name, "holds truths" if given.ndim else f"is {given}")
    if shape is not None:
        _check_shape(given, name, shape)
    array: NDArray[Any] = np.array(given, dtype, order="C") if own else np.asarray(given, dtype, order="C")
    if dtype.kind != "f" and not (array == given).all():
        at = tuple(np.argwhere(array != given)[0].tolist())
        raise ArrayError(f"{name}{_index_text(at)} is {given[at]}: expected whole numbers that fit {dtype.name}")
    return array if array.flags.carray or (array.flags.c_contiguous and array.flags.aligned) else array.copy(order="C")


def _floats_of_objects(given: NDArray[Any], name: str) -> NDArray[Any]:
    """Return numbers that NumPy stores as objects (large integers, fractions) as floats."""
    for at, value in np.ndenumerate(given):
        if not isinstance(value, Real) or isinstance(value, bool):
            _raise_not_real(f"{name}{_index_text(at)}", f"is {type(value).__name__} {str(value)[:40]!r}")
    try:
        return given.astype(np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise ArrayError(f"{name}: {error}") from None


def _refuse_masked(values: Any, name: str) -> None:
    """Raise ArrayError if an entry is masked; a mask that hides nothing is accepted."""
    ma = sys.modules.get("numpy.ma")  # NumPy imports it on request: before, no masks exist
    if getattr(ma, "extras", None) is None:  # or another thread is still at it
        return
    assert ma is not None
    if isinstance(values, ma.MaskedArray):
        hidden = np.argwhere(ma.getmaskarray(values) if values.dtype.names is None else _any_field_masked(ma, values))
    elif isinstance(values, Sequence) and not isinstance(values, str):
        hidden = np.array([[k] for k, value in enumerate(values) if value is ma.masked])
    else:
        return
    if len(hidden):
        message = f"{name}{_index_text(tuple(hidden[0].tolist()))} is masked: it has no value"
        raise ArrayError(message, hint="leave masked entries out, or fill them: .compressed(), .filled(…)")


def _any_field_masked(ma: Any, values: Any) -> NDArray[np.bool_]:
    """Return a mask of the rows of a structured array with a masked field."""
    mask = ma.getmaskarray(values)
    return np.logical_or.reduce([mask[field] for field in mask.dtype.names])


def _raise_not_real(name: str, message: str) -> NoReturn:
    """Raise ArrayError: expected real numbers."""
    raise ArrayError(
        f"{name} {message}: expected real numbers", hint="an array, a list or a column of floats or integers"
    )


def _index_text(at: tuple[int, ...]) -> str:
    """Return an index as text: "[2, 3]"."""
    return f"[{', '.join(map(str, at))}]" if at else ""

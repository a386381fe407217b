"""The one door of arrays into C: what a caller hands in becomes what C reads, or is refused by its name.

`taken` makes of a list, a column of a table or any NumPy array one that is aligned, C-contiguous, of native byte order
and of the shape and kind that C reads, without a change of any number. `pointer` gives C the memory of such an array
and of no other. Nothing else in gudgeon asks an array where it lies.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from numbers import Real
from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.errors import ArrayError

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
Shape = tuple[int | None, ...]
MOST = 2**32  # entries that are copied


def pointer(ffi: Any, array: NDArray[Any], kind: str = "double *", written: bool = False) -> Any:
    """C's view of an array's memory, which it keeps alive; `written`: C writes there.

    Raises ArrayError for an array that C would read otherwise than NumPy does: of another type or byte order, not
    contiguous, not aligned, or read-only where C writes.
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


def taken(
    values: ArrayLike,
    name: str,
    shape: Shape | None = None,
    *,
    dtype: np.dtype[Any] = FLOAT,
    finite: bool = False,
    own: bool = False,
    most: int = MOST,
) -> NDArray[Any]:
    """`values` as C reads them: aligned, C-contiguous, native byte order, of `dtype`; the array itself if it is so.

    shape: what it must be, None for any length. most: entries that are copied. finite: NaN and infinities are refused.
    own: always a copy, which no later change of `values` reaches. Numbers stay what they are; an array of masked
    entries, of text, of truths for numbers, of complex numbers, of other objects, of another shape raises ArrayError,
    which names it and the entry.
    """
    if type(values) is np.ndarray and values.dtype is dtype and not own and values.flags.carray:
        array: NDArray[Any] = values
    elif type(values) is np.ndarray and values.dtype is dtype and values.size <= most and not values.flags.c_contiguous:
        array = np.array(values, order="C")  # rows or columns of another one
    else:
        array = _converted(values, name, shape, dtype, own, most)
    if shape is not None and array.shape != shape and not _fits(array.shape, shape):
        _check_shape(array, name, shape)
    if finite and not np.isfinite(array).all():
        at = tuple(np.argwhere(~np.isfinite(array))[0].tolist())
        raise ArrayError(f"{name}{_place(at)} is {array[at]}: expected finite numbers")
    return array


def address(ffi: Any, array: NDArray[Any], kind: str = "void *") -> int:
    """Where an array's memory begins, for the library of another cffi; the caller keeps the array alive."""
    return int(ffi.cast("uintptr_t", pointer(ffi, array, kind, True)))


def _fits(have: tuple[int, ...], shape: Shape) -> bool:
    for wanted, own in zip(shape, have, strict=False):
        if wanted is not None and wanted != own:
            return False
    return len(have) == len(shape)


def _check_shape(array: NDArray[Any], name: str, shape: Shape) -> None:
    if not _fits(array.shape, shape):
        told = ", ".join("N" if size is None else str(size) for size in shape)
        raise ArrayError(f"{name} has shape {array.shape}, expected ({told}{',' * (len(shape) == 1)})")


def _converted(
    values: ArrayLike, name: str, shape: Shape | None, dtype: np.dtype[Any], own: bool, most: int
) -> NDArray[Any]:
    _refuse_masked(values, name)
    try:
        given: NDArray[Any] = np.asarray(values)
    except (TypeError, ValueError, OverflowError, MemoryError) as error:
        raise ArrayError(f"{name}: no array of numbers: {error}") from None
    if given.size > most:  # before anything of its size is made: a view may stand for any number of entries
        raise ArrayError(f"{name} has {given.size} entries: expected {most} at most")
    if given.dtype.kind == "O":
        given = _of_objects(given, name)
    if given.dtype.kind not in "biuf":
        kind = {"U": "text", "S": "bytes"}.get(given.dtype.kind, given.dtype.name)
        _refuse(name, f"holds {kind if given.ndim else repr(values)[:60]}")
    if given.dtype.kind == "b" and dtype.kind == "f":
        _refuse(name, "holds truths" if given.ndim else f"is {given}")
    if shape is not None:
        _check_shape(given, name, shape)
    array: NDArray[Any] = np.array(given, dtype, order="C") if own else np.asarray(given, dtype, order="C")
    if dtype.kind != "f" and not (array == given).all():
        at = tuple(np.argwhere(array != given)[0].tolist())
        raise ArrayError(f"{name}{_place(at)} is {given[at]}: expected whole numbers that fit {dtype.name}")
    return array if array.flags.carray or (array.flags.c_contiguous and array.flags.aligned) else array.copy(order="C")


def _of_objects(given: NDArray[Any], name: str) -> NDArray[Any]:
    """Numbers that NumPy keeps as objects (large integers, fractions), as floats."""
    for at, value in np.ndenumerate(given):
        if not isinstance(value, Real) or isinstance(value, bool):
            _refuse(f"{name}{_place(at)}", f"is {type(value).__name__} {str(value)[:40]!r}")
    try:
        return given.astype(np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise ArrayError(f"{name}: {error}") from None


def _refuse_masked(values: Any, name: str) -> None:
    """A masked entry has no value; a mask that hides nothing is fine."""
    ma = sys.modules.get("numpy.ma")  # NumPy imports it when somebody asks for it: nobody has a mask before
    if getattr(ma, "extras", None) is None:  # or another thread is still at it
        return
    assert ma is not None
    if isinstance(values, ma.MaskedArray):
        hidden = np.argwhere(ma.getmaskarray(values) if values.dtype.names is None else _any_field(ma, values))
    elif isinstance(values, Sequence) and not isinstance(values, str):
        hidden = np.array([[k] for k, value in enumerate(values) if value is ma.masked])
    else:
        return
    if len(hidden):
        message = f"{name}{_place(tuple(hidden[0].tolist()))} is masked: it has no value"
        raise ArrayError(message, hint="leave masked entries out, or fill them: .compressed(), .filled(…)")


def _any_field(ma: Any, values: Any) -> NDArray[np.bool_]:
    mask = ma.getmaskarray(values)
    return np.logical_or.reduce([mask[field] for field in mask.dtype.names])


def _refuse(name: str, told: str) -> NoReturn:
    raise ArrayError(f"{name} {told}: expected real numbers", hint="an array, a list or a column of floats or integers")


def _place(at: tuple[int, ...]) -> str:
    return f"[{', '.join(map(str, at))}]" if at else ""

"""Convert arrays to the form that C reads, and pass their memory to C; all arrays enter C through this module.

`as_c_array` converts a list, a table column or any NumPy array to an aligned, C-contiguous array of native byte order,
of the required shape and type. No number changes. `make_pointer` gives C the memory of such an array and of no other.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from numbers import Real
from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gudgeon.errors import ArrayError

# types of numbers, contact codes and flags in C
FLOAT, CODE, FLAG = np.dtype(np.float64), np.dtype(np.int8), np.dtype(np.uint8)
# by type of pointer in C: names of the array type in cffi and of its elements in NumPy; memory of a struct is bytes
_KINDS = {
    "double *": ("double[]", FLOAT),
    "int *": ("int[]", np.dtype("i")),
    "long *": ("long[]", np.dtype("l")),
    "signed char *": ("signed char[]", CODE),
    "unsigned char *": ("unsigned char[]", FLAG),
    "void *": ("unsigned char[]", FLAG),
}
POINTER_TYPES = {"B": "unsigned char *", "b": "signed char *", "i": "int *", "l": "long *", "d": "double *"}
Shape = tuple[int | None, ...]  # required lengths; None for any length
MAX_ENTRIES = 2**32  # largest number of entries that are copied


def make_pointer(ffi: Any, array: NDArray[Any], kind: str = "double *", is_written: bool = False) -> Any:
    """Return a C pointer to an array's memory, which keeps the array alive; `is_written`: C writes there.

    `kind` is the pointer's type in C, a key of _KINDS. Raises ArrayError for an array that C would read wrongly: of
    another type or byte order, not contiguous, not aligned, or read-only where C writes.
    """
    type_for_cffi, dtype = _KINDS[kind]
    if array.dtype is dtype or array.dtype == dtype:
        if not array.flags.aligned:
            raise ArrayError(f"an unaligned array for {kind}")
        try:
            return ffi.from_buffer(type_for_cffi, array, is_written)
        except (BufferError, ValueError) as error:
            layout = f"of shape {array.shape} and strides {array.strides}"
            raise ArrayError(f"an array {layout} for {kind}: {error}") from None
    raise ArrayError(f"an array of {array.dtype} for {kind}")


def set_struct_pointers(ffi: Any, struct: Any, arrays: Mapping[str, NDArray[Any]]) -> None:
    """Set the members of a struct of C to the addresses of the arrays with their names; callers own the arrays."""
    for name, array in arrays.items():
        setattr(struct, name, make_pointer(ffi, array, POINTER_TYPES[array.dtype.char]))


def as_c_array(
    values: ArrayLike,
    name: str,
    shape: Shape | None = None,
    *,
    dtype: np.dtype[Any] = FLOAT,
    require_finite: bool = False,
    always_copy: bool = False,
    max_entries: int = MAX_ENTRIES,
) -> NDArray[Any]:
    """Return `values` as C reads them: aligned, C-contiguous, native byte order, `dtype`; unchanged if they are so.

    shape: required lengths, None for any. require_finite: refuse NaN and infinities. always_copy: later changes of
    `values` have no effect. max_entries: largest number of entries. Raises ArrayError, which names the array and the
    entry, for masked entries, text, booleans in place of numbers, complex numbers, other objects, or another shape.
    """
    if type(values) is np.ndarray and values.dtype is dtype and not always_copy and values.flags.carray:
        array: NDArray[Any] = values
    elif (
        type(values) is np.ndarray
        and values.dtype is dtype
        and values.size <= max_entries
        and not values.flags.c_contiguous
    ):
        array = np.array(values, order="C")  # rows or columns of another array
    else:
        array = _convert_to_c_array(values, name, shape, dtype, always_copy, max_entries)
    if shape is not None and array.shape != shape and not _has_shape(array.shape, shape):
        _check_shape(array, name, shape)
    if require_finite and not np.isfinite(array).all():
        index = tuple(np.argwhere(~np.isfinite(array))[0].tolist())
        raise ArrayError(f"{name}{_format_index(index)} is {array[index]}: expected finite numbers")
    return array


def find_memory_address(ffi: Any, array: NDArray[Any], kind: str = "void *") -> int:
    """Return the memory address of an array as an integer, for a library of another cffi.

    The caller keeps the array alive, which must be writable. Raises ArrayError as `make_pointer`.
    """
    return int(ffi.cast("uintptr_t", make_pointer(ffi, array, kind, True)))


def make_column_pointer(ffi: Any, column: NDArray[np.float64]) -> Any:
    """Return a C pointer to the first of the doubles of a column (N,) with any stride; the caller keeps the array."""
    return ffi.cast("double *", column.ctypes.data)


def _has_shape(array_shape: tuple[int, ...], shape: Shape) -> bool:
    """Return whether an array's shape `array_shape` agrees with a required shape, whose None fits any length."""
    for required_length, length in zip(shape, array_shape, strict=False):
        if required_length is not None and required_length != length:
            return False
    return len(array_shape) == len(shape)


def _check_shape(array: NDArray[Any], name: str, shape: Shape) -> None:
    """Raise ArrayError if an array's shape differs from the required one; `name` is the array's name in the message."""
    if not _has_shape(array.shape, shape):
        lengths = ", ".join("N" if size is None else str(size) for size in shape)
        raise ArrayError(f"{name} has shape {array.shape}, expected ({lengths}{',' * (len(shape) == 1)})")


def _convert_to_c_array(
    values: ArrayLike, name: str, shape: Shape | None, dtype: np.dtype[Any], always_copy: bool, max_entries: int
) -> NDArray[Any]:
    """Return values converted to a C-contiguous array of `dtype`; see `as_c_array` for the arguments.

    Raises ArrayError for values that are not real numbers, that do not fit `dtype`, or for another shape. `shape` None:
    any shape.
    """
    _check_no_masked_entries(values, name)
    try:
        source: NDArray[Any] = np.asarray(values)
    except (TypeError, ValueError, OverflowError, MemoryError) as error:
        raise ArrayError(f"{name}: no array of numbers: {error}") from None
    if source.size > max_entries:  # before anything of this size is allocated: a view may have any number of entries
        raise ArrayError(f"{name} has {source.size} entries: expected {max_entries} at most")
    if source.dtype.kind == "O":
        source = _convert_objects_to_floats(source, name)
    if source.dtype.kind not in "biuf":
        kind = {"U": "text", "S": "bytes"}.get(source.dtype.kind, source.dtype.name)
        _raise_not_real_error(name, f"holds {kind if source.ndim else repr(values)[:60]}")
    if source.dtype.kind == "b" and dtype.kind == "f":
        _raise_not_real_error(name, "holds booleans" if source.ndim else f"is {source}")
    if shape is not None:
        _check_shape(source, name, shape)
    array: NDArray[Any] = np.array(source, dtype, order="C") if always_copy else np.asarray(source, dtype, order="C")
    if dtype.kind != "f" and not (array == source).all():
        index = tuple(np.argwhere(array != source)[0].tolist())
        raise ArrayError(
            f"{name}{_format_index(index)} is {source[index]}: expected whole numbers that fit {dtype.name}"
        )
    return array if array.flags.carray or (array.flags.c_contiguous and array.flags.aligned) else array.copy(order="C")


def _convert_objects_to_floats(objects: NDArray[Any], name: str) -> NDArray[Any]:
    """Return numbers that NumPy stores as objects (large integers, fractions) as floats.

    Raises ArrayError for other objects and for numbers that are too large.
    """
    for index, value in np.ndenumerate(objects):
        if not isinstance(value, Real) or isinstance(value, bool):
            _raise_not_real_error(f"{name}{_format_index(index)}", f"is {type(value).__name__} {str(value)[:40]!r}")
    try:
        return objects.astype(np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise ArrayError(f"{name}: {error}") from None


def _check_no_masked_entries(values: Any, name: str) -> None:
    """Raise ArrayError if an entry is masked; a mask that hides nothing is accepted.

    Masked arrays and sequences with `numpy.ma.masked` are recognised. Nothing is checked before numpy.ma is imported.
    """
    ma = sys.modules.get("numpy.ma")  # NumPy imports it on request: before, no masks exist
    if getattr(ma, "extras", None) is None:  # not imported, or another thread is importing it
        return
    assert ma is not None
    if isinstance(values, ma.MaskedArray):
        masked_indices = np.argwhere(
            ma.getmaskarray(values) if values.dtype.names is None else _find_masked_rows(ma, values)
        )
    elif isinstance(values, Sequence) and not isinstance(values, str):
        masked_indices = np.array([[k] for k, value in enumerate(values) if value is ma.masked])
    else:
        return
    if len(masked_indices):
        message = f"{name}{_format_index(tuple(masked_indices[0].tolist()))} is masked: it has no value"
        raise ArrayError(message, hint="leave masked entries out, or fill them: .compressed(), .filled(…)")


def _find_masked_rows(ma: Any, values: Any) -> NDArray[np.bool_]:
    """Return a mask of the rows of a structured array with a masked field; `ma` is the module numpy.ma."""
    mask = ma.getmaskarray(values)
    return np.logical_or.reduce([mask[field] for field in mask.dtype.names])


def _raise_not_real_error(name: str, message: str) -> NoReturn:
    """Raise ArrayError with the text "NAME MESSAGE: expected real numbers"."""
    raise ArrayError(
        f"{name} {message}: expected real numbers", hint="an array, a list or a column of floats or integers"
    )


def _format_index(index: tuple[int, ...]) -> str:
    """Return an index as text: "[2, 3]"; "" for the index of a number."""
    return f"[{', '.join(map(str, index))}]" if index else ""

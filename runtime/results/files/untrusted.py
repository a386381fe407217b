"""Read arrays and texts of NetCDF files from untrusted sources; a file that is not valid raises InputError.

The checksum, types, lengths and names are checked before data is read. Links to other files are not followed, and no
more is read than the size of the file allows. `check_typed` checks the types of objects from JSON.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from pathlib import Path
from types import NoneType, UnionType
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

import numpy as np

from gudgeon.errors import GudgeonError, InputError, in_a_line
from gudgeon.files.reading import check_regular
from gudgeon.language.argument_checks import path as named
from gudgeon.results.files.hdf5 import is_damaged
from gudgeon.results.state import Array

OLD_FORMAT = "gudgeon-result/1"  # impacts, events, parameters at the root, over other dimensions
DEFLATE = 1100  # no filter of HDF5's own makes data this many times smaller
LOADERS = {
    "gudgeon-result": ("a single run", "gudgeon.Result.load"),
    "gudgeon-batch": ("a batch of runs", "gudgeon.Batch.load"),
}
Made = TypeVar("Made")
AGAIN = "it is no result of gudgeon, or was damaged or cut short; run the scene again"


def open_result_file(path: str | os.PathLike[str], make: Callable[[Any, int], Made]) -> Made:
    """Return `make(file, size)` for an open HDF5 file and its size in bytes. Raises InputError for every fault of the
    file.
    """
    try:
        import h5py
    except ModuleNotFoundError as error:
        raise GudgeonError("NetCDF files need h5py: pip install 'gudgeon[xarray]'") from error
    path, shown = Path(named(path, "path")), in_a_line(os.fspath(path))
    try:
        found = path.stat()
    except OSError:  # a name that is too long, too
        raise InputError(f"there is no file {shown}") from None
    check_regular(found, shown)
    try:
        if is_damaged(path):
            raise InputError(f"{shown} is not as it was written: it was damaged", hint="run the scene again")
        with h5py.File(path, "r") as file:
            return make(file, found.st_size)
    except InputError:
        raise
    except Exception as error:  # whatever HDF5, JSON or NumPy make of what should not be
        message = str(error).partition("\n")[0][:200] or type(error).__name__
        raise InputError(f"{shown} cannot be read as a result: {message}", hint=AGAIN) from error


class File:
    """Arrays and texts of an open file by name ("S9.y", "impacts/t_on"). Raises ValueError for unexpected contents."""

    def __init__(self, file: Any, size: int, formats: tuple[str, ...]) -> None:
        """Check the format of an open HDF5 file of `size` bytes; formats[0] is the expected one."""
        self._file, self._left = file, float(size)
        found = self.text("gudgeon")
        kind = found.partition("/")[0]
        if kind in LOADERS and not formats[0].startswith(f"{kind}/"):
            what, loader = LOADERS[kind]
            raise InputError(f"{in_a_line(file.filename)} holds {what} ({found})", hint=f"read it with {loader}")
        if found not in formats:
            raise ValueError(f"expected the attribute gudgeon = {formats[0]!r}, found {found!r}")
        self.is_old = found == OLD_FORMAT

    def has(self, group: str) -> bool:
        """Return whether the file contains a group or dataset."""
        return group in self._file

    def names(self, group: str) -> list[str]:
        """Return the names of the entries of a group."""
        return list(self._group(group))

    def text(self, key: str, group: str = "") -> str:
        """Return a text attribute of the file or of a group."""
        found = (self._group(group) if group else self._file).attrs[key]
        if isinstance(found, bytes):
            found = found.decode()
        if not isinstance(found, str):
            raise ValueError(f"the attribute {key!r} is no text")
        return str(found)

    def numbers(self, name: str, length: int | None = None, dtype: str = "f8") -> Array:
        """Return an array of the given type and length; of any length for None."""
        item = self._dataset(name, length)
        if item.dtype.newbyteorder("=") != np.dtype(dtype):
            raise ValueError(f"{name} has numbers of type {item.dtype}, expected {dtype}")
        values: Array = item[...].astype(dtype, copy=False)
        return values

    def either(self, name: str, length: int) -> Array:
        """Return an array of integers or floats, as stored."""
        return self.numbers(name, length, "i8" if self._dataset(name, length).dtype.kind == "i" else "f8")

    def texts(self, name: str, length: int | None = None) -> list[str]:
        """Return an array of texts of the given length as a list; of any length for None."""
        import h5py

        item = self._dataset(name, length)
        if h5py.check_string_dtype(item.dtype) is None:
            raise ValueError(f"{name} has numbers, expected texts")
        return [str(text) for text in item.asstr()[...]]

    def _dataset(self, name: str, length: int | None) -> Any:
        """Return a one-dimensional dataset with its data in this file and no larger than the file allows."""
        import h5py
        from h5py import h5d

        group, _, last = name.rpartition("/")
        item = _hard_linked(self._group(group) if group else self._file, last)
        if not isinstance(item, h5py.Dataset) or len(item.shape or ()) != 1:
            raise ValueError(f"{name} is no variable over one dimension")
        if length is not None and item.shape[0] != length:
            raise ValueError(f"{name} has {item.shape[0]} values, expected {length}")
        settings, size = item.id.get_create_plist(), item.shape[0] * item.dtype.itemsize
        if settings.get_layout() == h5d.VIRTUAL or settings.get_external_count():
            raise ValueError(f"{name} is in another file")
        packed = DEFLATE if settings.get_nfilters() else 1
        self._left -= size / packed
        if self._left < 0 or item.id.get_storage_size() * packed < size:
            raise ValueError(f"{name} has more values than the file has room for")
        return item

    def _group(self, name: str) -> Any:
        """Return a group. Raises ValueError if there is none."""
        import h5py

        item = _hard_linked(self._file, name)
        if not isinstance(item, h5py.Group):
            raise ValueError(f"{name} is no group")
        return item


def _hard_linked(group: Any, name: str) -> Any:
    """Return the entry of a group that is stored in the file itself; a link raises ValueError."""
    import h5py

    if not isinstance(group.get(name, getlink=True), h5py.HardLink):
        raise ValueError(f"there is no {name}")
    return group[name]


def check_typed(value: Any, kind: Any, where: str) -> None:
    """Raise TypeError with the location unless `value` is of `kind`: a dataclass, tuple, mapping, union, str or
    number.
    """
    if kind is Any:
        return
    origin = get_origin(kind)
    if origin is tuple:
        _check_tuple(value, get_args(kind), where)
    elif isinstance(origin, type) and issubclass(origin, Mapping):
        _check_class(value, Mapping, where)
        for key, item in value.items():
            _check_class(key, str, where)
            check_typed(item, get_args(kind)[1], f"{where}.{key}")
    elif isinstance(kind, UnionType):
        if not any(_is_typed(value, one) for one in get_args(kind)):
            raise TypeError(f"{where} is {type(value).__name__}, expected {kind}")
    elif isinstance(kind, type) and is_dataclass(kind):
        _check_class(value, kind, where)
        for name, one in _field_types(kind).items():
            check_typed(getattr(value, name), one, f"{where}.{name}")
    else:
        _check_class(value, {float: (float, int)}.get(kind, kind), where)


def _is_typed(value: Any, kind: Any) -> bool:
    """Return whether a value is of a kind, by `check_typed`."""
    try:
        check_typed(value, kind, "")
    except TypeError:
        return False
    return True


def _check_tuple(value: Any, kinds: tuple[Any, ...], where: str) -> None:
    """Raise TypeError unless a value is a tuple with entries of these kinds."""
    _check_class(value, tuple, where)
    if len(kinds) == 2 and kinds[1] is Ellipsis:
        kinds = kinds[:1] * len(value)
    if len(kinds) != len(value):
        raise TypeError(f"{where} has {len(value)} entries, expected {len(kinds)}")
    for k, (item, kind) in enumerate(zip(value, kinds, strict=True)):
        check_typed(item, kind, f"{where}[{k}]")


def _check_class(value: Any, kind: Any, where: str) -> None:
    """Raise TypeError unless a value is an instance of a class; a bool does not count as a number."""
    is_bool = isinstance(value, bool) and kind is not bool
    if is_bool or not isinstance(value, NoneType if kind is None else kind):
        raise TypeError(f"{where} is {type(value).__name__}, expected {kind}")


@cache
def _field_types(kind: Any) -> dict[str, Any]:
    """Return the type hints of the fields of a dataclass."""
    hints = get_type_hints(kind)
    return {field.name: hints[field.name] for field in fields(kind)}

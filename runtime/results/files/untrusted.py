"""Read and validate arrays and texts of NetCDF files from untrusted sources; an invalid file raises InputError.

The checksum, types, lengths and names are checked before data is read. Links to other files are not followed, and no
more is read than the size of the file allows. `check_type` checks the types of objects from JSON.
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

from gudgeon.errors import GudgeonError, InputError, escape_line_breaks
from gudgeon.files.reading import check_regular_file
from gudgeon.language.argument_checks import check_path
from gudgeon.results.files.hdf5 import is_damaged
from gudgeon.results.state import Array

OLD_FORMAT = "gudgeon-result/1"  # impacts, events, parameters at the root, over other dimensions
MAX_COMPRESSION = 1100  # compression ratio that no built-in filter of HDF5 exceeds
LOADERS = {
    "gudgeon-result": ("a single run", "gudgeon.Result.load"),
    "gudgeon-batch": ("a batch of runs", "gudgeon.Batch.load"),
}
Content = TypeVar("Content")
DAMAGED_HINT = "the file is not a result of gudgeon, or is damaged or truncated; run the scene again"


def open_result_file(path: str | os.PathLike[str], read_content: Callable[[Any, int], Content]) -> Content:
    """Return `read_content(file, size)` for an open HDF5 file and its size in bytes.

    Raises InputError for every fault of the file, also for what `read_content` raises; GudgeonError without h5py.
    """
    try:
        import h5py
    except ModuleNotFoundError as error:
        raise GudgeonError("NetCDF files need h5py: pip install 'gudgeon[xarray]'") from error
    path, path_text = Path(check_path(path, "path")), escape_line_breaks(os.fspath(path))
    try:
        status = path.stat()
    except OSError:  # a name that is too long, too
        raise InputError(f"there is no file {path_text}") from None
    check_regular_file(status, path_text)
    try:
        if is_damaged(path):
            raise InputError(f"{path_text} is damaged: its checksum does not match", hint="run the scene again")
        with h5py.File(path, "r") as file:
            return read_content(file, status.st_size)
    except InputError:
        raise
    except Exception as error:  # any error of HDF5, JSON or NumPy for invalid contents
        message = str(error).partition("\n")[0][:200] or type(error).__name__
        raise InputError(f"{path_text} cannot be read as a result: {message}", hint=DAMAGED_HINT) from error


class File:
    """Arrays and texts of an open file by name ("S9.y", "impacts/t_on"). Raises ValueError for unexpected contents."""

    def __init__(self, file: Any, size: int, formats: tuple[str, ...]) -> None:
        """Check the format of an open HDF5 file of `size` bytes; formats[0] is the current one.

        Raises InputError for a file of the other kind of result, ValueError for any other format.
        """
        self._file, self._bytes_left = file, float(size)
        stored_format = self.read_text_attribute("gudgeon")
        format_name = stored_format.partition("/")[0]
        if format_name in LOADERS and not formats[0].startswith(f"{format_name}/"):
            content, loader = LOADERS[format_name]
            raise InputError(
                f"{escape_line_breaks(file.filename)} contains {content} ({stored_format})",
                hint=f"read it with {loader}",
            )
        if stored_format not in formats:
            raise ValueError(f"expected the attribute gudgeon = {formats[0]!r}, found {stored_format!r}")
        self.is_old = stored_format == OLD_FORMAT

    def has_entry(self, group: str) -> bool:
        """Return whether the file contains a group or dataset."""
        return group in self._file

    def list_names(self, group: str) -> list[str]:
        """Return the names of the entries of a group."""
        return list(self._get_group(group))

    def read_text_attribute(self, key: str, group: str = "") -> str:
        """Return a text attribute of the file or of a group.

        Raises ValueError if it is not a text, KeyError if there is none.
        """
        value = (self._get_group(group) if group else self._file).attrs[key]
        if isinstance(value, bytes):
            value = value.decode()
        if not isinstance(value, str):
            raise ValueError(f"the attribute {key!r} is not a text")
        return str(value)

    def read_array(self, name: str, length: int | None = None, dtype: str = "f8") -> Array:
        """Return a numeric array (n,) of the file; raise ValueError for another type or length.

        `length` None allows any length.
        """
        dataset = self._get_dataset(name, length)
        if dataset.dtype.newbyteorder("=") != np.dtype(dtype):
            raise ValueError(f"{name} has numbers of type {dataset.dtype}, expected {dtype}")
        values: Array = dataset[...].astype(dtype, copy=False)
        return values

    def read_integers_or_floats(self, name: str, length: int) -> Array:
        """Return an array of integers or floats, as stored."""
        return self.read_array(name, length, "i8" if self._get_dataset(name, length).dtype.kind == "i" else "f8")

    def read_texts(self, name: str, length: int | None = None) -> list[str]:
        """Return an array of texts of the file as a list; raise ValueError for numbers or another length.

        `length` None allows any length.
        """
        import h5py

        dataset = self._get_dataset(name, length)
        if h5py.check_string_dtype(dataset.dtype) is None:
            raise ValueError(f"{name} has numbers, expected texts")
        return [str(text) for text in dataset.asstr()[...]]

    def _get_dataset(self, name: str, length: int | None) -> Any:
        """Return a one-dimensional dataset after checks of its length, storage and size; raise ValueError otherwise.

        Its data must be in this file. Its uncompressed size, over MAX_COMPRESSION if compressed, is subtracted from
        `_bytes_left`, which must not become negative: all datasets together fit in the size of the file. `length` None
        allows any length.
        """
        import h5py
        from h5py import h5d

        group, _, entry_name = name.rpartition("/")
        dataset = _get_hard_linked_entry(self._get_group(group) if group else self._file, entry_name)
        if not isinstance(dataset, h5py.Dataset) or len(dataset.shape or ()) != 1:
            raise ValueError(f"{name} is not a one-dimensional variable")
        if length is not None and dataset.shape[0] != length:
            raise ValueError(f"{name} has {dataset.shape[0]} values, expected {length}")
        creation_properties, n_bytes = dataset.id.get_create_plist(), dataset.shape[0] * dataset.dtype.itemsize
        if creation_properties.get_layout() == h5d.VIRTUAL or creation_properties.get_external_count():
            raise ValueError(f"{name} is in another file")
        compression_limit = MAX_COMPRESSION if creation_properties.get_nfilters() else 1
        self._bytes_left -= n_bytes / compression_limit
        if self._bytes_left < 0 or dataset.id.get_storage_size() * compression_limit < n_bytes:
            raise ValueError(f"{name} has more values than fit in the file")
        return dataset

    def _get_group(self, name: str) -> Any:
        """Return a group. Raises ValueError if there is none, or if it is a link or a dataset."""
        import h5py

        entry = _get_hard_linked_entry(self._file, name)
        if not isinstance(entry, h5py.Group):
            raise ValueError(f"{name} is not a group")
        return entry


def _get_hard_linked_entry(group: Any, name: str) -> Any:
    """Return an entry of a group; raise ValueError for a missing entry, and for a soft or external link."""
    import h5py

    if not isinstance(group.get(name, getlink=True), h5py.HardLink):
        raise ValueError(f"there is no {name}")
    return group[name]


def check_type(value: Any, expected_type: Any, location: str) -> None:
    """Raise TypeError unless `value` has the expected type, at any depth; `location` names the value in the error.

    Types are dataclasses, tuples, mappings with texts as keys, unions, str and numbers; an int is allowed for float.
    """
    if expected_type is Any:
        return
    origin = get_origin(expected_type)
    if origin is tuple:
        _check_tuple(value, get_args(expected_type), location)
    elif isinstance(origin, type) and issubclass(origin, Mapping):
        _check_instance(value, Mapping, location)
        for key, element in value.items():
            _check_instance(key, str, location)
            check_type(element, get_args(expected_type)[1], f"{location}.{key}")
    elif isinstance(expected_type, UnionType):
        if not any(_has_type(value, member_type) for member_type in get_args(expected_type)):
            raise TypeError(f"{location} is {type(value).__name__}, expected {expected_type}")
    elif isinstance(expected_type, type) and is_dataclass(expected_type):
        _check_instance(value, expected_type, location)
        for name, member_type in _get_field_types(expected_type).items():
            check_type(getattr(value, name), member_type, f"{location}.{name}")
    else:
        _check_instance(value, {float: (float, int)}.get(expected_type, expected_type), location)


def _has_type(value: Any, expected_type: Any) -> bool:
    """Return whether a value has the expected type, by `check_type`."""
    try:
        check_type(value, expected_type, "")
    except TypeError:
        return False
    return True


def _check_tuple(value: Any, item_types: tuple[Any, ...], location: str) -> None:
    """Raise TypeError unless a value is a tuple with entries of these types; (T, ...) allows any number of T."""
    _check_instance(value, tuple, location)
    if len(item_types) == 2 and item_types[1] is Ellipsis:
        item_types = item_types[:1] * len(value)
    if len(item_types) != len(value):
        raise TypeError(f"{location} has {len(value)} entries, expected {len(item_types)}")
    for k, (element, element_type) in enumerate(zip(value, item_types, strict=True)):
        check_type(element, element_type, f"{location}[{k}]")


def _check_instance(value: Any, expected_class: Any, location: str) -> None:
    """Raise TypeError unless a value is an instance of a class; `expected_class` None expects None.

    A bool does not count as a number.
    """
    is_unexpected_bool = isinstance(value, bool) and expected_class is not bool
    if is_unexpected_bool or not isinstance(value, NoneType if expected_class is None else expected_class):
        raise TypeError(f"{location} is {type(value).__name__}, expected {expected_class}")


@cache
def _get_field_types(dataclass_type: Any) -> dict[str, Any]:
    """Return the type hints of the fields of a dataclass."""
    hints = get_type_hints(dataclass_type)
    return {field.name: hints[field.name] for field in fields(dataclass_type)}

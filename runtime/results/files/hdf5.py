"""Write tables as an HDF5 file that NetCDF 4 tools read: h5py creates the metadata, then the file is streamed to disk.

HDF5 never writes to a file itself: a full disk would leave it with handles that it cannot close and that crash it at
exit. It lays out the metadata (about 70 kB) and the offsets of the arrays; the arrays go straight to the file. The
layout runs in a separate thread, where no signal reaches Python, since Ctrl-C within its calls would be lost.

The last line of a file is a checksum after the end of the HDF5 data. A program that changes the file drops it, and
the file then ends where the HDF5 data do. Damage leaves other bytes there.
"""

from __future__ import annotations

import io
import os
import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gudgeon.errors import GudgeonError
from gudgeon.files.free_space import check_disk
from gudgeon.files.writing import open_atomic
from gudgeon.language.argument_checks import check_path
from gudgeon.waiting.cancellation import run_interruptible
from gudgeon.waiting.ctrl_c import DelayedCtrlC

Array: TypeAlias = NDArray[Any]

# label of a dimension without a coordinate variable, as the NetCDF library writes it
NO_VARIABLE = "This is a netCDF dimension but not a netCDF variable.%10d"
MAX_COMPACT_BYTES = 60_000  # of a compact attribute; longer ones are stored in a heap
PAGE_BYTES = 4096
CHECKSUM_LINE = b"\ngudgeon crc32 %08x\n"
CHECKSUM_BYTES = len(CHECKSUM_LINE % 0)
SIGNATURE = b"\x89HDF\r\n\x1a\n"
# offset of the end-of-file address in a superblock, by its version (HDF5 File Format Specification, section II.A)
END_ADDRESS_OFFSETS = {0: 40, 1: 44, 2: 28, 3: 28}


@dataclass(frozen=True)
class Variable:
    """A named array of a table; `values` (n,) are numbers or, as objects, texts."""

    name: str
    values: Array
    unit: str
    meaning: str

    @property
    def is_text(self) -> bool:
        """Whether the values are texts."""
        return bool(self.values.dtype == object)

    @property
    def attributes(self) -> dict[str, str]:
        """Unit and meaning as NetCDF attributes."""
        return {"units": self.unit or "1", "long_name": self.meaning}


@dataclass(frozen=True)
class Table:
    """Variables over one dimension: the root of the file ("") or a group.

    The first variable may be the coordinate of the dimension.
    """

    group: str
    dimension: str
    variables: tuple[Variable, ...]
    attributes: Mapping[str, str]

    @property
    def length(self) -> int:
        """Length of the dimension; a table of length 0 is not written."""
        return len(self.variables[0].values) if self.variables else 0


def generate_file_chunks(tables: Sequence[Table]) -> Iterator[Any]:
    """Yield the bytes of an HDF5 file with these tables in the order of the file, and the checksum line last.

    h5py creates the layout in another thread; the arrays are not copied.
    """
    image, offsets_and_values = run_interruptible(partial(_lay_out_file, tables))
    checksum = position = 0
    for offset, values in sorted(offsets_and_values, key=lambda offset_and_values: offset_and_values[0]):
        for chunk in (image.read_range(position, offset), np.ascontiguousarray(values).data.cast("B")):
            checksum = zlib.crc32(chunk, checksum)
            yield chunk
        position = offset + values.nbytes
    tail = image.read_range(position, image.size)
    yield tail
    yield CHECKSUM_LINE % zlib.crc32(tail, checksum)


def write_tables(tables: Iterator[Table], path: str | os.PathLike[str]) -> None:
    """Write a NetCDF file with these tables under a temporary name, then move it into place.

    Ctrl-C is raised between tables and between chunks. Raises OutputError if the disk is too small or writing fails,
    GudgeonError without h5py.
    """
    try:
        import h5py  # noqa: F401
    except ModuleNotFoundError as error:
        raise GudgeonError("NetCDF files need h5py: pip install 'gudgeon[xarray]'") from error
    path, table_list = check_path(path, "path"), []
    with DelayedCtrlC() as ctrl_c:  # Python drops what is raised in callbacks of weak references, Ctrl-C too
        for table in tables:
            table_list.append(table)
            ctrl_c.raise_delayed()
        n_bytes = sum(variable.values.nbytes for table in table_list for variable in table.variables)
        check_disk(Path(path).parent, n_bytes, "it", path)
        with open_atomic(path) as file:
            for chunk in generate_file_chunks(table_list):
                file.write(chunk)
                ctrl_c.raise_delayed()
    ctrl_c.raise_delayed()


def is_damaged(path: Path) -> bool:
    """Return whether anything but a matching checksum follows the HDF5 data of a file, which must be an HDF5 file.

    False for a file that ends with its HDF5 data: another program wrote it. False also where the data do not begin at
    the first byte, and for a file of another kind; HDF5 reads or refuses these.
    """
    with open(path, "rb") as file:
        head = file.read(64)
        offset = END_ADDRESS_OFFSETS.get(head[len(SIGNATURE)]) if len(head) > len(SIGNATURE) else None
        if not head.startswith(SIGNATURE) or offset is None:
            return False
        size = int.from_bytes(head[offset : offset + 8], "little")
        if file.seek(0, io.SEEK_END) <= size:  # HDF5 refuses a file that is shorter
            return False
        file.seek(0)
        checksum = 0
        while size > 0 and (chunk := file.read(min(size, 1 << 20))):
            checksum = zlib.crc32(chunk, checksum)
            size -= len(chunk)
        return file.read(CHECKSUM_BYTES + 1) != CHECKSUM_LINE % checksum


class _FileImage(io.RawIOBase):
    """Sparse file in memory: only written pages are stored, so that the gaps for arrays need no memory."""

    def __init__(self) -> None:
        """Create an empty file."""
        self._pages: dict[int, bytearray] = {}
        self._at = self.size = 0

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        """Set the position as io.RawIOBase does, and return it."""
        self._at = offset + {io.SEEK_SET: 0, io.SEEK_CUR: self._at, io.SEEK_END: self.size}[whence]
        return self._at

    def write(self, data: Any) -> int:
        """Write bytes at the position, advance it, and return their number."""
        start, n_bytes = self._at, len(data)
        while self._at < start + n_bytes:
            page, offset = divmod(self._at, PAGE_BYTES)
            page_data = data[self._at - start :][: PAGE_BYTES - offset]
            self._pages.setdefault(page, bytearray(PAGE_BYTES))[offset : offset + len(page_data)] = page_data
            self._at += len(page_data)
        self.size = max(self.size, self._at)
        return n_bytes

    def readinto(self, buffer: Any) -> int:
        """Fill the buffer from the position, advance it, and return the buffer's length."""
        buffer[:] = self.read_range(self._at, self._at + len(buffer))
        self._at += len(buffer)
        return len(buffer)

    def truncate(self, size: int | None = None) -> int:
        """Set the size of the file, by default to the position, and return it."""
        self.size = self._at if size is None else size
        return self.size

    def read_range(self, begin: int, end: int) -> bytes:
        """Return the bytes [begin, end), zeros where nothing was written."""
        empty_page, first_page = bytes(PAGE_BYTES), begin // PAGE_BYTES
        pages = (self._pages.get(page, empty_page) for page in range(first_page, -(-end // PAGE_BYTES)))
        return b"".join(pages)[begin - first_page * PAGE_BYTES : end - first_page * PAGE_BYTES]


def _lay_out_file(tables: Sequence[Table]) -> tuple[_FileImage, list[tuple[int, Array]]]:
    """Create the HDF5 file in memory; return it without its numeric arrays, and (offset in bytes, values) of each.

    Tables with neither rows nor attributes are left out.
    """
    import h5py

    image, offsets_and_values = _FileImage(), []
    with h5py.File(image, "w", track_order=True) as file:
        for number, table in enumerate(table for table in tables if table.length or table.attributes):
            group = file.create_group(table.group, track_order=True) if table.group else file
            for dataset, variable in _lay_out_table(group, table, number) if table.length else ():
                for key, text in variable.attributes.items():
                    _write_text_attribute(dataset, key, text)
                if not variable.is_text:
                    offsets_and_values.append((dataset.id.get_offset(), variable.values))
            for key, text in table.attributes.items():
                _write_text_attribute(group, key, text)
    return image, offsets_and_values


def _lay_out_table(group: Any, table: Table, dimension_number: int) -> Iterator[tuple[Any, Variable]]:
    """Create the HDF5 datasets of a table in a group, and yield (dataset, variable) of each.

    A dimension without a coordinate variable gets a placeholder dataset, which is not yielded. `dimension_number` is
    the NetCDF number of the dimension, unique in the file.
    """
    from h5py import h5ds

    has_coordinate = table.variables[0].name == table.dimension
    first_variable = (
        table.variables[0] if has_coordinate else Variable(table.dimension, np.zeros(table.length, ">f4"), "", "")
    )
    scale = _create_dataset(group, first_variable)
    h5ds.set_scale(scale.id, (table.dimension if has_coordinate else NO_VARIABLE % table.length).encode())
    scale.attrs["_Netcdf4Dimid"] = np.int32(dimension_number)
    if has_coordinate:
        yield scale, first_variable
    for variable in table.variables[has_coordinate:]:
        dataset = _create_dataset(group, variable)
        h5ds.attach_scale(dataset.id, scale.id, 0)
        yield dataset, variable


def _create_dataset(group: Any, variable: Variable) -> Any:
    """Create a dataset for a variable and return it.

    Numbers get space in the file but no data yet, texts are written.
    """
    import h5py
    from h5py import h5d, h5p, h5s, h5t

    if variable.is_text:
        return group.create_dataset(variable.name, data=variable.values, dtype=h5py.string_dtype(), track_order=True)
    properties = h5p.create(h5p.DATASET_CREATE)
    properties.set_alloc_time(h5d.ALLOC_TIME_EARLY)
    properties.set_fill_time(h5d.FILL_TIME_NEVER)
    properties.set_obj_track_times(False)
    properties.set_attr_creation_order(h5p.CRT_ORDER_TRACKED | h5p.CRT_ORDER_INDEXED)
    type_, space = h5t.py_create(variable.values.dtype), h5s.create_simple(variable.values.shape)
    return h5py.Dataset(h5d.create(group.id, variable.name.encode(), type_, space, properties))


def _write_text_attribute(owner: Any, attribute_name: str, text: str) -> None:
    """Write a text attribute of a group or dataset, up to MAX_COMPACT_BYTES in compact form, as NetCDF does.

    The compact form is ten times faster.
    """
    from h5py import h5a, h5s, h5t

    data = text.encode()
    if len(data) > MAX_COMPACT_BYTES:
        owner.attrs[attribute_name] = text
        return
    type_ = h5t.C_S1.copy()
    type_.set_size(max(len(data), 1))
    type_.set_cset(h5t.CSET_UTF8)
    h5a.create(owner.id, attribute_name.encode(), type_, h5s.create(h5s.SCALAR)).write(np.array(data), mtype=type_)

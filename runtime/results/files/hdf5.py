"""Write tables as an HDF5 file that NetCDF 4 tools read: h5py lays it out in memory, then it is streamed to a file.

HDF5 never writes to a file itself: a full disk would leave it with handles that it cannot close and that crash it at
exit. It lays out the metadata (about 70 kB) and the offsets of the arrays; the arrays go straight to the file. The
layout runs in a separate thread, where no signal reaches Python, since Ctrl-C within its calls would be lost.

The last line of a file is a checksum after the end of the HDF5 data. A program that changes the file drops it; damage
to the file does not.
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
from gudgeon.files.writing import written
from gudgeon.language.argument_checks import path as named
from gudgeon.waiting.asking import apart
from gudgeon.waiting.ctrl_c import CtrlC

Array: TypeAlias = NDArray[Any]

# what a dimension without a coordinate variable is called in the file: NetCDF's own words
NO_VARIABLE = "This is a netCDF dimension but not a netCDF variable.%10d"
LONGEST = 60_000  # bytes of a compact attribute; longer ones are stored in a heap
PAGE = 4096
SEAL = b"\ngudgeon crc32 %08x\n"
SEAL_SIZE = len(SEAL % 0)


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


def pieces(tables: Sequence[Table]) -> Iterator[Any]:
    """Yield the bytes of a file with these tables in order, and the checksum last."""
    image, places = apart(partial(_lay_out, tables))
    total = at = 0
    for offset, values in sorted(places, key=lambda place: place[0]):
        for piece in (image.between(at, offset), np.ascontiguousarray(values).data.cast("B")):
            total = zlib.crc32(piece, total)
            yield piece
        at = offset + values.nbytes
    end = image.between(at, image.size)
    yield end
    yield SEAL % zlib.crc32(end, total)


def write(tables: Iterator[Table], path: str | os.PathLike[str]) -> None:
    """Write a file with these tables.

    They are computed one after the other, and Ctrl-C is handled in between.
    """
    try:
        import h5py  # noqa: F401
    except ModuleNotFoundError as error:
        raise GudgeonError("NetCDF files need h5py: pip install 'gudgeon[xarray]'") from error
    path, found = named(path, "path"), []
    with CtrlC() as ctrl_c:  # Python drops what is raised in callbacks of weak references, Ctrl-C too
        for table in tables:
            found.append(table)
            ctrl_c.take()
        size = sum(one.values.nbytes for table in found for one in table.variables)
        check_disk(Path(path).parent, size, "it", path)
        with written(path) as file:
            for piece in pieces(found):
                file.write(piece)
                ctrl_c.take()
    ctrl_c.take()


def is_damaged(path: Path) -> bool:
    """Return whether the checksum of a file does not match; False for a file without a checksum."""
    with open(path, "rb") as file:
        size = file.seek(0, io.SEEK_END) - SEAL_SIZE
        if size <= 0:
            return False
        file.seek(size)
        seal, total = file.read(), 0
        if not seal.startswith(SEAL.partition(b"%")[0]):
            return False
        file.seek(0)
        while size > 0 and (piece := file.read(min(size, 1 << 20))):
            total = zlib.crc32(piece, total)
            size -= len(piece)
        return seal != SEAL % total


class _Image(io.RawIOBase):
    """A file in memory that stores only the written pages, so that the gaps for arrays need no memory."""

    def __init__(self) -> None:
        """Create an empty file."""
        self._pages: dict[int, bytearray] = {}
        self._at = self.size = 0

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        """Set the position as io.RawIOBase does, and return it."""
        self._at = offset + {io.SEEK_SET: 0, io.SEEK_CUR: self._at, io.SEEK_END: self.size}[whence]
        return self._at

    def write(self, data: Any) -> int:
        """Write bytes at the position, and return their number."""
        begin, count = self._at, len(data)
        while self._at < begin + count:
            page, offset = divmod(self._at, PAGE)
            part = data[self._at - begin :][: PAGE - offset]
            self._pages.setdefault(page, bytearray(PAGE))[offset : offset + len(part)] = part
            self._at += len(part)
        self.size = max(self.size, self._at)
        return count

    def readinto(self, buffer: Any) -> int:
        """Fill the buffer from the position, and return its length."""
        buffer[:] = self.between(self._at, self._at + len(buffer))
        self._at += len(buffer)
        return len(buffer)

    def truncate(self, size: int | None = None) -> int:
        """Set the size of the file, by default to the position, and return it."""
        self.size = self._at if size is None else size
        return self.size

    def between(self, begin: int, end: int) -> bytes:
        """Return the bytes [begin, end), zeros where nothing was written."""
        nothing, first = bytes(PAGE), begin // PAGE
        pages = (self._pages.get(page, nothing) for page in range(first, -(-end // PAGE)))
        return b"".join(pages)[begin - first * PAGE : end - first * PAGE]


def _lay_out(tables: Sequence[Table]) -> tuple[_Image, list[tuple[int, Array]]]:
    """Return the image of the file without numeric arrays, and the offset of each array."""
    import h5py

    image, places = _Image(), []
    with h5py.File(image, "w", track_order=True) as file:
        for number, table in enumerate(table for table in tables if table.length or table.attributes):
            group = file.create_group(table.group, track_order=True) if table.group else file
            for dataset, variable in _lay_out_table(group, table, number) if table.length else ():
                for key, text in variable.attributes.items():
                    _write_text(dataset, key, text)
                if not variable.is_text:
                    places.append((dataset.id.get_offset(), variable.values))
            for key, text in table.attributes.items():
                _write_text(group, key, text)
    return image, places


def _lay_out_table(group: Any, table: Table, number: int) -> Iterator[tuple[Any, Variable]]:
    """Yield the dataset of each variable of a table.

    A dimension without a coordinate variable gets a placeholder dataset, which is not read.
    """
    from h5py import h5ds

    own = table.variables[0].name == table.dimension
    first = table.variables[0] if own else Variable(table.dimension, np.zeros(table.length, ">f4"), "", "")
    scale = _create(group, first)
    h5ds.set_scale(scale.id, (table.dimension if own else NO_VARIABLE % table.length).encode())
    scale.attrs["_Netcdf4Dimid"] = np.int32(number)
    if own:
        yield scale, first
    for variable in table.variables[own:]:
        dataset = _create(group, variable)
        h5ds.attach_scale(dataset.id, scale.id, 0)
        yield dataset, variable


def _create(group: Any, variable: Variable) -> Any:
    """Create a dataset: of numbers with space in the file but without data, of texts with its data."""
    import h5py
    from h5py import h5d, h5p, h5s, h5t

    if variable.is_text:
        return group.create_dataset(variable.name, data=variable.values, dtype=h5py.string_dtype(), track_order=True)
    settings = h5p.create(h5p.DATASET_CREATE)
    settings.set_alloc_time(h5d.ALLOC_TIME_EARLY)
    settings.set_fill_time(h5d.FILL_TIME_NEVER)
    settings.set_obj_track_times(False)
    settings.set_attr_creation_order(h5p.CRT_ORDER_TRACKED | h5p.CRT_ORDER_INDEXED)
    kind, space = h5t.py_create(variable.values.dtype), h5s.create_simple(variable.values.shape)
    return h5py.Dataset(h5d.create(group.id, variable.name.encode(), kind, space, settings))


def _write_text(where: Any, key: str, text: str) -> None:
    """Write a text attribute in compact form if it is short enough, as NetCDF does; this is ten times faster."""
    from h5py import h5a, h5s, h5t

    data = text.encode()
    if len(data) > LONGEST:
        where.attrs[key] = text
        return
    kind = h5t.C_S1.copy()
    kind.set_size(max(len(data), 1))
    kind.set_cset(h5t.CSET_UTF8)
    h5a.create(where.id, key.encode(), kind, h5s.create(h5s.SCALAR)).write(np.array(data), mtype=kind)
